# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of sensors as samples for pages: bytes in, the frame of a sample out.

Pure, on any thread. A message that is broken, or of a kind that a page cannot show, becomes a
sample that says so in one line.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
import math
from typing import TypeAlias

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.errors import ViewerError
from amr_description.ros import readers
from amr_description.ros.readers import (
    CloudData,
    CompressedData,
    ContactsData,
    Header,
    ImageData,
    RangeData,
    ScanData,
)
from amr_description.text import shorten
from amr_description.viewer.clouds import thinned
from amr_description.viewer.graph import (
    CLASSIC_CONTACTS,
    CLOUD,
    COMPRESSED_IMAGE,
    GZ_CONTACTS,
    IMAGE,
    LASER_SCAN,
    MARKER,
    MARKERS,
    OCCUPANCY_GRID,
    PATH,
    POINT,
    POLYGON,
    POSES,
    RANGE,
)
from amr_description.viewer.pictures import picture_of_file, picture_of_pixels, SmallPicture
from amr_description.viewer.protocol import (
    Cloud,
    ContactInfo,
    Contacts,
    Distance,
    Head,
    Origin,
    Picture,
    Scan,
    Unreadable,
)
from amr_description.viewer.ros.marker_store import marker_sample, markers_sample
from amr_description.viewer.ros.marks import point_sample, polygon_sample, poses_sample
from amr_description.viewer.ros.navigation_samples import frame_name, grid_sample, path_sample
from amr_description.viewer.samples import (
    encode_sample,
    MOST_POINTS,
    PLACE_FLOATS,
    WHOLE_POINTS,
)

MOST_RAYS = 20_000
"""Ranges of a scan that are sent."""
_WORLD = 'world'
"""The frame of the points of ``ros_gz_interfaces/msg/Contacts``, whatever the header says."""
_SHOWN_CONTACTS = 32
"""Pairs of shapes that are named."""
_MOST_PLACES = 256
"""Points of contact that are sent."""

Parts: TypeAlias = Sequence[np.ndarray | bytes]
Converter: TypeAlias = Callable[[bytes, Origin], tuple[Head, Parts]]
"""Makes a head, and what follows it, of a message."""


def sample_of(
    message_type: str, data: bytes, topic: str, rate: float | None, *, is_whole: bool = False
) -> bytes:
    """
    Return the frame of a sample.

    Args:
        message_type: Of the message: one of :data:`CONVERTERS`.
        data: The message.
        topic: That it came by.
        rate: Messages per second of the topic; None: not known yet.
        is_whole: Whether all points of a cloud are shown.
    """
    convert = _whole_cloud if is_whole and message_type == CLOUD else CONVERTERS[message_type]
    return converted(convert, data, topic, rate)


def converted(convert: Converter, data: bytes, topic: str, rate: float | None) -> bytes:
    """Return the frame of a sample that is made of a message so, or why there is none."""
    origin = Origin(topic, '', 0.0, rate)
    try:
        with np.errstate(all='ignore'):  # what is published may be any number
            return encode_sample(*convert(data, origin))
    except (ValueError, ViewerError) as error:
        return unreadable(topic, str(error), rate)
    except Exception as error:  # a bug of ours, which must not end what else the page shows
        return unreadable(topic, f'the viewer failed: {type(error).__name__}: {error}', rate)


def unreadable(topic: str, text: str, rate: float | None = None) -> bytes:
    """Return a sample that says why there is none."""
    return encode_sample(Unreadable(Origin(topic, '', 0.0, rate), shorten(text)))


def _scan(data: bytes, origin: Origin) -> tuple[Head, Parts]:
    scan: ScanData = readers.SCAN.read(data)
    count = len(scan.ranges)
    thin = max(1, -(-count // MOST_RAYS))
    increment = scan.angle_increment * thin
    if not (math.isfinite(scan.angle_min) and math.isfinite(increment)):
        raise ViewerError(f'a scan begins at {scan.angle_min} rad, every {increment} rad')
    head = Scan(
        _origin(origin, scan.header),
        scan.angle_min,
        increment,
        _finite(scan.range_min),
        _finite(scan.range_max),
        count,
    )
    return head, (np.ascontiguousarray(scan.ranges[::thin], '<f4'),)


def _cloud(data: bytes, origin: Origin, most: int = MOST_POINTS) -> tuple[Head, Parts]:
    cloud: CloudData = readers.CLOUD.read(data)
    step, count = cloud.point_step, cloud.width * cloud.height
    octets, row = cloud.data, cloud.width * cloud.point_step
    if cloud.height > 1 and 0 < row < cloud.row_step <= len(octets) // cloud.height:
        rows = octets[: cloud.height * cloud.row_step].reshape(cloud.height, cloud.row_step)
        octets = rows[:, :row].reshape(-1)
    found = thinned(count, step, cloud.fields, octets, is_bigendian=cloud.is_bigendian, most=most)
    head = Cloud(_origin(origin, cloud.header), count, found.colouring, found.low, found.high)
    return head, (found.points, np.ascontiguousarray(found.colours))


def _whole_cloud(data: bytes, origin: Origin) -> tuple[Head, Parts]:
    return _cloud(data, origin, WHOLE_POINTS)


def _image(data: bytes, origin: Origin) -> tuple[Head, Parts]:
    image: ImageData = readers.IMAGE.read(data)
    picture = picture_of_pixels(
        image.encoding,
        image.width,
        image.height,
        image.step,
        image.data,
        is_bigendian=image.is_bigendian,
    )
    return _picture(_origin(origin, image.header), image.encoding, picture)


def _compressed_image(data: bytes, origin: Origin) -> tuple[Head, Parts]:
    image: CompressedData = readers.COMPRESSED_IMAGE.read(data)
    picture = picture_of_file(image.data.tobytes())
    return _picture(_origin(origin, image.header), shorten(image.format), picture)


def _picture(origin: Origin, encoding: str, picture: SmallPicture) -> tuple[Head, Parts]:
    size = (picture.width, picture.height, picture.low, picture.high)
    return Picture(origin, picture.format, encoding, *size), (picture.data,)


def _range(data: bytes, origin: Origin) -> tuple[Head, Parts]:
    found: RangeData = readers.RANGE.read(data)
    head = Distance(
        _origin(origin, found.header),
        _finite(found.field_of_view),
        _finite(found.min_range),
        _finite(found.max_range),
    )
    return head, (np.array([found.range], '<f4'),)


def _gz_contacts(data: bytes, origin: Origin) -> tuple[Head, Parts]:
    found = readers.CONTACTS.read(data)
    return _contacts(replace(found, header=replace(found.header, frame=_WORLD)), origin)


def _classic_contacts(data: bytes, origin: Origin) -> tuple[Head, Parts]:
    return _contacts(readers.CONTACTS_STATE.read(data), origin)


def _contacts(found: ContactsData, origin: Origin) -> tuple[Head, Parts]:
    named = tuple(
        ContactInfo(shorten(each.first), shorten(each.second), len(each.points), each.force)
        for each in found.contacts[:_SHOWN_CONTACTS]
    )
    places = [np.hstack([each.points, each.normals]) for each in found.contacts]
    joined = np.concatenate([np.empty((0, PLACE_FLOATS)), *places])
    return Contacts(_origin(origin, found.header), named), (joined[:_MOST_PLACES].astype('<f4'),)


def _origin(origin: Origin, header: Header) -> Origin:
    return replace(origin, frame=frame_name(header.frame), stamp=header.stamp / NANOSECONDS)


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None


CONVERTERS: Mapping[str, Converter] = {
    LASER_SCAN: _scan,
    CLOUD: _cloud,
    IMAGE: _image,
    COMPRESSED_IMAGE: _compressed_image,
    RANGE: _range,
    GZ_CONTACTS: _gz_contacts,
    CLASSIC_CONTACTS: _classic_contacts,
    OCCUPANCY_GRID: grid_sample,
    PATH: path_sample,
    MARKER: marker_sample,
    MARKERS: markers_sample,
    POSES: poses_sample,
    POLYGON: polygon_sample,
    POINT: point_sample,
}
"""By the type of the message."""
