# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a stack does when a node ends, or when it stops: functions of the user.

::

    diagnose = Node('diagnose', package='my_robot', start_when=on_request())

    def when_the_driver_ends(event: Exited) -> Node | Shutdown | None:
        if event.returncode == 3:
            return Shutdown('the battery is empty')
        return diagnose if event.returncode else None

    driver = Node('driver', package='my_robot', required=False, on_exit=when_the_driver_ends)

A node that a handler may start stands in the stack like every other, so that what is missing is
found before anything starts. Handlers are called by the supervisor: they must be quick.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from amr_description.bringup import user_errors, validation
from amr_description.bringup.conditions import Member, NodeRef


@dataclass(frozen=True)
class Exited:
    """A node has ended, and is not to be started again."""

    node: NodeRef
    returncode: int
    """Its exit code, or minus the number of the signal it died of."""
    last_lines: Sequence[str] = ()
    """What it wrote last."""


@dataclass(frozen=True)
class Stopping:
    """The stack stops; its processes are about to be told."""

    exit_code: int
    """That of the whole, as it is known now."""


_EXIT_CODE = validation.Validator(
    'a whole number from 0 to 255', lambda value: isinstance(value, int) and 0 <= value <= 255
)


@dataclass(frozen=True)
class Shutdown:
    """The wish of a handler that all be stopped."""

    reason: str
    exit_code: int = 0
    """That of the whole, 0 to 255."""

    def __post_init__(self) -> None:
        """Refuse what can be no exit code."""
        validation.require('Shutdown(%s)', self.reason, validation.TEXT)
        validation.require('Shutdown(…, exit_code=%s)', self.exit_code, _EXIT_CODE)


type Reaction = None | Shutdown | Member | Sequence[Member]
type ExitHandler = Callable[[Exited], Reaction]
type StopHandler = Callable[[Stopping], None]


@dataclass(frozen=True)
class HandlerResult:
    """What a handler wants."""

    members: Sequence[Member] = ()
    """To be started; each waits for :func:`conditions.on_request`."""
    shutdown: Shutdown | None = None


def call_exit_handler(handler: ExitHandler, event: Exited) -> HandlerResult:
    """Return what a handler wants; one that fails wants the stack to stop."""
    try:
        reaction = handler(event)
    except (Exception, SystemExit) as error:  # a stranger's must not end the supervisor
        return HandlerResult(shutdown=Shutdown(complaint('on_exit', error), exit_code=1))
    if reaction is None:
        return HandlerResult()
    if isinstance(reaction, Shutdown):
        return HandlerResult(shutdown=reaction)
    return HandlerResult(tuple(reaction) if isinstance(reaction, list | tuple) else (reaction,))


def complaint(name: str, error: BaseException) -> str:
    """Return one line on what a handler raised, and where."""
    return f'{name} failed: {user_errors.describe(error)}'
