# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``nav2_common.launch``: parameter files of others with other values."""

from pathlib import Path

import pytest
import yaml

from amr_description.bringup.description import ParameterText
from amr_description.errors import BringupError
from amr_description.launch_api.conditions import IfCondition
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.parameters import evaluated
from amr_description.launch_api.rewriting import HasNodeParams, ReplaceString, RewrittenYaml
from amr_description.launch_api.substitutions import LaunchConfiguration

TEXT = """
talker: {ros__parameters: {rate: 1.0, deep: {rate: 2, 'on': false}}}
other: {ros__parameters: {name: <robot>, list: [1, 2]}}
"""


@pytest.fixture
def file(tmp_path):
    (tmp_path / 'p.yaml').write_text(TEXT)
    return str(tmp_path / 'p.yaml')


@pytest.fixture
def context():
    context = LaunchContext()
    context.launch_configurations |= {'rate': '5.5', 'ns': 'r1'}
    return context


def rewritten(context, file, rewrites, **options):
    return yaml.safe_load(RewrittenYaml(file, rewrites, **options).written(context))


def test_values_are_replaced_by_name_or_path(context, file):
    rates = {'rate': LaunchConfiguration('rate')}
    found = rewritten(context, file, rates, convert_types=True)
    assert found['talker']['ros__parameters'] == {'rate': 5.5, 'deep': {'rate': 5.5, 'on': False}}
    path = {'talker.ros__parameters.deep.on': 'True', 'other.ros__parameters.list': '7'}
    found = rewritten(context, file, path, convert_types=True)
    assert found['talker']['ros__parameters'] == {'rate': 1.0, 'deep': {'rate': 2, 'on': True}}
    assert found['other']['ros__parameters']['list'] == 7
    texts = rewritten(context, file, {'rate': '3'})
    assert texts['talker']['ros__parameters']['rate'] == '3'


def test_what_the_file_lacks_is_added_by_its_whole_path(context, file):
    new = {'third.ros__parameters.a.b': '1', 'nowhere': '2', 'no.parameters': '3'}
    found = rewritten(context, file, new, convert_types=True)
    assert found['third'] == {'ros__parameters': {'a': {'b': 1}}}
    assert set(found) == {'talker', 'other', 'third'}


def test_truth_is_read_in_any_case_and_an_item_has_its_number(context, file):
    values = {'on': 'true', 'other.ros__parameters.list.1': '7'}
    found = rewritten(context, file, values)
    assert found['talker']['ros__parameters']['deep']['on'] is True
    assert found['other']['ros__parameters']['list'] == [1, '7']


def test_aliases_are_written_out(context, tmp_path):
    source = tmp_path / 'p.yaml'
    source.write_text('a: &a {ros__parameters: {x: 1}}\nb: *a\nc: {<<: *a}\n')
    text = RewrittenYaml(str(source), {'c.ros__parameters.y': '2'}).written(context)
    assert '*' not in text
    assert yaml.safe_load(text)['b'] == {'ros__parameters': {'x': 1}}


def test_a_parameter_below_a_value_has_no_place(context, file):
    with pytest.raises(BringupError, match=r"'talker.ros__parameters.rate.x': what stands above"):
        rewritten(context, file, {'talker.ros__parameters.rate.x': '1'})


def test_keys_and_the_root(context, file):
    root = LaunchConfiguration('ns')
    found = rewritten(context, file, {}, root_key=root, key_rewrites={'talker': 'mine'})
    assert set(found['r1']) == {'mine', 'other'}
    assert set(rewritten(context, file, {}, root_key='')) == {'talker', 'other'}


def test_as_parameters_it_is_a_text_and_elsewhere_a_file_that_is_there(context, file):
    made = RewrittenYaml(file, {'rate': '5'}, convert_types=True)
    (entry,) = evaluated(context, [made], '')
    assert isinstance(entry, ParameterText)
    path = Path(made.perform(context))
    assert path.read_text() == made.written(context)
    assert path.suffix == '.yaml'


def test_texts_are_replaced_where_the_condition_holds(context, file):
    for condition, expected in (None, 'r1'), (IfCondition('true'), 'r1'), (IfCondition('0'), '<r'):
        replacements = {'<robot>': LaunchConfiguration('ns')}
        text = ReplaceString(file, replacements, condition).written(context)
        assert f'name: {expected}' in text


def test_whether_a_node_has_parameters(context, file):
    assert HasNodeParams(file, 'talker').perform(context) == 'True'
    assert HasNodeParams(file, 'nobody').perform(context) == 'False'


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        (None, 'No such file'),
        ('a: [', 'expected the node content'),
        ('- a', r"no table of nodes, but \['a'\]"),
    ],
)
def test_a_source_that_is_none_is_one_line(context, tmp_path, text, said):
    path = tmp_path / 'source.yaml'
    if text is not None:
        path.write_text(text)
    with pytest.raises(BringupError, match=said) as told:
        RewrittenYaml(str(path), {}).perform(context)
    assert '\n' not in str(told.value)
