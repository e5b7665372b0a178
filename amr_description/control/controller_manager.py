# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controller manager of one robot: lifecycles of controllers, switching, and the control cycle.

Every method runs on the control thread. Other threads read :attr:`ControllerManager.snapshot`, an
immutable object that is replaced as a whole.
"""

from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Controller
from amr_description.control.controller_list import ControllerList
from amr_description.control.failure_handling import FailureHandler
from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import (
    ignore_transition,
    LoadedController,
    TransitionCallback,
)
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.snapshot import ManagerSnapshot, take_snapshot
from amr_description.control.statistics import RunningStatistic
from amr_description.control.switching import (
    names_of,
    NOTHING_TO_SWITCH,
    Strictness,
    SwitchExecution,
    SwitchPlanner,
)
from amr_description.errors import ControllerError
from amr_description.log import Log, Severity
from amr_description.plugin_errors import describe

_ACTIVE = LifecycleState.ACTIVE  # looked up in each cycle
_MICROSECOND = 1000
"""ns."""


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
        """
        Return the strictness of a request: 0 leaves it open, and only two levels are implemented.
        """
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


class PendingConfigure:
    """
    The configuration of one controller, under way.

    The control thread begins and finishes it (:class:`ControllerManager`). In between, one other
    thread calls :meth:`run`, once, so that a slow ``configure`` does not stop the robot.
    """

    def __init__(self, loaded: LoadedController) -> None:
        self.loaded = loaded
        self.failure: Exception | None = ControllerError('it was not configured')
        self.transition = ExitStack()
        """Closed when the configuration is finished."""
        self.transition.enter_context(loaded.transition(LifecycleState.INACTIVE))

    def run(self, parameters: Any) -> None:
        """Call the controller's ``configure``; keep what it raises for the finish."""
        try:
            self.loaded.controller.configure(parameters)
        except Exception as error:  # a third-party controller may raise anything
            self.failure = error
        else:
            self.failure = None


class ControllerManager:
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
        Start without controllers.

        Args:
            resources: the hardware components.
            update_rate: Hz.
            log: of the manager.
            period: ns, if the steps of the simulation do not divide that of ``update_rate``.
            defaults: the parameters ``defaults.…``.
        """
        self.resources = resources
        self.update_rate = update_rate
        self.defaults = defaults = defaults or ManagerDefaults()
        """May be replaced at any time, as its parameters are set."""
        resources.lends_commands_of_inactive = (
            defaults.allow_controller_activation_with_inactive_hardware
        )
        self.period = period or round(NANOSECONDS / update_rate)
        """Nominal time between two ticks, ns."""
        self.next_tick = 0
        """The instant of the next tick, ns: a multiple of the period, unless one was late."""
        self.periodicity = RunningStatistic()
        """One over the time between two ticks, Hz; empty where nothing is measured."""
        self.warns_of_overruns = False
        """Warn of a tick that takes longer than its period, by the stopwatch of the resources."""
        self.on_tick: Callable[[int], None] | None = None
        """Called after every tick with its time, ns."""
        self.on_change: Callable[[ManagerSnapshot], None] = lambda _: None
        """Called with every new snapshot."""
        self.snapshot = ManagerSnapshot()
        self._log = log
        self._last_tick: int | None = None
        self._controllers = ControllerList()
        self._execution = SwitchExecution(self._controllers, resources, log)
        self._failures = FailureHandler(self._controllers, resources, self._execution, log)
        self.refresh()

    @property
    def loaded(self) -> tuple[LoadedController, ...]:
        """The controllers in the order of their updates; for the control thread."""
        return tuple(self._controllers)

    def refresh(self) -> None:
        """Take a new snapshot, after any change."""
        self.snapshot = take_snapshot(self._controllers, self.resources, self.update_rate)
        self.on_change(self.snapshot)

    # --- lifecycle of controllers -------------------------------------------------------------

    def load(
        self,
        controller: Controller,
        type_name: str,
        fallbacks: Iterable[str] = (),
        on_transition: TransitionCallback = ignore_transition,
    ) -> None:
        """
        Add a controller.

        Args:
            controller: unconfigured.
            type_name: as in ``controller_manager_msgs/msg/ControllerState``.
            fallbacks: names of the controllers to start if it fails.
            on_transition: called for every transition.

        Raises:
            ControllerError: for its name, update rate or fallbacks.
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
        divisor = update_divisor(controller, self.update_rate, self._log)
        self._controllers.add(
            LoadedController(controller, type_name, divisor, fallbacks, on_transition)
        )
        self.refresh()

    def configure(self, name: str, parameters: Any) -> Controller:
        """
        Configure a controller, which may be inactive already, and return it.

        Args:
            name: of the controller.
            parameters: an instance of its ``parameters_type``.

        Raises:
            ControllerError: it is unknown, busy or active, or its ``configure`` raised.
        """
        pending = self.begin_configure(name)
        pending.run(parameters)
        return self.finish_configure(pending)

    def begin_configure(self, name: str) -> PendingConfigure:
        """
        Check whether a controller can be configured; clean it up first if it is inactive.

        Any thread may ``run`` the result. Until :meth:`finish_configure` every other request for
        this controller is refused. Raises ControllerError.
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

    def finish_configure(self, pending: PendingConfigure) -> Controller:
        """
        Return the controller, now inactive. Raises ControllerError: it is unconfigured instead.
        """
        loaded = pending.loaded
        loaded.is_busy = False
        try:
            with pending.transition:
                if pending.failure is not None:
                    raise pending.failure
                loaded.become_inactive(self.resources)
                try:
                    self._controllers.link()
                except ControllerError:
                    loaded.become_unconfigured()
                    raise
        except Exception as error:  # a third-party controller may raise anything
            raise ControllerError(
                f"Failed to configure controller '{loaded.name}': {describe(error)}"
            ) from error
        finally:
            self.refresh()
        return loaded.controller

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
        """Inactive → unconfigured, even if its ``cleanup`` raises."""
        if controller.state is LifecycleState.INACTIVE:
            self._failures.call_guarded('cleaning up', controller, controller.cleanup)
            self._controllers.link()

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

    # --- switching ----------------------------------------------------------------------------

    def switch(
        self,
        activate: Sequence[str],
        deactivate: Sequence[str],
        strictness: int,
        time: int,
        timeout: int | None = None,
    ) -> str:
        """
        Activate and deactivate controllers in one call, between two ticks.

        It waits for nothing, so it works while the simulation is paused, no timeout can pass, and
        ``activate_asap`` of a request makes no difference: it is always as soon as possible.

        Args:
            activate: names.
            deactivate: names.
            strictness: as in the request; 0 leaves it open.
            time: present time, ns.
            timeout: as in the request, ns.

        Returns:
            The message of the response.

        Raises:
            ControllerError: with the message of the response.
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
        planner = SwitchPlanner(self._controllers, self.resources, chosen, self._log)
        plan = planner.plan(activate, deactivate)
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
            self._deactivate_orphans([name], time)
            self.refresh()

    # --- the control cycle --------------------------------------------------------------------

    def is_due(self, time: int) -> bool:
        """Return whether it must tick at ``time``, ns."""
        return time >= self.next_tick

    def tick(self, time: int) -> None:
        """Read the hardware, update the active controllers that are due, write; ``time`` in ns."""
        self.next_tick = time - time % self.period + self.period
        last, self._last_tick = self._last_tick, time
        period = self.period if last is None else time - last
        resources, is_timed = self.resources, self.warns_of_overruns
        stopwatch = resources.stopwatch
        begin = stopwatch() if is_timed else 0
        if lost := resources.read(time, period):
            self._deactivate_orphans(lost, time)
        after_read = stopwatch() if is_timed else 0
        self._update(time, period)
        after_update = stopwatch() if is_timed else 0
        if lost := resources.write(time, period):
            self._lose(lost, time)
        if is_timed:
            self._warn_of_overrun(
                after_read - begin, after_update - after_read, stopwatch() - after_update
            )
        if resources.is_measured and last is not None and period > 0:
            self.periodicity.add(NANOSECONDS / period)
        if self.on_tick is not None:
            self.on_tick(time)

    def _update(self, time: int, period: int) -> None:
        failed: list[LoadedController] = []
        resources = self.resources
        stopwatch, is_measured = resources.stopwatch, resources.is_measured
        before = stopwatch() if is_measured else 0
        for loaded in self._controllers.ordered:
            divisor = loaded.update_divisor
            if loaded.state is not _ACTIVE or (divisor != 1 and not loaded.is_due()):
                continue
            last, loaded.last_update = loaded.last_update, time
            elapsed = self.period * divisor if last is None else time - last
            try:
                loaded.controller.update(time, elapsed)
            except Exception as error:  # a third-party controller may raise anything
                self._failures.log_failure('updating', loaded, error)
                failed.append(loaded)
                before = stopwatch()
                continue
            if is_measured:
                after = stopwatch()
                loaded.statistic.add(after - before, None if last is None else elapsed)
                before = after
        if failed:
            self._failures.switch_to_fallbacks(failed, 'update', time)
            self.refresh()
        resources.enforce_limits(period)

    def _lose(self, lost: Sequence[str], time: int) -> None:
        """Deactivate the controllers of components that :meth:`ResourceManager.write` has lost."""
        if self.defaults.deactivate_controllers_on_hardware_self_deactivate:
            self._deactivate_orphans(lost, time)
        else:
            states = {name: self.resources.components[name].state for name in lost}
            failed = [name for name in lost if states[name] is not LifecycleState.INACTIVE]
            self._failures.deactivate_orphans(failed, time)
            self.refresh()

    def _deactivate_orphans(self, components: Sequence[str], time: int) -> None:
        """Deactivate the controllers of components that have just been brought down."""
        if components:
            self._failures.deactivate_orphans(components, time)
            self.refresh()

    def _warn_of_overrun(self, read: int, update: int, write: int) -> None:
        """Warn of a tick that took longer than a period, with the durations of its parts, ns."""
        if read + update + write <= self.period:
            return
        total = (read + update + write) / _MICROSECOND
        self._log(
            Severity.WARN,
            f'Overrun might occur, Total time : {total:.3f} us (Expected < '
            f'{1e6 / self.update_rate:.3f} us) --> Read time : {read / _MICROSECOND:.3f} us, '
            f'Update time : {update / _MICROSECOND:.3f} us, Write time : '
            f'{write / _MICROSECOND:.3f} us',
            throttle=1.0,
        )

    # --- jumps of time, and the end -----------------------------------------------------------

    def begin(self, time: int) -> None:
        """
        Start at ``time``, ns: the first tick is due at the next multiple of the period.

        A tick at once would give the second one a period of perhaps a millisecond.
        """
        self._last_tick = None
        self.next_tick = time + -time % self.period

    def reset(self, time: int) -> None:
        """Reset everything, after the simulation was reset to ``time``, ns; states stay."""
        self.begin(time)
        self._deactivate_orphans(self.resources.reset(time), time)
        self._call_each('resetting', lambda each: each.reset(time), time)

    def set_clock(self, time: int) -> None:
        """Follow a jump of the clock to ``time``, ns, while the robot went on."""
        self.begin(time)
        self.resources.set_clock()
        self._call_each('setting the clock of', lambda each: each.set_clock(time), time)

    def _call_each(self, doing: str, call: Callable[[LoadedController], None], time: int) -> None:
        call_guarded = self._failures.call_guarded
        failed = [each for each in self._controllers if not call_guarded(doing, each, call, each)]
        if failed:
            self._failures.switch_to_fallbacks(
                [each for each in failed if each.is_active], 'reset', time
            )
            self.refresh()

    def shut_down(self, time: int) -> None:
        """Deactivate the controllers, write once more, then stop and close the hardware."""
        self._log(Severity.INFO, 'Shutdown request received....')
        self._log(Severity.INFO, 'Shutting down all controllers in the controller manager.')
        for loaded in self._controllers.active:
            self._log(Severity.INFO, f"Deactivating controller '{loaded.name}'")
        try:
            self._execution.force_deactivate(self._controllers.active, time)
            self.resources.enforce_limits(self.period)
            self.resources.write(time, self.period)
            for loaded in self._controllers:
                if not loaded.is_busy:  # another thread is still in its configure
                    self._log(Severity.INFO, f"Shutting down controller '{loaded.name}'")
                    self._clean_up(loaded)
                    loaded.finalize()
        finally:  # the motors stop even if an on_transition raises
            self.resources.shut_down()
        self.refresh()
        self._log(Severity.INFO, 'Shutting down the controller manager.')


def update_divisor(controller: Controller, manager_rate: int, log: Log) -> int:
    """
    Return the number of ticks of the manager for one update of a controller.

    Warns if the controller's update rate cannot be kept exactly.

    Args:
        controller: its context holds the rate, Hz.
        manager_rate: Hz.
        log: of the manager.

    Raises:
        ControllerError: the rate is not positive.
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
    divisor = (2 * manager_rate + rate) // (2 * rate)  # half away from zero, as C++ rounds
    if manager_rate % rate:
        log(
            Severity.WARN,
            f"The update rate of controller '{name}', {rate} Hz, is not achievable with a "
            f'controller manager at {manager_rate} Hz; it runs at {manager_rate / divisor:g} Hz',
        )
    return divisor
