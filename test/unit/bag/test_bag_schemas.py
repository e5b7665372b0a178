# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The text of a type with all that it contains."""

from pathlib import PosixPath

import pytest

from amr_description.bag import schemas
from amr_description.bag.schemas import compose, contained_types, schema_text

BETWEEN = '=' * 80 + '\nMSG: '


def test_each_contained_type_comes_once_behind_its_name():
    texts = {
        'a/msg/Outer': 'Header header\nInner[<=3] first  # b/Wrong\nb/Far far\nstring<=5 s\n',
        'a/msg/Inner': 'b/Far[4] far\nint8 X=1\n',
        'b/msg/Far': 'float64 x\n',
        'std_msgs/msg/Header': 'string frame_id\n',
    }
    assert compose('a/msg/Outer', texts.get) == (
        f'{texts["a/msg/Outer"]}{BETWEEN}std_msgs/Header\nstring frame_id\n'
        f'{BETWEEN}a/Inner\n{texts["a/msg/Inner"]}{BETWEEN}b/Far\nfloat64 x\n'
    )
    assert compose('a/msg/Outer', {**texts, 'b/msg/Far': None}.get) == ''


def test_installed_type():
    parts = schema_text('nav_msgs/msg/Odometry').split(BETWEEN)
    assert 'TwistWithCovariance twist' in parts[0]
    assert 'std_msgs/Header' in {part.partition('\n')[0] for part in parts}
    assert 'geometry_msgs/Vector3' in {part.partition('\n')[0] for part in parts}
    assert schema_text('nowhere/msg/Nothing') == ''


class InLocaleC(PosixPath):
    """As files are read where the locale is C: as ASCII, unless it is said otherwise."""

    def read_text(self, encoding='ascii'):
        return super().read_text(encoding)


def test_types_are_read_in_any_locale(tmp_path, monkeypatch):
    (tmp_path / 'msg').mkdir()
    (tmp_path / 'msg' / 'Angle.msg').write_text('float64 angle  # in °\n', encoding='utf-8')
    monkeypatch.setattr(schemas, 'package_share', lambda _: InLocaleC(tmp_path))
    assert schema_text('measures/msg/Angle') == 'float64 angle  # in °\n'


@pytest.mark.parametrize(
    ('name', 'first', 'contained'),
    [
        ('std_srvs/srv/SetBool_Event', 'info', 'SetBool_Response'),
        (
            'control_msgs/action/GripperCommand_FeedbackMessage',
            'goal_id',
            'GripperCommand_Feedback',
        ),
    ],
)
def test_what_services_and_actions_send(name, first, contained):
    parts = schema_text(name).split(BETWEEN)
    assert parts[0].split()[1] == first
    assert any(part.startswith(f'{name.split("/")[0]}/{contained}\n') for part in parts[1:])


def test_types_of_fields():
    text = 'bool a\nuint8[] b\nFoo c\nx/Bar[3] d\n# x/Not e\nstring NAME=x/y\n'
    assert [*contained_types('p/msg/M', text)] == ['p/msg/Foo', 'x/msg/Bar']


@pytest.mark.parametrize(
    'name', ['', 'String', 'std_msgs/', '../msg/String', 'a/b/c/d', 'std_msgs/msg/\0']
)
def test_what_is_no_name_of_a_type_has_no_text(name):
    assert schema_text(name) == ''
