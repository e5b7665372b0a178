# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The private members of rclpy that are used, each by what it is used for.

All is written for rclpy 7.1.6: a failure here, after an update, is of another rclpy.
"""

from action_msgs.msg import GoalStatus
from control_msgs.action import GripperCommand
import pytest
import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.action.server import GoalEvent
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from rclpy.task import Future
from rclpy.time import ClockType, Time
from std_msgs.msg import String
from support.ros_processes import PATIENCE

from amr_description.ros import rclpy_internals
from amr_description.ros.service_calls import wait_until

BROKEN = 'written for rclpy 7.1.6, and this is another'


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('guest', parameter_overrides=[Parameter('use_sim_time', value=True)])
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.mark.parametrize('name', rclpy_internals.__all__)
def test_every_name_is_there(name):
    assert hasattr(rclpy_internals, name), BROKEN


@pytest.mark.parametrize(
    'name', [each for each in rclpy_internals.__all__ if each.endswith('Error')]
)
def test_errors_are_exceptions(name):
    assert issubclass(getattr(rclpy_internals, name), Exception), BROKEN


def test_a_clock_that_is_shared_does_not_follow_the_topic(node):
    clock = rclpy_internals.manual_clock()
    rclpy_internals.share_clock(node, clock)
    assert node.count_subscribers('/clock') == 0, BROKEN
    clock.set_ros_time_override(Time(nanoseconds=7, clock_type=ClockType.ROS_TIME))
    assert node.get_clock().now().nanoseconds == 7, BROKEN
    assert node.get_parameter('use_sim_time').value is True


def test_a_node_may_leave_a_shared_clock_and_come_back(node):
    clock = rclpy_internals.manual_clock()
    rclpy_internals.share_clock(node, clock)
    node.set_parameters([Parameter('use_sim_time', value=False)])
    assert node.get_clock().now().nanoseconds > 10**18, BROKEN
    assert clock.now().nanoseconds == 0, BROKEN
    node.set_parameters([Parameter('use_sim_time', value=True)])
    assert node.get_clock() is clock, BROKEN


def test_a_manual_clock_stands_until_it_is_set():
    clock = rclpy_internals.manual_clock()
    assert clock.now().nanoseconds == 0, BROKEN
    clock.set_ros_time_override(Time(nanoseconds=7, clock_type=ClockType.ROS_TIME))
    assert clock.now().nanoseconds == 7, BROKEN


def test_a_plain_node_does_follow_the_topic(node):
    assert wait_until(node, lambda: node.count_subscribers('/clock') or None, timeout=PATIENCE)


def test_overrides_are_those_that_were_given(node):
    assert rclpy_internals.parameter_overrides(node)['use_sim_time'].value is True, BROKEN


def test_parameter_events_go_out_by_the_publisher_that_was_given(node):
    class Recorder:
        def __init__(self):
            self.events = []

        def publish(self, event):
            self.events.append(event)

    recorder = Recorder()
    rclpy_internals.replace_parameter_event_publisher(node, recorder)
    node.declare_parameter('a', 1)
    assert [p.name for event in recorder.events for p in event.new_parameters] == ['a'], BROKEN


def test_coroutines_that_wait_for_ever_can_be_cancelled(node):
    executor = SingleThreadedExecutor()

    async def wait_for_ever():
        await Future()

    task = executor.create_task(wait_for_ever)
    executor.spin_once(timeout_sec=0.1)
    assert not task.done()
    rclpy_internals.cancel_tasks(executor)
    assert task.cancelled(), BROKEN
    executor.shutdown()


@pytest.mark.parametrize('raw', [False, True])
def test_a_message_is_taken_without_an_executor(node, raw):
    subscription = node.create_subscription(String, 'topic', lambda _: None, 1, raw=raw)
    publisher = node.create_publisher(String, 'topic', 1)
    assert rclpy_internals.take_message(subscription) is None, BROKEN
    publisher.publish(String(data='word'))

    for _ in range(round(PATIENCE * 100)):
        taken = rclpy_internals.take_message(subscription)
        if taken is not None:
            break
        publisher.wait_for_all_acked(rclpy.duration.Duration(seconds=0.01))
    assert (b'word' in taken) if raw else (taken.data == 'word'), BROKEN
    node.destroy_subscription(subscription)
    with pytest.raises(InvalidHandle):
        rclpy_internals.take_message(subscription)


def test_bytes_are_published_as_they_are_and_not_once_the_publisher_is_gone(node):
    heard = []
    node.create_subscription(String, 'topic', heard.append, 1)
    publisher = node.create_publisher(String, 'topic', 1)
    wait_until(node, lambda: publisher.get_subscription_count() or None, timeout=PATIENCE)
    publish = rclpy_internals.bytes_publisher(publisher)
    publish(serialize_message(String(data='word')))
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == [String(data='word')], BROKEN
    node.destroy_publisher(publisher)
    with pytest.raises(InvalidHandle):
        publish(b'')


def test_bytes_are_published_without_the_lock(node):
    assert rclpy_internals._publish_serialized_message() is not None, BROKEN
    heard = []
    publisher = node.create_publisher(String, 'words', 10)
    node.create_subscription(String, 'words', heard.append, 10, raw=True)
    publish = rclpy_internals.publisher_without_lock(publisher)
    sent = serialize_message(String(data='ab\0' * 100_000))
    publish(sent)
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == [sent], BROKEN
    node.destroy_publisher(publisher)
    with pytest.raises(InvalidHandle):
        publish(sent)


def test_a_refusal_to_publish_without_the_lock_is_an_exception(node):
    publish = rclpy_internals.publisher_without_lock(node.create_publisher(String, 'words', 10))
    rclpy.shutdown()
    for _ in range(2):  # rcl warns of an error that nobody has taken before the next one
        with pytest.raises(rclpy_internals.RCLError, match='context is invalid'):
            publish(serialize_message(String()))


def test_a_goal_ends_by_itself_and_as_canceled_too(node):
    events, futures = (GoalEvent.SUCCEED, GoalEvent.ABORT, GoalEvent.CANCELED), []
    handles = []
    server = ActionServer(
        node, GripperCommand, 'grip', len, handle_accepted_callback=handles.append
    )
    client = ActionClient(node, GripperCommand, 'grip')
    wait_until(node, lambda: client.server_is_ready() or None, timeout=PATIENCE)
    for event in events:
        sending = client.send_goal_async(GripperCommand.Goal())
        accepted = wait_until(node, sending.result, timeout=PATIENCE)
        rclpy_internals.begin_goal(handles[-1])
        rclpy_internals.end_goal(server, handles[-1], event, GripperCommand.Result())
        futures.append(accepted.get_result_async())
        wait_until(node, futures[-1].result, timeout=PATIENCE)
    assert [each.result().status for each in futures] == [
        GoalStatus.STATUS_SUCCEEDED,
        GoalStatus.STATUS_ABORTED,
        GoalStatus.STATUS_CANCELED,
    ], BROKEN
    client.destroy()
    server.destroy()
