# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics of a lidar or range finder: LaserScan, PointCloud2, Range.

One of a few rays measures on the control thread: 0.15 ms for 360 rays, so that its scan goes out
in the cycle of its instant. One of many, or whose rays take long as the world has fine meshes,
measures on the thread of the :class:`~amr_description.simulation.topics.worker.SensorWorker`.
Either way its bits are the same. Where time waits, only the number of rays counts, so that the
order of messages does not depend on how fast the machine is.
"""

from collections.abc import Callable
from functools import partial
import time as wall
from typing import Any, TypeAlias

import numpy as np

from amr_description.cdr.template import template_of
from amr_description.clock import NANOSECONDS
from amr_description.messages.definitions import layout_of
from amr_description.messages.plain import message_like, PlainMessage
from amr_description.model.sensors import Lidar
from amr_description.sim.lidar import (
    cloud_rays,
    LidarScan,
    met_ranges,
    scan_angles,
    SimulatedLidar,
)
from amr_description.sim.sensor_schedule import CycleBudget
from amr_description.sim.state_copy import StateCopy
from amr_description.simulation.topics.sensor_topics import SensorContext, SensorTopics

# --- Messages ------------------------------------------------------------------------------------
#
# Everything but the stamp and the numbers that are measured is serialized once: 360 ranges and
# intensities to a reader in another process take 10 µs of processor time, as a message of rclpy
# 19.

SCAN, CLOUD, RANGE = (f'sensor_msgs/msg/{name}' for name in ('LaserScan', 'PointCloud2', 'Range'))
POINT_FIELD = 'sensor_msgs/msg/PointField'
UINT16, FLOAT32 = 4, 7
"""Values of its ``datatype``."""

ScanEncoder: TypeAlias = Callable[[LidarScan], bytes]

POINT = np.dtype(
    {
        'names': ['x', 'y', 'z', 'intensity', 'ring'],
        'formats': ['<f4', '<f4', '<f4', '<f4', '<u2'],
        'offsets': [0, 4, 8, 16, 24],
        'itemsize': 32,
    }
)
"""Fields and layout of the points of gz-sensors, as ros_gz_bridge passes them on."""
_DATA_TYPES = {'f4': FLOAT32, 'u2': UINT16}


def scan_encoder(lidar: Lidar, frame: str) -> ScanEncoder:
    """
    Return what makes LaserScans, of several rings of the middle one.

    All rays are of the same instant: ``time_increment`` and ``scan_time`` are 0, as in gz.

    Args:
        lidar: The sensor.
        frame: Of the messages.
    """
    message = PlainMessage(SCAN)
    message.header.frame_id = frame
    message.angle_min, message.angle_max, message.angle_increment = scan_angles(lidar.horizontal)
    message.range_min, message.range_max = lidar.range_min, lidar.range_max
    message.ranges = message.intensities = [0.0] * lidar.horizontal.samples
    arrays = ('ranges', 'intensities')
    template = template_of(layout_of(SCAN), message, ('header.stamp', *arrays), blocks=arrays)
    pack = template.pack
    begin, geometry, size, end = template.constants

    def encode(scan: LidarScan) -> bytes:
        ring = scan.middle_ring
        ranges, intensities = scan.ranges[ring].tobytes(), scan.intensities[ring].tobytes()
        stamp = divmod(scan.time, NANOSECONDS)
        return pack(begin, *stamp, geometry, ranges, size, intensities, end)

    return encode


def points_encoder(lidar: Lidar, frame: str) -> ScanEncoder:
    """
    Return what makes PointCloud2s: a row for each ring, from the lowest elevation up.

    x, y and z are NaN where a range is infinite, which is what ``skip_nans`` of readers leaves
    out; ``is_dense`` says whether there is none.

    Args:
        lidar: The sensor.
        frame: Of the messages.
    """
    shape = (lidar.vertical.samples, lidar.horizontal.samples)
    points = np.zeros(shape, POINT)
    points['ring'] = np.arange(shape[0])[:, None]
    rays = cloud_rays(lidar)
    message = PlainMessage(CLOUD)
    message.header.frame_id = frame
    message.height, message.width = shape
    message.fields = [_field(message, name) for name in POINT.names or ()]
    message.point_step = POINT.itemsize
    message.row_step = POINT.itemsize * shape[1]
    message.data = bytes(points.nbytes)
    changing = ('header.stamp', 'data', 'is_dense')
    template = template_of(layout_of(CLOUD), message, changing, blocks=('data',))
    pack = template.pack
    begin, layout, density, end = template.constants

    def encode(scan: LidarScan) -> bytes:
        ranges = met_ranges(scan)
        for axis, name in enumerate('xyz'):
            np.multiply(ranges, rays[:, :, axis], out=points[name])
        points['intensity'] = scan.intensities
        stamp, is_dense = divmod(scan.time, NANOSECONDS), not np.isnan(ranges).any()
        return pack(begin, *stamp, layout, points.tobytes(), density, is_dense, end)

    return encode


def range_encoder(lidar: Lidar, frame: str) -> ScanEncoder:
    """
    Return what makes Ranges: the nearest of all rays.

    As REP 117 wants it, that is -inf if one of them is too near, and +inf if none meets anything.
    ``field_of_view`` is the larger one of both axes, as of gazebo_ros.

    Args:
        lidar: The sensor.
        frame: Of the messages.
    """
    message = PlainMessage(RANGE)
    message.header.frame_id = frame
    message.radiation_type = lidar.radiation_type
    axes = lidar.horizontal, lidar.vertical
    message.field_of_view = max(
        axis.upper - axis.lower if axis.samples > 1 else 0.0 for axis in axes
    )
    message.min_range, message.max_range = lidar.range_min, lidar.range_max
    message.variance = lidar.noise.stddev**2
    template = template_of(layout_of(RANGE), message, ('header.stamp', 'range'))
    pack = template.pack
    begin, geometry, end = template.constants

    def encode(scan: LidarScan) -> bytes:
        stamp = divmod(scan.time, NANOSECONDS)
        return pack(begin, *stamp, geometry, float(scan.ranges.min()), end)

    return encode


def _field(message: PlainMessage, name: str) -> Any:
    fields = POINT.fields
    assert fields is not None, 'points have fields'
    kind, offset = fields[name][:2]
    datatype = _DATA_TYPES[kind.str[1:]]
    return message_like(message, POINT_FIELD, name=name, offset=offset, datatype=datatype, count=1)


MOST_RAYS = 1500
"""What all lidars together may cast on the control thread in one cycle, 0.6 ms in ``warehouse``.

Those that would exceed it, such as the fifth of a fleet, measure on the other thread."""
LONGEST = 0.001
"""s of processor time of one measurement; in real time a slower lidar leaves the thread."""


def ray_budget() -> CycleBudget:
    """Return the rays that the lidars of one world may cast on the control thread."""
    return CycleBudget(MOST_RAYS)


class LidarTopics(SensorTopics):
    """The topics of one lidar."""

    def __init__(self, lidar: Lidar, context: SensorContext) -> None:
        """
        Create the topics.

        Args:
            lidar: The sensor.
            context: What it is given.

        Raises:
            SimulationError: The robot has no such link.
        """
        self._context = context
        self._rays = lidar.horizontal.samples * lidar.vertical.samples
        self._has_many_rays = self._rays > MOST_RAYS
        self._is_slow = False
        self._task = context.worker.task(
            f"lidar '{lidar.mount.name}' of '{context.robot.name}'",
            'a lower <update_rate> or fewer <samples> would do',
        )
        self._lidar = SimulatedLidar(lidar, context.robot)
        frame = context.frame(lidar.mount.frame or lidar.mount.link)
        kinds: tuple[tuple[str, str, Callable[[Lidar, str], ScanEncoder]], ...] = (
            (lidar.scan_topic, 'LaserScan', scan_encoder),
            (lidar.points_topic, 'PointCloud2', points_encoder),
            (lidar.range_topic, 'Range', range_encoder),
        )
        self._topics = tuple(
            context.advertise(
                name, lidar.mount, f'sensor_msgs/msg/{kind}', encoder_of(lidar, frame)
            )
            for name, kind, encoder_of in kinds
            if name
        )

    @property
    def has_subscribers(self) -> bool:
        """Whether anybody subscribes to one of them; nothing is measured else."""
        return any(topic.has_subscribers for topic in self._topics)

    def measure(self, time: int) -> None:
        """Measure, and publish; ``time``: of this cycle, ns."""
        context, lidar = self._context, self._lidar
        is_aside = self._has_many_rays or (self._is_slow and context.worker.is_paced())
        if not (is_aside or context.ray_budget.take(time, self._rays)):
            # For good: each thread would find out anew what it sees.
            is_aside = self._has_many_rays = True
        if is_aside:
            state = context.states.copy()
            self._task.request(partial(self._make, time, lidar.body(), state))
            return
        begin = wall.thread_time()
        scene = context.world.ray_scene()
        is_usual = lidar.is_bound_to(scene)
        scan = lidar.measure(time, lidar.body(), scene)
        for topic in self._topics:
            topic.send(scan)
        self._is_slow = is_usual and wall.thread_time() - begin > LONGEST

    def _make(self, time: int, body: int, state: StateCopy) -> None:
        """Measure from a copy, and publish; on the thread of the worker."""
        scan = self._lidar.measure(time, body, self._context.scenes.scene(state))
        for topic in self._topics:
            if topic.has_subscribers:
                topic.write_aside(scan)
