# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a transform must be before it is kept, and signs that two nodes publish the same frame.

The texts that begin with ``TF_`` are tf2's.
"""

from collections import deque
from dataclasses import dataclass
import math

from amr_description.errors import InvalidArgumentException
from amr_description.model.frames import normalize, Transform

DEFAULT_AUTHORITY = 'default_authority'
"""Who published a transform, when that is not known: messages do not carry it."""

_NORM_TOLERANCE = 10e-3  # of the squared length of a quaternion, as in tf2
_CHANGES = 3  # of the parent within the window, before it counts as a quarrel


@dataclass(frozen=True, slots=True)
class StampedTransform:
    """The pose of ``child`` in ``parent`` (``transform_child_to_parent``) at ``time``, ns."""

    parent: str
    child: str
    time: int
    transform: Transform


def checked(stamped: StampedTransform, authority: str) -> StampedTransform:
    """
    Return it with names as tf2 keeps them (no leading ``/``) and a quaternion of length 1.

    Raises InvalidArgumentException: it is of no use.
    """
    parent, child = stamped.parent.removeprefix('/'), stamped.child.removeprefix('/')
    place, turn = stamped.transform.translation, stamped.transform.rotation
    if child == parent:
        raise InvalidArgumentException(
            f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id '
            f'and  child_frame_id "{child}" because they are the same'
        )
    if not child:
        raise InvalidArgumentException(
            f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because '
            f'child_frame_id not set (its frame_id is "{parent}")'
        )
    if not parent:
        raise InvalidArgumentException(
            f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority '
            f'"{authority}" because frame_id not set'
        )
    if not all(map(math.isfinite, (*place, *turn))):
        raise InvalidArgumentException(
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because of a nan value in the transform {numbers(place)} '
            f'{numbers(turn)}'
        )
    if not is_unit(turn):
        raise InvalidArgumentException(
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from '
            f'authority "{authority}" because of an invalid quaternion in the transform '
            f'{numbers(turn)}'
        )
    return StampedTransform(parent, child, stamped.time, Transform(place, normalize(turn)))


def is_unit(rotation: tuple[float, ...]) -> bool:
    """Tell whether tf2 takes a quaternion for one of length 1."""
    return abs(sum(part * part for part in rotation) - 1.0) < _NORM_TOLERANCE


def numbers(values: tuple[float, ...]) -> str:
    """Write a vector or a quaternion as tf2 does: ``(0.000000 0.000000 1.000000)``."""
    return f'({" ".join(f"{value:f}" for value in values)})'


@dataclass(frozen=True, slots=True)
class _Side:
    """One way in which a frame is published."""

    parent: str
    authority: str
    static: bool

    def __str__(self) -> str:
        source = '' if self.authority == DEFAULT_AUTHORITY else f' (from "{self.authority}")'
        return f'{"static" if self.static else "moving"} in "{self.parent}"{source}'


class ParentWatch:
    """
    Notices that a frame is published by more than one.

    A gripper takes a thing, and the thing has a new parent: that is one change. Two nodes that
    both publish a frame change its parent with every message. What is static does not change at
    all, so there once is enough.

    :param window: How long changes count, in stamps, ns.
    """

    def __init__(self, window: int) -> None:
        self._window = window
        self._changes: dict[str, deque[tuple[int, _Side]]] = {}

    def observe(self, stamped: StampedTransform, authority: str, *, static: bool) -> str:
        """Take note of who publishes a frame; return a warning that names both, or nothing."""
        side = _Side(stamped.parent, authority, static)
        changes = self._changes.setdefault(stamped.child, deque(maxlen=_CHANGES + 1))
        if changes and changes[-1][1] == side:
            return ''
        changes.append((stamped.time, side))
        if len(changes) < 2:
            return ''
        former = changes[-2][1]
        is_quarrel = (
            len(changes) > _CHANGES
            and abs(stamped.time - changes[0][0]) <= self._window
            and len({one for _, one in changes}) == 2
        )
        if not (is_quarrel or side.static or former.static):
            return ''
        return (
            f'TF_TWO_PARENTS: frame "{stamped.child}" is published as {former} and as {side}; '
            'the last one heard counts. A frame has one parent: one node may publish it'
        )
