# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Nodes with a lifecycle: LifecycleNode, ChangeState, OnStateTransition.

A transition is asked for by ``ros2 lifecycle set``, as soon as the node has the service for it; so
a handler of OnStateTransition comes after the transitions that the launch file itself asks for.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from amr_description.launch_api.descriptions import Action
from amr_description.launch_api.events import Event, Handler, SomeActions
from amr_description.launch_api.locations import refusal
from amr_description.launch_api.processes import Node
from amr_description.launch_api.substitutions import SomeSubstitutions


@dataclass(frozen=True)
class Transition:
    """A transition of lifecycle_msgs, by the names of its states."""

    label: str
    during: str
    """The state meanwhile."""
    goal: str


TRANSITIONS = {
    1: Transition('configure', 'configuring', 'inactive'),
    2: Transition('cleanup', 'cleaningup', 'unconfigured'),
    3: Transition('activate', 'activating', 'active'),
    4: Transition('deactivate', 'deactivating', 'inactive'),
    **dict.fromkeys((5, 6, 7), Transition('shutdown', 'shuttingdown', 'finalized')),
}
"""By their numbers, as in lifecycle_msgs/msg/Transition."""
CONFIGURE, ACTIVATE = 1, 3


def transition_of(number: int, where: str) -> Transition:
    """Return a transition. Raises BringupError: there is none of that number."""
    if number not in TRANSITIONS:
        known = ', '.join(map(str, TRANSITIONS))
        raise refusal(f'{where}={number!r}: it is one of {known}')
    return TRANSITIONS[number]


class LifecycleNode(Node):
    """A node whose state is managed."""

    def __init__(
        self,
        *,
        name: SomeSubstitutions,
        namespace: SomeSubstitutions = '',
        autostart: bool | SomeSubstitutions = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.autostart = autostart


def matches_action(target_action: Action) -> Callable[[Action], bool]:
    """Return a matcher of one action, as in launch.events."""
    return lambda action: action is target_action


class ChangeState(Event):
    """A transition is asked for."""

    def __init__(
        self, *, lifecycle_node_matcher: Callable[[Action], bool], transition_id: int
    ) -> None:
        transition_of(transition_id, 'ChangeState(transition_id)')
        self.lifecycle_node_matcher = lifecycle_node_matcher
        self.transition_id = transition_id


class LifecycleTransition(Action):
    """Transitions of several nodes, one after the other, by their names."""

    def __init__(
        self,
        *,
        lifecycle_node_names: Iterable[SomeSubstitutions],
        transition_ids: Iterable[int],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.lifecycle_node_names = list(lifecycle_node_names)
        self.transition_ids = list(transition_ids)
        for number in self.transition_ids:
            transition_of(number, 'LifecycleTransition(transition_ids)')


class OnStateTransition(Handler):
    """When a node has come to a state."""

    def __init__(
        self,
        *,
        entities: SomeActions,
        target_lifecycle_node: Action | None = None,
        transition: str | None = None,
        start_state: str | None = None,
        goal_state: str | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(target_lifecycle_node, entities, **kwargs)
        self.transition = transition
        self.start_state = start_state
        self.goal_state = goal_state

    def is_of(self, done: Transition) -> bool:
        """Return whether it waits for the success of a transition."""
        labels = (done.label, 'transition_success', f'on_{done.label}_success')
        return (
            self.start_state in (None, done.during)
            and self.goal_state in (None, done.goal)
            and self.transition in (None, *labels)
        )
