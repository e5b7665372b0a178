# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``mujoco_sim`` with a probe, which measures its control loop from inside.

A line of JSON on its standard input is a request, one on its standard output the answer:

``{"what": "profile", "seconds": S}``
    Processor time of a cycle, and where it goes (:class:`~benchmarks.profiles.Profile`). The
    control thread runs batches of cycles, and between them ``mj_step`` as often on a copy of the
    simulated state. So both see the same machine, however busy that is; and the time is that of
    the processor, which no other program takes part in. Of all batches the 2nd percentile counts:
    one with nothing in between and with warm caches.
``{"what": "speed", "seconds": S, "rounds": N}``
    Real-time factors (:class:`~benchmarks.profiles.Speed`): of the loop as it runs, and of
    ``mj_step`` alone on a copy while the loop is paused, in turn.
``{"what": "ticks", "seconds": S}``
    Wall time, simulated time and the command of a wheel at the end of each cycle
    (:class:`~benchmarks.punctuality.Tick`).
``{"what": "time"}``
    The simulated time, s.
"""

from collections.abc import Callable, Mapping
import copy
import functools
import json
import sys
import threading
import time
from typing import Any

import mujoco
from rclpy.executors import SingleThreadedExecutor

from amr_description.clock import NANOSECONDS
from amr_description.nodes.mujoco_sim import MujocoSim
from amr_description.ros.runtime import program, ros, serve
from benchmarks.probe import CYCLES, Probe

_STEPS = 5
"""In one call of ``mj_step`` alone: as many as a cycle of 10 ms has."""
_WHEEL = 'joint_wheel_front_left/velocity'


class Requests:
    """What may be asked; on a thread that does nothing else."""

    def __init__(self, sim: MujocoSim) -> None:
        self._loop_thread = sim.simulation.loop_thread
        self._loop = sim.simulation.loop_thread.loop
        self._engine = sim.simulation.world.engine

    def serve(self) -> None:
        """Answer the requests on the standard input."""
        for line in sys.stdin:
            request = json.loads(line)
            answer = getattr(self, request.pop('what'))(**request)
            print(json.dumps(answer), flush=True)

    def profile(self, seconds: float) -> Mapping[str, Any]:
        """Return the profile of a cycle."""
        probe = Probe(self._loop, self._engine)
        self._make(functools.partial(probe.run, seconds))
        return probe.result().as_json()

    def speed(self, seconds: float, rounds: int) -> Mapping[str, Any]:
        """Return the real-time factors of the loop, and of ``mj_step`` before and after each."""
        share = seconds / (2 * rounds + 1)
        full: list[float] = []
        bare = [self._bare_factor(share)]
        for _ in range(rounds):
            start, begin = self._loop.time, time.monotonic()
            time.sleep(share)
            wall = time.monotonic() - begin
            full.append((self._loop.time - start) / NANOSECONDS / wall)
            bare.append(self._bare_factor(share))
        return {'full': full, 'bare': bare}

    def ticks(self, seconds: float) -> list[tuple[int, int, float]]:
        """Return the cycles of a while."""
        (manager,) = self._loop.managers
        wheel = manager.resources.available_commands()[_WHEEL]
        ticks: list[tuple[int, int, float]] = []

        def on_tick(simulated: int) -> None:
            ticks.append((time.monotonic_ns(), simulated, wheel.value))

        def watch(callback: Callable[[int], None] | None) -> None:
            manager.on_tick = callback

        self._make(lambda: watch(on_tick))
        time.sleep(seconds)
        self._make(lambda: watch(None))
        return ticks

    def time(self) -> float:
        """Return the simulated time, s."""
        return self._loop.time / NANOSECONDS

    def _bare_factor(self, seconds: float) -> float:
        """Return the real-time factor of ``mj_step`` alone, on a copy, while time stands still."""
        self._make(self._loop.pause)
        model, data = self._engine.model, copy.copy(self._engine.data)
        calls, begin = 0, time.monotonic()
        now = begin
        while now - begin < seconds:
            for _ in range(CYCLES):
                mujoco.mj_step(model, data, _STEPS)
            calls += CYCLES
            now = time.monotonic()
        self._make(self._loop.resume)
        return calls * _STEPS * self._engine.timestep / NANOSECONDS / (now - begin)

    def _make(self, call: Callable[[], None]) -> None:
        """Have the control thread make a call, and wait for it. Raises what the call raises."""
        has_ended = threading.Event()
        future = self._loop_thread.submit(call)
        future.add_done_callback(lambda _: has_ended.set())
        has_ended.wait()
        future.result()


def simulate(args: list[str]) -> int:
    """Run the simulator until it is asked to stop."""
    with ros(args) as stop:
        executor = SingleThreadedExecutor()
        sim = MujocoSim(executor, args)
        executor.add_node(sim.node)
        probe = threading.Thread(target=Requests(sim).serve, name='probe', daemon=True)
        probe.start()
        try:
            serve(executor, stop, sim.simulation.start, until=lambda: sim.has_ended)
        finally:
            sim.close()
            executor.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(program(lambda: simulate(sys.argv[1:]), stopped=0))
