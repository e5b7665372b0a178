# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/your_own_planner.md: its functions drive the robot; what is wrong with one is a line."""

import math
import re
import sys

import numpy as np
import pytest
from support.doc_pages import Page

from amr_description import Simulation
from amr_description.errors import NavigationError, ParameterError, SimulationError
from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.pose import Pose
from amr_description.navigation.behaviors import DriveStatus
from amr_description.navigation.costmap import Costmap, CostmapSettings
from amr_description.navigation.drive import NavigationDrive, NavigationDriveSettings
from amr_description.navigation.path_follower import PursuitSettings
from amr_description.navigation.planner import PlannerSettings
from amr_description.navigation.plugins import find_follower, find_planner
from amr_description.simulation.goal_drive import drive_to

PAGE = Page('your_own_planner.md')
_FORMS, PLANNER, DRIVE, FOLLOWER = PAGE.blocks('python')
ROOM = Costmap(
    OccupancyGrid(np.zeros((80, 80), dtype=np.int8), 0.05, Pose(-2.0, -2.0, 0.0)),
    0.17,
    CostmapSettings(),
)
START, GOAL = Pose(0.0, 0.0, 0.0), Pose(1.0, 0.5, 0.0)


@pytest.fixture
def my_nav(tmp_path, monkeypatch):
    """The package of the page, where Python finds it."""
    package = tmp_path / 'my_nav'
    package.mkdir()
    (package / '__init__.py').touch()
    for name, block in (('my_planner', PLANNER), ('my_follower', FOLLOWER)):
        (package / f'{name}.py').write_text(block)
        (tmp_path / f'{name}.py').write_text(block)
    monkeypatch.syspath_prepend(str(tmp_path))


@pytest.mark.usefixtures('my_nav')
def test_the_planner_drives_as_the_page_prints_it(capsys):
    PAGE.run(DRIVE)
    assert [capsys.readouterr().out] == PAGE.blocks('text')


@pytest.mark.usefixtures('my_nav')
def test_both_drive_by_the_names_of_the_yaml_file():
    (table,) = PAGE.tables()
    named = table['/**/navigator']['ros__parameters']
    settings = NavigationDriveSettings(
        planner=PlannerSettings(plugin=named['planner']['plugin']),
        pursuit=PursuitSettings(plugin=named['FollowPath']['plugin']),
    )
    with Simulation('package://amr_description/urdf/amr.urdf') as sim:
        drive = drive_to(sim, (0.6, 0.6, 1.0), settings=settings)
        assert drive.status is DriveStatus.SUCCEEDED, drive.error
        assert math.hypot(sim.truth.x - 0.6, sim.truth.y - 0.6) < 0.25
        assert sim.truth.yaw == pytest.approx(1.0, abs=0.3)


def test_a_robot_that_does_not_come_to_its_goal_in_time_is_said():
    with (
        Simulation('package://amr_description/urdf/amr.urdf') as sim,
        pytest.raises(SimulationError, match=r'after 1 s the robot is 1\.\d+ m from its goal'),
    ):
        drive_to(sim, (2.0, 0.0), seconds=1.0)


def raise_it(*_):
    raise KeyError('left')


@pytest.mark.parametrize(
    ('function', 'code', 'words'),
    [
        (raise_it, 200, r"the planner has failed: KeyError: 'left' \(test_docs_planner.py:\d+\)"),
        (lambda *_: None, 208, r'no path from \(0.00, 0.00\) to \(1.00, 0.50\)'),
        (lambda *_: [], 208, 'no path from'),
        (lambda *_: 7, 200, 'the planner has failed: TypeError'),
        (lambda *_: sys.exit(1), 200, 'the planner has failed: SystemExit'),
        (lambda *_: [(1.0,), (2.0,)], 200, 'the planner has failed: ValueError'),
        (lambda *_: [(0.0, 0.0), (math.nan, 0.5)], 200, r'point 1 of the 2 .* is \(nan, 0.5\)'),
        (lambda *_: [Pose(0.0, 0.0, math.nan), GOAL], 200, r'point 0 of the 2 .* yaw=nan'),
        (lambda *_: [(0.0, 0.0), (0.5, 0.5)], 208, 'ends 0.50 m from the goal, more than two'),
    ],
)
def test_what_a_planner_does_wrong_is_one_line(function, code, words):
    with pytest.raises(NavigationError, match=words) as failure:
        find_planner(PlannerSettings(), function)(ROOM, START, GOAL)
    assert failure.value.error_code == code
    assert '\n' not in str(failure.value)


@pytest.mark.parametrize(
    ('function', 'words'),
    [
        (raise_it, "the controller has failed: KeyError: 'left'"),
        (lambda *_: None, 'the controller has failed: TypeError'),
        (lambda *_: sys.exit(1), 'the controller has failed: SystemExit'),
        (lambda *_: (math.nan, 0.0), r'has returned \(nan, 0.0\); m/s and rad/s'),
    ],
)
def test_what_a_follower_does_wrong_ends_the_goal_with_one_line(function, words):
    drive = NavigationDrive(NavigationDriveSettings(), np.zeros((1, 2)), [GOAL], velocity=function)
    command = drive.step(0.0, START, (0.0, 0.0), ROOM)
    assert drive.status is DriveStatus.FAILED
    assert (command.linear, command.angular) == (0.0, 0.0)
    assert drive.error.error_code == 100
    assert re.search(words, str(drive.error))


def test_what_is_given_is_what_the_functions_get():
    seen = []

    def velocity(*given):
        seen.append(given)
        return 0.1, 0.0

    poses = [START, Pose(0.5, 0.0, 0.3), GOAL]
    drive = NavigationDrive(
        NavigationDriveSettings(),
        np.zeros((1, 2)),
        [GOAL],
        plan=lambda *_: poses,
        velocity=velocity,
    )
    drive.step(0.0, Pose(0.4, 0.0, 0.0), (0.1, 0.2), ROOM)
    ((pose, twist, path, costmap, dt),) = seen
    assert (pose, twist, dt) == (Pose(0.4, 0.0, 0.0), (0.1, 0.2), 0.05)
    assert (path, costmap) == (poses[1:], ROOM)


def test_one_that_drives_at_an_obstacle_is_held():
    cells = np.zeros((80, 80), dtype=np.int8)
    cells[:, 50] = 100
    walled = Costmap(OccupancyGrid(cells, 0.05, Pose(-2.0, -2.0, 0.0)), 0.1, CostmapSettings())
    goal = Pose(1.0, 0.0, 0.0)
    drive = NavigationDrive(
        NavigationDriveSettings(),
        np.zeros((1, 2)),
        [goal],
        plan=lambda *_: [Pose(0.05 * k, 0.0, 0.0) for k in range(20)] + [goal],
        velocity=lambda *_: (0.5, 0.0),
    )
    assert drive.step(0.0, Pose(0.15, 0.0, 0.0), (0.5, 0.0), walled).linear == 0.0
    assert drive.status is DriveStatus.RUNNING, 'it waits, and recovers'


@pytest.mark.parametrize('name', ['nowhere.planner/plan', 'math/pi', 'SmacPlanner', ''])
@pytest.mark.parametrize(
    ('find', 'settings'), [(find_planner, PlannerSettings), (find_follower, PursuitSettings)]
)
def test_a_name_of_nothing_is_refused_in_one_line(find, settings, name):
    with pytest.raises(ParameterError) as refusal:
        find(settings(plugin=name))
    assert f"'{name}'" in str(refusal.value)
    assert '\n' not in str(refusal.value)
