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

from functools import partial
from typing import Any

from amr_description.model.sensors import Camera
from amr_description.sim.cameras.pictures import encoded, jpeg
from amr_description.sim.cameras.renderer import Shot
from amr_description.sim.cameras.simulated_camera import SimulatedCamera
from amr_description.simulation.topics.advertising import Topic
from amr_description.simulation.topics.image_messages import (
    camera_info_encoder,
    compressed_image_encoder,
    Encode,
    image_encoder,
    points_encoder,
)
from amr_description.simulation.topics.sensor_topics import SensorContext, SensorTopics

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
    def is_heard(self) -> bool:
        """Whether anybody subscribes to one of them."""
        pictures = self._image, self._compressed, self._depth, self._points
        return any(topic.is_heard for topic in (*pictures, *self._infos))

    def measure(self, time: int) -> None:
        """Have a picture made of what is subscribed to."""
        camera = self._camera
        with_color = self._image.is_heard or self._compressed.is_heard
        with_points = self._points.is_heard
        shot = self._simulated.shot(
            with_color=with_color or (with_points and bool(camera.image_topic)),
            with_depth=with_points or self._depth.is_heard,
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
            if self._compressed.is_heard:
                self._compressed.write(time, jpeg(pixels, camera.encoding))
        if picture.depth is not None:
            self._depth.write(time, picture.depth)
            if self._points.is_heard:
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
    def is_heard(self) -> bool:
        """Whether anybody subscribed at the last look."""
        return self._topic is not None and self._topic.is_heard

    def write(self, time: int, data: Any) -> None:
        """Publish if anybody subscribes."""
        topic = self._topic
        if topic is not None and topic.is_heard:
            topic.write_aside(self._encode(time, data))


def _as_it_is(message: bytes) -> bytes:
    return message
