# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controller manager of one robot: load, configure, switch; and read → update → write.

Every method runs on the owner's thread. Other threads read :attr:`ControllerManager.snapshot`, an
immutable object that is replaced as a whole.

The way of a controller from loaded to inactive, and back to unloaded.

What is said of a cycle that takes longer than there is time for it.

What the parameters ``defaults.…`` of a controller manager decide.

The configuration of a controller, which may take its time on another thread.

How often a controller is updated: at every so manieth tick of its manager.
"""

from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Controller, Log, Severity
from amr_description.control.controller_list import ControllerList
from amr_description.control.failure_handling import FailureHandler
from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import ignore_transition, LoadedController, Watch
from amr_description.control.plugin_errors import describe
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.snapshot import ManagerSnapshot, take_snapshot
from amr_description.control.statistics import RunningStatistic
from amr_description.control.switching import (
    names_of,
    NOTHING_TO_SWITCH,
    Strictness,
    SwitchExecution,
    Switching,
)
from amr_description.errors import ControllerError


class PendingConfigure:
    """
    The configuration of one controller, under way.

    The owner begins it and finishes it (:class:`ControllerManager`); in between any one thread
    calls :meth:`run`, once, while the loop goes on: a long configure stops no robot.
    """

    def __init__(self, loaded: LoadedController) -> None:
        self.loaded = loaded
        self.failure: Exception | None = ControllerError('it was not configured')
        self.transition = ExitStack()
        """Open from the begin to the finish."""
        self.transition.enter_context(loaded.transition(LifecycleState.INACTIVE))

    def run(self, parameters: Any) -> None:
        """
        Call the controller's ``configure``; what it raises is kept for the finish.

        A controller that is being configured is touched by nobody else.
        """
        try:
            self.loaded.controller.configure(parameters)
        except Exception as error:  # a foreign controller may raise anything
            self.failure = error
        else:
            self.failure = None


def update_divisor(controller: Controller, manager_rate: int, log: Log) -> int:
    """
    Return the ticks of the manager (``manager_rate``, Hz) for each update of the controller.

    What cannot be had exactly is warned of. Raises ControllerError: its rate is not positive.
    """
    name, rate = controller.context.name, controller.context.update_rate
    if rate <= 0:
        raise ControllerError(
            f"The update rate of controller '{name}' must be above 0 Hz, found {rate}"
        )
    if rate > manager_rate:
        log(
            Severity.WARN,
            f"The update rate of controller '{name}', {rate} Hz, is above that of the controller "
            f'manager, {manager_rate} Hz, and is set to it',
        )
        return 1
    stride = (2 * manager_rate + rate) // (2 * rate)  # half away from zero, as C++ rounds
    if manager_rate % rate:
        log(
            Severity.WARN,
            f"The update rate of controller '{name}', {rate} Hz, is not achievable with a "
            f'controller manager at {manager_rate} Hz; it runs at {manager_rate / stride:g} Hz',
        )
    return stride


class ControllerLifecycles:
    """Loads, configures, cleans up and unloads; who is active is for the manager to say."""

    def __init__(self, resources: ResourceManager, update_rate: int, log: Log) -> None:
        """``update_rate``: of the manager, Hz."""
        self.resources = resources
        self.update_rate = update_rate
        self._log = log
        self._controllers = ControllerList()
        self._execution = SwitchExecution(self._controllers, resources, log)
        self._failures = FailureHandler(self._controllers, resources, self._execution, log)
        self.on_change: Callable[[ManagerSnapshot], None] = lambda _: None
        """Called with every new snapshot."""
        self.snapshot = ManagerSnapshot()
        self.refresh()

    def load(
        self,
        controller: Controller,
        type_name: str,
        fallbacks: Iterable[str] = (),
        watch: Watch = ignore_transition,
    ) -> None:
        """
        Take a controller that was made elsewhere.

        ``fallbacks``: the controllers to start when it fails. ``watch``: is told of every
        transition. Raises ControllerError: name, rate or fallbacks.
        """
        name = controller.context.name
        if name in self._controllers:
            raise ControllerError(
                f"A controller named '{name}' was already loaded inside the controller manager"
            )
        fallbacks = tuple(fallbacks)
        if name in fallbacks:
            raise ControllerError(
                f"Controller '{name}' cannot be a fallback controller for itself."
            )
        stride = update_divisor(controller, self.update_rate, self._log)
        stopwatch = self.resources.stopwatch
        self._controllers.add(
            LoadedController(controller, type_name, stride, fallbacks, watch, stopwatch)
        )
        self.refresh()

    def configure(self, name: str, parameters: Any) -> Controller:
        """Configure, from inactive again; return the controller. Raises ControllerError."""
        configuring = self.begin_configure(name)
        configuring.run(parameters)
        return self.finish_configure(configuring)

    def begin_configure(self, name: str) -> PendingConfigure:
        """
        Check, clean up what is inactive, and set the controller aside. Raises ControllerError.

        Until :meth:`finish_configure` nothing else can be asked of it, so that any thread may
        ``run`` what this returns.
        """
        loaded = self._find(name, 'configure')
        if loaded.state not in (LifecycleState.UNCONFIGURED, LifecycleState.INACTIVE):
            raise ControllerError(
                f"Controller '{name}' can not be configured from '{loaded.state.label}' state."
            )
        self._clean_up(loaded)
        loaded.is_busy = True
        self.refresh()
        return PendingConfigure(loaded)

    def finish_configure(self, configuring: PendingConfigure) -> Controller:
        """
        Take the controller in again: inactive, or unconfigured where its ``configure`` raised.

        Raises ControllerError.
        """
        loaded = configuring.loaded
        loaded.is_busy = False
        try:
            with configuring.transition:
                if configuring.failure is not None:
                    raise configuring.failure
                self._settle(loaded)
        except Exception as error:  # a foreign controller may raise anything
            raise ControllerError(
                f"Failed to configure controller '{loaded.name}': {describe(error)}"
            ) from error
        finally:
            self.refresh()
        return loaded.controller

    def _settle(self, loaded: LoadedController) -> None:
        loaded.settle(self.resources)
        try:
            self._controllers.link()
        except ControllerError:
            loaded.unsettle()
            raise

    def cleanup(self, name: str) -> None:
        """Bring an inactive controller back to unconfigured. Raises ControllerError."""
        loaded = self._find(name, 'cleanup')
        if loaded.state not in (LifecycleState.UNCONFIGURED, LifecycleState.INACTIVE):
            raise ControllerError(
                f"Controller '{name}' can not be cleaned-up from '{loaded.state.label}' state."
            )
        self._clean_up(loaded)
        self.refresh()

    def unload(self, name: str) -> None:
        """Remove a controller that is not active. Raises ControllerError."""
        loaded = self._find(name, 'unload')
        if loaded.is_active:
            raise ControllerError(
                f"Could not unload controller with name '{name}' because it is still active"
            )
        self._clean_up(loaded)
        loaded.finalize()
        self._controllers.remove(name)
        self.refresh()

    def _clean_up(self, controller: LoadedController) -> None:
        """Inactive → unconfigured, which it is whatever its ``cleanup`` raises."""
        if controller.state is LifecycleState.INACTIVE:
            self._failures.call_guarded('cleaning up', controller, controller.cleanup)
            self._controllers.link()

    # --- helpers ------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Take a new snapshot, after anything has changed."""
        self.snapshot = take_snapshot(self._controllers, self.resources, self.update_rate)
        self.on_change(self.snapshot)

    @property
    def loaded(self) -> tuple[LoadedController, ...]:
        """The controllers in the order of their updates; on the owner's thread."""
        return tuple(self._controllers)

    def _find(self, name: str, verb: str) -> LoadedController:
        loaded = self._controllers.get(name)
        if loaded is None:
            raise ControllerError(
                f"Could not {verb} controller with name '{name}' because no controller with this "
                'name exists'
            )
        if loaded.is_busy:
            raise ControllerError(
                f"Could not {verb} controller with name '{name}' because it is being configured; "
                'ask again when that has ended'
            )
        return loaded


_MICROSECOND = 1000
"""ns."""


def overrun_text(expected: float, read: int, update: int, write: int) -> str:
    """Say how long the parts of a cycle took, ns, where ``expected`` µs are to be had."""
    total = (read + update + write) / _MICROSECOND
    return (
        f'Overrun might occur, Total time : {total:.3f} us (Expected < {expected:.3f} us) --> '
        f'Read time : {read / _MICROSECOND:.3f} us, Update time : {update / _MICROSECOND:.3f} us, '
        f'Write time : {write / _MICROSECOND:.3f} us'
    )


@dataclass(frozen=True, slots=True)
class ManagerDefaults:
    """The parameters ``defaults.…`` of a ``controller_manager`` node."""

    strictness: Strictness = Strictness.BEST_EFFORT
    """``switch_controller.strictness``: of a request that leaves it open."""
    allow_controller_activation_with_inactive_hardware: bool = False
    """True: controllers may command hardware that is not active."""
    deactivate_controllers_on_hardware_self_deactivate: bool = True
    """False: controllers go on commanding hardware that asked to be made inactive."""

    def choose_strictness(self, requested: int, log: Log) -> Strictness:
        """Return how strict a request is: 0 leaves it open, and only two levels are there."""
        if requested in (Strictness.STRICT, Strictness.BEST_EFFORT):
            return Strictness(requested)
        if requested == 0:
            log(
                Severity.WARN,
                'Controller Manager: to switch controllers you need to specify a strictness level '
                'of controller_manager_msgs::SwitchController::STRICT (2) or ::BEST_EFFORT (1). '
                f'When unspecified, the default is {self.strictness.name.lower()}',
                throttle=math.inf,
            )
            return self.strictness
        known = [level.name for level in Strictness if level == requested]
        log(
            Severity.WARN,
            f'Controller Manager: strictness {"".join(known) or requested} is not implemented. '
            'Defaulting to BEST_EFFORT',
        )
        return Strictness.BEST_EFFORT


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
        call_guarded, nominal = self._failures.call_guarded, self.period
        failed = [
            controller
            for controller in self._controllers.active
            if not call_guarded('updating', controller, controller.update, time, nominal)
        ]
        if failed:
            self._failures.switch_to_fallbacks(failed, 'update', time)
            self.refresh()
        self.resources.enforce_limits(period)

    def _write(self, time: int, period: int) -> None:
        gone = self.resources.write(time, period)
        if self.defaults.deactivate_controllers_on_hardware_self_deactivate:
            self._abandon(gone, time)
        elif gone:
            states = {name: self.resources.components[name].state for name in gone}
            failed = [name for name in gone if states[name] is not LifecycleState.INACTIVE]
            self._failures.deactivate_orphans(failed, time)
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
        call_guarded = self._failures.call_guarded
        failed = [each for each in self._controllers if not call_guarded(doing, each, tell, each)]
        if failed:
            self._failures.switch_to_fallbacks(
                [each for each in failed if each.is_active], 'reset', time
            )
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
            self._failures.deactivate_orphans(components, time)
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
