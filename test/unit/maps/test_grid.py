# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Poses in the plane, and cells of a map."""

from math import pi

import numpy as np
import pytest

from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.pose import Pose, wrapped


def test_a_pose_and_its_inverse_cancel():
    pose = Pose(1.0, -2.0, 2.5)
    assert pose.compose(pose.inverse()) == pytest.approx((0, 0, 0))
    assert pose.inverse().compose(pose) == pytest.approx((0, 0, 0))


def test_poses_compose_from_the_outside_in():
    assert Pose(1.0, 0.0, pi / 2).compose(Pose(2.0, 0.0, pi / 4)) == pytest.approx(
        (1.0, 2.0, 0.75 * pi)
    )


def test_angles_are_wrapped():
    assert wrapped(3 * pi / 2) == pytest.approx(-pi / 2)
    assert Pose(0, 0, 3.0).compose(Pose(0, 0, 3.0)).yaw == pytest.approx(6.0 - 2 * pi)


def test_cells_and_points_of_a_map_that_is_turned():
    grid = OccupancyGrid(np.zeros((3, 5), np.int8), 0.1, Pose(1.0, 2.0, pi / 2))
    assert (grid.height, grid.width) == (3, 5)
    assert grid.center_of(0, 0) == pytest.approx((0.95, 2.05))
    assert grid.center_of(2, 4) == pytest.approx((0.75, 2.45))
    for row in range(-1, 4):
        for column in range(-1, 6):
            assert grid.cell_of(*grid.center_of(row, column)) == (row, column)
            assert grid.holds(row, column) == (0 <= row < 3 and 0 <= column < 5)
