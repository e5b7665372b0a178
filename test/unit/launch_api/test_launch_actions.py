# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Actions and event handlers of launch files, translated; who starts when, without processes."""

import textwrap
from types import SimpleNamespace

from fixtures.launch_files.packages import (
    commands,
    first_in_the_index,
    install_package,
    parameters,
    stack_of,
)
import pytest

from amr_description.bringup.command_line import process_specs
from amr_description.bringup.handlers import Log, Shutdown, Stopping
from amr_description.bringup.main import listing
from amr_description.bringup.scheduler import Scheduler
from amr_description.errors import BringupError

HEAD = """
import os
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.events import Shutdown as ShutdownEvent
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue

def toy(executable, **kwargs):
    return Node(package='toys', executable=executable, **kwargs)

def generate_launch_description():
    return LaunchDescription([*entities()])

"""


@pytest.fixture
def toys(tmp_path):
    """A prefix with the package ``toys``, whose executables are a, b, c and d."""
    install_package(tmp_path, 'toys', *'abcd')
    with first_in_the_index(tmp_path):
        yield tmp_path


@pytest.fixture
def launch(toys):
    """A function: the stack of a file with these entities; ``before``: what is defined first."""

    def launched(entities, before='', name='my', **arguments):
        before = textwrap.dedent(before)
        indented = textwrap.indent(textwrap.dedent(entities).strip(), '        ')
        path = toys / f'{name}.launch.py'
        path.write_text(f'{HEAD}\n{before}\ndef entities():\n    return [\n{indented}\n    ]\n')
        return stack_of(path, **arguments)

    return launched


def whens(stack):
    return {name: when for name, when, _ in commands(stack)}


def test_names_namespaces_remappings_and_arguments(launch, toys):
    stack = launch("""
        SetParameter('rate', 5),
        SetRemap('/tf', 'tf'),
        GroupAction([
            PushRosNamespace('left'),
            PushRosNamespace(['a', 'rm']),
            SetUseSimTime(True),
            toy('a', name='x', namespace='inner', remappings=[('in', LaunchConfiguration('to'))],
                arguments=['-n', LaunchConfiguration('to')], ros_arguments=['--log-level', 'warn'],
                parameters=[{'p': LaunchConfiguration('n')}]),
            toy('b', namespace='/root'),
        ], launch_configurations={'n': '7'}),
        toy('c'),
    """, to='out')  # fmt: skip
    assert [line for *_, line in commands(stack)] == [
        'a -n out --ros-args --log-level warn --ros-args -r __node:=x -r __ns:=/left/arm/inner '
        '-r /tf:=tf -r in:=out',
        'b --ros-args -r __ns:=/root -r /tf:=tf',
        'c --ros-args -r /tf:=tf',
    ]
    named = '/left/arm/inner/x: ros__parameters:'
    written = f'{named} rate: 5 {named} use_sim_time: true {named} p: 7'
    assert parameters(stack, 'a-1').split() == written.split()
    assert 'use_sim_time' not in parameters(stack, 'c-3')


@pytest.mark.parametrize(
    ('namespace', 'words', 'section'),
    [
        ('', '', '/**:'),
        ("namespace='',", ' -r __ns:=/', '/x:'),
        ("namespace='/',", ' -r __ns:=/', '/x:'),
        ("namespace=LaunchConfiguration('none', default=''),", ' -r __ns:=/', '/x:'),
    ],
)
def test_an_empty_namespace_says_where_a_node_is(launch, namespace, words, section):
    stack = launch(f"toy('a', name='x', {namespace} parameters=[{{'p': 1}}]),")
    assert [line for *_, line in commands(stack)] == [f'a --ros-args -r __node:=x{words}']
    assert parameters(stack, 'a-1').split() == [section, 'ros__parameters:', 'p:', '1']


def test_an_empty_namespace_that_is_pushed_says_where_nodes_are(launch):
    stack = launch("""GroupAction([PushRosNamespace(''), toy('a', name='x', parameters=[{'p': 1}]),
        PushRosNamespace('r1'), toy('b')]), toy('c', name='z'),""")
    assert [line for *_, line in commands(stack)] == [
        'a --ros-args -r __node:=x -r __ns:=/',
        'b --ros-args -r __ns:=/r1',
        'c --ros-args -r __node:=z',
    ]
    assert parameters(stack, 'a-1').startswith('/x:')


def test_environment(launch):
    stack = launch("""
        SetEnvironmentVariable('COLOR', 'red'),
        GroupAction([
            AppendEnvironmentVariable('COLOR', 'blue'),
            UnsetEnvironmentVariable('HOME'),
            toy('a', additional_env={'MORE': EnvironmentVariable('COLOR')}),
        ]),
        GroupAction([AppendEnvironmentVariable('COLOR', 'x', separator=','), toy('b')],
            scoped=False),
        toy('c'),
        ExecuteProcess(cmd=['sh', '-c', 'true'], env={'ONLY': '1', 'PATH': '/bin:/usr/bin'}),
    """)
    a, b, c, only = (spec.environment for spec in process_specs(stack, None))
    assert a == {'COLOR': 'red:blue', 'HOME': None, 'MORE': 'red:blue'}
    assert b == c == {'COLOR': 'red,x'}
    assert only['HOME'] is None
    assert {name: value for name, value in only.items() if value} == {
        'ONLY': '1',
        'PATH': '/bin:/usr/bin',
    }


def test_conditions_and_arguments(launch):
    entities = """
        DeclareLaunchArgument('which', default_value='a', choices=['a', 'b']),
        DeclareLaunchArgument('more', default_value=['x', LaunchConfiguration('which')]),
        toy('a', condition=LaunchConfigurationEquals('which', 'a')),
        toy('b', condition=UnlessCondition(
            EqualsSubstitution(LaunchConfiguration('more'), 'xa'))),
        toy('c', arguments=[LaunchConfiguration('more')]),
    """
    assert [line for *_, line in commands(launch(entities))] == ['a', 'c xa']
    assert [line for *_, line in commands(launch(entities, which='b'))] == ['b', 'c xb']
    assert [line for *_, line in commands(launch(entities, more='y'))] == ['a', 'b', 'c y']
    odd = launch(entities, mor='y', FOO='1')
    assert odd.notes[0] == (
        'WARNING',
        "it declares no argument 'mor'; did you mean 'more'? known: more, which",
    )
    with pytest.raises(BringupError, match=r'my.launch.py:\d+: Argument "which" provided value "'):
        launch(entities, which='c')


def test_groups_forward_only_what_they_say(launch):
    stack = launch("""
        SetLaunchConfiguration('x', '1'),
        GroupAction([
            SetLaunchConfiguration('x', '2'),
            toy('a', arguments=[LaunchConfiguration('x')]),
        ]),
        GroupAction([
            toy('b', arguments=[LaunchConfiguration('x', default='none'),
                LaunchConfiguration('y')]),
        ], forwarding=False, launch_configurations={'y': LaunchConfiguration('x')}),
        toy('c', arguments=[LaunchConfiguration('x')]),
    """)
    assert [line for *_, line in commands(stack)] == ['a 2', 'b none 1', 'c 1']


def test_an_included_file_has_its_own_folder_and_arguments(launch, toys):
    inner = toys / 'inner'
    inner.mkdir()
    (inner / 'in.launch.py').write_text(
        f"""{HEAD}
def entities():
    return [DeclareLaunchArgument('needed'), toy('a', arguments=[
        ThisLaunchFileDir(), LaunchConfiguration('needed')])]
"""
    )
    path = "PathJoinSubstitution([ThisLaunchFileDir(), 'inner', 'in.launch.py'])"
    stack = launch(f"""
        IncludeLaunchDescription(PythonLaunchDescriptionSource({path}),
            launch_arguments={{'needed': 'yes'}}.items()),
        toy('b', arguments=[ThisLaunchFileDir()]),
    """)
    assert [line for *_, line in commands(stack)] == [f'a {inner} yes', f'b {toys}']
    with pytest.raises(BringupError, match=r"my.*missing required argument 'needed' \(descripti"):
        launch(f'IncludeLaunchDescription({path})')
    with pytest.raises(
        BringupError, match=r"my.launch.py:\d+: there is no launch file '.*/x.laun"
    ):
        launch("IncludeLaunchDescription('x.launch.py')")
    with pytest.raises(BringupError, match="my.launch.py' includes itself"):
        launch('IncludeLaunchDescription(ThisLaunchFile())')


HANDLERS = """
a, b, c, d = map(toy, 'abcd')
"""


def test_who_waits_for_whom(launch):
    stack = launch("""
        RegisterEventHandler(OnProcessExit(target_action=a, on_exit=[
            b, TimerAction(period=2.0, actions=[c])])),
        RegisterEventHandler(OnProcessStart(target_action=b, on_start=d)),
        a,
    """, HANDLERS)  # fmt: skip
    assert whens(stack) == {
        'a-1': 'at once',
        'b-2': 'when a-1 exited',
        'c-3': 'when 2 s have passed since a-1 exited',
        'd-4': 'when b-2 was started',
    }


@pytest.mark.parametrize('code', [0, 3])
def test_the_next_starts_after_a_failure_too(launch, code):
    stack = launch(
        'RegisterEventHandler(OnProcessExit(target_action=a, on_exit=[b])), a', HANDLERS
    )
    first, second = stack.nodes
    scheduler = Scheduler(stack)
    scheduler.on_start(first)
    assert scheduler.startable() == []
    scheduler.on_exit(first, code)
    assert not scheduler.over
    assert scheduler.startable() == [second]
    scheduler.on_start(second)
    scheduler.on_exit(second, code)
    assert scheduler.over
    assert scheduler.failure is None


def test_a_timer_keeps_the_launch_alive(launch):
    stack = launch("""
        a,
        RegisterEventHandler(OnProcessExit(target_action=a, on_exit=[
            TimerAction(period='2', actions=[LogInfo(msg='late'), b])])),
    """, HANDLERS)  # fmt: skip
    first, second = stack.nodes
    scheduler = Scheduler(stack, 10.0)
    scheduler.on_start(first)
    scheduler.on_exit(first, 0)
    assert not scheduler.over
    assert scheduler.next_time() == 12.0
    scheduler.advance_to(12.0)
    assert scheduler.startable() == [second]
    assert list(scheduler.lines) == [Log('late')]


def test_lines_and_shutdown_at_events(launch):
    stack = launch("""
        LogInfo(msg=['hello ', LaunchConfiguration('who', default='you')]),
        a,
        RegisterEventHandler(OnProcessExit(target_action=a, on_exit=[
            LogInfo(msg='over'), EmitEvent(event=ShutdownEvent(reason='Window closed'))])),
        b,
    """, HANDLERS)  # fmt: skip
    assert stack.notes == [('INFO', 'hello you')]
    assert listing(stack, process_specs(stack, None)).splitlines()[-3:-1] == [
        "handler: when a-1 exited: log 'over'",
        "handler: when a-1 exited: shut down: 'Window closed'",
    ]
    scheduler = Scheduler(stack)
    for node in stack.nodes:
        scheduler.on_start(node)
    scheduler.on_exit(stack.nodes[0], 1)
    assert scheduler.over
    assert scheduler.shutdown == Shutdown('Window closed')
    assert list(scheduler.lines) == [Log('over')]


@pytest.mark.parametrize(('code', 'exit_code'), [(0, 0), (4, 4), (-9, 137)])
def test_a_node_that_all_depends_on(launch, code, exit_code):
    stack = launch("toy('a', on_exit=Shutdown()), toy('b', on_exit=[LogInfo(msg='b')]), toy('c')")
    assert whens(stack)['a-1'] == 'at once, its end is the end of all'
    scheduler = Scheduler(stack)
    for node in stack.nodes:
        scheduler.on_start(node)
    scheduler.on_exit(stack.nodes[1], 1)
    assert not scheduler.over
    assert list(scheduler.lines) == [Log('b')]
    scheduler.on_exit(stack.nodes[0], code)
    assert scheduler.over
    assert (scheduler.failure.exit_code if scheduler.failure else 0) == exit_code


FUNCTIONS = """
a, b = toy('a'), toy('b')

def ended(event, context):
    if event.returncode == 3:
        return [LogInfo(msg=f'{event.process_name} gave up'), Shutdown(reason='no battery')]

def heard(event):
    text = event.text.decode().strip()
    return LogInfo(msg=f'heard "{text}"') if 'ready' in text else None
"""


def test_ready_is_what_starts_soon(launch):
    stack = launch("""
        a,
        TimerAction(period=2, actions=[b]),
        TimerAction(period=60, actions=[c]),
        RegisterEventHandler(OnProcessExit(target_action=a, on_exit=[d])),
    """, HANDLERS)  # fmt: skip
    scheduler = Scheduler(stack)
    scheduler.on_start(stack.nodes[0])
    assert not scheduler.ready
    scheduler.advance_to(2.0)
    (second,) = scheduler.startable()
    scheduler.on_start(second)
    assert scheduler.ready


@pytest.mark.parametrize(
    ('words', 'shell', 'ends'),
    [
        ('ros2 control load_controller a', False, True),
        ('ros2 service call /a std_srvs/srv/Empty', True, True),
        ('ros2 bag record /chatter', False, False),
        ('ros2 topic echo /chatter', True, False),
    ],
)
def test_only_what_ends_soon_is_waited_for(launch, words, shell, ends):
    cmd = [words] if shell else words.split()
    (command,) = (stack := launch(f'ExecuteProcess(cmd={cmd}, shell={shell}),')).nodes
    scheduler = Scheduler(stack)
    scheduler.on_start(command)
    assert scheduler.ready is not ends
    scheduler.on_exit(command, 0)
    assert scheduler.ready


def test_a_file_that_starts_no_process_says_its_lines_and_is_over(launch):
    stack = launch("LogInfo(msg='only a line'), LogInfo(msg=PathSubstitution('/a') / 'b' / 'c'),")
    assert stack.nodes == []
    assert [text for _, text in stack.notes] == [
        'only a line',
        '/a/b/c',
        'nothing is started: the launch file starts no process',
    ]
    scheduler = Scheduler(stack)
    scheduler.advance_to(0.0)
    assert scheduler.over
    later = launch("TimerAction(period=2.0, actions=[LogInfo(msg='later')]),")
    scheduler = Scheduler(later)
    scheduler.advance_to(1.0)
    assert not scheduler.over
    scheduler.advance_to(3.5)
    assert [line.text for line in scheduler.lines] == ['later']
    assert scheduler.over


def test_what_a_command_prints_is_asked_when_its_time_has_come(launch, tmp_path):
    """As of a running robot_state_publisher, which has the description of the others."""
    said = tmp_path / 'said'
    stack = launch(f"""
        a,
        TimerAction(period=2.0, actions=[
            LogInfo(msg=['it says ', Command('cat {said}')]),
            Node(package='amr_description', executable='talker', parameters=[
                {{'robot_description': Command('cat {said}')}}, {{'speed': 1.0}}]),
        ]),
    """, HANDLERS)  # fmt: skip
    scheduler = Scheduler(stack)
    scheduler.advance_to(3.0)
    assert [(line.level, 'cat' in line.text) for line in scheduler.lines] == [('ERROR', True)]
    node = stack.nodes[1]
    _, spec = process_specs(stack, tmp_path)
    assert node.parameters[1] == {'speed': 1.0}
    with pytest.raises(BringupError, match=r'executed command failed\. Command: cat'):
        spec.write_parameter_files()
    said.write_text('<robot/>')
    spec.write_parameter_files()
    (path, _), _ = spec.parameter_files
    assert 'robot_description: <robot/>' in path.read_text()
    scheduler = Scheduler(stack)
    scheduler.advance_to(3.0)
    assert [line.text for line in scheduler.lines] == ['it says <robot/>']


def test_functions_are_called_when_the_event_comes(launch):
    stack = launch("""
        a, b,
        RegisterEventHandler(OnProcessExit(target_action=a, on_exit=ended)),
        RegisterEventHandler(OnProcessIO(target_action=b, on_stdout=heard, on_stderr=heard)),
    """, FUNCTIONS)  # fmt: skip
    a, b = stack.nodes
    scheduler = Scheduler(stack)
    scheduler.on_start(a)
    scheduler.on_start(b)
    assert not scheduler.on_line(b, 'starting')
    assert scheduler.on_line(b, 'I am ready')
    scheduler.on_exit(a, 3)
    assert scheduler.shutdown == Shutdown('no battery')
    assert [line.text for line in scheduler.lines] == ['heard "I am ready"', 'a-1 gave up']


def test_a_function_can_start_nothing(launch):
    stack = launch(
        'a, b, RegisterEventHandler(OnProcessExit(target_action=a, on_exit=lambda e, c: [b]))',
        HANDLERS,
    )
    scheduler = Scheduler(stack)
    for node in stack.nodes:
        scheduler.on_start(node)
    scheduler.on_exit(stack.nodes[0], 0)
    assert scheduler.over
    assert scheduler.shutdown.exit_code == 1
    assert 'has returned Node, which cannot be started here' in scheduler.shutdown.reason


def test_lines_at_the_end(launch):
    stack = launch("""
        a,
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=['asked to stop: ', LocalSubstitution('event.reason')])])),
        RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: LogInfo(msg='bye'))),
    """, HANDLERS)  # fmt: skip
    lines = stack.on_shutdown(Stopping(0, 'ctrl-c (SIGINT)'))
    assert [line.text for line in lines] == ['asked to stop: ctrl-c (SIGINT)', 'bye']


def test_any_process_and_what_is_never_started(launch):
    stack = launch("""
        a, b,
        RegisterEventHandler(OnProcessExit(on_exit=[Shutdown(reason='one of them')])),
        RegisterEventHandler(OnProcessStart(target_action=c, on_start=[d])),
    """, HANDLERS)  # fmt: skip
    assert list(whens(stack)) == ['a-1', 'b-2']
    assert stack.notes[0][1].endswith('OnProcessStart never comes: its target is not started')
    scheduler = Scheduler(stack)
    for node in stack.nodes:
        scheduler.on_start(node)
    scheduler.on_exit(stack.nodes[1], 0)
    assert scheduler.shutdown == Shutdown('one of them')


def test_commands(launch, toys):
    stack = launch(
        """
        ExecuteProcess(cmd=['sh', '-c', 'exit 3'], cwd='/tmp', respawn=True, respawn_delay=2.0),
        ExecuteProcess(cmd=[['echo ', LaunchConfiguration('x', default='1'), " # it's"]],
            shell=True, prefix='nice -n 5'),
        ExecuteProcess(cmd=['gz', 'sim', '-r', '-s', 'walls.sdf']),
        ExecuteProcess(cmd=['toys/a'], cwd=FOLDER),
    """,
        f'FOLDER = {str(toys / "lib")!r}',
    )
    assert [line for *_, line in commands(stack)] == [
        "sh -c 'exit 3'",
        """nice -n 5 sh -c 'echo 1 # it'"'"'s\'""",
        'mujoco_sim',
        'toys/a',
    ]
    assert process_specs(stack, toys)[3].executable == toys / 'lib/toys/a'
    assert stack.nodes[0].folder == '/tmp'
    assert stack.nodes[0].respawn.delay == 2.0
    assert whens(stack)['sh-1'] == 'at once, started again'
    assert 'world: walls' in parameters(stack, 'mujoco_sim-3')


@pytest.mark.parametrize('is_a_terminal', [True, False])
def test_the_keyboard_has_the_terminal(launch, monkeypatch, is_a_terminal):
    monkeypatch.setattr('sys.stdin', SimpleNamespace(isatty=lambda: is_a_terminal))
    name = 'teleop_twist_keyboard'
    entities = f"Node(package='{name}', executable='{name}', prefix='%s'),"
    (node,) = launch(entities % 'nice -n 5').nodes
    assert node.terminal is is_a_terminal
    assert node.prefix == ('' if is_a_terminal else 'nice -n 5')
    if not is_a_terminal:
        with pytest.raises(
            BringupError, match=r"my.launch.py:2\d: prefix 'nope_ -e': there is no"
        ):
            launch(entities % 'nope_ -e')


def test_opaque_functions_and_own_actions(launch):
    stack = launch(
        """
        DeclareLaunchArgument('count', default_value='2'),
        OpaqueFunction(function=several, args=['a']),
        Own(condition=IfCondition('true')),
        """,
        """
        from launch import Action, Substitution

        def several(context, name):
            count = int(LaunchConfiguration('count').perform(context))
            return [toy(name, arguments=[str(index)]) for index in range(count)]

        class Shout(Substitution):
            def perform(self, context):
                return context.launch_configurations['count'] + '!'

        class Own(Action):
            def execute(self, context):
                return [toy('b', arguments=[Shout()])]
        """,
    )
    assert [line for *_, line in commands(stack)] == ['a 0', 'a 1', "b '2!'"]


@pytest.mark.parametrize(
    ('entities', 'said'),
    [
        ("toy('e')", "my.launch.py:14: executable 'e' not found on the libexec directory '.*/toy"),
        ("Node(package='toyz', executable='a')", "my.launch.py:2.: package 'toyz' not found"),
        ("toy('a', parameters=['no.yaml'])", "my.launch.py:14: 'no.yaml': no such file"),
        ("toy('a', colour='red')", r'my.launch.py:14: Node\(colour=…\) is not understood here'),
        ("toy('a', arguments='a b')", r"my.launch.py:14: arguments='a b': it takes a list"),
        ("ExecuteProcess(cmd=['nope_'])", "there is no command 'nope_' on the PATH"),
        ("ExecuteProcess(cmd=['./nope_'], cwd='/tmp')", "there is no program '/tmp/nope_'"),
        ("ExecuteProcess(cmd=['sh'], cwd='/nope_')", "cwd='/nope_': there is no such folder"),
        ("*[toy('a')] * 2", 'the same action stands twice; make a second one'),
        ('3', '3 is no action'),
        ("toy('a', name=LaunchConfiguration('x'))", "configuration 'x' does not exist"),
        ("TimerAction(period='soon', actions=[])", r"TimerAction\(period='soon'\): it takes 0 s"),
        ("EmitEvent(event=3)", r'EmitEvent\(event=int\(…\)\) is not understood here'),
        ("1 / 0", r"my.launch.py' failed: ZeroDivisionError: division by zero \("),
        ("RegisterEventHandler(3)", 'it takes an event handler'),
        ("RegisterEventHandler(OnShutdown(on_shutdown=[toy('a')]))", 'OnShutdown cannot start'),
        ("SetParametersFromFile('p', node_name='a')", "unexpected keyword argument 'node_name'"),
        ("PopEnvironmentX()", "NameError: name 'PopEnvironmentX' is not defined"),
        ("DeclareLaunchArgument('x', default_value='c', choices=['a'])", 'Provided default_value'),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_with_its_place(launch, entities, said):
    with pytest.raises(BringupError, match=said) as told:
        process_specs(launch(entities), None)
    assert '\n' not in str(told.value)
