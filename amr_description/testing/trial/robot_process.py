# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
One robot in a process with a time limit.

What it starts ends with it: the simulator watches a pipe to it. A process that is asked to end and
does not is killed; what it has found until then is in its result file.
"""

from dataclasses import asdict
import json
import os
from pathlib import Path
import signal
import subprocess
import sys
import tempfile
import threading
import time

from amr_description.testing.trial.findings import Findings, from_json
from amr_description.testing.trial.one_robot import Job
from amr_description.text import one_line

_MODULE = 'amr_description.testing.trial.one_robot'
_STOP_TIMEOUT = 25.0
"""s from SIGINT to SIGKILL: a simulator may take 15 of them."""


def try_robot(job: Job, timeout: float, running: set[subprocess.Popen[bytes]]) -> Findings:
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
        found = Findings(job.robot, job.file)
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
