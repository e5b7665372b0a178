# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What page and node say to each other: both sides of web/src/protocol.ts are the same."""

from dataclasses import fields, MISSING
import json
import math
import re
import types
import typing

from hypothesis import given, strategies as st
import pytest
from support.paths import ROOT

from amr_description.errors import ProtocolError
from amr_description.viewer import protocol, requests, samples, states
from amr_description.viewer.requests import decode

TEXT = (ROOT / 'web' / 'src' / 'protocol.ts').read_text(encoding='utf-8')
CODE = re.sub(r'/\*.*?\*/|//[^\n]*', '', TEXT, flags=re.DOTALL)
INTERFACES = dict(re.findall(r'export interface (\w+) \{(.*?)\n\}', CODE, re.DOTALL))
ONE = '{"type": "drive", "robot": "/", "linear": 0.5, "angular": 0}'


def members(body):
    """Name → type of the members of a TypeScript object type, those of the first level."""
    found, depth, part = {}, 0, ''
    for character in body + ';':
        depth += (character in '{[<(') - (character in '}]>)')
        if character == ';' and depth == 0:
            name, _, kind = part.partition(':')
            if kind:
                found[name.strip()] = ' '.join(kind.split())
            part = ''
        else:
            part += character
    return found


def members_of(name):
    return members(INTERFACES[name])


def parts_of(kind):
    """The dataclasses that a field may hold."""
    if isinstance(kind, typing.TypeAliasType):
        kind = kind.__value__
    arguments = typing.get_args(kind)
    return [part for each in arguments for part in parts_of(each)] or [kind]


def script(kind):
    """A Python type as TypeScript has it; a dataclass is 'object'."""
    if isinstance(kind, typing.TypeAliasType):
        return 'number' if kind is requests.Speed else kind.__name__
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Literal:
        return ' | '.join(f"'{each}'" for each in arguments)
    if isinstance(kind, types.UnionType):
        return ' | '.join(script(each) for each in arguments)
    if origin is tuple and arguments[1:] == (...,):
        inner = script(arguments[0])
        return f'({inner})[]' if '|' in inner else f'{inner}[]'
    if origin in (dict, typing.get_origin(typing.Mapping[str, str])):
        return f'Record<{script(arguments[0])}, {script(arguments[1])}>'
    names = {str: 'string', float: 'number', int: 'number', bool: 'boolean', type(None): 'null'}
    return names.get(kind, 'object')


def comparable(kind):
    """A TypeScript type in which what is written out is 'object', as a named one is."""
    kind = re.sub(r'\{.*\}', 'object', kind)
    return re.sub('|'.join(INTERFACES), 'object', kind)


SAID = {name: getattr(protocol, name) for name in INTERFACES if hasattr(protocol, name)}
HEARD = {name: getattr(requests, name) for name in ('Drive', 'Stop', 'SetJoints', 'Watch')}
REQUESTS = [
    members(body)
    for body in re.findall(
        r'\| \{(.*?)\}(?=\s*[|;])',
        re.search(r'type Request =(.*?)export type', CODE, re.DOTALL)[1],
        re.DOTALL,
    )
]


def test_every_message_of_the_page_is_known_here():
    assert INTERFACES.keys() == SAID.keys() | HEARD.keys()
    union = re.search(r'type ServerMessage =(.*?);', CODE, re.DOTALL)[1]
    here = {each.__name__ for each in protocol.ServerMessage.__value__.__args__}
    assert {name.strip() for name in union.split('|')} - {''} == here


@pytest.mark.parametrize('name', SAID)
def test_what_is_said_has_the_fields_that_the_page_reads(name):
    message, there = SAID[name], members_of(name)
    kind = there.pop('type', None)
    assert kind == (f"'{message.type}'" if hasattr(message, 'type') else None)
    assert {f.name: script(f.type) for f in fields(message)} == {
        key: comparable(value) for key, value in there.items()
    }


def test_parts_that_the_page_writes_in_place_have_its_fields():
    places = {
        ('RobotInfo', 'command'): protocol.Command,
        ('Layout', 'frames'): protocol.FrameInfo,
        ('Layout', 'robots'): protocol.RobotLayout,
        ('Controllers', 'controllers'): protocol.ControllerInfo,
        ('Controllers', 'hardware'): protocol.HardwareComponentInfo,
        ('Diagnostics', 'items'): protocol.DiagnosticItem,
    }
    for (name, member), part in places.items():
        inside = re.search(r'\{(.*)\}', members_of(name)[member])[1]
        here = {f.name: script(f.type) for f in fields(part)}
        assert members(inside) == here, (name, member)
        (field,) = (f for f in fields(SAID[name]) if f.name == member)
        assert part in parts_of(field.type)


@pytest.mark.parametrize('name', HEARD)
def test_what_is_heard_has_the_fields_that_the_page_writes(name):
    there = members_of(name)
    assert there.pop('type') == ' | '.join(f"'{each}'" for each in HEARD[name].types)
    optional = {f.name: '' if f.default is MISSING else '?' for f in fields(HEARD[name])}
    assert {f'{f.name}{optional[f.name]}': script(f.type) for f in fields(HEARD[name])} == there


def test_requests_have_the_fields_that_the_page_writes():
    there = {each.pop('type'): each for each in REQUESTS}
    here = {
        ' | '.join(f"'{each}'" for each in request.types): {
            f.name: script(f.type) for f in fields(request) if f.name != 'type'
        }
        for request in requests.REQUESTS
    }
    assert here == there


def test_constants_are_the_same():
    there = dict(re.findall(r'export const (\w+) = ([^;]+);', CODE))
    assert there.pop('PROTOCOL') == f"'{protocol.SUBPROTOCOL}'"
    assert {name: int(value) for name, value in there.items()} == {
        'HEADER_BYTES': states.HEADER.size,
        'POSE_FLOATS': states.POSE_FLOATS,
        'JOINT_FLOATS': states.JOINT_FLOATS,
        'MOTION_FLOATS': states.MOTION_FLOATS,
        'COMMAND_FLOATS': states.COMMAND_FLOATS,
        'WHEEL_FLOATS': states.WHEEL_FLOATS,
        'SAMPLE_KIND': samples.SAMPLE_KIND,
        'HEAD_AT': samples.HEAD_AT,
        'PLACE_FLOATS': samples.PLACE_FLOATS,
    }


def test_a_message_is_json_with_its_type():
    frame = protocol.encode(protocol.Driver('/', None, 'page 1'))
    assert json.loads(frame) == {
        'type': 'driver', 'robot': '/', 'client': None, 'stopped': 'page 1'
    }  # fmt: skip


def test_what_is_no_number_is_null_for_the_page():
    status = protocol.SimulationStatus('/sim', 'playing', math.nan, 1.0, math.inf)
    read = json.loads(protocol.encode(status))
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
    assert len(str(error.value)) < 300


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
