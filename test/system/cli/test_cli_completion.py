# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Tab completion: what may come next, what it costs, and that a shell gets it."""

import os
from pathlib import Path
import re
import shutil
import subprocess
import sys

from fixtures.cli.commands import environment, python, running_node
from fixtures.launch_files.packages import first_in_the_index, install_package
import pytest
from support.manager_host import ros_in_this_process, running_host
from support.paths import ROOT
from support.running_programs import Program

from amr_description.cli.completers import COMPLETERS
from amr_description.cli.lazy_parser import imported, LazyParser
from amr_description.cli.ros2 import COMMANDS
from amr_description.registry import resolve

ACTIVATE = ROOT / 'scripts' / 'activate'
SHELLS = {'bash': ['bash', '--norc', '--noprofile', '-i'], 'zsh': ['zsh', '-f', '-i']}
JOINTS, DRIVE = 'joint_state_broadcaster', 'diff_drive_controller'
needs_set_up = pytest.mark.skipif(
    Path(sys.prefix) != ROOT / '.venv', reason='needs what scripts/setup makes'
)
pytest.importorskip('argcomplete')


def ask(line, folder, *, shell='bash', **env):
    """Ask as the shell does on Tab; return the words, and what Python said on stderr."""
    answer = folder / 'answer'
    answer.write_text('')
    result = python(
        *('-m', 'amr_description.cli', 'ros2'),
        COMP_LINE=line,
        COMP_POINT=str(len(line)),
        _ARGCOMPLETE='1',
        _ARGCOMPLETE_SHELL=shell,
        _ARGCOMPLETE_STDOUT_FILENAME=str(answer),
        _ARGCOMPLETE_SUPPRESS_SPACE='1',
        **env,
    )
    assert result.returncode == 0, result.stderr
    return answer.read_text().split('\013') if answer.read_text() else [], result.stderr


@pytest.fixture
def complete(tmp_path):
    def complete_it(line, **env):
        return ask(line, tmp_path, **env)[0]

    return complete_it


@pytest.fixture(scope='module')
def fixture_node():
    with running_node('fixture_node.py') as node:
        yield node


@pytest.fixture  # of one test: others count the nodes that are there
def host(tmp_path_factory):
    with ros_in_this_process(), running_host(tmp_path_factory.mktemp('host')) as host:
        host.activate(JOINTS)
        assert host.client.load(DRIVE)
        assert host.client.configure(DRIVE)
        yield host


@pytest.mark.parametrize(
    ('line', 'words'),
    [
        ('ros2 to', ['topic']),
        ('ros2 topic e', ['echo']),
        ('ros2 topic --include-hidden-topics e', ['echo']),
        ('ros2 topic echo --fie', ['--field']),
        ('ros2 topic pub --qos-reliability be', ['best_effort', 'best_available']),
        ('ros2 topic echo /x --qos-reliability=rel', ['--qos-reliability=reliable']),
        ('ros2 "to', ['topic']),
        ('ros2 nonsense ec', []),
        ('ros2 control set_controller_state x in', ['inactive']),
        ('ros2 run demo_nodes_py t', ['talker']),
        ('ros2 run py_p', ['py_pubsub']),
        ('ros2 pkg create --license MI', ['MIT', 'MIT-0']),
        ('ros2 run no_such_package ', []),
        ('ros2 pkg prefix std_', ['std_msgs', 'std_srvs']),
        ('ros2 interface show std_msgs/msg/Str', ['std_msgs/msg/String']),
        ('ros2 interface package std_s', ['std_srvs']),
        ('ros2 launch amr_d', ['amr_description', 'amr_description/']),
        ('ros2 launch amr_description s', ['serial', 'simulation']),
        ('ros2 launch amr_description simulation rt', ['rtf:=']),
        ('ros2 launch amr_description nonsense ', []),
        ('ros2 topic pub /x std_msgs/msg/String "', ["data: ''"]),
        ('ros2 topic pub /x no_such/msg/Type "', []),
        ('ros2 service call /x std_srvs/srv/SetBool "', ['data: false']),
    ],
)
def test_what_needs_no_graph_does_without_rclpy(tmp_path, monkeypatch, line, words):
    monkeypatch.chdir(ROOT)
    found, imports = ask(line, tmp_path, PYTHONPROFILEIMPORTTIME='1')
    assert [word.strip('{}') for word in found] == words
    assert 'amr_description.cli.completion' in imports
    assert 'rclpy' not in imports


def test_launch_files_are_known_by_package_and_by_path(tmp_path, monkeypatch, complete):
    for name, text in (('toys', {'launch/play.launch.xml': '<launch/>'}), ('toybox', {})):
        install_package(tmp_path / 'prefix', name, **text)
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'toy.launch.yaml').touch()
    (tmp_path / 'toy.txt').touch()
    with first_in_the_index(tmp_path / 'prefix'):
        assert complete('ros2 launch toy') == ['toys', 'toy.launch.yaml']
        assert complete('ros2 launch toys p') == ['play.launch.xml']


def test_flags_stand_aside_until_a_dash_is_typed(complete):
    assert {'run', 'topic', 'pkg'} <= set(complete('ros2 '))
    assert not [word for word in complete('ros2 pkg prefix ') if word.startswith('-')]
    assert complete('ros2 pkg prefix --s') == ['--share']


def test_zsh_is_told_what_each_word_means(tmp_path):
    found, _ = ask('ros2 topic ec', tmp_path, shell='zsh')
    assert found == ['echo:Output messages from a topic']


def test_topics_nodes_services_and_types_come_from_the_graph(fixture_node, complete):
    assert complete('ros2 topic echo /cha') == ['/chatter']
    assert complete('ros2 topic hz cha') == ['chatter']
    assert '/_hidden' not in complete('ros2 topic info /')
    assert complete('ros2 topic pub /chatter ') == ['std_msgs/msg/String']
    assert complete('ros2 topic pub /nobodys std_msgs/msg/Str') == ['std_msgs/msg/String']
    assert complete('ros2 topic find geometry_msgs/') == ['geometry_msgs/msg/TwistStamped']
    assert complete('ros2 node info ') == ['/fixture']
    assert complete('ros2 service call /tr') == ['/trig']
    assert complete('ros2 service call trig ') == ['std_srvs/srv/Trigger']
    assert complete('ros2 service find std_srvs/srv/S') == ['std_srvs/srv/SetBool']


def test_parameters_come_from_their_node(fixture_node, complete):
    for node in ('fixture', '/fixture'):
        assert complete(f'ros2 param get {node} d_') == ['d_string']
    assert complete('ros2 param describe /fixture a_bool b_') == ['b_int']
    assert complete('ros2 param get /nobody d_') == []


def test_controllers_come_from_their_manager_by_their_state(host, complete):
    assert complete('ros2 control unload_controller ') == [DRIVE, JOINTS]
    assert complete('ros2 control switch_controllers --activate ') == [DRIVE]
    assert complete('ros2 control switch_controllers --strict --deactivate ') == [JOINTS]
    loadable = complete('ros2 control load_controller ')
    assert {'slow', 'broken'} <= set(loadable)
    assert not {JOINTS, DRIVE} & set(loadable)
    assert complete('ros2 control set_hardware_component_state ') == ['hardware']
    assert complete('ros2 control list_controllers -c ') == ['/controller_manager']
    assert complete('ros2 control unload_controller -c /nobody ') == []


def arguments_of(words, module):
    """Yield the names of the arguments of every verb, alone and behind those of their verb."""
    table = getattr(imported(module), 'VERBS', None)
    if table:
        for verb, below in table.items():
            yield from arguments_of([*words, verb], below)
        return
    (parser,) = LazyParser(prog='ros2', module=module).expand([])
    for action in parser._actions:
        yield from (action.dest, ' '.join([*words, action.dest]))


def test_the_table_leads_from_arguments_there_are_to_functions_there_are():
    known = {name for command in COMMANDS for name in arguments_of([command], COMMANDS[command])}
    assert COMPLETERS.keys() <= known
    for target in COMPLETERS.values():
        assert callable(resolve(f'amr_description.cli.completers.{target}'))


@needs_set_up
@pytest.mark.parametrize('shell', [shell for shell in SHELLS if shutil.which(shell)])
def test_an_activated_shell_completes_until_it_is_deactivated(shell):
    told = {'bash': 'complete -p ros2', 'zsh': 'echo ${_comps[ros2]}'}[shell]
    line = f'. {ACTIVATE}; {told}; . {ACTIVATE}; {told}; deactivate; echo now; {told}'
    done = subprocess.run(
        [*SHELLS[shell], '-c', line],
        env=os.environ | {'HOME': '/nowhere', 'TERM': 'dumb', 'CDPATH': '.'},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
        start_new_session=True,
    )
    before, after = done.stdout.split('now\n')
    assert before.count('_python_argcomplete') == 2, done.stderr
    assert 'argcomplete' not in after


@needs_set_up
def test_tab_completes_in_a_terminal():
    env = {'PS1': 'amr-test> ', 'TERM': 'dumb', 'COLUMNS': '200', 'HISTFILE': ''}
    with Program(*SHELLS['bash'], terminal=True, env=environment(**env), cwd=ROOT) as shell:
        shell.expect('amr-test> ')
        shell.type('. scripts/activate; echo $?-ready\n')
        shell.expect('0-ready')
        for keys, line in (
            ('ros2 to\t', 'ros2 topic '),
            ('ec\t', 'ros2 topic echo '),
            ('--onc\t', 'ros2 topic echo --once '),
            ('\x15ros2 launch amr_description sim\t', 'ros2 launch amr_description simulation '),
            ('rt\t', 'ros2 launch amr_description simulation rtf:='),
        ):
            shell.type(keys)
            shell.expect(re.escape(line.rpartition(' ')[2] or line.split()[-1] + ' '))
        shell.type('0 --print\n')
        assert shell.expect(r'real_time_factor: 0\.0')
