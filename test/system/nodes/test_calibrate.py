# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""calibrate against the running simulator: a robot whose geometry is wrong in its parameters."""

import re
import signal

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
import rclpy
from rclpy.node import Node
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import ResetSimulation, SetSimulationState
from support.ros_processes import ROOT, run, running
from support.running_programs import PATIENCE, Program

from amr_description.clock import NANOSECONDS
from amr_description.controllers.checks.drive_calibration import CalibrationRun, Geometry, Travel
from amr_description.nodes.calibrate import manoeuvres, patch, report
from amr_description.nodes.calibrate.drive import DriveTrack
from amr_description.ros.messages import fill_stamp
from amr_description.ros.service_calls import call, wait_until

# Shorter and wider than the shipped robot; and the parameters believe in larger wheels.
URDF = (
    (ROOT / 'urdf' / 'amr.urdf')
    .read_text(encoding='utf-8')
    .replace('xyz="0.2 0.15 0"', 'xyz="0.16 0.2 0"')
    .replace('xyz="0.2 -0.15 0"', 'xyz="0.16 -0.2 0"')
    .replace('xyz="-0.2 0.15 0"', 'xyz="-0.16 0.2 0"')
    .replace('xyz="-0.2 -0.15 0"', 'xyz="-0.16 -0.2 0"')
)
THEORY = 1.0 + (0.32 / 0.4) ** 2
"""The separation multiplier of Coulomb's law: 1 + (L / W)²."""
YAML = """
controller_manager:
  ros__parameters:
    update_rate: 100
    drive: {type: diff_drive_controller/DiffDriveController}
drive:
  ros__parameters:
    left_wheel_names: [joint_wheel_front_left, joint_wheel_back_left]
    right_wheel_names: [joint_wheel_front_right, joint_wheel_back_right]
    wheel_separation: 0.4
    wheel_radius: 0.105
    base_frame_id: base_footprint
    cmd_vel_timeout: 0.0  # on a busy machine commands come late
"""
BRISK = ('--linear', '0.4', '--angular', '2.0', '--distance', '0.4')
# name, true and its unit, before, its error in %, after, its error in %
ROW = re.compile(r'^(.+?) +([+-]\S+) (deg|m) +(\S+) \S+ +(\S+)% +(\S+) \S+ +(\S+)%$', re.MULTILINE)


@pytest.fixture(scope='module')
def robot(tmp_path_factory):
    """A fast simulator, with the robot and its controller ``/one/drive``."""
    path = tmp_path_factory.mktemp('calibrate') / 'controllers.yaml'
    path.write_text(
        YAML.replace('\ncontroller_manager:', '\n/one/controller_manager:').replace(
            '\ndrive:', '\n/one/drive:'
        )
    )
    options = f'-p real_time_factor:=5.0 -p controllers:={path}'.split()
    with running('mujoco_sim', '--ros-args', *options, until='waiting for robots'):
        assert run('create', '-string', URDF, '--ros-args', '-r', '__ns:=/one').returncode == 0
        assert run('spawner', 'drive', '-c', '/one/controller_manager').returncode == 0
        yield


def calibrate(*options):
    return Program.module('calibrate', *options)


def errors(output):
    """Those of the turns, before and after, in %."""
    rows = [row for row in ROW.findall(output) if row[2] == 'deg']
    assert len(rows) == 4, output
    return [float(row[4]) for row in rows], [float(row[6]) for row in rows]


@pytest.mark.long
def test_a_robot_with_another_wheelbase_turns_as_odometry_says_afterwards(robot, tmp_path):
    with calibrate('--controller', '/one/drive', *BRISK) as program:
        assert program.end() == 0, program.output
        before, after = errors(program.output)
        yaml = program.output[program.output.index('/one/drive:') :]
    assert min(before) > 40.0
    assert max(after) < 2.0
    found = {name: float(value) for name, value in re.findall(r'(\w+): ([\d.]+)', yaml)}
    assert found == {
        'wheel_separation_multiplier': pytest.approx(THEORY, rel=0.03),
        'left_wheel_radius_multiplier': pytest.approx(0.1 / 0.105, rel=2e-3),
        'right_wheel_radius_multiplier': pytest.approx(0.1 / 0.105, rel=2e-3),
    }
    # What it printed, taken over as it is, and the robot driven anew.
    path = tmp_path / 'patch.yaml'
    path.write_text(yaml)
    manager = ('-c', '/one/controller_manager')
    assert run('unspawner', 'drive', *manager).returncode == 0
    assert run('spawner', 'drive', *manager, '-p', str(path)).returncode == 0
    with calibrate(*BRISK, '--controller', 'drive', '--ros-args', '-r', '__ns:=/one') as program:
        assert program.end() == 0, program.output
        before, _ = errors(program.output)
    assert max(before) < 2.0


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('test_calibrate')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def commands(node):
    """The twists that the controller is sent."""
    heard = []
    topic = '/one/drive/cmd_vel'
    node.create_subscription(TwistStamped, topic, lambda it: heard.append(it.twist), 1000)
    return heard


def wait_for_speed(node, commands, speed):
    def is_last():
        return bool(commands) and commands[-1].linear.x == speed or None

    assert wait_until(node, is_last, timeout=PATIENCE)


def test_ctrl_c_stops_the_robot(robot, node, commands):
    with calibrate('--controller', '/one/drive', '--linear', '0.1') as program:
        wait_for_speed(node, commands, 0.1)
        program.signal(signal.SIGINT)
        assert program.end() == 128 + signal.SIGINT
        assert 'Traceback' not in program.output
    wait_for_speed(node, commands, 0.0)


def set_state(node, state):
    request = SetSimulationState.Request(state=SimulationState(state=state))
    service = '/mujoco_sim/set_simulation_state'
    response = call(node, SetSimulationState, service, request, timeout=PATIENCE)
    assert response.result.result == Result.RESULT_OK


def test_a_simulation_that_is_paused_or_reset_meanwhile_is_told(robot, node, commands):
    slowly = ('--controller', '/one/drive', '--linear', '0.1', '--timeout', '4')
    with calibrate(*slowly) as program:
        wait_for_speed(node, commands, 0.1)
        set_state(node, SimulationState.STATE_PAUSED)
        assert program.end() == 1
        assert 'the truth has stood still for 4 s: is the simulation paused' in program.output
    set_state(node, SimulationState.STATE_PLAYING)
    wait_for_speed(node, commands, 0.0)  # its last word
    with calibrate(*slowly) as program:
        wait_for_speed(node, commands, 0.1)
        service = '/mujoco_sim/reset_simulation'
        request = ResetSimulation.Request(scope=ResetSimulation.Request.SCOPE_TIME)
        response = call(node, ResetSimulation, service, request, timeout=PATIENCE)
        assert response.result.result == Result.RESULT_OK, response.result.error_message
        assert program.end() == 1
        assert 'simulated time went back: the simulation was reset' in program.output
    wait_for_speed(node, commands, 0.0)


def test_what_is_missing_is_told_in_one_line(robot):
    for name, timeout, line in (
        ('/two/drive', 1, "there is no controller '/two/drive' after 1 s: is the robot up"),
        ('/one/controller_manager', 10, "'/one/controller_manager' is no differential drive"),
    ):
        ended = run('calibrate', '--controller', name, '--timeout', str(timeout))
        assert ended.returncode == 1
        (said,) = ended.stderr.splitlines()
        assert line in said


@pytest.mark.parametrize('option', ['--linear', '--angular', '--distance', '--timeout'])
@pytest.mark.parametrize('value', ['0', '-1', 'nan', 'inf', 'fast'])
def test_options_must_be_positive_numbers(option, value):
    from amr_description.nodes.calibrate import parser

    with pytest.raises(SystemExit, match='2'):
        parser().parse_args([f'{option}={value}'])


@pytest.mark.parametrize('gap, is_lost', [(1.0, False), (2.0, True)])
def test_messages_that_leave_room_for_a_missed_turn_are_not_trusted(gap, is_lost):
    track = DriveTrack()
    message = Odometry()
    track.add(message)
    track.restart()
    message.twist.twist.angular.z = 1.2
    for count in range(1, 4):
        fill_stamp(round(count * gap * NANOSECONDS), message.header.stamp)
        track.add(message)
    assert (track.has_gap, track.has_jumped) == (is_lost, False)
    fill_stamp(0, message.header.stamp)
    track.add(message)
    assert track.has_jumped


def test_every_manoeuvre_has_its_counterpart_and_a_limit():
    found = manoeuvres(0.4, 0.8, 1.5)
    assert sum(each.angular for each in found) == 0.0
    assert sum(each.linear for each in found if not each.angular) == 0.0
    for each in found:
        assert 5.0 < each.time_limit < 60.0
        assert not each.is_done(Travel(0.0, 0.0))
        assert each.is_done(Travel(-1.5, 0.0)) == (each.angular == 0.0)
        assert each.is_done(Travel(0.0, 7.0)) == (each.angular != 0.0)


def test_the_report_tells_turns_in_degrees_and_the_patch_is_yaml_of_the_node():
    geometry, better = Geometry(0.3, 2.0), Geometry(0.3, 2.5)
    runs = [
        CalibrationRun('straight', 1.0, 1.0, Travel(1.0, 0.0)),
        CalibrationRun('spin', -0.3, 0.3, Travel(0.0, 0.8)),
    ]
    lines = report(runs, geometry, better).splitlines()
    assert lines[1].split() == ['straight', '+1.0000', 'm'] + 2 * ['+1.0000', 'm', '0.0%']
    assert lines[2].split() == [
        'spin', '+45.8', 'deg', '+57.3', 'deg', '25.0%', '+45.8', 'deg', '0.0%',
    ]  # fmt: skip
    assert patch('/drive', better).startswith('drive:\n  ros__parameters:\n    wheel_sep')
    assert patch('/one/drive', better).startswith('/one/drive:\n')
