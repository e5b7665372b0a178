# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The trees of frames that a transform buffer walks, and their descriptions as text.

A frame has one parent at a time; one without a parent is a root. Between the frames of two roots
nothing can be looked up. Publishers may make a loop, so every walk expects one.

:func:`frames_as_yaml` and :func:`frames_as_string` return what tf2's ``allFramesAsYAML`` and
``allFramesAsString`` do, number by number, as other tools read them. :func:`as_tree`,
:func:`as_dot` and :func:`facts` leave out what tf2 makes up for a static frame: a rate of
10000 Hz, a first and a last time of 0.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from amr_description.clock import NANOSECONDS
from amr_description.errors import ConnectivityException, LookupException
from amr_description.tf2_ros.time_cache import (
    Frame,
    seconds,
    StampedTransform,
    StaticCache,
    TimeCache,
    TransformStorage,
)

_SHOWN = 8  # names of a tree, in an error
_SHORTEST = 100_000  # ns: tf2 takes the length of a buffer to be at least this


@dataclass(frozen=True, slots=True)
class FrameRecord:
    """How a frame that has a parent is published; times in ns, both 0 for a static frame."""

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

    Args:
        cache_time: how long poses of a frame are kept before its latest one, ns.
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
        """Return whether a frame of that name has come up, with a parent or as one."""
        return name in self._names

    def __getitem__(self, name: str) -> Frame:
        """Return the poses of a frame that has a parent, in that."""
        return self._frames[name]

    def get(self, name: str) -> Frame | None:
        """Return the poses of a frame in its parent; None if it has no parent."""
        return self._frames.get(name)

    def records(self) -> list[FrameRecord]:
        """Return all frames that have a parent, in the order in which they came up."""
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
        """Add a pose; return False if it is older than what is kept and therefore ignored."""
        sample = TransformStorage(stamped.time, stamped.parent, stamped.transform)
        frame = self._frames.get(stamped.child)
        if isinstance(frame, TimeCache) and not static:
            if not frame.insert_data(sample):
                return False
        else:
            self._frames[stamped.child] = (
                StaticCache(sample) if static else TimeCache(sample, self._cache_time)
            )
        self._authorities[stamped.child] = authority
        self._names.setdefault(stamped.parent)
        self._names.setdefault(stamped.child)
        return True

    def clear_moving(self) -> None:
        """Drop the poses of moving frames, but not their names."""
        self._frames = {name: frame for name, frame in self._frames.items() if frame.is_static}

    def lineage(self, name: str) -> Iterator[str]:
        """Yield a frame and its ancestors, the root last; each frame of a loop once."""
        seen: set[str] = set()
        while name not in seen:
            seen.add(name)
            yield name
            frame = self._frames.get(name)
            name = frame.latest.parent if frame else name

    def branches(self, target: str, source: str) -> tuple[list[str], list[str]]:
        """
        Return the frames from each of two up to their first common ancestor, which is included.

        Raises:
            LookupException: there is a loop.
            ConnectivityException: they have no common ancestor.
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
        """Return the root of the frame's tree; for a loop, its alphabetically first frame."""
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
            f"'{root}' with {shortened(members) or 'nothing below it'}"
            for root, members in self.trees().items()
        )
        # The missing space after 'tree.' is tf2's: people search for the sentence as it is.
        return ConnectivityException(
            f"Could not find a connection between '{target}' and '{source}' because they are not "
            'part of the same tree.Tf has two or more unconnected trees. No common root: the '
            f'trees are {trees}'
        )


def loop_error(chain: Sequence[str], again: str) -> LookupException:
    """Return the error of a chain, from child to parent, that reaches one of its frames again."""
    loop = [*chain[chain.index(again) :], again]
    return LookupException(
        f'The tf tree is invalid because it contains a loop: {" is in ".join(loop)}'
    )


def shortened(names: Sequence[str]) -> str:
    """Return names separated by commas, the first few of many."""
    more = len(names) - _SHOWN
    shown = ', '.join(names[:_SHOWN])
    return f'{shown} and {more} more' if more > 0 else shown


def frames_as_string(records: Sequence[FrameRecord]) -> str:
    """Return a line for each frame and its parent."""
    lines = (f'Frame {record.name} exists with parent {record.parent}.\n' for record in records)
    return ''.join(lines)


def frames_as_yaml(records: Sequence[FrameRecord], now: int = 0) -> str:
    """Return a YAML mapping of frames; with ``now`` (ns, 0: unknown) also their delay."""
    return ''.join(_yaml(record, now) for record in records) or '[]'


def facts(record: FrameRecord) -> list[str]:
    """Return how a frame is published, as lines of text."""
    lines = [f'Broadcaster: {record.authority}']
    if record.is_static:
        return [*lines, 'Static']
    return [
        *lines,
        f'Average rate: {average_rate(record):.3f}',
        f'Buffer length: {(record.latest_time - record.oldest_time) / NANOSECONDS:.3f}',
        f'Most recent transform: {seconds(record.latest_time)}',
        f'Oldest transform: {seconds(record.oldest_time)}',
    ]


def average_rate(record: FrameRecord) -> float:
    """Return how often a moving frame is published, Hz; 0 when only one time is known."""
    length = record.latest_time - record.oldest_time
    return (record.samples - 1) * NANOSECONDS / length if length else 0.0


def tree_order(records: Sequence[FrameRecord]) -> list[tuple[str, FrameRecord | None, int]]:
    """
    Return (frame, its record, depth) of all frames, parents before children; roots have no record.

    Children are in alphabetical order. A loop is cut above its alphabetically first frame.
    """
    children: dict[str, list[str]] = {}
    for record in records:
        children.setdefault(record.parent, []).append(record.name)
    by_name = {record.name: record for record in records}
    ordered: list[tuple[str, FrameRecord | None, int]] = []
    seen: set[str] = set()
    roots = sorted(children.keys() - by_name.keys())
    for top in (*roots, *sorted(by_name)):  # what no root leads to is in a loop, or below one
        waiting = [(top, 0)] if top not in seen else []
        while waiting:
            name, depth = waiting.pop()
            if name not in seen:
                seen.add(name)
                ordered.append((name, by_name.get(name), depth))
                below = sorted(children.get(name, ()), reverse=True)
                waiting += [(child, depth + 1) for child in below]
    return ordered


def label(name: str, record: FrameRecord | None, depth: int) -> str:
    """Return the name of a frame of :func:`tree_order`, with a note where a loop was cut."""
    if record is None or depth > 0:
        return name
    return f'{name} (in a loop, below {record.parent})'


def as_tree(records: Sequence[FrameRecord]) -> str:
    """Return all trees, a line for each frame, indented below its parent."""
    return '\n'.join(_branches(records))


def as_dot(records: Sequence[FrameRecord], recorded: int) -> str:
    """Return the graph in the DOT language of Graphviz; ``recorded``: the time of it, ns."""
    if not records:
        return 'digraph G { "No tf data received" }\n'
    end = r'\n'
    edges = ''.join(
        f'{_quoted(record.parent)} -> {_quoted(record.name)}'
        f'[label=" {end.join(map(_escaped, facts(record)))}{end}"];\n'
        for record in records
    )
    top = next(name for name, _, depth in tree_order(records) if depth == 0)
    return (
        f'digraph G {{\n{edges}'
        'edge [style=invis];\n'
        ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";\n'
        f'"Recorded at time: {seconds(recorded)}"[ shape=plaintext ] ;\n'
        f'}}->{_quoted(top)};\n}}\n'
    )


def _yaml(record: FrameRecord, now: int) -> str:
    length = record.latest_time - record.oldest_time
    rate = record.samples * NANOSECONDS / max(length, _SHORTEST)
    delay = f'  transform_delay: {(now - record.latest_time) / NANOSECONDS:.3f}\n' if now else ''
    return (
        f'{record.name}: \n'
        f"  parent: '{record.parent}'\n"
        f"  broadcaster: '{record.authority}'\n"
        f'  rate: {rate:.3f}\n'
        f'  most_recent_transform: {seconds(record.latest_time)}\n'
        f'  oldest_transform: {seconds(record.oldest_time)}\n'
        f'{delay}'
        f'  buffer_length: {length / NANOSECONDS:.3f}\n'
    )


def _branches(records: Sequence[FrameRecord]) -> Iterator[str]:
    order = tree_order(records)
    for (name, record, depth), strokes in zip(order, _strokes(order), strict=True):
        line = strokes + label(name, record, depth)
        if record is not None:
            how = 'static' if record.is_static else f'{average_rate(record):.3f} Hz'
            line += f': {how}, {record.authority}'
        yield line


def _strokes(order: Sequence[tuple[str, FrameRecord | None, int]]) -> list[str]:
    """Return the box-drawing lines in front of each name."""
    strokes = []
    open_depths: set[int] = set()  # those at which a sibling follows, read from the end
    for _, _, depth in reversed(order):
        end = '├── ' if depth in open_depths else '└── '
        open_depths = {other for other in open_depths if other < depth} | {depth}
        above = ('│   ' if level in open_depths else '    ' for level in range(1, depth))
        strokes.append(''.join(above) + end if depth else '')
    return strokes[::-1]


def _escaped(text: str) -> str:
    return text.replace('\\', r'\\').replace('"', r'\"')


def _quoted(name: str) -> str:
    return f'"{_escaped(name)}"'
