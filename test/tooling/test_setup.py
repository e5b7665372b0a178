# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What scripts/setup makes anew and when, and that an interruption leaves nothing half done."""

import fcntl
import os
from pathlib import Path
import shutil
import subprocess
import sys
import threading

import environment
from environment import (
    commands,
    interface_wheel,
    launchers,
    main,
    SetupError,
    virtual_environment,
    workspace,
)
from environment.checkout import Checkout
from environment.commands import run
from environment.stamps import digest, digest_files, files_below, Stamp
import pytest
from support.paths import ROOT

BUILDER = 'amr_description/interface_build'


@pytest.fixture
def checkout(tmp_path):
    """A checkout with the files that decide what is made; its path has a space."""
    root = tmp_path / 'my checkout'
    files = {
        'pyproject.toml': '',
        'setup.py': '',
        'setup.cfg': '',
        'package.xml': '<package/>',
        'scripts/tools.lock': 'lark-parser==0.12.0\n',
        'scripts/requirements.lock': 'setuptools==79.0.1\npytest==9.2.0\nros-rclpy==7.1.6\n',
        'interfaces/a_msgs/msg/A.msg': 'int8 a\n',
        **{f'{BUILDER}/{name}.py': '' for name in interface_wheel.BUILDER},
        'urdf/robot.urdf': '<robot/>',
        'config/controllers.yaml': '{}',
    }
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return Checkout(root)


@pytest.fixture
def made(checkout, monkeypatch):
    """What set_up had made, in order; the work itself is left out."""
    calls = []

    def create(venv, _environment, with_pip):
        calls.append('environment')
        shutil.rmtree(venv, ignore_errors=True)  # as the real one
        python = virtual_environment.python_of(venv)
        python.parent.mkdir(parents=True)
        python.symlink_to(sys.executable)
        virtual_environment.site_packages(venv).mkdir(parents=True)
        (venv / 'pyvenv.cfg').write_text(f'command = {venv}')

    def build(checkout, _environment, on_top):
        calls.append('workspace, on top' if on_top else 'workspace')
        checkout.build.mkdir(parents=True, exist_ok=True)
        link = checkout.build / 'amr_description'
        link.unlink(missing_ok=True)
        link.symlink_to(checkout.root / 'amr_description')
        virtual_environment.site_packages(checkout.install).mkdir(parents=True, exist_ok=True)

    monkeypatch.setattr(virtual_environment, 'create', create)
    monkeypatch.setattr(virtual_environment, 'begin', lambda *_: None)
    monkeypatch.setattr(virtual_environment, 'complete', lambda *_: None)
    monkeypatch.setattr(interface_wheel, 'built', lambda *_: None)
    monkeypatch.setattr(interface_wheel, 'install', lambda *_: calls.append('interfaces'))
    monkeypatch.setattr(workspace, 'build', build)

    def set_up():
        calls.clear()
        busy = main.set_up(checkout, {'HOME': str(checkout.root)})
        assert busy == bool(calls)
        return list(calls)

    return set_up


def interrupt(*_, **_options):
    raise KeyboardInterrupt


def test_all_is_made_once(made, checkout):
    assert made() == ['environment', 'interfaces', 'workspace']
    assert made() == []
    assert not list(checkout.root.glob('.venv.*'))


def test_edits_of_data_need_nothing_but_new_files_a_build(made, checkout):
    made()
    (checkout.root / 'config/controllers.yaml').write_text('changed: true')
    assert made() == []
    (checkout.root / 'config/more.yaml').touch()
    assert made() == ['workspace, on top']
    (checkout.root / 'config/more.yaml').unlink()
    assert made() == ['workspace, on top']


@pytest.mark.parametrize('name', ['pyproject.toml', 'setup.py', 'setup.cfg', 'package.xml'])
def test_another_manifest_needs_a_build(made, checkout, name):
    made()
    (checkout.root / name).write_text('changed')
    assert made() == ['workspace, on top']


def test_another_interface_needs_the_wheel_alone(made, checkout):
    made()
    (checkout.interfaces / 'a_msgs/msg/B.msg').write_text('int8 b\n')
    assert made() == ['interfaces']
    (checkout.root / BUILDER / 'stage.py').write_text('changed')
    assert made() == ['interfaces']
    (checkout.root / BUILDER / 'wheel.py').write_text('of no concern')
    assert made() == []


def test_another_lock_needs_all(made, checkout):
    made()
    checkout.requirements.write_text('setuptools==79.0.1\n')
    assert made() == ['environment', 'interfaces', 'workspace, on top']


def test_a_moved_checkout_needs_all(made, checkout, monkeypatch):
    made()
    moved = checkout.root.rename(checkout.root.with_name('elsewhere'))
    assert main.set_up(Checkout(moved), {'HOME': str(moved)})
    assert (moved / '.venv/pyvenv.cfg').read_text() == f'command = {moved}/.venv'


@pytest.mark.parametrize('folder', ['.venv', 'build', 'install'])
def test_a_deleted_result_is_made_again(made, checkout, folder):
    made()
    (checkout.root / folder).rename(checkout.root / 'gone')
    assert made() != []
    assert made() == []


def test_a_build_that_copies_or_is_of_another_place_is_not_complete(checkout, tmp_path):
    link = checkout.build / 'amr_description'
    link.parent.mkdir(parents=True)
    packages = virtual_environment.site_packages(checkout.install)
    packages.mkdir(parents=True)
    link.symlink_to(checkout.root / 'amr_description')
    assert workspace.is_complete(checkout)
    other = packages.parent.rename(checkout.install / 'lib/python3.99')
    assert not workspace.is_complete(checkout)
    other.rename(packages.parent)
    link.unlink()
    link.symlink_to(tmp_path / 'where it was' / 'amr_description')
    assert not workspace.is_complete(checkout)
    link.unlink()
    link.mkdir()
    assert not workspace.is_complete(checkout)


def test_a_python_that_is_gone_is_noticed(made, checkout):
    made()
    python = virtual_environment.python_of(checkout.venv)
    python.unlink()
    python.symlink_to('/nowhere/python3.12')
    assert made() == ['environment', 'interfaces']


@pytest.mark.parametrize(
    ('module', 'step', 'left'),
    [
        (interface_wheel, 'built', ['environment', 'interfaces', 'workspace']),
        (virtual_environment, 'complete', ['environment', 'interfaces', 'workspace']),
        (interface_wheel, 'install', ['environment', 'interfaces', 'workspace']),
        (virtual_environment, 'relocate', ['environment', 'interfaces', 'workspace']),
        (virtual_environment, 'replace', ['environment', 'interfaces', 'workspace']),
        (workspace, 'build', ['workspace']),
    ],
)
def test_an_interruption_leaves_that_step_to_do(made, monkeypatch, module, step, left):
    with monkeypatch.context() as patch:
        patch.setattr(module, step, interrupt)
        with pytest.raises(KeyboardInterrupt):
            made()
    assert made() == left
    assert made() == []


def test_an_interrupted_rebuild_is_noticed_though_all_files_are_there(made, checkout, monkeypatch):
    made()
    (checkout.root / 'setup.py').write_text('changed')
    with monkeypatch.context() as patch:
        patch.setattr(workspace, 'build', interrupt)
        with pytest.raises(KeyboardInterrupt):
            made()
    (checkout.root / 'setup.py').write_text('')
    assert made() == ['workspace']


def test_second_set_up_waits_for_the_first(checkout):
    program = (
        'import sys; sys.path.insert(0, sys.argv[1])\n'
        'from pathlib import Path\n'
        'from environment import checkout\n'
        'with checkout.one_at_a_time(checkout.Checkout(Path(sys.argv[2]))): print("mine")\n'
    )
    with (checkout.root / '.setup.lock').open('w') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        second = subprocess.Popen(
            [sys.executable, '-c', program, ROOT / 'scripts', checkout.root],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert 'waiting' in second.stderr.readline()
        assert second.poll() is None
    output, _ = second.communicate(timeout=30)
    assert output == 'mine\n'


def test_lock_lasts_as_long_as_what_a_killed_set_up_has_started(checkout):
    started, go_on = checkout.root / 'started', checkout.root / 'go_on'
    os.mkfifo(started)
    os.mkfifo(go_on)
    program = (
        'import os, sys; sys.path.insert(0, sys.argv[1])\n'
        'from pathlib import Path\n'
        'from environment import checkout, commands\n'
        'root = Path(sys.argv[2])\n'
        'with checkout.one_at_a_time(checkout.Checkout(root)):\n'
        '    step = ["sh", "-c", "echo > started; read line < go_on"]\n'
        '    commands.run(step, os.environ, "reading", root)\n'
    )
    first = subprocess.Popen([sys.executable, '-c', program, ROOT / 'scripts', checkout.root])
    started.read_text()
    first.kill()
    first.wait()
    with (checkout.root / '.setup.lock').open() as lock:
        with pytest.raises(BlockingIOError):
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        go_on.write_text('now\n')
        fcntl.flock(lock, fcntl.LOCK_EX)


def test_digest_tells_parts_apart():
    assert digest('ab', 'c') != digest('a', 'bc')
    assert digest('a') == digest(b'a')


def test_digest_of_files_sees_names_and_contents(tmp_path):
    one, other = tmp_path / 'one', tmp_path / 'other'
    one.write_text('text')
    before = digest_files(files_below(tmp_path), tmp_path)
    (tmp_path / '__pycache__').mkdir()
    (tmp_path / '__pycache__/one.pyc').touch()
    assert digest_files(files_below(tmp_path), tmp_path) == before
    one.rename(other)
    assert digest_files(files_below(tmp_path), tmp_path) != before


def test_stamp_holds_what_was_written_until_removed(tmp_path):
    stamp = Stamp(tmp_path / 'deep' / 'stamp')
    assert not stamp.holds('key')
    stamp.write('key')
    assert stamp.holds('key')
    assert not stamp.holds('other')
    stamp.remove()
    assert not stamp.holds('key')


def test_wheel_depends_on_the_ros_it_is_compiled_against_not_on_the_rest(checkout):
    def key(lock):
        checkout.requirements.write_text(lock)
        return interface_wheel.key(checkout)

    first = key('pytest==1\nros-rmw==1\n')
    assert key('pytest==2\nros-rmw==1\n') == first
    assert key('ros-ament-cmake-core==1\nros-ament-package==1\nros-rmw==1\n') == first
    assert key('pytest==1\nros-rmw==2\n') != first


def test_a_failing_command_shows_its_last_lines():
    command = [sys.executable, '-c', 'import sys; print(*range(99), sep="\\n"); sys.exit(7)']
    with pytest.raises(SetupError, match=r'(?s)counting failed \(exit code 7\).*\| 97\n.*\| 98'):
        run(command, os.environ, 'counting')


def test_a_command_that_goes_on_shows_where_it_is(tmp_path, monkeypatch):
    go_on, said = tmp_path / 'go_on', []
    os.mkfifo(go_on)

    def progress(text):
        said.append(text)
        if 'half way' in text and go_on.exists():
            go_on.write_text('now\n')
            go_on.unlink()

    monkeypatch.setattr(commands, 'progress', progress)
    monkeypatch.setattr(commands, 'HEARTBEAT', 0.01)
    run(['sh', '-c', 'echo "half   way"; read line < go_on'], os.environ, 'counting', tmp_path)
    assert '  counting: half way' in said
    assert set(said) <= {'  counting: at work', '  counting: half way'}


def test_a_failure_ends_what_runs_beside_it():
    begun = threading.Event()
    ends = []

    def work():
        begun.set()
        try:
            commands.run([sys.executable, '-c', 'import time; time.sleep(60)'], {}, 'sleeping')
        except SetupError as error:
            ends.append(str(error))

    for failure in (SetupError('full'), KeyboardInterrupt()):
        with pytest.raises(type(failure)), commands.beside(work):
            assert begun.wait(10.0)
            raise failure
    assert len(ends) == 2
    commands.run([sys.executable, '-c', ''], {}, 'the next one')


def test_a_failure_beside_comes_at_the_end():
    def work():
        commands.run([sys.executable, '-c', 'print("no disk"); 1 / 0'], {}, 'building')

    with pytest.raises(SetupError, match='building failed'), commands.beside(work):
        inside = True
    assert inside


def test_a_line_of_progress_has_its_time(capsys, monkeypatch):
    monkeypatch.setattr(environment, '_START', environment.time.monotonic() - 75.0)
    environment.progress('building')
    assert capsys.readouterr().err == 'scripts/setup: [ 75 s] building\n'


def test_relocated_text_names_the_new_home_and_programs_are_left(tmp_path):
    fresh, home = tmp_path / '.venv.new', tmp_path / '.venv'
    (fresh / 'bin').mkdir(parents=True)
    (fresh / 'pyvenv.cfg').write_text(f'command = python -m venv {fresh}')
    (fresh / 'bin/pip').write_text(f'#!{fresh}/bin/python\nimport pip\n')
    program = b'\x7fELF\0' + os.fsencode(fresh)
    (fresh / 'bin/ruff').write_bytes(program)
    (fresh / 'bin/python').symlink_to(sys.executable)
    virtual_environment.relocate(fresh, home)
    assert (fresh / 'pyvenv.cfg').read_text() == f'command = python -m venv {home}'
    assert (fresh / 'bin/pip').read_text() == f'#!{home}/bin/python\nimport pip\n'
    assert (fresh / 'bin/ruff').read_bytes() == program
    assert (fresh / 'bin/python').is_symlink()


def test_replaced_environment_leaves_nothing_behind(tmp_path):
    for name in ('.venv', '.venv.new', '.venv.old'):
        (tmp_path / name).mkdir()
        (tmp_path / name / 'which').write_text(name)
    virtual_environment.replace(tmp_path / '.venv', tmp_path / '.venv.new')
    assert [path.name for path in tmp_path.iterdir()] == ['.venv']
    assert (tmp_path / '.venv/which').read_text() == '.venv.new'


def test_commands_start_our_python_with_the_libraries(tmp_path):
    venv = tmp_path / 'with space' / '.venv'
    packages = virtual_environment.site_packages(venv)
    (packages / 'ros_rcl.libs').mkdir(parents=True)
    checkout = Checkout(tmp_path / "with 'quotes'")
    launchers.write(venv, venv, checkout)
    python = venv / 'bin/python'
    python.write_text(
        '#!/bin/sh\necho "$_ROS_WHEELS_BOOTSTRAP_COMPLETE|$LD_LIBRARY_PATH"\nprintf "%s|" "$@"\n'
    )
    python.chmod(0o755)
    libraries = f'{venv}/lib:{packages}/ros_rcl.libs'
    for given, seen in (({}, libraries), ({'LD_LIBRARY_PATH': '/x'}, f'{libraries}:/x')):
        done = subprocess.run(
            [venv / 'bin/ros2', 'topic', 'a b'], env=given, capture_output=True, text=True
        )
        code = launchers.CODE.format(build=str(checkout.build))
        assert done.stdout == f'1|{seen}\n-P|-c|{code}|ros2|topic|a b|'
    assert (packages / 'amr_description.pth').read_text() == (f'{checkout.build}\n')


def test_bringup_is_the_installed_executable(tmp_path):
    checkout = Checkout(tmp_path / "with 'quotes'")
    launchers.write(checkout.venv, checkout.venv, checkout)
    executable = checkout.install / 'lib/amr_description/bringup'
    executable.parent.mkdir(parents=True)
    executable.write_text('#!/bin/sh\nprintf "%s|" "$LD_LIBRARY_PATH" "$@"\n')
    executable.chmod(0o755)
    done = subprocess.run(
        [checkout.venv / 'bin/bringup', 'stop', 'a b'], env={}, capture_output=True, text=True
    )
    assert done.stdout == '|stop|a b|'


def test_executable_starts_where_the_path_has_spaces(tmp_path):
    folder = tmp_path / 'with space'
    folder.mkdir()
    python = folder / 'python3'
    python.write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
    python.chmod(0o755)
    script = folder / 'talker'
    script.write_text(f'#!"{python}"\nimport sys\nprint(*sys.argv[1:], sep="|")\n')
    script.chmod(0o755)
    workspace.make_startable(script, python)
    done = subprocess.run([script, 'a b', 'c'], capture_output=True, text=True, check=True)
    assert done.stdout == 'a b|c\n'


def test_executable_that_starts_is_left_as_it_is(tmp_path):
    script = tmp_path / 'talker'
    script.write_text('#!/usr/bin/python3\n')
    workspace.make_startable(script, Path('/x/python'))
    assert script.read_text() == '#!/usr/bin/python3\n'


def test_takes_no_arguments(capsys):
    assert main.main(['now']) == 2
    assert 'takes no arguments' in capsys.readouterr().err


def test_settings_of_the_shell_that_do_not_count_are_named(monkeypatch, capsys):
    monkeypatch.setattr(main, 'set_up', lambda *_: True)
    assert main.main([], {'PYTHONPATH': '/x', 'CONDA_PREFIX': '/conda'}) == 0
    ignored, done = capsys.readouterr().err.splitlines()
    assert ignored == (
        'scripts/setup: ignoring PYTHONPATH and the conda environment /conda of this shell: '
        'it uses the ROS of PyPI alone'
    )
    assert done.startswith('scripts/setup: done in ')


def test_a_full_or_foreign_disk_is_one_line(monkeypatch, capsys):
    def refuse(*_):
        raise PermissionError(13, 'Permission denied', '/srv/checkout/.setup.lock')

    monkeypatch.setattr(main, 'one_at_a_time', refuse)
    assert main.main([]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith('scripts/setup: error: ')
    assert "Permission denied: '/srv/checkout/.setup.lock'" in line
