# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The binary frames of samples: what came by a topic, little-endian, for the pages that show it. A
page that is slow gets the newest of each topic, and of ``values`` all, up to a bound.

::

    0  u8   2, the kind of the frame
    1  u8   0
    2  u16  bytes of the head: it ends at a multiple of 8 bytes
    4  …    the head: JSON, one of the types of ``Head``, filled up with spaces
    …       what the head says
"""

from collections.abc import Iterable
from dataclasses import dataclass
import struct

import numpy as np

from amr_description.viewer.encoding import encode
from amr_description.viewer.protocol import Channel, Head

SAMPLE_KIND = 2
HEAD_AT = 4
"""Bytes before the head of a sample."""
PLACE_FLOATS = 6
"""Of a place of contact: x y z (m), and the normal."""
MOST_POINTS = 20_000
"""Points of a cloud that are sent."""
WHOLE_POINTS = 1_000_000
"""… of one of ``Watch.whole``."""
_BEGINNING = struct.Struct('<BBH')
_ALIGNMENT = 8
_LONGEST_HEAD = 2**16 - 4


@dataclass(frozen=True, slots=True)
class Sample:
    """A frame for the pages that show a topic in this way."""

    topic: str
    frame: bytes
    channel: Channel = 'sensor'
    is_lasting: bool = False
    """Whether it is sent again only when it has changed, as a map is."""


def encode_sample(head: Head, parts: Iterable[np.ndarray | bytes] = ()) -> bytes:
    """
    Return the frame of a sample.

    Args:
        head: What it is.
        parts: What follows: float64, float32, uint8, or the bytes of a file.

    Raises:
        ValueError: The head is longer than 65532 bytes.
    """
    text = encode(head).encode()
    text += b' ' * (-(HEAD_AT + len(text)) % _ALIGNMENT)
    if len(text) > _LONGEST_HEAD:
        raise ValueError(f'a head of {len(text)} bytes is too long')
    after = [part if isinstance(part, bytes) else part.tobytes() for part in parts]
    return b''.join([_BEGINNING.pack(SAMPLE_KIND, 0, len(text)), text, *after])
