# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What Gazebo Classic's plugins of sensors publish, by their own names and defaults."""

import math

import pytest

from amr_description.model.gazebo.sensors import robot_sensors_of
from amr_description.model.urdf import parse

RAY = """<ray><scan><horizontal><samples>9</samples><min_angle>-1</min_angle>
  <max_angle>1</max_angle></horizontal></scan>
  <range><min>0.1</min><max>10</max></range></ray>"""
DEPTH = '<camera><clip><near>0.05</near><far>8</far></clip></camera>'


def read(kind, library, inside='', sensor=None):
    sensor = {'camera': '<camera/>', 'depth': DEPTH, 'contact': ''}.get(kind, RAY) + (sensor or '')
    text = f"""<robot name="r"><link name="base"/><link name="eye"/>
      <joint name="a" type="fixed"><parent link="base"/><child link="eye"/></joint>
      <gazebo reference="base"><sensor name="s-1" type="{kind}">{sensor}
        <plugin name="node" filename="libgazebo_ros_{library}.so">{inside}</plugin>
      </sensor></gazebo></robot>"""
    return robot_sensors_of(parse(text, 'r.urdf'))


def sensor_of(kind, library, inside='', sensor=None):
    found = read(kind, library, inside, sensor)
    assert not found.findings and not found.lacking
    (sensor,) = found.sensors
    return sensor


def topics_of(sensor, namespace='/'):
    return {
        sensor.mount.full_name(topic, namespace): kind.rpartition('/')[2]
        for topic, kind in sensor.topics
    }


TO_SCAN = '<remapping>~/out:=scan</remapping>'
SCAN = '<output_type>sensor_msgs/LaserScan</output_type>'
IR = {'/cam/ir/image_raw': 'Image', '/cam/ir/camera_info': 'CameraInfo'}
COLOUR = {'/cam/image_raw': 'Image', '/cam/camera_info': 'CameraInfo'}
DEEP = {
    '/cam/depth/image_raw': 'Image',
    '/cam/depth/camera_info': 'CameraInfo',
    '/cam/points': 'PointCloud2',
}
NAMES = [
    ('ray', 'ray_sensor', '', {'/node/out': 'PointCloud2'}),
    ('ray', 'ray_sensor', f'<ros>{TO_SCAN}</ros>{SCAN}', {'/scan': 'LaserScan'}),
    (
        'gpu_ray',
        'ray_sensor',
        f'<ros><namespace>/r1</namespace><argument>~/out:=front/scan</argument></ros>{SCAN}',
        {'/r1/front/scan': 'LaserScan'},
    ),
    (
        'ray',
        'ray_sensor',
        '<ros><remapping>~/out:=/sonar</remapping></ros><output_type>sensor_msgs/Range'
        '</output_type>',
        {'/sonar': 'Range'},
    ),
    ('ray', 'laser', '<topicName>/base/scan</topicName>', {'/base/scan': 'LaserScan'}),
    (
        'gpu_ray',
        'gpu_laser',
        '<robotNamespace>/r1</robotNamespace><topicName>scan</topicName>',
        {'/r1/scan': 'LaserScan'},
    ),
    ('ray', 'laser', '', {'/scan': 'LaserScan'}),
    ('ray', 'range', '', {'/range': 'Range'}),
    ('ray', 'velodyne_laser', '', {'/velodyne_points': 'PointCloud2'}),
    (
        'gpu_ray',
        'velodyne_gpu_laser',
        '<ros><namespace>velodyne</namespace><remapping>~/out:=points</remapping></ros>',
        {'/velodyne/points': 'PointCloud2'},
    ),
    ('camera', 'camera', '', {'/s_1/image_raw': 'Image', '/s_1/camera_info': 'CameraInfo'}),
    ('camera', 'camera', '<camera_name>cam</camera_name>', COLOUR),
    (
        'camera',
        'camera',
        '<camera_name>cam</camera_name><ros><remapping>cam/image_raw:=picture</remapping></ros>',
        {'/picture': 'Image', '/cam/camera_info': 'CameraInfo'},
    ),
    ('depth', 'camera', '<camera_name>cam</camera_name>', COLOUR | DEEP),
    (
        'camera',
        'camera',
        """<robotNamespace>r1</robotNamespace><cameraName>cam</cameraName>
        <imageTopicName>rgb</imageTopicName><cameraInfoTopicName>rgb/info</cameraInfoTopicName>""",
        {'/r1/cam/rgb': 'Image', '/r1/cam/rgb/info': 'CameraInfo'},
    ),
    ('depth', 'openni_kinect', '<cameraName>cam</cameraName>', IR | DEEP),
    (
        'depth',
        'depth_camera',
        '<cameraName>cam</cameraName><pointCloudTopicName>cloud</pointCloudTopicName>',
        COLOUR | {name.replace('points', 'cloud'): kind for name, kind in DEEP.items()},
    ),
    ('contact', 'bumper', '', {'/bumper_states': 'ContactsState'}),
    ('contact', 'bumper', '<bumperTopicName>bump</bumperTopicName>', {'/bump': 'ContactsState'}),
]


@pytest.mark.parametrize('kind, library, inside, topics', NAMES)
def test_topics_and_types(kind, library, inside, topics):
    sensor = sensor_of(kind, library, inside)
    assert topics_of(sensor) == topics
    assert sensor.mount.frame == ('world' if library == 'bumper' else 'base')


def test_the_namespace_of_the_robot_counts_before_that_of_the_plugin():
    rules = f'<ros><namespace>/r1</namespace>{TO_SCAN}</ros>{SCAN}'
    assert topics_of(sensor_of('ray', 'ray_sensor', rules), '/r2') == {'/r2/scan': 'LaserScan'}


@pytest.mark.parametrize('tag', ['frame_name', 'frameName'])
def test_the_frame_is_the_one_that_the_plugin_names(tag):
    assert sensor_of('camera', 'camera', f'<{tag}>/eye</{tag}>').mount.frame == 'eye'


def test_the_depth_that_counts_is_that_of_the_plugin_within_the_clip():
    def depths(library, inside=''):
        camera = sensor_of('depth', library, f'<cameraName>cam</cameraName>{inside}')
        return camera.depth_near, camera.depth_far, camera.near, camera.far

    given = '<min_depth>0.01</min_depth><max_depth>3</max_depth>'
    assert depths('camera', given) == (0.05, 3.0, 0.05, 8.0)
    assert depths('openni_kinect') == (0.4, 5.0, 0.05, 8.0)
    camera = sensor_of('depth', 'camera', '<camera_name>cam</camera_name>')
    assert (camera.depth_near, camera.depth_far) == (0.4, 8.0)


def test_the_plugin_may_slow_the_sensor_down():
    fast, slow = '<update_rate>30</update_rate>', '<updateRate>10</updateRate>'
    assert sensor_of('camera', 'camera', slow, fast).mount.rate == 10.0
    assert sensor_of('camera', 'camera', '', fast).mount.rate == 30.0
    assert sensor_of('camera', 'camera', slow).mount.rate == 10.0


def test_range_finders_have_noise_and_a_kind_of_radiation():
    finder = sensor_of('ray', 'range', '<gaussianNoise>0.01</gaussianNoise>')
    assert (finder.noise.stddev, finder.radiation_type) == (0.01, 0)
    finder = sensor_of('ray', 'range', '<radiation>infrared</radiation>')
    assert (finder.noise.stddev, finder.radiation_type) == (0.0, 1)


def test_a_velodyne_has_limits_and_noise_in_its_plugin():
    inside = '<min_range>0.9</min_range><max_range>130</max_range><gaussian_noise>0.008'
    lidar = sensor_of('ray', 'velodyne_laser', f'{inside}</gaussian_noise>')
    assert (lidar.range_min, lidar.range_max, lidar.noise.stddev) == (0.9, 10.0, 0.008)


def test_a_stereo_pair_is_two_cameras():
    pair = """<camera name="left"><pose>0 0.1 0 0 0 0</pose></camera>
      <camera name="right"><pose>0 -0.1 0 0 0 0</pose><image><width>64</width></image></camera>"""
    text = f"""<robot name="r"><link name="base"/><gazebo reference="base">
      <sensor name="pair" type="multicamera"><pose>1 0 0 0 0 0</pose>{pair}
      <plugin name="p" filename="libgazebo_ros_multicamera.so">
        <cameraName>stereo</cameraName><hackBaseline>0.2</hackBaseline></plugin>
      </sensor></gazebo></robot>"""
    left, right = robot_sensors_of(parse(text)).sensors
    assert [*topics_of(left)] == ['/stereo/left/image_raw', '/stereo/left/camera_info']
    assert [*topics_of(right)] == ['/stereo/right/image_raw', '/stereo/right/camera_info']
    assert (left.baseline, right.baseline) == (0.0, 0.2)
    assert (left.width, right.width) == (320, 64)
    assert left.mount.pose.translation == (1.0, 0.1, 0.0)
    assert right.mount.pose.translation == (1.0, -0.1, 0.0)
    assert left.mount.name != right.mount.name


def test_what_ros_has_given_up_is_told():
    found = read('ray', 'block_laser')
    assert topics_of(found.sensors[0]) == {'/points': 'PointCloud2'}
    assert 'sensor_msgs/PointCloud is not published' in found.findings[0].text


@pytest.mark.parametrize(
    'kind, library, inside, message',
    [
        (
            'ray',
            'ray_sensor',
            '<output_type>LaserScn</output_type>',
            '<output_type>: found "LaserScn", expected sensor_msgs/LaserScan, ',
        ),
        (
            'ray',
            'camera',
            '',
            'plugin "libgazebo_ros_camera.so" does not work in it: found type "ray", expected one',
        ),
        (
            'depth',
            'camera',
            '<min_depth>9</min_depth>',
            '<min_depth> and <max_depth> of its plugin leave no depth: found 9 m to 8 m, with',
        ),
        (
            'depth',
            'camera',
            '<min_depth>nan</min_depth>',
            '<min_depth> of its plugin: found "nan", expected a number from 0 on',
        ),
        (
            'ray',
            'velodyne_laser',
            '<min_range>10</min_range>',
            '<min_range> and <max_range> of its plugin leave no range: found 10 m to 10 m',
        ),
        (
            'camera',
            'camera',
            '<updateRate>-1</updateRate>',
            '<update_rate> of its plugin: found "-1", expected a number from 0 on',
        ),
    ],
)
def test_a_plugin_that_cannot_work_is_told(kind, library, inside, message):
    found = read(kind, library, inside)
    assert not found.sensors
    assert f'gazebo sensor "s-1": {message}' in found.findings[0].text


def test_what_is_no_number_has_its_default():
    found = read('depth', 'camera', '<max_depth>far</max_depth>')
    assert math.isclose(found.sensors[0].depth_far, 8.0)
    assert '<max_depth> is "far", which is no number' in found.findings[0].text


def test_an_unknown_plugin_is_lacking():
    assert read('camera', 'thermal').lacking == (('s-1', 'camera'),)
