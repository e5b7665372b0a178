# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Laws that hold for every stack, whatever its nodes wait for and however they end."""

import itertools
import random

import pytest

from amr_description.bringup import (
    after,
    all_of,
    any_of,
    exited_cleanly,
    failed,
    Group,
    logged,
    Node,
    Respawn,
    Stack,
    started,
    topic,
)
from amr_description.bringup.conditions import RosGraph, Verdict
from amr_description.bringup.scheduler import Scheduler

TIMEOUT = 10.0
"""s"""
SEEDS = [range(first, first + 100) for first in range(0, 500, 100)]


def condition(chance, nodes, depth=2):
    """A condition on some of the nodes, on time and on a topic."""
    kind = chance.randrange(9 if depth else 6)
    if kind < 4 and nodes:
        of_node = (exited_cleanly, failed, started, lambda node: logged(node, 'up'))[kind]
        return of_node(chance.choice(nodes))
    if kind < 6:
        return after(chance.uniform(0, 5)) if kind % 2 else topic('/odom')
    parts = [condition(chance, nodes, depth - 1) for _ in range(chance.randint(1, 3))]
    return (all_of, any_of, lambda *parts: after(chance.uniform(0, 5), parts[0]))[kind - 6](*parts)


def stack(chance):
    """Nodes that wait for nodes before them, some in groups, some started again."""
    nodes = []
    for number in range(chance.randint(1, 5)):
        waits = chance.random() < 0.7
        node = Node(
            f'n{number}',
            start_when=condition(chance, list(nodes)) if waits else None,
            required=chance.random() < 0.5,
            respawn=Respawn(limit=2) if chance.random() < 0.2 else None,
            on_exit=chance.choice(['continue', 'continue', 'shutdown']),
        )
        nodes.append(node)
    members = [chance.choice([node, Group([node])]) for node in nodes]
    ready_when = condition(chance, nodes) if chance.random() < 0.5 else None
    return Stack(members, ready_when=ready_when, timeout=TIMEOUT)


class Run:
    """A stack that is brought up by chance."""

    def __init__(self, seed):
        self.chance = random.Random(seed)
        self.scheduler = Scheduler(stack(self.chance), start_time=5.0)
        self.running, self.starts, self.time = [], {}, 5.0

    def start_all(self):
        while not self.scheduler.over and (nodes := self.scheduler.startable()):
            (node, *_) = nodes
            condition = self.scheduler.condition_of(node)
            first = node not in self.starts
            if first and condition is not None:
                assert condition.evaluate(self.scheduler.state) is Verdict.HOLDS
            self.starts[node] = self.starts.get(node, 0) + 1
            assert node not in self.running
            self.scheduler.on_start(node)
            self.running.append(node)

    def happen(self):
        """Let one thing happen; it may always be that time passes."""
        actions = ['wait'] + (['end', 'say'] if self.running else []) + ['topic']
        match self.chance.choice(actions):
            case 'end':
                node = self.chance.choice(self.running)
                self.running.remove(node)
                self.scheduler.on_exit(node, self.chance.choice([0, 1, -9]))
            case 'say':
                self.scheduler.on_line(self.chance.choice(self.running), 'up')
            case 'topic':
                there = {'/odom': {'a/msg/B'}} if self.chance.random() < 0.5 else {}
                self.scheduler.observe(graph=RosGraph(topics=there))
            case _:
                self.pass_time()

    def pass_time(self):
        next_time = self.scheduler.next_time()
        if next_time is not None:
            assert next_time > self.time
            self.time = next_time
        self.scheduler.advance_to(self.time)


@pytest.mark.parametrize('seeds', SEEDS, ids=str)
def test_a_stack_is_over_or_something_can_still_happen(seeds):
    for seed in seeds:
        check(Run(seed))


def check(run):
    events = run.chance.randint(0, 20)
    for count in itertools.count():
        run.start_all()
        if run.scheduler.over:
            break
        assert run.running or run.scheduler.next_time() is not None
        if count < events:
            run.happen()
        elif run.scheduler.next_time() is not None:
            run.pass_time()
        else:
            break  # it is up, and all that will ever start was started
    respawned = {node for node in run.starts if node.respawn}
    assert all(count == 1 for node, count in run.starts.items() if node not in respawned)


@pytest.mark.parametrize('seeds', SEEDS, ids=str)
def test_a_failure_of_a_required_node_is_never_lost(seeds):
    for run in map(Run, seeds):
        run.start_all()
        required = [node for node in run.running if node.required and not node.respawn]
        for node in required[:1]:
            run.scheduler.on_exit(node, 3)
            assert run.scheduler.over
            assert run.scheduler.failure.exit_code == 3
