# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``mujoco_sim`` with a probe: how much processor time a cycle of its control loop takes, and where.

A line ``SECONDS`` on its standard input makes it measure, a line of JSON on its standard output
is the answer (:class:`~benchmarks.cycle.Measured`). The probe is a call of the control thread: it
runs batches of cycles, and between them as many calls of ``mj_step`` on a copy of the simulated
state. So both see the same machine, however busy that is; and the time is that of the processor,
which no other program takes part in. Of all batches the 2nd percentile counts: one with nothing
in between and with warm caches.
"""

from collections.abc import Callable
import copy
import functools
import json
from operator import itemgetter
import sys
import threading
import time

import mujoco
from rclpy.executors import SingleThreadedExecutor

from amr_description.clock import NANOSECONDS
from amr_description.control.loop import Loop
from amr_description.control.ros.loop_thread import LoopThread
from amr_description.nodes.mujoco_sim import MujocoSim
from amr_description.ros.runtime import program, ros, serve
from amr_description.sim.engine import Engine
from benchmarks.call_tree import CallRecorder, CallTree, cost_of_watching
from benchmarks.cycle import Measured

CYCLES = 20
"""In one batch: what is published with each second or fifth cycle is in each batch."""
_QUICK = 0.02
"""The percentile of the batches that counts; warm, and with nothing in between."""
_KEPT = 10
"""Of the batches that are watched call by call, the quickest ones."""
_ROUND = 0.25
"""s of the batches of one kind in a row: watching makes the interpreter forget what it has
specialised, and a pause lets the caches get cold."""

type Batch = tuple[int, CallRecorder]
"""Processor time, ns, and the calls."""


def quickest(times: list[int]) -> float:
    """Return the 2nd percentile of the time of batches (ns), for one cycle (µs)."""
    return sorted(times)[int(len(times) * _QUICK)] / CYCLES / 1e3


class Probe:
    """Batches of cycles, of ``mj_step`` alone, and of cycles that are watched, in turn."""

    def __init__(self, loop: Loop, engine: Engine) -> None:
        """``loop`` runs as fast as possible; ``engine``: of its world."""
        self._loop = loop
        self._engine = engine
        self._copy = copy.copy(engine.data)
        self._plain: list[int] = []
        self._bare: list[int] = []
        self._watched: list[Batch] = []
        self._steps = 1

    def run(self, seconds: float) -> None:
        """Measure for ``seconds`` of the wall clock; on the control thread."""
        end, start = time.monotonic() + seconds, self._loop.time
        self._loop.run_once()
        self._steps = max(1, round((self._loop.time - start) / self._engine.timestep))
        while not self._plain or time.monotonic() < end:
            self._repeat(self._measure_cycles, min(_ROUND, seconds))
            self._repeat(self._watch_cycles, min(_ROUND, seconds) / 2)

    def _repeat(self, measure: Callable[[], None], seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            measure()

    def _measure_cycles(self) -> None:
        self._plain.append(self._run_cycles())
        model = self._engine.model
        before = time.thread_time_ns()
        for _ in range(CYCLES):
            mujoco.mj_step(model, self._copy, self._steps)
        self._bare.append(time.thread_time_ns() - before)

    def _watch_cycles(self) -> None:
        recorder = CallRecorder()
        sys.setprofile(recorder)
        took = self._run_cycles()
        sys.setprofile(None)
        self._watched.append((took, recorder))
        self._watched = sorted(self._watched, key=itemgetter(0))[:_KEPT]

    def _run_cycles(self) -> int:
        """Return the processor time of a batch, ns."""
        before = time.thread_time_ns()
        for _ in range(CYCLES):
            self._loop.run_once()
        return time.thread_time_ns() - before

    def result(self) -> Measured:
        """Return what :meth:`run` has measured; on any thread."""
        cycle = quickest(self._plain)
        tree = CallTree('a cycle', total=sum(took for took, _ in self._watched))
        for _, recorder in self._watched:
            tree.add(recorder.events)
        tree = tree.per(CYCLES * len(self._watched), 1e3)
        tree = tree.without_overhead(cost_of_watching() / 1e3, cycle)
        period = self._steps * self._engine.timestep / NANOSECONDS
        speed = float(abs(self._engine.data.qvel).max()) if self._engine.model.nv else 0.0
        return Measured(cycle, quickest(self._bare), len(self._plain), period, speed, tree)


def _serve_probe(sim: MujocoSim) -> None:
    """Measure at each line of the standard input."""
    loop, engine = sim.simulation.loop_thread, sim.simulation.world.engine
    for line in sys.stdin:
        # MuJoCo refuses to copy the data while the control thread is in a step.
        probe = _make(loop, lambda: Probe(loop.loop, engine))
        _make(loop, functools.partial(probe.run, float(line)))
        print(json.dumps(probe.result().as_json()), flush=True)


def _make[Result](loop_thread: LoopThread, call: Callable[[], Result]) -> Result:
    """
    Have the control thread make a call, wait until it has, and return what it returns.

    Raises what the call raises.
    """
    has_ended = threading.Event()
    future = loop_thread.submit(call)
    future.add_done_callback(lambda _: has_ended.set())
    has_ended.wait()
    result: Result = future.result()
    return result


def simulate(args: list[str]) -> int:
    """Run the simulator until it is asked to stop."""
    with ros(args) as stop:
        executor = SingleThreadedExecutor()
        sim = MujocoSim(executor, args)
        executor.add_node(sim.node)
        probe = threading.Thread(target=_serve_probe, args=(sim,), name='probe', daemon=True)
        probe.start()
        try:
            serve(executor, stop, sim.simulation.start, until=lambda: sim.has_ended)
        finally:
            sim.close()
            executor.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(program(lambda: simulate(sys.argv[1:]), stopped=0))
