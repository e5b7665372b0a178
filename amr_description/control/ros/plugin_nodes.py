# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ROS nodes of controllers and hardware components, which know no ROS themselves.

From outside they are just as in ros2_control: parameters, topics, a logger, and for a controller
``~/transition_event``, as a lifecycle node of rclcpp publishes it. The ROS thread makes and
removes everything here; the control thread calls :meth:`LoopTopic.send`, by way of the ports,
and :class:`TransitionEvents`. What a controller subscribes to, a thread of its own takes.
"""

from collections.abc import Sequence
import re
from typing import Any

from lifecycle_msgs.msg import State, Transition, TransitionEvent
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from amr_description.control.contracts import (
    Controller,
    ControllerContext,
    Input,
    Output,
    Port,
    Qos,
    Severity,
)
from amr_description.control.interfaces import LifecycleState
from amr_description.control.manager_parameters import CommonParameters
from amr_description.control.plugin_errors import describe
from amr_description.control.ros.encoders import encoder_of
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.control.ros.port_servers import (
    GoalServer,
    reader_of,
    ServiceServer,
    writer_of,
)
from amr_description.errors import AmrError
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.ros.callback_thread import CallbackThread
from amr_description.ros.cdr_padding import serialize
from amr_description.ros.message_types import message_type
from amr_description.ros.parameters import (
    add_parameter_event_qos_overrides,
    add_validation_callback,
    adopt_overrides,
    declare,
    declare_added,
    values,
)
from amr_description.ros.runtime import destroy_node


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
        self._inputs: CallbackThread | None = None
        self._ports: list[Input[Any]] = []
        self._servers: list[ServiceServer | GoalServer] = []
        self.node: Node = context.publisher.make_node(name, namespace, arguments)
        try:
            self._table = controller_class.parameters_type
            self.log = context.logs.log_of(self.node.get_logger())
            self.publish_transition = TransitionEvents(self.node, context.publisher)
            common = self._declare(update_rate, *_names_of(robot))
            self.controller = controller_class(
                ControllerContext(
                    name=name,
                    log=self.log,
                    namespace=namespace,
                    update_rate=common.update_rate or update_rate,
                    robot=robot,
                )
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
        declare_added(self.node, self._table)
        return values(self.node, self._table)

    def connect(self) -> None:
        """
        Make the topics, services and actions that the configured controller declares, in place of
        earlier ones.
        """
        self.disconnect()
        if inputs := self.controller.inputs():
            self._inputs = CallbackThread(self.node, self._context.loop_thread.fail)
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
        destroy_node(self.node)

    # --- parameters ---------------------------------------------------------------------------

    def _declare(
        self, manager_rate: int, joints: Sequence[str], others: Sequence[str]
    ) -> CommonParameters:
        """Declare both tables; what is set later counts at the next configure."""
        for line in adopt_overrides(
            self.node, self._table, CommonParameters, joints=joints, others=others
        ):
            self.log(Severity.WARN, line)
        declare(self.node, self._table)
        common = declare(self.node, CommonParameters, defaults={'update_rate': manager_rate})
        add_validation_callback(self.node, self._table, CommonParameters)
        if common.is_async:
            self.log(
                Severity.WARN,
                'is_async is true: the controller is updated in the control loop all the same',
            )
        return common

    # --- ports --------------------------------------------------------------------------------

    def _subscribe(self, port: Input[Any], thread: CallbackThread) -> None:
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


_CONFIGURING = State(id=State.TRANSITION_STATE_CONFIGURING, label='configuring')
_CLEANING_UP = State(id=State.TRANSITION_STATE_CLEANINGUP, label='cleaningup')
_ACTIVATING = State(id=State.TRANSITION_STATE_ACTIVATING, label='activating')
_DEACTIVATING = State(id=State.TRANSITION_STATE_DEACTIVATING, label='deactivating')
_SHUTTING_DOWN = State(id=State.TRANSITION_STATE_SHUTTINGDOWN, label='shuttingdown')

_UNCONFIGURED, _INACTIVE, _ACTIVE, _FINALIZED = (
    LifecycleState.UNCONFIGURED,
    LifecycleState.INACTIVE,
    LifecycleState.ACTIVE,
    LifecycleState.FINALIZED,
)
_BEGUN = {
    (_UNCONFIGURED, _INACTIVE): (Transition(id=1, label='configure'), _CONFIGURING),
    (_INACTIVE, _UNCONFIGURED): (Transition(id=2, label='cleanup'), _CLEANING_UP),
    (_INACTIVE, _ACTIVE): (Transition(id=3, label='activate'), _ACTIVATING),
    (_ACTIVE, _INACTIVE): (Transition(id=4, label='deactivate'), _DEACTIVATING),
    (_UNCONFIGURED, _FINALIZED): (Transition(id=5, label='shutdown'), _SHUTTING_DOWN),
    (_INACTIVE, _FINALIZED): (Transition(id=6, label='shutdown'), _SHUTTING_DOWN),
    (_ACTIVE, _FINALIZED): (Transition(id=7, label='shutdown'), _SHUTTING_DOWN),
}
"""(start, goal) → the transition, and the state in between."""


class TransitionEvents:
    """
    ``~/transition_event`` of one node; called on the control thread, as the manager's ``Watch``.

    Every transition makes two messages, into the state in between and out of it::

        unconfigured → configuring   (configure)
        configuring → inactive       (transition_success)

    Beyond rcl, which leaves them empty, they have the transition itself and its time.
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
        transition, between = _BEGUN[start, goal]
        event = TransitionEvent(timestamp=self._clock.now().nanoseconds)
        if reached is None:
            event.transition = transition
            event.start_state, event.goal_state = _state(start), between
        else:
            event.transition = _end_of(transition, succeeded=reached is goal)
            event.start_state, event.goal_state = between, _state(reached)
        # At once, not at the end of the cycle: the node may be gone by then. Where ROS was shut
        # down first, nothing can be published, and the motors still have to be stopped.
        if self._context.ok():
            self._publisher.publish(event)


def _state(state: LifecycleState) -> State:
    return State(id=state, label=state.label)


def _end_of(transition: Transition, *, succeeded: bool) -> Transition:
    """Numbers as in ``lifecycle_msgs``: 10 to 50 for success, one more for failure."""
    number = 10 * min(transition.id, Transition.TRANSITION_UNCONFIGURED_SHUTDOWN)
    if succeeded:
        return Transition(id=number, label='transition_success')
    return Transition(id=number + 1, label='transition_failure')


def _names_of(robot: Robot | None) -> tuple[list[str], list[str]]:
    """Return the joints of a robot, and its links, sensors and GPIOs: what parameters may name."""
    if robot is None:
        return [], []
    parts = [part.name for info in hardware_of(robot) for part in (*info.sensors, *info.gpios)]
    joints = [joint.name for joint in robot.joints]
    return joints, [link.name for link in robot.links] + parts


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
