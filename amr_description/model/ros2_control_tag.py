# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``<ros2_control>`` blocks -> :class:`~amr_description.model.hardware_info.HardwareInfo`.

Errors begin with the words of ros2_control where it has some (``Joint 'x' not found in URDF``).
"""

from collections.abc import Iterator

from lxml import etree

from amr_description.model.element_reader import ElementReader, line_of
from amr_description.model.findings import quote, quote_all, raise_error, Report
from amr_description.model.hardware_info import (
    ComponentInfo,
    ComponentType,
    HardwareInfo,
    HardwareType,
)
from amr_description.model.robot import Joint, JointType, Mimic, Robot
from amr_description.model.ros2_control_interfaces import (
    read_component,
    read_parameters,
    read_text,
    read_transmission,
    refuse_unknown_children,
)
from amr_description.model.xml_source import parse_xml

_CHILDREN = ('hardware', 'properties', 'joint', 'sensor', 'gpio', 'transmission')


def hardware_of(robot: Robot) -> tuple[HardwareInfo, ...]:
    """
    Return the hardware components of a robot, in the order of the file; () when it has none.

    DescriptionError (``file:line: …``) at the first fault of a block.
    """
    xml = parse_xml(robot.text, robot.source, raise_error)
    return () if xml is None else read_hardware(xml, robot, raise_error)


def read_hardware(xml: etree._Element, robot: Robot, report: Report) -> tuple[HardwareInfo, ...]:
    """Return what can be read of the blocks below ``xml``, reporting every fault."""
    reader = ElementReader(robot.source, report)
    found: dict[str, HardwareInfo] = {}
    for element in xml.iterchildren('ros2_control'):
        info = _read_block(element, robot, reader)
        if info.name in found:
            reader.error(
                element,
                f'Hardware name {info.name} is duplicated',
                found=f'the first on line {found[info.name].line}',
                fix="provide a unique 'name' in the URDF",
            )
        found.setdefault(info.name, info)
    return tuple(found.values())


def _read_block(element: etree._Element, robot: Robot, reader: ElementReader) -> HardwareInfo:
    name = element.get('name', '')
    reader = reader.of(f'ros2_control {quote(name)}')
    if not name:
        reader.error(element, '<ros2_control> has no attribute "name"')
    refuse_unknown_children(element, _CHILDREN, reader)
    kind = _read_type(element, reader)
    hardware = _read_hardware_element(element, reader)
    joints = tuple(_read_joints(element, robot, reader))
    _check_mimicked(element, joints, reader)
    return HardwareInfo(
        name=name,
        type=kind,
        plugin='' if hardware is None else read_text(hardware, 'plugin', reader),
        group='' if hardware is None else hardware.findtext('group', '').strip(),
        parameters={} if hardware is None else read_parameters(hardware, reader),
        rw_rate=_read_rate(element, reader),
        is_async=reader.flag(element, 'is_async', False),
        joints=joints,
        sensors=_read_components(element, ComponentType.SENSOR, reader),
        gpios=_read_components(element, ComponentType.GPIO, reader),
        transmissions=tuple(
            read_transmission(child, reader) for child in element.iterchildren('transmission')
        ),
        line=line_of(element),
    )


def _read_type(element: etree._Element, reader: ElementReader) -> HardwareType:
    text = element.get('type', '')
    if text in HardwareType:
        return HardwareType(text)
    reader.error(
        element,
        'type of <ros2_control>',
        found=quote(text),
        expected=f'one of {", ".join(HardwareType)}',
    )
    return HardwareType.SYSTEM


def _read_hardware_element(
    element: etree._Element, reader: ElementReader
) -> etree._Element | None:
    hardware = element.find('hardware')
    if hardware is None:
        reader.error(
            element,
            'no <hardware>',
            fix='add <hardware><plugin>amr_description/MujocoSystem</plugin></hardware>',
        )
        return None
    refuse_unknown_children(hardware, ('plugin', 'group', 'param'), reader)
    return hardware


def _read_rate(element: etree._Element, reader: ElementReader) -> int:
    """Return ``rw_rate`` in Hz, 0 when it is not given."""
    text = element.get('rw_rate')
    if text is None:
        return 0
    if not (text.isascii() and text.isdigit() and 0 < len(text) <= 6 and int(text) > 0):
        reader.error(
            element, 'rw_rate', found=quote(text), expected='a non-zero positive integer, in Hz'
        )
        return 0
    return int(text)


def _read_components(
    element: etree._Element, kind: ComponentType, reader: ElementReader
) -> tuple[ComponentInfo, ...]:
    return tuple(read_component(child, kind, reader) for child in element.iterchildren(kind))


def _read_joints(
    element: etree._Element, robot: Robot, reader: ElementReader
) -> Iterator[ComponentInfo]:
    seen: set[str] = set()
    for child in element.iterchildren('joint'):
        name = child.get('name', '')
        if name in seen:
            reader.error(child, f"Joint '{name}' is listed twice", fix='list it once')
            continue
        seen.add(name)
        if name and not robot.has_joint(name):
            moving = quote_all([joint.name for joint in robot.joints if joint.has_position])
            reader.error(
                child,
                f"Joint '{name}' not found in URDF",
                expected=f'one of {moving}',
            )
        joint = robot.joint(name) if robot.has_joint(name) else None
        if joint is not None and joint.type is JointType.FIXED:
            reader.error(
                child,
                f"Joint '{name}' is of type 'fixed'",
                expected='a joint that moves: fixed joints do not make sense in ros2_control',
            )
        yield read_component(child, ComponentType.JOINT, reader, _read_mimic(child, joint, reader))


def _read_mimic(
    element: etree._Element, joint: Joint | None, reader: ElementReader
) -> Mimic | None:
    """Return how the URDF makes the joint follow another; None if the tag switches it off."""
    mimic = None if joint is None else joint.mimic
    if not reader.flag(element, 'mimic', mimic is not None):
        return None
    name = element.get('name', '')
    if mimic is None and joint is not None:
        reader.error(
            element,
            f'Joint \'{name}\' has mimic="true", but no <mimic> in the URDF',
            fix='add <mimic joint="…"/> to the <joint>, or remove the attribute',
        )
    if mimic is not None and element.find('command_interface') is not None:
        reader.error(
            element,
            f"Joint '{name}' has mimic attribute not set to false: activated mimic joints cannot "
            'have command interfaces',
            fix='remove its command interfaces or write mimic="false"',
        )
    return mimic


def _check_mimicked(
    element: etree._Element, joints: tuple[ComponentInfo, ...], reader: ElementReader
) -> None:
    names = [joint.name for joint in joints]
    for joint in joints:
        if joint.mimic is not None and joint.mimic.joint not in names:
            reader.error(
                element,
                f"Joint '{joint.name}' mimics a joint that is not in this tag",
                found=quote(joint.mimic.joint),
                expected=f'one of {quote_all(names)}',
            )
