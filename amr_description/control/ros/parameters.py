# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The parameters of a ``controller_manager`` node: its own, and those that it keeps for a controller.

The tables say what there is; :class:`ManagerParameters` declares and reads them on the node.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.control.controller_manager import ManagerDefaults
from amr_description.control.diagnostic_thresholds import Diagnostics
from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError
from amr_description.parameter_files import read_parameter_file
from amr_description.parameters import group, parameter
from amr_description.ros.arguments import inherited, ros_arguments
from amr_description.ros.parameters import (
    add_validation_callback,
    declare,
    declare_missing,
    declare_overrides,
    values,
)
from amr_description.ros.runtime import argument_errors

MOST_CYCLES = 100_000
"""Hz: no control loop is faster."""


@dataclass(frozen=True)
class InitialStates:
    """The states to which the hardware is brought at the start."""

    unconfigured: tuple[str, ...] = parameter((), 'Components that are left unconfigured')
    inactive: tuple[str, ...] = parameter((), 'Components that are configured, not activated')
    shutdown_on_initial_state_failure: bool = parameter(
        True, 'End when a component does not reach its first state', read_only=True
    )


@dataclass(frozen=True)
class SwitchDefaults:
    """For what a request to switch leaves open."""

    strictness: str = parameter(
        'best_effort', 'Where a request names no strictness', choices=('best_effort', 'strict')
    )


@dataclass(frozen=True)
class Defaults:
    """How controllers depend on hardware, and requests that leave something open."""

    allow_controller_activation_with_inactive_hardware: bool = parameter(
        False, 'Let controllers claim commands of hardware that is not active', read_only=True
    )
    deactivate_controllers_on_hardware_self_deactivate: bool = parameter(
        True, 'Deactivate the controllers of hardware that made itself inactive', read_only=True
    )
    switch_controller: SwitchDefaults = group('switch_controller', SwitchDefaults)


@dataclass(frozen=True)
class Overruns:
    """Cycles that take too long."""

    print_warnings: bool = parameter(True, 'Warn of them; default: unless use_sim_time')


@dataclass(frozen=True)
class DiagnosticUpdater:
    """How ``/diagnostics`` is published."""

    period: float = parameter(
        1.0, 'Time between two messages', unit='s', above=0.0, magnitude=(1e-3, 1e5)
    )
    use_fqn: bool = parameter(False, 'Name the node with its namespace')


@dataclass(frozen=True)
class ManagerTable:
    """
    The parameters of the manager.

    ``update_rate`` may be set while it runs, as in ros2_control, but only the start counts.
    """

    update_rate: int = parameter(
        100, 'Rate of the control loop', unit='Hz', above=0, magnitude=(1, MOST_CYCLES)
    )
    enforce_command_limits: bool = parameter(
        False, 'Clamp commands to the limits of the URDF', read_only=True
    )
    handle_exceptions: bool = parameter(
        True, 'Go on when a controller or a component raises', read_only=True
    )
    hardware_components_initial_state: InitialStates = group(
        'hardware_components_initial_state', InitialStates
    )
    defaults: Defaults = group('defaults', Defaults)
    overruns: Overruns = group('overruns', Overruns)
    diagnostics: Diagnostics = group('diagnostics.threshold', Diagnostics)
    diagnostic_updater: DiagnosticUpdater = group('diagnostic_updater', DiagnosticUpdater)


@dataclass(frozen=True)
class ControllerEntry:
    """The manager's parameters for one controller, below its name."""

    type: str = parameter('', 'Type of the controller', not_empty=True)
    params_file: tuple[str, ...] = parameter((), 'Parameter files of the controller')
    fallback_controllers: tuple[str, ...] = parameter(
        (), 'Controllers to activate when this one fails'
    )
    node_options_args: tuple[str, ...] = parameter((), 'ROS arguments of its node')


@dataclass(frozen=True)
class CommonParameters:
    """The parameters of every controller's node, besides the controller's own table."""

    is_async: bool = parameter(
        False, 'Update in a thread of its own: accepted, and updated in the control loop'
    )
    thread_priority: int = parameter(-100, 'Priority of that thread; not used')
    update_rate: int = parameter(
        100,
        "Updates per second; default, and 0: the manager's",
        unit='Hz',
        minimum=0,
        magnitude=(1, MOST_CYCLES),
    )


class ManagerParameters:
    """
    Declares the parameters of a manager's node, and reads them whenever they are needed.

    So what ``ros2 param set`` has set before a controller is loaded counts.
    """

    def __init__(self, node: Node, arguments: Sequence[str]) -> None:
        """
        Declare the parameters.

        Args:
            node: Of the manager; it must allow undeclared parameters.
            arguments: Its ROS arguments, which every controller gets too.

        Raises:
            ParameterError: A value has the wrong type, or is out of its bounds.
        """
        self._node = node
        self._arguments = list(arguments)
        uses_sim_time = node.get_parameter('use_sim_time').value
        with argument_errors():
            self.start = declare(
                node, ManagerTable, defaults={'overruns.print_warnings': not uses_sim_time}
            )
            """The values at the start."""
            declare_overrides(node)
        add_validation_callback(node, ManagerTable)
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
        Return the parameters for a controller, which are declared from now on.

        Raises:
            ControllerError: It has no type; the controllers that have one are named.
            ParameterError: A value has the wrong type.
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
        Return a controller's ROS arguments: the manager's, then its own files and options.

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
        """Return the present values of ``defaults.…``."""
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
