# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 run``: what is found, what the child gets, how it ends."""

from argparse import ArgumentParser
import os
import signal
import sys

from fixtures.cli.commands import ros2, started
import pytest
from support.waiting import until

from amr_description.ament_index import executables_of, package_prefix, packages
from amr_description.cli import run as run_verb
from amr_description.cli.run import _find as find_executable, STAND_INS
from amr_description.errors import AmrError

PYTHON = f'#!{sys.executable}\n'
EXECUTABLES = {
    'echo_words': '#!/bin/sh\necho words "$@"\n',
    'fail': '#!/bin/sh\nexit 3\n',
    'clean': PYTHON
    + """\
import signal, sys, time
signal.signal(signal.SIGTERM, lambda *_: sys.exit('terminated'))
try:
    print('up', flush=True)
    while True:
        time.sleep(0.02)  # a signal just before a call that blocks is handled after it
except KeyboardInterrupt:
    print('interrupted', flush=True)
""",
    'default': PYTHON
    + """\
import signal
signal.signal(signal.SIGINT, signal.SIG_DFL)
print('up', flush=True)
signal.pause()
""",
    'environment': '#!/bin/sh\necho "${MINE-} ${PYTHONUNBUFFERED-}"\n'
    "grep -E 'SigBlk|SigIgn' /proc/self/status\n",
    'parts/deep': '#!/bin/sh\necho deep\n',
    '.hidden/buried': '#!/bin/sh\necho buried\n',
    'one/twin': '#!/bin/sh\n',
    'two/twin': '#!/bin/sh\n',
}


@pytest.fixture(scope='module')
def prefix(tmp_path_factory):
    """A prefix with the packages ``toys``, full of executables, and ``books``, without any."""
    folder = tmp_path_factory.mktemp('prefix')
    index = folder / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    for package in ('toys', 'books'):
        (index / package).touch()
    for name, text in EXECUTABLES.items():
        path = folder / 'lib/toys' / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)
    (folder / 'lib/toys/notes.txt').write_text('not executable')
    return str(folder)


@pytest.fixture
def run(prefix):
    def run_it(*args, **env):
        return ros2('run', *args, AMENT_PREFIX_PATH=prefix, **env)

    return run_it


@pytest.fixture
def in_prefix(prefix, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', prefix)


def test_words_are_handed_over_as_they_stand(run):
    words = ['--ros-args', '-p', 'x:=1', '-h', '--', '--prefix', 'a b']
    result = run('toys', 'echo_words', *words)
    assert result.stdout == f'words {" ".join(words)}\n'
    assert (result.returncode, result.stderr) == (0, '')


def test_executables_are_found_in_folders_too(run):
    assert run('toys', 'deep').stdout == 'deep\n'


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        (('nope', 'x'), "Package 'nope' not found"),
        (('../toys', 'x'), "Package '../toys' not found"),
        (('toyss', 'x'), "Package 'toyss' not found; did you mean toys?\n"),
        (('books', 'x'), 'No executable found'),
        (('toys', 'buried'), 'No executable found'),
        (('toys', 'notes.txt'), 'No executable found'),
        (('toys', 'dep'), "No executable found: package 'toys' has no 'dep', it has "),
        (('--prefix', 'no_such_command -x', 'toys', 'deep'), "--prefix 'no_such_command -x'"),
    ],
)
def test_what_is_not_there_is_told(run, words, said):
    result = run(*words)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.startswith(said)
    assert result.stderr.count('\n') == 1


def test_two_of_one_name_are_told(run, prefix):
    result = run('toys', 'twin')
    assert result.returncode == 1
    assert result.stderr.splitlines() == [
        'Multiple executables found:',
        f'- {prefix}/lib/toys/one/twin',
        f'- {prefix}/lib/toys/two/twin',
    ]


def test_without_an_index_the_way_to_one_is_told():
    result = ros2('run', 'toys', 'deep', AMENT_PREFIX_PATH='')
    assert result.returncode == 1
    assert result.stderr.startswith("Package 'toys' not found: AMENT_PREFIX_PATH is empty;")


def test_a_failure_is_told_and_handed_on(run):
    result = run('toys', 'fail')
    assert (result.returncode, result.stdout) == (3, '[ros2run]: Process exited with failure 3\n')


def test_a_prefix_stands_before_the_command(run, prefix):
    result = run('--prefix', 'echo "two words"', 'toys', 'deep', 'end')
    assert result.stdout == f'two words {prefix}/lib/toys/parts/deep end\n'
    assert run('--prefix', '"', 'toys', 'deep').returncode == 2


def test_a_child_starts_as_from_a_shell(run):
    variables, blocked, ignored = run('toys', 'environment', MINE='1').stdout.splitlines()
    assert variables == f'1 {os.environ.get("PYTHONUNBUFFERED", "")}'
    assert int(blocked.split()[1], 16) == 0
    assert int(ignored.split()[1], 16) & (1 << (signal.SIGPIPE - 1)) == 0


@pytest.fixture
def only_ours(tmp_path):
    """A prefix with nothing but a package of our name, whose executables print their words."""
    index = tmp_path / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    (index / 'amr_description').touch()
    folder = tmp_path / 'lib/amr_description'
    folder.mkdir(parents=True)
    for name in ('talker', 'spawner'):
        (folder / name).write_text(f'#!/bin/sh\necho our {name} "$@"\n')
        (folder / name).chmod(0o755)
    return tmp_path


def test_a_stand_in_is_named_once_and_steps_back_for_the_original(only_ours):
    result = ros2('run', 'py_pubsub', 'talker', 'a b', AMENT_PREFIX_PATH=str(only_ours))
    assert (result.returncode, result.stdout) == (0, 'our talker a b\n')
    assert result.stderr == (
        "[ros2run]: package 'py_pubsub' is not installed: running 'talker' of amr_description\n"
    )
    (only_ours / 'share/ament_index/resource_index/packages/py_pubsub').touch()
    result = ros2('run', 'py_pubsub', 'talker', AMENT_PREFIX_PATH=str(only_ours))
    assert result.stderr.startswith('No executable found')


def test_what_stands_in_for_others_of_a_package_is_told(only_ours):
    result = ros2('run', 'robot_localization', 'ukf_node', AMENT_PREFIX_PATH=str(only_ours))
    assert result.returncode == 1
    assert result.stderr == (
        "Package 'robot_localization' not found; of it there are here: ekf_node, "
        'navsat_transform_node\n'
    )


@pytest.mark.parametrize(
    ('package', 'name', 'ours'),
    [
        ('demo_nodes_py', 'talker', 'demo_talker'),
        ('demo_nodes_py', 'listener', 'demo_listener'),
        ('controller_manager', 'spawner.py', 'spawner'),
        ('tf2_tools', 'view_frames.py', 'view_frames'),
    ],
)
def test_stand_ins_by_other_names(package, name, ours):
    assert STAND_INS[package, name] == ours
    assert ours in {path.name for path in executables_of('amr_description')}


@pytest.mark.parametrize(
    ('executable', 'node', 'topic'),
    [('talker', '/demo/mine', '/demo/news'), ('listener', '/demo/mine', '/demo/news')],
)
def test_a_demo_node_is_renamed_and_remapped_as_the_original(executable, node, topic):
    rules = ('-r', '__ns:=/demo', '-r', '__node:=mine', '-r', 'chatter:=news')
    with started('run', 'demo_nodes_py', executable, '--ros-args', *rules) as program:
        kind = 'Publishers' if executable == 'talker' else 'Subscribers'

        def is_there():  # the node is found once it has started
            said = ros2('node', 'info', node).stdout.partition(kind)[2].partition('Service')[0]
            return f'{topic}: std_msgs/msg/String' in said

        until(is_there)
        program.end(signal.SIGINT)


def test_every_program_of_ros2_control_has_a_stand_in():
    programs = {'hardware_spawner', 'ros2_control_node', 'spawner', 'unspawner'}
    ours = {STAND_INS['controller_manager', program] for program in programs}
    assert ours <= {path.name for path in executables_of('amr_description')}


@pytest.mark.parametrize('name', ['joint_state_publisher_gui', 'rviz2'])
def test_what_would_do_instead_of_a_program_with_a_window_is_told(only_ours, name):
    result = ros2('run', name, name, AMENT_PREFIX_PATH=str(only_ours))
    assert (result.returncode, result.stdout) == (1, '')
    (line,) = result.stderr.splitlines()
    assert "the page of 'ros2 launch amr_description display'" in line


@pytest.mark.parametrize(
    ('package', 'name', 'said'),
    [
        (
            'ros_gz_bridge',
            'parameter_bridge',
            'no bridge is needed: the simulator',
        ),
        ('rqt_graph', 'rqt_graph', "'ros2 node info NODE'"),
        ('nav2_bringup', 'anything', 'on a machine with ROS 2 Jazzy beside the simulator'),
        ('ros_gz_sim', 'gzserver', 'the simulator here is MuJoCo'),
    ],
)
def test_what_would_do_instead_of_a_package_is_told(only_ours, monkeypatch, package, name, said):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(only_ours))
    with pytest.raises(AmrError, match=f"^Package '{package}' not found: .*{said}"):
        find_executable(package, name)


@pytest.mark.parametrize(
    'name', ['joint_state_publisher', 'robot_state_publisher', 'teleop_twist_keyboard', 'xacro']
)
def test_what_launch_files_start_has_a_stand_in(name):
    assert STAND_INS[name, name] in {path.name for path in executables_of('amr_description')}


def test_a_stand_in_that_does_not_exist_yet_is_told(only_ours):
    result = ros2('run', 'ros_gz_sim', 'create', AMENT_PREFIX_PATH=str(only_ours))
    assert (result.returncode, result.stdout, result.stderr) == (
        1,
        '',
        "Package 'ros_gz_sim' not found, and amr_description has no 'create' yet\n",
    )


def test_without_us_a_stand_in_is_not_found(run):
    assert run('py_pubsub', 'talker').stderr == "Package 'py_pubsub' not found\n"


@pytest.mark.parametrize(
    ('words', 'blocked'),
    [
        (['amr_description', 'talker'], {signal.SIGINT}),
        (['--prefix', 'nice', 'amr_description', 'talker'], set()),
        (['toys', 'clean'], set()),
    ],
)
def test_ctrl_c_waits_until_a_program_of_ours_is_imported(prefix, monkeypatch, words, blocked):
    """It would print a traceback; ``entry.py`` unblocks it."""
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{prefix}:{os.environ["AMENT_PREFIX_PATH"]}')
    given = []
    monkeypatch.setattr(run_verb, 'run_to_end', lambda *args: given.append(args) or 0)
    parser = ArgumentParser()
    run_verb.add_arguments(parser)
    assert run_verb.main(parser.parse_args(words)) == 0
    [(_, _, found)] = given
    assert found == blocked


def test_what_is_blocked_is_so_in_the_child_alone(capfd):
    code = 'import signal; print(signal.pthread_sigmask(signal.SIG_BLOCK, []))'
    command = [sys.executable, '-c', code]
    assert run_verb.run_to_end(command, os.environ, {signal.SIGINT}) == 0
    assert run_verb.run_to_end(command, os.environ) == 0
    assert capfd.readouterr().out == '{<Signals.SIGINT: 2>}\nset()\n'
    assert signal.pthread_sigmask(signal.SIG_BLOCK, []) == set()


def test_ctrl_c_is_the_childs(prefix):
    with started('run', 'toys', 'clean', terminal=True, AMENT_PREFIX_PATH=prefix) as program:
        program.expect('up')
        program.type('\x03')
        program.expect('interrupted')
        assert program.end() == 0
        assert 'Traceback' not in program.output


def test_a_child_that_died_of_ctrl_c_is_told(prefix):
    with started('run', 'toys', 'default', terminal=True, AMENT_PREFIX_PATH=prefix) as program:
        program.expect('up')
        program.type('\x03')
        program.expect(r'\[ros2run\]: Interrupt')
        assert program.end() == 254


@pytest.mark.parametrize(
    ('executable', 'signum', 'said', 'code'),
    [
        ('clean', signal.SIGTERM, 'terminated', 1),
        ('clean', signal.SIGINT, 'interrupted', 0),
        ('default', signal.SIGTERM, r'\[ros2run\]: Terminated', 241),
        ('default', signal.SIGINT, r'\[ros2run\]: Interrupt', 254),
        ('default', signal.SIGHUP, r'\[ros2run\]: Hangup', 255),
        ('default', signal.SIGUSR1, r'\[ros2run\]: User defined signal 1', 246),
    ],
)
def test_signals_of_others_are_passed_on(prefix, executable, signum, said, code):
    with started('run', 'toys', executable, AMENT_PREFIX_PATH=prefix) as program:
        program.expect('up')
        program.signal(signum)
        program.expect(said)
        assert program.end() == code


def test_an_interrupt_of_the_whole_group_comes_once(prefix):
    with started('run', 'toys', 'clean', AMENT_PREFIX_PATH=prefix) as program:
        program.expect('up')
        os.killpg(program.process.pid, signal.SIGINT)
        assert program.end() == 0
        assert program.output.count('interrupted') == 1
        assert 'Traceback' not in program.output


def test_packages_are_those_of_the_index(in_prefix, prefix):
    assert {name: str(path) for name, path in packages().items()} == {
        'books': prefix,
        'toys': prefix,
    }
    assert str(package_prefix('toys')) == prefix
    with pytest.raises(AmrError, match="Package 'nope' not found"):
        package_prefix('nope')


def test_executables_may_be_executed_and_are_not_hidden(in_prefix):
    names = [path.name for path in executables_of('toys')]
    assert sorted(names) == sorted(
        name.rpartition('/')[2] for name in EXECUTABLES if not name.startswith('.')
    )
    assert executables_of('books') == []


def test_pkg_tells_the_same(prefix):
    def pkg(*args):
        result = ros2('pkg', *args, AMENT_PREFIX_PATH=prefix)
        return result.returncode, result.stdout, result.stderr

    assert pkg('list') == (0, 'books\ntoys\n', '')
    assert pkg('prefix', 'toys') == (0, f'{prefix}\n', '')
    assert pkg('prefix', '--share', 'toys') == (0, f'{prefix}/share/toys\n', '')
    assert pkg('prefix', 'nope') == (1, '', 'Package not found\n')
    assert pkg('executables', 'books') == (0, '', '')
    assert pkg('executables', 'nope') == (1, '', "Package 'nope' not found\n")
    assert 'toys fail\n' in pkg('executables')[1]
    assert f'{prefix}/lib/toys/fail\n' in pkg('executables', 'toys', '--full-path')[1]
