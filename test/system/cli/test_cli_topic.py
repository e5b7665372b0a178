# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 topic`` beyond the recordings: what goes on, what ends, and who is not reached."""

import re
import signal

from fixtures.cli.commands import ros2, running_node, shell, started
import pytest
from rclpy.topic_endpoint_info import TopicEndpointInfo
from support.running_programs import Program

from amr_description.ros.type_mismatch import mismatches

COMMAND = '/diff_drive_controller/cmd_vel'
STAMPED = 'geometry_msgs/msg/TwistStamped'

# Somebody who shows the commands of a robot.
PAGE = """
import sys
from geometry_msgs.msg import TwistStamped
import rclpy
rclpy.init()
node = rclpy.create_node('page')
node.create_subscription(TwistStamped, sys.argv[1], lambda _: print('heard', flush=True), 1)
print('there', flush=True)
while not node.count_publishers(sys.argv[1]):
    rclpy.spin_once(node, timeout_sec=0.01)
print('found', flush=True)
rclpy.spin(node)
"""


BEST_EFFORT = """
import time
import rclpy
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String
from amr_description.ros.rclpy_internals import take_message
rclpy.init()
node = rclpy.create_node('listener')
heard = lambda message: print('heard', message.data, flush=True)
subscription = node.create_subscription(String, '/words', heard, qos_profile_sensor_data)
print('there', flush=True)
while not subscription.get_publisher_count():
    time.sleep(0.01)
time.sleep(0.3)  # no answer is given meanwhile
print('it came' if take_message(subscription) else 'nothing came before the answer', flush=True)
rclpy.spin(node)
"""


@pytest.fixture(scope='module')
def fixture_node():
    with running_node('fixture_node.py') as node:
        yield node


def test_a_command_reaches_the_controller(fixture_node):
    seen = len(fixture_node.output)
    values = '{header: {frame_id: base_link}, twist: {linear: {x: 0.5}}}'
    assert ros2('topic', 'pub', '--once', COMMAND, STAMPED, values).returncode == 0
    fixture_node.expect("command x=0.5 frame='base_link' stamped=False", seen)


def test_once_reaches_all_who_are_there_not_only_the_first_that_is_found(fixture_node):
    seen = len(fixture_node.output)
    with Program.of(PAGE, COMMAND) as page:
        page.expect('there')
        fixture_node.signal(signal.SIGSTOP)
        try:
            publishing = started(
                'topic', 'pub', '--once', COMMAND, STAMPED, '{header: {frame_id: a}}'
            )
            with publishing as program:
                page.expect('found')
                fixture_node.signal(signal.SIGCONT)
                fixture_node.expect("command x=0.0 frame='a' stamped=False", seen)
                page.expect('heard')
                assert program.end() == 0
        finally:
            fixture_node.signal(signal.SIGCONT)


def test_once_waits_until_who_listens_by_best_effort_has_answered():
    """Until then that one may not know the publisher, and what comes is lost."""
    with Program.of(BEST_EFFORT) as listener:
        listener.expect('there')
        with started('topic', 'pub', '--once', '/words', 'std_msgs/msg/String', 'data: a'):
            listener.expect('nothing came before the answer')
            listener.expect('heard a')


def test_auto_stamps_every_message(fixture_node):
    seen = len(fixture_node.output)
    result = ros2(
        'topic', 'pub', '-t', '3', '-r', '50', COMMAND, STAMPED, '{header: auto}', '-p', '3'
    )
    assert result.returncode == 0
    assert result.stdout.count('publishing #') == 1
    fixture_node.expect(r"(command x=0.0 frame='' stamped=True\s+){3}", seen)


def test_a_topic_of_that_last_word_is_named(fixture_node):
    there = f'{COMMAND} ({STAMPED})'
    with started('topic', 'pub', '--once', '/cmd_vel', STAMPED) as program:
        program.expect(
            re.escape(f'WARNING: nobody subscribes to /cmd_vel; somebody does to {there}\n')
        )
    result = ros2('topic', 'echo', '/robot1/odom')
    assert result.stderr == (
        'Could not determine the type for the passed topic; there is /odom '
        '(nav_msgs/msg/Odometry)\n'
    )


def test_a_topic_of_a_similar_name_is_named(fixture_node):
    assert ros2('topic', 'echo', '/odm').stderr == (
        'Could not determine the type for the passed topic; did you mean /odom?\n'
    )


def test_a_publisher_of_another_type_is_told(fixture_node):
    twist = 'geometry_msgs/msg/Twist'
    with started('topic', 'pub', '--once', COMMAND, twist, '{linear: {x: 1}}') as program:
        program.expect(
            f'WARNING: you publish {twist} on {COMMAND}, but /fixture expects {STAMPED} there: '
            f'nothing will arrive; use {STAMPED}'
        )
        assert program.end(signal.SIGINT) == 2
        assert program.output.count('WARNING') == 1


def test_a_listener_of_another_type_is_told(fixture_node):
    result = ros2('topic', 'echo', '/chatter', 'std_msgs/msg/Int32', '--timeout', '0.1')
    assert (result.returncode, result.stdout) == (0, '')
    assert 'but /fixture publishes std_msgs/msg/String there' in result.stderr


def test_each_node_of_another_type_is_named_once():
    def endpoint(node, topic_type, namespace='/'):
        return TopicEndpointInfo(node_name=node, node_namespace=namespace, topic_type=topic_type)

    ends = [
        endpoint('b', 'p/msg/Other'),
        endpoint('b', 'p/msg/Other'),
        endpoint('a', 'p/msg/Other', '/left'),
        endpoint('c', 'p/msg/Ours'),
    ]
    lines = mismatches('p/msg/Ours', '/t', ends, publishing=True)
    assert [line.partition(' expects')[0].rpartition(' ')[2] for line in lines] == [
        '/b',
        '/left/a',
    ]
    assert mismatches('p/msg/Ours', '/t', ends[3:], publishing=False) == []


@pytest.mark.parametrize(
    ('words', 'usual'),
    [
        (('echo', '/chatter'), 'data: .*|---'),
        (('hz', '/chatter'), r'average rate: .*|\s+min: .*'),
        (('pub', '-r', '20', '/elsewhere', 'std_msgs/msg/String'), 'publishing #.*|'),
        (('pub', '--once', '/elsewhere', 'std_msgs/msg/String'), ''),
    ],
    ids=['echo', 'hz', 'pub', 'pub --once'],
)
def test_ctrl_c_ends_without_a_word(fixture_node, words, usual):
    with started('topic', *words, terminal=True) as program:
        program.expect('Hello World|average rate|publishing #3|Waiting for at least 1')
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert 'Traceback' not in program.output
        # The terminal shows ^C at once, also between the lines of one message.
        rest = program.output.partition('^C')[2].strip()
        assert [line for line in rest.splitlines() if not re.fullmatch(usual, line.rstrip())] == []


def test_sigterm_ends_without_a_word(fixture_node):
    with started('topic', 'echo', '/chatter') as program:
        program.expect('Hello World')
        assert program.end(signal.SIGTERM) == signal.SIGTERM
        assert 'Traceback' not in program.output


def test_a_pipe_shows_lines_at_once_and_may_be_closed(fixture_node, tmp_path):
    line = 'ros2 topic echo /chatter | head -1; echo ${PIPESTATUS[0]}'
    result = shell(line, tmp_path)
    first, status = result.stdout.splitlines()
    assert first.startswith('data: ')
    assert (int(status), result.stderr) == (128 + signal.SIGPIPE, '')


def test_a_topic_that_comes_later_is_heard_if_its_type_is_given():
    # Not --once: who publishes may see the listener before it is seen, and be gone too soon.
    publish = ('topic', 'pub', '-r', '20', '/late', 'std_msgs/msg/String', 'data: at last')
    with (
        started('topic', 'echo', '--once', '/late', 'std_msgs/msg/String') as listener,
        started(*publish),
    ):
        listener.expect('data: at last')
        assert listener.end() == 0


def test_hz_waits_for_the_topic_and_measures(fixture_node):
    with started('topic', 'hz', '/soon') as program:
        program.expect(r'WARNING: topic \[/soon\] does not appear to be published yet')
        with started('topic', 'pub', '-r', '20', '/soon', 'std_msgs/msg/String'):
            rate = program.expect(r'average rate: ([\d.]+)\n\tmin: [\d.]+s max: [\d.]+s std dev')
            assert float(rate[1]) == pytest.approx(20.0, rel=0.5)
        assert program.end(signal.SIGINT) == 2
