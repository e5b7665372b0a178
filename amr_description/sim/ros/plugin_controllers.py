# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Starts the controllers that stand for Gazebo's plugins, as soon as their robot is spawned.

Gazebo's plugins work from the first moment on, without a spawner; so do these. For
``ros2 control`` they are controllers as all others: they can be listed, switched off and unloaded.
"""

from collections.abc import Coroutine, Sequence
import json
from typing import Any

from rclpy.executors import Executor
from rclpy.parameter import Parameter
from rclpy.task import Future

from amr_description.control.contracts import Log, Severity
from amr_description.control.ros.controller_manager_node import RunningManager
from amr_description.control.switching import Strictness
from amr_description.errors import AmrError
from amr_description.model.gazebo_builder import GazeboTranslation, PluginController
from amr_description.model.sensors import frame_in
from amr_description.text import quote

_SWITCH_TIMEOUT = 5_000_000_000
"""ns."""


async def start_controllers(
    running: RunningManager, controllers: Sequence[PluginController], log: Log
) -> None:
    """
    Load, configure and activate controllers, in this order, on the thread of their manager.

    One that cannot be started is logged; the robot and the others work without it, as in Gazebo.
    """
    requests, node = running.requests, running.node
    for each in controllers:
        node.set_parameters(
            [
                Parameter(f'{each.name}.type', value=each.type),
                Parameter(
                    f'{each.name}.node_options_args',
                    value=node_arguments(each, node.get_namespace(), requests.manager.update_rate),
                ),
            ]
        )
        try:
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


def run_in(executor: Executor, work: Coroutine[Any, Any, None], waiting: Executor) -> Future:
    """
    Run a coroutine in one executor; return what a coroutine of another one can await.

    Args:
        executor: Of the node that the coroutine is about; its thread runs.
        work: The coroutine.
        waiting: The executor of the one that awaits.
    """
    done = Future(executor=waiting)

    async def run() -> None:
        try:
            await work
        except Exception as error:  # raised again where the future is awaited
            done.set_exception(error)
        finally:  # it may be closed, as its robot is removed
            if not done.done():
                done.set_result(None)
            waiting.wake()  # a task that awaits is looked at only when the executor wakes

    executor.create_task(run())
    return done


def abandon(done: Future, waiting: Executor) -> None:
    """
    End the wait for what :func:`run_in` was to run, where its executor runs no more.

    Args:
        done: What :func:`run_in` has returned; it may be done.
        waiting: The executor of the one that awaits it.
    """
    if not done.done():
        done.set_result(None)
        waiting.wake()
