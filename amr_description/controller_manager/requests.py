# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is asked of a controller manager: load, configure, switch, unload.

The requests are coroutines, so that over ROS none blocks the thread that serves the node of the
manager: what concerns the manager is done on the control thread, and awaited. Where there is one
thread only nothing has to be awaited, and :func:`run_at_once` runs a request like a function.

What serves a controller, a node with topics or nothing but its ports, is for its :class:`Host`.
"""

from collections.abc import Awaitable, Callable, Coroutine, Iterable, Sequence
import importlib
import sys
from typing import Any, Protocol, TypeVar

from amr_description.control.contracts import Controller
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import TransitionCallback
from amr_description.control.manager_parameters import ControllerEntry
from amr_description.control.switching import Strictness
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.controllers import CONTROLLERS
from amr_description.controllers.checks.parameter_faults import taken_as, type_here
from amr_description.errors import AmrError, ControllerError
from amr_description.log import Log, Severity
from amr_description.model.robot import Robot
from amr_description.plugin_errors import describe

Result = TypeVar('Result')


class ServedController(Protocol):
    """A controller, unconfigured at first, with its parameters and what serves its ports."""

    @property
    def controller(self) -> Controller:
        """The controller."""

    @property
    def publish_transition(self) -> TransitionCallback:
        """Called for every transition, as the manager says."""

    def parameters(self) -> Any:
        """Return its parameters as they are now. Raises ParameterError."""

    def connect(self) -> None:
        """Serve the ports that the configured controller declares, in place of earlier ones."""

    def disconnect(self) -> None:
        """Serve them no more."""

    def destroy(self) -> None:
        """Remove what serves it."""


class Host(Protocol):
    """What the controllers of a manager are served by, and where its calls are made."""

    @property
    def time(self) -> int:
        """Present time, ns; on the control thread."""

    def make(
        self,
        name: str,
        controller_class: type[Controller],
        arguments: Sequence[str],
        *,
        update_rate: int,
        robot: Robot | None,
    ) -> ServedController:
        """
        Make a controller.

        Args:
            name: Of the controller and its node.
            controller_class: Called with a ControllerContext.
            arguments: ROS arguments of the node.
            update_rate: Of the manager, Hz.
            robot: As its URDF says; handed to the controller.

        Raises:
            ParameterError: A parameter has another type, or is out of its bounds.
            Exception: Whatever the constructor of a third party's controller raises.
        """

    def ask(self, call: Callable[[], Result]) -> Awaitable[Result]:
        """Have the control thread make a call between two cycles; what it raises is raised."""

    def run_aside(self, call: Callable[[], None], name: str) -> Awaitable[object]:
        """Make a call that may take long, while the control thread goes on."""


def run_at_once(request: Coroutine[Any, Any, Any]) -> Any:
    """Run a request whose host has all done at once; return what it returns."""
    try:
        request.send(None)
    except StopIteration as end:
        return end.value
    request.close()
    raise RuntimeError('a request waits, and there is nobody to wait for')


def reload_modules(names: Iterable[str]) -> None:
    """
    Import modules anew, so that an edited controller can be loaded without a restart.

    Only the modules named, not what they import. Raises ControllerError: one has a mistake in it;
    those before it are new, it and those behind it are as they were.
    """
    importlib.invalidate_caches()
    for name in sorted(names):
        try:
            if name in sys.modules:
                importlib.reload(sys.modules[name])
        except Exception as error:  # a plugin may raise anything
            raise ControllerError(
                f"Cannot reload controller library '{name}': {type(error).__name__}: {error}"
            ) from error


class ManagerRequests:
    """
    Loads, configures, switches and unloads, for one manager; ``controllers`` by their names.
    """

    def __init__(
        self,
        host: Host,
        log: Log,
        parameters: ManagerParameters,
        manager: ControllerManager,
        *,
        robot: Robot | None,
    ) -> None:
        """
        Begin without controllers.

        Args:
            host: Serves the controllers.
            log: Of the manager.
            parameters: Of the manager.
            manager: Used on the control thread only, but for its snapshot.
            robot: Handed to controllers.
        """
        self.log = log
        self.manager = manager
        self.controllers: dict[str, ServedController] = {}
        self.parameters = parameters
        self._host = host
        self._robot = robot
        self._modules: set[str] = set()

    async def load(self, name: str) -> None:
        """Make a controller and its node, and hand it to the manager. Raises ControllerError."""
        if name in self.controllers:
            raise ControllerError(
                f"A controller named '{name}' was already loaded inside the controller manager"
            )
        entry = self.parameters.entry_of(name)
        self.log(Severity.INFO, f"Loading controller : '{name}' of type '{entry.type}'")
        try:
            served = self._make(name, entry)
        except AmrError:
            raise
        except Exception as error:
            raise ControllerError(
                f"Failed to load controller '{name}': {describe(error)}"
            ) from error
        # Before the manager has it: others may see the controller in the list at once.
        self.controllers[name] = served
        try:
            await self._host.ask(
                lambda: self.manager.load(
                    served.controller,
                    entry.type,
                    entry.fallback_controllers,
                    served.publish_transition,
                )
            )
        except Exception:
            self._forget(name)
            raise

    async def configure(self, name: str) -> None:
        """
        Configure a controller and make its topics. Raises ControllerError, ParameterError.

        The controller's own part, which may take long, runs in a thread of its own.
        """
        served = self.controllers.get(name)
        if served is None:
            raise ControllerError(
                f"Could not configure controller with name '{name}' because no controller with "
                'this name exists'
            )
        self.log(Severity.INFO, f"Configuring controller: '{name}'")
        parameters = served.parameters()
        try:
            configuring = await self._host.ask(lambda: self.manager.begin_configure(name))
            await self._host.run_aside(lambda: configuring.run(parameters), f'configure {name}')
            await self._host.ask(lambda: self.manager.finish_configure(configuring))
        except AmrError:
            states = {each.name: each.state for each in self.manager.snapshot.controllers}
            if states.get(name) is LifecycleState.UNCONFIGURED:
                served.disconnect()
            raise
        if self.controllers.get(name) is not served:
            return  # it was unloaded since
        try:
            served.connect()
        except Exception as error:
            await self.cleanup(name)
            raise ControllerError(
                f"Failed to configure controller '{name}': {describe(error)}"
            ) from error

    async def cleanup(self, name: str) -> None:
        """Bring a controller back to unconfigured, without topics. Raises ControllerError."""
        await self._host.ask(lambda: self.manager.cleanup(name))
        if name in self.controllers:  # and was not unloaded since
            self.controllers[name].disconnect()

    async def unload(self, name: str) -> None:
        """Remove a controller and its node. Raises ControllerError."""
        await self._host.ask(lambda: self.manager.unload(name))
        self._forget(name)

    async def reload_libraries(self, *, force: bool) -> None:
        """Unload every controller, and import anew what they were made of."""
        active = self.manager.snapshot.active_controllers
        if active and not force:
            raise ControllerError(
                'Cannot reload controller libraries because there are still active controllers: '
                f'{", ".join(active)}; deactivate them, or ask with force_kill'
            )
        if active:
            await self._host.ask(
                lambda: self.manager.switch([], active, Strictness.STRICT, self._host.time)
            )
        for name in list(self.controllers):
            await self.unload(name)
        reload_modules(self._modules)

    async def switch(
        self, activate: Sequence[str], deactivate: Sequence[str], strictness: int, timeout: int
    ) -> str:
        """
        Switch controllers.

        Args:
            activate: Names of controllers.
            deactivate: Names of controllers.
            strictness: As in the request.
            timeout: ns.

        Returns:
            The message of the response.

        Raises:
            ControllerError: The switch is refused, or has failed.
        """
        defaults = self.parameters.defaults()

        def switch() -> str:
            self.manager.defaults = defaults
            time = self._host.time
            return self.manager.switch(activate, deactivate, strictness, time, timeout)

        try:
            message = await self._host.ask(switch)
        finally:
            self._disconnect_unconfigured()
        self.log(Severity.INFO, message)
        return message

    def _disconnect_unconfigured(self) -> None:
        """Remove the topics of controllers that a failed activation has left unconfigured."""
        for each in self.manager.snapshot.controllers:
            if each.state is LifecycleState.UNCONFIGURED and each.name in self.controllers:
                self.controllers[each.name].disconnect()

    async def set_component_state(self, name: str, state: LifecycleState) -> None:
        """Bring a hardware component to a state. Raises HardwareError."""
        await self._host.ask(
            lambda: self.manager.set_component_state(name, state, self._host.time)
        )

    def _make(self, name: str, entry: ControllerEntry) -> ServedController:
        """Make a controller. Raises ControllerError, ParameterError, or anything."""
        with self.parameters.explained(name, entry):
            return self._make_of_type(name, entry)

    def _make_of_type(self, name: str, entry: ControllerEntry) -> ServedController:
        here = type_here(entry.type)
        if here != entry.type:
            self.log(Severity.WARN, f"Controller '{name}': {taken_as(entry.type, here)}")
        try:
            controller_class = CONTROLLERS.find(here)
        except ControllerError as error:
            raise ControllerError(
                f"Loader for controller '{name}' (type '{entry.type}') not found. {error}"
            ) from error
        self._modules.add(controller_class.__module__)
        arguments = self.parameters.arguments_of(entry)
        self.log(Severity.INFO, f"Loading controller '{name}'")
        self.log(
            Severity.INFO, f"Controller '{name}' node arguments: --ros-args {' '.join(arguments)} "
        )
        return self._host.make(
            name,
            controller_class,
            arguments,
            update_rate=self.parameters.update_rate,
            robot=self._robot,
        )

    def _forget(self, name: str) -> None:
        """Remove a controller that the manager does not know, or no longer."""
        self.controllers.pop(name).destroy()
