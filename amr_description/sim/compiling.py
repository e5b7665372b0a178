# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What MuJoCo's compiler says, as lines of a log."""

from collections.abc import Iterator
from contextlib import contextmanager
import warnings

from amr_description.control.contracts import Log, Severity


def one_line(text: str) -> str:
    """MuJoCo's message without its line breaks and its leading ``Error:``."""
    return ' '.join(text.split()).removeprefix('Error: ')


@contextmanager
def compiler_warnings(log: Log, source: str) -> Iterator[None]:
    """Tell ``log`` in one line each what is warned of meanwhile; ``source``: of what."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always', UserWarning)
        yield
    for line in dict.fromkeys(one_line(str(warning.message)) for warning in caught):
        log(Severity.WARN, f'{source}: MuJoCo: {line}')
