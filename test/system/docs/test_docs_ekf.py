# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/localisation.md, "Odometry of wheels and IMU", typed as it stands, in a real graph."""

import re

from nav_msgs.msg import Odometry
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from support import shells
from support.doc_pages import Page
from support.running_programs import PATIENCE
from support.shells import line_of
from tf2_msgs.msg import TFMessage

from amr_description.clock import NANOSECONDS
from amr_description.ros.messages import nanoseconds

CHAPTER = re.search(
    r'^## Odometry of wheels and IMU$.*',
    Page('localisation.md').text,
    re.DOTALL | re.MULTILINE,
)[0]
TYPED = [
    'ros2 run tf2_ros tf2_echo odom base_link',
    'ros2 topic pub --once /diff_drive_controller/cmd_vel geometry_msgs/msg/TwistStamped '
    '"{twist: {linear: {x: 0.5}}}"',
]


@pytest.fixture
def terminal(tmp_path):
    """A function that opens a new terminal for one who reads the chapter."""
    typed = '\n'.join(['source scripts/activate', *TYPED, CHAPTER])
    return lambda: shells.newcomer(typed, tmp_path)


def assert_one_publisher():
    """Listen to 50 transforms of base_footprint: each is that of an odometry of the filter."""
    rclpy.init(args=[])
    executor, node = SingleThreadedExecutor(), Node('listener_to_the_filter')
    executor.add_node(node)
    stamps, edges = set(), []

    def on_odometry(message):
        stamps.add(nanoseconds(message.header.stamp))

    def on_transforms(message):
        edges.extend(
            (nanoseconds(each.header.stamp), each.header.frame_id)
            for each in message.transforms
            if each.child_frame_id == 'base_footprint'
        )

    node.create_subscription(Odometry, 'odometry/filtered', on_odometry, QoSProfile(depth=100))
    node.create_subscription(TFMessage, '/tf', on_transforms, QoSProfile(depth=1000))
    end = node.get_clock().now().nanoseconds + PATIENCE * NANOSECONDS
    try:
        # Between the first and the last odometry that was heard, both topics are whole.
        while len(stamps) < 50 or len(edges) < 52:
            assert node.get_clock().now().nanoseconds < end, (len(stamps), len(edges))
            executor.spin_once(timeout_sec=0.1)
    finally:
        node.destroy_node()
        executor.shutdown()
        rclpy.try_shutdown()
    within = [row for row in edges if min(stamps) <= row[0] <= max(stamps)]
    assert {parent for _, parent in within} == {'odom'}
    assert [stamp for stamp, _ in within] == sorted({stamp for stamp, _ in within})
    assert {stamp for stamp, _ in within} <= stamps


@pytest.mark.long
def test_wheels_and_imu_are_one_odometry(terminal):
    with terminal() as robot, terminal() as shell:
        robot.type(f'{line_of(CHAPTER, "scripts/run ekf:=true")} viewer:=false')
        robot.see(r'ready in \d+\.\d s')
        shell.run(TYPED[1])
        shell.type(line_of(CHAPTER, 'ros2 topic echo'))
        shell.see('frame_id: odom')
        shell.see('child_frame_id: base_footprint')
        shell.see(re.escape(shells.PROMPT))
        assert_one_publisher()
        shell.type(TYPED[0])
        shell.see(r'Translation: \[')
        shell.interrupt()
        robot.interrupt()


def test_it_starts_beside_any_robot(terminal):
    with terminal() as shell:
        shell.start(line_of(CHAPTER, 'ros2 run robot_localization'))
        rclpy.init(args=[])
        node = Node('who_looks_for_the_filter')
        try:
            end = node.get_clock().now().nanoseconds + PATIENCE * NANOSECONDS
            while 'ekf_filter_node' not in node.get_node_names():
                assert node.get_clock().now().nanoseconds < end, node.get_node_names()
                rclpy.spin_once(node, timeout_sec=0.1)
        finally:
            node.destroy_node()
            rclpy.try_shutdown()
        shell.interrupt()
