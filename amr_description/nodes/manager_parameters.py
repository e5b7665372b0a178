# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of a ``controller_manager`` node, as the manager needs them."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.control.manager_defaults import ManagerDefaults
from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError
from amr_description.nodes.manager_table import ControllerEntry, ManagerTable
from amr_description.nodes.node_parameters import (
    declare,
    declare_missing,
    declare_the_rest,
    refuse_what_the_table_refuses,
    values,
)
from amr_description.nodes.parameter_files import read_parameter_file
from amr_description.nodes.ros_arguments import inherited, ros_arguments
from amr_description.nodes.runtime import argument_errors


class ManagerParameters:
    """
    Reads the node each time: ``ros2 param set`` before a load counts.

    ``arguments`` are the manager's own ROS arguments, which every controller gets too; ``start``
    is what the table held at the start.
    """

    def __init__(self, node: Node, arguments: Sequence[str]) -> None:
        """Declare the parameters. Raises ParameterError."""
        self._node = node
        self._arguments = list(arguments)
        uses_sim_time = node.get_parameter('use_sim_time').value
        with argument_errors():
            self.start = declare(
                node, ManagerTable, defaults={'overruns.print_warnings': not uses_sim_time}
            )
            declare_the_rest(node)
        refuse_what_the_table_refuses(node, ManagerTable)
        if not self.start.handle_exceptions:
            node.get_logger().warning(
                'handle_exceptions is false; what raises an exception is taken down all the same, '
                'and the others go on'
            )

    @property
    def update_rate(self) -> int:
        """Hz."""
        return self.start.update_rate

    def now(self) -> ManagerTable:
        """Return the present values."""
        return values(self._node, ManagerTable)

    def entry_of(self, name: str) -> ControllerEntry:
        """
        Return what is set for a controller; from then on all of it is declared.

        Raises ControllerError that names the controllers that have a type; ParameterError.
        """
        if not self._get(f'{name}.type'):
            raise ControllerError(
                f"The 'type' param was not defined for '{name}'. Controllers with a type in the "
                f'parameters of {self._node.get_fully_qualified_name()}: '
                f'{", ".join(self._typed_controllers()) or "none"}'
            )
        prefix = f'{name}.'
        with argument_errors():
            declare_missing(self._node, ControllerEntry, prefix=prefix)
        file = self._get(f'{prefix}params_file')
        lone = [Parameter(f'{prefix}params_file', value=[file])] if isinstance(file, str) else []
        return values(self._node, ControllerEntry, lone, prefix=prefix)

    def arguments_of(self, entry: ControllerEntry) -> list[str]:
        """
        Return the manager's own arguments, then the controller's files and options.

        Raises ParameterError: a file cannot be read.
        """
        for path in entry.params_file:
            read_parameter_file(Path(path))  # rcl would not say where it is wrong
        uses_sim_time = self._get('use_sim_time')
        return [
            *inherited(self._arguments),
            *(argument for path in entry.params_file for argument in ('--params-file', path)),
            *(['-p', 'use_sim_time:=true'] if uses_sim_time else []),
            *ros_arguments(['--ros-args', *entry.node_options_args]),
        ]

    def defaults(self) -> ManagerDefaults:
        """Return what ``defaults.…`` says now."""
        now = self.now().defaults
        return ManagerDefaults(
            strictness=Strictness[now.switch_controller.strictness.upper()],
            allow_controller_activation_with_inactive_hardware=(
                now.allow_controller_activation_with_inactive_hardware
            ),
            deactivate_controllers_on_hardware_self_deactivate=(
                now.deactivate_controllers_on_hardware_self_deactivate
            ),
        )

    def _get(self, name: str) -> Any:
        return self._node.get_parameter_or(name, Parameter(name)).value

    def _typed_controllers(self) -> list[str]:
        return sorted(
            name.removesuffix('.type')
            for name in self._node.get_parameters_by_prefix('')
            if name.endswith('.type')
        )
