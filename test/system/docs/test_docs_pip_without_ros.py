# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
docs/simulation.md, "Install", in an empty home with another Python and no ROS.

It fetches 70 MB, and runs with ``--long``; in every run: test/tooling/test_release_wheel.py, and
that what is imported is declared, in test/tooling/test_architecture.py.
"""

import os
import re
import signal
import subprocess
import sys

from environment import engine
import pytest
from releasing import package_wheel
from support.chromium import Chromium
from support.doc_pages import Page
from support.paths import ROOT
from support.running_programs import PATIENCE

PAGE = Page('simulation.md')
FETCHING = 300  # s
pytestmark = pytest.mark.long


class Machine:
    """An empty home, and an environment in it."""

    def __init__(self, home):
        self.home = home
        kept = {name: value for name, value in os.environ.items() if name.startswith('PIP_')}
        command = [sys.executable, '-m', 'pip', 'cache', 'dir']
        cache = subprocess.run(command, capture_output=True, text=True, check=True)
        self._variables = kept | {
            'HOME': str(home),
            'PATH': '/usr/bin:/bin',
            'PIP_CACHE_DIR': cache.stdout.strip(),
        }

    def type(self, *words, **options):
        options = {'cwd': self.home, 'env': self._variables, 'text': True, **options}
        return subprocess.Popen(words, stdout=subprocess.PIPE, **options)

    def run(self, *words):
        with self.type(*words) as running:
            said, _ = running.communicate(timeout=FETCHING)
        assert running.returncode == 0, said
        return said

    def files(self):
        return {path for path in (self.home / 'amr').rglob('*') if path.is_file()}


@pytest.fixture(scope='module')
def machine(tmp_path_factory):
    machine = Machine(tmp_path_factory.mktemp('home'))
    machine.run(engine.find_python(os.environ), '-m', 'venv', 'amr')
    return machine


def test_a_wheel_is_all_that_is_needed_and_leaves_no_file(machine):
    built = package_wheel.build(ROOT, ROOT / '.venv', machine.home, 1700000000, os.environ)
    wheels = [path.name for path in built]
    program = machine.home / 'amr' / 'bin'
    before = machine.files()
    (line,) = re.findall(r'^python -m (pip install amr_.*\.whl)$', PAGE.text, re.MULTILINE)
    assert line.endswith(f' {wheels[0]}')
    machine.run(program / 'python', '-m', *line.split())
    machine.run(program / 'pip', 'check')
    said = machine.run(program / 'python', '-c', PAGE.blocks('python')[0])
    assert said.startswith('it is at 1.000 m, and takes itself to be at 1.000 m\n')
    drive_by_the_page(machine, program / 'amr')
    named = machine.run(program / 'pip', 'freeze').splitlines()
    names = [re.split(r'[= @]', each)[0] for each in named]
    machine.run(program / 'pip', 'uninstall', '--yes', *names)
    left = {path for path in machine.files() - before if '/pip/' not in str(path)}
    assert left == set()
    assert {path.name for path in machine.home.iterdir()} <= {'amr', *wheels}


def drive_by_the_page(machine, program):
    with machine.type(program, '--port', '0', '--world', 'ramp') as running:
        try:
            url = re.search(r'http://\S+/', running.stdout.readline())[0]
            with Chromium() as browser:
                page = browser.open(url)
                page.wait_until('amr.now.scene.pose !== null')
                page.key_down('KeyW')
                page.wait_until('amr.now.scene.pose.x > 0.2')
                page.key_up('KeyW')
            running.send_signal(signal.SIGINT)
            assert running.wait(PATIENCE) == 0
        finally:
            running.kill()
