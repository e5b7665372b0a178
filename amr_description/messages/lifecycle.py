# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a controller manager says of states, as the bytes of messages.

``~/transition_event`` of a controller and ``~/activity`` of a manager.
"""

from collections.abc import Sequence
from typing import Any, TypeAlias

from amr_description.control.interfaces import LifecycleState
from amr_description.control.snapshot import ComponentSnapshot, ControllerSnapshot, ManagerSnapshot
from amr_description.messages.parts import fill_stamp

ACTIVITY = 'controller_manager_msgs/msg/ControllerManagerActivity'
TRANSITION_EVENT = 'lifecycle_msgs/msg/TransitionEvent'

State: TypeAlias = tuple[int, str]
"""Its number and its label."""
States: TypeAlias = tuple[tuple[str, State], ...]
"""Of things, by their names."""

_CONFIGURING, _CLEANING_UP = (10, 'configuring'), (11, 'cleaningup')
_SHUTTING_DOWN, _ACTIVATING, _DEACTIVATING = (
    (12, 'shuttingdown'),
    (13, 'activating'),
    (14, 'deactivating'),
)
_UNCONFIGURED, _INACTIVE, _ACTIVE, _FINALIZED = (
    LifecycleState.UNCONFIGURED,
    LifecycleState.INACTIVE,
    LifecycleState.ACTIVE,
    LifecycleState.FINALIZED,
)
_BEGUN: dict[tuple[LifecycleState, LifecycleState], tuple[State, State]] = {
    (_UNCONFIGURED, _INACTIVE): ((1, 'configure'), _CONFIGURING),
    (_INACTIVE, _UNCONFIGURED): ((2, 'cleanup'), _CLEANING_UP),
    (_INACTIVE, _ACTIVE): ((3, 'activate'), _ACTIVATING),
    (_ACTIVE, _INACTIVE): ((4, 'deactivate'), _DEACTIVATING),
    (_UNCONFIGURED, _FINALIZED): ((5, 'shutdown'), _SHUTTING_DOWN),
    (_INACTIVE, _FINALIZED): ((6, 'shutdown'), _SHUTTING_DOWN),
    (_ACTIVE, _FINALIZED): ((7, 'shutdown'), _SHUTTING_DOWN),
}
"""(start, goal) → the transition, and the state in between."""
_FIRST_SHUTDOWN = 5


def transition_event(
    time: int, start: LifecycleState, goal: LifecycleState, reached: LifecycleState | None
) -> bytes:
    """
    Return the message that a transition has begun, or has ended.

    Every transition makes two messages, into the state in between and out of it::

        unconfigured → configuring   (configure)
        configuring → inactive       (transition_success)

    Beyond rcl, which leaves them empty, they have the transition itself and its time.

    Args:
        time: ns.
        start: The state before.
        goal: That to which it leads.
        reached: In which it has ended; None: it has begun.
    """
    transition, between = _BEGUN[start, goal]
    event = _new(TRANSITION_EVENT)
    event.timestamp = time
    before, after = _state(start), between
    if reached is not None:
        transition = _end_of(transition[0], succeeded=reached is goal)
        before, after = between, _state(reached)
    for message, (number, label) in (
        (event.transition, transition),
        (event.start_state, before),
        (event.goal_state, after),
    ):
        message.id, message.label = number, label
    return _bytes_of(TRANSITION_EVENT, event)


def states_of(snapshot: ManagerSnapshot) -> tuple[States, States]:
    """Return the states of controllers, and of hardware components."""
    return _named(snapshot.controllers), _named(snapshot.components)


def activity(time: int, controllers: States, components: States) -> bytes:
    """
    Return the message of the states of all controllers and components.

    Args:
        time: ns.
        controllers: See :func:`states_of`.
        components: Likewise.
    """
    message = _new(ACTIVITY)
    fill_stamp(time, message.header.stamp)
    message.controllers = [_named_state(*each) for each in controllers]
    message.hardware_components = [_named_state(*each) for each in components]
    return _bytes_of(ACTIVITY, message)


def _new(type_name: str) -> Any:
    from amr_description.messages.plain import PlainMessage  # for who hears of states

    return PlainMessage(type_name)


def _bytes_of(type_name: str, message: Any) -> bytes:
    from amr_description.cdr.serialized import serialized
    from amr_description.messages.definitions import layout_of

    return serialized(layout_of(type_name), message)


def _named(entries: Sequence[ControllerSnapshot] | Sequence[ComponentSnapshot]) -> States:
    return tuple((each.name, _state(each.state)) for each in entries)


def _named_state(name: str, state: State) -> Any:
    message = _new('controller_manager_msgs/msg/NamedLifecycleState')
    message.name = name
    message.state.id, message.state.label = state
    return message


def _state(state: LifecycleState) -> State:
    return int(state), state.label


def _end_of(transition: int, *, succeeded: bool) -> State:
    """Numbers as in ``lifecycle_msgs``: 10 to 50 for success, one more for failure."""
    number = 10 * min(transition, _FIRST_SHUTDOWN)
    return (number, 'transition_success') if succeeded else (number + 1, 'transition_failure')
