# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``~/transition_event`` of a controller's node, as a lifecycle node of rclcpp publishes it.

Every transition makes two messages, into the state in between and out of it::

    unconfigured → configuring   (configure)
    configuring → inactive       (transition_success)

Beyond rcl, which leaves them empty, they say the transition itself and its time.
"""

from lifecycle_msgs.msg import State, Transition, TransitionEvent
from rclpy.node import Node
from rclpy.qos import QoSProfile

from amr_description.control.interfaces import LifecycleState

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
    """The topic of one node; called, on the owner's thread, as ``Watch`` of the manager is."""

    def __init__(self, node: Node) -> None:
        self._clock = node.get_clock()
        self._context = node.context
        self._publisher = node.create_publisher(
            TransitionEvent, '~/transition_event', QoSProfile(depth=10)
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
        # At once, not with the turn's outbox: the node may be gone by then. Where ROS was shut
        # down first, nobody hears it any more, and the motors still have to be stopped.
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
