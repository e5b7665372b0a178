# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The line protocol of the motor board: laws of its lines."""

from dataclasses import fields
import math
import re

from hypothesis import example, given, strategies as st
import pytest

from amr_description.errors import HardwareError
from amr_description.hardware import serial_protocol
from amr_description.hardware.serial_protocol import (
    Arm,
    Board,
    BoardMode,
    decode,
    Disarm,
    encode,
    Error,
    Get,
    GREATEST_VELOCITY,
    Hello,
    LineReader,
    LONGEST_LINE,
    LONGEST_WATCHDOG,
    Reason,
    Refused,
    Set,
    SHORTEST_WATCHDOG,
    State,
    VERSION,
)

DOC = serial_protocol.__doc__
U16 = st.integers(0, 2**16 - 1)
U32 = st.integers(0, 2**32 - 1)
I32 = st.integers(-(2**31), 2**31 - 1)
VELOCITIES = st.integers(-100_000_000, 100_000_000).map(lambda n: n / 10_000)  # of four digits
NAMES = st.from_regex('[A-Za-z0-9_-]{1,16}', fullmatch=True)
MESSAGES = st.one_of(
    st.builds(Hello, U16, U16),
    st.builds(Get, U16),
    st.builds(Arm, U16, U16),
    st.builds(Set, U16, VELOCITIES, VELOCITIES),
    st.builds(Disarm, U16),
    st.builds(Board, U16, U16, NAMES, U32, VELOCITIES),
    st.builds(State, U16, U32, I32, I32, VELOCITIES, VELOCITIES, st.sampled_from(BoardMode)),
    st.builds(Error, st.sampled_from(Reason)),
)
LONGEST = State(65535, 2**32 - 1, -(2**31), -(2**31), -10000.0, -10000.0, BoardMode.TIMEOUT)


def good(found):
    return [message for message in found if not isinstance(message, Refused)]


@given(MESSAGES)
@example(LONGEST)
def test_what_is_written_is_read(message):
    line = encode(message)
    assert len(line) <= LONGEST_LINE
    assert line.isascii()
    assert LineReader().feed(line) == [message]


@given(st.lists(MESSAGES, max_size=5), st.lists(st.integers(0, 300)))
def test_pieces_make_no_difference(messages, cuts):
    stream = b''.join(map(encode, messages))
    cuts = sorted(min(cut, len(stream)) for cut in cuts)
    reader = LineReader()
    pieces = (stream[a:b] for a, b in zip([0, *cuts], [*cuts, len(stream)], strict=True))
    assert [found for piece in pieces for found in reader.feed(piece)] == messages


@given(MESSAGES, st.data())
def test_a_line_with_one_wrong_byte_is_refused(message, data):
    line = bytearray(encode(message))
    position = data.draw(st.integers(0, len(line) - 1))
    line[position] = data.draw(st.integers(0, 255).filter(lambda byte: byte != line[position]))
    assert good(LineReader().feed(bytes(line) + encode(Get(7)))) in ([], [Get(7)])


@given(MESSAGES, st.data())
def test_a_line_that_is_cut_short_is_refused(message, data):
    line = encode(message)
    cut = data.draw(st.integers(0, len(line) - 2))
    assert good(LineReader().feed(line[:cut] + b'\n')) == []


@given(st.binary(max_size=300), MESSAGES)
def test_a_line_feed_always_starts_a_new_line(garbage, message):
    assert LineReader().feed(garbage + b'\n' + encode(message))[-1] == message


@given(st.binary(max_size=1000))
def test_every_line_of_noise_is_refused_by_name(noise):
    found = LineReader().feed(noise + b'\n')
    assert len(found) == sum(1 for line in noise.split(b'\n') if line)
    assert all(isinstance(line, Refused) for line in found)


def test_an_endless_line_takes_no_memory():
    reader = LineReader()
    for _ in range(1000):
        assert reader.feed(b'x' * 1000) == []
    assert len(reader._line) <= LONGEST_LINE
    assert reader.feed(b'\n') == [Refused(b'x' * LONGEST_LINE, Reason.CHECKSUM)]
    assert reader.feed(encode(Get(7))) == [Get(7)]


def framed(body):
    """A line whose CRC is right, whatever its words."""
    from binascii import crc_hqx

    return b'$%b*%04X' % (body, crc_hqx(body, 0xFFFF))


def test_the_crc_is_that_of_the_catalogue():
    assert framed(b'123456789') == b'$123456789*29B1'
    assert encode(Get(7)) == framed(b'GET,7') + b'\n'


@pytest.mark.parametrize(
    ('body', 'reason'),
    [
        (b'', Reason.MESSAGE),
        (b'get', Reason.MESSAGE),
        (b'GET', Reason.MESSAGE),
        (b'SET,1,1.0000', Reason.MESSAGE),
        (b'SET,1,1.0000,nan', Reason.MESSAGE),
        (b'SET,1,1.0000,inf', Reason.MESSAGE),
        (b'SET,1,1.0000,1e3', Reason.MESSAGE),
        (b'SET,1,1.0000,1', Reason.MESSAGE),
        (b'SET,1,1.0000,10000.0001', Reason.RANGE),
        (b'ARM,1,65536', Reason.RANGE),
        (b'ARM,1,-1', Reason.RANGE),
        (b'HELLO,1,', Reason.MESSAGE),
        (b'ERROR,WHATEVER', Reason.MESSAGE),
        (b'STATE,1,0,2147483648,0,0.0000,0.0000,IDLE', Reason.RANGE),
    ],
)
def test_a_line_without_a_meaning_is_refused(body, reason):
    assert decode(framed(body)) == Refused(framed(body), reason)


def test_nothing_is_read_into_a_lower_case_crc_or_a_carriage_return():
    line = next(framed(b'GET,%d' % n) for n in range(99) if framed(b'GET,%d' % n)[-1:].isalpha())
    assert decode(line) == Get(int(line[5:-5]))
    assert decode(line[:-4] + line[-4:].lower()).reason is Reason.CHECKSUM
    assert decode(line + b'\r').reason is Reason.CHECKSUM


def test_the_page_lists_every_line_with_its_fields():
    cells = re.findall('^``([A-Z<][^`]*)``(?:  |$)', DOC, re.MULTILINE)
    lines = '\n'.join(cells).replace('\n<', '<').splitlines()
    listed = {line.split(',')[0]: line.count('<') for line in lines}
    kinds = (Hello, Get, Arm, Set, Disarm, Board, State, Error)
    assert listed == {kind.__name__.upper(): len(fields(kind)) for kind in kinds}


def test_the_page_has_the_numbers_of_the_code():
    assert f'version {VERSION}.' in DOC
    assert f'at most {LONGEST_LINE} bytes' in DOC
    assert f'``watchdog``: {SHORTEST_WATCHDOG} to {LONGEST_WATCHDOG} ms' in DOC


def test_a_firmware_may_print_a_negative_zero():
    assert str(decode(framed(b'SET,1,-0.0000,0.0000')).left) == '0.0'
    assert encode(Set(1, -0.0, -0.00001)) == encode(Set(1, 0.0, 0.0))


@pytest.mark.parametrize(
    'value', [math.nan, math.inf, -math.inf, 1e300, math.nextafter(GREATEST_VELOCITY, math.inf)]
)
def test_what_is_not_finite_or_huge_is_not_written(value):
    with pytest.raises(HardwareError, match='rad/s is no field of a line; it must be finite and'):
        encode(Set(1, 0.0, value))


@pytest.mark.parametrize('message', [Hello(-1, 0), Hello(2**16, 0), Board(1, 1, 'a b', 1, 1.0)])
def test_what_has_no_place_in_a_line_is_not_written(message):
    with pytest.raises(HardwareError, match='is no field of a line; it must'):
        encode(message)
