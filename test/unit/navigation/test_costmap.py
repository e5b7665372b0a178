# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Costs around obstacles of map and scan, and the footprint that is put among them."""

from dataclasses import replace
import math

import numpy as np
import pytest

from amr_description.errors import ParameterError
from amr_description.maps.grid import OccupancyGrid, OCCUPIED, UNKNOWN
from amr_description.maps.pose import Pose
from amr_description.navigation.costmap import (
    Costmap,
    CostmapSettings,
    INSCRIBED,
    LETHAL,
    NO_INFORMATION,
)
from amr_description.navigation.footprint import (
    circumscribed_radius,
    inscribed_radius,
    outline,
    placed,
    read_footprint,
)

SETTINGS = CostmapSettings(inflation_radius=0.5, cost_scaling_factor=3.0, inf_is_valid=True)


def costmap(*, occupied=(), unknown=(), shape=(40, 40), settings=SETTINGS):
    cells = np.zeros(shape, dtype=np.int8)
    for row, column in occupied:
        cells[row, column] = OCCUPIED
    for row, column in unknown:
        cells[row, column] = UNKNOWN
    return Costmap(OccupancyGrid(cells, 0.05, Pose(-1.0, -1.0, 0.0)), 0.17, settings)


def test_costs_fall_as_those_of_the_inflation_layer():
    costs = costmap(occupied=[(20, 20)], unknown=[(0, 0)]).costs
    assert costs[20, 20] == LETHAL
    assert costs[20, 23] == INSCRIBED  # 0.15 m away, nearer than the inscribed radius
    assert costs[20, 26] == int(252 * math.exp(-3.0 * (0.30 - 0.17)))
    assert costs[23, 24] == int(252 * math.exp(-3.0 * (0.25 - 0.17)))
    assert costs[20, 30] == int(252 * math.exp(-3.0 * (0.50 - 0.17)))
    assert costs[20, 31] == 0
    assert costs[0, 0] == NO_INFORMATION


@pytest.mark.parametrize('factor', [0.0, 1e6])
@pytest.mark.parametrize('occupied', [[], [(20, 20)]])
@pytest.mark.filterwarnings('error')
def test_costs_are_numbers_with_any_factor_and_without_obstacles(factor, occupied):
    settings = replace(SETTINGS, cost_scaling_factor=factor)
    costs = costmap(occupied=occupied, settings=settings).costs
    assert costs[0, 0] == 0
    if occupied:
        assert costs[20, 23] == INSCRIBED
        assert costs[20, 26] == (252 if factor == 0.0 else 0)


def test_a_scan_marks_what_it_hits_and_clears_what_it_passes():
    found = costmap()
    sensor = Pose(0.025, 0.025, 0.0)
    found.see(sensor, np.array([0.0]), np.array([0.5]))
    assert np.argwhere(found.seen).tolist() == [[20, 30]]
    assert found.costs[20, 30] == LETHAL
    assert found.costs[20, 27] == INSCRIBED
    found.see(sensor, np.array([0.0]), np.array([0.8]))
    assert np.argwhere(found.seen).tolist() == [[20, 36]]
    found.see(sensor, np.array([0.0]), np.array([math.inf]))
    assert not found.seen.any()
    assert not found.costs.any()


def test_obstacles_of_the_map_stay_whatever_passes_them():
    found = costmap(occupied=[(20, 25)])
    found.see(Pose(0.025, 0.025, 0.0), np.array([0.0]), np.array([math.inf]))
    assert found.costs[20, 25] == LETHAL


@pytest.mark.parametrize('distance', [math.nan, -math.inf, 2.6])
def test_rays_that_say_nothing_and_far_hits_mark_nothing(distance):
    found = costmap(shape=(40, 100))
    found.see(Pose(0.0, 0.0, 0.0), np.array([0.0]), np.array([distance]))
    assert not found.seen.any()


def test_inf_clears_only_if_it_is_valid():
    found = costmap(settings=CostmapSettings())
    found.see(Pose(0.025, 0.025, 0.0), np.array([0.0]), np.array([0.5]))
    found.see(Pose(0.025, 0.025, 0.0), np.array([0.0]), np.array([math.inf]))
    assert found.seen.any()
    found.clear()
    assert not found.seen.any()


def test_costs_near_a_seen_obstacle_are_those_of_one_in_the_map():
    seen = costmap(occupied=[(5, 5)])
    seen.see(Pose(0.025, 0.025, 0.7), np.array([0.0]), np.array([0.6]))
    (cell,) = np.argwhere(seen.seen).tolist()
    assert (seen.costs == costmap(occupied=[(5, 5), tuple(cell)]).costs).all()


def test_what_is_outside_is_blocked_and_unknown():
    found = costmap(occupied=[(20, 25)])
    assert found.cost_at(5.0, 0.0) == NO_INFORMATION
    assert found.is_blocked(np.array([[0.0, 0.0], [5.0, 0.0]]))
    assert found.is_blocked(np.array([[0.27, 0.02]]))
    assert not found.is_blocked(np.array([[0.0, 0.0]]))


def test_costs_of_points_outside_are_unknown():
    points = np.array([[0.0, 0.0], [5.0, 0.0], [0.0, -5.0]])
    found = costmap(occupied=[(20, 20)]).costs_at(points)
    assert found.tolist() == [LETHAL, NO_INFORMATION, NO_INFORMATION]


def test_a_turned_map_is_refused():
    grid = OccupancyGrid(np.zeros((4, 4), dtype=np.int8), 0.05, Pose(0.0, 0.0, 0.1))
    with pytest.raises(ValueError, match=r'turned by 0\.1 rad'):
        Costmap(grid, 0.17, SETTINGS)


def test_the_footprint_is_read_as_nav2_writes_it():
    corners = read_footprint('[[0.3, 0.17], [0.3, -0.17], [-0.3, -0.17], [-0.3, 0.17]]')
    assert inscribed_radius(corners) == pytest.approx(0.17)
    assert circumscribed_radius(corners) == pytest.approx(math.hypot(0.3, 0.17))
    points = outline(corners, 0.05)
    gaps = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
    assert gaps.max() <= 0.05 + 1e-12
    turned = placed(corners, Pose(1.0, 2.0, math.pi / 2))
    assert turned[0] == pytest.approx((1.0 - 0.17, 2.0 + 0.3))


@pytest.mark.parametrize(
    ('text', 'complaint'),
    [
        ('round', 'no list of corners'),
        ('[[0.1, 0.2, 0.3]]', 'no list of corners'),
        ('[[nan, 0], [0, 1], [1, 0]]', 'no list of corners'),
        ('[[0.1, 0.1], [0.2, 0.2]]', '2 corners; it needs 3'),
        ('[[1, 1], [2, 1], [2, 2], [1, 2]]', 'origin of the robot is not inside'),
    ],
)
def test_a_footprint_that_is_none_is_refused(text, complaint):
    with pytest.raises(ParameterError, match=complaint):
        read_footprint(text)
