# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""All sensors of a robot, over DDS: the same bytes in every run, at the instants that are due."""

from collections import defaultdict
from contextlib import contextmanager
import hashlib
import signal
import struct

from fixtures.cli.commands import started
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image, Imu, LaserScan, PointCloud2
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import SetSimulationState
from std_srvs.srv import Trigger
from support.paths import ROOT

from amr_description.model.description_file import description_at

MS = 1_000_000
TOPICS = {
    '/scan': LaserScan,
    '/scan/points': PointCloud2,
    '/camera/image': Image,
    '/camera/depth_image': Image,
    '/camera/points': PointCloud2,
    '/camera/camera_info': CameraInfo,
    '/imu': Imu,
}
PERIODS = {'/imu': 10 * MS}
"""ns, of those that are not of 10 Hz."""

pytest_plugins = ['amr_description.testing.fixtures']
pytestmark = pytest.mark.in_order('one simulation, whose robot is removed at the end')


def description(width, height):
    """Return amr with sensors, the camera's pictures of another size."""
    text = description_at(str(ROOT / 'urdf/amr_sensors.urdf.xacro'), warn=pytest.fail)
    for name, size, given in (('width', 320, width), ('height', 240, height)):
        assert f'<{name}>{size}</{name}>' in text
        text = text.replace(f'<{name}>{size}</{name}>', f'<{name}>{given}</{name}>')
    return text


SMALL = description(32, 24)


class Listener:
    """Hears all sensors of a simulation; the bytes of each message by topic."""

    def __init__(self, sim, topics=TOPICS):
        self.sim, self.types = sim, topics
        self.heard = defaultdict(list)
        self._subscriptions = [
            sim.node.create_subscription(kind, topic, self.heard[topic].append, 1000, raw=True)
            for topic, kind in topics.items()
        ]
        best_effort = self.heard['/scan, best effort']
        self._subscriptions.append(
            sim.node.create_subscription(
                LaserScan, '/scan', best_effort.append, qos_profile_sensor_data, raw=True
            )
        )

    def __enter__(self):
        """Wait until the simulator knows who hears it, and no message is under way."""
        self.sim.wait(
            lambda: all(each.get_publisher_count() for each in self._subscriptions), 'publishers'
        )
        steps = 0
        while not all(self.heard[topic] for topic in self.types):
            self.sim.run(0.1)  # who publishes may know of us later: what was missed comes again
            steps += 1
            assert steps < 300, {topic: len(self.heard[topic]) for topic in self.types}
        self.begin()
        return self

    def __exit__(self, *_error):
        for each in self._subscriptions:
            self.sim.node.destroy_subscription(each)

    def stamps(self, topic):
        """Return those of all messages of a topic, ns: the first field, after 4 bytes of CDR."""
        stamps = (struct.unpack_from('<iI', data, 4) for data in self.heard[topic])
        return [seconds * 1000 * MS + rest for seconds, rest in stamps]

    def begin(self):
        """Reset, when no message is under way."""
        self.sim.run(0.2)
        self.catch_up()
        self.forget()
        self.sim.reset()

    def catch_up(self):
        """Wait for all that was due before the present instant, at which a step will measure."""
        now = round(self.sim.time * 1000) * MS - 1
        for topic in self.types:
            latest = now - now % PERIODS.get(topic, 100 * MS)
            self.sim.wait(lambda t=topic, s=latest: max(self.stamps(t), default=-1) >= s, topic)

    def forget(self):
        for messages in self.heard.values():
            messages.clear()

    def digest(self):
        return {
            topic: hashlib.sha256(b''.join(self.heard[topic])).hexdigest() for topic in self.types
        }

    def drive(self, seconds):
        """Drive an arc from time 0; return the digest of all that was published meanwhile."""
        for _ in range(round(2 * seconds)):
            self.sim.drive(0.4, 0.5, seconds=0.5, stop=False)
        self.catch_up()
        return self.digest()


@contextmanager
def in_real_time(sim):
    """Have time pass by itself, at factor 1."""

    def set_factor(factor):
        client = sim.node.create_client(SetParameters, '/mujoco_sim/set_parameters')
        sim.wait(client.service_is_ready, 'the parameters')
        parameter = Parameter('real_time_factor', value=factor).to_parameter_msg()
        future = client.call_async(SetParameters.Request(parameters=[parameter]))
        sim.wait(future.done, 'the factor')
        sim.node.destroy_client(client)

    set_factor(1.0)
    sim.ask(SetSimulationState, state=SimulationState(state=SimulationState.STATE_PLAYING))
    try:
        yield
    finally:
        sim.ask(SetSimulationState, state=SimulationState(state=SimulationState.STATE_PAUSED))
        set_factor(0.0)
        sim.reset()


@pytest.fixture
def listener(calm_listener):
    calm_listener.begin()
    return calm_listener


@pytest.fixture(scope='module')
def calm_listener(simulation):
    sim = simulation(SMALL, world='warehouse')
    with Listener(sim) as listener:
        yield listener


@pytest.mark.parametrize(
    ('picture', 'seconds'),
    [((32, 24), 1), pytest.param((320, 240), 20, marks=pytest.mark.long)],
)
def test_two_runs_are_byte_equal_noise_included(simulation, picture, seconds):
    sim = simulation(description(*picture), world='warehouse')
    with Listener(sim) as listener:
        first = listener.drive(seconds)
        stamps = {topic: listener.stamps(topic) for topic in TOPICS}
        listener.begin()
        assert listener.drive(seconds) == first
    instants = [number * 100 * MS for number in range(10 * seconds)]
    assert all(stamps[topic] == instants for topic in TOPICS if topic != '/imu')
    assert len(stamps['/imu']) == 100 * seconds
    noisy = {topic: listener.heard[topic] for topic in ('/scan', '/camera/image')}
    assert all(len(set(messages)) == len(messages) for messages in noisy.values())


def test_a_pause_stops_them_and_a_step_gives_exactly_those_due(listener):
    sim, heard = listener.sim, listener.heard
    sim.run(0.25)
    listener.catch_up()
    before = {topic: len(heard[topic]) for topic in TOPICS}
    sim.run(0.05)  # nothing of 10 Hz is due
    sim.step(1)
    listener.catch_up()
    assert {t: len(heard[t]) - n for t, n in before.items() if t != '/imu'} == dict.fromkeys(
        set(TOPICS) - {'/imu'}, 1
    )
    assert listener.stamps('/scan') == [0, 100 * MS, 200 * MS, 300 * MS]


def test_best_effort_and_reliable_subscribers_hear_the_same(listener):
    listener.sim.run(0.3)
    listener.catch_up()
    by_either, scans = listener.heard['/scan, best effort'], listener.heard['/scan']
    listener.sim.wait(lambda: by_either[-1:] == scans[-1:], 'the last scan, best effort')
    assert len(scans) == 3
    assert by_either[-3:] == scans  # those before were on their way at the reset


def test_the_present_instant_is_measured_only_while_time_stands_still(listener):
    sim = listener.sim
    client = sim.node.create_client(Trigger, '/mujoco_sim/measure')

    def measured():
        future = client.call_async(Trigger.Request())
        sim.wait(future.done, 'an answer')
        return future.result()

    sim.wait(client.service_is_ready, 'the service')
    sim.run(0.25)
    answer = measured()
    assert answer.success
    assert set(TOPICS) - {'/imu'} <= set(answer.message.split())
    sim.wait(lambda: listener.stamps('/scan')[-1:] == [250 * MS], 'that of now')
    with in_real_time(sim):
        answer = measured()
    assert not answer.success
    assert 'pause it first' in answer.message
    sim.node.destroy_client(client)


@pytest.mark.parametrize(
    ('words', 'expected'),
    [
        (('hz', '-s', '/scan'), r'average rate: (9|10)\.\d+\n'),
        pytest.param(
            ('echo', '--no-arr', '/camera/image'),
            r"data: '<sequence type: uint8, length: 2304>'",
            marks=pytest.mark.long,
        ),
        pytest.param(
            ('echo', '--no-arr', '/scan'),
            r"frame_id: lidar_link\n(?s:.)*type: float, length: 360>'",
            marks=pytest.mark.long,
        ),
        pytest.param(
            ('bw', '/scan'),
            r'Message size mean: 2.9\d KB min: 2.9\d KB max: 2.9\d KB',
            marks=pytest.mark.long,
        ),
    ],
)
def test_commands_say_what_is_published(listener, words, expected):
    with in_real_time(listener.sim), started('topic', *words) as program:
        program.expect(expected)
        assert program.end(signal.SIGINT) == signal.SIGINT


def test_a_robot_that_goes_takes_its_topics_away(listener):
    sim = listener.sim
    sim.remove(sim.name)

    def are_gone():
        return not any(map(sim.node.count_publishers, TOPICS))

    sim.wait(are_gone, 'the end of the topics')
