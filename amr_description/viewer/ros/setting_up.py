# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controllers of a robot that a page has spawned: those of the robot that it is like.

That one may have been deleted since, and its controller manager with it; or the viewer began only
after that.
"""

from collections.abc import Iterable, Sequence

from amr_description.errors import PartlyDoneError, ViewerError
from amr_description.model.gazebo.tags import ros2_control_host_of
from amr_description.model.gazebo.translation import translate
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse
from amr_description.viewer.protocol import ControllerInfo
from amr_description.viewer.requests import SetUp
from amr_description.viewer.ros.service_clients import (
    activate_controllers,
    active_controllers,
    ServiceClients,
)
from amr_description.viewer.ros.threads import ServedRobot


async def set_up(
    services: ServiceClients,
    robot: str,
    like: ServedRobot,
    listed: Sequence[ControllerInfo] | None,
) -> str:
    """
    Activate the controllers of a new robot.

    Args:
        services: The clients.
        robot: Its namespace.
        like: The robot that it is like.
        listed: The last known controllers of that one; None: they never were.

    Returns:
        What is active, in one line; empty: it has no hardware.

    Raises:
        PartlyDoneError: They are not active; can be asked again.
        DescriptionError: The description cannot be read.
    """
    manager = _manager_of(robot, like)
    if manager is None:
        return ''
    try:
        names = await activate_controllers(
            services, manager, await _names(services, robot, like, listed)
        )
    except ViewerError as error:
        again = {'type': SetUp.types[0], 'robot': robot, 'like': like.found.id}
        raise PartlyDoneError(
            f'the controllers of {robot} are not active: {error}', again
        ) from error
    return f'active: {", ".join(names) or "no controllers"}'


async def _names(
    services: ServiceClients,
    robot: str,
    like: ServedRobot,
    listed: Sequence[ControllerInfo] | None,
) -> Sequence[str] | None:
    """Return the active controllers, in the order to activate them in; None: unknown."""
    is_another = like.found.id != robot  # in its own place it has none yet
    if is_another and like.found.is_present and like.found.manager is not None:
        try:
            return await active_controllers(services, like.found.manager)
        except ViewerError:
            if listed is None:
                raise  # it is there, and will say so later
    return None if listed is None else _active(listed) or None


def _active(listed: Iterable[ControllerInfo]) -> list[str]:
    return [each.name for each in listed if each.state == 'active'][::-1]


def _manager_of(robot: str, like: ServedRobot) -> str | None:
    """Return the controller manager that a robot like another one has; None: it has none."""
    manager = like.found.manager
    if manager is not None:
        return robot.rstrip('/') + manager.removeprefix(like.found.id.rstrip('/'))
    return None if like.described is None else manager_of(robot, like.described.message.urdf)


def manager_of(robot: str, urdf: str) -> str | None:
    """
    Return the controller manager that a robot in this namespace has; None: it has no hardware.

    Raises:
        DescriptionError: The description cannot be read.
    """
    described = translate(parse(urdf)).robot
    if not hardware_of(described):
        return None
    return f'{robot.rstrip("/")}/{ros2_control_host_of(described).controller_manager_name}'
