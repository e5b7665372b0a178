# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Two runs of one drive, in real time and as fast as a busy machine can: the same bits."""

from itertools import pairwise
import math
import struct

import pytest

from amr_description.testing import determinism

SECONDS = 3.0
TICKS = 301
WHEELS, IMU = 4, 2


@pytest.fixture(scope='module')
def fast():
    return determinism.record(SECONDS, 0.0, busy=2)


def test_the_log_is_of_every_tick_and_of_a_robot_that_moves(fast):
    records = list(struct.iter_unpack(f'<q{2 * WHEELS + IMU}d', fast.log))
    times = [time for time, *_ in records]
    assert times == [tick * 10_000_000 for tick in range(TICKS)]
    assert all(math.isfinite(value) for record in records for value in record)
    assert len(set(records[100:])) == len({record[1:] for record in records[100:]}) == TICKS - 100


def test_its_imu_is_noisy(fast):
    # At rest before the first command, of which the wheels feel nothing yet.
    rates = [record[-IMU] for record in struct.iter_unpack(f'<q{2 * WHEELS + IMU}d', fast.log)]
    assert 0.001 < max(abs(b - a) for a, b in pairwise(rates[:3])) < 0.1


def test_in_real_time_it_is_the_same_bit_by_bit(fast):
    slow = determinism.record(SECONDS, 1.0)
    assert slow.factor < 1.1
    assert slow.log == fast.log


def test_two_runs_are_compared_and_told(monkeypatch, capsys, fast):
    other = determinism.Run(fast.log[:-1] + bytes([fast.log[-1] ^ 1]), 1.0)
    for second, code, said in ((fast, 0, 'equal, bit by bit'), (other, 1, 'NOT equal')):
        runs = iter([fast, second])
        monkeypatch.setattr(determinism, 'record', lambda *_, runs=runs, **__: next(runs))
        assert determinism.main([]) == code
        assert said in capsys.readouterr().out
