# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The diagnostics of a controller manager: three tasks, each with a level, a message, and values.

Texts, keys and rules are those of controller_manager 4.x and of its diagnostic_updater. The mean
of an execution time is compared with zero, that of a rate with the requested rate. Controllers and
components that run at the rate of the manager are not checked for their rate.
"""

from collections.abc import Mapping
from dataclasses import dataclass
import enum

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.diagnostic_thresholds import (
    DiagnosticThresholds,
    ManagerThresholds,
    Thresholds,
)
from amr_description.control.interfaces import LifecycleState
from amr_description.control.snapshot import ManagerSnapshot
from amr_description.control.statistics import CycleStatistic, Statistic

HARDWARE_ID = 'ros2_control'


class Level(enum.IntEnum):
    """As in ``diagnostic_msgs/msg/DiagnosticStatus``."""

    OK = 0
    WARN = 1
    ERROR = 2


@dataclass(frozen=True, slots=True)
class Measurements:
    """The snapshot and the statistics of one manager, at one instant."""

    snapshot: ManagerSnapshot
    update_rate: int
    """Of the manager, Hz."""
    periodicity: Statistic
    """Of the manager's ticks, Hz."""
    updates: Mapping[str, CycleStatistic]
    """By controller."""
    reads: Mapping[str, CycleStatistic]
    """By hardware component."""
    writes: Mapping[str, CycleStatistic]
    """By hardware component, without sensors, which are never written."""


def take_measurements(manager: ControllerManager) -> Measurements:
    """Copy the statistics of a manager; on the control thread."""
    components = manager.resources.components
    return Measurements(
        snapshot=manager.snapshot,
        update_rate=manager.update_rate,
        periodicity=manager.periodicity.result(),
        updates={loaded.name: loaded.statistic.result() for loaded in manager.loaded},
        reads={name: component.read_statistic.result() for name, component in components.items()},
        writes={
            name: component.write_statistic.result()
            for name, component in components.items()
            if not component.is_sensor
        },
    )


class Report:
    """The result of one task."""

    def __init__(self) -> None:
        self.level = Level.OK
        self.message = ''
        self.values: list[tuple[str, str]] = []

    def add(self, key: str, value: str) -> None:
        """Add a value."""
        self.values.append((key, value))

    def merge(self, level: Level, message: str) -> None:
        """Add a message: problems are joined by semicolons, and replace a message of level OK."""
        if level and self.level:
            self.message += f'; {message}'
        elif level > self.level or not self.message:
            self.message = message
        self.level = max(level, self.level)


def reports(
    measured: Measurements | None,
    thresholds: DiagnosticThresholds,
    update_rate: int,
    *,
    has_description: bool = True,
) -> dict[str, Report]:
    """
    Return the reports of all tasks, by their names.

    Args:
        measured: of the manager; None without hardware.
        thresholds: of warnings and errors.
        update_rate: of the manager, Hz.
        has_description: whether the robot description, and so the hardware, should be there.
    """
    return {
        'Controllers Activity': controllers_activity(measured, thresholds),
        'Hardware Components Activity': hardware_components_activity(measured, thresholds),
        'Controller Manager Activity': controller_manager_activity(
            measured, thresholds, update_rate, has_description
        ),
    }


def controllers_activity(
    measured: Measurements | None, thresholds: DiagnosticThresholds
) -> Report:
    """Check the controllers; ``measured``: None without hardware."""
    report = Report()
    controllers = measured.snapshot.controllers if measured else ()
    updates = measured.updates if measured else {}
    checks = _CycleChecks(report, thresholds.controllers, measured.update_rate if measured else 0)
    for controller in controllers:
        report.add(f'{controller.name}.state', controller.state.label)
        if controller.state is LifecycleState.ACTIVE:
            found = updates[controller.name]
            checks.check(controller.name, '', controller.update_rate, found)
    are_active = all(each.state is LifecycleState.ACTIVE for each in controllers)
    report.merge(
        Level.OK,
        'All controllers are active' if are_active else 'Not all controllers are active',
    )
    checks.conclude()
    if not measured or not _has_active_hardware(measured):
        report.merge(
            Level.ERROR, 'No hardware components are currently active to activate controllers'
        )
    elif not controllers:
        report.merge(Level.WARN, 'No controllers are currently loaded')
    return report


def hardware_components_activity(
    measured: Measurements | None, thresholds: DiagnosticThresholds
) -> Report:
    """Check the hardware components; ``measured``: None without hardware."""
    report = Report()
    if not measured:
        report.merge(Level.ERROR, 'Resource manager is not yet initialized!')
        return report
    components = measured.snapshot.components
    if not components:
        report.merge(Level.ERROR, 'No hardware components are loaded!')
        return report
    if not _has_active_hardware(measured):
        report.merge(Level.WARN, 'No hardware components are currently active')
        return report
    are_active = all(each.state is LifecycleState.ACTIVE for each in components)
    some = 'Not all hardware components are active'
    report.merge(Level.OK, 'All hardware components are active' if are_active else some)
    checks = _CycleChecks(report, thresholds.hardware_components, measured.update_rate)
    for component in components:
        name = component.name
        report.add(f'{name}.state', component.state.label)
        if component.state is not LifecycleState.ACTIVE:
            continue
        checks.check(name, '.read_cycle', component.rate, measured.reads[name])
        if name in measured.writes:
            checks.check(name, '.write_cycle', component.rate, measured.writes[name])
    checks.conclude()
    return report


def controller_manager_activity(
    measured: Measurements | None,
    thresholds: DiagnosticThresholds,
    update_rate: int,
    has_description: bool,
) -> Report:
    """Check the cycle of the manager itself; arguments as of :func:`reports`."""
    report = Report()
    found = measured.periodicity if measured else Statistic()
    report.add('update_rate', str(update_rate))
    report.add('periodicity.average', f'{found.mean:f}')
    report.add('periodicity.standard_deviation', f'{found.standard_deviation:f}')
    report.add('periodicity.min', f'{found.minimum:f}')
    report.add('periodicity.max', f'{found.maximum:f}')
    if not measured:
        if has_description:
            report.merge(Level.ERROR, 'Resource Manager is not initialized properly!')
        else:
            report.merge(Level.WARN, 'Waiting for robot description....')
        return report
    report.merge(Level.OK, 'Controller Manager is running')
    report.merge(
        _level_of_rate(found, update_rate, thresholds.controller_manager),
        f'Controller Manager has bad periodicity : {found.mean:f} Hz. Expected consistent '
        f'{update_rate} Hz',
    )
    return report


class _CycleChecks:
    """Compares statistics of cycles with thresholds, and collects the names of those above."""

    def __init__(self, report: Report, thresholds: Thresholds, manager_rate: int) -> None:
        self._report = report
        self._thresholds = thresholds
        self._manager_rate = manager_rate
        self._level = Level.OK
        self._slow: list[str] = []
        self._irregular: list[str] = []

    def check(self, name: str, cycle: str, rate: int, found: CycleStatistic) -> None:
        """
        Check one cycle, and add its values to the report.

        Args:
            name: of the controller or component.
            cycle: ``.read_cycle``, ``.write_cycle``, or '' for the update of a controller.
            rate: requested, Hz.
            found: the measurement.
        """
        limits = self._thresholds.execution_time
        self._report.add(f'{name}{cycle}.execution_time', _described(found.execution_time, 'us'))
        if rate != self._manager_rate:
            self._check_rate(name, cycle, rate, found.periodicity)
        mean, deviation = found.execution_time.mean, found.execution_time.standard_deviation
        level = max(
            _level_of(mean, limits.mean_error.warn, limits.mean_error.error),
            _level_of(deviation, limits.standard_deviation.warn, limits.standard_deviation.error),
        )
        if level:
            self._slow.append(name)  # a component that reads and writes slowly is there twice
        self._level = max(level, self._level)

    def _check_rate(self, name: str, cycle: str, rate: int, found: Statistic) -> None:
        described = f'{_described(found, "Hz")} -> Desired : {rate} Hz'
        self._report.add(f'{name}{cycle}.periodicity', described)
        level = _level_of_rate(found, rate, self._thresholds)
        if level and name not in self._irregular:
            self._irregular.append(name)
        self._level = max(level, self._level)

    def conclude(self) -> None:
        """Add the messages to the report."""
        for what, names in (('execution', self._slow), ('periodicity', self._irregular)):
            if names:
                listed = ''.join(f'{name} ' for name in names)
                text = f'\nHigh {what} jitter or mean error : [ {listed}]'
                self._report.merge(self._level, text)


def _has_active_hardware(measured: Measurements) -> bool:
    components = measured.snapshot.components
    return any(component.state is LifecycleState.ACTIVE for component in components)


def _described(found: Statistic, unit: str) -> str:
    return (
        f'Avg: {found.mean:.2f} [{found.minimum:.2f} - {found.maximum:.2f}] {unit}, '
        f'StdDev: {found.standard_deviation:.2f}'
    )


def _level_of_rate(
    found: Statistic, rate: int, thresholds: Thresholds | ManagerThresholds
) -> Level:
    limits = thresholds.periodicity
    return max(
        _level_of(abs(found.mean - rate), limits.mean_error.warn, limits.mean_error.error),
        _level_of(
            found.standard_deviation,
            limits.standard_deviation.warn,
            limits.standard_deviation.error,
        ),
    )


def _level_of(value: float, warn: float, error: float) -> Level:
    """Return the level of a value; OK while it is not known (NaN)."""
    if value > error:
        return Level.ERROR
    return Level.WARN if value > warn else Level.OK
