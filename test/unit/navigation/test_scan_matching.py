# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Scans of a room, whose rays are exact, matched against its map in cells."""

from math import pi, radians

import numpy as np
from numpy.typing import NDArray
import pytest
from support.scanned_room import ANGLES, room, scan

from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.localization import Agreement, MotionNoise, ray_ends, ScanTracker
from amr_description.navigation.scan_matching import ScanMatcher

SURE = np.diag([0.01, 0.01, 0.01])
VAGUE = np.diag([0.25, 0.25, radians(15.0) ** 2])


def points_of(ranges: NDArray[np.float64], most: int = 360) -> NDArray[np.float64]:
    return ray_ends(ranges, ANGLES, nearest=0.1, farthest=12.0, most=most)


def errors(found: Pose, true: Pose) -> tuple[float, float]:
    return found.distance(true), abs(wrapped(found.yaw - true.yaw))


POSES = [Pose(0.0, 0.0, 0.0), Pose(-2.0, 2.0, 2.5), Pose(2.5, -0.3, -1.0), Pose(0.3, 2.2, -3.1)]


@pytest.mark.parametrize('true', POSES)
def test_a_scan_gives_the_pose_within_a_centimetre(true):
    predicted = Pose(true.x + 0.1, true.y - 0.08, true.yaw + 0.08)
    noisy = scan(true) + np.random.default_rng(1).normal(0.0, 0.005, 360)
    match = ScanMatcher(room()).match(points_of(noisy), predicted, SURE)
    distance, angle = errors(match.pose, true)
    assert distance < 0.01
    assert angle < radians(0.2)
    assert match.fit > 0.99


@pytest.mark.parametrize('true', POSES)
def test_a_vague_pose_is_searched_around(true):
    predicted = Pose(true.x - 0.7, true.y + 0.6, wrapped(true.yaw + 0.4))
    match = ScanMatcher(room()).match(points_of(scan(true), 120), predicted, VAGUE)
    distance, angle = errors(match.pose, true)
    assert distance < 0.015
    assert angle < radians(0.3)


def test_what_the_map_does_not_show_does_not_matter():
    true = POSES[0]
    ranges = scan(true)
    somebody = np.abs(ANGLES - 0.5) < 0.5
    ranges[somebody] = np.minimum(ranges[somebody], 0.8)
    match = ScanMatcher(room()).match(points_of(ranges), Pose(0.05, 0.05, 0.03), SURE)
    distance, angle = errors(match.pose, true)
    assert distance < 0.015
    assert angle < radians(0.3)
    assert match.fit < 0.9


def test_the_origin_of_a_map_may_be_turned():
    true = Pose(0.4, -0.3, 0.7)
    turned = Pose(1.0, 2.0, 0.6)
    corner = Pose(-3.5, -2.5, 0.0)
    grid = room(turned.compose(corner))
    place = turned.compose(true)
    predicted = Pose(place.x + 0.05, place.y - 0.05, place.yaw + 0.05)
    match = ScanMatcher(grid).match(points_of(scan(true)), predicted, SURE)
    distance, angle = errors(match.pose, place)
    assert distance < 0.01
    assert angle < radians(0.2)


def test_along_a_corridor_the_pose_is_as_vague_as_it_was():
    walls = ((-9.0, 9.0, -0.9, -0.7), (-9.0, 9.0, 0.7, 0.9))
    ranges = scan(Pose(0.0, 0.1, 0.0), walls)
    ranges[ranges > 2.5] = np.inf
    grid = room(boxes=walls)
    match = ScanMatcher(grid).match(points_of(ranges), Pose(0.2, 0.0, 0.05), SURE)
    assert match.pose == pytest.approx((0.2, 0.1, 0.0), abs=0.01)
    along, across, _ = np.sqrt(np.diag(match.covariance))
    assert along == pytest.approx(0.1, rel=0.01)
    assert across < 0.01


def test_without_rays_the_pose_is_the_prediction():
    predicted = Pose(1.0, 0.5, 3.0)
    match = ScanMatcher(room()).match(np.empty((0, 2)), predicted, SURE)
    assert match.pose == pytest.approx(predicted)
    assert match.fit == 0.0
    np.testing.assert_allclose(match.covariance, SURE)


def test_only_rays_that_met_something_count():
    ranges = np.array([0.05, 1.0, np.inf, np.nan, 5.0, -np.inf])
    angles = np.array([0.0, pi / 2, 0.0, 0.0, pi, 0.0])
    ends = ray_ends(ranges, angles, nearest=0.1, farthest=12.0, most=10)
    np.testing.assert_allclose(ends, [[0.0, 1.0], [-5.0, 0.0]], atol=1e-12)
    assert len(ray_ends(ranges, angles, nearest=0.1, farthest=5.0, most=10)) == 1
    assert len(ray_ends(np.ones(360), ANGLES, nearest=0.1, farthest=12.0, most=60)) == 60


def tracker(**arguments: float) -> ScanTracker:
    return ScanTracker(ScanMatcher(room()), MotionNoise(), **arguments)


def test_a_drive_with_odometry_that_errs_is_followed():
    follower = tracker()
    true, odometry = Pose(-2.0, 1.5, 0.0), Pose(0.0, 0.0, 0.0)
    follower.place(true, VAGUE, odometry)
    for _ in range(40):
        true = true.compose(Pose(0.08, 0.0, -0.03))
        # It takes the robot to drive 10 % farther than it does, and to turn 20 % more.
        odometry = odometry.compose(Pose(0.088, 0.0, -0.036))
        match = follower.update(points_of(scan(true)), odometry)
        distance, angle = errors(match.pose, true)
        assert distance < 0.015
        assert angle < radians(0.5)
    estimate = follower.estimate
    assert estimate.map_to_odom.compose(odometry) == pytest.approx(match.pose)


def test_a_scan_is_matched_after_a_way_or_a_turn():
    follower = tracker(update_min_d=0.25, update_min_a=0.2)
    points = points_of(scan(POSES[0]))
    assert follower.update(points, Pose(0.0, 0.0, 0.0)) is None  # it has no pose yet
    follower.place(POSES[0], SURE, Pose(0.0, 0.0, 0.0))
    assert follower.update(points, Pose(0.0, 0.0, 0.0)) is not None  # the first one
    assert follower.update(points, Pose(0.2, 0.0, 0.1)) is None
    follower.match_next()
    assert follower.update(points, Pose(0.2, 0.0, 0.1)) is not None
    assert follower.update(points, Pose(0.2, 0.0, 0.31)) is not None
    assert follower.update(points, Pose(0.2, -0.26, 0.31)) is not None


def test_a_pose_without_a_covariance_is_as_vague_as_amcls():
    follower = tracker()
    follower.place(Pose(0.6, -0.4, 0.2), np.zeros((3, 3)), Pose(5.0, 5.0, 1.0))
    match = follower.update(points_of(scan(POSES[0])), Pose(5.0, 5.0, 1.0))
    assert match.pose == pytest.approx(POSES[0], abs=0.015)


@pytest.mark.parametrize(
    'covariance',
    [
        np.diag([-1.0, 0.25, 0.07]),  # no variance
        np.array([[0.25, 9.0, 0.0], [9.0, 0.25, 0.0], [0.0, 0.0, 0.07]]),  # more than correlated
        np.diag([1e300, 1e300, 1e300]),
        np.diag([1e4, 1e4, 1e4]),  # as of a robot that has been lost for hours
    ],
)
def test_whatever_a_covariance_says_the_search_ends(covariance):
    follower = tracker()
    follower.place(Pose(0.6, -0.4, 0.2), covariance, Pose(0.0, 0.0, 0.0))
    match = follower.update(points_of(scan(POSES[0])), Pose(0.0, 0.0, 0.0))
    assert match.pose == pytest.approx(POSES[0], abs=0.015)


def test_a_scan_of_another_place_leaves_the_pose_to_odometry():
    follower = tracker()
    follower.place(POSES[0], SURE, Pose(0.0, 0.0, 0.0))
    far_from_walls = ray_ends(np.full(360, 0.7), ANGLES, nearest=0.1, farthest=12.0, most=360)
    match = follower.update(far_from_walls, Pose(0.1, 0.0, 0.0))
    assert Agreement.of(match) is Agreement.LOST
    assert match.pose == pytest.approx((0.1, 0.0, 0.0))


def test_a_robot_that_stands_can_still_be_corrected():
    follower = tracker()
    follower.place(POSES[0], SURE, Pose(0.0, 0.0, 0.0))
    points = points_of(scan(POSES[0]))
    for _ in range(200):
        follower.update(points, Pose(0.0, 0.0, 0.0))
    pushed = Pose(0.12, 0.05, 0.05)
    for _ in range(3):
        match = follower.update(points_of(scan(pushed)), Pose(0.0, 0.0, 0.0))
    assert match.pose == pytest.approx(pushed, abs=0.01)
