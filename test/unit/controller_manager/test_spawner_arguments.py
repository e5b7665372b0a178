# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command line of the spawner: both forms, defaults, and what is wrong."""

from dataclasses import replace

import pytest

from amr_description.controller_manager.spawner_arguments import (
    ControllerPlan,
    parse,
    SpawnOptions,
)
from amr_description.errors import ParameterError

DEFAULTS = SpawnOptions(
    plans=(ControllerPlan('a'),),
    manager='controller_manager',
    namespace='',
    manager_timeout=0.0,
    switch_timeout=5.0,
    call_timeout=10.0,
    as_group=False,
    activate_asap=True,
    unload_on_kill=False,
    continue_on_error=False,
)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """A working directory with two parameter files."""
    monkeypatch.chdir(tmp_path)
    for name in ('a.yaml', 'b.yaml'):
        (tmp_path / name).touch()
    return tmp_path


def test_defaults_are_those_of_the_original():
    assert parse(['a']) == DEFAULTS
    assert parse(['--controller', 'a']) == replace(DEFAULTS, activate_asap=False)


@pytest.mark.parametrize('form', [['a'], ['--controller', 'a'], ['--controller=a']])
@pytest.mark.parametrize(
    ('words', 'changed'),
    [
        ('-c /x/cm', {'manager': '/x/cm'}),
        ('--controller-manager cm', {'manager': 'cm'}),
        ('-n left', {'namespace': 'left'}),
        ('-u', {'unload_on_kill': True}),
        ('--controller-manager-timeout 2.5', {'manager_timeout': 2.5}),
        ('--switch-timeout 0', {'switch_timeout': 0.0}),
        ('--service-call-timeout 1', {'call_timeout': 1.0}),
        ('--activate-as-group', {'as_group': True}),
        ('--switch-asap', {'activate_asap': True}),
        ('--no-switch-asap', {'activate_asap': False}),
    ],
)
def test_what_is_for_all_may_stand_anywhere(form, words, changed):
    expected = replace(parse(form), **changed)
    assert parse([*form, *words.split()]) == expected
    assert parse([*words.split(), *form]) == expected


def test_in_the_short_form_all_controllers_are_treated_alike(folder):
    words = 'a b a -p a.yaml --param-file b.yaml --inactive --load-only'
    args = ['--controller-ros-args', '-r /tf:=tf', '--controller-ros-args', '-p x:=1']
    plan = ControllerPlan(
        'a',
        files=(str(folder / 'a.yaml'), str(folder / 'b.yaml')),
        load_only=True,
        inactive=True,
        ros_args=('-r', '/tf:=tf', '-p', 'x:=1'),
    )
    assert parse([*words.split(), *args]).plans == (plan, replace(plan, name='b'))


def test_in_the_long_form_each_has_its_own(folder):
    words = '--controller a -p a.yaml --inactive -c cm --controller b --load-only'
    options = parse([*words.split(), '--controller-ros-args', '-r /tf:=tf', '--controller', 'd'])
    assert options.manager == 'cm'
    assert options.plans == (
        ControllerPlan('a', files=(str(folder / 'a.yaml'),), inactive=True),
        ControllerPlan('b', load_only=True, ros_args=('-r', '/tf:=tf')),
        ControllerPlan('d'),
    )


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        ('', 'controller_names'),
        ('a --nonsense', 'unrecognized arguments: --nonsense'),
        ('a --switch-timeout soon', "'soon' is no time in seconds"),
        ('a --switch-timeout -1', "'-1' is no time in seconds"),
        ('a --controller-manager-timeout inf', "'inf' is no time in seconds"),
        ('a --controller-manager-timeout nan', "'nan' is no time in seconds"),
        ('a --service-call-timeout 0', 'it must be above 0 s'),
        ('--controller', '--controller NAME'),
        ('--controller --inactive', '--controller NAME'),
        ('--controller a --controller a', 'controller a is given twice'),
        ('--controller a b', 'unrecognized arguments: b'),
        ('b --controller a', 'unrecognized arguments: b'),
        ('-p a.yaml --controller a', 'unrecognized arguments: -p a.yaml'),
        ('--inactive --controller a', 'unrecognized arguments: --inactive'),
    ],
)
def test_a_wrong_command_line_is_answered_with_the_usage(capsys, words, said):
    with pytest.raises(SystemExit) as ended:
        parse(words.split())
    error = capsys.readouterr().err
    assert ended.value.code == 2
    assert error.startswith('usage: spawner ')
    assert said in error


@pytest.mark.parametrize('words', ['-h', 'a --help', '--controller a -h'])
def test_help_tells_both_forms(capsys, words):
    with pytest.raises(SystemExit) as ended:
        parse(words.split())
    text = capsys.readouterr().out
    assert ended.value.code == 0
    assert 'controller_names' in text
    assert '--controller NAME' in text


@pytest.mark.parametrize('words', ['a -p no.yaml', '--controller a -p .'])
def test_a_parameter_file_must_be_there(words):
    with pytest.raises(ParameterError, match='^-p (no.yaml|.): there is no such parameter file$'):
        parse(words.split())
