# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A client of a paused simulator: its services, commands that are known to have arrived, and the
newest message of a topic.

A command is published with the present simulated time as its stamp. The client then waits until
the simulator has acknowledged it (:mod:`amr_description.control.ros.loop_publisher`). No time
passes meanwhile, so the next step acts on the command: at the same instant and with the same bits
in every run.
"""

from collections.abc import Callable, Mapping
import copy
from typing import Any, TypeAlias

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import KeyValue
from rcl_interfaces.srv import SetParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message
from simulation_interfaces.msg import EntityState, Result
from simulation_interfaces.srv import (
    GetEntityState,
    GetSimulationState,
    ResetSimulation,
    StepSimulation,
)
from std_srvs.srv import Trigger

from amr_description.control.ros import loop_publisher
from amr_description.errors import SimulationError
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.message_fields import set_fields
from amr_description.ros.message_types import message_type
from amr_description.ros.messages import fill_stamp, nanoseconds
from amr_description.ros.polled_topic import PolledTopic
from amr_description.ros.service_calls import (
    ask_until_answered,
    name_of_type,
    ServiceReadiness,
    wait_until,
)
from amr_description.simulation.tracebacks import is_for_the_test, without_frames
from amr_description.testing.program import SimulatorProcess

__tracebackhide__ = is_for_the_test

TIMEOUT = 30.0
"""s of the wall clock, for every wait."""
_RETRY_DELAY = 0.05
"""s until a command counts as lost and is published again; doubled after each attempt."""
_MAX_STEPS = 1000
"""Physics steps in one request, so that none takes long."""

_GUID_PREFIX = 12
"""Bytes of an endpoint's GUID that are its participant's (DDSI-RTPS 2.5, 9.3.1)."""

Condition: TypeAlias = Callable[[], Any]


class LockStep:
    """The client of one simulator; not thread-safe."""

    def __init__(self, node: Node, process: SimulatorProcess, name: str = '/mujoco_sim') -> None:
        """
        Subscribe to the acknowledgements; :meth:`connect` waits for the simulator.

        Args:
            node: Its executor is spun here and nowhere else.
            process: The simulator, checked while waiting.
            name: The simulator's node.
        """
        self.node = node
        self._process = process
        self._name = name
        self._clients: dict[Any, Client] = {}
        self._publishers: dict[str, Publisher] = {}
        self._published: dict[str, int] = {}
        self._acknowledged: dict[str, int] = {}
        self._checked: dict[str, int] = {}
        self.time = 0
        """Simulated time, ns."""
        self.timestep = 0
        """A physics step, ns; set by :meth:`measure_timestep`."""
        self._acknowledgements = loop_publisher.ACKNOWLEDGEMENT_TOPIC.replace('~', name)
        node.create_subscription(
            KeyValue,
            self._acknowledgements,
            self._on_acknowledgement,
            loop_publisher.ACKNOWLEDGEMENT_QOS,
        )

    # --- services -----------------------------------------------------------------------------

    def connect(self) -> None:
        """Wait until the simulator responds. Raises SimulationError."""
        client = self._client(GetSimulationState)
        self.wait(ServiceReadiness(self.node, client), 'the simulator')
        ask_until_answered(self.node, client, GetSimulationState.Request(), timeout=TIMEOUT)

    def measure_timestep(self, entity: str) -> None:
        """Measure the physics step, by the stamps of an entity; then reset."""
        before = nanoseconds(self.state(entity).header.stamp)
        self.step(1)
        self.timestep = nanoseconds(self.state(entity).header.stamp) - before
        self.reset()

    def ask(self, service_type: Any, *, timeout: float = TIMEOUT, **fields: Any) -> Any:
        """
        Call a service of the simulator and return the response.

        Args:
            service_type: Type of the service; its name follows from that.
            timeout: s of the wall clock, for the answer.
            **fields: Of the request.

        Raises:
            SimulationError: The simulator reports an error, has ended, or is not the only one.
        """
        if self.node.count_publishers(self._acknowledgements) > 1:
            raise SimulationError(f'a second simulator {self._name} {self._intruder()}')
        name = name_of_type(service_type)
        response = self._call(service_type, name, service_type.Request(**fields), timeout)
        result = response.result
        if result.result != Result.RESULT_OK:
            raise SimulationError(f'{name}: {result.error_message}')
        return response

    def set_parameter(self, name: str, value: Any) -> None:
        """Set a parameter of the simulator. Raises SimulationError: it is refused."""
        request = SetParameters.Request(
            parameters=[Parameter(name, value=value).to_parameter_msg()]
        )
        (result,) = self._call(SetParameters, 'set_parameters', request).results
        if not result.successful:
            raise SimulationError(result.reason)

    def measure(self) -> list[str]:
        """Have all sensors with subscribers measure now; return their topics."""
        response = self._call(Trigger, 'measure', Trigger.Request())
        if not response.success:
            raise SimulationError(f'measure: {response.message}')
        return response.message.split()

    def state(self, entity: str) -> EntityState:
        """Return the present state of an entity."""
        return self.ask(GetEntityState, entity=entity).state

    def step(self, count: int) -> None:
        """Make ``count`` physics steps."""
        while count > 0:
            steps = min(count, _MAX_STEPS)
            self.ask(StepSimulation, steps=steps)
            count -= steps

    def reset(self) -> None:
        """Reset time and robots; the controllers stay as they are."""
        request = ResetSimulation.Request
        self.ask(ResetSimulation, scope=request.SCOPE_TIME | request.SCOPE_STATE)
        self.time = 0

    # --- topics -------------------------------------------------------------------------------

    def send_all(self, messages: Mapping[str, Any], *, as_they_are: bool = False) -> None:
        """
        Publish messages to controllers and wait until all are acknowledged.

        A header without a stamp gets the present simulated time, in a copy: the message may be
        sent again, later. A message that is lost, as best effort allows, is published again.
        Nobody else may publish on these topics: acknowledgements do not name the publisher.

        Args:
            messages: Topic → message, or a dict in the form of the message.
            as_they_are: Whether a header without a stamp stays so.

        Raises:
            SimulationError: No controller accepts a message, or a second robot subscribes to it.
        """
        waiting = {self.node.resolve_topic_name(topic): each for topic, each in messages.items()}
        waiting = {
            topic: self._message(topic, each) if isinstance(each, Mapping) else each
            for topic, each in waiting.items()
        }
        waiting = {
            topic: self._prepared(topic, message, as_they_are)
            for topic, message in waiting.items()
        }

        def has_arrived() -> bool | None:
            # Wait for the last one: none may arrive after time has gone on, or back.
            for topic in list(waiting):
                if self._acknowledged.get(topic, 0) >= self._published[topic]:
                    del waiting[topic]
            return not waiting or None

        delay = _RETRY_DELAY
        while delay < TIMEOUT:
            for topic, message in waiting.items():
                self._published[topic] += 1
                self._publishers[topic].publish(message)
            if wait_until(self.node, has_arrived, timeout=delay):
                return
            self._process.check()
            delay *= 2
        topics = ', '.join(f"'{topic}'" for topic in waiting)
        raise SimulationError(
            f'no controller takes what is sent on {topics}; is its controller active?'
        )

    def _message(self, topic: str, fields: Mapping[str, Any]) -> Any:
        """Return a message of the type of a topic, of a dict in its form. Raises AmrError."""

        def types() -> list[str]:
            return [each.topic_type for each in self.node.get_subscriptions_info_by_topic(topic)]

        message = message_type(self.wait(types, f"a subscriber of '{topic}'")[0])()
        set_fields(message, dict(fields))
        return message

    def forget(self, namespace: str) -> None:
        """Remove the publishers on topics in a namespace, whose subscribers are gone."""
        inside = f'/{namespace.strip("/")}/'
        for topic in [each for each in self._publishers if each.startswith(inside)]:
            self.node.destroy_publisher(self._publishers.pop(topic))
            self._acknowledged.pop(topic, None)
            self._checked.pop(topic, None)

    def _prepared(self, topic: str, message: Any, as_it_is: bool) -> Any:
        """Return a message with its stamp, once its topic has a subscriber."""
        publisher = self._publishers.get(topic)
        if publisher is None:
            publisher = self.node.create_publisher(type(message), topic, QoSProfile(depth=10))
            self._publishers[topic] = publisher
            self._published[topic] = 0
        if not as_it_is and hasattr(message, 'header') and message.header.stamp == Time():
            message = copy.deepcopy(message)
            fill_stamp(self.time, message.header.stamp)
        self.wait(
            publisher.get_subscription_count,
            f"a subscriber of '{topic}' ({type(message).__name__})",
        )
        self._require_one_robot(topic)
        return message

    def _require_one_robot(self, topic: str) -> None:
        """
        Raise SimulationError if two participants have a controller of one name on a topic.

        Looked at again only when the number of subscriptions has changed: that of the graph, which
        knows a subscription before the publisher sends to it.
        """
        count = self.node.count_subscribers(topic)
        if self._checked.get(topic) == count:
            return
        found: dict[str, bytes] = {}
        for each in self.node.get_subscriptions_info_by_topic(topic):
            name, participant = endpoint_node(each), bytes(each.endpoint_gid[:_GUID_PREFIX])
            if name is None:  # not yet discovered
                return
            if found.setdefault(name, participant) != participant:
                raise SimulationError(f'a second controller {name} {self._intruder()}')
        self._checked[topic] = count

    def _intruder(self) -> str:
        domain = self.node.context.get_domain_id()
        return (
            f'has come into ROS domain {domain}, which is that of this test; give that another '
            'ROS_DOMAIN_ID, and run the test again'
        )

    @without_frames
    def wait(self, condition: Condition, what: str, timeout: float | None = None) -> Any:
        """
        Spin the node until a condition holds; return what it returned.

        Args:
            condition: Called repeatedly; holds when its result is true.
            what: What is waited for, for the error.
            timeout: s of the wall clock, :data:`TIMEOUT` by default.

        Raises:
            SimulationError: It does not hold in time, or the simulator has ended.
        """
        timeout = TIMEOUT if timeout is None else timeout

        def holds() -> Any:
            self._process.check()
            return condition() or None

        found = wait_until(self.node, holds, timeout=timeout)
        if found is None:
            raise SimulationError(f'waited {timeout:g} s for {what}, in vain')
        return found

    def _on_acknowledgement(self, message: KeyValue) -> None:
        number = int(message.value)
        if number > self._published.get(message.key, 0):
            return  # of another publisher: a later one of ours is not to count as acknowledged
        self._acknowledged[message.key] = max(number, self._acknowledged.get(message.key, 0))

    def _call(self, service_type: Any, name: str, request: Any, timeout: float = TIMEOUT) -> Any:
        client = self._client(service_type, name)
        self.wait(ServiceReadiness(self.node, client), f"the simulator's service {name}")
        future = client.call_async(request)
        self.wait(future.done, f'the answer of {name}', timeout)
        return future.result()

    def _client(self, service_type: Any, name: str = '') -> Client:
        client = self._clients.get(service_type)
        if client is None:
            name = f'{self._name}/{name or name_of_type(service_type)}'
            client = self._clients[service_type] = self.node.create_client(service_type, name)
        return client


class LatestMessage:
    """
    The newest message of a topic, which no executor takes.

    What is published at a thousand hertz while a simulation runs as fast as it can costs this
    process nothing until it is taken.
    """

    def __init__(self, node: Node, message_type: type, topic: str) -> None:
        def read(data: bytes) -> Any:
            return deserialize_message(data, message_type)

        self._topic = PolledTopic(node, message_type, topic, read, qos=QoSProfile(depth=1))
        self._message: Any = None

    @property
    def topic(self) -> str:
        """Its name."""
        return self._topic.topic

    def take(self) -> Any | None:
        """Return the newest message since :meth:`forget`; None: there is none."""
        while (message := self._topic.take()) is not None:
            self._message = message
        return self._message

    def forget(self) -> None:
        """Drop the messages so far."""
        self.take()
        self._message = None

    def close(self) -> None:
        """Remove the subscription."""
        self._topic.destroy()
