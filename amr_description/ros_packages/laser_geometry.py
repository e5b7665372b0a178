# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``laser_geometry``: the points of a scan, in the frame of the lidar."""

# ruff: noqa: N802

from typing import Final

import numpy as np
from sensor_msgs.msg import LaserScan, PointCloud2, PointField

_FLOAT = PointField.FLOAT32


class LaserProjection:
    """
    Projects scans.

    A point has x, y, z, and what ``channel_options`` asks for: the intensity, the index of its
    ray, its distance, its time after the stamp, and where the lidar was (0, as nothing moves it).
    """

    class ChannelOption:
        """What a point has beside its place; several are added up."""

        NONE: Final = 0x00
        INTENSITY: Final = 0x01
        INDEX: Final = 0x02
        DISTANCE: Final = 0x04
        TIMESTAMP: Final = 0x08
        VIEWPOINT: Final = 0x10
        DEFAULT: Final = 0x03

    def projectLaser(
        self,
        scan_in: LaserScan,
        range_cutoff: float = -1.0,
        channel_options: int = ChannelOption.DEFAULT,
    ) -> PointCloud2:
        """
        Return the points of a scan that lie between its least range and the cutoff.

        Args:
            scan_in: The scan.
            range_cutoff: m; below 0: the greatest range of the scan.
            channel_options: Of :class:`ChannelOption`.
        """
        ranges = np.array(scan_in.ranges, dtype=float)
        angles = scan_in.angle_min + scan_in.angle_increment * np.arange(len(ranges))
        cutoff = scan_in.range_max if range_cutoff < 0.0 else min(range_cutoff, scan_in.range_max)
        kept = (ranges >= scan_in.range_min) & (ranges < cutoff)
        index = np.flatnonzero(kept)
        far = ranges[kept]
        columns = {
            'x': far * np.cos(angles[kept]),
            'y': far * np.sin(angles[kept]),
            'z': np.zeros(len(far)),
        }
        option = self.ChannelOption
        if channel_options & option.INTENSITY and len(scan_in.intensities) == len(ranges):
            columns['intensity'] = np.array(scan_in.intensities, dtype=float)[kept]
        if channel_options & option.INDEX:
            columns['index'] = index
        if channel_options & option.DISTANCE:
            columns['distances'] = far
        if channel_options & option.TIMESTAMP:
            columns['stamps'] = index * scan_in.time_increment
        if channel_options & option.VIEWPOINT:
            columns |= {f'vp_{axis}': np.zeros(len(far)) for axis in 'xyz'}
        types = [(name, '<i4' if name == 'index' else '<f4') for name in columns]
        points = np.zeros(len(far), types)
        for name, values in columns.items():
            points[name] = values
        cloud = PointCloud2(header=scan_in.header, height=1, width=len(far), is_dense=False)
        cloud.fields = [
            PointField(
                name=name,
                offset=4 * place,
                datatype=PointField.INT32 if name == 'index' else _FLOAT,
                count=1,
            )
            for place, name in enumerate(columns)
        ]
        cloud.point_step = 4 * len(columns)
        cloud.row_step = cloud.point_step * len(far)
        cloud.data = points.tobytes()
        return cloud
