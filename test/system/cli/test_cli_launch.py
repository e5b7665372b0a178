# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 launch``: what is understood as a stack, what is told otherwise, and that it is one."""

import signal

from fixtures.bringup.running import Bringup, install_toys, STACKS
from fixtures.cli.commands import ros2
import pytest
from support.paths import ROOT

from amr_description.cli.launch_files import find_launch_file
from amr_description.errors import AmrError, UsageError

PLAIN = str(STACKS / 'plain.py')
FOREIGN = 'def generate_launch_description():\n    return None\n'


class Launch(Bringup):
    """``ros2 launch <stack> <arguments>``."""

    module = ('amr_description.cli', 'ros2', 'launch')


@pytest.fixture
def share(tmp_path, monkeypatch):
    """The share folder of the package ``toys``; ``amr_description`` is there, too."""
    prefix = tmp_path / 'prefix'
    install_toys(prefix)
    (prefix / 'share/ament_index/resource_index/packages/amr_description').touch()
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(prefix))
    folder = prefix / 'share/toys/launch'
    folder.mkdir(parents=True)
    return folder


@pytest.mark.parametrize(
    'file', ['simulation', 'simulation.launch.py', 'gazebo.launch.py', 'gazebo', 'simulation.py']
)
def test_a_stack_is_known_by_its_name_and_by_those_of_the_tutorial(share, file):
    assert find_launch_file('amr_description', file, ['a:=b']) == ('simulation', ['a:=b'])


def test_a_stack_of_another_package_is_found_in_its_share_folder(share):
    (share / 'mine.py').write_text('def mine(): ...\n')
    assert find_launch_file('toys', 'mine.py', ['a:=b']) == (str(share / 'mine.py'), ['a:=b'])


def test_a_file_is_known_by_its_path(share, monkeypatch):
    assert find_launch_file(PLAIN, 'code:=3', ['code:=4']) == (PLAIN, ['code:=3', 'code:=4'])
    monkeypatch.chdir(STACKS)
    assert find_launch_file('plain.py', None, []) == ('plain.py', [])


def test_in_place_of_the_tutorials_launch_files_our_stacks_are_started(share, capsys):
    own = share.parents[1] / 'amr_description/launch/gazebo.launch.py'
    own.parent.mkdir(parents=True)
    own.write_text(FOREIGN)
    found = find_launch_file('amr_description', 'gazebo.launch.py', ['rtf:=2.0'])
    assert found == ('simulation', ['rtf:=2.0'])
    assert capsys.readouterr().err == (
        f"[ros2launch]: launch files are not supported here: in place of '{own}' the stack "
        "'simulation' is started\n"
    )


@pytest.mark.parametrize('name', ['gazebo.launch.py', 'mine.launch.py'])
def test_other_launch_files_of_a_package_of_our_name_are_heeded(share, name):
    own = share.parents[1] / 'amr_description/launch' / name
    own.parent.mkdir(parents=True)
    own.write_text(FOREIGN)
    given = ('amr_description', name) if name.startswith('mine') else (str(own), None)
    with pytest.raises(AmrError, match=f"'{own}': launch files .* are not supported here") as told:
        find_launch_file(*given, [])
    if name.startswith('mine'):
        return
    assert str(told.value).endswith(
        'use a stack (docs/write_your_own_stack.md), for the one of the tutorial: '
        'ros2 launch amr_description simulation'
    )
    assert (ROOT / 'docs/write_your_own_stack.md').is_file()


@pytest.mark.parametrize(
    ('package', 'file', 'error', 'said'),
    [
        ('amr_description', 'rviz.launch.py', AmrError, "no stack 'rviz.launch.py'.*simul"),
        ('amr_description', 'simulaton', AmrError, "did you mean 'simulation'"),
        ('amr_description', '*', AmrError, r"no stack '\*'"),
        (
            'amr_description',
            None,
            UsageError,
            'which one of .*: ros2 launch amr_description displ',
        ),
        ('amr_description', 'rtf:=0', UsageError, "which one of 'amr_description'"),
        ('simulation', None, UsageError, "'simulation' is a stack; .* amr_description simulation"),
        ('nopkg', 'x.launch.py', AmrError, "Package 'nopkg' not found"),
        (
            'ros_gz_sim',
            'gz_sim.launch.py',
            AmrError,
            "Package 'ros_gz_sim' not found: the simulator here is MuJoCo: 'ros2 launch amr_descr",
        ),
        (
            'nav2_bringup',
            'navigation_launch.py',
            AmrError,
            "Package 'nav2_bringup' not found: it runs on a machine with ROS 2 Jazzy beside",
        ),
        ('toys', 'nope.py', AmrError, "file 'nope.py' was not found in the share directory of pa"),
        ('toys', '../toys/a.py', AmrError, 'was not found in the share directory'),
        ('./nope.py', None, AmrError, "there is no launch file 'nope.py'"),
        (str(STACKS), None, AmrError, 'there is no launch file'),
    ],
)
def test_what_is_not_there_is_told_in_one_line(share, package, file, error, said):
    with pytest.raises(error, match=said) as told:
        find_launch_file(package, file, [])
    assert str(told.value).count('\n') == 0


def test_two_of_one_name_are_told(share):
    for folder in (share, share / 'more'):
        folder.mkdir(exist_ok=True)
        (folder / 'twin.py').write_text('def twin(): ...\n')
    with pytest.raises(AmrError, match="'twin.py' was found more than once in .* 'toys'"):
        find_launch_file('toys', 'twin.py', [])


@pytest.mark.parametrize(
    ('name', 'text', 'said'),
    [
        (
            'robot.launch.py',
            FOREIGN,
            r'launch files \(.*\) are not supported here; use a stack \(docs',
        ),
        ('robot.launch.xml', '<launch/>', 'not supported here.* or one of: display, fleet, '),
        ('broken.py', 'def broken(:\n', r"broken.py', line 1: is not Python: invalid syntax"),
        ('zero.py', '\0', 'is not Python: '),
    ],
)
def test_what_is_no_stack_is_told_in_one_line(share, name, text, said):
    (share / name).write_text(text)
    with pytest.raises(AmrError, match=said) as told:
        find_launch_file('toys', name, [])
    assert str(told.value).count('\n') == 0


@pytest.mark.parametrize('flags', [['--show-args'], ['-s', '-n', '-d', '-a']])
def test_arguments_are_shown(share, flags):
    for words in ([PLAIN, *flags], [*flags, PLAIN]):
        result = ros2('launch', *words)
        assert (result.returncode, result.stderr) == (0, '')
        assert result.stdout.startswith("Arguments (pass arguments as '<name>:=<value>'):\n")
        assert "    'code':\n        no description given\n        (default: '0')" in result.stdout


@pytest.mark.parametrize('flag', ['-p', '--print', '--print-description'])
def test_what_would_be_started_is_printed(share, flag):
    result = ros2('launch', PLAIN, flag, 'code:=3')
    assert (result.returncode, result.stderr) == (0, '')
    assert result.stdout.endswith('/lib/toys/plain 3 --ros-args\n')


@pytest.mark.parametrize(('pattern', 'words'), [('pl', ['nice', '-n', '5']), ('x', [])])
def test_a_launch_prefix_stands_before_the_executables_that_match(share, pattern, words):
    options = ['--launch-prefix', 'nice -n 5', '--launch-prefix-filter', pattern]
    result = ros2('launch', '--print', *options, PLAIN)
    assert (result.returncode, result.stderr) == (0, '')
    assert result.stdout.splitlines()[1].split()[:-3] == words


@pytest.mark.parametrize(
    ('word', 'said'),
    [
        ('code', "ros2 launch: malformed launch argument 'code', expected format"),
        ('code:=x', "ros2 launch: code:=x: 'x' is not an integer"),
        ('cod:=1', "ros2 launch: unknown argument 'cod'; did you mean 'code'?"),
    ],
)
def test_wrong_arguments_are_told_by_the_bring_up(share, word, said):
    result = ros2('launch', PLAIN, word)
    assert (result.returncode, result.stdout) == (2, '')
    assert result.stderr.startswith(said)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_it_is_the_bring_up_that_gets_the_signals(tmp_path, number):
    with Launch(tmp_path, PLAIN, 'code:=130') as launch:
        launch.expect('plain is up')
        assert launch.end(number) == 0
        assert 'process has ended on SIGINT' in launch.output
        assert 'Traceback' not in launch.output
        assert launch.left() == []


def test_ctrl_c_in_a_terminal_stops_all(tmp_path):
    with Launch(tmp_path, PLAIN, 'code:=130', terminal=True) as launch:
        launch.expect('plain is up')
        launch.type('\x03')
        assert launch.end() == 0
        assert 'Traceback' not in launch.output
        assert launch.left() == []


def test_the_exit_code_is_that_of_the_bring_up(tmp_path):
    with Launch(tmp_path, str(STACKS / 'chatty.py'), 'text:=x', 'code:=5') as launch:
        assert launch.end() == 5
