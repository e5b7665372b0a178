# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rates and order of stamps, and the time at which something was received."""

from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise
from statistics import median

from amr_description.clock import NANOSECONDS
from amr_description.navigation.contract.findings import CheckOutcome, failed
from amr_description.navigation.contract.observations import ContractEndpoint, ContractTopic, Tick

_SHOWN = 4


def mean_rate(times: Sequence[int]) -> float:
    """Return the mean rate, Hz, of two instants or more, ns; 0: all are the same."""
    span = times[-1] - times[0]
    return (len(times) - 1) * NANOSECONDS / span if span > 0 else 0.0


def usual_rate(times: Sequence[int]) -> float:
    """
    Return the rate, Hz, of two instants or more by their median interval.

    What is lost on the way of messages that are sent by best effort hardly changes it.
    """
    interval = median(later - earlier for earlier, later in pairwise(times))
    return NANOSECONDS / interval if interval > 0 else 0.0


def not_after(times: Sequence[int]) -> list[tuple[int, int]]:
    """Return each pair of successive instants of which the second is not later."""
    return [(earlier, later) for earlier, later in pairwise(times) if later <= earlier]


def clock_around(ticks: Sequence[Tick], received: int) -> tuple[int, int] | None:
    """
    Return the robot's time at the tick before and at the one after a moment of reception, ns.

    A message that is sent within a tick may come before the tick's own message. None: there is no
    tick before or after it.
    """
    place = bisect_right(ticks, received, key=lambda tick: tick.received)
    if place in (0, len(ticks)):
        return None
    return ticks[place - 1].time, ticks[place].time


def seconds(time: int) -> str:
    """Return a time as text, s."""
    return f'{time / NANOSECONDS:.3f} s'


def names_of(endpoints: Sequence[ContractEndpoint]) -> str:
    """Return the nodes of endpoints, each once."""
    return ', '.join(dict.fromkeys(each.node for each in endpoints)) or 'nobody'


def absence_of(
    topic: ContractTopic,
    type_name: str,
    duration: float,
    who: str,
    elsewhere: Sequence[ContractTopic],
) -> CheckOutcome:
    """
    Return the outcome of a demand on messages that did not come, and why they did not.

    Args:
        topic: on which they should have come.
        type_name: that they should have had.
        duration: s that was waited.
        who: usually publishes it.
        elsewhere: other topics with messages of this type.
    """
    if not topic.publishers:
        if not elsewhere:
            return failed(f'nobody publishes {topic.name}', who)
        there = [f'{names_of(each.publishers)} on {each.name}' for each in elsewhere]
        more = f' and {len(there) - _SHOWN} more' if len(there) > _SHOWN else ''
        places = '; '.join(there[:_SHOWN]) + more
        remap = f'-r {topic.name.rpartition("/")[2]}:={elsewhere[0].name}'
        advice = f'publish it there, or remap it, here and for Nav2: {remap}'
        return failed(f'nobody publishes {topic.name}; {places}', advice)
    others = [each for each in topic.publishers if each.type_name != type_name]
    if len(others) == len(topic.publishers):
        kinds = ', '.join(dict.fromkeys(each.type_name for each in others))
        return failed(f'{names_of(others)} publishes {kinds} on {topic.name}', f'use {type_name}')
    return failed(
        f'no message on {topic.name} in {duration:.0f} s, of {names_of(topic.publishers)}',
        'start the sensor or the controller, and the time of the simulation if it stands still',
    )
