# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The stack ``fleet``: several robots of one kind in one simulation.

``robot1``, ``robot2`` … have their topics, controller managers and frames in namespaces of their
names. All publish on one ``/tf``: each a tree of frames from ``robot1/odom`` down, below
``world``.
"""

from collections.abc import Iterator
import math
import os
from typing import Annotated, TypeAlias
from xml.sax.saxutils import quoteattr

from amr_description.ament_index import world_path
from amr_description.bringup import (
    all_of,
    exited_cleanly,
    Node,
    notes_on,
    path_of,
    robot_description,
    Stack,
)
from amr_description.bringup.controller_files import (
    ABOUT_SENSORS,
    controllers_files,
    require_namespaces,
    URDF,
    with_sensors,
)
from amr_description.bringup.description import ParameterValue
from amr_description.bringup.environment import setup_command
from amr_description.bringup.stacks.controllers import (
    plan_controllers,
    SpawnPlan,
    words_of,
)
from amr_description.bringup.stacks.next_steps import velocity_topic
from amr_description.bringup.stacks.simulation import (
    ABOUT_CONTROLLERS,
    ABOUT_RECORD,
    new_folder,
)
from amr_description.bringup.stacks.visualization import ABOUT_VIEWER, page
from amr_description.errors import UsageError
from amr_description.model.shapes import horizontal_reach
from amr_description.model.urdf import parse

_GAP = 1.0
"""m between two robots, whatever their headings."""

_Position: TypeAlias = tuple[float, float]


def fleet(
    robots: Annotated[int, 'how many'] = 3,
    urdf: Annotated[str, 'robot description, URDF or xacro'] = URDF,
    xacro_args: Annotated[str, 'arguments of a xacro file: name:=value …'] = '',
    sensors: Annotated[bool, ABOUT_SENSORS] = False,
    controllers: Annotated[
        str, f'{ABOUT_CONTROLLERS}; for any namespace: /**/controller_manager: …'
    ] = '',
    world: Annotated[str, 'world to simulate'] = 'empty',
    rtf: Annotated[float, 'real-time factor; 0 is as fast as possible'] = 1.0,
    spacing: Annotated[float, 'm between two robots; 0: by their size'] = 0.0,
    viewer: Annotated[bool, ABOUT_VIEWER] = True,
    record: Annotated[str, ABOUT_RECORD] = '',
) -> Stack:
    """Several robots in MuJoCo, each in its namespace with both controllers, ready to drive."""
    _require(robots >= 1, f'robots:={robots}: a fleet has 1 robot or more')
    _require(rtf >= 0, f'rtf:={rtf}: a real-time factor is 0 (as fast as possible) or more')
    _require(spacing >= 0, f'spacing:={spacing}: a distance is 0 (by their size) or more')
    urdf = with_sensors(urdf, sensors)
    description = robot_description(urdf, xacro_args)
    needed = 2.0 * horizontal_reach(parse(description, urdf))
    _require(
        not 0 < spacing <= needed,
        f'spacing:={spacing}: the robots would touch; they need more than {needed:.2f} m',
    )
    positions = dict(_positions(robots, spacing or needed + _GAP))
    files = controllers_files(controllers, urdf, description)
    for file in files:
        require_namespaces(file, list(positions))
    joined = ','.join(map(str, files))
    plan = plan_controllers(
        urdf, description, controllers and joined, namespace=f'/{next(iter(positions))}'
    )
    # 1. The simulated world, empty so far; it publishes /clock.
    mujoco_sim = _simulator(world, rtf, plan.parameter or joined, new_folder(record))
    # 2. The origins of the odometry frames: they join the robots in one tree of frames.
    map_publisher = Node(
        'robot_state_publisher',
        name='fleet_map',
        namespace='fleet',
        parameters=[{'robot_description': _map_of(positions), 'use_sim_time': True}],
    )
    # 3. The robots, side by side.
    members = [_robot(name, place, description, plan) for name, place in positions.items()]
    up = all_of(*(exited_cleanly(last) for *_, last in members))
    return Stack(
        [
            mujoco_sim,
            map_publisher,
            *(node for member in members for node in member),
            *page(viewer, up),
        ],
        ready_when=up,
        next_steps=_how_to_drive(list(positions), plan),
        notes=[*notes_on([path_of(urdf), *files]), *plan.notes],
    )


def _simulator(world: str, rtf: float, controllers: str, record: str) -> Node:
    world_path(world)  # before anything starts
    parameters: dict[str, ParameterValue] = {'world': world, 'real_time_factor': rtf}
    parameters |= {'controllers': controllers} | ({'record': record} if record else {})
    return Node('mujoco_sim', parameters=[parameters], on_exit='shutdown')


def _robot(name: str, position: _Position, description: str, plan: SpawnPlan) -> tuple[Node, ...]:
    """Return the nodes that publish a robot's URDF, spawn it and spawn its controllers."""
    robot_state_publisher = Node(
        'robot_state_publisher',
        namespace=name,
        parameters=[
            {
                'robot_description': description,
                'frame_prefix': f'{name}/',
                'use_sim_time': True,
            }
        ],
    )
    x, y = position
    height = ['-z', '0.2'] if plan.is_that_of_amr else []  # else on the ground
    create = Node(
        'create',
        namespace=name,
        arguments=['-topic', 'robot_description', '-name', name, '-x', x, '-y', y, *height],
    )
    if not plan.names:
        return robot_state_publisher, create
    # One process for all controllers: with ten robots, starting processes takes the time.
    spawner = Node(
        'spawner', namespace=name, arguments=words_of(plan), start_when=exited_cleanly(create)
    )
    return robot_state_publisher, create, spawner


def grid(count: int, spacing: float) -> Iterator[tuple[float, float]]:
    """Yield ``count`` positions (x, y), m, of a nearly square grid centred on the origin."""
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    for number in range(count):
        row, column = divmod(number, columns)
        yield spacing * (column - (columns - 1) / 2.0), spacing * (row - (rows - 1) / 2.0)


def _positions(count: int, spacing: float) -> Iterator[tuple[str, _Position]]:
    for number, position in enumerate(grid(count, spacing), start=1):
        yield f'robot{number}', position


def _map_of(positions: dict[str, _Position]) -> str:
    """Return a URDF of fixed joints, which robot_state_publisher publishes on /tf_static."""
    lines = ['<robot name="fleet">', '<link name="world"/>']
    for name, (x, y) in positions.items():
        odom = quoteattr(f'{name}/odom')
        lines += [
            f'<link name={odom}/>',
            f'<joint name={odom} type="fixed"><parent link="world"/><child link={odom}/>'
            f'<origin xyz="{x} {y} 0"/></joint>',
        ]
    return '\n'.join([*lines, '</robot>'])


def _how_to_drive(names: list[str], plan: SpawnPlan) -> str:
    """Return the next steps of a user; ``plan``: that of the first robot."""
    first, last = names[0], names[-1]
    topic = velocity_topic(plan)
    if topic is None:
        return 'Ctrl-C stops all.'
    local = topic.name.removeprefix(f'/{first}')
    return f"""drive {first} with, in another shell,
    {setup_command('amr_description', os.environ)}
    ros2 run amr_description teleop_twist_keyboard --ros-args -p stamped:=true \\
        -r /cmd_vel:=/{first}{local}
or {last} in a circle
    ros2 topic pub -r 10 /{last}{local} geometry_msgs/msg/TwistStamped \\
        "{{twist: {{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}}}"
Ctrl-C stops all."""


def _require(holds: bool, text: str) -> None:
    if not holds:
        raise UsageError(text)
