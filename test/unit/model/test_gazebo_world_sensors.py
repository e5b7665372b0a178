# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Sensors of ``<gazebo>`` blocks that look at the world: what is read, SDF's defaults, faults."""

import math

import pytest

from amr_description.model import checks
from amr_description.model.findings import Severity
from amr_description.model.gazebo.sensors import robot_sensors_of
from amr_description.model.sensors import Intrinsics, ScanAxis
from amr_description.model.urdf import parse

SCAN = '<scan><horizontal><max_angle>1</max_angle></horizontal></scan>'
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
    assert not found.findings
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
    assert (both.image_topic, both.depth_topic) == ('cam/image', 'cam/depth_image')
    assert (both.points_topic, both.camera_info_topic) == ('cam/points', 'cam/camera_info')


def test_topics_of_new_gazebo_are_in_the_namespace_of_the_robot_once():
    for topic in ('scan', '/scan', '/model/r/scan', 'r1/scan', '/r1/scan'):
        sensor = sensor_of('lidar', f'<topic>{topic}</topic><lidar>{SCAN}{RANGE}</lidar>')
        assert sensor.mount.full_name(sensor.scan_topic, '/r1') == '/r1/scan'
    assert sensor.mount.full_name('r10/scan', '/r1') == '/r1/r10/scan'
    assert sensor.mount.full_name('/scan', '/r1') == '/scan'


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


def test_a_contact_sensor_has_collisions_and_a_topic():
    def contact_of(inside):
        found = sensor_of('contact', f'<contact>{inside}</contact>', name='bump')
        return found.collisions, found.topic

    assert contact_of('') == ((), 'bump/contact')
    assert contact_of('<topic>__default_topic__</topic>') == ((), 'bump/contact')
    assert contact_of('<topic>/model/r/hit</topic>') == ((), 'hit')
    assert sensor_of('contact', '<topic>hit</topic>').topic == 'hit'
    named = '<contact><collision>front_collision</collision><collision/></contact>'
    body = '<collision name="front"><geometry><sphere radius="1"/></geometry></collision>'
    text = f"""<robot name="r"><link name="base">{body}</link><gazebo reference="base">
      <sensor name="s" type="contact">{named}</sensor></gazebo></robot>"""
    found = robot_sensors_of(parse(text))
    assert not found.findings and found.sensors[0].collisions == ('front_collision',)


@pytest.mark.parametrize(
    'mask, base, wheel, sees, told',
    [
        ('', '1', '1', True, 0),
        ('<visibility_mask>2</visibility_mask>', '1', '0x1', False, 0),
        ('<visibility_mask>0xFFFFFFFE</visibility_mask>', '1', '3', True, 1),
        ('<visibility_mask>all</visibility_mask>', '1', '1', True, 1),
        ('<visibility_mask>3</visibility_mask>', '1', '1', True, 0),
    ],
)
def test_a_mask_may_hide_the_robot_from_its_lidar(mask, base, wheel, sees, told):
    shape = '<visual><geometry><sphere radius="1"/></geometry></visual>'
    flags = ''.join(
        f'<gazebo reference="{link}"><visual><visibility_flags>{bits}</visibility_flags></visual>'
        '</gazebo>'
        for link, bits in (('base', base), ('wheel', wheel))
    )
    text = f"""<robot name="r"><link name="base">{shape}</link><link name="wheel">{shape}</link>
      <joint name="a" type="fixed"><parent link="base"/><child link="wheel"/></joint>{flags}
      <gazebo reference="base"><sensor name="s" type="lidar"><lidar>{SCAN}{RANGE}{mask}</lidar>
      </sensor></gazebo></robot>"""
    found = robot_sensors_of(parse(text))
    assert [each.sees_robot for each in found.sensors] == [sees]
    assert len(found.findings) == told


def test_several_lidars_without_a_topic_have_their_names():
    lidar = (
        f"""<lidar><scan><horizontal><max_angle>1</max_angle></horizontal></scan>{RANGE}</lidar>"""
    )
    tags = ''.join(f'<sensor name="{name}" type="lidar">{lidar}</sensor>' for name in 'ab')
    found = robot_sensors_of(robot_of(f'<gazebo reference="eye">{tags}</gazebo>')).sensors
    assert [each.scan_topic for each in found] == ['a/scan', 'b/scan']


def test_a_sensor_of_ros2_control_is_left_to_it():
    control = """<ros2_control name="c" type="sensor"><hardware><plugin>p</plugin></hardware>
      <sensor name="s"><state_interface name="range"/></sensor></ros2_control>"""
    sensor = '<gazebo reference="eye"><sensor name="s" type="camera"/></gazebo>'
    found = robot_sensors_of(robot_of(control + sensor))
    assert not found.sensors and not found.findings and not found.lacking


def ranged(inside):
    return f'<lidar>{SCAN}<range>{inside}</range></lidar>'


def scanned(horizontal, vertical=''):
    inside = f'<horizontal>{horizontal}</horizontal>{vertical}'
    return f'<lidar><scan>{inside}</scan>{RANGE}</lidar>'


FAULTS = [
    ('lidar', '', 'it has no <lidar>; write one, with <scan> and <range>'),
    ('lidar', f'<ray>{SCAN}</ray>', 'it has no <range> with a <max>; write, in <ray>,'),
    ('lidar', ranged(''), '<range> has no <max>'),
    ('lidar', ranged('<min>-1</min><max>3</max>'), '<min> of <range>: found "-1", expected m: a'),
    ('lidar', ranged('<min>nan</min><max>3</max>'), '<min> of <range>: found "nan", expected m'),
    ('lidar', ranged('<max>0x1</max>'), '<max> of <range>: found "0x1", expected m: a number'),
    ('lidar', ranged('<min>3</min><max>1</max>'), '<range>: found <min> 3, <max> 1, expected a'),
    ('lidar', ranged('<max>1</max><resolution>-1</resolution>'), '<resolution> of <range>: found'),
    ('lidar', scanned('<samples>0</samples>'), '<samples> of <horizontal>: found "0", expected a'),
    (
        'lidar',
        scanned('<resolution>nan</resolution>'),
        '<resolution> of <horizontal>: found "na',
    ),
    (
        'lidar',
        scanned('<min_angle>2</min_angle><max_angle>1</max_angle>'),
        'the angles of <horizontal>: found <min_angle> 2, <max_angle> 1, 640 samples, expected a '
        '<max_angle> above <min_angle>; swap them',
    ),
    (
        'lidar',
        scanned('<max_angle>180</max_angle>'),
        '<max_angle> of <horizontal>: found "180", expected rad, -6.28 to 6.28; 180° are 3.142 ra',
    ),
    (
        'lidar',
        scanned('<max_angle>1</max_angle>', '<vertical><max_angle>2</max_angle></vertical>'),
        '<max_angle> of <vertical>: found "2", expected rad, -1.57 to 1.57',
    ),
    (
        'lidar',
        scanned('<samples>1000000000</samples><max_angle>1</max_angle>'),
        'its scan has too many rays for a CPU: found 1000000000 by 1: 1000000000 rays, expected a',
    ),
    (
        'camera',
        '<update_rate>-5</update_rate>',
        '<update_rate>: found "-5", expected Hz: a finit',
    ),
    (
        'lidar',
        scanned('<samples>1e300</samples><resolution>1e300</resolution><max_angle>1</max_angle>'),
        'its scan has too many rays for a CPU: found 1000000000 by 1',
    ),
    ('camera', '<pose>0 0 1</pose>', '<pose>: found "0 0 1", expected 6 numbers, finite'),
    (
        'camera',
        '<topic>my camera</topic>',
        'its topic is no name of one in ROS: found "my came',
    ),
    (
        'camera',
        '<camera><image><width>0</width></image></camera>',
        '<width> of <image>: found "0", expected a whole number from 1 on',
    ),
    (
        'camera',
        '<camera><image><width>100000</width><height>100000</height></image></camera>',
        'its picture is too large: found 100000 by 100000 pixels, expected at most 16777216',
    ),
    (
        'camera',
        '<camera><horizontal_fov>90</horizontal_fov></camera>',
        '<horizontal_fov> of <camera>: found "90", expected rad: above 0 and below π (3.14); 90° '
        'are 1.571 rad',
    ),
    (
        'camera',
        '<camera><horizontal_fov>0</horizontal_fov></camera>',
        '<horizontal_fov> of <camera>: found "0", expected rad: above 0',
    ),
    (
        'camera',
        '<camera><clip><near>3</near><far>1</far></clip></camera>',
        '<clip>: found <near> 3, <far> 1, expected a <far> above <near>; swap them',
    ),
    (
        'camera',
        '<camera><lens><intrinsics><fx>0</fx></intrinsics></lens></camera>',
        '<fx> of <intrinsics>: found "0", expected pixels: a finite number above 0',
    ),
    (
        'camera',
        '<camera><noise><type>gaussian</type><stddev>-1</stddev></noise></camera>',
        '<stddev> of <noise>: found "-1", expected a finite number from 0 on',
    ),
    ('gpu_lidr', '', 'its type is none of SDF: found "gpu_lidr", expected one of gpu_lidar, lid'),
    ('', '', 'it has no type: expected one of gpu_lidar,'),
]


@pytest.mark.parametrize('kind, inside, message', FAULTS)
def test_a_sensor_that_cannot_work_is_left_out_and_told_with_its_line(kind, inside, message):
    good = '<sensor name="good" type="camera"/>'
    tag = f'<sensor name="s" type="{kind}">{inside}</sensor>'
    robot = robot_of(f'<gazebo reference="eye">{tag}{good}</gazebo>')
    found = robot_sensors_of(robot)
    assert [each.mount.name for each in found.sensors] == ['good']
    assert found.findings[0].text.startswith(f'r.urdf:5: gazebo sensor "s": {message}')
    told, fix = found.findings[0].as_taken().text, found.findings[0].fix
    assert told.endswith(f'; the sensor is left out; {fix}' if fix else '; the sensor is left out')
    told = [each.text for each in checks.check(robot.text, 'r.urdf')]
    assert all(each.text in told for each in found.findings)


WARNINGS = [
    (
        '<camera><image><width>64.5</width></image></camera>',
        '<width> of <image>: found "64.5", expected a whole number from 1 on; 64 is taken',
    ),
    (
        '<camera><image><format>BAYER_RGGB8</format></image></camera>',
        '<format>: found "BAYER_RGGB8", expected one of R8G8B8,',
    ),
    (
        '<frame_id>eye_optcal</frame_id>',
        '<frame_id> is no link of the robot: tf will know no transform to it: found "eye_optcal"; '
        'write eye_optical',
    ),
    ('<camera><noise><type>white</type></noise></camera>', 'type of <noise>: found "white"'),
]


def test_a_collision_that_is_not_there_is_told():
    tag = '<sensor name="s" type="contact"><contact><collision>f</collision></contact></sensor>'
    found = robot_sensors_of(robot_of(f'<gazebo reference="eye">{tag}</gazebo>'))
    assert len(found.sensors) == 1
    assert [each.text for each in found.findings] == [
        'r.urdf:5: gazebo sensor "s": <collision> of <contact> is none of the robot: found "f"; '
        'write eye_collision for those of its link'
    ]


@pytest.mark.parametrize('inside, message', WARNINGS)
def test_a_sensor_that_works_otherwise_than_meant_is_told(inside, message):
    tag = f'<sensor name="s" type="camera">{inside}</sensor>'
    found = robot_sensors_of(robot_of(f'<gazebo reference="eye">{tag}</gazebo>'))
    (finding,) = found.findings
    assert len(found.sensors) == 1 and finding.severity is Severity.WARNING
    assert finding.text.startswith(f'r.urdf:5: gazebo sensor "s": {message}')


@pytest.mark.parametrize(
    'block, message',
    [
        (
            '<gazebo reference="ey">{}</gazebo>',
            '"s": it is mounted on a link that is not there: found "ey", expected one of "base", '
            '"eye", "eye_optical"; the sensor is left out; write reference="eye"',
        ),
        (
            '<gazebo reference="b">{}</gazebo>',
            '"s": it is mounted on a link that is not there: found "b", expected one of "base", '
            '"eye", "eye_optical"; the sensor is left out; write reference="eye_optical"',
        ),
        ('<gazebo>{}</gazebo>', '"s": its <gazebo> has no attribute "reference"'),
        (
            '<gazebo reference="eye"><sensor type="camera"/></gazebo>',
            '"": it has no attribute "n',
        ),
    ],
)
def test_a_sensor_without_a_place_or_a_name_is_told(block, message):
    robot = robot_of(block.format('<sensor name="s" type="camera"/>'))
    found = robot_sensors_of(robot)
    assert not found.sensors
    (finding,) = found.findings
    assert finding.text.startswith(f'r.urdf:5: gazebo sensor {message}')
    told = [each.text for each in checks.check(robot.text, 'r.urdf') if each.line == 5]
    assert told == [finding.text]


def test_two_sensors_on_one_topic_are_told():
    lidar = f'<topic>front</topic><lidar>{SCAN}{RANGE}</lidar>'
    tags = (
        f'<sensor name="a" type="lidar">{lidar}</sensor>',
        f'<sensor name="b" type="lidar">{lidar}</sensor>',
        '<sensor name="c" type="camera"><topic>front</topic></sensor>',
        '<sensor name="d" type="camera"><topic>x/left</topic></sensor>',
        '<sensor name="e" type="camera"><topic>x/left_2</topic></sensor>',
    )
    blocks = '\n'.join(f'<gazebo reference="eye">{tag}</gazebo>' for tag in tags)
    found = robot_sensors_of(robot_of(blocks))
    assert [each.mount.name for each in found.sensors] == ['a', 'b', 'd', 'e']
    assert [each.text for each in found.findings] == [
        'r.urdf:6: gazebo sensor "b": it has the topic of another sensor: found "/front", '
        '"/front/points", as "a" on line 5; both are on it; give each a <topic> of its own',
        'r.urdf:7: gazebo sensor "c": it has a topic of another type, sensor_msgs/msg/LaserScan: '
        'found "/front", as "a" on line 5; give each a <topic> of its own',
    ]
