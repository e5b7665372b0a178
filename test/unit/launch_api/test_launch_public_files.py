# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Launch files of public repositories, their calls retyped: each starts what it says, or is refused.

No process is started: what would be is looked at, as ``ros2 launch --print`` shows it.
"""

import os

from fixtures.launch_files.packages import (
    commands,
    first_in_the_index,
    install_package,
    outline,
    parameters,
    PUBLIC,
    stack_of,
    URDF,
    XACRO,
)
import pytest
from support.paths import ROOT

from amr_description.errors import BringupError

TUTORIAL = ROOT / 'test/fixtures/tutorial'
LOOKED_AT = (PUBLIC.parent / 'public.txt').read_text().split('\n== ')[1:]


@pytest.fixture(scope='module')
def share(tmp_path_factory):
    """The share folder of the package ``demos``, in which all of them lie."""
    prefix = tmp_path_factory.mktemp('prefix')
    files = {f'launch/{path.name}': path.read_text() for path in PUBLIC.iterdir()}
    files |= {
        'config/my_controllers.yaml': '{}\n',
        'config/ekf.yaml': '{}\n',
        'urdf/robot.urdf': URDF,
        'urdf/robot.urdf.xacro': XACRO,
    }
    share = install_package(prefix, 'demos', 'command_timeout', **files)
    with first_in_the_index(prefix):
        yield share


def launched(share, name, **arguments):
    return stack_of(share / 'launch' / f'{name}.launch.py', **arguments)


def said(stack):
    return '\n'.join(f'{level} {text}' for level, text in stack.notes)


@pytest.mark.parametrize('expected', LOOKED_AT, ids=lambda text: text.partition('.')[0])
def test_each_starts_what_was_looked_at(share, expected, monkeypatch):
    """All of what it starts, and of what it is left out; the others look at arguments, too."""
    monkeypatch.setattr(os, 'environ', os.environ.copy())
    name, *lines = expected.strip().splitlines()
    assert outline(share / 'launch' / name) == '\n'.join(lines).format(share=share)


def test_each_file_was_looked_at():
    names = [text.partition('\n')[0] for text in LOOKED_AT]
    assert names == sorted(path.name for path in PUBLIC.iterdir())


def test_gz_ros2_control_demos(share):
    stack = launched(share, 'gz_diff_drive_example')
    activate = 'ros2 control load_controller --set-state active'
    names = {name: (when, line) for name, when, line in commands(stack)}
    assert {name: when for name, (when, _) in names.items()} == {
        'mujoco_sim-1': 'at once, its end is the end of all',
        'robot_state_publisher-2': 'at once',
        'create-3': 'at once',
        'ros2-4': 'when create-3 exited',
        'ros2-5': 'when ros2-4 exited',
        'viewer-6': 'at once, started again up to 5 times',
    }
    assert names['ros2-4'][1] == f'{activate} joint_state_broadcaster'
    assert names['ros2-5'][1] == f'{activate} diff_drive_base_controller'
    assert names['create-3'][1].endswith('-name cartpole -allow_renaming true')
    assert 'paused: false' in parameters(stack, 'mujoco_sim-1')


def test_articubot_one(share):
    stack = launched(share, 'articubot_launch_robot')
    yaml = share / 'config/my_controllers.yaml'
    started = 'when ros2_control_node-2 was started'
    assert commands(stack) == [
        ('robot_state_publisher-1', 'at once', 'robot_state_publisher'),
        (
            'ros2_control_node-2',
            'when 3 s have passed of the stack',
            f'ros2_control_node --ros-args --params-file {yaml}',
        ),
        ('spawner-3', started, 'spawner diff_cont'),
        ('spawner-4', started, 'spawner joint_broad'),
    ]
    described = parameters(stack, 'robot_state_publisher-1')
    assert 'true_base_link' in described
    assert 'use_sim_time: false' in described
    assert 'robot_description: robot' in parameters(stack, 'ros2_control_node-2')


def test_ros2_control_demos(share):
    stack = launched(share, 'ros2_control_demo_diffbot', prefix='left_')
    yaml = share / 'config/my_controllers.yaml'
    assert commands(stack)[:4] == [
        (
            'ros2_control_node-1',
            'at once',
            f'ros2_control_node --ros-args --params-file {yaml} '
            "-r '~/robot_description:=/robot_description'",
        ),
        ('robot_state_publisher-2', 'at once', 'robot_state_publisher'),
        ('spawner-3', 'at once', 'spawner diffbot_base_controller -c /controller_manager'),
        (
            'spawner-4',
            'when spawner-3 exited',
            'spawner joint_state_broadcaster --controller-manager /controller_manager',
        ),
    ]
    assert 'left_base_link' in parameters(stack, 'robot_state_publisher-2')
    assert 'INFO in place of rviz2: the page whose address the viewer prints' in said(stack)
    alone = launched(share, 'ros2_control_demo_diffbot', gui='false')
    assert [name for name, *_ in commands(alone)][-1] == 'spawner-4'


def test_linorobot2(share):
    stack = launched(share, 'linorobot2_gazebo', spawn_x='1.5', odom_topic='/filtered')
    assert commands(stack)[:5] == [
        ('mujoco_sim-1', 'at once, its end is the end of all', 'mujoco_sim'),
        ('create-2', 'at once', 'create -topic robot_description -name linorobot2 -x 1.5'),
        ('command_timeout-3', 'at once', 'command_timeout --ros-args -r __node:=command_timeout'),
        (
            'ekf_node-4',
            'at once',
            'ekf_node --ros-args -r __node:=ekf_filter_node '
            f'--params-file {share}/config/ekf.yaml -r odometry/filtered:=/filtered',
        ),
        ('robot_state_publisher-5', 'at once', 'robot_state_publisher'),
    ]
    assert commands(stack)[5][0] == 'viewer-6'
    assert 'use_sim_time: true' in parameters(stack, 'robot_state_publisher-5')
    notes = said(stack)
    assert f"INFO the world '{share}/worlds/playground.sdf' is not read here: it is 'emp" in notes
    assert 'INFO ros_gz_bridge parameter_bridge is left out: no bridge is needed' in notes
    assert 'viewer' not in str(commands(launched(share, 'linorobot2_gazebo', gui='false')))


def test_turtlebot3(share):
    stack = launched(share, 'turtlebot3_world')
    assert [line for _, _, line in commands(stack)][1] == (
        f'create -name burger -file {share}/urdf/robot.urdf.xacro -x -2.0 -z 0.01'
    )
    assert [name for name, *_ in commands(stack)] == [
        'mujoco_sim-1', 'create-2', 'robot_state_publisher-3', 'viewer-4',
    ]  # fmt: skip
    assert 'use_sim_time: true' in parameters(stack, 'robot_state_publisher-3')
    moved = launched(share, 'turtlebot3_world', x_pose='3.0')
    assert '-x 3.0' in commands(moved)[1][2]


def test_ros_gz_project_template(share):
    stack = launched(share, 'ros_gz_example_diff_drive')
    world = parameters(stack, 'mujoco_sim-1')
    assert 'world: warehouse' in world
    assert 'paused: true' in world
    assert 'ros_gz_bridge' in said(stack)
    line = 'robot_state_publisher --ros-args -r __node:=robot_state_publisher'
    assert commands(stack)[1] == ('robot_state_publisher-2', 'at once', line)


def test_urdf_launch(share):
    given = {'urdf_package': 'demos', 'urdf_package_path': 'urdf/robot.urdf.xacro'}
    stack = launched(share, 'urdf_launch_display', **given)
    names = ['robot_state_publisher-1', 'joint_state_publisher-2', 'viewer-3']
    assert [name for name, *_ in commands(stack)] == names
    assert 'base_link' in parameters(stack, 'robot_state_publisher-1')
    assert 'in place of joint_state_publisher_gui, rviz2: the page' in said(stack)
    plain = launched(share, 'urdf_launch_display', jsp_gui='false', **given)
    assert [name for name, *_ in commands(plain)] == names


def test_slam_toolbox(share):
    stack = launched(share, 'slam_toolbox_online_async')
    assert commands(stack) == []
    assert 'INFO slam_toolbox async_slam_toolbox_node is left out: it runs on a mac' in said(stack)


@pytest.mark.parametrize(
    ('name', 'arguments', 'refusal'),
    [
        (
            'urdf_launch_display',
            {'urdf_package_path': 'urdf/robot.urdf.xacro'},
            r"missing required argument 'urdf_package' \(description: 'The package of the ",
        ),
        (
            'urdf_launch_display',
            {'jsp_gui': 'maybe', 'urdf_package': 'demos', 'urdf_package_path': 'x'},
            r'urdf_launch_display.launch.py:1\d: Argument "jsp_gui" provided value "maybe" is not '
            r"valid. Valid options are: \['true', 'false'\]",
        ),
    ],
)
def test_what_cannot_be_started_is_refused_in_one_line(share, name, arguments, refusal):
    before = os.environ.copy()
    with pytest.raises(BringupError, match=refusal) as told:
        launched(share, name, **arguments)
    assert '\n' not in str(told.value)
    os.environ.pop('FILE_PATH', None)
    assert os.environ.copy() == before


def test_the_tutorials_own_files(tmp_path):
    """Letter for letter; what they start by a real bring-up is in test_walk_learner.py."""
    install_package(tmp_path, 'amr_description', **{'urdf/amr.urdf': URDF})
    for name in ('gazebo', 'display'):
        text = (TUTORIAL / f'{name}_launch.txt').read_text()
        (tmp_path / f'{name}.launch.py').write_text(text)
    with first_in_the_index(tmp_path):
        gazebo = stack_of(tmp_path / 'gazebo.launch.py')
        display = stack_of(tmp_path / 'display.launch.py')
        assert commands(gazebo)[:5] == [
            ('mujoco_sim-1', 'at once, its end is the end of all', 'mujoco_sim'),
            ('robot_state_publisher-2', 'at once', 'robot_state_publisher'),
            ('create-3', 'at once', 'create -topic robot_description -name amr -z 0.2'),
            ('spawner-4', 'when create-3 exited', 'spawner joint_state_broadcaster'),
            ('spawner-5', 'when spawner-4 exited', 'spawner diff_drive_controller'),
        ]
        assert 'paused: false\n    world: empty\n' in parameters(gazebo, 'mujoco_sim-1')
        assert [name for name, *_ in commands(display)] == [
            'robot_state_publisher-1', 'joint_state_publisher-2', 'viewer-3',
        ]  # fmt: skip
