# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Grids and poses, as messages and back."""

import numpy as np
import pytest

from amr_description.navigation.grid import OccupancyGrid
from amr_description.navigation.pose import Pose
from amr_description.navigation.ros.messages import grid_message, grid_of, pose_message, pose_of


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


def test_a_grid_of_too_few_cells_is_an_error():
    message = grid_message(OccupancyGrid(np.zeros((2, 2), np.int8), 0.1, Pose(0.0, 0.0, 0.0)))
    message.data.pop()
    with pytest.raises(ValueError):
        grid_of(message)
