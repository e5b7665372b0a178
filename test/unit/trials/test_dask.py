# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Trials on a cluster: a real scheduler of Dask, and two workers, one of which is killed.

Dask is there where the engine is tested without ROS (``scripts/test engine``), and need not be
elsewhere: then it is said what would do.
"""

from contextlib import ExitStack
from importlib.util import find_spec
import json
import os
import subprocess
import sys
import threading
import time

import pytest
from support.paths import ROOT

from amr_description.errors import TrialsError
from amr_description.trials.command import dask_executor
from amr_description.trials.function import TrialFunction
from amr_description.trials.one_run import Ending
from amr_description.trials.runner import trials

FILE = ROOT / 'test' / 'fixtures' / 'trials' / 'drives.py'
HAS_DASK = find_spec('distributed') is not None
PATIENCE = 120.0
pytestmark = pytest.mark.skipif(not HAS_DASK, reason='with Dask, by scripts/test engine')


def start(program, *words):
    environment = {**os.environ, 'PYTHONPATH': os.pathsep.join(filter(None, sys.path))}
    command = [sys.executable, '-m', f'distributed.cli.dask_{program}', *words]
    return subprocess.Popen(command, env=environment, stdout=-3, stderr=-3)


@pytest.fixture
def cluster(tmp_path):
    """Address of a scheduler on this host, and two workers with a thread each."""
    file, local = tmp_path / 'scheduler.json', ['--host', '127.0.0.1', '--no-dashboard']
    started = [start('scheduler', *local, '--port', '0', '--scheduler-file', str(file))]
    one_thread = ['--no-nanny', '--nthreads', '1', '--local-directory', str(tmp_path)]
    try:
        for _ in range(2):
            worker = [*local, *one_thread, '--scheduler-file', str(file)]
            started.append(start('worker', *worker))
        deadline = time.monotonic() + PATIENCE
        while not (file.exists() and file.stat().st_size):
            assert time.monotonic() < deadline
            time.sleep(0.05)
        yield json.loads(file.read_text())['address'], started[1:]
    finally:
        for process in reversed(started):
            process.terminate()
        for process in started:
            process.wait(PATIENCE)


def in_cluster(cluster, name, *, killed=(), **options):
    """The report of trials; ``killed``: workers, when a tenth of the runs is done."""
    trial = TrialFunction.named(f'{FILE}:{name}')
    alone = trials(trial, workers=1, **options)
    has_killed = threading.Event()

    def kill(done, bad, total):
        if done >= total // 10 and not has_killed.is_set():
            has_killed.set()
            for worker in killed:
                worker.kill()

    with ExitStack() as stack:
        executor = dask_executor(cluster[0], stack)
        report = trials(trial, executor=executor, progress=kill, **options)
        assert has_killed.is_set()
    return alone, report


def test_a_worker_that_is_killed_loses_no_run_and_counts_none_twice(cluster):
    alone, report = in_cluster(cluster, 'slippery', seeds=30, killed=cluster[1][:1])
    assert [run.name for run in report.runs] == [run.name for run in alone.runs]
    assert len(report.runs) == 60
    assert report.to_json(times=False) == alone.to_json(times=False)
    assert report.digest == alone.digest
    assert cluster[1][0].wait(PATIENCE) == -9
    assert cluster[1][1].poll() is None


def test_a_run_that_hangs_there_is_ended_and_the_others_go_on(cluster):
    _, report = in_cluster(cluster, 'sometimes_loops', seeds=2, timeout=10.0)
    assert [run.kind for run in report.runs] == [*[Ending.PASSED] * 3, Ending.HUNG] * 2


def test_nobody_at_an_address_is_said():
    import dask

    with (
        dask.config.set({'distributed.comm.timeouts.connect': '0.2s'}),
        ExitStack() as stack,
        pytest.raises(TrialsError, match='no scheduler of Dask answers at tcp://127.0.0.1:1'),
    ):
        dask_executor('tcp://127.0.0.1:1', stack)
