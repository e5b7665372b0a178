# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Patience and new starts: what a stack does as time passes; no process is involved."""

import math

import pytest

from amr_description.bringup import (
    after,
    all_of,
    exited_cleanly,
    failed,
    logged,
    Node,
    Respawn,
    service,
    Stack,
    topic,
)
from amr_description.bringup.conditions import Graph
from amr_description.bringup.scheduler import Failure, Scheduler
from amr_description.errors import BringupError


def name(node):
    return f'{node.executable}-1'


def begun(*nodes, **options):
    """The progress of a stack of which all that can start at once was started, at 1000 s."""
    progress = Scheduler(Stack(nodes, **options), begin=1000.0)
    for node in progress.startable():
        progress.start(node)
    progress.at(1000.0)
    return progress


def test_a_wait_that_takes_too_long_stops_the_stack_and_says_all():
    sim, create = Node('sim'), Node('create')
    spawner = Node('spawner', start_when=service('/manager/list'))
    progress = begun(sim, create, spawner)
    progress.see(graph=Graph(services={'/list', '/sim/get_parameters'}))
    assert progress.next_time() == 1060.0
    progress.at(1059.9)
    assert not progress.over
    progress.at(1060.0)
    assert progress.over
    assert progress.failure.exit_code == 124
    assert progress.failure.text(name) == (
        'spawner-1 waited 60 s in vain: the service /manager/list is not there; there are /list; '
        'sim-1 still runs; create-1 still runs'
    )


def test_who_waits_for_the_end_of_a_step_has_patience_with_that_step_alone():
    slow = Node('slow')
    step = Node('step', start_when=exited_cleanly(slow))
    last = Node('last', start_when=exited_cleanly(step))
    progress = begun(slow, step, last)
    progress.at(1059.0)
    progress.end(slow, 0)
    progress.start(step)
    progress.at(1059.0)
    assert progress.next_time() == 1119.0
    progress.at(1118.0)
    assert not progress.over
    progress.at(1119.0)
    assert progress.failure.text(name) == 'last-1 waited 60 s in vain: step-1 still runs'


def test_the_readiness_of_a_stack_is_a_wait_too():
    step = Node('step')
    progress = begun(step, ready_when=exited_cleanly(step), patience=5.0)
    progress.at(1005.0)
    assert progress.failure.node is None
    assert progress.failure.text(name) == (
        'the stack, to be ready, waited 5 s in vain: step-1 still runs'
    )


def test_once_ready_it_stays_so_and_waits_no_more():
    progress = begun(Node('sim'), ready_when=topic('/odom'))
    progress.see(graph=Graph(topics={'/odom': {'a/msg/B'}}))
    assert progress.ready
    progress.see(graph=Graph())
    progress.at(2000.0)
    assert progress.ready
    assert not progress.over
    assert progress.next_time() is None


@pytest.mark.parametrize('patience', [math.inf, 1e9])
def test_a_node_may_have_another_patience(patience):
    progress = begun(
        Node('sim'),
        Node('late', start_when=topic('/odom'), patience=patience),
        ready_when=topic('/odom'),
        patience=math.inf,
    )
    progress.at(1e6)
    assert not progress.over
    assert progress.next_time() == (None if patience == math.inf else 1000.0 + 1e9)


def test_what_waits_on_purpose_loses_no_patience():
    progress = begun(Node('sim'), Node('late', start_when=after(100.0)))
    progress.at(1099.9)
    assert not progress.over
    progress.at(1100.0)
    assert [node.executable for node in progress.startable()] == ['late']


def test_an_optional_node_is_given_up_and_the_stack_goes_on():
    sim = Node('sim')
    first = Node('first', start_when=topic('/odom'), required=False, patience=3.0)
    second = Node('second', start_when=exited_cleanly(first), required=False)
    progress = begun(sim, first, second)
    progress.at(1003.0)
    assert not progress.over
    assert [each.node for each in progress.gave_up] == [first]
    assert progress.unreachable() == [first, second]
    assert progress.ready
    progress.see(graph=Graph(topics={'/odom': {'a/msg/B'}}))
    assert progress.startable() == []


def test_a_stack_that_can_no_longer_get_ready_goes_on_unready():
    step = Node('step', required=False)
    progress = begun(Node('sim'), step, ready_when=exited_cleanly(step))
    assert progress.never_ready is None
    progress.end(step, 1)
    assert progress.never_ready == exited_cleanly(step)
    progress.at(2000.0)
    assert not progress.over
    assert not progress.ready


def test_who_waits_for_a_failure_has_time_and_is_not_missed():
    driver = Node('driver', required=False)
    progress = begun(driver, Node('fallback', start_when=failed(driver)))
    assert progress.ready
    progress.at(1e6)
    assert not progress.over
    progress.end(driver, 3)
    assert [node.executable for node in progress.startable()] == ['fallback']


def test_patience_begins_once_the_failure_has_come():
    driver = Node('driver', required=False)
    fallback = Node('fallback', start_when=all_of(failed(driver), topic('/odom')))
    progress = begun(Node('sim'), driver, fallback)
    progress.at(2000.0)
    progress.end(driver, 3)
    progress.at(2000.0)
    assert progress.next_time() == 2060.0
    progress.at(2060.0)
    assert progress.failure.node is fallback


def test_two_are_given_up_at_once():
    late = [Node(n, start_when=topic('/odom'), required=False, patience=3.0) for n in 'ab']
    progress = begun(Node('sim'), *late)
    progress.at(1003.0)
    assert progress.unreachable() == late


def test_a_stack_of_which_nothing_is_left_but_what_was_given_up_is_over():
    step = Node('step')
    late = Node('late', start_when=topic('/odom'), required=False, patience=3.0)
    progress = begun(step, late)
    progress.end(step, 0)
    assert not progress.over  # the topic may be of another machine
    progress.at(1003.0)
    assert progress.over
    assert progress.failure is None


def test_a_line_that_was_never_said_is_known_at_the_end_of_who_should_have():
    talker = Node('talker')
    waits = Node('waits', start_when=logged(talker, 'up'))
    progress = begun(talker, waits)
    progress.end(talker, 0)
    assert progress.unreachable() == [waits]
    assert progress.over


RULE = Respawn(delay=1.0, backoff=2.0, limit=3)


def test_it_is_started_again_each_time_later():
    node = Node('sick', respawn=RULE)
    progress = begun(node)
    now = 1000.0
    for delay in (1.0, 2.0, 4.0):
        progress.end(node, 1)
        assert not progress.over
        assert progress.next_time() == now + delay
        progress.at(now + delay - 0.1)
        assert progress.startable() == []
        now += delay
        progress.at(now)
        assert progress.startable() == [node]
        progress.start(node)
        assert progress.startable() == []
    progress.end(node, 1)
    assert progress.failure == Failure(node, 1, restarts=3)


def test_too_many_good_ends_are_a_failure_as_well():
    node = Node('quits', respawn=Respawn(limit=1))
    progress = begun(node)
    progress.end(node, 0)
    progress.at(1001.0)
    progress.start(node)
    progress.end(node, 0)
    assert progress.failure.exit_code == 1


def test_one_that_ran_steadily_begins_anew():
    node = Node('rare', respawn=Respawn(limit=1, steady=60.0))
    progress = begun(node)
    for day in range(1, 10):
        progress.at(1000.0 + day * 86_400)
        progress.end(node, -11)
        assert progress.next_time() == 1001.0 + day * 86_400
        progress.at(1001.0 + day * 86_400)
        progress.start(node)
    assert not progress.over


def test_nothing_is_started_again_once_the_stack_is_over():
    node = Node('sick', respawn=RULE)
    progress = begun(node)
    progress.over = True
    progress.end(node, -2)
    assert progress.startable() == []
    assert progress.failure is None


def test_a_rule_without_a_pause_is_refused():
    for wrong in ({'delay': 0}, {'backoff': 0.5}, {'limit': 0}):
        with pytest.raises(BringupError, match='delay > 0, backoff >= 1 and limit > 0'):
            Respawn(**wrong)
