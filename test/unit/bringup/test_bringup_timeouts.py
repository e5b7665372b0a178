# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Timeouts and respawns: what a stack does as time passes; no process is involved."""

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
from amr_description.bringup.conditions import RosGraph
from amr_description.bringup.scheduler import Failure, Scheduler
from amr_description.errors import BringupError


def name(node):
    return f'{node.executable}-1'


def begun(*nodes, **options):
    """The scheduler of a stack of which all that can start at once was started, at 1000 s."""
    scheduler = Scheduler(Stack(nodes, **options), start_time=1000.0)
    for node in scheduler.startable():
        scheduler.on_start(node)
    scheduler.advance_to(1000.0)
    return scheduler


def test_a_timeout_stops_the_stack_and_is_explained():
    sim, create = Node('sim'), Node('create')
    spawner = Node('spawner', start_when=service('/manager/list'))
    scheduler = begun(sim, create, spawner)
    scheduler.observe(graph=RosGraph(services={'/list', '/sim/get_parameters'}))
    assert scheduler.next_time() == 1060.0
    scheduler.advance_to(1059.9)
    assert not scheduler.over
    scheduler.advance_to(1060.0)
    assert scheduler.over
    assert scheduler.failure.exit_code == 124
    assert scheduler.failure.text(name) == (
        'spawner-1 waited 60 s in vain: the service /manager/list is not there; there are /list; '
        'sim-1 still runs; create-1 still runs'
    )


def test_a_timeout_begins_once_the_awaited_step_was_started():
    slow = Node('slow')
    step = Node('step', start_when=exited_cleanly(slow))
    last = Node('last', start_when=exited_cleanly(step))
    scheduler = begun(slow, step, last)
    scheduler.advance_to(1059.0)
    scheduler.on_exit(slow, 0)
    scheduler.on_start(step)
    scheduler.advance_to(1059.0)
    assert scheduler.next_time() == 1119.0
    scheduler.advance_to(1118.0)
    assert not scheduler.over
    scheduler.advance_to(1119.0)
    assert scheduler.failure.text(name) == 'last-1 waited 60 s in vain: step-1 still runs'


def test_the_readiness_of_a_stack_is_a_wait_too():
    step = Node('step')
    scheduler = begun(step, ready_when=exited_cleanly(step), timeout=5.0)
    scheduler.advance_to(1005.0)
    assert scheduler.failure.node is None
    assert scheduler.failure.text(name) == (
        'the stack, to be ready, waited 5 s in vain: step-1 still runs'
    )


def test_once_ready_it_stays_so_and_waits_no_more():
    scheduler = begun(Node('sim'), ready_when=topic('/odom'))
    scheduler.observe(graph=RosGraph(topics={'/odom': {'a/msg/B'}}))
    assert scheduler.ready
    scheduler.observe(graph=RosGraph())
    scheduler.advance_to(2000.0)
    assert scheduler.ready
    assert not scheduler.over
    assert scheduler.next_time() is None


@pytest.mark.parametrize('timeout', [math.inf, 1e9])
def test_a_node_may_have_a_timeout_of_its_own(timeout):
    scheduler = begun(
        Node('sim'),
        Node('late', start_when=topic('/odom'), timeout=timeout),
        ready_when=topic('/odom'),
        timeout=math.inf,
    )
    scheduler.advance_to(1e6)
    assert not scheduler.over
    assert scheduler.next_time() == (None if timeout == math.inf else 1000.0 + 1e9)


def test_a_delay_on_purpose_extends_the_timeout():
    scheduler = begun(Node('sim'), Node('late', start_when=after(100.0)))
    scheduler.advance_to(1099.9)
    assert not scheduler.over
    scheduler.advance_to(1100.0)
    assert [node.executable for node in scheduler.startable()] == ['late']


def test_an_optional_node_is_abandoned_and_the_stack_continues():
    sim = Node('sim')
    first = Node('first', start_when=topic('/odom'), required=False, timeout=3.0)
    second = Node('second', start_when=exited_cleanly(first), required=False)
    scheduler = begun(sim, first, second)
    scheduler.advance_to(1003.0)
    assert not scheduler.over
    assert [each.node for each in scheduler.abandoned] == [first]
    assert scheduler.unreachable() == [first, second]
    assert scheduler.ready
    scheduler.observe(graph=RosGraph(topics={'/odom': {'a/msg/B'}}))
    assert scheduler.startable() == []


def test_a_stack_that_can_never_get_ready_continues():
    step = Node('step', required=False)
    scheduler = begun(Node('sim'), step, ready_when=exited_cleanly(step))
    assert scheduler.never_ready is None
    scheduler.on_exit(step, 1)
    assert scheduler.never_ready == exited_cleanly(step)
    scheduler.advance_to(2000.0)
    assert not scheduler.over
    assert not scheduler.ready


def test_a_wait_for_a_failure_has_no_timeout_and_does_not_delay_readiness():
    driver = Node('driver', required=False)
    scheduler = begun(driver, Node('fallback', start_when=failed(driver)))
    assert scheduler.ready
    scheduler.advance_to(1e6)
    assert not scheduler.over
    scheduler.on_exit(driver, 3)
    assert [node.executable for node in scheduler.startable()] == ['fallback']


def test_a_timeout_begins_once_the_failure_has_come():
    driver = Node('driver', required=False)
    fallback = Node('fallback', start_when=all_of(failed(driver), topic('/odom')))
    scheduler = begun(Node('sim'), driver, fallback)
    scheduler.advance_to(2000.0)
    scheduler.on_exit(driver, 3)
    scheduler.advance_to(2000.0)
    assert scheduler.next_time() == 2060.0
    scheduler.advance_to(2060.0)
    assert scheduler.failure.node is fallback


def test_two_nodes_are_abandoned_at_once():
    late = [Node(n, start_when=topic('/odom'), required=False, timeout=3.0) for n in 'ab']
    scheduler = begun(Node('sim'), *late)
    scheduler.advance_to(1003.0)
    assert scheduler.unreachable() == late


def test_a_stack_with_only_abandoned_nodes_left_is_over():
    step = Node('step')
    late = Node('late', start_when=topic('/odom'), required=False, timeout=3.0)
    scheduler = begun(step, late)
    scheduler.on_exit(step, 0)
    assert not scheduler.over  # the topic may be of another machine
    scheduler.advance_to(1003.0)
    assert scheduler.over
    assert scheduler.failure is None


def test_an_awaited_line_can_no_longer_come_once_its_node_has_ended():
    talker = Node('talker')
    waits = Node('waits', start_when=logged(talker, 'up'))
    scheduler = begun(talker, waits)
    scheduler.on_exit(talker, 0)
    assert scheduler.unreachable() == [waits]
    assert scheduler.over


RULE = Respawn(delay=1.0, backoff=2.0, limit=3)


def test_it_is_started_again_each_time_later():
    node = Node('sick', respawn=RULE)
    scheduler = begun(node)
    now = 1000.0
    for delay in (1.0, 2.0, 4.0):
        scheduler.on_exit(node, 1)
        assert not scheduler.over
        assert scheduler.next_time() == now + delay
        scheduler.advance_to(now + delay - 0.1)
        assert scheduler.startable() == []
        now += delay
        scheduler.advance_to(now)
        assert scheduler.startable() == [node]
        scheduler.on_start(node)
        assert scheduler.startable() == []
    scheduler.on_exit(node, 1)
    assert scheduler.failure == Failure(node, 1, restarts=3)


def test_too_many_clean_exits_are_a_failure():
    node = Node('quits', respawn=Respawn(limit=1))
    scheduler = begun(node)
    scheduler.on_exit(node, 0)
    scheduler.advance_to(1001.0)
    scheduler.on_start(node)
    scheduler.on_exit(node, 0)
    assert scheduler.failure.exit_code == 1


def test_delay_and_limit_start_over_after_a_steady_run():
    node = Node('rare', respawn=Respawn(limit=1, steady=60.0))
    scheduler = begun(node)
    for day in range(1, 10):
        scheduler.advance_to(1000.0 + day * 86_400)
        scheduler.on_exit(node, -11)
        assert scheduler.next_time() == 1001.0 + day * 86_400
        scheduler.advance_to(1001.0 + day * 86_400)
        scheduler.on_start(node)
    assert not scheduler.over


def test_nothing_is_started_again_once_the_stack_is_over():
    node = Node('sick', respawn=RULE)
    scheduler = begun(node)
    scheduler.over = True
    scheduler.on_exit(node, -2)
    assert scheduler.startable() == []
    assert scheduler.failure is None


@pytest.mark.parametrize('seconds', [0.0, 9.9])
def test_what_is_required_at_start_ends_the_stack_if_it_fails_then(seconds):
    node = Node('navigator', required='at start', respawn=RULE)
    scheduler = begun(node, Node('simulator'))
    scheduler.advance_to(1000.0 + seconds)
    scheduler.on_exit(node, 1)
    assert scheduler.failure == Failure(node, 1)
    assert scheduler.over


def test_what_is_required_at_start_is_started_again_later_and_in_the_end_given_up():
    node, simulator = Node('navigator', required='at start', respawn=RULE), Node('simulator')
    scheduler = begun(node, simulator)
    now = 1010.0
    scheduler.advance_to(now)
    for delay in (1.0, 2.0, 4.0):
        scheduler.on_exit(node, -11)
        now += delay
        scheduler.advance_to(now)
        assert scheduler.startable() == [node]
        scheduler.on_start(node)
    scheduler.on_exit(node, 1)
    assert scheduler.startable() == []
    assert scheduler.failure is None
    assert not scheduler.over
    scheduler.on_exit(simulator, 1)
    assert scheduler.failure == Failure(simulator, 1)


def test_without_a_respawn_a_later_failure_is_only_said():
    node = Node('navigator', required='at start')
    scheduler = begun(node, Node('simulator'))
    scheduler.advance_to(1010.0)
    scheduler.on_exit(node, 1)
    assert scheduler.failure is None
    assert not scheduler.over


def test_a_node_that_ends_well_at_its_start_is_no_failure():
    node = Node('navigator', required='at start')
    scheduler = begun(node, Node('simulator'))
    scheduler.on_exit(node, 0)
    assert scheduler.failure is None
    assert not scheduler.over


def test_a_respawn_without_a_delay_is_refused():
    for wrong in ({'delay': 0}, {'backoff': 0.5}, {'limit': 0}):
        with pytest.raises(BringupError, match='delay > 0, backoff >= 1 and limit > 0'):
            Respawn(**wrong)
