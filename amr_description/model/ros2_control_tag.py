# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``<ros2_control>`` blocks -> :class:`~amr_description.model.hardware_info.HardwareInfo`.

Errors begin with the text of ros2_control where it has one (``Joint 'x' not found in URDF``). What
ros2_control refuses and the simulator can live with says so (``Finding.taken``); what ros2_control
reads over (a ``min`` that is no number, an unknown element in a joint) is a warning.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
import math

from lxml import etree

from amr_description.model.findings import Finding, Report, Severity
from amr_description.model.hardware_info import (
    ComponentInfo,
    ComponentType,
    HardwareInfo,
    HardwareType,
    InterfaceInfo,
    TransmissionEnd,
    TransmissionInfo,
)
from amr_description.model.origins import raise_error_of, relocated
from amr_description.model.robot import Joint, JointType, Mimic, Robot
from amr_description.model.xml_reader import ElementReader, line_of, parse_number, parse_xml
from amr_description.text import closest_match, quote, quote_all

_INTEGER_RANGES = {
    'int8': (-(2**7), 2**7 - 1),
    'uint8': (0, 2**8 - 1),
    'int16': (-(2**15), 2**15 - 1),
    'uint16': (0, 2**16 - 1),
    'int32': (-(2**31), 2**31 - 1),
    'uint32': (0, 2**32 - 1),
}
_DATA_TYPES = ('double', 'bool', 'float32', *_INTEGER_RANGES)
_INTERFACE_TAGS = ('command_interface', 'state_interface')
_COMPONENT_CHILDREN = {
    ComponentType.JOINT: (*_INTERFACE_TAGS, 'param', 'limits'),
    ComponentType.SENSOR: ('state_interface', 'param'),
    ComponentType.GPIO: (*_INTERFACE_TAGS, 'param'),
}
_TRUTH_VALUES = {'true': 1.0, 'false': 0.0}
_CHILDREN = ('hardware', 'properties', 'joint', 'sensor', 'gpio', 'transmission')
_LEFT_OUT = 'it is left out'
_FIRST_COUNTS = 'the first one counts'
_SIMULATED = 'its joints and sensors are simulated'


def hardware_of(
    robot: Robot, strict: bool = False, warn: Callable[[str], object] | None = None
) -> tuple[HardwareInfo, ...]:
    """
    Return the hardware components of a robot in the order of the file; () if it has none.

    Those that stand for plugins of Gazebo come last.

    Args:
        robot: the robot.
        strict: refuse all that ros2_control refuses, as real hardware has to; False: only what the
            simulator can make nothing of.
        warn: gets a line for each thing that ros2_control reads over.

    Raises:
        DescriptionError: (``file:line: …``) the first fault of a block.
    """
    raise_error = raise_error_of(robot.text, strict)

    def report(finding: Finding) -> None:
        raise_error(finding)
        if warn is not None and finding.severity is Severity.WARNING:
            warn(relocated(finding, robot.text).text)

    xml = parse_xml(robot.text, robot.source, report)
    return () if xml is None else (*read_hardware(xml, robot, report), *robot.plugin_hardware)


def read_hardware(xml: etree._Element, robot: Robot, report: Report) -> tuple[HardwareInfo, ...]:
    """Return the blocks below ``xml`` as far as they can be read; report every fault."""
    reader = ElementReader(robot.source, report)
    found: dict[str, HardwareInfo] = {}
    for element in xml.iterchildren('ros2_control'):
        kind = _read_type(element, reader)
        if kind is None:
            continue
        info = _read_block(element, kind, robot, reader)
        if info.name in found:
            reader.error(
                element,
                f'Hardware name {info.name} is duplicated',
                found=f'the first on line {found[info.name].line}',
                fix="provide a unique 'name' in the URDF",
                taken=_FIRST_COUNTS,
            )
        found.setdefault(info.name, info)
    return tuple(found.values())


def _read_block(
    element: etree._Element, kind: HardwareType, robot: Robot, reader: ElementReader
) -> HardwareInfo:
    name = element.get('name', '')
    reader = reader.of(f'ros2_control {quote(name)}')
    if not name:
        reader.error(element, '<ros2_control> has no attribute "name"')
    for child in _unknown_children(element, _CHILDREN):
        reader.error(child, **_invalid(child, _CHILDREN), taken=_LEFT_OUT)
    hardware = _read_hardware_element(element, reader)
    joints = tuple(_read_joints(element, robot, reader))
    _check_mimicked(element, joints, reader)
    return HardwareInfo(
        name=name,
        type=kind,
        plugin='' if hardware is None else _read_plugin(hardware, reader),
        group='' if hardware is None else hardware.findtext('group', '').strip(),
        parameters={} if hardware is None else _read_parameters(hardware, reader),
        rw_rate=_read_rate(element, reader),
        is_async=reader.flag(element, 'is_async', False),
        joints=joints,
        sensors=_read_components(element, ComponentType.SENSOR, reader),
        gpios=_read_components(element, ComponentType.GPIO, reader),
        transmissions=tuple(
            _read_transmission(child, reader) for child in element.iterchildren('transmission')
        ),
        line=line_of(element),
    )


def _read_type(element: etree._Element, reader: ElementReader) -> HardwareType | None:
    """Return the type of a block; None: of one that nobody knows, which ros2_control passes by."""
    text = element.get('type', '')
    reader = reader.of(f'ros2_control {quote(element.get("name", ""))}')
    if text in set(HardwareType):
        return HardwareType(text)
    reader.error(
        element,
        'type of <ros2_control>',
        found=quote(text),
        expected=f'one of {", ".join(HardwareType)}',
        taken='the block is passed by',
    )
    return None


def _read_hardware_element(
    element: etree._Element, reader: ElementReader
) -> etree._Element | None:
    hardware = element.find('hardware')
    if hardware is None:
        reader.error(
            element,
            'no <hardware>',
            fix='add <hardware><plugin>amr_description/MujocoSystem</plugin></hardware>',
            taken=_SIMULATED,
        )
        return None
    _warn_of_unknown_children(hardware, ('plugin', 'group', 'param'), reader)
    return hardware


def _read_plugin(hardware: etree._Element, reader: ElementReader) -> str:
    """Return the name of the plugin; '' after a report."""
    return _read_text(hardware, 'plugin', reader, taken=_SIMULATED)


def _read_rate(element: etree._Element, reader: ElementReader) -> int:
    """Return ``rw_rate`` in Hz, 0 when it is not given."""
    text = element.get('rw_rate')
    if text is None:
        return 0
    if not (text.isascii() and text.isdigit() and len(text) <= 6 and int(text) > 0):
        reader.error(
            element, 'rw_rate', found=quote(text), expected='a non-zero positive integer, in Hz'
        )
        return 0
    return int(text)


def _read_joints(
    element: etree._Element, robot: Robot, reader: ElementReader
) -> Iterator[ComponentInfo]:
    seen: set[str] = set()
    for child in element.iterchildren('joint'):
        name = child.get('name', '')
        if name in seen:
            reader.error(
                child, f"Joint '{name}' is listed twice", fix='list it once', taken=_FIRST_COUNTS
            )
            continue
        seen.add(name)
        joint = robot.joint(name) if robot.has_joint(name) else None
        if not name:
            reader.required(child, 'name')
        elif joint is None:
            moving = [joint.name for joint in robot.joints if joint.has_position]
            meant = closest_match(name, moving)
            reader.error(
                child,
                f"Joint '{name}' not found in URDF",
                expected=f'one of {quote_all(moving)}',
                fix=f'write name="{meant}"' if meant else '',
                taken=_LEFT_OUT,
            )
        elif joint.type is JointType.FIXED:
            reader.error(
                child,
                f"Joint '{name}' is of type 'fixed'",
                expected='a joint that moves: fixed joints do not make sense in ros2_control',
                taken=_LEFT_OUT,
            )
        else:
            yield _read_joint(child, joint, robot, reader)


def _read_joint(
    element: etree._Element, joint: Joint, robot: Robot, reader: ElementReader
) -> ComponentInfo:
    """Return a ``<joint>``, with how it follows another one."""
    component = _read_component(element, ComponentType.JOINT, reader)
    mimic = joint.mimic
    if mimic is None and not component.command_interfaces:
        mimic = _mimic_of_parameters(element, component.parameters, robot, reader)
    if not reader.flag(element, 'mimic', mimic is not None):
        return component
    if mimic is None:
        reader.error(
            element,
            f'Joint \'{joint.name}\' has mimic="true", but no <mimic> in the URDF',
            fix='add <mimic joint="…"/> to the <joint>, or remove the attribute',
            taken='it moves by itself',
        )
    elif component.command_interfaces:
        reader.error(
            element,
            f"Joint '{joint.name}' has mimic attribute not set to false: activated mimic joints "
            'cannot have command interfaces',
            fix='remove its command interfaces or write mimic="false"',
            taken='it follows the other joint, and its commands have no effect',
        )
    return replace(component, mimic=mimic)


def _mimic_of_parameters(
    element: etree._Element, parameters: Mapping[str, str], robot: Robot, reader: ElementReader
) -> Mimic | None:
    """Return how ``<param name="mimic">`` makes a joint follow another, as Humble has it."""
    source = parameters.get('mimic', '')
    if not source:
        return None
    numbers = {
        name: parse_number(parameters[name])
        for name in ('multiplier', 'offset')
        if name in parameters
    }
    if robot.has_joint(source) and all(map(math.isfinite, numbers.values())):
        return Mimic(source, **numbers)
    found = ', '.join(f'{name} {quote(parameters[name])}' for name in ('mimic', *numbers))
    reader.warning(
        element,
        'it does not follow another joint',
        found=found,
        expected='the name of a joint, and numbers',
    )
    return None


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
                taken='it follows that joint all the same',
            )


def _read_components(
    element: etree._Element, kind: ComponentType, reader: ElementReader
) -> tuple[ComponentInfo, ...]:
    return tuple(_read_component(child, kind, reader) for child in element.iterchildren(kind))


def _read_component(
    element: etree._Element, kind: ComponentType, reader: ElementReader
) -> ComponentInfo:
    """Return a ``<joint>``, ``<sensor>`` or ``<gpio>`` of a ``<ros2_control>`` block."""
    name = reader.required(element, 'name')
    reader = reader.of(f'{reader.label}, {kind} {quote(name)}')
    _warn_of_unknown_children(element, _COMPONENT_CHILDREN[kind], reader)
    limited = _limits_enabled(element, reader)
    commands, states = (_read_interfaces(element, tag, limited, reader) for tag in _INTERFACE_TAGS)
    return ComponentInfo(
        name=name,
        type=kind,
        command_interfaces=commands,
        state_interfaces=states,
        parameters=_read_parameters(element, reader),
        line=line_of(element),
    )


def _limits_enabled(element: etree._Element, reader: ElementReader) -> bool:
    limits = element.find('limits')
    return True if limits is None else reader.flag(limits, 'enable', True)


def _read_interfaces(
    element: etree._Element, tag: str, limited: bool, reader: ElementReader
) -> tuple[InterfaceInfo, ...]:
    interfaces: dict[str, InterfaceInfo] = {}
    for child in element.iterchildren(tag):
        interface = _read_interface(child, limited, reader)
        if interface.name in interfaces:
            reader.error(
                child,
                f'{tag} {quote(interface.name)} is there twice',
                fix='remove one',
                taken=_FIRST_COUNTS,
            )
        interfaces.setdefault(interface.name, interface)
    return tuple(interfaces.values())


def _read_interface(
    element: etree._Element, limited: bool, reader: ElementReader
) -> InterfaceInfo:
    name = reader.required(element, 'name')
    _warn_of_unknown_children(element, ('param', 'limits'), reader)
    data_type = element.get('data_type', 'double')
    if data_type not in _DATA_TYPES:
        reader.error(
            element,
            f'data_type of <{element.tag}>',
            found=quote(data_type),
            expected=f'one of {", ".join(_DATA_TYPES)}',
        )
    parameters = _read_parameters(element, reader)
    low, high = _read_bounds(element, parameters, reader)
    initial = _read_initial(element, parameters.pop('initial_value', ''), reader)
    _check_initial(element, data_type, initial, reader)
    return InterfaceInfo(
        name=name,
        data_type=data_type,
        size=_read_size(element, reader),
        min=low,
        max=high,
        initial_value=initial,
        limits_enabled=limited and _limits_enabled(element, reader),
        parameters=parameters,
    )


def _read_bounds(
    element: etree._Element, parameters: dict[str, str], reader: ElementReader
) -> tuple[float | None, float | None]:
    """
    Take ``min`` and ``max`` out of the parameters; None where there is none.

    ros2_control skips both if one cannot be read. It does not compare them, and a ``min`` above
    the ``max`` leaves no command at all.
    """
    texts = {key: parameters.pop(key) for key in ('min', 'max') if parameters.get(key)}
    bounds = {key: _number(text) for key, text in texts.items()}
    for key, value in bounds.items():
        if not math.isfinite(value):
            reader.warning(
                element,
                f'parameter {quote(key)}',
                found=quote(texts[key]),
                expected='a finite number',
                fix='its bounds are skipped',
            )
            return None, None
    low, high = bounds.get('min'), bounds.get('max')
    if low is not None and high is not None and low > high:
        reader.warning(
            element,
            'parameters "min" and "max"',
            found=f'{low:g} and {high:g}',
            expected='a "min" that is not above "max"',
            fix='its bounds are skipped',
        )
        return None, None
    return low, high


def _read_initial(element: etree._Element, text: str, reader: ElementReader) -> float | None:
    """Return ``initial_value``; None without one."""
    value = _number(text)
    if not text or math.isfinite(value):
        return value if text else None
    reader.error(
        element,
        'parameter "initial_value"',
        found=quote(text),
        expected='a finite number',
        taken='it is left out',
    )
    return None


def _number(text: str) -> float:
    """Return the number that the text of a parameter stands for; NaN if it is none."""
    return _TRUTH_VALUES.get(text.lower(), parse_number(text))


def _check_initial(
    element: etree._Element, data_type: str, value: float | None, reader: ElementReader
) -> None:
    """Report an initial value that an integer type cannot hold."""
    if value is None or data_type not in _INTEGER_RANGES:
        return
    low, high = _INTEGER_RANGES[data_type]
    if not (value.is_integer() and low <= value <= high):
        reader.error(
            element,
            'parameter "initial_value"',
            found=f'{value:g}',
            expected=f'an integer from {low} to {high}, as its data_type is {data_type}',
        )


def _read_size(element: etree._Element, reader: ElementReader) -> int:
    size = reader.number(element, 'size', 1.0)
    if size < 1 or (math.isfinite(size) and not size.is_integer()):
        reader.error(
            element,
            f'size of <{element.tag}>',
            found=quote(element.get('size', '')),
            expected='an integer of 1 or more',
        )
    return int(size) if size >= 1 else 1


def _read_transmission(element: etree._Element, reader: ElementReader) -> TransmissionInfo:
    """Return a ``<transmission>``."""
    name = reader.required(element, 'name')
    reader = reader.of(f'{reader.label}, transmission {quote(name)}')
    _warn_of_unknown_children(element, ('plugin', 'joint', 'actuator', 'param'), reader)
    joints, actuators = (
        tuple(_read_end(child, reader) for child in element.iterchildren(tag))
        for tag in ('joint', 'actuator')
    )
    return TransmissionInfo(name, _read_text(element, 'plugin', reader), joints, actuators)


def _read_end(element: etree._Element, reader: ElementReader) -> TransmissionEnd:
    """Return a ``<joint>`` or ``<actuator>`` of a transmission; its numbers are child elements."""
    numbers = {}
    for tag, default in (('mechanical_reduction', 1.0), ('offset', 0.0)):
        text = element.findtext(tag)
        value = default if text is None else parse_number(text.strip())
        if not math.isfinite(value):
            reader.error(element, f'<{tag}>', found=quote(text or ''), expected='a finite number')
        numbers[tag] = value
    return TransmissionEnd(
        name=reader.required(element, 'name'), role=element.get('role', ''), **numbers
    )


def _unknown_children(element: etree._Element, known: tuple[str, ...]) -> Iterator[etree._Element]:
    """Yield every child element whose tag is not in ``known``."""
    return (child for child in element.iterchildren(etree.Element) if child.tag not in known)


def _warn_of_unknown_children(
    element: etree._Element, known: tuple[str, ...], reader: ElementReader
) -> None:
    """Report every child element that ros2_control does not look for."""
    for child in _unknown_children(element, known):
        reader.warning(child, **_invalid(child, known), fix='it has no effect')


def _invalid(child: etree._Element, known: tuple[str, ...]) -> dict[str, str]:
    """Return the words of a finding about an element that has no place here."""
    expected = ', '.join(f'<{tag}>' for tag in known)
    return {'what': f'invalid tag name {quote(child.tag)}', 'expected': expected}


def _read_text(element: etree._Element, tag: str, reader: ElementReader, taken: str = '') -> str:
    """Return the text of a child that must be there; '' after a report."""
    text = (element.findtext(tag) or '').strip()
    if not text:
        reader.error(
            element, f'no {tag} in <{element.tag}>', fix=f'add <{tag}>…</{tag}>', taken=taken
        )
    return text


def _read_parameters(element: etree._Element, reader: ElementReader) -> dict[str, str]:
    """Return the ``<param name="…">text</param>`` children of an element."""
    parameters: dict[str, str] = {}
    for child in element.iterchildren('param'):
        name = reader.required(child, 'name')
        if name in parameters:
            reader.warning(
                child, f'parameter {quote(name)} is set twice', fix='the last one counts'
            )
        parameters[name] = (child.text or '').strip()
    return parameters
