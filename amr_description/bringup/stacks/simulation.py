# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``simulation``: the robot in MuJoCo, its controllers active, ready to drive."""

from collections.abc import Mapping
from dataclasses import dataclass
import math
from pathlib import Path
from typing import Annotated
from xml.etree import ElementTree

from amr_description.ament_index import world_path
from amr_description.argument_types import word_of
from amr_description.bringup import (
    exited_cleanly,
    Node,
    notes_on,
    path_of,
    robot_description,
    Stack,
)
from amr_description.bringup.controller_files import (
    ABOUT_SENSORS,
    URDF,
    URDF_WITH_SENSORS,
    with_sensors,
)
from amr_description.bringup.description import ParameterValue
from amr_description.bringup.stacks.controllers import (
    ABOUT_ACTIVATE,
    AMR,
    plan_controllers,
    spawners,
)
from amr_description.bringup.stacks.next_steps import (
    next_steps_of,
    velocity_topic,
    VelocityTopic,
)
from amr_description.bringup.stacks.visualization import ABOUT_VIEWER, ANEW, page
from amr_description.errors import DescriptionError, UsageError
from amr_description.text import plain_name

ABOUT_CONTROLLERS = (
    'parameters of the controllers; empty: the file that the URDF names, for amr the shipped one'
)
ABOUT_FIXED = 'whether the root link is fixed to the world, as that of an arm'
ABOUT_LIFT = 'whether a robot that would touch the world is lifted until it is free'
ABOUT_STRICT = 'whether a robot that has to be taken as something else is refused'
ABOUT_BRIDGE = 'configuration file of ros_gz_bridge, by which topics of Gazebo are called'
ABOUT_MOCKS = 'mock_components is simulated as other hardware (simulate), or stays a mock (mock)'
ABOUT_RENDERER = 'what makes pictures of cameras: OpenGL (gl), rays, or OpenGL if it works (auto)'
ABOUT_RECORD = 'folder of a bag to which the run is recorded, in simulated time and without loss'
ABOUT_EKF = 'whether amr has its odom -> base_footprint from wheels and IMU, by ekf_node'
_EKF = 'package://amr_description/config/ekf.yaml'
_CONTROLLERS_BESIDE_EKF = 'package://amr_description/config/controllers_ekf.yaml'
"""Those of amr, which leave the transform to ekf_node."""


@dataclass(frozen=True, eq=False)
class SimulatedRobot(Stack):
    """The stack of a simulated robot, and how that is driven."""

    velocity_topic: VelocityTopic | None = None
    """None: nothing drives it."""
    description: str = ''
    """Its URDF."""


def simulation(
    urdf: Annotated[str, 'robot description, URDF or xacro'] = URDF,
    xacro_args: Annotated[str, 'arguments of a xacro file: name:=value …'] = '',
    sensors: Annotated[bool, ABOUT_SENSORS] = False,
    controllers: Annotated[str, ABOUT_CONTROLLERS] = '',
    activate: Annotated[str, ABOUT_ACTIVATE] = '',
    world: Annotated[str, 'world to simulate'] = 'empty',
    rtf: Annotated[float, 'real-time factor; 0 is as fast as possible'] = 1.0,
    paused: Annotated[bool, 'whether time stands still at first'] = False,
    viewer: Annotated[bool, ABOUT_VIEWER] = True,
    name: Annotated[str, 'name of the robot in the simulator; empty: that of the URDF'] = '',
    x: Annotated[float, 'where the root link is spawned, m'] = 0.0,
    y: Annotated[float, 'm'] = 0.0,
    z: Annotated[str, 'm; empty: on the ground, amr 0.2 above it'] = '',
    yaw: Annotated[float, 'its heading, rad'] = 0.0,
    fixed: Annotated[bool, ABOUT_FIXED] = False,
    lift: Annotated[bool, ABOUT_LIFT] = True,
    strict: Annotated[bool, ABOUT_STRICT] = False,
    mock_hardware: Annotated[str, ABOUT_MOCKS] = 'simulate',
    bridge: Annotated[str, ABOUT_BRIDGE] = '',
    camera_renderer: Annotated[str, ABOUT_RENDERER] = 'auto',
    ekf: Annotated[bool, ABOUT_EKF] = False,
    record: Annotated[str, ABOUT_RECORD] = '',
) -> SimulatedRobot:
    """The robot in MuJoCo with its controllers, ready to drive."""
    controllers, filters = _filter(ekf, urdf, controllers)
    urdf = with_sensors(urdf, sensors or ekf)
    description = robot_description(urdf, xacro_args)
    if fixed:
        description = _fixed(description, urdf)
    plan = plan_controllers(urdf, description, controllers, activate, bridge=bridge)
    options: dict[str, ParameterValue] = {'lift': lift, 'strict': strict, 'bridge': bridge}
    options |= {'mock_hardware': mock_hardware, 'camera_renderer': camera_renderer}
    options |= {'record': new_folder(record)}

    # 1. The simulated world, empty so far; it publishes /clock.
    mujoco_sim = _simulator(world, rtf, paused, plan.parameter, options)

    # 2. The URDF, published as /robot_description and as transforms.
    published: dict[str, ParameterValue] = {'robot_description': description, 'use_sim_time': True}
    robot_state_publisher = Node('robot_state_publisher', parameters=[published])

    # 3. The robot is spawned; its <ros2_control> block brings up /controller_manager.
    name = name or entity_name(description)
    words = ['-topic', 'robot_description', '-name', name, *_pose(name, x, y, z, yaw)]
    create = Node('create', arguments=words)

    # 4. The controllers, one after the other, once there is a controller manager.
    controlled = spawners(plan, exited_cleanly(create))

    up = exited_cleanly(controlled[-1] if controlled else create)
    return SimulatedRobot(
        [mujoco_sim, robot_state_publisher, create, *controlled, *filters, *page(viewer, up)],
        ready_when=up,
        next_steps=next_steps_of(viewer, plan, description),
        notes=[*notes_on([path_of(urdf), *plan.files]), *plan.notes],
        velocity_topic=velocity_topic(plan),
        description=description,
    )


def _filter(ekf: bool, urdf: str, controllers: str) -> tuple[str, list[Node]]:
    """Return the parameter file of the controllers, and ekf_node if it is wanted."""
    if not ekf:
        return controllers, []
    if urdf not in (URDF, URDF_WITH_SENSORS) or controllers:
        given = f'controllers:={controllers}' if controllers else f'urdf:={urdf}'
        raise UsageError(
            f'ekf:=true is for amr and its controllers; with {given}, set enable_odom_tf: false '
            "there, and start 'ros2 run robot_localization ekf_node --ros-args -p "
            "use_sim_time:=true --params-file FILE' beside it"
        )
    filtering = Node(
        'ekf_node',
        parameters=[str(path_of(_EKF)), {'use_sim_time': True}],
        required='at start',
        respawn=ANEW,
    )
    return _CONTROLLERS_BESIDE_EKF, [filtering]


# Parameters of the simulator with the values that they have there when they are not given.
_OPTIONS: Mapping[str, ParameterValue] = {
    'lift': True,
    'strict': False,
    'mock_hardware': 'simulate',
    'bridge': '',
    'camera_renderer': 'auto',
    'record': '',
}


def _simulator(
    world: str,
    rtf: float,
    paused: bool,
    controllers: str,
    options: Mapping[str, ParameterValue],
) -> Node:
    if not rtf >= 0:
        raise UsageError(f'rtf:={rtf}: a real-time factor is 0 (as fast as possible) or more')
    world_path(world)  # before anything starts
    parameters: dict[str, ParameterValue] = {
        'world': world,
        'real_time_factor': rtf,
        'paused': paused,
        'controllers': controllers,
    }
    if options['mock_hardware'] not in ('simulate', 'mock'):
        raise UsageError(f'mock_hardware:={options["mock_hardware"]}: it is simulate or mock')
    if options['camera_renderer'] not in ('auto', 'gl', 'rays'):
        raise UsageError(f'camera_renderer:={options["camera_renderer"]}: it is auto, gl or rays')
    parameters.update({key: each for key, each in options.items() if each != _OPTIONS[key]})
    if options['bridge']:
        parameters['bridge'] = str(path_of(str(options['bridge']), 'bridge'))
    return Node('mujoco_sim', parameters=[parameters], on_exit='shutdown')


def new_folder(record: str) -> str:
    """Return the absolute path of a bag that is to be made; empty: none is."""
    if not record:
        return ''
    path = Path(record).expanduser().absolute()
    if path.exists() or path.is_symlink():
        raise UsageError(f'record:={record}: it is there already; another name will do')
    return str(path)


def entity_name(urdf: str) -> str:
    """Return the robot's name, with ``_`` for what the name of an entity may not have."""
    try:
        name = ElementTree.fromstring(urdf).get('name', '')
    except ElementTree.ParseError:  # robot_state_publisher says where
        name = ''
    return plain_name(name) or 'robot'


def _pose(name: str, x: float, y: float, z: str, yaw: float) -> list[str]:
    """Return the pose as arguments of ``create``, which puts a robot without a z on the ground."""
    height = z or ('0.2' if name == AMR else '')
    try:
        numbers = [x, y, yaw, float(height or 0.0)]
    except ValueError:
        raise UsageError(f"z:={z}: '{z}' is not a number") from None
    if not all(map(math.isfinite, numbers)):
        raise UsageError(f'x:={x} y:={y} z:={z} yaw:={yaw}: a pose is of finite numbers')
    words = [
        ('-x', x and word_of(x)),
        ('-y', y and word_of(y)),
        ('-z', height),
        ('-Y', yaw and word_of(yaw)),
    ]
    return [word for option, value in words if value for word in (option, str(value))]


def _fixed(description: str, urdf: str) -> str:
    """Return a description whose root is fixed to the world."""
    from amr_description.model.fixing import fixed_to_world

    try:
        return fixed_to_world(description)
    except DescriptionError as error:
        raise UsageError(f'fixed:=true: urdf:={urdf}: {error}') from None
