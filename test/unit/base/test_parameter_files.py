# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files: their faults in one line, their sections, and how they are written."""

from itertools import pairwise
import math
from pathlib import Path

import pytest
import yaml

from amr_description.errors import ParameterError
from amr_description.parameter_files import (
    compose,
    content_of,
    dotted,
    find_keys,
    flatten,
    load_yaml,
    parameter_file_text,
    read_parameter_file,
    scalar_of,
    sections,
    text_of,
    YamlError,
)


def test_nodes_may_stand_below_their_namespaces(tmp_path):
    path = tmp_path / 'good.yaml'
    path.write_text('/left:\n  arm:\n    ros__parameters: {gain: 1.0}\n')
    assert read_parameter_file(path) == {'/left': {'arm': {'ros__parameters': {'gain': 1.0}}}}


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('', 'holds no node'),
        ('[1, 2]', 'holds no node'),
        ('/arm: {gain: 1.0}', "below '/arm/gain' stands 1.0, and no ros__parameters"),
        ('/arm:\n  ros__parameters: {gain: [1', r"bad.yaml:2:29: expected ',' or '\]'"),
        ('/arm:\n\tros__parameters:', 'bad.yaml:2:1: found character'),
        ('/arm: \x07', 'character 7 is U.0007, which YAML does not allow'),
        ('/arm: 2026-99-99', "below '/arm' stands '2026-99-99', and no ros__parameters"),
        ('{\n' * 50_000, 'nested too deeply'),
        ('{\n' * 500 + 'x', 'nested too deeply'),
        ('a: &x\n  b: *x', r"bad.yaml:2:6: ROS reads no aliases, as '\*x'; write the value out"),
        ('a: {p: &x [*x]}', r"bad.yaml:1:12: ROS reads no aliases, as '\*x'"),
        ('a:\n  <<: {b: 1}', "bad.yaml:2:3: ROS merges no tables, as '<<:' does; write the val"),
    ],
)
def test_a_fault_is_reported_in_one_line(tmp_path, text, said):
    path = tmp_path / 'bad.yaml'
    path.write_text(text)
    with pytest.raises(ParameterError, match=said) as error:
        read_parameter_file(path)
    assert '\n' not in str(error.value)


@pytest.mark.parametrize(
    ('text', 'value'),
    [
        *(('5e-2', 0.05), ('1E3', 1000.0), ('5.', 5.0), ('+.5', 0.5), ('-0.0', -0.0)),
        *(('+5', 5), ('010', 8), ('08', 8.0), ('0x1F', 31), ('0x1.8p1', 3.0), ('-0', 0)),
        *(('inf', math.inf), ('-Infinity', -math.inf), ('-.inf', -math.inf), ('+.INF', math.inf)),
        *(('y', True), ('On', True), ('NO', False), ('n', False), ('tRUE', 'tRUE'), ('yE', 'yE')),
        *((text, text) for text in ('1_000', '1_00.0', '1:30', '2026-01-01', '0b11', '0o17')),
        *((text, text) for text in ('null', '~', '<', '=', '1e400', '1e-400', '5e-324', '1d3')),
        *((text, text) for text in ('0x', '1e', '--5', '.', '+', '.e5', '٣', '5 6', '0x1G')),
        *((str(2**63 - 1), 2**63 - 1), (str(-(2**63)), -(2**63)), (str(2**63), float(2**63))),
        ('9' * 5000, '9' * 5000),
        *(('"5"', '5'), ("'yes'", 'yes'), ('!!str 5', '5'), ('!!int "5"', '5'), ('!!float 5', 5)),
    ],
)
def test_a_value_is_what_rcl_reads(text, value):
    """Held against rcl itself by test/ros/control/test_parameters_as_rcl_reads_them.py."""
    (found,) = content_of(f'p: {text}').values()
    assert (type(found), repr(found)) == (type(value), repr(value))
    assert content_of(text_of({'p': value})) == {'p': value}


def test_no_number_is_one_too():
    assert all(math.isnan(scalar_of(text)) for text in ('.nan', 'NaN', '.NAN', '-nan', 'nan(x)'))


def test_keys_are_texts():
    assert content_of('{1: a, yes: b, 5e2: c, "<<": d}') == {
        '1': 'a', 'yes': 'b', '5e2': 'c', '<<': 'd'
    }  # fmt: skip


def test_bytes_that_are_not_text_are_reported(tmp_path):
    path = tmp_path / 'bad.yaml'
    path.write_bytes(b'/arm: \xff')
    with pytest.raises(ParameterError, match='not UTF-8 text'):
        read_parameter_file(path)


def test_a_missing_file_is_reported(tmp_path):
    with pytest.raises(ParameterError, match="nowhere.yaml': No such file"):
        read_parameter_file(tmp_path / 'nowhere.yaml')
    with pytest.raises(ParameterError, match='Is a directory'):
        read_parameter_file(Path(tmp_path))


def test_a_syntax_error_has_its_line_and_column():
    with pytest.raises(YamlError) as error:
        load_yaml('a: 1\n b: 2')
    assert error.value.where == (2, 3)


def test_sections_are_found_below_namespaces_in_the_order_of_the_file():
    content = load_yaml(
        '/**: {ros__parameters: {}}\nleft: {far: {arm: {ros__parameters: {a: 1}}}}'
    )
    assert [each.pattern for each in sections(content)] == ['/**', '/left/far/arm']


@pytest.mark.parametrize(
    ('pattern', 'node', 'expected'),
    [
        ('/**', '/a/b', True),
        ('/*', '/a', True),
        ('/*', '/a/b', False),
        ('/**/b', '/b', True),
        ('/a/**', '/a/b/c', True),
        ('a', '/a', True),
        ('/a.c', '/abc', False),
    ],
)
def test_wildcards_match_parts_of_names(pattern, node, expected):
    (section,) = sections({pattern: {'ros__parameters': {}}})
    assert section.is_of(node) is expected


def test_what_is_written_is_what_is_read(tmp_path):
    parameters = {'a.b': 1.0, 'a.c.d': ['5', 'on'], 'text': '1e3', 'e': True}
    path = tmp_path / 'good.yaml'
    path.write_text(parameter_file_text('/left/arm', parameters))
    (section,) = sections(read_parameter_file(path))
    assert section.is_of('/left/arm')
    assert {dotted(keys): value for keys, value in flatten(section.parameters)} == parameters


def test_a_key_that_stands_twice_is_one_table_as_rcl_reads_it(tmp_path):
    path = tmp_path / 'twice.yaml'
    path.write_text(
        '/**:\n  arm:\n    ros__parameters: {a: 1, b: 1}\n'
        '/**:\n  hand:\n    ros__parameters: {c: 3}\n'
        '/**:\n  arm:\n    ros__parameters: {b: 2}\n'
    )
    tables = {each.pattern: each.parameters for each in sections(read_parameter_file(path))}
    assert tables == {'/**/arm': {'a': 1, 'b': 2}, '/**/hand': {'c': 3}}
    assert find_keys(compose(path.read_text()), ('/**', 'hand'))[0] == 5


@pytest.mark.parametrize(
    'text',
    ['&a [*a]', 'a: &a [1, [*a]]', '&a {b: *a}', 'a: &a {b: [1, {c: *a}]}', '- &a [*a]'],
)
@pytest.mark.parametrize('load', [yaml.safe_load, yaml.compose])
def test_a_value_that_contains_itself_is_none(text, load):
    with pytest.raises(ParameterError, match=r'^a value contains itself, as &a \[\*a\] does'):
        load_yaml(text, load)


def test_a_value_may_stand_in_many_places():
    assert load_yaml('{a: &a [1], b: [*a, *a], c: *a}') == {'a': [1], 'b': [[1], [1]], 'c': [1]}
    laughs = 'a: &a [1]\n' + ''.join(
        f'{new}: &{new} [{", ".join([f"*{old}"] * 9)}]\n' for old, new in pairwise('abcdefghijk')
    )
    assert set(load_yaml(laughs)) == set('abcdefghijk')


def test_of_a_value_that_stands_twice_the_line_is_that_of_the_one_that_counts():
    text = 'a:\n  ros__parameters:\n    x: 1\n    y: 2\na:\n  ros__parameters:\n    x: 3\n'
    tree = compose(text)
    assert content_of(text) == {'a': {'ros__parameters': {'x': 3, 'y': 2}}}
    assert [find_keys(tree, ('a', 'ros__parameters', key))[0] for key in 'xy'] == [7, 4]
