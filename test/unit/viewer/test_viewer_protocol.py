# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What page and node say to each other, as frames."""

from dataclasses import fields
import json
import math

from hypothesis import given, strategies as st
import pytest

from amr_description.errors import ProtocolError
from amr_description.viewer import protocol, requests
from amr_description.viewer.encoding import encode
from amr_description.viewer.requests import decode

ONE = '{"type": "drive", "robot": "/", "linear": 0.5, "angular": 0}'


def test_a_message_is_json_with_its_type():
    frame = encode(protocol.Driver('/', None, 'page 1'))
    assert json.loads(frame) == {
        'type': 'driver', 'robot': '/', 'client': None, 'stopped': 'page 1'
    }  # fmt: skip


def test_what_is_no_number_is_null_for_the_page():
    status = protocol.SimulationStatus('/sim', 'playing', math.nan, 1.0, math.inf)
    read = json.loads(encode(status))
    assert (read['time'], read['factor'], read['real_factor']) == (None, 1.0, None)


def test_a_drive_is_read():
    assert decode(ONE) == requests.Drive('/', 0.5, 0.0)


def test_a_spawn_is_read():
    frame = {
        'type': 'spawn', 'id': 3, 'simulator': '/sim', 'name': 'a', 'namespace': '/a',
        'position': [1, 2.5, 0], 'yaw': 0.1, 'like': '/',
    }  # fmt: skip
    read = decode(json.dumps(frame))
    assert read == requests.Spawn(3, '/sim', 'a', '/a', (1.0, 2.5, 0.0), 0.1, '/')


def test_what_a_page_watches_is_read():
    assert decode('{"type": "watch", "parts": ["wheels"]}') == requests.Watch(('wheels',))
    assert decode('{"type": "watch", "parts": []}') == requests.Watch(())
    frame = '{"type": "watch", "parts": [], "topics": ["/scan", "/front/scan"]}'
    assert decode(frame) == requests.Watch((), ('/scan', '/front/scan'))


def test_play_and_pause_are_told_apart():
    assert [decode(f'{{"type": "{kind}", "id": 1, "simulator": "/s"}}').type
            for kind in ('play', 'pause')] == ['play', 'pause']  # fmt: skip


@pytest.mark.parametrize(
    ('frame', 'text'),
    [
        ('', 'is no JSON'),
        ('{', 'is no JSON'),
        ('[' * 100_000, 'is no JSON'),
        ('null', 'of type None is not known; there are: drive, stop'),
        ('[]', 'of type None is not known'),
        ('{"type": ["drive"]}', r"of type \['drive'\] is not known"),
        ('{"type": "fly"}', 'of type "fly" is not known'),
        ('{"type": "drive", "robot": "/"}', "'drive' lacks 'linear'"),
        (ONE.replace('0.5', '"fast"'), "'linear' of 'drive' cannot be \"fast\""),
        (ONE.replace('0.5', 'NaN'), "'linear' of 'drive' cannot be nan"),
        (ONE.replace('0.5', '1e999'), "'linear' of 'drive' cannot be inf"),
        (ONE.replace('0.5', '-101'), "'linear' of 'drive' cannot be -101"),
        (ONE.replace('0.5', '1' + '0' * 400), "'linear' of 'drive' cannot be 1000"),
        (ONE.replace('0.5', '9' * 400), "'linear' of 'drive' cannot be 999"),
        (ONE.replace('0.5', 'true'), "'linear' of 'drive' cannot be True"),
        (ONE.replace('"/"', '"\\u001b[2J"'), "'robot' of 'drive' cannot be"),
        ('{"type": "step", "id": 1, "simulator": "/s", "steps": -1}', "'steps' .* cannot be -1"),
        ('{"type": "step", "id": 1.5, "simulator": "/s", "steps": 1}', "'id' .* cannot be 1.5"),
        ('{"type": "set_joints", "robot": "/", "positions": {"a": null}}', "'positions' of"),
        ('{"type": "stop", "robot": 1}', "'robot' of 'stop' cannot be 1"),
        ('{"type": "watch"}', "'watch' lacks 'parts'"),
        ('{"type": "watch", "parts": "wheels"}', "'parts' of 'watch' cannot be \"wheels\""),
        ('{"type": "watch", "parts": ["wheels", "sky"]}', r"cannot be \['wheels', 'sky'\]"),
        ('{"type": "watch", "parts": [["wheels"]]}', r"cannot be \[\['wheels'\]\]"),
        ('{"type": "watch", "parts": [], "topics": [1]}', r"'topics' of 'watch' cannot be \[1\]"),
    ],
)
def test_what_cannot_be_understood_is_refused_in_one_line(frame, text):
    with pytest.raises(ProtocolError, match=text) as error:
        decode(frame)
    assert '\n' not in str(error.value)
    assert len(str(error.value)) < 450


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=6,
)
NAMES = [name for message in requests.MESSAGES for name in message.types]
FIELDS = sorted({f.name for message in requests.MESSAGES for f in fields(message)})


@given(st.sampled_from(NAMES), st.dictionaries(st.sampled_from(FIELDS), JSON))
def test_any_frame_is_a_message_or_a_protocol_error(kind, found):
    try:
        read = decode(json.dumps({**found, 'type': kind}))
    except ProtocolError:
        return
    assert kind in read.types


@pytest.mark.parametrize(
    ('frame', 'is_right'),
    [
        ({'type': 'set_factor', 'id': 1, 'simulator': '/s', 'factor': -1.0}, True),
        ({'type': 'set_factor', 'id': 1, 'simulator': '/s', 'factor': 1e6}, True),
        ({'type': 'drive', 'robot': '/', 'linear': 99.0, 'angular': -99.0}, True),
        ({'type': 'drive', 'robot': '/', 'linear': 101.0, 'angular': 0.0}, False),
        ({'type': 'stop', 'robot': 'two\nlines'}, False),
    ],
)
def test_only_what_has_a_limit_is_limited(frame, is_right):
    """A speed and a rate are numbers, and each has a reader of its own."""
    if is_right:
        decode(json.dumps(frame))
        return
    with pytest.raises(ProtocolError, match='cannot be'):
        decode(json.dumps(frame))
