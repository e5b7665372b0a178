# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
When the ROS graph that a verb shows is complete.

Discovery ends at no given moment: DDS finds a participant, each of its endpoints, and what its
nodes are called, in this order or another, and loses packets of any. But on this host all of it
can be counted: Linux knows who listens (``local_participants.py``), and each participant says
which nodes and endpoints it has (``node_lists.py``). Where there may be more, on other hosts or
behind a discovery server, a graph that has been quiet for a while counts as complete.

With our simulation, on a quiet machine, the count is full 0.22 s after the node was made, of which
0.1 s and more are Fast DDS's delay before it answers who asks for endpoints.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Set
import math
import os
import sys
import time as wall

from rclpy.node import Node
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.cli.session import Session
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.local_participants import local_participants, may_have_made
from amr_description.ros.node_lists import (
    NodeList,
    NodeLists,
    PREFIX,
    subscribe_to_node_lists,
    TOPIC,
)
from amr_description.ros.transport import is_udp_only, reaches_other_hosts

_AT_LEAST = 0.5  # s; where completeness is not known
_QUIET = 0.4  # s without changes until discovery is complete; Fast DDS repeats after 0.28 s
_QUIET_WITH_SERVER = 1.5  # s; discovery by a server has several steps, 0.45 s each
_FAREWELL = 0.2  # s after its end in which a participant may still count as found
_SHORTEST_LIFE = 0.1  # s, of a participant
_HOPE = 0.3  # s in which a count on this host is full, as a rule
_LONGEST_DISCOVERY = 5.0  # s; a graph may never stop changing, and Fast DDS may pause for 3 s
_LOOKUP_TIMEOUT = 2.0  # s to wait for a given name
_LOOKUP_TIMEOUT_OF_HOSTS = 4.0  # s, where it may be on another one, which speaks up every 3 s
_POLL = 0.01  # s

_PARAMETER_EVENTS = '/parameter_events'
_HOST = 4  # bytes of a gid: vendor and host

_HINT_AFTER = 2.0  # s of waiting until a hint is looked for, and between two looks


def wait_for_discovery(
    session: Session, at_least: float | None, found: Callable[[], bool] | None = None
) -> None:
    """
    Wait until the graph is complete: it is known to be, or it has been quiet, at most for 5 s.

    Times are those of the session's clock, so that it waits longer where this process has to wait
    its turn.

    Args:
        session: of the verb.
        at_least: shortest time to wait, s; None: no longer than it takes to know, or 0.5 s.
        found: returns whether a wanted name is there. If not, wait for it, up to 2 s in all; where
            it may be on another host, 4 s.
    """
    start = session.clock.now()
    with subscribe_to_node_lists(session.node) as lists:
        count = Count(session, lists) if lists is not None and _is_this_host_all() else None
        quiet = Quiet(session, _AT_LEAST if at_least is None else at_least)

        def is_complete() -> bool:
            waited = session.clock.now() - start
            if count is not None and count.is_full():
                return waited >= (at_least or 0.0)
            if count is None:
                return quiet.is_complete()
            # One has ended before it was found, or one is no ROS: the count is never full.
            return waited >= _HOPE and quiet.is_complete() and count.has_all_of_the_found()

        session.spin(is_complete, max(at_least or 0.0, _LONGEST_DISCOVERY), poll=_POLL)
    if found is not None:
        session.spin(found, start + max(at_least or 0.0, lookup_timeout()) - session.clock.now())


def lookup_timeout() -> float:
    """Return how long to wait for a given name, s."""
    return _LOOKUP_TIMEOUT_OF_HOSTS if reaches_other_hosts() else _LOOKUP_TIMEOUT


def is_there_within(session: Session, is_there: Callable[[], bool], timeout: float | None) -> bool:
    """
    Wait for a node or a server; return whether it is there.

    Args:
        session: of the verb.
        is_there: returns whether it is.
        timeout: how long to wait, s; None: without limit. It is not over before the graph is
            complete: until then nobody knows.
    """
    if session.spin(is_there, timeout):
        return True
    wait_for_discovery(session, 0.0)
    return is_there()


def explained_absence(
    session: Session,
    is_there: Callable[[], bool],
    timeout: float | None,
    explain: Callable[[], str],
) -> str | None:
    """
    Wait for a server, and print why it is not there as soon as that is known.

    Args:
        session: Of the verb.
        is_there: Returns whether it is.
        timeout: How long to wait, s; None: without limit.
        explain: Returns why it is not; '': that is not known.

    Returns:
        None: it is there. Else why not; '' where that was printed, or is not known.
    """
    left = math.inf if timeout is None else timeout
    hint = ''
    while True:
        # Again until something is known: the server may be discovered after the first time.
        wait = left if hint else min(left, _HINT_AFTER)
        if session.spin(is_there, wait):
            return None
        left -= wait
        if left <= 0.0:
            break
        if hint := explain():
            print(f'WARNING: {hint}', file=sys.stderr)
    if is_there_within(session, is_there, 0.0):
        return None
    return '' if hint else explain()


class Count:
    """Counts participants, nodes and endpoints of this host that are there, and that are found."""

    def __init__(self, session: Session, lists: NodeLists) -> None:
        self._clock = session.clock
        self._node = session.node
        self._lists = lists
        self._there = session.participants
        self._been_there = set(session.participants)
        self._looked_at = session.began  # who has been there; s of the wall
        self._unseen: set[bytes] = set()  # has come and gone since
        self._last_end = -math.inf  # s
        self._found: set[bytes] = set()
        self._current: set[bytes] = set()  # is found now, and has not ended

    def is_full(self) -> bool:
        """
        Return whether everything is found.

        A participant that has ended may still count as found, and hide one that is not. So all are
        counted that have been there since before the verb's own: as many have to have been found,
        without those that came and went between two looks. One may have ended before it was found;
        after some time those are counted that run.
        """
        lists = self._lists.newest()
        hosts = {prefix[:_HOST] for prefix in _own(self._node, lists)}
        self._current = set.union(*_participants(self._node))
        # After that: who comes in between is not found yet, and must not stand for another one.
        before, self._there = self._there, local_participants(self._node.context.get_domain_id())
        self._been_there |= self._there
        if before - self._there:
            self._last_end = self._clock.now()
        on_this_host = {each for each in self._current if each[:_HOST] in hosts}
        found = on_this_host - self._found - self._unseen
        before_this, self._looked_at = self._looked_at, wall.monotonic()
        if self._looked_at - before_this > _SHORTEST_LIFE:  # this process had to wait its turn
            self._unseen |= {each for each in found if not may_have_made(each, self._there)}
        self._found |= found - self._unseen
        all_found = len(self._found) >= len(self._been_there)
        if self._been_there > self._there:
            ended = {each for each in on_this_host if not may_have_made(each, self._there)}
            if len(on_this_host) - len(ended) >= len(self._there):
                self._current -= ended
                all_found |= self._clock.now() - self._last_end >= _FAREWELL
        return all_found and self.has_all_of_the_found()

    def has_all_of_the_found(self) -> bool:
        """Return whether of each participant that is found all nodes and endpoints are known."""
        node, current, lists = self._node, self._current, self._lists.newest()
        if any(not current <= ends for ends in (*_participants(node), lists.keys())):
            return False
        nodes = sum((lists[each].nodes for each in current), Counter[tuple[str, str]]())
        if not nodes <= Counter(node.get_node_names_and_namespaces()):
            return False
        others = current - _own(node, lists)
        listed = {gid for each in others for gid in lists[each].endpoints}
        return listed <= _named_endpoints(node) and _have_announcers_names(node, current)


class Quiet:
    """Watches the graph for changes."""

    def __init__(self, session: Session, at_least: float) -> None:
        """``at_least``: shortest time to watch, s."""
        self._clock = session.clock
        self._node = session.node
        self._domain = session.node.context.get_domain_id()
        self._at_least = at_least
        self._quiet = _QUIET_WITH_SERVER if os.environ.get('ROS_DISCOVERY_SERVER') else _QUIET
        self._start = self._last_change = session.clock.now()
        self._known: object = None
        self._there = local_participants(self._domain)

    def is_complete(self) -> bool:
        """
        Return whether all participants of this host are found, and nothing has changed for 0.4 s.

        A participant that has just ended may still count as found, and hide one that is not. On a
        busy machine changes come in batches, so after late changes the wait is longer.
        """
        now = self._clock.now()
        snapshot = _snapshot(self._node)
        if snapshot != self._known:
            self._known, self._last_change = snapshot, now
        quiet = max(self._quiet, (self._last_change - self._start) * 0.5)
        if now - self._start < self._at_least or now - self._last_change < quiet:
            return False
        found = _found(self._node)
        # After that, as in Count: who comes in between must not stand for another one.
        before, self._there = self._there, local_participants(self._domain)
        if before - self._there:
            self._last_change = now
            return False
        return found >= len(self._there)


def _is_this_host_all() -> bool:
    """Return whether everybody that can be found is on this host, and listens to UDP ports."""
    server = os.environ.get('ROS_DISCOVERY_SERVER')
    return not server and not reaches_other_hosts() and is_udp_only()


def _participants(node: Node) -> tuple[set[bytes], set[bytes]]:
    """Return who publishes lists of nodes, and who subscribes to them, by gid prefix."""
    publishers = node.get_publishers_info_by_topic(TOPIC, no_mangle=True)
    subscriptions = node.get_subscriptions_info_by_topic(TOPIC, no_mangle=True)
    return _prefixes(publishers), _prefixes(subscriptions)


def _prefixes(endpoints: Iterable[TopicEndpointInfo]) -> set[bytes]:
    return {bytes(end.endpoint_gid[:PREFIX]) for end in endpoints}


def _own(node: Node, lists: Mapping[bytes, NodeList]) -> set[bytes]:
    """Return the participant of a node, once it is known."""
    name = (node.get_name(), node.get_namespace())
    return {prefix for prefix, each in lists.items() if name in each.nodes}


def _named_endpoints(node: Node) -> set[bytes]:
    """Return the gids of the endpoints that are discovered, and whose node is known."""
    return {
        bytes(end.endpoint_gid)
        for topic, _ in node.get_topic_names_and_types(no_demangle=True)
        for ends in (node.get_publishers_info_by_topic, node.get_subscriptions_info_by_topic)
        for end in ends(topic, no_mangle=True)
        if endpoint_node(end) is not None
    }


def _snapshot(node: Node) -> object:
    """Return a value that is equal as long as the graph does not change."""
    topics = node.get_topic_names_and_types()
    endpoints = [(node.count_publishers(t), node.count_subscribers(t)) for t, _ in topics]
    services = node.get_service_names_and_types()
    return sorted(node.get_node_names_and_namespaces()), topics, endpoints, services


def _found(node: Node) -> int:
    """
    Return how many participants are found with endpoints and nodes.

    Fast DDS discovers a participant and each of its endpoints separately, either up to a second
    later than the other; what its nodes are called comes last, as a message. Each participant of
    ROS both publishes and subscribes to the lists of nodes, and has a node. As long as one has a
    node whose name is not known it is 0.
    """
    if not _have_announcers_names(node):
        return 0
    return min(len(node.get_node_names()), *map(len, _participants(node)))


def _have_announcers_names(node: Node, participants: Set[bytes] | None = None) -> bool:
    """
    Return whether all nodes are known that publish parameter events, as each node does.

    ``participants``: by gid prefix, of which alone it is asked; None: of all.
    """
    return all(
        endpoint_node(publisher) is not None
        for publisher in node.get_publishers_info_by_topic(_PARAMETER_EVENTS)
        if participants is None or bytes(publisher.endpoint_gid[:PREFIX]) in participants
    )
