# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller manager as seen by a program that asks it for something, ours or a C++ one."""

from collections.abc import Mapping, Sequence
import time
from typing import Any

from controller_manager_msgs import srv
from lifecycle_msgs.msg import State
from rcl_interfaces.msg import Log
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile

from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError
from amr_description.nodes.clients import ask_until_answered, call, wait_until

_ROSOUT = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class ManagerClient:
    """Calls the services of one controller manager."""

    def __init__(
        self,
        node: Node,
        manager: str,
        *,
        timeout: float = 0.0,
        call_timeout: float = 10.0,
        silent: float = 0.0,
    ) -> None:
        """
        Wait until the manager is there; ``manager``: its node, relative to the namespace.

        ``timeout``: s, 0 for ever. ``silent``: for so long, s, waiting is not worth a line.
        Raises ControllerError when it does not come, NoAnswerError when it does not answer.
        """
        self._node = node
        self._call_timeout = call_timeout
        self._asked = 0.0
        self.name = node.resolve_service_name(manager)
        self.namespace = self.name.rpartition('/')[0] or '/'
        service = f'{self.name}/list_controllers'
        self._list = node.create_client(srv.ListControllers, service)

        def say() -> None:
            node.get_logger().warning(f'Could not contact service {service}')
            node.get_logger().info(f'waiting for service {service} to become available...')

        def ready() -> bool | None:
            return True if self._list.service_is_ready() else None

        found = None
        if silent:
            found = wait_until(node, ready, lambda: None, every=10.0, timeout=silent)
        if not found:
            node.get_logger().info(f'waiting for service {service} to become available...')
            found = wait_until(node, ready, say, every=10.0, timeout=timeout)
        if not found:
            raise ControllerError(
                f'Could not contact service {service} within {timeout:g} s: the controller '
                'manager comes up when a robot with a <ros2_control> block is spawned'
            )
        self.states()

    def states(self) -> dict[str, str]:
        """Name → state of every loaded controller."""
        response = ask_until_answered(
            self._node, self._list, srv.ListControllers.Request(), timeout=self._call_timeout
        )
        return {controller.name: controller.state for controller in response.controller}

    def typed_controllers(self) -> list[str]:
        """Names of the controllers that the manager's parameters hold a type for."""
        listed = self.call(ListParameters, 'list_parameters').result.names
        return sorted(name.removesuffix('.type') for name in listed if name.endswith('.type'))

    def load(self, name: str) -> bool:
        """Load a controller."""
        return self.call(srv.LoadController, 'load_controller', name=name).ok

    def configure(self, name: str) -> bool:
        """Configure a controller."""
        return self.call(srv.ConfigureController, 'configure_controller', name=name).ok

    def unload(self, name: str) -> bool:
        """Unload a controller."""
        return self.call(srv.UnloadController, 'unload_controller', name=name).ok

    def cleanup(self, name: str) -> bool:
        """Bring an inactive controller back to unconfigured."""
        return self.call(srv.CleanupController, 'cleanup_controller', name=name).ok

    def reload_libraries(self, *, force_kill: bool) -> bool:
        """Unload all controllers, and import what they are made of anew."""
        return self.call(
            srv.ReloadControllerLibraries, 'reload_controller_libraries', force_kill=force_kill
        ).ok

    def set_component_state(
        self, name: str, state: State
    ) -> srv.SetHardwareComponentState.Response:
        """Bring a hardware component to a state; the response has the state that it is in."""
        return self.call(
            srv.SetHardwareComponentState,
            'set_hardware_component_state',
            name=name,
            target_state=state,
        )

    def switch(
        self,
        *,
        activate: Sequence[str] = (),
        deactivate: Sequence[str] = (),
        timeout: float = 5.0,
        activate_asap: bool = True,
    ) -> str | None:
        """Switch under STRICT; return ``None``, or why it failed."""
        response = self.request_switch(
            activate, deactivate, Strictness.STRICT, timeout=timeout, activate_asap=activate_asap
        )
        return None if response.ok else response.message

    def request_switch(
        self,
        activate: Sequence[str],
        deactivate: Sequence[str],
        strictness: int,
        *,
        timeout: float = 5.0,
        activate_asap: bool = True,
    ) -> srv.SwitchController.Response:
        """Switch; ``strictness``: as in the request, 0 for the manager's default."""
        return self.call(
            srv.SwitchController,
            'switch_controller',
            activate_controllers=list(activate),
            deactivate_controllers=list(deactivate),
            strictness=int(strictness),
            activate_asap=activate_asap,
            timeout=Duration(seconds=timeout).to_msg(),
        )

    def set_parameters(self, controller: str, parameters: Mapping[str, str | list[str]]) -> None:
        """Set ``<controller>.<key>`` at the manager. Raises ControllerError."""
        if not parameters:
            return
        rows = [Parameter(f'{controller}.{k}', value=v) for k, v in parameters.items()]
        response = self.call(
            SetParameters, 'set_parameters', parameters=[row.to_parameter_msg() for row in rows]
        )
        for row, result in zip(rows, response.results, strict=True):
            if not result.successful:
                raise ControllerError(f"{self.name} refuses '{row.name}': {result.reason}")

    def reasons(self, controller: str) -> str:
        """
        Say why the last load failed; the services only say that it did.

        A missing type is found by asking; the rest is :meth:`logged`.
        """
        asked = self._asked
        return self._missing_type(controller) or self.logged(controller, since=asked)

    def logged(self, *nodes: str, since: float | None = None) -> str:
        """
        Return what the manager, and nodes beside it, have logged as errors; empty: nothing.

        Taken from the latched ``/rosout``. ``since``: s, Unix time; None: the last request.
        """
        since = self._asked if since is None else since
        inside = self.namespace.rstrip('/')
        names = {self.name, *(f'{inside}/{node}' for node in nodes)}
        loggers = {name.strip('/').replace('/', '.') for name in names}
        lines: list[str] = []

        def hear(message: Log) -> None:
            stamp = message.stamp.sec + message.stamp.nanosec * 1e-9
            if message.level >= Log.ERROR and message.name in loggers and stamp >= since:
                lines.append(message.msg)

        subscription = self._node.create_subscription(Log, '/rosout', hear, _ROSOUT)
        wait_until(self._node, lambda: lines or None, lambda: None, every=1.0, timeout=1.0)
        self._node.destroy_subscription(subscription)
        return '; '.join(dict.fromkeys(lines))

    def _missing_type(self, controller: str) -> str:
        """Say which controllers have a type, if this one has none."""
        response = self.call(GetParameters, 'get_parameters', names=[f'{controller}.type'])
        if response.values and response.values[0].string_value:
            return ''
        typed = self.typed_controllers()
        return (
            f"no type is set for it; the parameters of {self.name} hold one for: "
            f'{", ".join(typed) or "none"}; a parameter file given here may name another'
        )

    def call(self, service_type: Any, service: str, **fields: Any) -> Any:
        """Call a service, by its name below that of the manager; return the response."""
        request = service_type.Request(**fields)
        self._asked = time.time()
        return call(
            self._node,
            service_type,
            f'{self.name}/{service}',
            request,
            timeout=self._call_timeout,
        )

