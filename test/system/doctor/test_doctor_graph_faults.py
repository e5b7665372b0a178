# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Faults made on a running robot: each is the first finding, and what its fix says mends it.

One simulator with one robot serves the whole file. What is wrong is a node of this process, in a
context of its own, or a parameter.
"""

import math
import os
import signal
import subprocess

from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
import pytest
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import SetSimulationState
from std_msgs.msg import Bool, String
from support.contract_graph import MS
from support.doctor_bench import ALL, every, FACTOR, GRAPH, robot_bench, typed
from support.preloaded import Popen
from support.ros_processes import command, environment, PATIENCE

from amr_description.clock import NANOSECONDS
from amr_description.doctor.ros import clock as clock_probe, commands as command_probe
from amr_description.doctor.ros.clock import ClockProbe
from amr_description.ros.messages import fill_stamp
from amr_description.ros.service_calls import call

DRIVE = '/diff_drive_controller'
COMMANDS = f'{DRIVE}/cmd_vel'
TIME = {**GRAPH, 'clock': ClockProbe}
FAST = 0.02
"""s between two messages of a fault."""
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SECOND, HALF = Duration(seconds=1), Duration(seconds=0.5)


@pytest.fixture(scope='module')
def robot():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(clock_probe, 'LISTEN', 0.3)
        patch.setattr(clock_probe, 'SURE', 0.6)
        patch.setattr(command_probe, 'LISTEN', 1.5)
        patch.setattr(command_probe, 'SHORTEST', 0.3)
        with robot_bench() as made:
            yield made


def test_two_nodes_of_one_name(robot):
    with robot.intruder('mujoco_sim') as node:
        found = robot.first('duplicate_node_names', '2 nodes are named /mujoco_sim', GRAPH)
        assert (
            f'in the processes {os.getpid()} and' in found.what or str(os.getpid()) in found.what
        )
        assert '-r __node:=mujoco_sim_2' in found.fix
        robot.remove(node)
        with robot.intruder('mujoco_sim_2'):
            robot.healed(GRAPH)


def test_a_node_that_is_stopped(robot):
    line = command('static_transform_publisher', '--frame-id', 'a', '--child-frame-id', 'b')
    process = Popen(line, stderr=subprocess.DEVNULL, env=environment(), start_new_session=True)
    try:
        name = 'static_transform_publisher_'
        robot.until(
            lambda _: any(n.startswith(name) for n in robot.doctor.get_node_names()), GRAPH
        )
        process.send_signal(signal.SIGSTOP)
        found = robot.first('frozen_nodes', name, GRAPH)
        assert found.fix == f'kill -CONT {process.pid}'
        subprocess.run(['bash', '-c', found.fix], check=True)
        robot.healed(GRAPH)
    finally:
        process.kill()
        process.wait(PATIENCE)


def test_twist_for_a_controller_that_takes_it_stamped(robot):
    with robot.stranger('teleop') as node:
        node.create_publisher(Twist, COMMANDS, 10)
        found = robot.first('mismatched_types', '/teleop', GRAPH)
        assert found.what == (
            f'/teleop publishes Twist on {COMMANDS}, but /diff_drive_controller subscribes to '
            'TwistStamped'
        )
        assert '-p stamped:=true' in found.fix
    with robot.intruder('teleop') as node:
        node.create_publisher(TwistStamped, COMMANDS, 10)
        robot.healed(GRAPH)


@pytest.mark.long
def test_another_type_of_odometry(robot):
    with robot.stranger('logger') as node:
        node.create_subscription(String, '/odom', lambda _: None, 10)
        found = robot.first('mismatched_types', '/logger subscribes to String', GRAPH)
        assert '/diff_drive_controller publishes Odometry on /odom' in found.what
    with robot.intruder('logger') as node:
        node.create_subscription(Odometry, '/odom', lambda _: None, 10)
        robot.healed(GRAPH)


INCOMPATIBLE = {
    'reliability': (
        {'reliability': ReliabilityPolicy.BEST_EFFORT},
        {'reliability': ReliabilityPolicy.RELIABLE},
    ),
    'durability': (
        {'durability': DurabilityPolicy.VOLATILE},
        {'durability': DurabilityPolicy.TRANSIENT_LOCAL},
    ),
    'deadline': ({'deadline': SECOND}, {'deadline': HALF}),
    'liveliness': (
        {'liveliness': LivelinessPolicy.AUTOMATIC},
        {'liveliness': LivelinessPolicy.MANUAL_BY_TOPIC},
    ),
    'liveliness_lease_duration': (
        {'liveliness_lease_duration': SECOND},
        {'liveliness_lease_duration': HALF},
    ),
}


SHORT = ('reliability',)


@pytest.mark.parametrize(
    'policy',
    [
        each if each in SHORT else pytest.param(each, marks=pytest.mark.long)
        for each in INCOMPATIBLE
    ],
)
def test_qos_that_does_not_match(robot, policy):
    offered, requested = (QoSProfile(depth=1, **each) for each in INCOMPATIBLE[policy])
    with robot.intruder('driver') as driver, robot.intruder('mapper') as mapper:
        driver.create_publisher(LaserScan, '/scan', offered)
        wrong = mapper.create_subscription(LaserScan, '/scan', lambda _: None, requested)
        found = robot.first('incompatible_qos', '/scan, /mapper requests', GRAPH)
        assert found.what.startswith(f'/driver offers {policy} ')
        # With what the fix says.
        mapper.destroy_subscription(wrong)
        mapper.create_subscription(LaserScan, '/scan', lambda _: None, offered)
        robot.healed(GRAPH)


@pytest.mark.parametrize('kind', [pytest.param(TwistStamped, marks=pytest.mark.long), Twist])
def test_commands_beside_the_controller(robot, kind):
    with robot.stranger('navigator') as node:
        node.create_publisher(kind, '/cmd_vel', 10)
        found = robot.first('misnamed_topics', '/navigator publishes /cmd_vel', GRAPH)
        assert f'-r /cmd_vel:={COMMANDS}' in found.fix
        assert ('publish TwistStamped, not Twist' in found.fix) is (kind is Twist)
    with robot.intruder('remapped') as node:
        node.create_publisher(TwistStamped, COMMANDS, 10)
        robot.healed(GRAPH)


def test_a_misspelt_topic(robot):
    with robot.intruder('driver') as driver, robot.intruder('mapper') as mapper:
        driver.create_publisher(LaserScan, '/scan', 10)
        wrong = mapper.create_subscription(LaserScan, '/scna', lambda _: None, 10)
        found = robot.first('misnamed_topics', '/mapper subscribes to /scna', GRAPH)
        assert '-r /scan:=/scna' in found.fix
        mapper.destroy_subscription(wrong)
        mapper.create_subscription(LaserScan, '/scan', lambda _: None, 10)
        robot.healed(GRAPH)


@pytest.mark.long
def test_commands_on_the_topic_of_humble(robot):
    with robot.intruder('teleop') as node:
        node.create_publisher(Twist, f'{COMMANDS}_unstamped', 10)
        found = robot.first('unstamped_commands', '/teleop', GRAPH)
        assert f'-r cmd_vel:={COMMANDS}' in found.fix
    with robot.intruder('teleop_of_jazzy') as node:
        node.create_publisher(TwistStamped, COMMANDS, 10)
        robot.healed(GRAPH)


# --- time -----------------------------------------------------------------------------------


def test_a_second_clock(robot):
    with robot.intruder('bag_player') as node:
        node.create_publisher(Clock, '/clock', 10)
        found = robot.first('two_clocks', '/bag_player', TIME)
        assert '/mujoco_sim' in found.what
    robot.healed(TIME)  # with all but one ended


def test_a_node_on_the_system_clock(robot):
    with robot.intruder('ekf', use_sim_time=False) as node:
        node.create_subscription(Odometry, '/odom', lambda _: None, 10)
        found = robot.first('mixed_use_sim_time', 'use_sim_time is false in /ekf', TIME)
        typed(found.fix)
        robot.healed(TIME)


def test_stamps_of_the_system_clock(robot):
    with robot.intruder('lidar') as node:
        publisher = node.create_publisher(LaserScan, '/scan', 10)
        scan = LaserScan()
        fill_stamp(1_800_000_000_000 * MS, scan.header.stamp)
        timer = every(node, 0.05, publisher, lambda: scan)
        found = robot.first('stamps_of_another_clock', '/lidar stamps /scan', TIME)
        assert 'self.get_clock().now()' in found.fix
        node.destroy_timer(timer)

        def stamped():
            scan.header.stamp = node.get_clock().now().to_msg()
            return scan

        every(node, 0.05, publisher, stamped)
        robot.healed(TIME)


def test_a_simulation_that_is_paused(robot):
    paused = SimulationState(state=SimulationState.STATE_PAUSED)
    request = SetSimulationState.Request(state=paused)
    call(robot.doctor, SetSimulationState, '/mujoco_sim/set_simulation_state', request)
    found = robot.first('standing_clock', '/clock stands still at ', TIME)
    typed(found.fix)
    robot.healed(TIME)


def test_a_simulation_that_is_slower_than_asked(robot):
    robot.set_parameter('/mujoco_sim', 'real_time_factor', 1e6)
    found = robot.first('slow_simulation', ' instead of 1e+06', TIME)
    assert 'ros2 param set /mujoco_sim real_time_factor ' in found.fix
    robot.set_parameter('/mujoco_sim', 'real_time_factor', FACTOR)
    robot.healed(TIME)


# --- commands -------------------------------------------------------------------------------


@pytest.fixture
def sender(robot):
    with robot.intruder('navigator') as node:
        yield node, node.create_publisher(TwistStamped, COMMANDS, 10)


def twist(x=0.3, *, stamp=0):
    message = TwistStamped()
    message.twist.linear.x = x
    fill_stamp(stamp, message.header.stamp)
    return message


def test_stop_is_pressed(robot):
    with robot.intruder('viewer') as node:
        publisher = node.create_publisher(Bool, '/emergency_stop', LATCHED)
        publisher.publish(Bool(data=True))
        robot.first('engaged_stop', '/emergency_stop is true, published by /viewer')
        publisher.publish(Bool(data=False))
        robot.healed()


def test_commands_that_are_no_numbers(robot, sender):
    node, publisher = sender
    timer = every(node, FAST, publisher, lambda: twist(math.nan))
    robot.first('commands_not_finite', 'by /navigator')
    node.destroy_timer(timer)
    every(node, FAST, publisher, lambda: twist(0.0))
    robot.healed()


def test_commands_of_the_system_clock(robot, sender):
    node, publisher = sender
    timer = every(node, FAST, publisher, lambda: twist(stamp=1_800_000_000 * NANOSECONDS))
    assert 'leave the stamp at 0' in robot.first('commands_of_another_clock', '/navigator').fix
    node.destroy_timer(timer)
    every(node, FAST, publisher, twist)
    robot.healed()


def test_commands_that_are_too_old(robot, sender):
    node, publisher = sender

    def stamped(age):
        return twist(stamp=max(1, node.get_clock().now().nanoseconds - age))

    robot.until(lambda _: node.get_clock().now().nanoseconds > 2 * NANOSECONDS)
    timer = every(node, FAST, publisher, lambda: stamped(2 * NANOSECONDS))
    robot.first('commands_too_old', f'{DRIVE} takes none older than 0.5 s')
    node.destroy_timer(timer)
    every(node, FAST, publisher, lambda: stamped(0))
    robot.healed()


def test_two_who_command_one_robot(robot, sender):
    node, publisher = sender
    every(node, FAST, publisher, twist)
    with robot.intruder('teleop') as other:
        second = other.create_publisher(TwistStamped, COMMANDS, 10)
        every(other, FAST, second, lambda: twist(-0.3))
        robot.until(
            lambda found: any(
                '/navigator' in each.what and '/teleop' in each.what for each in found
            )
        )
        found = robot.first('contending_commands', ' at once: ')
        assert f'-r cmd_vel_out:={COMMANDS}' in found.fix
    robot.healed()


def test_commands_that_come_too_seldom(robot, sender):
    node, publisher = sender
    # At this real-time factor half a second is 0.1 s of the controller's time.
    robot.set_parameter(DRIVE, 'cmd_vel_timeout', 0.04)
    try:
        timer = every(node, 0.3, publisher, twist)
        robot.first('commands_too_seldom', f'{DRIVE} brakes 0.04 s after each')
        node.destroy_timer(timer)
        every(node, FAST, publisher, twist)
        robot.healed()
    finally:
        robot.set_parameter(DRIVE, 'cmd_vel_timeout', 0.5)


def test_commands_above_the_limits(robot, sender):
    node, publisher = sender
    robot.set_parameter(DRIVE, 'linear.x.max_velocity', 0.2)
    try:
        timer = every(node, FAST, publisher, twist)
        robot.first('commands_beyond_limits', 'commands linear.x 0.3 m/s')
        node.destroy_timer(timer)
        every(node, FAST, publisher, lambda: twist(0.2))
        robot.healed()
    finally:
        robot.set_parameter(DRIVE, 'linear.x.max_velocity', math.nan)


def test_nothing_else_is_wrong(robot):
    robot.healed(ALL)
