# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Event handlers of a stack: the user's functions for the end of a node and of the whole stack.

::

    diagnose = Node('diagnose', package='my_robot', start_when=on_request())

    def on_driver_exit(event: Exited) -> Node | Shutdown | None:
        if event.returncode == 3:
            return Shutdown('the battery is empty')
        return diagnose if event.returncode else None

    driver = Node('driver', package='my_robot', required=False, on_exit=on_driver_exit)

A node that a handler starts is a member of the stack like every other, so that a missing
executable is found before anything starts. Handlers run on the supervisor's event loop: they must
return quickly.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, TypeVar

from amr_description.bringup import user_errors, validation
from amr_description.bringup.conditions import CONDITION, Condition, Member, NodeRef, StackState

T = TypeVar('T')

Level: TypeAlias = Literal['INFO', 'WARNING', 'ERROR']
"""The severity of a message, as launch writes it."""


@dataclass(frozen=True)
class Exited:
    """A node has ended and will not be respawned."""

    node: NodeRef
    returncode: int
    """Exit code, or minus the number of the signal that ended it."""
    last_lines: Sequence[str] = ()
    """The last lines of its output."""


@dataclass(frozen=True)
class Stopping:
    """The stack stops; no process has been signalled yet."""

    exit_code: int
    """The exit code of the bring-up, as far as it is known."""
    reason: str = ''
    """Why it stops; '': it has ended by itself."""


_EXIT_CODE = validation.Validator(
    'a whole number from 0 to 255', lambda value: isinstance(value, int) and 0 <= value <= 255
)


@dataclass(frozen=True)
class Shutdown:
    """Returned by a handler: stop the stack."""

    reason: str
    exit_code: int = 0
    """The exit code of the bring-up, 0 to 255."""

    def __post_init__(self) -> None:
        """Raise BringupError for a field of the wrong type."""
        validation.require('Shutdown(%s)', self.reason, validation.TEXT)
        validation.require('Shutdown(…, exit_code=%s)', self.exit_code, _EXIT_CODE)


@dataclass(frozen=True)
class Log:
    """Returned by a handler: write a line into the log of the bring-up."""

    text: str
    level: Level = 'INFO'


Reaction: TypeAlias = None | Shutdown | Log | Member | Sequence[Log | Shutdown | Member]
ExitHandler: TypeAlias = Callable[[Exited], Reaction]
StopHandler: TypeAlias = Callable[[Stopping], Log | Sequence[Log] | None]
LineHandler: TypeAlias = Callable[[str], Reaction]
StateHandler: TypeAlias = Callable[[StackState], Reaction]


@dataclass(frozen=True, eq=False)
class EventHandler:
    """A function that is called once, as soon as a condition holds."""

    when: Condition
    run: StateHandler
    text: str = ''
    """What it does, for ``--print``."""

    def __post_init__(self) -> None:
        """Raise BringupError for a field of the wrong type."""
        validation.require('EventHandler(%s, …)', self.when, CONDITION)
        validation.require('EventHandler(…, %s)', self.run, validation.FUNCTION)


@dataclass(frozen=True)
class HandlerResult:
    """What the scheduler does about the return value of an exit handler."""

    members: Sequence[Member] = ()
    """What to start; the condition of each node contains :func:`.on_request`."""
    shutdown: Shutdown | None = None
    lines: Sequence[Log] = ()


def call_handler(name: str, handler: Callable[[T], Reaction], event: T) -> HandlerResult:
    """
    Call a handler; if it raises, the stack is to stop with exit code 1.

    Args:
        name: what the handler was given for, for the message.
        handler: the function.
        event: its argument.
    """
    try:
        reaction = handler(event)
    except (Exception, SystemExit) as error:  # the user's code must not end the supervisor
        return HandlerResult(shutdown=Shutdown(describe_failure(name, error), exit_code=1))
    if reaction is None:
        return HandlerResult()
    parts = _parts(reaction)
    return HandlerResult(
        members=tuple(each for each in parts if not isinstance(each, Shutdown | Log)),
        shutdown=next((each for each in parts if isinstance(each, Shutdown)), None),
        lines=tuple(lines_of(reaction)),
    )


def lines_of(returned: object) -> list[Log]:
    """Return the lines in what a handler has returned, whatever else that is."""
    return [each for each in _parts(returned) if isinstance(each, Log)]


def _parts(returned: object) -> list[Any]:
    return [*returned] if isinstance(returned, list | tuple) else [returned]


def describe_failure(name: str, error: BaseException) -> str:
    """Return one line about the exception of the handler ``name``, with its location."""
    return f'{name} failed: {user_errors.describe(error)}'
