# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Grids and poses, as messages and back."""

import math

import numpy as np
import pytest

from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.pose import Pose
from amr_description.navigation.ros.messages import (
    grid_message,
    grid_of,
    is_on_map,
    pose_message,
    pose_of,
)


def test_a_pose_comes_back():
    assert pose_of(pose_message(Pose(1.0, 2.0, -3.0))) == pytest.approx((1.0, 2.0, -3.0))


def test_a_grid_comes_back():
    cells = np.array([[-1, 0, 100], [7, 8, 9]], np.int8)
    message = grid_message(OccupancyGrid(cells, 0.25, Pose(1.0, 2.0, 0.5)))
    assert message.header.frame_id == 'map'
    assert list(message.data) == [-1, 0, 100, 7, 8, 9]
    assert (message.info.width, message.info.height) == (3, 2)
    grid = grid_of(message)
    assert (grid.cells == cells).all()
    assert grid.resolution == 0.25
    assert grid.origin == pytest.approx((1.0, 2.0, 0.5))


@pytest.mark.parametrize(
    ('changes', 'text'),
    [
        ({'width': 3}, '3 x 2 cells of 0.1 m, of which 4 have come'),
        ({'width': 0}, '0 x 2 cells of 0.1 m'),
        ({'resolution': 0.0}, '2 x 2 cells of 0 m'),
        ({'resolution': -0.1}, '2 x 2 cells of -0.1 m'),
        ({'resolution': math.nan}, '2 x 2 cells of nan m'),
        ({'resolution': math.inf}, '2 x 2 cells of inf m'),
        ({'resolution': 1e-9}, '2 x 2 cells of 1e-09 m'),
        (
            {'origin': pose_message(Pose(math.nan, 0.0, 0.0))},
            '2 x 2 cells of 0.1 m that begin at (nan, 0.0, 0.0)',
        ),
    ],
)
def test_what_is_no_map_is_an_error(changes, text):
    message = grid_message(OccupancyGrid(np.zeros((2, 2), np.int8), 0.1, Pose(0.0, 0.0, 0.0)))
    for name, value in changes.items():
        setattr(message.info, name, value)
    with pytest.raises(ValueError) as found:
        grid_of(message)
    assert str(found.value) == text


@pytest.mark.parametrize(
    ('pose', 'is_there'),
    [
        (Pose(1.0, -9e8, 3.0), True),
        (Pose(1e308, 0.0, 0.0), False),
        (Pose(0.0, -math.inf, 0.0), False),
        (Pose(math.nan, 0.0, 0.0), False),
        (Pose(0.0, 0.0, math.nan), False),
    ],
)
def test_what_tf_makes_of_a_pose_may_be_no_place(pose, is_there):
    assert is_on_map(pose) is is_there
