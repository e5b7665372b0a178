# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What publishers offer, what subscriptions request: reliability, durability, deadline, liveliness.

DDS connects two only if what is offered is at least what is requested (DDS 1.4, 2.2.3), and says
nothing otherwise.
"""

from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

from amr_description.clock import NANOSECONDS
from amr_description.doctor.findings import Finding, Severity
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.graph import ObservedEndpoint, ObservedQos, ObservedTopic
from amr_description.doctor.rules.wording import names_of


class QosFault(NamedTuple):
    """A policy by which two do not match."""

    policy: str
    offered: str
    requested: str
    to_subscribe: str
    """What a subscription would request to get what is offered."""
    to_publish: str
    """What a publisher would offer to be received."""


def incompatible_qos(seen: Observations) -> Iterator[Finding]:
    """
    What a publisher offers is less than what a subscription requests: nothing arrives.

    Subscribe to sensors with best effort, to ``map`` and ``robot_description`` with transient
    local. Which policies match: docs/doctor.md#which-qos-matches.
    """
    for topic in seen.graph.topics if seen.graph else ():
        for fault, pairs in _incompatible(topic).items():
            publishers = [each for each, _ in pairs]
            subscriptions = [each for _, each in pairs]
            is_deaf = not any(
                each.type_name == end.type_name and not faults(each.qos, end.qos)
                for end in subscriptions
                for each in topic.publishers
            )
            yield Finding(
                severity=Severity.ERROR if is_deaf else Severity.WARNING,
                rule='incompatible_qos',
                what=f'{names_of(publishers)} offers {fault.policy} {fault.offered} on '
                f'{topic.name}, {names_of(subscriptions)} requests {fault.requested}',
                why='a publisher has to offer at least what a subscription requests: between '
                'these nothing arrives',
                fix=f'subscribe with {fault.to_subscribe}, or publish with {fault.to_publish}',
            )


def faults(offered: ObservedQos, requested: ObservedQos) -> list[QosFault]:
    """Return the policies by which two do not match."""
    found = []
    if requested.is_reliable and not offered.is_reliable:
        found.append(_choice('reliability', 'BEST_EFFORT', 'RELIABLE'))
    if requested.is_transient_local and not offered.is_transient_local:
        found.append(_choice('durability', 'VOLATILE', 'TRANSIENT_LOCAL'))
    if _is_longer(offered.deadline, requested.deadline):
        found.append(_time('deadline', offered.deadline, requested.deadline))
    if requested.is_manual and not offered.is_manual:
        found.append(_choice('liveliness', 'AUTOMATIC', 'MANUAL_BY_TOPIC'))
    if _is_longer(offered.lease, requested.lease):
        found.append(_time('liveliness_lease_duration', offered.lease, requested.lease))
    return found


def _choice(policy: str, offered: str, requested: str) -> QosFault:
    return QosFault(policy, offered, requested, offered, requested)


def _time(policy: str, offered: int | None, requested: int | None) -> QosFault:
    one, other = _seconds(offered), _seconds(requested)
    longer = f'no {policy}' if offered is None else f'a {policy} of {one}'
    return QosFault(policy, one, other, longer, f'a {policy} of {other} or less')


def _seconds(time: int | None) -> str:
    return 'infinite' if time is None else f'{time / NANOSECONDS:g} s'


def _is_longer(offered: int | None, requested: int | None) -> bool:
    return requested is not None and (offered is None or offered > requested)


def _incompatible(
    topic: ObservedTopic,
) -> dict[QosFault, list[tuple[ObservedEndpoint, ObservedEndpoint]]]:
    """Return the pairs that do not match, by their faults."""
    found: dict[QosFault, list[tuple[ObservedEndpoint, ObservedEndpoint]]] = {}
    for publisher, subscription in product(topic.publishers, topic.subscriptions):
        # A node that subscribes to what it publishes itself may do so with another QoS.
        if publisher.type_name != subscription.type_name or publisher.node == subscription.node:
            continue
        for fault in faults(publisher.qos, subscription.qos):
            found.setdefault(fault, []).append((publisher, subscription))
    return found
