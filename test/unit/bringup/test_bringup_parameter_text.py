# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters written for rcl come back from rcl as they were."""

import math

import pytest
import rclpy

from amr_description.bringup.command_line import node_key, yaml_text
from amr_description.errors import BringupError

PARAMETERS = {
    'truth': True,
    'lie': False,
    'whole': -(2**63),
    'real': 1.0,
    'tiny': 1e-300,
    'huge': 1e22,
    'infinite': -math.inf,
    'nested': {'deep': {'name': 'value'}},
    'truths': [True, False],
    'wholes': (1, 2, 3),
    'reals': [0.5, -1e-7],
    'texts': ['5', 'true', ''],
    'looks_like_a_number': '5',
    'empty': '',
    'yaml': '{a: b} # c: "d" \'e\' \\ %s & * ! | > @ `',
    'lines': 'one\n\ttwo\r\n three',
    'controls': '\x01\x1b\x7f\x85\xa0\u2028\ufeff',
    'letters': 'ä€🤖',
    'robot_description': '<robot name="a">\n' + '<link name="base: #link"/>\n' * 5000 + '</robot>',
}


def read_back(path):
    context = rclpy.Context()
    rclpy.init(args=['--ros-args', '--params-file', str(path)], context=context)
    try:
        node = rclpy.create_node(
            'reader', context=context, automatically_declare_parameters_from_overrides=True
        )
        parameters = {name: p.value for name, p in node.get_parameters_by_prefix('').items()}
        node.destroy_node()
        return parameters
    finally:
        context.try_shutdown()


@pytest.mark.parametrize('key', ['/**', '/reader'])
def test_rcl_reads_what_was_meant(tmp_path, key):
    path = tmp_path / 'parameters.yaml'
    path.write_text(yaml_text(key, PARAMETERS), encoding='utf-8')
    got = read_back(path)
    expected = {**PARAMETERS, 'nested.deep.name': 'value'}
    del expected['nested']
    for name, value in expected.items():
        found = got[name]
        assert (list(found) if isinstance(value, list | tuple) else found) == (
            list(value) if isinstance(value, tuple) else value
        ), name
        assert type(found) is type(value) or isinstance(value, list | tuple), name


def test_not_a_number_is_one_too(tmp_path):
    path = tmp_path / 'parameters.yaml'
    path.write_text(yaml_text('/**', {'nan': math.nan}), encoding='utf-8')
    assert math.isnan(read_back(path)['nan'])


@pytest.mark.parametrize(
    ('name', 'namespace', 'key'),
    [
        (None, None, '/**'),
        ('n', None, '/**'),
        (None, 'a', '/**'),
        ('n', 'a', '/a/n'),
        ('n', '/a/b/', '/a/b/n'),
        ('n', '/', '/n'),
    ],
)
def test_parameters_stand_under_the_full_name_if_it_is_known(name, namespace, key):
    assert node_key(name, namespace) == key


def test_a_value_without_a_ros_type_is_refused_by_name():
    with pytest.raises(BringupError, match="parameter 'a.b' is None, a NoneType"):
        yaml_text('/**', {'a': {'b': None}})
    with pytest.raises(BringupError, match=r"parameter 'mixed' has elements of several types"):
        yaml_text('/**', {'mixed': [1, 2.0]})
    with pytest.raises(BringupError, match=r"parameter 'deep' is \[1\], a list"):
        yaml_text('/**', {'deep': [[1]]})
    with pytest.raises(BringupError, match="parameter 'empty' is an empty list"):
        yaml_text('/**', {'empty': []})
    with pytest.raises(BringupError, match="parameter 'big' is 9223372036854775808, a int"):
        yaml_text('/**', {'big': 2**63})
    with pytest.raises(BringupError, match="parameter 'text' is 'a.x00b', a str"):
        yaml_text('/**', {'text': 'a\0b'})
