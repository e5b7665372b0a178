# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot of a simulation in lock-step: spawned, controlled, and read by its topics."""

from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any, TypeAlias

from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import SpawnEntity

from amr_description.control.ros.client import ManagerClient, SPAWNER_SERVICES
from amr_description.errors import SimulationError
from amr_description.model.controller_files import declared_controllers, manager_of
from amr_description.model.frames import Transform
from amr_description.model.gazebo_bridge import Bridge, bridged, NO_BRIDGE
from amr_description.model.gazebo_translation import translate
from amr_description.model.robot import Robot as Description
from amr_description.ros.log_thread import LoggerLog
from amr_description.ros.messages import fill_pose
from amr_description.simulation.api import namespace_of, RobotApi
from amr_description.simulation.readings import Contact, Image, Joint, Motion, Points, Scan
from amr_description.simulation.spawned_controllers import (
    BROADCASTER,
    spawn_declared,
    Topics,
    topics_of,
)
from amr_description.simulation.tracebacks import is_for_the_test
from amr_description.testing.lock_step import LatestMessage, LockStep, TIMEOUT
from amr_description.testing.readings import joints_of, motion_of_entity, motion_of_odometry
from amr_description.testing.sensors import RobotReadings

__tracebackhide__ = is_for_the_test

TopicTypes: TypeAlias = Sequence[tuple[str, Sequence[str]]]
