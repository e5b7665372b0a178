# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Topics whose names are nearly the same: a namespace more or less, or a letter."""

from collections.abc import Iterator
from itertools import product
import re

from amr_description.doctor.findings import Finding, Severity
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.graph import (
    ObservedTopic,
    STAMPED_TWIST,
    TWIST,
    VELOCITY_TYPES,
)
from amr_description.doctor.rules.wording import names_of, short_type

_LONG_NAME = 6
"""Characters: in words as long as this, two may differ; in shorter ones, one."""
_SHORTEST_NAME = 3
_MOST_TOPICS = 300
_OPPOSITES = ({'local', 'global'}, {'min', 'max'})
"""First words of names, by few letters apart, that mean two things."""


def misnamed_topics(seen: Observations) -> Iterator[Finding]:
    """
    Nobody publishes what is subscribed to, but nearly so, and nobody hears that.

    A namespace differs, as in ``/cmd_vel`` and ``/diff_drive_controller/cmd_vel``, or a letter.
    Remap one of them.
    """
    topics = seen.graph.topics if seen.graph else ()
    unheard = [t for t in topics if t.publishers and not t.subscriptions]
    unpublished = [t for t in topics if t.subscriptions and not t.publishers]
    if len(unheard) > _MOST_TOPICS or len(unpublished) > _MOST_TOPICS:
        return
    for here, there in product(unheard, unpublished):
        kinds = {e.type_name for e in here.publishers}, {e.type_name for e in there.subscriptions}
        are_velocities = all(kind & {*VELOCITY_TYPES} for kind in kinds)
        if not (kinds[0] & kinds[1] or are_velocities) or not is_near(here.name, there.name):
            continue
        yield _near_miss(here, there, *kinds)


def is_near(one: str, other: str) -> bool:
    """
    Return whether one name is probably meant to be the other.

    It is in a namespace more or less, ``/cmd_vel`` and ``/robot1/cmd_vel``; or one of its words is
    written otherwise by a letter or two. Names that differ in numbers are not.
    """
    if one.endswith(other) or other.endswith(one):
        return True
    first, second = one.split('/'), other.split('/')
    if len(first) != len(second):
        return False
    differing = [pair for pair in zip(first, second, strict=True) if pair[0] != pair[1]]
    if len(differing) != 1:
        return False
    word, written = differing[0]
    if {word.partition('_')[0], written.partition('_')[0]} in _OPPOSITES:
        return False
    if re.sub(r'\d', '', word) == re.sub(r'\d', '', written):
        return False
    shorter = min(len(word), len(written))
    most = 2 if shorter >= _LONG_NAME else 1
    return shorter >= _SHORTEST_NAME and distance(word, written) <= most


def distance(one: str, other: str) -> int:
    """Return how many letters are added, left out, replaced, or swapped with their neighbour."""
    before: list[int] = []
    last = list(range(len(other) + 1))
    for i, a in enumerate(one, 1):
        row = [i]
        for j, b in enumerate(other, 1):
            cost = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (a != b))
            if i > 1 and j > 1 and a == other[j - 2] and one[i - 2] == b:
                cost = min(cost, before[j - 2] + 1)
            row.append(cost)
        before, last = last, row
    return last[-1]


def _near_miss(
    here: ObservedTopic, there: ObservedTopic, offered: set[str], wanted: set[str]
) -> Finding:
    publisher, subscription = names_of(here.publishers), names_of(there.subscriptions)
    fix = (
        f'start {publisher} with --ros-args -r {here.name}:={there.name}, or {subscription} with '
        f'-r {there.name}:={here.name}'
    )
    if not offered & wanted:
        kind = next(iter(wanted & {*VELOCITY_TYPES}))
        other = TWIST if kind == STAMPED_TWIST else STAMPED_TWIST
        fix += f'; and publish {short_type(kind, other)}, not {short_type(other, kind)}'
    return Finding(
        severity=Severity.ERROR if offered & {*VELOCITY_TYPES} else Severity.WARNING,
        rule='misnamed_topics',
        what=f'{publisher} publishes {here.name}, which nobody subscribes to; {subscription} '
        f'subscribes to {there.name}, which nobody publishes',
        why='topics are equal only letter for letter, with their namespaces: nothing arrives',
        fix=fix,
    )
