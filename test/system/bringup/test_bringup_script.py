# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``scripts/run``: set up, then become the bring-up; the set-up here is a stand-in."""

import os
import shutil
import signal
import subprocess

import pytest
from support.paths import ROOT

SCRIPT = ROOT / 'scripts/run'
PATIENCE = 30.0  # s


@pytest.fixture
def checkout(tmp_path):
    """A checkout whose set-up says so, and whose ``bringup`` prints its pid and arguments."""
    root = tmp_path / 'a checkout'
    for name, text in {
        'scripts/setup': 'echo "$PPID" >"$0.ran"; exec ${SETUP_DOES:-true}',
        'scripts/activate': 'export ACTIVATED="$AMR_ALONE"yes',
        'install/amr_description/lib/amr_description/bringup': (
            'echo "$$ $ACTIVATED$PYTHONDONTWRITEBYTECODE"; printf "%s\\n" "$@"'
        ),
    }.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'#!/bin/bash\n{text}\n')
        path.chmod(0o755)
    shutil.copy(SCRIPT, root / 'scripts/run')
    return root


def start(checkout, *words, **env):
    return subprocess.Popen(
        [checkout / 'scripts/run', *words],
        cwd='/',
        env={**os.environ, **env},
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


@pytest.mark.parametrize(
    ('words', 'passed'),
    [
        ([], ['simulation']),
        (['rtf:=0', 'world:=a b'], ['simulation', 'rtf:=0', 'world:=a b']),
        (['--show-args'], ['simulation', '--show-args']),
        (['simulation', 'rtf:=0'], ['simulation', 'rtf:=0']),
        (['my stack.py', '--print'], ['my stack.py', '--print']),
    ],
)
def test_it_becomes_the_bring_up_with_the_arguments(checkout, words, passed):
    with start(checkout, *words, PYTHONDONTWRITEBYTECODE='1') as process:
        first, *rest = process.communicate(timeout=PATIENCE)[0].splitlines()
    assert first == f'{process.pid} 1yes'
    assert rest == passed
    assert (checkout / 'scripts/setup.ran').exists()


def test_a_failed_set_up_ends_it(checkout):
    with start(checkout, SETUP_DOES='false') as process:
        assert process.communicate(timeout=PATIENCE)[0] == ''
    assert process.returncode == 1


def test_ctrl_c_during_the_set_up_ends_it(checkout):
    with start(checkout, SETUP_DOES='cat /dev/zero') as process:
        process.stdout.read(1)
        os.killpg(process.pid, signal.SIGINT)
        assert process.communicate(timeout=PATIENCE)[0].strip('\0') == ''
    assert process.returncode == -signal.SIGINT
