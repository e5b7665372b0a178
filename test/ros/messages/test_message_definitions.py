# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The definitions that are shipped, and plain messages, are those of the installed packages."""

import importlib

import pytest
from support.message_definitions import text

from amr_description.errors import AmrError
from amr_description.messages import definitions
from amr_description.messages.definitions import fields_of, hashes, texts
from amr_description.messages.plain import message_of
from amr_description.ros.message_fields import set_fields
from amr_description.ros.message_types import message_type

TWIST = 'geometry_msgs/msg/TwistStamped'
LAYOUT = 'std_msgs/msg/Float64MultiArray'


def plain(value):
    """A message of either kind as dicts, lists and numbers."""
    if hasattr(value, 'get_fields_and_field_types'):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if hasattr(value, '__dict__') and not isinstance(value, type):
        return {name: plain(each) for name, each in vars(value).items()}
    if isinstance(value, bytes):
        return value[0]
    if hasattr(value, '__len__') and not isinstance(value, str):
        return [plain(each) for each in value]
    return value


def class_of(name):
    """Also of the part of a service or an action."""
    package, kind, last = name.split('/')
    if kind == 'msg':
        return message_type(name)
    whole, _, part = last.rpartition('_')
    module = importlib.import_module(f'{package}.{kind}')
    return getattr(getattr(module, whole), part)


def test_the_file_is_up_to_date():
    """``python test/support/message_definitions.py --write``, with test/ on PYTHONPATH."""
    assert definitions.FILE.read_text(encoding='utf-8') == text()
    assert {name for name in texts() if '/msg/' in name} == hashes().keys()


@pytest.mark.parametrize('name', texts())
def test_a_message_of_defaults_is_that_of_ros(name):
    assert plain(message_of(name, {})) == plain(class_of(name)())
    assert [each.name for each in fields_of(name)] or '/Empty' in name


@pytest.mark.parametrize(
    ('name', 'values'),
    [
        (TWIST, {'twist': {'linear': {'x': 0.5, 'y': 1}, 'angular': {'z': -0.25}}}),
        (TWIST, {'header': {'stamp': {'sec': 3, 'nanosec': 4}, 'frame_id': 7}}),
        (LAYOUT, {'data': [1, 2.5, True], 'layout': {'dim': [{'label': 'a', 'size': 2}]}}),
        ('std_msgs/msg/Bool', {'data': 'yes'}),
        ('std_msgs/msg/Bool', {'data': 0}),
        ('nav_msgs/msg/Odometry', {'pose': {'covariance': [0.5] * 36}}),
        (
            'trajectory_msgs/msg/JointTrajectory',
            {'joint_names': ['a'], 'points': [{'positions': [1], 'time_from_start': {'sec': 2}}]},
        ),
    ],
)
def test_a_dict_is_read_as_ros_reads_it(name, values):
    expected = message_type(name)()
    set_fields(expected, values)
    assert plain(message_of(name, values)) == plain(expected)


@pytest.mark.parametrize(
    ('name', 'values'),
    [
        (TWIST, {'twist': {'linaer': {'x': 1.0}}}),
        (TWIST, {'speed': 1.0}),
        (TWIST, {'twist': 1.0}),
        (TWIST, {'twist': {'linear': {'x': 'fast'}}}),
        (TWIST, {'twist': {'linear': {'x': None}}}),
        (TWIST, {'twist': {'linear': {'x': [1.0]}}}),
        (LAYOUT, {'data': 1.0}),
        (LAYOUT, {'data': [1.0, 'b']}),
        (LAYOUT, {'layout': {'dim': [{'size': 'x'}]}}),
        ('std_msgs/msg/Bool', {'data': 'perhaps'}),
    ],
)
def test_what_does_not_fit_is_said_as_of_ros(name, values):
    with pytest.raises(AmrError) as expected:
        set_fields(message_type(name)(), values)
    with pytest.raises(AmrError) as found:
        message_of(name, values)
    assert str(found.value) == str(expected.value)


@pytest.mark.parametrize(
    ('name', 'values'),
    [
        (LAYOUT, {'layout': {'data_offset': -1}}),
        (LAYOUT, {'layout': {'data_offset': 2**32}}),
        ('nav_msgs/msg/Odometry', {'pose': {'covariance': [0.5] * 35}}),
    ],
)
def test_what_is_out_of_range_is_refused_by_both(name, values):
    with pytest.raises(AmrError, match='Failed to populate field'):
        set_fields(message_type(name)(), values)
    with pytest.raises(AmrError, match='Failed to populate field: .* [(]field '):
        message_of(name, values)
