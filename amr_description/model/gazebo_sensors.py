# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Lidars, cameras and contact sensors from the ``<sensor>`` tags of ``<gazebo>`` blocks."""

from amr_description.model.robot import Robot
from amr_description.model.sensors import RobotSensors


def robot_sensors_of(robot: Robot) -> RobotSensors:
    """Return the sensors of a robot."""
    del robot
    return RobotSensors()
