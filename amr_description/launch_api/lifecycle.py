# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Nodes with a lifecycle: LifecycleNode, ChangeState, OnStateTransition.

A transition is asked for by ``ros2 lifecycle set``, as soon as the node has the service for it; so
a handler of OnStateTransition comes after the transitions that the launch file itself asks for.
"""

from collections.abc import Callable, Iterable
from typing import Any

from amr_description.launch_api.descriptions import Action
from amr_description.launch_api.events import Event, Handler, SomeActions
from amr_description.launch_api.locations import refusal
from amr_description.launch_api.processes import Node
from amr_description.launch_api.substitutions import SomeSubstitutions

GOALS = {
    1: 'inactive', 2: 'unconfigured', 3: 'active', 4: 'inactive', 5: 'finalized', 6: 'finalized',
    7: 'finalized',
}  # fmt: skip
"""Number of a transition, as in lifecycle_msgs/msg/Transition -> the state that it leads to."""
CONFIGURE, ACTIVATE = 1, 3


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
        if transition_id not in GOALS:
            known = ', '.join(map(str, GOALS))
            raise refusal(f'ChangeState(transition_id={transition_id!r}): it is one of {known}')
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
