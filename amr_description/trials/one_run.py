# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A run: a trial with one seed, in this process; what becomes of it is plain data.

A simulation is started once in a process and reset for each run, which gives the same bits as one
that is started anew: both are reset with the seed. One that a run has changed for good, by a robot
that came, a controller that was switched or a value written into MuJoCo's model, is not used
again.
"""

from collections.abc import Callable, Mapping
import ctypes
from dataclasses import dataclass, field, replace
import enum
from hashlib import blake2b
import linecache
import math
import numbers
import os
from pathlib import Path
import threading
import time
import traceback
from types import TracebackType
from typing import Any

import numpy as np

from amr_description.errors import TrialsError
from amr_description.simulation.in_process import Simulation
from amr_description.text import one_line, unwrap
from amr_description.trials.function import TrialFunction, Value

MOST_SIMULATIONS = 4
"""With differing arguments, that are kept in a process."""
GRACE = 5.0
"""s after a time-out, in which a run that is in C may come back; then its process ends."""
_LONGEST = 300
"""Characters of a message."""
_NUMBER = 'value'
"""How a number is called that a trial returns alone."""


class Ending(enum.StrEnum):
    """What became of a run."""

    PASSED = 'passed'
    FAILED = 'failed'
    """An assertion does not hold, or False was returned."""
    RAISED = 'raised'
    """It raised something else."""
    INVALID = 'invalid'
    """It returned NaN, or what is no number."""
    HUNG = 'hung'
    DIED = 'died'
    """Its process ended: by a signal, or by itself."""

    @property
    def is_broken(self) -> bool:
        """Whether it tells nothing of the robot."""
        return self in (Ending.INVALID, Ending.HUNG, Ending.DIED)


@dataclass(frozen=True)
class Task:
    """What a process is told to run."""

    function: TrialFunction
    name: str
    """Of the run: its seed, of a grid with the number of its cell."""
    seed: int
    cell: Mapping[str, Value]
    """The values of the grid."""
    fresh: bool = False
    """Start a simulation of its own."""
    bag: str = ''
    """A folder to record to; empty: nothing is recorded."""
    timeout: float = math.inf
    """s after which the process itself ends the run; infinite: others see to that."""


@dataclass(frozen=True)
class TrialRun:
    """What became of a run."""

    name: str
    seed: int
    kind: Ending
    message: str = ''
    """One line; empty: it passed."""
    parameters: Mapping[str, Value] = field(default_factory=dict)
    values: Mapping[str, float] = field(default_factory=dict)
    """What it returned, by name."""
    step: int = 0
    """Physics steps of its last simulation."""
    bits: str = ''
    """Digest of the states in which its simulations ended."""
    seconds: float = 0.0
    """Time of the processor, s. It is no part of what has to be the same."""

    def is_as(self, other: 'TrialRun') -> bool:
        """Whether another run came to the same, bit for bit."""
        return replace(self, seconds=0.0) == replace(other, seconds=0.0)


class Simulations:
    """
    What a trial gets as ``simulate``: called as the class Simulation, it returns one at time 0.

    It is started by the first call with such arguments, and reset by further ones.
    """

    def __init__(self) -> None:
        """Start none yet."""
        self._kept: dict[str, tuple[Simulation, bytes]] = {}
        self._lent: dict[str, Simulation] = {}
        self._seed, self._fresh, self._bag = 0, False, ''
        self._digest = blake2b(digest_size=8)

    def __call__(
        self, urdf: str | Path, controllers: str | Path | None = None, **options: Any
    ) -> Simulation:
        """Return a running simulation at time 0, seeded; arguments as of the class."""
        if 'record' in options:
            raise TrialsError('a trial that fails is recorded by itself; leave record= out')
        key = repr((urdf, controllers, sorted(options.items())))
        if key in self._lent:
            self._note(self._lent[key])
        kept = self._kept.pop(key, None)
        if kept is not None and not kept[0].is_alive:  # the trial has closed it
            kept = None
        if kept is not None:
            kept[0].reset(seed=self._seed)
            if _mark(kept[0]) != kept[1]:
                kept[0].close()
                kept = None
        if kept is None:
            while len(self._kept) >= MOST_SIMULATIONS:
                self._kept.pop(next(iter(self._kept)))[0].close()
            sim = Simulation(urdf, controllers, **options)
            sim.start()
            sim.reset(seed=self._seed)
            kept = sim, _mark(sim)
        self._kept[key] = kept  # the newest last
        sim = self._lent[key] = kept[0]
        if self._bag:
            sim.record(self._bag if len(self._lent) == 1 else f'{self._bag}-{len(self._lent)}')
        return sim

    def begin(self, seed: int, *, fresh: bool, bag: str) -> None:
        """Begin a run."""
        if fresh:
            self.close()
        self._seed, self._bag = seed, bag
        self._lent.clear()
        self._digest = blake2b(digest_size=8)

    def end(self) -> tuple[int, str]:
        """End a run; return physics steps, and the digest of all that its simulations came to."""
        step = 0
        for sim in self._lent.values():
            step = self._note(sim)
            if self._bag and sim.is_alive:
                sim.end_recording()
        self._lent.clear()
        return step, self._digest.hexdigest()

    def close(self) -> None:
        """End all simulations."""
        for sim, _ in self._kept.values():
            sim.close()
        self._kept.clear()

    def _note(self, sim: Simulation) -> int:
        self._digest.update(sim.world.state())
        return sim.world.time // sim.world.timestep


def _mark(sim: Simulation) -> bytes:
    """Return what a run may have changed that no reset undoes."""
    managers = {
        name: robot.manager.states() if robot.manager else {} for name, robot in sim.robots.items()
    }
    return repr((sim.world.engine.generation, managers)).encode() + sim.world.engine.constants()


class _OfThread(threading.local):
    """Each thread has its own: those of a cluster's worker run side by side."""

    def __init__(self) -> None:
        self.simulations = Simulations()


_own = _OfThread()


def run_task(task: Task) -> TrialRun:
    """Run a trial once, in this process and thread. Only Ctrl-C is raised."""
    begin = time.thread_time()
    simulations, watchdog = _own.simulations, _Watchdog(task.timeout)
    parameters: Mapping[str, Value] = {}
    step, bits = 0, ''
    simulations.begin(task.seed, fresh=task.fresh, bag=task.bag)
    try:
        try:
            with watchdog:
                function = task.function.load()
                parameters = {**task.cell, **task.function.drawn(task.seed)}
                rng = np.random.default_rng(task.seed)
                returned = function(simulate=simulations, rng=rng, **parameters)
        finally:
            step, bits = simulations.end()
        kind, message, values = judged(returned)
    except KeyboardInterrupt:
        raise
    except _OutOfTimeError:
        kind, message, values = Ending.HUNG, f'not done after {task.timeout:g} s', {}
        watchdog.end()
        simulations.close()
        step, bits = 0, ''  # wherever it was just then
    except BaseException as error:  # whatever users raise, and pytest.fail()
        kind = Ending.FAILED if is_failure(error) else Ending.RAISED
        message, values = message_of(error), {}
    seconds = time.thread_time() - begin
    return TrialRun(task.name, task.seed, kind, message, parameters, values, step, bits, seconds)


def judged(returned: Any) -> tuple[Ending, str, Mapping[str, float]]:
    """Return what a returned value says: kind, message, values."""
    if isinstance(returned, bool | np.bool_):
        return (Ending.PASSED, '', {}) if returned else (Ending.FAILED, 'it returned False', {})
    if returned is None:
        return Ending.PASSED, '', {}
    values = returned if isinstance(returned, Mapping) else {_NUMBER: returned}
    plain: dict[str, float] = {}
    for name, value in values.items():
        if not isinstance(value, numbers.Real | np.bool_):
            kind = type(value).__name__
            said = f"it returned a '{kind}'" + (f" as '{name}'" if values is returned else '')
            return (
                Ending.INVALID,
                f'{said}; None, a bool, a number or a dict of numbers will do',
                {},
            )
        if not math.isfinite(value):
            shown = 'NaN' if math.isnan(value) else str(float(value))
            return Ending.INVALID, f"it returned {shown} as '{name}'; a finite number will do", {}
        plain[str(name)] = float(value)
    return Ending.PASSED, '', plain


def is_failure(error: BaseException) -> bool:
    """Whether an exception says that something is not as it should be: pytest.fail() does, too."""
    return isinstance(error, AssertionError) or type(error).__name__ == 'Failed'


def message_of(error: BaseException) -> str:
    """Return one line: where, what kind, and what an exception says, or the line that raised."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [each for each in frames if not _is_ours(each.filename)]
    said = unwrap(str(error))
    where = ''
    if own:
        name, line = own[-1].filename, own[-1].lineno or 0
        where = f'{Path(name).name}:{line}: '
        if not said and isinstance(error, AssertionError):
            said = linecache.getline(name, line).strip()
    kind = '' if is_failure(error) else f'{type(error).__name__}: '
    text = one_line(f'{where}{kind}{said}'.rstrip(': '))
    return text if len(text) <= _LONGEST else f'{text[: _LONGEST - 1]}…'


_PACKAGE = str(Path(__file__).parents[1])


def _is_ours(file: str) -> bool:
    return file.startswith(_PACKAGE)


class _OutOfTimeError(BaseException):
    """The run has had its time."""


class _Watchdog:
    """
    Ends a ``with`` block that takes too long, in a thread of any worker of any executor.

    Where Python runs, an exception ends it. What is in C and does not come back can be ended only
    with its process: then the executor says what becomes of it.
    """

    def __init__(self, seconds: float) -> None:
        self._thread, self._lock = threading.get_ident(), threading.Lock()
        self._is_over = self._has_fired = False
        self._timers: list[threading.Timer] = []
        if math.isfinite(seconds):
            calls: Mapping[float, Callable[[], None]] = {
                seconds: self._fire,
                seconds + GRACE: self._end_process,
            }
            self._timers = [threading.Timer(after, call) for after, call in calls.items()]
            for timer in self._timers:
                timer.daemon = True

    def __enter__(self) -> None:
        for timer in self._timers:
            timer.start()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.end()
        if self._has_fired and kind is not _OutOfTimeError:
            raise _OutOfTimeError  # it has come back meanwhile, or was about to be ended

    def end(self) -> None:
        """End nothing any more."""
        with self._lock:
            self._is_over = True
        for timer in self._timers:
            timer.cancel()

    def _fire(self) -> None:
        with self._lock:
            if self._is_over:
                return
            self._has_fired = True
            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(self._thread), ctypes.py_object(_OutOfTimeError)
            )

    def _end_process(self) -> None:
        with self._lock:
            if not self._is_over:
                os._exit(1)
