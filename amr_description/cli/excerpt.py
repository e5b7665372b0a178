# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What was typed, as an error line may repeat it."""

_MOST = 200  # characters
_TAIL = 60


def excerpt(text: str) -> str:
    """Return a text in one line, without its middle if it is very long."""
    line = ''.join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
    return line if len(line) <= _MOST else f'{line[: _MOST - _TAIL]} ... {line[-_TAIL:]}'
