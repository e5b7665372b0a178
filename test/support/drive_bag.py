# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A bag of a drive in a circle, written without any node: where the robot is when is known."""

from math import cos, pi, sin

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Image, JointState, LaserScan
from std_msgs.msg import String
from support.small_bags import BEGIN, LATCHED, MS
from tf2_msgs.msg import TFMessage

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.ros.message_types import type_name

LENGTH = 10
"""s of the drive."""
PERIOD = 20
"""ms between two messages of what moves."""
RADIUS = 2.0
SPEED = 0.5
"""m/s along the circle."""
URDF = """<robot name="circler">
  <link name="base_link"><visual><geometry><box size="0.4 0.3 0.2"/></geometry></visual></link>
  <link name="lidar"/>
  <link name="wheel"/>
  <joint name="lidar_joint" type="fixed">
    <parent link="base_link"/><child link="lidar"/><origin xyz="0 0 0.2"/>
  </joint>
  <link name="camera"/>
  <joint name="camera_joint" type="fixed">
    <parent link="base_link"/><child link="camera"/><origin xyz="0.2 0 0.1"/>
  </joint>
  <joint name="wheel_joint" type="continuous">
    <parent link="base_link"/><child link="wheel"/><axis xyz="0 1 0"/>
  </joint>
</robot>"""


def pose_at(seconds):
    """Where the robot is, m and rad, so many seconds after the begin."""
    turn = SPEED / RADIUS * seconds
    return RADIUS * sin(turn), RADIUS * (1.0 - cos(turn)), turn


def write_drive(folder):
    """Write the bag; return its folder."""
    with BagWriter(folder) as writer:
        known = set()

        def write(topic, message, ms, profile=None):
            if topic not in known:
                known.add(topic)
                profiles = (profile or QosProfile(),)
                writer.add_topic(
                    TopicMetadata(topic, type_name(type(message)), offered_qos_profiles=profiles)
                )
            time = BEGIN + ms * MS
            writer.write(BagMessage(topic, serialize_message(message), time, time))

        write('/robot_description', String(data=URDF), 0, LATCHED)
        write('/tf_static', _transform('base_link', 'lidar', 0, 0.0, 0.0, 0.2), 0, LATCHED)
        for ms in range(0, LENGTH * 1000 + 1, PERIOD):
            _write_motion(write, ms)
            if ms % 100 == 0:
                write('/scan', _scan(ms), ms)
            if ms % 500 == 0:
                write('/camera/image_raw', _image(ms), ms)
    return folder


def _write_motion(write, ms):
    x, y, turn = pose_at(ms / 1000)
    write('/tf', _transform('odom', 'base_link', ms, x, y, 0.0, turn), ms)
    odometry = Odometry()
    odometry.header.stamp = _stamp(ms)
    odometry.header.frame_id, odometry.child_frame_id = 'odom', 'base_link'
    odometry.pose.pose.position.x, odometry.pose.pose.position.y = x, y
    odometry.pose.pose.orientation.z = sin(turn / 2)
    odometry.pose.pose.orientation.w = cos(turn / 2)
    odometry.twist.twist.linear.x = SPEED
    odometry.twist.twist.angular.z = SPEED / RADIUS
    write('/odom', odometry, ms)
    odometry.header.frame_id = 'world'
    write('/ground_truth/odom', odometry, ms)
    joints = JointState(name=['wheel_joint'], position=[ms / 100], velocity=[10.0])
    joints.header.stamp = _stamp(ms)
    write('/joint_states', joints, ms)
    if ms < LENGTH * 500:  # the second half is commanded by nobody
        command = TwistStamped()
        command.header.stamp = _stamp(ms)
        command.twist.linear.x = SPEED
        write('/cmd_vel', command, ms)


def _transform(parent, child, ms, x, y, z, turn=0.0):
    each = TransformStamped(child_frame_id=child)
    each.header.frame_id, each.header.stamp = parent, _stamp(ms)
    move, turned = each.transform.translation, each.transform.rotation
    move.x, move.y, move.z = x, y, z
    turned.z, turned.w = sin(turn / 2), cos(turn / 2)
    return TFMessage(transforms=[each])


def _scan(ms):
    count = 90
    scan = LaserScan(angle_min=-pi, angle_max=pi, angle_increment=2 * pi / count, range_max=30.0)
    scan.header.frame_id, scan.header.stamp = 'lidar', _stamp(ms)
    scan.ranges = [3.0 + ms / 10_000] * count
    return scan


def _image(ms):
    """A picture of one grey, which is lighter the later it is."""
    width, height = 32, 24
    image = Image(width=width, height=height, step=width, encoding='mono8')
    image.header.frame_id, image.header.stamp = 'lidar', _stamp(ms)
    image.data = bytes([ms * 255 // (LENGTH * 1000)]) * (width * height)
    return image


def _stamp(ms):
    seconds, rest = divmod(BEGIN + ms * MS, 10**9)
    return Time(sec=seconds, nanosec=rest)
