# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The thresholds of ``/diagnostics``: parameters of the controller manager."""

from dataclasses import dataclass

from amr_description.parameters import group, parameter


@dataclass(frozen=True)
class RateLimits:
    """Deviations of a rate."""

    warn: float = parameter(5.0, 'Deviation to warn of', unit='Hz', above=0.0)
    error: float = parameter(10.0, 'Deviation that is an error', unit='Hz', above=0.0)


@dataclass(frozen=True)
class TimeLimits:
    """Mean times."""

    warn: float = parameter(1000.0, 'Execution time to warn of', unit='µs', above=0.0)
    error: float = parameter(2000.0, 'Execution time that is an error', unit='µs', above=0.0)


@dataclass(frozen=True)
class SpreadLimits:
    """Standard deviations of times."""

    warn: float = parameter(100.0, 'Deviation to warn of', unit='µs', above=0.0)
    error: float = parameter(200.0, 'Deviation that is an error', unit='µs', above=0.0)


@dataclass(frozen=True)
class Periodicity:
    """How regularly something runs."""

    mean_error: RateLimits = group('mean_error', RateLimits)
    standard_deviation: RateLimits = group('standard_deviation', RateLimits)


@dataclass(frozen=True)
class ExecutionTime:
    """How long something takes."""

    mean_error: TimeLimits = group('mean_error', TimeLimits)
    standard_deviation: SpreadLimits = group('standard_deviation', SpreadLimits)


@dataclass(frozen=True)
class ManagerThresholds:
    """Of the manager's own loop."""

    periodicity: Periodicity = group('periodicity', Periodicity)


@dataclass(frozen=True)
class Thresholds:
    """Of controllers, or of hardware components."""

    periodicity: Periodicity = group('periodicity', Periodicity)
    execution_time: ExecutionTime = group('execution_time', ExecutionTime)


@dataclass(frozen=True)
class DiagnosticThresholds:
    """The thresholds of warnings and errors on ``/diagnostics``."""

    controller_manager: ManagerThresholds = group('controller_manager', ManagerThresholds)
    controllers: Thresholds = group('controllers', Thresholds)
    hardware_components: Thresholds = group('hardware_components', Thresholds)
