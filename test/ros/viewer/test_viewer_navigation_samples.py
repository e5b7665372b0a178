# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Maps and paths as samples for pages: what is sent, thinned and refused."""

import json
import math
import struct
import zlib

from hypothesis import given, strategies as st
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from support.navigated_robot import cells, grid, path

from amr_description.viewer.graph import OCCUPANCY_GRID, PATH
from amr_description.viewer.ros.navigation_samples import MOST_POSES
from amr_description.viewer.ros.sensor_samples import sample_of


def sample(kind, message):
    """Return the head, and what follows it."""
    frame = sample_of(kind, serialize_message(message), '/a', 2.0)
    end = 4 + struct.unpack_from('<H', frame, 2)[0]
    return json.loads(frame[4:end]), frame[end:]


def test_the_cells_of_a_map_are_deflated_row_by_row():
    head, rest = sample(OCCUPANCY_GRID, grid())
    assert (head['type'], head['width'], head['height']) == ('map', 160, 120)
    assert (head['resolution'], head['position']) == (pytest.approx(0.05), [-2.0, 0.0, 0.0])
    assert (head['orientation'], head['origin']['frame']) == ([0.0, 0.0, 0.0, 1.0], 'map')
    assert np.array_equal(np.frombuffer(zlib.decompress(rest), 'i1'), cells().reshape(-1))
    assert len(rest) < cells().size / 20


def test_a_map_that_is_published_again_is_the_same_sample():
    first, again = grid(), grid()
    again.header.stamp.sec = 77
    assert sample(OCCUPANCY_GRID, first) == sample(OCCUPANCY_GRID, again)


@pytest.mark.parametrize(
    ('change', 'text'),
    [
        ({'width': 5000}, 'a map of 5000 × 120 cells: the page draws 1 to 4096 a side'),
        ({'height': 0}, 'a map of 160 × 0 cells: the page draws 1 to 4096 a side'),
        ({'height': 119}, 'a map of 160 × 119 cells has 19200'),
        ({'resolution': 0.0}, 'of 0 m: a cell has a side of more than 0 m'),
        ({'resolution': math.nan}, 'of nan m: a cell has a side of more than 0 m'),
    ],
)
def test_a_map_that_cannot_be_drawn_is_refused_in_one_line(change, text):
    message = grid()
    for name, value in change.items():
        setattr(message.info, name, value)
    head, rest = sample(OCCUPANCY_GRID, message)
    assert (head['type'], rest) == ('unreadable', b'')
    assert text in head['text']


def test_a_map_without_an_orientation_is_not_turned():
    message = grid()
    message.info.origin.orientation.w = 0.0
    assert sample(OCCUPANCY_GRID, message)[0]['orientation'] == [0.0, 0.0, 0.0, 1.0]
    message.info.origin.position.x = math.inf
    assert 'NaN and infinity are no place' in sample(OCCUPANCY_GRID, message)[0]['text']


def test_a_path_has_its_points_its_length_and_its_frame():
    head, rest = sample(PATH, path([(0.0, 0.0), (3.0, 4.0), (3.0, 5.0)]))
    assert (head['type'], head['count'], head['length']) == ('path', 3, 6.0)
    assert head['origin']['frame'] == 'map'
    points = np.frombuffer(rest, '<f4').reshape(-1, 3)
    assert points.tolist() == [[0, 0, 0], [3, 4, 0], [3, 5, 0]]


def test_an_empty_path_clears_the_one_before():
    head, rest = sample(PATH, path([]))
    assert (head['count'], head['length'], rest) == (0, 0.0, b'')


def test_a_path_whose_header_is_empty_has_the_frame_of_its_poses():
    message = path([(0.0, 0.0)])
    message.header.frame_id = ''
    assert sample(PATH, message)[0]['origin']['frame'] == 'map'


def test_a_long_path_is_thinned_and_ends_at_the_goal():
    head, rest = sample(PATH, path([(x, math.nan if x == 7 else 0.0) for x in range(12_001)]))
    points = np.frombuffer(rest, '<f4').reshape(-1, 3)
    assert head['count'] == 12_001
    assert len(points) <= MOST_POSES + 1
    assert points[-1].tolist() == [12_000, 0, 0]
    assert np.isfinite(points).all()


@pytest.mark.parametrize(('kind', 'message'), [(OCCUPANCY_GRID, grid()), (PATH, path([(1, 2)]))])
@given(st.integers(0, 400), st.binary(min_size=1, max_size=6))
def test_any_bytes_become_a_map_a_path_or_a_refusal(kind, message, at, noise):
    data = serialize_message(message)
    at = min(at, len(data))
    frame = sample_of(kind, data[:at] + noise + data[at + len(noise) :], '', 1)
    end = 4 + struct.unpack_from('<H', frame, 2)[0]
    head = json.loads(frame[4:end])
    assert head['type'] in ('map', 'path', 'unreadable')
    assert not head.get('text', '').startswith('the viewer failed')
