# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Trials: a function is run with each of its seeds, and what becomes of all of them is counted."""

from collections.abc import Callable, Generator, Iterable
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import replace
import os
from pathlib import Path
import time
from typing import Any, TypeAlias

from amr_description.errors import TrialsError
from amr_description.trials.function import (
    cells,
    require_parameters,
    stop_loading,
    TrialFunction,
    varied_of,
)
from amr_description.trials.one_run import Ending, Task, TrialRun
from amr_description.trials.processes import in_executor, Lost, RunnerProcesses
from amr_description.trials.report import TrialsReport

TIMEOUT = 60.0
"""s that a run may take."""
MOST_BAGS = 10
_MOST_SUBMITTED = 256
Results: TypeAlias = Generator[tuple[Task, TrialRun | Lost], None, None]
Progress = Callable[[int, int, int], None]
"""Called with how many runs are done, have not passed, and there are."""


def trials(
    function: Callable[..., Any] | TrialFunction,
    seeds: int | Iterable[int] = 100,
    *,
    timeout: float = TIMEOUT,
    workers: int | None = None,
    executor: Executor | None = None,
    shard: tuple[int, int] = (1, 1),
    only: str = '',
    fresh: bool = False,
    bags: str | Path | None = None,
    progress: Progress | None = None,
) -> TrialsReport:
    """
    Run a function with each seed, and with each cell of its grid; Ctrl-C keeps what is done.

    It is called with ``simulate``, which takes the arguments of the class Simulation and returns
    one at time 0, with ``rng``, the Generator of its seed, and with the parameters of ``vary``. A
    run passes if it returns None, True, a finite number or a dict of these.

    Args:
        function: At the top of a file; or what :meth:`TrialFunction.named` has found.
        seeds: 0 or above; a number: so many, from 0 on.
        timeout: s of the wall clock that a run may take.
        workers: Processes; None: as many as this process may use cores.
        executor: Where it runs, in place of processes of this machine.
        shard: The third of eight is (3, 8): every eighth run, from the third on.
        only: The name of a run: nothing else is run.
        fresh: Start a simulation for each run, in place of a reset.
        bags: A folder for the bags of the first ten failures; None: none.
        progress: Told of each run that is done.

    Returns:
        The report. It is the same, but for times, wherever the runs were.

    Raises:
        TrialsError: A process could not find the function, or its parameters do not fit.
    """
    stop_loading()
    _require_above_zero(timeout, 'a time-out in s')
    _require_above_zero(1 if workers is None else workers, 'a number of workers')
    trial = function if isinstance(function, TrialFunction) else TrialFunction.of(function)
    tasks = _chosen(_tasks(trial, seeds, fresh), shard, only)
    begin = time.monotonic()
    count = min(workers or cores(), len(tasks))
    results = _results(tasks, executor, count, timeout)
    runs, was_interrupted = _gathered(results, len(tasks), progress)
    report = TrialsReport(
        trial.label,
        tuple(runs[task.name] for task in tasks if task.name in runs),
        total=len(tasks),
        was_interrupted=was_interrupted,
        seconds=time.monotonic() - begin,
        workers=0 if executor else count,
    )
    if bags is not None and not was_interrupted:
        report = _with_bags(report, tasks, Path(bags), timeout, workers or cores())
    return report


def _require_above_zero(value: float, what: str) -> None:
    if not value > 0:
        raise TrialsError(f'{what} of {value}; one above 0 will do')


def cores() -> int:
    """Return how many cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # macOS, Windows
        return os.cpu_count() or 1


def _tasks(trial: TrialFunction, seeds: int | Iterable[int], fresh: bool) -> list[Task]:
    loaded = trial.load()
    require_parameters(loaded, [*varied_of(loaded)])
    grid = trial.grid()
    numbers = range(seeds) if isinstance(seeds, int) else [*seeds]
    wrong = [seed for seed in numbers if seed < 0]
    if wrong:
        raise TrialsError(f'a seed of {wrong[0]}; 0 and above will do')
    if len({*numbers}) < len(numbers):
        raise TrialsError('a seed is named twice, whose run would count twice')
    return [
        Task(trial, name, seed, grid[cell], fresh=fresh)
        for seed in numbers
        for name, cell in cells(grid, seed)
    ]


def _chosen(tasks: list[Task], shard: tuple[int, int], only: str) -> list[Task]:
    number, count = shard
    if not 1 <= number <= count:
        raise TrialsError(f'the shard {number}/{count}; 1/{max(count, 1)} is the first')
    if only:
        found = [task for task in tasks if task.name == only]
        if not found:
            names = f'{tasks[0].name} to {tasks[-1].name}' if tasks else 'none'
            raise TrialsError(f"there is no run '{only}'; there are: {names}")
        return found
    found = tasks[number - 1 :: count]
    if not found:
        raise TrialsError(f'{len(tasks)} runs, and none for the shard {number}/{count}')
    return found


def _results(tasks: list[Task], executor: Executor | None, count: int, timeout: float) -> Results:
    """Yield what becomes of tasks, as they are done."""
    if executor is None:
        with RunnerProcesses(count, timeout) as processes:
            yield from processes.run(tasks)
    else:
        guarded = [replace(task, timeout=timeout) for task in tasks]
        yield from in_executor(executor.submit, guarded, _MOST_SUBMITTED)


def _gathered(
    results: Results, total: int, progress: Progress | None
) -> tuple[dict[str, TrialRun], bool]:
    """Return what became of runs, by name; and whether Ctrl-C has ended it."""
    runs: dict[str, TrialRun] = {}
    bad = 0
    try:
        with closing(results):
            for task, result in results:
                run = _lost(task, result) if isinstance(result, Lost) else result
                assert task.name not in runs, 'each counts once'
                runs[task.name] = run
                bad += run.kind is not Ending.PASSED
                if progress is not None:
                    progress(len(runs), bad, total)
    except KeyboardInterrupt:
        return runs, True
    return runs, False


def _lost(task: Task, lost: Lost) -> TrialRun:
    parameters = {**task.cell, **task.function.drawn(task.seed)}
    return TrialRun(task.name, task.seed, lost.kind, lost.message, parameters)


def _with_bags(
    report: TrialsReport, tasks: list[Task], folder: Path, timeout: float, count: int
) -> TrialsReport:
    """Record the first failures, each by a second run, which has to come to the same."""
    by_name = {task.name: task for task in tasks}
    failures = [run for run in report.bad if run.kind not in (Ending.HUNG, Ending.DIED)][
        :MOST_BAGS
    ]
    if not failures:
        return report
    folder.mkdir(parents=True, exist_ok=True)
    again = [
        replace(by_name[run.name], fresh=True, bag=str((folder / run.name).absolute()))
        for run in failures
    ]
    patience = 3 * timeout  # to record takes longer
    with RunnerProcesses(min(count, len(again)), patience) as processes:
        runs, was_interrupted = _gathered(processes.run(again), len(again), None)
    names = [run.name for run in failures if run.name in runs]
    bags = {name: folder / name for name in names if (folder / name).is_dir()}
    unlike = tuple(
        run.name for run in failures if run.name in runs and not run.is_as(runs[run.name])
    )
    return replace(report, bags=bags, unlike=unlike, was_interrupted=was_interrupted)
