# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
LaunchDescription, what all actions have in common, and the arguments of a description.

An action is visited by :mod:`~amr_description.launch_api.translation`. Most have an ``execute``,
as in launch, which changes the context and returns the entities to visit next.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Protocol, TypeAlias

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.locations import Located, refusal
from amr_description.launch_api.substitutions import (
    described,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    SomeSubstitutions,
    Substitution,
)


class HasTruth(Protocol):
    """A condition."""

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether it holds."""
        ...


class LaunchDescriptionEntity(Located):
    """What a description is made of."""

    def sub_entities(self) -> 'Iterable[LaunchDescriptionEntity]':
        """Return the entities in it that are known without a context, for ``--show-args``."""
        return ()


Entities: TypeAlias = Iterable[LaunchDescriptionEntity]


class Action(LaunchDescriptionEntity):
    """Base of all actions; users derive from it, too."""

    def __init__(self, *, condition: HasTruth | None = None) -> None:
        self.condition = condition

    def execute(self, context: LaunchContext) -> Entities | None:
        """Change the context; return what to visit next."""
        return None


class Occurrence(Action):
    """An action that is done when its time has come, and not while the description is visited."""

    def occur(self, context: LaunchContext) -> None:
        """Do it; called on the thread that runs the processes."""
        raise NotImplementedError(f'{type(self).__name__}.occur')


class LaunchDescription(LaunchDescriptionEntity):
    """What ``generate_launch_description`` returns."""

    def __init__(
        self,
        initial_entities: Entities | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        self.entities = list(initial_entities or ())
        self.deprecated_reason = deprecated_reason

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Append one."""
        self.entities.append(entity)

    def add_action(self, action: Action) -> None:
        """Append one."""
        self.entities.append(action)

    def sub_entities(self) -> Entities:
        return self.entities

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return its entities."""
        return self.entities

    def get_launch_arguments(self) -> 'list[DeclareLaunchArgument]':
        """Return the arguments that it declares, also in files that it includes."""
        return declared_arguments(self)


class DeclareLaunchArgument(Action):
    """An argument, ``name:=value``."""

    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutions = None,
        description: str | None = None,
        choices: Sequence[str] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.name = name
        self.default_value: list[Substitution] | None = None
        if default_value is not None:
            self.default_value = normalize_to_list_of_substitutions(default_value)
        if choices is not None and not choices:
            raise refusal('Provided choices arg is empty. Use None to ignore the choice list.')
        if choices and isinstance(default_value, str) and default_value not in choices:
            raise refusal(
                f'Provided default_value "{default_value}" is not in provided choices "{choices}".'
            )
        self.choices = choices
        self.description = _about(description, choices)
        self.is_conditional = False
        """Whether it is visited under a condition only, as far as that is known."""

    def execute(self, context: LaunchContext) -> None:
        if self.name not in context.launch_configurations:
            if self.default_value is None:
                raise refusal(f'Required launch argument "{self.name}" was not provided.', '')
            context.launch_configurations[self.name] = perform_substitutions(
                context, self.default_value
            )
        value = context.launch_configurations[self.name]
        if self.choices is not None and value not in self.choices:
            raise refusal(
                f'Argument "{self.name}" provided value "{value}" is not valid. Valid options '
                f'are: {list(self.choices)}',
                '',
            )


class DeclareBooleanLaunchArgument(DeclareLaunchArgument):
    """An argument that is true or false."""

    def __init__(self, name: str, **kwargs: Any) -> None:
        super().__init__(name, choices=['true', 'false', 'True', 'False'], **kwargs)


def _about(description: str | None, choices: Sequence[str] | None) -> str:
    if description is None:
        return 'no description given' if choices is None else f'One of: {list(choices)}'
    if choices is None:
        return description
    return f'{description.removesuffix(".")}. Valid choices are: {list(choices)}'


def declared_arguments(description: LaunchDescription) -> list[DeclareLaunchArgument]:
    """Return the arguments of a description and of what it includes; of each name the first."""
    found: dict[str, DeclareLaunchArgument] = {}
    for argument in _arguments_below(description, conditional=False):
        found.setdefault(argument.name, argument)
    return list(found.values())


def _arguments_below(
    entity: LaunchDescriptionEntity, *, conditional: bool
) -> Iterator[DeclareLaunchArgument]:
    for each in entity.sub_entities():
        if not isinstance(each, LaunchDescriptionEntity):
            continue  # it is refused where it is visited
        inside = conditional or getattr(each, 'condition', None) is not None
        if isinstance(each, DeclareLaunchArgument):
            each.is_conditional = inside
            yield each
        yield from _arguments_below(each, conditional=inside)


def show_arguments(arguments: Sequence[DeclareLaunchArgument]) -> str:
    """Return what ``--show-args`` prints, letter for letter as the original does."""
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    for argument in arguments:
        star = '*' if argument.is_conditional else ''
        lines += ['', f"    '{argument.name}':{star}", f'        {argument.description}']
        if argument.default_value is not None:
            lines.append(f'        (default: {described(argument.default_value)})')
    if any(argument.is_conditional for argument in arguments):
        lines += ['', '* argument(s) which are only used if specific conditions occur']
    return '\n'.join(lines if arguments else [*lines, '', '  No arguments.'])
