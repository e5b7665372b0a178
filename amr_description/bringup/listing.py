# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``--print`` prints: the tree of a stack, what each part waits for, and command lines."""

from collections.abc import Iterator, Mapping, Sequence

from amr_description.bringup.conditions import NameOf
from amr_description.bringup.description import Group, Member, Node, Stack
from amr_description.bringup.job import Job
from amr_description.bringup.placement import Placement

_INDENT = '    '


def listing(stack: Stack, jobs: Sequence[Job]) -> str:
    """Return the text."""
    by_node = {job.node: job for job in jobs}

    def name_of(node: Node) -> str:
        return by_node[node].name

    lines = list(_tree(stack.nodes, by_node, name_of))
    if stack.ready_when:
        lines.append(f'ready: when {Placement(stack).ready_when.describe(name_of)}')
    return '\n'.join(lines)


def _tree(members: Sequence[Member], jobs: Mapping[Node, Job], name_of: NameOf) -> Iterator[str]:
    for member in members:
        if isinstance(member, Node):
            yield from _of_job(jobs[member], name_of)
            continue
        inside = member.members if isinstance(member, Group) else member.nodes
        yield f'{_group(member) if isinstance(member, Group) else "stack"}:'
        yield from (f'{_INDENT}{line}' for line in _tree(inside, jobs, name_of))


def _group(group: Group) -> str:
    return f'group {group.namespace}' if group.namespace else 'group'


def _of_job(job: Job, name_of: NameOf) -> Iterator[str]:
    condition = job.placed.start_when
    when = f'when {condition.describe(name_of)}' if condition else 'at once'
    yield f'{job.name}: {", ".join([when, *_manners(job.node)])}'
    yield f'{_INDENT}{job.command_text}'
    for variable, value in job.environment.items():
        yield f'{_INDENT}{variable}={value}'
    for path, text in job.parameter_files:
        if text is not None:
            yield f'{_INDENT}{path}:'
            yield from (f'{2 * _INDENT}{line}' for line in text.splitlines())


def _manners(node: Node) -> Iterator[str]:
    """Yield how it differs from a node of which nothing is said."""
    if not node.required:
        yield 'optional'
    if node.respawn:
        limit = '' if node.respawn.limit is None else f' up to {node.respawn.limit} times'
        yield f'started again{limit}'
    if node.on_exit == 'shutdown':
        yield 'its end is the end of all'
    if node.terminal:
        yield 'has the terminal'
