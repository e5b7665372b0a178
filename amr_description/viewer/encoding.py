# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The text frames of messages to pages."""

from dataclasses import asdict, fields
from functools import cache
import json
import math
from typing import Any

from amr_description.viewer.protocol import Head, ServerMessage


def encode(message: ServerMessage | Head) -> str:
    """Return the text frame of a message; NaN and infinity become null."""
    try:
        return _encode({'type': message.type, **_members(message)})
    except ValueError:  # from a third-party message; JSON has neither NaN nor infinity
        return _encode(_finite({'type': message.type, **asdict(message)}))


def _members(value: Any) -> dict[str, Any]:
    """Return the fields of a dataclass, in a third of the time of ``asdict``, which copies all."""
    kind: type = type(value)
    return {name: getattr(value, name) for name in _names(kind)}


@cache
def _names(kind: type) -> tuple[str, ...]:
    return tuple(each.name for each in fields(kind))


_encode = json.JSONEncoder(default=_members, allow_nan=False, separators=(',', ':')).encode


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(each) for each in value]
    return value
