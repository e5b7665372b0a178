# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Starts the controllers that stand for Gazebo's plugins, as soon as their robot is spawned.

Gazebo's plugins work from the first moment on, without a spawner; so do these. For
``ros2 control`` they are controllers as all others: they can be listed, switched off and unloaded.
"""

from collections.abc import Sequence
import json

from amr_description.control.switching import Strictness
from amr_description.controller_manager.requests import ManagerRequests
from amr_description.errors import AmrError
from amr_description.log import Log, Severity
from amr_description.model.gazebo.builder import GazeboTranslation, PluginController
from amr_description.model.sensors import frame_in
from amr_description.text import quote

_SWITCH_TIMEOUT = 5_000_000_000
"""ns."""


async def start_controllers(
    requests: ManagerRequests, controllers: Sequence[PluginController], namespace: str, log: Log
) -> None:
    """
    Load, configure and activate controllers, in this order, on the thread of their manager.

    One that cannot be started is logged; the robot and the others work without it, as in Gazebo.

    Args:
        requests: Of the manager.
        controllers: To be started.
        namespace: Of the manager.
        log: Of the simulator.
    """
    store = requests.parameters.store
    for each in controllers:
        arguments = node_arguments(each, namespace, requests.manager.update_rate)
        try:
            store.set(f'{each.name}.type', each.type)
            store.set(f'{each.name}.node_options_args', arguments)
            await requests.load(each.name)
            await requests.configure(each.name)
            await requests.switch([each.name], [], Strictness.STRICT, _SWITCH_TIMEOUT)
        except AmrError as error:
            log(Severity.ERROR, f'{each.origin}: its controller cannot be started: {error}')


def node_arguments(controller: PluginController, namespace: str, update_rate: int) -> list[str]:
    """
    Return the ROS arguments of a controller's node: its parameters and its topics.

    Args:
        controller: Its parameters and topics.
        namespace: Of its node.
        update_rate: Of the manager, Hz; no controller can be faster.
    """
    arguments = []
    for name, value in controller.parameters.items():
        given = min(value, update_rate) if name == 'update_rate' else value
        if name in controller.frames:
            given = frame_in(namespace, value)
        arguments += ['-p', f'{name}:={json.dumps(given)}']
    for before, after in controller.names_of_topics(namespace).items():
        if before != after:
            arguments += ['-r', f'{before}:={after}']
    return arguments


def log_translation(robot: str, translation: GazeboTranslation, namespace: str, log: Log) -> None:
    """Log what was made of plugins and sensors: a line each, and one of what is not simulated."""
    for each in translation.controllers:
        controller = f'{each.name} ({each.type})'
        topics = ', '.join(each.topics_in_use(namespace))
        log(
            Severity.INFO,
            f"'{robot}': for {each.origin} runs the controller {controller}: {topics}",
        )
    for sensor in translation.sensors:
        topics = ', '.join(sensor.mount.full_name(each, namespace) for each, _ in sensor.topics)
        log(Severity.INFO, f"'{robot}': sensor {quote(sensor.mount.name)}: {topics}")
    for remark in translation.remarks:
        log(Severity.INFO, f"'{robot}': {remark}")
    for note in translation.notes:
        log(Severity.WARN, f"'{robot}': {note}")
    if translation.not_simulated:
        log(Severity.WARN, f"'{robot}': {translation.not_simulated}")
