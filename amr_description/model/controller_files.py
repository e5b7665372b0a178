# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The parameter files of a robot's controllers: which it names, and which controllers they have types
for.

A type stands in the section of the controller manager (``arm.type``) or in that of the controller
itself (``arm: {ros__parameters: {type: …}}``), as for the ``spawner`` of ros2_control.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from amr_description.ament_index import own_share, parameter_path
from amr_description.errors import ResourceError
from amr_description.model.gazebo.tags import gazebo_plugins_of, ros2_control_host_of
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.parameter_files import dotted, flatten, read_parameter_file, Section, sections

VELOCITY_TOPICS = {
    'AckermannSteeringController': '~/reference',
    'BicycleSteeringController': '~/reference',
    'DiffDriveController': '~/cmd_vel',
    'MecanumDriveController': '~/reference',
    'OmniWheelDriveController': '~/cmd_vel',
    'TricycleController': '~/cmd_vel',
    'TricycleSteeringController': '~/reference',
}
"""The controllers that drive a robot, by their class, and the topics of their TwistStamped."""

TWIST_MUX = 'TwistMuxController'
"""The class that commands one of them, by topics of its parameters: then those drive."""

_TYPE = '.type'


@dataclass(frozen=True, slots=True)
class DeclaredController:
    """A controller that parameter files have a type for."""

    name: str
    type: str
    file: Path | None = None
    """That has its type in its own section, so that a spawner has to name it; None: no need."""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    """Those of its node, by dotted name."""
    remappings: tuple[tuple[str, str], ...] = ()
    """Of ``node_options_args`` in the section of the manager: (from, to)."""

    @property
    def is_broadcaster(self) -> bool:
        """Whether it only publishes states."""
        return self.type.lower().endswith('broadcaster')

    @property
    def class_name(self) -> str:
        """The class in its type."""
        return class_of(self.type)

    @property
    def velocity_topic(self) -> str:
        """The topic of TwistStamped that drives, as its node names it; '': it does not drive."""
        if self.class_name != TWIST_MUX:
            return VELOCITY_TOPICS.get(self.class_name, '')
        group, given = 'cmd_vel_inputs.', self.parameters
        inputs = sorted({name.split('.')[1] for name in given if name.startswith(group)})
        if not inputs:
            return ''
        highest = max(inputs, key=lambda name: int(given.get(f'{group}{name}.priority', 0)))
        return str(given.get(f'{group}{highest}.topic', f'{highest}/cmd_vel'))


def class_of(controller_type: str) -> str:
    """Return the class in the type of a controller, ``package/Class`` or ``package::Class``."""
    return controller_type.replace('::', '/').rpartition('/')[2]


def manager_of(robot: Robot) -> tuple[str, str]:
    """Return the namespace, absolute, and the name of a robot's controller manager."""
    host = ros2_control_host_of(robot)
    return f'/{host.namespace.strip("/")}', host.controller_manager_name


def named_files(robot: Robot) -> list[str]:
    """Return what the ros2_control plugins of a URDF name in ``<parameters>``, as written."""
    hosts = [each for each in gazebo_plugins_of(robot) if each.hosts_ros2_control]
    return list(dict.fromkeys(path for each in hosts for path in each.parameters))


def existing_files(named: Iterable[str]) -> list[Path]:
    """Return those of the named files that are there."""
    found = []
    for written in named:
        try:
            path = parameter_path(written)
        except ResourceError:  # of a package that is not installed
            continue
        found += [path] if path.is_file() else []
    return found


def missing_files(named: Iterable[str]) -> list[str]:
    """Return those of the named files that are not there, as written."""
    return [written for written in named if not existing_files([written])]


def files_of(robot: Robot) -> list[Path]:
    """
    Return the files that a URDF names, else the shipped one, if that is for this robot.

    It is for none without ``<ros2_control>``, even if plugins of Gazebo drive it.
    """
    shipped = own_share() / 'config' / 'controllers.yaml'
    found = existing_files(named_files(robot))
    is_for_it = hardware_of(robot) and not foreign_wheels(robot, shipped)
    return found or ([shipped] if is_for_it else [])


def foreign_wheels(robot: Robot, file: Path) -> list[str]:
    """Return the wheels in a parameter file that a robot with ``<ros2_control>`` lacks."""
    if not hardware_of(robot):
        return []
    wheels = [
        wheel
        for section in sections(read_parameter_file(file))
        for keys, value in flatten(section.parameters)
        if str(keys[-1]).endswith('_wheel_names')
        for wheel in value
    ]
    return [wheel for wheel in wheels if not robot.has_joint(wheel)]


def declared_controllers(
    files: Sequence[Path], namespace: str, manager: str
) -> list[DeclaredController]:
    """
    Return the controllers that files have types for: broadcasters first, the rest in their order.

    Args:
        files: later ones override earlier ones.
        namespace: that of the controller manager, absolute.
        manager: its name.

    Raises:
        ParameterError: a file is no parameter file.
    """
    read = [(file, each) for file in files for each in sections(read_parameter_file(file))]
    prefix = namespace.rstrip('/')
    listed = _values(section for _, section in read if section.is_of(f'{prefix}/{manager}'))
    types = {
        name.removesuffix(_TYPE): value
        for name, value in listed.items()
        if name.endswith(_TYPE) and isinstance(value, str)
    }
    own_files: dict[str, Path] = {}
    for file, section in read:
        name = section.pattern.rpartition('/')[2]
        if '*' in name or name in types or not section.is_of(f'{prefix}/{name}'):
            continue
        kind = _values([section]).get('type')
        if isinstance(kind, str):
            types[name], own_files[name] = kind, file
    found = [
        DeclaredController(
            name,
            kind,
            own_files.get(name),
            _values(section for _, section in read if section.is_of(f'{prefix}/{name}')),
            tuple(_remappings(listed.get(f'{name}.node_options_args'))),
        )
        for name, kind in types.items()
    ]
    return sorted(found, key=lambda each: not each.is_broadcaster)


def claimed_names(
    robot: Robot, files: Sequence[Path] | None = None, namespace: str = ''
) -> frozenset[str]:
    """
    Return what the controllers of parameter files may claim: joints, and others by their names.

    Args:
        robot: whose controllers they are.
        files: None: those that the robot names, else the shipped one, if it is for this robot.
        namespace: of the controller manager; empty: that of the robot.

    Raises:
        ParameterError: a file is no parameter file.
    """
    inside, manager = manager_of(robot)
    found = declared_controllers(
        files_of(robot) if files is None else files, namespace or inside, manager
    )
    values = [
        value
        for each in found
        if not each.is_broadcaster
        for given in each.parameters.values()
        for value in (given if isinstance(given, list) else [given])
    ]
    return frozenset(value.partition('/')[0] for value in values if isinstance(value, str))


def spawner_words(controllers: Sequence[DeclaredController]) -> list[str]:
    """Return the words of a ``spawner`` for controllers, with the files that some need."""
    if not any(each.file for each in controllers):
        return [each.name for each in controllers]
    words = ['--switch-asap']
    for each in controllers:
        words += ['--controller', each.name]
        words += ['--param-file', str(each.file)] if each.file else []
    return words


def _values(found: Iterable[Section]) -> dict[str, Any]:
    """Return the parameters of sections by dotted name; the last one counts."""
    return {
        dotted(keys): value
        for section in found
        if isinstance(section.parameters, dict)
        for keys, value in flatten(section.parameters)
    }


def remapping(rule: str) -> tuple[str, str] | None:
    """Return a rule ``from:=to`` as a pair; None: it is another word."""
    old, separator, new = rule.partition(':=')
    return (old, new) if separator else None


def _remappings(words: object) -> Iterable[tuple[str, str]]:
    """Yield the rules among ROS arguments."""
    found = map(remapping, map(str, words if isinstance(words, list) else ()))
    return (rule for rule in found if rule is not None)
