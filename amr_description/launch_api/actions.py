# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The actions that start no process: configurations, environment, groups, timers, lines."""

from collections.abc import Callable, Iterable, Mapping
import os
from typing import Any

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import Action, Entities, LaunchDescriptionEntity
from amr_description.launch_api.events import Handler, Shutdown as ShutdownEvent
from amr_description.launch_api.lifecycle import ChangeState
from amr_description.launch_api.locations import refusal
from amr_description.launch_api.substitutions import (
    is_a_substitution,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    SomeSubstitutions,
    text_of,
)
from amr_description.text import truth


class SetLaunchConfiguration(Action):
    """Give a configuration a value."""

    def __init__(self, name: SomeSubstitutions, value: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)
        self.value = normalize_to_list_of_substitutions(value)

    def execute(self, context: LaunchContext) -> None:
        name = perform_substitutions(context, self.name)
        context.launch_configurations[name] = perform_substitutions(context, self.value)


class UnsetLaunchConfiguration(Action):
    """Remove a configuration."""

    def __init__(self, name: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)

    def execute(self, context: LaunchContext) -> None:
        context.launch_configurations.pop(perform_substitutions(context, self.name), None)


class PushLaunchConfigurations(Action):
    """Begin a scope of configurations."""

    def execute(self, context: LaunchContext) -> None:
        context.push_configurations()


class PopLaunchConfigurations(Action):
    """End it."""

    def execute(self, context: LaunchContext) -> None:
        context.pop_configurations()


class ResetLaunchConfigurations(Action):
    """Forget all configurations but those that are given."""

    def __init__(
        self,
        launch_configurations: Mapping[Any, SomeSubstitutions] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.kept = launch_configurations or {}

    def execute(self, context: LaunchContext) -> None:
        kept = {text_of(context, key): text_of(context, value) for key, value in self.kept.items()}
        context.launch_configurations = kept


class PushEnvironment(Action):
    """Begin a scope of environment variables."""

    def execute(self, context: LaunchContext) -> None:
        context.push_environment()


class PopEnvironment(Action):
    """End it."""

    def execute(self, context: LaunchContext) -> None:
        context.pop_environment()


class ResetEnvironment(Action):
    """Have the environment that the launch began with."""

    def execute(self, context: LaunchContext) -> None:
        context.environment = dict(context.environment_at_first)


class SetEnvironmentVariable(Action):
    """Set a variable for what is started from here on."""

    def __init__(self, name: SomeSubstitutions, value: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)
        self.value = normalize_to_list_of_substitutions(value)

    def execute(self, context: LaunchContext) -> None:
        name = perform_substitutions(context, self.name)
        context.environment[name] = perform_substitutions(context, self.value)


class AppendEnvironmentVariable(SetEnvironmentVariable):
    """Append to a variable that is a list."""

    def __init__(
        self,
        name: SomeSubstitutions,
        value: SomeSubstitutions,
        prepend: Any = False,
        separator: SomeSubstitutions = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(name, value, **kwargs)
        self.prepend = prepend
        self.separator = normalize_to_list_of_substitutions(separator)

    def execute(self, context: LaunchContext) -> None:
        name = perform_substitutions(context, self.name)
        parts = [perform_substitutions(context, self.value)]
        if before := context.environment.get(name):
            prepends = self.prepend
            if not isinstance(prepends, bool):
                prepends = truth(text_of(context, prepends))
            parts = [*parts, before] if prepends else [before, *parts]
        context.environment[name] = perform_substitutions(context, self.separator).join(parts)


class UnsetEnvironmentVariable(Action):
    """Remove a variable."""

    def __init__(self, name: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)

    def execute(self, context: LaunchContext) -> None:
        context.environment.pop(perform_substitutions(context, self.name), None)


class GroupAction(Action):
    """Actions with a scope of their own."""

    def __init__(
        self,
        actions: Entities,
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[Any, SomeSubstitutions] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.actions = list(actions)
        self.scoped = scoped
        self.forwarding = forwarding
        self.launch_configurations = launch_configurations or {}

    def sub_entities(self) -> Entities:
        return self.actions if self.forwarding or not self.scoped else ()

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        given = self.launch_configurations.items()
        sets = [SetLaunchConfiguration(name, value) for name, value in given]
        if not self.scoped:
            return [*sets, *self.actions]
        if self.forwarding:
            begin: list[LaunchDescriptionEntity] = [*sets]
        else:
            begin = [ResetEnvironment(), ResetLaunchConfigurations(self.launch_configurations)]
        return [
            PushLaunchConfigurations(),
            PushEnvironment(),
            *begin,
            *self.actions,
            PopEnvironment(),
            PopLaunchConfigurations(),
        ]


class OpaqueFunction(Action):
    """A function of the context, which returns what to visit next."""

    def __init__(
        self,
        *,
        function: Callable[..., Entities | None],
        args: Iterable[Any] | None = None,
        kwargs: Mapping[str, Any] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(function):
            raise refusal(f'OpaqueFunction(function={function!r}): it takes a function')
        self.function = function
        self.args = list(args or ())
        self.kwargs = dict(kwargs or {})

    def execute(self, context: LaunchContext) -> Entities | None:
        return self.function(context, *self.args, **self.kwargs)


class Log(Action):
    """A line in the log."""

    def __init__(
        self, *, msg: SomeSubstitutions, level: SomeSubstitutions = 'INFO', **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.msg = normalize_to_list_of_substitutions(
            msg if isinstance(msg, str) or is_a_substitution(msg) or _is_list(msg) else str(msg)
        )
        self.level = normalize_to_list_of_substitutions(level)


def _is_list(value: object) -> bool:
    return isinstance(value, list | tuple)


class LogInfo(Log):
    """A line in the log."""

    def __init__(self, *, msg: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(msg=msg, **kwargs)


class TimerAction(Action):
    """Actions after a time."""

    def __init__(
        self,
        *,
        period: float | SomeSubstitutions,
        actions: Entities,
        cancel_on_shutdown: Any = True,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.period = period
        self.actions = list(actions)

    def sub_entities(self) -> Entities:
        return self.actions

    def seconds(self, context: LaunchContext) -> float:
        """Return the period, s. Raises BringupError."""
        given = self.period
        text = str(given) if isinstance(given, int | float) else text_of(context, given)
        try:
            seconds = float(text)
        except ValueError:
            seconds = -1.0
        if not 0 <= seconds < float('inf'):
            raise refusal(f"TimerAction(period='{text}'): it takes 0 s or more", self.where)
        return seconds


class RegisterEventHandler(Action):
    """What to do at an event."""

    def __init__(self, event_handler: Handler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(event_handler, Handler):
            raise refusal(f'RegisterEventHandler({event_handler!r}): it takes an event handler')
        self.event_handler = event_handler

    def sub_entities(self) -> Entities:
        return self.event_handler.entities


class EmitEvent(Action):
    """An event; here ``Shutdown`` and ``ChangeState``."""

    def __init__(self, *, event: object, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(event, ShutdownEvent | ChangeState):
            raise refusal(
                f'EmitEvent(event={type(event).__name__}(…)) is not understood here; understood '
                'are Shutdown and ChangeState'
            )
        self.event = event


class Shutdown(EmitEvent):
    """Stop all."""

    def __init__(self, *, reason: SomeSubstitutions = 'reason not given', **kwargs: Any) -> None:
        super().__init__(event=ShutdownEvent(reason=reason), **kwargs)
