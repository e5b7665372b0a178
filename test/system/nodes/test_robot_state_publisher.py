# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""robot_state_publisher over real DDS: topics, QoS, stamps, parameters, refusals."""

import math
import signal

from builtin_interfaces.msg import Time
import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from support.paths import ROOT, TESTS
from support.running_programs import Program
from tf2_msgs.msg import TFMessage

from amr_description.nodes.robot_state_publisher import RobotStatePublisher
from amr_description.nodes.robot_state_publisher.robot_state import JointThrottle
from amr_description.ros.messages import nanoseconds
from amr_description.ros.runtime import spinning
from amr_description.ros.service_calls import wait_until

AMR = ROOT / 'urdf/amr.urdf'
GRIPPER = TESTS / 'fixtures/urdf/gripper.urdf.xacro'
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
TWO_LINKS = """
<robot name="test">
  <link name="link1"/>
  <joint name="joint1" type="{kind}">
    <parent link="link1"/><child link="link2"/>
    <origin xyz="{x} 0 0" rpy="0 0 1.57"/><axis xyz="0 0 1"/>
  </joint>
  <link name="link2"/>
</robot>
"""


class Listener(Node):
    """What a TF listener and a robot see of the node."""

    def __init__(self):
        super().__init__('listener')
        self.descriptions, self.static, self.moving = [], [], []
        self.create_subscription(String, 'robot_description', self.hear_description, LATCHED)
        self.create_subscription(TFMessage, '/tf_static', self.static.append, LATCHED)
        self.create_subscription(TFMessage, '/tf', self.moving.append, 100)
        self.joint_states = self.create_publisher(JointState, 'joint_states', 10)
        self.clock = self.create_publisher(Clock, '/clock', 10)

    def hear_description(self, message):
        self.descriptions.append(message.data)

    def until(self, condition):
        """Serve the node until ``condition()`` is true."""
        assert wait_until(
            self, lambda: condition() or None, lambda: None, every=60.0, timeout=20.0
        ), 'waited in vain'

    def say(self, *, name=('joint1',), position=(math.pi,), stamp=(5, 0)):
        """Publish a joint state."""
        message = JointState(name=list(name), position=list(position))
        message.header.stamp = Time(sec=stamp[0], nanosec=stamp[1])
        self.joint_states.publish(message)

    def set_clock(self, node, time):
        """Publish /clock until ``node`` has this time."""

        def has_it():
            self.clock.publish(Clock(clock=time))
            return node.get_clock().now().to_msg() == time

        self.until(has_it)

    def hear(self, stamp, **joint_state):
        """Publish a joint state until its stamp is heard on /tf; return these transforms."""
        time = Time(sec=stamp[0], nanosec=stamp[1])
        heard = []

        def is_heard():
            self.say(stamp=stamp, **joint_state)
            heard.extend(m for m in self.moving if m.transforms[0].header.stamp == time)
            return heard

        self.until(is_heard)
        return heard[0].transforms


@pytest.fixture
def listener():
    rclpy.init(args=[])
    node = Listener()
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def start(listener, tmp_path):
    """Start the node on a description, in a thread; wait until the two have found each other."""
    running = []

    def start_node(urdf, **parameters):
        rows = {'robot_description': urdf} | parameters
        arguments = [Parameter(name, value=value) for name, value in rows.items()]
        node = RobotStatePublisher(parameter_overrides=arguments)
        spinner = spinning(node)
        spinner.__enter__()
        running.append(spinner)
        listener.until(lambda: listener.static and listener.descriptions)
        listener.until(lambda: listener.joint_states.get_subscription_count())
        return node

    yield start_node
    for spinner in running:
        spinner.__exit__(None, None, None)


def place(transform):
    """Return frames and translation of a TransformStamped."""
    xyz = transform.transform.translation
    frames = (transform.header.frame_id, transform.child_frame_id)
    return (*frames, pytest.approx((xyz.x, xyz.y, xyz.z), abs=0.01))


def test_latecomers_get_description_and_fixed_joints(start, listener):
    urdf = TWO_LINKS.format(kind='fixed', x=5)
    start(urdf)
    assert listener.descriptions == [urdf]
    (message,) = listener.static
    (transform,) = message.transforms
    assert place(transform) == ('link1', 'link2', (5.0, 0.0, 0.0))
    assert transform.transform.rotation.z == pytest.approx(math.sin(1.57 / 2))
    assert transform.header.stamp.sec > 0


def test_the_topics_have_the_known_qos(start, listener):
    node = start(TWO_LINKS.format(kind='fixed', x=5))

    def qos(topic, find=listener.get_publishers_info_by_topic):
        (info,) = [i for i in find(topic) if i.node_name == 'robot_state_publisher']
        return info.qos_profile.reliability, info.qos_profile.durability

    reliable, best_effort = ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT
    volatile, latched = DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL
    assert qos('/robot_description') == (reliable, latched)
    assert qos('/tf_static') == (reliable, latched)
    assert qos('/tf') == (reliable, volatile)
    heard = qos('/joint_states', listener.get_subscriptions_info_by_topic)
    assert heard == (best_effort, volatile)
    assert node.get_parameter('qos_overrides./joint_states.subscription.depth').value == 5


def test_moving_joints_carry_the_stamp_of_their_joint_state(start, listener):
    start(TWO_LINKS.format(kind='continuous', x=5))
    (transform,) = listener.hear(position=[math.pi], stamp=(5, 7))
    assert place(transform) == ('link1', 'link2', (5.0, 0.0, 0.0))
    assert transform.transform.rotation.z == pytest.approx(math.sin((1.57 + math.pi) / 2))
    assert transform.header.stamp == Time(sec=5, nanosec=7)


def test_a_zero_stamp_means_now(start, listener):
    node = start(TWO_LINKS.format(kind='continuous', x=5))
    before = node.get_clock().now().to_msg().sec
    listener.until(lambda: listener.say(stamp=(0, 0)) or listener.moving)
    assert listener.moving[0].transforms[0].header.stamp.sec >= before > 0


def test_the_first_50_ms_of_simulated_time_are_published(start, listener):
    start(TWO_LINKS.format(kind='continuous', x=5))
    (transform,) = listener.hear(stamp=(0, 1_000_000))
    assert transform.header.stamp == Time(nanosec=1_000_000)


def test_every_message_comes_through_with_ignore_timestamp(start, listener):
    start(TWO_LINKS.format(kind='continuous', x=5), ignore_timestamp=True)
    for stamp in [(5, 0), (5, 1), (4, 900_000_000), (4, 800_000_000)]:
        assert len(listener.hear(stamp)) == 1


def test_which_messages_are_published_depends_on_their_stamps_alone(start, listener):
    """Also on those that have waited while nobody looked for them."""
    start(TWO_LINKS.format(kind='continuous', x=5))
    listener.hear((10, 0))
    throttle, expected = JointThrottle(), []
    throttle.note(['joint1'], 10 * 10**9, 50_000_000)

    def stamps():
        return [nanoseconds(each.transforms[0].header.stamp) for each in listener.moving]

    for number in range(1, 61):
        stamp = 10 * 10**9 + number * 10_000_000
        if throttle.admit(['joint1'], stamp):
            throttle.note(['joint1'], stamp, 50_000_000)
            expected.append(stamp)
        listener.say(stamp=divmod(stamp, 10**9))
        if expected[-1:] == [stamp]:  # five wait in a queue, and every fifth is published
            listener.until(lambda: stamps()[-1] == expected[-1])
    assert [each for each in stamps() if each > 10 * 10**9] == expected


def test_frames_get_the_prefix_as_it_is(start, listener):
    node = start(AMR.read_text(), frame_prefix='my_prefix/')
    (transform,) = listener.static[0].transforms
    assert transform.header.frame_id == 'my_prefix/base_footprint'
    (transform,) = listener.hear((5, 0), name=['joint_wheel_front_left'], position=[0.0])
    assert transform.child_frame_id == 'my_prefix/wheel_front_left'
    assert node.set_parameters([Parameter('frame_prefix', value='')])[0].successful
    listener.until(lambda: len(listener.static) == 2)
    assert listener.static[1].transforms[0].header.frame_id == 'base_footprint'


def test_unusable_joint_states_are_told_and_the_next_one_counts(start, listener, capfd):
    start(TWO_LINKS.format(kind='continuous', x=5))
    listener.say(name=['joint1'], position=[])
    listener.say(name=['joint1', 'joint2'], position=[1.0])
    listener.say(name=['unknown'], position=[1.0])
    (transform,) = listener.hear(stamp=(-3, 0))
    assert transform.header.stamp.sec == -3
    error = capfd.readouterr().err
    assert 'JointState message about joint(s) "joint1" whose position member was empty.' in error
    assert '[ERROR]' in error
    assert 'Robot state publisher ignored an invalid JointState message' in error


def test_time_going_back_starts_anew(start, listener, capfd):
    node = start(TWO_LINKS.format(kind='continuous', x=5), use_sim_time=True)
    for seconds in (100, 3):
        listener.set_clock(node, Time(sec=seconds))
        listener.hear((seconds, 0))
    warning = 'Moved backwards in time, re-publishing joint transforms!'
    assert warning in capfd.readouterr().err


def test_stamps_that_go_back_start_anew_whatever_the_clock(start, listener):
    """The clock is read by what comes; after a rest it may be past its last time already."""
    node = start(TWO_LINKS.format(kind='continuous', x=5), use_sim_time=True)
    listener.set_clock(node, Time(nanosec=100_000_000))
    listener.hear((0, 400_000_000))
    (transform,) = listener.hear((0, 10_000_000))
    assert transform.header.stamp.nanosec == 10_000_000


def test_what_was_on_its_way_when_time_went_back_holds_nothing_up(start, listener):
    """A message of before, in the middle of the times that come again."""
    node = start(TWO_LINKS.format(kind='continuous', x=5), use_sim_time=True)
    listener.set_clock(node, Time(nanosec=500_000_000))
    listener.hear((0, 500_000_000))
    listener.set_clock(node, Time(nanosec=1))
    listener.say(stamp=(0, 490_000_000))
    (transform,) = listener.hear((0, 10_000_000))
    assert transform.header.stamp.nanosec == 10_000_000


def test_a_new_description_replaces_the_old_one(start, listener):
    node = start(TWO_LINKS.format(kind='fixed', x=5))
    new = TWO_LINKS.format(kind='fixed', x=10)
    assert node.set_parameters([Parameter('robot_description', value=new)])[0].successful
    listener.until(lambda: len(listener.static) == 2 and len(listener.descriptions) == 2)
    assert listener.descriptions[-1] == new
    assert place(listener.static[-1].transforms[0]) == ('link1', 'link2', (10.0, 0.0, 0.0))


def test_a_robot_without_joints_replaces_one_with_a_mimic_on_a_fixed_joint(start, listener):
    mimic = '<mimic joint="joint1"/></joint>'
    node = start(TWO_LINKS.format(kind='fixed', x=5).replace('</joint>', mimic))
    lone = "<robot name='test'><link name='base_link'/></robot>"
    assert node.set_parameters([Parameter('robot_description', value=lone)])[0].successful
    listener.until(lambda: len(listener.static) == 2)
    assert listener.static[-1].transforms == []


@pytest.mark.parametrize(
    ('name', 'value', 'reason'),
    [
        ('robot_description', '', 'Empty URDF is not allowed'),
        ('robot_description', '<robot', 'Unable to initialize urdf::model from robot description'),
        ('robot_description', '<robot name="x"/>', 'Unable to initialize urdf::model'),
        ('publish_frequency', 1000.5, 'publish_frequency must be between 0.0 and 1000.0'),
        ('publish_frequency', -1.0, 'publish_frequency must be between 0.0 and 1000.0'),
    ],
)
def test_what_cannot_be_used_is_refused_and_the_old_value_kept(
    start, listener, name, value, reason
):
    node = start(TWO_LINKS.format(kind='continuous', x=5))
    before = node.get_parameter(name).value
    result = node.set_parameters([Parameter(name, value=value)])[0]
    assert not result.successful
    assert result.reason.startswith(reason)
    assert node.get_parameter(name).value == before
    assert len(listener.hear((5, 0))) == 1
    assert len(listener.descriptions) == 1


def test_publish_frequency_can_be_changed_while_it_runs(start, listener):
    node = start(TWO_LINKS.format(kind='continuous', x=5), publish_frequency=1.0)
    listener.hear(stamp=(5, 0))
    assert node.set_parameters([Parameter('publish_frequency', value=1000.0)])[0].successful
    (transform,) = listener.hear(stamp=(5, 1_000_000))
    assert transform.header.stamp.nanosec == 1_000_000


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        ([], 'robot_description parameter must not be empty'),
        (['/nowhere/amr.urdf'], '/nowhere/amr.urdf'),
        (['package://nowhere/amr.urdf'], "package 'nowhere' is not found"),
        (
            [str(GRIPPER), 'palm:=perhaps'],
            'gripper.urdf.xacro:17: Xacro conditional "$(arg palm)" evaluated',
        ),
        (['--ros-args', '-p', 'robot_description:=<robot/>'], 'Unable to initialize urdf::model'),
        ([str(AMR), '--ros-args', '-p', 'publish_frequency:=-1.0'], 'must be between 0.0'),
    ],
)
def test_it_does_not_start_on_what_it_cannot_use(arguments, words):
    with Program.module('robot_state_publisher', *arguments) as node:
        assert node.end() == 1
        (fatal,) = [line for line in node.lines if '[FATAL]' in line]
        assert words in fatal
        assert 'Traceback' not in node.output


@pytest.mark.parametrize('file', [str(AMR), 'package://amr_description/urdf/amr.urdf'])
def test_it_takes_a_file_as_its_argument_and_says_so(file):
    with Program.module('robot_state_publisher', file) as node:
        node.expect('No robot_description parameter, but command-line argument available')
        node.expect(r'\[INFO\] \[[\d.]+\] \[robot_state_publisher\]: Robot initialized')
        assert node.end(signal.SIGINT) == 0


def test_it_takes_a_xacro_file_and_its_arguments_which_are_no_remapping_rules(listener):
    with Program.module(
        'robot_state_publisher', str(GRIPPER), 'palm:=false', 'frame:=x', '--ros-args'
    ) as node:
        node.expect('Robot initialized')
        assert 'nothing asks for "frame"; its arguments: "finger_length", "palm"' in node.output
        assert 'remap rule' not in node.output
        listener.until(lambda: listener.descriptions)
        assert 'name="wrist"' in listener.descriptions[0]
        assert 'palm' not in listener.descriptions[0].partition('<robot')[2]
        assert node.end(signal.SIGINT) == 0


def test_ctrl_c_ends_the_expansion_of_a_bomb(tmp_path):
    bomb = tmp_path / 'bomb.xacro'
    endless = '${[0 for a in range(10**9) for b in range(10**9)]}'
    bomb.write_text(
        '<robot name="bomb" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        f'${{xacro.message("expanding")}}<link name="{endless}"/></robot>'
    )
    with Program.module('robot_state_publisher', str(bomb)) as node:
        node.expect('expanding')
        assert node.end(signal.SIGINT) == 0
