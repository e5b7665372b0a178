# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Decorators of test files."""

from collections.abc import Callable, Iterable, Iterator
import functools
import threading
from typing import Any, TypeVar

C = TypeVar('C', bound=type)
F = TypeVar('F', bound=Callable[..., Any])

PARAMETERS = 'launch_testing_parameters'
POST_SHUTDOWN = 'launch_testing_post_shutdown'
KEEP_ALIVE = 'launch_testing_keep_alive'
START_TIMEOUT = 'launch_testing_start_timeout'
"""Attributes by which decorators mark functions and classes."""


def keep_alive(function: F) -> F:
    """Have the launch go on when all processes have ended, until the tests are over."""
    setattr(function, KEEP_ALIVE, True)
    return function


def post_shutdown_test() -> Callable[[C], C]:
    """Have the tests of a class run when all processes have ended."""

    def mark(item: C) -> C:
        if not isinstance(item, type):
            raise TypeError(f'post_shutdown_test marks classes, and no {type(item).__name__}')
        setattr(item, POST_SHUTDOWN, True)
        return item

    return mark


def ready_to_test_action_timeout(timeout: float) -> Callable[[F], F]:
    """Have ReadyToTest come within this time, s, in place of 15."""

    def mark(function: F) -> F:
        setattr(function, START_TIMEOUT, timeout)
        return function

    return mark


def parametrize(argnames: str, argvalues: Iterable[Any]) -> Callable[[F], F]:
    """
    Have the description made, and run, once for each value.

    Args:
        argnames: Arguments of the function, as 'a' or 'a, b'.
        argvalues: A value for each run; with more names than one, tuples of them.
    """
    names = [name.strip() for name in argnames.split(',') if name.strip()]
    values = [each if isinstance(each, tuple) else (each,) for each in argvalues]

    def mark(function: F) -> F:
        setattr(function, PARAMETERS, [dict(zip(names, each, strict=True)) for each in values])
        return function

    return mark


def runs_of(function: Callable[..., Any]) -> Iterator[tuple[Callable[..., Any], dict[str, Any]]]:
    """Yield a description's function for each of its runs, with the arguments that it has then."""
    for arguments in getattr(function, PARAMETERS, [{}]):
        bound = functools.partial(function, **arguments)
        yield functools.update_wrapper(bound, function), arguments


class ReadyAggregator:
    """Calls a function once it was called itself a number of times, by whatever threads."""

    def __init__(self, ready_fn: Callable[[], object], num_to_aggregate: int) -> None:
        self._ready = ready_fn
        self._left = num_to_aggregate
        self._lock = threading.Lock()

    def ready_fn(self) -> None:
        """Count down."""
        with self._lock:
            self._left -= 1
            is_last = self._left == 0
        if is_last:
            self._ready()
