# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Services and actions of controllers, over a real rclpy client."""

from collections import Counter

from action_msgs.msg import GoalStatus
from control_msgs.action import GripperCommand
import pytest
from rclpy.action import ActionClient
from rclpy.time import Time
from std_srvs.srv import SetBool
from support.manager_host import ros_in_this_process, running_host
from support.running_programs import PATIENCE

from amr_description.ros.service_calls import call, wait_until

YAML = """
controller_manager:
  ros__parameters:
    update_rate: 100
    counter: {type: support.port_controller/Counter}
"""
FOREVER = 1e9


@pytest.fixture(scope='module')
def shared_host(tmp_path_factory):
    with (
        ros_in_this_process(),
        running_host(tmp_path_factory.mktemp('host'), YAML) as host,
    ):
        yield host


@pytest.fixture
def host(shared_host):
    shared_host.activate('counter')
    yield shared_host
    if shared_host.client.states():
        shared_host.forget()


@pytest.fixture
def client(host):
    client = ActionClient(host.client_node, GripperCommand, '/counter/count')
    wait_until(host.client_node, lambda: client.server_is_ready() or None, timeout=PATIENCE)
    yield client
    client.destroy()


def finish(host, future):
    return wait_until(
        host.client_node, lambda: future.result() if future.done() else None, timeout=PATIENCE
    )


def send(host, client, count, **options):
    goal = GripperCommand.Goal()
    goal.command.position = float(count)
    return finish(host, client.send_goal_async(goal, **options))


def result_of(host, handle):
    response = finish(host, handle.get_result_async())
    return response.status, response.result.position


def test_a_service_is_answered_by_the_controller(host):
    response = call(host.client_node, SetBool, '/counter/switch', SetBool.Request(data=True))
    assert (response.success, response.message) == (True, 'at 0')


def test_an_answer_that_raises_is_logged_and_answered(host, stderr):
    response = call(host.client_node, SetBool, '/counter/switch', SetBool.Request(data=False))
    assert (response.success, response.message) == (False, '')
    wait_until(host.client_node, lambda: 'no switching off' in stderr() or None, timeout=PATIENCE)


def test_a_service_is_answered_while_inactive(host):
    assert host.client.switch(deactivate=['counter']) is None
    assert call(host.client_node, SetBool, '/counter/switch', SetBool.Request(data=True)).success


def test_a_goal_is_followed_to_its_end(host, client):
    feedback = []
    handle = send(host, client, 30, feedback_callback=feedback.append)
    assert handle.accepted
    assert result_of(host, handle) == (GoalStatus.STATUS_SUCCEEDED, 30.0)
    counts = [each.feedback.position for each in feedback]
    assert counts == sorted(set(counts))
    assert 0 < counts[0] <= 30


def now(host):
    return host.manager_node.node.get_clock().now()


def test_goals_are_stamped_with_the_time_of_the_node(host, client):
    before = now(host)
    assert before <= Time.from_msg(send(host, client, 1).stamp) <= now(host)


def test_the_executor_sleeps_between_goals_though_the_clock_runs(host, client):
    result_of(host, send(host, client, 1))
    beyond = 12 * 10**9  # ns, longer than results are kept

    def jump():
        host.stepper.time += beyond
        host.loop_thread.loop.set_clock()

    end = now(host).nanoseconds + beyond + 500 * 10**6
    host.loop_thread.submit(jump)
    seen = Counter()  # of each entity, at every turn of the executor
    host.executor.can_execute = lambda entity: seen.update([id(entity)]) or True
    wait_until(host.client_node, lambda: now(host).nanoseconds > end or None, timeout=PATIENCE)
    del host.executor.can_execute
    assert max(seen.values(), default=0) < 20  # and not at each of the fifty cycles


def test_a_goal_is_rejected_with_the_reason_in_the_log(host, client, stderr):
    assert not send(host, client, -1).accepted
    wait_until(
        host.client_node, lambda: 'cannot count to -1' in stderr() or None, timeout=PATIENCE
    )


def test_an_inactive_controller_takes_no_goal(host, client, stderr):
    assert host.client.switch(deactivate=['counter']) is None
    assert not send(host, client, 1).accepted
    text = "Can't accept new action goals. Controller is not running."
    wait_until(host.client_node, lambda: text in stderr() or None, timeout=PATIENCE)


def test_a_goal_is_canceled_by_its_client(host, client):
    handle = send(host, client, FOREVER)
    canceling = finish(host, handle.cancel_goal_async()).goals_canceling
    assert len(canceling) == 1
    status, count = result_of(host, handle)
    assert status == GoalStatus.STATUS_CANCELED
    assert count > 0


def test_a_newer_goal_cancels_the_older_one(host, client):
    older, newer = send(host, client, FOREVER), send(host, client, 1)
    assert result_of(host, older) == (GoalStatus.STATUS_CANCELED, -1.0)
    assert result_of(host, newer) == (GoalStatus.STATUS_SUCCEEDED, 1.0)


def test_a_goal_that_a_deactivated_controller_leaves_is_aborted(host, client):
    handle = send(host, client, FOREVER)
    assert host.client.switch(deactivate=['counter']) is None
    assert result_of(host, handle) == (GoalStatus.STATUS_ABORTED, 0.0)


def test_the_result_comes_though_the_controller_is_unloaded_at_once(host, client):
    handle = send(host, client, FOREVER)
    result = handle.get_result_async()
    assert host.client.switch(deactivate=['counter']) is None
    assert host.client.unload('counter')
    assert finish(host, result).status == GoalStatus.STATUS_ABORTED
    assert client.wait_for_server(timeout_sec=0.0) is False


def test_a_flood_of_goals_leaves_the_loop_alone(host, client):
    for _ in range(100):  # more than the services of DDS keep: some are lost
        client.send_goal_async(GripperCommand.Goal())
    handle = send(host, client, 3)
    assert result_of(host, handle) == (GoalStatus.STATUS_SUCCEEDED, 3.0)
    assert host.client.states() == {'counter': 'active'}


def test_a_client_that_is_gone_leaves_its_goal_running(host, client):
    other = ActionClient(host.client_node, GripperCommand, '/counter/count')
    wait_until(host.client_node, lambda: other.server_is_ready() or None, timeout=PATIENCE)
    send(host, other, FOREVER)
    other.destroy()
    newer = send(host, client, 2)
    assert result_of(host, newer) == (GoalStatus.STATUS_SUCCEEDED, 2.0)
