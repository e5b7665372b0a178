# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which state a request to a controller manager means."""

import pytest

from amr_description.control.interfaces import LifecycleState
from amr_description.control.ros.services import state_of


@pytest.mark.parametrize(
    ('number', 'label', 'state'),
    [
        (3, '', LifecycleState.ACTIVE),
        (0, 'inactive', LifecycleState.INACTIVE),
        (3, 'inactive', LifecycleState.ACTIVE),  # the number counts
        (0, '', LifecycleState.UNKNOWN),
        (0, 'Active', LifecycleState.UNKNOWN),
        (77, 'active', LifecycleState.UNKNOWN),
    ],
)
def test_the_number_counts_and_without_one_the_label(number, label, state):
    assert state_of(number, label) is state
