# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The shell side: how scripts/setup finds a Python, and what scripts/activate does to a shell."""

import os
from pathlib import Path
import shutil
import subprocess
import sys

import pytest
from support.needs import need_complete_python
from support.paths import ROOT

ACTIVATE = ROOT / 'scripts' / 'activate'
SHELLS = [shell for shell in ('bash', 'zsh') if shutil.which(shell)]
PLAIN = {'HOME': '/nowhere', 'PATH': '/usr/bin:/bin', 'TERM': 'dumb'}
needs_set_up = pytest.mark.skipif(
    Path(sys.prefix) != ROOT / '.venv', reason='needs what scripts/setup makes'
)


def shell_run(text, shell='bash', **environment):
    options = ['--norc', '--noprofile'] if shell == 'bash' else ['--no-rcs']
    return subprocess.run(
        [shell, *options, '-c', text],
        env=PLAIN | environment,
        capture_output=True,
        text=True,
        timeout=60,
    )


@pytest.fixture
def bare(tmp_path):
    """A checkout whose scripts/setup says which Python it found, and a PATH of its own."""
    checkout = tmp_path / 'check out'
    (checkout / 'scripts/environment').mkdir(parents=True)
    shutil.copy(ROOT / 'scripts/setup', checkout / 'scripts')
    main = checkout / 'scripts/environment/__main__.py'
    main.write_text('import sys; print("started by", sys.executable, sys.argv[1:])\n')
    programs = tmp_path / 'programs'
    programs.mkdir()
    for name in ('dirname', 'mkdir', 'sed', 'uname'):
        (programs / name).symlink_to(shutil.which(name))
    return checkout, programs


def program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'#!/bin/sh\n{text}\n')
    path.chmod(0o755)


def set_up(bare, **environment):
    checkout, programs = bare
    return subprocess.run(
        ['/bin/sh', checkout / 'scripts/setup'],
        env={'PATH': str(programs), 'HOME': str(checkout), **environment},
        capture_output=True,
        text=True,
        timeout=60,
    )


def test_python_on_the_path_is_taken(bare):
    need_complete_python()
    (bare[1] / 'python3').symlink_to(sys._base_executable)
    assert set_up(bare).stdout == f'started by {bare[1]}/python3 []\n'


@pytest.mark.parametrize(
    ('there', 'taken'),
    [
        ({'python3': '11', 'python3.12': '12', 'python3.13': '13'}, 'python3.12'),
        ({'python3': '13', 'python3.11': '11', 'python3.14': '14'}, 'python3'),
        ({'python3': '11', 'python3.14': '14'}, 'python3.14'),
        ({'python3': '12 Python.h', 'python3.11': '11'}, 'python3.11'),
    ],
)
def test_jazzys_own_comes_first_and_what_is_complete_before_that(bare, there, taken):
    for name, answer in there.items():
        program(bare[1] / name, f'case "$2" in -c) echo {answer} ;; *) echo {name} ;; esac')
    assert set_up(bare).stdout == f'{taken}\n'


def test_a_python_is_taken_when_apt_can_bring_what_it_lacks(bare):
    program(bare[1] / 'python3', 'case "$2" in -c) echo 11 pip Python.h ;; *) echo taken ;; esac')
    done = set_up(bare)
    assert (done.returncode, done.stdout) == (1, '')
    assert f'{bare[1]}/python3: lacks pip Python.h' in done.stderr
    for name in ('apt-get', 'dpkg-deb'):
        program(bare[1] / name, 'exit 1')
    assert set_up(bare).stdout == 'taken\n'


def test_python_that_does_not_start_is_passed_over(bare):
    need_complete_python()
    # As pyenv's python3.12 does when another version is chosen.
    program(bare[1] / 'python3.12', 'echo "pyenv: python3.12: command not found" >&2; exit 127')
    (bare[1] / 'python3').symlink_to(sys._base_executable)
    assert set_up(bare).stdout == f'started by {bare[1]}/python3 []\n'


def test_python_of_pyenv_is_found(bare, tmp_path):
    need_complete_python()
    python = tmp_path / 'py env/versions/3.12.1/bin/python3'
    program(python, f'exec {sys._base_executable} "$@"')
    done = set_up(bare, PYENV_ROOT=str(tmp_path / 'py env'))
    assert done.stdout.startswith('started by ')


def test_python_of_a_pyenv_that_only_the_path_names_is_found(bare, tmp_path):
    need_complete_python()
    root = tmp_path / 'py env'
    program(root / 'versions/3.12.1/bin/python3', f'exec {sys._base_executable} "$@"')
    program(root / 'shims/python3', 'echo "pyenv: python3: command not found" >&2; exit 127')
    done = set_up(bare, PATH=f'{bare[1]}:{root}/shims')
    assert done.stdout.startswith('started by ')


def test_python_of_uv_is_found(bare):
    need_complete_python()
    program(
        bare[0] / '.local/bin/uv',
        'case "$*" in --version) ;; "python find 3.12")'
        f' echo {sys._base_executable} ;; *) exit 1 ;; esac',
    )
    assert set_up(bare).stdout.startswith(f'started by {sys._base_executable}')


def test_the_host_that_a_python_comes_from_is_said_before_it_is_asked(bare):
    asks = '"python install 3.12") echo asked >&2; exit 1'
    uv = bare[0] / '.local/bin/uv'
    program(uv, f'case "$*" in {asks} ;; --version) ;; *) exit 1 ;; esac')
    done = set_up(bare)
    said, _, after = done.stderr.partition('fetching CPython 3.12 from github.com (35 MB), by uv')
    assert (done.returncode, 'asked' in said, 'uv python install 3.12: asked' in after) == (
        1, False, True,
    )  # fmt: skip
    other = set_up(bare, UV_PYTHON_INSTALL_MIRROR='https://mirror.example')
    assert 'fetching CPython 3.12 from https://mirror.example, by uv' in other.stderr


def test_no_python_gives_the_reasons_and_the_ways(bare):
    program(bare[1] / 'python3.12', 'echo "is broken" >&2; exit 1')
    done = set_up(bare)
    assert done.returncode == 1
    assert f'{bare[1]}/python3.12: is broken' in done.stderr
    for way in ('uv python install 3.12', 'pyenv install 3.12', 'apt install', 'AMR_PYTHON='):
        assert way in done.stderr


def test_named_python_is_taken_or_refused(bare):
    need_complete_python()
    chosen = set_up(bare, AMR_PYTHON=sys._base_executable)
    assert chosen.stdout.startswith(f'started by {sys._base_executable}')
    refused = set_up(bare, AMR_PYTHON='/nowhere/python')
    assert refused.returncode == 1
    assert 'AMR_PYTHON=/nowhere/python will not do: it is not there' in refused.stderr


def test_a_named_python_takes_the_place_of_that_of_an_environment(bare):
    need_complete_python()
    program(bare[0] / '.venv/bin/python', 'case "$1" in -ESc) ;; *) echo the old one ;; esac')
    assert set_up(bare).stdout == 'the old one\n'
    assert set_up(bare, AMR_PYTHON=sys._base_executable).stdout.startswith('started by')


@needs_set_up
@pytest.mark.parametrize('shell', SHELLS)
class TestActivate:
    def test_commands_and_packages_are_found(self, shell):
        done = shell_run(
            f'. {ACTIVATE}; command -v ros2 check_urdf bringup python colcon;'
            'echo $AMENT_PREFIX_PATH; echo $ROS_DISTRO $ROS_AUTOMATIC_DISCOVERY_RANGE;'
            'ros2 pkg prefix amr_description',
            shell,
        )
        programs = [
            str(ROOT / '.venv/bin' / name)
            for name in ('ros2', 'check_urdf', 'bringup', 'python', 'colcon')
        ]
        install = f'{ROOT}/install/amr_description'
        assert done.stderr == ''
        assert done.stdout.splitlines() == [
            *programs, f'{install}:{ROOT}/.venv', 'jazzy LOCALHOST', install,
        ]  # fmt: skip

    def test_programs_of_others_find_what_stands_in_for_packages(self, shell, tmp_path):
        robot = tmp_path / 'r.urdf.xacro'
        robot.write_text(
            '<robot name="$(find xacro)" xmlns:xacro="http://www.ros.org/wiki/xacro"/>'
        )
        code = (
            'from ament_index_python.packages import *;'
            'print(get_package_share_directory("controller_manager"), "py_pubsub" in '
            'get_packages_with_prefixes())'
        )
        done = shell_run(
            f". {ACTIVATE}; python -c '{code}'; xacro {robot} | tail -1;"
            ' $VIRTUAL_ENV/lib/controller_manager/spawner --help | head -1;'
            ' ros2 pkg prefix controller_manager; ros2 run xacro xacro --help 2>&1 | head -1',
            shell,
            HOME=str(tmp_path),
        )
        share, found, usage, run = done.stdout.splitlines()
        assert share == f'{ROOT}/.venv/share/controller_manager False'
        assert found == f'<robot name="{ROOT}/.venv/share/xacro"/>'
        assert usage.startswith('usage: spawner')
        assert 'Package not found' in done.stderr
        assert "package 'xacro' is not installed: running 'xacro' of amr_description" in run

    def test_nothing_that_foreign_programs_would_feel(self, shell):
        done = shell_run(f'. {ACTIVATE}; env', shell)
        names = {line.partition('=')[0] for line in done.stdout.splitlines()}
        assert not names & {'LD_LIBRARY_PATH', 'PYTHONPATH', '_ROS_WHEELS_BOOTSTRAP_COMPLETE'}

    def test_users_discovery_range_is_kept(self, shell):
        done = shell_run(
            f'. {ACTIVATE}; echo $ROS_AUTOMATIC_DISCOVERY_RANGE',
            shell,
            ROS_AUTOMATIC_DISCOVERY_RANGE='SUBNET',
        )
        assert done.stdout == 'SUBNET\n'

    def test_deactivate_takes_everything_back(self, shell):
        done = shell_run(
            f'before=$(env | sort; set | grep -i _amr | grep -v BASH_EXECUTION); . {ACTIVATE};'
            f' . {ACTIVATE}; deactivate;'
            ' after=$(env | sort; set | grep -i _amr | grep -v BASH_EXECUTION);'
            ' [ "$before" = "$after" ] || printf "%s\n---\n%s\n" "$before" "$after";'
            ' command -v deactivate ros2; echo end',
            shell,
        )
        assert done.stdout == 'end\n'

    def test_sourced_twice_is_sourced_once(self, shell):
        done = shell_run(f'. {ACTIVATE}; once=$(env); . {ACTIVATE}; [ "$once" = "$(env)" ]', shell)
        assert done.returncode == 0, done.stdout

    def test_script_started_from_an_activated_shell(self, shell, tmp_path):
        program(tmp_path / 'deactivate', 'echo a program of that name was run')
        inner = f'{shell} -c "set -e; . {ACTIVATE}; env" | grep -E "^(AMENT|COLCON|PATH)"'
        outer = 'env | grep -E "^(AMENT|COLCON|PATH)"'
        done = shell_run(
            f'. {ACTIVATE}; {outer}; {inner}', shell, PATH=f'{tmp_path}:/usr/bin:/bin'
        )
        lines = done.stdout.splitlines()
        assert lines[: len(lines) // 2] == lines[len(lines) // 2 :]

    def test_strict_shells_survive(self, shell):
        done = shell_run(f'set -eu; . {ACTIVATE}; echo $ROS_DISTRO', shell)
        assert (done.stdout, done.stderr) == ('jazzy\n', '')

    def test_other_ros2_wins(self, shell, tmp_path):
        program(tmp_path / 'real one/ros2', 'echo the real one: "$@"')
        path = f'{tmp_path}/real one:/usr/bin:/bin'
        done = shell_run(f'. {ACTIVATE}; ros2 topic list', shell, PATH=path)
        assert done.stdout == 'the real one: topic list\n'

    def test_sourced_ros_stays_in_charge(self, shell, tmp_path):
        index = tmp_path / 'share/ament_index/resource_index/packages/rclpy'
        index.parent.mkdir(parents=True)
        index.touch()
        done = shell_run(
            f'. {ACTIVATE}; echo $PATH $ROS_AUTOMATIC_DISCOVERY_RANGE',
            shell,
            AMENT_PREFIX_PATH=str(tmp_path),
        )
        assert done.stdout == '/usr/bin:/bin LOCALHOST\n'
        assert f'{tmp_path} is sourced here and stays in charge' in done.stderr

    def test_our_scripts_leave_a_sourced_ros_out(self, shell, tmp_path):
        for file in ('share/ament_index/resource_index/packages/rclpy', 'rclpy', 'librcl.so'):
            (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / file).touch()
        done = shell_run(
            f'AMR_ALONE=1; . {ACTIVATE}; echo $AMENT_PREFIX_PATH; echo $PYTHONPATH;'
            ' echo $LD_LIBRARY_PATH; command -v ros2',
            shell,
            AMENT_PREFIX_PATH=f'{tmp_path}:/my/overlay',
            PYTHONPATH=f'{tmp_path}:/my/controllers',
            LD_LIBRARY_PATH=str(tmp_path),
        )
        assert done.stdout.splitlines() == [
            f'{ROOT}/install/amr_description:{ROOT}/.venv:/my/overlay',
            '/my/controllers',
            '',
            f'{ROOT}/.venv/bin/ros2',
        ]

    def test_another_rclpy_on_the_python_path_is_named(self, shell, tmp_path):
        (tmp_path / 'rclpy').mkdir()
        done = shell_run(f'. {ACTIVATE}', shell, PYTHONPATH=str(tmp_path))
        assert f'names another rclpy ({tmp_path}); unset PYTHONPATH' in done.stderr

    def test_without_set_up_it_says_what_to_run(self, shell, tmp_path):
        (tmp_path / 'scripts').mkdir()
        copy = shutil.copy(ACTIVATE, tmp_path / 'scripts')
        done = shell_run(f'. {copy}; echo $?; env', shell)
        assert done.stdout.startswith('1\n')
        assert 'AMENT_PREFIX_PATH' not in done.stdout
        assert done.stderr == (f'scripts/activate: not set up yet; run {tmp_path}/scripts/setup\n')


def copied(tmp_path, home):
    """A checkout with an environment that is made for ``home``."""
    (tmp_path / 'scripts').mkdir()
    shutil.copy(ACTIVATE, tmp_path / 'scripts')
    for folder in ('.venv/.setup', '.venv/bin', 'install'):
        (tmp_path / folder).mkdir(parents=True)
    for name in ('local_setup.sh', 'bin/python'):
        program(tmp_path / '.venv' / name, '')
    (tmp_path / '.venv/.setup/home').write_text(f'{home}\n')
    return tmp_path / 'scripts/activate'


@pytest.mark.parametrize('shell', SHELLS)
def test_a_moved_or_copied_checkout_is_said(shell, tmp_path):
    activate = copied(tmp_path, f'/the/old{tmp_path}/.venv')
    done = shell_run(f'set -u; . {activate}; echo $?', shell)
    assert done.stdout == '1\n'
    assert f'was set up elsewhere (/the/old{tmp_path}/.venv), and moved' in done.stderr
    assert done.stderr.endswith(f'run {tmp_path}/scripts/setup\n')
    (tmp_path / '.venv/.setup/home').write_text(f'{tmp_path}/.venv\n')
    assert shell_run(f'. {activate}; echo $?', shell).stdout == '0\n'
    (tmp_path / '.venv/bin/python').unlink()
    assert 'its Python is gone' in shell_run(f'. {activate}', shell).stderr


@pytest.mark.parametrize('line', ['bash "$0"', '"$0"'])
def test_activate_says_that_it_is_to_be_sourced(line):
    command = ['bash', '-c', line, ACTIVATE]
    done = subprocess.run(command, env=PLAIN, capture_output=True, text=True)
    assert done.returncode == 1
    assert 'to be sourced, not run' in done.stderr


@needs_set_up
def test_workspace_on_top_finds_the_underlay():
    # colcon chains .venv into install/setup.bash, as it does with /opt/ros/jazzy.
    done = shell_run(f'. {ROOT}/install/setup.bash; echo $AMENT_PREFIX_PATH; command -v ros2')
    assert done.stdout.splitlines() == [
        f'{ROOT}/install/amr_description{os.pathsep}{ROOT}/.venv',
        f'{ROOT}/.venv/bin/ros2',
    ]


@needs_set_up
def test_workspace_on_top_keeps_to_this_host_unless_told_otherwise():
    line = f'. {ROOT}/install/setup.bash; echo $ROS_AUTOMATIC_DISCOVERY_RANGE'
    assert shell_run(line).stdout == 'LOCALHOST\n'
    assert shell_run(line, ROS_AUTOMATIC_DISCOVERY_RANGE='SUBNET').stdout == 'SUBNET\n'
