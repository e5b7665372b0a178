# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the section ``graph``; of nodes here: names that are there twice, no answers."""

from collections import defaultdict
from collections.abc import Iterator

from amr_description.doctor.findings import Finding, Rule, Severity
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.graph import GraphNode
from amr_description.doctor.rules.qos import incompatible_qos
from amr_description.doctor.rules.topic_names import misnamed_topics
from amr_description.doctor.rules.types import mismatched_definitions, mismatched_types


def duplicate_node_names(seen: Observations) -> Iterator[Finding]:
    """Two nodes of one name have the same services: either of them answers, or both do."""
    found = defaultdict(list)
    for node in seen.graph.nodes if seen.graph else ():
        found[node.name].append(node)
    for name, nodes in found.items():
        if len(nodes) < 2 or _is_hidden(name):
            continue
        hosts = {each.host for each in nodes}
        processes = [str(each.process) for each in nodes if each.process is not None]
        places = ''
        if len(hosts) > 1:
            places = f', on {len(hosts)} machines'
        elif len(set(processes)) > 1:
            places = f', in the processes {" and ".join(sorted(set(processes), key=int))}'
        rename = f'start one with --ros-args -r __node:={name.rpartition("/")[2]}_2'
        # A signal to a process that has both would end both.
        is_apart = bool(processes) and len(set(processes)) == len(processes)
        fix = f'end one of them (kill -INT {processes[-1]}), or {rename}' if is_apart else rename
        if len(hosts) > 1:
            fix = (
                'give each machine another domain (export ROS_DOMAIN_ID=7), or each robot a '
                f'namespace (-r __ns:=/robot2), or {rename}'
            )
        yield Finding(
            severity=Severity.ERROR,
            rule='duplicate_node_names',
            what=f'{len(nodes)} nodes are named {name}{places}',
            why='they have the same services and parameters, and a request reaches both',
            fix=fix,
        )


def frozen_nodes(seen: Observations) -> Iterator[Finding]:
    """A node that does not serve its callbacks, though it is in the graph."""
    nodes = [each for each in (seen.graph.nodes if seen.graph else ())]
    for name in dict.fromkeys(each.name for each in nodes if each.is_stopped):
        process = next(each.process for each in nodes if each.name == name and each.is_stopped)
        yield Finding(
            severity=Severity.ERROR,
            rule='frozen_nodes',
            what=f'the process {process} of {name} is stopped, as by Ctrl-Z',
            why='it publishes nothing and answers nobody, though it is in the graph',
            fix=f'kill -CONT {process}',
        )
    for node in nodes:
        if node.is_silent and not node.is_stopped and not _is_hidden(node.name):
            yield Finding(
                severity=Severity.WARNING,
                rule='frozen_nodes',
                what=f'{node.name} does not answer its parameter services{_place(node)}',
                why='its callbacks are not served: a callback blocks, or nobody spins it',
                fix=_end(node),
            )


def _is_hidden(name: str) -> bool:
    return name.rpartition('/')[2].startswith('_')


def _place(node: GraphNode) -> str:
    return f', and its process {node.process} does nothing' if node.process is not None else ''


def _end(node: GraphNode) -> str:
    if node.process is None:
        return 'start it again, and let no callback wait: no sleep, no synchronous call'
    return (
        f'see where it waits (py-spy dump --pid {node.process}; gdb -p {node.process}), or end it '
        f'(kill -INT {node.process}) and start it again; no callback may wait'
    )


RULES: tuple[Rule, ...] = (
    duplicate_node_names,
    frozen_nodes,
    mismatched_types,
    mismatched_definitions,
    incompatible_qos,
    misnamed_topics,
)
