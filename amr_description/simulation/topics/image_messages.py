# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The messages of cameras, serialized: of pictures most is one array, the rest hardly changes.

Made of bytes, an image of 640 x 480 costs one copy; see :mod:`amr_description.cdr.template`.
"""

from collections.abc import Callable
import struct
from typing import Any, TypeAlias

import numpy as np

from amr_description.cdr.template import template_of
from amr_description.clock import NANOSECONDS
from amr_description.messages.definitions import layout_of
from amr_description.messages.plain import message_of, PlainMessage
from amr_description.model.sensors import Camera
from amr_description.sim.cameras.lens import intrinsics_of
from amr_description.simulation.topics.lidar_messages import CLOUD, FLOAT32

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
