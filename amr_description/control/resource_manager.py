# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The resource manager of one robot: its hardware components, their interfaces, and the claims.

Every method runs on the control thread.

One difference from ros2_control 4.x: an infinite command (or, as this is Python, one that is not a
number) stops its joint, with an ERROR that names the controller. There, infinity reaches the
hardware component, which refuses it and is brought down: a single message with a speed of
1e308 m/s would end the robot.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
import math
from typing import Any, TYPE_CHECKING

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import HardwareComponent, World
from amr_description.control.interfaces import (
    Claim,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    StateInterface,
)
from amr_description.control.joint_limits import (
    CommandRanges,
    JointLimiter,
    limiters_of,
    value_at_rest,
)
from amr_description.control.loaded_component import by_name, LoadedComponent
from amr_description.control.statistics import Stopwatch, unmeasured, zero_clock
from amr_description.errors import (
    HardwareDeactivationError,
    HardwareError,
    HardwareStartError,
    InterfaceError,
)
from amr_description.log import Log, Severity
from amr_description.plugin_errors import describe

if TYPE_CHECKING:
    from amr_description.model.hardware_info import HardwareInfo
    from amr_description.model.robot import Robot


_INACTIVE, _ACTIVE = LifecycleState.INACTIVE, LifecycleState.ACTIVE  # looked up in each cycle


class ResourceManager:
    """The hardware components of one robot, in the order of its description; see the module."""

    def __init__(
        self,
        log: Log,
        robot: 'Robot | None' = None,
        enforce_command_limits: bool = False,
        stopwatch: Stopwatch = zero_clock,
    ) -> None:
        """
        Start without components.

        Args:
            log: of the manager.
            robot: its ``<limit>`` elements limit the joints; None: only their parameters do.
            enforce_command_limits: keep commands within the limits of their joints.
            stopwatch: measures how long everything takes.
        """
        self.log = log
        self.stopwatch = stopwatch
        self.is_measured = stopwatch is not unmeasured
        """Whether statistics are kept."""
        self.components: dict[str, LoadedComponent] = {}
        self._ordered: tuple[LoadedComponent, ...] = ()
        """The same, as each cycle runs through them."""
        self.claims: dict[str, str] = {}
        """Command interface → the controller that has claimed it."""
        self.lends_commands_of_inactive = False
        """True: controllers may command components that are inactive."""
        self._robot = robot
        self._enforces_limits = enforce_command_limits
        self._limiters: dict[str, list[JointLimiter]] = {}
        self._ranges: tuple[CommandRanges, ...] = ()
        """Of each component."""
        self._references: dict[str, dict[str, CommandInterface]] = {}
        self._exported_states: dict[str, dict[str, StateInterface]] = {}

    # --- components ---------------------------------------------------------------------------

    def load(
        self,
        info: 'HardwareInfo',
        find: Callable[[str], Callable[..., HardwareComponent]],
        world: World | None,
        log: Log | None = None,
    ) -> None:
        """
        Create a component from its description, and add it.

        Args:
            info: its ``<ros2_control>`` block.
            find: returns the class of a plugin.
            world: the simulated world; None on a real robot.
            log: of the component; None: that of the manager.

        Raises:
            HardwareError: for an unknown plugin, or an interface that is there already.
            Exception: whatever the constructor of the component raises.
        """
        self.log(Severity.INFO, f"Loading hardware '{info.name}' ")
        create = find(info.plugin)
        self.log(Severity.INFO, f"Loaded hardware '{info.name}' from plugin '{info.plugin}'")
        self.log(Severity.INFO, f"Initialize hardware '{info.name}' ")
        self.add(create(info, log or self.log, world))
        self.log(Severity.INFO, f"Successful initialization of hardware '{info.name}'")

    def add(self, component: HardwareComponent) -> None:
        """Add a component. Raises HardwareError: one of its names is taken, or invalid."""
        loaded = LoadedComponent(component, self.log)
        name = loaded.info.name
        if name in self.components:
            raise HardwareError(f"Hardware component '{name}' is there twice")
        for other in self.components.values():
            twice = (
                loaded.states.keys() & other.states.keys()
                | loaded.commands.keys() & other.commands.keys()
            )
            if twice:
                raise HardwareError(
                    f"Interface '{min(twice)}' is exported by the hardware components "
                    f"'{other.info.name}' and '{name}'; one of them must leave it out"
                )
        if loaded.info.is_async:
            self.log(
                Severity.WARN,
                f'Hardware component \'{name}\' has is_async="true": it is read and written in '
                'the control loop nevertheless; it must do slow I/O on a thread of its own',
            )
        if self._enforces_limits:
            self._limiters[name] = limiters_of(loaded, self._robot, self.log)
        self.components[name] = loaded
        self._ordered = (*self._ordered, loaded)
        self._ranges = (*self._ranges, CommandRanges(loaded, self._limiters.get(name, ())))

    def set_state(self, name: str, target: LifecycleState) -> None:
        """
        Bring a component to ``target``, one transition after the other.

        Raises HardwareError: it is unknown or finalized, or a transition failed, which leaves it
        in the state that it has reached.
        """
        loaded = self.components.get(name)
        if loaded is None:
            raise HardwareError(
                f"Hardware component '{name}' does not exist. Known: {_listed(self.components)}"
            )
        loaded.go_to(target)

    def start_components(
        self,
        unconfigured: Sequence[str] = (),
        inactive: Sequence[str] = (),
        shutdown_on_failure: bool = True,
    ) -> None:
        """
        Bring the components to their initial states: active, unless they are named.

        Args:
            unconfigured: names of those that stay unconfigured; unknown ones are warned of.
            inactive: names of those that become inactive; likewise.
            shutdown_on_failure: False: a component that fails stays in the state that it has
                reached, which is logged.

        Raises:
            HardwareStartError: a component fails.
        """
        targets = dict.fromkeys(self.components, LifecycleState.ACTIVE)
        named = {LifecycleState.UNCONFIGURED: unconfigured, LifecycleState.INACTIVE: inactive}
        for state, name in ((state, name) for state, names in named.items() for name in names):
            if targets.get(name) is LifecycleState.ACTIVE:
                targets[name] = state
            elif name:  # an empty name stands for an empty list
                self.log(
                    Severity.WARN,
                    f"Hardware component '{name}' is unknown, therefore not set in "
                    f"'{state.label}' state. Known and not yet set: "
                    f'{_listed(n for n, to in targets.items() if to is LifecycleState.ACTIVE)}',
                )
        for name, target in sorted(targets.items(), key=lambda pair: pair[1]):
            self._start(name, target, shutdown_on_failure)

    def _start(self, name: str, target: LifecycleState, shutdown_on_failure: bool) -> None:
        activate = target is LifecycleState.ACTIVE
        setting = f"Setting component '{name}' to '{target.label}' state."
        self.log(Severity.INFO, f"Activating component '{name}'." if activate else setting)
        try:
            self.set_state(name, target)
        except HardwareError as error:
            text = (
                f'Failed to set the initial state of the component : {name} to {target.label}. '
                f'{error}'
            )
            if shutdown_on_failure:
                raise HardwareStartError(text) from error
            self.log(Severity.ERROR, text)

    def shut_down(self) -> None:
        """Stop, close and finalize every component, as far as it still can."""
        for loaded in self.components.values():
            loaded.bring_down(LifecycleState.FINALIZED)

    # --- interfaces ---------------------------------------------------------------------------

    def available_commands(self) -> dict[str, CommandInterface]:
        """
        Return the command interfaces of active components and controllers, by name.

        With ``lends_commands_of_inactive``, those of inactive components too.
        """
        lending = (
            loaded
            for loaded in self.components.values()
            if loaded.state is LifecycleState.ACTIVE
            or (self.lends_commands_of_inactive and loaded.is_available)
        )
        sources = chain((loaded.commands for loaded in lending), self._references.values())
        return {name: handle for source in sources for name, handle in source.items()}

    def available_states(self) -> dict[str, StateInterface]:
        """Return the state interfaces of components, then those of active controllers."""
        available = (loaded for loaded in self.components.values() if loaded.is_available)
        sources = chain((loaded.states for loaded in available), self._exported_states.values())
        return {name: handle for source in sources for name, handle in source.items()}

    @staticmethod
    def names(request: InterfaceRequest, available: Iterable[str]) -> tuple[str, ...]:
        """Return the names of a request: all that are available, those listed, or none."""
        if request.claim is Claim.ALL:
            return tuple(available)
        return request.names

    def claim(self, controller: str, names: Sequence[str]) -> list[CommandInterface]:
        """
        Claim command interfaces for a controller.

        Args:
            controller: its name.
            names: of the interfaces.

        Returns:
            The interfaces, in the same order.

        Raises:
            InterfaceError: one is not available, or claimed already; nothing is claimed.
        """
        available = self.available_commands()
        for name in names:
            if name not in available:
                raise InterfaceError(f"the command interface '{name}' is not available")
            holder = self.claims.get(name)
            if holder is not None:
                raise InterfaceError(f"the command interface '{name}' is claimed by '{holder}'")
        self.claims.update(dict.fromkeys(names, controller))
        return [available[name] for name in names]

    def lend_states(self, names: Sequence[str]) -> list[StateInterface]:
        """
        Return state interfaces, in the order of ``names``; any number of controllers may read one.

        Raises InterfaceError: one is not available.
        """
        available = self.available_states()
        missing = [name for name in names if name not in available]
        if missing:
            raise InterfaceError(f"the state interface '{missing[0]}' is not available")
        return [available[name] for name in names]

    def release(self, controller: str) -> None:
        """Release all claims of a controller."""
        self.claims = {name: by for name, by in self.claims.items() if by != controller}

    def add_exported(
        self,
        controller: str,
        references: Iterable[CommandInterface],
        states: Iterable[StateInterface],
    ) -> None:
        """Make the references and exported states of an active controller available to others."""
        self._references[controller] = by_name(references, controller)
        self._exported_states[controller] = by_name(states, controller)

    def remove_exported(self, controller: str) -> None:
        """Make the references and exported states of a controller unavailable."""
        self._references.pop(controller, None)
        self._exported_states.pop(controller, None)

    # --- switching ----------------------------------------------------------------------------

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        Have the components check a switch, see :class:`HardwareComponent`.

        Args:
            start: command interfaces that are to be claimed.
            stop: command interfaces that are to be released.

        Raises:
            HardwareError: a component refuses.
        """
        for loaded, begin, end in self._affected(start, stop):
            try:
                loaded.component.prepare_command_mode_switch(begin, end)
            except Exception as error:  # a third-party component may raise anything
                raise HardwareError(
                    f"Hardware component '{loaded.info.name}' refuses the command mode: "
                    f'{describe(error)}'
                ) from error

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        Have the components carry out a switch; arguments as above.

        Raises HardwareError: a component failed; those after it have not been called.
        """
        for loaded, begin, end in self._affected(start, stop):
            try:
                loaded.component.perform_command_mode_switch(begin, end)
            except Exception as error:
                raise HardwareError(
                    f"Hardware component '{loaded.info.name}' failed to switch its command mode: "
                    f'{describe(error)}'
                ) from error

    def _affected(
        self, start: Sequence[str], stop: Sequence[str]
    ) -> Iterator[tuple[LoadedComponent, list[str], list[str]]]:
        """Yield the available components with some of these interfaces, each with its own."""
        for loaded in self.components.values():
            begin = [name for name in start if name in loaded.commands]
            end = [name for name in stop if name in loaded.commands]
            if loaded.is_available and (begin or end):
                yield loaded, begin, end

    # --- the control cycle --------------------------------------------------------------------

    def set_clock(self) -> None:
        """Follow a jump of the clock, while the robot went on."""
        for loaded in self.components.values():
            loaded.set_clock()

    def reset(self, time: int) -> list[str]:
        """
        Reset the components, after the simulation was reset to ``time``, ns.

        Returns the names of those that failed and were brought down.
        """
        for limiter in chain.from_iterable(self._limiters.values()):
            limiter.reset()
        lost: list[str] = []
        for loaded in self.components.values():
            try:
                loaded.reset(time)
            except Exception as error:
                lost += self._handle_failure(loaded, 'reset', error)
        return lost

    def read(self, time: int, period: int) -> list[str]:
        """
        Read every available component that is due.

        Args:
            time: of this tick, ns.
            period: since the previous tick, ns.

        Returns:
            The names of those that failed and were brought down, along with their groups.
        """
        lost: list[str] = []
        stopwatch, is_measured = self.stopwatch, self.is_measured
        before = stopwatch() if is_measured else 0
        for loaded in self._ordered:
            if loaded.state is not _ACTIVE and loaded.state is not _INACTIVE:
                continue
            last = loaded.last_read
            elapsed = loaded.elapsed(last, time, period) if loaded.rate else period
            if elapsed is None:
                continue
            loaded.last_read = time
            try:
                loaded.component.read(time, elapsed)
            except Exception as error:  # a third-party component may raise anything
                lost += self._handle_failure(loaded, 'read', error)
                before = stopwatch()
                continue
            if is_measured:
                after = stopwatch()
                loaded.read_statistic.add(after - before, None if last is None else time - last)
                before = after
        return lost

    def write(self, time: int, period: int) -> list[str]:
        """
        Write every active component that is due; arguments as of :meth:`read`.

        Returns the names of those that are no longer active: brought down along with their groups,
        or inactive if they asked for that.
        """
        lost: list[str] = []
        stopwatch, is_measured = self.stopwatch, self.is_measured
        before = stopwatch() if is_measured else 0
        for loaded in self._ordered:
            if loaded.state is not _ACTIVE or loaded.is_sensor:
                continue
            last = loaded.last_write
            elapsed = loaded.elapsed(last, time, period) if loaded.rate else period
            if elapsed is None:
                continue
            loaded.last_write = time
            try:
                loaded.component.write(time, elapsed)
            except Exception as error:
                lost += self._handle_failure(loaded, 'write', error)
                before = stopwatch()
                continue
            if is_measured:
                after = stopwatch()
                loaded.write_statistic.add(after - before, None if last is None else time - last)
                before = after
        return lost

    def _handle_failure(self, failed: LoadedComponent, action: str, error: Exception) -> list[str]:
        """Deactivate a component that asks for it, or bring it and its group down."""
        failed.report(action, error)
        name, group = failed.info.name, failed.info.group
        if action == 'write' and isinstance(error, HardwareDeactivationError):
            failed.bring_down(LifecycleState.INACTIVE)
            return [name]
        failed.bring_down()
        lost = [name]
        for other in self.components.values():
            if group and other.info.group == group and other.is_available:
                self.log(
                    Severity.ERROR,
                    f"Hardware component '{other.info.name}' is brought down with '{name}': both "
                    f"are of the group '{group}'",
                )
                other.bring_down()
                lost.append(other.info.name)
        return lost

    def enforce_limits(self, period: int) -> None:
        """
        Limit what controllers have written for the next ``period`` ns; before every :meth:`write`.

        With ``enforce_command_limits``, commands are kept within the limits of their joints. In
        any case a command that is infinite or not a number stops its joint: no component ever
        gets one.
        """
        for ranges in self._ranges:
            if not ranges.hold() and ranges.loaded.is_available:
                self._limit(ranges.loaded, period)

    def _limit(self, loaded: LoadedComponent, period: int) -> None:
        try:
            self._limit_numbers(loaded, period)
        except (TypeError, OverflowError):
            for command in loaded.commands.values():
                if not _is_number(command.value):
                    self._stop(command)
            self._limit_numbers(loaded, period)

    def _limit_numbers(self, loaded: LoadedComponent, period: int) -> None:
        """Limit the commands of a component. Raises TypeError, OverflowError: not a number."""
        name = loaded.info.name
        for limiter in self._limiters.get(name, ()):
            limiter.enforce(period / NANOSECONDS)
        for command in loaded.commands.values():
            if math.isinf(command.value):
                self._stop(command)

    def _stop(self, command: CommandInterface) -> None:
        still = value_at_rest(command.interface)
        writer = self.claims.get(command.name)
        by = f" by controller '{writer}'" if writer else ''
        self.log(
            Severity.ERROR,
            f"The command '{command.name}' is {command.value}{by}; a finite number is needed. It "
            f'is set to {still}',
            throttle=1.0,
        )
        command.value = still


def _listed(names: Iterable[str]) -> str:
    return ', '.join(names) or 'none'


def _is_number(value: Any) -> bool:
    """Return whether a command, which a third-party controller may have written, is a number."""
    try:
        math.isinf(value)
    except (TypeError, OverflowError):
        return False
    return True
