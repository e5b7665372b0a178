# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The controller manager of a robot, in this process: brought up, and asked as by services."""

from collections import deque
from collections.abc import Callable, Collection, Coroutine, Iterator, Mapping, Sequence
from dataclasses import dataclass
import logging
import time as wall
from typing import Any, TypeVar

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.snapshot import ControllerSnapshot, ManagerSnapshot
from amr_description.control.switching import Strictness
from amr_description.controller_manager.bring_up import bring_up
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.controller_manager.plain_parameters import PlainParameters
from amr_description.controller_manager.requests import ManagerRequests, run_at_once
from amr_description.controller_manager.spawner import ControllerState, reason_of
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Log, Severity, Throttle
from amr_description.messages.lifecycle import ACTIVITY, activity, States, states_of
from amr_description.plugin_errors import is_traceback, log_error
from amr_description.sim.robot_view import RobotView
from amr_description.simulation.engine import Arrival
from amr_description.simulation.plain_controllers import (
    Newest,
    PlainController,
    PlainHost,
    SIM_TIME,
)
from amr_description.simulation.publishing import LATCHED, PlainPublisher

# --- The log of a simulation ---------------------------------------------------------------------
#
# There the logger is ``amr_description.<node>``; a program that wants to see them says so, as by
# ``logging.basicConfig(level='INFO')``.

logging.getLogger('amr_description').addHandler(logging.NullHandler())
_MOST = 5000
"""Lines that are kept."""


@dataclass(frozen=True, slots=True)
class LogLine:
    """One line, and the node that would have said it."""

    node: str
    severity: Severity
    text: str

    def __str__(self) -> str:
        return f'[{self.severity.name}] [{self.node}]: {self.text}'


class LogLines:
    """The newest lines of all components, oldest first."""

    def __init__(self) -> None:
        self.count = 0
        """Of all lines so far."""
        self._lines: deque[LogLine] = deque(maxlen=_MOST)

    def __iter__(self) -> Iterator[LogLine]:
        return iter(self._lines)

    def log_of(self, node: str) -> Log:
        """Return the log of a component, by the full name of its node."""
        name = node.strip('/').replace('/', '.')
        logger = logging.getLogger(f'amr_description.{name}')
        repeated = Throttle(wall.monotonic)

        def log(severity: Severity, text: str, *, throttle: float = 0.0) -> None:
            if throttle and not repeated.passes(text, throttle):
                return
            self.count += 1
            self._lines.append(LogLine(name, severity, text))
            logger.log(severity, text)

        return log

    def errors_since(self, count: int, nodes: Collection[str]) -> list[str]:
        """Return the errors that some nodes have logged, each once, since there were ``count``."""
        names = {node.strip('/').replace('/', '.') for node in nodes}
        newest = [*self._lines][max(0, len(self._lines) - (self.count - count)) :]
        found = (
            each.text
            for each in newest
            if each.severity >= Severity.ERROR
            and each.node in names
            and not is_traceback(each.text)
        )
        return list(dict.fromkeys(found))


_Result = TypeVar('_Result')
_TIMEOUT = 5_000_000_000
"""ns, of a switch; none is ever waited for."""


class LocalManager:
    """
    A controller manager without a node.

    It is a :class:`~amr_description.controller_manager.spawner.Manager`.
    """

    requests: ManagerRequests
    """Set when it is brought up."""

    def __init__(
        self,
        arrival: Arrival,
        *,
        lines: LogLines,
        time: Callable[[], int],
        publisher: PlainPublisher,
    ) -> None:
        """
        Read its parameters.

        Args:
            arrival: Its robot, and how it is called.
            lines: Get what it logs.
            time: Returns the present time, ns.
            publisher: Of the loop.

        Raises:
            ParameterError: A parameter is no good, as an ``update_rate`` of 0.
        """
        self.namespace, arguments = arrival.namespace, arrival.arguments
        self.name = f'{self.namespace.rstrip("/")}/{arrival.manager_name}'
        self._robot, self._hardware = arrival.robot, arrival.hardware
        self._lines, self._log, self._time = lines, lines.log_of(self.name), time
        self._host = PlainHost(self.namespace, lines.log_of, time, publisher)
        self._publisher = publisher
        self._states: tuple[States, States] | None = None
        self._activity = publisher.messages(f'{self.name}/activity', ACTIVITY, LATCHED)
        self._asked = 0
        """Lines of log before the last request."""
        store = PlainParameters(self.name, arguments, SIM_TIME)
        self.parameters = ManagerParameters(store, arguments, self._log)

    @property
    def update_rate(self) -> int:
        """Hz."""
        return self.parameters.update_rate

    def bring_up(self, world: RobotView, period: int, simulates_mocks: bool) -> ControllerManager:
        """See :class:`~amr_description.simulation.engine.PreparedManager`."""
        inside = self.namespace.rstrip('/')
        manager = bring_up(
            self.parameters,
            self._log,
            self._robot,
            [(info, self._lines.log_of(f'{inside}/{info.name}')) for info in self._hardware],
            world=world,
            period=period,
            simulates_mocks=simulates_mocks,
        )
        self.requests = ManagerRequests(
            self._host, self._log, self.parameters, manager, robot=self._robot
        )
        manager.on_change = self._publish_activity
        self._publish_activity(manager.snapshot)
        return manager

    def destroy(self) -> None:
        """Publish nothing any more."""
        for each in self.served.values():
            each.destroy()
        self._publisher.forget([self._activity])

    def _publish_activity(self, snapshot: ManagerSnapshot) -> None:
        states = states_of(snapshot)
        if states != self._states:
            self._states = states
            time = self._time()
            self._activity.publish(lambda: activity(time, *states))

    @property
    def served(self) -> Mapping[str, PlainController]:
        """Its controllers, by name."""
        return self._host.made

    @property
    def outputs(self) -> Mapping[str, Newest]:
        """What they publish, by topic."""
        return self._host.outputs

    # --- what a spawner asks ------------------------------------------------------------------

    def is_there(self) -> bool:
        """Return whether it is still there."""
        return True

    def states(self) -> dict[str, str]:
        """Return the states of all loaded controllers, by their names."""
        return {name: each.state for name, each in self.controllers().items()}

    def controllers(self) -> Mapping[str, ControllerState]:
        """Return all loaded controllers, by their names."""
        return {each.name: _State(each) for each in self.requests.manager.snapshot.controllers}

    def has_type(self, controller: str) -> bool:
        """Return whether its parameters hold a type for a controller."""
        return bool(self.parameters.store.value(f'{controller}.type'))

    def set_parameters(self, controller: str, parameters: Mapping[str, str | list[str]]) -> None:
        """Set ``<controller>.<key>``. Raises ControllerError."""
        for key, value in parameters.items():
            try:
                self.parameters.store.set(f'{controller}.{key}', value)
            except ParameterError as error:
                raise ControllerError(
                    f'Could not set controller param "{key}" to "{value}" for {controller}: '
                    f'{self.name} refuses it: {error}'
                ) from error

    def load(self, name: str) -> bool:
        """Load a controller."""
        return self._succeeds(self.requests.load(name))

    def configure(self, name: str) -> bool:
        """Configure a controller."""
        return self._succeeds(self.requests.configure(name))

    def unload(self, name: str) -> bool:
        """Unload a controller."""
        return self._succeeds(self.requests.unload(name))

    def switch(
        self,
        *,
        activate: Sequence[str] = (),
        deactivate: Sequence[str] = (),
        timeout: float = 5.0,
        activate_asap: bool = True,
    ) -> str | None:
        """Switch with strictness STRICT; return ``None``, or why it failed."""
        self._asked = self._lines.count
        switch = self.requests.switch(activate, deactivate, Strictness.STRICT, _TIMEOUT)
        try:
            run_at_once(switch)
        except Exception as error:  # a plugin may raise anything
            return log_error(self._log, error)
        return None

    def reasons(self, controller: str) -> str:
        """Return why the last load failed."""
        cause = self.logged(controller)
        if self.has_type(controller):
            return cause
        return reason_of(self, controller, cause, self.parameters.typed_controllers())

    def logged(self, *nodes: str) -> str:
        """Return what it, and nodes beside it, have logged as errors since the last request."""
        inside = self.namespace.rstrip('/')
        names = [self.name, *(f'{inside}/{node}' for node in nodes)]
        return '; '.join(self._lines.errors_since(self._asked, names))

    def _succeeds(self, request: Coroutine[Any, Any, None]) -> bool:
        self._asked = self._lines.count
        try:
            run_at_once(request)
        except Exception as error:  # a plugin may raise anything
            log_error(self._log, error)
            return False
        return True


class LocalHost:
    """
    Makes the managers of robots, in one thread with the engine.

    It is a :class:`~amr_description.simulation.engine.ManagerHost`.
    """

    def __init__(
        self, lines: LogLines, time: Callable[[], int], publisher: PlainPublisher
    ) -> None:
        """
        Begin without robots.

        Args:
            lines: Get what managers log.
            time: Returns the present time, ns.
            publisher: Of the loop.
        """
        self._lines, self._time, self._publisher = lines, time, publisher

    def prepare(self, arrival: Arrival) -> LocalManager:
        """Make the manager of a robot. Raises ParameterError."""
        return LocalManager(arrival, lines=self._lines, time=self._time, publisher=self._publisher)

    async def ask(self, call: Callable[[], _Result]) -> _Result:
        """Make a call: this is the control thread."""
        return call()


class _State:
    """A controller, as a spawner asks for it."""

    def __init__(self, controller: ControllerSnapshot) -> None:
        self.name, self.type = controller.name, controller.type
        self.state = controller.state.label
        self.claimed_interfaces: Sequence[str] = controller.claimed
        self.required_command_interfaces: Sequence[str] = controller.required_commands
        self.required_state_interfaces: Sequence[str] = controller.required_states
