# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Components, their interfaces and the claims on them; what happens when hardware fails."""

import math

from control_fakes import bring_up, FakeHardware, FakeLog, MS
import pytest

from amr_description.control.contracts import Severity
from amr_description.control.interfaces import (
    ALL_INTERFACES,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    NO_INTERFACES,
)
from amr_description.control.resource_manager import ResourceManager
from amr_description.errors import HardwareError, InterfaceError

UNCONFIGURED, INACTIVE, ACTIVE = (LifecycleState(number) for number in (1, 2, 3))


def states_of(resources):
    return {name: owned.state for name, owned in resources.components.items()}


# --- components ----------------------------------------------------------------------------------


def test_a_component_goes_through_every_state_on_its_way():
    hardware = FakeHardware(['j'])
    resources = bring_up(hardware)
    resources.set_state('hardware', UNCONFIGURED)
    assert [call[0] for call in hardware.calls] == [
        'configure', 'activate', 'deactivate', 'cleanup'
    ]  # fmt: skip
    resources.set_state('hardware', UNCONFIGURED)
    assert len(hardware.calls) == 4


def test_interfaces_are_there_from_configure_and_commands_only_while_active():
    resources = ResourceManager(FakeLog())
    resources.add(FakeHardware(['j']))
    found = []
    for state in (UNCONFIGURED, INACTIVE, ACTIVE, INACTIVE, UNCONFIGURED):
        resources.set_state('hardware', state)
        found.append((len(resources.available_states()), len(resources.available_commands())))
    assert found == [(0, 0), (2, 0), (2, 1), (2, 0), (0, 0)]


def test_read_is_for_available_components_and_write_for_active_ones():
    hardware = FakeHardware(['j'])
    resources = ResourceManager(FakeLog())
    resources.add(hardware)
    for state, reads, writes in ((UNCONFIGURED, 0, 0), (INACTIVE, 1, 0), (ACTIVE, 2, 1)):
        resources.set_state('hardware', state)
        assert resources.read(0, MS) == resources.write(0, MS) == []
        assert (hardware.count('read'), hardware.count('write')) == (reads, writes)


def test_a_component_twice_is_refused():
    resources = bring_up(FakeHardware(['a']))
    with pytest.raises(HardwareError, match=r"component 'hardware' is there twice"):
        resources.add(FakeHardware(['b']))


def test_two_components_with_one_interface_are_refused():
    resources = bring_up(FakeHardware(['a', 'b'], 'left'))
    message = r"'b/position' is exported by the hardware components 'left' and 'right'"
    with pytest.raises(HardwareError, match=message):
        resources.add(FakeHardware(['b', 'c'], 'right'))
    assert list(resources.components) == ['left']


def test_a_component_with_one_interface_twice_is_refused():
    hardware = FakeHardware(['a', 'b'])
    hardware.commands['b'] = hardware.commands['a']
    message = r"'hardware' exports the interface 'a/velocity' twice"
    with pytest.raises(HardwareError, match=message):
        bring_up(hardware)


def test_an_unknown_component_is_told_with_those_there_are():
    resources = bring_up(FakeHardware(['j'], 'wheels'))
    with pytest.raises(HardwareError, match=r"'arm' does not exist\. Known: wheels"):
        resources.set_state('arm', ACTIVE)


@pytest.mark.parametrize('target', [LifecycleState.FINALIZED, LifecycleState.UNKNOWN])
def test_a_state_off_the_path_is_refused(target):
    with pytest.raises(HardwareError, match=f'cannot go from active to {target.label}'):
        bring_up(FakeHardware(['j'])).set_state('hardware', target)


@pytest.mark.parametrize(
    ('transition', 'target', 'reached'),
    [
        ('configure', ACTIVE, UNCONFIGURED),
        ('activate', ACTIVE, INACTIVE),
        ('deactivate', UNCONFIGURED, ACTIVE),
        ('cleanup', UNCONFIGURED, INACTIVE),
    ],
)
@pytest.mark.parametrize('error', [HardwareError('no power'), OSError('no power')])
def test_a_transition_that_fails_leaves_it_where_it_was(transition, target, reached, error):
    hardware = FakeHardware(['j'])
    resources = ResourceManager(FakeLog())
    resources.add(hardware)
    if target is UNCONFIGURED:
        resources.set_state('hardware', ACTIVE)
    hardware.faults[transition] = error
    message = rf"'hardware' failed on its way from {reached.label} to .*no power"
    with pytest.raises(HardwareError, match=message):
        resources.set_state('hardware', target)
    assert states_of(resources) == {'hardware': reached}


# --- faults --------------------------------------------------------------------------------------


@pytest.mark.parametrize('action', ['read', 'write'])
@pytest.mark.parametrize('error', [HardwareError('cable off'), ZeroDivisionError('cable off')])
def test_a_component_that_fails_is_stopped_and_closed_and_the_others_go_on(action, error):
    bad, good = FakeHardware(['a'], 'bad'), FakeHardware(['b'], 'good')
    resources = bring_up(bad, good)
    bad.faults[action] = error
    bad.calls.clear()
    assert getattr(resources, action)(0, MS) == ['bad']
    assert [call[0] for call in bad.calls] == [action, 'deactivate', 'cleanup']
    assert states_of(resources) == {'bad': UNCONFIGURED, 'good': ACTIVE}
    assert good.count(action) == 1
    (text,) = resources.log.texts(Severity.ERROR)
    assert f"{action} of hardware component 'bad' failed" in text
    assert 'cable off' in text
    assert ('ZeroDivisionError' in text) == isinstance(error, ZeroDivisionError)


def test_a_component_that_cannot_even_be_stopped_is_given_up():
    hardware = FakeHardware(['j'])
    resources = bring_up(hardware)
    hardware.faults = dict.fromkeys(('read', 'deactivate', 'cleanup'), OSError('gone'))
    assert resources.read(0, MS) == ['hardware']
    assert states_of(resources) == {'hardware': UNCONFIGURED}
    assert len(resources.log.texts(Severity.ERROR)) == 3


def test_a_component_that_failed_can_be_brought_back():
    hardware = FakeHardware(['j'])
    resources = bring_up(hardware)
    hardware.faults['read'] = OSError('gone')
    resources.read(0, MS)
    hardware.faults.clear()
    resources.set_state('hardware', ACTIVE)
    assert resources.read(0, MS) == []


def test_shut_down_stops_and_closes_all_of_them():
    components = [FakeHardware(['a'], 'one'), FakeHardware(['b'], 'two')]
    resources = bring_up(*components)
    components[0].faults['deactivate'] = OSError('gone')
    resources.shut_down()
    assert states_of(resources) == {'one': UNCONFIGURED, 'two': UNCONFIGURED}
    assert [component.count('cleanup') for component in components] == [1, 1]


# --- claims --------------------------------------------------------------------------------------


def test_a_claim_lends_the_handles_in_the_order_asked_for():
    resources = bring_up(FakeHardware(['a', 'b']))
    handles = resources.claim('me', ['b/velocity', 'a/velocity'])
    assert [handle.name for handle in handles] == ['b/velocity', 'a/velocity']
    assert resources.claims == {'a/velocity': 'me', 'b/velocity': 'me'}


@pytest.mark.parametrize(
    ('names', 'message'),
    [
        (['b/velocity', 'a/velocity'], "command interface 'a/velocity' is claimed by 'other'"),
        (['b/velocity', 'c/velocity'], "command interface 'c/velocity' is not available"),
    ],
)
def test_a_claim_that_fails_claims_nothing(names, message):
    resources = bring_up(FakeHardware(['a', 'b']))
    resources.claim('other', ['a/velocity'])
    with pytest.raises(InterfaceError, match=message):
        resources.claim('me', names)
    assert resources.claims == {'a/velocity': 'other'}


def test_release_gives_back_only_ones_own():
    resources = bring_up(FakeHardware(['a', 'b']))
    resources.claim('me', ['a/velocity'])
    resources.claim('other', ['b/velocity'])
    resources.release('me')
    resources.release('nobody')
    assert resources.claims == {'b/velocity': 'other'}


def test_states_are_lent_to_any_number():
    resources = bring_up(FakeHardware(['a']))
    assert resources.lend_states(['a/position']) == resources.lend_states(['a/position'])
    with pytest.raises(InterfaceError, match=r"state interface 'a/effort' is not available"):
        resources.lend_states(['a/position', 'a/effort'])


def test_requests_are_resolved_to_names():
    available = {'a/velocity': None, 'b/velocity': None}
    assert ResourceManager.names(ALL_INTERFACES, available) == tuple(available)
    assert ResourceManager.names(NO_INTERFACES, available) == ()
    assert ResourceManager.names(InterfaceRequest.individual(['x/y']), available) == ('x/y',)


# --- command modes -------------------------------------------------------------------------------


def test_each_component_hears_of_its_own_commands_only():
    left, right = FakeHardware(['a'], 'left'), FakeHardware(['b'], 'right')
    resources = bring_up(left, right)
    resources.perform_command_mode_switch(['a/velocity', 'lent/velocity'], [])
    assert left.calls[-1] == ('perform', ('a/velocity',), ())
    assert right.count('perform') == 0


@pytest.mark.parametrize('error', [HardwareError('not now'), KeyError('not now')])
def test_when_one_refuses_nobody_has_switched(error):
    left, right = FakeHardware(['a'], 'left'), FakeHardware(['b'], 'right')
    resources = bring_up(left, right)
    right.faults['prepare'] = error
    with pytest.raises(HardwareError, match=r"'right' refuses the command mode: .*not now"):
        resources.prepare_command_mode_switch(['a/velocity'], ['b/velocity'])
    assert left.calls[-1] == ('prepare', ('a/velocity',), ())
    assert left.count('perform') == right.count('perform') == 0


def test_a_component_that_is_down_is_not_bothered():
    hardware = FakeHardware(['a'])
    resources = bring_up(hardware)
    resources.set_state('hardware', UNCONFIGURED)
    resources.perform_command_mode_switch((), ['a/velocity'])
    assert hardware.count('perform') == 0


# --- handles -------------------------------------------------------------------------------------


def test_a_command_is_nan_until_it_is_written():
    handle = CommandInterface('wheel', 'velocity')
    assert math.isnan(handle.value)
    assert handle.name == 'wheel/velocity'
    assert repr(handle) == "CommandInterface('wheel/velocity', value=nan)"
