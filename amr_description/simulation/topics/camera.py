# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics of a camera: colours, depth, points, and what its lens is.

===========================  ======================================================================
``<image>``                  ``sensor_msgs/msg/Image``: ``rgb8``, ``bgr8`` or ``mono8``
``<image>/compressed``       ``sensor_msgs/msg/CompressedImage``: the same as a JPEG
``<depth>``                  ``sensor_msgs/msg/Image``: ``32FC1``, m along the optical axis; +inf:
                             nothing or too far, -inf: too near (REP 118)
``<points>``                 ``sensor_msgs/msg/PointCloud2``: one point a pixel, with its colour if
                             the camera has colours; NaN where there is no depth
``<camera_info>``            ``sensor_msgs/msg/CameraInfo``, with each picture
===========================  ======================================================================

A picture is made by the worker, from a copy of the state of its instant, and only of what somebody
subscribes to: colours, depth, points and JPEGs are each left out by themselves.
"""

from collections.abc import Callable
from functools import partial
import struct
from typing import Any, TypeAlias

import numpy as np

from amr_description.cdr.template import template_of
from amr_description.clock import NANOSECONDS
from amr_description.messages.definitions import layout_of
from amr_description.messages.plain import message_of, PlainMessage
from amr_description.model.sensors import Camera
from amr_description.sim.cameras.lens import intrinsics_of
from amr_description.sim.cameras.pictures import encoded, jpeg
from amr_description.sim.cameras.renderer import Shot
from amr_description.sim.cameras.simulated_camera import SimulatedCamera
from amr_description.simulation.topics.advertising import Topic
from amr_description.simulation.topics.lidar import CLOUD, FLOAT32
from amr_description.simulation.topics.sensor_topics import SensorContext, SensorTopics

# --- Messages ------------------------------------------------------------------------------------
#
# Made of bytes, an image of 640 x 480 costs one copy; see :mod:`amr_description.cdr.template`.

Encode: TypeAlias = Callable[[int, Any], bytes]
"""``(time in ns, array or bytes) ->`` a serialized message."""

IMAGE, COMPRESSED_IMAGE, CAMERA_INFO = (
    f'sensor_msgs/msg/{name}' for name in ('Image', 'CompressedImage', 'CameraInfo')
)
_STAMP = ('header.stamp',)
_LENGTH = struct.Struct('<I')
_PIXEL_BYTES = {'rgb8': 3, 'bgr8': 3, 'mono8': 1, '32FC1': 4}
_XYZ = ('x', 'y', 'z')
_COLOR_OFFSET = 16
"""Bytes, of a point: as Gazebo's, aligned to 8."""
POINT_STEPS = {False: 16, True: 24}
"""Bytes of a point, without and with a color."""


def image_encoder(camera: Camera, frame: str, encoding: str) -> Encode:
    """Return what makes ``sensor_msgs/msg/Image`` of pixels."""
    message = message_of(
        IMAGE,
        {
            'header': {'frame_id': frame},
            'height': camera.height,
            'width': camera.width,
            'encoding': encoding,
            'step': camera.width * _PIXEL_BYTES[encoding],
        },
    )
    return _with_data(IMAGE, message)


def compressed_image_encoder(frame: str, encoding: str) -> Encode:
    """Return what makes ``sensor_msgs/msg/CompressedImage`` of a JPEG."""
    # As compressed_image_transport calls it: JPEGs of colors are made of bgr8.
    compressed = 'bgr8' if encoding != 'mono8' else ''
    message = PlainMessage(COMPRESSED_IMAGE)
    message.header.frame_id = frame
    message.format = f'{encoding}; jpeg compressed {compressed}'
    return _with_data(COMPRESSED_IMAGE, message)


def points_encoder(camera: Camera, frame: str, *, with_color: bool) -> Encode:
    """Return what makes ``sensor_msgs/msg/PointCloud2``, a point for each pixel, of points."""
    step = POINT_STEPS[with_color]
    offsets = {name: 4 * at for at, name in enumerate(_XYZ)}
    if with_color:
        offsets['rgb'] = _COLOR_OFFSET
    message = message_of(
        CLOUD,
        {
            'header': {'frame_id': frame},
            'height': camera.height,
            'width': camera.width,
            'fields': [
                {'name': name, 'offset': offset, 'datatype': FLOAT32, 'count': 1}
                for name, offset in offsets.items()
            ],
            'point_step': step,
            'row_step': step * camera.width,
            'is_dense': False,
        },
    )
    return _with_data(CLOUD, message, end=b'\0')


def camera_info_encoder(camera: Camera, frame: str) -> Callable[[int], bytes]:
    """Return what makes ``sensor_msgs/msg/CameraInfo`` of a time, ns."""
    template = template_of(layout_of(CAMERA_INFO), camera_info(camera, frame), _STAMP)
    begin, end = template.constants
    return lambda time: template.pack(begin, *divmod(time, NANOSECONDS), end)


def camera_info(camera: Camera, frame: str) -> PlainMessage:
    """Return the ``CameraInfo`` of a camera, without a stamp."""
    k, lens = intrinsics_of(camera), camera.distortion
    # Of the right one of a stereo pair, Tx = -fx B: see the comments of the message.
    tx = -k.fx * camera.baseline if camera.baseline else 0.0
    message = PlainMessage(CAMERA_INFO)
    message.header.frame_id = frame
    message.height, message.width = camera.height, camera.width
    message.distortion_model = 'plumb_bob'
    message.d = [lens.k1, lens.k2, lens.p1, lens.p2, lens.k3]
    message.k = [k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0]
    message.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    message.p = [k.fx, 0.0, k.cx, tx, 0.0, k.fy, k.cy, 0.0, 0.0, 0.0, 1.0, 0.0]
    return message


def _with_data(kind: str, message: PlainMessage, end: bytes = b'') -> Encode:
    """
    Return what makes such a message with other data.

    Args:
        kind: Its type.
        message: Its data are empty.
        end: What follows the data, serialized.
    """
    template = template_of(layout_of(kind), message, _STAMP)
    before, after = template.constants
    cut = -(_LENGTH.size + len(end))

    def encode(time: int, data: Any) -> bytes:
        head = template.pack(before, *divmod(time, NANOSECONDS), after)[:cut]
        size = data.nbytes if isinstance(data, np.ndarray) else len(data)
        return b''.join((head, _LENGTH.pack(size), data, end))

    return encode


_DEPTH_ENCODING = '32FC1'


class CameraTopics(SensorTopics):
    """See the module."""

    def __init__(self, camera: Camera, context: SensorContext) -> None:
        """Create the topics."""
        mount = camera.mount
        self._camera, self._context = camera, context
        frame = context.frame(mount.frame or mount.link)
        encoding = camera.encoding
        has_color = bool(camera.image_topic)
        self._image = self._topic(
            'Image', camera.image_topic, image_encoder(camera, frame, encoding)
        )
        compressed = f'{camera.image_topic}/compressed' if has_color else ''
        self._compressed = self._topic(
            'CompressedImage', compressed, compressed_image_encoder(frame, encoding)
        )
        self._depth = self._topic(
            'Image', camera.depth_topic, image_encoder(camera, frame, _DEPTH_ENCODING)
        )
        self._points = self._topic(
            'PointCloud2',
            camera.points_topic,
            points_encoder(
                camera,
                context.frame(camera.points_frame) if camera.points_frame else frame,
                with_color=has_color,
            ),
        )
        info = camera_info_encoder(camera, frame)
        self._infos = [
            self._topic('CameraInfo', topic, lambda time, _: info(time))
            for topic in dict.fromkeys((camera.camera_info_topic, camera.depth_camera_info_topic))
        ]
        self._simulated = SimulatedCamera(camera, context.robot, context.states)
        self._task = context.worker.task(
            f"camera '{mount.name}' of '{context.robot.name}'",
            'a lower <update_rate> or a smaller <image> would do',
        )

    @property
    def has_subscribers(self) -> bool:
        """Whether anybody subscribes to one of them."""
        pictures = self._image, self._compressed, self._depth, self._points
        return any(topic.has_subscribers for topic in (*pictures, *self._infos))

    def measure(self, time: int) -> None:
        """Have a picture made of what is subscribed to."""
        camera = self._camera
        with_color = self._image.has_subscribers or self._compressed.has_subscribers
        with_points = self._points.has_subscribers
        shot = self._simulated.shot(
            with_color=with_color or (with_points and bool(camera.image_topic)),
            with_depth=with_points or self._depth.has_subscribers,
        )
        if shot.with_color or shot.with_depth:
            self._task.request(partial(self._make, time, shot))
        else:
            self._send_infos(time)

    def _topic(self, kind: str, name: str, encode: Encode) -> '_BulkTopic':
        if not name:
            return _BulkTopic(None, encode)
        message, mount = f'sensor_msgs/msg/{kind}', self._camera.mount
        return _BulkTopic(self._context.advertise(name, mount, message, _as_it_is), encode)

    def _make(self, time: int, shot: Shot) -> None:
        """Make a picture and publish it; on the thread of the worker."""
        camera = self._camera
        picture = self._simulated.picture(self._context.renderer, time, shot)
        if picture.color is not None:
            pixels = encoded(picture.color, camera.encoding)
            self._image.write(time, pixels)
            if self._compressed.has_subscribers:
                self._compressed.write(time, jpeg(pixels, camera.encoding))
        if picture.depth is not None:
            self._depth.write(time, picture.depth)
            if self._points.has_subscribers:
                self._points.write(time, self._simulated.points(picture))
        self._send_infos(time)

    def _send_infos(self, time: int) -> None:
        for topic in self._infos:
            topic.write(time, None)


class _BulkTopic:
    """A topic of messages of the worker, which are published at once; maybe none at all."""

    def __init__(self, topic: Topic | None, encode: Encode) -> None:
        self._topic, self._encode = topic, encode

    @property
    def has_subscribers(self) -> bool:
        """Whether anybody subscribed at the last look."""
        return self._topic is not None and self._topic.has_subscribers

    def write(self, time: int, data: Any) -> None:
        """Publish if anybody subscribes."""
        topic = self._topic
        if topic is not None and topic.has_subscribers:
            topic.write_aside(self._encode(time, data))


def _as_it_is(message: bytes) -> bytes:
    return message
