# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The drawing of frame trees by ``view_frames``: layout without Graphviz, SVG and PDF.

Roots are at the top and each frame is below its parent; the text between them says how the frame
is published. Lengths are in points (1/72 inch), x to the right, y down. All text is monospaced,
with letters 0.6 of the font size wide, so the layout needs no font metrics.

The PDF is written by hand (ISO 32000-1): one page, two kinds of strokes, and Courier, which every
reader has. Its characters are those of Western Europe; others become ``?``. The SVG has all of
them.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias
from xml.sax.saxutils import escape

from amr_description.tf2_ros.frame_graph import facts, FrameRecord, label, tree_order
from amr_description.tf2_ros.time_cache import seconds

NAME_SIZE = 11.0
FACT_SIZE = 8.0
LETTER_WIDTH = 0.6
"""Fraction of the font size."""

_MARGIN = 20.0
_GAP = 16.0  # between neighbours, and above and below the text on a line
_BOX_HEIGHT = 24.0
_LINE_HEIGHT = 1.25  # fraction of the font size
_NOTHING = 'No tf data received'
_LARGEST_SIDE = 14400.0  # points; the limit of a PDF page


@dataclass(frozen=True)
class DrawnText:
    """A line of text, centred on ``x``, with its base line at ``y``."""

    x: float
    y: float
    size: float
    text: str


@dataclass(frozen=True)
class DrawnBox:
    """A rectangle; ``x`` and ``y`` are its upper left corner."""

    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True)
class Line:
    """A line from one point to another."""

    x1: float
    y1: float
    x2: float
    y2: float


Shape: TypeAlias = DrawnText | DrawnBox | Line


@dataclass(frozen=True)
class Drawing:
    """A page and the shapes on it."""

    width: float
    height: float
    shapes: tuple[Shape, ...]


@dataclass(frozen=True)
class _PlacedFrame:
    """One frame: its record (None for a root), its depth, and the centre of its column."""

    name: str
    label: str
    record: FrameRecord | None
    depth: int
    x: float


def draw(records: Sequence[FrameRecord], recorded: int) -> Drawing:
    """Draw all trees side by side; ``recorded`` is the time of the records, ns."""
    title = DrawnText(
        0.0, _MARGIN + FACT_SIZE, FACT_SIZE, f'Recorded at time: {seconds(recorded)}'
    )
    frames, right = _layout(records)
    if not frames:
        frames, right = [_PlacedFrame('', _NOTHING, None, 0, _MARGIN + 100.0)], _MARGIN + 200.0
    right = max(right, _MARGIN + _width(title.text, FACT_SIZE))
    title = DrawnText((right + _MARGIN) / 2.0, title.y, title.size, title.text)
    level = _BOX_HEIGHT + 2.0 * _GAP + _height_of_facts(records)
    top = title.y + 2.0 * _GAP
    by_name = {frame.name: frame for frame in frames}
    shapes: list[Shape] = [title]
    for frame in frames:
        y = top + frame.depth * level
        shapes += _frame(frame, y)
        if frame.record and frame.depth:
            shapes += _connection(by_name[frame.record.parent].x, frame, y, level)
    depth = max(frame.depth for frame in frames)
    return Drawing(right + _MARGIN, top + depth * level + _BOX_HEIGHT + _MARGIN, tuple(shapes))


def _layout(records: Sequence[FrameRecord]) -> tuple[list[_PlacedFrame], float]:
    """Give each frame a column above those of its children; return frames and right end."""
    order = tree_order(records)
    widths: dict[str, float] = {}  # of a frame with all its descendants
    below: dict[str, float] = {}
    for name, record, depth in reversed(order):  # children come before their parents here
        own = _width(label(name, record, depth), NAME_SIZE) + _GAP
        for fact in facts(record) if record else ():
            own = max(own, _width(fact, FACT_SIZE))
        widths[name] = max(own + _GAP, below.get(name, 0.0))
        if record and depth:
            below[record.parent] = below.get(record.parent, 0.0) + widths[name]
    frames: list[_PlacedFrame] = []
    start: dict[str, float] = {}  # left end of the next child of a frame
    end = _MARGIN
    for name, record, depth in order:
        left = start[record.parent] if record and depth else end
        if record and depth:
            start[record.parent] += widths[name]
        else:
            end += widths[name]
        start[name] = left + (widths[name] - below.get(name, 0.0)) / 2.0
        center = left + widths[name] / 2.0
        frames.append(_PlacedFrame(name, label(name, record, depth), record, depth, center))
    return frames, end


def _frame(frame: _PlacedFrame, y: float) -> Iterator[Shape]:
    """Yield the box with the name; its top is at ``y``."""
    width = _width(frame.label, NAME_SIZE) + _GAP
    yield DrawnBox(frame.x - width / 2.0, y, width, _BOX_HEIGHT)
    yield DrawnText(frame.x, y + _BOX_HEIGHT / 2.0 + 0.35 * NAME_SIZE, NAME_SIZE, frame.label)


def _connection(parent_x: float, frame: _PlacedFrame, y: float, level: float) -> Iterator[Shape]:
    """Yield the line from the parent's box to the child's at ``y``, and the facts beside it."""
    parent_y = y - level + _BOX_HEIGHT
    bend = parent_y + _GAP / 2.0
    lines = facts(frame.record)
    height = len(lines) * FACT_SIZE * _LINE_HEIGHT
    yield Line(parent_x, parent_y, parent_x, bend)
    yield Line(parent_x, bend, frame.x, bend)
    yield Line(frame.x, bend, frame.x, y - _GAP / 2.0 - height)
    for number, line in enumerate(lines):
        base = y - _GAP / 2.0 - height + (number + 0.8) * FACT_SIZE * _LINE_HEIGHT
        yield DrawnText(frame.x, base, FACT_SIZE, line)
    yield Line(frame.x, y - _GAP / 2.0, frame.x, y)


def _height_of_facts(records: Sequence[FrameRecord]) -> float:
    most = max((len(facts(record)) for record in records), default=0)
    return most * FACT_SIZE * _LINE_HEIGHT


def _width(text: str, size: float) -> float:
    return len(text) * size * LETTER_WIDTH


def as_svg(drawing: Drawing) -> str:
    """Return the text of an SVG file."""
    size = f'width="{drawing.width:.1f}" height="{drawing.height:.1f}"'
    return '\n'.join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} '
            f'viewBox="0 0 {drawing.width:.1f} {drawing.height:.1f}" '
            'font-family="monospace" text-anchor="middle">',
            '<rect width="100%" height="100%" fill="white"/>',
            '<g fill="none" stroke="black">',
            *(_svg_stroke(shape) for shape in drawing.shapes if not isinstance(shape, DrawnText)),
            '</g>',
            *(_svg_text(shape) for shape in drawing.shapes if isinstance(shape, DrawnText)),
            '</svg>\n',
        ]
    )


def as_pdf(drawing: Drawing) -> bytes:
    """Return the bytes of a PDF file; a drawing too large for a page is scaled down."""
    scale = min(1.0, _LARGEST_SIDE / max(drawing.width, drawing.height))
    strokes = [f'{scale:.6f} 0 0 {scale:.6f} 0 0 cm 1 w']
    strokes += [stroke for shape in drawing.shapes for stroke in _pdf(shape, drawing.height)]
    content = '\n'.join(strokes).encode('cp1252', errors='replace')
    sides = f'{drawing.width * scale:.1f} {drawing.height * scale:.1f}'
    return _pdf_file(
        [
            b'<< /Type /Catalog /Pages 2 0 R >>',
            b'<< /Type /Pages /Kids [3 0 R] /Count 1 >>',
            f'<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {sides}] /Contents 4 0 R '
            '/Resources << /Font << /F1 5 0 R >> >> >>'.encode(),
            b'<< /Length %d >>\nstream\n%s\nendstream' % (len(content), content),
            b'<< /Type /Font /Subtype /Type1 /BaseFont /Courier /Encoding /WinAnsiEncoding >>',
        ]
    )


def _svg_stroke(shape: DrawnBox | Line) -> str:
    if isinstance(shape, DrawnBox):
        return (
            f'<rect x="{shape.x:.1f}" y="{shape.y:.1f}" width="{shape.width:.1f}" '
            f'height="{shape.height:.1f}" rx="6"/>'
        )
    return f'<path d="M{shape.x1:.1f} {shape.y1:.1f}L{shape.x2:.1f} {shape.y2:.1f}"/>'


def _svg_text(text: DrawnText) -> str:
    # textLength: the text is as wide as in the layout, whatever monospaced font is used.
    width = len(text.text) * text.size * LETTER_WIDTH
    return (
        f'<text x="{text.x:.1f}" y="{text.y:.1f}" font-size="{text.size:g}" '
        f'textLength="{width:.1f}">{escape(_printable(text.text))}</text>'
    )


def _pdf(shape: Shape, height: float) -> Iterator[str]:
    """Yield the operators that draw a shape; in a PDF, y goes up."""
    if isinstance(shape, DrawnBox):
        bottom = height - shape.y - shape.height
        yield f'{shape.x:.1f} {bottom:.1f} {shape.width:.1f} {shape.height:.1f} re S'
    elif isinstance(shape, Line):
        yield f'{shape.x1:.1f} {height - shape.y1:.1f} m'
        yield f'{shape.x2:.1f} {height - shape.y2:.1f} l S'
    else:
        left = shape.x - len(shape.text) * shape.size * LETTER_WIDTH / 2.0
        text = _printable(shape.text)
        for special in '\\()':
            text = text.replace(special, f'\\{special}')
        yield f'BT /F1 {shape.size:g} Tf {left:.1f} {height - shape.y:.1f} Td ({text}) Tj ET'


def _pdf_file(objects: list[bytes]) -> bytes:
    """Return the file: numbered objects, and the table of their offsets."""
    file = b'%PDF-1.4\n'
    offsets = []
    for number, content in enumerate(objects, start=1):
        offsets.append(len(file))
        file += b'%d 0 obj\n%s\nendobj\n' % (number, content)
    table = b''.join(b'%010d 00000 n \n' % offset for offset in offsets)
    count = len(objects) + 1
    return file + (
        b'xref\n0 %d\n0000000000 65535 f \n%strailer\n<< /Size %d /Root 1 0 R >>\n'
        b'startxref\n%d\n%%%%EOF\n' % (count, table, count, len(file))
    )


def _printable(text: str) -> str:
    """Replace control characters, which would break either file: names come from the network."""
    return ''.join(letter if letter.isprintable() else '?' for letter in text)
