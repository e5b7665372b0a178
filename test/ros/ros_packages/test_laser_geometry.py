# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``laser_geometry`` by its own name."""

import math

from laser_geometry import LaserProjection
import numpy as np
import pytest
from sensor_msgs.msg import LaserScan
from sensor_msgs_py.point_cloud2 import read_points

OPTION = LaserProjection.ChannelOption


def scan(*ranges, intensities=()):
    message = LaserScan(
        angle_min=-math.pi / 2, angle_increment=math.pi / 2, range_min=0.1, range_max=10.0,
        ranges=ranges, intensities=intensities, time_increment=0.5,
    )  # fmt: skip
    message.header.frame_id = 'laser'
    message.header.stamp.sec = 7
    return message


def test_points_lie_where_rays_end():
    cloud = LaserProjection().projectLaser(scan(1.0, 2.0, 3.0, intensities=[5.0, 6.0, 7.0]))
    assert (cloud.header.frame_id, cloud.header.stamp.sec) == ('laser', 7)
    assert (cloud.height, cloud.width, cloud.point_step) == (1, 3, 20)
    points = read_points(cloud)
    assert points.dtype.names == ('x', 'y', 'z', 'intensity', 'index')
    assert np.stack([points['x'], points['y']], axis=1) == pytest.approx(
        np.array([[0.0, -1.0], [2.0, 0.0], [0.0, 3.0]]), abs=1e-6
    )
    assert points['intensity'].tolist() == [5.0, 6.0, 7.0]
    assert points['index'].tolist() == [0, 1, 2]


def test_rays_without_an_end_have_no_point():
    bad = (math.inf, math.nan, 0.05, 10.0, 4.0)
    cloud = LaserProjection().projectLaser(scan(*bad))
    assert read_points(cloud)['index'].tolist() == [4]
    assert LaserProjection().projectLaser(scan(*bad), range_cutoff=3.0).width == 0
    assert LaserProjection().projectLaser(scan()).width == 0


def test_points_have_what_is_asked_for():
    everything = OPTION.DISTANCE | OPTION.TIMESTAMP | OPTION.VIEWPOINT | OPTION.INTENSITY
    cloud = LaserProjection().projectLaser(scan(1.0, 2.0), channel_options=everything)
    points = read_points(cloud)
    assert points.dtype.names == ('x', 'y', 'z', 'distances', 'stamps', 'vp_x', 'vp_y', 'vp_z')
    assert points['distances'].tolist() == [1.0, 2.0]
    assert points['stamps'].tolist() == [0.0, 0.5]
    none = LaserProjection().projectLaser(scan(1.0), channel_options=OPTION.NONE)
    assert [each.name for each in none.fields] == ['x', 'y', 'z']
