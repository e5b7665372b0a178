# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of a robot that was tried: rows, verdict, JSON."""

from dataclasses import replace
import json
import math

import pytest

from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.model.robot import Joint, JointType, Limit
from amr_description.simulation.readings import Motion
from amr_description.testing.trial.bring_up import logged
from amr_description.testing.trial.driving import travel
from amr_description.testing.trial.findings import (
    Check,
    ControllerFinding,
    from_json,
    MotionResult,
    RestResult,
    row,
    table,
    to_json,
    TrialFindings,
)
from amr_description.testing.trial.moving import offset_of
from amr_description.testing.trial.one_robot import cause_of, check_of, explanations, unrest

FOUND = TrialFindings(
    'cart',
    '/cart.urdf',
    check=Check(1, ['no mass'], ['a', 'b']),
    spawn_seconds=2.04,
    rest=RestResult(math.inf, 0.5, 0.01, 0.0, 0.0),
    controllers=[
        ControllerFinding('a', 'x/A', 'active'),
        ControllerFinding('b', 'x/B', 'inactive'),
    ],
    motions=[
        MotionResult('a', 'forward', 1.0, 0.99, 1.0),
        MotionResult('a', 'turn', 2.0, 1.0, is_fine=False),
        MotionResult('a', 'trajectory', 0.0, None, is_fine=False),
    ],
    warnings=['WARN: x'] * 5,
    faults=['a: turn'],
    seconds=9.6,
    cpu_seconds=3.21,
)


def test_a_row_tells_every_stage():
    motions = 'forward 99%; !turn 50%; !trajectory'
    assert row(FOUND) == ('cart', '1E 2W', '2.0 s', 'no', '1/2', motions, '5', '10', '3.2')
    assert row(TrialFindings('a', 'a'))[1:6] == ('0E 0W', 'refused', '-', '0/0', '-')


def test_the_table_has_faults_and_the_first_warnings():
    lines = table([FOUND, TrialFindings('arm', 'arm')]).splitlines()
    assert lines[1].endswith('FAIL')
    assert lines[2:7] == ['    fault: a: turn', *['    WARN: x'] * 3, '    … and 2 lines more']
    assert lines[7].split()[:3] == ['arm', '0E', '0W']
    assert lines[7].endswith('ok')
    assert lines[-1] == '1 of 2 fine'
    assert len(table([FOUND], details=False).splitlines()) == 3


def test_json_holds_everything_and_is_read_again():
    text = to_json([FOUND])
    assert json.loads(text)[0]['rest']['seconds'] is None
    assert from_json(text) == FOUND


def test_warnings_and_errors_of_a_log_are_told_once():
    log = (
        '[INFO] [1.0] [sim]: on\n' + '[WARN] [1.0] [sim]: thin\n' * 2 + '[ERROR] [2.0] [a.b]: no\n'
    )
    assert logged(log) == ['WARN: thin', 'ERROR: no']


@pytest.mark.parametrize(
    ('code', 'out', 'err', 'expected'),
    [
        (1, '{"error": "cannot"}', '', Check(1, errors=['cannot'])),
        (
            0,
            '{"findings": [{"severity": "warning", "line": 3, "what": "thin", "found": "1"}]}',
            '',
            Check(0, warnings=['3: thin, 1']),
        ),
        (0, 'tree', '', Check(0, failure="exit code 0, and no JSON: 'tree'")),
        (
            1,
            '',
            'Traceback (most recent call last):\n  x\nKeyError: 1\n',
            Check(1, failure='exit code 1: KeyError: 1'),
        ),
        (-11, '', '', Check(-11, failure='exit code -11: ?')),
    ],
)
def test_a_check_that_fails_is_not_one_that_finds_errors(code, out, err, expected):
    assert check_of(code, out, err) == expected


@pytest.mark.parametrize(
    ('truth', 'odometry', 'expected'),
    [
        (None, None, 'not measured'),
        (-0.99, 1.0, 'the other way'),
        (0.5, None, 'no odometry'),
        (0.5, 0.52, 'by its odometry, too'),
        (0.5, 1.0, 'not by its odometry'),
    ],
)
def test_truth_and_odometry_tell_a_cause(truth, odometry, expected):
    motion = MotionResult('a', 'forward', 1.0, truth, odometry, is_fine=False)
    assert cause_of(motion).startswith(expected)


def test_only_what_was_said_of_the_controller_explains_its_motion():
    lines = [
        'WARN: c.yaml:9: drive: left and right wheels are swapped: turns are inverted',
        'WARN: c.yaml:9: drive: the wheel cannot roll: it slides',
        'WARN: c.yaml:9: overdrive: the wheel cannot roll: it slides',
        'ERROR: drive: no',
        'WARN: thin',
        'WARN: cart.urdf: "caster" slides and holds the robot: its wheels pull less: they slip',
    ]
    turn = MotionResult('drive', 'turn', 1.0, -1.0, 1.0, is_fine=False)
    assert explanations(turn, lines) == [*lines[:2], lines[-1]]
    ahead = replace(turn, what='forward')
    assert explanations(ahead, lines) == [lines[1], lines[-1]]
    marked = replace(FOUND, motions=[replace(turn, said='x')], explained=['drive: x'])
    assert row(marked)[5] == '~turn -100%'
    assert '    explained: drive: x' in table([marked]).splitlines()


def at(x, y, yaw):
    pose = Transform((x, y, 0.0), quaternion_from_yaw(yaw))
    return Motion(0.0, pose, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_the_way_is_in_the_axes_of_the_start():
    found = travel(at(1.0, 1.0, math.pi / 2), at(1.0, 3.0, -math.pi))
    assert (found.ahead, found.left) == pytest.approx((2.0, 0.0), abs=1e-12)
    assert found.turn == pytest.approx(math.pi / 2)


@pytest.mark.parametrize(
    ('kind', 'limit', 'position', 'expected'),
    [
        (JointType.REVOLUTE, (-2.0, 2.0), 0.0, 0.3),
        (JointType.REVOLUTE, (-2.0, 2.0), 1.0, -0.3),
        (JointType.REVOLUTE, (0.0, 0.5), 0.0, 0.1),
        (JointType.PRISMATIC, (0.0, 1.0), 0.0, 0.05),
        (JointType.CONTINUOUS, None, 5.0, 0.3),
    ],
)
def test_a_joint_is_asked_to_the_side_with_more_room(kind, limit, position, expected):
    bounds = Limit(*limit, 1.0, 1.0) if limit else None
    origin = Transform()
    joint = Joint('j', kind, 'a', 'b', origin, (0.0, 0.0, 1.0), bounds, None, None, 1)
    assert offset_of(joint, position) == pytest.approx(expected)


def test_a_robot_that_tips_over_is_told_from_one_that_trembles():
    trembles = RestResult(math.inf, fastest=0.1, drop=0.0, shift=0.0, tilt=0.1)
    assert unrest(trembles, 0.02, 0.5) == (
        'it still moves after 2 s: 0.020 m/s, 0.500 rad/s at the end'
    )
    tips = replace(trembles, tilt=math.pi / 2.0)
    assert unrest(tips, 0.02, 0.5).endswith(
        'it has tipped over, by 90°, as what is made to be bolted down does (fixed:=true)'
    )
