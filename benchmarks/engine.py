# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulation without ROS: ``amr_description.Simulation``, in a process of its own.

``python -m benchmarks.engine [--seconds S]`` measures in this process, and prints the figures as
JSON. All but memory is processor time.
"""

import argparse
from collections.abc import Callable
import copy
import json
import statistics
import subprocess
import sys
import time

import mujoco

from amr_description import Simulation
from amr_description.model.frames import Transform
from benchmarks.figures import Figures

_URDF = 'package://amr_description/urdf/amr.urdf'
_PERIOD = 0.01
"""s, of the controllers."""
_COMMANDS = 10
"""Cycles for each command."""
_ROUNDS = 5
_RESETS = 200
_COMMAND = {'twist': {'linear': {'x': 0.3}, 'angular': {'z': 0.3}}}
_START = """
import resource, time
from amr_description import Simulation
with Simulation('package://amr_description/urdf/amr.urdf') as sim:
    sim.step()
    first = time.process_time()
    sim.drive(0.3, 0.3, seconds=10)
    print(first, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def engine_figures(seconds: float) -> Figures:
    """Measure in a process without ROS. Raises CalledProcessError."""
    command = [sys.executable, '-m', 'benchmarks.engine', '--seconds', str(seconds)]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    values = json.loads(done.stdout)
    text = values.pop('text')
    return Figures(values, text)


def cycle_ratio(
    robots: int, seconds: float, clock: Callable[[], float] = time.process_time
) -> tuple[float, float, float]:
    """
    Return the share of a cycle that is ``mj_step``; a cycle, and ``mj_step`` alone, in µs.

    The robots drive in circles, commanded ten times a second; the odometry of each is read in each
    cycle. ``mj_step`` alone is of a copy of the state, in turn; medians of some rounds.

    Args:
        robots: How many.
        seconds: Of the measurement.
        clock: Processor time, s.
    """
    poses = {f'robot{n}': Transform((2.0 * (n % 5), 2.0 * (n // 5), 0.0)) for n in range(robots)}
    with Simulation(_URDF, robots=poses) as sim:
        found, steps = [*sim.robots.values()], round(_PERIOD / sim.timestep)
        commands = {robot.command_topic: _COMMAND for robot in found}

        def cycles(count: int) -> None:
            for number in range(count):
                if not number % _COMMANDS:
                    sim.send_all(commands)
                sim.step(steps)
                for robot in found:
                    _ = robot.odometry

        cycles(100)
        begin = clock()
        cycles(100)
        count = max(100, int(seconds / (2 * _ROUNDS) / (clock() - begin) * 100))
        full, bare = [], []
        for _ in range(_ROUNDS):
            begin = clock()
            cycles(count)
            full.append((clock() - begin) / count)
            model, data = sim.world.engine.model, copy.copy(sim.world.engine.data)
            begin = clock()
            for _ in range(count):
                mujoco.mj_step(model, data, steps)
            bare.append((clock() - begin) / count)
        ratio = statistics.median(b / f for b, f in zip(bare, full, strict=True))
        return ratio, statistics.median(full) * 1e6, statistics.median(bare) * 1e6


def reset_time(clock: Callable[[], float] = time.process_time) -> float:
    """Return the processor time of a reset after some driving, ms."""
    total = 0.0
    with Simulation(_URDF) as sim:
        for _ in range(_RESETS):
            sim.drive(0.3, 0.3, seconds=0.05, stop=False)
            begin = clock()
            sim.reset()
            total += clock() - begin
    return total / _RESETS * 1e3


def start() -> tuple[float, float]:
    """Return the processor time from the start of Python to the first step, s; and memory, MB."""
    found = []
    for _ in range(3):
        done = subprocess.run(
            [sys.executable, '-c', _START], check=True, stdout=subprocess.PIPE, text=True
        )
        found.append(tuple(map(float, done.stdout.split())))
    return min(first for first, _ in found), max(kilobytes for _, kilobytes in found) / 1024


def main(args: list[str] | None = None) -> int:
    """Measure, and print JSON; return the exit code."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument('--seconds', type=float, default=5.0, help='of each measurement (5)')
    seconds = options.parse_args(args).seconds
    ratio, full, bare = cycle_ratio(1, seconds)
    ten, *_ = cycle_ratio(10, seconds)
    first, memory = start()
    text = (
        'the simulation without ROS\n'
        f'a cycle: {full:.0f} µs of processor time, mj_step alone {bare:.0f} µs'
    )
    values = {
        'engine': ratio,
        'engine fleet': ten,
        'engine start': first,
        'engine reset': reset_time(),
        'engine memory': memory,
    }
    print(json.dumps({**values, 'text': text}))
    return 0


if __name__ == '__main__':
    sys.exit(main())
