# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A simulator that stands still but for what it is asked: its services, and commands that are known
to have arrived.

A command is published with the present simulated time as its stamp, and is waited for until the
simulator has confirmed it (:mod:`amr_description.control.ros.loop_publisher`). As time stands still meanwhile,
the next step acts on it, at the same instant with the same bits in every run.

The newest message of a topic, taken when it is asked for.
"""

from collections.abc import Callable, Mapping
import re
from typing import Any

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import KeyValue
from rclpy.client import Client
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from simulation_interfaces.msg import EntityState, Result
from simulation_interfaces.srv import (
    GetEntityState,
    GetSimulationState,
    ResetSimulation,
    StepSimulation,
)

from amr_description.clock import NANOSECONDS
from amr_description.control.ros import loop_publisher
from amr_description.errors import SimulationError
from amr_description.ros.service_calls import ask_until_answered, wait_until
from amr_description.testing.program import SimulatorProcess
from amr_description.testing.readings import nanoseconds

PATIENCE = 30.0
"""s: how long anything is waited for."""
_AGAIN = 0.05
"""s: then a command counts as lost and is published again; twice as long the next time."""
_STRETCH = 1000
"""Physics steps in one request, so that none takes long."""

type Condition = Callable[[], Any]


class LockStep:
    """Asks one simulator, in the thread that calls."""

    def __init__(self, node: Node, program: SimulatorProcess, name: str = '/mujoco_sim') -> None:
        """``node`` is served by its executor here, and by nobody else."""
        self.node = node
        self._program = program
        self._name = name
        self._clients: dict[Any, Client] = {}
        self._publishers: dict[str, Publisher] = {}
        self._counts: dict[str, int] = {}
        self._received: dict[str, int] = {}
        self.time = 0
        """Simulated time, ns."""
        self.timestep = 0
        """A physics step, ns; known after :meth:`measure`."""
        topic = loop_publisher.ACKNOWLEDGEMENT_TOPIC.replace('~', name)
        node.create_subscription(
            KeyValue, topic, self._note_receipt, loop_publisher.ACKNOWLEDGEMENT_QOS
        )

    # --- services -----------------------------------------------------------------------------

    def connect(self) -> None:
        """Wait until the simulator is there and answers. Raises SimulationError."""
        client = self._client(GetSimulationState)
        self.wait(client.service_is_ready, 'the simulator')
        ask_until_answered(self.node, client, GetSimulationState.Request(), timeout=PATIENCE)

    def measure(self, entity: str) -> None:
        """See how long a physics step is, by any entity's stamp; then begin as resets begin."""
        before = nanoseconds(self.state(entity).header.stamp)
        self.step(1)
        self.timestep = nanoseconds(self.state(entity).header.stamp) - before
        self.reset()

    def ask(self, service_type: Any, **fields: Any) -> Any:
        """
        Call a service of the simulator, whose name follows from its type; return the response.

        Raises SimulationError: it refuses, in its words, or it has ended.
        """
        client, name = self._client(service_type), _snake(service_type)
        self.wait(client.service_is_ready, f"the simulator's service {name}")
        future = client.call_async(service_type.Request(**fields))
        self.wait(future.done, f'the answer of {name}')
        response = future.result()
        result = response.result
        if result.result != Result.RESULT_OK:
            raise SimulationError(f'{name}: {result.error_message}')
        return response

    def state(self, entity: str) -> EntityState:
        """Where an entity is at the present instant."""
        return self.ask(GetEntityState, entity=entity).state

    def step(self, count: int) -> None:
        """Let ``count`` physics steps be made; return when they are."""
        while count > 0:
            stretch = min(count, _STRETCH)
            self.ask(StepSimulation, steps=stretch)
            count -= stretch

    def reset(self) -> None:
        """Let time be 0 and all robots where they were spawned; controllers stay as they are."""
        request = ResetSimulation.Request
        self.ask(ResetSimulation, scope=request.SCOPE_TIME | request.SCOPE_STATE)
        self.time = 0

    # --- topics -------------------------------------------------------------------------------

    def send_all(self, messages: Mapping[str, Any]) -> None:
        """
        Publish messages to controllers, by topic, and wait until all have been taken.

        A header without a stamp gets that of the present simulated time. What is lost, as best
        effort allows, is published again. Nobody else may publish there: receipts do not tell
        whose message it was. Raises SimulationError: no controller takes it.
        """
        waiting = {self.node.resolve_topic_name(topic): each for topic, each in messages.items()}
        for topic, message in waiting.items():
            self._prepare(topic, message)

        def has_arrived() -> bool | None:
            # The last one, so that none is on its way still when time goes on, or back.
            for topic in list(waiting):
                if self._received.get(topic, 0) >= self._counts[topic]:
                    del waiting[topic]
            return not waiting or None

        again = _AGAIN
        while again < PATIENCE:
            for topic, message in waiting.items():
                self._counts[topic] += 1
                self._publishers[topic].publish(message)
            if wait_until(self.node, has_arrived, timeout=again):
                return
            self._program.check()
            again *= 2
        topics = ', '.join(f"'{topic}'" for topic in waiting)
        raise SimulationError(
            f'no controller takes what is sent on {topics}; is the one that hears it active?'
        )

    def forget(self, namespace: str) -> None:
        """Remove the publishers on topics in a namespace: whoever heard them is gone."""
        inside = f'/{namespace.strip("/")}/'
        for topic in [each for each in self._publishers if each.startswith(inside)]:
            self.node.destroy_publisher(self._publishers.pop(topic))
            self._received.pop(topic, None)

    def _prepare(self, topic: str, message: Any) -> None:
        """Stamp a message, and wait until somebody hears its topic."""
        publisher = self._publishers.get(topic)
        if publisher is None:
            publisher = self.node.create_publisher(type(message), topic, QoSProfile(depth=10))
            self._publishers[topic] = publisher
            self._counts[topic] = 0
        if hasattr(message, 'header') and message.header.stamp == Time():
            stamp = message.header.stamp
            stamp.sec, stamp.nanosec = divmod(self.time, NANOSECONDS)
        self.wait(
            publisher.get_subscription_count,
            f"a subscriber of '{topic}' ({type(message).__name__})",
        )

    def wait(self, condition: Condition, what: str, timeout: float | None = None) -> Any:
        """
        Serve the node until ``condition()`` holds; return what it returned.

        ``timeout``: s of the wall clock, :data:`PATIENCE` by default. Raises SimulationError.
        """
        timeout = PATIENCE if timeout is None else timeout

        def holds() -> Any:
            self._program.check()
            return condition() or None

        found = wait_until(self.node, holds, timeout=timeout)
        if found is None:
            raise SimulationError(f'waited {timeout:g} s for {what}, in vain')
        return found

    def _note_receipt(self, message: KeyValue) -> None:
        number = int(message.value)
        self._received[message.key] = max(number, self._received.get(message.key, 0))

    def _client(self, service_type: Any) -> Client:
        client = self._clients.get(service_type)
        if client is None:
            name = f'{self._name}/{_snake(service_type)}'
            client = self._clients[service_type] = self.node.create_client(service_type, name)
        return client


def _snake(service_type: Any) -> str:
    return re.sub('(?<!^)(?=[A-Z])', '_', service_type.__name__).lower()


class Latest:
    """
    The newest message on one topic.

    ``node`` must not be in an executor: so what is published at a thousand hertz while a
    simulation runs as fast as it can costs this process nothing.
    """

    def __init__(self, node: Node, message_type: Any, topic: str) -> None:
        self._node = node
        self._subscription = node.create_subscription(
            message_type, topic, self._never_called, QoSProfile(depth=1)
        )
        self._message: Any = None

    @property
    def topic(self) -> str:
        """Its full name."""
        return self._subscription.topic_name

    def take(self) -> Any | None:
        """The newest that has come, since :meth:`forget`; None: nothing yet."""
        subscription = self._subscription
        with subscription.handle:
            while taken := subscription.handle.take_message(subscription.msg_type, False):
                self._message = taken[0]
        return self._message

    def forget(self) -> None:
        """Drop what has come."""
        self.take()
        self._message = None

    def close(self) -> None:
        """Remove the subscription."""
        self._node.destroy_subscription(self._subscription)

    @staticmethod
    def _never_called(_: Any) -> None:
        raise AssertionError('the node is in an executor')
