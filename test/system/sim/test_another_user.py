# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Another user of the host, a real one with a uid of his own, asks the simulator for harm.

It runs as root here, he as 65534: nothing runs for him, nothing that he may not read is told, in
an answer, a topic, or the log, and nothing is written where he says.
"""

import json
import os
from pathlib import Path
import select
import signal
import subprocess
import sys
import tempfile
from urllib.parse import urlencode

from fixtures.sim.driving import AMR
import pytest
from support.needs import need
from support.paths import ROOT
from support.ros_processes import environment, PATIENCE
from support.running_programs import Program

from amr_description.sim.spawning import SpawnCode

CLIENT = ROOT / 'test' / 'fixtures' / 'sim' / 'other_user.py'
OTHER = 65534
SECRET = 'canary7391'
"""In every file that the other user may not read, in places where a reader would quote it."""
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
COMMANDS = f"""<robot name="evil" {XACRO}>
<xacro:property name="g" value="${{(x for x in [1]).gi_frame.f_back.f_back.f_builtins}}"/>
<link name="${{g['open']('PATH', 'w').write('ran') or 'a'}}"/></robot>"""


class OtherUser:
    """The client; ``home``: his folder."""

    def __init__(self, home):
        self.home = home
        self._process = subprocess.Popen(
            [sys.executable, str(CLIENT), str(OTHER), str(home)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment(),
            text=True,
        )
        assert self._answer() == [OTHER] * 3

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.stdin.close()
        self._process.kill()
        self._process.wait()
        self._process.stdout.close()

    def _answer(self):
        ready, _, _ = select.select([self._process.stdout], [], [], 3 * PATIENCE)
        assert ready, 'it does not answer'
        return json.loads(self._process.stdout.readline())

    def _say(self, *words):
        self._process.stdin.write(f'{json.dumps(words)}\n')
        self._process.stdin.flush()
        return self._answer()

    def call(self, service, kind, /, **fields):
        return self._say('call', service, kind, fields)

    def simulator(self, name, kind, /, **fields):
        return self.call(f'/mujoco_sim/{name}', f'simulation_interfaces/srv/{kind}', **fields)

    def spawn(self, **fields):
        """The result code and the reason; beside what is there already."""
        fields = {'initial_pose': {'pose': {'position': {'y': 3.0}}}} | fields
        answer = self.simulator('spawn_entity', 'SpawnEntity', **fields)
        return answer['result']['result'], answer['result']['error_message']

    def set_parameter(self, node, name, value):
        """Why it is refused; empty: it is not."""
        parameter = {'name': name, 'value': {'type': 4, 'string_value': str(value)}}
        answer = self.call(
            f'{node}/set_parameters', 'rcl_interfaces/srv/SetParameters', parameters=[parameter]
        )
        (result,) = answer['results']
        return result['reason']

    def can_read(self, path):
        return self._say('open', str(path))

    @property
    def log(self):
        return '\n'.join(self._say('log'))


@pytest.fixture(scope='module')
def place():
    """A folder that all may read: of the simulator, of the other user, and one with secrets."""
    need(os.geteuid() == 0, 'only root can be another user; run it as root')
    with tempfile.TemporaryDirectory() as top:
        os.chmod(top, 0o755)
        for name in ('started', 'home', 'ours'):
            Path(top, name).mkdir(mode=0o755)
        os.chown(Path(top, 'home'), OTHER, OTHER)
        yield Path(top)


@pytest.fixture(scope='module')
def simulator(place):
    with Program.module('mujoco_sim', cwd=place / 'started') as program:
        program.expect('waiting for robots')
        yield program
        assert program.end(signal.SIGINT) == 0
        assert SECRET not in program.output
        assert 'Traceback' not in program.output


@pytest.fixture(scope='module')
def other(simulator, place):
    with OtherUser(place / 'home') as other:
        code, reason = other.spawn(name='amr', resource_string=AMR, initial_pose={})
        assert code == SpawnCode.OK, reason
        yield other


@pytest.fixture
def secret(place):
    """Writes a file that is the simulator's user's alone."""

    def write(name, text):
        path = place / 'ours' / name
        path.write_text(text)
        path.chmod(0o600)
        return path

    return write


def his(other, name, text):
    path = other.home / name
    path.write_text(text)
    os.chown(path, OTHER, OTHER)
    return path


def is_silent(other, *answers):
    """Nothing of a secret is in the answers, or on /rosout; nothing was spawned."""
    assert not any(SECRET in str(each) for each in answers), answers
    assert SECRET not in other.log
    listed = other.simulator('get_entities', 'GetEntities')
    assert listed['entities'] == ['amr']


def test_nothing_of_his_files_runs(other, place):
    ran = place / 'ours' / 'ran'
    for name in ('evil.urdf.xacro', 'evil.xacro'):
        path = his(other, name, COMMANDS.replace('PATH', str(ran)))
        for uri in (str(path), f'file://{path}', f'{path}?a=1'):
            code, reason = other.spawn(uri=uri)
            assert code == SpawnCode.NO_RESOURCE
            assert f'{path} belongs to the user {OTHER}' in reason
    assert not ran.exists()


@pytest.mark.parametrize(
    'plugin', ['evil/Plugin', 'evil.evil/Plugin', 'pip.__main__/x', 'subprocess/Popen', 'this/s']
)
def test_no_module_of_his_is_imported_nor_one_that_is_a_program(other, place, plugin):
    ran = place / 'ours' / 'ran'
    for folder in (place / 'started', other.home):
        his(other, 'evil.py', f'open({str(ran)!r}, "w")\n').rename(folder / 'evil.py')
    text = AMR.replace('amr_description/MujocoSystem', plugin)
    assert text != AMR
    code, reason = other.spawn(name='evil', resource_string=text, entity_namespace='/his')
    if code == SpawnCode.OK:  # of a name without a dot, which is taken for a driver in C++
        assert '.' not in plugin
        answer = other.simulator('delete_entity', 'DeleteEntity', entity='evil')
        assert answer['result']['result'] == SpawnCode.OK
    else:
        assert plugin in reason
    manager = '/controller_manager'
    assert other.set_parameter(manager, 'evil.type', plugin) == ''
    loaded = other.call(
        f'{manager}/load_controller', 'controller_manager_msgs/srv/LoadController', name='evil'
    )
    assert not loaded['ok']
    assert not ran.exists()


SECRETS = {
    'robot.urdf': AMR.replace('name="amr"', f'name="{SECRET}"', 1),
    'broken.urdf': f'{SECRET} <robot name="{SECRET}"><link name="{SECRET}"',
    'wrong.urdf': f'<robot name="a"><link name="{SECRET}"/><joint name="{SECRET}"/></robot>',
    'robot.urdf.xacro': f'<robot name="{SECRET}" {XACRO}><link name="a"/></robot>',
    'broken.urdf.xacro': f'<robot name="{SECRET}" {XACRO}><link name="${{{SECRET}}}"/></robot>',
    'id_rsa': f'-----BEGIN {SECRET}',
}


@pytest.mark.parametrize('name', SECRETS)
@pytest.mark.parametrize('by', ['path', 'link'])
def test_no_file_is_read_for_him_that_he_may_not_read(other, secret, name, by):
    path = secret(name, SECRETS[name])
    assert not other.can_read(path)
    uri = path
    if by == 'link':
        uri = other.home / f'link_{name}'
        uri.unlink(missing_ok=True)
        uri.symlink_to(path)
    code, reason = other.spawn(uri=str(uri))
    assert code == SpawnCode.NO_RESOURCE
    assert f'not everybody may read {path}' in reason
    answer = other.simulator('load_world', 'LoadWorld', uri=str(uri))
    assert f'not everybody may read {path}' in answer['result']['error_message']
    is_silent(other, reason, answer)


def test_an_argument_of_his_is_no_expression(other, place):
    """Xacro evaluates what stands inside of ${…}, and puts arguments there."""
    path, ran = place / 'ours' / 'wide.urdf.xacro', place / 'ours' / 'ran'
    path.write_text(
        f'<robot name="r" {XACRO}><xacro:arg name="wide" default="1"/>'
        '<link name="base${2 * $(arg wide)}"/></robot>'
    )
    path.chmod(0o644)
    for value in (f"open('{ran}', 'w').write('ran')", '[g for g in ()].append(1)', '9**9**9'):
        code, reason = other.spawn(name='r', uri=f'{path}?{urlencode({"wide": value})}')
        assert code == SpawnCode.NO_RESOURCE
        assert 'the argument wide is not taken from a request: ' in reason
    assert not ran.exists()
    assert other.spawn(name='r', uri=f'{path}?wide=0.5')[0] == SpawnCode.OK
    other.simulator('delete_entity', 'DeleteEntity', entity='r')


def test_a_xacro_file_that_he_may_have_run_reads_no_secret_for_him(other, place, secret):
    path = place / 'ours' / 'open.urdf.xacro'
    path.write_text(
        f'<robot name="r" {XACRO}><xacro:arg name="file" default=""/>'
        '<xacro:property name="file" value="$(arg file)"/>'
        '<link name="${xacro.load_yaml(file)[\'name\']}"/></robot>'
    )
    path.chmod(0o644)
    hers = his(other, 'open.yaml', 'name: base\n')
    hidden = secret('secret.yaml', f'name: {SECRET}\n')
    code, reason = other.spawn(name='r', uri=f'{path}?file={hidden}')
    assert code == SpawnCode.NO_RESOURCE
    assert f'not everybody may read {hidden}' in reason
    code, reason = other.spawn(name='r', uri=f'{path}?file={hers}')
    assert f'belongs to the user {OTHER}' in reason
    is_silent(other, reason)


@pytest.mark.parametrize('suffix', ['.stl', '.obj', '.dae', '.ply', '.glb', '.gltf', '.off', ''])
def test_what_a_description_names_is_not_quoted(other, secret, suffix):
    """A mesh is read as the simulator's user, whose robots are in folders of his own."""
    path = secret(f'mesh{suffix}', f'v {SECRET}\nsolid {SECRET}\n{SECRET} {SECRET}\n' * 20)
    assert not other.can_read(path)
    mesh = f'<mesh filename="file://{path}"/>'
    text = AMR.replace(
        '<link name="base_link">',
        f"""<link name="base_link"><collision>
        <geometry>{mesh}</geometry></collision>""",
        1,
    )
    assert text != AMR
    code, reason = other.spawn(name='mesh', resource_string=text, entity_namespace='/his')
    if code == SpawnCode.OK:
        other.simulator('delete_entity', 'DeleteEntity', entity='mesh')
    is_silent(other, reason.replace(str(path), ''))


@pytest.mark.parametrize('text', [f'{SECRET}: [', f'{SECRET}', f'a:\n  ros__parameters: {SECRET}'])
def test_nor_is_a_parameter_file(other, secret, text):
    path = secret('secret.yaml', text)
    gazebo = (
        '<gazebo><plugin filename="libgz_ros2_control-system.so" '
        f'name="gz_ros2_control::GazeboSimROS2ControlPlugin"><parameters>{path}</parameters>'
        '</plugin></gazebo></robot>'
    )
    text = AMR.replace('</robot>', gazebo)
    code, reason = other.spawn(name='p', resource_string=text, entity_namespace='/his')
    if code == SpawnCode.OK:
        other.simulator('delete_entity', 'DeleteEntity', entity='p')
    manager = '/controller_manager'
    assert (
        other.set_parameter(manager, 'q.type', 'joint_state_broadcaster/JointStateBroadcaster')
        == ''
    )
    refusal = other.set_parameter(manager, 'q.params_file', path)
    loaded = other.call(
        f'{manager}/load_controller', 'controller_manager_msgs/srv/LoadController', name='q'
    )
    is_silent(other, reason, refusal, loaded)


def test_a_bag_is_written_below_the_folder_of_the_start_only(other, place):
    for folder in (place / 'ours' / 'bag', place / 'started', '/root/bag', '../ours/bag'):
        reason = other.set_parameter('/mujoco_sim', 'record', folder)
        assert f'is not below {place / "started"}, as a request has to be' in reason
    link = place / 'started' / 'link'
    link.symlink_to(place / 'ours')
    assert 'is not below' in other.set_parameter('/mujoco_sim', 'record', 'link/bag')
    assert [each.name for each in (place / 'ours').glob('bag*')] == []
    assert other.set_parameter('/mujoco_sim', 'record', 'bag') == ''
    assert other.set_parameter('/mujoco_sim', 'record', '') == ''
    assert (place / 'started' / 'bag' / 'metadata.yaml').is_file()


def test_no_folder_is_listed_for_him_that_he_may_not_list(other, place):
    closed = place / 'ours' / 'closed'
    closed.mkdir(mode=0o700)
    (closed / f'{SECRET}.urdf').write_text('')
    assert not other.can_read(closed)
    answer = other.simulator('get_spawnables', 'GetSpawnables', sources=[str(closed)])
    assert f'not everybody may read {closed}' in answer['result']['error_message']
    is_silent(other, answer)
