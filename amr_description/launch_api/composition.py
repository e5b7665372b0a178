# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Components: nodes that a container loads from C++ libraries, of which there are none here.

They are values, as in launch_ros: a file may make them. Where one with a true condition is
reached, it is left out if something here does what it does, and refused otherwise.
"""

from collections.abc import Iterable
from typing import Any

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.counterparts import counterpart_of
from amr_description.launch_api.descriptions import Action
from amr_description.launch_api.locations import Located, refusal
from amr_description.launch_api.substitutions import SomeSubstitutions, text_of


class ComposableNode(Located):
    """A node in a library of C++."""

    def __init__(
        self,
        *,
        package: SomeSubstitutions,
        plugin: SomeSubstitutions,
        condition: Any = None,
        **others: Any,
    ) -> None:
        self.package = package
        self.condition = condition
        self.plugin = plugin
        self.others = others


class LoadComposableNodes(Action):
    """Have a container load nodes."""

    def __init__(
        self,
        *,
        composable_node_descriptions: Iterable[ComposableNode] | None = None,
        target_container: object = None,
        condition: Any = None,
        **others: Any,
    ) -> None:
        super().__init__(condition=condition)
        self.components = list(composable_node_descriptions or ())
        self.target_container = target_container
        self.others = others

    def left_out(self, context: LaunchContext) -> dict[str, str]:
        """Return what is left out, and why. Raises BringupError where nothing does it here."""
        found = {}
        for each in self.components:
            if each.condition is not None and not each.condition.evaluate(context):
                continue
            package, plugin = (text_of(context, text) for text in (each.package, each.plugin))
            other = counterpart_of(package, plugin)
            if other is None or not other.why:
                raise refusal(
                    f"the component '{plugin}' of {package} is a library of C++, which no "
                    'container can load here; start it as a node of its own, if it has an '
                    'executable',
                    each.where,
                )
            found[f'{package} {plugin}'] = other.why
        return found


class ComposableNodeContainer(LoadComposableNodes):
    """A process that loads nodes."""

    def __init__(
        self,
        *,
        name: SomeSubstitutions,
        namespace: SomeSubstitutions = '',
        **others: Any,
    ) -> None:
        super().__init__(**others)
        self.name = name
        self.namespace = namespace

    def left_out(self, context: LaunchContext) -> dict[str, str]:
        """Return the container too: it would have nothing to load."""
        return super().left_out(context) or {text_of(context, self.name): 'it loads nothing here'}
