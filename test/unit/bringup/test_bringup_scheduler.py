# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What may start when, and what a failure means; no process is involved."""

import itertools

import pytest

from amr_description.bringup import (
    after,
    all_of,
    EventHandler,
    exited,
    exited_cleanly,
    Log,
    Node,
    Respawn,
    Shutdown,
    Stack,
    started,
)
from amr_description.bringup.reporter import failure_report
from amr_description.bringup.scheduler import Failure, Scheduler
from amr_description.errors import BringupError


def chain(length, **options):
    """Return nodes, each of which waits for the clean exit of the one before."""
    nodes = [Node('n0', **options)]
    for index in range(1, length):
        nodes.append(Node(f'n{index}', start_when=exited_cleanly(nodes[-1]), **options))
    return nodes


@pytest.mark.parametrize('order', list(itertools.permutations(range(3))))
def test_the_order_of_the_list_does_not_matter(order):
    nodes = chain(3)
    scheduler = Scheduler(Stack([nodes[i] for i in order]))
    for node in nodes:
        assert scheduler.startable() == [node]
        scheduler.on_start(node)
        assert scheduler.startable() == []
        assert not scheduler.over
        scheduler.on_exit(node, 0)
    assert scheduler.over
    assert scheduler.failure is None
    assert scheduler.ready


@pytest.mark.parametrize('respawn', [None, Respawn(limit=1)])
def test_nothing_follows_the_start_of_a_process_that_cannot_be_made(respawn):
    absent = Node('absent', required=False, respawn=respawn)
    follower = Node('follower', start_when=started(absent), required=False)
    scheduler = Scheduler(Stack([absent, Node('other'), follower]))
    scheduler.on_no_start(absent, 126, ['could not be started'])
    assert follower not in scheduler.startable()
    assert scheduler.unreachable() == ([] if respawn else [follower])
    if respawn:
        scheduler.advance_to(respawn.delay)
        scheduler.on_start(absent)
        assert follower in scheduler.startable()


@pytest.mark.parametrize(('returncode', 'exit_code'), [(1, 1), (255, 255), (-9, 137), (-2, 130)])
def test_a_failure_stops_the_stack_with_the_exit_code_of_the_node(returncode, exit_code):
    first, second, third = chain(3)
    scheduler = Scheduler(Stack([first, second, third]))
    scheduler.on_start(first)
    scheduler.on_exit(first, returncode)
    assert scheduler.over
    assert scheduler.failure == Failure(first, returncode)
    assert scheduler.failure.exit_code == exit_code
    assert scheduler.unreachable() == [second, third]
    assert scheduler.startable() == []
    assert not scheduler.ready


def test_only_the_first_failure_counts():
    one, other = Node('a'), Node('b')
    scheduler = Scheduler(Stack([one, other]))
    scheduler.on_start(one)
    scheduler.on_start(other)
    scheduler.on_exit(other, 7)
    scheduler.on_exit(one, -15)
    assert scheduler.failure == Failure(other, 7)


def test_an_optional_failure_counts_only_if_a_required_node_depends_on_it():
    optional = chain(3, required=False)
    scheduler = Scheduler(Stack([*optional, Node('worker')]))
    for node in scheduler.startable():
        scheduler.on_start(node)
    scheduler.on_exit(optional[0], 1)
    assert scheduler.unreachable() == optional[1:]
    assert not scheduler.over

    required = Node('required', start_when=exited_cleanly(optional[2]))
    scheduler = Scheduler(Stack([*optional, required]))
    scheduler.on_start(optional[0])
    scheduler.on_exit(optional[0], 1)
    assert scheduler.failure == Failure(optional[0], 1)
    assert scheduler.unreachable() == [*optional[1:], required]


def test_a_clean_exit_may_stop_the_stack():
    boss, worker = Node('boss', on_exit='shutdown'), Node('worker')
    scheduler = Scheduler(Stack([boss, worker]))
    scheduler.on_start(boss)
    scheduler.on_start(worker)
    scheduler.on_exit(boss, 0)
    assert scheduler.over
    assert scheduler.failure is None


def test_started_and_all_of():
    one, other = Node('one'), Node('other')
    both = Node('both', start_when=all_of(started(one), exited_cleanly(other)))
    scheduler = Scheduler(Stack([one, other, both]))
    scheduler.on_start(one)
    scheduler.on_start(other)
    assert scheduler.startable() == []
    scheduler.on_exit(other, 0)
    assert scheduler.startable() == [both]
    words = both.start_when.describe(lambda node: node.executable)
    assert words == 'one was started and other exited with code 0'


def test_ready_without_a_condition_is_when_all_were_started():
    first, second = chain(2)
    scheduler = Scheduler(Stack([first, second]))
    scheduler.on_start(first)
    scheduler.on_exit(first, 0)
    assert not scheduler.ready
    scheduler.on_start(second)
    assert scheduler.ready


def test_a_stack_that_cannot_run_is_refused():
    node, other = Node('a'), Node('other')
    with pytest.raises(BringupError, match='at least one node'):
        Stack([])
    with pytest.raises(BringupError, match=r"the same Node\('a'\) stands twice"):
        Stack([node, node])
    with pytest.raises(BringupError, match=r"waits for Node\('other'\), which is not in"):
        Stack([Node('b', start_when=started(other))])
    with pytest.raises(BringupError, match=r"waits for Node\('other'\), which is not in"):
        Stack([node], ready_when=started(other))


def test_the_failure_report_ends_with_one_complete_line():
    failure = Failure(Node('create'), 2)
    assert failure_report('create-3', failure, ['begin', 'no clock', '  '], ['spawner-4']) == [
        'the last lines of create-3:\n    begin\n    no clock\n      ',
        'stopped because create-3 ended with exit code 2 (never started: spawner-4): no clock',
    ]
    assert failure_report('sim-1', Failure(Node('sim'), -11), [], []) == [
        'stopped because sim-1 died of SIGSEGV, without a word'
    ]
    line = "[FATAL] [1795282350.335513884] [left.sim]: world 'x' [1]: no file"
    assert failure_report('sim-1', Failure(Node('sim'), -40), [line], []) == [
        "stopped because sim-1 died of signal 40: world 'x' [1]: no file"
    ]


@pytest.mark.parametrize('code', [0, 5])
def test_a_node_may_wait_for_any_end_of_another_one(code):
    first = Node('first', required=False)
    second = Node('second', start_when=exited(first))
    scheduler = Scheduler(Stack([first, second]))
    scheduler.on_start(first)
    assert scheduler.startable() == []
    scheduler.on_exit(first, code)
    assert scheduler.startable() == [second]


def test_event_handlers_are_called_once_when_their_condition_holds():
    first, second = Node('first', required=False), Node('second')
    seen = []

    def note(state):
        seen.append(state.nodes[first].returncode)
        return Log('noted')

    stop = EventHandler(after(3.0, exited(first)), lambda _: [Log('b'), Shutdown('enough', 9)])
    stack = Stack([first, second], event_handlers=[EventHandler(exited(first), note), stop])
    scheduler = Scheduler(stack, 10.0)
    for node in stack.nodes:
        scheduler.on_start(node)
    assert seen == []
    scheduler.on_exit(first, 4)
    assert seen == [4]
    assert scheduler.next_time() == 13.0
    scheduler.on_exit(second, 0)
    assert not scheduler.over  # a handler counts down
    scheduler.advance_to(13.0)
    assert seen == [4]
    assert [line.text for line in scheduler.lines] == ['noted', 'b']
    assert scheduler.over
    assert scheduler.shutdown.exit_code == 9


def test_an_event_handler_that_raises_stops_the_stack():
    node = Node('node')
    stack = Stack([node], event_handlers=[EventHandler(started(node), lambda _: 1 / 0)])
    scheduler = Scheduler(stack)
    scheduler.on_start(node)
    assert scheduler.over
    assert 'an event handler failed: ZeroDivisionError' in scheduler.shutdown.reason


def test_lines_of_output_may_be_handled():
    node = Node('node', on_output=lambda line: Log(line.upper()) if 'a' in line else None)
    scheduler = Scheduler(Stack([node]))
    scheduler.on_start(node)
    assert not scheduler.on_line(node, 'b')
    assert scheduler.on_line(node, 'a')
    assert list(scheduler.lines) == [Log('A')]
