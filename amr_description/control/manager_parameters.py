# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The parameters of a controller manager: its own, those that it keeps for a controller, and those
that every controller has.
"""

from dataclasses import dataclass

from amr_description.control.diagnostic_thresholds import DiagnosticThresholds
from amr_description.parameters import group, parameter

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
    diagnostics: DiagnosticThresholds = group('diagnostics.threshold', DiagnosticThresholds)
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
