# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The values inside a controller manager that are published for introspection.

Their names are those that controller_manager 4.x registers::

    state_interface.joint_wheel_front_left/position
    command_interface.joint_wheel_front_left/velocity
    AmrSystem.stats/read_cycle/execution_time/average            µs
    diff_drive_controller.stats/periodicity/current_value        Hz
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
import math

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import Handle
from amr_description.control.statistics import RunningCycleStatistic, Statistic

_QUANTITIES = ('execution_time', 'periodicity')
_NUMBERS = ('max', 'min', 'average', 'standard_deviation', 'sample_count', 'current_value')


@dataclass(frozen=True, slots=True)
class IntrospectionRegistry:
    """Named values."""

    names: tuple[str, ...]
    read: Callable[[], list[float]]
    """Returns the present values, in the order of ``names``; for the control thread."""


def interfaces_of(manager: ControllerManager) -> IntrospectionRegistry:
    """Return the interfaces of hardware and of configured controllers, available or not."""
    named = dict(_handles(manager))
    handles = tuple(named.values())
    return IntrospectionRegistry(tuple(named), lambda: [_number(handle) for handle in handles])


def _number(handle: Handle) -> float:
    """Return the value of an interface; NaN if a plugin has written what is not a number."""
    try:
        return float(handle.value)
    except (TypeError, ValueError, OverflowError):
        return math.nan


def _handles(manager: ControllerManager) -> Iterator[tuple[str, Handle]]:
    for component in manager.resources.components.values():
        yield from ((f'state_interface.{name}', state) for name, state in component.states.items())
        yield from (
            (f'command_interface.{name}', each) for name, each in component.commands.items()
        )
    for loaded in manager.loaded:
        yield from ((f'state_interface.{each.name}', each) for each in loaded.exported_states)
        yield from ((f'command_interface.{each.name}', each) for each in loaded.references)


def statistics_of(manager: ControllerManager) -> IntrospectionRegistry:
    """Return execution times and rates of components and controllers."""
    named = dict(_statistics(manager))
    running = tuple(named.values())
    names = tuple(
        f'{name}/{quantity}/{number}'
        for name in named
        for quantity in _QUANTITIES
        for number in _NUMBERS
    )
    return IntrospectionRegistry(
        names, lambda: [number for each in running for number in _numbers(each)]
    )


def _statistics(manager: ControllerManager) -> Iterator[tuple[str, RunningCycleStatistic]]:
    for name, component in manager.resources.components.items():
        yield f'{name}.stats/read_cycle', component.read_statistic
        if not component.is_sensor:
            yield f'{name}.stats/write_cycle', component.write_statistic
    for loaded in manager.loaded:
        yield f'{loaded.name}.stats', loaded.statistic


def _numbers(running: RunningCycleStatistic) -> Iterator[float]:
    found = running.result()
    yield from _in_order(found.execution_time)
    yield from _in_order(found.periodicity)


def _in_order(found: Statistic) -> tuple[float, ...]:
    return (
        found.maximum,
        found.minimum,
        found.mean,
        found.standard_deviation,
        float(found.count),
        found.latest,
    )
