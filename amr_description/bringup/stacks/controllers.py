# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which controllers a stack spawns for a robot, in what order, and what is said of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
import re
from typing import TYPE_CHECKING

from amr_description.ament_index import path_of
from amr_description.bringup import exited_cleanly, Node
from amr_description.bringup.conditions import Condition
from amr_description.bringup.controller_files import controllers_files, SHIPPED, URDF
from amr_description.bringup.input_files import Note
from amr_description.errors import DescriptionError, UsageError
from amr_description.text import quote_all, suggestion

if TYPE_CHECKING:  # YAML and the URDF are read where they are needed only
    from amr_description.model.controller_files import DeclaredController
    from amr_description.model.robot import Robot

AMR = 'amr'
"""The name of the robot of this package, and of the tutorial."""
PAIR = ('joint_state_broadcaster', 'diff_drive_controller')
"""The controllers of amr, and of the tutorial: each has a spawner of its own."""
ABOUT_ACTIVATE = (
    'controllers to spawn, in order, separated by blanks or commas; empty: all that the parameter '
    'file has types for'
)


@dataclass(frozen=True)
class SpawnPlan:
    """What a stack does about the controllers of a robot."""

    names: tuple[str, ...] = PAIR
    """In the order in which they are spawned."""
    declared: tuple['DeclaredController', ...] = ()
    """The same with their types and parameters; empty where they are those of amr."""
    files: tuple[Path, ...] = ()
    """Their parameter files."""
    namespace: str = '/'
    """Of the controller manager."""
    manager: str = 'controller_manager'
    remappings: tuple[tuple[str, str], ...] = ()
    """Of all controllers, by the URDF: (from, to)."""
    notes: tuple[Note, ...] = ()
    is_given: bool = False
    """Whether the files are those of the user, and not those that the URDF names."""
    plugin_twist: str = ''
    """The topic of ``geometry_msgs/msg/Twist`` by which a plugin of Gazebo drives; '': none."""

    @property
    def is_that_of_amr(self) -> bool:
        """Whether robot and controllers are those of this package and of the tutorial."""
        return self.names == PAIR and not self.declared

    @property
    def parameter(self) -> str:
        """The parameter ``controllers`` of the simulator; '': those that the URDF names."""
        return ','.join(map(str, self.files)) if self.is_given or len(self.files) == 1 else ''


def plan_controllers(
    urdf: str,
    description: str,
    controllers: str = '',
    activate: str = '',
    namespace: str = '',
    bridge: str = '',
) -> SpawnPlan:
    """
    Return what is spawned for a robot.

    Args:
        urdf: the description as given.
        description: its text.
        controllers: the parameter files as given, between commas; '': those that the URDF names,
            else the shipped one, if it is for this robot.
        activate: the names as given; '': all.
        namespace: that of the robot, absolute; '': that of its URDF.
        bridge: a configuration file of ros_gz_bridge; '': none.

    Raises:
        ResourceError, ParameterError: there is no such file, or it is no parameter file.
        UsageError: a name of ``activate`` is not in it.
    """
    wanted = tuple(filter(None, re.split(r'[\s,]+', activate)))
    if urdf == URDF and not controllers and not wanted:
        return SpawnPlan(files=(path_of(SHIPPED),))
    from amr_description.model.urdf import parse

    try:
        robot = parse(description, urdf)
        return _plan(urdf, robot, controllers, wanted, namespace, bridge)
    except DescriptionError:  # the node that reads it says where, and what would do
        return SpawnPlan(files=tuple(controllers_files(controllers, urdf, description)))


def _plan(
    urdf: str,
    robot: 'Robot',
    controllers: str,
    wanted: Sequence[str],
    inside: str,
    bridge: str,
) -> SpawnPlan:
    from amr_description.model.controller_files import (
        declared_controllers,
        manager_of,
        remapping,
    )
    from amr_description.model.gazebo.bridge import bridged, read_bridge
    from amr_description.model.gazebo.tags import ros2_control_host_of
    from amr_description.model.gazebo.translation import translate
    from amr_description.model.ros2_control_tag import hardware_of
    from amr_description.parameter_files import given_files

    given = given_files(controllers, 'controllers')
    plugins = translate(robot, given or None, inside)
    if bridge:
        plugins = bridged(plugins, read_bridge(path_of(bridge, 'bridge')))
    if not hardware_of(plugins.robot):
        note = f'urdf:={urdf}: it has no <ros2_control>, and so no controller manager of its own'
        note += f'; controllers:={controllers} has no effect' if controllers else ''
        return SpawnPlan((), files=tuple(given), notes=(('INFO', note),))
    files, notes = (given, []) if given else _files_of(urdf, robot)
    own_namespace, manager = manager_of(robot)
    namespace = inside or own_namespace
    if plugins.controllers:
        named = ', '.join(each.name for each in plugins.controllers)
        notes.append(('INFO', f"urdf:={urdf}: Gazebo's plugins, active from the start: {named}"))
    found = declared_controllers(files, namespace, manager)
    if files and not found:
        named = ', '.join(map(str, files))
        notes.append(('WARNING', f'{named}: no controller has a type there, so none is spawned'))
    names = [each.name for each in found]
    for name in wanted:
        if name not in names:
            raise UsageError(
                f'activate:={name}: no parameter file has a type for it{suggestion(name, names)}'
            )
    chosen = tuple(wanted) or tuple(names)
    if robot.name == AMR and chosen == PAIR and own_namespace == '/':
        return SpawnPlan(files=tuple(files), notes=tuple(notes), is_given=bool(given))
    by_name = {each.name: each for each in found}
    return SpawnPlan(
        chosen,
        tuple(by_name[name] for name in chosen),
        tuple(files),
        namespace,
        manager,
        tuple(rule for rule in map(remapping, ros2_control_host_of(robot).remappings) if rule),
        tuple(notes),
        bool(given),
        plugins.twist_topic(namespace),
    )


def _files_of(urdf: str, robot: 'Robot') -> tuple[list[Path], list[Note]]:
    """Return the parameter files of a robot for which none is given, and what is said of it."""
    from amr_description.model.controller_files import files_of, missing_files, named_files
    from amr_description.model.ros2_control_tag import hardware_of

    files, missing = files_of(robot), missing_files(named_files(robot))
    if not files and not missing and not hardware_of(robot):
        return [], []  # Gazebo's plugins are all that it has
    if not files:
        why = 'no controller is spawned: give controllers:=FILE'
        why = f'it names no parameter file; {why}' if not missing else why
    elif missing:
        why = 'correct its name, or give controllers:=FILE'
    else:
        return files, []
    if missing:
        why = f'a file that it names in <parameters> is not there: {quote_all(missing)}; {why}'
    return files, [('WARNING', f'urdf:={urdf}: {why}')]


def spawners(plan: SpawnPlan, start_when: Condition | None) -> list[Node]:
    """
    Return the nodes that spawn the controllers of a plan; [] where there are none.

    Those of amr are spawned one after the other, and a failure stops the stack. Those of another
    robot have one spawner, which leaves out what cannot be.
    """
    namespace = None if plan.namespace == '/' else plan.namespace
    if plan.is_that_of_amr:
        nodes: list[Node] = []
        for name in plan.names:
            nodes.append(Node('spawner', arguments=[name], start_when=start_when))
            start_when = exited_cleanly(nodes[-1])
        return nodes
    if not plan.names:
        return []
    words = words_of(plan)
    return [Node('spawner', namespace=namespace, arguments=words, start_when=start_when)]


def words_of(plan: SpawnPlan) -> list[str]:
    """Return the words of one spawner for all controllers of a plan."""
    if plan.is_that_of_amr:
        return list(plan.names)
    from amr_description.model.controller_files import spawner_words

    words = spawner_words(plan.declared)
    if plan.manager != 'controller_manager':
        words += ['--controller-manager', plan.manager]
    return [*words, '--continue-on-error']
