# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules of the checker on ``<ros2_control>`` blocks whose text is right.

That their joints exist and that their tags are known is seen to where they are read.
"""

from collections.abc import Iterator

from amr_description.model.findings import Finding, quote
from amr_description.model.hardware_info import ComponentInfo, ComponentType, HardwareInfo
from amr_description.model.nearest import nearest
from amr_description.model.robot import JointType
from amr_description.model.subject import Subject

_MANY_COORDINATES = (JointType.PLANAR, JointType.FLOATING)
_OF_JOINTS = ('position', 'velocity', 'acceleration', 'effort', 'torque', 'force', 'current')
# Between a slip of the pen ("velocty", 0.93) and another word ("speed", 0.15).
_MISSPELT = 0.8


def commanded_joints_have_a_position(subject: Subject) -> Iterator[Finding]:
    """What takes commands is one number: no planar and no floating joint."""
    for hardware, component in _components(subject):
        if component.type is not ComponentType.JOINT or not component.command_interfaces:
            continue
        robot, name = subject.robot, component.name
        if robot.has_joint(name) and robot.joint(name).type in _MANY_COORDINATES:
            yield subject.error(
                component.line,
                f'joint {quote(name)} of ros2_control {quote(hardware.name)} takes commands',
                found=f'type {robot.joint(name).type} in the URDF',
                expected='revolute, continuous or prismatic: a position that is one number',
            )


def components_offer_interfaces(subject: Subject) -> Iterator[Finding]:
    """Every joint, sensor and GPIO of a block has an interface; what is commanded can be read."""
    for hardware, component in _components(subject):
        where = f'{component.type} {quote(component.name)} of ros2_control {quote(hardware.name)}'
        if not component.command_interfaces and not component.state_interfaces:
            yield subject.warning(
                component.line,
                f'{where} has no interface',
                fix='add <state_interface name="…"/>, or remove it',
            )
        elif component.type is ComponentType.JOINT and not component.state_interfaces:
            yield subject.warning(
                component.line,
                f'{where} takes commands, and nobody can read what it does',
                fix='add <state_interface name="position"/> and <state_interface '
                'name="velocity"/>',
            )


def interface_names_are_spelt_right(subject: Subject) -> Iterator[Finding]:
    """No interface of a joint has nearly the name of a standard one."""
    for hardware, component in _components(subject):
        if component.type is not ComponentType.JOINT:
            continue
        for interface in (*component.command_interfaces, *component.state_interfaces):
            name = interface.name
            meant = nearest(name, _OF_JOINTS, _MISSPELT) if name.isalpha() else ''
            if meant and name != meant:
                yield subject.warning(
                    component.line,
                    f'joint {quote(component.name)} of ros2_control {quote(hardware.name)}: an '
                    'interface that no controller asks for',
                    found=quote(name),
                    fix=f'write name="{meant}"',
                )


def one_block_commands(subject: Subject) -> Iterator[Finding]:
    """No command interface is offered by two blocks."""
    first: dict[tuple[str, str], str] = {}
    for hardware, component in _components(subject):
        for interface in component.command_interfaces:
            key = (component.name, interface.name)
            if first.setdefault(key, hardware.name) != hardware.name:
                yield subject.error(
                    component.line,
                    f'command interface "{component.name}/{interface.name}" is offered twice',
                    found=f'by ros2_control {quote(first[key])} and {quote(hardware.name)}',
                    fix='remove one',
                )


def _components(subject: Subject) -> Iterator[tuple[HardwareInfo, ComponentInfo]]:
    for hardware in subject.hardware:
        for component in hardware.components:
            yield hardware, component
