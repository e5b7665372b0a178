# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which packages of CMake have a Python half, and the rules that take the other one out."""

import pytest

from amr_description.workspace.python_half import has_python_half, PythonHalf


@pytest.mark.parametrize(
    ('rules', 'expected'),
    [
        ('ament_python_install_package(${PROJECT_NAME})', True),
        ('  ament_python_install_package (x)\nadd_library(y)', True),
        ('# ament_python_install_package(x)', False),
        ('add_library(y)', False),
        ('rosidl_generate_interfaces(x "msg/A.msg")\nament_python_install_package(x)', False),
    ],
)
def test_a_package_with_messages_has_no_half_of_its_own(rules, expected):
    assert has_python_half(rules) == expected


def test_a_command_is_taken_out_once(tmp_path):
    half = PythonHalf(tmp_path / 'stubs')
    assert half.without('rclcpp_components_register_node')
    assert not half.without('rclcpp_components_register_node')
    rules = (tmp_path / 'stubs/python_half.cmake').read_text()
    assert rules.count('function(rclcpp_components_register_node)\nendfunction()') == 1
    assert f'-DCMAKE_PROJECT_INCLUDE={tmp_path}/stubs/python_half.cmake' in half.arguments


def test_what_is_left_out_is_that_of_the_last_run(tmp_path):
    half = PythonHalf(tmp_path)
    assert half.left_out == []
    (tmp_path / 'left_out.txt').write_text('b\na\nb\n')
    assert half.left_out == ['b', 'a']
    half.begin()
    assert half.left_out == []
