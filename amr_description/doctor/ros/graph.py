# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Nodes with their processes and answers, and the endpoints of all topics.

A process that was killed stays in the graph for some seconds: what is of it on this machine is
left out.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
import os
from pathlib import Path
import time

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.doctor.observations.graph import (
    GraphNode,
    ObservedEndpoint,
    ObservedGraph,
    ObservedQos,
    ObservedTopic,
)
from amr_description.doctor.ros.probe_context import CLOCK_TOPIC, ProbeContext
from amr_description.doctor.ros.queries import GET_PARAMETERS, ParameterQuery
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.local_participants import local_participants, processes_of
from amr_description.ros.node_lists import PREFIX
from amr_description.ros.rclpy_internals import NodeNameNonExistentError

PATIENCE = 2.0
"""s that a node has to answer, by the system clock."""

_FEWEST_LOOKS = 20
"""Looks for the answer meanwhile: a process that had no time to look may have missed it."""
_REACH = 0.5
"""s until a server is reached, if it is there."""
_MARGIN = 0.3
"""s until a query is asked."""
_PARAMETER_EVENTS = '/parameter_events'
_HOST = 4
"""Bytes of a gid: vendor and host."""
_INFINITE = 2**62
"""ns: a time from here on is none, whatever the middleware writes."""
_IDLE_SHARE = 0.05
"""Of a core: a process that takes less, and does not wait for a core, does nothing."""
_HIDDEN = '_'
_ACTION = '/_action/'
_CLIENTS = '_rclcpp_node'
_STANDARD = (
    'describe_parameters',
    'get_logger_levels',
    'get_parameter_types',
    'get_parameters',
    'get_type_description',
    'list_parameters',
    'set_logger_levels',
    'set_parameters',
    'set_parameters_atomically',
)
"""Services of every node."""
_NAMELESS = 'a node without a name'
_TICKS = os.sysconf('SC_CLK_TCK')


class GraphProbe:
    """Observes nodes and topics."""

    def begin(self, context: ProbeContext) -> None:
        """Ask all nodes for ``use_sim_time``."""
        self._context, self._node = context, context.node
        node = context.node
        self._own = node.get_fully_qualified_name()
        self._began = time.monotonic()
        self._queries: dict[str, ParameterQuery] = {}
        for service, _ in node.get_service_names_and_types():
            name = service.removesuffix(GET_PARAMETERS)
            if name not in (service, self._own) and not _is_hidden(name):
                self._queries[name] = self._context.ask(name, ['use_sim_time'])
        host = self._own_host()
        self._work = {
            pid: _work_of(pid)
            for name, prefix in self._announcers()
            if name in self._queries and prefix[:_HOST] == host
            for pid in processes_of(prefix)
        }

    @property
    def is_done(self) -> bool:
        """Whether all nodes have answered, or have had time to."""
        waited = time.monotonic() - self._began
        open_ones = [each for each in self._queries.values() if each.response is None]
        if waited > _REACH:
            open_ones = [each for each in open_ones if each.is_reachable()]
        return not open_ones or waited > PATIENCE + _MARGIN

    def observe(self) -> ObservedGraph:
        """Return the graph."""
        host = self._own_host()
        node = self._node
        found = {
            name: (
                node.get_publishers_info_by_topic(name),
                node.get_subscriptions_info_by_topic(name),
            )
            for name, _ in sorted(node.get_topic_names_and_types())
        }
        ends = (each for both in found.values() for listed in both for each in listed)
        prefixes = {bytes(each.endpoint_gid[:PREFIX]) for each in ends}
        here = {each for each in prefixes if host is not None and each[:_HOST] == host}
        running = prefixes - here | running_of(here, node.context.get_domain_id())
        topics = tuple(
            ObservedTopic(
                name=name,
                publishers=self._ends(publishers, running),
                subscriptions=self._ends(subscriptions, running),
            )
            for name, (publishers, subscriptions) in found.items()
        )
        graph = ObservedGraph(topics=topics, nodes=tuple(self._nodes(host, running)))
        return graph

    # --- nodes --------------------------------------------------------------------------------

    def _own_host(self) -> bytes | None:
        """Return what the gids of this machine begin with; None: not known."""
        own = (prefix for name, prefix in self._announcers() if name == self._own)
        return next((prefix[:_HOST] for prefix in own), None)

    def _announcers(self) -> list[tuple[str, bytes]]:
        """Return nodes and their participants, by the topic that every node publishes."""
        return [
            (endpoint_node(each) or _NAMELESS, bytes(each.endpoint_gid[:PREFIX]))
            for each in self._node.get_publishers_info_by_topic(_PARAMETER_EVENTS)
        ]

    def _nodes(self, host: bytes | None, running: Collection[bytes]) -> Iterator[GraphNode]:
        names = Counter(_full(*each) for each in self._node.get_node_names_and_namespaces())
        announcers = self._announcers()
        for name in sorted(names.keys() - {self._own}):
            places = [prefix for each, prefix in announcers if each == name]
            for prefix in places:
                is_here = host is None or prefix[:_HOST] == host
                pids = processes_of(prefix) if is_here else []
                if pids or not is_here or prefix in running:
                    place = '' if is_here else prefix[:_HOST].hex()
                    yield self._described(name, pids[0] if len(pids) == 1 else None, place)
            if not places:  # it has no such publisher, or one that was not discovered yet
                yield from (self._described(name, None, '') for _ in range(names[name]))

    def _described(self, name: str, pid: int | None, host: str) -> GraphNode:
        query = self._queries.get(name)
        value = (query.values or {}).get('use_sim_time') if query else None
        state = _states(pid) if pid is not None else set()
        return GraphNode(
            name=name,
            host=host,
            process=pid,
            is_stopped='T' in state,
            is_silent=self._is_silent(name, query, pid, state),
            use_sim_time=value if isinstance(value, bool) else None,
        )

    def _is_silent(
        self, name: str, query: ParameterQuery | None, pid: int | None, state: set[str]
    ) -> bool:
        if query is None or query.values is not None or query.asked is None:
            return False
        waited = time.monotonic() - query.asked
        if waited < PATIENCE or query.looks < _FEWEST_LOOKS:
            return False
        if pid is None or not serves(self._node, name):
            return False  # of another host it is not known whether it is only busy
        # One that is busy, or waits for a core, will answer.
        is_waiting = state & {'R', 'D'}
        worked = _work_of(pid) - self._work.get(pid, 0.0)
        return not is_waiting and worked < _IDLE_SHARE * (time.monotonic() - self._began)

    # --- topics -------------------------------------------------------------------------------

    def _ends(
        self, found: Iterable[TopicEndpointInfo], running: Collection[bytes]
    ) -> tuple[ObservedEndpoint, ...]:
        """Return the endpoints of others whose participant runs."""
        return tuple(
            ObservedEndpoint(
                node=endpoint_node(each) or _NAMELESS,
                type_name=each.topic_type,
                type_hash=_hash_of(each),
                qos=qos_of(each.qos_profile),
            )
            for each in found
            if endpoint_node(each) != self._own and bytes(each.endpoint_gid[:PREFIX]) in running
        )


def running_of(prefixes: Collection[bytes], domain: int) -> set[bytes]:
    """
    Return the participants of this host that run, of those that are in the graph.

    A process that was killed stays in the graph for some seconds. Of a container with the network
    of the host, or with hidepid, processes are not seen, though their sockets are: where there are
    more participants than processes, it is not known which have ended, and all are taken to run.
    """
    known = {each for each in prefixes if processes_of(each)}
    is_sure = len(local_participants(domain)) <= len(known)
    return known if is_sure else {*prefixes}


def serves(node: Node, name: str) -> bool:
    """
    Return whether a node of the graph has callbacks of its own: services, or subscriptions.

    Many scripts only publish, and are never spun; Nav2's ``bt_navigator`` spins the nodes of its
    clients only while it navigates.
    """
    namespace, _, last = name.rpartition('/')
    if last.endswith(_CLIENTS):
        return False
    try:
        services = node.get_service_names_and_types_by_node(last, namespace or '/')
        topics = node.get_subscriber_names_and_types_by_node(last, namespace or '/')
    except NodeNameNonExistentError:
        return False
    if {each for each, _ in services} - {f'{name}/{each}' for each in _STANDARD}:
        return True
    subscribed = {each for each, _ in topics} - {_PARAMETER_EVENTS, CLOCK_TOPIC}
    return any(_ACTION not in each for each in subscribed)


def qos_of(profile: QoSProfile) -> ObservedQos:
    """Return what rules compare of a discovered QoS."""
    return ObservedQos(
        is_reliable=profile.reliability is not ReliabilityPolicy.BEST_EFFORT,
        is_transient_local=profile.durability is DurabilityPolicy.TRANSIENT_LOCAL,
        is_manual=profile.liveliness is LivelinessPolicy.MANUAL_BY_TOPIC,
        deadline=_finite(profile.deadline.nanoseconds),
        lease=_finite(profile.liveliness_lease_duration.nanoseconds),
    )


def _finite(time: int) -> int | None:
    return time if 0 < time < _INFINITE else None


def _hash_of(end: TopicEndpointInfo) -> str:
    """Return the hash of an endpoint's type; '': it has none, as before Iron."""
    found = end.topic_type_hash
    return bytes(found.value).hex() if found.version > 0 else ''


def _is_hidden(name: str) -> bool:
    return name.rpartition('/')[2].startswith(_HIDDEN)


def _full(name: str, namespace: str) -> str:
    return f'{namespace.rstrip("/")}/{name}'


@dataclass(frozen=True, slots=True)
class _Stat:
    """Of ``/proc/PID/stat``, proc(5)."""

    state: str
    work: float
    """s of processor time."""


def _stat(path: Path) -> _Stat | None:
    try:
        # The name in parentheses is any bytes.
        fields = path.read_bytes().rpartition(b')')[2].decode().split()
    except OSError:
        return None
    return _Stat(fields[0], (int(fields[11]) + int(fields[12])) / _TICKS)


def _work_of(pid: int) -> float:
    """Return the processor time of a process, s."""
    found = _stat(Path(f'/proc/{pid}/stat'))
    return found.work if found else 0.0


def _states(pid: int) -> set[str]:
    """Return the states of the threads of a process: R, S, D, T, as in ``ps``."""
    found = (_stat(path) for path in Path(f'/proc/{pid}/task').glob('*/stat'))
    return {each.state for each in found if each}
