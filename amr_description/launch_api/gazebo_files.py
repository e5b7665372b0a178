# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Launch files of Gazebo's packages, where these are not installed: the simulator here is started.

``gz_args`` are understood as far as they matter: the world, ``-r`` (else time stands still at
first) and ``-s`` (no page). A world of SDF is not read: the empty one is there in its place.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
import shlex
from typing import Any

from amr_description.ament_index import shipped_worlds, world_path
from amr_description.launch_api.actions import LogInfo, OpaqueFunction, Shutdown
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import (
    Action,
    DeclareLaunchArgument,
    LaunchDescription,
)
from amr_description.launch_api.processes import Node
from amr_description.launch_api.substitutions import SomeSubstitutions, text_of
from amr_description.text import truth

_OURS = 'amr_description'
_NO_BRIDGE = 'no bridge is needed here: its topics are of ROS'
_WITH_A_VALUE = (
    '-v', '--verbose', '-z', '--iterations', '--physics-engine', '--render-engine', '--seed',
    '--render-engine-server', '--render-engine-gui', '--gui-config', '--record-path',
    '--network-role',
)  # fmt: skip
_WITH_A_VALUE_IN_CLASSIC = (
    '-e', '--physics', '-p', '--play', '-g', '--gui-plugin', '--gui-client-plugin', '-s',
    '--server-plugin', '-o', '--profile', '--iters', '--seed', '--record_path',
    '--record_encoding', '--record_period', '--record_filter',
)  # fmt: skip


class GazeboPage(Action):
    """The page of the viewer, in the place of a window of Gazebo."""


@dataclass(frozen=True)
class World:
    """What the words after ``gz sim`` say."""

    name: str = ''
    """As given; '': none."""
    is_running: bool = False
    has_window: bool = True
    has_server: bool = True

    @property
    def shipped(self) -> str:
        """The world here: a shipped one of that name, an MJCF file, else the empty one."""
        path = Path(self.name)
        if path.suffix == '.xml':
            return str(world_path(self.name))
        return path.stem if path.stem in shipped_worlds() else 'empty'


def world_of(words: Sequence[str]) -> World:
    """Return what the words after ``gz sim`` say."""
    names, flags, skip = [], set(), False
    for word in words:
        if skip and not word.startswith('-'):
            skip = False
        elif word.startswith('-'):
            long = word.startswith('--')
            flags |= {word} if long else set(word[1:])
            skip = word in _WITH_A_VALUE
        else:
            names.append(word)
    return World(
        name=names[0] if names else '',
        is_running='r' in flags,
        has_window='s' not in flags and '--headless-rendering' not in flags,
        has_server='g' not in flags,
    )


def classic_world_of(program: str, words: Sequence[str]) -> World:
    """Return what the words after ``gazebo``, ``gzserver`` or ``gzclient`` of Classic say."""
    names, flags, rest = [], set(), [*words]
    while rest:
        word = rest.pop(0)
        if not word.startswith('-'):
            names.append(word)
        elif word in _WITH_A_VALUE_IN_CLASSIC:
            del rest[:1]
        else:
            flags.add(word)
    return World(
        name=names[0] if names else '',
        is_running=flags.isdisjoint({'-u', '--pause'}),
        has_window=program != 'gzserver',
        has_server=program != 'gzclient',
    )


def simulator(world: World) -> list[Action]:
    """Return the actions that take the place of Gazebo."""
    actions: list[Action] = []
    if world.has_server:
        parameters = {'world': world.shipped, 'paused': not world.is_running}
        sdf = world.name and Path(world.name).stem != world.shipped and world.name != world.shipped
        if sdf:
            actions.append(
                LogInfo(
                    msg=f"the world '{world.name}' is not read here: it is '{world.shipped}' in "
                    'its place'
                )
            )
        actions.append(
            Node(
                package=_OURS,
                executable='mujoco_sim',
                parameters=[parameters],
                on_exit=Shutdown(reason='the simulator has ended'),
            )
        )
    return [*actions, GazeboPage()] if world.has_window else actions


class GzServer(Action):
    """The world alone, as ros_gz_sim.actions has it."""

    def __init__(
        self, *, world_sdf_file: SomeSubstitutions = '', condition: Any = None, **_others: Any
    ) -> None:
        super().__init__(condition=condition)
        self.world_sdf_file = world_sdf_file

    def execute(self, context: LaunchContext) -> list[Action]:
        name = text_of(context, self.world_sdf_file)
        return simulator(World(name, is_running=True, has_window=False))


class RosGzBridge(Action):
    """A bridge, which is not needed."""

    def __init__(self, *, condition: Any = None, **_others: Any) -> None:
        super().__init__(condition=condition)

    def execute(self, _context: LaunchContext) -> list[Action]:
        return [LogInfo(msg=_NO_BRIDGE)]


def _declared(**defaults: str) -> list[DeclareLaunchArgument]:
    return [DeclareLaunchArgument(name, default_value=value) for name, value in defaults.items()]


def _gz_sim() -> LaunchDescription:
    def started(context: LaunchContext) -> list[Action]:
        given = context.launch_configurations
        words = shlex.split(f'{given["gz_args"] or given["ign_args"]}')
        return simulator(world_of(words))

    arguments = _declared(
        gz_args='', gz_version='8', ign_args='', ign_version='', debugger='false',
        on_exit_shutdown='false',
    )  # fmt: skip
    return LaunchDescription([*arguments, OpaqueFunction(function=started)])


def _gz_server() -> LaunchDescription:
    def started(context: LaunchContext) -> list[Action]:
        name = str(context.launch_configurations['world_sdf_file'])
        return simulator(World(name, is_running=True, has_window=False))

    arguments = _declared(
        world_sdf_file='', world_sdf_string='', container_name='ros_gz_container'
    )
    return LaunchDescription([*arguments, OpaqueFunction(function=started)])


def _gz_spawn_model() -> LaunchDescription:
    def started(context: LaunchContext) -> list[Action]:
        given = {key: str(value) for key, value in context.launch_configurations.items()}
        options = {
            '-world': given['world'], '-file': given['file'], '-topic': given['topic'],
            '-string': given['model_string'], '-name': given['entity_name'],
            '-x': given['x'], '-y': given['y'], '-z': given['z'],
            '-R': given['roll'], '-P': given['pitch'], '-Y': given['yaw'],
        }  # fmt: skip
        words = [word for option, value in options.items() if value for word in (option, value)]
        return [Node(package=_OURS, executable='create', arguments=words)]

    arguments = _declared(
        world='', file='', model_string='', topic='', entity_name='', allow_renaming='False',
        x='', y='', z='', roll='', pitch='', yaw='',
    )  # fmt: skip
    return LaunchDescription([*arguments, OpaqueFunction(function=started)])


def _classic() -> LaunchDescription:
    def started(context: LaunchContext) -> list[Action]:
        given = context.launch_configurations
        window = truth(str(given.get('gui', 'true'))) is not False
        paused = truth(str(given.get('pause', 'false'))) is True
        return simulator(World(str(given['world']), is_running=not paused, has_window=window))

    arguments = _declared(world='', gui='true', pause='false')
    return LaunchDescription([*arguments, OpaqueFunction(function=started)])


def _classic_server() -> LaunchDescription:
    def started(context: LaunchContext) -> list[Action]:
        name = str(context.launch_configurations['world'])
        return simulator(World(name, is_running=True, has_window=False))

    return LaunchDescription([*_declared(world=''), OpaqueFunction(function=started)])


def _page() -> LaunchDescription:
    return LaunchDescription([GazeboPage()])


def _nothing() -> LaunchDescription:
    return LaunchDescription([LogInfo(msg=_NO_BRIDGE)])


def left_out(package: str, file: str, why: str) -> LaunchDescription:
    """Return what is there of a launch file of a package that stops no robot: a line."""
    return LaunchDescription([LogInfo(msg=f'{package} {Path(file).name} is left out: {why}')])


FILES: Mapping[str, Mapping[str, Callable[[], LaunchDescription]]] = {
    'gazebo_ros': {
        'launch/gazebo.launch.py': _classic,
        'launch/gzclient.launch.py': _page,
        'launch/gzserver.launch.py': _classic_server,
    },
    'ros_gz_bridge': {'launch/ros_gz_bridge.launch.py': _nothing},
    'ros_gz_sim': {
        'launch/gz_server.launch.py': _gz_server,
        'launch/gz_sim.launch.py': _gz_sim,
        'launch/gz_spawn_model.launch.py': _gz_spawn_model,
    },
}
"""By package and file."""
