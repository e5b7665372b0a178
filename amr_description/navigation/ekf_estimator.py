# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Measurements of several sensors, in the order of their stamps, through one filter.

Measurements are kept until :meth:`Estimator.integrate`, which the node calls at its rate. One that
is older than the state, of a sensor that takes long, corrects the present state as if it were of
now; with a history the filter goes back to before it and takes all later ones again.

Rules are those of robot_localization (``ros_filter.cpp``). Times are ns.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
import heapq
import itertools

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.navigation.ekf import (
    Array,
    ControlInput,
    Ekf,
    Measurement,
    Outcome,
    Tuning,
    TURN_RATE,
)

_UNKNOWN_ANGULAR_VARIANCE = 1e-6
"""rad²/s⁴, of the angular acceleration before the first estimate."""


@dataclass(frozen=True, slots=True)
class Timing:
    """When the estimator predicts and how far it looks back."""

    sensor_timeout: int
    """ns without a measurement after which it predicts to the present."""
    predict_to_current_time: bool = False
    """Whether it always does."""
    history: int | None = None
    """ns that it can go back for a late measurement; None: not at all."""


@dataclass(frozen=True, slots=True, eq=False)
class _Saved:
    """The filter as it was."""

    state: Array
    covariance: Array
    time: int
    control: ControlInput | None


class Estimator:
    """A filter with its queue of measurements, and its past."""

    def __init__(
        self,
        tuning: Tuning,
        timing: Timing,
        report: Callable[[Measurement, Outcome], object] = lambda measurement, outcome: None,
    ) -> None:
        """``report``: told what became of each measurement."""
        self.filter = Ekf(tuning)
        self.angular_acceleration: Array
        """3, rad/s², in the robot's axes: the change of the turn rates since the last time."""
        self.angular_covariance: Array
        """3 × 3, of the angular acceleration."""
        self._timing = timing
        self._report = report
        self._queue: list[tuple[int, int, Measurement]] = []
        self._numbers = itertools.count()  # of one stamp the first that came is the first
        self._states: deque[_Saved] = deque()
        self._measurements: deque[Measurement] = deque()
        self._forget_rates()

    def reset(self) -> None:
        """Begin anew, without measurements."""
        self.clear()
        self._forget_rates()
        self.filter.reset()

    def clear(self) -> None:
        """Drop measurements that wait, and the past."""
        self._queue.clear()
        self._states.clear()
        self._measurements.clear()

    def set_state(self, state: Array, covariance: Array, time: int) -> None:
        """Replace the state, at a time; what is known of before is dropped."""
        self.clear()
        self.filter.state = state.copy()
        self.filter.covariance = covariance.copy()
        self.filter.time = time

    def set_control(self, control: ControlInput) -> None:
        """Follow a command from the next prediction on."""
        self.filter.control = control

    def add(self, measurement: Measurement) -> None:
        """Keep a measurement until it is integrated."""
        heapq.heappush(self._queue, (measurement.time, next(self._numbers), measurement))

    def integrate(self, now: int) -> None:
        """
        Take the measurements that are not later than ``now``.

        If there are none for the sensor timeout, or it is asked for, predict to ``now``.
        """
        predicts = self._timing.predict_to_current_time
        if self._queue:
            self._take_all(now)
        elif self.filter.is_initialized:
            predicts |= now - self.filter.time >= self._timing.sensor_timeout
        # Back in time there is nothing to predict: the original would, with a negative dt.
        if predicts and self.filter.is_initialized and now > self.filter.time:
            self.filter.predict(now)
        self._differentiate(now)
        if self._timing.history is not None:
            self._forget_before(self.filter.time - self._timing.history)

    def _take_all(self, now: int) -> None:
        restored = 0
        if self._timing.history is not None and self._queue[0][0] < self.filter.time:
            restored = self._revert(self._queue[0][0] - 1)
        while self._queue and self._queue[0][0] <= now:
            measurement = heapq.heappop(self._queue)[2]
            # A present command stays; those of the past come back with their measurements.
            if restored > 0 and measurement.control is not None:
                self.filter.control = measurement.control
            restored -= 1
            self._report(measurement, self.filter.process(measurement))
            if self._timing.history is not None:
                self._measurements.append(measurement)
                if not self._queue or self._queue[0][0] != self.filter.time:
                    self._save()

    def _save(self) -> None:
        each = self.filter
        saved = _Saved(each.state.copy(), each.covariance.copy(), each.time, each.control)
        self._states.append(saved)

    def _revert(self, time: int) -> int:
        """
        Go back to the state at ``time``, or to the oldest that is kept.

        Returns:
            How many measurements wait again.
        """
        saved: _Saved | None = None
        while self._states and self._states[-1].time > time:
            saved = self._states.pop()
        if self._states:
            saved = self._states[-1]
        if saved is None:
            return 0
        self.filter.state = saved.state.copy()
        self.filter.covariance = saved.covariance.copy()
        self.filter.time = saved.time
        restored = 0
        while self._measurements and self._measurements[-1].time > time:
            measurement = self._measurements.pop()
            if saved.time <= measurement.time:
                self.add(measurement)
                restored += 1
        return restored

    def _forget_before(self, time: int) -> None:
        while self._measurements and self._measurements[0].time < time:
            self._measurements.popleft()
        while self._states and self._states[0].time < time:
            self._states.popleft()

    def _forget_rates(self) -> None:
        self.angular_acceleration = np.zeros(3)
        self.angular_covariance = np.eye(3) * _UNKNOWN_ANGULAR_VARIANCE
        self._rates = np.zeros(3)
        self._rates_time: int | None = None

    def _differentiate(self, now: int) -> None:
        """Estimate the angular acceleration of the turn rates now and at the last call."""
        if not self.filter.is_initialized:
            return
        rates = self.filter.state[TURN_RATE].copy()
        if self._rates_time is not None and now > self._rates_time:
            dt = (now - self._rates_time) / NANOSECONDS
            self.angular_acceleration = (rates - self._rates) / dt
            covariance = self.filter.covariance[TURN_RATE, TURN_RATE]
            self.angular_covariance = covariance * (2.0 / (dt * dt))
        self._rates, self._rates_time = rates, now
