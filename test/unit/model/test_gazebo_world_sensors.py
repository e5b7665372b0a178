# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Lidars and cameras of ``<gazebo>`` blocks: what is read, SDF's defaults, topics and frames."""

import math

import pytest

from amr_description.model.gazebo_sensors import robot_sensors_of
from amr_description.model.sensors import Intrinsics, ScanAxis
from amr_description.model.urdf import parse

RANGE = '<range><min>0.1</min><max>10</max></range>'


def robot_of(inside):
    return parse(
        f"""<robot name="r"><link name="base"/><link name="eye"/><link name="eye_optical"/>
        <joint name="a" type="fixed"><parent link="base"/><child link="eye"/></joint>
        <joint name="b" type="fixed"><origin rpy="-1.5707963 0 -1.5707963"/>
          <parent link="eye"/><child link="eye_optical"/></joint>
        {inside}</robot>""",
        'r.urdf',
    )


def sensor_of(kind, inside, link='eye', name='s'):
    sensor = f'<sensor name="{name}" type="{kind}">{inside}</sensor>'
    found = robot_sensors_of(robot_of(f'<gazebo reference="{link}">{sensor}</gazebo>'))
    assert not found.notes
    (sensor,) = found.sensors
    return sensor


@pytest.mark.parametrize('kind', ['gpu_lidar', 'lidar', 'gpu_ray', 'ray'])
@pytest.mark.parametrize('inside', ['lidar', 'ray'])
def test_a_lidar_has_the_defaults_of_sdf(kind, inside):
    scan = '<scan><horizontal><max_angle>1</max_angle></horizontal></scan>'
    lidar = sensor_of(kind, f'<{inside}>{scan}{RANGE}</{inside}>')
    assert (lidar.horizontal, lidar.vertical) == (ScanAxis(640, 0.0, 1.0), ScanAxis(1, 0.0, 0.0))
    assert (lidar.range_min, lidar.range_max, lidar.range_resolution) == (0.1, 10.0, 0.0)
    assert (lidar.scan_topic, lidar.points_topic) == ('scan', 'scan/points')
    assert (lidar.mount.frame, lidar.mount.rate) == ('eye', 0.0)


def test_a_lidar_is_read():
    lidar = sensor_of(
        'gpu_lidar',
        """<pose>0 0 0.1 0 0 0</pose><update_rate>10</update_rate><topic>/model/r/front</topic>
        <gz_frame_id>base</gz_frame_id><lidar><scan>
        <horizontal><samples>360</samples><resolution>0.5</resolution>
          <min_angle>-1</min_angle><max_angle>1</max_angle></horizontal>
        <vertical><samples>16</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle>
        </vertical></scan><range><min>0.2</min><max>inf</max><resolution>0.01</resolution></range>
        <noise><type>gaussian</type><mean>0.01</mean><stddev>0.02</stddev></noise></lidar>""",
    )
    assert lidar.mount.pose.translation == (0.0, 0.0, 0.1)
    assert (lidar.mount.link, lidar.mount.frame, lidar.mount.rate) == ('eye', 'base', 10.0)
    assert lidar.horizontal == ScanAxis(180, -1.0, 1.0)
    assert lidar.vertical == ScanAxis(16, -0.2, 0.2)
    assert (lidar.range_max, lidar.range_resolution) == (math.inf, 0.01)
    assert (lidar.noise.mean, lidar.noise.stddev) == (0.01, 0.02)
    assert lidar.scan_topic == 'front'


def test_a_camera_has_the_defaults_of_sdf():
    camera = sensor_of('camera', '<camera/>', name='my-eye')
    assert (camera.width, camera.height, camera.horizontal_fov) == (320, 240, 1.047)
    assert (camera.near, camera.far, camera.intrinsics) == (0.1, 100.0, None)
    assert (camera.image_topic, camera.camera_info_topic) == ('my_eye/image', 'my_eye/camera_info')
    assert camera.mount.frame == 'eye_optical'


def test_cameras_are_on_the_topics_of_gazebo():
    topic = '<topic>cam/image_raw</topic>'
    camera = sensor_of('camera', f'{topic}<camera/>')
    assert (camera.image_topic, camera.camera_info_topic) == ('cam/image_raw', 'cam/camera_info')
    named = '<camera><camera_info_topic>info</camera_info_topic></camera>'
    assert sensor_of('camera', topic + named).camera_info_topic == 'info'
    depth = sensor_of('depth_camera', f'{topic}<camera/>')
    assert depth.image_topic == depth.camera_info_topic == ''
    assert depth.depth_topic == 'cam/image_raw'
    assert depth.points_topic == 'cam/image_raw/points'
    assert depth.depth_camera_info_topic == 'cam/camera_info'
    both = sensor_of('rgbd_camera', '<topic>/cam</topic><camera/>')
    assert (both.image_topic, both.depth_topic) == ('/cam/image', '/cam/depth_image')
    assert (both.points_topic, both.camera_info_topic) == ('/cam/points', '/cam/camera_info')


def test_the_points_of_a_depth_camera_have_the_axes_of_their_frame():
    def is_optical(tag):
        return sensor_of('rgbd_camera', f'{tag}<camera/>').points_are_optical

    assert is_optical('') and is_optical('<gz_frame_id>eye_optical</gz_frame_id>')
    assert not is_optical('<gz_frame_id>eye</gz_frame_id>')
    along_z = '<pose>0 0 0 0 -1.5707963 0</pose>'  # of the link, whose axes are optical then
    assert is_optical(f'{along_z}<frame_id>eye</frame_id>')


def test_the_lens_of_a_camera():
    camera = sensor_of(
        'camera',
        """<camera><horizontal_fov>1.5</horizontal_fov><image><width>64</width><height>48</height>
        <format>L8</format></image><clip><near>0.2</near><far>300</far></clip>
        <lens><intrinsics><fx>50</fx><fy>51</fy><cx>32</cx><cy>24</cy></intrinsics></lens>
        <distortion><k1>-0.1</k1><p2>0.2</p2></distortion>
        <noise type="gaussian"><stddev>0.007</stddev></noise></camera>""",
    )
    assert (camera.width, camera.height, camera.encoding) == (64, 48, 'mono8')
    assert (camera.near, camera.far, camera.depth_far) == (0.2, 300.0, 300.0)
    assert camera.intrinsics == Intrinsics(50.0, 51.0, 32.0, 24.0)
    assert (camera.distortion.k1, camera.distortion.p2) == (-0.1, 0.2)
    assert camera.noise.stddev == 0.007
