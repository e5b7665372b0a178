# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Cells, lines and footprints of nav2_simple_commander, by its own names."""

from geometry_msgs.msg import Point32, Polygon
from nav2_simple_commander.costmap_2d import PyCostmap2D
from nav2_simple_commander.footprint_collision_checker import FootprintCollisionChecker
from nav2_simple_commander.line_iterator import LineIterator
from nav_msgs.msg import OccupancyGrid
import pytest


def grid(width=10, height=5, origin=(1.0, -1.0)):
    message = OccupancyGrid(data=[each % 100 for each in range(width * height)])
    message.data[0] = -1
    message.header.frame_id = 'map'
    info = message.info
    info.width, info.height, info.resolution = width, height, 0.5
    info.origin.position.x, info.origin.position.y = origin
    return message


def test_a_costmap_has_cells_by_coordinates_and_index():
    costmap = PyCostmap2D(grid())
    assert (costmap.getSizeInCellsX(), costmap.getSizeInCellsY()) == (10, 5)
    assert (costmap.getSizeInMetersX(), costmap.getSizeInMetersY()) == (4.75, 2.25)
    assert (costmap.getOriginX(), costmap.getOriginY()) == (1.0, -1.0)
    assert (costmap.getResolution(), costmap.getGlobalFrameID()) == (0.5, 'map')
    assert costmap.getCostXY(3, 2) == costmap.getCostIdx(23) == 23
    assert costmap.getCostXY(0, 0) == 255
    costmap.setCost(3, 2, 254)
    assert costmap.getCostXY(3, 2) == 254
    with pytest.raises(IndexError):
        costmap.getCostXY(0, 5)


def test_cells_and_points():
    costmap = PyCostmap2D(grid())
    assert costmap.mapToWorld(0, 4) == (1.25, 1.25)
    assert costmap.worldToMapValidated(1.25, 1.25) == (0, 4)
    for outside in ((0.9, 0.0), (6.0, 0.0), (2.0, -1.1), (2.0, 1.5)):
        assert costmap.worldToMapValidated(*outside) == (None, None)


@pytest.mark.parametrize(
    ('line', 'points'),
    [
        ((0, 0, 3, 3), [(0, 0), (1, 1), (2, 2), (3, 3)]),
        ((3, 0, 0, 6, 2), [(3, 0), (1, 4), (0, 6)]),
        ((1, 2, 1, -1), [(1, 2), (1, 1), (1, 0), (1, -1)]),
        ((0, 0, 4, 0, 9), [(0, 0), (4, 0)]),
    ],
)
def test_a_line_goes_from_its_first_to_its_last_point(line, points):
    iterator, found = LineIterator(*line), []
    while iterator.isValid():
        found.append((iterator.getX(), iterator.getY()))
        iterator.advance()
    assert found == points
    assert (iterator.getX0(), iterator.getY0()) == points[0]
    assert (iterator.getX1(), iterator.getY1()) == points[-1]


@pytest.mark.parametrize(
    ('arguments', 'error'),
    [
        ((0, 0, '10', 10, 1), TypeError),
        ((0, 0, 10, 10, 0), ValueError),
        ((0, 0, 10, 10, -2), ValueError),
        ((2, 2, 2, 2, 1), ValueError),
    ],
)
def test_what_is_no_line_is_refused(arguments, error):
    with pytest.raises(error, match='is|has'):
        LineIterator(*arguments)


def test_a_footprint_costs_as_much_as_what_its_edges_are_on():
    message = grid(20, 20, (0.0, 0.0))
    message.data = [0] * 400
    message.data[10 * 20 + 10] = 100
    costmap, checker = PyCostmap2D(message), FootprintCollisionChecker()
    with pytest.raises(ValueError, match='setCostmap'):
        checker.pointCost(0, 0)
    checker.setCostmap(costmap)
    square = Polygon(points=[Point32(x=x, y=y) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    assert checker.footprintCostAtPose(3.0, 3.0, 0.0, square) == 0.0
    assert checker.footprintCostAtPose(4.25, 5.25, 0.0, square) == 100.0
    assert checker.footprintCostAtPose(0.5, 5.0, 0.0, square) == 254.0
    costmap.setCost(10, 10, 254)
    assert checker.footprintCostAtPose(4.25, 5.25, 0.0, square) == 254.0
