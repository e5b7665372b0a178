# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The graph: nodes, and who publishes and subscribes to what.

Names of nodes and topics are full. Times are integer ns.
"""

from dataclasses import dataclass

TWIST = 'geometry_msgs/msg/Twist'
STAMPED_TWIST = 'geometry_msgs/msg/TwistStamped'
VELOCITY_TYPES = (TWIST, STAMPED_TWIST)


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedQos:
    """What a publisher offers, or a subscription requests, as far as discovery tells."""

    is_reliable: bool = True
    is_transient_local: bool = False
    is_manual: bool = False
    """Liveliness is ``MANUAL_BY_TOPIC``."""
    deadline: int | None = None
    """None: infinite; ``lease`` too."""
    lease: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedEndpoint:
    """A publisher or a subscription."""

    node: str
    type_name: str
    type_hash: str = ''
    """Empty: not known, as of releases before Iron."""
    qos: ObservedQos = ObservedQos()


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedTopic:
    """All endpoints of a topic, but those of the doctor."""

    name: str
    publishers: tuple[ObservedEndpoint, ...] = ()
    subscriptions: tuple[ObservedEndpoint, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class GraphNode:
    """A node; two of one name are two of these."""

    name: str
    host: str = ''
    """Of another machine, as far as DDS identifies it; empty: this one."""
    process: int | None = None
    """Its process, where it is on this machine and known."""
    is_stopped: bool = False
    """Its process is stopped by a signal, as Ctrl-Z sends it."""
    is_silent: bool = False
    """It was asked for a parameter, did not answer, and its process was idle meanwhile."""
    use_sim_time: bool | None = None
    """None: it has not said so."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedGraph:
    """What discovery shows, without processes that have ended."""

    topics: tuple[ObservedTopic, ...] = ()
    nodes: tuple[GraphNode, ...] = ()

    def topic(self, name: str) -> ObservedTopic:
        """Return a topic; without endpoints, if it is not there."""
        return next((each for each in self.topics if each.name == name), ObservedTopic(name=name))
