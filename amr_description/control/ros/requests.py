# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the services of a controller manager do: coroutines on the thread that serves its node.

Nodes and topics are made here; the rest is submitted to the control thread and awaited, so that
nothing here ever blocks the executor.
"""

from collections.abc import Callable, Iterable, Sequence
import importlib
import sys
from typing import TypeVar

from rclpy.node import Node
from rclpy.task import Future

from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import LifecycleState
from amr_description.control.manager_parameters import ControllerEntry
from amr_description.control.plugin_errors import describe
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.control.ros.parameters import ManagerParameters
from amr_description.control.ros.plugin_nodes import ControllerNode
from amr_description.control.switching import Strictness
from amr_description.controllers import CONTROLLERS
from amr_description.errors import AmrError, ControllerError
from amr_description.model.robot import Robot
from amr_description.ros.runtime import argument_errors, run_in_thread

Result = TypeVar('Result')


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
        node: Node,
        log: Log,
        parameters: ManagerParameters,
        manager: ControllerManager,
        *,
        robot: Robot | None,
        context: LoopContext,
    ) -> None:
        """
        Begin without controllers.

        Args:
            node: Of the manager; it must be in an executor.
            log: Of the manager.
            parameters: Of the manager.
            manager: Used on the control thread only, but for its snapshot.
            robot: Handed to controllers.
            context: Of the process.
        """
        self.node = node
        self.log = log
        self.manager = manager
        self.controllers: dict[str, ControllerNode] = {}
        self._parameters = parameters
        self._robot = robot
        self._context = context
        self._modules: set[str] = set()

    async def load(self, name: str) -> None:
        """Make a controller and its node, and hand it to the manager. Raises ControllerError."""
        if name in self.controllers:
            raise ControllerError(
                f"A controller named '{name}' was already loaded inside the controller manager"
            )
        entry = self._parameters.entry_of(name)
        self.log(Severity.INFO, f"Loading controller : '{name}' of type '{entry.type}'")
        try:
            controller_node = self._make(name, entry)
        except AmrError:
            raise
        except Exception as error:
            raise ControllerError(
                f"Failed to load controller '{name}': {describe(error)}"
            ) from error
        # Before the manager has it: others may see the controller in the list at once.
        self.controllers[name] = controller_node
        self.node.executor.add_node(controller_node.node)
        try:
            await self._ask(
                lambda: self.manager.load(
                    controller_node.controller,
                    entry.type,
                    entry.fallback_controllers,
                    controller_node.publish_transition,
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
        controller_node = self.controllers.get(name)
        if controller_node is None:
            raise ControllerError(
                f"Could not configure controller with name '{name}' because no controller with "
                'this name exists'
            )
        self.log(Severity.INFO, f"Configuring controller: '{name}'")
        parameters = controller_node.parameters()
        try:
            configuring = await self._ask(lambda: self.manager.begin_configure(name))
            await run_in_thread(
                lambda: configuring.run(parameters), self.node.executor, f'configure {name}'
            )
            await self._ask(lambda: self.manager.finish_configure(configuring))
        except AmrError:
            states = {each.name: each.state for each in self.manager.snapshot.controllers}
            if states.get(name) is LifecycleState.UNCONFIGURED:
                controller_node.disconnect()
            raise
        if self.controllers.get(name) is not controller_node:
            return  # it was unloaded since
        try:
            with argument_errors():
                controller_node.connect()
        except Exception as error:
            await self.cleanup(name)
            raise ControllerError(
                f"Failed to configure controller '{name}': {describe(error)}"
            ) from error

    async def cleanup(self, name: str) -> None:
        """Bring a controller back to unconfigured, without topics. Raises ControllerError."""
        await self._ask(lambda: self.manager.cleanup(name))
        if name in self.controllers:  # and was not unloaded since
            self.controllers[name].disconnect()

    async def unload(self, name: str) -> None:
        """Remove a controller and its node. Raises ControllerError."""
        await self._ask(lambda: self.manager.unload(name))
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
            await self._ask(
                lambda: self.manager.switch(
                    [], active, Strictness.STRICT, self._context.loop_thread.loop.time
                )
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
        defaults = self._parameters.defaults()

        def switch() -> str:
            self.manager.defaults = defaults
            time = self._context.loop_thread.loop.time
            return self.manager.switch(activate, deactivate, strictness, time, timeout)

        try:
            message = await self._ask(switch)
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
        await self._ask(
            lambda: self.manager.set_component_state(
                name, state, self._context.loop_thread.loop.time
            )
        )

    def _ask(self, call: Callable[[], Result]) -> Future:
        """Have the control thread make a call; see :meth:`LoopThread.submit`."""
        return self._context.loop_thread.submit(call, self.node.executor)

    def _make(self, name: str, entry: ControllerEntry) -> ControllerNode:
        """Make a controller and its node. Raises ControllerError, ParameterError, or anything."""
        with self._parameters.explained(name, entry):
            return self._make_of_type(name, entry)

    def _make_of_type(self, name: str, entry: ControllerEntry) -> ControllerNode:
        try:
            controller_class = CONTROLLERS.find(entry.type)
        except ControllerError as error:
            raise ControllerError(
                f"Loader for controller '{name}' (type '{entry.type}') not found. {error}"
            ) from error
        self._modules.add(controller_class.__module__)
        arguments = self._parameters.arguments_of(entry)
        self.log(Severity.INFO, f"Loading controller '{name}'")
        self.log(
            Severity.INFO, f"Controller '{name}' node arguments: --ros-args {' '.join(arguments)} "
        )
        with argument_errors():
            return ControllerNode(
                name,
                controller_class,
                arguments,
                namespace=self.node.get_namespace(),
                update_rate=self._parameters.update_rate,
                robot=self._robot,
                context=self._context,
            )

    def _forget(self, name: str) -> None:
        """Remove the node of a controller that the manager does not know, or no longer."""
        controller_node = self.controllers.pop(name)
        self.node.executor.remove_node(controller_node.node)
        controller_node.destroy()
