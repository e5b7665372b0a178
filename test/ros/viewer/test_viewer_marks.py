# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What others draw, as samples for pages: what is drawn, thinned, kept, ended and refused."""

import asyncio
import json
import math
import struct

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    Polygon,
    PolygonStamped,
    Pose,
    PoseArray,
    Quaternion,
)
from hypothesis import given, strategies as st
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from amr_description.ros import readers
from amr_description.ros.message_types import type_name
from amr_description.ros.polled_topic import NumberedMessage
from amr_description.viewer.protocol import SensorInfo
from amr_description.viewer.ros import marker_feed
from amr_description.viewer.ros.marker_feed import MarkerFeed
from amr_description.viewer.ros.sensor_samples import sample_of

FLOATS = {'lines': 12, 'points': 6, 'triangles': 6}
TRANSPARENT = 'Marker is fully transparent (color.a is 0.0).'
SCALE = 'Scale contains 0.0 in x, y or z.'


def marker(kind=Marker.CUBE, *, points=(), colors=(), **values):
    """Return a red marker of 1 m in the frame map."""
    made = Marker(type=kind, ns='ns', id=7)
    made.header.frame_id = 'map'
    made.header.stamp.sec = 5
    made.scale.x = made.scale.y = made.scale.z = 1.0
    made.color = ColorRGBA(r=1.0, g=0.0, b=0.0, a=1.0)
    made.pose.orientation.w = 1.0
    made.points = [Point(x=float(x), y=float(y), z=float(z)) for x, y, z in points]
    made.colors = [ColorRGBA(r=float(r), g=float(g), b=float(b), a=1.0) for r, g, b in colors]
    for name, value in values.items():
        *path, last = name.split('__')
        target = made
        for each in path:
            target = getattr(target, each)
        setattr(target, last, value)
    return made


def parts_of(frame):
    """Return the head of a sample, and the rows of each batch."""
    end = 4 + struct.unpack_from('<H', frame, 2)[0]
    head, at, rows = json.loads(frame[4:end]), end, []
    for batch in head.get('batches', ()):
        width = FLOATS.get(batch['kind'], 13)
        size = 4 * width * batch['count']
        rows.append(np.frombuffer(frame[at : at + size], '<f4').reshape(-1, width))
        at += size
    assert at == len(frame)
    return head, rows


def drawn(message):
    return parts_of(sample_of(type_name(type(message)), serialize_message(message), '/m', 2.0))


def kinds(head):
    return [each['kind'] for each in head['batches']]


def test_a_cube_is_where_it_is_and_as_it_looks():
    head, (rows,) = drawn(marker(pose__position=Point(x=1.0, y=2.0, z=3.0), scale__y=0.5))
    assert rows.tolist() == [[1, 2, 3, 0, 0, 0, 1, 1, 0.5, 1, 1, 0, 0]]
    (batch,) = head['batches']
    assert (batch['kind'], batch['frame'], batch['stamp']) == ('box', 'map', 5.0)
    assert (batch['opacity'], head['count'], head['shown'], head['faults']) == (1.0, 1, 1, [])
    assert head['origin'] == {'topic': '/m', 'frame': 'map', 'stamp': 5.0, 'rate': 2.0}


@pytest.mark.parametrize(
    ('kind', 'points', 'expected', 'count'),
    [
        (Marker.ARROW, [], ['cylinder', 'cone'], 1),
        (Marker.ARROW, [(0, 0, 0), (1, 0, 0)], ['cylinder', 'cone'], 1),
        (Marker.SPHERE, [], ['sphere'], 1),
        (Marker.CYLINDER, [], ['cylinder'], 1),
        (Marker.LINE_STRIP, [(0, 0, 0), (1, 0, 0), (1, 1, 0)], ['lines'], 2),
        (Marker.LINE_LIST, [(0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0)], ['lines'], 2),
        (Marker.CUBE_LIST, [(0, 0, 0), (1, 0, 0)], ['box'], 2),
        (Marker.SPHERE_LIST, [(0, 0, 0), (1, 0, 0)], ['sphere'], 2),
        (Marker.POINTS, [(0, 0, 0), (1, 0, 0)], ['points'], 2),
        (Marker.TRIANGLE_LIST, [(0, 0, 0), (1, 0, 0), (0, 1, 0)], ['triangles'], 1),
    ],
)
def test_every_type_is_drawn(kind, points, expected, count):
    head, _ = drawn(MarkerArray(markers=[marker(kind, points=points)]))
    assert (kinds(head), head['count'], head['shown']) == (expected, count, count)
    assert head['faults'] == []


def test_the_pose_of_a_marker_moves_and_turns_its_points():
    turned = Quaternion(z=math.sqrt(0.5), w=math.sqrt(0.5))
    message = marker(Marker.POINTS, points=[(1, 0, 0)], pose__orientation=turned)
    message.pose.position.z = 2.0
    _, (rows,) = drawn(message)
    assert rows[0, :3].tolist() == pytest.approx([0, 1, 2], abs=1e-6)


def test_an_arrow_between_points_ends_at_the_second():
    message = marker(Marker.ARROW, points=[(0, 0, 0), (0, 0, 2)])
    message.scale.x, message.scale.y, message.scale.z = 0.1, 0.2, 0.5
    _, (shaft, head) = drawn(message)
    assert shaft[0, :3].tolist() == pytest.approx([0, 0, 0.75], abs=1e-6)
    assert head[0, :3].tolist() == pytest.approx([0, 0, 1.5], abs=1e-6)
    assert (shaft[0, 9], head[0, 9]) == pytest.approx((1.5, 0.5))
    assert abs(head[0, 3:7]).tolist() == pytest.approx([0, 0, 0, 1], abs=1e-6)


@pytest.mark.parametrize('direction', [(-1, 0, 0), (0, 1, 0), (0, 0, -1), (1, 1, 1)])
def test_an_arrow_points_in_any_direction(direction):
    _, (_, head) = drawn(marker(Marker.ARROW, points=[(0, 0, 0), direction]))
    x, y, z, w = head[0, 3:7]
    axis = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]
    assert axis == pytest.approx(list(np.array(direction) / np.linalg.norm(direction)), abs=1e-6)


def test_each_point_has_its_colour():
    points, colors = [(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    _, (rows,) = drawn(marker(Marker.LINE_STRIP, points=points, colors=colors))
    assert rows[0].tolist() == [0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0]
    head, (rows,) = drawn(marker(Marker.POINTS, points=points, colors=colors[:2]))
    assert rows[:, 3:].tolist() == [[1, 0, 0]] * 3
    assert head['faults'] == ['ns/7: Number of colors does not match number of points.']


def test_a_text_is_shown():
    head, _ = drawn(marker(Marker.TEXT_VIEW_FACING, text='here', scale__z=0.3))
    (text,) = head['texts']
    assert (text['text'], text['height'], text['frame']) == ('here', 0.3, 'map')


def test_what_is_locked_to_its_frame_goes_with_it():
    head, _ = drawn(marker(frame_locked=True))
    assert head['batches'][0]['stamp'] is None


@pytest.mark.parametrize(
    ('message', 'fault'),
    [
        (marker(color__a=0.0), TRANSPARENT),
        (marker(scale__x=0.0), SCALE),
        (marker(header__frame_id=''), 'For frame []: Frame [] does not exist'),
        (marker(pose__position=Point(x=math.nan)), 'invalid floating point values'),
        (marker(scale__x=1e300), 'invalid floating point values'),
        (marker(Marker.POINTS, points=[(math.inf, 0, 0)]), 'invalid floating point values'),
        (marker(Marker.POINTS), 'Points array is empty.'),
        (marker(Marker.LINE_STRIP, points=[(0, 0, 0)]), 'At least two points are required'),
        (marker(Marker.LINE_LIST, points=[(0, 0, 0)] * 3), 'a multiple of 2'),
        (marker(Marker.TRIANGLE_LIST, points=[(0, 0, 0)] * 4), 'a multiple of 3'),
        (marker(Marker.ARROW, points=[(0, 0, 0)]), 'should be either 0 or 2'),
        (marker(Marker.TEXT_VIEW_FACING), 'Text is empty.'),
        (marker(Marker.MESH_RESOURCE), 'Empty mesh_resource path.'),
        (marker(Marker.MESH_RESOURCE, mesh_resource='package://no_such/a.stl'), 'no_such'),
        (marker(Marker.MESH_RESOURCE, mesh_resource='file:///etc/passwd'), 'the page draws'),
        (marker(99), 'Unknown marker type: 99'),
        (marker(action=9), 'Unknown marker action: 9'),
    ],
    ids=lambda each: each if isinstance(each, str) else '',
)
def test_what_cannot_be_drawn_says_why_in_a_line(message, fault):
    head, rows = drawn(MarkerArray(markers=[message]))
    assert (head['type'], rows) == ('marks', [])
    (line,) = head['faults']
    assert fault in line


def test_a_quaternion_of_zeros_turns_nothing():
    head, (rows,) = drawn(marker(pose__orientation__w=0.0))
    assert rows[0, 3:7].tolist() == [0, 0, 0, 1]
    assert head['faults'] == ['ns/7: Uninitialized quaternion, assuming identity.']
    head, (rows,) = drawn(marker(pose__orientation__w=7.0))
    assert rows[0, 3:7].tolist() == [0, 0, 0, 1]
    assert 'Unnormalized quaternion' in head['faults'][0]


def test_one_fault_of_many_markers_is_one_line():
    many = MarkerArray(markers=[marker(id=number, color__a=0.0) for number in range(100)])
    head, _ = drawn(many)
    assert head['faults'] == [f'ns/0 and 99 more: {TRANSPARENT}']


def test_very_many_points_are_shown_in_part():
    """They are written as bytes: to make as many messages takes seconds."""
    few = serialize_message(marker(Marker.POINTS, points=[(1, 2, 3)] * 8))
    eight = struct.pack('<3d', 1, 2, 3) * 8
    at = few.index(eight)
    count = 400_000
    length = few.rindex(struct.pack('<I', 8), 0, at)
    data = few[:length] + struct.pack('<I', count) + few[length + 4 : at]
    data += eight * (count // 8) + few[at + len(eight) :]
    head, (rows,) = parts_of(sample_of(type_name(Marker), data, '/m', None))
    assert (head['count'], head['shown'], len(rows)) == (count, 20_000, 20_000)
    assert rows[-1].tolist() == [1, 2, 3, 1, 0, 0]


def test_many_looks_and_texts_are_bounded():
    looks = [marker(id=number, color__a=(number + 1) / 300) for number in range(260)]
    texts = [
        marker(Marker.TEXT_VIEW_FACING, id=1000 + number, text='x' * 500) for number in range(260)
    ]
    head, rows = drawn(MarkerArray(markers=[*looks, *texts]))
    assert (len(rows), len(head['texts'])) == (250, 100)
    assert head['faults'] == [
        'of 260 frames, times and looks 250 are drawn',
        'of 260 texts 100 are drawn',
    ]


def poses(*values):
    made = PoseArray(poses=values)
    made.header.frame_id = 'map'
    return made


def test_poses_are_arrows_along_x():
    turned = Quaternion(z=math.sqrt(0.5), w=math.sqrt(0.5))
    head, (rows,) = drawn(poses(Pose(position=Point(x=1.0), orientation=turned)))
    assert (kinds(head), head['count'], head['shown'], len(rows)) == (['lines'], 1, 1, 3)
    assert rows[0, :6].tolist() == pytest.approx([1, 0, 0, 1, 0.3, 0], abs=1e-6)


def test_poses_are_checked_too():
    head, rows = drawn(poses(Pose(), Pose(position=Point(x=math.nan))))
    assert (rows, len(head['faults'])) == ([], 1)
    nothing = Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)
    head, (rows,) = drawn(poses(Pose(orientation=nothing)))
    assert rows[0, 3:6].tolist() == pytest.approx([0.3, 0, 0])
    assert head['faults'] == ['Uninitialized quaternion, assuming identity.']
    head, rows = drawn(poses())
    assert (head['count'], rows, head['faults']) == (0, [], [])


def test_a_polygon_is_closed_and_a_point_is_a_ball():
    corners = [Point32(x=0.0), Point32(x=1.0), Point32(x=1.0, y=1.0)]
    polygon = PolygonStamped(polygon=Polygon(points=corners))
    polygon.header.frame_id = 'base_link'
    head, (rows,) = drawn(polygon)
    assert (kinds(head), rows[-1, :6].tolist()) == (['lines'], [1, 1, 0, 0, 0, 0])
    point = PointStamped(point=Point(x=1.0, y=2.0, z=3.0))
    assert 'Frame [] does not exist' in drawn(point)[0]['faults'][0]
    point.header.frame_id = 'map'
    head, (rows,) = drawn(point)
    assert (kinds(head), rows[0, :3].tolist()) == (['sphere'], [1, 2, 3])


MESSAGES = [
    MarkerArray(markers=[marker(Marker.ARROW), marker(Marker.POINTS, points=[(0, 0, 0)] * 3)]),
    marker(Marker.TEXT_VIEW_FACING, text='a'),
    poses(Pose()),
]


@pytest.mark.parametrize('message', MESSAGES, ids=lambda each: type(each).__name__)
@given(st.integers(0, 400), st.binary(min_size=1, max_size=8))
def test_any_bytes_become_a_sample(message, at, noise):
    data = serialize_message(message)
    at = min(at, len(data))
    frame = sample_of(type_name(type(message)), data[:at] + noise + data[at + len(noise) :], '', 1)
    head, _ = parts_of(frame)
    assert head['type'] in ('marks', 'unreadable')
    assert not head.get('text', '').startswith('the viewer failed')


def test_what_is_read_of_a_marker_is_what_was_sent():
    message = marker(Marker.MESH_RESOURCE, mesh_resource='package://a/b.stl', text='t')
    message.lifetime = Duration(sec=2, nanosec=5)
    message.mesh_file.filename, message.mesh_file.data = 'b.stl', b'abc'
    message.mesh_use_embedded_materials = True
    found = readers.MARKER.read(serialize_message(message))
    assert (found.ns, found.id, found.type, found.lifetime) == ('ns', 7, 10, 2_000_000_005)
    assert (found.mesh_resource, found.mesh[0], bytes(found.mesh[1])) == (
        'package://a/b.stl',
        'b.stl',
        b'abc',
    )
    assert (found.text, found.mesh_use_embedded_materials, found.frame_locked) == (
        't',
        True,
        False,
    )


class Topic:
    """Instead of a MarkerTopic."""

    def __init__(self, *_):
        self.messages = []

    def publish(self, *markers):
        data = serialize_message(MarkerArray(markers=markers))
        self.messages.append(NumberedMessage(data, 0, None))

    def take_numbered(self):
        return self.messages.pop(0) if self.messages else None


class Feed:
    """A feed whose time is that of the test, s."""

    def __init__(self, monkeypatch):
        self.topic = Topic()
        monkeypatch.setattr(marker_feed, 'MarkerTopic', lambda *_: self.topic)
        self.now, self.clock = 0.0, 100.0
        info = SensorInfo('/m', '/', 'markers', 'visualization_msgs/msg/MarkerArray')
        self.feed = MarkerFeed(None, info, lambda _: self.now)

    def take(self):
        """Return what is drawn anew; None: nothing is."""

        self.clock += 1.0

        async def take():
            self.feed.take(self.clock, is_wanted=True)
            if self.feed._work is None:
                return None
            await self.feed._work
            return self.feed.take(self.clock, is_wanted=True)

        frame = asyncio.run(take())
        self.now += 1.0
        return None if frame is None else parts_of(frame)[0]['count']


@pytest.fixture
def feed(monkeypatch):
    return Feed(monkeypatch)


def test_markers_are_added_changed_and_deleted(feed):
    assert feed.take() is None
    feed.topic.publish(marker(id=1), marker(id=2))
    feed.topic.publish(marker(id=3))
    assert feed.take() == 3
    assert feed.feed.is_drawn
    feed.topic.publish(marker(id=2, action=Marker.DELETE), marker(id=3))
    assert feed.take() == 2
    assert feed.take() is None
    feed.topic.publish(Marker(action=Marker.DELETEALL), marker(id=9))
    assert feed.take() == 1
    feed.topic.publish(Marker(action=Marker.DELETEALL))
    assert feed.take() == 0
    assert not feed.feed.is_drawn


def test_a_marker_ends_after_its_lifetime(feed):
    feed.topic.publish(marker(id=1, lifetime=Duration(sec=2)), marker(id=2))
    assert feed.take() == 2  # at 0 s
    assert feed.take() is None
    assert feed.take() == 1
    assert feed.take() is None


def test_a_reset_clears_what_is_of_a_time_to_come(feed):
    feed.now = 50.0
    feed.topic.publish(marker())
    assert feed.take() == 1
    feed.now = 1.0
    assert feed.take() == 0


def test_of_meshes_that_no_marker_names_any_more_nothing_is_kept(feed):
    """A publisher may send a new one with each message."""
    for number in range(3):
        mesh = marker(Marker.MESH_RESOURCE, mesh_resource='embedded://part.stl')
        mesh.mesh_file.filename, mesh.mesh_file.data = 'part.stl', bytes([number]) * 84
        feed.topic.publish(mesh)
        assert feed.take() == 1
        assert [*feed.feed.files.values()] == [bytes([number]) * 84]
    feed.topic.publish(Marker(action=Marker.DELETEALL))
    assert feed.take() == 0
    assert not feed.feed.files
