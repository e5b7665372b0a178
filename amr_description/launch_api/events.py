# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Event handlers of launch, and the events that their functions are given."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import LaunchDescriptionEntity
from amr_description.launch_api.locations import Located, refusal
from amr_description.launch_api.substitutions import SomeSubstitutions, text_of

Function: TypeAlias = Callable[..., Any]
SomeActions: TypeAlias = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity] | Function


class Event:
    """Base of all events."""


class Shutdown(Event):
    """The launch stops."""

    def __init__(
        self,
        *,
        reason: SomeSubstitutions = 'reason not given',
        due_to_sigint: bool = False,
        **_kwargs: Any,
    ) -> None:
        self.reason = reason
        self.due_to_sigint = due_to_sigint

    def text(self, context: LaunchContext) -> str:
        """Return the reason."""
        return text_of(context, self.reason)


@dataclass(frozen=True)
class IncludeRequest(Event):
    """A description is to run, too; by a LaunchService that runs."""

    launch_description: Any


@dataclass(frozen=True)
class ShutdownProcess(Event):
    """Processes are to end; by a LaunchService that runs: with what was included with them."""

    process_matcher: Callable[[Any], bool]


@dataclass(frozen=True)
class ProcessEvent(Event):
    """Something about a process."""

    action: object
    name: str
    """As on the screen: ``create-3``."""
    cmd: Sequence[str] = ()
    pid: int | None = None

    @property
    def process_name(self) -> str:
        """As in launch."""
        return self.name


@dataclass(frozen=True)
class ProcessStarted(ProcessEvent):
    """It was started."""


@dataclass(frozen=True)
class ProcessExited(ProcessEvent):
    """It has ended."""

    returncode: int = 0


@dataclass(frozen=True)
class ProcessIO(ProcessEvent):
    """It has written a line."""

    text: bytes = b''
    from_stdout: bool = True
    from_stderr: bool = False
    from_stdin: bool = False


@dataclass(frozen=True)
class ExecutionComplete(Event):
    """An action is complete."""

    action: object


class Handler(Located):
    """Base of the event handlers: a target, and what is to be done."""

    def __init__(self, target: object, on_event: SomeActions, **kwargs: Any) -> None:
        if kwargs.pop('handle_once', False) not in (True, False):
            raise refusal(f'{type(self).__name__}: handle_once is True or False')
        if kwargs:
            names = ', '.join(kwargs)
            raise refusal(f'{type(self).__name__}({names}=…) is not understood here')
        self.target = target
        self.function = on_event if callable(on_event) else None
        self.entities: list[LaunchDescriptionEntity] = []
        if isinstance(on_event, LaunchDescriptionEntity):
            self.entities = [on_event]
        elif not callable(on_event):
            self.entities = list(on_event)


class OnProcessExit(Handler):
    """When a process has ended, whatever its exit code."""

    def __init__(
        self, *, target_action: object = None, on_exit: SomeActions, **kwargs: Any
    ) -> None:
        super().__init__(target_action, on_exit, **kwargs)


class OnProcessStart(Handler):
    """When a process was started."""

    def __init__(
        self, *, target_action: object = None, on_start: SomeActions, **kwargs: Any
    ) -> None:
        super().__init__(target_action, on_start, **kwargs)


class OnExecutionComplete(Handler):
    """When an action is complete: a process has ended."""

    def __init__(
        self, *, target_action: object = None, on_completion: SomeActions, **kwargs: Any
    ) -> None:
        super().__init__(target_action, on_completion, **kwargs)


class OnShutdown(Handler):
    """When the launch stops, before the first process is signalled."""

    def __init__(self, *, on_shutdown: SomeActions, **kwargs: Any) -> None:
        super().__init__(None, on_shutdown, **kwargs)


class OnLine(Handler):
    """When a process has written a line with a text: of launch_testing."""

    def __init__(self, *, target_action: object, text: str, actions: SomeActions) -> None:
        super().__init__(target_action, actions)
        self.text = text


class OnProcessIO(Handler):
    """When a process writes: ``on_stdout`` and ``on_stderr`` are called with each line."""

    def __init__(
        self,
        *,
        target_action: object = None,
        on_stdin: Function | None = None,
        on_stdout: Function | None = None,
        on_stderr: Function | None = None,
        **kwargs: Any,
    ) -> None:
        if on_stdin is not None:
            raise refusal('OnProcessIO(on_stdin=…) is not understood here')
        functions = [each for each in (on_stdout, on_stderr) if each is not None]
        super().__init__(target_action, functions[0] if functions else (), **kwargs)
        self.functions = functions
