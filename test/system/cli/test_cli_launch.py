# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 launch``: what is understood as a stack, what is told otherwise, and that it is one."""

from argparse import ArgumentParser
import os
import re
import signal

from fixtures.bringup.running import Bringup, install_toys, STACKS
from fixtures.cli.commands import ros2
import pytest

from amr_description.cli import launch as launch_command
from amr_description.cli.launch_files import (
    find_launch_file,
    is_launch_file,
    launchable_names,
)
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


def test_what_may_be_launched_of_a_package_is_known(share):
    for name in ('a.launch', 'b.launch.xml', 'c.launch.yml', 'parameters.yaml'):
        (share / name).touch()
    (share / 'd.launch.py').write_text(FOREIGN)
    (share / 'e.py').write_text('def e(): ...\n')
    (share / 'module.py').write_text('def f(): ...\n')
    assert launchable_names('toys') == [
        'a.launch',
        'b.launch.xml',
        'c.launch.yml',
        'd.launch.py',
        'e.py',
    ]


@pytest.mark.parametrize('name', ['gazebo.launch.py', 'mine.launch.py'])
def test_launch_files_of_a_package_of_our_name_come_first(share, name):
    own = share.parents[1] / 'amr_description/launch' / name
    own.parent.mkdir(parents=True)
    own.write_text(FOREIGN)
    assert find_launch_file('amr_description', name, ['a:=b']) == (str(own), ['a:=b'])
    assert find_launch_file(str(own), 'a:=b', []) == (str(own), ['a:=b'])
    assert is_launch_file(str(own))


@pytest.mark.parametrize(
    ('name', 'text', 'is_one'),
    [
        ('robot.launch.py', FOREIGN, True),
        ('robot_launch.py', FOREIGN, True),
        ('robot.launch.py', 'x = 1', True),
        ('robot.launch.xml', '<launch/>', True),
        ('robot.launch.yaml', 'launch: []', True),
        ('robot.py', 'def robot(): ...', False),
        ('robot.py', f'{FOREIGN}def robot(): ...', False),
        ('robot.py', 'x = 1', False),
    ],
)
def test_launch_files_and_stacks_are_told_apart(share, name, text, is_one):
    (share / name).write_text(text)
    assert is_launch_file(find_launch_file('toys', name, [])[0]) is is_one
    assert not is_launch_file('simulation')


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
        ('nope.launch', None, AmrError, "there is no launch file 'nope.launch'"),
    ],
)
def test_what_is_not_there_is_told_in_one_line(share, package, file, error, said):
    with pytest.raises(error, match=said) as told:
        find_launch_file(package, file, [])
    assert str(told.value).count('\n') == 0


def test_a_launch_file_that_is_in_the_source_alone_is_named_there(share, tmp_path):
    (tmp_path / 'build/toys').mkdir(parents=True)
    source = tmp_path / 'src/toys/launch/new.launch.py'
    source.parent.mkdir(parents=True)
    source.write_text(FOREIGN)
    (tmp_path / 'src/toys/package.xml').write_text('<package><name>toys</name></package>')
    (share / 'mine.launch.py').write_text(FOREIGN)
    with pytest.raises(AmrError, match=f'; {source} is not installed: colcon build'):
        find_launch_file('toys', 'new.launch.py', [])
    with pytest.raises(AmrError, match=r'; did you mean mine\.launch\.py\?'):
        find_launch_file('toys', 'mime.launch.py', [])


def test_a_file_of_nearly_that_name_is_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'robot.launch.py').write_text(FOREIGN)
    with pytest.raises(AmrError, match=r"file 'robt.launch.py'; did you mean robot.launch.py\?$"):
        find_launch_file('robt.launch.py', None, [])


def test_two_of_one_name_are_told(share):
    for folder in (share, share / 'more'):
        folder.mkdir(exist_ok=True)
        (folder / 'twin.py').write_text('def twin(): ...\n')
    with pytest.raises(AmrError, match="'twin.py' was found more than once in .* 'toys'"):
        find_launch_file('toys', 'twin.py', [])


@pytest.mark.parametrize(
    ('name', 'text', 'said'),
    [
        ('robot.urdf', '<robot/>', 'the name of a launch file ends with one of .launch.py'),
        ('broken.py', 'def broken(:\n', r"broken.py', line 1: is not Python: invalid syntax"),
        ('zero.py', '\0', 'is not Python: '),
    ],
)
def test_what_is_no_stack_is_told_in_one_line(share, name, text, said):
    (share / name).write_text(text)
    with pytest.raises(AmrError, match=said) as told:
        is_launch_file(find_launch_file('toys', name, [])[0])
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
    ('word', 'said', 'code'),
    [
        ('code', "ros2 launch: malformed launch argument 'code', expected format", 1),
        ('code:=x', "ros2 launch: code:=x: 'x' is not an integer", 2),
        ('cod:=1', "ros2 launch: unknown argument 'cod'; did you mean 'code'?", 2),
    ],
)
def test_wrong_arguments_are_told_by_the_bring_up(share, word, said, code):
    result = ros2('launch', PLAIN, word)
    assert (result.returncode, result.stdout) == (code, '')
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


LAUNCH_FILE = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, LogInfo, RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO, OnShutdown
from launch.substitutions import LaunchConfiguration, LocalSubstitution
from launch_ros.actions import Node

def heard(event):
    if b'plain is up' in event.text:
        return LogInfo(msg='heard it')

def generate_launch_description():
    words = ['echo $GREETING; exit ', LaunchConfiguration('code')]
    first = ExecuteProcess(cmd=['bin/sh', '-c', words],
        additional_env={'GREETING': 'good day'}, cwd='/')
    plain = Node(package='toys', executable='plain', arguments=['130'])
    return LaunchDescription([
        DeclareLaunchArgument('code', default_value='3', description='How the first one ends.'),
        first,
        RegisterEventHandler(OnProcessExit(target_action=first,
            on_exit=[LogInfo(msg='the first is over'), plain])),
        RegisterEventHandler(OnProcessIO(target_action=plain, on_stdout=heard)),
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=['stops: ', LocalSubstitution('event.reason')])])),
    ])
"""


@pytest.fixture
def launch_file(tmp_path):
    path = tmp_path / 'my.launch.py'
    path.write_text(LAUNCH_FILE)
    return str(path)


def test_a_launch_file_is_run(tmp_path, launch_file):
    with Launch(tmp_path, launch_file) as launch:
        launch.expect(r'\[launch.user\]: heard it')
        assert launch.end(signal.SIGINT) == 0
        assert '[sh-1] good day' in launch.output
        assert re.search(r'sh-1.*: process has died .*exit code 3', launch.output)
        assert launch.output.index('the first is over') < launch.output.index('plain is up')
        assert '[INFO] [launch.user]: stops: ctrl-c (SIGINT)' in launch.output
        assert 'Traceback' not in launch.output
        assert launch.left() == []


def test_a_launch_file_is_shown_and_printed(share, launch_file):
    shown = ros2('launch', launch_file, '--show-args')
    assert (shown.returncode, shown.stderr) == (0, '')
    assert shown.stdout == (
        "Arguments (pass arguments as '<name>:=<value>'):\n\n    'code':\n"
        "        How the first one ends.\n        (default: '3')\n"
    )
    printed = ros2('launch', launch_file, '--print', 'code:=0', 'cod:=1')
    assert (printed.returncode, printed.stderr) == (0, '')
    assert printed.stdout.startswith(
        "[WARNING] it declares no argument 'cod'; did you mean 'code'? known: code\n"
        "sh-1: at once, optional\n    bin/sh -c 'echo $GREETING; exit 0'\n"
        '    GREETING=good day\n    in /\nplain-2: when sh-1 exited, optional\n'
    )


@pytest.mark.parametrize(
    ('words', 'code', 'seen'),
    [
        ([], 7, 'LOCALHOST'),
        (['--discovery', 'subnet'], 7, 'SUBNET'),
        (['--print'], 5, None),
        (['--launch-prefix', 'nice'], 5, None),
    ],
)
def test_the_original_is_given_what_it_knows(launch_file, monkeypatch, words, code, seen):
    variable, ranges = 'ROS_AUTOMATIC_DISCOVERY_RANGE', [None]
    monkeypatch.setenv(variable, 'LOCALHOST')

    def original(_path, _words, *, show):
        ranges.append(os.environ[variable])
        return 7

    monkeypatch.setattr('amr_description.launch_api.launch_file.launch_by_the_original', original)
    monkeypatch.setattr('amr_description.bringup.main.main', lambda *_, **__: 5)
    parser = ArgumentParser()
    launch_command.add_arguments(parser)
    assert launch_command.main(parser.parse_args([*words, launch_file])) == code
    assert ranges[-1] == seen


def test_a_launch_file_that_is_refused(share):
    (share / 'odd.launch.py').write_text(
        LAUNCH_FILE.replace("executable='plain'", "executable='x'")
    )
    refused = ros2('launch', 'toys', 'odd.launch.py')
    assert (refused.returncode, refused.stdout) == (1, '')
    assert refused.stderr.startswith("ros2 launch: odd.launch.py:16: executable 'x' not found on")
    assert refused.stderr.count('\n') == 1
