# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A simulated robot driven to a goal, without ROS: what the navigator does, on the true map and pose.

So a planner or a follower of one's own is tried in seconds:
``drive_to(sim, (1.5, 0.5), plan=my_plan)``.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from amr_description.ament_index import path_of, resolve_uri
from amr_description.controller_manager.plain_parameters import given_parameters
from amr_description.errors import SimulationError
from amr_description.maps.pose import Pose
from amr_description.model.footprint import footprint
from amr_description.model.frames import yaw_of
from amr_description.navigation.behaviors import DriveStatus
from amr_description.navigation.costmap import Costmap, CostmapSettings
from amr_description.navigation.drive import NavigationDrive, NavigationDriveSettings
from amr_description.navigation.footprint import outline, Points
from amr_description.navigation.plugins import PlanFunction, VelocityFunction
from amr_description.parameters import build
from amr_description.sim.occupancy import map_of_model, MapSettings
from amr_description.simulation.in_process import Simulation

SCAN = 'sensor_msgs/msg/LaserScan'
_LOW, _HIGH = 0.02, 0.4
"""m: what is between is in the way, as on the ``/obstacle_map`` of the navigation stack."""
_SPACING = 0.025
"""m between points of the outline: half a cell."""
_SCAN_PERIOD = 0.1
"""s"""
_NAVIGATOR = 'package://amr_description/config/navigator.yaml'


@cache
def settings_of_amr() -> tuple[NavigationDriveSettings, CostmapSettings]:
    """Return the parameters of the navigator and of its costmap, by ``config/navigator.yaml``."""
    arguments = ('--params-file', str(path_of(_NAVIGATOR)))
    values = given_parameters('/navigator', arguments)
    drive = build(NavigationDriveSettings, values)
    return drive, build(CostmapSettings, values, 'costmap.')


def drive_to(
    sim: Simulation,
    goal: Pose | tuple[float, ...],
    *,
    plan: PlanFunction | None = None,
    velocity: VelocityFunction | None = None,
    settings: NavigationDriveSettings | None = None,
    costs: CostmapSettings | None = None,
    seconds: float = 120.0,
    watch: Callable[[NavigationDrive], Any] = lambda _drive: None,
) -> NavigationDrive:
    """
    Drive the robot to a goal, on the map of its world; what its lidar sees is in the way, too.

    It knows where it is: its pose is the truth. At the end it has been told to stand.

    Args:
        sim: Has one robot, with a controller that takes velocities.
        goal: In the frame of the world: a pose, (x, y) or (x, y, yaw), m and rad.
        plan: In place of the built-in planner; see :mod:`amr_description.navigation.plugins`.
        velocity: In place of the built-in follower.
        settings: Of the navigator; None: those of amr.
        costs: Of its costmap; None: those of amr.
        seconds: At most, of simulated time.
        watch: Called before each step.

    Returns:
        How it has ended: ``status``, ``error``, ``path``, ``plans`` and ``recoveries``.

    Raises:
        SimulationError: The simulation cannot go on, or the time is over.
        MapError: The world has no map.
        DescriptionError: The robot has no footprint.
    """
    usual, usual_costs = settings_of_amr()
    settings = settings or usual
    costmap, corners = _surroundings(sim, costs or usual_costs)
    target = goal if isinstance(goal, Pose) else Pose(*map(float, (*goal, 0.0)[:3]))
    drive = NavigationDrive(
        settings, outline(corners, _SPACING), [target], plan=plan, velocity=velocity
    )
    period = 1.0 / settings.controller_frequency
    until, seen = sim.time + seconds, -_SCAN_PERIOD
    while drive.status is DriveStatus.RUNNING:
        if sim.time > until:
            raise SimulationError(
                f'after {seconds:g} s the robot is {drive.remaining(_pose(sim)):.2f} m from its '
                'goal; more seconds, or another way, will do'
            )
        if sim.time - seen >= _SCAN_PERIOD - 1e-9:
            seen = sim.time
            _see(sim, costmap)
        watch(drive)
        truth = sim.truth
        command = drive.step(sim.time, _pose(sim), (truth.linear[0], truth.angular[2]), costmap)
        sim.drive(command.linear, command.angular, seconds=period, stop=False)
    return drive


def _surroundings(sim: Simulation, costs: CostmapSettings) -> tuple[Costmap, Points]:
    """Return what is around the robot, and its corners, m."""
    description, start = sim.robot.description, sim.truth
    shape = footprint(description, resolve_uri, frame=description.root.name)
    settings = MapSettings(height=_LOW, top=_HIGH, start=(start.x, start.y))
    grid = map_of_model(sim.world.engine.model, settings)
    return Costmap(grid, shape.inscribed_radius, costs), np.array(shape.corners)


def _pose(sim: Simulation) -> Pose:
    truth = sim.truth
    return Pose(truth.x, truth.y, truth.yaw)


def _see(sim: Simulation, costmap: Costmap) -> None:
    """Have the costmap see what a level lidar sees; without one it has the map alone."""
    robot = sim.robot
    for topic, kind in robot.sensor_topics.items():
        if kind == SCAN:
            scan = robot.scan_of(topic)
            place = robot.transform(robot.root_frame, scan.frame)
            x, y, _ = place.translation
            sensor = _pose(sim).compose(Pose(x, y, yaw_of(place.rotation)))
            costmap.see(sensor, scan.angles, scan.ranges)
