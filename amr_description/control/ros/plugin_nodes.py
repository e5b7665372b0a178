# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ROS nodes of controllers and hardware components, which know no ROS themselves.

From outside they are just as in ros2_control: parameters, topics, a logger, and for a controller
``~/transition_event``, as a lifecycle node of rclcpp publishes it. The ROS thread makes and
removes everything here; the control thread calls :meth:`LoopTopic.send`, by way of the ports,
and :class:`TransitionEvents`. What a controller subscribes to, a thread of its own takes.
"""

from collections.abc import Awaitable, Callable, Sequence
import re
from typing import Any, TypeVar

from lifecycle_msgs.msg import TransitionEvent
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.task import Future

from amr_description.control.contracts import Controller, Input, Output, Port, Qos
from amr_description.control.interfaces import LifecycleState
from amr_description.control.ros.encoders import encoder_of
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.control.ros.node_parameters import NodeParameters
from amr_description.control.ros.port_servers import (
    GoalServer,
    ServiceServer,
)
from amr_description.controller_manager.made_controllers import make_controller
from amr_description.errors import AmrError
from amr_description.log import Severity
from amr_description.messages.lifecycle import transition_event
from amr_description.messages.readers import reader_of
from amr_description.messages.writers import writer_of
from amr_description.model.robot import Robot
from amr_description.plugin_errors import describe
from amr_description.ros.layouts import serialize
from amr_description.ros.message_types import message_type
from amr_description.ros.parameters import add_parameter_event_qos_overrides
from amr_description.ros.runtime import argument_errors, destroy_node, run_in_thread
from amr_description.ros.subscription_thread import SubscriptionThread

_Result = TypeVar('_Result')


class ComponentNode:
    """The node of a hardware component, named after it: its logger and the usual services."""

    def __init__(
        self, name: str, arguments: Sequence[str], *, namespace: str, context: LoopContext
    ) -> None:
        """
        Make the node.

        Args:
            name: Of the ``<ros2_control>`` block.
            arguments: ROS arguments of the node.
            namespace: Of the controller manager.
            context: Of the process.
        """
        self.node: Node = context.publisher.make_node(node_name(name), namespace, arguments)
        add_parameter_event_qos_overrides(self.node)
        self.log = context.logs.log_of(self.node.get_logger())
        """The component's own."""

    def destroy(self) -> None:
        """Remove the node."""
        destroy_node(self.node)


class ControllerNode:
    """One controller, unconfigured at first, and its node."""

    def __init__(
        self,
        name: str,
        controller_class: type[Controller],
        arguments: Sequence[str],
        *,
        namespace: str,
        update_rate: int,
        robot: Robot | None,
        context: LoopContext,
    ) -> None:
        """
        Make node and controller.

        Args:
            name: Of the controller and its node.
            controller_class: Called with a :class:`ControllerContext`.
            arguments: ROS arguments of the node.
            namespace: Of the controller manager.
            update_rate: Of the controller manager, Hz.
            robot: As its URDF says; handed to the controller.
            context: Of the process.

        Raises:
            ParameterError: A parameter has another type, or is out of its bounds.
            Exception: Whatever the constructor of a third party's controller raises.
        """
        self._publisher = context.publisher
        self._context = context
        self._publishers: list[Publisher] = []
        self._inputs: SubscriptionThread | None = None
        self._ports: list[Input[Any]] = []
        self._servers: list[ServiceServer | GoalServer] = []
        self.node: Node = context.publisher.make_node(name, namespace, arguments)
        try:
            self._table = controller_class.parameters_type
            self._parameters = NodeParameters(self.node)
            self.log = context.logs.log_of(self.node.get_logger())
            self.publish_transition = TransitionEvents(self.node, context.publisher)
            self.controller = make_controller(
                controller_class,
                self._parameters,
                name=name,
                namespace=namespace,
                log=self.log,
                update_rate=update_rate,
                robot=robot,
            )
        except Exception:
            self.destroy()
            raise

    def parameters(self) -> Any:
        """
        Read the node's parameters into the controller's table.

        Those of keyed groups that are new since the last time are declared now. Raises
        ParameterError.
        """
        self._parameters.declare_added(self._table)
        return self._parameters.values(self._table)

    def connect(self) -> None:
        """
        Make the topics, services and actions that the configured controller declares, in place of
        earlier ones.
        """
        self.disconnect()
        with argument_errors():
            self._connect()

    def _connect(self) -> None:
        if inputs := self.controller.inputs():
            self._inputs = SubscriptionThread(self.node, self._context.loop_thread.fail)
            for each in inputs:
                self._subscribe(each, self._inputs)
            self._inputs.start()
        self._publishers += [
            self._advertise(each) for each in self.controller.outputs() if self._is_possible(each)
        ]
        for service in self.controller.services():
            self._servers.append(ServiceServer(self.node, service, self._context))
        for action in self.controller.actions():
            self._servers.append(GoalServer(self.node, action))

    def disconnect(self) -> None:
        """Remove them; the control thread must have cleaned the controller up before."""
        for server in self._servers:
            server.close()
        self._servers.clear()
        if self._inputs is not None:
            self._inputs.end()
            self._inputs = None
        self._publisher.forget(self._ports, self._publishers)
        self._ports.clear()
        for publisher in self._publishers:
            self.node.destroy_publisher(publisher)
        self._publishers.clear()

    def destroy(self) -> None:
        """Remove the node."""
        self.disconnect()
        self._publisher.forget((), tuple(self.node.publishers))
        if self.node.executor is not None:
            self.node.executor.remove_node(self.node)
        destroy_node(self.node)

    # --- ports --------------------------------------------------------------------------------

    def _subscribe(self, port: Input[Any], thread: SubscriptionThread) -> None:
        convert = reader_of(port.port)

        def receive(message: Any, info: Any) -> None:
            try:
                sample = convert(message)
                reason = port.check(sample, self._now()) if port.check else ''
            except Exception as error:  # a third party's converter; the robot must go on
                self.node.get_logger().error(
                    f"Cannot accept a message on '{port.port.name}': {describe(error)}",
                    throttle_duration_sec=1.0,
                )
                return
            if reason:
                self.node.get_logger().error(reason)
            elif port.put(sample, serialize(message) if port.on_drain else b''):
                self._publisher.acknowledge(
                    subscription.topic_name, info['publication_sequence_number']
                )
            else:
                self.node.get_logger().warning(
                    "Can't accept new commands. subscriber is inactive", throttle_duration_sec=1.0
                )

        subscription = thread.subscribe(
            _message_type(port.port), port.port.name, receive, qos(port.port.qos)
        )
        self._ports.append(port)
        self._publisher.input(port, subscription)

    def _now(self) -> int:
        return self.node.get_clock().now().nanoseconds

    def _is_possible(self, output: Output[Any]) -> bool:
        """Return whether an output can be published; one that is optional is warned of if not."""
        try:
            _message_type(output.port)
        except AmrError as error:
            if not output.port.is_optional:
                raise
            self.log(Severity.WARN, f"'{output.port.name}' is not published: {error}")
            return False
        return True

    def _advertise(self, port: Output[Any]) -> Publisher:
        fill = writer_of(port.port)
        message_class = _message_type(port.port)
        publisher = self.node.create_publisher(message_class, port.port.name, qos(port.port.qos))
        sample = None if port.port.convert else port.port.sample
        encode = encoder_of(sample, port.port.message, fill, message_class)
        port.sink = self._publisher.topic(publisher, encode).send
        return publisher


class NodeHost:
    """
    Serves the controllers of a manager by nodes: a
    :class:`~amr_description.controller_manager.requests.Host`.
    """

    def __init__(self, node: Node, context: LoopContext) -> None:
        """
        Serve no controller yet.

        Args:
            node: Of the manager; it must be in an executor, which serves the controllers too.
            context: Of the process.
        """
        self._node = node
        self._context = context

    @property
    def time(self) -> int:
        """Present time, ns; on the control thread."""
        return self._context.loop_thread.loop.time

    def make(
        self,
        name: str,
        controller_class: type[Controller],
        arguments: Sequence[str],
        *,
        update_rate: int,
        robot: Robot | None,
    ) -> ControllerNode:
        """Make a controller and its node, and have it served. Raises ParameterError, or more."""
        with argument_errors():
            made = ControllerNode(
                name,
                controller_class,
                arguments,
                namespace=self._node.get_namespace(),
                update_rate=update_rate,
                robot=robot,
                context=self._context,
            )
        self._node.executor.add_node(made.node)
        return made

    def ask(self, call: Callable[[], _Result]) -> Future:
        """Have the control thread make a call; see :meth:`LoopThread.submit`."""
        return self._context.loop_thread.submit(call, self._node.executor)

    def run_aside(self, call: Callable[[], None], name: str) -> Awaitable[object]:
        """Make a call in a thread of its own."""
        return run_in_thread(call, self._node.executor, name)


class TransitionEvents:
    """
    ``~/transition_event`` of one node; called on the control thread, as the manager's ``Watch``.
    """

    def __init__(self, node: Node, loop_publisher: LoopPublisher) -> None:
        self._clock = node.get_clock()
        self._context = node.context
        self._publisher = loop_publisher.recorded(
            node.create_publisher(TransitionEvent, '~/transition_event', QoSProfile(depth=10))
        )

    def __call__(
        self, start: LifecycleState, goal: LifecycleState, reached: LifecycleState | None
    ) -> None:
        """Publish that a transition has begun, or (``reached``) has ended."""
        event = transition_event(self._clock.now().nanoseconds, start, goal, reached)
        # At once, not at the end of the cycle: the node may be gone by then. Where ROS was shut
        # down first, nothing can be published, and the motors still have to be stopped.
        if self._context.ok():
            self._publisher.publish(event)


def node_name(component: str) -> str:
    """
    Return a component's name as ROS allows it for a node: ``Amr-System 2`` is ``amr_system_2``.
    """
    name = re.sub(r'[^a-z0-9_]', '_', component.lower())
    return f'_{name}' if name[:1].isdigit() else name or '_'


def qos(wanted: Qos) -> QoSProfile:
    """Return rclpy's profile; system defaults are left to the middleware."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST if wanted.depth else HistoryPolicy.SYSTEM_DEFAULT,
        depth=wanted.depth,
        reliability=ReliabilityPolicy[wanted.reliability.upper()],
        durability=DurabilityPolicy[wanted.durability.upper()],
    )


def _message_type(port: Port) -> Any:
    """Return the message class of a port. Raises AmrError."""
    return message_type(port.message, f"The message type of the port '{port.name}'")
