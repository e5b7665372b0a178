# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which velocity command goes on, by the rules of twist_mux; no ROS here."""

from hypothesis import given, strategies as st
import pytest
from support.paths import ROOT
import yaml

from amr_description.errors import ParameterError
from amr_description.navigation.twist_mux import Channel, MuxSettings, read_settings, TwistMux
from amr_description.parameter_files import dotted, flatten

SECOND = 1_000_000_000
NAVIGATION = Channel('topics.navigation', 'cmd_vel', SECOND // 2, 10)
TELEOP = Channel('topics.teleop', 'cmd_vel_teleop', SECOND // 2, 100)
STOP = Channel('locks.stop', 'emergency_stop', 0, 255)
WATCHED = Channel('locks.watched', 'heartbeat', SECOND, 50)


def values(text):
    """Return the parameters of a table in YAML, by dotted name."""
    return {dotted(keys): value for keys, value in flatten(yaml.safe_load(text))}


GOOD = """
topics:
  navigation: {topic: cmd_vel, timeout: 0.5, priority: 10}
  teleop: {topic: cmd_vel_teleop, timeout: 0.5, priority: 100}
locks:
  stop: {topic: emergency_stop, timeout: 0.0, priority: 255}
use_stamped: true
"""


def test_a_command_goes_on_while_no_input_of_higher_priority_commands():
    mux = TwistMux([NAVIGATION, TELEOP], [])
    assert mux.hear_command('topics.navigation', 10 * SECOND)
    assert mux.hear_command('topics.teleop', 10 * SECOND)
    assert not mux.hear_command('topics.navigation', 10 * SECOND + NAVIGATION.timeout)
    assert mux.hear_command('topics.navigation', 10 * SECOND + TELEOP.timeout + 1)


def test_of_equal_priorities_the_first_by_name_wins():
    left, right = (Channel(f'topics.{name}', name, SECOND, 7) for name in ('a', 'b'))
    mux = TwistMux([right, left], [])
    assert mux.hear_command('topics.b', 0)
    assert mux.hear_command('topics.a', 0)
    assert not mux.hear_command('topics.b', 1)


def test_priority_0_never_wins():
    mux = TwistMux([Channel('topics.a', 'a', 0, 0)], [])
    assert not mux.hear_command('topics.a', 0)


def test_without_a_timeout_one_command_masks_those_below_for_good():
    mux = TwistMux([NAVIGATION, Channel('topics.joy', 'joy', 0, 20)], [])
    assert mux.hear_command('topics.navigation', 0)  # the original would wait for joy already
    assert mux.hear_command('topics.joy', 0)
    assert not mux.hear_command('topics.navigation', 10**6 * SECOND)


@pytest.mark.parametrize('now', [0, 1, NAVIGATION.timeout, 100 * SECOND])
def test_what_was_never_heard_has_expired_at_any_time(now):
    mux = TwistMux([NAVIGATION, TELEOP], [])
    assert mux.is_masked('topics.teleop', now)
    assert mux.hear_command('topics.navigation', now)


def test_after_a_reset_of_the_clock_what_was_heard_before_has_expired():
    mux = TwistMux([NAVIGATION, TELEOP], [WATCHED])
    mux.hear_lock('locks.watched', False, 100 * SECOND)
    assert mux.hear_command('topics.teleop', 100 * SECOND)
    assert not mux.is_locked('locks.watched', 100 * SECOND)
    assert mux.is_masked('topics.teleop', 0)
    assert mux.is_locked('locks.watched', 0)


def test_a_lock_masks_what_has_less_than_its_priority():
    mux = TwistMux([NAVIGATION, TELEOP], [Channel('locks.a', 'a', 0, 100)])
    assert mux.lock_priority(0) == 0  # without a timeout it is free until it is told otherwise
    mux.hear_lock('locks.a', True, 0)
    assert mux.lock_priority(0) == 100
    assert not mux.hear_command('topics.navigation', 0)
    assert mux.hear_command('topics.teleop', 0)
    mux.hear_lock('locks.a', False, 0)
    assert mux.hear_command('topics.navigation', SECOND)


def test_a_lock_with_a_timeout_is_locked_while_its_publisher_is_silent():
    mux = TwistMux([NAVIGATION, TELEOP], [WATCHED])
    assert mux.is_locked('locks.watched', 0)
    assert not mux.hear_command('topics.navigation', 0)
    mux.hear_lock('locks.watched', False, 0)
    assert mux.hear_command('topics.navigation', WATCHED.timeout)
    assert not mux.hear_command('topics.navigation', WATCHED.timeout + 1)
    assert mux.hear_command('topics.teleop', WATCHED.timeout + 1)


CHANNELS = st.builds(
    lambda timeout, priority: (timeout, priority), st.integers(0, 5), st.integers(0, 4)
)
EVENTS = st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3), st.booleans()), max_size=40)


@given(st.lists(CHANNELS, min_size=1, max_size=4), st.lists(CHANNELS, max_size=2), EVENTS)
def test_only_a_fresh_command_that_outranks_all_fresh_ones_and_no_lock_goes_on(
    inputs, locks, events
):
    channels = [Channel(f'topics.{i}', f't{i}', *each) for i, each in enumerate(inputs)]
    stops = [Channel(f'locks.{i}', f'l{i}', *each) for i, each in enumerate(locks)]
    mux = TwistMux(channels, stops)
    heard, flags, now = {}, {}, 0
    for step, index, is_true in events:
        now += step
        if is_true and index < len(stops):
            flags[index] = (now, is_true)
            mux.hear_lock(stops[index].name, is_true, now)
        channel = channels[index % len(channels)]
        heard[channel.name] = now
        goes_on = mux.hear_command(channel.name, now)

        barrier = max(
            (
                each.priority
                for i, each in enumerate(stops)
                if i in flags or each.timeout > 0  # no lock is ever told that it is free
            ),
            default=0,
        )
        fresh = [
            each
            for each in channels
            if each.name in heard and (not each.timeout or now - heard[each.name] <= each.timeout)
        ]
        rivals = [each for each in fresh if each.priority >= barrier]
        best = min(rivals, key=lambda each: (-each.priority, each.name), default=None)
        assert goes_on == (best is channel and channel.priority > 0)


def test_a_file_is_read():
    found = read_settings(values(GOOD))
    assert found == MuxSettings((NAVIGATION, TELEOP), (STOP,), ())


def test_the_shipped_file_is_without_remarks():
    content = yaml.safe_load((ROOT / 'config' / 'twist_mux.yaml').read_text(encoding='utf-8'))
    [section] = content.values()
    given = {dotted(keys): value for keys, value in flatten(section['ros__parameters'])}
    found = read_settings(given)
    assert [each.topic for each in found.inputs] == ['cmd_vel', 'cmd_vel_teleop']
    assert [each.topic for each in found.locks] == ['emergency_stop']
    assert found.locks[0].priority > max(each.priority for each in found.inputs)
    assert found.remarks == ()


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        (
            '{topics: {a: {topic: x, priority: 1}}}',
            "could not load parameter 'topics.a.timeout': each of topics and locks has a topic, a "
            'timeout (s) and a priority (0 to 255)',
        ),
        (
            '{locks: {a: {topic: x, timeout: 0.0, prioritiy: 1}}}',
            "could not load parameter 'locks.a.priority', found locks.a.prioritiy: each of topics "
            'and locks has a topic, a timeout (s) and a priority (0 to 255)',
        ),
        (
            '{topics: {topic: x, timeout: 0.5, priority: 1}}',
            "parameter 'topics' holds a table for each name, topics: {NAME: {topic: …, timeout: "
            '…, priority: …}}, found topics.priority, topics.timeout, topics.topic',
        ),
        (
            '{topics: {a: {topic: x, timeout: "0.5", priority: 1}}}',
            "parameter 'topics.a.timeout' must be of type double, found '0.5', a string; write "
            '0.5, without quotes',
        ),
        (
            '{topics: {a: {topic: x, timeout: -1.0, priority: 1}}}',
            "parameter 'topics.a.timeout' must be at least 0, found -1.0 s",
        ),
        (
            '{topics: {a: {topic: x, timeout: .nan, priority: 1}}}',
            "parameter 'topics.a.timeout' must be a finite number, found nan s",
        ),
        (
            '{topics: {a: {topic: "", timeout: 1.0, priority: 1}}}',
            "parameter 'topics.a.topic' must not be empty, found ''",
        ),
        (
            '{topics: {a: {topic: x, timeout: 1.0, priority: high}}}',
            "parameter 'topics.a.priority' must be of type integer, found 'high', a string",
        ),
    ],
)
def test_a_faulty_file_gets_one_line(text, line):
    with pytest.raises(ParameterError) as error:
        read_settings(values(text))
    assert str(error.value).strip() == line.strip()


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        ('{}', 'no topics are given, so nothing goes on to cmd_vel_out'),
        (
            '{topics: {a: {topic: x, timeout: 1, priority: 1}}}',
            "parameter 'topics.a.timeout': 1 is taken as 1.0, which twist_mux itself ends for",
        ),
        (
            '{topics: {a: {topic: x, timeout: 1.0, priority: 256}}}',
            "parameter 'topics.a.priority' is 256: priorities are from 0 to 255, so it is 255",
        ),
        (
            '{topics: {a: {topic: x, timeout: 1.0, priority: 0}}}',
            "parameter 'topics.a.priority' is 0: no command of it goes on; write 1",
        ),
        (
            '{topics: {a: {topic: x, timeout: 1.0, priority: 1, stamped: true}}}',
            "parameter 'topics.a.stamped' is none of twist_mux: ignored",
        ),
        (
            '{topics: {a: {topic: x, timeout: 0.0, priority: 2}, b: {topic: y, timeout: 1.0, '
            'priority: 1}}}',
            "parameter 'topics.a.timeout' is 0: its first command masks topics.b for good",
        ),
    ],
)
def test_what_is_hardly_meant_gets_one_remark(text, line):
    [remark] = read_settings(values(text)).remarks
    assert remark.startswith(line)


def test_diagnostics_are_those_of_the_original():
    mux = TwistMux([TELEOP, NAVIGATION], [STOP])
    mux.hear_command('topics.navigation', 0)
    mux.hear_lock('locks.stop', True, 0)
    assert mux.report(0) == [
        (
            'velocity topics.navigation',
            ' masked (listening to cmd_vel @ 0.500000s with priority #10)',
        ),
        (
            'velocity topics.teleop',
            ' masked (listening to cmd_vel_teleop @ 0.500000s with priority #100)',
        ),
        (
            'lock locks.stop',
            ' locked (listening to emergency_stop @ 0.000000s with priority #255)',
        ),
        ('current priority', '255'),
        ('loop time in [sec]', '0'),
        ('data age in [sec]', '0'),
    ]
