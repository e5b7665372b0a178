# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Asks controller managers what they have, and reads what they log."""

import time

from controller_manager_msgs.msg import ControllerState, HardwareComponentState
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllerTypes,
    ListHardwareComponents,
)
from rcl_interfaces.msg import Log
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from amr_description.doctor.observations.controllers import (
    Component,
    ObservedController,
    ObservedControllers,
    ObservedLogLine,
    ObservedManager,
)
from amr_description.doctor.ros.probe_context import ProbeContext
from amr_description.doctor.ros.queries import AllParametersQuery, query
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.doctor.rules.controllers import DRIVE

_LIST = 'controller_manager_msgs/srv/ListControllers'
_MANAGER = 'controller_manager'
_LOG = '/rosout'
_LOG_QOS = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_LEAST = 0.3
"""s that the lines of the log are waited for, of managers with something that is not active."""
_KEPT = 200


class ControllersProbe:
    """Observes ``controllers``."""

    def __init__(self) -> None:
        self._asked: dict[str, _Asked] = {}
        self._lines: dict[tuple[str, str], ObservedLogLine] = {}
        self._spawners: tuple[str, ...] = ()

    def begin(self, context: ProbeContext) -> None:
        """Ask all managers; those that have the name and no services, too."""
        node = context.node
        self._began = time.monotonic()
        nodes = [
            f'{namespace.rstrip("/")}/{name}'
            for name, namespace in node.get_node_names_and_namespaces()
        ]
        served = [
            service.rpartition('/')[0]
            for service, types in node.get_service_names_and_types()
            if _LIST in types and node.count_services(service)
        ]
        named = [each for each in nodes if each.rpartition('/')[2] == _MANAGER]
        self._asked = {name: _Asked(node, name) for name in dict.fromkeys((*served, *named))}
        self._spawners = tuple(
            sorted(n for n in nodes if n.rpartition('/')[2].startswith('spawner_'))
        )
        self._log = TopicProbe(node, Log, _LOG, depth=1, qos=_LOG_QOS) if self._asked else None

    @property
    def is_done(self) -> bool:
        """Whether all have answered; and, where something is amiss, the log has come."""
        self._take()
        if not all(each.has_answered for each in self._asked.values()):
            return False
        return time.monotonic() - self._began >= _LEAST

    def observe(self) -> ObservedControllers:
        """Return what was seen."""
        self._take()
        return ObservedControllers(
            managers=tuple(each.manager() for each in self._asked.values()),
            spawners=self._spawners,
            log=tuple(self._lines.values())[-_KEPT:],
        )

    def _take(self) -> None:
        for line, _, _ in self._log.messages() if self._log is not None else ():
            if line.level >= Log.WARN:
                node = f'/{line.name.replace(".", "/")}'
                is_error = line.level >= Log.ERROR
                self._lines[node, line.msg] = ObservedLogLine(
                    node=node, text=line.msg, is_error=is_error
                )


class _Asked:
    """What is asked of one manager."""

    def __init__(self, node: Node, name: str) -> None:
        self.name = name
        self._node = node
        self._controllers = query(node, ListControllers, f'{name}/list_controllers')
        self._components = query(node, ListHardwareComponents, f'{name}/list_hardware_components')
        self._types = query(node, ListControllerTypes, f'{name}/list_controller_types')
        self._parameters = AllParametersQuery(node, name)
        self._drives: dict[str, AllParametersQuery] = {}

    @property
    def has_answered(self) -> bool:
        """Whether all has come; the parameters of drives are asked for once they are known."""
        controllers = self._controllers.response
        if controllers is None or self._components.response is None:
            return False
        namespace = self.name.rpartition('/')[0]
        for each in controllers.controller:
            if each.type == DRIVE and each.name not in self._drives:
                drive = AllParametersQuery(self._node, f'{namespace}/{each.name}')
                self._drives[each.name] = drive
        values = [each.values for each in self._drives.values()]
        is_known = self._types.response is not None and self._parameters.values is not None
        return is_known and None not in values

    def manager(self) -> ObservedManager:
        """Return what has come."""
        controllers, components = self._controllers.response, self._components.response
        types, values = self._types.response, self._parameters.values or {}
        return ObservedManager(
            name=self.name,
            answers=not self._controllers.is_silent,
            controllers=tuple(
                map(self._controller, controllers.controller if controllers else ())
            ),
            components=tuple(map(_component, components.component if components else ())),
            types=tuple(types.types) if types else (),
            wanted={
                name.removesuffix('.type'): value
                for name, value in values.items()
                if name.endswith('.type') and name.count('.') == 1 and isinstance(value, str)
            },
        )

    def _controller(self, state: ControllerState) -> ObservedController:
        asked = self._drives.get(state.name)
        return ObservedController(
            name=state.name,
            type_name=state.type,
            state=state.state,
            commands=tuple(state.required_command_interfaces),
            is_chained=bool(state.is_chained),
            parameters=(asked.values if asked is not None else None) or {},
        )


def _component(state: HardwareComponentState) -> Component:
    interfaces = (*state.command_interfaces, *state.state_interfaces)
    return Component(
        name=state.name,
        state=state.state.label,
        plugin=state.plugin_name,
        interfaces=tuple(each.name for each in interfaces),
    )
