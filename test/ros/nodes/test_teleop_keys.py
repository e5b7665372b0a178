# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the keys of teleop_twist_keyboard mean, and how long a command holds; no ROS here."""

import pytest

from amr_description.nodes.teleop_twist_keyboard.keys import (
    HELP,
    KeyHold,
    MOVES,
    SPEEDS,
    Teleop,
    Velocity,
)
from amr_description.terminal import CTRL_Z

REST = Velocity()
CONTROLLER_TIMEOUT = 0.5  # s, of diff_drive_controller


@pytest.mark.parametrize(
    ('key', 'x', 'y', 'z', 'yaw'),
    [
        ('u', 1, 0, 0, 1), ('i', 1, 0, 0, 0), ('o', 1, 0, 0, -1),
        ('j', 0, 0, 0, 1), ('l', 0, 0, 0, -1),
        ('m', -1, 0, 0, -1), (',', -1, 0, 0, 0), ('.', -1, 0, 0, 1),
        ('U', 1, 1, 0, 0), ('I', 1, 0, 0, 0), ('O', 1, -1, 0, 0),
        ('J', 0, 1, 0, 0), ('L', 0, -1, 0, 0),
        ('M', -1, 1, 0, 0), ('<', -1, 0, 0, 0), ('>', -1, -1, 0, 0),
        ('t', 0, 0, 1, 0), ('b', 0, 0, -1, 0),
    ],
)  # fmt: skip
def test_moves(key, x, y, z, yaw):
    teleop = Teleop(0.5, 2.0)
    assert teleop.press(key) == ''
    assert teleop.velocity == Velocity(x * 0.5, y * 0.5, z * 0.5, yaw * 2.0)
    assert teleop.is_moving


@pytest.mark.parametrize('key', ['k', 'K', ' ', 's', '\n', '\x1b', '\x1b[A', CTRL_Z, 'ü', '\x00'])
def test_anything_else_stops(key):
    teleop = Teleop(0.5, 1.0)
    teleop.press('i')
    assert teleop.press(key) == ''
    assert teleop.velocity == REST
    assert not teleop.is_moving


@pytest.mark.parametrize(
    ('key', 'speed', 'turn'),
    [
        ('q', '0.55', '1.1'), ('z', '0.45', '0.9'),
        ('w', '0.55', '1.0'), ('x', '0.45', '1.0'),
        ('e', '0.5', '1.1'), ('c', '0.5', '0.9'),
    ],
)  # fmt: skip
def test_speed_keys_change_the_speeds_and_keep_the_direction(key, speed, turn):
    teleop = Teleop(0.5, 1.0)
    teleop.press('u')
    assert teleop.press(key) == f'currently:\tspeed {speed}\tturn {turn} '
    assert teleop.velocity == Velocity(x=float(speed), yaw=float(turn))


def test_speeds_multiply_without_rounding():
    teleop = Teleop(0.5, 1.0)
    teleop.press('q')
    assert teleop.press('q') == 'currently:\tspeed 0.6050000000000001\tturn 1.2100000000000002 '


def test_the_help_comes_again_after_every_15th_speed_key():
    teleop = Teleop(0.5, 1.0)
    with_help = []
    for count in range(1, 46):
        teleop.press('i')  # does not count
        if HELP in teleop.press('q' if count % 2 else 'z'):
            with_help.append(count)
    assert with_help == [15, 30, 45]


def test_the_help_names_every_key():
    for key in [*MOVES, *SPEEDS]:
        assert key in HELP
    for line in (
        'Moving around:', 'anything else : stop', 'CTRL-C to quit',
        'q/z : increase/decrease max speeds by 10%',
    ):  # fmt: skip
        assert line in HELP.splitlines()


RELEASE = 'release of '


def drive(presses, *, period=0.1, key_timeout=0.7, until=5.0):
    """Run the two as the node does; return what is published: [(time, velocity)]."""
    teleop, hold = Teleop(0.5, 1.0), KeyHold(period, key_timeout)
    presses = [*presses]
    published = []
    now = 0.0
    while True:
        wait = hold.wait(now)
        due = until if wait is None else now + wait
        if presses and presses[0][0] <= due:
            now, key = presses.pop(0)
            if key.startswith(RELEASE):
                if hold.release(key.removeprefix(RELEASE)):
                    teleop.stop()
                    published.append((now, teleop.velocity))
                continue
            teleop.press(key)
            published.append((now, teleop.velocity))
            hold.press(key, now, moving=teleop.is_moving, name=key)
        elif due >= until:
            return published
        else:
            now = due
            if hold.is_released(now):
                teleop.stop()
                published.append((now, teleop.velocity))
            elif hold.is_repeat_due(now):
                published.append((now, teleop.velocity))


def held(key, *, delay, rate, duration):
    """Return the presses that a terminal reports while a key is held from t = 1 s on."""
    count = int((duration - delay) * rate)
    return [(1.0, key), *((1.0 + delay + n / rate, key) for n in range(count))]


@pytest.mark.parametrize('delay', [0.25, 0.5, 0.66])
@pytest.mark.parametrize('rate', [10.9, 25.0, 33.0])
def test_a_held_key_drives_without_a_stutter_and_stops_soon_after(delay, rate):
    presses = held('i', delay=delay, rate=rate, duration=2.0)
    published = drive(presses)
    *moving, (stop_time, last) = published
    assert {velocity for _, velocity in moving} == {Velocity(x=0.5)}
    times = [time for time, _ in moving]
    gaps = [later - earlier for earlier, later in zip(times, times[1:], strict=False)]
    assert max(gaps) < CONTROLLER_TIMEOUT / 4
    assert last == REST
    assert stop_time - presses[-1][0] == pytest.approx(0.25)


def test_a_single_press_holds_for_the_key_timeout_then_one_zero_and_silence():
    published = drive([(1.0, 'i')])
    assert [time for time, _ in published] == pytest.approx([1 + n / 10 for n in range(8)])
    assert [velocity for _, velocity in published] == [Velocity(x=0.5)] * 7 + [REST]


def test_pressing_again_by_hand_is_no_auto_repeat():
    published = drive([(1.0, 'i'), (1.3, 'i')])
    assert published[-1] == (pytest.approx(2.0), REST)
    assert [velocity for _, velocity in published].count(REST) == 1


def test_a_stop_key_is_one_zero_and_silence():
    published = drive([(1.0, 'i'), (1.05, 'k')])
    assert published == [(1.0, Velocity(x=0.5)), (1.05, REST)]


def test_a_change_of_direction_is_sent_at_once():
    published = drive([(1.0, 'i'), (1.25, 'j')])
    assert (1.25, Velocity(yaw=1.0)) in published
    assert all(v == Velocity(yaw=1.0) for time, v in published if 1.25 <= time < 1.9)


def test_a_speed_key_while_driving_drives_on_faster():
    published = drive([(1.0, 'i'), (1.25, 'q')])
    assert (1.25, Velocity(x=0.55)) in published
    assert published[-1] == (pytest.approx(1.95), REST)


def test_a_speed_key_at_rest_moves_nothing():
    assert drive([(1.0, 'i'), (3.0, 'q')])[-1] == (3.0, REST)


def test_without_both_additions_one_key_is_one_message():
    presses = [(1.0, 'i'), (1.1, 'i'), (2.0, 'q'), (3.0, 'k')]
    velocities = [Velocity(x=0.5), Velocity(x=0.5), Velocity(x=0.55), REST]
    times = [time for time, _ in presses]
    assert drive(presses, period=0.0, key_timeout=0.0) == [*zip(times, velocities, strict=True)]


def test_without_a_key_timeout_the_command_is_repeated_until_the_next_key():
    published = drive([(1.0, 'i'), (4.02, 'k')], key_timeout=0.0)
    assert len(published) == 32
    assert published[-1] == (4.02, REST)
    assert {velocity for _, velocity in published[:-1]} == {Velocity(x=0.5)}


def test_without_repetition_the_release_still_stops():
    assert drive([(1.0, 'i')], period=0.0) == [(1.0, Velocity(x=0.5)), (1.7, REST)]


def test_a_release_that_is_told_stops_at_once_with_one_zero():
    published = drive([(1.0, 'i'), (1.3, f'{RELEASE}i')])
    assert published[-1] == (1.3, REST)
    assert [velocity for _, velocity in published].count(REST) == 1


def test_the_release_of_another_key_stops_nothing():
    published = drive([(1.0, 'i'), (1.2, 'j'), (1.3, f'{RELEASE}i'), (1.6, f'{RELEASE}j')])
    assert published[-1] == (1.6, REST)
    assert all(velocity == Velocity(yaw=1.0) for time, velocity in published if 1.2 <= time < 1.6)


def test_a_speed_key_between_does_not_take_over_the_drive():
    presses = [(1.0, 'i'), (1.2, 'q'), (1.3, f'{RELEASE}q'), (1.5, f'{RELEASE}i')]
    published = drive(presses)
    assert published[-1] == (1.5, REST)
    assert REST not in [velocity for time, velocity in published if time < 1.5]


def test_a_release_that_never_comes_is_made_up_for_by_the_timeout():
    presses = held('i', delay=0.5, rate=25.0, duration=2.0)  # then the network is gone
    assert drive(presses)[-1] == (pytest.approx(presses[-1][0] + 0.25), REST)


def test_a_release_after_the_timeout_is_no_second_zero():
    published = drive([(1.0, 'i'), (3.0, f'{RELEASE}i')])
    assert published[-1] == (pytest.approx(1.7), REST)


def test_a_latched_command_outlives_the_release():
    published = drive([(1.0, 'i'), (1.2, f'{RELEASE}i')], key_timeout=0.0)
    assert REST not in [velocity for _, velocity in published]
