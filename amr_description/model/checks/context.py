# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the rules of the checker get: the description, and what it is checked against.
"""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

from lxml import etree

from amr_description.model.findings import Finding, SourceLocation
from amr_description.model.frames import Transform
from amr_description.model.gazebo.plugins import PluginTag
from amr_description.model.gazebo.tags import GazeboPlugin
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.kinematics import link_poses
from amr_description.model.mended_inertials import bodies_of, mended_inertials, MendedInertial
from amr_description.model.mesh_uses import find_meshes, FindFile, MeshUse
from amr_description.model.robot import Joint, JointType, Robot, WORLD_LINK
from amr_description.model.wheels import find_wheels, Wheel


@dataclass(frozen=True, slots=True)
class DriveSettings:
    """
    The parameters of one diff_drive_controller; lengths in m.

    ``location`` is the line of the controller, ``locations`` that of each parameter by its name.
    """

    name: str
    location: SourceLocation
    left_wheels: tuple[str, ...]
    right_wheels: tuple[str, ...]
    separation: float
    radius: float
    separation_multiplier: float
    base_frame: str
    odom_frame: str
    publishes_transform: bool
    position_feedback: bool
    open_loop: bool
    left_radius_multiplier: float = 1.0
    right_radius_multiplier: float = 1.0
    tags: Mapping[str, PluginTag] | None = None
    """Of a plugin of Gazebo: the elements that give its sizes; None: it is a controller's."""
    locations: Mapping[str, SourceLocation] = field(default_factory=dict)

    @property
    def wheels(self) -> tuple[str, ...]:
        """The names of all its wheels, the left ones first."""
        return (*self.left_wheels, *self.right_wheels)

    @property
    def is_plugin(self) -> bool:
        """Whether it is a plugin of Gazebo."""
        return self.tags is not None

    def named(self, parameter: str) -> str:
        """Return what a parameter is called where it is written."""
        return self.tags[parameter].text if self.tags else parameter

    def per(self, parameter: str) -> float:
        """Return what is written, by what it means: 2 for a diameter that gives a radius."""
        return self.tags[parameter].per if self.tags else 1.0

    def written(self, parameter: str, value: float) -> str:
        """Return a parameter as it is to be written, of a value of it."""
        if self.tags:
            return self.tags[parameter].written(value)
        return f'{parameter}: {_decimal(value)}'

    def location_of(self, parameter: str) -> SourceLocation:
        """Return the line of a parameter, or of the controller if no file sets it."""
        return self.locations.get(parameter, self.location)

    def error(self, parameter: str, what: str, **details: Any) -> Finding:
        """Return an error at a parameter; ``details`` as in Finding.error."""
        return Finding.error(*self.location_of(parameter), f'{self.name}: {what}', **details)

    def warning(self, parameter: str, what: str, **details: Any) -> Finding:
        """Return a warning at a parameter; ``details`` as in Finding.warning."""
        return Finding.warning(*self.location_of(parameter), f'{self.name}: {what}', **details)


def _decimal(value: float) -> str:
    """Return a number as a parameter of type double is written."""
    text = f'{value:.4g}'
    return text if '.' in text or 'e' in text else f'{text}.0'


FileExists: TypeAlias = Callable[[str], bool]
"""Return whether the file of a URI or path exists. Raises AmrError: that is not known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckInputs:
    """
    What a description is checked against.

    Attributes:
        file_exists: looks for the files that the description names; None: they are not checked.
        find_file: returns the file of a mesh; None: no mesh is read.
        drives: the controllers of the robot.
        hardware_plugins: the names of those that are shipped; empty: they are not checked.
    """

    file_exists: FileExists | None = None
    find_file: FindFile | None = None
    drives: tuple[DriveSettings, ...] = ()
    hardware_plugins: Collection[str] = ()


@dataclass(frozen=True)
class CheckContext:
    """A description as far as it could be read; the tree of the robot may be broken."""

    robot: Robot
    hardware: tuple[HardwareInfo, ...]
    gazebo_plugins: tuple[GazeboPlugin, ...]
    xml: etree._Element
    inputs: CheckInputs

    @cached_property
    def poses(self) -> dict[str, Transform]:
        """``transform_link_to_root`` of each link that is below a root, with all joints at 0."""
        return link_poses(self.robot)

    @cached_property
    def bodies(self) -> dict[str, str]:
        """The topmost link of each link's rigid body: links joined by fixed joints are one."""
        return bodies_of(self.robot)

    @cached_property
    def mended_inertials(self) -> dict[str, MendedInertial]:
        """What the simulator gives links instead of their ``<inertial>``, by link."""
        return mended_inertials(self.robot)

    @cached_property
    def fixed_links(self) -> frozenset[str]:
        """The links that are rigidly joined to a root called ``world``."""
        return frozenset(link for link, top in self.bodies.items() if top == WORLD_LINK)

    @cached_property
    def speed_joints(self) -> tuple[Joint, ...]:
        """The continuous joints that take a velocity command, in the order of the file."""
        commanded = {
            component.name
            for hardware in self.hardware
            for component in hardware.joints
            if any(interface.name == 'velocity' for interface in component.command_interfaces)
        }
        return tuple(
            joint
            for joint in self.robot.joints
            if joint.name in commanded
            and joint.type is JointType.CONTINUOUS
            and joint.child in self.poses
        )

    def wheels_of(self, drive: DriveSettings) -> tuple[Wheel, ...]:
        """Return the wheels of a drive whose shapes are round about their joints."""
        return find_wheels(self.robot, drive.wheels)

    @cached_property
    def meshes(self) -> tuple[MeshUse, ...]:
        """The meshes whose files are found; none without :attr:`CheckInputs.find_file`."""
        find_file = self.inputs.find_file
        return () if find_file is None else find_meshes(self.robot, find_file)

    @cached_property
    def wheels(self) -> tuple[Wheel, ...]:
        """The wheels: links that are round about the axis of a joint with a velocity command."""
        return find_wheels(self.robot, {joint.name for joint in self.speed_joints})

    def error(self, line: int, what: str, **details: Any) -> Finding:
        """Return an error on a line of this description; ``details`` as in Finding.error."""
        return Finding.error(self.robot.source, line, what, **details)

    def warning(self, line: int, what: str, **details: Any) -> Finding:
        """Return a warning on a line of this description; ``details`` as in Finding.warning."""
        return Finding.warning(self.robot.source, line, what, **details)


Rule: TypeAlias = Callable[[CheckContext], Iterator[Finding]]
