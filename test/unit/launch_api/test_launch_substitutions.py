# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Substitutions and conditions: their texts, what --show-args says of them, and their failures."""

import sys

import pytest

from amr_description.errors import BringupError
from amr_description.launch_api import conditions, logic, substitutions as subs
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.parameters import (
    evaluated,
    Parameter,
    ParameterFile,
    ParameterValue as Value,
)
from amr_description.launch_api.text_syntax import parse_text

CONFIG = subs.LaunchConfiguration


@pytest.fixture
def context():
    made = LaunchContext()
    made.launch_configurations |= {'robot': 'amr', 'sim': 'True', 'n': '3', 'empty': ''}
    made.environment['HOST'] = 'here'
    locals_ = {'current_launch_file_directory': '/pkg/launch', 'current_launch_file_path': '/f'}
    made.extend_locals(locals_)
    return made


@pytest.mark.parametrize(
    ('made', 'text', 'described'),
    [
        (subs.TextSubstitution(text='a b'), 'a b', "'a b'"),
        (CONFIG('robot'), 'amr', "LaunchConfig('robot')"),
        (CONFIG(['ro', 'bot']), 'amr', "LaunchConfig('ro' + 'bot')"),
        (CONFIG('nope', default='x'), 'x', "LaunchConfig('nope')"),
        (CONFIG('nope', default=['a', CONFIG('n')]), 'a3', "LaunchConfig('nope')"),
        (CONFIG('nope', default=True), 'True', "LaunchConfig('nope')"),
        (subs.EnvironmentVariable('HOST'), 'here', "EnvVar('HOST')"),
        (subs.EnvironmentVariable('NOPE_', default_value='x'), 'x', "EnvVar('NOPE_')"),
        (
            subs.PathJoinSubstitution(['a', [CONFIG('robot'), '.urdf']]),
            'a/amr.urdf',
            "PathJoin(''a' + LaunchConfig('robot') + '.urdf'')",
        ),
        (subs.PathSubstitution('a') / 'b' , 'a/b', "PathJoin(''a' + 'b'')"),
        (subs.StringJoinSubstitution(['a', CONFIG('n')], '-'), 'a-3', None),
        (subs.ThisLaunchFileDir(), '/pkg/launch', 'ThisLaunchFileDir()'),
        (subs.ThisLaunchFile(), '/f', 'ThisLaunchFile()'),
        (subs.Command(['echo ', CONFIG('robot')]), 'amr\n', "Command('echo ' + LaunchConfig('rob"),
        (subs.Command(f"{sys.executable} -c 'print(1)'"), '1\n', None),
        (subs.FindExecutable(name='sh'), None, "FindExec('sh')"),
        (logic.NotSubstitution(CONFIG('sim')), 'false', None),
        (logic.AndSubstitution(CONFIG('sim'), 'yes'), 'true', None),
        (logic.OrSubstitution('off', '0'), 'false', None),
        (logic.AnySubstitution('0', 'no', 'on'), 'true', None),
        (logic.AllSubstitution(), 'true', None),
        (logic.EqualsSubstitution(CONFIG('robot'), 'amr'), 'true', None),
        (logic.EqualsSubstitution('1.0', 1), 'true', None),
        (logic.EqualsSubstitution('true', '1'), 'true', None),
        (logic.EqualsSubstitution(CONFIG('empty'), None), 'true', None),
        (logic.NotEqualsSubstitution('a', 'b'), 'true', None),
        (
            logic.IfElseSubstitution(CONFIG('sim'), 'gz', 'real'),
            'gz',
            "IfElseSubstitution(LaunchConfig('sim'), 'gz', 'real')",
        ),
        (logic.IfElseSubstitution('false', else_value='real'), 'real', None),
        (
            logic.PythonExpression(["'", CONFIG('sim'), "' == 'True' and pi > 3"]),
            'True',
            """PythonExpr(''' + LaunchConfig('sim') + '' == 'True' and pi > 3', ['math'])""",
        ),
        (logic.PythonExpression('sys.maxsize > 0', ['sys']), 'True', None),
    ],
)  # fmt: skip
def test_the_text_of_a_substitution(context, made, text, described):
    found = made.perform(context)
    assert found == text if text is not None else found.endswith('/sh')
    assert described is None or made.describe().startswith(described)


def test_a_package_is_found_and_described():
    own = subs.FindPackageShare('amr_description')
    assert own.perform(LaunchContext()).endswith('/share/amr_description')
    assert own.describe() == "FindPackageShare(pkg='amr_description')"
    prefix = subs.FindPackagePrefix(['amr_', 'description']).perform(LaunchContext())
    assert own.perform(LaunchContext()) == f'{prefix}/share/amr_description'


@pytest.mark.parametrize(
    ('made', 'said'),
    [
        (CONFIG('robo'), "launch configuration 'robo' does not exist; did you mean 'robot'"),
        (subs.EnvironmentVariable('NOPE_'), "environment variable 'NOPE_' does not exist"),
        (subs.FindExecutable(name='nope_'), "executable 'nope_' not found on the PATH"),
        (subs.FindPackageShare('nope_'), "package 'nope_' not found; build it and source its"),
        (subs.Command('nope_ x'), "the command 'nope_ x' cannot be run: .*No such file"),
        (subs.Command('sh -c "echo bad >&2; exit 3"'), 'executed command failed. .*: bad'),
        (subs.Command('sh -c "echo odd >&2"'), 'executed command showed stderr output.*: odd'),
        (subs.Command("'"), 'cannot be split'),
        (logic.NotSubstitution(CONFIG('robot')), r"LaunchConfig\('robot'\) is 'amr'; it takes tr"),
        (logic.PythonExpression('1 +'), "PythonExpression '1 \\+': SyntaxError"),
        (logic.PythonExpression(CONFIG('robot')), "'amr': NameError: name 'amr' is not defined"),
        (subs.FileContent('/nope_'), "FileContent '/nope_': .*No such file"),
        (subs.LocalSubstitution('event.reason'), "there is no 'event.reason' here"),
    ],
)
def test_a_substitution_without_a_text_is_told_with_its_place(context, made, said):
    with pytest.raises(BringupError, match=rf'test_launch_substitutions.py:\d+: .*{said}') as told:
        made.perform(context)
    assert '\n' not in str(told.value)


def test_a_description_that_is_not_there_is_named(context, tmp_path):
    (tmp_path / 'robot.urdf.xacro').write_text('<robot name="a"><odd/></robot>')
    (tmp_path / 'broken.xacro').write_text('<robot')
    with pytest.raises(
        BringupError, match=r"no file '.*/robto.urdf.xacro'; did you mean robot.ur"
    ):
        subs.Command(f'xacro {tmp_path}/robto.urdf.xacro a:=b.urdf').perform(context)
    with pytest.raises(BringupError, match='executed command failed') as told:
        subs.Command(f'xacro {tmp_path}/broken.xacro').perform(context)
    assert 'there is no file' not in str(told.value)


def test_stderr_of_a_command_may_be_allowed(context):
    odd = 'sh -c "echo odd >&2; echo even"'
    assert subs.Command(odd, on_stderr='ignore').perform(context) == 'even\n'
    assert subs.Command(odd, on_stderr='capture').perform(context) == 'odd\neven\n'
    assert context.notes == []
    assert subs.Command(odd, on_stderr='warn').perform(context.copy()) == 'even\n'
    ((level, text),) = context.notes
    assert level == 'WARNING'
    assert text == f'executed command showed stderr output. Command: {odd}: odd'


@pytest.mark.parametrize(
    ('condition', 'holds'),
    [
        (conditions.IfCondition(CONFIG('sim')), True),
        (conditions.IfCondition('0'), False),
        (conditions.UnlessCondition('false'), True),
        (conditions.UnlessCondition(CONFIG('sim')), False),
        (conditions.LaunchConfigurationEquals('robot', 'amr'), True),
        (conditions.LaunchConfigurationEquals('robot', 'arm'), False),
        (conditions.LaunchConfigurationEquals('nope', None), True),
        (conditions.LaunchConfigurationEquals('nope', 'x'), False),
        (conditions.LaunchConfigurationNotEquals('robot', 'arm'), True),
        (conditions.Condition(predicate=lambda context: 'n' in context.launch_configurations), 1),
    ],
)
def test_a_condition(context, condition, holds):
    assert condition.evaluate(context) == holds


def test_a_condition_is_true_or_false(context):
    with pytest.raises(BringupError, match="invalid condition expression 'amr', expected one of"):
        conditions.IfCondition(CONFIG('robot')).evaluate(context)


@pytest.mark.parametrize(
    ('given', 'expected'),
    [
        ({'a': 'True', 'b': 5, 'c': [1, 2.5], 'd': ['x', 'y']}, None),
        ({'a': CONFIG('sim'), 'b': CONFIG('n'), 'c': CONFIG('robot')}, (True, 3, 'amr')),
        ({'a': [CONFIG('robot'), '/base']}, ('amr/base',)),
        ({CONFIG('robot'): 1}, (1,)),
        ({'deep': {'a': CONFIG('n')}}, ({'a': 3},)),
        ({'a': Value(CONFIG('n'), value_type=str)}, ('3',)),
        ({'a': Value('2', value_type=float)}, (2.0,)),
        ({'a': Value([CONFIG('n'), '4'], value_type=list[int])}, None),
        ({'a': Value(CONFIG('sim'), value_type=bool)}, (True,)),
        ({'a': Value('5')}, (5,)),
        ({'a': CONFIG('empty')}, ('',)),
        ({'a': [[CONFIG('n')], ['4']]}, None),
    ],
)
def test_parameters(context, given, expected):
    (table,) = evaluated(context, [given], 'x')
    if expected is not None:
        assert tuple(table.values()) == expected
        assert [type(each) for each in table.values()] == [type(each) for each in expected]


def test_lists_of_parameters(context):
    (table,) = evaluated(context, [{'c': [1, 2.5], 'd': ['1', '2']}], 'x')
    assert table == {'c': [1.0, 2.5], 'd': ['1', '2']}
    (named,) = evaluated(context, [Parameter('a', CONFIG('n'))], 'x')
    assert named == {'a': 3}


@pytest.mark.parametrize(
    ('given', 'said'),
    [
        ({'a': subs.TextSubstitution(text='b: [')}, 'Unable to parse the value of param'),
        ({'a': subs.TextSubstitution(text='{b: 1}')}, "in YAML a dict, .*value_type=str"),
        ({'a': object()}, "parameter 'a' is <object.*for which ROS has no type"),
        ({'a': Value('x', value_type=int)}, "parameter 'a' is 'x', which is no int"),
    ],
)  # fmt: skip
def test_a_parameter_that_ros_does_not_have(context, given, said):
    with pytest.raises(BringupError, match=said):
        evaluated(context, [given], 'x')


def test_parameters_are_a_list(context):
    with pytest.raises(BringupError, match='it takes a list'):
        evaluated(context, {'a': 1}, 'x')


def test_a_parameter_file_with_substitutions(context, tmp_path):
    path = tmp_path / 'p.yaml'
    path.write_text(
        '# $(var nope)\na: {ros__parameters: {robot: $(var robot), n: "$(env HOST)"}}\n'
    )
    assert ParameterFile(str(path)).evaluate(context) == path
    text = ParameterFile([str(path)], allow_substs=True).evaluate(context).text
    assert text.splitlines()[1] == 'a: {ros__parameters: {robot: amr, n: "here"}}'


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('plain', 'plain'),
        ('', ''),
        ('a $(var robot)-$(var n) b', 'a amr-3 b'),
        ('$(var nope x)', 'x'),
        ('$(var $(var robot)_n "a b")', 'a b'),
        ('$(env NOPE_ $(var robot))', 'amr'),
        ("$(eval '$(var n) + 1')", '4'),
        ('$(eval $(var n) + 1)', '4'),
        ("$(eval 'os.sep + str(floor(1.5))' 'os, math')", '/1'),
        ('$(command echo $(var robot) ignore)', 'amr ignore\n'),
        ('$(equals $(var robot) amr)', 'true'),
        ('$(dirname)/x', '/pkg/launch/x'),
        ("$(command 'echo hi')", 'hi\n'),
        ('$(command echo hi ignored)', 'hi ignored\n'),
        ("""$(command "sh -c 'echo hi; echo oh >&2'" ignore)""", 'hi\n'),
        ("""$(command "sh -c 'echo hi; echo oh >&2'" 'capture')""", 'hi\noh\n'),
        (r'\$(var x)', '$(var x)'),
    ],
)
def test_substitutions_in_texts(context, text, expected):
    assert subs.perform_substitutions(context, parse_text(text)) == expected


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('$(vars x)', r'f:3: \$\(vars\) is not understood here; did you mean var'),
        ('$(var x', r"f:3: '\$\(var x': \$\(var is not closed"),
        ("$(eval '1' math 2)", r'f:3: \$\(eval …\): it does not take 3 arguments'),
        ('$(not a b)', r'f:3: \$\(not …\): it does not take 2 arguments'),
    ],
)
def test_a_text_that_is_not_understood(text, said):
    with pytest.raises(BringupError, match=said):
        parse_text(text, 'f:3')


def test_scopes(context):
    context.push_configurations()
    context.launch_configurations['robot'] = 'other'
    context.push_environment()
    context.environment['HOST'] = 'there'
    inner = context.copy()
    context.pop_environment()
    context.pop_configurations()
    assert CONFIG('robot').perform(context) == 'amr'
    assert subs.EnvironmentVariable('HOST').perform(context) == 'here'
    assert CONFIG('robot').perform(inner) == 'other'
    assert context.changes_of_environment() == {'HOST': 'here'}
    del context.environment['PATH']
    assert context.changes_of_environment() == {'HOST': 'here', 'PATH': None}


def test_anonymous_names_differ_by_their_name_only(context):
    first, again, other = (subs.AnonName(name).perform(context) for name in ('a', 'a', 'b'))
    assert first == again != other
    assert first.startswith('a_')
