# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The PID controller of control_toolbox, for joint_trajectory_controller and pid_controller.

::

    u = p·e + I + d·ė        dI/dt = i·e

The output is clamped to ``u_min`` … ``u_max``. What keeps the integral term I from growing
meanwhile is the **anti-windup strategy**:

``none``
    nothing;
``back_calculation``
    dI/dt = i·e + (u_clamped − u) / T, with the tracking time constant T: √(d/i), without d: p/i;
``conditional_integration``
    I stands while the output is clamped and the error drives it further beyond the clamp;
``legacy``
    without ``antiwindup`` I grows, and what is added to the output is clamped to ``i_min`` …
    ``i_max``; with it I itself is clamped.

With the other three, ``i_min`` and ``i_max`` clamp I where they are finite.

Formulas: control_toolbox (BSD-3-Clause), ``pid.cpp``.
"""

from dataclasses import dataclass
import math
import sys

from amr_description.errors import ControllerError

STRATEGIES = ('back_calculation', 'conditional_integration', 'legacy', 'none')
_EPSILON = sys.float_info.epsilon


@dataclass(frozen=True, slots=True)
class PidGains:
    """Gains and limits; of the error in its unit, and of the output in its own."""

    p: float = 0.0
    i: float = 0.0
    """1/s."""
    d: float = 0.0
    """s."""
    u_max: float = math.inf
    u_min: float = -math.inf
    i_max: float = math.inf
    """Of the integral term, in the unit of the output."""
    i_min: float = -math.inf
    strategy: str = 'none'
    """One of :data:`STRATEGIES`."""
    antiwindup: bool = False
    """Counts for ``legacy`` only."""
    tracking_time_constant: float = 0.0
    """s, for ``back_calculation``; 0: as the module says."""
    error_deadband: float = _EPSILON
    """Errors up to this size are not integrated."""

    def check(self) -> None:
        """Raise ControllerError if they contradict each other."""
        if self.strategy not in STRATEGIES:
            raise ControllerError(
                f"AntiWindupStrategy: Unknown antiwindup strategy : '{self.strategy}'. Valid "
                f'strategies are: {", ".join(map(repr, STRATEGIES))}.'
            )
        if not self.u_min < self.u_max:
            raise ControllerError(
                f'Gains: u_min ({self.u_min:g}) must be less than u_max ({self.u_max:g})'
            )
        if not self.i_min <= self.i_max:
            raise ControllerError(
                f'Gains: i_min ({self.i_min:g}) must be less than i_max ({self.i_max:g})'
            )
        is_tracking = self.strategy == 'back_calculation'
        if is_tracking and not 0.0 <= self.tracking_time_constant < math.inf:
            raise ControllerError(
                "AntiWindupStrategy 'back_calculation' requires a valid positive tracking time "
                f'constant (tracking_time_constant), not {self.tracking_time_constant:g}'
            )

    def tracking_time(self) -> float:
        """Return T of ``back_calculation``, s; infinite: there is nothing to track."""
        if self.tracking_time_constant > 0.0:
            return self.tracking_time_constant
        if self.i == 0.0:
            return math.inf
        ratio = self.d / self.i
        time = math.sqrt(ratio) if ratio > 0.0 else self.p / self.i
        return time if time > 0.0 else math.inf


class Pid:
    """One PID controller, with its integral term."""

    def __init__(self, gains: PidGains) -> None:
        """Take checked gains. Raises ControllerError."""
        gains.check()
        self._tracking_time = gains.tracking_time()
        self._gains = gains
        self.integral = 0.0
        """The integral term, in the unit of the output."""
        self.error = 0.0
        self.error_rate = 0.0
        self._command = 0.0

    @property
    def gains(self) -> PidGains:
        """Present gains; new ones keep the integral term. Setting raises ControllerError."""
        return self._gains

    @gains.setter
    def gains(self, gains: PidGains) -> None:
        gains.check()
        self._gains = gains
        self._tracking_time = gains.tracking_time()

    def reset(self, *, keep_integral: bool = False) -> None:
        """Forget the last error and, unless it is kept, the integral term."""
        self.error = self.error_rate = self._command = 0.0
        if not keep_integral:
            self.integral = 0.0

    def compute(self, error: float, period: float, error_rate: float | None = None) -> float:
        """
        Return the output.

        Args:
            error: desired − measured.
            period: since the last call, s; 0: nothing changes.
            error_rate: its derivative; None: by the difference to the last error.

        Returns:
            The clamped output; NaN for an error that is not finite, which is not integrated.
        """
        if abs(period) <= _EPSILON:
            return self._command
        if error_rate is None:
            error_rate = (error - self.error) / period
        if not (math.isfinite(error) and math.isfinite(error_rate)):
            self._command = math.nan
            return math.nan
        self.error, self.error_rate = error, error_rate
        gains = self._gains
        if gains.i == 0.0 and self.integral == 0.0:  # most arms: there is nothing to integrate
            wanted = gains.p * error + gains.d * error_rate
            self._command = command = min(max(wanted, gains.u_min), gains.u_max)
            return command
        is_integrated = abs(error) > gains.error_deadband
        integral = self._legacy(error, period, is_integrated)
        wanted = gains.p * error + integral + gains.d * error_rate
        command = min(max(wanted, gains.u_min), gains.u_max)
        if is_integrated and gains.strategy != 'legacy':
            self._integrate(error, period, wanted, command)
        self._command = command
        return command

    def _legacy(self, error: float, period: float, is_integrated: bool) -> float:
        """Return the integral part of the output; ``legacy`` integrates before, not after."""
        gains = self._gains
        if gains.strategy != 'legacy':
            return self.integral
        if is_integrated:
            self.integral += gains.i * period * error
        clamped = min(max(self.integral, gains.i_min), gains.i_max)
        if gains.antiwindup:
            self.integral = clamped
        return clamped

    def _integrate(self, error: float, period: float, wanted: float, command: float) -> None:
        gains = self._gains
        rate = gains.i * error
        if gains.strategy == 'back_calculation' and gains.i != 0.0:
            rate += (command - wanted) / self._tracking_time
        elif gains.strategy == 'conditional_integration':
            is_clamped = abs(wanted - command) > _EPSILON
            if is_clamped and error * wanted > 0.0:
                rate = 0.0
        self.integral = min(max(self.integral + period * rate, gains.i_min), gains.i_max)
