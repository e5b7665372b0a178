# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""joint_state_publisher over real DDS: topics, sources, descriptions, parameters, refusals."""

import signal

import pytest
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from support.paths import TESTS
from support.running_programs import Program

from amr_description.nodes.joint_state_publisher import JointStatePublisher
from amr_description.ros.runtime import spinning
from amr_description.ros.service_calls import wait_until

GRIPPER = TESTS / 'fixtures/urdf/gripper.urdf.xacro'
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LIMIT = '<limit lower="0.5" upper="1.5" effort="1" velocity="1"/>'
CART = """
<robot name="cart">
  <link name="base"/><link name="wheel"/><link name="mast"/>
  <joint name="axle" type="continuous"><parent link="base"/><child link="wheel"/></joint>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="mast"/>{}</joint>
</robot>
"""
SETTER = '/joint_state_publisher/set_joint_positions'


class Observer(Node):
    """Who moves the joints, and who sees them."""

    def __init__(self):
        super().__init__('observer')
        self.heard = []
        self.create_subscription(JointState, 'joint_states', self.heard.append, 10)
        self.description = self.create_publisher(String, 'robot_description', LATCHED)
        self.movers = {
            topic: self.create_publisher(JointState, topic, 10) for topic in (SETTER, '/arm')
        }

    def until(self, condition):
        """Serve the node until ``condition()`` is true."""
        assert wait_until(
            self, lambda: condition() or None, lambda: None, every=60.0, timeout=20.0
        ), f'waited in vain; heard last: {self.heard[-1:]}'

    def describe(self, text):
        """Latch a description."""
        self.description.publish(String(data=text))

    def move(self, topic, **joints):
        """Publish positions."""
        message = JointState(name=list(joints), position=list(joints.values()))
        self.movers[topic].publish(message)

    def positions(self):
        """Return the latest joint state heard, as a dictionary."""
        last = self.heard[-1] if self.heard else JointState()
        return dict(zip(last.name, last.position, strict=True))

    def sees(self, **positions):
        """Wait until these joints stand there."""
        wanted = {name: pytest.approx(value) for name, value in positions.items()}
        self.until(lambda: self.positions() == wanted)


@pytest.fixture
def observer():
    rclpy.init(args=[])
    node = Observer()
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def start(observer):
    """Start the node in a thread."""
    running = []

    def start_node(*description, **parameters):
        rows = {'rate': 100} | parameters
        overrides = [Parameter(name, value=value) for name, value in rows.items()]
        node = JointStatePublisher(description, parameter_overrides=overrides)
        spinner = spinning(node)
        spinner.__enter__()
        running.append(spinner)
        return node

    yield start_node
    for spinner in running:
        spinner.__exit__(None, None, None)


def test_a_description_from_the_topic_makes_joint_states(start, observer):
    start(**{'zeros.axle': 0.25})
    observer.describe(CART.format(LIMIT))
    observer.sees(axle=0.25, hinge=1.0)
    message = observer.heard[-1]
    assert list(message.name) == ['axle', 'hinge']
    assert (list(message.velocity), list(message.effort)) == ([], [])
    assert message.header.frame_id == ''
    assert message.header.stamp.sec > 0


def test_the_topics_have_the_known_qos(start, observer):
    start(source_list=['/arm'])

    def qos(topic, find):
        (info,) = [i for i in find(topic) if i.node_name == 'joint_state_publisher']
        return info.qos_profile.reliability, info.qos_profile.durability

    heard = observer.get_subscriptions_info_by_topic
    observer.until(lambda: observer.count_publishers('/joint_states'))
    observer.until(lambda: all(observer.count_subscribers(t) for t in (SETTER, '/arm')))
    observer.until(lambda: observer.count_subscribers('/robot_description'))
    reliable = ReliabilityPolicy.RELIABLE
    plain = (reliable, DurabilityPolicy.VOLATILE)
    assert qos('/joint_states', observer.get_publishers_info_by_topic) == plain
    assert qos(SETTER, heard) == qos('/arm', heard) == plain
    assert qos('/robot_description', heard) == (reliable, DurabilityPolicy.TRANSIENT_LOCAL)


def test_a_xacro_file_with_arguments_and_movers(start, observer):
    start(str(GRIPPER), 'palm:=false', source_list=['/arm'])
    observer.sees(
        wrist=0.0, left_knuckle=0.0, left_tip=0.001, right_knuckle=0.05, right_tip=0.0015
    )
    observer.until(lambda: all(p.get_subscription_count() for p in observer.movers.values()))
    observer.move(SETTER, wrist=0.5)
    observer.move('/arm', left_knuckle=0.2, right_tip=9.0, unknown=1.0)
    observer.sees(
        wrist=0.5, left_knuckle=0.2, left_tip=0.003, right_knuckle=-0.15, right_tip=-0.0005
    )


def test_an_unusable_description_is_told_and_the_old_one_kept(start, observer, stderr):
    start()
    observer.describe(CART.format(LIMIT))
    observer.sees(axle=0.0, hinge=1.0)
    observer.describe(CART.format(''))
    observer.until(lambda: 'a revolute joint needs limits' in stderr())
    assert 'robot_description cannot be used, the old one is kept: ' in stderr()
    observer.heard.clear()
    observer.sees(axle=0.0, hinge=1.0)
    observer.describe(CART.format(LIMIT.replace('1.5', '3.5')))
    observer.sees(axle=0.0, hinge=2.0)


def test_the_same_description_again_leaves_the_joints_where_they_are(start, observer):
    start()
    observer.describe(CART.format(LIMIT))
    observer.until(lambda: observer.movers[SETTER].get_subscription_count())
    observer.sees(axle=0.0, hinge=1.0)
    observer.move(SETTER, axle=0.5)
    observer.sees(axle=0.5, hinge=1.0)
    observer.describe(CART.format(LIMIT))
    assert observer.description.wait_for_all_acked(Duration(seconds=20.0))
    observer.move(SETTER, hinge=0.75)  # heard after the description
    observer.sees(axle=0.5, hinge=0.75)


def test_a_message_with_too_few_positions_is_told_and_ignored(start, observer, stderr):
    start(rate=50.0)
    observer.describe(CART.format(LIMIT))
    observer.until(lambda: observer.movers[SETTER].get_subscription_count())
    wrong = JointState(name=['axle', 'hinge'], position=[1.0])

    def is_told():
        # Again and again: the first message of a publisher may find no reader yet.
        observer.movers[SETTER].publish(wrong)
        return 'a JointState with 2 names and 1, 0, 0 positions' in stderr()

    observer.until(is_told)
    observer.move(SETTER, axle=0.5)
    observer.sees(axle=0.5, hinge=1.0)


def test_rate_and_delta_may_be_set_while_it_runs(start, observer):
    node = start(publish_default_velocities=True, rate=1)
    observer.describe(CART.format(LIMIT))
    changes = [Parameter('rate', value=200.0), Parameter('delta', value=0.001)]
    assert all(result.successful for result in node.set_parameters(changes))
    observer.until(lambda: observer.positions().get('axle', 0.0) > 0.05)
    assert list(observer.heard[-1].velocity) == [0.0, 0.0]
    assert node.get_parameter('rate').value == 200.0


@pytest.mark.parametrize(
    ('name', 'value', 'reason'),
    [
        ('rate', 0, "'rate' must be above 0 and at most 1000, found 0"),
        ('rate', 'fast', "'rate' must be above 0"),
        ('delta', -0.1, "'delta' must be at least 0"),
        ('use_mimic_tags', False, 'read-only'),
        ('zeros.axle', 1.0, 'read-only'),
    ],
)
def test_what_cannot_be_set_is_refused(start, name, value, reason):
    node = start(**{'zeros.axle': 0.5})
    before = node.get_parameter(name).value
    (result,) = node.set_parameters([Parameter(name, value=value)])
    assert not result.successful
    assert reason in result.reason
    assert node.get_parameter(name).value == before


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (['/nowhere/arm.urdf'], '/nowhere/arm.urdf'),
        ([str(GRIPPER), 'palm:=perhaps'], 'gripper.urdf.xacro:17: Xacro conditional'),
        (['--ros-args', '-p', 'rate:=0'], "'rate' must be above 0"),
        (['--ros-args', '-p', 'source_list:=[/joint_states]'], 'publishes itself'),
    ],
)
def test_it_does_not_start_on_what_it_cannot_use(arguments, words):
    with Program.module('joint_state_publisher', *arguments) as node:
        assert node.end() == 1
        (fatal,) = [line for line in node.lines if '[FATAL]' in line]
        assert words in fatal
        assert 'Traceback' not in node.output


def test_it_waits_for_a_description_and_ends_quietly_on_ctrl_c():
    with Program.module('joint_state_publisher') as node:
        node.expect('Waiting for robot_description to be published on the robot_description topic')
        assert node.end(signal.SIGINT) == 0
