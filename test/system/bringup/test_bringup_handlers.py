# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Event handlers at the end of a node and of the stack; respawn of real processes."""

import json
import re
import signal
import sys

from fixtures.bringup.running import Bringup, STACKS
import pytest

from amr_description.bringup import (
    Exited,
    exited_cleanly,
    Group,
    Node,
    on_request,
    Shutdown,
    Stack,
)
from amr_description.bringup.scheduler import Scheduler


def ended(on_exit, *others, code=0, required=False):
    """Progress after the end of a node with this handler, and what the handler was told."""
    events = []

    def handler(event):
        events.append(event)
        return on_exit(event)

    node = Node('node', on_exit=handler, required=required)
    scheduler = Scheduler(Stack([node, *others]))
    scheduler.on_start(node)
    scheduler.on_exit(node, code, ['last words'])
    assert events == [Exited(node, code, ['last words'])]
    return scheduler


@pytest.mark.parametrize('code', [0, 3, -9])
def test_it_may_start_what_waits_for_that(code):
    helper, after_it = Node('helper', start_when=on_request()), Node('after')
    after_it = Node('after', start_when=exited_cleanly(helper))
    scheduler = ended(lambda _: helper, helper, after_it, code=code)
    assert scheduler.startable() == [helper]
    assert not scheduler.over
    scheduler.on_start(helper)
    assert scheduler.startable() == []


def test_it_may_start_several_and_whole_groups():
    first, second = (Node('n', start_when=on_request()) for _ in range(2))
    third = Node('third')
    group = Group([third], start_when=on_request())
    scheduler = ended(lambda _: [first, group], first, second, group)
    assert scheduler.startable() == [first, third]


@pytest.mark.parametrize(
    ('reaction', 'text'),
    [
        ('stop', "'stop' stands in a stack"),
        (5, '5 stands in a stack'),
        (Shutdown, 'Shutdown'),
        (False, 'False stands in a stack'),
    ],
)
def test_an_invalid_return_value_stops_the_stack(reaction, text):
    scheduler = ended(lambda _: reaction)
    assert scheduler.over
    assert scheduler.shutdown.exit_code == 1
    assert scheduler.shutdown.reason.startswith('on_exit returned what is no reaction: ')
    assert text in scheduler.shutdown.reason


def test_a_handler_that_leaves_python_stops_the_stack():
    scheduler = ended(lambda _: sys.exit(9))
    assert re.fullmatch(
        r'on_exit failed: SystemExit: 9 \(test_bringup_handlers.py, line \d+\)',
        scheduler.shutdown.reason,
    )


def test_it_may_return_none():
    helper = Node('helper', start_when=on_request())
    scheduler = ended(lambda _: None, helper)
    assert scheduler.startable() == []
    assert scheduler.over  # nobody is left who could ask
    assert scheduler.failure is None


def test_it_may_stop_the_stack():
    scheduler = ended(lambda event: Shutdown(f'code {event.returncode}', 5), Node('n'), code=2)
    assert scheduler.over
    assert scheduler.shutdown == Shutdown('code 2', 5)


def test_a_required_node_that_failed_stops_the_stack_whatever_its_handler_returns():
    helper = Node('helper', start_when=on_request())
    scheduler = ended(lambda _: helper, helper, code=4, required=True)
    assert scheduler.over
    assert scheduler.failure.exit_code == 4


def test_a_handler_that_raises_stops_the_stack_and_is_located():
    scheduler = ended(lambda _: 1 / 0, Node('n'))
    text = r'on_exit failed: ZeroDivisionError: division by zero \(test_bringup_handlers.py, line'
    assert re.match(text, scheduler.shutdown.reason)
    assert scheduler.shutdown.exit_code == 1


def test_it_may_start_only_what_waits_for_it():
    plain = Node('plain')
    for other in (plain, Node('foreign', start_when=on_request())):
        scheduler = ended(lambda _, other=other: other, plain)
        assert f"on_exit asks for Node('{other.executable}'), which" in scheduler.shutdown.reason


def test_a_wait_for_a_request_has_no_timeout_and_does_not_delay_readiness():
    scheduler = Scheduler(Stack([Node('n'), Node('helper', start_when=on_request())]))
    scheduler.on_start(scheduler.startable()[0])
    assert scheduler.ready
    scheduler.advance_to(1e9)
    assert not scheduler.over


def handled(folder, reaction):
    note = folder / 'note'
    return Bringup(
        folder, str(STACKS / 'handled.py'), 'code:=3', f'note:={note}', f'reaction:={reaction}'
    ), note


def test_a_handler_starts_another_node(tmp_path):
    bringup, note = handled(tmp_path, 'start')
    with bringup:
        bringup.expect(r'\[step-3\]: process has finished cleanly')
        assert bringup.end(signal.SIGTERM) == 0
        assert note.read_text() == 'the end with 0'


@pytest.mark.parametrize(
    ('reaction', 'code', 'told'),
    [
        ('shutdown', 7, r"\[ERROR\] \[launch\]: stopping: step said 'two'"),
        ('raise', 1, r'stopping: on_exit failed: ValueError: one \(handled.py, line \d+\)'),
        ('raise', 1, r'on_shutdown failed: OSError: no brake \(handled.py, line \d+\)'),
        ('foreign', 1, r"stopping: on_exit asks for Node\('step'\), which is not in the stack"),
    ],
)
def test_a_handler_stops_the_stack(tmp_path, reaction, code, told):
    bringup, note = handled(tmp_path, reaction)
    with bringup:
        assert bringup.end() == code
        assert re.search(told, bringup.output)
        assert note.read_text() == f'the end with {code}'
        assert ('on_shutdown failed' in bringup.output) == (reaction == 'raise')
        assert ('[INFO] [launch.user]: parked' in bringup.output) == (reaction == 'shutdown')
        assert bringup.left() == []


def test_a_step_is_respawned_up_to_its_limit(tmp_path):
    bringup, _ = handled(tmp_path, 'respawn')
    with bringup:
        bringup.expect(r'\[step-3\]: process has finished cleanly')
        assert bringup.output.count('[step-2]: process started') == 3
        assert re.findall(
            r'\[step-2\]: process is started again in (\S+ s .*)', bringup.output
        ) == [
            '0.1 s (1 of 2); its last line: two',
            '0.2 s (2 of 2); its last line: two',
        ]
        events = (bringup.logs / 'latest/events.jsonl').read_text().splitlines()
        told = [event for event in map(json.loads, events) if event['event'] == 'respawn']
        assert [(event['node'], event['seconds']) for event in told] == [
            ('step-2', pytest.approx(0.1)),
            ('step-2', pytest.approx(0.2)),
        ]
        assert bringup.end(signal.SIGINT) == 0
