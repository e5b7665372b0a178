# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What Nav2 hears of a drive, recorded with its QoS, and what is wrong with it."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf

from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data, qos_profile_system_default
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from amr_description.errors import TransformException
from amr_description.ros.messages import nanoseconds, transform_of
from amr_description.ros.qos import CLOCK, TF_STATIC
from amr_description.tf2_ros.buffer import stamped_transform
from amr_description.tf2_ros.buffer_core import BufferCore
from amr_description.tf2_ros.time_cache import StampedTransform

HOUR = 3_600_000_000_000
"""ns."""


@dataclass
class NavigationLog:
    """The messages of a drive, each list in the order in which they came."""

    scans: list[LaserScan] = field(default_factory=list)
    odometry: list[Odometry] = field(default_factory=list)
    clock: list[int] = field(default_factory=list)
    transforms: list[StampedTransform] = field(default_factory=list)
    static_transforms: list[StampedTransform] = field(default_factory=list)

    @contextmanager
    def recording(self, node: Node) -> Iterator[None]:
        """Subscribe as Nav2's costmaps, transform listeners, odometry smoother and clocks do."""

        def hear_tf(message: TFMessage) -> None:
            self.transforms += map(stamped_transform, message.transforms)

        def hear_static(message: TFMessage) -> None:
            self.static_transforms += map(stamped_transform, message.transforms)

        def hear_clock(message: Clock) -> None:
            self.clock.append(nanoseconds(message.clock))

        subscribe = node.create_subscription
        subscriptions = (
            subscribe(LaserScan, '/scan', self.scans.append, qos_profile_sensor_data),
            subscribe(TFMessage, '/tf', hear_tf, 100),
            subscribe(TFMessage, '/tf_static', hear_static, TF_STATIC),
            subscribe(Odometry, '/odom', self.odometry.append, qos_profile_system_default),
            subscribe(Clock, '/clock', hear_clock, CLOCK),
        )
        yield
        for each in subscriptions:
            node.destroy_subscription(each)

    def is_complete_at(self, stamp: int) -> bool:
        """
        Return whether a scan was heard, what came with it, and the transforms of all of it.

        Args:
            stamp: Of the scan, ns.
        """
        if not (self.scans and self.odometry and self.clock):
            return False
        odometry = nanoseconds(self.odometry[-1].header.stamp)
        if min(nanoseconds(self.scans[-1].header.stamp), odometry, self.clock[-1]) < stamp:
            return False
        return self._has_moved('odom', stamp) and self._has_moved('base_footprint', odometry)

    def _has_moved(self, child: str, stamp: int) -> bool:
        return any(
            each.child == child and each.time >= stamp for each in reversed(self.transforms)
        )

    def buffer(self) -> BufferCore:
        """Return all transforms, as a listener with a long memory has them."""
        core = BufferCore(HOUR)
        for transform in self.static_transforms:
            core.set_transform(transform, 'log', static=True)
        for transform in self.transforms:
            core.set_transform(transform, 'log', static=False)
        return core

    def faults(self, period: int) -> Iterator[str]:
        """
        Yield what a planner could not work with.

        Args:
            period: Of the scans, ns.
        """
        core = self.buffer()
        for scan in self.scans:
            stamp = nanoseconds(scan.header.stamp)
            try:
                core.lookup_transform('map', scan.header.frame_id, stamp)
            except TransformException as error:
                yield f'scan of {stamp}: {error}'
            if len(scan.ranges) != len(self.scans[0].ranges):
                yield f'scan of {stamp}: {len(scan.ranges)} rays'
        stamps = [nanoseconds(each.header.stamp) for each in self.scans]
        for before, after in pairwise(stamps):
            if after - before != period:
                yield f'scan of {after} after {before}'
        yield from _not_rising('odometry', [nanoseconds(o.header.stamp) for o in self.odometry])
        for before, now in pairwise(self.clock):
            if now < before:  # the same again while time stands still
                yield f'clock of {now} after {before}'
        yield from self._faults_of_tree()
        yield from self._faults_of_odometry(core)
        if stamps and self.clock[-1] < stamps[-1]:
            yield f'the clock is at {self.clock[-1]}, the last scan of {stamps[-1]}'

    def _faults_of_tree(self) -> Iterator[str]:
        both = [*self.static_transforms, *self.transforms]
        for child in sorted({each.child for each in both}):
            parents = {each.parent for each in both if each.child == child}
            if len(parents) > 1:
                yield f'{child} has the parents {sorted(parents)}'
            moving = [each.time for each in self.transforms if each.child == child]
            yield from _not_rising(child, moving)

    def _faults_of_odometry(self, core: BufferCore) -> Iterator[str]:
        for message in self.odometry:
            stamp, pose = nanoseconds(message.header.stamp), transform_of(message.pose.pose)
            frames = (message.header.frame_id, message.child_frame_id)
            try:
                by_tf = core.lookup_transform(*frames, stamp).transform
            except TransformException as error:
                yield f'odometry of {stamp}: {error}'
                continue
            pairs = zip(by_tf.translation, pose.translation, strict=True)
            if max(abs(one - other) for one, other in pairs) > 1e-9:
                yield f'odometry of {stamp} is not that of TF'


def _not_rising(what: str, stamps: list[int]) -> Iterator[str]:
    last = -inf
    for stamp in stamps:
        if stamp <= last:
            yield f'{what} of {stamp} after {last}'
        last = stamp
