# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Random goals in ``warehouse`` in lock-step: all are reached, and nothing is touched."""

import math

import pytest
from support.paths import ROOT
from support.warehouse_goals import (
    CONTACT_TOPIC,
    feeling_robot,
    FOOTPRINT,
    random_goals,
    warehouse,
)

from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.behaviors import DriveStatus
from amr_description.navigation.costmap import Costmap
from amr_description.navigation.drive import NavigationDrive
from amr_description.navigation.footprint import inscribed_radius, outline
from amr_description.simulation.goal_drive import settings_of_amr
from amr_description.testing.simulation import Simulation

PERIOD = 0.05
SETTINGS, COSTS = settings_of_amr()
GROUND = 'ground::link::collision'
LONGEST = 120.0
"""s for a goal; only a robot that is stuck takes as long."""


@pytest.fixture(scope='module')
def simulation(tmp_path_factory):
    robot = feeling_robot(tmp_path_factory.mktemp('robot'))
    with Simulation(robot, ROOT / 'config' / 'controllers.yaml', world='warehouse') as sim:
        yield sim


@pytest.fixture
def sim(simulation):
    simulation.reset()
    return simulation


def pose_of(sim):
    truth = sim.truth
    return Pose(truth.x, truth.y, truth.yaw)


def touched(sim):
    """What touches something other than the ground."""
    return {each for each in sim.contacts(CONTACT_TOPIC) if each.second != GROUND}


def see(sim, costmap):
    scan, pose = sim.scan, pose_of(sim)  # lidar_link is above the middle of the robot
    costmap.see(pose, scan.angles, scan.ranges)


def drive_to(sim, goal, costmap):
    drive = NavigationDrive(SETTINGS, outline(FOOTPRINT, 0.025), [goal])
    began = sim.time
    odd = False
    while drive.status is DriveStatus.RUNNING and sim.time - began < LONGEST:
        if odd := not odd:  # 10 Hz
            see(sim, costmap)
            assert not touched(sim), f'on the way to {goal}'
        truth = sim.truth
        command = drive.step(sim.time, pose_of(sim), (truth.linear[0], truth.angular[2]), costmap)
        sim.drive(command.linear, command.angular, seconds=PERIOD, stop=False)
    sim.drive(0.0, 0.0, seconds=0.5)
    return drive


@pytest.mark.parametrize('count', [1, pytest.param(20, marks=pytest.mark.long)])
def test_random_goals_are_reached_without_touching_anything(sim, count):
    costmap = Costmap(warehouse(), inscribed_radius(FOOTPRINT), COSTS)
    for goal in random_goals(count, seed=20):
        drive = drive_to(sim, goal, costmap)
        assert drive.status is DriveStatus.SUCCEEDED, f'{goal}: {drive.error}'
        pose = pose_of(sim)
        away, turn = pose.distance(goal), math.degrees(wrapped(pose.yaw - goal.yaw))
        print(
            f'({goal.x:.2f}, {goal.y:.2f}, {goal.yaw:.2f}) after {sim.time:.1f} s: '
            f'{1000 * away:.0f} mm, {turn:.1f} degrees, {drive.recoveries} recoveries'
        )
        assert away < 0.10
        assert abs(turn) < 5.0
        assert not touched(sim)


def test_a_touch_would_be_felt(sim):
    assert not touched(sim)
    while sim.time < 30.0 and not (felt := touched(sim)):
        sim.drive(0.5, 0.0, seconds=0.2, stop=False)
    assert any(each.first.startswith('amr::') and each.second != GROUND for each in felt)
