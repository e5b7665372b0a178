# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The process twist_mux: types of its topics, locks, diagnostics, faulty files."""

from contextlib import contextmanager

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, TwistStamped
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool
from support.ros_processes import PATIENCE, run, running, wait_for_line

from amr_description.ros.service_calls import wait_until

FILE = """
twist_mux:
  ros__parameters:
    topics:
      navigation: {topic: cmd_vel, timeout: 0.0, priority: 10}
      teleop: {topic: cmd_vel_teleop, timeout: 100.0, priority: 100}
    locks:
      stop: {topic: emergency_stop, timeout: 0.0, priority: 50}
"""


@pytest.fixture
def user():
    """A node of this process; types are a participant's, so it is in another than the mux."""
    rclpy.init(args=[])
    node = Node('user')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def words_for(tmp_path, text=FILE):
    file = tmp_path / 'twist_mux.yaml'
    file.write_text(text, encoding='utf-8')
    return ['--ros-args', '--params-file', str(file)]


@contextmanager
def multiplexing(tmp_path, *words):
    with running(
        'twist_mux', *words_for(tmp_path), *words, until="Topic handler 'locks.stop'"
    ) as mux:
        yield mux


def until(node, condition):
    found = wait_until(node, lambda: condition() or None, every=0.02, timeout=PATIENCE)
    assert found, 'it never came'
    return found


def command(kind, speed):
    message = kind()
    twist = message if kind is Twist else message.twist
    twist.linear.x = speed
    return message


def send_until(node, publisher, message, condition):
    """
    Publish again and again, as an input listens by best effort.

    It also takes up the type of a new publisher only after a moment.
    """
    until(node, lambda: condition() or publisher.publish(message))


@pytest.mark.parametrize('kind', [Twist, TwistStamped])
@pytest.mark.parametrize('output', [Twist, TwistStamped])
def test_inputs_have_the_type_of_their_publishers_and_the_output_its_own(
    tmp_path, user, output, kind
):
    words = ['-p', 'use_stamped:=false'] if output is Twist else []
    with multiplexing(tmp_path, *words):
        heard = []
        user.create_subscription(output, 'cmd_vel_out', heard.append, 10)
        commands = user.create_publisher(kind, 'cmd_vel', 10)
        send_until(user, commands, command(kind, 0.25), lambda: heard)
        twist = heard[0] if output is Twist else heard[0].twist
        assert twist.linear.x == 0.25


def test_an_unstamped_command_gets_the_time_of_its_arrival_and_a_stamped_one_keeps_its_own(
    tmp_path, user
):
    with multiplexing(tmp_path):
        heard = []
        user.create_subscription(TwistStamped, 'cmd_vel_out', heard.append, 10)
        unstamped = user.create_publisher(Twist, 'cmd_vel', 10)
        before = user.get_clock().now()
        send_until(user, unstamped, command(Twist, 0.25), lambda: heard)
        came = rclpy.time.Time.from_msg(heard[0].header.stamp, before.clock_type)
        assert before <= came <= user.get_clock().now()
        stamped = user.create_publisher(TwistStamped, 'cmd_vel_teleop', 10)
        message = command(TwistStamped, 0.5)
        message.header.stamp.sec, message.header.frame_id = 7, 'base_link'
        send_until(user, stamped, message, lambda: heard[-1] == message)


def test_a_publisher_of_the_other_type_may_come_after_the_first_has_gone(tmp_path, user):
    with multiplexing(tmp_path):
        heard = []
        user.create_subscription(TwistStamped, 'cmd_vel_out', heard.append, 10)
        for kind, speed in [(TwistStamped, 1.0), (Twist, 2.0), (TwistStamped, 3.0)]:
            commands = user.create_publisher(kind, 'cmd_vel', 10)
            send_until(
                user,
                commands,
                command(kind, speed),
                lambda speed=speed: heard and heard[-1].twist.linear.x == speed,
            )
            user.destroy_publisher(commands)


def test_both_types_on_one_topic_are_said(tmp_path, user):
    with multiplexing(tmp_path) as mux:
        stamped = user.create_publisher(TwistStamped, 'cmd_vel', 10)
        until(user, stamped.get_subscription_count)
        context = rclpy.Context()
        context.init(args=[])
        planner = Node('planner', context=context)
        planner.create_publisher(Twist, 'cmd_vel', 10)
        line = wait_for_line(mux, 'where')
        assert line.endswith(
            'publishes geometry_msgs/msg/Twist on /cmd_vel, where geometry_msgs/msg/TwistStamped '
            'is published too: only the latter is heard; give each a topic\n'
        )
        planner.destroy_node()
        context.try_shutdown()


def test_who_cannot_hear_the_output_is_said(tmp_path, user):
    with multiplexing(tmp_path) as mux:
        user.create_subscription(Twist, 'cmd_vel_out', lambda _: None, 10)
        line = wait_for_line(mux, 'wants')
        assert line.endswith(
            ' wants geometry_msgs/msg/Twist on /cmd_vel_out, but this publishes '
            'geometry_msgs/msg/TwistStamped: nothing will arrive; use -p use_stamped:=false\n'
        )


def test_a_lock_stops_what_is_below_it_and_diagnostics_say_so(tmp_path, user):
    with multiplexing(tmp_path):
        heard, reports = [], []
        user.create_subscription(TwistStamped, 'cmd_vel_out', heard.append, 10)
        user.create_subscription(DiagnosticArray, '/diagnostics', reports.append, 10)
        lock = user.create_publisher(Bool, 'emergency_stop', 10)
        navigation = user.create_publisher(TwistStamped, 'cmd_vel', 10)
        teleop = user.create_publisher(TwistStamped, 'cmd_vel_teleop', 10)
        until(user, lambda: lock.get_subscription_count())

        def value(key):
            [status] = reports[-1].status
            assert (status.name, status.message, status.hardware_id, status.level) == (
                'twist_mux: Twist mux status', 'ok', 'none', b'\x00',
            )  # fmt: skip
            return {each.key: each.value for each in status.values}[key]

        until(user, lambda: reports and value('current priority') == '0')
        assert value('lock locks.stop').startswith(' free ')
        send_until(user, lock, Bool(data=True), lambda: value('current priority') == '50')
        assert value('lock locks.stop').startswith(' locked ')
        until(user, navigation.get_subscription_count)
        until(user, teleop.get_subscription_count)
        navigation.publish(command(TwistStamped, 1.0))
        send_until(user, teleop, command(TwistStamped, 2.0), lambda: heard)
        assert {each.twist.linear.x for each in heard} == {2.0}


def test_topics_and_their_qos(tmp_path, user):
    with multiplexing(tmp_path, '-r', 'cmd_vel_out:=wheels'):
        [output] = until(user, lambda: user.get_publishers_info_by_topic('/wheels'))
        assert output.topic_type == 'geometry_msgs/msg/TwistStamped'
        assert output.qos_profile.reliability == ReliabilityPolicy.RELIABLE
        for topic in ('/cmd_vel', '/cmd_vel_teleop', '/emergency_stop'):
            [found] = until(user, lambda topic=topic: user.get_subscriptions_info_by_topic(topic))
            lock, velocity = 'std_msgs/msg/Bool', 'geometry_msgs/msg/Twist'
            assert found.topic_type == (lock if topic == '/emergency_stop' else velocity)
        best_effort = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        sensor_like = user.create_publisher(TwistStamped, 'cmd_vel', best_effort)
        until(user, sensor_like.get_subscription_count)


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        (
            FILE.replace('timeout: 0.0, ', '', 1),
            "could not load parameter 'topics.navigation.timeout': each of topics and locks has a "
            'topic, a timeout (s) and a priority (0 to 255)',
        ),
        (
            FILE.replace('topic: cmd_vel,', 'topic: cmd_vel_out,'),
            "parameter 'topics.navigation.topic' is /cmd_vel_out, which is also cmd_vel_out: the "
            'node would hear itself; remap one of them, as -r cmd_vel_out:=/wheels/cmd_vel',
        ),
        (
            FILE.replace('topic: cmd_vel,', 'topic: cmd vel,'),
            "parameter 'topics.navigation.topic' is 'cmd vel': ",
        ),
    ],
)
def test_a_faulty_file_gets_one_line_and_exit_code_1(tmp_path, text, line):
    result = run('twist_mux', *words_for(tmp_path, text))
    [said] = [each for each in result.stderr.splitlines() if 'FATAL' in each]
    assert line in said
    assert 'Traceback' not in result.stderr
    assert result.returncode == 1


def test_a_file_of_ros_1_gets_one_line(tmp_path):
    text = """
twist_mux:
  ros__parameters:
    topics:
    - {name: navigation, topic: cmd_vel, timeout: 0.5, priority: 10}
    - {name: teleop, topic: cmd_vel_teleop, timeout: 0.5, priority: 100}
"""
    result = run('twist_mux', *words_for(tmp_path, text))
    [said] = [each for each in result.stderr.splitlines() if 'FATAL' in each]
    assert 'twist_mux.yaml' in said
    assert 'line_num 5' in said
    assert result.returncode == 1
