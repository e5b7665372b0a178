# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which frame is in which: the trees that a transform buffer walks.

A frame has one parent at a time. One without a parent is a root; where there are two, nothing is
known between their trees. Nothing keeps publishers from making a loop, so a walk must expect one.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from amr_description.errors import ConnectivityException, LookupException
from amr_description.model.transform_cache import Frame, MovingFrame, Sample, StaticFrame
from amr_description.model.transform_input import StampedTransform

_SHOWN = 8  # names of a tree, in an error


@dataclass(frozen=True, slots=True)
class FrameRecord:
    """What is known of a frame that has a parent; times in ns, both 0 for a static frame."""

    name: str
    parent: str
    authority: str
    is_static: bool
    samples: int
    latest_time: int
    oldest_time: int


class FrameTree:
    """
    All frames and their poses in their parents.

    :param cache_time: How long the past of a frame is kept before its latest pose, ns.
    """

    def __init__(self, cache_time: int) -> None:
        self._cache_time = cache_time
        self._frames: dict[str, Frame] = {}
        self._authorities: dict[str, str] = {}
        self._names: dict[str, None] = {}

    @property
    def names(self) -> list[str]:
        """All frames, in the order in which they came up."""
        return list(self._names)

    def __contains__(self, name: str) -> bool:
        """Tell whether a frame of that name has come up, with a parent or as one."""
        return name in self._names

    def get(self, name: str) -> Frame | None:
        """Return the poses of a frame in its parent; None: it has no parent."""
        return self._frames.get(name)

    def records(self) -> list[FrameRecord]:
        """Tell of all frames that have a parent, in the order in which they came up."""
        return [
            FrameRecord(
                name,
                frame.latest.parent,
                self._authorities[name],
                frame.is_static,
                len(frame),
                frame.latest_time,
                frame.oldest_time,
            )
            for name in self._names
            if (frame := self._frames.get(name))
        ]

    def insert(self, stamped: StampedTransform, authority: str, *, static: bool) -> bool:
        """Take a pose; False: it is older than what is kept, and ignored."""
        sample = Sample(stamped.time, stamped.parent, stamped.transform)
        frame = self._frames.get(stamped.child)
        if isinstance(frame, MovingFrame) and not static:
            if not frame.insert(sample):
                return False
        else:
            made = StaticFrame(sample) if static else MovingFrame(sample, self._cache_time)
            self._frames[stamped.child] = made
        self._authorities[stamped.child] = authority
        self._names.setdefault(stamped.parent)
        self._names.setdefault(stamped.child)
        return True

    def forget_moving(self) -> None:
        """Forget where moving frames were, but not that they exist."""
        self._frames = {name: frame for name, frame in self._frames.items() if frame.is_static}

    def lineage(self, name: str) -> Iterator[str]:
        """Yield a frame and its present ancestors, the root last; of a loop each frame once."""
        seen: set[str] = set()
        while name not in seen:
            seen.add(name)
            yield name
            frame = self._frames.get(name)
            name = frame.latest.parent if frame else name

    def ways(self, target: str, source: str) -> tuple[list[str], list[str]]:
        """
        Return the frames from either up to, and with, the first that they share.

        :raises LookupException: There is a loop.
        :raises ConnectivityException: They share none.
        """
        up = list(self.lineage(source))
        down: list[str] = []
        for name in self.lineage(target):
            down.append(name)
            if name in up:
                return down, up[: up.index(name) + 1]
        for lineage in (up, down):
            frame = self._frames.get(lineage[-1])
            if frame:
                raise loop_error(lineage, frame.latest.parent)
        raise self.unconnected(target, source)

    def root_of(self, name: str) -> str:
        """Return the root of the frame's tree; of a loop, its alphabetically first frame."""
        lineage = list(self.lineage(name))
        frame = self._frames.get(lineage[-1])
        return min(lineage[lineage.index(frame.latest.parent) :]) if frame else lineage[-1]

    def trees(self) -> dict[str, list[str]]:
        """Return the roots, each with the other frames of its tree."""
        trees: dict[str, list[str]] = {}
        for name in self._names:
            root = self.root_of(name)
            trees.setdefault(root, []).extend([name] if name != root else [])
        return trees

    def unconnected(self, target: str, source: str) -> ConnectivityException:
        """Return the error of two frames in different trees."""
        trees = ', and '.join(
            f"'{root}' with {listed(members) or 'nothing below it'}"
            for root, members in self.trees().items()
        )
        # The missing space after 'tree.' is tf2's: people search for the sentence as it is.
        return ConnectivityException(
            f"Could not find a connection between '{target}' and '{source}' because they are not "
            'part of the same tree.Tf has two or more unconnected trees. No common root: the '
            f'trees are {trees}'
        )


def loop_error(way: Sequence[str], again: str) -> LookupException:
    """Return the error of a way, from child to parent, that comes to one of its frames again."""
    loop = [*way[way.index(again) :], again]
    return LookupException(
        f'The tf tree is invalid because it contains a loop: {" is in ".join(loop)}'
    )


def listed(names: Sequence[str]) -> str:
    """Write names, the first few of many."""
    more = len(names) - _SHOWN
    shown = ', '.join(names[:_SHOWN])
    return f'{shown} and {more} more' if more > 0 else shown
