# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A drawing as SVG and as PDF.

The PDF is written by hand (ISO 32000-1): one page, two kinds of strokes, and Courier, which every
reader has and which needs no embedding; its letters are those of Western Europe, others become
``?``. The SVG has all of them.

This module imports no rclpy.
"""

from collections.abc import Iterator
from xml.sax.saxutils import escape

from amr_description.nodes.frame_drawing import Box, Drawing, LETTER_WIDTH, Line, Shape, Text

_LARGEST = 14400.0  # points: no side of a page may be longer


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
            *(_svg_stroke(shape) for shape in drawing.shapes if not isinstance(shape, Text)),
            '</g>',
            *(_svg_text(shape) for shape in drawing.shapes if isinstance(shape, Text)),
            '</svg>\n',
        ]
    )


def as_pdf(drawing: Drawing) -> bytes:
    """Return the bytes of a PDF file; a drawing too large for a page is made smaller."""
    scale = min(1.0, _LARGEST / max(drawing.width, drawing.height))
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


def _svg_stroke(shape: Box | Line) -> str:
    if isinstance(shape, Box):
        return (
            f'<rect x="{shape.x:.1f}" y="{shape.y:.1f}" width="{shape.width:.1f}" '
            f'height="{shape.height:.1f}" rx="6"/>'
        )
    return f'<path d="M{shape.x1:.1f} {shape.y1:.1f}L{shape.x2:.1f} {shape.y2:.1f}"/>'


def _svg_text(text: Text) -> str:
    # textLength: whichever typewriter face the viewer has, the text is as wide as was laid out.
    width = len(text.text) * text.size * LETTER_WIDTH
    return (
        f'<text x="{text.x:.1f}" y="{text.y:.1f}" font-size="{text.size:g}" '
        f'textLength="{width:.1f}">{escape(_printable(text.text))}</text>'
    )


def _pdf(shape: Shape, height: float) -> Iterator[str]:
    """The strokes of a shape; in a PDF y goes up."""
    if isinstance(shape, Box):
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
    """Number the objects and add the table that says where each begins."""
    file = b'%PDF-1.4\n'
    places = []
    for number, content in enumerate(objects, start=1):
        places.append(len(file))
        file += b'%d 0 obj\n%s\nendobj\n' % (number, content)
    table = b''.join(b'%010d 00000 n \n' % place for place in places)
    count = len(objects) + 1
    return file + (
        b'xref\n0 %d\n0000000000 65535 f \n%strailer\n<< /Size %d /Root 1 0 R >>\n'
        b'startxref\n%d\n%%%%EOF\n' % (count, table, count, len(file))
    )


def _printable(text: str) -> str:
    """Names come from the network: control characters would break either file."""
    return ''.join(letter if letter.isprintable() else '?' for letter in text)
