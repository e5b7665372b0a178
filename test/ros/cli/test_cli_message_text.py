# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A message -> YAML and CSV."""

import os
import subprocess
import sys

from geometry_msgs.msg import PoseArray, Twist
from hypothesis import given, strategies as st
from nav_msgs.msg import Odometry
import pytest
from rcl_interfaces.msg import ParameterValue
from sensor_msgs.msg import JointState
from std_msgs.msg import Byte, Empty, Float64, String
import yaml

from amr_description.ros.message_fields import set_fields
from amr_description.ros.message_text import (
    dump_with_pyyaml,
    dump_yaml,
    Style,
    to_csv,
    to_yaml,
)

JOINTS = JointState(name=['a', 'b'], position=[0.0, 1.5])
JOINTS.header.stamp.sec = 3


def test_yaml_has_the_fields_in_their_order():
    assert to_yaml(JOINTS) == (
        'header:\n'
        '  stamp:\n'
        '    sec: 3\n'
        '    nanosec: 0\n'
        "  frame_id: ''\n"
        'name:\n- a\n- b\n'
        'position:\n- 0.0\n- 1.5\n'
        'velocity: []\n'
        'effort: []\n'
    )


def test_flow_style_puts_arrays_in_one_line():
    tail = to_yaml(JOINTS, Style(flow_style=True)).partition("frame_id: ''\n")[2]
    assert tail == 'name: [a, b]\nposition: [0.0, 1.5]\nvelocity: []\neffort: []\n'


@pytest.mark.parametrize(
    ('value', 'text'),
    [
        (0.1, '0.1'),
        (1e-5, '1.0e-05'),
        (1e20, '1.0e+20'),
        (float('nan'), '.nan'),
        (float('-inf'), '-.inf'),
    ],
)
def test_numbers_are_written_so_that_yaml_reads_numbers(value, text):
    written = to_yaml(Float64(data=value))
    assert written == f'data: {text}\n'
    assert isinstance(yaml.safe_load(written)['data'], float)


@pytest.mark.parametrize(
    ('text', 'written'),
    [
        ('', "''"),
        ('5', "'5'"),
        ('a\nb', "'a\n\n  b'"),
        ('a\n b', '"a\\n b"'),
        ('true', "'true'"),
        ('grüße 😀', 'grüße 😀'),
        ('x: y', "'x: y'"),
        ('w' * 120 + ' ' + 'w' * 7, 'w' * 120 + ' ' + 'w' * 7),
    ],
)
def test_texts_are_quoted_where_yaml_would_misread_them(text, written):
    assert to_yaml(String(data=text)) == f'data: {written}\n'


def test_what_yaml_wrote_fills_an_equal_message():
    odometry = Odometry(child_frame_id='base: "link"')
    odometry.pose.pose.position.x = 1e-17
    odometry.pose.covariance[7] = 0.1
    again = Odometry()
    set_fields(again, yaml.safe_load(to_yaml(odometry, Style(truncate_length=None))))
    assert again == odometry


def test_long_arrays_and_texts_are_cut():
    cut = Style(truncate_length=3)
    assert to_yaml(String(data='abcd'), cut) == 'data: abc...\n'
    assert to_yaml(String(data='abc'), cut) == 'data: abc\n'
    numbers = ParameterValue(integer_array_value=[1, 2, 3, 4], byte_array_value=[b'\x41'])
    written = yaml.safe_load(to_yaml(numbers, cut))
    assert written['integer_array_value'] == [1, 2, 3, '...']
    assert written['byte_array_value'] == ['A']
    assert yaml.safe_load(to_yaml(PoseArray(poses=PoseArray().poses), cut))['poses'] == []


def test_arrays_and_texts_can_be_left_out():
    left_out = Style(arrays=False, strings=False)
    assert yaml.safe_load(to_yaml(JOINTS, left_out)) == {
        'header': {'stamp': {'sec': 3, 'nanosec': 0}, 'frame_id': '<string length: <0>>'},
        'name': '<sequence type: string, length: 2>',
        'position': '<sequence type: double, length: 2>',
        'velocity': '<sequence type: double, length: 0>',
        'effort': '<sequence type: double, length: 0>',
    }
    pose = yaml.safe_load(to_yaml(Odometry(), left_out))['pose']
    assert pose['covariance'] == '<array type: double[36]>'
    assert to_yaml(PoseArray(), left_out).endswith(
        "poses: '<sequence type: geometry_msgs/msg/Pose, length: 0>'\n"
    )


def test_csv_has_every_value_and_a_column_for_an_empty_array():
    assert to_csv(JOINTS) == '3,0,,a,b,0.0,1.5,,'
    assert to_csv(Twist()) == '0.0,0.0,0.0,0.0,0.0,0.0'
    assert to_csv(JOINTS, Style(truncate_length=1)) == '3,0,,a,...,0.0,...,,'
    assert to_csv(JOINTS, Style(arrays=False)).endswith('<sequence type: double, length: 0>')


def test_messages_without_fields_and_bytes():
    assert to_yaml(Empty()) == '{}\n'
    assert to_yaml(Byte(data=b'A')) == 'data: A\n'
    assert to_csv(Byte(data=b'A')) == "b'A'"


@pytest.mark.parametrize('module', ['cli.echo_printer', 'ros.message_fields'])
def test_numpy_is_loaded_only_for_messages_that_hold_something_of_it(module):
    code = f'import sys, amr_description.{module}; print("numpy" in sys.modules)'
    said = subprocess.check_output(
        [sys.executable, '-c', code],  # started: that of support.preloaded has loaded it
        env={**os.environ, 'PYTHONPATH': os.pathsep.join(sys.path)},
        text=True,
    )
    assert said == 'False\n'


TEXTS = st.text(max_size=6) | st.sampled_from(
    [
        '',
        'no',
        '...',
        '- a',
        'a: b',
        "it's",
        ' a',
        'a\nb',
        '1',
        '1e3',
        '~',
        '\u2603',
        '=',
        '#',
        '\t',
    ]
)
NUMBERS = st.integers() | st.floats() | st.sampled_from([1e-5, 1e16, 1e22, -0.0, 5e-324])
SCALARS = TEXTS | NUMBERS | st.booleans() | st.none()


def collections_of(values):
    return st.lists(values, max_size=4) | st.dictionaries(TEXTS, values, max_size=4)


@given(value=st.dictionaries(TEXTS, st.recursive(SCALARS, collections_of), max_size=5))
def test_yaml_is_that_of_pyyaml(value):
    assert dump_yaml(value) == dump_with_pyyaml(value)
