# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The tree of groups and stacks, flattened: what holds for each node where it stands."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from amr_description.bringup.conditions import all_of, Condition, Scope
from amr_description.bringup.description import Group, Member, Node, Parameters, Stack


@dataclass(frozen=True)
class ResolvedNode:
    """A node, and what it has of its groups and stacks."""

    node: Node
    namespace: str | None
    """From the root, ``/robot1/arm``; None: neither the node nor a group gives one."""
    environment: Mapping[str, str]
    parameters: Parameters
    remappings: Sequence[tuple[str, str]]
    start_when: Condition | None
    """With full names."""
    patience: float
    """s"""


@dataclass(frozen=True)
class _Place:
    """What a member inherits."""

    patience: float
    namespace: str | None = None
    environment: Mapping[str, str] = field(default_factory=dict)
    parameters: Parameters = ()
    remappings: Sequence[tuple[str, str]] = ()
    conditions: tuple[tuple[Condition, str | None], ...] = ()
    """Those of the groups around it, each with the namespace that it stands in."""


class Placement:
    """Where everything of a stack stands."""

    def __init__(self, stack: Stack) -> None:
        """Flatten ``stack``."""
        self._stacks: dict[Stack, str] = {}
        at_root = _Place(stack.patience)
        found = list(self._walk(stack, at_root))
        self.nodes = [self._placed(node, place) for node, place in found]
        """In the order of the tree."""
        self.ready_when = stack.readiness.resolved(self._scope(None))

    def _walk(self, member: Member, place: _Place) -> Iterator[tuple[Node, _Place]]:
        if isinstance(member, Node):
            yield member, place
            return
        if isinstance(member, Stack):
            self._stacks[member] = place.namespace or '/'
            inside, members = replace(place, patience=member.patience), member.nodes
        else:
            inside, members = _inside(member, place), member.members
        for each in members:
            yield from self._walk(each, inside)

    def _placed(self, node: Node, place: _Place) -> ResolvedNode:
        namespace = _joined(place.namespace, node.namespace)
        conditions = [c.resolved(self._scope(where)) for c, where in place.conditions]
        if node.start_when is not None:
            conditions.append(node.start_when.resolved(self._scope(place.namespace)))
        return ResolvedNode(
            node,
            namespace,
            {**place.environment, **node.environment},
            (*place.parameters, *node.parameters),
            (*place.remappings, *node.remappings),
            all_of(*conditions) if len(conditions) > 1 else next(iter(conditions), None),
            place.patience if node.patience is None else node.patience,
        )

    def _scope(self, namespace: str | None) -> Scope:
        return Scope(namespace or '/', self._stacks)


def _inside(group: Group, place: _Place) -> _Place:
    namespace = _joined(place.namespace, group.namespace)
    own = ((group.start_when, namespace),) if group.start_when else ()
    return replace(
        place,
        namespace=namespace,
        environment={**place.environment, **group.environment},
        parameters=(*place.parameters, *group.parameters),
        remappings=(*place.remappings, *group.remappings),
        conditions=(*place.conditions, *own),
    )


def _joined(outer: str | None, inner: str | None) -> str | None:
    """Return a namespace in another one, from the root, or None if there is none."""
    if inner is None:
        return outer
    if inner.startswith('/') or outer is None:
        return f'/{inner.strip("/")}'
    return f'{outer.rstrip("/")}/{inner.strip("/")}'.rstrip('/') or '/'
