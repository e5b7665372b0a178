# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is said where a module of ROS is not found."""

import subprocess
import sys

import pytest

from amr_description.stand_ins import hint_of_module


@pytest.mark.parametrize(
    ('module', 'hint'),
    [
        ('cv2', 'pip install opencv-python-headless'),
        ('my_robot_msgs.msg', '"colcon build" generates them'),
        ('rclcpp_interfaces', 'it has messages'),
        ('turtlesim.srv', 'does what its turtle does'),
        ('ament_mypy.main', 'this linter is not here'),
        ('rospy', 'in ROS 2 it is rclpy'),
        ('actionlib', 'in ROS 2 it is rclpy.action'),
        ('simple_pid', 'pip install simple-pid'),
        ('PIL.Image', 'pip install Pillow'),
        ('ros2launch.api', 'has no such module'),
        ('moveit.planning', 'beside this one'),
    ],
)
def test_a_module_of_ros_has_a_hint(module, hint):
    assert hint in hint_of_module(module)


def test_other_modules_have_none():
    assert [hint_of_module(each) for each in ('numpy', 'my_package', 'msgs')] == ['', '', '']


def uncaught(code):
    done = subprocess.run(
        [sys.executable, '-c', code], stderr=subprocess.PIPE, text=True, check=False
    )
    return done.stderr


def test_a_program_that_ends_of_it_says_so_below_the_traceback():
    *_, error, note = uncaught('import rospy').splitlines()
    assert error == "ModuleNotFoundError: No module named 'rospy'"
    assert note == "amr_description: no module 'rospy': it is of ROS 1; in ROS 2 it is rclpy"


def test_what_is_caught_or_of_no_ros_stays_as_it_is():
    caught = 'try:\n    import rospy\nexcept ModuleNotFoundError as error:\n    print(vars(error))'
    done = subprocess.run([sys.executable, '-c', caught], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ('{}\n', '')
    assert uncaught('import no_such').splitlines()[-1] == (
        "ModuleNotFoundError: No module named 'no_such'"
    )
