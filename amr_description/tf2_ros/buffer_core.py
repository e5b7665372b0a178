# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a transform must be before it is kept, and signs that two nodes publish the same frame.

The texts that begin with ``TF_`` are tf2's.

A memory of transforms between frames, as tf2's: where each frame is in any other, and was.

::

    buffer = TransformBuffer()
    buffer.set_transform(StampedTransform('odom', 'base_link', time, transform_base_to_odom))
    buffer.set_transform(StampedTransform('base_link', 'laser', 0, laser_to_base), static=True)
    buffer.lookup('odom', 'laser', time).transform.apply(point_in_laser)  # the point in odom

The transform that is looked up takes coordinates from ``source`` to ``target``: it is the pose of
``source`` in ``target``. Times are integer nanoseconds; 0 asks for the latest time that is known
of all transforms on the way. Between two samples positions go straight and rotations turn evenly.

Errors are those of tf2, in its words, and then say what tf2 leaves to be found out: which
transform on the way is the late one, what the trees are, which known name is near.

Not safe to use from several threads at once: its owner locks.
"""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
import math

from amr_description.clock import NANOSECONDS
from amr_description.errors import (
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from amr_description.model.frames import normalize, Transform
from amr_description.text import closest_match
from amr_description.tf2_ros.frame_graph import FrameRecord, FrameTree, listed, loop_error
from amr_description.tf2_ros.time_cache import (
    Frame,
    LATEST,
    seconds,
    StampedTransform,
    TimeCache,
    TransformStorage,
)

DEFAULT_AUTHORITY = 'default_authority'
"""Who published a transform, when that is not known: messages do not carry it."""

_NORM_TOLERANCE = 10e-3  # of the squared length of a quaternion, as in tf2
_CHANGES = 3  # of the parent within the window, before it counts as a quarrel


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


CACHE_TIME = 10 * NANOSECONDS
"""ns: how long tf2 remembers."""

_NEAR = 0.75  # difflib's ratio: a slip of the pen, not just the same ending


@dataclass(frozen=True, slots=True)
class Remark:
    """What should be said about a transform that came in."""

    text: str
    is_refused: bool
    """It was not taken; otherwise it was, but something is wrong."""
    matter: tuple[str, str]
    """Kind and frame; remarks about one matter need not be said all the time."""


class BufferCore:
    """
    The memory; see the module.

    :param cache_time: How long the past is kept before the latest of a frame, ns.
    """

    def __init__(self, cache_time: int = CACHE_TIME) -> None:
        self.cache_time = cache_time
        self._tree = FrameTree(cache_time)
        self._watch = ParentWatch(cache_time)

    @property
    def names(self) -> list[str]:
        """All frames, in the order in which they came up."""
        return self._tree.names

    def records(self) -> list[FrameRecord]:
        """Tell of all frames that have a parent, in the order in which they came up."""
        return self._tree.records()

    def trees(self) -> Mapping[str, list[str]]:
        """Return the roots, each with the other frames of its tree."""
        return self._tree.trees()

    def set_transform(
        self,
        stamped: StampedTransform,
        authority: str = DEFAULT_AUTHORITY,
        *,
        static: bool = False,
    ) -> Remark | None:
        """
        Take a transform; return what there is to say about it.

        A static transform is good for all times, whatever its own; it replaces what was known of
        its child, and is replaced by a moving one.
        """
        try:
            stamped = checked(stamped, authority)
        except InvalidArgumentException as error:
            text = str(error)
            return Remark(text, True, (text.partition(':')[0], stamped.child))
        if not self._tree.insert(stamped, authority, static=static):
            text = (
                f'TF_OLD_DATA ignoring data from the past for frame {stamped.child} at time '
                f'{seconds(stamped.time)} according to authority {authority}; the latest is at '
                f'{seconds(self._tree.get(stamped.child).latest_time)}'
            )
            return Remark(text, True, ('TF_OLD_DATA', stamped.child))
        warning = self._watch.observe(stamped, authority, static=static)
        return Remark(warning, False, ('TF_TWO_PARENTS', stamped.child)) if warning else None

    def clear(self) -> None:
        """Forget all that moves, as when time goes back; static transforms stay."""
        self._tree.forget_moving()
        self._watch = ParentWatch(self.cache_time)

    def lookup(self, target: str, source: str, time: int = LATEST) -> StampedTransform:
        """
        Return ``transform_source_to_target`` at ``time``; its ``parent`` is the target.

        :raises LookupException: A frame is not known, or there is a loop above it.
        :raises ConnectivityException: They are in different trees.
        :raises ExtrapolationException: Not enough is known for that time.
        :raises InvalidArgumentException: An empty name, or one that begins with ``/``.
        """
        if target == source:
            frame = self._tree.get(target)
            known = frame.latest_time if frame and time == LATEST else time
            return StampedTransform(target, source, known, Transform())
        self._require(target_frame=target, source_frame=source)
        if time == LATEST:
            time = self.latest_common_time(target, source)
        return StampedTransform(target, source, time, self._transform(target, source, time))

    def lookup_full(
        self, target: str, target_time: int, source: str, source_time: int, fixed: str
    ) -> StampedTransform:
        """
        Return the transform from ``source`` as it was then to ``target`` at another time.

        ``fixed``: the frame that stands still in between, such as ``odom``. Raises as
        :meth:`lookup`.
        """
        self._require(target_frame=target, source_frame=source, fixed_frame=fixed)
        before = self.lookup(fixed, source, source_time).transform
        after = self.lookup(target, fixed, target_time)
        return StampedTransform(target, source, after.time, after.transform @ before)

    def obstacle(self, target: str, source: str, time: int = LATEST) -> str:
        """Say, in the words of tf2's ``canTransform``, why :meth:`lookup` would fail; or ''."""
        if target == source:
            return ''
        for argument, frame in (('target_frame', target), ('source_frame', source)):
            fault = _fault_of(frame) or self._absence_of(frame)
            if fault:
                where = f'passed to canTransform argument {argument}'
                return f'Invalid frame ID "{frame}" {where} - {fault}'
        try:
            self.lookup(target, source, time)
        except TransformException as error:
            return str(error)
        return ''

    def latest_common_time(self, target: str, source: str) -> int:
        """Return the latest time that is known on the whole way, ns; 0: nothing there moves."""
        self._require(target_frame=target, source_frame=source)
        down, up = self._tree.ways(target, source)
        frames = [self._tree.get(name) for name in (*down[:-1], *up[:-1])]
        times = (frame.latest_time for frame in frames)  # 0 of what is static
        return min((time for time in times if time != LATEST), default=LATEST)

    def chain(self, target: str, source: str) -> list[str]:
        """Return the frames on the way from ``target`` to ``source``, both included."""
        self._require(target_frame=target, source_frame=source)
        down, up = self._tree.ways(target, source)
        return [*down, *reversed(up[:-1])]

    def _transform(self, target: str, source: str, time: int) -> Transform:
        """Climb from both; where the ways meet, one goes on and the other back."""
        way = f'frame [{source}] to frame [{target}]'
        reached = {source: Transform()}  # transform_source_to_… itself and its ancestors
        late: ExtrapolationException | None = None
        name = source
        while name != target and (frame := self._tree.get(name)):
            try:
                sample = _sample(name, frame, time, way)
            except ExtrapolationException as error:
                late = error  # it does not matter if the ways meet below
                break
            name = _climb(name, sample, reached)
        passed = {target: Transform()}  # transform_target_to_… likewise
        name = target
        while name not in reached:
            frame = self._tree.get(name)
            if not frame:
                raise late or self._tree.unconnected(target, source)
            name = _climb(name, _sample(name, frame, time, way), passed)
        return passed[name].inverse() @ reached[name]

    def _require(self, **names: str) -> None:
        """Raise unless the names are those of known frames."""
        for argument, frame in names.items():
            where = f'passed to lookupTransform argument {argument}'
            if fault := _fault_of(frame):
                raise InvalidArgumentException(f'Invalid argument "{frame}" {where} - {fault}')
            if frame not in self._tree:
                raise LookupException(f'"{frame}" {where} does not exist. {self._others(frame)}')

    def _absence_of(self, frame: str) -> str:
        return '' if frame in self._tree else f'frame does not exist. {self._others(frame)}'

    def _others(self, frame: str) -> str:
        """What there is instead of a frame."""
        if match := closest_match(frame, self._tree.names, _NEAR):
            return f"Did you mean '{match}'?"
        return f'Known are: {listed(self._tree.names) or "none yet"}'


def _sample(name: str, frame: Frame, time: int, way: str) -> TransformStorage:
    """Return where a frame was. Raises ExtrapolationException, which names it."""
    try:
        return frame.at(time)
    except ExtrapolationException as error:
        gap = frame.gap_to(time) if isinstance(frame, TimeCache) else 0
        raise ExtrapolationException(
            f"{error}, when looking up transform from {way}; it is '{name}' in "
            f"'{frame.latest.parent}' that lacks {seconds(gap)} s"
        ) from error


def _climb(name: str, sample: TransformStorage, reached: dict[str, Transform]) -> str:
    """Add the parent to what was reached from below, and return it. Raises LookupException."""
    if sample.parent in reached:
        raise loop_error(list(reached), sample.parent)
    reached[sample.parent] = sample.transform @ reached[name]
    return sample.parent


def _fault_of(frame: str) -> str:
    if not frame:
        return 'in tf2 frame_ids cannot be empty'
    if frame.startswith('/'):
        return "in tf2 frame_ids cannot start with a '/'"
    return ''
