# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The tree of groups and stacks, flattened: each node with all that it inherits."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from amr_description.bringup.conditions import all_of, Condition, Member, Scope
from amr_description.bringup.description import Group, Node, Parameters, Stack, stacks_of
from amr_description.bringup.handlers import EventHandler


@dataclass(frozen=True)
class ResolvedNode:
    """A node with what it inherits from its groups and stacks."""

    node: Node
    namespace: str | None
    """Absolute, ``/robot1/arm``; None: neither the node nor a group sets one."""
    environment: Mapping[str, str | None]
    """None: without the variable."""
    parameters: Parameters
    remappings: Sequence[tuple[str, str]]
    start_when: Condition | None
    """With absolute names."""
    timeout: float
    """s"""


@dataclass(frozen=True)
class _Inherited:
    """What a member gets from the groups and stacks around it."""

    timeout: float
    namespace: str | None = None
    environment: Mapping[str, str | None] = field(default_factory=dict)
    parameters: Parameters = ()
    remappings: Sequence[tuple[str, str]] = ()
    conditions: tuple[tuple[Condition, str | None], ...] = ()
    """Those of the groups, each with the namespace that its names are relative to."""


class Placement:
    """The nodes of a stack, resolved."""

    def __init__(self, stack: Stack) -> None:
        """Flatten the stack."""
        self._stacks: dict[Member, str] = {}
        found = list(self._walk(stack, _Inherited(stack.timeout)))
        self.nodes = [self._resolve(node, inherited) for node, inherited in found]
        """In the order of the tree."""
        self.ready_when = stack.readiness.resolved(self._scope(None))
        """With absolute names."""
        self.event_handlers = list(self._handlers(stack, None))
        """With absolute names."""

    def _handlers(self, stack: Stack, namespace: str | None) -> Iterator[EventHandler]:
        scope = self._scope(self._stacks.get(stack, namespace))
        for handler in stack.event_handlers:
            yield replace(handler, when=handler.when.resolved(scope))
        for inner in stacks_of(stack.nodes):
            yield from self._handlers(inner, namespace)

    def _walk(self, member: Member, inherited: _Inherited) -> Iterator[tuple[Node, _Inherited]]:
        if isinstance(member, Node):
            yield member, inherited
            return
        inner = inherited
        members: Sequence[Member] = ()
        if isinstance(member, Stack):
            self._stacks[member] = inherited.namespace or '/'
            inner, members = replace(inherited, timeout=member.timeout), member.nodes
        elif isinstance(member, Group):
            inner, members = _with_group(inherited, member), member.members
        for each in members:
            yield from self._walk(each, inner)

    def _resolve(self, node: Node, inherited: _Inherited) -> ResolvedNode:
        conditions = [c.resolved(self._scope(where)) for c, where in inherited.conditions]
        if node.start_when is not None:
            conditions.append(node.start_when.resolved(self._scope(inherited.namespace)))
        return ResolvedNode(
            node,
            _joined(inherited.namespace, node.namespace),
            {**inherited.environment, **node.environment},
            (*inherited.parameters, *node.parameters),
            (*inherited.remappings, *node.remappings),
            all_of(*conditions) if len(conditions) > 1 else next(iter(conditions), None),
            inherited.timeout if node.timeout is None else node.timeout,
        )

    def _scope(self, namespace: str | None) -> Scope:
        return Scope(namespace or '/', self._stacks)


def _with_group(inherited: _Inherited, group: Group) -> _Inherited:
    namespace = _joined(inherited.namespace, group.namespace)
    own = ((group.start_when, namespace),) if group.start_when else ()
    return replace(
        inherited,
        namespace=namespace,
        environment={**inherited.environment, **group.environment},
        parameters=(*inherited.parameters, *group.parameters),
        remappings=(*inherited.remappings, *group.remappings),
        conditions=(*inherited.conditions, *own),
    )


def _joined(outer: str | None, inner: str | None) -> str | None:
    """Return the absolute namespace ``inner`` within ``outer``; None if there is neither."""
    if inner is None:
        return outer
    if inner.startswith('/') or outer is None:
        return f'/{inner.strip("/")}'
    return f'{outer.rstrip("/")}/{inner.strip("/")}'.rstrip('/') or '/'
