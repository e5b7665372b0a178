# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Runs, in this process: by an executor of one thread, which is as good as any."""

from concurrent.futures import ThreadPoolExecutor
import math

import numpy as np
import pytest
from support.paths import ROOT

from amr_description import Simulation
from amr_description.errors import SimulationError, TrialsError
from amr_description.model.frames import Transform
from amr_description.trials.function import TrialFunction
from amr_description.trials.one_run import Ending, judged, message_of, Simulations
from amr_description.trials.runner import trials

FILE = ROOT / 'test' / 'fixtures' / 'trials' / 'drives.py'
URDF = str(ROOT / 'urdf' / 'amr.urdf')


def named(name):
    return TrialFunction.named(f'{FILE}:{name}')


@pytest.fixture
def here():
    with ThreadPoolExecutor(1) as executor:
        yield executor


@pytest.mark.parametrize(
    ('returned', 'kind', 'words'),
    [
        (None, Ending.PASSED, ''),
        (True, Ending.PASSED, ''),
        (np.bool_(False), Ending.FAILED, 'it returned False'),
        (0.5, Ending.PASSED, ''),
        ({'a': np.float32(1.0), 'b': True}, Ending.PASSED, ''),
        (math.nan, Ending.INVALID, "it returned NaN as 'value'; a finite number will do"),
        ({'a': -math.inf}, Ending.INVALID, "it returned -inf as 'a'; a finite number will do"),
        ('fine', Ending.INVALID, "it returned a 'str'; None, a bool, a number or a dict of"),
        ({'a': []}, Ending.INVALID, "it returned a 'list' as 'a'; None, a bool"),
    ],
)
def test_what_is_returned_says_whether_it_passed(returned, kind, words):
    found, message, values = judged(returned)
    assert found is kind
    assert message.startswith(words)
    assert bool(values) == (isinstance(returned, float | dict) and kind is Ending.PASSED)


def test_a_message_is_one_line_that_says_where():
    try:
        assert math.pi < 3
    except AssertionError as error:
        error.args = ()  # as where pytest does not rewrite asserts
        assert message_of(error).endswith(': assert math.pi < 3')
        assert message_of(error).startswith('test_one_run.py:')
    try:
        raise KeyError('a\nb' * 500)
    except KeyError as error:
        assert 'KeyError: ' in message_of(error)
        assert len(message_of(error)) == 300
    with pytest.raises(SimulationError) as caught:
        Simulation(URDF).step()
    assert 'SimulationError: a simulation runs inside its block' in message_of(caught.value)


def test_runs_are_in_the_order_of_their_seeds_and_shards_are_parts_of_them(here):
    whole = trials(named('quick'), 8, executor=here)
    assert [run.name for run in whole.runs] == [*'01234567']
    assert [run.values['draw'] for run in whole.runs] == [
        np.random.default_rng(seed).random() for seed in range(8)
    ]
    part = trials(named('quick'), 8, executor=here, shard=(3, 3))
    assert [run.name for run in part.runs] == ['2', '5']
    assert [*part.runs][0].is_as(whole.runs[2])
    assert trials(named('quick'), 8, executor=here, only='5').runs[0].is_as(whole.runs[5])


@pytest.mark.parametrize(
    ('options', 'words'),
    [
        ({'seeds': [-1]}, 'a seed of -1'),
        ({'seeds': [1, 1]}, 'a seed is named twice'),
        ({'shard': (9, 8)}, 'the shard 9/8'),
        ({'seeds': 2, 'shard': (3, 3)}, '2 runs, and none for the shard 3/3'),
        ({'only': '100'}, "there is no run '100'; there are: 0 to 99"),
        ({'timeout': 0.0}, 'a time-out in s of 0.0'),
        ({'workers': 0}, 'a number of workers of 0'),
    ],
)
def test_what_cannot_be_run_is_said(options, words):
    with pytest.raises(TrialsError, match=words):
        trials(named('quick'), **options)


def test_a_simulation_that_is_reset_gives_the_bits_of_one_that_is_started(here):
    kept, fresh = (
        trials(named('slippery'), 3, executor=here, fresh=fresh) for fresh in (False, True)
    )
    assert kept.digest == fresh.digest
    assert len({run.bits for run in kept.runs}) == 6
    assert {run.kind for run in kept.runs} == {Ending.PASSED, Ending.FAILED}


def test_what_a_run_has_changed_for_good_does_not_reach_the_next():
    simulate = Simulations()

    def lent():
        simulate.begin(0, fresh=False, bag='')
        sim = simulate(URDF)
        sim.drive(0.4, 0.1, seconds=0.3)
        return sim, simulate.end()

    first, bits = lent()
    assert lent() == (first, bits)
    first.world.engine.model.body_mass[2] *= 2.0
    second, again = lent()
    assert second is not first
    assert not first.is_alive
    assert again == bits
    second.robot.manager.switch(deactivate=['joint_state_broadcaster'])
    assert lent()[0] is not second
    simulate.begin(0, fresh=False, bag='')
    poses = {'a': Transform(), 'b': Transform((0.0, 2.0, 0.0))}
    crowded = simulate(URDF, ROOT / 'config' / 'controllers.yaml', robots=poses, activate=[])
    crowded.remove('b')
    simulate.begin(1, fresh=False, bag='')
    again = simulate(URDF, ROOT / 'config' / 'controllers.yaml', robots=poses, activate=[])
    assert [*again.robots] == ['a', 'b']
    with pytest.raises(TrialsError, match='is recorded by itself'):
        simulate(URDF, record='bag')
    simulate.close()


def test_few_simulations_are_kept():
    simulate, made = Simulations(), []
    for height in range(6):
        simulate.begin(0, fresh=False, bag='')
        made.append(simulate(URDF, pose=Transform((0.0, 0.0, 0.1 * height)), activate=[]))
    assert [sim.is_alive for sim in made] == [False, False, True, True, True, True]
    simulate.close()
    assert not any(sim.is_alive for sim in made)


def test_a_run_that_hangs_in_a_thread_is_ended(here):
    """By an exception; other runs in that thread go on, with simulations of their own."""
    report = trials(named('sometimes_loops'), 2, executor=here, timeout=1.0)
    kinds = [run.kind for run in report.runs]
    assert kinds == [*[Ending.PASSED] * 3, Ending.HUNG] * 2
    assert report.runs[3].message == 'not done after 1 s'


def test_a_trial_may_close_its_simulation(here):
    report = trials(named('closes'), 2, executor=here)
    assert [run.message for run in report.bad] == []
    assert len({run.bits for run in report.runs}) == 1


def test_no_message_paints_on_the_terminal(here):
    (run,) = trials(named('paints'), 1, executor=here).bad
    assert run.message.endswith('ValueError: \\x1b[31mred')
