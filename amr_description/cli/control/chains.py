# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The chains of controllers, as an indented tree and in the DOT language."""

from collections.abc import Iterator, Sequence
from typing import Any

HARDWARE = 'hardware'


def owner_of(interface: str, controllers: Sequence[Any]) -> str:
    """Return the controller that a command interface leads to, or :data:`HARDWARE`."""
    for controller in controllers:
        references = (f'{controller.name}/{name}' for name in controller.reference_interfaces)
        if interface in references:
            return controller.name
    return HARDWARE


def commands(controller: Any, controllers: Sequence[Any]) -> dict[str, list[str]]:
    """Return target -> the interfaces by which a controller commands it."""
    targets: dict[str, list[str]] = {}
    for interface in controller.required_command_interfaces:
        targets.setdefault(owner_of(interface, controllers), []).append(interface)
    return targets


def tree(controllers: Sequence[Any]) -> Iterator[str]:
    """Yield a tree for each controller that no other commands."""
    by_name = {controller.name: controller for controller in controllers}
    commanded = {name for c in controllers for name in commands(c, controllers) if name != c.name}
    for controller in controllers:
        if controller.name not in commanded:
            yield f'{controller.name} [{controller.state}]'
            yield from _branches(controller, by_name, (controller.name,))


def _branches(controller: Any, by_name: dict[str, Any], above: tuple[str, ...]) -> Iterator[str]:
    indent = '    ' * len(above)
    for target, interfaces in commands(controller, list(by_name.values())).items():
        state = f' [{by_name[target].state}]' if target in by_name else ''
        yield f'{indent}-> {target}{state}: {", ".join(interfaces)}'
        if target in by_name and target not in above:
            yield from _branches(by_name[target], by_name, (*above, target))


def dot(controllers: Sequence[Any]) -> Iterator[str]:
    """Yield the lines of a directed graph of controllers, hardware and command interfaces."""
    yield 'digraph controllers {'
    yield '    rankdir=LR;'
    yield '    node [shape=box];'
    yield f'    {_quoted(HARDWARE)} [shape=cylinder];'
    for controller in controllers:
        style = 'solid' if controller.state == 'active' else 'dashed'
        label = f'{controller.name}\n{controller.type}\n{controller.state}'
        yield f'    {_quoted(controller.name)} [label={_quoted(label)}, style={style}];'
    for controller in controllers:
        for target, interfaces in commands(controller, controllers).items():
            yield _edge(controller.name, target, interfaces)
        if controller.required_state_interfaces:
            yield _edge(HARDWARE, controller.name, controller.required_state_interfaces)
    yield '}'


def _edge(source: str, target: str, interfaces: Sequence[str]) -> str:
    label = _quoted('\n'.join(interfaces))
    return f'    {_quoted(source)} -> {_quoted(target)} [label={label}];'


def _quoted(text: str) -> str:
    escaped = text.replace('\\', '\\\\').replace('"', '\\"').replace('\n', '\\n')
    return f'"{escaped}"'
