# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The stack ``navigation`` while it runs: the parameter files, and ``check_navigation``, against it.
"""

import json
import math
import signal
from types import SimpleNamespace

from fixtures.bringup.running import Bringup
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid, Odometry
import pytest
from rcl_interfaces.srv import GetParameters
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool, String
from support.paths import ROOT
from support.ros_processes import PATIENCE
from support.running_programs import Program
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener

from amr_description.model.footprint import footprint
from amr_description.model.urdf import parse
from amr_description.navigation.contract.rules import RULES
from amr_description.parameter_files import dotted, flatten, read_parameter_file, sections
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import call, wait_until

FILES = ('nav2_params.yaml', 'mapper_params_online_async.yaml')
NODES = {
    each.pattern: {dotted(keys): value for keys, value in flatten(each.parameters)}
    for file in FILES
    for each in sections(read_parameter_file(ROOT / 'config' / file))
}
FRAMES = (
    'global_frame', 'local_frame', 'robot_base_frame', 'base_frame', 'fixed_frame', 'odom_frame',
    'map_frame', 'base_frame_id', 'odom_frame_id', 'global_frame_id',
)  # fmt: skip
WITHIN_NAV2 = ('local_costmap/', 'global_costmap/', '/local_costmap/', 'collision_monitor_state',
               'cmd_vel_smoothed')  # fmt: skip
"""Topics that nodes of Nav2 publish for each other."""
TYPES = {'scan': 'sensor_msgs/msg/LaserScan', 'odom': 'nav_msgs/msg/Odometry',
         'map': 'nav_msgs/msg/OccupancyGrid'}  # fmt: skip

MACHINE = {'time.real_time_factor', 'tf.at_scans', 'scan.age'}
"""It is what the machine gives."""
LONG = ('--duration', '120')
"""On a busy machine; it ends as soon as all is known."""

TELEOP = ('--ros-args', '-r', 'cmd_vel:=/cmd_vel_teleop')
"""An input of twist_mux on which nobody publishes; on /cmd_vel the navigator does."""


class Operator(Node):
    """Hears what Nav2 and slam_toolbox would, and commands as they do."""

    def __init__(self):
        super().__init__('operator')
        self.heard = {}
        for kind, topic, qos in (
            (LaserScan, 'scan', qos_profile_sensor_data),
            (Odometry, 'odom', 10),
            (Odometry, 'ground_truth/odom', 10),
            (OccupancyGrid, 'map', LATCHED),
            (String, 'robot_description', LATCHED),
        ):
            self.create_subscription(kind, topic, self._take(topic), qos)
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.lock = self.create_publisher(Bool, 'emergency_stop', 10)

    def _take(self, topic):
        return lambda message: self.heard.__setitem__(topic, message)

    def until(self, condition):
        found = wait_until(self, lambda: condition() or None, every=0.05, timeout=PATIENCE)
        assert found, 'waited in vain'
        return found

    def wait_for(self, *topics):
        self.until(lambda: {*topics} <= self.heard.keys())
        return [self.heard[topic] for topic in topics]

    def twist(self, topic='ground_truth/odom'):
        return self.heard[topic].twist.twist

    def drive(self, publisher, twist, condition):
        """Command a twist at 10 Hz or more until a condition holds; then rest."""
        self.until(lambda: condition() or publisher.publish(twist))
        self.until(lambda: self.rests() or publisher.publish(Twist()))

    def rests(self):
        twist = self.twist()
        return abs(twist.linear.x) < 0.01 and abs(twist.angular.z) < 0.02


def twist(x=0.0, yaw=0.0):
    found = Twist()
    found.linear.x, found.angular.z = x, yaw
    return found


@pytest.fixture(scope='module')
def stack(tmp_path_factory):
    """The stack as it is by default, without the page, and one that looks at it."""
    folder = tmp_path_factory.mktemp('stack')
    own = {'AMENT_PREFIX_PATH': str(ROOT / 'install' / 'amr_description')}
    with Bringup(folder, 'navigation', 'viewer:=false', **own) as up:
        up.expect('ready in')
        rclpy.init(args=[])
        operator = Operator()
        operator.set_parameters([rclpy.Parameter('use_sim_time', value=True)])
        [start] = operator.wait_for('ground_truth/odom')
        yield SimpleNamespace(operator=operator, up=up, start=start.pose.pose.position)
        operator.destroy_node()
        rclpy.try_shutdown()
        assert up.end(signal.SIGINT) == 0
        assert up.left() == []
        assert 'process has died' not in up.output


def test_every_frame_of_the_files_is_in_tf(stack):
    wanted = {
        parameters[key] for parameters in NODES.values() for key in FRAMES if key in parameters
    }
    assert wanted == {'map', 'odom', 'base_link', 'base_footprint'}
    [scan, grid] = stack.operator.wait_for('scan', 'map')
    assert grid.header.frame_id == 'map'
    for frame in wanted:
        for other in ('odom', scan.header.frame_id):
            stack.operator.until(
                lambda one=frame, two=other: stack.operator.buffer.can_transform(
                    one, two, rclpy.time.Time()
                )
            )


def test_every_node_of_the_stack_goes_by_the_simulated_time(stack):
    for node in (
        'map_of_world',
        'navigator',
        'robot_state_publisher',
        'truth_localizer',
        'twist_mux',
    ):
        response = call(
            stack.operator,
            GetParameters,
            f'/{node}/get_parameters',
            GetParameters.Request(names=['use_sim_time']),
            timeout=PATIENCE,
        )
        assert [each.bool_value for each in response.values] == [True], node


def test_every_topic_of_the_files_has_a_publisher_of_its_type(stack):
    operator, named = stack.operator, set()
    for node, parameters in NODES.items():
        for key, value in parameters.items():
            is_topic = key.endswith(('_topic', '.topic'))
            if not is_topic or value.startswith(WITHIN_NAV2) or key == 'cmd_vel_out_topic':
                continue
            kind = TYPES[value.strip('/')]
            named.add(value.strip('/'))
            publishers = operator.until(
                lambda name=value: operator.get_publishers_info_by_topic(f'/{name.strip("/")}')
            )
            assert {each.topic_type for each in publishers} == {kind}, f'{node}: {key}'
    assert named == {'scan', 'odom', 'map'}


def test_the_last_node_of_nav2_is_heard_by_the_mux(stack):
    topic = f'/{NODES["/collision_monitor"]["cmd_vel_out_topic"]}'

    def names():
        found = stack.operator.get_subscriptions_info_by_topic(topic)
        return [name for each in found if (name := endpoint_node(each))]

    assert stack.operator.until(names) == ['/twist_mux']


def test_ranges_are_those_of_the_lidar(stack):
    [scan] = stack.operator.wait_for('scan')
    slam, amcl = NODES['/slam_toolbox'], NODES['/amcl']
    assert slam['max_laser_range'] == amcl['laser_max_range'] == scan.range_max
    assert math.isclose(slam['min_laser_range'], scan.range_min, rel_tol=1e-6)
    for costmap in ('/local_costmap/local_costmap', '/global_costmap/global_costmap'):
        for key in ('raytrace_max_range', 'obstacle_max_range'):
            assert NODES[costmap][f'obstacle_layer.scan.{key}'] <= scan.range_max
    local = NODES['/local_costmap/local_costmap']
    corner = math.hypot(local['width'], local['height']) / 2
    assert local['obstacle_layer.scan.raytrace_max_range'] >= corner


def test_the_footprint_is_the_outline_of_the_collisions(stack):
    [description] = stack.operator.wait_for('robot_description')
    found = footprint(parse(description.data), lambda name: None)
    assert found.frame == 'base_link'
    for costmap in ('/local_costmap/local_costmap', '/global_costmap/global_costmap'):
        assert NODES[costmap]['robot_base_frame'] == found.frame
        assert NODES[costmap]['footprint'] == found.text
        assert NODES[costmap]['inflation_layer.inflation_radius'] > found.circumscribed_radius


def test_the_initial_pose_is_where_the_robot_is_in_the_map(stack):
    amcl = NODES['/amcl']
    assert math.hypot(stack.start.x - amcl['initial_pose.x'], stack.start.y) < 0.02
    assert (amcl['initial_pose.y'], amcl['initial_pose.yaw']) == (0.0, 0.0)


def test_the_robot_reaches_the_greatest_speeds(stack):
    """Commanded as Nav2 does, by its topic and the type of its default."""
    operator, smoother = stack.operator, NODES['/velocity_smoother']
    operator.wait_for('ground_truth/odom', 'odom')
    commands = operator.create_publisher(Twist, 'cmd_vel', 10)
    ahead, _, turn = smoother['max_velocity']
    # Forth and back, so that it ends near where it began.
    for speed in (ahead, -ahead):
        operator.drive(
            commands,
            twist(x=speed),
            lambda wanted=speed: operator.twist().linear.x / wanted > 0.97,
        )
    for speed in (turn, -turn):
        operator.drive(
            commands,
            twist(yaw=speed),
            lambda wanted=speed: operator.twist().angular.z / wanted > 0.95,
        )
    operator.destroy_publisher(commands)


def test_a_person_outranks_the_planner_and_stop_outranks_both(stack):
    operator = stack.operator
    operator.wait_for('ground_truth/odom')
    planner = operator.create_publisher(Twist, 'cmd_vel', 10)
    person = operator.create_publisher(Twist, 'cmd_vel_teleop', 10)

    def both(*, is_locked=False):
        # Again and again: the mux takes what it is sent by best effort.
        operator.lock.publish(Bool(data=is_locked))
        planner.publish(twist(x=0.2))
        person.publish(twist(x=-0.2))

    operator.until(lambda: operator.twist().linear.x < -0.15 or both())
    operator.until(lambda: operator.twist().linear.x > 0.15 or planner.publish(twist(x=0.2)))
    operator.until(lambda: operator.rests() or both(is_locked=True))
    operator.until(lambda: operator.twist().linear.x < -0.15 or both())
    operator.until(lambda: operator.rests() or person.publish(Twist()))
    for publisher in (planner, person):
        operator.destroy_publisher(publisher)


def test_a_goal_is_driven_to_by_way_of_the_mux(stack):
    operator = stack.operator
    operator.wait_for('ground_truth/odom')
    goals = operator.create_publisher(PoseStamped, 'goal_pose', 10)
    operator.until(goals.get_subscription_count)
    goal = PoseStamped()
    goal.header.frame_id = 'map'
    goal.pose.position.x, goal.pose.position.y = 1.5, 0.6
    goal.pose.orientation.w = 1.0
    goals.publish(goal)
    stack.up.expect('Goal succeeded')

    def distance():
        position = operator.heard['ground_truth/odom'].pose.pose.position
        return math.hypot(position.x - 1.5, position.y - 0.6)

    operator.until(lambda: distance() < 0.1 and operator.rests())


def check(*options):
    return Program.module('check_navigation', *options)


def report(*options):
    """Its exit code is 0, or 1 as only the machine was too slow."""
    with check('--json', *LONG, *options) as program:
        code = program.end()
        text = program.output
    data = json.loads(text[text.index('{\n') : text.rindex('}') + 1])
    found = {each['name']: each for each in data['findings'] if each['name'] not in MACHINE}
    assert data['holds'] == (code == 0)
    assert len(data['findings']) == len(RULES)
    return found


def by_verdict(found, verdict):
    return {name: each['found'] for name, each in found.items() if each['verdict'] == verdict}


def test_every_demand_holds_for_the_stack_navigation(stack):
    found = report('--drive', *TELEOP)
    assert by_verdict(found, 'failed') == {}
    assert {*by_verdict(found, 'not checked')} == {'slam.max_laser_range', 'costmap.footprint'}
    assert found['cmd_vel.listener']['found'] == '/twist_mux on /cmd_vel_teleop'
    assert 'reach 0.345 m from base_link' in found['costmap.footprint']['found']


def test_all_but_the_command_topic_holds_for_the_robot_itself(stack):
    """Of the simulation alone: its wheels take stamped commands, elsewhere than Nav2 publishes."""
    with check(*LONG, '--ros-args', '-r', 'cmd_vel:=/nowhere') as program:
        assert program.end() == 1
        lines = program.output.split('\n')
    failed = [e for e in lines if e.startswith('FAILED') and e.split()[1] not in MACHINE]
    assert len(failed) == 1, failed
    assert 'nobody subscribes to /nowhere' in failed[0]
    assert '/diff_drive_controller on /diff_drive_controller/cmd_vel' in failed[0]
    (last,) = [e for e in lines if ' demands in ' in e]
    assert last.startswith(f'{len(RULES)} demands in ')


def test_a_namespace_without_a_robot(stack):
    with check('--duration', '1', '--ros-args', '-r', '__ns:=/nobody') as program:
        assert program.end() == 1
        assert 'nobody publishes /nobody/scan' in program.output
        assert 'nothing came on /nobody/odom, /nobody/scan' in program.output


def test_it_does_not_fight_over_the_robot(stack):
    rival = Node('rival')  # it answers no services, as nobody spins it
    rival.create_publisher(Twist, '/cmd_vel_teleop', 1)
    # It does not wait for scans, which never come, to say so.
    with check(*LONG, '--drive', *TELEOP, '-r', 'scan:=/no_scan') as program:
        assert program.end() == 2
        assert 'FATAL' in program.output
        assert '--drive: /rival publishes commands on /cmd_vel_teleop' in program.output
        assert 'passed' not in program.output
    rival.destroy_node()
