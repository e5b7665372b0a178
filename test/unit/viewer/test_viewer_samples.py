# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The binary frames of sensors: as the page reads them."""

import json
import struct

from hypothesis import given, strategies as st
import numpy as np
import pytest

from amr_description.viewer.protocol import Distance, Origin, Unreadable
from amr_description.viewer.samples import encode_sample


def parts_of(frame):
    """Head and rest of a frame."""
    kind, zero, size = struct.unpack_from('<BBH', frame)
    assert (kind, zero, size % 4) == (2, 0, 0)
    return json.loads(frame[4 : 4 + size]), frame[4 + size :]


@given(st.text(max_size=9))
def test_numbers_are_aligned_whatever_the_head(topic):
    head = Distance(Origin(topic, 'laser', 1.5, None), 0.1, 0.0, None)
    said, rest = parts_of(encode_sample(head, [np.array([np.inf, 2.0], '<f4'), b'abc']))
    assert (said['type'], said['origin']['topic'], said['max_range']) == ('range', topic, None)
    assert np.frombuffer(rest[:8], '<f4').tolist() == [np.inf, 2.0]
    assert rest[8:] == b'abc'


def test_a_head_is_of_bounded_length():
    with pytest.raises(ValueError, match='too long'):
        encode_sample(Unreadable(Origin('/a', '', 0.0, None), 'x' * 70_000))
