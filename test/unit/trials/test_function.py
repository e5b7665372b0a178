# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A trial's function: what it is called, where it is found, and what it is given."""

from dataclasses import replace
from functools import partial
import runpy
import sys

import pytest
from support.paths import ROOT

from amr_description.errors import TrialsError
from amr_description.trials.function import cells, require_parameters, TrialFunction
from amr_description.trials.variations import normal, uniform, vary

FILE = ROOT / 'test' / 'fixtures' / 'trials' / 'drives.py'


@pytest.fixture
def drives(monkeypatch):
    monkeypatch.syspath_prepend(FILE.parent)
    monkeypatch.delitem(sys.modules, 'drives', raising=False)
    import drives

    return drives


def top(simulate, rng):
    pass


def test_a_function_is_found_by_its_module(drives, monkeypatch):
    monkeypatch.chdir(FILE.parent)
    trial = TrialFunction.of(drives.quick)
    assert trial.label == 'drives.py:quick'
    assert trial.load() is drives.quick
    assert TrialFunction.named('drives:quick').load() is drives.quick


def test_a_function_of_a_script_is_found_by_its_file():
    script = runpy.run_path(str(FILE), run_name='__main__')
    trial = TrialFunction.of(script['quick'])
    assert trial.module == '__main__'
    assert trial.load() is script['quick']
    in_other_processes = replace(trial, label='')
    assert in_other_processes.load().__name__ == 'quick'
    assert in_other_processes.load() is not script['quick']
    assert TrialFunction.named(f'{FILE}:quick').load().__name__ == 'quick'


def test_another_module_of_that_name_is_not_taken_for_it(drives, tmp_path):
    other = tmp_path / 'drives.py'
    other.write_text('def quick(simulate, rng):\n    return 1\n')
    assert TrialFunction.named(f'{other}:quick').load()(None, None) == 1
    assert drives.quick is TrialFunction.of(drives.quick).load()


def test_what_other_processes_could_not_find_is_said():
    def local(simulate, rng):
        pass

    for function in (local, lambda simulate, rng: None):
        with pytest.raises(TrialsError, match='cannot be sent to other processes; a function tha'):
            TrialFunction.of(function)
    with pytest.raises(TrialsError, match='cannot be sent to other processes: '):
        TrialFunction.of(partial(top, local))
    typed = {'__name__': 'notebook'}
    exec('def cell(simulate, rng): pass', typed)
    with pytest.raises(TrialsError, match="'cell' is in no file"):
        TrialFunction.of(typed['cell'])
    assert TrialFunction.of(partial(top, rng=3)).load().keywords == {'rng': 3}


@pytest.mark.parametrize(
    ('target', 'words'),
    [
        ('drives', "'drives' names no trial; module:function or file.py:function"),
        ('nowhere:drive', "No module named 'nowhere'; it is looked for in this folder"),
        ('nowhere.py:drive', 'there is no file nowhere.py'),
        (f'{FILE}:nothing', 'there is no function of that name'),
        (f'{FILE}:URDF', 'there is no function of that name'),
    ],
)
def test_a_name_that_leads_nowhere_is_said(target, words):
    with pytest.raises(TrialsError, match=words):
        TrialFunction.named(target)


def test_a_grid_is_run_with_each_seed_and_draws_are_those_of_the_seed():
    trial = TrialFunction.named(f'{FILE}:slippery')
    assert trial.grid() == [{'speed': 0.3}, {'speed': 0.6}]
    assert [*cells(trial.grid(), 7)] == [('7.0', 0), ('7.1', 1)]
    assert [*cells(TrialFunction.named(f'{FILE}:quick').grid(), 7)] == [('7', 0)]
    draws = [trial.drawn(seed)['grip'] for seed in range(200)]
    assert draws == [trial.drawn(seed)['grip'] for seed in range(200)]
    assert len({*draws}) == 200
    assert 0.02 <= min(draws) < 0.1 < 0.9 < max(draws) <= 1.0


def test_a_parameter_does_not_change_the_draws_of_others():
    one = vary(b=normal(0.0, 1.0))(partial(top))
    both = vary(a=uniform(0.0, 1.0), b=normal(0.0, 1.0))(partial(top))
    assert TrialFunction.of(both).drawn(3)['b'] == TrialFunction.of(one).drawn(3)['b']


@pytest.mark.parametrize('value', ['fast', 3, [], None])
def test_what_does_not_vary_is_said(value):
    with pytest.raises(TrialsError, match="'speed' is .*; a list of values, or a function"):
        vary(speed=value)
    with pytest.raises(TrialsError, match="a value of 'speed' is nan; a finite number or a text"):
        vary(speed=[1.0, float('nan')])


def test_what_a_function_takes_has_to_be_what_it_is_given():
    require_parameters(top, [])
    with pytest.raises(TrialsError, match='takes "tmp_path", which nobody gives it'):
        require_parameters(lambda simulate, rng, tmp_path: None, [])
    with pytest.raises(TrialsError, match='does not take "speed", which it gets'):
        require_parameters(top, ['speed'])
