# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Contact sensors and bumpers: ``ros_gz_interfaces/msg/Contacts``, as ros_gz_bridge gives them, or
``gazebo_msgs/msg/ContactsState``, as Gazebo Classic's bumper does.

``Contacts`` come while there are some, in the frame of the world. ``ContactsState`` come at each
instant that is due, empty or not, in the frame of the link that ``<frame_name>`` names, else in
that of the world. (Gazebo Classic says so in the header, too, but has the values of the world.)
The first collision is that of the sensor; the normal points towards it, and the first force acts
on it. As in new Gazebo there is no torque.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from geometry_msgs.msg import Vector3, Wrench
from rclpy.qos import QoSProfile

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Severity
from amr_description.control.ros.encoders import filling
from amr_description.model.collision_names import find_collisions, gazebo_name
from amr_description.model.frames import rotate, Vector
from amr_description.model.robot import Robot
from amr_description.model.sensors import ContactSensor
from amr_description.ros.message_types import message_type
from amr_description.ros.messages import fill_stamp
from amr_description.sim.contacts import Contact, ContactPoint, ContactReader, geoms_of
from amr_description.sim.ros.names import WORLD_FRAME
from amr_description.sim.ros.sensors.topics import SensorContext, SensorTopics
from amr_description.text import quote, quote_all

CONTACTS = 'ros_gz_interfaces/msg/Contacts'
CONTACTS_STATE = 'gazebo_msgs/msg/ContactsState'

_QOS = QoSProfile(depth=10)


@dataclass(frozen=True, slots=True)
class ContactsSample:
    """What is published at one instant, ns; contacts in the frame ``frame_id``."""

    stamp: int
    frame_id: str
    contacts: tuple[Contact, ...]


class ContactTopics(SensorTopics):
    """The topic of one contact sensor."""

    def __init__(self, sensor: ContactSensor, context: SensorContext) -> None:
        """Create the topic; warn of collisions that are not there."""
        self._robot = context.robot
        self._node = context.node
        self._is_sent_empty = sensor.message == CONTACTS_STATE
        frame = sensor.mount.frame
        is_of_link = sensor.message == CONTACTS_STATE and self._robot.description.has_link(frame)
        self._link = frame if is_of_link else ''
        self._frame_id = context.frame(frame) if is_of_link else WORLD_FRAME
        collisions = _collisions_of(sensor, context)
        self._reader = ContactReader(context.world, context.robot, collisions)
        message = message_type(sensor.message)
        self._topic = context.loop_publisher.topic(
            context.node.create_publisher(
                message, context.topic(sensor.topic, sensor.mount), _QOS
            ),
            filling(_FILLERS[sensor.message](), message()),
        )

    @property
    def is_heard(self) -> bool:
        """Whether anybody subscribes."""
        return self._topic.is_heard

    def measure(self, time: int) -> None:
        """Publish what touches the sensor."""
        contacts = self._reader.read()
        if contacts or self._is_sent_empty:
            self._send(time, contacts)

    def answer(self, time: int) -> None:
        """Publish what touches the sensor, also that nothing does."""
        self._send(time, self._reader.read())

    def _send(self, time: int, contacts: tuple[Contact, ...]) -> None:
        if self._link and contacts:
            contacts = self._in_link(contacts)
        self._topic.send(ContactsSample(time, self._frame_id, contacts))

    def destroy(self) -> None:
        """Remove the topic."""
        self._node.destroy_publisher(self._topic.publisher)

    def _in_link(self, contacts: tuple[Contact, ...]) -> tuple[Contact, ...]:
        """Return contacts in the frame of the link that the messages name."""
        to_link = self._robot.pose(self._link).inverse()

        def moved(contact: Contact) -> Contact:
            points = tuple(
                replace(
                    point,
                    position=to_link.apply(point.position),
                    normal=rotate(to_link.rotation, point.normal),
                    force=rotate(to_link.rotation, point.force),
                )
                for point in contact.points
            )
            return replace(contact, points=points)

        return tuple(moved(each) for each in contacts)


def _collisions_of(sensor: ContactSensor, context: SensorContext) -> tuple[tuple[str, int], ...]:
    """Return the collisions of a sensor: those of its link if none of the named ones is there."""
    robot, mount = context.robot.description, sensor.mount
    found, unknown = find_collisions(robot, mount.link, sensor.collisions)
    if unknown:
        what = (
            f'there is no collision {quote_all(unknown)}; there are: {_names(robot, mount.link)}'
        )
        if not found:
            found, _ = find_collisions(robot, mount.link, ())
            what = f'{what}; it feels all of link {quote(mount.link)}'
        context.log(
            Severity.WARN, f"robot '{context.robot.name}': sensor {quote(mount.name)}: {what}"
        )
    # Of a link called world, or whose mesh was not found, there may be none.
    simulated = {*geoms_of(context.world, context.robot).values()}
    felt = tuple(key for key in found if key in simulated)
    if not felt:
        context.log(
            Severity.WARN,
            f"robot '{context.robot.name}': sensor {quote(mount.name)} feels nothing: link "
            f'{quote(mount.link)} has no <collision> that is simulated',
        )
    return felt


def _names(robot: Robot, link: str) -> str:
    """Return what the collisions of a robot are called, those of a link if it has any."""
    links = [robot.link(link)] if robot.link(link).collisions else robot.links
    names = [gazebo_name(each, number) for each in links for number in range(len(each.collisions))]
    return ', '.join(names) or 'none'


def _contacts_filler() -> Callable[[ContactsSample, Any], None]:
    """Return the converter to ``ros_gz_interfaces/msg/Contacts``."""
    contact_type = message_type('ros_gz_interfaces/msg/Contact')
    wrench_type = message_type('ros_gz_interfaces/msg/JointWrench')

    wrenches: list[Any] = []  # each costs 20 µs to make, and is filled again

    def filled_wrenches(points: Sequence[ContactPoint], first: int) -> list[Any]:
        last = first + len(points)
        wrenches.extend(wrench_type() for _ in range(last - len(wrenches)))
        for point, message in zip(points, wrenches[first:last], strict=True):
            one, other = message.body_1_wrench.force, message.body_2_wrench.force
            one.x, one.y, one.z = x, y, z = point.force
            other.x, other.y, other.z = -x, -y, -z
        return wrenches[first:last]

    def fill(sample: ContactsSample, message: Any) -> None:
        fill_stamp(sample.stamp, message.header.stamp)
        message.header.frame_id = sample.frame_id
        contacts, count = [], 0
        for each in sample.contacts:
            contact = contact_type()
            contact.collision1.id, contact.collision1.name = each.own_id, each.own
            contact.collision2.id, contact.collision2.name = each.other_id, each.other
            contact.collision1.type = contact.collision2.type = contact.collision1.COLLISION
            contact.positions = [_vector(point.position) for point in each.points]
            contact.normals = [_vector(point.normal) for point in each.points]
            contact.depths = [point.depth for point in each.points]
            contact.wrenches = filled_wrenches(each.points, count)
            count += len(each.points)
            contacts.append(contact)
        message.contacts = contacts

    return fill


def _contacts_state_filler() -> Callable[[ContactsSample, Any], None]:
    """Return the converter to ``gazebo_msgs/msg/ContactsState``."""
    state_type = message_type('gazebo_msgs/msg/ContactState')

    def fill(sample: ContactsSample, message: Any) -> None:
        fill_stamp(sample.stamp, message.header.stamp)
        message.header.frame_id = sample.frame_id
        states = []
        for number, each in enumerate(sample.contacts, start=1):
            seconds, rest = divmod(sample.stamp, NANOSECONDS)
            state = state_type(
                info=f'Debug:  i: ({number}/{len(sample.contacts)})     my_geom: [{each.own}]  '
                f'other_geom: [{each.other}]        time: [{seconds}.{rest}]\n',
                collision1_name=each.own,
                collision2_name=each.other,
                wrenches=[Wrench(force=_vector(point.force)) for point in each.points],
                contact_positions=[_vector(point.position) for point in each.points],
                contact_normals=[_vector(point.normal) for point in each.points],
                depths=[point.depth for point in each.points],
            )
            total = zip(*(point.force for point in each.points), strict=True)
            x, y, z = map(sum, total)
            state.total_wrench.force = _vector((x, y, z))
            states.append(state)
        message.states = states

    return fill


def _vector(values: Vector) -> Vector3:
    x, y, z = values
    return Vector3(x=x, y=y, z=z)


_FILLERS = {CONTACTS: _contacts_filler, CONTACTS_STATE: _contacts_state_filler}
