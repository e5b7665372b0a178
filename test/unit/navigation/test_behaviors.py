# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Single motions and waypoints, with a robot that does at once what it is told."""

import math

import numpy as np
import pytest

from amr_description.maps.grid import OccupancyGrid, OCCUPIED
from amr_description.maps.pose import Pose
from amr_description.navigation.behaviors import (
    AssistedTeleop,
    BackUp,
    BehaviorDrive,
    DriveOnHeading,
    DriveStatus,
    RecoverySettings,
    Spin,
    Wait,
)
from amr_description.navigation.costmap import Costmap, CostmapSettings
from amr_description.navigation.drive import NavigationDrive, NavigationDriveSettings
from amr_description.navigation.footprint import outline
from amr_description.navigation.waypoints import WaypointDrive, WaypointSettings

SETTINGS = RecoverySettings()
OUTLINE = outline(np.array([[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]), 0.025)
PERIOD = 0.05
MIDDLE = Pose(2.0, 3.0, 0.0)


def walled():
    """A room of 6 x 6 m, the corner of which is at the origin, with a wall at x from 4 m on."""
    cells = np.zeros((120, 120), dtype=np.int8)
    cells[:, 80:84] = OCCUPIED
    return Costmap(OccupancyGrid(cells, 0.05, Pose(0.0, 0.0, 0.0)), 0.2, CostmapSettings())


def run(drive, pose=MIDDLE, until=60.0):
    """Step a drive to its end; return where the robot is then, and when."""
    costmap, now = walled(), 0.0
    while drive.status is DriveStatus.RUNNING and now < until:
        command = drive.step(now, pose, (0.0, 0.0), costmap)
        pose = pose.compose(Pose(command.linear * PERIOD, 0.0, command.angular * PERIOD))
        now += PERIOD
    return pose, now


def behavior(kind, **options):
    return BehaviorDrive(lambda pose, now: kind(SETTINGS, OUTLINE, pose, now, **options))


@pytest.mark.parametrize('angle', [1.0, -1.0, 5.0, -7.0])
def test_a_spin_turns_by_its_angle_to_either_side(angle):
    drive = behavior(Spin, angle=angle, allowance=0.0)
    pose, _ = run(drive)
    assert drive.status is DriveStatus.SUCCEEDED
    assert math.cos(pose.yaw - angle) == pytest.approx(1.0, abs=1e-3)
    assert drive.behavior.done == pytest.approx(abs(angle), abs=0.05)
    assert (pose.x, pose.y) == (2.0, 3.0)


@pytest.mark.parametrize(
    ('kind', 'distance', 'speed', 'moved'),
    [
        (DriveOnHeading, 0.5, 0.2, 0.5),
        (DriveOnHeading, -0.5, -0.2, -0.5),
        (BackUp, 0.5, 0.2, -0.5),
        (BackUp, -0.5, -0.2, -0.5),
    ],
)
def test_straight_on_and_back_by_the_distance(kind, distance, speed, moved):
    drive = behavior(kind, distance=distance, speed=speed)
    pose, now = run(drive)
    assert drive.status is DriveStatus.SUCCEEDED
    assert pose.x - 2.0 == pytest.approx(moved, abs=0.011)
    assert now == pytest.approx(2.5, abs=0.2)


@pytest.mark.parametrize(
    ('kind', 'options', 'code', 'text'),
    [
        (DriveOnHeading, {'distance': 3.0, 'speed': 0.5}, 723, 'collision ahead'),
        (DriveOnHeading, {'distance': 1.0, 'speed': 0.1, 'allowance': 2.0}, 721, '2 s'),
        (BackUp, {'distance': 1.0, 'speed': 0.1, 'allowance': 2.0}, 711, 'allowance'),
        (BackUp, {'distance': 3.0, 'speed': 0.5}, 714, 'collision ahead'),
        (Spin, {'angle': 3.0, 'allowance': 0.5}, 701, 'allowance'),
    ],
)
def test_what_cannot_be_done_ends_with_the_code_of_its_action(kind, options, code, text):
    drive = behavior(kind, **options)
    pose, _ = run(drive)
    assert drive.status is DriveStatus.FAILED
    assert drive.error.error_code == code
    assert text in str(drive.error)
    assert 0.3 <= pose.x <= 3.7  # it has touched neither wall nor the edge


def test_a_spin_beside_a_wall_is_refused():
    drive = behavior(Spin, angle=1.5)
    pose, _ = run(drive, Pose(3.69, 3.0, 0.0))
    assert (drive.status, drive.error.error_code) == (DriveStatus.FAILED, 703)
    assert pose.yaw < 0.4


def test_a_wait_lasts_as_long_as_it_is_asked_for():
    drive = behavior(Wait, seconds=1.5)
    pose, now = run(drive)
    assert (drive.status, pose) == (DriveStatus.SUCCEEDED, Pose(2.0, 3.0, 0.0))
    assert now == pytest.approx(1.5, abs=0.1)


def test_assisted_teleop_drives_as_told_but_into_nothing():
    wanted = [(1.0, 0.0)]
    drive = behavior(AssistedTeleop, command=lambda: wanted[0], allowance=0.0)
    pose, now = run(drive, until=10.0)
    assert drive.status is DriveStatus.RUNNING
    assert 3.5 < pose.x <= 3.7  # before the wall
    wanted[0] = None
    drive.step(now, pose, (0.0, 0.0), walled())
    assert drive.status is DriveStatus.SUCCEEDED


def test_assisted_teleop_ends_with_its_time():
    drive = behavior(AssistedTeleop, command=lambda: (0.0, 0.1), allowance=1.0)
    _, now = run(drive)
    assert (drive.status, drive.error.error_code) == (DriveStatus.FAILED, 731)
    assert now == pytest.approx(1.1, abs=0.1)


def waypoints(*places, **options):
    """A drive to places; ``stop_on_failure`` as an option."""
    settings = WaypointSettings(stop_on_failure=options.pop('stop', False))
    navigation = NavigationDriveSettings(number_of_retries=0)
    return WaypointDrive(
        settings,
        [Pose(*each, 0.0) for each in places],
        lambda goal: NavigationDrive(navigation, OUTLINE, [goal]),
        **options,
    )


def test_waypoints_are_reached_one_after_the_other_and_again():
    drive = waypoints((2.5, 3.0), (2.5, 2.0), loops=1)
    seen = []

    def step(now, pose, speed, costmap, real=drive.step):
        seen.append(drive.index)
        return real(now, pose, speed, costmap)

    drive.step = step
    pose, _ = run(drive, until=300.0)
    assert drive.status is DriveStatus.SUCCEEDED
    assert pose.distance(Pose(2.5, 2.0, 0.0)) < 0.3
    changes = [a for a, b in zip(seen, [*seen[1:], None], strict=True) if a != b]
    assert changes == [0, 1, 0, 1]
    assert drive.plans >= 4


def test_a_waypoint_that_cannot_be_reached_is_missed_or_ends_all():
    drive = waypoints((9.0, 9.0), (2.5, 3.0))
    run(drive, until=300.0)
    assert drive.status is DriveStatus.SUCCEEDED
    ((index, error),) = drive.missed
    assert (index, error.error_code) == (0, 204)
    drive = waypoints((9.0, 9.0), (2.5, 3.0), stop=True)
    run(drive, until=300.0)
    assert (drive.status, drive.error.error_code) == (DriveStatus.FAILED, 601)
    assert 'waypoint 0' in str(drive.error)


def test_parts_of_a_costmap_are_cleared():
    for inside, left in ((True, 1), (False, 1)):
        costmap = walled()
        # two hits: 1 m ahead, and 1.5 m behind
        costmap.see(Pose(2.0, 3.0, 0.0), np.array([0.0, math.pi]), np.array([1.0, 1.5]))
        assert costmap.seen.sum() == 2
        costmap.clear_square(Pose(2.0, 3.0, 0.0), 2.4, inside=inside)
        assert costmap.seen.sum() == left
        assert costmap.is_blocked(np.array([[3.0, 3.0]])) is not inside
    costmap.clear_square(Pose(-99.0, -99.0, 0.0), 1.0, inside=False)
    assert costmap.seen.sum() == 0


def test_the_window_of_a_costmap_is_around_a_place_and_within_the_map():
    costmap = walled()
    costs, corner = costmap.window(Pose(3.01, 3.01, 0.0), 3.0)
    assert costs.shape == (60, 60)
    assert (corner.x, corner.y) == pytest.approx((1.5, 1.5))
    assert (costs[:, 50:54] == 254).all()
    costs, corner = costmap.window(Pose(0.51, 5.81, 0.0), 3.0)
    assert costs.shape == (34, 40)
    assert (corner.x, corner.y) == pytest.approx((0.0, 4.3))
    assert costmap.window(Pose(99.0, 99.0, 0.0), 3.0)[0].size == 0
