# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ekf_node`` over DDS, by a clock that the test drives: topics, frames, services, words."""

import math

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import (
    AccelWithCovarianceStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    TwistStamped,
)
from nav_msgs.msg import Odometry
import pytest
from rcl_interfaces.msg import Log
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from robot_localization.srv import SetPose, ToggleFilterProcessing
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu
from std_srvs.srv import Empty
from support.running_programs import PATIENCE
from tf2_msgs.msg import TFMessage
import yaml

from amr_description.clock import NANOSECONDS
from amr_description.errors import ParameterError
from amr_description.model.frames import quaternion_from_rpy
from amr_description.navigation.ros.ekf_node import EkfNode
from amr_description.ros.messages import fill_stamp, nanoseconds
from amr_description.ros.runtime import argument_errors

KEPT = QoSProfile(depth=1000)
LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
WHEELS = [False] * 6 + [True, True, False, False, False, True, False, False, False]
GYRO = [False] * 11 + [True, False, False, False]
POSE = [True, True, False, False, False, True] + [False] * 9
TICK = 10_000_000
"""ns by which the clock goes on while something is waited for."""
SETTINGS = {'frequency': 50.0, 'sensor_timeout': 1000.0, 'use_sim_time': True}


class Graph:
    """A filter, and a node that talks with it."""

    def __init__(self, executor, tester, node):
        self.node, self.tester, self._executor = node, tester, executor
        self.time = 0
        self._clock = tester.create_publisher(Clock, '/clock', KEPT)
        self._publishers = {}
        self.log = []
        tester.create_subscription(Log, '/rosout', self.log.append, LATCHED)
        self.odometry = self.hear(Odometry, 'odometry/filtered')
        self.transforms = self.hear(TFMessage, '/tf')

    def hear(self, kind, topic):
        """Return a list that gets the messages of a topic."""
        found = []
        self.tester.create_subscription(kind, topic, found.append, KEPT)
        return found

    def until(self, condition, what):
        """Let time pass until a condition holds."""
        wall = self.tester.get_clock()
        end = wall.now().nanoseconds + PATIENCE * NANOSECONDS
        while not condition():
            assert wall.now().nanoseconds < end, f'{what}; log: {self.words}'
            self.time += TICK
            message = Clock()
            fill_stamp(self.time, message.clock)
            self._clock.publish(message)
            self._executor.spin_once(timeout_sec=0.05)

    def send(self, topic, message, seconds=0.0, qos=KEPT):
        """Publish a message; its stamp is ``seconds``."""
        if isinstance(message, TFMessage):
            for each in message.transforms:
                fill_stamp(round(seconds * NANOSECONDS), each.header.stamp)
        else:
            fill_stamp(round(seconds * NANOSECONDS), message.header.stamp)
        if topic not in self._publishers:
            self._publishers[topic] = self.tester.create_publisher(type(message), topic, qos)
            each = self._publishers[topic]
            self.until(lambda: each.get_subscription_count() > 0, f'nobody hears {topic}')
        self._publishers[topic].publish(message)

    def filtered(self, seconds):
        """Wait for the odometry of an instant."""
        stamp = round(seconds * NANOSECONDS)

        def found():
            return [each for each in self.odometry if nanoseconds(each.header.stamp) == stamp]

        self.until(found, f'no odometry of {seconds} s')
        return found()[-1]

    def ask(self, kind, service, request):
        """Return the answer of a service."""
        client = self.tester.create_client(kind, service)
        self.until(client.service_is_ready, f'no service {service}')
        future = client.call_async(request)
        self.until(future.done, f'no answer of {service}')
        return future.result()

    def said(self, text):
        """Wait until the filter has logged a text."""
        self.until(lambda: any(text in words for words in self.words), f'not said: {text}')

    @property
    def words(self):
        """What the filter has logged."""
        return [each.msg for each in self.log if each.name == 'ekf_filter_node']


@pytest.fixture
def filter_with(tmp_path):
    """Return a function that starts a filter with some parameters."""
    made = []

    def start(**parameters):
        path = tmp_path / 'ekf.yaml'
        path.write_text(yaml.safe_dump({'/**': {'ros__parameters': SETTINGS | parameters}}))
        rclpy.init(args=['--ros-args', '--params-file', str(path)])
        executor = SingleThreadedExecutor()
        tester = Node('tester', use_global_arguments=False)
        made.extend((executor, tester))
        graph = Graph(executor, tester, EkfNode())
        made.append(graph.node)
        executor.add_node(tester)
        executor.add_node(graph.node)
        return graph

    yield start
    for each in reversed(made[1:]):
        each.destroy_node()
    if made:
        made[0].shutdown()
    rclpy.try_shutdown()


def odometry(vx=0.0, vyaw=0.0, x=0.0, yaw=0.0, child='base_link'):
    message = Odometry(child_frame_id=child)
    message.header.frame_id = 'odom'
    message.pose.pose.position.x = x
    message.pose.pose.orientation.z = math.sin(yaw / 2)
    message.pose.pose.orientation.w = math.cos(yaw / 2)
    message.twist.twist.linear.x, message.twist.twist.angular.z = vx, vyaw
    for index in range(0, 36, 7):
        message.pose.covariance[index] = message.twist.covariance[index] = 1e-4
    return message


def transform(parent, child, x=0.0, rpy=(0.0, 0.0, 0.0)):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.transform.translation.x = x
    turn = message.transform.rotation
    turn.x, turn.y, turn.z, turn.w = quaternion_from_rpy(*rpy)
    return TFMessage(transforms=[message])


def yaw_of(message):
    turn = message.pose.pose.orientation
    return 2 * math.atan2(turn.z, turn.w)


def edges(graph):
    return {
        (each.header.frame_id, each.child_frame_id)
        for message in graph.transforms
        for each in message.transforms
    }


def test_wheels_become_an_odometry_and_a_transform(filter_with):
    graph = filter_with(
        odom0='wheels/odom', odom0_config=WHEELS, two_d_mode=True, base_link_frame='base_footprint'
    )
    graph.send('wheels/odom', odometry(vx=0.5, child='base_footprint'), 1.0)
    graph.filtered(1.0)
    graph.send('wheels/odom', odometry(vx=0.5, child='base_footprint'), 3.0)
    found = graph.filtered(3.0)
    assert (found.header.frame_id, found.child_frame_id) == ('odom', 'base_footprint')
    assert found.pose.pose.position.x == pytest.approx(1.0, abs=1e-6)
    assert found.twist.twist.linear.x == pytest.approx(0.5, abs=1e-6)
    assert found.pose.covariance[0] > 0.0
    graph.until(lambda: len(graph.transforms) >= len(graph.odometry), 'no transform')
    assert edges(graph) == {('odom', 'base_footprint')}
    last = graph.transforms[-1].transforms[0]
    assert last.header.stamp == found.header.stamp
    assert last.transform.translation.x == found.pose.pose.position.x
    assert not graph.words


def test_an_imu_on_its_side_turns_the_robot_by_its_pitch_rate(filter_with):
    vpitch = [False] * 10 + [True] + [False] * 4
    graph = filter_with(
        odom0='odom', odom0_config=WHEELS[:11] + [False] * 4, imu0='imu', imu0_config=vpitch,
        two_d_mode=True, transform_timeout=PATIENCE,
    )  # fmt: skip
    mounted = transform('base_link', 'imu', rpy=(math.pi / 2, 0.0, 0.0))
    graph.send('/tf_static', mounted, qos=LATCHED)
    imu = Imu()
    imu.header.frame_id, imu.angular_velocity.y = 'imu', 0.25
    imu.angular_velocity_covariance = [1e-4, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0, 1e-4]
    graph.send('imu', imu, 1.0)
    graph.filtered(1.0)
    graph.send('imu', imu, 2.0)
    found = graph.filtered(2.0)
    assert yaw_of(found) == pytest.approx(0.25, abs=1e-6)
    assert found.twist.twist.angular.y == 0.0


def test_a_filter_in_map_publishes_where_odom_is(filter_with):
    graph = filter_with(pose0='pose', pose0_config=POSE, world_frame='map', two_d_mode=True)
    graph.send('/tf', transform('odom', 'base_link', x=1.0, rpy=(0.0, 0.0, 0.5)), 1.0)
    graph.until(lambda: graph.transforms, 'no odometry')
    pose = PoseWithCovarianceStamped()
    pose.header.frame_id = 'map'
    pose.pose.pose.position.x = 3.0
    half = 0.25
    pose.pose.pose.orientation.z, pose.pose.pose.orientation.w = math.sin(half), math.cos(half)
    pose.pose.covariance = odometry().pose.covariance
    graph.send('pose', pose, 1.0)
    graph.filtered(1.0)
    graph.until(lambda: ('map', 'odom') in edges(graph), 'no map')
    assert ('map', 'base_link') not in edges(graph)
    found = next(
        each.transform
        for message in graph.transforms
        for each in message.transforms
        if each.child_frame_id == 'odom'
    )
    assert found.translation.x == pytest.approx(2.0)
    assert found.rotation.z == pytest.approx(0.0, abs=1e-12)


def test_services(filter_with):
    graph = filter_with(odom0='odom', odom0_config=WHEELS, disabled_at_startup=True)
    graph.said('Filter is disabled. To enable it call the /enable service')
    graph.ask(Empty, 'enable', Empty.Request())
    graph.send('odom', odometry(vx=1.0), 10.0)
    assert graph.filtered(10.0).pose.pose.position.x == 0.0
    pose = PoseWithCovarianceStamped()
    pose.header.frame_id = 'odom'
    pose.pose.pose.position.x = 4.0
    pose.pose.pose.orientation.w = 1.0
    graph.send('set_pose', pose, 10.0)
    graph.send('odom', odometry(vx=1.0), 15.0)
    graph.until(lambda: graph.odometry[-1].pose.pose.position.x == 4.0, 'not set')
    assert graph.odometry[-1].twist.twist.linear.x == 0.0
    moved = SetPose.Request(pose=pose)
    moved.pose.pose.pose.position.x = 5.0
    graph.ask(SetPose, 'set_pose', moved)
    graph.until(lambda: graph.odometry[-1].pose.pose.position.x == 5.0, 'not set')
    graph.ask(Empty, 'reset', Empty.Request())
    count = len(graph.odometry)
    graph.send('odom', odometry(vx=2.0), 20.0)
    found = graph.filtered(20.0)
    # Anew: the first measurement is taken as it is.
    assert found.twist.twist.linear.x == 2.0
    assert len(graph.odometry) > count


def test_measurements_are_dropped_while_it_is_toggled_off(filter_with):
    graph = filter_with(odom0='odom', odom0_config=WHEELS)
    graph.send('odom', odometry(vx=1.0), 1.0)
    graph.filtered(1.0)
    off, on = (ToggleFilterProcessing.Request(on=each) for each in (False, True))
    answers = [graph.ask(ToggleFilterProcessing, 'toggle', each).status for each in (off, off)]
    assert answers == [True, False]
    graph.said('Service was called to toggle filter processing off, but it is off already')
    graph.send('odom', odometry(vx=3.0), 2.0)
    since = graph.time
    graph.until(lambda: graph.time > since + NANOSECONDS, 'time')
    assert graph.ask(ToggleFilterProcessing, 'toggle', on).status
    graph.send('odom', odometry(vx=1.0), 3.0)
    found = graph.filtered(3.0)
    assert found.twist.twist.linear.x == pytest.approx(1.0)
    assert found.pose.pose.position.x < 1.5, 'it is where it was'
    assert all(each.twist.twist.linear.x < 2.0 for each in graph.odometry)


@pytest.mark.parametrize(
    ('frame', 'x', 'reason'),
    [
        ('moon', 0.0, "there is no transform from 'moon' to 'odom'"),
        ('odom', math.nan, 'its position or its covariance is no number, or too large'),
        ('odom', 1e300, 'its position or its covariance is no number, or too large'),
    ],
)
def test_a_pose_that_cannot_be_set_changes_nothing(filter_with, frame, x, reason):
    graph = filter_with(odom0='odom', odom0_config=WHEELS)
    graph.send('odom', odometry(vx=1.0), 1.0)
    graph.filtered(1.0)
    pose = PoseWithCovarianceStamped()
    pose.header.frame_id = frame
    pose.pose.pose.position.x = x
    graph.send('set_pose', pose)
    graph.said(f'set_pose: {reason}: the pose stays as it is')
    graph.send('odom', odometry(vx=1.0), 2.0)
    assert graph.filtered(2.0).pose.pose.position.x == pytest.approx(1.0, abs=1e-6)


def jumped_back(graph):
    """Drive, reset the simulation, drive; return what was published since."""
    graph.send('odom', odometry(vx=1.0), 1.0)
    graph.filtered(1.0)
    graph.until(lambda: graph.time > 20 * NANOSECONDS, 'time')
    graph.odometry.clear()
    graph.time = -TICK  # so that it goes on from 0, as a simulation does
    graph.said('Time jumped back')
    graph.send('odom', odometry(vx=0.3), 0.5)


def test_a_simulation_that_is_reset_begins_anew(filter_with):
    graph = filter_with(odom0='odom', odom0_config=WHEELS, reset_on_time_jump=True)
    jumped_back(graph)
    found = graph.filtered(0.5)
    assert found.twist.twist.linear.x == 0.3
    assert any('the filter begins anew' in words for words in graph.words)


def test_without_that_it_says_what_would_do(filter_with):
    graph = filter_with(odom0='odom', odom0_config=WHEELS)
    jumped_back(graph)
    graph.said("as reset_on_time_jump is false; call the service 'reset', or set it")
    graph.ask(Empty, 'reset', Empty.Request())
    graph.send('odom', odometry(vx=0.3), 0.6)
    assert graph.filtered(0.6).twist.twist.linear.x == 0.3


def test_diagnostics_and_accelerations(filter_with):
    graph = filter_with(
        odom0='odom', odom0_config=WHEELS, imu0='imu', imu0_config=GYRO, two_d_mode=True,
        print_diagnostics=True, publish_acceleration=True,
        **{'diagnostic_updater.period': 0.05},
    )  # fmt: skip
    reports = graph.hear(DiagnosticArray, '/diagnostics')
    accelerations = graph.hear(AccelWithCovarianceStamped, 'accel/filtered')
    message = odometry(vx=1.0)
    message.twist.covariance[0] = 0.0
    graph.send('odom', message, 1.0)
    graph.filtered(1.0)

    def complaints():
        return [
            value
            for report in reports
            for status in report.status
            for value in status.values
            if value.key == 'odom0_twist_covariance'
        ]

    graph.until(complaints, 'no complaint')
    assert complaints()[0].value.startswith(
        'The covariance at position (0), which corresponds to X_VELOCITY variance, was zero.'
    )
    assert [status.name for status in reports[0].status] == [
        'ekf_filter_node: Filter diagnostic updater',
        'ekf_filter_node: odometry/filtered topic status',
    ]
    graph.until(lambda: accelerations, 'no acceleration')
    assert accelerations[0].header.frame_id == 'base_link'


def test_commands_accelerate(filter_with):
    graph = filter_with(
        odom0='odom', odom0_config=WHEELS, use_control=True, stamped_control=True,
        control_timeout=100.0, control_config=[True, False, False, False, False, False],
        acceleration_limits=[1.0] * 6, acceleration_gains=[1.0] * 6,
        predict_to_current_time=True,
    )  # fmt: skip
    command = TwistStamped()
    command.twist.linear.x = 0.5
    graph.send('cmd_vel', command, 1.0)
    graph.send('odom', odometry(vx=0.1), 1.0)
    # Odometry is of the present time, which passes while the publishers are found.
    graph.until(lambda: graph.odometry, 'no odometry')
    graph.until(lambda: graph.odometry[-1].twist.twist.linear.x > 0.3, 'not accelerated')
    command.header.frame_id = 'wheel'
    graph.send('cmd_vel', command, 2.0)
    graph.said("Commanded velocities must be given in the robot's body frame (base_link).")


def test_what_is_of_no_use_is_logged(filter_with):
    graph = filter_with(odom0='odom', odom0_config=WHEELS, odom0_nodelay=False, frequency=50)
    graph.said('odom0_nodelay has no effect: it was for TCP, in ROS 1')
    graph.said('frequency: taken as doubles')
    assert graph.node.get_parameter('frequency').value == 50.0
    assert graph.node.get_parameter('odom0_queue_size').value == 10


def test_a_frame_that_stays_unknown_is_said(filter_with):
    graph = filter_with(odom0='odom', odom0_config=WHEELS)
    for seconds in (1.0, 2.0):
        graph.send('odom', odometry(child='moon'), seconds)
        since = graph.time
        graph.until(lambda since=since: graph.time > since + 8 * NANOSECONDS, 'time')
    graph.said(
        "odom0_twist: there is no transform from 'moon', the frame of its messages, to "
        "'base_link': they are ignored"
    )


def test_what_is_wrong_is_one_line(filter_with):
    said = "'odom0_config' has 14 elements; 15 are expected"
    with pytest.raises(ParameterError, match=said), argument_errors():
        filter_with(odom0='odom', odom0_config=[True] * 14)
