# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A working day of a robot: its last minutes are like its first, and it costs no more."""

import math
from pathlib import Path

import pytest
from support.paths import ROOT

from amr_description.testing.simulation import Simulation

COURSE = ((0.5, 0.3), (0.5, -0.3), (-0.3, 0.5), (0.0, -0.5))
"""m/s and rad/s, for a quarter of a round each; it turns as far to the left as to the right."""
TOLERANCE = 1e-4
"""m and rad, between two rounds."""
MOST_GROWTH = 10.0
"""MB."""


def resources(process):
    """MB of memory, threads and open files of a process."""
    status = dict(
        line.split(':', 1)
        for line in Path(f'/proc/{process}/status').read_text(encoding='utf-8').splitlines()
    )
    files = len(list(Path(f'/proc/{process}/fd').iterdir()))
    return [int(status['VmRSS'].split()[0]) / 1e3, int(status['Threads']), files]


def in_frame_of(begin, end):
    """Where ``end`` is as ``begin`` has it: m, m, rad."""
    dx, dy = end.x - begin.x, end.y - begin.y
    forward = math.cos(begin.yaw) * dx + math.sin(begin.yaw) * dy
    left = math.cos(begin.yaw) * dy - math.sin(begin.yaw) * dx
    return forward, left, math.remainder(end.yaw - begin.yaw, math.tau)


@pytest.mark.parametrize(
    ('rounds', 'seconds'), [(3, 1.0), pytest.param(480, 15.0, marks=pytest.mark.long)]
)
def test_every_round_is_like_the_second(rounds, seconds):
    with Simulation(ROOT / 'urdf' / 'amr.urdf') as sim:
        process = sim._simulator.process.pid
        moves = []
        for number in range(rounds):
            before = (sim.truth, sim.odometry) if number else ()
            for linear, angular in COURSE:
                sim.drive(linear, angular, seconds=seconds, stop=False)
            assert sim.time == sim.truth.time == pytest.approx(4 * seconds * (number + 1))
            now = (sim.truth, sim.odometry)
            moves.append([in_frame_of(*pair) for pair in zip(before, now, strict=False)])
            if number == 1:
                needed = resources(process)
        for truth, odometry in moves[2:]:
            assert truth == pytest.approx(moves[1][0], abs=TOLERANCE)
            assert odometry == pytest.approx(moves[1][1], abs=TOLERANCE)
        # Measured: 3 % of the way, as the wheels scrub in each turn.
        way = seconds * sum(abs(linear) for linear, _ in COURSE)
        assert math.dist(moves[1][0][:2], moves[1][1][:2]) < 0.05 * way
        memory, *others = resources(process)
        assert memory - needed[0] < MOST_GROWTH
        assert others == needed[1:]
