# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter values as they are typed, and parameter files as they are written and read."""

import math

import pytest
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterType,
)
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
import yaml

from amr_description.cli.param.values import advice, as_text, to_message, TYPE_NAMES, typed
from amr_description.cli.param.verbs import lines, select
from amr_description.errors import AmrError, ParameterError
from amr_description.parameter_files import parameter_file_text

BOOL = ParameterType.PARAMETER_BOOL
INTEGER = ParameterType.PARAMETER_INTEGER
DOUBLE = ParameterType.PARAMETER_DOUBLE
STRING = ParameterType.PARAMETER_STRING
BYTE_ARRAY = ParameterType.PARAMETER_BYTE_ARRAY
BOOL_ARRAY = ParameterType.PARAMETER_BOOL_ARRAY
INTEGER_ARRAY = ParameterType.PARAMETER_INTEGER_ARRAY
DOUBLE_ARRAY = ParameterType.PARAMETER_DOUBLE_ARRAY
STRING_ARRAY = ParameterType.PARAMETER_STRING_ARRAY


@pytest.mark.parametrize(
    ('text', 'value', 'kind'),
    [
        ('true', True, BOOL),
        ('off', False, BOOL),
        ('Yes', True, BOOL),
        ('5', 5, INTEGER),
        ('-5', -5, INTEGER),
        ('0x10', 16, INTEGER),
        ('010', 8, INTEGER),
        ('1_000', 1000, INTEGER),
        ('1:30', 90, INTEGER),
        ('5.0', 5.0, DOUBLE),
        ('-0.5', -0.5, DOUBLE),
        ('1.0e+3', 1000.0, DOUBLE),
        ('.inf', math.inf, DOUBLE),
        ('1e3', '1e3', STRING),
        ('-.5', '-.5', STRING),
        ('"5"', '5', STRING),
        ('hi there', 'hi there', STRING),
        ('', '', STRING),
        ('null', 'null', STRING),
        ('~', '~', STRING),
        ('2026-01-01', '2026-01-01', STRING),
        ('{a: 1}', '{a: 1}', STRING),
        ('[left', '[left', STRING),
        ('<?xml version="1.0"?>\n<!-- a: b # c -->\n<robot/>\n',) * 2 + (STRING,),
        ('[1, 2.0]', '[1, 2.0]', STRING),
        ('[true, 1]', '[true, 1]', STRING),
        ('[[1], [2]]', '[[1], [2]]', STRING),
        ('!!binary YQ==', '!!binary YQ==', STRING),
        ('[true, off]', [True, False], BOOL_ARRAY),
        ('[1, 2]', [1, 2], INTEGER_ARRAY),
        ('[1.0, .inf]', [1.0, math.inf], DOUBLE_ARRAY),
        ('[a, "5"]', ['a', '5'], STRING_ARRAY),
        ('[!!binary YQ==, !!binary /w==]', [b'a', b'\xff'], BYTE_ARRAY),
        ('[!!binary YWI=]', '[!!binary YWI=]', STRING),
    ],
)
def test_what_is_typed_has_the_type_of_yaml(text, value, kind):
    assert typed(text) == value
    message = to_message(typed(text))
    assert message.type == kind
    assert parameter_value_to_python(message) == value


@pytest.mark.parametrize('kind', [k for k, name in TYPE_NAMES.items() if 'array' in name])
def test_an_empty_list_is_of_the_type_of_its_parameter(kind):
    assert to_message(typed('[]'), kind).type == kind


def test_an_empty_list_without_a_parameter_is_what_the_genuine_command_makes_of_it():
    assert to_message([]).type == BOOL_ARRAY
    assert to_message([], DOUBLE).type == BOOL_ARRAY


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('@x', "line 1, column 1: found character '@' .* for a string write '\"@x\"'"),
        ('a: b: c', 'line 1, column 5: mapping values are not allowed here'),
        ('*b', "line 1, column 1: found undefined alias 'b'"),
        ('{\n' * 5000, 'nested too deeply$'),
        ('\udcff', r'U\+DCFF, which YAML does not allow$'),
    ],
)
def test_what_is_not_yaml_is_told_with_its_place(text, said):
    with pytest.raises(AmrError, match=said) as error:
        typed(text)
    assert '\n' not in str(error.value)


@pytest.mark.parametrize('value', [2**63, -(2**63) - 1, [1, 2**63]])
def test_an_integer_that_does_not_fit_is_told(value):
    with pytest.raises(ParameterError, match='does not fit into the 64 bits'):
        to_message(value)


@pytest.mark.parametrize('value', [2**63 - 1, -(2**63)])
def test_the_largest_integers_fit(value):
    assert to_message(value).integer_value == value


@pytest.mark.parametrize(
    ('text', 'wanted', 'said'),
    [
        ('1', DOUBLE, 'it is a double: write 1.0'),
        ('1e-7', DOUBLE, 'it is a double: write 1.0e-07'),
        ('fast', DOUBLE, 'it is a double'),
        ('1.0', INTEGER, 'it is an integer: write 1'),
        ('1.5', INTEGER, 'it is an integer'),
        ('.inf', INTEGER, 'it is an integer'),
        ('1', BOOL, 'it is a boolean: write true or false'),
        ('5', STRING, 'it is a string: write \'"5"\''),
        ('off', STRING, 'it is a string: write \'"off"\''),
        ('[1, 2]', DOUBLE_ARRAY, 'it is a double array: write [1.0, 2.0]'),
        ('[1, 2.5]', DOUBLE_ARRAY, 'it is a double array: write [1.0, 2.5]'),
        ('3', DOUBLE_ARRAY, 'it is a double array: write [3.0]'),
        ('[1, a]', INTEGER_ARRAY, 'it is an integer array'),
        ('{a: 1}', DOUBLE, 'it is a double'),
        ('1', STRING_ARRAY, 'it is a string array'),
    ],
)
def test_a_value_of_another_type_is_rewritten(text, wanted, said):
    assert advice(text, wanted) == said


def test_a_value_that_is_not_yaml_is_told_with_its_place():
    said = advice('[1, 2', DOUBLE_ARRAY)
    assert said.startswith('it is a double array. The passed value is not YAML: line 1, column 6')


@pytest.mark.parametrize('text', ['1', '1e-7', '[1, 2.5]', '3', '.inf', '1.0', '[]', '0x10'])
@pytest.mark.parametrize('wanted', [DOUBLE, INTEGER, DOUBLE_ARRAY, INTEGER_ARRAY, STRING])
def test_what_is_advised_has_the_type_that_is_wanted(text, wanted):
    _, given, instead = advice(text, wanted).partition(': write ')
    if given:
        assert to_message(typed(instead.strip("'")), wanted).type == wanted


@pytest.mark.parametrize(
    'value', [True, 5, -0.5, 'x: y', '5', '', [1.0, 2.0], ['a', '5'], [b'a'], []]
)
def test_a_value_as_text_is_the_same_when_typed(value):
    assert typed(as_text(value)) == value


def test_a_description_tells_what_there_is():
    bounds = IntegerRange(from_value=-1, to_value=1)
    descriptor = ParameterDescriptor(
        name='a.b',
        type=INTEGER,
        description='An int',
        additional_constraints='odd',
        read_only=True,
        integer_range=[bounds],
    )
    assert list(lines(descriptor)) == [
        'Parameter name: a.b',
        '  Type: integer',
        '  Description: An int',
        '  Constraints:',
        '    Read only: true',
        '    Min value: -1',
        '    Max value: 1',
        '    Additional constraints: odd',
    ]
    steps = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.25)
    descriptor = ParameterDescriptor(name='c', type=BYTE_ARRAY, floating_point_range=[steps])
    assert list(lines(descriptor))[1::4] == ['  Type: byte array', '    Step: 0.25']


TEXTS = [
    '', ' ', 'a b', 'x: y', '# c', "it's", '"', '\\', 'two\nlines', 'end\n', '\ttab', 'grüße 😀',
    'word ' * 60, '5', '+5', '-08', '08', '0x10', '0X1F', '0x1p3', '0x1.8', '0b11', '0o7', '1_000',
    '12:30', '2026-01-01', '1.', '.5', '1e3', '1E5', '1.5e-3', '.5e1', '99999999999999999999',
    'inf', 'Infinity', '-Infinity', '.inf', '-.Inf', 'nan', 'NaN', '.nan', 'nan()', 'nan(1)',
    'y', 'N', 'yes', 'Off', 'true', 'TRUE', 'tRue', 'null', 'NULL', '~', '=', '<<', '[1]',
    '{a: 1}', '-.5', '- a', '? x', '@x', '*a', '&a', '!x', '%', '|', '>', '`', 'e5', '0x', '.',
    '-', '\x07', '\u2028',
]  # fmt: skip
VALUES = {
    **{f'text_{index:02}': text for index, text in enumerate(TEXTS)},
    'texts': TEXTS[:40],
    'flag': True,
    'flags': [True, False],
    'largest': 2**63 - 1,
    'smallest': -(2**63),
    'integers': [0, -1],
    'doubles': [0.1, 1.0, 1e20, 1e-300, -0.0, math.inf, -math.inf, 1.7976931348623157e308],
    'a.b': 1,
    'a.c.d': 2,
    'g': 1,
    'g.h': 2,
    'two words': 3,
}


@pytest.fixture
def as_rcl_reads(tmp_path):
    """Start a node with a parameter file; return its parameters."""

    def start(node, text):
        file = tmp_path / 'parameters.yaml'
        file.write_text(text)
        context = Context()
        rclpy.init(context=context, args=['--ros-args', '--params-file', str(file)])
        try:
            declare = {'automatically_declare_parameters_from_overrides': True}
            node = Node(node, context=context, **declare)
            found = node.get_parameters_by_prefix('')
            node.destroy_node()
        finally:
            context.try_shutdown()
        return {k: parameter_value_to_python(p.get_parameter_value()) for k, p in found.items()}

    return start


def test_what_is_dumped_is_what_a_node_starts_with(as_rcl_reads):
    read = as_rcl_reads('arm', parameter_file_text('/arm', VALUES))
    assert {name: read.get(name) for name in VALUES} == VALUES
    assert {name: type(read[name]) for name in VALUES} == {k: type(v) for k, v in VALUES.items()}


def test_what_is_dumped_is_what_is_loaded():
    assert select(yaml.safe_load(parameter_file_text('/left/arm', VALUES)), '/left/arm') == VALUES


def test_a_dump_is_sorted_and_nested():
    text = parameter_file_text('/arm', {'b': 'x', 'a.b.c': 1, 'a.b.a': [1, 2], 'a.c': None})
    assert text == (
        '/arm:\n  ros__parameters:\n    a:\n      b:\n        a:\n        - 1\n        - 2\n'
        '        c: 1\n      c: null\n    b: x\n'
    )


@pytest.mark.parametrize(
    ('pattern', 'nodes'),
    [
        ('/arm', ['/arm']),
        ('arm', ['/arm']),
        ('/left/arm', ['/left/arm']),
        ('left/arm', ['/left/arm']),
        ('/**', ['/arm', '/left/arm', '/left/far/arm', '/leg']),
        ('/*', ['/arm', '/leg']),
        ('/*/arm', ['/left/arm']),
        ('/**/arm', ['/arm', '/left/arm', '/left/far/arm']),
        ('/left/**', ['/left/arm', '/left/far/arm']),
        ('/a.m', []),
    ],
)
def test_a_section_is_for_the_nodes_that_it_names(pattern, nodes):
    for node in ('/arm', '/left/arm', '/left/far/arm', '/leg'):
        content = {pattern: {'ros__parameters': {'x': 1}}}
        if node in nodes:
            assert select(content, node) == {'x': 1}
        else:
            with pytest.raises(ParameterError, match=f'no parameters for {node}'):
                select(content, node)


def section(**parameters):
    return {'ros__parameters': parameters}


def test_the_more_particular_section_wins():
    content = {
        '/arm': section(a=1),
        '/*': section(a=2, b=2),
        '/**': section(a=3, b=3, c={'d': 3}),
        '/leg': section(a=4, e=4),
    }
    assert select(content, '/arm') == {'a': 1, 'b': 2, 'c.d': 3}
    assert select(content, '/arm', wildcards=False) == {'a': 1}
    with pytest.raises(ParameterError, match=r'no parameters for /hand in it, only for /arm, /\*'):
        select(content, '/hand', wildcards=False)


def test_nodes_may_stand_below_their_namespace():
    content = {'left': {'arm': section(a=1), 'far': {'arm': section(a=2)}}, '/**': section(b=3)}
    assert select(content, '/left/arm') == {'b': 3, 'a': 1}
    assert select(content, '/left/far/arm') == {'b': 3, 'a': 2}


def test_what_has_no_type_in_ros_is_sent_as_text_and_null_is_not_sent():
    parameters = yaml.safe_load('{a: [1, 2.0], b: 2026-01-01, c: null, 5: 6}')
    found = select({'/arm': {'ros__parameters': parameters}}, '/arm')
    assert found == {'a': '[1, 2.0]', 'b': '2026-01-01', '5': 6}


@pytest.mark.parametrize('parameters', [None, 5, [1]])
def test_parameters_that_are_no_mapping_are_told(parameters):
    with pytest.raises(ParameterError, match='of /arm is expected to be a mapping'):
        select({'/arm': {'ros__parameters': parameters}}, '/arm')
