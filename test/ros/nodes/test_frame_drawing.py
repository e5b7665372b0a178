# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The drawing of frames: nothing overlaps, lines meet boxes, and the files are what they claim."""

import re
import xml.etree.ElementTree as ElementTree

from hypothesis import given, strategies as st

from amr_description.nodes.view_frames.drawing import (
    as_pdf,
    as_svg,
    draw,
    DrawnBox,
    DrawnText,
    LETTER_WIDTH,
    Line,
)
from amr_description.tf2_ros.frame_graph import FrameRecord

SVG = '{http://www.w3.org/2000/svg}'


def record(name, parent, static=True):
    return FrameRecord(name, parent, '/robot', static, 5, 0 if static else 9, 0)


@st.composite
def forests(draw_from):
    """Records of up to nine frames below up to two roots."""
    records = []
    for child in range(2, draw_from(st.integers(3, 11))):
        parent = draw_from(st.integers(0, child - 1))
        name = 'frame_' * draw_from(st.integers(0, 3)) + str(child)
        known = {0: 'map', 1: 'world'} | {index + 2: one.name for index, one in enumerate(records)}
        records.append(record(name, known[parent], draw_from(st.booleans())))
    return records


def area(shape):
    if isinstance(shape, DrawnBox):
        return shape.x, shape.y, shape.x + shape.width, shape.y + shape.height
    half = len(shape.text) * shape.size * LETTER_WIDTH / 2
    return shape.x - half, shape.y - 0.8 * shape.size, shape.x + half, shape.y + 0.2 * shape.size


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def of(drawing, kind):
    return [shape for shape in drawing.shapes if isinstance(shape, kind)]


@given(forests())
def test_nothing_overlaps_or_leaves_the_sheet(records):
    drawing = draw(records, 0)
    names = {one.name for one in records} | {one.parent for one in records}
    boxes = [area(box) for box in of(drawing, DrawnBox)]
    notes = [area(text) for text in of(drawing, DrawnText) if text.text not in names]
    assert len(boxes) == len(names)
    for index, one in enumerate(boxes + notes):
        assert 0 <= one[0] <= one[2] <= drawing.width
        assert 0 <= one[1] <= one[3] <= drawing.height
        assert not any(overlap(one, other) for other in (boxes + notes)[:index])


@given(forests())
def test_each_name_stands_in_a_box_and_each_child_hangs_below_its_parent(records):
    drawing = draw(records, 0)
    boxes = [area(box) for box in of(drawing, DrawnBox)]
    place = {}
    for text in of(drawing, DrawnText):
        for box in boxes:
            if overlap(area(text), box):
                place[text.text] = box
    lines = of(drawing, Line)
    for one in records:
        child, parent = place[one.name], place[one.parent]
        assert child[1] > parent[3]
        middle = (child[0] + child[2]) / 2
        assert any(abs(line.x2 - middle) < 0.1 and line.y2 == child[1] for line in lines)
        below = (parent[0] + parent[2]) / 2
        assert any(abs(line.x1 - below) < 0.1 and line.y1 == parent[3] for line in lines)


NAMES = ['base_link', 'laser(1)', 'back\\slash', 'imu<&>"', 'kamera_ü', '車輪', 'bell\x07']
ODD = [record(name, 'map') for name in NAMES]


def test_the_svg_is_xml_with_all_names():
    root = ElementTree.fromstring(as_svg(draw(ODD, 0)))
    assert root.tag == f'{SVG}svg'
    texts = {element.text for element in root.iter(f'{SVG}text')}
    assert {*NAMES[:-1], 'bell?', 'map', 'Recorded at time: 0.000000'} <= texts


def test_the_pdf_is_one_page_whose_table_and_length_are_right():
    pdf = as_pdf(draw(ODD, 0))
    assert pdf.startswith(b'%PDF-1.4\n')
    table = int(re.search(rb'startxref\n(\d+)\n%%EOF\n$', pdf)[1])
    assert pdf[table:].startswith(b'xref\n0 6\n0000000000 65535 f \n')
    places = [int(place) for place in re.findall(rb'(\d{10}) 00000 n \n', pdf[table:])]
    for number, place in enumerate(places, start=1):
        assert pdf[place:].startswith(b'%d 0 obj\n' % number)
    length = int(re.search(rb'/Length (\d+)', pdf)[1])
    stream = pdf[pdf.index(b'stream\n') + 7 :]
    assert stream[length:].startswith(b'\nendstream')
    for name in (b'(base_link)', b'(laser\\(1\\))', b'(back\\\\slash)', b'(kamera_\xfc)', b'(??)'):
        assert name in stream


def test_a_drawing_too_large_for_a_page_is_made_smaller():
    pdf = as_pdf(draw([record(f'frame_number_{number}', 'map') for number in range(300)], 0))
    width, height = map(float, re.search(rb'MediaBox \[0 0 (\S+) (\S+)\]', pdf).groups())
    assert max(width, height) == 14400.0


def test_nothing_heard_is_drawn_as_such():
    texts = [text.text for text in of(draw([], 0), DrawnText)]
    assert texts == ['Recorded at time: 0.000000', 'No tf data received']


def test_a_loop_is_drawn_cut():
    texts = [text.text for text in of(draw([record('a', 'b'), record('b', 'a')], 0), DrawnText)]
    assert 'a (in a loop, below b)' in texts
    assert 'b' in texts
