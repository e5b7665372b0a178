# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which controllers of a vendor's parameter file a robot lacks, and which it does without."""

import pytest

from amr_description.testing.trial.findings import ControllerFinding, MotionResult, TrialFindings
from amr_description.testing.trial.parts import (
    is_here,
    named_in_parameters,
    NO_SUCH_INTERFACES,
    NOT_HERE,
    split,
)
from amr_description.testing.trial.verdict import judge, table, TrialVerdict

JOINTS = ('shoulder', 'elbow', 'finger')


def controller(name, *names, state='inactive', without=NOT_HERE):
    return ControllerFinding(name, 'x/Y', state, without=without, names=[*names])


@pytest.mark.parametrize(
    ('finding', 'is_spare'),
    [
        (controller('faults', 'not loaded', 'arm'), True),  # names no joint of the robot
        (controller('compliance', 'shoulder', 'elbow'), True),  # others have moved them
        (controller('hand', 'finger'), False),  # nobody has moved it
        (controller('hand', 'knuckle', without=NO_SUCH_INTERFACES), True),  # another robot's
        (controller('sensor', without=''), False),  # could be here, and failed
    ],
)
def test_a_robot_does_without_what_cannot_be_here_if_others_move_its_joints(finding, is_spare):
    active = controller('arm', state='active')
    lacking, spare = split([active, finding], JOINTS, {'shoulder', 'elbow', 'position'})
    assert (finding in spare, finding in lacking) == (is_spare, not is_spare)
    assert active not in (*lacking, *spare)


def test_a_class_is_here_or_is_not():
    known = ['diff_drive_controller/DiffDriveController']
    assert is_here('diff_drive_controller/DiffDriveController', known)
    assert not is_here('picknik_twist_controller/PicknikTwistController', known)
    assert is_here('json.decoder/JSONDecoder', known)  # it would say itself why it is none


def test_the_texts_of_a_controllers_sections_are_what_it_names(tmp_path):
    file = tmp_path / 'both.yaml'
    file.write_text(
        '/**/hand: {ros__parameters: {joint: finger, gains: {finger: {p: 1.0}}, of: [[a], b]}}\n'
        'arm/hand: {ros__parameters: {side: left}}\n'
        'handle: {ros__parameters: {joint: door}}\n'
    )
    assert named_in_parameters('hand', [file]) == {'finger', 'a', 'b', 'left'}


def test_what_a_robot_did_without_is_told_beside_its_verdict():
    moved = MotionResult('arm', 'trajectory', 0.3, 0.3)
    arm = TrialFindings('arm', 'arm', motions=[moved], spare=['faults (x/Y): its class …'])
    assert str(judge(arm)) == 'moved as told (without faults (x/Y): its class …)'
    assert judge(arm).verdict is TrialVerdict.AS_TOLD
    assert '1 moved as told, 1 of them without controllers that cannot be here;' in table([arm])
    alone = TrialFindings('arm', 'arm', spare=['faults (x/Y): its class …'])
    assert judge(alone).verdict is TrialVerdict.NOT
