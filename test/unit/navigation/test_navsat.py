# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Degrees ↔ metres against published points and laws; where the world of a robot is in them."""

import math

from hypothesis import given, strategies as st
import pytest

from amr_description.errors import ParameterError
from amr_description.model.frames import quaternion_from_rpy, quaternion_from_yaw, Transform
from amr_description.navigation.navsat import (
    Datum,
    GeoPoint,
    heading_of,
    LocalCartesian,
    Utm,
    without_mounting,
    world_from_grid,
)

PLACES = st.builds(
    GeoPoint, st.floats(-80.0, 83.9), st.floats(-180.0, 179.9), st.floats(-100.0, 9000.0)
)
EAST = (0.0, 0.0, 0.0, 1.0)


def near(place, expected, within):
    assert math.dist(place[:2], expected) < within


@pytest.mark.parametrize(
    ('point', 'zone', 'place'),
    [
        # The CN Tower, as Wikipedia's page on UTM has it; then by what UTM is defined by.
        (GeoPoint(43.642567, -79.387139), Utm(17, True), (630084.3, 4833438.6)),
        (GeoPoint(0.0, 3.0), Utm(31, True), (500_000.0, 0.0)),
        (GeoPoint(-0.000001, 3.0), Utm(31, False), (500_000.0, 10_000_000.0 - 0.1105)),
    ],
)
def test_points_of_which_the_place_is_known(point, zone, place):
    assert Utm.of(point) == zone
    near(zone.forward(point), place, within=0.05)


def test_a_quarter_of_a_meridian_is_as_long_as_geodesy_has_it():
    assert Utm(31, True).forward(GeoPoint(90.0, 3.0))[1] == pytest.approx(
        0.9996 * 10_001_965.7293, abs=1e-3
    )


@pytest.mark.parametrize(
    ('latitude', 'longitude', 'zone'),
    [(60.0, 4.0, 32), (55.9, 4.0, 31), (75.0, 8.9, 31), (75.0, 9.0, 33), (75.0, 41.0, 37),
     (75.0, 42.0, 38), (-33.9, 151.2, 56), (10.0, 180.0, 1), (10.0, -180.0, 1)],
)  # fmt: skip
def test_zones_with_norway_and_svalbard(latitude, longitude, zone):
    assert Utm.of(GeoPoint(latitude, longitude)) == Utm(zone, latitude >= 0.0)


@pytest.mark.parametrize('latitude', [84.0, -80.1])
def test_near_a_pole_there_is_no_zone(latitude):
    with pytest.raises(ParameterError, match='set use_local_cartesian: true'):
        Utm.of(GeoPoint(latitude, 0.0))


@given(PLACES)
def test_there_and_back(point):
    for grid in (Utm.of(point), LocalCartesian(GeoPoint(point.latitude, point.longitude - 0.1))):
        found = grid.back(grid.forward(point))
        assert found.latitude == pytest.approx(point.latitude, abs=1e-10)
        assert math.remainder(found.longitude - point.longitude, 360.0) == pytest.approx(
            0.0, abs=1e-9
        )
        assert found.altitude == pytest.approx(point.altitude, abs=1e-4)


@given(PLACES)
def test_convergence_is_where_a_step_north_goes(point):
    grid, step = Utm.of(point), 1e-5
    south, north = (
        grid.forward(GeoPoint(point.latitude + each, point.longitude)) for each in (-step, step)
    )
    to_the_left = math.atan2(south[0] - north[0], north[1] - south[1])
    assert grid.convergence(point) == pytest.approx(to_the_left, abs=1e-6)


@given(PLACES)
def test_utm_turned_by_its_convergence_is_the_plane_at_the_point(point):
    """Two ways to the same metres: the series, and the geometry of the ellipsoid."""
    origin = GeoPoint(point.latitude, point.longitude)
    away = GeoPoint(point.latitude + 1e-4, point.longitude + 1e-4)
    zone, plane = Utm.of(origin), LocalCartesian(origin)
    begin, end = zone.forward(origin), zone.forward(away)
    east, north = end[0] - begin[0], end[1] - begin[1]
    turn = -zone.convergence(origin)
    turned = (
        east * math.cos(turn) - north * math.sin(turn),
        east * math.sin(turn) + north * math.cos(turn),
    )
    expected = plane.forward(away)[:2]
    # The scale of UTM is 0.9996 at the meridian of a zone, more beside it.
    assert math.dist(turned, expected) < 2e-3 * math.hypot(*expected)


def test_the_world_begins_where_the_robot_was():
    """It looked to the north; its odometry said: at (1, 2), to the east."""
    point = GeoPoint(50.0, 8.0, 100.0)
    grid = LocalCartesian(GeoPoint(50.0, 8.0))
    datum = Datum(point, quaternion_from_yaw(math.pi / 2), Transform((1.0, 2.0, 0.0), EAST))
    world = world_from_grid(datum, grid, heading_of(datum, grid, 0.0))
    assert world.apply(grid.forward(point)) == pytest.approx((1.0, 2.0, 0.0))
    east, north, up = grid.forward(point)
    assert world.apply((east, north + 3.0, up + 1.0)) == pytest.approx((4.0, 2.0, 1.0))
    assert world.apply((east + 3.0, north, up)) == pytest.approx((1.0, -1.0, 0.0))


def test_a_receiver_at_the_bow_and_an_offset_of_the_compass():
    grid = LocalCartesian(GeoPoint(50.0, 8.0))
    datum = Datum(GeoPoint(50.0, 8.0), EAST, Transform(), receiver=(2.0, 0.0, 0.5))
    heading = heading_of(datum, grid, math.pi / 2)
    world = world_from_grid(datum, grid, heading)
    assert world.apply((0.0, 0.0, 0.0)) == pytest.approx((2.0, 0.0, 0.5))
    assert world.apply((0.0, 1.0, 0.0)) == pytest.approx((3.0, 0.0, 0.5))


def test_odometry_that_rolls_leaves_the_world_level():
    grid = LocalCartesian(GeoPoint(50.0, 8.0))
    tilted = Transform((0.0, 0.0, 0.0), quaternion_from_rpy(0.3, -0.2, 0.0))
    world = world_from_grid(Datum(GeoPoint(50.0, 8.0), EAST, tilted), grid, 0.0)
    assert world.apply((5.0, 0.0, 0.0)) == pytest.approx((5.0, 0.0, 0.0))


def test_an_imu_that_looks_aside():
    mounting = quaternion_from_yaw(math.pi / 2)
    pitched = quaternion_from_rpy(0.0, 0.1, math.pi / 2)
    roll = without_mounting(pitched, mounting)
    assert roll == pytest.approx(quaternion_from_rpy(-0.1, 0.0, 0.0), abs=1e-9)
