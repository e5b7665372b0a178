# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The node viewer in a ROS graph: what a page sees of robots, and how it moves them."""

from contextlib import contextmanager
import json
import signal
import struct

from control_msgs.action import GripperCommand
from controller_manager_msgs.msg import ControllerState
from controller_manager_msgs.srv import ListControllers, ListHardwareComponents
from fixtures.sim.driving import AMR
from geometry_msgs.msg import TransformStamped, Twist, TwistStamped
from nav_msgs.msg import Odometry
import numpy as np
import pytest
import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import String
from support.page import Page
from support.running_programs import PATIENCE, Program
from support.sensor_messages import scan
from test_viewer_server import ask, url_of, viewer
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory

from amr_description.bag.reader import BagReader
from amr_description.ros.service_calls import wait_until
from amr_description.viewer.samples import SAMPLE_KIND

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
WHEELS = [
    f'joint_wheel_{place}' for place in ('back_left', 'back_right', 'front_left', 'front_right')
]


CONNECTING = [(0.001, 0.0), (0.0, 0.0)]
"""What :meth:`Host.connected` has a robot commanded."""


class Robot:
    """
    A robot that is nothing but topics, below a namespace.

    ``commands``: what it heard; of what it is commanded while it is connected only that.
    """

    def __init__(self, node, place='', command=TwistStamped):
        self.node = node
        self.place = place
        self.commands = []
        self.is_connected = False
        self._ends = [
            node.create_publisher(String, f'{place}/robot_description', LATCHED),
            node.create_publisher(JointState, f'{place}/joint_states', 10),
            node.create_publisher(Odometry, f'{place}/odom', 10),
        ]
        self.description, self.joint_states, self.odometry = self._ends
        self._heard = None
        self.hear_commands(command)
        self.description.publish(String(data=AMR))

    def hear_commands(self, kind):
        """Hear commands of this type, and no others."""
        if self._heard is not None:
            self.node.destroy_subscription(self._heard)
        self.commands.clear()
        self._heard = self.node.create_subscription(kind, f'{self.place}/cmd_vel', self._hear, 100)

    def _hear(self, command):
        # The viewer may be late with the last commands of the connection, which are over then.
        if self.commands or not self.is_connected or velocity(command) not in CONNECTING:
            self.commands.append(command)

    @property
    def velocities(self):
        """The commands so far: linear, angular."""
        return [velocity(each) for each in self.commands]

    def vanish(self):
        for end in self._ends:
            self.node.destroy_publisher(end)
        self.node.destroy_subscription(self._heard)


def velocity(command):
    """Linear, angular."""
    twist = getattr(command, 'twist', command)
    return twist.linear.x, twist.angular.z


class Host:
    """The rest of the graph: one node that has robots."""

    def __init__(self):
        self.node = Node('host')

    def until(self, condition):
        """Serve the node until a condition holds; return what it returned."""
        found = wait_until(self.node, lambda: condition() or None, every=60.0, timeout=PATIENCE)
        assert found, 'waited in vain'
        return found

    def connected(self, page, robot):
        """Wait until the page knows the robot, and its commands arrive."""
        self.until(lambda: page.last('model'))
        topic = f'{robot.place}/cmd_vel'
        self.until(lambda: self.node.count_publishers(topic))
        name = robot.place or '/'
        self.until(
            lambda: page.say('drive', robot=name, linear=0.001, angular=0.0) or robot.commands
        )
        page.say('stop', robot=name)
        self.until(lambda: robot.velocities[-1] == (0.0, 0.0))
        page.ask('play', 0, simulator='/none')  # what is answered after that
        self.until(lambda: page.is_told_that_nobody_drives)
        robot.is_connected = True
        robot.commands.clear()


@pytest.fixture(scope='module')
def url():
    with viewer() as program:
        yield url_of(program)
        assert program.end(signal.SIGINT) == 0, program.output
        assert len(program.lines) == 1, program.output


@pytest.fixture
def host(url):
    rclpy.init(args=[])
    host = Host()
    with Page(url) as page:  # the viewer still has the robots of the test before for a moment
        host.until(lambda: (graph := page.last('graph')) and not graph['robots'])
    yield host
    host.node.destroy_node()
    rclpy.try_shutdown()


@contextmanager
def at_rest(host, robot):
    """What happens inside must end with the robot stopped, once, and silence after it."""
    yield
    host.until(lambda: robot.velocities and robot.velocities[-1] == (0.0, 0.0))
    assert robot.velocities.count((0.0, 0.0)) == 1


def endpoints(host, robot):
    """Who publishes commands of a robot, each by its number in DDS."""
    topic = f'{robot.place}/cmd_vel'
    return [bytes(each.endpoint_gid) for each in host.node.get_publishers_info_by_topic(topic)]


def floats(state):
    return np.frombuffer(state, '<f4', offset=16)


def test_a_page_sees_what_a_robot_is(host, url):
    Robot(host.node)
    with Page(url) as page:
        model = host.until(lambda: page.last('model'))
        assert (model['robot'], model['urdf'], model['root']) == ('/', AMR, 'base_footprint')

        def complete():  # its topics are discovered one after the other
            graph = page.last('graph')
            found = [robot for robot in graph['robots'] if robot['odometry'] and robot['command']]
            return found and graph

        graph = host.until(complete)
        (info,) = graph['robots']
        assert (info['id'], info['name'], info['odometry']) == ('/', 'amr', '/odom')
        assert info['command'] == {
            'topic': '/cmd_vel', 'message': 'geometry_msgs/msg/TwistStamped'
        }  # fmt: skip
        assert (graph['hint'], info['truth'], info['manager']) == (None, None, None)


def test_a_page_sees_what_moves(host, url):
    robot = Robot(host.node)
    frames = host.node.create_publisher(TFMessage, '/tf', 10)
    clock = host.node.create_publisher(Clock, '/clock', 10)
    transform = TransformStamped(child_frame_id='base_footprint')
    transform.header.frame_id = 'odom'
    transform.transform.translation.x = 3.5
    transform.transform.translation.z = 1e300  # not logged either
    odometry = Odometry()
    odometry.pose.pose.position.y = -2.0
    odometry.twist.twist.linear.x = 0.25
    odometry.twist.twist.linear.y = -0.5
    time = Clock()
    time.clock.sec = 10_000  # so that it is seen to go back, however late

    def publish():
        time.clock.sec += 1
        clock.publish(time)
        frames.publish(TFMessage(transforms=[transform]))
        robot.odometry.publish(odometry)
        robot.joint_states.publish(JointState(name=['x', WHEELS[1]], position=[9.0, 0.5]))

    def complete():
        publish()
        layout = page.last('layout')
        if not page.states or not layout or not layout['frames'] or not layout['robots']:
            return None
        joints = layout['robots'][0]['joints']
        if not joints:  # its description has not come yet
            return None
        state = page.states[-1]
        if struct.unpack_from('<H', state, 2)[0] != layout['id']:
            return None
        if struct.unpack_from('<d', state, 8)[0] > time.clock.sec:  # that of the system, as yet
            return None
        values = floats(state)
        # Of each topic: they are found one after the other.
        known = values[[0, 7 + joints.index(WHEELS[1]), 19]]
        return None if np.isnan(known).any() else (layout, values)

    with Page(url) as page:
        layout, values = host.until(complete)
        assert layout['frames'] == [{'name': 'base_footprint', 'parent': 'odom'}]
        joints = layout['robots'][0]['joints']
        assert sorted(joints) == WHEELS
        assert values[:7].tolist() == [3.5, 0, np.inf, 0, 0, 0, 1]
        positions, speeds = values[7:11], values[11:19]
        assert positions[joints.index(WHEELS[1])] == 0.5
        assert np.isnan(positions).sum() == 3
        assert np.isnan(speeds).all()  # neither measured nor commanded
        assert values[19:29].tolist() == [0, -2, 0, 0, 0, 0, 1, 0.25, 0, -0.5]
        assert np.isnan(values[29:39]).all()  # no simulator, no truth
        numbers = [struct.unpack_from('<I', state, 4)[0] for state in page.states]
        assert numbers == sorted(set(numbers))
        now = struct.unpack_from('<d', page.states[-1], 8)[0]
        assert 0 < now <= time.clock.sec
        time.clock.sec = 0
        host.until(lambda: publish() or page.last('reset'))
        count = len(page.states)
        host.until(lambda: publish() or len(page.states) > count)


def test_a_sensor_is_heard_while_a_page_shows_it(host, url):
    """By one subscription, whose message comes as it was published."""
    robot = Robot(host.node)
    lidar = host.node.create_publisher(LaserScan, '/front/scan', 10)
    wanted = {'topic': '/front/scan', 'robot': '/', 'kind': 'scan'}
    with Page(url) as page, Page(url) as other:
        for each in (page, other):
            host.until(lambda each=each: (each.last('graph') or {}).get('sensors'))
            (info,) = each.last('graph')['sensors']
            assert wanted.items() <= info.items()
        assert lidar.get_subscription_count() == 0
        for each in (page, other):
            each.say('watch', parts=[], topics=['/front/scan'])
        host.until(lambda: lidar.get_subscription_count() == 1)
        host.until(lambda: lidar.publish(scan('laser')) or samples(page) and samples(other))
        head, ranges = samples(page)[-1]
        assert (head['origin']['frame'], ranges) == ('laser', [1.0, 2.0])
        page.say('watch', parts=[], topics=[])
        other.ask('play', 1, simulator='/none')
        assert lidar.get_subscription_count() == 1
        other.close()
        host.until(lambda: lidar.get_subscription_count() == 0)
        host.node.destroy_publisher(lidar)
        host.until(lambda: page.last('graph')['sensors'] == [])
    robot.vanish()


def samples(page):
    """Head and numbers of each sample of a sensor so far."""
    found = []
    for frame in [*page.states]:
        if frame[0] == SAMPLE_KIND:
            end = 4 + struct.unpack_from('<H', frame, 2)[0]
            found.append((json.loads(frame[4:end]), np.frombuffer(frame[end:], '<f4').tolist()))
    return found


def test_frames_of_a_robot_with_a_tf_of_its_own_are_called_after_it(host, url):
    """As Nav2 has them, of several robots: /tf is remapped to tf, and all say 'odom'."""
    transform = TransformStamped(child_frame_id='base_footprint')
    transform.header.frame_id = 'odom'
    for place in ('/r1', '/r2'):
        Robot(host.node, place)
        publisher = host.node.create_publisher(TFMessage, f'{place}/tf_static', LATCHED)
        publisher.publish(TFMessage(transforms=[transform]))
    with Page(url) as page:
        frames = [
            {'name': f'{name}/base_footprint', 'parent': f'{name}/odom'} for name in ('r1', 'r2')
        ]
        host.until(lambda: (layout := page.last('layout')) and layout['frames'] == frames)


def test_a_page_drives_and_stops(host, url):
    robot = Robot(host.node)
    with Page(url) as page:
        host.connected(page, robot)
        with at_rest(host, robot):
            page.say('drive', robot='/', linear=0.5, angular=-0.25)
            host.until(lambda: robot.commands)
            page.say('stop', robot='/')
        assert robot.velocities[0] == (0.5, -0.25)
        header = robot.commands[0].header
        assert header.frame_id == 'base_link'
        age = host.node.get_clock().now().nanoseconds * 1e-9 - header.stamp.sec
        assert 0 <= age < PATIENCE


def test_commands_are_stamped_with_the_time_of_the_simulation(host, url):
    robot = Robot(host.node)
    clock = host.node.create_publisher(Clock, '/clock', 10)
    time = Clock()
    time.clock.sec, time.clock.nanosec = 12, 500
    with Page(url) as page:
        host.connected(page, robot)

        def stamp():
            clock.publish(time)
            page.say('drive', robot='/', linear=0.1, angular=0.0)
            return robot.commands and robot.commands[-1].header.stamp == time.clock

        host.until(stamp)
        host.node.destroy_publisher(clock)  # the simulation ends, the robot is a real one now
        since = host.node.get_clock().now().nanoseconds

        def stamp_of_now():
            page.say('drive', robot='/', linear=0.1, angular=0.0)
            return Time.from_msg(robot.commands[-1].header.stamp).nanoseconds >= since

        host.until(stamp_of_now)
        assert page.last('reset') is None
        clock = host.node.create_publisher(Clock, '/clock', 10)
        time.clock.sec = 3  # another simulation
        host.until(lambda: clock.publish(time) or page.last('reset'))
        host.until(stamp)


def test_a_stop_arrives_while_the_topics_of_the_robot_change(host, url):
    """The publisher of commands stays: a new one would lose what it says before it is known."""
    robot = Robot(host.node)
    with Page(url) as page:
        host.connected(page, robot)
        (ours,) = endpoints(host, robot)
        page.say('drive', robot='/', linear=0.5, angular=0.0)
        truth = host.node.create_publisher(Odometry, '/ground_truth/odom', 10)
        host.until(lambda: (g := page.last('graph')['robots']) and g[0]['truth'])
        page.say('stop', robot='/')
        host.until(lambda: robot.velocities[-1:] == [(0.0, 0.0)])
        assert endpoints(host, robot) == [ours]
        host.node.destroy_publisher(truth)


def test_who_wants_a_plain_twist_gets_one(host, url):
    robot = Robot(host.node, command=Twist)
    with Page(url) as page:
        host.connected(page, robot)
        page.say('drive', robot='/', linear=0.5, angular=0.0)
        host.until(lambda: (0.5, 0.0) in robot.velocities)


def test_a_robot_that_wants_another_type_from_now_on_gets_it(host, url):
    robot = Robot(host.node)
    with Page(url) as page:
        host.connected(page, robot)
        robot.hear_commands(Twist)
        host.until(
            lambda: (
                page.say('drive', robot='/', linear=0.5, angular=0.0)
                or (0.5, 0.0) in robot.velocities
            )
        )


@pytest.mark.parametrize('ending', ['silence', 'close', 'vanish', 'rubbish', 'stop all'])
def test_whatever_ends_a_drive_stops_the_robot(host, url, ending):
    robot = Robot(host.node)
    with Page(url) as watcher, Page(url) as driver:
        host.connected(driver, robot)
        with at_rest(host, robot):
            driver.say('drive', robot='/', linear=0.5, angular=0.0)
            host.until(lambda: robot.commands)
            match ending:
                case 'close':
                    driver.close()
                case 'vanish':
                    driver.vanish()
                case 'rubbish':
                    driver.socket.send('{')
                case 'stop all':
                    watcher.say('stop', robot=None)
        host.until(lambda: watcher.is_told_that_nobody_drives)


def test_the_end_of_the_viewer_stops_the_robot_and_completes_its_bag(host, tmp_path):
    robot = Robot(host.node)
    with viewer('port:=0', f'bag_folder:={tmp_path}') as program, Page(url_of(program)) as page:
        host.connected(page, robot)
        reply = page.ask('start_recording', 1, topics=[])
        assert reply['ok'], reply['message']
        host.until(lambda: page.last('bag_writing')['messages'])
        with at_rest(host, robot):
            page.say('drive', robot='/', linear=0.5, angular=0.0)
            host.until(lambda: robot.commands)
            program.signal(signal.SIGTERM)
        assert program.end() == 0
    (folder,) = tmp_path.iterdir()
    with BagReader(folder) as reader:
        assert not reader.is_rebuilt
        assert [*reader.messages()]


def test_one_page_drives_at_a_time_and_all_know_which(host, url):
    robot = Robot(host.node)
    with Page(url) as first, Page(url) as second:
        host.connected(first, robot)
        host.until(lambda: second.last('model'))

        def drive():
            first.say('drive', robot='/', linear=0.5, angular=0.0)
            second.say('drive', robot='/', linear=-1.0, angular=0.0)
            return second.last('notice')

        notice = host.until(drive)
        name = first.last('hello')['client']
        assert notice['text'].startswith(f'{name} drives /')
        assert name in [each['client'] for each in second.of('driver')]
        assert (-1.0, 0.0) not in robot.velocities
        second.say('stop', robot='/')
        host.until(lambda: (0.0, 0.0) in robot.velocities)
        assert host.until(lambda: first.last('driver')['stopped']) == name
        host.until(
            lambda: (
                second.say('drive', robot='/', linear=-1.0, angular=0.0)
                or (-1.0, 0.0) in robot.velocities
            )
        )


def test_sliders_move_the_joints_of_a_joint_state_publisher(host, url, tmp_path):
    robot = Robot(host.node)
    heard = []
    host.node.destroy_publisher(robot.joint_states)
    host.node.create_subscription(JointState, '/joint_states', heard.append, 10)
    with Program.module('joint_state_publisher') as program, Page(url) as page:

        def moved():
            graph = page.last('graph')
            if graph and graph['robots'] and graph['robots'][0]['joint_publisher']:
                page.say('set_joints', robot='/', positions={WHEELS[0]: 1.25})
            return any(1.25 in message.position for message in heard)

        host.until(moved)
        assert page.last('graph')['robots'][0]['joint_publisher'] == '/joint_state_publisher'
        assert program.end(signal.SIGINT) == 0


@contextmanager
def manager_of(node, *controllers):
    """A controller manager ``/arm/controller_manager`` that lists these as active."""
    listed = [
        ControllerState(name=name, state='active', claimed_interfaces=claims)
        for name, claims in controllers
    ]

    def list_controllers(_request, response):
        response.controller = listed
        return response

    place = '/arm/controller_manager'
    services = [
        node.create_service(ListControllers, f'{place}/list_controllers', list_controllers),
        node.create_service(
            ListHardwareComponents,
            f'{place}/list_hardware_components',
            lambda _, response: response,
        ),
    ]
    yield
    for service in services:
        node.destroy_service(service)


def test_sliders_move_joints_by_controllers_and_a_stop_holds_them(host, url):
    robot = Robot(host.node, '/arm')
    left, right, finger, _ = WHEELS
    heard, grips = [], []
    arm = ('mover', [f'{left}/position', f'{right}/position'])
    hand = ('hand', [f'{finger}/position'])
    host.node.create_subscription(JointTrajectory, '/arm/mover/joint_trajectory', heard.append, 10)
    server = ActionServer(
        host.node,
        GripperCommand,
        '/arm/hand/gripper_cmd',
        lambda _: GripperCommand.Result(),
        goal_callback=lambda goal: grips.append(goal.command.position) or GoalResponse.REJECT,
    )
    with manager_of(host.node, arm, hand), Page(url) as page:

        def moves():
            listed = page.last('controllers')
            return [each['moves'] for each in listed['controllers']] if listed else []

        host.until(lambda: moves() == [[left, right], [finger]])
        # Else goals come from a client that cannot be answered yet.
        host.until(lambda: host.node.count_subscribers('/arm/hand/gripper_cmd/_action/feedback'))

        def moved():
            robot.joint_states.publish(
                JointState(name=[left, right, finger], position=[0.25, -0.5, 0.0])
            )
            page.say('set_joints', robot='/arm', positions={left: 1.0, finger: 0.5})
            return heard and 0.5 in grips

        host.until(moved)
        (point,) = heard[-1].points
        assert (heard[-1].joint_names, [*point.positions]) == ([left, right], [1.0, -0.5])
        assert Duration.from_msg(point.time_from_start).nanoseconds == pytest.approx(0.75e9)
        page.say('stop', robot=None)
        host.until(lambda: [*heard[-1].points[0].positions] == [0.25, -0.5] and grips[-1] == 0.0)
    server.destroy()
    robot.vanish()


def test_several_robots_come_and_go(host, url):
    first, second = Robot(host.node, '/r1'), Robot(host.node, '/r2')
    with Page(url) as page:

        def ids():
            graph = page.last('graph')
            return graph and [robot['id'] for robot in graph['robots']]

        host.until(lambda: ids() == ['/r1', '/r2'])
        host.connected(page, second)
        page.say('drive', robot='/r2', linear=0.5, angular=0.0)
        host.until(lambda: (0.5, 0.0) in second.velocities)
        assert first.velocities == []
        first.vanish()
        host.until(lambda: ids() == ['/r2'])
        host.until(lambda: [r['id'] for r in page.last('layout')['robots']] == ['/r2'])
        with Page(url) as late:
            host.until(lambda: late.last('layout') and late.last('model'))
            assert [model['robot'] for model in late.of('model')] == ['/r2']


def test_nothing_is_subscribed_while_nobody_looks(host, url):
    Robot(host.node)

    def are_heard():
        topics = ('/joint_states', '/robot_description', '/tf')
        return [host.node.count_subscribers(each) > 0 for each in topics]

    with Page(url) as page:
        host.until(lambda: page.last('model'))
        host.until(lambda: all(are_heard()))
    host.until(lambda: not any(are_heard()))


def test_meshes_are_served_while_a_description_names_them(host, url, tmp_path):
    mesh = tmp_path / 'part.stl'
    mesh.write_bytes(b'solid part')
    urdf = AMR.replace('</robot>', '')
    urdf += (
        f'<link name="part"><visual><geometry><mesh filename="file://{mesh}"/></geometry>'
        '</visual></link><joint name="to_part" type="fixed"><parent link="base_link"/>'
        '<child link="part"/></joint></robot>'
    )
    robot = Robot(host.node)
    robot.description.publish(String(data=urdf))
    with Page(url) as page:
        (path,) = host.until(lambda: (m := page.last('model')) and [*m['meshes'].values()])
        status, headers, body = ask(url, path=path)
        assert (status, body) == (200, 'solid part')
        assert headers['Content-Type'] == 'model/stl'
        assert 'immutable' in headers['Cache-Control']
        assert ask(url, path=f'/mesh/{mesh.name}')[0] == 404
        robot.description.publish(String(data=AMR))
        host.until(lambda: page.last('model')['urdf'] == AMR)
        assert ask(url, path=path)[0] == 404
