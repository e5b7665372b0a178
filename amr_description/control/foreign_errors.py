# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a stranger's controller or hardware component raises, as one line."""

from amr_description.errors import AmrError


def describe(error: Exception) -> str:
    """Return the text of an error; one that was not raised on purpose begins with its type."""
    if isinstance(error, AmrError):
        return str(error)
    return f'{type(error).__name__}: {error}'
