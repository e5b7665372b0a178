# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command ``try_robots``: its options, the robots side by side, the table, the exit code."""

import argparse
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
import json
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time

from amr_description.errors import AmrError
from amr_description.testing.trial.findings import from_json, to_json, TrialFindings
from amr_description.testing.trial.inputs import (
    descriptions,
    offer_prefixes,
    prefixes,
    robot_names,
)
from amr_description.testing.trial.one_robot import Job
from amr_description.testing.trial.verdict import judge, table, TrialVerdict
from amr_description.text import one_line

_MODULE = 'amr_description.testing.trial.one_robot'
_STOP_TIMEOUT = 25.0
"""s from SIGINT to SIGKILL: a simulator may take 15 of them."""


def try_robot(job: Job, timeout: float, running: set[subprocess.Popen[bytes]]) -> TrialFindings:
    """
    Try a robot; end its process after ``timeout`` s of the wall clock.

    ``running`` has the process while it runs, so that who is interrupted can end it.
    """
    with tempfile.TemporaryDirectory(prefix='amr-try-') as name:
        folder = Path(name)
        file, result, log = folder / 'job.json', folder / 'found.json', folder / 'log'
        file.write_text(json.dumps(asdict(job)), encoding='utf-8')
        begin = time.monotonic()
        with log.open('wb') as stream:
            process = subprocess.Popen(
                [sys.executable, '-m', _MODULE, str(file), str(result)],
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=stream,
                start_new_session=True,
            )
        running.add(process)
        try:
            is_late, cpu_seconds = _wait(process, timeout)
        finally:
            running.discard(process)
        found = TrialFindings(job.robot, job.file)
        if result.is_file():
            found = from_json(result.read_text(encoding='utf-8'))
        found.seconds, found.cpu_seconds = time.monotonic() - begin, cpu_seconds
        if is_late:
            found.faults.append(f'{found.stage}: not done within {timeout:g} s')
        elif process.returncode:
            lines = log.read_text(encoding='utf-8', errors='replace').strip().splitlines()
            said = one_line(lines[-1]) if lines else 'without a word'
            found.faults.append(
                f'{found.stage}: the process of the trial ended with {process.returncode}: {said}'
            )
        return found


def _wait(process: subprocess.Popen[bytes], timeout: float) -> tuple[bool, float]:
    """Wait for the end of a process; return whether it was late, and its CPU time in s."""
    late = threading.Event()

    def stop() -> None:
        late.set()
        process.send_signal(signal.SIGINT)

    timers = [
        threading.Timer(timeout, stop),
        threading.Timer(timeout + _STOP_TIMEOUT, lambda: process.send_signal(signal.SIGKILL)),
    ]
    for timer in timers:
        timer.start()
    try:
        _, status, usage = os.wait4(process.pid, 0)
    finally:
        for timer in timers:
            timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return late.is_set(), usage.ru_utime + usage.ru_stime


_OF_ROBOT = re.compile(r'([^\s:=]+)=(?=[^\s:=]+:=)')
"""``ROBOT=`` before the first argument of a xacro file."""


def main(arguments: Sequence[str]) -> int:
    """Try robots; return 0 if all move as told, 1 if one does not, 2 for what cannot be tried."""
    options = _parser().parse_args(arguments)
    try:
        replacements = tuple(map(_replacement, options.replace))
        files = descriptions(options.paths)
    except (AmrError, ValueError) as error:
        print(f'try_robots: {error}', file=sys.stderr)
        return 2
    offer_prefixes([*prefixes(options.paths), *options.prefix])
    jobs = [
        Job(
            name,
            str(file.absolute()),
            tuple(options.controllers),
            replacements,
            ' '.join(given_to(name, options.xacro_args)),
            name in options.fixed or 'all' in options.fixed,
        )
        for name, file in zip(robot_names(files), files, strict=True)
        if not options.only or any(word in name for word in options.only)
    ]
    try:
        found = _try_all(jobs, options.jobs, options.timeout)
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    text = table(found, details=not options.brief)
    print(text, flush=True)
    if options.json:
        options.json.write_text(to_json(found) + '\n', encoding='utf-8')
    return 0 if all(judge(each).verdict is TrialVerdict.AS_TOLD for each in found) else 1


def _try_all(jobs: Sequence[Job], count: int, timeout: float) -> list[TrialFindings]:
    """Try robots, ``count`` of them side by side; say on stderr how far it is."""
    running: set[subprocess.Popen[bytes]] = set()

    def one(job: Job) -> TrialFindings:
        found = try_robot(job, timeout, running)
        print(f'{job.robot}: {judge(found)} ({found.seconds:.0f} s)', file=sys.stderr, flush=True)
        return found

    with ThreadPoolExecutor(count) as pool:
        try:
            return list(pool.map(one, jobs))
        except KeyboardInterrupt:
            pool.shutdown(wait=False, cancel_futures=True)
            for process in [*running]:  # they were not meant: each is in a session of its own
                process.send_signal(signal.SIGINT)
            raise


def given_to(robot: str, given: Sequence[str]) -> list[str]:
    """Return what ``[ROBOT=]TEXT`` give a robot: its own, else those of all."""
    pairs = [_OF_ROBOT.match(each) for each in given]
    own = [
        text[pair.end() :]
        for text, pair in zip(given, pairs, strict=True)
        if pair and pair[1] == robot
    ]
    return own or [text for text, pair in zip(given, pairs, strict=True) if not pair]


def _replacement(text: str) -> tuple[str, str]:
    old, separator, new = text.partition('=')
    if not (old and separator):
        raise ValueError(f"--replace '{text}' is no OLD=NEW")
    return old, new


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='try_robots',
        description='Try robots as they are: check, spawn, rest, controllers, motions.',
        epilog='Exit code: 0 all move as told; 1 one does not; 2 nothing can be tried.',
    )
    add = parser.add_argument
    add('paths', nargs='+', type=Path, metavar='FOLDER|FILE', help='descriptions, or their folder')
    add(
        '--controllers',
        action='append',
        default=[],
        metavar='[ROBOT=]FILE',
        help='the parameter file of all robots, or of one; given more than once for one robot, '
        'the files are read one over the other',
    )
    add(
        '--xacro-args',
        action='append',
        default=[],
        metavar='[ROBOT=]NAME:=VALUE …',
        help='arguments of all xacro files, or of one; may be given more than once',
    )
    add(
        '--fixed',
        action='append',
        default=[],
        metavar='ROBOT',
        help='have its root link fixed to the world, as that of an arm; all: of every robot',
    )
    add(
        '--replace',
        action='append',
        default=[],
        metavar='OLD=NEW',
        help='replace a text in a copy of each description; may be given more than once',
    )
    add(
        '--prefix',
        action='append',
        default=[],
        type=Path,
        metavar='FOLDER',
        help='an install prefix whose packages the descriptions name; a FOLDER of descriptions '
        'that is one is taken by itself',
    )
    add('--only', action='append', default=[], metavar='TEXT', help='robots whose name holds it')
    add('--jobs', type=int, default=1, metavar='N', help='robots side by side (1)')
    add('--timeout', type=float, default=180.0, metavar='S', help='s for each robot (180)')
    add('--json', type=Path, metavar='FILE', help='write everything that was found into it')
    add('--brief', action='store_true', help='the table without faults and warnings')
    return parser
