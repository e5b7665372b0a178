# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Contact sensors over DDS: the messages of ros_gz_bridge and of Gazebo Classic's bumper."""

from gazebo_msgs.msg import ContactsState
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from ros_gz_interfaces.msg import Contacts, Entity
from support.running_programs import PATIENCE

from amr_description.control.ros.loop_publisher import ClockedLoopPublisher, NodeTopics
from amr_description.model.frames import Transform
from amr_description.model.sensors import ContactSensor, SensorMount
from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import wait_until
from amr_description.sim.contacts import Contact, ContactPoint
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.contact import (
    contacts_bytes,
    CONTACTS_STATE,
    contacts_state_bytes,
    ContactsSample,
)
from amr_description.simulation.topics.sensor_manager import SensorManager

WEIGHT = 2.0 * 9.81
"""N."""
ROBOT = """<robot name="r"><link name="base">
      <inertial><mass value="2"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision name="box"><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
    <link name="foot"/><joint name="j" type="fixed"><origin xyz="0.5 0 -0.1"/>
      <parent link="base"/><child link="foot"/></joint></robot>"""
TURN = 10_000_000
"""ns, of the loop."""


class Host:
    """A falling box with a contact sensor, stepped by hand."""

    def __init__(self, sensor, height):
        self.node = Node('host')
        self.world = MujocoWorld('empty')
        self.lines = []
        publisher = ClockedLoopPublisher(self.node, look_period=0)
        self.sensors = SensorManager(
            NodeTopics(self.node, publisher),
            self.world,
            lambda severity, text, throttle=0.0: self.lines.append(text),
            lambda: False,
        )
        self.world.spawn('r', ROBOT, Transform((1.0, 0.0, height)))
        self.sensors.add('r', '/one', [sensor])
        self._publisher = publisher

    def turn(self, count):
        for _ in range(count):
            self._publisher.publish(self.world.time)
            self.world.step(TURN // self.world.timestep)

    def wait(self, condition):
        assert wait_until(self.node, lambda: condition() or None, timeout=PATIENCE)


@pytest.fixture
def start():
    rclpy.init(args=[])
    hosts = []

    def start(height, frame='', rate=0.0, collisions=(), link='base', **others):
        mount = SensorMount('touch', link, frame=frame, rate=rate)
        hosts.append(Host(ContactSensor(mount, collisions, **others), height))
        return hosts[-1]

    yield start
    for host in hosts:
        host.node.destroy_node()
    rclpy.try_shutdown()


def heard(host, kind, topic, qos):
    messages = []
    host.node.create_subscription(kind, topic, messages.append, qos)
    (publisher,) = [each for each in host.node.publishers if each.topic_name == topic]
    host.wait(lambda: publisher.get_subscription_count() > 0)
    return messages


@pytest.mark.parametrize('qos', [QoSProfile(depth=1000), qos_profile_sensor_data])
def test_contacts_come_while_there_are_some(start, qos):
    host = start(0.3)
    messages = heard(host, Contacts, '/one/contact', qos)
    host.turn(5)  # falling
    host.world.step(400)
    at_rest = host.world.time
    host.turn(3)
    host.wait(lambda: len(messages) == 3)
    assert [nanoseconds(each.header.stamp) - at_rest for each in messages] == [0, TURN, 2 * TURN]
    (contact,) = messages[0].contacts
    assert messages[0].header.frame_id == 'world'
    names = (contact.collision1.name, contact.collision2.name)
    assert names == ('r::base::box_collision', 'ground::link::collision')
    assert contact.collision1.type == Entity.COLLISION
    assert sum(each.body_1_wrench.force.z for each in contact.wrenches) == pytest.approx(WEIGHT)
    assert sum(each.body_2_wrench.force.z for each in contact.wrenches) == pytest.approx(-WEIGHT)
    assert len(contact.positions) == len(contact.normals) == len(contact.depths)
    assert {each.z for each in contact.normals} == {1.0}
    host.sensors.remove('r')
    assert host.node.count_publishers('/one/contact') == 0


def test_a_bumper_of_classic_says_at_its_rate_what_touches_it_in_its_frame(start):
    host = start(
        0.3, 'foot', 50.0, ('box_collision',), topic='bumper_states', message=CONTACTS_STATE
    )
    assert not host.lines
    messages = heard(host, ContactsState, '/one/bumper_states', QoSProfile(depth=1000))
    host.turn(5)  # falling; at 20 and 40 ms
    host.world.step(400)
    host.turn(4)
    host.wait(lambda: len(messages) == 4)
    assert [len(each.states) for each in messages] == [0, 0, 1, 1]
    assert {each.header.frame_id for each in messages} == {'one/foot'}
    (state,) = messages[-1].states
    assert state.collision1_name == 'r::base::box_collision'
    assert state.total_wrench.force.z == pytest.approx(WEIGHT)
    # The corners of the box as the link foot has them, 0.5 m before its middle.
    assert {round(each.x, 2) for each in state.contact_positions} == {-0.6, -0.4}
    assert all(abs(each.z) < 1e-3 for each in state.contact_positions)


def sample(frame):
    """Names of odd lengths: what aligns numbers differs with each."""
    points = tuple(
        ContactPoint((i + 0.5, 2.0, 3.0), (0.0, 0.6, 0.8), (4.0, -5.0, float(i)), 1e-3)
        for i in range(3)
    )
    contacts = (
        Contact('a::b::c', 2**40, 'ground::link::collision', 1, points),
        Contact('a::b::Stoßfänger', 7, 'd', 8, points[:1]),
    )
    return ContactsSample(3_000_000_007, frame, contacts)


def vector(message):
    return (message.x, message.y, message.z)


@pytest.mark.parametrize('frame', ['', 'w', 'wo', 'world', 'robot1/bumper'])
@pytest.mark.parametrize(
    ('encode', 'kind'), [(contacts_bytes, Contacts), (contacts_state_bytes, ContactsState)]
)
def test_messages_are_those_that_rclpy_would_make(encode, kind, frame):
    given = sample(frame)
    data = encode(given)
    message = deserialize_message(data, kind)
    assert len(serialize_message(message)) == len(data)
    assert data == encode(given), 'also what is between the fields'
    assert nanoseconds(message.header.stamp) == given.stamp
    assert message.header.frame_id == frame
    found = message.contacts if kind is Contacts else message.states
    for each, contact in zip(found, given.contacts, strict=True):
        forces = [point.force for point in contact.points]
        if kind is Contacts:
            pairs = (each.collision1, each.collision2)
            assert [pair.id for pair in pairs] == [contact.own_id, contact.other_id]
            names = [pair.name for pair in pairs]
            positions, normals = each.positions, each.normals
            assert [vector(w.body_1_wrench.force) for w in each.wrenches] == forces
            opposite = [tuple(-value for value in force) for force in forces]
            assert [vector(w.body_2_wrench.force) for w in each.wrenches] == opposite
        else:
            names = [each.collision1_name, each.collision2_name]
            positions, normals = each.contact_positions, each.contact_normals
            assert [vector(w.force) for w in each.wrenches] == forces
            total = tuple(map(sum, zip(*forces, strict=True)))
            assert vector(each.total_wrench.force) == total
            assert 'time: [3.7]' in each.info
        assert names == [contact.own, contact.other]
        assert [vector(each) for each in positions] == [each.position for each in contact.points]
        assert [vector(each) for each in normals] == [each.normal for each in contact.points]
        assert [*each.depths] == [point.depth for point in contact.points]


def test_what_a_sensor_names_and_is_not_there_is_told(start):
    host = start(0.1, collisions=('bonnet',))
    messages = heard(host, Contacts, '/one/contact', QoSProfile(depth=1000))
    host.turn(3)
    host.wait(lambda: messages)
    assert host.lines == [
        'robot \'r\': sensor "touch": there is no collision "bonnet"; there are: box_collision; '
        'it feels all of link "base"'
    ]


def test_a_sensor_on_a_link_that_touches_nothing_is_told(start):
    (line,) = start(0.1, link='foot').lines
    assert line.endswith('feels nothing: link "foot" has no <collision> that is simulated')
