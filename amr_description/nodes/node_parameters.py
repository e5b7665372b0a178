# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of a ROS node from a table of :mod:`amr_description.parameters`."""

from collections.abc import Iterable

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.parameters import build, specs


def declare[Table](node: Node, table: type[Table]) -> Table:
    """
    Declare every row of ``table`` on ``node`` and return the values given to it.

    :raises ParameterError: A value is out of the table's bounds.
    :raises rclpy.exceptions.InvalidParameterTypeException: A value is of another type.
    """
    for spec in specs(table):
        default = list(spec.default) if isinstance(spec.default, tuple) else spec.default
        description = f'{spec.doc} ({spec.unit})' if spec.unit else spec.doc
        descriptor = ParameterDescriptor(description=description, read_only=spec.read_only)
        node.declare_parameter(spec.name, default, descriptor)
    return values(node, table)


def values[Table](node: Node, table: type[Table], changed: Iterable[Parameter] = ()) -> Table:
    """
    Return the node's present values, with those of ``changed`` in their place.

    :raises ParameterError: A value is not of the table's type or out of its bounds.
    """
    found = {spec.name: node.get_parameter(spec.name).value for spec in specs(table)}
    return build(table, found | {parameter.name: parameter.value for parameter in changed})
