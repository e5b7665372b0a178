# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
docs/install.md, "Install with pip", typed in an empty home on a machine without a compiler.

What is typed here is made by ``scripts/release``, twice, to the same bytes. It takes two minutes
and the network, and runs with ``--long``; in every run: test/tooling/test_release_wheel.py.
"""

import os
import shutil
import subprocess
import sys

import pytest
from support.doc_pages import Page
from support.paths import ROOT
from support.shells import line_of, PROMPT, terminal

README, INSTALL, PACKAGE = map(Page, ('../README.md', 'install.md', 'your_own_package.md'))
PATIENCE = 300  # s, for what fetches 150 packages
# All that a terminal and pip need; no compiler, no make, no linker.
PROGRAMS = 'bash cat dirname env grep head ls mkdir readlink rm sed sh sha256sum tr uname'
pytestmark = pytest.mark.long


@pytest.fixture(scope='module')
def release(tmp_path_factory):
    """The folder with the files of a draft."""
    folders = [tmp_path_factory.mktemp(name) / 'dist' for name in ('first', 'second')]
    for folder, mask in zip(folders, (0o022, 0o077), strict=True):
        command = [ROOT / 'scripts/release', '--draft', '--output', folder]
        subprocess.run(command, check=True, timeout=PATIENCE, umask=mask)
    first, second = ((folder / 'SHA256SUMS').read_text() for folder in folders)
    assert first == second
    return folders[0]


@pytest.fixture
def machine(release, tmp_path):
    """The words before a command that is to run there; the release lies in its home."""
    for name in ('bin', 'home'):
        (tmp_path / name).mkdir()
    for name in PROGRAMS.split():
        (tmp_path / 'bin' / name).symlink_to(shutil.which(name))
    (tmp_path / 'bin/python3').symlink_to(sys._base_executable)
    home = shutil.copytree(release, tmp_path / 'home', dirs_exist_ok=True)
    kept = {
        name: value
        for name, value in os.environ.items()
        if name.startswith('PIP_') or name.lower().endswith('_proxy')
    }
    cache = subprocess.run(
        [sys.executable, '-m', 'pip', 'cache', 'dir'], capture_output=True, text=True, check=True
    )
    variables = kept | {
        'PATH': str(tmp_path / 'bin'),
        'HOME': str(home),
        'ROS_DOMAIN_ID': os.environ['ROS_DOMAIN_ID'],
        'PIP_CACHE_DIR': cache.stdout.strip(),
        'PS1': PROMPT,
        'TERM': 'dumb',
        'COLUMNS': '200',
        'HISTFILE': '',
    }
    return ['env', '-i', *(f'{name}={value}' for name, value in variables.items())]


@pytest.fixture
def installed(machine, tmp_path):
    """The home, after the first three lines."""
    home = tmp_path / 'home'
    lines = ['sha256sum --check', 'python3 -m venv', 'ros/bin/pip install']
    script = 'set -e\n' + '\n'.join(line_of(INSTALL.text, line) for line in lines)
    done = subprocess.run(
        [*machine, 'bash', '-c', script],
        cwd=home,
        timeout=PATIENCE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    return home


def test_three_lines_give_a_ros_without_a_compiler(installed, machine):
    options = {'activate': '', 'folder': installed, 'machine': machine}
    with terminal(INSTALL.text, **options) as shell:
        shell.run('source ros/setup.bash')
        shell.start('ros2 launch amr_description simulation')
        shell.see(r'ready in \d+\.\d s')
        with terminal(INSTALL.text, **options) as other:
            assert '/diff_drive_controller/cmd_vel' in other.run('ros/bin/ros2 topic list')
            assert other.run('ros/bin/check_urdf').startswith('robot name is: amr\n')
            other.run('source ros/setup.bash')
            other.book = README.text
            assert 'frame_id: odom' in other.run('ros2 topic echo /odom --once')
            other.book = 'ros2 run amr_description talker'
            other.start('ros2 run')
            other.see(r'\[minimal_publisher\]: Publishing: "Hello World: \d+"')
            other.interrupt()
        shell.interrupt()
    # A workspace on top; then a shell that has sourced that alone.
    shutil.copytree(ROOT / 'examples/py_pubsub', installed / 'ros2_ws/src/py_pubsub')
    with terminal(INSTALL.text, **options) as shell:
        for line in ('source ros/', 'cd ~/ros2_ws', 'colcon build', 'source install/'):
            shell.run(line)
        shell.book = PACKAGE.text
        assert '1 passed' in shell.run('colcon test')
    with terminal(PACKAGE.text, **options) as shell:
        shell.run('source ~/ros2_ws/install/setup.bash')
        shell.start('ros2 run py_pubsub listener')
        with terminal(PACKAGE.text, **options) as other:
            other.run('source ~/ros2_ws/install/setup.bash')
            other.start('ros2 run py_pubsub talker')
            shell.see(r'\[minimal_subscriber\]: I heard: "Hello World: \d+"')
            other.interrupt()
        shell.interrupt()
