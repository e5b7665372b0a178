# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Configuration files of ros_gz_bridge: names of topics in ROS, and what is wrong with a file."""

from fixtures.sim.plugin_robot import cart, gz_drive
import pytest

from amr_description.errors import ParameterError
from amr_description.model.gazebo.bridge import bridged, read_bridge
from amr_description.model.gazebo.translation import translate
from amr_description.model.urdf import parse

SENSORS = """
<sensor name="laser" type="gpu_lidar"><lidar><scan><horizontal><max_angle>1</max_angle>
  </horizontal></scan><range><max>5</max></range></lidar></sensor>
<sensor name="eye" type="rgbd_camera"><topic>/model/cart/eye</topic></sensor>
<sensor name="bump" type="contact"/><sensor name="unit" type="imu"><topic>imu</topic></sensor>"""


def read(tmp_path, text):
    path = tmp_path / 'bridge.yaml'
    path.write_text(text)
    return read_bridge(path)


def topics_of(tmp_path, text):
    bridge = read(tmp_path, text)
    robot = parse(cart(gz_drive(), reference=SENSORS))
    found = bridged(translate(robot), bridge)
    sensors = {
        name: kind.rpartition('/')[2] for each in found.sensors for name, kind in each.topics
    }
    controllers = {name for each in found.controllers for name in each.topics.values()}
    return sensors, controllers, found.notes


def entry(gz, ros, kind='sensor_msgs/msg/LaserScan', direction='GZ_TO_ROS'):
    return f"""- ros_topic_name: "{ros}"
  gz_topic_name: "{gz}"
  ros_type_name: "{kind}"
  gz_type_name: "gz.msgs.Any"
  direction: {direction}
"""


def test_topics_are_called_as_the_file_says(tmp_path):
    sensors, controllers, notes = topics_of(
        tmp_path,
        entry('/world/w/model/cart/link/base_link/sensor/laser/scan', 'front/scan')
        + entry('eye/image', '/rgb', 'sensor_msgs/Image')
        + entry('/model/cart/eye/points', 'cloud', 'sensor_msgs/msg/PointCloud2')
        + entry('/imu', 'imu/data', 'sensor_msgs/msg/Imu')
        + entry('/model/cart/odometry', 'wheel/odom', 'nav_msgs/msg/Odometry')
        + entry('cmd_vel', 'drive', 'geometry_msgs/msg/Twist', 'ROS_TO_GZ')
        + '- topic_name: /clock\n  ros_type_name: rosgraph_msgs/msg/Clock\n',
    )
    assert sensors == {
        'front/scan': 'LaserScan',
        'scan/points': 'PointCloud2',
        '/rgb': 'Image',
        'eye/depth_image': 'Image',
        'eye/camera_info': 'CameraInfo',
        'cloud': 'PointCloud2',
        'bump/contact': 'Contacts',
    }
    assert controllers == {'drive', 'wheel/odom', 'imu/data', '/tf', 'joint_states'}
    assert not notes


def test_a_contact_that_gazebo_names(tmp_path):
    name = '/world/w/model/cart/link/base/sensor/bump/contact'
    kind = 'ros_gz_interfaces/msg/Contacts'
    assert 'hits' in topics_of(tmp_path, entry(name, 'hits', kind))[0]


def test_another_type_is_told(tmp_path):
    text = f'# robot\n{entry("scan", "scan", "sensor_msgs/msg/Image")}'
    assert topics_of(tmp_path, text)[2] == (
        f'{tmp_path}/bridge.yaml:2: "scan" is sensor_msgs/msg/Image there; sensor "laser" '
        'publishes sensor_msgs/msg/LaserScan on it',
    )


def test_an_empty_file_changes_nothing(tmp_path):
    assert 'scan' in topics_of(tmp_path, '# nothing\n')[0]


@pytest.mark.parametrize(
    'text, message',
    [
        (
            'topic: scan',
            ': it is no configuration of ros_gz_bridge: it is a list of  - {ros_topic',
        ),
        ('- scan', ':1: this is no entry of ros_gz_bridge'),
        ('- {}\n- lazy: true', ':1: an entry has no name of a topic'),
        (
            entry('a', 'b') + '- ros_topic: scan',
            ':6: there is no "ros_topic"; did you mean ros_topic_name?',
        ),
        ('- topic_name: [a]', ':1: topic_name is no text'),
        (
            entry('a', 'b', direction='GZ2ROS'),
            ':1: direction "GZ2ROS" is none of BIDIRECTIONAL, GZ',
        ),
        (entry('a', 'my topic'), ':1: ros_topic_name "my topic" is no name of a topic of ROS'),
        ('- a: [', ':1:'),
    ],
)
def test_a_faulty_file_is_told_with_its_line(tmp_path, text, message):
    with pytest.raises(ParameterError) as caught:
        read(tmp_path, text)
    assert f'bridge.yaml{message}' in str(caught.value)


def test_a_file_that_is_not_there_or_no_text_is_told(tmp_path):
    with pytest.raises(ParameterError, match='No such file'):
        read_bridge(tmp_path / 'none.yaml')
    (tmp_path / 'x.yaml').write_bytes(b'\xff\xfe')
    with pytest.raises(ParameterError, match='not UTF-8'):
        read_bridge(tmp_path / 'x.yaml')
