# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the section ``graph``; of nodes here: names that are there twice, no answers."""

from collections import defaultdict
from collections.abc import Iterator, Sequence

from amr_description.doctor.findings import Finding, Rule, Severity
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.graph import (
    GraphNode,
    ObservedEndpoint,
    STAMPED_TWIST,
    VELOCITY_TYPES,
)
from amr_description.doctor.rules.qos import incompatible_qos
from amr_description.doctor.rules.topic_names import misnamed_topics
from amr_description.doctor.rules.wording import names_of, short_type


def mismatched_types(seen: Observations) -> Iterator[Finding]:
    """
    Publishers and subscriptions of one topic with other types: nothing arrives.

    The classic: ``Twist`` for a controller that takes ``TwistStamped``. Teleop nodes have ``-p
    stamped:=true``, Nav2 has ``enable_stamped_cmd_vel: true``, twist_mux takes both
    (docs/localisation.md#between-planner-and-wheels).
    """
    for topic in seen.graph.topics if seen.graph else ():
        deaf = _unmatched(topic.subscriptions, topic.publishers)
        mute = _unmatched(topic.publishers, topic.subscriptions)
        if not deaf and not mute:
            continue
        subscriptions = deaf or [
            e for e in topic.subscriptions if e.type_name != mute[0].type_name
        ]
        publishers = mute or [e for e in topic.publishers if e.type_name != deaf[0].type_name]
        offered, wanted = publishers[0].type_name, subscriptions[0].type_name
        yield Finding(
            severity=Severity.ERROR,
            rule='mismatched_types',
            what=f'{names_of(publishers)} publishes {short_type(offered, wanted)} on '
            f'{topic.name}, but {names_of(subscriptions)} subscribes to '
            f'{short_type(wanted, offered)}',
            why='DDS connects equal types only: nothing arrives'
            + (', and the robot does not move' if offered in VELOCITY_TYPES else ''),
            fix=_type_fix(topic.name, publishers, offered, wanted),
        )


def mismatched_definitions(seen: Observations) -> Iterator[Finding]:
    """
    One type by name, built of two definitions: a workspace was not built, or not sourced.

    Build the package from the same sources on both sides, source it, and start both nodes again.
    """
    for topic in seen.graph.topics if seen.graph else ():
        ends = [e for e in (*topic.publishers, *topic.subscriptions) if e.type_hash]
        for name in dict.fromkeys(each.type_name for each in ends):
            of_type = [each for each in ends if each.type_name == name]
            hashes = dict.fromkeys(each.type_hash for each in of_type)
            if len(hashes) < 2:
                continue
            parts = [[e for e in of_type if e.type_hash == each] for each in hashes]
            yield Finding(
                severity=Severity.ERROR,
                rule='mismatched_definitions',
                what=f'{name} on {topic.name} is of one definition in {names_of(parts[0])}, and '
                f'of another in {names_of(parts[1])}',
                why='fields are read at the wrong places, or nothing arrives at all',
                fix=f'build {name.partition("/")[0]} from the same sources on both sides (colcon '
                f'build --packages-up-to {name.partition("/")[0]}), source install/setup.bash, '
                'and start both again',
            )


def _unmatched(
    ends: Sequence[ObservedEndpoint], others: Sequence[ObservedEndpoint]
) -> list[ObservedEndpoint]:
    """Return the endpoints of nodes that no other one reaches, as all have another type."""
    if not others:
        return []
    types = {each.type_name for each in others}
    # A node with an endpoint of each type follows the others.
    reached = {each.node for each in ends if each.type_name in types}
    return [each for each in ends if each.type_name not in types and each.node not in reached]


def _type_fix(
    topic: str, publishers: Sequence[ObservedEndpoint], offered: str, wanted: str
) -> str:
    if {offered, wanted} != {*VELOCITY_TYPES}:
        return f'use {wanted} in {names_of(publishers)}, or remap it: -r {topic}:={topic}_2'
    is_stamped = wanted == STAMPED_TWIST
    value = str(is_stamped).lower()
    command = f"ros2 topic pub -r 10 {topic} {wanted} '{_forward(is_stamped)}'"
    return (
        f'publish {short_type(wanted, offered)}: teleop_twist_keyboard -p stamped:={value}, '
        f'Nav2 enable_stamped_cmd_vel: {value}, {command}'
    )


def _forward(is_stamped: bool) -> str:
    twist = '{linear: {x: 0.2}}'
    return f'{{twist: {twist}}}' if is_stamped else twist


def duplicate_node_names(seen: Observations) -> Iterator[Finding]:
    """
    Two nodes of one name have the same services: either of them answers, or both do.

    ``ros2 param set`` reaches one of them, or both. One is left from a run before, or two robots
    share a domain. End one, rename it (``-r __node:=NAME``), or give each robot a namespace or a
    ``ROS_DOMAIN_ID``.
    """
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
    """
    A node that does not serve its callbacks, though it is in the graph.

    Ctrl-Z has stopped it: ``kill -CONT PID``. Or a callback waits, as in a sleep or a synchronous
    service call.
    """
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
