# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which hardware component owns which interface, and which controller has claimed it.

Where this departs from ros2_control 4.x: an infinite command (or, as this is Python, one that is
no number) stops its joint, with an ERROR that names the controller. There infinity goes to the
hardware, whose component refuses it and is brought down: one message with a speed of 1e308 m/s
would end the robot.

The hardware components of one robot: made, brought from state to state, read and written.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
import math
from typing import TYPE_CHECKING

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import HardwareComponent, Log, Severity, World
from amr_description.control.interfaces import (
    Claim,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    StateInterface,
)
from amr_description.control.joint_limits import JointLimiter, limiters_of, value_at_rest
from amr_description.control.loaded_component import by_name, LoadedComponent
from amr_description.control.plugin_errors import describe
from amr_description.control.statistics import Stopwatch, zero_clock
from amr_description.errors import (
    HardwareDeactivationError,
    HardwareError,
    HardwareStartError,
    InterfaceError,
)

if TYPE_CHECKING:
    from amr_description.model.hardware_info import HardwareInfo
    from amr_description.model.robot import Robot


class HardwareComponents:
    """All components of one robot, in the order of its description."""

    def __init__(
        self,
        log: Log,
        robot: 'Robot | None' = None,
        enforce_command_limits: bool = False,
        stopwatch: Stopwatch = zero_clock,
    ) -> None:
        """
        ``robot``: where the limits of the joints are from; else only from parameters.
        ``stopwatch``: measures how long everything takes.
        """
        self.log = log
        self.stopwatch = stopwatch
        self.components: dict[str, LoadedComponent] = {}
        self._robot = robot
        self._enforces_limits = enforce_command_limits
        self._limiters: dict[str, list[JointLimiter]] = {}

    def load(
        self,
        info: 'HardwareInfo',
        find: Callable[[str], Callable[..., HardwareComponent]],
        world: World | None,
        log: Log | None = None,
    ) -> None:
        """
        Make a component of the class that ``find`` knows by the name of its plugin, and take it.

        ``log``: the component's own, where it has one. Raises HardwareError, or whatever the
        constructor of a foreign component raises.
        """
        self.log(Severity.INFO, f"Loading hardware '{info.name}' ")
        make = find(info.plugin)
        self.log(Severity.INFO, f"Loaded hardware '{info.name}' from plugin '{info.plugin}'")
        self.log(Severity.INFO, f"Initialize hardware '{info.name}' ")
        self.add(make(info, log or self.log, world))
        self.log(Severity.INFO, f"Successful initialization of hardware '{info.name}'")

    def add(self, component: HardwareComponent) -> None:
        """Take a component and its interfaces. Raises HardwareError where a name is taken."""
        owned = LoadedComponent(component, self.log, self.stopwatch)
        name = owned.info.name
        if name in self.components:
            raise HardwareError(f"Hardware component '{name}' is there twice")
        for other in self.components.values():
            twice = (
                owned.states.keys() & other.states.keys()
                | owned.commands.keys() & other.commands.keys()
            )
            if twice:
                raise HardwareError(
                    f"Interface '{min(twice)}' is exported by the hardware components "
                    f"'{other.info.name}' and '{name}'; one of them must leave it out"
                )
        if owned.info.is_async:
            self.log(
                Severity.WARN,
                f'Hardware component \'{name}\' has is_async="true": it is read and written in '
                'the control loop all the same; its own thread must do what takes long',
            )
        if self._enforces_limits:
            self._limiters[name] = limiters_of(owned, self._robot, self.log)
        self.components[name] = owned

    def set_state(self, name: str, target: LifecycleState) -> None:
        """
        Bring a component to ``target``, one transition after the other; finalized is final.

        Raises HardwareError: unknown component, no such way, or a transition failed; it is then
        left in the state that it reached.
        """
        owned = self.components.get(name)
        if owned is None:
            raise HardwareError(
                f"Hardware component '{name}' does not exist. Known: {_listed(self.components)}"
            )
        owned.go_to(target)

    def start_components(
        self,
        unconfigured: Sequence[str] = (),
        inactive: Sequence[str] = (),
        shutdown_on_failure: bool = True,
    ) -> None:
        """
        Bring the components to their first states: active, but for those that are named.

        The arguments are the parameters ``hardware_components_initial_state.…``; a name that no
        component has is warned of. Raises HardwareStartError where a component does not get there
        and ``shutdown_on_failure``; without that it stays where it got to, which is logged.
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
        for owned in self.components.values():
            owned.bring_down(LifecycleState.FINALIZED)

    def set_clock(self) -> None:
        """The clock was set, forward or back, while all went on."""
        for owned in self.components.values():
            owned.set_clock()

    def reset(self, time: int) -> list[str]:
        """The world began anew at ``time``, ns; return the components that failed."""
        for limiter in chain.from_iterable(self._limiters.values()):
            limiter.reset()
        return self._each('reset', lambda owned: owned.reset(time))

    def read(self, time: int, period: int) -> list[str]:
        """
        Read every available component that is due; return the names of those that failed.

        They are brought down, with their group.
        """
        return self._each('read', lambda owned: owned.read(time, period))

    def write(self, time: int, period: int) -> list[str]:
        """
        Write every active component that is due; return the names of those that are no longer
        active.

        They are brought down, with their group; one that asked for it is only inactive.
        """
        return self._each('write', lambda owned: owned.write(time, period))

    def _each(self, action: str, do: Callable[[LoadedComponent], None]) -> list[str]:
        lost: list[str] = []
        for owned in self.components.values():
            try:
                do(owned)
            except Exception as error:  # a foreign component may raise anything; others go on
                lost += self._lose(owned, action, error)
        return lost

    def _lose(self, failed: LoadedComponent, action: str, error: Exception) -> list[str]:
        """Deactivate a component that asked for it; else bring it and its group down."""
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


def _listed(names: Iterable[str]) -> str:
    return ', '.join(names) or 'none'


class ResourceManager(HardwareComponents):
    """The components of one robot, their interfaces and the claims on them."""

    def __init__(
        self,
        log: Log,
        robot: 'Robot | None' = None,
        enforce_command_limits: bool = False,
        stopwatch: Stopwatch = zero_clock,
    ) -> None:
        """See the base."""
        super().__init__(log, robot, enforce_command_limits, stopwatch)
        self.claims: dict[str, str] = {}
        """Command interface → the controller that holds it."""
        self.lends_commands_of_inactive = False
        """True: controllers may command components that are not active (yet)."""
        self._references: dict[str, dict[str, CommandInterface]] = {}
        self._exported_states: dict[str, dict[str, StateInterface]] = {}

    # --- interfaces ---------------------------------------------------------------------------

    def available_commands(self) -> dict[str, CommandInterface]:
        """
        Every command interface of an active component or controller, by name.

        With ``lends_commands_of_inactive`` those of inactive components too.
        """
        lending = (
            owned
            for owned in self.components.values()
            if owned.state is LifecycleState.ACTIVE
            or (self.lends_commands_of_inactive and owned.is_available)
        )
        sources = chain((owned.commands for owned in lending), self._references.values())
        return {name: handle for source in sources for name, handle in source.items()}

    def available_states(self) -> dict[str, StateInterface]:
        """Every state interface that can be read, by name: components in their order first."""
        available = (owned for owned in self.components.values() if owned.is_available)
        sources = chain((owned.states for owned in available), self._exported_states.values())
        return {name: handle for source in sources for name, handle in source.items()}

    @staticmethod
    def names(request: InterfaceRequest, available: Iterable[str]) -> tuple[str, ...]:
        """Resolve a request to names: all that are available, those listed, or none."""
        if request.claim is Claim.ALL:
            return tuple(available)
        return request.names

    def claim(self, controller: str, names: Sequence[str]) -> list[CommandInterface]:
        """Lend the command interfaces to a controller. Raises InterfaceError, claiming nothing."""
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
        """Lend state interfaces, which any number may read. Raises InterfaceError."""
        available = self.available_states()
        missing = [name for name in names if name not in available]
        if missing:
            raise InterfaceError(f"the state interface '{missing[0]}' is not available")
        return [available[name] for name in names]

    def release(self, controller: str) -> None:
        """Take all claims of a controller back."""
        self.claims = {name: by for name, by in self.claims.items() if by != controller}

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Ask each component about its commands that begin and end. Raises HardwareError."""
        for owned, begin, end in self._concerned(start, stop):
            try:
                owned.component.prepare_command_mode_switch(begin, end)
            except Exception as error:  # a foreign component may raise anything
                raise HardwareError(
                    f"Hardware component '{owned.info.name}' refuses the command mode: "
                    f'{describe(error)}'
                ) from error

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Tell each component which of its commands begin and end now. Raises HardwareError."""
        for owned, begin, end in self._concerned(start, stop):
            try:
                owned.component.perform_command_mode_switch(begin, end)
            except Exception as error:
                raise HardwareError(
                    f"Hardware component '{owned.info.name}' failed to switch its command mode: "
                    f'{describe(error)}'
                ) from error

    def _concerned(
        self, start: Sequence[str], stop: Sequence[str]
    ) -> Iterator[tuple[LoadedComponent, list[str], list[str]]]:
        """The available components that own some of these, each with its own."""
        for owned in self.components.values():
            begin = [name for name in start if name in owned.commands]
            end = [name for name in stop if name in owned.commands]
            if owned.is_available and (begin or end):
                yield owned, begin, end

    def enforce_limits(self, period: int) -> None:
        """
        Bound what the controllers have written, for ``period`` ns; before every :meth:`write`.

        With ``enforce_command_limits`` commands are kept within the limits of their joints. In any
        case an infinite one stops its joint, and so does what is no number at all: no component
        is ever given one.
        """
        for name, owned in self.components.items():
            if not owned.is_available:
                continue
            try:
                self._bound(name, owned, period)
            except (TypeError, OverflowError):
                for command in owned.commands.values():
                    if not _is_number(command.value):
                        self._stop(command)
                self._bound(name, owned, period)

    def _bound(self, name: str, owned: LoadedComponent, period: int) -> None:
        """Raises TypeError or OverflowError where a command is no number."""
        for limiter in self._limiters.get(name, ()):
            limiter.enforce(period / NANOSECONDS)
        for command in owned.commands.values():
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

    # --- what controllers offer ---------------------------------------------------------------

    def offer(
        self,
        controller: str,
        references: Iterable[CommandInterface],
        states: Iterable[StateInterface],
    ) -> None:
        """Make an active controller's references and exported states available to others."""
        self._references[controller] = by_name(references, controller)
        self._exported_states[controller] = by_name(states, controller)

    def withdraw(self, controller: str) -> None:
        """Take what a controller offered back."""
        self._references.pop(controller, None)
        self._exported_states.pop(controller, None)


def _is_number(value: object) -> bool:
    """Tell whether a stranger's controller has written what a component can read."""
    try:
        math.isinf(value)
    except (TypeError, OverflowError):
        return False
    return True
