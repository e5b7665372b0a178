# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Keys out of what terminals send: characters, sequences, reports of the kitty protocol."""

from hypothesis import example, given, strategies as st
import pytest

from amr_description.nodes.teleop_twist_keyboard.keys import MOVES, SPEEDS
from amr_description.terminal import CTRL_C, CTRL_Z, KeyEvent, KeyParser

BOUND = {*MOVES, *SPEEDS}


def keys(text):
    return [event.key for event in KeyParser().feed(text)]


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('iu,<', ['i', 'u', ',', '<']),
        ('\x1b[Ai', ['\x1b[A', 'i']),  # an arrow
        ('\x1bOPi', ['\x1bOP', 'i']),  # F1
        ('\x1b[15~\x1b[1;5Ci', ['\x1b[15~', '\x1b[1;5C', 'i']),
        ('ü', ['ü']),
    ],
)
def test_an_ordinary_terminal(text, expected):
    assert keys(text) == expected


# What kitty sends with all flags set, on a US keyboard unless said.
@pytest.mark.parametrize(
    ('report', 'event'),
    [
        ('\x1b[105;;105u', KeyEvent('i', 'i')),
        ('\x1b[105;1:1;105u', KeyEvent('i', 'i')),
        ('\x1b[105;1:2;105u', KeyEvent('i', 'i')),  # a repetition
        ('\x1b[105;1:3u', KeyEvent('i', 'i', is_release=True)),
        ('\x1b[105u', KeyEvent('i', 'i')),
        ('\x1b[105:73;2;73u', KeyEvent('I', 'i')),
        ('\x1b[105:73;2:3u', KeyEvent('I', 'i', is_release=True)),
        ('\x1b[44:60;2;60u', KeyEvent('<', ',')),
        ('\x1b[44;2u', KeyEvent('<', ',')),  # of a terminal that tells no text
        ('\x1b[46;2u', KeyEvent('>', '.')),
        ('\x1b[105;65;73u', KeyEvent('I', 'i')),  # Caps Lock
        ('\x1b[105;65u', KeyEvent('I', 'i')),
        ('\x1b[105;66u', KeyEvent('i', 'i')),  # Caps Lock and Shift
        ('\x1b[105;129;105u', KeyEvent('i', 'i')),  # Num Lock
        ('\x1b[60;;60u', KeyEvent('<', '<')),  # a key of its own on a German keyboard
        ('\x1b[1096::105;;1096u', KeyEvent('i', 'ш')),  # where i is, on a Russian keyboard
        ('\x1b[1096:1064:105;2;1064u', KeyEvent('I', 'ш')),
        ('\x1b[99;5u', KeyEvent(CTRL_C, 'c')),
        ('\x1b[1089::99;5u', KeyEvent(CTRL_C, 'с')),  # noqa: RUF001 (a Cyrillic letter)
        ('\x1b[122;5u', KeyEvent(CTRL_Z, 'z')),
        ('\x1b[99;133u', KeyEvent(CTRL_C, 'c')),  # with Num Lock
        ('\x1b[27u', KeyEvent('\x1b', '\x1b')),
        ('\x1b[1;1:3A', KeyEvent('\x1b[1;1:3A', '1A', is_release=True)),
        ('\x1b[3;1:3~', KeyEvent('\x1b[3;1:3~', '3~', is_release=True)),
    ],
)  # fmt: skip
def test_a_report(report, event):
    assert KeyParser().feed(report) == [event]


@pytest.mark.parametrize(
    'report',
    [
        '\x1b[105;5u',  # Ctrl-I is no i
        '\x1b[105;3u',  # nor is Alt-I
        '\x1b[106;9u',  # nor Super-J
        '\x1b[99;6u',  # Ctrl-Shift-C copies, and ends nothing
        '\x1b[57427;;u',  # the keypad
        '\x1b[0;;105:106u',  # what an input method has composed
    ],
)
def test_a_report_of_anything_else_is_one_key_without_a_meaning(report):
    (event,) = KeyParser().feed(report)
    assert event.key not in BOUND | {CTRL_C, CTRL_Z}
    assert not event.is_release


@pytest.mark.parametrize('code', [57358, 57360, 57441, 57447, 57454])
@pytest.mark.parametrize('event', ['', ';2:1', ';2:3'])
def test_shift_and_the_like_are_no_keys(code, event):
    assert KeyParser().feed(f'\x1b[{code}{event}u') == []


def test_the_answers_of_the_terminal_are_no_keys():
    parser = KeyParser()
    assert not parser.offers_releases
    assert parser.feed('i\x1b[?0u\x1b[?62;4ci') == [KeyEvent('i', 'i')] * 2
    assert parser.offers_releases
    assert parser.identities == 1


def test_a_terminal_without_the_protocol_answers_with_its_identity_only():
    parser = KeyParser()
    parser.feed('\x1b[?1;2c')
    assert (parser.offers_releases, parser.identities) == (False, 1)


TOKENS = ['i', 'u', 'ü', '\x1b[A', '\x1bOP', '\x1b[105;1:3u', '\x1b[44:60;2;60u', '\x1b[?0u']


@given(st.lists(st.sampled_from(TOKENS)), st.lists(st.integers(0, 60)))
@example(['\x1b[105;1:3u'], [9])  # "3u": u would drive
def test_it_does_not_matter_where_the_network_cuts(tokens, cuts):
    text = ''.join(tokens)
    parser = KeyParser()
    places = sorted({0, len(text), *(cut for cut in cuts if cut < len(text))})
    pieces = [text[a:b] for a, b in zip(places, places[1:], strict=False)]
    events = [event for piece in pieces for event in parser.feed(piece)]
    assert events == KeyParser().feed(text)


@given(st.text(st.sampled_from('\x1b[]O;:?019uA~ciü\x03\udcff')))
def test_garbage_is_survived(text):
    parser = KeyParser()
    parser.feed(text)
    parser.flush()
    assert not parser.has_escape


@given(st.integers(0, 10**12), st.integers(0, 10**12), st.integers(0, 10**12))
def test_numbers_of_any_size_are_survived(code, modifiers, text):
    assert len(KeyParser().feed(f'\x1b[{code};{modifiers};{text}u')) <= 1


def test_the_key_escape_is_told_once_nothing_follows():
    parser = KeyParser()
    assert parser.feed('i\x1b') == [KeyEvent('i', 'i')]
    assert parser.has_escape
    assert parser.flush() == [KeyEvent('\x1b', '\x1b')]
    assert not parser.has_escape
    assert parser.feed('i') == [KeyEvent('i', 'i')]


def test_with_the_protocol_an_escape_is_always_a_beginning():
    parser = KeyParser()
    parser.feed('\x1b[?0u\x1b')
    assert not parser.has_escape
    assert parser.feed('[105;1:3u') == [KeyEvent('i', 'i', is_release=True)]
