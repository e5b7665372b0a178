# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator as a process: what it takes in, what it refuses, how create and spawner end."""

from dataclasses import dataclass
from pathlib import Path
import signal
import subprocess

from geometry_msgs.msg import PoseStamped
import pytest
import rclpy
from rclpy.node import Node
from simulation_interfaces.msg import Result
from simulation_interfaces.srv import GetEntityState, ResetSimulation, SpawnEntity
from support.ros_processes import command, environment, PATIENCE, ROOT, run, running
from support.running_programs import Program

from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import call, wait_until
from amr_description.sim.spawning import SpawnCode
from amr_description.testing.program import own_domain

URDF = (ROOT / 'urdf' / 'amr.urdf').read_text(encoding='utf-8')
YAML = (ROOT / 'config' / 'controllers.yaml').read_text(encoding='utf-8')
SERVICES = '/mujoco_sim'


@dataclass(frozen=True)
class SharedSimulator:
    """The simulator of all tests of this file, and the parameter file that it reads at a spawn."""

    program: Program
    controllers: Path


@pytest.fixture(scope='module')
def node():
    rclpy.init(args=[])
    node = Node('test_mujoco_sim')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture(scope='module')
def shared(tmp_path_factory):
    path = tmp_path_factory.mktemp('mujoco_sim') / 'controllers.yaml'
    path.write_text(YAML)
    options = ('--ros-args', '-p', f'controllers:={path}')
    with Program.module('mujoco_sim', *options) as program:
        program.expect('waiting for robots')
        yield SharedSimulator(program, path)
        assert program.end(signal.SIGINT) == 0, program.output


@pytest.fixture
def sim(shared, node):
    """The simulator without a robot; it has none afterwards."""
    shared.controllers.write_text(YAML)
    yield shared
    reset = ResetSimulation.Request(scope=ResetSimulation.Request.SCOPE_ALL)
    response = call(node, ResetSimulation, f'{SERVICES}/reset_simulation', reset, timeout=PATIENCE)
    assert response.result.result == Result.RESULT_OK, response.result.error_message
    assert gone(node, 'controller_manager')


def gone(node, name):
    """Wait until no node has this name any more."""
    return wait_until(
        node,
        lambda: name not in node.get_node_names() or None,
        lambda: None,
        every=1.0,
        timeout=PATIENCE,
    )


def spawn(node, **fields):
    return call(
        node, SpawnEntity, f'{SERVICES}/spawn_entity', SpawnEntity.Request(**fields), timeout=20.0
    )


def aside(y):
    """A pose that far to the left of the origin, m."""
    pose = PoseStamped()
    pose.pose.position.y = y
    return pose


def state(node, entity):
    request = GetEntityState.Request(entity=entity)
    return call(node, GetEntityState, f'{SERVICES}/get_entity_state', request, timeout=20.0)


def test_each_fault_of_the_tutorial_is_named_once_and_nothing_else():
    """Of a simulator of its own, as all that it prints counts; so in a domain of its own."""
    tutorial = ROOT / 'test' / 'fixtures' / 'tutorial'
    controllers = tutorial / 'controllers.yaml'
    # Paused: on a busy machine a simulation that plays warns that real time is not kept.
    arguments = ['--ros-args', '-p', f'controllers:={controllers}', '-p', 'paused:=true']
    with (
        own_domain(),
        running('mujoco_sim', *arguments, until='waiting for robots') as process,
    ):
        assert run('create', '-file', str(tutorial / 'amr.urdf'), '-name', 'amr').returncode == 0
        said = []
        for line in process.stderr:
            said.append(line)
            if "Successful 'activate' of hardware" in line:
                break
    axles, frames, scrubbing = [line for line in said if '[WARN]' in line or '[ERROR]' in line]
    assert 'a positive speed drives the robot backwards' in axles
    place = f'{controllers}:{{}}: diff_drive_controller: {{}}'
    assert place.format(20, '"base_link" gets two parents in TF') in frames
    assert place.format(16, 'wheels one behind the other scrub in a turn') in scrubbing


def test_a_second_simulator_in_a_domain_ends_with_one_line_and_the_first_goes_on(sim, node):
    with Program.module('mujoco_sim', '--ros-args', '-p', 'paused:=true') as second:
        assert second.end() == 1
    (line,) = [line for line in second.lines if '[FATAL]' in line]
    assert '/mujoco_sim publishes /clock in ROS domain' in line
    assert sim.program.process.poll() is None
    assert wait_until(node, lambda: node.count_publishers('/clock') == 1 or None, timeout=PATIENCE)


def test_a_wrong_axle_is_one_warning_at_the_spawn(sim, node):
    axes = URDF.count('<axis xyz="0 0 -1"/>')
    wrong = URDF.replace('<axis xyz="0 0 -1"/>', '<axis xyz="1 0 0"/>')
    request = SpawnEntity.Request(name='crab', resource_string=wrong)
    request.initial_pose.pose.position.z = 0.2
    response = call(node, SpawnEntity, f'{SERVICES}/spawn_entity', request, timeout=20.0)
    assert (axes, response.result.result) == (4, Result.RESULT_OK)
    words = 'of diff_drive_controller: the axle points ahead, so that the wheel rolls sideways: '
    sim.program.expect(words)
    assert sim.program.output.count(words) == 1


def test_a_robot_is_spawned_falls_and_rests(sim, node):
    request = SpawnEntity.Request(name='amr', resource_string=URDF)
    request.initial_pose.pose.position.x = 1.5
    request.initial_pose.pose.position.z = 0.2
    response = call(node, SpawnEntity, f'{SERVICES}/spawn_entity', request, timeout=20.0)
    assert (response.result.result, response.entity_name) == (Result.RESULT_OK, 'amr')

    def at_rest():
        it = state(node, 'amr').state
        still = abs(it.twist.linear.z) < 1e-4 and it.pose.position.z < 0.1
        return it if still else None

    pose = wait_until(node, at_rest, lambda: None, every=1.0, timeout=20.0).pose
    assert pose.position.x == pytest.approx(1.5, abs=1e-3)
    assert pose.position.z == pytest.approx(0.0, abs=1e-3)
    assert pose.orientation.w == pytest.approx(1.0, abs=1e-6)


def test_what_cannot_be_spawned_is_refused_with_its_code(sim, node):
    assert spawn(node, name='amr', resource_string=URDF).result.result == Result.RESULT_OK
    refusals = {
        SpawnCode.NAME_NOT_UNIQUE: {'name': 'amr', 'resource_string': URDF},
        SpawnCode.NAME_INVALID: {'name': 'my robot', 'resource_string': URDF},
        SpawnCode.NO_RESOURCE: {'name': 'empty'},
        SpawnCode.RESOURCE_PARSE_ERROR: {
            'name': 'half',
            'resource_string': URDF[: len(URDF) // 2],
        },
        SpawnCode.UNSUPPORTED_FORMAT: {'name': 'sdf', 'resource_string': '<sdf version="1.9"/>'},
    }
    for code, fields in refusals.items():
        result = spawn(node, **fields).result
        assert (result.result, bool(result.error_message)) == (code, True), fields['name']
        assert '\n' not in result.error_message
    second = spawn(node, name='second', resource_string=URDF).result
    assert second.result == SpawnCode.NAMESPACE_INVALID
    assert "the namespace '/' has a controller manager already" in second.error_message
    second = {'name': 'second', 'resource_string': URDF, 'entity_namespace': 'second'}
    inside = spawn(node, **second).result
    assert inside.result == SpawnCode.INVALID_POSE
    assert "spawned inside link 'base_link' of robot 'amr'" in inside.error_message
    apart = spawn(node, **second, initial_pose=aside(2.0))
    assert apart.result.result == Result.RESULT_OK
    renamed = spawn(
        node,
        name='amr',
        resource_string=URDF.replace('ros2_control', 'ignored'),
        allow_renaming=True,
        initial_pose=aside(-2.0),
    )
    assert renamed.entity_name == 'amr_1', renamed.result.error_message
    assert state(node, 'nobody').result.result == Result.RESULT_NOT_FOUND


def test_hardware_in_python_that_is_not_there_leaves_no_robot_behind(sim, node):
    urdf = URDF.replace('amr_description/MujocoSystem', 'acme.motors/Motor')
    result = spawn(node, name='amr', resource_string=urdf).result
    assert result.result == Result.RESULT_OPERATION_FAILED
    assert "hardware plugin 'acme.motors/Motor' is not known" in result.error_message
    assert state(node, 'amr').result.result == Result.RESULT_NOT_FOUND
    assert gone(node, 'controller_manager')


@pytest.mark.parametrize(
    ('plugin', 'words'),
    [
        ('acme/Motor', 'drives real hardware and is not used here'),
        ('mock_components/GenericSystem', 'is simulated; mock_hardware:=mock keeps the mock'),
    ],
)
def test_hardware_of_real_robots_and_mocks_is_simulated(sim, node, plugin, words):
    lost = '<joint name="lost"/></ros2_control>'
    urdf = URDF.replace('amr_description/MujocoSystem', plugin).replace('</ros2_control>', lost)
    begin = len(sim.program.output)
    assert spawn(node, name='amr', resource_string=urdf).result.result == Result.RESULT_OK
    sim.program.expect(f"plugin '{plugin}' {words}", begin)
    sim.program.expect("Joint 'lost' not found in URDF", begin)


@pytest.mark.parametrize(
    ('fields', 'code', 'message'),
    [
        ({'entity_namespace': 'my robot'}, SpawnCode.NAMESPACE_INVALID, "'my robot'"),
        (
            {
                'resource_string': URDF.replace(
                    'amr_description/MujocoSystem', 'numpy.ma/MaskedArray'
                )
            },
            SpawnCode.OPERATION_FAILED,
            "hardware plugin 'numpy.ma/MaskedArray' is no HardwareComponent: derive it from ",
        ),
    ],
)
def test_what_only_others_refuse_leaves_the_simulator_running(sim, node, fields, code, message):
    result = spawn(node, **{'name': 'amr', 'resource_string': URDF} | fields).result
    assert result.result == code
    assert message in result.error_message
    assert '\n' not in result.error_message
    assert state(node, 'amr').result.result == Result.RESULT_NOT_FOUND
    assert spawn(node, name='amr', resource_string=URDF).result.result == Result.RESULT_OK


def test_a_refused_update_rate_leaves_no_node_behind(sim, node):
    sim.controllers.write_text(YAML.replace('update_rate: 100', 'update_rate: 0'))
    result = spawn(node, name='amr', resource_string=URDF).result
    assert "parameter 'update_rate'" in result.error_message
    assert gone(node, 'controller_manager')


@pytest.mark.parametrize(
    ('old', 'new', 'message'),
    [
        ('<parent link="base_link"/>', '<parent link="trailer"/>', '"trailer"'),
        ('<mass value="0.5"/>', '<mass value="-1"/>', 'mass: '),
        ('</robot>', '', ':'),
    ],
)
def test_create_tells_what_is_wrong_with_a_urdf_and_fails(sim, tmp_path, old, new, message):
    path = tmp_path / 'broken.urdf'
    path.write_text(URDF.replace(old, new))
    ended = run('create', '-file', str(path), '-name', 'amr')
    assert ended.returncode == 1
    (line,) = ended.stderr.splitlines()
    assert f'Entity creation failed. {path}:' in line
    assert message in line


def test_xacro_files_are_expanded_with_their_arguments(sim, node, open_path):
    path = open_path / 'twin.urdf.xacro'
    path.write_text(
        '<robot name="$(arg name)" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:arg name="name" default="nobody"/>'
        '<xacro:include filename="$(find amr_description)/urdf/amr.urdf"/></robot>'
    )
    assert spawn(node, uri=f'{path}?name=one').entity_name == 'one'
    ended = run(
        'create', '-file', str(path), 'name:=two', '-x', '2', '--ros-args', '-r', '__ns:=/two'
    )
    assert (ended.returncode, 'remap rule' in ended.stderr) == (0, False)
    assert state(node, 'two').state.pose.position.x == pytest.approx(2.0, abs=1e-3)
    result = spawn(node, uri=str(path)).result
    assert result.result == SpawnCode.NO_RESOURCE
    assert f'{path}:1: Undefined substitution argument name' in result.error_message
    ended = run('create', '-topic', 'robot_description', 'name:=two')
    assert ended.returncode == 2
    assert 'name:=two is for a xacro file, and there is no -file' in ended.stderr


def test_create_without_a_source_or_with_a_missing_file():
    ended = run('create')
    assert ended.returncode == 255
    assert 'Must specify either -file, -param, -string or -topic' in ended.stderr
    ended = run('create', '-file', '/no/such.urdf')
    assert ended.returncode == 2
    assert '-file /no/such.urdf' in ended.stderr


def test_spawners_tell_why_they_fail(sim):
    wrong = YAML.replace('"joint_wheel_front_left"', '"joint_wheel_typo"')
    sim.controllers.write_text(wrong)
    assert run('create', '-string', URDF, '-z', '0.2').returncode == 0
    failures = {
        'nobody': 'no type is set for it: /controller_manager has one for diff_drive_controller, '
        'joint_state_broadcaster; name the parameter file that sets its type with -p FILE',
        'diff_drive_controller': "the command interface 'joint_wheel_typo/velocity' is not "
        'available',
    }
    for name, reason in failures.items():
        ended = run('spawner', name)
        assert ended.returncode == 1
        assert reason in ended.stderr
        assert 'Traceback' not in ended.stderr
    assert run('spawner', 'joint_state_broadcaster').returncode == 0
    again = run('spawner', 'joint_state_broadcaster')
    assert again.returncode == 0
    assert 'is active already' in again.stderr


def test_a_parameter_file_that_is_not_yaml_is_named_with_its_line(sim):
    sim.controllers.write_text('controller_manager:\n  ros__parameters: {update_rate: 100\n')
    ended = run('create', '-string', URDF)
    assert ended.returncode == 1
    assert f'{sim.controllers}:3:1' in ended.stderr


def test_the_spawner_waits_only_as_long_as_it_is_told():
    ended = run('spawner', 'some', '--controller-manager-timeout', '0.3')
    assert ended.returncode == 1
    assert (
        'Could not contact service /controller_manager/list_controllers within 0.3' in ended.stderr
    )


@pytest.mark.parametrize(
    ('parameter', 'message'),
    [
        ('world:=atlantis', "world 'atlantis'"),
        ('physics.solver:=newton', "'physics.solver' must be one of world, PGS, CG, Newton"),
    ],
)
def test_a_world_that_cannot_be_ends_the_simulator(parameter, message):
    ended = run('mujoco_sim', '--ros-args', '-p', parameter)
    assert ended.returncode == 1
    assert message in ended.stderr
    assert 'Traceback' not in ended.stderr


@pytest.mark.parametrize('library', ['librcl.so', 'librmw_fastrtps_cpp.so', 'libmujoco.so'])
def test_a_stop_during_the_start_ends_it_too(library):
    with own_domain():  # beside the other simulator it ends by itself, if the signal comes late
        process = subprocess.Popen(
            command('mujoco_sim'),
            stderr=subprocess.DEVNULL,
            env=environment(),
            start_new_session=True,
        )
        try:
            maps = Path(f'/proc/{process.pid}/maps')
            while library not in maps.read_text():
                assert process.poll() is None
            process.send_signal(signal.SIGTERM)
            assert process.wait(PATIENCE) in (0, -signal.SIGTERM)
        finally:
            process.kill()
            process.wait()


def test_create_fixes_the_root_in_the_air_where_that_is_asked(sim, node):
    words = ('-string', URDF, '-name', 'amr', '-z', '0.5')
    assert run('create', *words, '-fixed').returncode == 0
    begin = nanoseconds(state(node, 'amr').state.header.stamp)

    def later():
        found = state(node, 'amr').state
        return found if nanoseconds(found.header.stamp) - begin > 300_000_000 else None

    found = wait_until(node, later, timeout=PATIENCE)
    assert found.pose.position.z == 0.5
