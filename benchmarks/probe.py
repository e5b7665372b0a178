# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The processor time of a cycle of the control loop, and where it goes."""

from collections.abc import Callable
import copy
from operator import itemgetter
import sys
import time
from typing import TypeAlias

import mujoco

from amr_description.clock import NANOSECONDS
from amr_description.control.loop import Loop
from amr_description.sim.engine import Engine
from benchmarks.call_tree import CallRecorder, CallTree, cost_of_watching
from benchmarks.profiles import Profile

CYCLES = 20
"""In one batch: what is published with each second or fifth cycle is in each batch."""
_QUICK = 0.02
"""The percentile of the batches that counts; warm, and with nothing in between."""
_WATCHED = 10
"""Cycles in a batch that is watched call by call: short, so that few are interrupted."""
_KEPT = 10
"""Of these, the quickest by the wall clock, which is read ten times as fast as the other."""
_ROUND = 0.25
"""s of the batches of one kind in a row: watching makes the interpreter forget what it has
specialised, and a pause lets the caches get cold."""

Batch: TypeAlias = tuple[int, CallRecorder]
"""Wall time, ns, and the calls."""


def quickest(times: list[int]) -> float:
    """Return the 2nd percentile of the time of batches (ns), for one cycle (µs)."""
    return sorted(times)[int(len(times) * _QUICK)] / CYCLES / 1e3


class Probe:
    """Batches of cycles, of ``mj_step`` alone, and of cycles that are watched, in turn."""

    def __init__(self, loop: Loop, engine: Engine) -> None:
        """``loop`` runs as fast as possible; ``engine``: of its world."""
        self._loop = loop
        self._engine = engine
        self._copy: mujoco.MjData | None = None
        self._plain: list[int] = []
        self._bare: list[int] = []
        self._physics: list[int] = []
        self._watched: list[Batch] = []
        self._steps = 1

    def run(self, seconds: float) -> None:
        """Measure for ``seconds`` of the wall clock; on the control thread."""
        end, start = time.monotonic() + seconds, self._loop.time
        # Here and not earlier: MuJoCo refuses to copy the data while another thread is in a step.
        self._copy = copy.copy(self._engine.data)
        self._loop.run_once()
        self._steps = max(1, round((self._loop.time - start) / self._engine.timestep))
        while not self._plain or time.monotonic() < end:
            self._repeat(self._measure_cycles, min(_ROUND, seconds))
            self._repeat(self._measure_physics, min(_ROUND, seconds) / 2)
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

    def _measure_physics(self) -> None:
        """Measure ``mj_step`` where it is, in the cycle: other code leaves its caches cold."""
        step, spent = mujoco.mj_step, 0

        def timed_step(*args: object) -> None:
            nonlocal spent
            before = time.thread_time_ns()
            step(*args)
            spent += time.thread_time_ns() - before

        mujoco.mj_step = timed_step
        try:
            self._run_cycles()
        finally:
            mujoco.mj_step = step
        self._physics.append(spent)

    def _watch_cycles(self) -> None:
        recorder = CallRecorder()
        before = time.perf_counter_ns()
        sys.setprofile(recorder)
        for _ in range(_WATCHED):
            self._loop.run_once()
        sys.setprofile(None)
        took = time.perf_counter_ns() - before
        self._watched.append((took, recorder))
        self._watched = sorted(self._watched, key=itemgetter(0))[:_KEPT]

    def _run_cycles(self) -> int:
        """Return the processor time of a batch, ns."""
        before = time.thread_time_ns()
        for _ in range(CYCLES):
            self._loop.run_once()
        return time.thread_time_ns() - before

    def result(self) -> Profile:
        """Return what :meth:`run` has measured; on any thread."""
        cycle = quickest(self._plain)
        tree = CallTree('a cycle', total=sum(took for took, _ in self._watched))
        for _, recorder in self._watched:
            tree.add(recorder.events)
        tree = tree.per(_WATCHED * len(self._watched), 1e3)
        tree = tree.without_overhead(
            cost_of_watching() / 1e3, cycle, {'mj_step': quickest(self._physics)}
        )
        period = self._steps * self._engine.timestep / NANOSECONDS
        speed = float(abs(self._engine.data.qvel).max()) if self._engine.model.nv else 0.0
        return Profile(cycle, quickest(self._bare), len(self._plain), period, speed, tree)
