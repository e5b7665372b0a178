# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What stands beside a robot in launch files of others, and stops it in none."""

from fixtures.launch_files.packages import commands, first_in_the_index, install_package, stack_of
import pytest
from support.paths import ROOT

from amr_description.errors import BringupError
from amr_description.launch_api.counterparts import arguments_as_ours
from amr_description.launch_api.gazebo_files import classic_world_of, World

FILE = """
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition
from launch.events import matches_action
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import *
from launch_ros.descriptions import ComposableNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.substitutions import FindPackageShare
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition
from controller_manager.launch_utils import (
    generate_controllers_spawner_launch_description as spawner_of,
    generate_controllers_spawner_launch_description_from_dict as spawner_of_dict,
    generate_load_controller_launch_description as spawner_of_one,
)
from ros_gz_bridge.actions import RosGzBridge
from ros_gz_sim.actions import GzServer

def generate_launch_description():
    managed = LifecycleNode(package='toys', executable='a', name='map', namespace='r1')
    return LaunchDescription([
%s
    ])
"""


@pytest.fixture
def launch(tmp_path):
    """A function: the stack of a file with these entities."""
    install_package(tmp_path, 'toys', 'a', 'b')

    def made(entities):
        (tmp_path / 'my.launch.py').write_text(FILE % entities)
        return stack_of(tmp_path / 'my.launch.py')

    with first_in_the_index(tmp_path):
        yield made


def notes(stack):
    return [text for _, text in stack.notes]


def asks(transition):
    return f"""EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(managed),
        transition_id=Transition.TRANSITION_{transition})),"""


@pytest.mark.parametrize(
    ('package', 'executable', 'instead'),
    [
        ('joy_linux', 'joy_linux_node', "'ros2 run joy joy_node'"),
        ('rqt_graph', 'rqt_graph', "'ros2 node list'"),
        ('rplidar_ros', 'rplidar_node', 'the simulator measures by the <gazebo><sensor>'),
        ('depthai_ros_driver', 'camera_node', 'the simulator measures by the <gazebo><sensor>'),
        ('nav2_amcl', 'amcl', 'it runs on a machine with ROS 2 Jazzy beside the simulator'),
        ('ros_gz_image', 'image_bridge', 'no bridge is needed'),
    ],
)
def test_what_cannot_be_here_is_left_out_and_the_rest_comes_up(
    launch, package, executable, instead
):
    stack = launch(
        f"Node(package='{package}', executable='{executable}'), "
        "Node(package='toys', executable='a'),"
    )
    assert [name for name, *_ in commands(stack)] == ['a-1']
    (note,) = notes(stack)
    assert note.startswith(f'{package} {executable}'.replace('rqt_graph rqt_graph', 'rqt_graph'))
    assert f'is left out: {instead}' in note or instead in note


@pytest.mark.parametrize(
    ('package', 'file', 'instead'),
    [
        ('ld08_driver', 'ld08.launch.py', 'it is the driver of a device'),
        ('nav2_bringup', 'navigation_launch.py', 'it runs on a machine with ROS 2 Jazzy'),
        ('teleop_twist_joy', 'teleop-launch.py', "'ros2 run joy joy_node' and"),
    ],
)
def test_an_included_file_of_what_cannot_be_here_is_left_out(launch, package, file, instead):
    stack = launch(f"""DeclareLaunchArgument('map', default_value='x'),
        IncludeLaunchDescription(PathJoinSubstitution([FindPackageShare('{package}'),
            'launch', '{file}']), launch_arguments={{'map': 'y'}}.items()),
        Node(package='toys', executable='a'),""")
    assert [name for name, *_ in commands(stack)] == ['a-1']
    (note,) = notes(stack)
    assert note.startswith(f'{package} {file} is left out: {instead}')


def test_an_included_file_of_the_simulator_is_needed(launch):
    with pytest.raises(BringupError, match="'launch/x.launch.py' of it has nothing in its place"):
        launch("""IncludeLaunchDescription(PathJoinSubstitution([FindPackageShare('ros_gz_sim'),
            'launch', 'x.launch.py'])),""")


def test_a_joystick_beside_the_robot_is_started_by_nodes_of_ours(launch):
    stack = launch("""Node(package='joy', executable='joy_node'),
        Node(package='teleop_twist_joy', executable='teleop_node', name='teleop',
             remappings=[('/cmd_vel', '/cmd_vel_joy')]),""")
    assert [line for _, _, line in commands(stack)] == [
        'joy_node',
        'teleop_twist_joy --ros-args -r __node:=teleop -r /cmd_vel:=/cmd_vel_joy',
    ]


def test_what_is_mistyped_is_still_refused(launch):
    with pytest.raises(BringupError, match=r"my.launch.py:2\d: package 'toyz' not found"):
        launch("Node(package='toyz', executable='a'),")


def test_names_of_foxy(launch):
    stack = launch("Node(package='controller_manager', executable='spawner.py', arguments=['x']),")
    assert [line for _, _, line in commands(stack)] == ['spawner x']


def test_the_demo_nodes_have_their_names_and_topics(launch):
    stack = launch(
        "Node(package='demo_nodes_py', executable='talker', name='mine', namespace='r1', "
        "remappings=[('chatter', 'news')]),"
    )
    assert [line for _, _, line in commands(stack)] == [
        'demo_talker --ros-args -r __node:=mine -r __ns:=/r1 -r chatter:=news'
    ]


@pytest.mark.parametrize(
    ('given', 'taken', 'lacking'),
    [
        ('-entity a -robot_namespace r1 -b', '-name a -robot_namespace r1', []),
        ('-topic t -timeout 30 -unpause -y 1', '-topic t -y 1', []),
        ('-reference_frame world -entity a', '-name a', []),
        ('-reference_frame other -entity a', '-name a', ['-reference_frame other']),
        ('-database cube -stdin -z 1', '-z 1', ['-database cube', '-stdin']),
        ('-entity a --ros-args -r __ns:=/x', '-name a --ros-args -r __ns:=/x', []),
        ('-entity', '-name', []),
    ],
)
def test_options_of_spawn_entity_are_obeyed_or_named(given, taken, lacking):
    assert arguments_as_ours('spawn_entity.py', given.split()) == (taken.split(), lacking)


def test_what_an_option_lacks_is_said(launch):
    stack = launch(
        "Node(package='gazebo_ros', executable='spawn_entity.py', arguments=['-database', 'x']),"
    )
    text = "'-database x' of gazebo_ros spawn_entity.py is left out: it is not known here"
    assert ('WARNING', text) in stack.notes


@pytest.mark.parametrize(
    ('program', 'words', 'world'),
    [
        ('gazebo', '--verbose -s libgazebo_ros_init.so -s lib.so a.xml', World('a.xml', True)),
        ('gazebo', 'a.world -u', World('a.world', False)),
        ('gzserver', '-e ode a.xml', World('a.xml', True, has_window=False)),
        ('gzserver', '--pause --seed 3', World('', False, has_window=False)),
        ('gzclient', '-g lib.so', World('', True, has_server=False)),
    ],
)
def test_options_of_gazebo_classic(program, words, world):
    assert classic_world_of(program, words.split()) == world


def test_the_page_opens_when_the_window_would(launch):
    stack = launch(
        "Node(package='controller_manager', executable='spawner', arguments=['nope']), "
        "Node(package='rviz2', executable='rviz2'),"
    )
    assert [(name, when) for name, when, _ in commands(stack)] == [
        ('spawner-1', 'at once'),
        ('viewer-2', 'at once, started again up to 5 times'),
    ]
    late = launch(
        "TimerAction(period=3.0, actions=[Node(package='rviz2', executable='rviz2')]), "
        "Node(package='toys', executable='a'),"
    )
    assert commands(late)[1][:2] == (
        'viewer-2',
        'when 3 s have passed of the stack, started again up to 5 times',
    )


def test_a_node_with_a_lifecycle_is_configured_and_then_activated(launch):
    stack = launch(
        f"""managed, {asks('CONFIGURE')}
        RegisterEventHandler(OnStateTransition(target_lifecycle_node=managed,
            start_state='configuring', goal_state='inactive', entities=[{asks('ACTIVATE')}])),
        RegisterEventHandler(OnStateTransition(target_lifecycle_node=managed,
            goal_state='active', entities=[Node(package='toys', executable='b')])),"""
    )
    there = 'the service /r1/map/change_state is there'
    assert commands(stack) == [
        ('a-1', 'at once', 'a --ros-args -r __node:=map -r __ns:=/r1'),
        ('ros2-2', f'when {there}', 'ros2 lifecycle set /r1/map 1'),
        (
            'ros2-3',
            f'when ros2-2 exited with code 0 and {there}',
            'ros2 lifecycle set /r1/map 3',
        ),
        ('b-4', 'when ros2-3 exited with code 0', 'b'),
    ]


def test_a_node_that_starts_its_lifecycle_itself(launch):
    stack = launch(
        "LifecycleNode(package='toys', executable='a', name='m', namespace='', autostart=True),"
        "LifecycleTransition(lifecycle_node_names=['/n'], transition_ids=[4, 2]),"
    )
    lines = [line for _, _, line in commands(stack)[1:]]
    assert lines == [f'ros2 lifecycle set {each}' for each in ('/m 1', '/m 3', '/n 4', '/n 2')]


def test_a_state_that_nobody_asks_for_is_said_never_to_come(launch):
    stack = launch(
        """managed, RegisterEventHandler(OnStateTransition(target_lifecycle_node=managed,
            goal_state='finalized', entities=[Node(package='toys', executable='b')])),"""
    )
    assert [name for name, *_ in commands(stack)] == ['a-1']
    (note,) = notes(stack)
    assert 'OnStateTransition never comes' in note


def test_a_transition_is_asked_of_nodes_by_the_names_that_they_have(launch):
    stack = launch(
        f"""PushRosNamespace('outer'), {asks('CONFIGURE')} managed,
        RegisterEventHandler(OnStateTransition(target_lifecycle_node=managed,
            goal_state='active', entities=[Node(package='toys', executable='b')])),
        LifecycleTransition(lifecycle_node_names=['/r1/map'], transition_ids=[3]),"""
    )
    ask = [line for _, _, line in commands(stack)[1:]]
    node = next(each for each in stack.nodes if each.name == 'map')
    full = f'{node.namespace}/map'
    assert f'ros2 lifecycle set {full} 1' in ask, 'also of one that stands behind it in the file'


def test_a_handler_comes_after_the_transitions_of_its_node_alone(launch):
    b = "entities=[Node(package='toys', executable='b')]"
    stack = launch(
        f"""managed, LifecycleTransition(lifecycle_node_names=['/r1/map'], transition_ids=[1]),
        RegisterEventHandler(OnStateTransition(target_lifecycle_node=managed,
            start_state='configuring', goal_state='inactive', {b})),
        RegisterEventHandler(OnStateTransition(target_lifecycle_node=managed,
            start_state='deactivating', goal_state='inactive', {b})),"""
    )
    assert [name for name, *_ in commands(stack)] == ['a-1', 'ros2-2', 'b-3']
    (note,) = notes(stack)
    assert note.endswith('never comes: the launch file asks its target for no such transition')


def test_a_transition_that_there_is_not_is_said(launch):
    with pytest.raises(
        BringupError, match=r'LifecycleTransition\(transition_ids\)=9: it is one of'
    ):
        launch("LifecycleTransition(lifecycle_node_names=['/n'], transition_ids=[9]),")


COMPONENT = "ComposableNode(package='{}', plugin='x::Y', name='y')"


def test_components_are_values_and_those_of_which_something_is_here_are_left_out(launch):
    nav2, own = COMPONENT.format('nav2_amcl'), COMPONENT.format('toys')
    stack = launch(
        f"""ComposableNodeContainer(name='c', namespace='', package='rclcpp_components',
            executable='component_container', composable_node_descriptions=[]),
        LoadComposableNodes(target_container='c', composable_node_descriptions=[{nav2}]),
        LoadComposableNodes(target_container='c', composable_node_descriptions=[{own}],
            condition=IfCondition('False')),
        LoadComposableNodes(target_container='c', composable_node_descriptions=[
            ComposableNode(package='toys', plugin='x::Y', condition=IfCondition('False'))]),
        Node(package='toys', executable='a'),"""
    )
    assert [name for name, *_ in commands(stack)] == ['a-1']
    assert [text.partition(':')[0] for text in notes(stack)] == [
        'c is left out',
        'nav2_amcl x is left out',
    ] or [text.partition(' is left out')[0] for text in notes(stack)] == ['c', 'nav2_amcl x::Y']
    with pytest.raises(BringupError, match=r"the component 'x::Y' of toys is a library of C\+\+"):
        launch(f"LoadComposableNodes(composable_node_descriptions=[{own}], target_container='c'),")


def test_actions_of_gazebo(launch):
    stack = launch("GzServer(world_sdf_file='empty.sdf'), RosGzBridge(bridge_name='x'),")
    assert [name for name, *_ in commands(stack)] == ['mujoco_sim-1']
    assert 'no bridge is needed here: its topics are of ROS' in notes(stack)


def test_a_world_that_there_is_not_is_said_before_anything_starts(launch):
    simulator = "package='amr_description', executable='mujoco_sim'"
    with pytest.raises(BringupError, match=r"py:2\d: world 'rampe': .*did you mean ramp"):
        launch(f"Node({simulator}, parameters=[{{'world': 'rampe'}}]),")


MANAGER = '--controller-manager controller_manager'


@pytest.mark.parametrize(
    ('entity', 'words'),
    [
        ("spawner_of(['a', 'b'])", f'a b {MANAGER}'),
        (
            "spawner_of(('a',), [LaunchConfiguration('unload_on_kill'), None], ['--inactive'])",
            f'a {MANAGER} --param-file false --inactive',
        ),
        ("GroupAction([spawner_of_one('a', 'p.yaml')])", f'a {MANAGER} --param-file p.yaml'),
        ("spawner_of_one(controller_name='a', controller_params_file=None)", f'a {MANAGER}'),
        (
            "spawner_of_dict({'a': None, 'b': 'p.yaml', 'c': ['p.yaml', 'q']}, ['--load-only'])",
            f'a b c {MANAGER} --param-file p.yaml --param-file p.yaml --param-file q --load-only',
        ),
        (
            "SetLaunchConfiguration('unload_on_kill', 'true'), "
            "SetLaunchConfiguration('controller_manager_name', '/r1/cm'), spawner_of_one('a')",
            'a --controller-manager /r1/cm --unload-on-kill',
        ),
    ],
)  # fmt: skip
def test_controllers_are_spawned_as_by_functions_of_controller_manager(launch, entity, words):
    stack = launch(f'{entity},')
    assert [line for _, _, line in commands(stack)] == [f'spawner {words}']


@pytest.mark.parametrize(
    ('given', 'said'),
    [
        ("['a']", r"Invalid controller_info_dict type parsed \['a'\]"),
        ("{'a': 1}", 'Invalid controller_params_file type parsed in the dict 1'),
    ],
)
def test_what_is_no_table_of_controllers_is_said(launch, given, said):
    with pytest.raises(BringupError, match=said):
        launch(f'spawner_of_dict({given}),')


def test_a_spawner_that_stays_to_unload_is_not_waited_for(launch):
    stack = launch("SetLaunchConfiguration('unload_on_kill', 'true'), spawner_of(['a']),")
    assert 'exited' not in str(stack.ready_when)


DESCRIBED = (
    "Node(package='robot_state_publisher', executable='robot_state_publisher', "
    f"parameters=[{{'robot_description': open({str(ROOT / 'urdf/amr.urdf')!r}).read()}}]),"
)
OURS = str(ROOT / 'config/controllers.yaml')
SIMULATOR = (
    "Node(package='amr_description', executable='mujoco_sim', "
    f"parameters=[{{'controllers': {OURS!r}}}]),"
)
REAL = f"""Node(package='controller_manager', executable='ros2_control_node',
    parameters=[{OURS!r}], remappings=[('/diff_drive_controller/cmd_vel', '/cmd_vel')]),"""
BOTH = "spawner_of(['joint_state_broadcaster', 'diff_drive_controller']),"


@pytest.mark.parametrize(
    ('entities', 'topic'),
    [
        (SIMULATOR + DESCRIBED + BOTH, '/diff_drive_controller/cmd_vel'),
        (REAL + DESCRIBED + BOTH, '/cmd_vel'),
        (SIMULATOR + DESCRIBED + "spawner_of(['joint_state_broadcaster']),", ''),
        (SIMULATOR + DESCRIBED + BOTH.replace('])', "], [], ['--controller-ros-args', 'x'])"), ''),
        (SIMULATOR + BOTH, ''),
        (SIMULATOR + REAL + DESCRIBED + BOTH, ''),
    ],
)
def test_how_the_robot_is_driven_is_said_where_it_is_known(launch, entities, topic):
    said = launch(entities).next_steps
    assert (f'ros2 topic pub --once {topic} geometry_msgs/msg/TwistStamped' in said) == bool(topic)
    assert bool(said) == bool(topic)


def test_a_drive_of_another_name_has_its_own_topic(launch, tmp_path):
    (tmp_path / 'c.yaml').write_text("""\
controller_manager:
  ros__parameters: {wheels: {type: diff_drive_controller/DiffDriveController}}
wheels:
  ros__parameters: {left_wheel_names: [joint_wheel_front_left]}
""")
    simulator = SIMULATOR.replace(OURS, str(tmp_path / 'c.yaml'))
    assert (
        '/wheels/cmd_vel ' in launch(simulator + DESCRIBED + "spawner_of(['wheels']),").next_steps
    )
    assert launch(simulator + DESCRIBED + "spawner_of(['others']),").next_steps == ''
