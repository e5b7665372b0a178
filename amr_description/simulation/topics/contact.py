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

from dataclasses import dataclass, replace
import itertools

from amr_description.cdr.writer import Writer
from amr_description.clock import NANOSECONDS
from amr_description.model.frames import rotate
from amr_description.model.sensors import ContactSensor
from amr_description.sim.contact_sensor import SimulatedContacts
from amr_description.sim.contacts import Contact
from amr_description.simulation.topics.names import WORLD_FRAME
from amr_description.simulation.topics.sensor_topics import SensorContext, SensorTopics

CONTACTS = 'ros_gz_interfaces/msg/Contacts'
CONTACTS_STATE = 'gazebo_msgs/msg/ContactsState'

_COLLISION = 5
"""Of ``ros_gz_interfaces/msg/Entity``."""


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
        self._is_sent_empty = sensor.message == CONTACTS_STATE
        frame = sensor.mount.frame
        is_of_link = sensor.message == CONTACTS_STATE and self._robot.description.has_link(frame)
        self._link = frame if is_of_link else ''
        self._frame_id = context.frame(frame) if is_of_link else WORLD_FRAME
        self._reader = SimulatedContacts(sensor, context.world, context.robot, context.log)
        self._topic = context.advertise(
            sensor.topic, sensor.mount, sensor.message, _ENCODERS[sensor.message]
        )

    @property
    def has_subscribers(self) -> bool:
        """Whether anybody subscribes."""
        return self._topic.has_subscribers

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


def contacts_bytes(sample: ContactsSample) -> bytes:
    """Return a ``ros_gz_interfaces/msg/Contacts``."""
    out = _begin(sample)
    for each in sample.contacts:
        for number, name in ((each.own_id, each.own), (each.other_id, each.other)):
            out.long(number)
            out.text(name)
            out.octet(_COLLISION)
        _write_points(out, each)
        out.count(len(each.points))
        for point in each.points:
            x, y, z = point.force
            out.stamp(0)
            out.text('')
            for _ in ('body_1', 'body_2'):  # names and ids, which gz leaves out as well
                out.text('')
                out.count(0)
            out.doubles((x, y, z, 0.0, 0.0, 0.0, -x, -y, -z, 0.0, 0.0, 0.0))
    return out.bytes()


def contacts_state_bytes(sample: ContactsSample) -> bytes:
    """Return a ``gazebo_msgs/msg/ContactsState``."""
    out = _begin(sample)
    seconds, rest = divmod(sample.stamp, NANOSECONDS)
    for number, each in enumerate(sample.contacts, start=1):
        out.text(
            f'Debug:  i: ({number}/{len(sample.contacts)})     my_geom: [{each.own}]  '
            f'other_geom: [{each.other}]        time: [{seconds}.{rest}]\n'
        )
        out.text(each.own)
        out.text(each.other)
        out.count(len(each.points))
        wrenches = [(*point.force, 0.0, 0.0, 0.0) for point in each.points]
        total = map(sum, zip(*wrenches, strict=True))
        out.doubles([*itertools.chain.from_iterable(wrenches), *total])
        _write_points(out, each)
    return out.bytes()


def _begin(sample: ContactsSample) -> Writer:
    """Write the header, and how many contacts there are."""
    out = Writer()
    out.stamp(sample.stamp)
    out.text(sample.frame_id)
    out.count(len(sample.contacts))
    return out


def _write_points(out: Writer, contact: Contact) -> None:
    """Write positions, normals and depths."""
    points = contact.points
    for vectors in ([each.position for each in points], [each.normal for each in points]):
        out.count(len(points))
        out.doubles([value for vector in vectors for value in vector])
    out.count(len(points))
    out.doubles([each.depth for each in points])


_ENCODERS = {CONTACTS: contacts_bytes, CONTACTS_STATE: contacts_state_bytes}
