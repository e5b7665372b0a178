# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What waits in ports between other threads and the control thread: samples, and goals; and what a
controller requests.
"""

import threading

import pytest

from amr_description.control.contracts import Action, ActionPort, Goal, GoalStatus, Input, Port
from amr_description.control.interfaces import InterfaceRequest, StateInterface
from amr_description.errors import ControllerError

PORT = Port('~/input', 'std_msgs/msg/Empty', 'nowhere:nothing')


@pytest.fixture
def queue():
    queue = Input(PORT)
    queue.open()
    return queue


def test_a_closed_input_takes_nothing():
    queue = Input(PORT)
    assert not queue.put(1)
    queue.open()
    assert queue.drain() == []


def test_samples_come_once_and_oldest_first(queue):
    assert all(queue.put(sample) for sample in (1, 2, 3))
    assert queue.drain() == [1, 2, 3]
    assert queue.drain() == []


def test_the_oldest_of_too_many_are_dropped():
    queue = Input(PORT, capacity=3)
    queue.open()
    for sample in range(10):
        queue.put(sample)
    assert queue.drain() == [7, 8, 9]


def test_samples_that_wait_at_a_close_are_dropped(queue):
    queue.put(1)
    queue.close()
    assert not queue.put(2)
    queue.open()
    assert queue.drain() == []


def test_nothing_is_lost_or_doubled_between_threads():
    queue = Input(PORT, capacity=100_000)
    queue.open()
    writer = threading.Thread(target=lambda: [queue.put(k) for k in range(50_000)])
    writer.start()
    received = []
    while writer.is_alive():
        received += queue.drain()
    writer.join()
    assert received + queue.drain() == list(range(50_000))


ACTION = ActionPort('~/action', 'an/action/Type', object, object, object)


@pytest.fixture
def action():
    action = Action(ACTION, lambda request, time: '', capacity=3)
    action.open()
    return action


def test_a_goal_ends_once():
    goal = Goal('request')
    assert goal.is_live
    goal.abort('too far')
    goal.succeed('there')
    goal.cancel(None)
    assert goal.outcome == (GoalStatus.ABORTED, 'too far')
    assert not goal.is_live


def test_the_newest_feedback_replaces_what_was_not_published():
    goal = Goal('request')
    goal.send_feedback(1)
    goal.send_feedback(2)
    assert goal.feedback == 2


def test_a_closed_action_takes_no_goal():
    action = Action(ACTION, lambda request, time: '')
    goal = Goal(1)
    assert not action.put(goal)
    action.open()
    assert action.drain() == []
    assert goal.is_live  # whoever was refused ends it


def test_the_oldest_of_too_many_goals_are_canceled(action):
    goals = [Goal(k) for k in range(5)]
    assert all(map(action.put, goals))
    assert action.drain() == goals[2:]
    assert [goal.outcome for goal in goals[:2]] == [(GoalStatus.CANCELED, None)] * 2
    assert all(goal.is_live for goal in goals[2:])


def test_goals_without_an_end_are_aborted_at_the_end_of_the_activity(action):
    forgotten, done, waiting = Goal(1), Goal(2), Goal(3)
    action.put(forgotten)
    action.put(done)
    assert action.drain() == [forgotten, done]
    done.succeed('there')
    action.put(waiting)
    action.close()
    action.end()
    assert forgotten.outcome == (GoalStatus.ABORTED, None)
    assert waiting.outcome == (GoalStatus.ABORTED, None)
    assert done.outcome == (GoalStatus.SUCCEEDED, 'there')
    action.open()
    assert action.drain() == []


def test_no_goal_of_another_thread_is_lost_or_doubled():
    action = Action(ACTION, lambda request, time: '', capacity=100_000)
    action.open()
    writer = threading.Thread(target=lambda: [action.put(Goal(k)) for k in range(5_000)])
    writer.start()
    received = []
    while writer.is_alive():
        received += action.drain()
    writer.join()
    received += action.drain()
    assert [goal.request for goal in received] == list(range(5_000))


def test_as_many_interfaces_as_were_requested_are_required():
    request = InterfaceRequest.individual(['a/position', 'b/position'])
    handles = [StateInterface('a', 'position'), StateInterface('b', 'position')]
    request.require_all(handles, 'state')
    with pytest.raises(ControllerError, match='Expected 2 state interfaces, got 1'):
        request.require_all(handles[:1], 'state')
