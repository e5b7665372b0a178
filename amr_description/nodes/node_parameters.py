# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of a ROS node from a table of :mod:`amr_description.parameters`."""

from collections.abc import Iterable

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.parameters import build, Spec, specs

_ARRAYS = {
    'string_array': Parameter.Type.STRING_ARRAY,
    'double_array': Parameter.Type.DOUBLE_ARRAY,
}


def declare[Table](node: Node, table: type[Table]) -> Table:
    """
    Declare every row of ``table`` on ``node`` and return the values given to it.

    :raises ParameterError: A value is out of the table's bounds.
    :raises rclpy.exceptions.InvalidParameterTypeException: A value is of another type.
    """
    for spec in specs(table):
        _declare(node, spec)
    return values(node, table)


def values[Table](node: Node, table: type[Table], changed: Iterable[Parameter] = ()) -> Table:
    """
    Return the node's present values, with those of ``changed`` in their place.

    :raises ParameterError: A value is not of the table's type or out of its bounds.
    """
    found = {spec.name: node.get_parameter(spec.name).value for spec in specs(table)}
    return build(table, found | {parameter.name: parameter.value for parameter in changed})


def _declare(node: Node, spec: Spec) -> None:
    array_type = _ARRAYS.get(spec.type)
    if array_type is None:
        node.declare_parameter(spec.name, spec.default, _descriptor(spec))
        return
    # An empty list has no type of its own in rclpy: the type is declared, then the value is set.
    if node.declare_parameter(spec.name, array_type).type_ == Parameter.Type.NOT_SET:
        node.set_parameters([Parameter(spec.name, array_type, list(spec.default))])
    descriptor = _descriptor(spec)
    descriptor.type = array_type.value
    node.set_descriptor(spec.name, descriptor)


def _descriptor(spec: Spec) -> ParameterDescriptor:
    """Meaning, unit and range of one row."""
    unit = f' [{spec.unit}]' if spec.unit else ''
    descriptor = ParameterDescriptor(description=spec.doc + unit, read_only=spec.read_only)
    low, high = spec.bounds.minimum, spec.bounds.maximum
    if low is not None and high is not None:
        if spec.type == 'integer':
            descriptor.integer_range = [IntegerRange(from_value=int(low), to_value=int(high))]
        elif spec.type == 'double':
            descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    return descriptor
