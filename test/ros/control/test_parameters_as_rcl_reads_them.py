# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Values of parameter files are what rcl makes of them, which nodes get."""

import math

import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node

from amr_description.parameter_files import read_parameter_file

VALUES = [
    *('5e-2', '1e3', '1E-3', '5.', '.5', '+5', '-5', '+.5', '010', '08', '+010', '00', '0x1F'),
    *('0x1.8p1', '0b11', '0o17', '1_000', '1_00.0', '1:30', '190:20:30.15', '-0', '-0.0'),
    *('inf', '-inf', '+inf', 'Infinity', 'infinit', '.inf', '-.inf', '+.inf', '.NaN', 'nan'),
    *('nan(x)', 'yes', 'YES', 'yEs', 'y', 'N', 'on', 'oN', 'Off', 'True', 'tRUE', 'FALSE'),
    *('null', '~', 'Null', '2026-01-01', '2026-01-01 10:00:00', '=', '1e400', '1e-400', '5e-324'),
    *(
        str(2**63 - 1),
        str(-(2**63)),
        str(2**63),
        '9' * 20,
        '9' * 400,
        '07777777777777777777777777',
    ),
    *('!!str 5', '!!int "5"', '!!float 5', '"5"', "'5'", '!!bool "true"', '!foo 5', '5 # c', "''"),
    *('0x', 'e5', '1e', '--5', '0.0.1', '5f', '0x1G', '1d3', '.', '+', '.e5', '٣', '5 6'),
]


@pytest.fixture(scope='module')
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp('values') / 'values.yaml'
    lines = [f'    p{number}: {value}' for number, value in enumerate(VALUES)]
    path.write_text('\n'.join(['/**:', '  ros__parameters:', *lines, '    l: [5e-2, .inf]\n']))
    return path


@pytest.fixture(scope='module')
def of_rcl(file):
    context = Context()
    rclpy.init(args=['--ros-args', '--params-file', str(file)], context=context)
    options = {'automatically_declare_parameters_from_overrides': True}
    node = Node('reader', context=context, allow_undeclared_parameters=True, **options)
    yield {name: each.value for name, each in node.get_parameters_by_prefix('').items()}
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_all_values_are_those_of_rcl(file, of_rcl):
    ours = read_parameter_file(file)['/**']['ros__parameters']
    for number, text in enumerate(VALUES):
        found, expected = ours[f'p{number}'], of_rcl[f'p{number}']
        assert type(found) is type(expected), (text, found, expected)
        same = math.isnan(found) if expected != expected else repr(found) == repr(expected)
        assert same, (text, found, expected)
    assert ours['l'] == list(of_rcl['l'])
