# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A hardware component inside the manager: its lifecycle state, interfaces, and its own rate."""

from collections.abc import Iterable
from typing import TypeVar

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import HardwareComponent
from amr_description.control.interfaces import Handle, LifecycleState
from amr_description.control.statistics import RunningCycleStatistic
from amr_description.errors import HardwareError
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import HardwareType
from amr_description.plugin_errors import describe, log_traceback

H = TypeVar('H', bound=Handle)

_INACTIVE, _ACTIVE = LifecycleState.INACTIVE, LifecycleState.ACTIVE  # looked up in each cycle

# Neighbours are one transition apart; there is no way back from finalized.
_STATES = (
    LifecycleState.FINALIZED,
    LifecycleState.UNCONFIGURED,
    LifecycleState.INACTIVE,
    LifecycleState.ACTIVE,
)
_TRANSITIONS = {
    (LifecycleState.UNCONFIGURED, LifecycleState.INACTIVE): 'configure',
    (LifecycleState.INACTIVE, LifecycleState.ACTIVE): 'activate',
    (LifecycleState.ACTIVE, LifecycleState.INACTIVE): 'deactivate',
    (LifecycleState.INACTIVE, LifecycleState.UNCONFIGURED): 'cleanup',
    (LifecycleState.UNCONFIGURED, LifecycleState.FINALIZED): 'shutdown',
}


class LoadedComponent:
    """A component with its lifecycle, which only the resource manager changes."""

    def __init__(self, component: HardwareComponent, log: Log) -> None:
        """
        Take a component.

        Args:
            component: unconfigured.
            log: for its transitions and failures.

        Raises:
            HardwareError: it exports a name twice, or is a sensor with command interfaces.
        """
        self.component = component
        self.info = component.info
        self.states = by_name(component.state_interfaces(), self.info.name)
        self.commands = by_name(component.command_interfaces(), self.info.name)
        self.is_sensor = self.info.type is HardwareType.SENSOR
        """True: it is never written."""
        if self.is_sensor and self.commands:
            raise HardwareError(
                f'Hardware component \'{self.info.name}\' is of type "sensor", which is never '
                f"written, and has the command interface '{min(self.commands)}'; it has to be of "
                'type "actuator" or "system"'
            )
        self.state = LifecycleState.UNCONFIGURED
        self.read_statistic = RunningCycleStatistic()
        """Of its reads since it was activated."""
        self.write_statistic = RunningCycleStatistic()
        """Likewise of its writes."""
        self.rate = self.info.rw_rate
        """Hz, of its own; 0: that of the manager."""
        self._log = log
        self.last_read: int | None = None
        """When it was read, ns; None: not since a transition, or a jump of the clock."""
        self.last_write: int | None = None
        """Likewise."""

    @property
    def is_available(self) -> bool:
        """True while it is inactive or active: it is read, and its states can be used."""
        return self.state is _ACTIVE or self.state is _INACTIVE

    @property
    def is_active(self) -> bool:
        """True while it is active: it is written, unless it is a sensor."""
        return self.state is _ACTIVE

    # --- lifecycle ----------------------------------------------------------------------------

    def go_to(self, target: LifecycleState) -> None:
        """
        Go to ``target``, one transition after the other.

        Raises HardwareError: there is no way, or a transition failed, which leaves it in the state
        that it has reached.
        """
        name = self.info.name
        if target not in _STATES:
            raise HardwareError(
                f"Hardware component '{name}' cannot go from {self.state.label} to {target.label}"
            )
        if self.state is LifecycleState.FINALIZED and target is not self.state:
            raise HardwareError(
                f"hardware '{name}' is in finalized state and can be only destroyed; "
                f'{target.label} was requested. Restart its controller manager'
            )
        while self.state is not target:
            following = self._next_towards(target)
            try:
                self._make_transition(following)
            except Exception as error:  # a third-party component may raise anything
                raise HardwareError(
                    f"Hardware component '{name}' failed on its way from {self.state.label} to "
                    f'{following.label}: {describe(error)}'
                ) from error

    def bring_down(self, target: LifecycleState = LifecycleState.UNCONFIGURED) -> None:
        """Go down to ``target``, whatever its methods raise."""
        while _STATES.index(self.state) > _STATES.index(target):
            following = self._next_towards(target)
            try:
                self._make_transition(following)
            except Exception as error:  # it counts as done nevertheless
                self.report(f'transition to {following.label}', error)
                self.state = following

    def _next_towards(self, target: LifecycleState) -> LifecycleState:
        here = _STATES.index(self.state)
        return _STATES[here + (1 if here < _STATES.index(target) else -1)]

    def _make_transition(self, following: LifecycleState) -> None:
        """Make one transition, logged as ros2_control does."""
        transition = _TRANSITIONS[self.state, following]
        self._log(Severity.INFO, f"'{transition}' hardware '{self.info.name}' ")
        getattr(self.component, transition)()
        self.state = following
        self.last_read = self.last_write = None
        if following is LifecycleState.ACTIVE:
            self.read_statistic.reset()
            self.write_statistic.reset()
        self._log(Severity.INFO, f"Successful '{transition}' of hardware '{self.info.name}'")

    # --- input and output ---------------------------------------------------------------------

    def elapsed(self, last: int | None, time: int, period: int) -> int | None:
        """
        Return the period to hand to a component with a rate of its own, ns; None: it is not due.

        That is the true time since the previous call, and the nominal period at the first. It is
        due from 99 % of its period on, as a tick may come early.

        Args:
            last: when it was called, ns; None: not yet.
            time: of the manager's tick, ns.
            period: since the previous tick, ns.
        """
        rate = self.rate
        if last is None:
            return max(period, NANOSECONDS // rate)
        elapsed = time - last
        return elapsed if elapsed * rate >= 0.99 * NANOSECONDS else None

    def set_clock(self) -> None:
        """The clock jumped: forget when it was read and written."""
        self.last_read = self.last_write = None

    def reset(self, time: int) -> None:
        """The simulation was reset to ``time``, ns. Raises whatever the component raises."""
        self.set_clock()
        if self.is_available:
            self.component.reset(time)

    def report(self, action: str, error: Exception) -> None:
        """Log an exception of the component."""
        self._log(
            Severity.ERROR,
            f"{action} of hardware component '{self.info.name}' failed: {describe(error)}",
        )
        log_traceback(self._log, error)


def by_name(handles: Iterable[H], owner: str) -> dict[str, H]:
    """Index interfaces by name. Raises HardwareError: ``owner`` exports a name twice."""
    found: dict[str, H] = {}
    for handle in handles:
        if handle.name in found:
            raise HardwareError(f"'{owner}' exports the interface '{handle.name}' twice")
        found[handle.name] = handle
    return found
