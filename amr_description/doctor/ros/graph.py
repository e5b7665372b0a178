# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Nodes with their processes and answers, and the endpoints of all topics.

A process that was killed stays in the graph for some seconds: what is of it on this machine is
left out.
"""

from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
import os
from pathlib import Path
import time

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.doctor.observations.graph import Endpoint, Graph, GraphNode, Qos, Topic
from amr_description.doctor.ros.shared import GET_PARAMETERS, Question, Shared, shared_of
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.local_participants import processes_of
from amr_description.ros.node_lists import NodeList, NodeLists, PREFIX, subscribe_to_node_lists

PATIENCE = 2.0
"""s that a node has to answer, by the system clock."""

_FEWEST_LOOKS = 60
"""Looks for the answer meanwhile: a process that had no time to look may have missed it."""
_LIST_PATIENCE = 1.0
"""s until the lists of nodes have come."""
_HOST = 4
"""Bytes of a gid: vendor and host."""
_INFINITE = 2**62
"""ns: a time from here on is none, whatever the middleware writes."""
_IDLE_SHARE = 0.05
"""Of a core: a process that takes less, and does not wait for a core, does nothing."""
_HIDDEN = '_'
_NAMELESS = 'a node without a name'
_TICKS = os.sysconf('SC_CLK_TCK')


class GraphProbe:
    """Observes nodes and topics."""

    def begin(self, node: Node) -> None:
        """Ask all nodes for ``use_sim_time``, and look which process each is of."""
        self._node = node
        self._shared: Shared = shared_of(node)
        self._began = time.monotonic()
        self._stack = ExitStack()
        self._lists: NodeLists | None = self._stack.enter_context(subscribe_to_node_lists(node))
        self._questions: dict[str, Question] = {}
        self._work: dict[int, float] = {}
        own = node.get_fully_qualified_name()
        for service, _ in node.get_service_names_and_types():
            name = service.removesuffix(GET_PARAMETERS)
            if name not in (service, own) and not _is_hidden(name):
                self._questions[name] = self._shared.ask(name, ['use_sim_time'])

    @property
    def is_done(self) -> bool:
        """Whether all nodes have answered, or have had time to, and their processes are known."""
        waited = time.monotonic() - self._began
        processes = self._processes()
        for pid in {pid for pid, _ in processes.values() if pid is not None} - self._work.keys():
            self._work[pid] = _work_of(pid)
        answered = [question.is_answered() for question in self._questions.values()]
        names = {_full(*each) for each in self._node.get_node_names_and_namespaces()}
        has_lists = names <= processes.keys() or waited > _LIST_PATIENCE
        return has_lists and (all(answered) or waited > PATIENCE + _LIST_PATIENCE)

    def observe(self) -> Graph:
        """Return the graph."""
        self.is_done  # noqa: B018  # takes the answers that have come since
        ended = self._ended()
        graph = Graph(topics=self._topics(ended), nodes=tuple(self._nodes(ended)))
        self._stack.close()
        self._shared.release()
        return graph

    # --- nodes --------------------------------------------------------------------------------

    def _newest(self) -> Mapping[bytes, NodeList]:
        return self._lists.newest() if self._lists is not None else {}

    def _own_host(self) -> bytes | None:
        """Return what the gids of this machine begin with; None: not known."""
        own = (self._node.get_name(), self._node.get_namespace())
        return next((p[:_HOST] for p, each in self._newest().items() if own in each.nodes), None)

    def _processes(self) -> dict[str, tuple[int | None, str]]:
        """Return process and host of the nodes, by full name, of which some may have two."""
        return {name: (pid, host) for name, pid, host in self._places()}

    def _places(self) -> list[tuple[str, int | None, str]]:
        """Return name, process and host of each node that is listed; None: not known."""
        host = self._own_host()
        found = []
        for prefix, each in self._newest().items():
            is_here = host is None or prefix[:_HOST] == host
            pids = processes_of(prefix) if is_here else []
            if is_here and not pids:
                continue
            pid = pids[0] if len(pids) == 1 else None
            place = '' if is_here else prefix[:_HOST].hex()
            found += [(_full(*name), pid, place) for name in each.nodes.elements()]
        return found

    def _ended(self) -> set[bytes]:
        """Return the participants of this machine whose processes have ended, by gid prefix."""
        host = self._own_host()
        prefixes = {each for each in self._newest() if host is not None and each[:_HOST] == host}
        return {prefix for prefix in prefixes if not processes_of(prefix)}

    def _nodes(self, ended: set[bytes]) -> Iterable[GraphNode]:
        own = self._node.get_fully_qualified_name()
        known = self._node.get_node_names_and_namespaces()
        names = [_full(*each) for each in known]
        places = [each for each in self._places() if each[0] in names]
        gone = {_full(*name) for prefix in ended for name in self._newest()[prefix].nodes}
        listed = {name for name, _, _ in places} | gone
        places += [(name, None, '') for name in names if name not in listed]
        for name, pid, host in sorted(places, key=lambda each: each[0]):
            if name == own:
                continue
            question = self._questions.get(name)
            value = (question.values or {}).get('use_sim_time') if question else None
            state = _states(pid) if pid is not None else set()
            yield GraphNode(
                name=name,
                host=host,
                process=pid,
                is_stopped='T' in state,
                is_silent=self._is_silent(question, pid, state),
                use_sim_time=value if isinstance(value, bool) else None,
            )

    def _is_silent(self, question: Question | None, pid: int | None, state: set[str]) -> bool:
        if question is None or question.values is not None or question.asked is None:
            return False
        waited = time.monotonic() - question.asked
        if waited < PATIENCE or question.looks < _FEWEST_LOOKS:
            return False
        if pid is None:
            return True
        # One that is busy, or waits for a core, will answer.
        is_waiting = state & {'R', 'D'}
        worked = _work_of(pid) - self._work.get(pid, 0.0)
        return not is_waiting and worked < _IDLE_SHARE * (time.monotonic() - self._began)

    # --- topics -------------------------------------------------------------------------------

    def _topics(self, ended: set[bytes]) -> tuple[Topic, ...]:
        node = self._node
        return tuple(
            Topic(
                name=name,
                publishers=self._ends(node.get_publishers_info_by_topic(name), ended),
                subscriptions=self._ends(node.get_subscriptions_info_by_topic(name), ended),
            )
            for name, _ in sorted(node.get_topic_names_and_types())
        )

    def _ends(self, found: Iterable[TopicEndpointInfo], ended: set[bytes]) -> tuple[Endpoint, ...]:
        own = self._node.get_fully_qualified_name()
        return tuple(
            Endpoint(
                node=endpoint_node(each) or _NAMELESS,
                type_name=each.topic_type,
                type_hash=_hash_of(each),
                qos=qos_of(each.qos_profile),
            )
            for each in found
            if endpoint_node(each) != own and bytes(each.endpoint_gid[:PREFIX]) not in ended
        )


def qos_of(profile: QoSProfile) -> Qos:
    """Return what rules compare of a discovered QoS."""
    return Qos(
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
        fields = path.read_text().rpartition(')')[2].split()
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
