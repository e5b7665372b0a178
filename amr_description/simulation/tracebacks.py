# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Tracebacks of a test that one of our errors ends: they stop at the line of the test.

A module whose frames pytest is to leave out says ``__tracebackhide__ = is_for_the_test``. Anything
but an :class:`~amr_description.errors.AmrError` is a fault of ours, and is shown with all frames.
"""

from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

from amr_description.errors import AmrError

P = ParamSpec('P')
Result = TypeVar('Result')


def is_for_the_test(info: Any) -> bool:
    """Whether an error (``pytest.ExceptionInfo``) says all in its one line."""
    return info is not None and info.errisinstance(AmrError)


__tracebackhide__ = is_for_the_test


def without_frames(function: Callable[P, Result]) -> Callable[P, Result]:
    """Drop the frames below from an AmrError: also those of modules that are not of tests."""

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> Result:
        try:
            return function(*args, **kwargs)
        except AmrError as error:
            raise error.with_traceback(None)  # noqa: B904 - the same error

    return call
