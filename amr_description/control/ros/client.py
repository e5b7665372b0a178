# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A client of the services of a controller manager, be it ours or that of ros2_control."""

from collections.abc import Iterable, Mapping, Sequence
import time
from typing import Any

from controller_manager_msgs import srv
from controller_manager_msgs.msg import ControllerState, HardwareComponentState
from lifecycle_msgs.msg import State
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters
from rclpy.client import Client
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.control.ros.absence_diagnosis import errors_of, ManagerProbe
from amr_description.controller_manager.spawner import reason_of
from amr_description.errors import ControllerError, NoAnswerError
from amr_description.ros.qos import SERVICE_CLIENT
from amr_description.ros.runtime import argument_errors
from amr_description.ros.service_calls import (
    ask_until_answered,
    call_with,
    name_of_type,
    ServiceReadiness,
    wait_until,
)

SPAWNER_SERVICES = (
    SetParameters,
    srv.LoadController,
    srv.ConfigureController,
    srv.SwitchController,
)
"""The types of the services that a spawner calls to activate a controller."""
_LOG_PERIOD = 10.0
"""s: how often it is logged that the manager is still not there."""
_ATTEMPTS = 3
_MAX_DURATION = 2.0**31 - 1.0
"""s: the longest that a builtin_interfaces/Duration can hold."""


class ManagerClient:
    """Calls the services of one controller manager, each by a client kept until :meth:`close`."""

    def __init__(
        self,
        node: Node,
        manager: str,
        *,
        timeout: float = 0.0,
        call_timeout: float = 10.0,
        silent: float = 0.0,
        first: Any = None,
        soon: Iterable[Any] = (),
    ) -> None:
        """
        Wait until the manager is there and answers.

        Args:
            node: Makes the clients, and is spun here.
            manager: The manager's node, relative to the namespace of ``node``.
            timeout: s, for the manager to come; 0: without end.
            call_timeout: s, for each of three waits for a response.
            silent: s, how long it is waited without a line of log.
            first: The type of the service that is waited for, whose request has no fields;
                default: ListControllers.
            soon: The types of services that will be called. Their clients are made before that of
                ``first``: when that one is answered, the manager knows them too. For another one
                it has to be asked again, before its first call.

        Raises:
            ControllerError: The manager does not come; it says what is missing.
            NoAnswerError: It does not answer.
            ParameterError: ``manager`` is not a valid name.
        """
        self._node = node
        self._call_timeout = call_timeout
        self._call_time = 0.0
        with argument_errors():
            self.name = node.resolve_service_name(manager)
        self.namespace = self.name.rpartition('/')[0] or '/'
        self._probe = ManagerProbe(node, self.name)
        self._clients: dict[Any, Client] = {}
        self._known: set[Any] = set()
        self._first = first or srv.ListControllers
        for service_type in soon:
            self._client(service_type)
        client = self._client(self._first)
        self._wait_for(client, timeout, silent)
        self._query(client)
        self._known.update(self._clients)

    def close(self) -> None:
        """Remove the clients, for a node that lives longer: the graph shows their services."""
        for client in self._clients.values():
            self._node.destroy_client(client)
        self._clients.clear()
        self._known.clear()

    def is_there(self) -> bool:
        """Return whether it is still there."""
        return self._node.count_services(self._service(srv.ListControllers)) > 0

    def query(self, service_type: Any, **fields: Any) -> Any:
        """
        Return the response of a service that changes nothing; its name follows from its type.

        ``fields``: of the request. Raises NoAnswerError.
        """
        return self._query(self._client(service_type), **fields)

    def states(self) -> dict[str, str]:
        """Return the states of all loaded controllers, by their names."""
        return {name: each.state for name, each in self.controllers().items()}

    def controllers(self) -> dict[str, ControllerState]:
        """Return all loaded controllers, by their names."""
        return {each.name: each for each in self.query(srv.ListControllers).controller}

    def components(self) -> list[HardwareComponentState]:
        """Return the hardware components."""
        return self.query(srv.ListHardwareComponents).component

    def typed_controllers(self) -> list[str]:
        """Return the names of the controllers that the manager's parameters hold a type for."""
        listed = self.query(ListParameters).result.names
        return sorted(name.removesuffix('.type') for name in listed if name.endswith('.type'))

    def has_type(self, controller: str) -> bool:
        """Return whether the manager's parameters hold a type for a controller."""
        return bool(self.type_of(controller))

    def type_of(self, controller: str) -> str:
        """Return the type that the manager's parameters hold for a controller; '': none."""
        values = self.query(GetParameters, names=[f'{controller}.type']).values
        return values[0].string_value if values else ''

    def load(self, name: str) -> bool:
        """Load a controller."""
        return self._call(srv.LoadController, name=name).ok

    def configure(self, name: str) -> bool:
        """Configure a controller."""
        return self._call(srv.ConfigureController, name=name).ok

    def unload(self, name: str) -> bool:
        """Unload a controller."""
        return self._call(srv.UnloadController, name=name).ok

    def cleanup(self, name: str) -> bool:
        """Bring an inactive controller back to unconfigured."""
        return self._call(srv.CleanupController, name=name).ok

    def reload_libraries(self, *, force_kill: bool) -> bool:
        """Unload all controllers, and import their modules anew."""
        return self._call(srv.ReloadControllerLibraries, force_kill=force_kill).ok

    def set_component_state(
        self, name: str, state: State
    ) -> srv.SetHardwareComponentState.Response:
        """Bring a hardware component to a state; the response has the state that it is in."""
        return self._call(srv.SetHardwareComponentState, name=name, target_state=state)

    def switch(
        self,
        *,
        activate: Sequence[str] = (),
        deactivate: Sequence[str] = (),
        timeout: float = 5.0,
        activate_asap: bool = True,
    ) -> str | None:
        """Switch with strictness STRICT; return ``None``, or why it failed."""
        response = self.request_switch(
            activate,
            deactivate,
            srv.SwitchController.Request.STRICT,
            timeout=timeout,
            activate_asap=activate_asap,
        )
        if response.ok:
            return None
        fault = self._probe.explain_clock() if 'timed out' in response.message else ''
        return '; '.join(filter(None, (response.message, fault)))

    def request_switch(
        self,
        activate: Sequence[str],
        deactivate: Sequence[str],
        strictness: int,
        *,
        timeout: float = 5.0,
        activate_asap: bool = True,
    ) -> srv.SwitchController.Response:
        """
        Switch controllers.

        Args:
            activate: Their names.
            deactivate: Their names.
            strictness: As in the request; 0: the manager's default.
            timeout: s, how long the manager may take; its response is awaited at least as long.
            activate_asap: As in the request.
        """
        return self._call(
            srv.SwitchController,
            max(timeout, self._call_timeout),
            activate_controllers=list(activate),
            deactivate_controllers=list(deactivate),
            strictness=strictness,
            activate_asap=activate_asap,
            timeout=Duration(seconds=min(timeout, _MAX_DURATION)).to_msg(),
        )

    def set_parameters(self, controller: str, parameters: Mapping[str, str | list[str]]) -> None:
        """Set ``<controller>.<key>`` at the manager. Raises ControllerError."""
        if not parameters:
            return
        rows = [Parameter(f'{controller}.{key}', value=v) for key, v in parameters.items()]
        messages = [row.to_parameter_msg() for row in rows]
        response = self._call(SetParameters, parameters=messages)
        for (key, value), result in zip(parameters.items(), response.results, strict=True):
            if not result.successful:
                raise ControllerError(
                    f'Could not set controller param "{key}" to "{value}" for {controller}: '
                    f'{self.name} refuses it: {result.reason}'
                )

    def reasons(self, controller: str) -> str:
        """
        Return why the last load failed; the response only says that it did.

        A missing type is found by its parameters; for the rest see :meth:`logged`.
        """
        since = self._call_time
        if self.has_type(controller):
            return self.logged(controller, since=since)
        cause = self.logged(controller, since=since)
        return reason_of(self, controller, cause, self.typed_controllers())

    def logged(self, *nodes: str, since: float | None = None) -> str:
        """
        Return what the manager, and nodes beside it, have logged as errors; empty: nothing.

        ``since``: s, Unix time; None: the last request that was to change something.
        """
        inside = self.namespace.rstrip('/')
        names = [self.name, *(f'{inside}/{node}' for node in nodes)]
        return '; '.join(errors_of(self._node, names, self._call_time if since is None else since))

    def _wait_for(self, client: Client, timeout: float, silent: float) -> None:
        """Wait until the service is there, and log what is missing. Raises ControllerError."""
        service, log = client.srv_name, self._node.get_logger()

        is_ready = ServiceReadiness(self._node, client)

        def ready() -> bool | None:
            return is_ready() or None

        def log_absence() -> None:
            log.warning(f'Could not contact service {service}: {self._probe.explain()}')
            log.info(f'waiting for service {service} to become available...')

        if silent and wait_until(self._node, ready, timeout=silent):
            return
        log.info(f'waiting for service {service} to become available...')
        if not wait_until(self._node, ready, log_absence, every=_LOG_PERIOD, timeout=timeout):
            fault = self._probe.explain()
            if not ready():
                raise ControllerError(
                    f'Could not contact service {service} within {timeout:g} s: {fault}'
                )

    def _query(self, client: Client, **fields: Any) -> Any:
        request = client.srv_type.Request(**fields)
        try:
            return ask_until_answered(
                self._node, client, request, timeout=self._call_timeout, attempts=_ATTEMPTS
            )
        except NoAnswerError as error:
            raise self._explained(error) from error

    def _call(self, service_type: Any, timeout: float | None = None, /, **fields: Any) -> Any:
        """Call a service that changes something, once; return the response."""
        client = self._known_client(service_type)
        self._call_time = time.time()
        try:
            return call_with(
                self._node,
                client,
                service_type.Request(**fields),
                timeout=self._call_timeout if timeout is None else timeout,
                attempts=_ATTEMPTS,
            )
        except NoAnswerError as error:
            raise self._explained(error) from error

    def _known_client(self, service_type: Any) -> Client:
        """
        Return a client whose first request may be sent only once: the manager knows it.

        That throws away the response to a client that discovery has not told it of, as where a
        packet was lost, which takes 3 s to come again. It hears of the clients of a participant in
        the order in which they were made: where it answers a later one, it knows this one.
        """
        client = self._client(service_type)
        if service_type not in self._known:
            later = self._make_client(self._first)
            try:
                self._query(later)
            finally:
                self._node.destroy_client(later)
            self._known.update(self._clients)
        return client

    def _client(self, service_type: Any) -> Client:
        if service_type not in self._clients:
            self._clients[service_type] = self._make_client(service_type)
        return self._clients[service_type]

    def _make_client(self, service_type: Any) -> Client:
        service = self._service(service_type)
        return self._node.create_client(service_type, service, qos_profile=SERVICE_CLIENT)

    def _service(self, service_type: Any) -> str:
        return f'{self.name}/{name_of_type(service_type)}'

    def _explained(self, error: NoAnswerError) -> NoAnswerError:
        if not self.is_there():
            return error
        fault = self._probe.explain_clock() or f'{self.name} may be stopped, or busy: see its log'
        return NoAnswerError(f'{error} {fault}')
