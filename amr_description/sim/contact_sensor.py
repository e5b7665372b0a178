# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A contact sensor on a robot: what touches its collisions; without ROS."""

from amr_description.log import Log, Severity
from amr_description.model.collision_names import find_collisions, gazebo_name
from amr_description.model.robot import Robot
from amr_description.model.sensors import ContactSensor
from amr_description.sim.contacts import Contact, ContactReader, geoms_of
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld
from amr_description.text import quote, quote_all


class SimulatedContacts:
    """What touches the collisions of a sensor; valid as long as the view of its robot is."""

    def __init__(
        self, sensor: ContactSensor, world: MujocoWorld, robot: RobotView, log: Log
    ) -> None:
        """
        Take a sensor.

        Args:
            sensor: Its description.
            world: The simulated world.
            robot: The robot that has it.
            log: Is warned of collisions that are not there.
        """
        self._reader = ContactReader(world, robot, _collisions_of(sensor, world, robot, log))

    def read(self) -> tuple[Contact, ...]:
        """Return what touches it now, in the frame of the world."""
        return self._reader.read()


def _collisions_of(
    sensor: ContactSensor, world: MujocoWorld, view: RobotView, log: Log
) -> tuple[tuple[str, int], ...]:
    """Return the collisions of a sensor: those of its link if none of the named ones is there."""
    robot, mount = view.description, sensor.mount
    found, unknown = find_collisions(robot, mount.link, sensor.collisions)
    if unknown:
        what = (
            f'there is no collision {quote_all(unknown)}; there are: {_names(robot, mount.link)}'
        )
        if not found:
            found, _ = find_collisions(robot, mount.link, ())
            what = f'{what}; it feels all of link {quote(mount.link)}'
        log(Severity.WARN, f"robot '{view.name}': sensor {quote(mount.name)}: {what}")
    # Of a link called world, or whose mesh was not found, there may be none.
    simulated = {*geoms_of(world, view).values()}
    felt = tuple(key for key in found if key in simulated)
    if not felt:
        log(
            Severity.WARN,
            f"robot '{view.name}': sensor {quote(mount.name)} feels nothing: link "
            f'{quote(mount.link)} has no <collision> that is simulated',
        )
    return felt


def _names(robot: Robot, link: str) -> str:
    """Return what the collisions of a robot are called, those of a link if it has any."""
    links = [robot.link(link)] if robot.link(link).collisions else robot.links
    names = [gazebo_name(each, number) for each in links for number in range(len(each.collisions))]
    return ', '.join(names) or 'none'
