# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Packages of messages that others publish: their fields, and the hashes that they have there."""

import json

# Published in sources that others have generated and in metadata of bags.
HASHES = {
    'ackermann_msgs/msg/AckermannDrive':
        'RIHS01_acf287a224a947dd1b0b87d6d76cdb73f497b0237b8fc73be2173b2ebbb82c99',
    'apriltag_msgs/msg/AprilTagDetection':
        'RIHS01_77c6bb37e0a9fe5f159666b14f3340f989749d436a2ee01b5c53bdd7d7085dbb',
    'livox_ros_driver/msg/CustomMsg':
        'RIHS01_94041b4794f52c1d81def2989107fc898a62dacb7a39d5dbe80d4b55e538bf6d',
    'px4_msgs/msg/RoverAckermannSetpoint':
        'RIHS01_0e87233b69538ab38fe51ca54ad878f826b05446371eca7859b97e5e1d1136ca',
    'vision_msgs/msg/Detection2DArray':
        'RIHS01_214274120007f4a683866481336b70310268cfa107aebe9d594a6acf75bda968',
}  # fmt: skip
# Of each package what these need: package, message, fields.
FIELDS = {
    'ackermann_msgs': {
        'AckermannDrive': 'float32 steering_angle, float32 steering_angle_velocity, '
        'float32 speed, float32 acceleration, float32 jerk',
    },
    'apriltag_msgs': {
        'Point': 'float64 x, float64 y',
        'AprilTagDetection': 'string family, int32 id, int32 hamming, float32 goodness, '
        'float32 decision_margin, Point centre, Point[4] corners, float64[9] homography',
    },
    'livox_ros_driver': {
        'CustomPoint': 'uint32 offset_time, float32 x, float32 y, float32 z, '
        'uint8 reflectivity, uint8 tag, uint8 line',
        'CustomMsg': 'std_msgs/Header header, uint64 timebase, uint32 point_num, '
        'uint8 lidar_id, uint8[3] rsvd, CustomPoint[] points',
    },
    'px4_msgs': {
        'RoverAckermannSetpoint': 'uint64 timestamp, float32 forward_speed_setpoint, '
        'float32 forward_speed_setpoint_normalized, float32 steering_setpoint, '
        'float32 steering_setpoint_normalized, float32 lateral_acceleration_setpoint',
    },
    'vision_msgs': {
        'Point2D': 'float64 x, float64 y',
        'Pose2D': 'vision_msgs/Point2D position, float64 theta',
        'BoundingBox2D': 'vision_msgs/Pose2D center, float64 size_x, float64 size_y',
        'ObjectHypothesis': 'string class_id, float64 score',
        'ObjectHypothesisWithPose': 'vision_msgs/ObjectHypothesis hypothesis, '
        'geometry_msgs/PoseWithCovariance pose',
        'Detection2D': 'std_msgs/Header header, ObjectHypothesisWithPose[] results, '
        'BoundingBox2D bbox, string id',
        'Detection2DArray': 'std_msgs/Header header, vision_msgs/Detection2D[] detections',
    },
}
MANIFEST = """\
<package format="3">
  <name>{name}</name>
  <version>1.2.3</version>
  <description>Messages</description>
  <maintainer email="you@example.com">you</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  {depends}
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
RULES = """\
cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
{found}
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${{PROJECT_NAME}}
  {files}
  {dependencies}
)
ament_package()
"""


def write_package(folder, name, definitions, depends=()):
    """
    Write an interface package as its authors would.

    :param definitions: The text of each file, by its path: ``msg/Name.msg``.
    """
    for path, text in definitions.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    tags = '\n  '.join(f'<depend>{each}</depend>' for each in depends)
    (folder / 'package.xml').write_text(MANIFEST.format(name=name, depends=tags))
    rules = RULES.format(
        name=name,
        found='\n'.join(f'find_package({each} REQUIRED)' for each in depends),
        files='\n  '.join(f'"{path}"' for path in definitions),
        dependencies=f'DEPENDENCIES {" ".join(depends)}' if depends else '',
    )
    (folder / 'CMakeLists.txt').write_text(rules)


def write_public_packages(folder):
    """Write the packages of :data:`FIELDS` below ``folder``."""
    for name, messages in FIELDS.items():
        definitions = {
            f'msg/{message}.msg': fields.replace(', ', '\n') + '\n'
            for message, fields in messages.items()
        }
        used = ''.join(messages.values())
        depends = [each for each in ('std_msgs', 'geometry_msgs') if f'{each}/' in used]
        write_package(folder / name, name, definitions, depends)


def hash_of(description, name):
    """Return the hash of a type in its ``.json`` file."""
    hashes = json.loads(description.read_text())['type_hashes']
    return {each['type_name']: each['hash_string'] for each in hashes}[name]
