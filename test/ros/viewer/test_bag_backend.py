# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A bag as the backend of the page's server: what was where at each time, without a node."""

import asyncio
from base64 import b64decode
from contextlib import contextmanager
import json
import struct
import threading

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rcl_interfaces.msg import Log
from rclpy.serialization import serialize_message
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from support.drive_bag import LENGTH, pose_at, SPEED, URDF, write_drive
from support.ros_processes import PATIENCE
from support.small_bags import BEGIN, MS, topic, write_bag
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.reader import BagReader
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError, ViewerError
from amr_description.ros.message_types import type_name
from amr_description.viewer.backend import Watched
from amr_description.viewer.bags import (
    Playback,
    Playhead,
    ReadOverview,
    ReadSeries,
    Recording,
    Seek,
)
from amr_description.viewer.protocol import Graph, Layout, Model, World
from amr_description.viewer.requests import Definition, ResetSimulation
from amr_description.viewer.ros import bag_backend
from amr_description.viewer.ros.bag_backend import BagBackend
from amr_description.viewer.ros.recorded import RecordedFrames
from amr_description.viewer.states import StateFrame

HEAD = struct.Struct('<BBHId')


class Told:
    """In place of the server: what it is told."""

    def __init__(self):
        self.messages = {}

    @property
    def pages(self):
        return self

    def publish(self, subject, message):
        self.messages[type(message), subject] = message

    def send_to(self, part, message):
        self.messages[type(message), part] = message

    def last(self, kind, subject=''):
        return self.messages[kind, subject]


@pytest.fixture(scope='module')
def drive(tmp_path_factory):
    return write_drive(tmp_path_factory.mktemp('bags') / 'drive')


@pytest.fixture(scope='module')
def opened(drive):
    backend = BagBackend(drive, pytest.fail)
    yield backend
    backend.close_bag()


@pytest.fixture
def backend(opened):
    """Paused at its begin, with a first page."""
    ask(opened, Playback(1, False, 1.0))
    ask(opened, Seek(1, 0.0))
    opened.server = Told()
    opened.open()
    return opened


def ask(backend, request):
    return asyncio.run(backend.handlers.carry_out(request, 'page 1'))


class Pages:
    """What pages see of a backend."""

    def __init__(self, backend):
        self._backend = backend
        self._frame = None

    def at(self, seconds):
        """Return the state at a time of the bag, and its time."""
        ask(self._backend, Seek(1, seconds))
        messages, state = self._backend.take_state()
        for each in messages:
            if isinstance(each, Layout):
                self._frame = StateFrame(each)
        *_, time = HEAD.unpack_from(state)
        floats = np.frombuffer(state, '<f4', offset=HEAD.size)
        frame = StateFrame(self._frame.layout)
        frame.poses.base[:] = floats
        return frame, time


@pytest.mark.parametrize('seconds', [[0.0, 3.0, 9.98], [9.98, 3.0, 0.0]])
def test_everything_is_where_it_was_forwards_and_backwards(backend, seconds):
    pages = Pages(backend)
    for each in seconds:
        frame, time = pages.at(each)
        x, y, turn = pose_at(each)
        names = [one.name for one in frame.layout.frames]
        base, robot = frame.poses[names.index('base_link')], frame.robots[0]
        assert base[:2] == pytest.approx((x, y), abs=1e-5)
        assert base[5] == pytest.approx(np.sin(turn / 2), abs=1e-6)
        assert frame.poses[names.index('lidar')][2] == pytest.approx(0.2)
        camera = frame.poses[names.index('camera')]  # of the description: it has no transform
        assert camera[:3] == pytest.approx((0.2, 0.0, 0.1))
        assert robot.odometry[[0, 1, 7]] == pytest.approx((x, y, SPEED), abs=1e-5)
        assert robot.truth[:2] == pytest.approx((x, y), abs=1e-5)
        assert robot.positions[0] == pytest.approx(each * 10)
        commanded = robot.command[0]
        assert commanded == pytest.approx(SPEED) if each < LENGTH / 2 else np.isnan(commanded)
        assert time == pytest.approx(BEGIN / 1e9 + each, abs=1e-3)


def test_the_page_is_told_of_the_bag_and_of_its_robot(backend, drive):
    backend.take_state()
    recording = backend.server.last(Recording)
    assert (recording.name, recording.length) == ('drive', LENGTH)
    assert backend.server.last(Model, '/').urdf == URDF
    graph = backend.server.last(Graph)
    assert [each.topic for each in graph.sensors] == ['/camera/image_raw', '/scan']
    assert graph.robots[0].command is None  # nothing can be driven
    assert graph.hint is None
    assert backend.server.last(Playhead) == Playhead(0.0, False, 1.0)


def test_samples_are_those_of_the_time_that_is_shown(backend):
    async def seen(seconds):
        await backend.handlers.carry_out(Seek(1, seconds), 'page 1')
        channel = ('sensor', '/scan')
        async with asyncio.timeout(PATIENCE):
            while not (samples := backend.take_samples({channel})):
                await asyncio.sleep(0.001)
        size = int.from_bytes(samples[0].frame[2:4], 'little')
        head = json.loads(samples[0].frame[4 : 4 + size])
        return head['type'], np.frombuffer(samples[0].frame[4 + size :], '<f4')[0]

    async def scrub():
        return [await seen(each) for each in (5.05, 2.0, 7.19)]

    backend.watch(Watched(sensors=frozenset({'/scan', '/nowhere'})))
    found = asyncio.run(scrub())
    assert [kind for kind, _ in found] == ['scan'] * 3
    assert [each for _, each in found] == pytest.approx([3.5, 3.2, 3.71])


def test_a_series_has_a_number_of_all_messages(backend):
    data = ask(backend, ReadSeries(1, '/odom', 'pose.pose.position.x')).data
    stamps, values = (np.frombuffer(b64decode(each), '<f8') for each in (data.stamps, data.values))
    assert len(stamps) == len(values) == 501
    assert stamps[[0, -1]] == pytest.approx((BEGIN / 1e9, BEGIN / 1e9 + LENGTH))
    assert values[-1] == pytest.approx(pose_at(LENGTH)[0])


@pytest.mark.parametrize('how', ['page has gone', 'takes too long'])
def test_a_series_that_nobody_waits_for_is_read_no_further(backend, monkeypatch, how):
    begun, goes_on, read = threading.Event(), threading.Event(), []
    messages = BagReader.messages

    def slowly(reader, topics):
        for each in messages(reader, topics):
            read.append(each)
            begun.set()
            assert goes_on.wait(PATIENCE)
            yield each

    async def leave():
        request = ReadSeries(1, '/odom', 'pose.pose.position.x')
        wish = asyncio.create_task(backend.handlers.carry_out(request, 'page 2'))
        if how == 'page has gone':
            assert await asyncio.to_thread(begun.wait, PATIENCE)
            backend.forget('page 2')
            goes_on.set()
        with pytest.raises(ViewerError, match='nobody waits|takes longer than'):
            await wish
        goes_on.set()  # asyncio.run() waits for the thread

    monkeypatch.setattr(BagReader, 'messages', slowly)
    if how == 'takes too long':
        monkeypatch.setattr(bag_backend, '_LONGEST_READ', 0.01)
    asyncio.run(leave())
    assert len(read) <= 1  # 0: it was over before its thread began


def test_an_overview_goes_from_the_first_to_the_last_time(backend):
    data = ask(backend, ReadOverview(1)).data
    states = b64decode(data.states)
    size = len(states) // data.count
    times = [HEAD.unpack_from(states, each * size)[-1] for each in (0, data.count - 1)]
    assert times == pytest.approx([BEGIN / 1e9, BEGIN / 1e9 + LENGTH])
    assert HEAD.unpack_from(states)[2] == data.layout
    assert data.robots == tuple(each.layout() for each in backend.recorded.robots)
    assert data.frames == backend.recorded.frames.tree(backend.recorded.end)


def test_an_overview_of_many_robots_has_fewer_states(backend, monkeypatch):
    monkeypatch.setattr(bag_backend, '_LARGEST', 10_000)
    data = bag_backend.overview(backend.recorded)
    assert 8_000 < len(b64decode(data.states)) <= 10_000


def test_trees_that_are_the_same_have_one_layout():
    frames = RecordedFrames()
    take = frames.takes('/tf')
    for time in range(100):
        each = TransformStamped(child_frame_id='base_link')
        each.header.frame_id = ('odom', 'map')[time % 2]
        take(time, serialize_message(TFMessage(transforms=[each])))
    assert {frames.version(time) for time in range(100)} == {0, 1}
    parents = [frames.tree(time)[0].parent for time in (0, 1, 50, 99)]
    assert parents == ['odom', 'map', 'odom', 'map']


def test_it_plays_to_its_end_and_from_its_begin(backend):
    async def play():
        await backend.handlers.carry_out(Seek(1, LENGTH - 0.5), 'page 1')
        await backend.handlers.carry_out(Playback(2, True, 100.0), 'page 1')
        async with asyncio.timeout(PATIENCE):
            while backend.server.last(Playhead) != Playhead(LENGTH, False, 100.0):
                await asyncio.sleep(0.001)
                backend.take_state()
        await backend.handlers.carry_out(Playback(3, True, 0.001), 'page 1')
        backend.take_state()

    backend.take_state()
    asyncio.run(play())
    again = backend.server.last(Playhead)
    assert again.playing
    assert again.place < 1.0


@pytest.mark.parametrize(
    ('request_', 'why'),
    [
        (ResetSimulation(1, '/mujoco_sim'), 'shows a recording'),
        (Playback(1, True, 0.0), 'a rate is above 0'),
        (ReadSeries(1, '/nothing', 'data'), 'no topic /nothing'),
        (ReadSeries(1, '/odom', 'pose.nothing'), 'nothing'),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(backend, request_, why):
    with pytest.raises(ViewerError, match=why):
        ask(backend, request_)


def test_nothing_is_driven(backend):
    assert backend.robots() == ()
    with pytest.raises(ViewerError, match='shows a recording'):
        backend.drive('/', 1.0, 0.0)


def test_fields_of_its_types_are_told(backend):
    assert ask(backend, Definition(1, 'nav_msgs/msg/Odometry')).data


def test_a_bag_without_a_robot_says_what_would_do(tmp_path):
    path = write_bag(tmp_path / 'texts', [topic('/chatter')], [(0, '/chatter', 'a')])
    backend = BagBackend(path, pytest.fail)
    backend.server = Told()
    backend.open()
    backend.close_bag()
    assert 'no topic /robot_description' in backend.server.last(Graph).hint


NEW_FILE = 'new file'


def write_messages(folder, *messages):
    """Write a bag of (ms after the begin, topic, message, or its bytes and the type), NEW_FILE."""
    with BagWriter(folder) as writer:
        known = set()
        for each in messages:
            if each is NEW_FILE:
                writer.split()
                continue
            ms, name, message = each
            data, kind = message if isinstance(message, tuple) else (None, type(message))
            if name not in known:
                known.add(name)
                writer.add_topic(TopicMetadata(name, type_name(kind)))
            time = BEGIN + ms * MS
            writer.write(BagMessage(name, data or serialize_message(message), time, time))
    return folder


@contextmanager
def shown(bag):
    """A backend with a first page."""
    backend = BagBackend(bag, pytest.fail)
    try:
        backend.server = Told()
        backend.open()
        yield backend
    finally:
        backend.close_bag()


def test_broken_messages_are_left_out_and_counted(tmp_path):
    box = MarkerArray(markers=[Marker(ns='box', type=Marker.CUBE)])
    box.markers[0].pose.orientation.w = 1.0
    cut_off = {kind: serialize_message(each)[:12] for kind, each in (
        (MarkerArray, box), (String, String(data=URDF)), (Odometry, Odometry())
    )}  # fmt: skip
    bag = write_messages(
        tmp_path / 'broken',
        (0, '/robot_description', String(data=URDF)),
        (0, '/mujoco_sim/world', box),
        *(
            (after, name, (cut_off[kind], kind))
            for after in (1, 2)
            for name, kind in (
                ('/robot_description', String),
                ('/mujoco_sim/world', MarkerArray),
                ('/odom', Odometry),
            )
        ),
        (1000, '/mujoco_sim/world', MarkerArray()),
    )
    with shown(bag) as backend:
        assert backend.recorded.broken == 6
        for seconds, count in ((0.0, 1), (0.5, 1), (1.0, 0)):
            ask(backend, Seek(1, seconds))
            backend.take_state()
            assert len(backend.server.last(World, '/mujoco_sim').shapes) == count
        assert backend.server.last(Model, '/').urdf == URDF


def test_time_0_of_a_simulation_is_a_time(tmp_path):
    clocks = ((0, '/clock', Clock()), (10, '/clock', Clock(clock=Time(nanosec=10 * MS))))
    with shown(write_messages(tmp_path / 'begun', *clocks)) as backend:
        pages = Pages(backend)
        assert [pages.at(each)[1] for each in (0.0, 0.01)] == [0.0, 0.01]


def odometry(x):
    message = Odometry()
    message.pose.pose.position.x = x
    return message


def test_of_a_simulation_that_was_reset_the_last_run_is_shown(tmp_path):
    bag = write_messages(
        tmp_path / 'reset',
        *((ms, '/odom', odometry(ms / 1000)) for ms in range(0, 4000, 100)),
        NEW_FILE,
        *((ms, '/odom', odometry(5.0 + ms / 1000)) for ms in range(0, 3000, 100)),
        NEW_FILE,
        (0, '/odom', odometry(7.0)),  # as the simulation ended
    )
    with shown(bag) as backend:
        assert [each.name for each in backend.left_out] == ['reset_0.mcap', 'reset_2.mcap']
        recording = backend.server.last(Recording)
        assert (recording.name, recording.messages) == ('reset', 30)
        assert recording.length == pytest.approx(2.9)
        series = ask(backend, ReadSeries(1, '/odom', 'pose.pose.position.x')).data
        assert np.frombuffer(b64decode(series.values), '<f8')[[0, -1]] == pytest.approx((5, 7.9))


def test_of_a_long_log_the_last_lines_are_kept(tmp_path):
    lines = ((n, '/rosout', Log(msg=f'line {n}')) for n in range(2010))
    with shown(write_messages(tmp_path / 'log', *lines)) as backend:
        assert [each.text for each in backend.latest('log').lines] == [
            f'line {n}' for n in range(10, 2010)
        ]
        assert backend.latest('log').lines[-1].number == 2010


def test_what_is_no_bag_is_refused(tmp_path):
    with pytest.raises(BagError, match='does not exist'):
        BagBackend(tmp_path / 'nothing', pytest.fail)
