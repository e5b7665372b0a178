# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics of controllers that drive, where a stack or a test looks for them."""

import sys

from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.wheeled_drive import reference_input, stamped_twist_input
from amr_description.model.controller_files import class_of, VELOCITY_TOPICS


def test_every_controller_that_drives_is_known_by_its_class_and_topic():
    found = {}
    for name in CONTROLLERS.names:
        names = vars(sys.modules[CONTROLLERS.find(name).__module__])
        for make in (stamped_twist_input, reference_input):
            if make.__name__ in names:
                found[class_of(name)] = make().port.name
    assert found == VELOCITY_TOPICS


def test_the_class_of_a_type_is_behind_a_slash_or_two_colons():
    assert class_of('diff_drive_controller/DiffDriveController') == 'DiffDriveController'
    assert class_of('diff_drive_controller::DiffDriveController') == 'DiffDriveController'
