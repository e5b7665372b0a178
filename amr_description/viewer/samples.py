# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The binary frames of sensors: a sample as ``web/src/protocol.ts`` defines it.

::

    0  u8 2 │ 1  u8 0 │ 2  u16 bytes of the head │ 4  head, JSON │ …  what it says

The head is filled up with spaces, so that what follows it is aligned to 4 bytes.
"""

from collections.abc import Iterable
from dataclasses import dataclass
import struct

import numpy as np

from amr_description.viewer.protocol import encode, Head

SAMPLE_KIND = 2
HEAD_AT = 4
"""Bytes before the head of a sample."""
PLACE_FLOATS = 6
"""Of a place of contact: x y z (m), and the normal."""
_BEGINNING = struct.Struct('<BBH')
_LONGEST_HEAD = 2**16 - 4


@dataclass(frozen=True, slots=True)
class Sample:
    """A frame for the pages that show a topic."""

    topic: str
    frame: bytes


def encode_sample(head: Head, parts: Iterable[np.ndarray | bytes] = ()) -> bytes:
    """
    Return the frame of a sample.

    Args:
        head: What it is.
        parts: What follows: float32, uint8, or the bytes of a file.

    Raises:
        ValueError: The head is longer than 65532 bytes.
    """
    text = encode(head).encode()
    text += b' ' * (-len(text) % 4)
    if len(text) > _LONGEST_HEAD:
        raise ValueError(f'a head of {len(text)} bytes is too long')
    after = [part if isinstance(part, bytes) else part.tobytes() for part in parts]
    return b''.join([_BEGINNING.pack(SAMPLE_KIND, 0, len(text)), text, *after])
