# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of a ROS node from a table of :mod:`amr_description.parameters`."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from copy import copy
import dataclasses
from typing import Any, cast, TypeVar

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterEvent,
    SetParametersResult,
)
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_parameter_events, QoSPolicyKind
from rclpy.qos_overriding_options import QoSOverridingOptions

from amr_description.errors import ParameterError
from amr_description.former_parameters import understand
from amr_description.parameters import build, Spec, specs, Value
from amr_description.ros.rclpy_internals import (
    parameter_overrides,
    replace_parameter_event_publisher,
    set_parameter_override,
)

Table = TypeVar('Table')

PUBLISHER_POLICIES = (
    QoSPolicyKind.DEPTH,
    QoSPolicyKind.DURABILITY,
    QoSPolicyKind.HISTORY,
    QoSPolicyKind.RELIABILITY,
)
"""What rclcpp lets be overridden of a publisher, as a rule."""

_NO_DEFAULTS: Mapping[str, Value] = {}


def declare(
    node: Node, table: type[Table], *, defaults: Mapping[str, Value] = _NO_DEFAULTS
) -> Table:
    """
    Declare every row of ``table`` on ``node`` and return the values given to it.

    ``defaults``: in place of the table's, by name.

    :raises ParameterError: A value is out of the table's bounds.
    :raises rclpy.exceptions.InvalidParameterTypeException: A value is of another type.
    """
    declare_missing(node, table, defaults=defaults)
    return values(node, table)


def declare_missing(
    node: Node, table: type, *, prefix: str = '', defaults: Mapping[str, Value] = _NO_DEFAULTS
) -> None:
    """
    Declare the rows of ``table`` that are not yet; ``prefix``: of every name, with its dot.

    What a node that allows it was told undeclared is described now, and keeps its type.
    """
    for spec in specs(table, prefix, _PresentValues(node)):
        if node.has_parameter(spec.name):
            descriptor = _descriptor(spec)
            descriptor.type = node.get_parameter(spec.name).type_.value
            node.set_descriptor(spec.name, descriptor)
        else:
            default = defaults.get(spec.name, spec.default)
            _declare(node, dataclasses.replace(spec, default=default))


def adopt_overrides(
    node: Node, *tables: type, joints: Collection[str] = (), others: Collection[str] = ()
) -> list[str]:
    """
    Have what a node was given taken as it is meant, before the tables are declared.

    Args:
        node: has the overrides.
        *tables: of its parameters.
        joints: of the robot, if it is known.
        others: the links, sensors and GPIOs of the robot.

    Returns:
        One line for each parameter that is of an earlier release, or a number of another type;
        one together for many such numbers.
    """
    overrides = parameter_overrides(node)
    lines: list[str] = []
    for table in tables:
        given = {name: each.value for name, each in overrides.items()}
        found = understand(table, given, joints, others)
        lines += found.lines
        for name, value in found.values.items():
            set_parameter_override(node, Parameter(name, value=value))
    return lines


def declare_added(node: Node, table: type) -> None:
    """Declare the rows of keyed groups that are new, as a list has got more elements since."""
    for spec in specs(table, '', _PresentValues(node)):
        if not node.has_parameter(spec.name):
            _declare(node, spec)


def declare_overrides(node: Node) -> None:
    """
    Declare what the node was given beyond its tables, for a node with undeclared parameters.

    rclpy does so itself when it is asked to, and ends with a ValueError at an empty list.
    """
    for name, given in parameter_overrides(node).items():
        if given.type_ != Parameter.Type.NOT_SET and not node.has_parameter(name):
            node.declare_parameter(name, given.value)


def values(
    node: Node, table: type[Table], changed: Iterable[Parameter] = (), *, prefix: str = ''
) -> Table:
    """
    Return the node's present values, with those of ``changed`` in their place.

    :raises ParameterError: A value is not of the table's type or out of its bounds.
    """
    present = _PresentValues(node)
    found = {
        spec.name: present[spec.name]
        for spec in specs(table, prefix, present)
        if spec.name in present
    }
    return build(table, found | {each.name: each.value for each in changed}, prefix)


class _PresentValues(Mapping[str, Any]):
    """
    The values of a node's parameters, by name, as they are when they are asked for.

    Its names are also those that the node was given, and has not declared.
    """

    def __init__(self, node: Node) -> None:
        self._node = node

    def __getitem__(self, name: str) -> Any:
        if not self._node.has_parameter(name):
            raise KeyError(name)
        return self._node.get_parameter(name).value

    def __iter__(self) -> Iterator[str]:
        return iter(parameter_overrides(self._node).keys() | self._declared())

    def __len__(self) -> int:
        return len(list(iter(self)))

    def _declared(self) -> set[str]:
        return set(self._node.get_parameters_by_prefix(''))


def add_validation_callback(node: Node, *tables: type) -> None:
    """Check every set of parameters against ``tables``; what is refused has a reason."""

    def check(changed: list[Parameter]) -> SetParametersResult:
        try:
            for table in tables:
                values(node, table, changed)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    node.add_on_set_parameters_callback(check)


def add_parameter_event_qos_overrides(node: Node) -> None:
    """
    Let ``qos_overrides./parameter_events.publisher.…`` decide, as every plain node of rclcpp does.
    """
    publisher = node.create_publisher(
        ParameterEvent,
        '/parameter_events',
        copy(qos_profile_parameter_events),
        qos_overriding_options=QoSOverridingOptions(PUBLISHER_POLICIES),
    )
    replace_parameter_event_publisher(node, publisher)


def _declare(node: Node, spec: Spec) -> None:
    if not spec.type.endswith('_array'):
        node.declare_parameter(spec.name, spec.default, _descriptor(spec))
        return
    array_type = Parameter.Type[spec.type.upper()]
    # An empty list has no type of its own in rclpy: the type is declared, then the value is set.
    if node.declare_parameter(spec.name, array_type).type_ == Parameter.Type.NOT_SET:
        node.set_parameters(
            [Parameter(spec.name, array_type, [*cast('tuple[Any, ...]', spec.default)])]
        )
    descriptor = _descriptor(spec)
    descriptor.type = array_type.value
    node.set_descriptor(spec.name, descriptor)


def _descriptor(spec: Spec) -> ParameterDescriptor:
    """Meaning, unit and range of one row."""
    unit = f' [{spec.unit}]' if spec.unit else ''
    descriptor = ParameterDescriptor(
        name=spec.name, description=spec.doc + unit, read_only=spec.read_only
    )
    low, high = spec.bounds.minimum, spec.bounds.maximum
    if low is not None and high is not None:
        if spec.type == 'integer':
            descriptor.integer_range = [IntegerRange(from_value=int(low), to_value=int(high))]
        elif spec.type == 'double':
            descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    return descriptor
