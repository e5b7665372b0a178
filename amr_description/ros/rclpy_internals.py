# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What this package needs of rclpy although rclpy keeps it private; nothing else uses such members.

Written for rclpy 7.1.6. ``test_rclpy_internals.py`` holds each one, and names that version when
another rclpy breaks it.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
import ctypes
from functools import cache
from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import ROSClock
from rclpy.context import Context
from rclpy.exceptions import ParameterNotDeclaredException
from rclpy.executors import Executor
from rclpy.guard_condition import GuardCondition
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

if TYPE_CHECKING:
    # rclpy.action loads numpy: a quarter of the processor time of `ros2 topic list`
    from rclpy.action import ActionServer
    from rclpy.action.server import GoalEvent, ServerGoalHandle
    from rclpy.lifecycle import LifecycleNode

__all__ = [
    'begin_goal',
    'bytes_publisher',
    'cancel_tasks',
    'clock_subscription',
    'destroy_lifecycle_services',
    'destroy_type_description_service',
    'end_goal',
    'manual_clock',
    'mend_parameter_services',
    'NodeNameNonExistentError',
    'parameter_overrides',
    'publisher_without_lock',
    'RCLError',
    'RCLInvalidROSArgsError',
    'RcutilsLogger',
    'replace_parameter_event_publisher',
    'set_parameter_override',
    'share_clock',
    'SubscriptionWaiter',
    'take_message',
    'take_with_info',
    'takes_info',
    'UnknownROSArgsError',
]

NodeNameNonExistentError = _rclpy.NodeNameNonExistentError
RCLError = _rclpy.RCLError
RCLInvalidROSArgsError = _rclpy.RCLInvalidROSArgsError
UnknownROSArgsError = _rclpy.UnknownROSArgsError


def share_clock(node: Node, clock: ROSClock) -> None:
    """
    Let a node go by a clock that others go by, too, and not by ``/clock``.

    For a node whose ``use_sim_time`` is true; on the thread that made it. Where the parameter is
    set to false later on, the node goes by the system clock.
    """
    source, own = node._time_source, node._clock
    source.ros_time_is_active = True
    node.destroy_subscription(source._clock_sub)
    source._clock_sub = None
    node._clock = clock

    def choose(parameters: list[Parameter]) -> None:
        for each in parameters:
            if each.name == 'use_sim_time':
                node._clock = clock if each.value else own

    node.add_post_set_parameters_callback(choose)


def clock_subscription(node: Node) -> Subscription | None:
    """Return the subscription that sets the clock of a node; None: the system's clock does."""
    source = getattr(node, '_time_source', None)  # none yet, while the node is made
    return None if source is None else source._clock_sub


def manual_clock() -> ROSClock:
    """Return a clock that stands at 0 until ``set_ros_time_override()`` is called."""
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    return clock


def parameter_overrides(node: Node) -> Mapping[str, Parameter]:
    """Return the parameters that a node was given, by files and arguments, declared or not."""
    return node._parameter_overrides


def set_parameter_override(node: Node, parameter: Parameter) -> None:
    """Have a node given a value before the parameter is declared, in the place of another one."""
    node._parameter_overrides[parameter.name] = parameter


def replace_parameter_event_publisher(node: Node, publisher: Publisher) -> None:
    """Have a node publish its parameter events with another publisher."""
    node.destroy_publisher(node._parameter_event_publisher)
    node._parameter_event_publisher = publisher


def mend_parameter_services() -> None:
    """
    Have the parameter services of every node of this process answer what they raise on.

    In rclpy 7.1.6 a value of an unknown type, or the question for the type of an undeclared
    parameter of a node that allows such, raises out of the executor. rclcpp answers.
    """
    ParameterService._get_parameter_types_callback = _get_parameter_types
    ParameterService._set_parameters_callback = _set_parameters
    ParameterService._set_parameters_atomically_callback = _set_parameters_atomically


def _get_parameter_types(service: ParameterService, request: Any, response: Any) -> Any:
    node = service._get_node()
    try:
        response.types = [_number_of(node.get_parameter_type(each)) for each in request.names]
    except ParameterNotDeclaredException:
        response.types = []
    return response


def _number_of(kind: Any) -> int:
    return kind.value if isinstance(kind, Parameter.Type) else kind


def _set_parameters(service: ParameterService, request: Any, response: Any) -> Any:
    node = service._get_node()
    response.results = [_set_together(node, [each]) for each in request.parameters]
    return response


def _set_parameters_atomically(service: ParameterService, request: Any, response: Any) -> Any:
    response.result = _set_together(service._get_node(), request.parameters)
    return response


def _set_together(node: Node, messages: Sequence[Any]) -> SetParametersResult:
    """Set parameters, all or none; whatever is wrong with them is the reason."""
    try:
        return node.set_parameters_atomically([_parameter_of(each) for each in messages])
    except Exception as error:  # rclpy has ten kinds of them, and the callbacks may raise any
        reason = ' '.join(str(error).split()) or type(error).__name__
        return SetParametersResult(successful=False, reason=reason)


def _parameter_of(message: Any) -> Parameter:
    known = {each.value for each in Parameter.Type}
    if message.value.type not in known:
        raise ValueError(
            f'{message.name!r}: a value is of type {min(known)} to {max(known)}, '
            f'not {message.value.type}'
        )
    return Parameter.from_parameter_msg(message)


def cancel_tasks(executor: Executor) -> None:
    """Cancel the coroutines of callbacks that still await something, for an executor at rest."""
    for task, *_ in executor._tasks:
        task.cancel()


def take_message(subscription: Subscription) -> Any | None:
    """
    Take the next message of a subscription that no executor serves.

    Returns:
        The message, or its bytes for a raw subscription; None: none has come.

    Raises:
        InvalidHandle: The subscription was destroyed.
    """
    taken = take_with_info(subscription)
    return None if taken is None else taken[0]


def take_with_info(subscription: Subscription) -> tuple[Any, Mapping[str, int]] | None:
    """Take as :func:`take_message`, with what rclpy hands to a callback as message info."""
    handle = subscription.handle
    with handle:
        return handle.take_message(subscription.msg_type, subscription.raw)


def takes_info(subscription: Subscription) -> bool:
    """Return whether its callback has a second parameter, for what rclpy tells of a message."""
    return subscription._callback_type is Subscription.CallbackType.WithMessageInfo


def bytes_publisher(publisher: Publisher) -> Callable[[bytes], None]:
    """
    Return ``Publisher.publish`` for serialized messages: 1.1 µs instead of 1.6, without a reader.

    It raises InvalidHandle: the publisher was destroyed.
    """
    handle = publisher.handle
    publish_raw = handle.publish_raw

    def publish(data: bytes) -> None:
        with handle:
            publish_raw(data)

    return publish


def publisher_without_lock(publisher: Publisher) -> Callable[[bytes], None]:
    """
    Return a :func:`bytes_publisher` during whose calls the other threads of Python go on.

    rclpy keeps the interpreter's lock while it publishes: 1 to 2 ms for 1.8 MB by UDP, for which a
    control thread would wait. A call costs 3 µs more, so this is for big messages.

    It raises InvalidHandle: the publisher was destroyed; RCLError: rcl refuses.
    """
    publish_serialized = _publish_serialized_message()
    if publish_serialized is None:
        return bytes_publisher(publisher)
    handle = publisher.handle

    def publish(data: bytes) -> None:
        message = _SerializedMessage(data, len(data), len(data))
        with handle:
            code = publish_serialized(handle.pointer, ctypes.byref(message), None)
        if code:
            raise RCLError(f'Failed to publish: {_take_error()}')

    return publish


class _SerializedMessage(ctypes.Structure):
    """``rcl_serialized_message_t``, which is a ``rcutils_uint8_array_t``."""

    _fields_ = (
        ('buffer', ctypes.c_char_p),
        ('buffer_length', ctypes.c_size_t),
        ('buffer_capacity', ctypes.c_size_t),
        ('allocator', ctypes.c_void_p * 5),  # nothing of it is allocated, or freed
    )


class _ErrorString(ctypes.Structure):
    """``rcutils_error_string_t``."""

    _fields_ = (('str', ctypes.c_char * 1024),)


class SubscriptionWaiter:
    """Waits, in one thread, for a message of subscriptions that no executor serves."""

    def __init__(self, subscriptions: Sequence[Subscription], context: Context) -> None:
        self._subscriptions = tuple(subscriptions)
        self._guard = GuardCondition(None, None, context)
        self._context = context
        self._wait_set = self._made_for(len(subscriptions))

    def serve(self, subscriptions: Sequence[Subscription]) -> None:
        """Wait for these from now on; in the thread that waits."""
        if len(subscriptions) > len(self._subscriptions):
            self._wait_set.destroy_when_not_in_use()
            self._wait_set = self._made_for(len(subscriptions))
        self._subscriptions = tuple(subscriptions)

    def _made_for(self, count: int) -> Any:
        with self._context.handle:
            return _rclpy.WaitSet(count, 1, 0, 0, 0, 0, self._context.handle)

    def wait(self) -> None:
        """Wait for a message, or for :meth:`wake`. Raises InvalidHandle: one was destroyed."""
        self._wait_set.clear_entities()
        with ExitStack() as in_use:
            for subscription in self._subscriptions:
                in_use.enter_context(subscription.handle)
                self._wait_set.add_subscription(subscription.handle)
            in_use.enter_context(self._guard.handle)
            self._wait_set.add_guard_condition(self._guard.handle)
            self._wait_set.wait(-1)

    def wake(self) -> None:
        """End the wait, or the next one; from any thread."""
        self._guard.trigger()

    def destroy(self) -> None:
        """Let go of everything; nobody waits any more."""
        self._wait_set.destroy_when_not_in_use()
        self._guard.destroy()


def begin_goal(handle: 'ServerGoalHandle') -> None:
    """
    Set an accepted goal executing, or leave it canceling, without a coroutine that waits for it.

    rclpy polls such a coroutine at every turn of the executor until the goal has ended.
    """
    from rclpy.action.server import GoalEvent

    if not handle.is_cancel_requested:
        handle._update_state(GoalEvent.EXECUTE)


def end_goal(
    server: 'ActionServer', handle: 'ServerGoalHandle', event: 'GoalEvent', result: Any
) -> None:
    """
    End a goal, publish its status, and answer those who ask for its result.

    Args:
        server: of the action.
        handle: of the goal, begun by :func:`begin_goal`.
        event: SUCCEED, ABORT or CANCELED. The server may cancel what no client asked to be, which
            rcl allows only by way of CANCEL_GOAL.
        result: the message.

    Raises:
        RCLError: rcl refuses.
    """
    from rclpy.action.server import GoalEvent

    if event is GoalEvent.CANCELED and not handle.is_cancel_requested:
        handle._update_state(GoalEvent.CANCEL_GOAL)
    handle._update_state(event)
    response = server.action_type.Impl.GetResultService.Response()
    response.status = handle.status
    response.result = result
    future = server._result_futures[bytes(handle.goal_id.uuid)]
    future._set_executor(None)  # sent now: at the executor's next turn the server may be gone
    future.set_result(response)


def destroy_lifecycle_services(node: 'LifecycleNode') -> None:
    """
    Remove ``~/change_state`` and the others, which ``LifecycleNode.destroy_node()`` forgets.

    They would stay in the graph until a garbage collection, and keep the participant of their
    context.
    """
    node._state_machine.destroy_when_not_in_use()


def destroy_type_description_service(node: Node) -> None:
    """
    Remove ``~/get_type_description``, which ``Node.destroy_node()`` forgets.

    rcl makes it for every node, and rclpy has no more of it than its address. It would stay in
    the graph under the name of the node that is gone, with 0.1 MB, and answer beside that of the
    next node of that name.
    """
    service = node._type_description_service._type_description_srv
    fini = _service_fini()
    if service is not None and fini is not None:
        with node.handle, service.impl:
            fini(service.impl.pointer, node.handle.pointer)  # a second time does nothing


@cache
def _service_fini() -> Callable[[int, int], int] | None:
    """``rcl_service_fini`` of the library that rclpy has loaded; None: it is not to be found."""
    try:
        fini = ctypes.CDLL('librcl.so').rcl_service_fini
    except (OSError, AttributeError):
        return None
    fini.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    return fini


@cache
def _publish_serialized_message() -> Callable[..., int] | None:
    """``rcl_publish_serialized_message``, likewise; ctypes lets go of the lock while it runs."""
    try:
        publish = ctypes.CDLL('librcl.so').rcl_publish_serialized_message
        _error_functions()
    except (OSError, AttributeError):
        return None
    publish.argtypes = [ctypes.c_void_p] * 3
    return publish


def _take_error() -> str:
    """Return what the last call of rcl on this thread said, and forget it."""
    get, reset = _error_functions()
    text = get().str.decode(errors='replace')
    reset()
    return text


@cache
def _error_functions() -> tuple[Callable[[], _ErrorString], Callable[[], None]]:
    library = ctypes.CDLL('librcutils.so')
    get, reset = library.rcutils_get_error_string, library.rcutils_reset_error
    get.restype, reset.restype = _ErrorString, None
    return get, reset
