# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``simulation``: the order of starts, and the parameters."""

import re

from fixtures.sim import plugin_robot
import pytest
from support.paths import ROOT

from amr_description.bringup.arguments import declared, resolve
from amr_description.bringup.scheduler import Scheduler
from amr_description.bringup.stack_files import make_stack
from amr_description.bringup.stacks.simulation import simulation
from amr_description.bringup.stacks.teleop import teleop
from amr_description.errors import AmrError, SimulationError
from amr_description.limited_child import Limits
from amr_description.model.description_file import located_text
from amr_description.model.origins import with_file
from amr_description.model.urdf import parse
from amr_description.sim.spawning import check_name

GRIPPER = str(ROOT / 'test/fixtures/urdf/gripper.urdf.xacro')


@pytest.fixture(autouse=True)
def installed(tmp_path, monkeypatch):
    """Install the files of the source tree, as ``colcon build --symlink-install`` does."""
    share = tmp_path / 'install/share/amr_description'
    marker = tmp_path / 'install/share/ament_index/resource_index/packages/amr_description'
    marker.parent.mkdir(parents=True)
    marker.touch()
    share.mkdir(parents=True)
    for folder in ('urdf', 'config'):
        (share / folder).symlink_to(ROOT / folder)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path / 'install'))
    return share


def stack(**given):
    return simulation(**resolve(declared(simulation), given))


def test_the_order_of_the_tutorial():
    scheduler = Scheduler(stack())
    waves = []
    while wave := scheduler.startable():
        for node in wave:
            scheduler.on_start(node)
        waves.append([[node.executable, *node.arguments[:1]] for node in wave])
        scheduler.on_exit(wave[-1], 0)
    assert waves == [
        [['mujoco_sim'], ['robot_state_publisher'], ['create', '-topic']],
        [['spawner', 'joint_state_broadcaster']],
        [['spawner', 'diff_drive_controller']],
        [['viewer']],
    ]
    assert scheduler.ready


def test_it_is_ready_only_with_the_last_controller():
    scheduler = Scheduler(stack())
    for _ in range(3):
        assert not scheduler.ready
        *_, last = scheduler.startable()
        for node in scheduler.startable():
            scheduler.on_start(node)
        scheduler.on_exit(last, 0)
    assert scheduler.ready


def test_parameters(installed):
    sim, publisher, create, *_ = stack(rtf='0').nodes
    assert sim.parameters == [
        {
            'world': 'empty',
            'real_time_factor': 0.0,
            'controllers': str(installed / 'config/controllers.yaml'),
            'paused': False,
        }
    ]
    strict, *_ = stack(strict='true').nodes
    assert strict.parameters[0]['strict'] is True
    assert publisher.parameters == [
        {
            'robot_description': with_file(
                (ROOT / 'urdf/amr.urdf').read_text(), f'{installed}/urdf/amr.urdf'
            ),
            'use_sim_time': True,
        }
    ]
    assert create.arguments == ['-topic', 'robot_description', '-name', 'amr', '-z', '0.2']


@pytest.mark.parametrize(
    ('urdf', 'name'),
    [
        ('<robot name="rover"/>', 'rover'),
        ('<!-- <robot name="old"/> --><robot name="my rover/2"/>', 'my_rover_2'),
        ('<robot/>', 'robot'),
        ('<robot name="rover">', 'robot'),
    ],
)
def test_the_robot_has_the_name_of_its_description(installed, tmp_path, urdf, name):
    (tmp_path / 'rover.urdf').write_text(urdf)
    create = stack(urdf=str(tmp_path / 'rover.urdf')).nodes[2]
    assert create.arguments == ['-topic', 'robot_description', '-name', name]
    check_name(name, ())


@pytest.mark.parametrize(
    ('given', 'words'),
    [
        ({}, ['-z', '0.2']),
        ({'z': '0'}, ['-z', '0']),
        ({'z': '-0.1', 'x': '1', 'yaw': '0.5'}, ['-x', '1.0', '-z', '-0.1', '-Y', '0.5']),
    ],
)
def test_the_pose_is_as_asked(given, words):
    create = stack(**given).nodes[2]
    assert create.arguments == ['-topic', 'robot_description', '-name', 'amr', *words]


@pytest.mark.parametrize(
    ('given', 'parameters'),
    [
        ({}, {}),
        ({'lift': 'true', 'strict': 'false', 'mock_hardware': 'simulate'}, {}),
        ({'lift': 'false'}, {'lift': False}),
        (
            {'strict': 'true', 'mock_hardware': 'mock'},
            {'strict': True, 'mock_hardware': 'mock'},
        ),
    ],
)
def test_the_simulator_is_told_what_differs_from_its_defaults(given, parameters):
    (told,) = stack(**given).nodes[0].parameters
    assert {key: told[key] for key in told.keys() & OPTIONS} == parameters


@pytest.mark.parametrize('name', ['simulation', 'fleet', 'navigation'])
def test_a_misspelt_world_is_refused_before_anything_starts(name):
    with pytest.raises(SimulationError, match=r"world 'warehose': neither .*mean warehouse\?;"):
        make_stack(name, {'world': 'warehose'})


def test_topics_are_called_as_a_bridge_file_says(tmp_path):
    (tmp_path / 'bridge.yaml').write_text(
        '- {ros_topic_name: drive, gz_topic_name: /model/cart/cmd_vel}\n'
    )
    (tmp_path / 'cart.urdf').write_text(plugin_robot.cart(plugin_robot.gz_drive()))
    given = {'urdf': str(tmp_path / 'cart.urdf'), 'bridge': str(tmp_path / 'bridge.yaml')}
    found = stack(**given)
    assert found.nodes[0].parameters[0]['bridge'] == given['bridge']
    assert found.velocity_topic.name == '/drive'
    with pytest.raises(AmrError, match='^bridge:=.*: no such file: '):
        stack(bridge='/none.yaml')


def test_mock_hardware_is_simulated_or_a_mock():
    with pytest.raises(AmrError, match='^mock_hardware:=fake: it is simulate or mock'):
        stack(mock_hardware='fake')


def test_a_renderer_is_one_that_there_is():
    assert stack(camera_renderer='rays').nodes[0].parameters[0]['camera_renderer'] == 'rays'
    with pytest.raises(AmrError, match='^camera_renderer:=vulkan: it is auto, gl or rays'):
        stack(camera_renderer='vulkan')


def test_a_recording_is_a_new_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert stack(record='drive').nodes[0].parameters[0]['record'] == str(tmp_path / 'drive')
    assert 'record' not in stack().nodes[0].parameters[0]
    (tmp_path / 'drive').mkdir()
    with pytest.raises(AmrError, match='^record:=drive: it is there already; another name'):
        stack(record='drive')


OPTIONS = {'lift', 'strict', 'mock_hardware', 'camera_renderer'}


def cart(folder, types, more=''):
    """Write a cart that is no amr, and a parameter file; return the arguments of the stack."""
    text = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()
    (folder / 'cart.urdf').write_text(text.replace('</robot>', f'{more}</robot>'))
    lines = ''.join(f'    {name}: {{type: {kind}}}\n' for name, kind in types.items())
    file = folder / 'cart.yaml'
    file.write_text(f'controller_manager:\n  ros__parameters:\n    update_rate: 50\n{lines}')
    return {'urdf': str(folder / 'cart.urdf'), 'controllers': str(file)}


STATES = 'joint_state_broadcaster/JointStateBroadcaster'
DRIVE = 'diff_drive_controller/DiffDriveController'
TYPES = {'base': DRIVE, 'lift': 'position_controllers/JointGroupPositionController', 'js': STATES}


def spawners(made):
    return [node for node in made.nodes if node.executable == 'spawner']


def test_another_robot_gets_the_controllers_of_its_file(tmp_path):
    made = stack(**cart(tmp_path, TYPES))
    (spawner,) = spawners(made)
    assert spawner.arguments == ['js', 'base', 'lift', '--continue-on-error']
    assert spawner.namespace is None
    assert '-r /cmd_vel:=/base/cmd_vel\n' in made.next_steps
    assert 'ros2 topic pub --once /base/cmd_vel geometry_msgs/msg/TwistStamped' in made.next_steps


def test_some_of_them_may_be_chosen(tmp_path):
    given = cart(tmp_path, TYPES)
    (spawner,) = spawners(stack(**given, activate='lift, js'))
    assert spawner.arguments == ['lift', 'js', '--continue-on-error']
    with pytest.raises(
        AmrError, match="^activate:=lif: .*; did you mean 'lift'\\? known: js, base, lift$"
    ):
        stack(**given, activate='js lif')


def test_the_manager_may_have_a_namespace_and_a_name(tmp_path):
    plugin = (
        '<gazebo><plugin filename="x" name="gz_ros2_control::GazeboSimROS2ControlPlugin"><ros>'
        '<namespace>left</namespace><remapping>~/cmd_vel:=cmd_vel</remapping></ros>'
        '<controller_manager_name>boss</controller_manager_name></plugin></gazebo>'
    )
    given = cart(tmp_path, TYPES, plugin)
    file = tmp_path / 'cart.yaml'
    file.write_text(file.read_text().replace('controller_manager:', '/left/boss:'))
    made = stack(**given)
    (spawner,) = spawners(made)
    assert spawner.namespace == '/left'
    assert spawner.arguments[-3:] == ['--controller-manager', 'boss', '--continue-on-error']
    assert '/cmd_vel:=/left/cmd_vel\n' in made.next_steps


def test_a_robot_without_ros2_control_waits_for_nobody(tmp_path):
    given = cart(tmp_path, TYPES)
    path = tmp_path / 'cart.urdf'
    path.write_text(re.sub('<ros2_control.*</ros2_control>', '', path.read_text(), flags=re.S))
    made = stack(**given)
    assert spawners(made) == []
    assert made.ready_when.nodes[0].executable == 'create'
    ((level, note),) = [each for each in made.notes if 'using' not in each[1]]
    assert level == 'INFO'
    assert note.endswith(f'controllers:={given["controllers"]} has no effect')


def test_the_keys_drive_the_robot_by_its_own_topic(tmp_path):
    def keyboard(**given):
        return teleop(**resolve(declared(teleop), given)).nodes[-1]

    given = cart(tmp_path, TYPES)
    assert keyboard().remappings == [('/cmd_vel', '/diff_drive_controller/cmd_vel')]
    assert keyboard(**given).remappings == [('/cmd_vel', '/base/cmd_vel')]
    with pytest.raises(AmrError, match='no controller of the robot takes a velocity, so keys'):
        keyboard(**given, activate='js')


@pytest.mark.parametrize(
    ('kind', 'parameters', 'expected'),
    [
        (
            'joint_trajectory_controller/JointTrajectoryController',
            'joints: [lift_joint]',
            '/it/joint_trajectory trajectory_msgs/msg/JointTrajectory \\\n        "{joint_names: '
            '[lift_joint], points: [{positions: [0.18], time_from_start: {sec: 2}}]}"',
        ),
        (
            'forward_command_controller/ForwardCommandController',
            'joints: [lift_joint]',
            '/it/commands std_msgs/msg/Float64MultiArray "{data: [0.18]}"',
        ),
        (
            'position_controllers/GripperActionController',
            'joint: lift_joint',
            '/it/gripper_cmd control_msgs/action/GripperCommand "{command: {position: 0.18}}"',
        ),
        (
            'parallel_gripper_action_controller/GripperActionController',
            'joint: lift_joint',
            'action/ParallelGripperCommand "{command: {position: [0.18]}}"',
        ),
        ('mecanum_drive_controller/MecanumDriveController', '', '/it/reference '),
        ('tricycle_controller/TricycleController', '', '/it/cmd_vel '),
        (
            'twist_mux_controller/TwistMuxController',
            'cmd_vel_inputs: {a: {priority: 1}, b: {priority: 2, topic: manual/cmd_vel}}',
            '/manual/cmd_vel ',
        ),
    ],
)
def test_the_next_steps_name_the_topics_of_the_controllers(tmp_path, kind, parameters, expected):
    given = cart(tmp_path, {'js': STATES, 'it': kind})
    with (tmp_path / 'cart.yaml').open('a') as file:
        file.write(f'it:\n  ros__parameters: {{{parameters}}}\n')
    said = stack(**given).next_steps
    assert expected in said
    assert said.endswith('Ctrl-C stops all.')


def test_the_root_may_be_fixed(tmp_path):
    made = stack(**cart(tmp_path, TYPES), fixed='true', name='it', lift='false')
    sim, publisher, create, *_ = made.nodes
    assert parse(publisher.parameters[0]['robot_description']).root.name == 'world'
    assert create.arguments[-1] == 'it'
    assert sim.parameters[0]['lift'] is False


def test_a_xacro_file_is_expanded_with_its_arguments(installed, capsys):
    given = {'urdf': str(GRIPPER), 'xacro_args': "palm:=false 'finger_lenght:=0.1'"}
    made = stack(**given)
    arguments = {'palm': 'false', 'finger_length': '0.08'}
    (parameters,) = made.nodes[1].parameters
    assert parameters['robot_description'] == located_text(GRIPPER, arguments)
    assert 'nothing asks for "finger_lenght"' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('expression', 'words'),
    [
        ('[0 for a in range(10**9) for b in range(10**9)]', 'bomb.xacro: no end after 1 s'),
        ("'x' * 10**10", 'bomb.xacro:1: MemoryError'),
    ],
)
def test_an_endless_expansion_is_stopped(tmp_path, monkeypatch, expression, words):
    monkeypatch.setattr('amr_description.bringup.urdf_text._LIMITS', Limits(seconds=1))
    bomb = tmp_path / 'bomb.xacro'
    bomb.write_text(f'<robot name="${{{expression}}}" xmlns:xacro="http://ros.org/wiki/xacro"/>')
    with pytest.raises(AmrError, match=words):
        stack(urdf=str(bomb))


def test_the_files_are_noted_with_their_hashes(installed):
    urdf, controllers = stack().notes
    assert urdf[1].startswith(f'using {installed}/urdf/amr.urdf -> {ROOT}/urdf/amr.urdf (sha256 ')
    assert controllers[1].startswith(f'using {installed}/config/controllers.yaml -> ')


@pytest.mark.parametrize(
    ('given', 'text'),
    [
        ({'xacro_args': 'a:=1'}, 'amr.urdf is no xacro file'),
        (
            {'urdf': GRIPPER, 'xacro_args': 'palm:=perhaps'},
            'xacro: .*gripper.*not a boolean',
        ),
        ({'urdf': GRIPPER, 'xacro_args': "palm:='"}, 'No closing quotation'),
        ({'urdf': GRIPPER, 'xacro_args': 'palm'}, "'palm' is no argument of a xacro file"),
        ({'z': 'high'}, "z:=high: 'high' is not a number"),
        ({'x': 'inf'}, 'a pose is of finite numbers'),
        ({'rtf': '-1'}, 'rtf:=-1.0: a real-time factor is 0'),
        ({'rtf': 'nan'}, 'rtf:=nan: a real-time factor is 0'),
        ({'urdf': 'no.urdf'}, 'urdf:=no.urdf: no such file: /'),
        ({'controllers': '/'}, 'controllers:=/: it is a folder: /'),
    ],
)
def test_bad_arguments_are_reported_before_anything_starts(given, text):
    with pytest.raises(AmrError, match=text):
        stack(**given)


def test_the_next_steps_can_be_typed():
    text = stack().next_steps
    assert 'ros2 run amr_description teleop_twist_keyboard --ros-args -p stamped:=true' in text
    command = '{header: {frame_id: base_link}, twist: {linear: {x: 0.5}, angular: {z: 0.0}}}'
    assert f'"{command}"' in text


def test_a_robot_for_gazebo_needs_no_spawner(tmp_path):
    path = tmp_path / 'cart.urdf'
    path.write_text(plugin_robot.cart(plugin_robot.gz_drive('<topic>base/cmd_vel</topic>')))
    found = stack(urdf=str(path))
    assert [node.executable for node in found.nodes] == [
        'mujoco_sim',
        'robot_state_publisher',
        'create',
        'viewer',
    ]
    assert found.nodes[0].parameters[0]['controllers'] == ''
    assert 'teleop_twist_keyboard --ros-args \\\n        -r /cmd_vel:=/base/cmd_vel' in (
        found.next_steps
    )
    assert '--once /base/cmd_vel geometry_msgs/msg/Twist \\\n        "{linear:' in found.next_steps
    path.write_text(plugin_robot.cart(plugin_robot.gz_drive()))
    assert 'teleop_twist_keyboard\n' in stack(urdf=str(path)).next_steps
    said = f"urdf:={path}: Gazebo's plugins, active from the start: diff_drive, "
    assert ('INFO', f'{said}joint_state_broadcaster') in found.notes


def test_the_filter_of_amr_has_its_controllers_and_its_imu(installed):
    nodes = {each.executable: each for each in stack(ekf='true', viewer='false').nodes}
    file, table = nodes['ekf_node'].parameters
    assert (file, table) == (str(installed / 'config/ekf.yaml'), {'use_sim_time': True})
    simulator = nodes['mujoco_sim'].parameters[0]
    assert simulator['controllers'] == str(installed / 'config/controllers_ekf.yaml')
    assert 'imu_link' in nodes['robot_state_publisher'].parameters[0]['robot_description']
    assert 'ekf_node' not in {each.executable for each in stack(viewer='false').nodes}


@pytest.mark.parametrize('given', [{'urdf': GRIPPER}, {'controllers': 'mine.yaml'}])
def test_the_filter_is_for_amr_and_its_controllers(given):
    ((name, value),) = given.items()
    with pytest.raises(AmrError, match='ekf:=true is for amr and its controllers') as raised:
        stack(ekf='true', **given)
    assert f'with {name}:={value}, set enable_odom_tf: false there' in str(raised.value)
