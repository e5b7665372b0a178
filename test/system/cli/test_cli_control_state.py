# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 control`` that change something, beside a controller manager that runs."""

from fixtures.cli.commands import ros2
import pytest
from support.control_fakes import WHEELS
from support.manager_host import ros_in_this_process, running_host

JOINTS, DRIVE = 'joint_state_broadcaster', 'diff_drive_controller'
PARAMETERS = f"""\
left_wheel_names: [{WHEELS[0]}, {WHEELS[1]}], right_wheel_names: [{WHEELS[2]}, {WHEELS[3]}],
wheel_separation: 0.3, wheel_radius: 0.1"""
TYPE = 'diff_drive_controller/DiffDriveController'
LOGS = 'check controller_manager logs'
WAITING = 'waiting for service /controller_manager/list_controllers to become available...'


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    with ros_in_this_process(), running_host(tmp_path_factory.mktemp('host')) as host:
        yield host


@pytest.fixture(autouse=True)
def nothing_loaded(request):
    yield
    if 'host' in request.fixturenames:
        request.getfixturevalue('host').forget()


def control(*words, **env):
    """Return exit code, output and error, without what it says while it waits."""
    result = ros2('control', *words, **env)
    said = [line for line in result.stderr.splitlines(keepends=True) if WAITING not in line]
    assert 'Traceback' not in result.stderr
    return result.returncode, result.stdout, ''.join(said)


def done(text):
    return 0, f'{text}\n', ''


def failed(text):
    return 1, '', f'{text}\n'


def test_a_controller_is_loaded_and_brought_to_a_state(host):
    assert control('load_controller', JOINTS) == done(f'Successfully loaded controller {JOINTS}')
    assert host.client.states() == {JOINTS: 'unconfigured'}
    already = f'Controller : {JOINTS} already loaded, skipping load_controller!\n'
    into = f'Successfully loaded controller {JOINTS} into state '
    for state in ('inactive', 'active', 'active'):
        assert control('load_controller', JOINTS, '--set-state', state) == done(
            f'{already}{into}{state}'
        )
        assert host.client.states() == {JOINTS: state}
    code, said, error = control('load_controller', JOINTS, '--set-state', 'inactive')
    assert (code, said) == (1, already)
    assert error == (
        f'Controller : {JOINTS} is active; to deactivate it: '
        f'ros2 control set_controller_state {JOINTS} inactive\n'
    )
    assert host.client.states() == {JOINTS: 'active'}


def test_a_parameter_file_names_the_type(host, tmp_path):
    file = tmp_path / 'mine.yaml'
    file.write_text(f'mine: {{ros__parameters: {{type: {TYPE}, {PARAMETERS}}}}}')
    code, said, error = control('load_controller', 'mine', '--set-state', 'active', str(file))
    assert (code, error) == (0, '')
    assert said.endswith('Successfully loaded controller mine into state active\n')
    assert host.client.states() == {'mine': 'active'}


def test_a_load_that_fails_says_why(host, tmp_path):
    code, said, error = control('load_controller', 'nobody')
    assert (code, said) == (1, '')
    assert error.startswith(f'Failed loading controller nobody {LOGS}: no type is set for it: ')
    assert control('load_controller', 'nobody', 'no.yaml') == failed(
        'Controller parameter file : no.yaml does not exist, Aborting!'
    )
    (tmp_path / 'other.yaml').write_text('other: {ros__parameters: {}}')
    code, said, error = control('load_controller', JOINTS, str(tmp_path / 'other.yaml'))
    assert (code, said) == (1, '')
    assert error.startswith(f'Controller : {JOINTS} parameters not found in parameter files : [')
    code, said, error = control('load_controller', 'broken')
    assert 'ValueError: a mistake of a third party' not in said
    assert error.startswith(f'Failed loading controller broken {LOGS}: ')
    assert error.count('\n') == 1


def test_a_controller_goes_from_state_to_state(host):
    assert host.client.load(JOINTS)
    for state, said in (
        ('inactive', f'Successfully configured {JOINTS}'),
        ('active', f'Successfully activated {JOINTS}'),
        ('inactive', f'Successfully deactivated {JOINTS}'),
        ('unconfigured', f'successfully cleaned up {JOINTS}'),
    ):
        assert control('set_controller_state', JOINTS, state) == done(said)
        assert host.client.states() == {JOINTS: state}


@pytest.mark.parametrize(
    ('state', 'asked', 'said'),
    [
        ('active', 'active', f'cannot activate {JOINTS} from its current state active'),
        ('unconfigured', 'active', f'cannot activate {JOINTS} from its current state unconfig'),
        ('inactive', 'inactive', f"cannot put {JOINTS} in 'inactive' state from its current sta"),
        ('active', 'unconfigured', f'cannot cleanup {JOINTS} from its current state active'),
        (None, 'active', f'controller {JOINTS} does not seem to be loaded'),
    ],
)
def test_a_state_that_is_not_the_next_is_refused(host, state, asked, said):
    if state:
        assert host.client.load(JOINTS)
    if state in ('inactive', 'active'):
        assert host.client.configure(JOINTS)
    if state == 'active':
        assert host.client.switch(activate=[JOINTS]) is None
    code, printed, error = control('set_controller_state', JOINTS, asked)
    assert (code, printed) == (1, '')
    assert error.startswith(said)
    assert host.client.states() == ({JOINTS: state} if state else {})


def test_an_activation_that_is_refused_is_not_called_a_success(host):
    """The original asks under BEST_EFFORT here, and says that all went well."""
    host.activate(DRIVE)
    assert host.client.load('rival_1')
    assert host.client.configure('rival_1')
    code, said, error = control('set_controller_state', 'rival_1', 'active')
    assert (code, said) == (1, '')
    assert error.startswith(f'Error activating controller, {LOGS}: Unable to activate controller')
    assert 'is currently claimed by another controller' in error


def test_controllers_are_switched_with_the_strictness_asked_for(host):
    host.activate(JOINTS)
    assert host.client.load(DRIVE)
    assert host.client.configure(DRIVE)
    words = ('switch_controllers', '--deactivate', JOINTS, '--activate', DRIVE, 'nobody')
    code, said, error = control(*words, '--strict')
    assert (code, said) == (1, '')
    assert error == (
        "Aborting, no controller is switched! ('STRICT' switch) "
        "Could not activate controller with name 'nobody' because no controller with this name "
        'exists\n'
    )
    assert host.client.states() == {JOINTS: 'active', DRIVE: 'inactive'}
    code, said, error = control(*words, '--best-effort', '--switch-timeout', '2.5')
    assert (code, error) == (0, '')
    assert said.startswith('Successfully switched controllers!')
    assert host.client.states() == {JOINTS: 'inactive', DRIVE: 'active'}
    assert control('switch_controllers') == done(
        'After checking the controllers, no controllers need to be activated or deactivated.'
    )


def test_what_a_switch_says_is_blue_or_red(host):
    assert control('switch_controllers', RCUTILS_COLORIZED_OUTPUT='1')[1].startswith('\033[94m')
    words = ('switch_controllers', '--strict', '--activate', 'nobody')
    assert control(*words, RCUTILS_COLORIZED_OUTPUT='1')[2].startswith('\033[91mAborting')


def test_controllers_are_cleaned_up_and_unloaded(host):
    host.activate(JOINTS)
    for verb, doing, way in (
        ('cleanup_controller', 'cleaning up', "can not be cleaned-up from 'active' state"),
        ('unload_controller', 'unloading', 'because it is still active'),
    ):
        code, said, error = control(verb, JOINTS)
        assert (code, said) == (1, '')
        assert error.startswith(f'Error {doing} controller {JOINTS}, {LOGS}: ')
        assert way in error
    assert host.client.switch(deactivate=[JOINTS]) is None
    assert control('cleanup_controller', JOINTS) == done(
        f'Successfully cleaned up controller {JOINTS}'
    )
    assert host.client.states() == {JOINTS: 'unconfigured'}
    assert control('unload_controller', JOINTS) == done(
        f'Successfully unloaded controller {JOINTS}'
    )
    assert host.client.states() == {}
    assert 'no controller with this name exists' in control('unload_controller', JOINTS)[2]


def test_libraries_are_reloaded_by_force(host):
    host.activate(JOINTS)
    code, said, error = control('reload_controller_libraries')
    assert (code, said) == (1, '')
    assert error.startswith(f'Error reloading libraries, {LOGS}: Cannot reload controller libr')
    assert control('reload_controller_libraries', '--force-kill') == done('Reload successful')
    assert host.client.states() == {}


def test_a_component_is_brought_to_a_state(host):
    for state in ('inactive', 'unconfigured', 'inactive', 'active'):
        assert control('set_hardware_component_state', 'hardware', state) == done(
            f'Successfully set hardware to state {state}'
        )
    code, said, error = control('set_hardware_component_state', 'nobody', 'inactive')
    assert (code, said) == (1, '')
    assert error.startswith(f'Error stopping hardware component, {LOGS}: ')
    assert "'nobody'" in error


@pytest.mark.parametrize(
    'words',
    [
        ('set_controller_state', JOINTS, 'finalized'),
        ('set_controller_state', JOINTS),
        ('set_hardware_component_state', 'hardware', 'on'),
        ('switch_controllers', '--strict', '--best-effort'),
        ('switch_controllers', '--switch-timeout', 'soon'),
        ('load_controller', JOINTS, '--set-state', 'unconfigured'),
        ('unload_controller', '\udcff'),
        ('unload_controller',),
    ],
)
def test_a_wrong_command_line_is_answered_with_the_usage(words):
    code, said, error = control(*words)
    assert (code, said) == (2, '')
    assert error.startswith(f'usage: ros2 control {words[0]} [-h]')


def test_a_manager_that_cannot_be_is_told_in_one_line():
    for verb in ('list_controllers', 'reload_controller_libraries'):
        code, said, error = control(verb, '-c', 'a b')
        assert (code, said) == (1, '')
        assert error.startswith("'a b' is not the name of a controller manager: ")
        assert error.count('\n') == 1
