# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Goals from the first step to the end, with a robot that does what it is told, or does not."""

from dataclasses import replace
import math

import numpy as np
import pytest

from amr_description.maps.grid import OccupancyGrid, OCCUPIED
from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.behaviors import DriveStatus, WheelCommand
from amr_description.navigation.costmap import Costmap, CostmapSettings
from amr_description.navigation.drive import (
    FAILED_TO_MAKE_PROGRESS,
    GoalCheckerSettings,
    NavigationDrive,
    NavigationDriveSettings,
    PATIENCE_EXCEEDED,
)
from amr_description.navigation.footprint import outline, placed
from amr_description.navigation.planner import GOAL_OCCUPIED, GOAL_OUTSIDE_MAP, NO_VALID_PATH

START = Pose(1.0, 1.0, 0.0)
CORNERS = np.array([[0.3, 0.17], [0.3, -0.17], [-0.3, -0.17], [-0.3, 0.17]])
OUTLINE = outline(CORNERS, 0.025)
SETTINGS = NavigationDriveSettings(
    goal_checker=GoalCheckerSettings(xy_goal_tolerance=0.05, yaw_goal_tolerance=0.05)
)
PERIOD = 0.05


class Robot:
    """Follows commands within 1 m/s² and 2.5 rad/s²; ``works`` False: stands."""

    def __init__(self, pose=START, *, works=True):
        self.pose, self.speed, self.works = pose, (0.0, 0.0), works
        self.now = 0.0
        self.commands = []

    def follow(self, drive, costmap, *, until=300.0, watch=lambda _robot: None):
        while drive.status is DriveStatus.RUNNING and self.now < until:
            command = drive.step(self.now, self.pose, self.speed, costmap)
            self.commands.append(command)
            self.move(command)
            assert not costmap.is_blocked(placed(OUTLINE, self.pose))
            watch(self)

    def move(self, command: WheelCommand):
        if self.works:
            linear = limited(self.speed[0], command.linear, 1.0 * PERIOD)
            self.speed = (linear, limited(self.speed[1], command.angular, 2.5 * PERIOD))
            turn = self.speed[1] * PERIOD
            step = self.speed[0] * PERIOD
            half = turn / 2
            moved = Pose(step * math.cos(half), step * math.sin(half), turn)
            self.pose = self.pose.compose(moved)
        self.now += PERIOD


def limited(old, new, step):
    return min(max(new, old - step), old + step)


def room(*walls):
    """5 m square, its lower left corner at 0, 0; ``walls`` are (rows, columns)."""
    cells = np.zeros((100, 100), dtype=np.int8)
    for rows, columns in walls:
        cells[rows, columns] = OCCUPIED
    settings = CostmapSettings(inflation_radius=0.7, cost_scaling_factor=3.0, inf_is_valid=True)
    return Costmap(OccupancyGrid(cells, 0.05, Pose(0.0, 0.0, 0.0)), 0.17, settings)


def drive_to(*goals):
    return NavigationDrive(SETTINGS, OUTLINE, goals)


@pytest.mark.parametrize('yaw', [0.0, 1.5, 3.1, -2.0])
def test_a_goal_is_reached_in_place_and_yaw(yaw):
    robot, goal = Robot(), Pose(3.0, 3.5, yaw)
    drive = drive_to(goal)
    robot.follow(drive, room())
    assert drive.status is DriveStatus.SUCCEEDED
    assert robot.pose.distance(goal) <= 0.05
    assert abs(wrapped(robot.pose.yaw - yaw)) <= 0.06
    assert robot.commands[-1] == WheelCommand()
    assert drive.recoveries == 0


def test_walls_are_driven_around_without_touching():
    robot = Robot(Pose(1.0, 4.0, 0.0))
    drive = drive_to(Pose(4.0, 4.0, 0.0))
    robot.follow(drive, room((slice(25, 100), 50)))
    assert drive.status is DriveStatus.SUCCEEDED


def test_poses_are_passed_in_order():
    robot, passed = Robot(), []
    corners = [Pose(4.0, 1.0, 0.0), Pose(4.0, 4.0, 0.0), Pose(1.0, 4.0, 1.57)]
    drive = drive_to(*corners)
    left = set()

    def watch(robot):
        left.add(drive.goals_left)
        passed.append(robot.pose)

    robot.follow(drive, room(), watch=watch)
    assert drive.status is DriveStatus.SUCCEEDED
    assert left == {3, 2, 1}
    for corner in corners:
        assert min(corner.distance(each) for each in passed) < 0.1


def test_a_given_path_is_followed():
    path = [Pose(1.0 + 0.05 * k, 1.0 + 0.3 * math.sin(0.05 * k), 0.0) for k in range(60)]
    robot = Robot()
    drive = NavigationDrive(SETTINGS, OUTLINE, [path[-1]], given_path=path)
    away = []
    robot.follow(
        drive,
        room(),
        watch=lambda robot: away.append(min(robot.pose.distance(each) for each in path)),
    )
    assert drive.status is DriveStatus.SUCCEEDED
    assert max(away) < 0.1
    assert drive.plans == 1


def test_what_a_scan_sees_is_driven_around():
    robot, costmap = Robot(), room()
    goal = Pose(4.0, 1.0, 0.0)
    drive = drive_to(goal)
    angles = np.linspace(-0.6, 0.6, 200)

    def watch(robot):
        # A box of 0.6 m stands at x = 2.5; its near side is seen from 1.2 m on.
        ahead = 2.5 - robot.pose.x
        if 0.5 < ahead < 1.2 and abs(robot.pose.y - 1.0) < 0.1:
            ranges = np.where(np.abs(np.tan(angles)) * ahead < 0.3, ahead / np.cos(angles), np.nan)
            costmap.see(Pose(robot.pose.x, robot.pose.y, 0.0), angles, ranges)

    robot.follow(drive, costmap, watch=watch)
    assert costmap.seen.any()
    assert drive.status is DriveStatus.SUCCEEDED
    assert robot.pose.distance(goal) <= 0.05


def test_parameters_may_change_on_the_way():
    drive, robot, costmap = drive_to(Pose(4.0, 1.0, 0.0)), Robot(), room()
    robot.follow(drive, costmap, until=2.0)
    assert robot.commands[-1].linear == pytest.approx(0.5)
    drive.configure(replace(SETTINGS, pursuit=replace(SETTINGS.pursuit, desired_linear_vel=0.3)))
    robot.follow(drive, costmap)
    assert max(each.linear for each in robot.commands[41:]) == pytest.approx(0.3)
    costmap.configure(replace(costmap.settings, inflation_radius=0.0))
    assert not costmap.costs.any()


def test_a_map_that_becomes_smaller_on_the_way_ends_the_goal():
    drive, robot = drive_to(Pose(4.0, 4.0, 0.0)), Robot()
    robot.follow(drive, room(), until=1.0)
    cells = np.zeros((40, 40), dtype=np.int8)
    small = Costmap(OccupancyGrid(cells, 0.05, Pose(0.0, 0.0, 0.0)), 0.17, CostmapSettings())
    drive.step(robot.now, robot.pose, robot.speed, small)
    assert drive.error.error_code == GOAL_OUTSIDE_MAP


def test_a_goal_in_an_obstacle_fails_at_once():
    robot = Robot()
    drive = drive_to(Pose(2.5, 3.0, 0.0))
    robot.follow(drive, room((slice(50, 70), slice(45, 55))))
    assert drive.status is DriveStatus.FAILED
    assert drive.error.error_code == GOAL_OCCUPIED
    assert robot.commands == [WheelCommand()]


def test_no_way_is_a_failure_after_all_recoveries():
    robot = Robot()
    drive = drive_to(Pose(4.0, 1.0, 0.0))
    robot.follow(drive, room((slice(0, 100), 50)))
    assert drive.status is DriveStatus.FAILED
    assert drive.error.error_code == NO_VALID_PATH
    assert drive.recoveries == SETTINGS.number_of_retries
    assert any(command.angular > 0.5 for command in robot.commands)  # it has spun …
    assert any(command.linear < 0.0 for command in robot.commands)  # … and backed up
    assert robot.commands[-1] == WheelCommand()


def test_wheels_that_do_not_turn_are_a_lack_of_progress():
    robot = Robot(works=False)
    drive = drive_to(Pose(4.0, 1.0, 0.0))
    robot.follow(drive, room(), until=1000.0)
    assert drive.status is DriveStatus.FAILED
    assert drive.error.error_code == FAILED_TO_MAKE_PROGRESS
    assert 'do its wheels get the commands' in str(drive.error)


def test_a_given_path_into_a_wall_is_not_driven():
    path = [Pose(1.0 + 0.05 * k, 1.0, 0.0) for k in range(60)]
    robot = Robot()
    drive = NavigationDrive(SETTINGS, OUTLINE, [path[-1]], given_path=path)
    robot.follow(drive, room((slice(0, 100), 50)))
    assert drive.status is DriveStatus.FAILED
    assert drive.error.error_code == PATIENCE_EXCEEDED
    assert 'would touch' in str(drive.error)
