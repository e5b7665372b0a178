# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a test changes in a simulation: physics, sensors, motors, commands; the next reset undoes all.

Functions that do so for users are in ``trials/``: variations and faults. Here are the places where
they reach in: after a read and around a write of hardware components, where commands are sent,
where a scan is read, at the end of a cycle, in the compiled model.
"""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast, TYPE_CHECKING

from amr_description.control.contracts import HardwareComponent, Log, Severity
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.loaded_component import LoadedComponent
from amr_description.control.loop import Loop
from amr_description.errors import SimulationError
from amr_description.sim.model_changes import ModelChanges
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld

if TYPE_CHECKING:  # most simulations have no lidar
    from amr_description.simulation.readings import Scan

AfterRead = Callable[[int], None]
"""Called with the time of the tick, ns, when the states have been read."""
Dispatch = Callable[[int], int | None]
"""From the time at which a command is sent to that at which it arrives, ns; None: it is lost."""


class Alterations:
    """All that is changed of one simulation; see the module."""

    def __init__(
        self,
        world: MujocoWorld,
        loop: Loop,
        manager_of: Callable[[str], ControllerManager | None],
        observers: list[Callable[[int], None]],
        log: Log,
    ) -> None:
        """
        Change nothing yet.

        Args:
            world: The physics.
            loop: Of the simulation.
            manager_of: Returns that of a robot; None: it has none.
            observers: Called at the end of each cycle with its time, ns.
            log: Of the simulator.
        """
        self.model = ModelChanges(world.engine, lambda: world.faults.lost)
        """Masses, frictions, wheels, gravity."""
        self.scans: dict[str, list[Callable[[Scan], Scan]]] = {}
        """By the names of robots: what is made of a scan that is read."""
        self._world, self._loop, self._observers, self._log = world, loop, observers, log
        self._manager_of = manager_of
        self._altered: list[tuple[LoadedComponent, HardwareComponent]] = []
        self._on_cycle: list[Callable[[int], None]] = []
        self._dispatches: list[Dispatch] = []
        self._under_way: deque[tuple[int, Callable[[], None]]] = deque()

    def undo(self) -> None:
        """Undo everything, as a reset begins."""
        self.model.undo()
        self.scans.clear()
        for loaded, component in reversed(self._altered):
            loaded.component = component
        self._altered.clear()
        for call in self._on_cycle:
            self._observers.remove(call)
        self._on_cycle.clear()
        self._dispatches.clear()
        self._under_way.clear()

    def robot(self, name: str = '') -> RobotView:
        """Return a robot, the only one if it is not named. Raises SimulationError."""
        names = self._world.names
        if not name and len(names) != 1:
            raise SimulationError(f'there are {len(names)} robots; name one: {", ".join(names)}')
        return self._world.robot(name or names[0])

    # --- hardware -----------------------------------------------------------------------------

    def states(
        self, name: str, robot: str = ''
    ) -> Mapping[LoadedComponent, Sequence[StateInterface]]:
        """
        Return state interfaces of a robot, and the hardware components that read them.

        Args:
            name: Of an interface, as ``imu/angular_velocity.z``, or of a joint or sensor: all of
                its interfaces.
            robot: Its name; empty: the only one.

        Raises:
            SimulationError: There is none.
        """
        return self._found('state', name, robot, lambda loaded: loaded.states)

    def commands(
        self, joint: str, robot: str = ''
    ) -> Mapping[LoadedComponent, Sequence[CommandInterface]]:
        """Return command interfaces of a joint, or the one of a full name; as :meth:`states`."""
        return self._found('command', joint, robot, lambda loaded: loaded.commands)

    def _found(
        self, kind: str, name: str, robot: str, of: Callable[[LoadedComponent], Mapping[str, Any]]
    ) -> Mapping[LoadedComponent, Sequence[Any]]:
        manager = self._manager_of(self.robot(robot).name)
        components = [*manager.resources.components.values()] if manager else []
        found = {
            loaded: [each for each in of(loaded).values() if name in (each.name, each.prefix)]
            for loaded in components
        }
        found = {loaded: handles for loaded, handles in found.items() if handles}
        if not found:
            known = sorted({each.prefix for loaded in components for each in of(loaded).values()})
            raise SimulationError(
                f"nothing has the {kind} interfaces '{name}'; there are those of: "
                f'{", ".join(known) or "none"}'
            )
        return found

    def after_read(self, loaded: LoadedComponent, call: AfterRead) -> None:
        """Have a call made after each read of a component."""
        self._altered_component(loaded).after_read.append(call)

    def around_write(
        self, loaded: LoadedComponent, call: Callable[[int], Callable[[], None] | None]
    ) -> None:
        """Have a call made before each write; what it returns is called after that write."""
        self._altered_component(loaded).around_write.append(call)

    def _altered_component(self, loaded: LoadedComponent) -> '_AlteredComponent':
        if not isinstance(loaded.component, _AlteredComponent):
            self._altered.append((loaded, loaded.component))
            altered = _AlteredComponent(loaded.component)
            loaded.component = cast(HardwareComponent, altered)
        return cast(_AlteredComponent, loaded.component)

    # --- commands -----------------------------------------------------------------------------

    def dispatch(self, rule: Dispatch) -> None:
        """Have a rule say when each command arrives; of several each adds its delay."""
        if not self._dispatches:
            self.on_cycle(self._deliver)
        self._dispatches.append(rule)

    def send(self, put: Callable[[], None]) -> None:
        """Have a command arrive: now, later or never. Raises what ``put`` raises, if now."""
        now = arrival = self._loop.time
        for rule in self._dispatches:
            following = rule(arrival)
            if following is None:
                return
            arrival = following
        if arrival <= now and not self._under_way:
            put()
            return
        if self._under_way:  # one way, on which none overtakes another
            arrival = max(arrival, self._under_way[-1][0])
        self._under_way.append((arrival, put))

    def _deliver(self, time: int) -> None:
        while self._under_way and self._under_way[0][0] <= time:
            _, put = self._under_way.popleft()
            try:
                put()
            except SimulationError as error:  # its sender has gone on meanwhile
                self._log(Severity.WARN, f'a late command is dropped: {error}')

    # --- time ---------------------------------------------------------------------------------

    def on_cycle(self, call: Callable[[int], None]) -> None:
        """Have a call made at the end of each cycle with its time, ns."""
        self._on_cycle.append(call)
        self._observers.append(call)


class _AlteredComponent:
    """A hardware component, with what is called after its reads and around its writes."""

    def __init__(self, component: HardwareComponent) -> None:
        self.after_read: list[AfterRead] = []
        self.around_write: list[Callable[[int], Callable[[], None] | None]] = []
        self._component = component

    def __getattr__(self, name: str) -> Any:
        return getattr(self._component, name)

    def read(self, time: int, period: int) -> None:
        """Read, then alter what was read."""
        self._component.read(time, period)
        for call in self.after_read:
            call(time)

    def write(self, time: int, period: int) -> None:
        """Write what is altered, then bring back what controllers have commanded."""
        after = [call(time) for call in self.around_write]
        try:
            self._component.write(time, period)
        finally:
            for call_after in reversed(after):
                if call_after is not None:
                    call_after()
