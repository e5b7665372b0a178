# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When conditions hold, how they combine, and how they explain that they are unmet."""

import itertools

import pytest

from amr_description.bringup import (
    after,
    all_of,
    any_of,
    exited_cleanly,
    failed,
    logged,
    Node,
    path_exists,
    ros_node,
    service,
    Stack,
    started,
    topic,
)
from amr_description.bringup.conditions import (
    NodeState,
    PathState,
    RosGraph,
    StackState,
    Verdict,
)
from amr_description.bringup.scheduler import Scheduler
from amr_description.errors import BringupError

HOLDS, NOT_YET, NEVER = Verdict.HOLDS, Verdict.NOT_YET, Verdict.NEVER
NODE = Node('n')


def verdict_of(condition, state=None, **changes):
    return condition.evaluate(StackState({NODE: state or NodeState()}, **changes))


def explanation_of(condition, state=None, **changes):
    return condition.explain_unmet(StackState({NODE: state or NodeState()}, **changes), name)


def name(node):
    return f'{node.executable}-1'


WAITING, RUNNING, STUCK = NodeState(), NodeState(started=True), NodeState(unreachable=True)
WELL, BADLY = (NodeState(started=True, returncode=code) for code in (0, 3))
RESTARTS = NodeState(started=True, restart_at=9.0)


@pytest.mark.parametrize(
    ('condition', 'verdicts'),
    [
        (exited_cleanly(NODE), (NOT_YET, NOT_YET, NEVER, HOLDS, NEVER, NOT_YET)),
        (failed(NODE), (NOT_YET, NOT_YET, NEVER, NEVER, HOLDS, NOT_YET)),
        (started(NODE), (NOT_YET, HOLDS, NEVER, HOLDS, HOLDS, HOLDS)),
        (logged(NODE, 'x'), (NOT_YET, NOT_YET, NEVER, NEVER, NEVER, NOT_YET)),
    ],
)
def test_conditions_on_a_node(condition, verdicts):
    states = (WAITING, RUNNING, STUCK, WELL, BADLY, RESTARTS)
    assert tuple(verdict_of(condition, state) for state in states) == verdicts


@pytest.mark.parametrize('verdicts', list(itertools.product(Verdict, repeat=2)))
def test_all_of_and_any_of_are_minimum_and_maximum(verdicts):
    states = {HOLDS: WELL, NOT_YET: RUNNING, NEVER: BADLY}
    nodes = [Node('a'), Node('b')]
    of_state = dict(zip(nodes, (states[v] for v in verdicts), strict=True))
    conditions = [exited_cleanly(node) for node in nodes]
    weakest_first = [NEVER, NOT_YET, HOLDS]
    stack_state = StackState(of_state)
    assert all_of(*conditions).evaluate(stack_state) == min(verdicts, key=weakest_first.index)
    assert any_of(*conditions).evaluate(stack_state) == max(verdicts, key=weakest_first.index)


def test_a_line_counts_even_if_the_node_has_ended_since():
    node = Node('n')
    scheduler = Scheduler(Stack([node, Node('next', start_when=logged(node, r'port \d+'))]))
    scheduler.on_start(node)
    assert not scheduler.on_line(node, 'port closed')
    assert [n.executable for n in scheduler.startable()] == []
    assert scheduler.on_line(node, 'listens on port 8000.')
    assert not scheduler.on_line(node, 'listens on port 8001.')
    scheduler.on_exit(node, 0)
    assert [n.executable for n in scheduler.startable()] == ['next']


def test_the_same_line_of_another_node_does_not_count():
    one, other = Node('one'), Node('other')
    scheduler = Scheduler(Stack([one, other, Node('next', start_when=logged(one, 'up'))]))
    for node in (one, other):
        scheduler.on_start(node)
    assert not scheduler.on_line(other, 'up')
    assert scheduler.startable() == []


GRAPH = RosGraph(
    topics={'/odom': {'nav_msgs/msg/Odometry'}, '/tf': {'tf2_msgs/msg/TFMessage'}},
    services={'/robot/list', '/robot/get_parameters'},
    nodes={'/robot/sim'},
)


@pytest.mark.parametrize(
    ('condition', 'holds'),
    [
        (topic('/odom'), True),
        (topic('/odom', 'nav_msgs/msg/Odometry'), True),
        (topic('/odom', 'std_msgs/msg/String'), False),
        (topic('/od'), False),
        (service('/robot/list'), True),
        (service('/list'), False),
        (ros_node('/robot/sim'), True),
        (ros_node('/sim'), False),
    ],
)
def test_the_graph(condition, holds):
    assert verdict_of(condition, graph=GRAPH) == (HOLDS if holds else NOT_YET)
    assert verdict_of(condition) == NOT_YET
    assert condition.is_external


@pytest.mark.parametrize('bad', ['', '/', 'a b', '~/odom', '//odom', 'odom/', '1st', 'ö'])
def test_an_invalid_name_is_refused(bad):
    for condition in (topic, service, ros_node):
        with pytest.raises(BringupError, match='is not the name of a topic, a service or a node'):
            condition(bad)


def test_an_invalid_pattern_or_time_is_refused():
    with pytest.raises(BringupError, match=r"logged\(…, '\('\): missing \)"):
        logged(NODE, '(')
    for seconds in (-1, float('nan'), float('inf')):
        with pytest.raises(BringupError, match='it takes 0 s or more'):
            after(seconds)


def test_a_path():
    condition = path_exists('/dev/ttyUSB0')
    assert verdict_of(condition) == NOT_YET
    assert verdict_of(condition, paths={'/dev/ttyUSB0': PathState(False)}) == NOT_YET
    assert verdict_of(condition, paths={'/dev/ttyUSB0': PathState(True)}) == HOLDS


def test_time_after_the_start_and_after_a_condition():
    node = Node('n')
    late, later = Node('late', start_when=after(5)), Node('later')
    later = Node('later', start_when=after(2, after(1, exited_cleanly(node))))
    scheduler = Scheduler(Stack([node, late, later]), start_time=100.0)
    scheduler.on_start(node)
    assert scheduler.next_time() == 105.0
    scheduler.advance_to(101.0)
    scheduler.on_exit(node, 0)
    assert scheduler.next_time() == 102.0
    scheduler.advance_to(102.5)  # a little late, which the two seconds count from
    assert scheduler.startable() == []
    assert scheduler.next_time() == 104.5
    scheduler.advance_to(104.5)
    assert scheduler.startable() == [later]
    scheduler.advance_to(105.0)
    assert scheduler.startable() == [late, later]


def test_time_after_a_condition_that_never_holds():
    assert verdict_of(after(1, exited_cleanly(NODE)), BADLY) == NEVER


@pytest.mark.parametrize(
    ('condition', 'state', 'text'),
    [
        (exited_cleanly(NODE), RUNNING, 'n-1 still runs'),
        (exited_cleanly(NODE), BADLY, 'n-1 ended with 3'),
        (started(NODE), WAITING, 'n-1 was not started'),
        (exited_cleanly(NODE), RESTARTS, 'n-1 waits for its next start'),
        (logged(NODE, 'port'), RUNNING, "n-1 has not said 'port'"),
        (topic('/odmo'), None, 'nobody publishes /odmo; there are /odom, /tf'),
        (
            topic('/tf', 'a/msg/B'),
            None,
            '/tf is published as tf2_msgs/msg/TFMessage, not as a/msg/B',
        ),
        (service('/list'), None, 'the service /list is not there; there are /robot/list'),
        (ros_node('/sim'), None, 'the node /sim is not there; there are /robot/sim'),
        (path_exists('/dev/ttyUSB0'), None, 'there is no /dev/ttyUSB0; /dev has ttyUSB1'),
        (path_exists('/dev/board'), None, 'there is no /dev/board; /dev has ttyUSB1'),
        (path_exists('/x/y'), None, 'there is no /x/y; /x has nothing like it'),
        (after(3), None, '3.0 s are left'),
        (
            all_of(started(NODE), exited_cleanly(NODE), ros_node('/sim')),
            RUNNING,
            'n-1 still runs; the node /sim is not there; there are /robot/sim',
        ),
    ],
)
def test_why_it_is_unmet_and_what_is_there_instead(condition, state, text):
    dev = PathState(False, frozenset({'ttyUSB1', 'null'}))
    paths = {'/dev/ttyUSB0': dev, '/dev/board': dev}
    assert explanation_of(condition, state, graph=GRAPH, paths=paths) == text


def test_many_names_are_cut_to_the_nearest():
    graph = RosGraph(services={f'/s{n}/list' for n in range(20)} | {'/listen'})
    text = explanation_of(service('/list'), graph=graph)
    assert text.startswith('the service /list is not there; there are /listen, ')
    assert text.endswith(' and 13 more')


def test_description_in_words():
    node = exited_cleanly(NODE)
    words = any_of(after(2, node), all_of(topic('/odom', 'a/msg/B'), path_exists('/dev/x')))
    assert words.describe(name) == (
        '(2 s have passed since n-1 exited with code 0 or '
        'somebody publishes /odom (a/msg/B) and /dev/x is there)'
    )
