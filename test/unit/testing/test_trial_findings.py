# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of a robot that was tried: rows, verdict, JSON."""

from dataclasses import replace
import json
import math
from types import SimpleNamespace

from controller_manager_msgs.msg import ControllerState
import pytest

from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.model.robot import Joint, JointType, Limit
from amr_description.model.urdf import parse
from amr_description.simulation.readings import Joint as State, Motion
from amr_description.testing.trial.bring_up import Active, in_the_way_of, logged
from amr_description.testing.trial.driving import travel
from amr_description.testing.trial.findings import (
    Check,
    ControllerFinding,
    from_json,
    MotionResult,
    RestResult,
    to_json,
    TrialFindings,
)
from amr_description.testing.trial.inputs import declared_drives
from amr_description.testing.trial.moving import Mover, offset_of
from amr_description.testing.trial.one_robot import check_of, mover_of_body
from amr_description.testing.trial.posture import (
    has_tipped,
    spreading_joints,
    stands_on_legs,
    tilt_between,
    tipped,
    unrest,
)
from amr_description.testing.trial.verdict import (
    cause_of,
    explanations,
    judge,
    row,
    table,
    TrialVerdict,
)

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


def test_the_table_has_verdicts_faults_and_the_first_warnings():
    arm = TrialFindings('arm', 'arm', has_drive=False, undriven=['nothing drives it'])
    lines = table([FOUND, arm]).splitlines()
    assert lines[1].endswith('  moved, off')
    assert lines[2:4] == [
        '    moved, off (a: turn 50 %: no odometry to compare with)',
        '    fault: a: turn',
    ]
    assert lines[4:8] == [*['    WARN: x'] * 3, '    … and 2 lines more']
    assert lines[8].split()[:3] == ['arm', '0E', '0W']
    assert lines[8].endswith('did not move')
    assert lines[-1] == (
        '2 tried: 0 moved as told; 1 moved, off; 1 did not move, 1 of them without anything in '
        'their description that drives'
    )
    assert len(table([FOUND], details=False).splitlines()) == 3


def motion(share, what='forward', odometry=1.0, **more):
    is_fine = abs(share - 1.0) < 0.05
    return MotionResult('drive', what, 1.0, share, odometry, is_fine=is_fine, **more)


def verdict(*motions, **more):
    return judge(TrialFindings('x', 'x', motions=[*motions], **more))


def test_a_verdict_is_of_what_a_robot_did():
    assert verdict(motion(0.99), motion(1.0, 'turn')).verdict is TrialVerdict.AS_TOLD
    off = verdict(motion(0.99), motion(0.6, 'turn', said='WARN: /a/x.yaml:3: wheels scrub'))
    assert str(off) == 'moved, off (drive: turn 60 %: x.yaml:3: wheels scrub)'
    assert verdict(motion(-1.0, 'turn')).verdict is TrialVerdict.OFF
    assert verdict(motion(0.02)).verdict is TrialVerdict.NOT
    assert verdict(motion(math.nan)).verdict is TrialVerdict.NOT
    refused = verdict(faults=['spawn: MuJoCo refuses the model'])
    assert str(refused) == 'did not move (spawn: MuJoCo refuses the model)'
    arm = verdict(motion(1.0), faults=['hand (x/Y) is not loaded: no such type'])
    assert str(arm) == 'moved, off (hand (x/Y) is not loaded: no such type)'


def test_what_falls_tips_or_is_lost_has_not_moved_as_told():
    for posture in (tipped(1.0), 'it falls, by 44.0 m', 'its state is lost: x'):
        assert verdict(motion(1.0), posture=[f'at rest {posture}']).verdict is TrialVerdict.OFF
        assert str(verdict(posture=[posture])) == f'did not move ({posture})'
    assert 'by 57°' in tipped(1.0)
    assert 'fixed:=true' in tipped(1.0) and tipped(1.0, rolls=True).endswith('by 57°')
    assert not has_tipped(math.radians(4.0))
    assert has_tipped(tilt_between(at(0.0, 0.0, 0.0), lying()))


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


def test_of_joints_the_cause_is_not_sought_in_odometry():
    motion = MotionResult('a', 'trajectory', 1.0, 6.37, None, is_fine=False)
    assert cause_of(motion).startswith('its joints do not follow')


def limbs(count, kind='revolute', root='base', lowest=2):
    """A robot of some limbs of three joints each, the first of which turns about x."""
    parts = [f'<robot name="r"><link name="{root}"/>']
    for limb in range(count):
        for number in range(3):
            parent = f'l{limb}{number - 1}' if number else root
            parts.append(
                f'<link name="l{limb}{number}"/><joint name="j{limb}{number}" type="{kind}">'
                f'<parent link="{parent}"/><child link="l{limb}{number}"/>'
                f'<origin xyz="0 0 {-0.2 if limb < lowest else 0.2}"/>'
                f'<axis xyz="{"0 1 0" if number else "1 0 0"}"/>'
                '<limit lower="-1" upper="1" effort="9" velocity="9"/></joint>'
            )
    return parse(''.join([*parts, '</robot>']))


def test_who_stands_on_legs_is_moved_less_far():
    assert stands_on_legs(limbs(2)) and stands_on_legs(limbs(4))
    assert not stands_on_legs(limbs(1))  # an arm
    assert not stands_on_legs(limbs(4, kind='continuous'))  # wheels
    assert not stands_on_legs(limbs(2, root='world'))


def test_of_legs_that_stand_no_joint_is_moved_that_pushes_feet_apart():
    """Hips about x spread the legs, thighs and calves about y bend them; arms are free."""
    assert spreading_joints(limbs(4, lowest=4)) == {'j00', 'j10', 'j20', 'j30'}
    assert spreading_joints(limbs(4, lowest=2)) == {'j00', 'j10'}  # of a humanoid
    assert spreading_joints(limbs(1)) == frozenset()  # an arm


def test_what_is_held_is_asked_to_stay_unless_there_is_nothing_else():
    states = SimpleNamespace(read=lambda: {'hip': State(0.1, 0.0, 0.0), 'knee': State(0, 0, 0)})
    joints = ('hip/position', 'knee/position')

    def asked(*claimed):
        legs = Active('legs', 'x/JointTrajectoryController', '/', claimed, False)
        mover = Mover(SimpleNamespace(), legs, {}, states, on_legs=True, held={'hip'})
        return {name: round(b - a, 3) for name, (a, b) in mover._targets().items()}

    assert asked(*joints) == {'hip': 0.0, 'knee': 0.06}
    assert asked(joints[0]) == {'hip': 0.06}


def test_beside_a_plugin_that_moves_the_body_wheels_only_turn():
    planar = Active('planar', 'amr_description/GazeboPlanarMove', '/', ('base/x',), False)
    wheels = Active('wheels', 'x/MecanumDriveController', '/', ('front/velocity',), False)
    states = Active('states', 'x/JointStateBroadcaster', '/', (), False)
    assert mover_of_body([planar, wheels]) == 'planar'
    assert not mover_of_body([wheels, planar]) and not mover_of_body([planar, states])
    assert not mover_of_body([states, wheels])


def test_wheels_that_were_steered_are_straight_again_for_what_is_tried_next(monkeypatch):
    steered, passed = State(0.1, 0.0, 0.0), []
    sim = SimpleNamespace(run=passed.append)
    controller = Active('steering', 'x/ForwardCommandController', '/', ('front/position',), False)
    mover = Mover(sim, controller, {}, SimpleNamespace(read=lambda: {'front': steered}))
    sent = []
    monkeypatch.setattr(mover, '_command', sent.append)
    mover.move()
    assert sent == [[pytest.approx(0.4)], [0.1]] and len(passed) == 2


@pytest.mark.parametrize(('time_constant', 'expected'), [(0.1, 0.3), (3.0, 0.3), (math.inf, 0.0)])
def test_joints_that_turn_something_heavy_are_given_the_time_they_need(time_constant, expected):
    clock = [0.0]

    def position():
        t = clock[0]  # of a speed that grows to what is commanded
        if math.isinf(time_constant):
            return 0.0
        return 0.3 * (t - time_constant * (1.0 - math.exp(-t / time_constant)))

    class Sim(SimpleNamespace):
        time = property(lambda _: clock[0])

        def run(self, seconds):
            clock[0] += seconds

    states = SimpleNamespace(read=lambda: {'axle': State(position(), 0.0, 0.0)})
    turned = Active('axle', 'x/JointGroupVelocityController', '/', ('axle/velocity',), False)
    mover = Mover(Sim(), turned, {}, states)
    mover._command = lambda values: None
    assert mover.move().truth == pytest.approx(expected, rel=0.1, abs=1e-6)
    assert clock[0] < 16.0


SWAPPED = 'WARN: c.yaml:9: drive: left and right wheels are swapped: turns are inverted'
ORDER = 'WARN: c.yaml:9: drive: the traction joints are not in the order right, left'
SLIDES = 'WARN: c.yaml:9: drive: the wheel cannot roll: it slides'
OTHERS = 'WARN: c.yaml:9: overdrive: the wheel cannot roll: it slides'
CASTER = 'WARN: cart.urdf: "caster" slides and holds the robot: its wheels pull less: they slip'
SCRUB = 'WARN: c.yaml:9: drive: wheels one behind the other scrub in a turn'
RADIUS = 'WARN: c.yaml:9: drive: wheel_radius is not that of "w": found 0.05 m, expected 0.1 m'
CLAMPED = "WARN: robot 'x': joint 'w': the velocity command 9 is beyond 3.5 and is clamped"


@pytest.mark.parametrize(
    ('what', 'share', 'explained_by'),
    [
        ('turn', -1.0, [SWAPPED, ORDER]),
        ('turn', 0.6, [ORDER, SLIDES, CASTER, SCRUB, CLAMPED]),
        ('forward', 0.6, [SLIDES, CASTER, CLAMPED]),
        ('forward', 2.0, [RADIUS]),
        ('turn', 1.4, [RADIUS]),
        ('forward', -1.0, []),
        ('forward', 1.0, []),
    ],
)
def test_only_what_explains_a_deviation_counts(what, share, explained_by):
    lines = [SWAPPED, ORDER, SLIDES, OTHERS, 'INFO: drive: scrub', 'WARN: thin', CASTER, SCRUB]
    lines += [RADIUS, CLAMPED]
    assert explanations(motion(share, what), lines) == explained_by


def test_what_is_explained_has_its_mark():
    turn = MotionResult('drive', 'turn', 1.0, -1.0, 1.0, is_fine=False, said='x')
    marked = replace(FOUND, motions=[turn], explained=['drive: x'])
    assert row(marked)[5] == '~turn -100%'
    assert '    explained: drive: x' in table([marked]).splitlines()


def at(x, y, yaw):
    pose = Transform((x, y, 0.0), quaternion_from_yaw(yaw))
    return Motion(0.0, pose, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def lying():
    pose = Transform((0.0, 0.0, 0.0), (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)))
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
        (JointType.REVOLUTE, (-2.0, 2.0), 1e-6, -0.3),
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
    alike = 0.3 if position == 1e-6 else expected  # as its neighbour at -1e-6
    assert offset_of(joint, position, on_legs=True) == pytest.approx(alike)


def test_what_a_robot_that_trembles_does_is_told():
    assert unrest(0.02, 0.5) == 'it still moves after 2 s: 0.020 m/s, 0.500 rad/s at the end'


def test_what_a_description_says_that_drives_counts_even_if_nobody_simulates_it():
    def drives(inside):
        return declared_drives(f'<robot name="x"><link name="a"/>{inside}</robot>')

    base = '<plugin name="base" filename="libgazebo_ros_force_based_move.so"/>'
    assert drives(f'<gazebo>{base}</gazebo>').plugins == ('base',)
    assert not drives(f'<!-- <gazebo>{base}</gazebo> -->').is_any
    block = '<ros2_control name="s" type="system"><joint name="j">{}</joint></ros2_control>'
    state = drives(block.format('<state_interface name="position"/>'))
    assert (state.is_controlled, state.is_any) == (True, False)
    assert drives(block.format('<command_interface name="position"/>')).has_commands
    bridge = '<plugin name="c" filename="libgazebo_ros2_control.so"/>'
    assert not drives(f'<gazebo>{bridge}</gazebo>').plugins


def test_plugins_that_move_joints_are_not_told_to_drive():
    systems = 'JointTrajectoryController', 'JointPositionController', 'JointController'
    plugins = ''.join(f'<plugin filename="x" name="gz::sim::systems::{s}"/>' for s in systems)
    classic = '<plugin name="poses" filename="libgazebo_ros_joint_pose_trajectory.so"/>'
    inside = f'<link name="a"/><gazebo>{plugins}{classic}</gazebo>'
    found = declared_drives(f'<robot name="x">{inside}</robot>')
    names = [f'gz::sim::systems::{each}' for each in systems]
    assert (found.plugins, found.joint_plugins) == ((), (*names, 'poses'))
    assert found.is_any


def test_a_mode_of_the_same_joints_gives_way_and_who_commands_it():
    def listed(name, *interfaces, state='active'):
        return ControllerState(name=name, state=state, required_command_interfaces=[*interfaces])

    every = [
        listed('by_speed', 'elbow/velocity'),
        listed('above', 'by_speed/elbow/velocity'),
        listed('hand', 'finger/position'),
        listed('idle', 'elbow/effort', state='inactive'),
    ]
    assert in_the_way_of({'elbow/position'}, every) == ['by_speed', 'above']
