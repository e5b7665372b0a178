# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The controllers of a simulated robot: spawned as its files say; by which topics it is used."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
import warnings

from amr_description.controller_manager.spawner import ControllerState, Manager, Spawner
from amr_description.controller_manager.spawner_arguments import parse
from amr_description.log import Log
from amr_description.model.controller_files import (
    class_of,
    DeclaredController,
    spawner_words,
    TWIST_MUX,
    VELOCITY_TOPICS,
)
from amr_description.model.gazebo.builder import GazeboTranslation

BROADCASTER = 'JointStateBroadcaster'
_STAMPED_TWIST = 'geometry_msgs/msg/TwistStamped'
_ODOMETRY = 'nav_msgs/msg/Odometry'
_JOINT_STATE = 'sensor_msgs/msg/JointState'

FindTopic = Callable[[str, str], str]
"""(controller, type of messages) → the full name of its topic of that type."""


@dataclass(frozen=True)
class Topics:
    """Topics of the active controllers, after remapping; empty: there is none."""

    command: str = ''
    """geometry_msgs/msg/TwistStamped, of the first controller that drives, or of its mux."""
    is_stamped: bool = True
    """Whether it is; Twist without a stamp drives a plugin of Gazebo."""
    odometry: str = ''
    """nav_msgs/msg/Odometry, of that which drives."""
    joints: str = ''
    """sensor_msgs/msg/JointState."""


def spawn_declared(
    log: Log,
    manager: Manager,
    declared: Sequence[DeclaredController],
    names: Sequence[str] | None,
) -> None:
    """
    Spawn the controllers that are named, or as many of those that are declared as can be.

    Args:
        log: Gets what a spawner says.
        manager: Of the robot.
        declared: The controllers that parameter files have types for.
        names: The controllers, in order; None: all that are declared. One that cannot be, or
            claims what another one has claimed, is then left out or inactive, with a warning.

    Raises:
        ControllerError, ParameterError: A controller that is named cannot be spawned.
    """
    known = {each.name: each for each in declared}
    chosen = known if names is None else names
    wanted = [known.get(name, DeclaredController(name, '')) for name in chosen]
    if not wanted:
        return
    spawner = Spawner(log, manager, parse(spawner_words(wanted)))
    if names is not None:
        spawner.spawn()
        return
    for line in spawner.spawn_what_can_be():
        warnings.warn(line, stacklevel=2)


def topics_of(
    manager: Manager,
    subscribed: FindTopic,
    published: FindTopic,
    plugins: GazeboTranslation,
    namespace: str,
) -> Topics:
    """
    Return the topics by which a robot is driven and read.

    Args:
        manager: Of the robot, whose active controllers count.
        subscribed: Finds a topic that a controller subscribes to.
        published: Finds one that it publishes.
        plugins: What stands for the plugins of Gazebo in its description.
        namespace: Of the manager, absolute.
    """
    active = [each for each in manager.controllers().values() if each.state == 'active']
    drive = next((each.name for each in active if _drives(each.type)), None)
    broadcaster = next((each.name for each in active if each.type.endswith(BROADCASTER)), None)
    topics = Topics(
        command=subscribed(_mux_of(drive, active) or drive, _STAMPED_TWIST) if drive else '',
        odometry=published(drive, _ODOMETRY) if drive else '',
        joints=published(broadcaster, _JOINT_STATE) if broadcaster else '',
    )
    return _with_plugins(topics, plugins, [each.name for each in active], namespace)


def _mux_of(drive: str, active: Sequence[ControllerState]) -> str:
    """Return the controller that chooses the commands of a drive; '': its own topic counts."""
    muxes = (each for each in active if class_of(each.type) == TWIST_MUX)
    commanding = (
        each.name
        for each in muxes
        if any(name.startswith(f'{drive}/') for name in each.claimed_interfaces)
    )
    return next(commanding, '')


def _drives(controller_type: str) -> bool:
    """Return whether a type is that of a drive, or ends with it: ``my_package/MyDiffDrive…``."""
    return class_of(controller_type).endswith(tuple(VELOCITY_TOPICS))


def _with_plugins(
    topics: Topics, plugins: GazeboTranslation, active: Collection[str], namespace: str
) -> Topics:
    """Return topics with those of Gazebo's plugins, if active, in place of what is missing."""
    if topics.command:
        return topics
    running = tuple(each for each in plugins.controllers if each.name in active)
    plugins = replace(plugins, controllers=running)
    return Topics(
        command=plugins.twist_topic(namespace),
        is_stamped=False,
        odometry=topics.odometry or plugins.odometry_topic(namespace),
        joints=topics.joints or plugins.joint_states_topic(namespace),
    )
