# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``spawner`` beside a controller manager that runs: steps, words, exit codes."""

import signal
import subprocess

from controller_manager_msgs.msg import ControllerState
import pytest
from rcl_interfaces.srv import GetParameters
from support import preloaded
from support.control_fakes import WHEELS
from support.manager_host import ros_in_this_process, running_host
from support.ros_processes import command, environment, PATIENCE, run
from support.running_programs import Program

from amr_description.controller_manager.spawner import (
    claimed_by_others,
    in_order_of_chains,
    Spawner,
)
from amr_description.controller_manager.spawner_arguments import parse
from amr_description.errors import ControllerError, NoAnswerError, ParameterError
from amr_description.ros.service_calls import call

JOINTS, DRIVE = 'joint_state_broadcaster', 'diff_drive_controller'
TYPE = 'diff_drive_controller/DiffDriveController'
WAITING = 'waiting for service /controller_manager/list_controllers to become available...'
ALREADY = ['Controller already loaded, skipping load_controller']


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    folder = tmp_path_factory.mktemp('host')
    with (
        pytest.MonkeyPatch.context() as patch,
        ros_in_this_process(),
        running_host(folder) as host,
    ):
        patch.setenv('ROS_HOME', str(folder))
        yield host


@pytest.fixture(autouse=True)
def nothing_loaded(host):
    yield
    host.forget()


class Voice:
    """A log that keeps its lines; :meth:`said` since last time."""

    def __init__(self):
        self.lines = []

    def __call__(self, severity, text, *, throttle=0.0):
        self.lines.append(text)

    def said(self):
        said, self.lines[:] = list(self.lines), []
        return said


@pytest.fixture
def voice():
    return Voice()


@pytest.fixture
def said(voice):
    return voice.said


@pytest.fixture
def spawner(host, voice):
    """Make the spawner of a command line."""

    def make(*words, files=()):
        return Spawner(voice, host.client, parse(words), files)

    return make


def words_of(ended):
    """What a process has logged, without stamps and names."""
    return [line.split(': ', 1)[1] for line in ended.stderr.splitlines() if 'RTPS' not in line]


def parameters(host, *names):
    request = GetParameters.Request(names=list(names))
    service = '/controller_manager/get_parameters'
    values = call(host.client_node, GetParameters, service, request).values
    return [list(v.string_array_value) or v.string_value for v in values]


def activated(name):
    return [f'Loaded {name}', f'Configured and activated {name}']


def test_a_controller_is_spawned_and_left_alone_when_it_is_active(host):
    ended = run('spawner', JOINTS)
    assert (ended.returncode, ended.stdout) == (0, '')
    assert words_of(ended) == [WAITING, *activated(JOINTS)]
    assert host.client.states() == {JOINTS: 'active'}
    again = run('spawner', JOINTS, '--activate-as-group')
    assert again.returncode == 0
    assert words_of(again) == [
        WAITING,
        *ALREADY,
        f'Controller {JOINTS} is active already; nothing to do',
    ]


def test_each_controller_goes_as_far_as_it_is_told(host, spawner, said):
    words = f'--controller {JOINTS} --load-only --controller {DRIVE} --inactive'
    spawner(*words.split(), '--controller', 'bystander_1').spawn()
    assert said() == [
        f'Loaded {JOINTS}',
        f'Loaded {DRIVE}',
        *activated('bystander_1'),
    ]
    states = {JOINTS: 'unconfigured', DRIVE: 'inactive', 'bystander_1': 'active'}
    assert host.client.states() == states
    spawner(JOINTS, DRIVE, 'bystander_1').spawn()
    assert said() == [
        *ALREADY,
        f'Configured and activated {JOINTS}',
        *ALREADY,
        f'Configured and activated {DRIVE}',
        *ALREADY,
        'Controller bystander_1 is active already; nothing to do',
    ]


def test_a_group_is_activated_by_one_request_without_those_that_are_active(
    host, spawner, said, monkeypatch
):
    host.activate(JOINTS)
    asked = []
    switch = host.client.switch
    monkeypatch.setattr(host.client, 'switch', lambda **o: asked.append(o) or switch(**o))
    words = [JOINTS, DRIVE, 'bystander_1', '--activate-as-group', '--no-switch-asap']
    spawner(*words, '--switch-timeout', '3').spawn()
    group = [DRIVE, 'bystander_1']
    assert asked == [{'activate': group, 'timeout': 3.0, 'activate_asap': False}]
    done = f'Configured and activated all the parsed controllers list : {group}!'
    assert said()[-1] == done
    assert set(host.client.states().values()) == {'active'}


def test_the_manager_is_told_what_files_and_line_say(host, spawner, said, tmp_path):
    mine, defaults = tmp_path / 'mine.yaml', tmp_path / 'defaults.yaml'
    mine.write_text(
        f'mine: {{ros__parameters: {{type: {TYPE}, fallback_controllers: [{JOINTS}], '
        f'left_wheel_names: [{WHEELS[0]}], right_wheel_names: [{WHEELS[2]}]}}}}'
    )
    defaults.write_text('/**: {ros__parameters: {wheel_separation: 0.3, wheel_radius: 0.5}}')
    host.activate(JOINTS)
    host.client.switch(deactivate=[JOINTS])
    words = ['mine', '-p', str(mine), '--controller-ros-args', '-r ~/odom:=/mine']
    spawner(*words, files=[str(defaults)]).spawn()
    files = [str(defaults), str(mine)]
    assert parameters(
        host,
        *(f'mine.{k}' for k in ('node_options_args', 'params_file', 'type')),
        'mine.fallback_controllers',
    ) == [['-r', '~/odom:=/mine'], files, TYPE, [JOINTS]]
    assert said() == [
        'Setting controller param "node_options_args" to "[\'-r\', \'~/odom:=/mine\']" for mine',
        f'Setting controller param "params_file" to "{files}" for mine',
        f'Setting controller param "type" to "{TYPE}" for mine',
        f'Setting controller param "fallback_controllers" to "[\'{JOINTS}\']" for mine',
        *activated('mine'),
    ]
    request = GetParameters.Request(names=['wheel_radius'])
    (radius,) = call(host.client_node, GetParameters, '/mine/get_parameters', request).values
    assert radius.double_value == 0.5


def test_files_for_ros_go_on_to_the_controllers(host, tmp_path):
    file = tmp_path / 'ros.yaml'
    file.write_text(f'from_ros: {{ros__parameters: {{type: {JOINTS}/JointStateBroadcaster}}}}')
    ended = run('spawner', 'from_ros', JOINTS, '--ros-args', '--params-file', str(file))
    assert (ended.returncode, words_of(ended)) == (
        0,
        [
            WAITING,
            f'Setting controller param "params_file" to "[\'{file}\']" for from_ros',
            f'Setting controller param "type" to "{JOINTS}/JointStateBroadcaster" for from_ros',
            *activated('from_ros'),
            *activated(JOINTS),
        ],
    )


def test_a_file_that_does_not_speak_of_a_controller_is_told(host, spawner, said, tmp_path):
    file = tmp_path / 'other.yaml'
    file.write_text('other: {ros__parameters: {gain: 1.0}}')
    text = f"parameters not found in parameter files : ['{file}']"
    spawner(JOINTS, '-p', str(file)).spawn()
    told = f'Controller : {JOINTS} {text}; the manager knows its type'
    assert said() == [told, *activated(JOINTS)]
    with pytest.raises(ParameterError, match='^Controller : nobody parameters not found in par'):
        spawner('nobody', '-p', str(file)).spawn()


@pytest.mark.parametrize(
    ('name', 'words', 'failure'),
    [
        (
            'nobody',
            '',
            'Failed loading controller nobody: no type is set for it: /contr',
        ),
        ('wrong_number', '', 'Failed loading controller wrong_number: .*wheel_radius'),
        ('rival_1', '', 'Failed to activate controller : rival_1: .* claimed by another control'),
        (
            'rival_1',
            '--activate-as-group',
            r"Failed to activate the parsed controllers list : \['rival_1'\]: .* claimed by anot",
        ),
    ],
)
def test_a_step_that_fails_has_its_reason(host, spawner, name, words, failure):
    host.activate(DRIVE)
    with pytest.raises(ControllerError, match=f'^{failure}'):
        spawner(name, *words.split()).spawn()


def test_a_controller_that_cannot_be_configured_has_its_reason(spawner, tmp_path):
    file = tmp_path / 'lopsided.yaml'
    file.write_text(f'lopsided: {{ros__parameters: {{type: {TYPE}, left_wheel_names: [a]}}}}')
    with pytest.raises(ControllerError, match='^Failed to configure controller lopsided: .*wheel'):
        spawner('lopsided', '-p', str(file)).spawn()


def test_what_cannot_be_is_named_and_the_rest_is_spawned(host, spawner, said, tmp_path):
    """A type that is not there, wheels that another one has claimed; in the order of chains."""
    file = tmp_path / 'robot.yaml'
    wheels = f'left_wheel_names: [{WHEELS[0]}], right_wheel_names: [{WHEELS[2]}]'
    drive = f'type: {TYPE}, {wheels}, wheel_separation: 0.3, wheel_radius: 0.1'
    file.write_text(
        'arm: {ros__parameters: {type: vendor/Arm}}\n'
        f'other: {{ros__parameters: {{{drive}}}}}\n'
        f'broken: {{ros__parameters: {{{drive}, cmd_vel_timeout: long}}}}'
    )
    words = ['-p', str(file), '--continue-on-error']
    spawner(JOINTS, DRIVE, 'arm', 'broken', 'other', *words).spawn()
    assert host.client.states() == {
        JOINTS: 'active',
        DRIVE: 'active',
        'other': 'inactive',
    }
    missing, broken, claimed = [line for line in said() if 'left out' in line or 'stays' in line]
    assert missing.startswith('Failed loading controller arm: ')
    assert "'vendor/Arm'" in missing
    assert missing.endswith('; it is left out')
    assert broken.startswith('Failed loading controller broken: ')
    assert claimed == (
        f'other stays inactive: {DRIVE} has claimed {WHEELS[0]}/velocity, {WHEELS[2]}/velocity; '
        f'for the other one:  ros2 control switch_controllers --deactivate {DRIVE} '
        '--activate other'
    )


def test_controllers_are_activated_after_those_that_they_are_chained_to():
    def state(name, *commands, states=()):
        return ControllerState(
            name=name,
            required_command_interfaces=list(commands),
            required_state_interfaces=list(states),
        )

    given = {
        each.name: each
        for each in (
            state('drive', 'left/velocity', 'right/velocity'),
            state('filter', states=['drive/speed']),
            state('left', 'wheel_left/velocity'),
            state('right', 'wheel_right/velocity'),
            state('ring_a', 'ring_b/x'),
            state('ring_b', 'ring_a/x'),
        )
    }
    ordered = in_order_of_chains(list(given), given)
    assert ordered == ['left', 'right', 'drive', 'filter', 'ring_a', 'ring_b']


def test_a_controller_that_somebody_has_unloaded_needs_and_claims_nothing():
    assert in_order_of_chains(['gone'], {}) == ['gone']
    assert claimed_by_others('gone', {}) == ('', [])


def test_two_spawners_of_one_controller_take_turns(host):
    processes = [
        preloaded.Popen(
            command('spawner', DRIVE), stderr=subprocess.PIPE, text=True, env=environment()
        )
        for _ in range(2)
    ]
    ends = [process.communicate(timeout=PATIENCE)[1] for process in processes]
    assert [process.returncode for process in processes] == [0, 0], ends
    assert host.client.states() == {DRIVE: 'active'}
    said = ''.join(ends)
    assert said.count(f'Loaded {DRIVE}') == said.count('is active already') == 1


def test_one_that_stays_unloads_what_it_spawned(host):
    words = f'--controller {JOINTS} --controller bystander_1 --inactive -u'
    with Program.module('spawner', *words.split()) as program:
        program.expect('Waiting until interrupt to unload controllers')
        assert host.client.states() == {JOINTS: 'active', 'bystander_1': 'inactive'}
        assert program.end(signal.SIGINT) == 0
    said = [line.split(': ', 1)[1] for line in program.lines[-4:]]
    assert said == [
        'KeyboardInterrupt successfully captured!',
        'Deactivating and unloading controllers...',
        f"Successfully deactivated controllers : ['{JOINTS}']",
        f"Successfully unloaded controllers : ['{JOINTS}', 'bystander_1']",
    ]
    assert host.client.states() == {}


def test_there_may_be_nothing_left_to_unload(host, spawner, said):
    host.activate(DRIVE)
    spawner(JOINTS, '-u').unload()
    assert said() == ['No active controllers to unload.']
    assert host.client.states() == {DRIVE: 'active'}


class GoneManager:
    """Goes before it answers, if it is asked anything."""

    name = '/controller_manager'

    def __init__(self, *presence):
        self.presence = iter(presence)

    def is_there(self):
        return next(self.presence)

    def states(self):
        raise NoAnswerError('it went away')


def test_controllers_of_a_manager_that_is_gone_need_no_unloading(voice):
    for presence in ((False,), (True, False)):
        Spawner(voice, GoneManager(*presence), parse([JOINTS, '-u'])).unload()
        assert voice.said() == ['/controller_manager is gone, and its controllers with it']
    with pytest.raises(NoAnswerError, match='it went away'):
        Spawner(voice, GoneManager(True, True), parse([JOINTS, '-u'])).unload()


def test_a_stop_during_the_spawning_ends_it_before_the_next(host, spawner):
    answers = iter([False, True])
    spawner(JOINTS, DRIVE).spawn(lambda: next(answers))
    assert host.client.states() == {JOINTS: 'active'}


def test_an_interrupted_wait_is_not_a_success(host):
    with Program.module('spawner', JOINTS, '-c', 'nobody') as program:
        program.expect('waiting for service /nobody/list_controllers')
        assert program.end(signal.SIGINT) == 128 + signal.SIGINT, program.output
    assert program.lines[-1].endswith('KeyboardInterrupt received! Exiting....')
    assert 'Traceback' not in program.output


def test_a_namespace_may_be_given_in_the_old_way_but_not_twice(host):
    ended = run('spawner', JOINTS, '-n', 'left', '--controller-manager-timeout', '3')
    assert ended.returncode == 1
    deprecated, _, error = words_of(ended)
    assert deprecated.startswith("The '--namespace' argument is deprecated and will be removed ")
    assert error.startswith(
        'Could not contact service /left/controller_manager/list_controllers within 3 s: there is '
        'no node /left/controller_manager, but /controller_manager; name it with -c'
    )
    ended = run('spawner', JOINTS, '-n', 'left', '--ros-args', '-r', '__ns:=/left')
    assert (ended.returncode, words_of(ended)) == (
        1,
        [
            "Setting namespace through both '--namespace left' arg and the ROS 2 standard way "
            "'--ros-args -r __ns:=/left' is not allowed!"
        ],
    )


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        (['a b'], "Invalid node name: .* 'spawner_a b'"),
        (['a', '-c', 'a b'], 'failed to resolve name: '),
        ([b'\xff'], 'not valid UTF-8: '),
    ],
)
def test_a_name_that_cannot_be_is_told_in_one_line(words, said):
    ended = run('spawner', *words)
    assert ended.returncode == 1
    (line,) = words_of(ended)
    assert line.startswith(said.partition(' .*')[0])
