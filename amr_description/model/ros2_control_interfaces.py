# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The inner elements of ``<ros2_control>``: components, interfaces, parameters, transmissions."""

import math

from lxml import etree

from amr_description.model.element_reader import ElementReader, line_of, parse_number
from amr_description.model.findings import quote
from amr_description.model.hardware_info import (
    ComponentInfo,
    ComponentType,
    InterfaceInfo,
    TransmissionEnd,
    TransmissionInfo,
)
from amr_description.model.robot import Mimic

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
_NUMERIC_PARAMETERS = ('min', 'max', 'initial_value')
_TRUTH_VALUES = {'true': 1.0, 'false': 0.0}


def refuse_unknown_children(
    element: etree._Element, known: tuple[str, ...], reader: ElementReader
) -> None:
    """Report every child element whose tag is not in ``known``."""
    for child in element.iterchildren(etree.Element):
        if child.tag not in known:
            expected = ', '.join(f'<{tag}>' for tag in known)
            reader.error(child, f'invalid tag name {quote(child.tag)}', expected=expected)


def read_text(element: etree._Element, tag: str, reader: ElementReader) -> str:
    """Return the text of a child that must be there; '' after a report."""
    text = (element.findtext(tag) or '').strip()
    if not text:
        reader.error(element, f'no {tag} in <{element.tag}>', fix=f'add <{tag}>…</{tag}>')
    return text


def read_parameters(element: etree._Element, reader: ElementReader) -> dict[str, str]:
    """Return the ``<param name="…">text</param>`` children of an element."""
    parameters = {}
    for child in element.iterchildren('param'):
        name = reader.required(child, 'name')
        if name in parameters:
            reader.error(child, f'parameter {quote(name)} is set twice', fix='set it once')
        parameters.setdefault(name, (child.text or '').strip())
    return parameters


def read_component(
    element: etree._Element,
    kind: ComponentType,
    reader: ElementReader,
    mimic: Mimic | None = None,
) -> ComponentInfo:
    """Return a ``<joint>``, ``<sensor>`` or ``<gpio>`` of a ``<ros2_control>`` block."""
    name = reader.required(element, 'name')
    reader = reader.of(f'{reader.label}, {kind} {quote(name)}')
    refuse_unknown_children(element, _COMPONENT_CHILDREN[kind], reader)
    limited = _limits_enabled(element, reader)
    commands, states = (_read_interfaces(element, tag, limited, reader) for tag in _INTERFACE_TAGS)
    return ComponentInfo(
        name=name,
        type=kind,
        command_interfaces=commands,
        state_interfaces=states,
        parameters=read_parameters(element, reader),
        mimic=mimic,
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
            reader.error(child, f'{tag} {quote(interface.name)} is there twice', fix='remove one')
        interfaces.setdefault(interface.name, interface)
    return tuple(interfaces.values())


def _read_interface(
    element: etree._Element, limited: bool, reader: ElementReader
) -> InterfaceInfo:
    name = reader.required(element, 'name')
    refuse_unknown_children(element, ('param', 'limits'), reader)
    data_type = element.get('data_type', 'double')
    if data_type not in _DATA_TYPES:
        reader.error(
            element,
            f'data_type of <{element.tag}>',
            found=quote(data_type),
            expected=f'one of {", ".join(_DATA_TYPES)}',
        )
    parameters = read_parameters(element, reader)
    numbers = {
        key: _parameter_number(element, key, parameters.pop(key), reader)
        for key in _NUMERIC_PARAMETERS
        if key in parameters
    }
    _check_range(element, numbers, reader)
    _check_initial(element, data_type, numbers.get('initial_value'), reader)
    return InterfaceInfo(
        name=name,
        data_type=data_type,
        size=_read_size(element, reader),
        limits_enabled=limited and _limits_enabled(element, reader),
        parameters=parameters,
        **numbers,
    )


def _check_range(
    element: etree._Element, numbers: dict[str, float | None], reader: ElementReader
) -> None:
    low, high = numbers.get('min'), numbers.get('max')
    if low is not None and high is not None and low > high:
        reader.error(
            element,
            'parameters "min" and "max"',
            found=f'{low:g} and {high:g}',
            expected='a "min" that is not above "max"',
        )


def _check_initial(
    element: etree._Element, data_type: str, value: float | None, reader: ElementReader
) -> None:
    """Report a first value that an integer type cannot hold."""
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


def _parameter_number(
    element: etree._Element, name: str, text: str, reader: ElementReader
) -> float | None:
    value = _TRUTH_VALUES.get(text.lower(), parse_number(text))
    if math.isfinite(value):
        return value
    reader.error(
        element, f'parameter {quote(name)}', found=quote(text), expected='a finite number'
    )
    return None


def read_transmission(element: etree._Element, reader: ElementReader) -> TransmissionInfo:
    """Return a ``<transmission>``."""
    name = reader.required(element, 'name')
    reader = reader.of(f'{reader.label}, transmission {quote(name)}')
    refuse_unknown_children(element, ('plugin', 'joint', 'actuator', 'param'), reader)
    joints, actuators = (
        tuple(_read_end(child, reader) for child in element.iterchildren(tag))
        for tag in ('joint', 'actuator')
    )
    return TransmissionInfo(name, read_text(element, 'plugin', reader), joints, actuators)


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
