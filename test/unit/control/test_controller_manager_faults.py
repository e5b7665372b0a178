# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The controller manager when controllers or hardware fail, and over resets and jumps of time."""

import contextlib
import re

import pytest
from support.control_fakes import FakeController, FakeHardware, FakeLog, make_manager, MS, start
from support.loaded_manager import ERRORS, PERIOD, run, states_of

from amr_description.control.interfaces import LifecycleState
from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError, HardwareError
from amr_description.log import Severity

# --- faults --------------------------------------------------------------------------------------


@pytest.mark.parametrize('error', ERRORS)
def test_a_controller_that_fails_is_deactivated_and_the_others_go_on(error):
    log, hardware = FakeLog(), FakeHardware(['a', 'b'])
    manager = make_manager(hardware, log=log)
    bad = start(manager, FakeController('bad', ['a/velocity']))
    good = start(manager, FakeController('good', ['b/velocity']))
    run(manager, 2)
    bad.faults['update'] = error
    run(manager, 2, begin=2 * PERIOD)
    assert states_of(manager) == {'bad': 'inactive', 'good': 'active'}
    assert manager.resources.claims == {'b/velocity': 'good'}
    assert hardware.written == {'a': 0.0, 'b': 4.0}
    assert bad.count('update') == 3
    assert len(good.updates) == 4
    assert hardware.calls.count(('perform', (), ('a/velocity',))) == 1
    texts = [each for each in log.texts(Severity.ERROR) if 'Traceback' not in each]
    assert "'bad': no, thanks" in texts[0]
    assert ('Caught exception of type : ZeroDivisionError' in texts[0]) == (error is ERRORS[1])
    assert texts[1] == ('Deactivating controllers : [ bad ] as their update resulted in an error!')


@pytest.mark.parametrize('error', ERRORS)
def test_a_deactivation_that_fails_still_ends_the_claims(error):
    log, hardware = FakeLog(), FakeHardware(['j'])
    manager = make_manager(hardware, log=log)
    controller = start(manager, FakeController(commands=['j/velocity']))
    controller.faults['deactivate'] = error
    manager.switch([], ['fake'], Strictness.STRICT, 0)
    assert states_of(manager) == {'fake': 'inactive'}
    assert manager.resources.claims == {}
    assert hardware.calls[-1] == ('perform', (), ('j/velocity',))
    assert "Failed to deactivate 'fake' cleanly" in log.texts(Severity.ERROR)[0]


def test_a_controller_that_failed_can_be_activated_again():
    manager = make_manager()
    controller = start(manager, FakeController())
    controller.faults['update'] = ERRORS[0]
    manager.tick(0)
    controller.faults.clear()
    manager.switch(['fake'], [], Strictness.STRICT, PERIOD)
    run(manager, 2, begin=PERIOD)
    assert controller.updates == [(PERIOD, PERIOD), (2 * PERIOD, PERIOD)]


@pytest.mark.parametrize('action', ['read', 'write'])
def test_when_hardware_fails_only_its_controllers_are_deactivated(action):
    log = FakeLog()
    bad, good = FakeHardware(['a'], 'bad'), FakeHardware(['b'], 'good')
    manager = make_manager(bad, good, log=log)
    start(manager, FakeController('commands_bad', ['a/velocity']))
    start(manager, FakeController('reads_bad', states=['a/position']))
    start(manager, FakeController('commands_good', ['b/velocity'], ['b/position']))
    bad.faults[action] = OSError('cable off')
    run(manager, 3)
    assert states_of(manager) == {
        'commands_bad': 'inactive', 'reads_bad': 'inactive', 'commands_good': 'active'
    }  # fmt: skip
    assert manager.resources.claims == {'b/velocity': 'commands_good'}
    assert (bad.count(action), bad.count('deactivate')) == (1, 1)
    assert good.written == {'b': 3.0}
    assert [(c.name, c.state.label) for c in manager.snapshot.components] == [
        ('bad', 'unconfigured'), ('good', 'active')
    ]  # fmt: skip
    assert (
        'Deactivating controllers : [ commands_bad reads_bad ] as the hardware components [ bad ] '
        'are no longer active'
    ) in log.texts(Severity.ERROR)


def test_unused_hardware_that_fails_affects_no_controller():
    log = FakeLog()
    bad = FakeHardware(['a'], 'bad')
    manager = make_manager(bad, FakeHardware(['b'], 'good'), log=log)
    start(manager, FakeController(commands=['b/velocity']))
    bad.faults['read'] = OSError('cable off')
    manager.tick(0)
    assert states_of(manager) == {'fake': 'active'}
    assert not any('Deactivating' in text for text in log.texts(Severity.ERROR))


def test_the_controllers_of_a_component_that_is_set_down_are_deactivated():
    hardware = FakeHardware(['a'])
    manager = make_manager(hardware)
    start(manager, FakeController('drives', ['a/velocity']))
    start(manager, FakeController('looks', states=['a/position']))
    manager.set_component_state('hardware', LifecycleState.INACTIVE, 0)
    assert states_of(manager) == {'drives': 'inactive', 'looks': 'active'}
    manager.set_component_state('hardware', LifecycleState.UNCONFIGURED, 0)
    assert states_of(manager) == {'drives': 'inactive', 'looks': 'inactive'}
    with pytest.raises(HardwareError, match='does not exist'):
        manager.set_component_state('nothing', LifecycleState.ACTIVE, 0)


def test_shut_down_leaves_the_actuators_at_rest_and_the_hardware_closed():
    hardware = FakeHardware(['j'])
    manager = make_manager(hardware)
    controller = start(manager, FakeController(commands=['j/velocity']))
    run(manager, 3)
    hardware.calls.clear()
    manager.shut_down(3 * PERIOD)
    assert [call[0] for call in controller.calls][-2:] == ['deactivate', 'cleanup']
    assert hardware.written == {'j': 0.0}
    last = ['write', 'deactivate', 'cleanup', 'shutdown']
    assert [call[0] for call in hardware.calls][-4:] == last
    assert states_of(manager) == {'fake': 'finalized'}


def test_every_transition_is_reported_at_its_start_and_its_end():
    calls = []
    manager = make_manager(FakeHardware(['j']))
    controller = FakeController(commands=['j/velocity'])
    manager.load(
        controller,
        'a/Type',
        on_transition=lambda start, goal, reached: calls.append(
            f'{start.label} > {goal.label}: {reached.label if reached else "..."}'
        ),
    )

    def new():
        lines = calls.copy()
        calls.clear()
        return lines

    configuring = manager.begin_configure('fake')
    assert new() == ['unconfigured > inactive: ...']
    configuring.run(None)
    manager.finish_configure(configuring)
    assert new() == ['unconfigured > inactive: inactive']
    controller.faults['activate'] = ControllerError('not now')
    with pytest.raises(ControllerError, match='Unable to activate'):
        manager.switch(['fake'], [], Strictness.STRICT, 0)
    assert new() == [
        'inactive > active: ...',
        'inactive > active: inactive',
        'inactive > unconfigured: ...',
        'inactive > unconfigured: unconfigured',
    ]
    del controller.faults['activate']
    manager.configure('fake', None)
    new()
    manager.switch(['fake'], [], Strictness.STRICT, 0)
    manager.switch(['fake'], ['fake'], Strictness.STRICT, 0)
    assert new() == [
        'inactive > active: ...',
        'inactive > active: active',
        'active > inactive: ...',
        'active > inactive: inactive',
        'inactive > active: ...',
        'inactive > active: active',
    ]
    manager.switch([], ['fake'], Strictness.STRICT, 0)
    new()
    controller.faults['configure'] = ControllerError('not now')
    with pytest.raises(ControllerError, match='not now'):
        manager.configure('fake', None)
    assert new() == [
        'inactive > unconfigured: ...',
        'inactive > unconfigured: unconfigured',
        'unconfigured > inactive: ...',
        'unconfigured > inactive: unconfigured',
    ]
    manager.unload('fake')
    assert new() == ['unconfigured > finalized: ...', 'unconfigured > finalized: finalized']


@pytest.mark.parametrize('doing', ['update', 'activate', 'deactivate'])
def test_an_exception_of_a_plugin_is_a_line_with_its_place_and_its_traceback(doing):
    log = FakeLog()
    manager = make_manager(FakeHardware(['j']), log=log)
    controller = FakeController(commands=['j/velocity'])
    manager.load(controller, 'a/Type')
    manager.configure('fake', None)
    controller.faults[doing] = ZeroDivisionError('two\nlines')
    with contextlib.suppress(ControllerError):
        manager.switch(['fake'], [], Strictness.STRICT, 0)
    run(manager, 1)
    manager.shut_down(PERIOD)
    line, story = (text for _, text in log.lines if 'ZeroDivisionError' in text)
    assert re.search(r': two lines \(control_fakes\.py:\d+\)$', line)
    assert story.startswith('Traceback')
    assert 'control_fakes.py' in story


# --- reset ---------------------------------------------------------------------------------------


def test_after_a_reset_time_starts_over_and_controllers_stay():
    manager = make_manager()
    active = start(manager, FakeController('active'))
    inactive = FakeController('inactive')
    manager.load(inactive, 'a/Type')
    manager.configure('inactive', None)
    manager.load(FakeController('unconfigured'), 'a/Type')
    run(manager, 3, begin=1000 * MS)
    manager.reset(0)
    assert active.calls[-1] == inactive.calls[-1] == ('reset', 0)
    assert manager.is_due(0)
    run(manager, 2)
    assert active.updates[3:] == [(0, PERIOD), (PERIOD, PERIOD)]
    assert states_of(manager) == {
        'active': 'active', 'inactive': 'inactive', 'unconfigured': 'unconfigured'
    }  # fmt: skip


@pytest.mark.parametrize('error', ERRORS)
def test_a_reset_that_fails_deactivates_only_that_controller(error):
    manager = make_manager(FakeHardware(['j']))
    bad = start(manager, FakeController('bad', ['j/velocity']))
    good = start(manager, FakeController('good'))
    bad.faults['reset'] = error
    manager.reset(0)
    assert states_of(manager) == {'bad': 'inactive', 'good': 'active'}
    assert good.calls[-1] == ('reset', 0)
    assert manager.resources.claims == {}


def test_after_the_clock_was_set_controllers_stay_and_the_hardware_is_left_alone():
    manager = make_manager(hardware := FakeHardware(['j']))
    active = start(manager, FakeController('active'))
    run(manager, 3, begin=1000 * MS)
    manager.set_clock(5000 * MS)
    assert active.calls[-1] == ('set_clock', 5000 * MS)
    assert hardware.count('reset') == 0
    run(manager, 2, begin=5000 * MS)
    assert active.updates[3:] == [(5000 * MS, PERIOD), (5010 * MS, PERIOD)]


@pytest.mark.parametrize('instant', [0, 9_000_000 * MS])
def test_hardware_with_a_rate_of_its_own_keeps_it_when_the_clock_is_set(instant):
    manager = make_manager(hardware := FakeHardware(['j'], rw_rate=50))
    run(manager, 4, begin=1000 * MS)
    assert hardware.count('read') == hardware.count('write') == 2
    manager.set_clock(instant)
    run(manager, 4, begin=instant)
    assert hardware.count('read') == hardware.count('write') == 4
    assert hardware.count('reset') == 0


def test_the_hardware_is_shut_down_even_if_a_transition_callback_raises():
    manager = make_manager(hardware := FakeHardware(['j']))

    def watch(*_):
        raise RuntimeError('the context is gone')

    manager.load(FakeController(), 'a/Type', on_transition=watch)
    with pytest.raises(RuntimeError, match='the context is gone'):
        manager.shut_down(0)
    assert hardware.count('deactivate') == hardware.count('cleanup') == 1
