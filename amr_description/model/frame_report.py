# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a transform buffer knows, as text: tf2's list and YAML, a tree, a graph for Graphviz.

YAML and list are what tf2's ``allFramesAsYAML`` and ``allFramesAsString`` return, number by
number, as other tools read them. The others leave out what tf2 makes up for a static frame: a
rate of 10000 Hz, a first and a last time of 0.
"""

from collections.abc import Iterator, Sequence

from amr_description.model.frame_tree import FrameRecord
from amr_description.model.transform_cache import SECOND, seconds

_SHORTEST = 100_000  # ns: of this length tf2 takes a memory to be at least


def frames_as_string(records: Sequence[FrameRecord]) -> str:
    """Return a line for each frame and its parent."""
    lines = (f'Frame {record.name} exists with parent {record.parent}.\n' for record in records)
    return ''.join(lines)


def frames_as_yaml(records: Sequence[FrameRecord], now: int = 0) -> str:
    """Return a YAML mapping of frames; with ``now`` (ns, 0: unknown) also how old they are."""
    return ''.join(_yaml(record, now) for record in records) or '[]'


def facts(record: FrameRecord) -> list[str]:
    """Return what there is to say about how a frame is published, a line each."""
    lines = [f'Broadcaster: {record.authority}']
    if record.is_static:
        return [*lines, 'Static']
    return [
        *lines,
        f'Average rate: {average_rate(record):.3f}',
        f'Buffer length: {(record.latest_time - record.oldest_time) / SECOND:.3f}',
        f'Most recent transform: {seconds(record.latest_time)}',
        f'Oldest transform: {seconds(record.oldest_time)}',
    ]


def average_rate(record: FrameRecord) -> float:
    """Return how often a moving frame is published, Hz; 0 when only one time is known."""
    length = record.latest_time - record.oldest_time
    return (record.samples - 1) * SECOND / length if length else 0.0


def tree_order(records: Sequence[FrameRecord]) -> list[tuple[str, FrameRecord | None, int]]:
    """
    Return (frame, its record, depth) of all, each one before those below it; roots have none.

    Children stand in alphabetical order. A loop is cut open above its first frame.
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
    """Name a frame in :func:`tree_order`, and tell where a loop was cut."""
    is_cut = record is not None and depth == 0
    return f'{name} (in a loop, below {record.parent})' if is_cut else name


def as_tree(records: Sequence[FrameRecord]) -> str:
    """Return all trees, a line for each frame, indented below its parent."""
    return '\n'.join(_branches(records))


def as_dot(records: Sequence[FrameRecord], recorded: int) -> str:
    """Return the graph in Graphviz's language; ``recorded``: when, ns."""
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
    rate = record.samples * SECOND / max(length, _SHORTEST)
    delay = f'  transform_delay: {(now - record.latest_time) / SECOND:.3f}\n' if now else ''
    return (
        f'{record.name}: \n'
        f"  parent: '{record.parent}'\n"
        f"  broadcaster: '{record.authority}'\n"
        f'  rate: {rate:.3f}\n'
        f'  most_recent_transform: {seconds(record.latest_time)}\n'
        f'  oldest_transform: {seconds(record.oldest_time)}\n'
        f'{delay}'
        f'  buffer_length: {length / SECOND:.3f}\n'
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
    """The lines in front of each name: down to its younger siblings, and those of its parents."""
    strokes = []
    going_on: set[int] = set()  # depths at which a sibling follows; read from the end
    for _, _, depth in reversed(order):
        end = '├── ' if depth in going_on else '└── '
        going_on = {other for other in going_on if other < depth} | {depth}
        above = ('│   ' if level in going_on else '    ' for level in range(1, depth))
        strokes.append(''.join(above) + end if depth else '')
    return strokes[::-1]


def _escaped(text: str) -> str:
    return text.replace('\\', r'\\').replace('"', r'\"')


def _quoted(name: str) -> str:
    return f'"{_escaped(name)}"'
