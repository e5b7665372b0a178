# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controller manager of one robot: load, configure, switch; and read → update → write.

Every method runs on the owner's thread. Other threads read :attr:`ControllerManager.snapshot`, an
immutable object that is replaced as a whole.
"""

from collections.abc import Callable, Sequence
import math

from amr_description.control.contracts import Log, Severity
from amr_description.control.interfaces import LifecycleState, NANOSECONDS
from amr_description.control.lifecycles import ControllerLifecycles
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.manager_defaults import ManagerDefaults
from amr_description.control.overruns import overrun_text
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.statistics import RunningStatistic
from amr_description.control.switch_execution import names_of
from amr_description.control.switching import NOTHING_TO_SWITCH, Strictness, Switching


class ControllerManager(ControllerLifecycles):
    """Runs the controllers of one robot at ``update_rate`` Hz."""

    def __init__(
        self,
        resources: ResourceManager,
        update_rate: int,
        log: Log,
        period: int | None = None,
        defaults: ManagerDefaults | None = None,
    ) -> None:
        """
        ``update_rate``: Hz, as parameters and services give it. ``period``: ns, where the world's
        steps do not divide that of the rate exactly.
        """
        self.defaults = defaults = defaults or ManagerDefaults()
        """May be replaced while it runs, as a parameter is set."""
        super().__init__(resources, update_rate, log)
        resources.lends_commands_of_inactive = (
            defaults.allow_controller_activation_with_inactive_hardware
        )
        self.period = period or round(NANOSECONDS / update_rate)
        """Nominal time between two ticks, ns."""
        self.next_tick = 0
        """The instant of the next tick, ns: a multiple of the period, if nothing came late."""
        self._last_tick: int | None = None
        self.periodicity = RunningStatistic()
        """One over the time between two ticks, Hz."""
        self.warns_of_overruns = False
        """Whether a tick that takes longer than its period is told of; by the stopwatch."""
        self.on_tick: Callable[[int], None] | None = None
        """Called after every tick, with its time, ns."""

    # --- the tick -----------------------------------------------------------------------------

    def is_due(self, time: int) -> bool:
        """Tell whether it must tick at ``time``, ns."""
        return time >= self.next_tick

    def tick(self, time: int) -> None:
        """Read the hardware, update every active controller that is due, write; ``time`` in ns."""
        self.next_tick = time - time % self.period + self.period
        last, self._last_tick = self._last_tick, time
        period = self.period if last is None else time - last
        stopwatch = self.resources.stopwatch
        begin = stopwatch()
        self._abandon(self.resources.read(time, period), time)
        after_read = stopwatch()
        self._update(time, period)
        after_update = stopwatch()
        self._write(time, period)
        end = stopwatch()
        if last is not None and period > 0:
            self.periodicity.add(NANOSECONDS / period)
        if self.warns_of_overruns and end - begin > self.period:
            update = after_update - after_read
            self._warn_of_overrun(after_read - begin, update, end - after_update)
        if self.on_tick is not None:
            self.on_tick(time)

    def _update(self, time: int, period: int) -> None:
        survives, nominal = self._faults.survives, self.period
        failed = [
            controller
            for controller in self._controllers.active
            if not survives('updating', controller, controller.update, time, nominal)
        ]
        if failed:
            self._faults.replace(failed, 'update', time)
            self.refresh()
        self.resources.enforce_limits(period)

    def _write(self, time: int, period: int) -> None:
        gone = self.resources.write(time, period)
        if self.defaults.deactivate_controllers_on_hardware_self_deactivate:
            self._abandon(gone, time)
        elif gone:
            states = {name: self.resources.components[name].state for name in gone}
            failed = [name for name in gone if states[name] is not LifecycleState.INACTIVE]
            self._faults.abandon(failed, time)
            self.refresh()

    def _warn_of_overrun(self, *durations: int) -> None:
        expected = 1e6 / self.update_rate
        self._log(Severity.WARN, overrun_text(expected, *durations), throttle=1.0)

    def begin(self, time: int) -> None:
        """
        Time begins at ``time`` (ns): the first tick is that at the next multiple of the period.

        One at once would leave the second a period that is no period, of a millisecond perhaps.
        """
        self._last_tick = None
        self.next_tick = time + -time % self.period

    def reset(self, time: int) -> None:
        """The world began anew at ``time`` (ns): states stay, and all begins anew."""
        self.begin(time)
        self._abandon(self.resources.reset(time), time)
        self._tell('resetting', lambda each: each.reset(time), time)

    def set_clock(self, time: int) -> None:
        """The clock was set to ``time`` (ns), and the robot went on."""
        self.begin(time)
        self.resources.set_clock()
        self._tell('setting the clock of', lambda each: each.set_clock(time), time)

    def _tell(self, doing: str, tell: Callable[[LoadedController], None], time: int) -> None:
        survives = self._faults.survives
        failed = [each for each in self._controllers if not survives(doing, each, tell, each)]
        if failed:
            self._faults.replace([each for each in failed if each.is_active], 'reset', time)
            self.refresh()

    def shut_down(self, time: int) -> None:
        """End: deactivate the controllers, write once more, then stop and close the hardware."""
        self._log(Severity.INFO, 'Shutdown request received....')
        self._log(Severity.INFO, 'Shutting down all controllers in the controller manager.')
        for loaded in self._controllers.active:
            self._log(Severity.INFO, f"Deactivating controller '{loaded.name}'")
        try:
            self._execution.drop(self._controllers.active, time)
            self.resources.enforce_limits(self.period)
            self.resources.write(time, self.period)
            for loaded in self._controllers:
                if not loaded.is_busy:  # another thread is still in its configure
                    self._log(Severity.INFO, f"Shutting down controller '{loaded.name}'")
                    self._clean_up(loaded)
                    loaded.finalize()
        finally:  # whatever a watch of these raises, the motors stop
            self.resources.shut_down()
        self.refresh()
        self._log(Severity.INFO, 'Shutting down the controller manager.')

    def _abandon(self, components: Sequence[str], time: int) -> None:
        """Deactivate what used components that have just gone."""
        if components:
            self._faults.abandon(components, time)
            self.refresh()

    # --- switch -------------------------------------------------------------------------------

    def switch(
        self,
        activate: Sequence[str],
        deactivate: Sequence[str],
        strictness: int,
        time: int,
        timeout: int | None = None,
    ) -> str:
        """
        Activate and deactivate in one go; return the message of success.

        ``strictness``: as in the request; 0 leaves it open. ``timeout``: ns, as in the request.
        A switch here is one call between two ticks. It waits for nothing, so that it works while
        the simulation is paused, no time-out can pass, and ``activate_asap`` of the request makes
        no difference: it is always as soon as possible. Raises ControllerError.
        """
        chosen = self.defaults.choose_strictness(strictness, self._log)
        if timeout == 0:
            self._log(
                Severity.INFO,
                'Switch controller timeout is set to 0, using default 1s!',
                throttle=math.inf,
            )
        for verb, names in (('Activating', activate), ('Deactivating', deactivate)):
            if names:
                self._log(Severity.INFO, f'{verb} controllers: [ {" ".join(names)} ]')
        switching = Switching(self._controllers, self.resources, chosen, self._log)
        plan = switching.plan(activate, deactivate)
        if not plan.activate and not plan.deactivate:
            return NOTHING_TO_SWITCH
        try:
            self._execution.carry_out(plan, chosen, time)
        finally:
            self.refresh()
        if chosen is Strictness.STRICT:
            return 'Successfully switched controllers!'
        return (
            'Successfully switched controllers! '
            f'Deactivated controllers: [ {names_of(plan.deactivate)} ] '
            f'Activated controllers: [ {names_of(plan.activate)} ]'
        )

    def set_component_state(self, name: str, state: LifecycleState, time: int) -> None:
        """
        Bring a hardware component to a state; controllers that lose interfaces are deactivated.

        Raises HardwareError.
        """
        try:
            self.resources.set_state(name, state)
        finally:
            self._abandon([name], time)
            self.refresh()
