# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The stack ``navigation``: a simulated robot with all that Nav2 and slam_toolbox ask of it.

=====================  ======================================================================
node                   what it gives
=====================  ======================================================================
the ``simulation``     ``/clock``, ``/scan``, ``/odom``, ``/tf``, the page
``map_of_world``       ``/map``, latched; ``map_server`` does so with a saved one
a localizer            ``map`` → ``odom``, by ground truth or by scans
``navigator``          ``/navigate_to_pose`` and ``/goal_pose``, where Nav2 does not serve them; it
                       plans on ``/obstacle_map``, which has what the lidar is too high to see
``twist_mux``          ``/cmd_vel`` and ``/cmd_vel_teleop`` to the wheels
=====================  ======================================================================

Maps, localizer and navigator are started again when they fail; the robot stops and goes on.
"""

from contextlib import suppress
from dataclasses import replace
import os
import re
from typing import Annotated, Any

from amr_description.ament_index import path_of
from amr_description.argument_types import word_of
from amr_description.bringup import Node, Stack
from amr_description.bringup.arguments import with_arguments_of
from amr_description.bringup.controller_files import ABOUT_SENSORS, URDF, URDF_WITH_SENSORS
from amr_description.bringup.description import ParameterValue
from amr_description.bringup.environment import setup_command
from amr_description.bringup.input_files import Note
from amr_description.bringup.stacks.next_steps import VelocityTopic
from amr_description.bringup.stacks.simulation import SimulatedRobot, simulation
from amr_description.bringup.stacks.visualization import ANEW
from amr_description.errors import DescriptionError, UsageError

MUX = 'package://amr_description/config/twist_mux.yaml'
"""Inputs and locks of twist_mux, on topics without a namespace."""
NAVIGATOR = 'package://amr_description/config/navigator.yaml'
"""Parameters of the navigator for amr."""
_OBSTACLE_MAP = 'obstacle_map'
_ASSISTED = 'cmd_vel_assisted'
_BAND = ('--height', '0.02', '--top', '0.4')
"""m; what a robot like amr would run into, between the ground and the deck of its sensors."""
NONE = 'none'
"""In place of a part of the stack: another node is to do it."""
_ABOUT_MAP = (
    'what is on /map: the map of the world (world), that of a .yaml file, or nothing (none)'
)
_ABOUT_NAVIGATOR = 'whether the navigator of this package drives to goals, as Nav2 would'
_ABOUT_PARAMETERS = 'parameters of the navigator that replace those of its file'
_ABOUT_LOCALIZATION = (
    'who publishes map -> odom: truth_localizer (truth), scan_localizer (scan), or another (none)'
)
_LOCALIZATIONS = ('truth', 'scan', NONE)
_LIDAR = re.compile(r"""type=["'](gpu_)?(lidar|ray)["']""")
_BASE = 'base_footprint'
_PLANNED = '/cmd_vel'
"""Where Nav2 publishes its commands, which is an input of the mux."""


@with_arguments_of(simulation)
def navigation(
    sensors: Annotated[bool, ABOUT_SENSORS] = True,
    world: Annotated[str, 'world to simulate'] = 'warehouse',
    map: Annotated[str, _ABOUT_MAP] = 'world',
    localization: Annotated[str, _ABOUT_LOCALIZATION] = 'truth',
    navigator: Annotated[bool, _ABOUT_NAVIGATOR] = True,
    navigator_params: Annotated[str, _ABOUT_PARAMETERS] = '',
    twist_mux: Annotated[str, 'inputs and locks of twist_mux'] = MUX,
    **others: Any,
) -> Stack:
    """The simulation in a warehouse, with all that Nav2 and slam_toolbox need."""
    urdf = others['urdf']
    is_amr = urdf in (URDF, URDF_WITH_SENSORS)  # another robot has the sensors of its own tags
    robot = simulation(sensors=sensors and is_amr, world=world, **others)
    if robot.velocity_topic is None:
        raise UsageError(
            f'urdf:={urdf}: no controller of the robot takes a velocity, so nothing can navigate '
            'it; the stack simulation brings it up'
        )

    # 1. The map of the world, latched, in the frame of the world.
    maps = _map(map, world, others['x'], others['y'])

    # 2. Where the robot is in it, once there is one.
    start = (others['x'], others['y'], others['yaw'])
    localizers = _localizer(localization, robot, start, has_map=bool(maps))

    # 3. Commands of planners and persons, by priority, to the wheels.
    mux = _mux(robot.velocity_topic, str(path_of(twist_mux, 'twist_mux')))

    # 4. What drives to goals, unless Nav2 does.
    files = [str(path_of(NAVIGATOR))] if is_amr else []
    if navigator_params:
        files.append(str(path_of(navigator_params, 'navigator_params')))
    drives = [_navigator(robot, is_amr, files, has_mux=bool(mux))] if navigator else []
    if drives and map == 'world':
        drives = _on_obstacle_map(drives[0], world, others['x'], others['y'])

    return Stack(
        [*robot.nodes, *maps, *localizers, *drives, *mux],
        ready_when=robot.ready_when,
        next_steps=_next_steps(bool(others['viewer']), bool(mux), navigator),
        notes=[*robot.notes, *_notes_on_lidar(urdf, robot.description)],
    )


def _notes_on_lidar(urdf: str, description: str) -> list[Note]:
    """Return a warning, if nothing of the robot can publish /scan."""
    if _LIDAR.search(description):
        return []
    note = f'urdf:={urdf}: no <sensor> is a lidar: without /scan nothing drives to goals or maps'
    return [('WARNING', note)]


def _map(map: str, world: str, x: float, y: float) -> list[Node]:
    """Return the node that publishes the map, if one is wanted; the robot starts at x, y (m)."""
    if map == NONE:
        return []
    if map == 'world':
        return [_map_of_world(world, x, y)]
    if not map.endswith(('.yaml', '.yml')):
        raise UsageError(f'map:={map}: it is world, {NONE}, or the .yaml file of a map')
    file = str(path_of(map, 'map'))
    parameters: dict[str, ParameterValue] = {'yaml_filename': file, 'autostart_node': True}
    given = [parameters | {'use_sim_time': True}]
    return [Node('map_server', parameters=given, required='at start', respawn=ANEW)]


def _localizer(
    localization: str, robot: SimulatedRobot, start: tuple[float, float, float], *, has_map: bool
) -> list[Node]:
    """Return the node that publishes map → odom, if one is wanted; ``start``: x, y (m), yaw."""
    if localization not in _LOCALIZATIONS:
        known = ', '.join(_LOCALIZATIONS[:-1])
        raise UsageError(f'localization:={localization}: it is {known} or {NONE}')
    if localization == NONE:
        return []
    parameters: dict[str, ParameterValue] = {'use_sim_time': True}
    base = _base_frame(robot.description)
    if base != _BASE:
        parameters['base_frame_id'] = base
    if localization == 'scan':
        if not has_map:
            raise UsageError('localization:=scan matches scans against a map, and map:=none')
        pose = zip(('x', 'y', 'yaw'), start, strict=True)
        parameters |= {'set_initial_pose': True}
        parameters |= {f'initial_pose.{name}': value for name, value in pose}
    return [
        Node(
            f'{localization}_localizer',
            parameters=[parameters],
            start_when=robot.ready_when,
            required='at start',
            respawn=ANEW,
        )
    ]


def _navigator(robot: SimulatedRobot, is_amr: bool, files: list[str], *, has_mux: bool) -> Node:
    """
    Return the node that drives to goals, by these parameter files; a robot that is not amr is
    taken as round.

    Beside a mux, which takes ``/cmd_vel_teleop`` to the wheels as it is, what is to be kept from
    obstacles has a topic of its own.
    """
    # Plain Twist, as Nav2 by default and `ros2 topic pub` in most books: a topic has one type.
    parameters: dict[str, ParameterValue] = {
        'use_sim_time': True,
        'enable_stamped_cmd_vel': False,
    }
    if not is_amr:
        from amr_description.model.shapes import horizontal_reach
        from amr_description.model.urdf import parse

        with suppress(DescriptionError):  # robot_state_publisher says where
            parameters['robot_radius'] = horizontal_reach(parse(robot.description))
        parameters['robot_base_frame'] = _base_frame(robot.description)
    return Node(
        'navigator',
        parameters=[*files, parameters],
        remappings=[('cmd_vel_teleop', _ASSISTED)] if has_mux else [],
        start_when=robot.ready_when,
        required='at start',
        respawn=ANEW,
    )


def _on_obstacle_map(navigator: Node, world: str, x: float, y: float) -> list[Node]:
    """Return the navigator and the map that it plans on; the robot starts at x, y (m)."""
    remappings = [('map', _OBSTACLE_MAP)]
    maps = _map_of_world(world, x, y, *_BAND)
    maps = replace(maps, name=_OBSTACLE_MAP, remappings=remappings)
    return [maps, replace(navigator, remappings=[*navigator.remappings, *remappings])]


def _map_of_world(world: str, x: float, y: float, *more: str) -> Node:
    """Return the node that publishes a map of the world, which is free at x, y (m)."""
    return Node(
        'map_of_world',
        arguments=[world, '--publish', '--start', word_of(x), word_of(y), *more],
        parameters=[{'use_sim_time': True}],
        required='at start',
        respawn=ANEW,
    )


def _base_frame(description: str) -> str:
    """Return base_footprint, or, of a robot that has none, its root link."""
    if f'name="{_BASE}"' in description:
        return _BASE
    from amr_description.model.urdf import parse

    try:
        return parse(description).roots[0].name
    except DescriptionError:  # robot_state_publisher says where
        return _BASE


def _mux(wheels: VelocityTopic, file: str) -> list[Node]:
    """Return twist_mux; [] if the wheels themselves listen where planners publish."""
    if wheels.name == _PLANNED:
        return []
    return [
        Node(
            'twist_mux',
            parameters=[file, {'use_stamped': wheels.is_stamped, 'use_sim_time': True}],
            remappings=[('cmd_vel_out', wheels.name)],
        )
    ]


def _next_steps(viewer: bool, has_mux: bool, navigator: bool) -> str:
    """Return what a user would type next."""
    page = 'open the page whose address comes below' if viewer else ''
    if navigator:
        begin = f'{page} and press "Goal" there, or ' if page else ''
        first = f"""{begin}send it to a goal with, in another shell,
    {setup_command('amr_description', os.environ)}
    ros2 topic pub --once /goal_pose geometry_msgs/msg/PoseStamped \\
        "{{header: {{frame_id: map}}, pose: {{position: {{x: 2.0, y: 0.8}}}}}}"
Keys outrank it:"""
    else:
        first = f"""{f'{page}, or ' if page else ''}drive with, in another shell,
    {setup_command('amr_description', os.environ)}"""
    remapping = ' \\\n        --ros-args -r /cmd_vel:=/cmd_vel_teleop' if has_mux else ''
    return f"""{first}
    ros2 run teleop_twist_keyboard teleop_twist_keyboard{remapping}
Nav2 drives it from another machine (docs/nav2.md), with navigator:=false here, by
    ros2 launch nav2_bringup navigation_launch.py use_sim_time:=True \\
        params_file:=nav2_params.yaml
and slam_toolbox maps, with map:=none localization:=none here, by
    ros2 launch slam_toolbox online_async_launch.py use_sim_time:=True \\
        slam_params_file:=mapper_params_online_async.yaml
Ctrl-C stops all."""
