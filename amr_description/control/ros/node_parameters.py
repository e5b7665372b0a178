# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of a controller manager, and of its controllers, in their nodes."""

from collections.abc import Collection, Mapping
from typing import Any, TypeVar

from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.controller_manager.parameter_store import NO_VALUES
from amr_description.errors import ParameterError
from amr_description.parameters import Value
from amr_description.ros.parameters import (
    add_validation_callback,
    adopt_overrides,
    declare_added,
    declare_missing,
    declare_overrides,
    values,
)
from amr_description.ros.runtime import argument_errors

_Table = TypeVar('_Table')


class NodeParameters:
    """
    The parameters of a node of ROS, as the controller manager keeps parameters.

    It is a :class:`~amr_description.controller_manager.parameter_store.ParameterStore`.
    """

    def __init__(self, node: Node) -> None:
        """``node``: has them."""
        self._node = node

    @property
    def node(self) -> str:
        """The full name of the node."""
        return str(self._node.get_fully_qualified_name())

    def adopt(
        self, *tables: type, joints: Collection[str] = (), others: Collection[str] = ()
    ) -> list[str]:
        """See :func:`~amr_description.ros.parameters.adopt_overrides`."""
        return adopt_overrides(self._node, *tables, joints=joints, others=others)

    def declare(
        self, table: type, *, prefix: str = '', defaults: Mapping[str, Value] = NO_VALUES
    ) -> None:
        """See :func:`~amr_description.ros.parameters.declare_missing`. Raises ParameterError."""
        with argument_errors():
            declare_missing(self._node, table, prefix=prefix, defaults=defaults)

    def declare_added(self, table: type) -> None:
        """See :func:`~amr_description.ros.parameters.declare_added`."""
        declare_added(self._node, table)

    def declare_given(self) -> None:
        """See :func:`~amr_description.ros.parameters.declare_overrides`."""
        with argument_errors():
            declare_overrides(self._node)

    def values(
        self, table: type[_Table], changed: Mapping[str, Any] = NO_VALUES, *, prefix: str = ''
    ) -> _Table:
        """See :func:`~amr_description.ros.parameters.values`."""
        given = [Parameter(name, value=value) for name, value in changed.items()]
        return values(self._node, table, given, prefix=prefix)

    def check_sets(self, *tables: type) -> None:
        """See :func:`~amr_description.ros.parameters.add_validation_callback`."""
        add_validation_callback(self._node, *tables)

    def value(self, name: str) -> Any:
        """Return a declared value, or None."""
        return self._node.get_parameter_or(name, Parameter(name)).value

    def names(self) -> Collection[str]:
        """Return the names of all that are declared."""
        return set(self._node.get_parameters_by_prefix(''))

    def set(self, name: str, value: Any) -> None:
        """Set a value. Raises ParameterError: it is refused."""
        (result,) = self._node.set_parameters([Parameter(name, value=value)])
        if not result.successful:
            raise ParameterError(result.reason)
