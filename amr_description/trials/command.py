# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``trials``: runs a function with many seeds, and says how often it passes.

::

    ros2 run amr_description trials my_module:drive --seeds 1000
    python -m amr_description.trials my_file.py:drive --only 17          # that run again
    python -m amr_description.trials my_file.py:drive --shard 3/8 -o shard3
    python -m amr_description.trials --merge shard*/report.json --at-least 0.95

With ``-o FOLDER`` it leaves there ``report.json``, ``report.xml`` (JUnit), ``report.html`` (plots)
and ``bags/``, those of the first ten failures. Ctrl-C keeps what is done.

Exit codes: 0: as many have passed as are asked for; 1: fewer; 2: wrong options; 3: enough have
passed, but one hung, died, returned no number, or came to something else when it was repeated;
130: Ctrl-C; 143: SIGTERM, which keeps what is done, too.
"""

import argparse
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, ExitStack
import importlib
from pathlib import Path
import shutil
import signal
import sys
import time
from typing import NoReturn

from amr_description.errors import AmrError, TrialsError
from amr_description.trials.function import TrialFunction
from amr_description.trials.page import page_of
from amr_description.trials.report import merged, TrialsReport
from amr_description.trials.runner import TIMEOUT, trials

INTERRUPTED, TERMINATED = 130, 143
_BAR = 30
"""Characters of the progress bar."""
_PERIOD = 0.1
"""s between two pictures of it."""


def shard_of(text: str) -> tuple[int, int]:
    """Return the shard ``3/8``, for argparse and pytest."""
    number, _, count = text.partition('/')
    try:
        found = int(number), int(count)
    except ValueError:
        found = 0, 0
    if not 1 <= found[0] <= found[1]:
        raise argparse.ArgumentTypeError(f"'{text}' is no shard; 1/8 is the first of eight")
    return found


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    options = argparse.ArgumentParser(
        prog='trials',
        description='Run a function with many seeds, and say how often it passes.',
        epilog='Exit code: 0; 1 fewer than --at-least have passed; 2 wrong arguments; 3 enough, '
        'but a run hung, died, gave no number or did not repeat; 130 Ctrl-C; 143 SIGTERM.',
        allow_abbrev=False,
    )
    add = options.add_argument
    add('trial', nargs='?', metavar='TRIAL', help='module:function, or file.py:function')
    add('--seeds', metavar='N', type=int, default=100, help='how many (default: %(default)s)')
    add('--first-seed', metavar='SEED', type=int, default=0, help='the first of them (default: 0)')
    add('--only', metavar='RUN', default='',
        help='one run, by the name that the report has: its seed, or SEED.CELL')  # fmt: skip
    add('--at-least', metavar='SHARE', type=float, default=1.0,
        help='which has to pass, between 0 and 1 (default: %(default)s)')  # fmt: skip
    add('--timeout', metavar='S', type=float, default=TIMEOUT,
        help='of a run, in s (default: %(default)s)')  # fmt: skip
    add('--workers', metavar='N', type=int, help='processes (default: one for each core)')
    add('--shard', metavar='I/N', type=shard_of, default=(1, 1),
        help='every Nth run, from the Ith on')  # fmt: skip
    add('--fresh', action='store_true', help='start a simulation for each run, slower')
    add('--dask', metavar='ADDRESS', help='run by a scheduler of Dask, as tcp://host:8786')
    add('-o', '--output', metavar='FOLDER', type=Path,
        help='leave report.json, report.xml, report.html and bags/ here')  # fmt: skip
    add('--merge', metavar='FILE', type=Path, nargs='+', help='reports of shards, as JSON')
    return options


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    options = parser()
    given = options.parse_args(args)
    terminations: list[int] = []
    if (given.trial is None) == (given.merge is None):
        options.error('name a trial, as my_module:drive, or reports to --merge')
    try:
        if given.merge is not None:
            report = merged([_read(path) for path in given.merge])
        else:
            with _terminations() as terminations:
                report = _run(given)
        print(report)
        if given.output is not None:
            print(f'  {write(report, given.output)}')
    except AmrError as error:
        print(f'trials: {error}', file=sys.stderr)
        return 2
    return TERMINATED if terminations else exit_code(report, given.at_least)


@contextmanager
def _terminations() -> Iterator[list[int]]:
    """Have SIGTERM, by which a CI ends a job, keep what is done as Ctrl-C does; yield those."""
    received: list[int] = []

    def interrupt(number: int, _frame: object) -> NoReturn:
        received.append(number)
        raise KeyboardInterrupt

    former = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield received
    finally:
        signal.signal(signal.SIGTERM, former)


def exit_code(report: TrialsReport, at_least: float) -> int:
    """Return that of the executable; ``at_least``: the share that has to pass."""
    if report.was_interrupted:
        return INTERRUPTED
    if report.share < at_least:
        return 1
    return 0 if report.is_sound else 3


def write(report: TrialsReport, folder: Path) -> str:
    """Write a report as JSON, JUnit and a page; return their names. Raises TrialsError."""
    texts = {
        folder / 'report.json': report.to_json() + '\n',
        folder / 'report.xml': report.to_junit(),
        folder / 'report.html': page_of(report),
    }
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for path, text in texts.items():
            path.write_text(text, encoding='utf-8')
    except OSError as error:
        raise TrialsError(f'the report cannot be written: {error}') from error
    return ', '.join(map(str, texts))


def progress_bar() -> Callable[[int, int, int], None]:
    """Return what draws progress on a terminal; where there is none, it draws nothing."""
    begin = shown = time.monotonic()

    def draw(done: int, bad: int, total: int) -> None:
        nonlocal shown
        now = time.monotonic()
        if not sys.stderr.isatty() or (now - shown < _PERIOD and done < total):
            return
        shown = now
        full = _BAR * done // total
        left = (now - begin) / done * (total - done)
        text = f'{"█" * full}{"░" * (_BAR - full)} {done}/{total}, {bad} not passed, {left:.0f} s'
        end = '\n' if done == total else ''
        print(f'\r{text}\x1b[K', end=end, file=sys.stderr, flush=True)

    return draw


def dask_executor(address: str, stack: ExitStack) -> Executor:
    """
    Return the executor of a scheduler of Dask, whose connection ends with the stack.

    Raises TrialsError: Dask is not installed, or nobody answers there.
    """
    try:
        distributed = importlib.import_module('distributed')
    except ModuleNotFoundError as error:
        raise TrialsError(
            "--dask needs Dask: python -m pip install 'distributed', here and for its workers"
        ) from error
    try:
        client = stack.enter_context(distributed.Client(address, set_as_default=False))
    except (OSError, ValueError) as error:
        raise TrialsError(f'no scheduler of Dask answers at {address}: {error}') from error
    # It runs again what was with a worker that died; the same run comes to the same.
    executor: Executor = client.get_executor(pure=False)
    return executor


def _run(given: argparse.Namespace) -> TrialsReport:
    sys.path[:0] = [''] if '' not in sys.path else []  # modules of this folder, as python -m does
    trial = TrialFunction.named(given.trial)
    bags = None
    if given.output is not None:
        bags = given.output / 'bags'
        if (given.output / 'report.json').exists():  # those of an earlier report
            shutil.rmtree(bags, ignore_errors=True)
        if bags.exists():
            raise TrialsError(f'{bags} is there already; another --output will do')
    with ExitStack() as stack:
        executor = None if given.dask is None else dask_executor(given.dask, stack)
        return trials(
            trial,
            range(given.first_seed, given.first_seed + given.seeds),
            timeout=given.timeout,
            workers=given.workers,
            executor=executor,
            shard=given.shard,
            only=_with_seed(given),
            fresh=given.fresh,
            bags=bags,
            progress=progress_bar(),
        )


def _with_seed(given: argparse.Namespace) -> str:
    """Return the run that is asked for; let its seed be among those that there are."""
    if not given.only:
        return ''
    seed = given.only.partition('.')[0]
    if not seed.isdecimal():
        raise TrialsError(f'--only {given.only} names no run; its seed does, as 17, or 17.3')
    given.first_seed, given.seeds = int(seed), 1
    return str(given.only)


def _read(path: Path) -> TrialsReport:
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise TrialsError(f'{path} cannot be read: {error.strerror}') from error
    return TrialsReport.from_json(text, str(path))
