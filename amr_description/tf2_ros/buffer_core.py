# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The transforms between frames over the last seconds, as in tf2's ``BufferCore``.

::

    buffer = BufferCore()
    buffer.set_transform(StampedTransform('odom', 'base_link', time, transform_base_to_odom))
    buffer.set_transform(StampedTransform('base_link', 'laser', 0, laser_to_base), static=True)
    laser_to_odom = buffer.lookup_transform('odom', 'laser', time).transform
    laser_to_odom.apply(point_in_laser)  # the same point in odom

The transform that is looked up takes coordinates from ``source`` to ``target``: it is the pose of
``source`` in ``target``. Times are integer nanoseconds; 0 asks for the latest time at which all
transforms between the two frames are known. Between two samples positions are interpolated
linearly and rotations spherically.

Errors have the text of tf2, those that begin with ``TF_`` included, and add what tf2 leaves out:
which transform of the chain is late, which frames the trees have, which known name is similar.

Not safe to use from several threads at once: the caller locks.
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
from amr_description.tf2_ros.frame_graph import FrameRecord, FrameTree, loop_error, shortened
from amr_description.tf2_ros.time_cache import (
    Frame,
    LATEST,
    seconds,
    StampedTransform,
    TimeCache,
    TransformStorage,
)

CACHE_TIME = 10 * NANOSECONDS
"""ns: how long transforms are kept by default, as in tf2."""

DEFAULT_AUTHORITY = 'default_authority'
"""The publisher of a transform where it is not known: messages do not carry it."""

_SIMILARITY = 0.75  # difflib's ratio: a slip of the pen, not just the same ending
_NORM_TOLERANCE = 10e-3  # of the squared length of a quaternion, as in tf2
_CHANGES = 3  # of the parent within the window, before it counts as a conflict


@dataclass(frozen=True, slots=True)
class InputWarning:
    """What is wrong with a transform that was set."""

    text: str
    is_refused: bool
    """Whether the transform was ignored."""
    key: tuple[str, str]
    """Kind and frame, by which repeated warnings can be throttled."""


class BufferCore:
    """
    See the module.

    Args:
        cache_time: how long transforms are kept before the latest of their frame, ns.
    """

    def __init__(self, cache_time: int = CACHE_TIME) -> None:
        self.cache_time = cache_time
        self._tree = FrameTree(cache_time)
        self._conflicts = ParentConflictDetector(cache_time)

    @property
    def names(self) -> list[str]:
        """All frames, in the order in which they came up."""
        return self._tree.names

    def records(self) -> list[FrameRecord]:
        """Return all frames that have a parent, in the order in which they came up."""
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
    ) -> InputWarning | None:
        """
        Add a transform; return what is wrong with it, if anything.

        A static transform is valid at all times, whatever its stamp. It replaces all that is kept
        of its child frame, and a moving transform replaces it.
        """
        try:
            stamped = validated(stamped, authority)
        except InvalidArgumentException as error:
            text = str(error)
            return InputWarning(text, True, (text.partition(':')[0], stamped.child))
        if not self._tree.insert(stamped, authority, static=static):
            text = (
                f'TF_OLD_DATA ignoring data from the past for frame {stamped.child} at time '
                f'{seconds(stamped.time)} according to authority {authority}; the latest is at '
                f'{seconds(self._tree[stamped.child].latest_time)}'
            )
            return InputWarning(text, True, ('TF_OLD_DATA', stamped.child))
        warning = self._conflicts.observe(stamped, authority, static=static)
        return InputWarning(warning, False, ('TF_TWO_PARENTS', stamped.child)) if warning else None

    def clear(self) -> None:
        """Drop all moving transforms, as when time jumps back; static ones stay."""
        self._tree.clear_moving()
        self._conflicts = ParentConflictDetector(self.cache_time)

    def lookup_transform(self, target: str, source: str, time: int = LATEST) -> StampedTransform:
        """
        Return ``transform_source_to_target`` at ``time``; its ``parent`` is the target.

        Raises:
            LookupException: a frame is not known, or there is a loop above it.
            ConnectivityException: the frames are in different trees.
            ExtrapolationException: a transform is not known at that time.
            InvalidArgumentException: a name is empty or begins with ``/``.
        """
        if target == source:
            frame = self._tree.get(target)
            known = frame.latest_time if frame and time == LATEST else time
            return StampedTransform(target, source, known, Transform())
        self._require(target_frame=target, source_frame=source)
        if time == LATEST:
            time = self.latest_common_time(target, source)
        return StampedTransform(target, source, time, self._transform(target, source, time))

    def lookup_transform_full(
        self, target: str, target_time: int, source: str, source_time: int, fixed: str
    ) -> StampedTransform:
        """
        Return the transform from ``source`` at one time to ``target`` at another.

        ``fixed`` is a frame that does not move in between, such as ``odom``. Raises as
        :meth:`lookup_transform`.
        """
        self._require(target_frame=target, source_frame=source, fixed_frame=fixed)
        before = self.lookup_transform(fixed, source, source_time).transform
        after = self.lookup_transform(target, fixed, target_time)
        return StampedTransform(target, source, after.time, after.transform @ before)

    def explain_failure(self, target: str, source: str, time: int = LATEST) -> str:
        """Return why :meth:`lookup_transform` would fail, as tf2's ``canTransform``; '' if not."""
        if target == source:
            return ''
        for argument, frame in (('target_frame', target), ('source_frame', source)):
            fault = _fault_of(frame) or self._absence_of(frame)
            if fault:
                where = f'passed to canTransform argument {argument}'
                return f'Invalid frame ID "{frame}" {where} - {fault}'
        try:
            self.lookup_transform(target, source, time)
        except TransformException as error:
            return str(error)
        return ''

    def latest_common_time(self, target: str, source: str) -> int:
        """Return the latest time at which the whole chain is known, ns; 0: all of it is static."""
        self._require(target_frame=target, source_frame=source)
        down, up = self._tree.branches(target, source)
        frames = [self._tree[name] for name in (*down[:-1], *up[:-1])]
        times = (frame.latest_time for frame in frames)  # 0 of what is static
        return min((time for time in times if time != LATEST), default=LATEST)

    def chain(self, target: str, source: str) -> list[str]:
        """Return the frames between ``target`` and ``source``, both included."""
        self._require(target_frame=target, source_frame=source)
        down, up = self._tree.branches(target, source)
        return [*down, *reversed(up[:-1])]

    def _transform(self, target: str, source: str, time: int) -> Transform:
        """Climb from both frames to their common ancestor, and invert the way of the target."""
        frames = f'frame [{source}] to frame [{target}]'
        from_source = {source: Transform()}  # transform_source_to_… itself and its ancestors
        late: ExtrapolationException | None = None
        name = source
        while name != target and (frame := self._tree.get(name)):
            try:
                sample = _sample(name, frame, time, frames)
            except ExtrapolationException as error:
                late = error  # does not matter if the branches meet below
                break
            name = _climb(name, sample, from_source)
        from_target = {target: Transform()}  # transform_target_to_… likewise
        name = target
        while name not in from_source:
            frame = self._tree.get(name)
            if not frame:
                raise late or self._tree.unconnected(target, source)
            name = _climb(name, _sample(name, frame, time, frames), from_target)
        return from_target[name].inverse() @ from_source[name]

    def _require(self, **names: str) -> None:
        """Raise InvalidArgumentException or LookupException unless all names are known."""
        for argument, frame in names.items():
            where = f'passed to lookupTransform argument {argument}'
            if fault := _fault_of(frame):
                raise InvalidArgumentException(f'Invalid argument "{frame}" {where} - {fault}')
            if frame not in self._tree:
                raise LookupException(
                    f'"{frame}" {where} does not exist. {self._alternatives(frame)}'
                )

    def _absence_of(self, frame: str) -> str:
        return '' if frame in self._tree else f'frame does not exist. {self._alternatives(frame)}'

    def _alternatives(self, frame: str) -> str:
        """Return the known frame with the most similar name, or all of them."""
        if match := closest_match(frame, self._tree.names, _SIMILARITY):
            return f"Did you mean '{match}'?"
        return f'Known are: {shortened(self._tree.names) or "none yet"}'


def validated(stamped: StampedTransform, authority: str) -> StampedTransform:
    """
    Return a transform with names as tf2 keeps them (no leading ``/``) and a unit quaternion.

    Raises:
        InvalidArgumentException: it cannot be used.
    """
    parent, child = stamped.parent.removeprefix('/'), stamped.child.removeprefix('/')
    translation, rotation = stamped.transform.translation, stamped.transform.rotation
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
    if not all(map(math.isfinite, (*translation, *rotation))):
        raise InvalidArgumentException(
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because of a nan value in the transform {numbers(translation)} '
            f'{numbers(rotation)}'
        )
    if not is_unit(rotation):
        raise InvalidArgumentException(
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from '
            f'authority "{authority}" because of an invalid quaternion in the transform '
            f'{numbers(rotation)}'
        )
    return StampedTransform(
        parent, child, stamped.time, Transform(translation, normalize(rotation))
    )


def is_unit(rotation: tuple[float, ...]) -> bool:
    """Return whether tf2 accepts a quaternion as one of length 1."""
    return abs(sum(part * part for part in rotation) - 1.0) < _NORM_TOLERANCE


def numbers(values: tuple[float, ...]) -> str:
    """Return a vector or a quaternion as tf2 prints it: ``(0.000000 0.000000 1.000000)``."""
    return f'({" ".join(f"{value:f}" for value in values)})'


@dataclass(frozen=True, slots=True)
class _Publication:
    """How a frame is published."""

    parent: str
    authority: str
    static: bool

    def __str__(self) -> str:
        source = '' if self.authority == DEFAULT_AUTHORITY else f' (from "{self.authority}")'
        return f'{"static" if self.static else "moving"} in "{self.parent}"{source}'


class ParentConflictDetector:
    """
    Detects that a frame is published by more than one node.

    When a gripper takes an object, the object gets a new parent once. Two nodes that both publish
    a frame change its parent with every message. A static transform never changes, so there the
    first change counts.

    Args:
        window: how long a change is remembered, ns between stamps.
    """

    def __init__(self, window: int) -> None:
        self._window = window
        self._changes: dict[str, deque[tuple[int, _Publication]]] = {}

    def observe(self, stamped: StampedTransform, authority: str, *, static: bool) -> str:
        """Record how a frame is published; return a warning that names both publishers, or ''."""
        current = _Publication(stamped.parent, authority, static)
        changes = self._changes.setdefault(stamped.child, deque(maxlen=_CHANGES + 1))
        if changes and changes[-1][1] == current:
            return ''
        changes.append((stamped.time, current))
        if len(changes) < 2:
            return ''
        former = changes[-2][1]
        is_conflict = (
            len(changes) > _CHANGES
            and abs(stamped.time - changes[0][0]) <= self._window
            and len({publication for _, publication in changes}) == 2
        )
        if not (is_conflict or current.static or former.static):
            return ''
        return (
            f'TF_TWO_PARENTS: frame "{stamped.child}" is published as {former} and as {current}; '
            'the last one heard counts. A frame has one parent: one node may publish it'
        )


def _sample(name: str, frame: Frame, time: int, frames: str) -> TransformStorage:
    """Return the pose of a frame at a time. Raises ExtrapolationException, which names it."""
    try:
        return frame.get_data(time)
    except ExtrapolationException as error:
        gap = frame.gap_to(time) if isinstance(frame, TimeCache) else 0
        raise ExtrapolationException(
            f"{error}, when looking up transform from {frames}; it is '{name}' in "
            f"'{frame.latest.parent}' that lacks {seconds(gap)} s"
        ) from error


def _climb(name: str, sample: TransformStorage, reached: dict[str, Transform]) -> str:
    """Add the parent to the frames reached so far; return it. Raises LookupException."""
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
