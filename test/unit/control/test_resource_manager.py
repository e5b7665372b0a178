# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Components, their interfaces and the claims on them; failures of hardware."""

from contextlib import suppress
import math

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import bring_up, FakeHardware, FakeLog, MS
from support.examples import examples

from amr_description.clock import NANOSECONDS
from amr_description.control.controller_list import ControllerList
from amr_description.control.interfaces import (
    ALL_INTERFACES,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    NO_INTERFACES,
    StateInterface,
)
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.snapshot import take_snapshot
from amr_description.errors import HardwareDeactivationError, HardwareError, InterfaceError
from amr_description.log import Severity
from amr_description.model.hardware_info import (
    ComponentInfo,
    ComponentType,
    HardwareInfo,
    HardwareType,
    InterfaceInfo,
)

UNCONFIGURED, INACTIVE, ACTIVE, FINALIZED = (LifecycleState(number) for number in range(1, 5))


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


def test_an_unknown_component_is_reported_with_the_known_ones():
    resources = bring_up(FakeHardware(['j'], 'wheels'))
    with pytest.raises(HardwareError, match=r"'arm' does not exist\. Known: wheels"):
        resources.set_state('arm', ACTIVE)


def test_a_state_off_the_path_is_refused():
    with pytest.raises(HardwareError, match='cannot go from active to unknown'):
        bring_up(FakeHardware(['j'])).set_state('hardware', LifecycleState.UNKNOWN)


def test_finalized_is_final():
    hardware = FakeHardware(['j'])
    resources = bring_up(hardware)
    hardware.calls.clear()
    resources.set_state('hardware', FINALIZED)
    assert [call[0] for call in hardware.calls] == ['deactivate', 'cleanup', 'shutdown']
    assert not resources.available_states()
    for target in (UNCONFIGURED, INACTIVE, ACTIVE):
        message = f"'hardware' is in finalized state and can be only destroyed; {target.label} was"
        with pytest.raises(HardwareError, match=message):
            resources.set_state('hardware', target)
    resources.set_state('hardware', FINALIZED)
    resources.shut_down()
    assert len(hardware.calls) == 3


def test_every_transition_is_logged_as_ros2_control_does():
    resources = bring_up(FakeHardware(['j'], 'AmrSystem'))
    resources.shut_down()
    words = ['configure', 'activate', 'deactivate', 'cleanup', 'shutdown']
    assert resources.log.texts() == [
        text
        for word in words
        for text in (
            f"'{word}' hardware 'AmrSystem' ",
            f"Successful '{word}' of hardware 'AmrSystem'",
        )
    ]


def test_a_component_is_made_by_the_class_of_its_plugin():
    made = []

    def make(info, log, world):
        made.append((log, world))
        return FakeHardware(['j'], info.name)

    resources = ResourceManager(FakeLog())
    info = HardwareInfo('AmrSystem', HardwareType.SYSTEM, 'a/Plugin')
    resources.load(info, {'a/Plugin': make}.__getitem__, None)
    assert made == [(resources.log, None)]
    assert states_of(resources) == {'AmrSystem': UNCONFIGURED}
    assert resources.log.texts() == [
        "Loading hardware 'AmrSystem' ",
        "Loaded hardware 'AmrSystem' from plugin 'a/Plugin'",
        "Initialize hardware 'AmrSystem' ",
        "Successful initialization of hardware 'AmrSystem'",
    ]


def test_async_is_warned_of():
    resources = bring_up(FakeHardware(['j'], is_async=True))
    (text,) = resources.log.texts(Severity.WARN)
    assert '\'hardware\' has is_async="true": it is read and written in the control loop' in text


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


# --- first states --------------------------------------------------------------------------------


def loaded(*components):
    """Return a resource manager with these components, unconfigured."""
    resources = ResourceManager(FakeLog())
    for component in components:
        resources.add(component)
    return resources


def test_all_components_become_active_but_those_that_are_named():
    resources = loaded(*(FakeHardware([name], name) for name in 'abcd'))
    resources.start_components(unconfigured=['c', ''], inactive=['a'])
    assert states_of(resources) == {
        'a': INACTIVE, 'b': ACTIVE, 'c': UNCONFIGURED, 'd': ACTIVE
    }  # fmt: skip
    assert resources.log.texts(Severity.WARN) == []
    texts = resources.log.texts()
    assert "Activating component 'b'." in texts
    assert "Setting component 'a' to 'inactive' state." in texts
    assert "Setting component 'c' to 'unconfigured' state." in texts


def test_an_initial_state_for_an_unknown_component_is_warned_of():
    resources = loaded(FakeHardware(['a'], 'a'), FakeHardware(['b'], 'b'))
    resources.start_components(unconfigured=['a'], inactive=['a', 'wheels'])
    assert states_of(resources) == {'a': UNCONFIGURED, 'b': ACTIVE}
    assert resources.log.texts(Severity.WARN) == [
        f"Hardware component '{name}' is unknown, therefore not set in 'inactive' state. Known "
        'and not yet set: b'
        for name in ('a', 'wheels')
    ]


def test_a_component_that_fails_on_its_way_to_its_initial_state_ends_the_start():
    broken = FakeHardware(['a'], 'a')
    broken.faults['activate'] = OSError('no power')
    message = r'Failed to set the initial state of the component : a to active\. .*no power'
    with pytest.raises(HardwareError, match=message):
        loaded(broken).start_components()


def test_it_may_be_left_in_the_state_that_it_has_reached():
    broken = FakeHardware(['a'], 'a')
    broken.faults['activate'] = OSError('no power')
    resources = loaded(broken, FakeHardware(['b'], 'b'))
    resources.start_components(shutdown_on_failure=False)
    assert states_of(resources) == {'a': INACTIVE, 'b': ACTIVE}
    (text,) = resources.log.texts(Severity.ERROR)
    assert 'Failed to set the initial state of the component : a to active' in text


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


def test_a_component_that_cannot_even_be_stopped_is_brought_down():
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


def test_shut_down_stops_closes_and_finalizes_all_of_them():
    components = [FakeHardware(['a'], 'one'), FakeHardware(['b'], 'two')]
    resources = bring_up(*components)
    components[0].faults['deactivate'] = OSError('gone')
    resources.shut_down()
    assert states_of(resources) == {'one': FINALIZED, 'two': FINALIZED}
    assert [component.count('cleanup') for component in components] == [1, 1]
    assert [component.count('shutdown') for component in components] == [1, 1]


@pytest.mark.parametrize('action', ['read', 'write'])
def test_a_group_fails_together(action):
    parts = [FakeHardware([name], name, group='arm') for name in 'abc']
    other = FakeHardware(['d'], 'd')
    resources = bring_up(*parts, other)
    parts[1].faults[action] = OSError('no power')
    assert getattr(resources, action)(0, MS) == ['b', 'a', 'c']
    assert states_of(resources) == dict.fromkeys('abc', UNCONFIGURED) | {'d': ACTIVE}
    assert [part.count(action) for part in (*parts, other)] == [1, 1, 0, 1]
    _, first, second = resources.log.texts(Severity.ERROR)
    assert "'a' is brought down with 'b': both are of the group 'arm'" in first
    assert "'c' is brought down with 'b'" in second


def test_a_component_may_ask_out_of_write_to_be_made_inactive():
    asking, other = (FakeHardware([n], n, group='arm') for n in 'ab')
    resources = bring_up(asking, other)
    asking.faults['write'] = HardwareDeactivationError('pressed')
    assert resources.write(0, MS) == ['a']
    assert states_of(resources) == {'a': INACTIVE, 'b': ACTIVE}
    assert asking.calls[-1] == ('deactivate',)
    (text,) = resources.log.texts(Severity.ERROR)
    assert text == "write of hardware component 'a' failed: pressed"
    assert resources.write(0, MS) == []
    asking.faults['read'] = HardwareDeactivationError('pressed')
    assert resources.read(0, MS) == ['a', 'b'], 'out of read it is an error like any other'
    assert states_of(resources) == {'a': UNCONFIGURED, 'b': UNCONFIGURED}


# --- rates ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('rate', 'period', 'every'),
    [(0, 10, 1), (100, 10, 1), (50, 20, 2), (30, 40, 4), (25, 40, 4), (1000, 10, 1)],
)
def test_a_slow_component_is_read_and_written_with_its_true_period(rate, period, every):
    hardware = FakeHardware(['j'], rw_rate=rate)
    resources = bring_up(hardware)
    given = {'read': [], 'write': []}
    hardware.read = lambda time, period: given['read'].append((time, period))
    hardware.write = lambda time, period: given['write'].append((time, period))
    for tick in range(12):
        resources.read(tick * 10 * MS, 10 * MS)
        resources.write(tick * 10 * MS, 10 * MS)
    assert [time for time, _ in given['read']] == [t * 10 * MS for t in range(0, 12, every)]
    assert {p for _, p in given['read'][1:]} == {period * MS}
    assert given['read'] == given['write']
    first = max(10 * MS, NANOSECONDS // rate) if rate else 10 * MS
    assert given['read'][0][1] == first


@pytest.mark.parametrize(('rate', 'shown'), [(0, 100), (30, 30), (100, 100), (1000, 100)])
def test_the_rate_of_a_component_is_at_most_the_managers(rate, shown):
    resources = bring_up(FakeHardware(['j'], rw_rate=rate))
    (component,) = take_snapshot(ControllerList(), resources, 100).components
    assert component.rate == shown


def test_a_sensor_is_not_written():
    hardware = FakeHardware([], type=HardwareType.SENSOR)
    resources = bring_up(hardware)
    resources.read(0, MS)
    resources.write(0, MS)
    assert (hardware.count('read'), hardware.count('write')) == (1, 0)


def test_a_sensor_with_commands_is_refused():
    message = r"""'hardware' is of type "sensor", which is never written, and has .*'j/v"""
    with pytest.raises(HardwareError, match=message):
        bring_up(FakeHardware(['j'], type=HardwareType.SENSOR))


def test_after_a_reset_a_slow_component_is_due_at_once():
    hardware = FakeHardware(['j'], rw_rate=1)
    down = FakeHardware(['k'], 'down')
    resources = bring_up(hardware, down)
    resources.set_state('down', UNCONFIGURED)
    resources.read(10 * NANOSECONDS, MS)
    assert resources.reset(0) == []
    assert hardware.calls[-1] == ('reset', 0)
    assert down.count('reset') == 0, 'it has nothing to forget'
    resources.read(0, MS)
    assert hardware.count('read') == 2


def test_a_component_that_cannot_be_reset_is_brought_down():
    hardware = FakeHardware(['j'])
    resources = bring_up(hardware)
    hardware.faults['reset'] = OSError('stuck')
    assert resources.reset(0) == ['hardware']
    assert states_of(resources) == {'hardware': UNCONFIGURED}


# --- laws ----------------------------------------------------------------------------------------

FROM = {
    'configure': (UNCONFIGURED, INACTIVE),
    'activate': (INACTIVE, ACTIVE),
    'deactivate': (ACTIVE, INACTIVE),
    'cleanup': (INACTIVE, UNCONFIGURED),
    'shutdown': (UNCONFIGURED, FINALIZED),
}


class Recorded(FakeHardware):
    """Remembers whether a call raised."""

    def __init__(self, name):
        super().__init__(['j'], name)
        self.life = []

    def call(self, method, *arguments):
        self.life.append((method, method in self.faults))
        super().call(method, *arguments)


ACTIONS = st.sampled_from(['read', 'write', 'shut_down', *map(LifecycleState, range(1, 5))])
FAULTS = st.lists(st.sampled_from([*FROM, 'read', 'write']), max_size=2)


@examples(150)
@given(st.lists(st.tuples(ACTIONS, FAULTS), max_size=12))
def test_the_lifecycle_holds_whatever_is_requested_and_whatever_fails(requests):
    hardware = Recorded('hardware')
    resources = loaded(hardware)
    for action, faults in requests:
        hardware.faults = dict.fromkeys(faults, OSError('stuck'))
        before = states_of(resources)['hardware']
        hardware.life.clear()
        if isinstance(action, LifecycleState):
            with suppress(HardwareError):
                resources.set_state('hardware', action)
        elif action == 'shut_down':
            resources.shut_down()
        else:
            failed = getattr(resources, action)(0, MS)
            assert failed == (['hardware'] if (action, True) in hardware.life else [])
        check_calls(hardware.life, before, states_of(resources)['hardware'], action)


def check_calls(life, before, after, action):
    """Each call was allowed where the component then was, and led where it is now."""
    state = before
    for method, failed in life:
        if method in FROM:
            begin, end = FROM[method]
            assert state is begin, f'{method} while {state.label}'
            given_up = action in ('read', 'write', 'shut_down')
            state = end if not failed or given_up else state
        else:
            assert state in ((INACTIVE, ACTIVE) if method == 'read' else (ACTIVE,))
    assert after is state
    if before is FINALIZED:
        assert (life, after) == ([], FINALIZED)


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


def test_release_gives_back_the_claims_of_one_controller():
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


def test_each_component_is_asked_about_its_own_commands_only():
    left, right = FakeHardware(['a'], 'left'), FakeHardware(['b'], 'right')
    resources = bring_up(left, right)
    resources.perform_command_mode_switch(['a/velocity', 'lent/velocity'], [])
    assert left.calls[-1] == ('perform', ('a/velocity',), ())
    assert right.count('perform') == 0


@pytest.mark.parametrize('error', [HardwareError('not now'), KeyError('not now')])
def test_if_one_component_refuses_none_has_switched(error):
    left, right = FakeHardware(['a'], 'left'), FakeHardware(['b'], 'right')
    resources = bring_up(left, right)
    right.faults['prepare'] = error
    with pytest.raises(HardwareError, match=r"'right' refuses the command mode: .*not now"):
        resources.prepare_command_mode_switch(['a/velocity'], ['b/velocity'])
    assert left.calls[-1] == ('prepare', ('a/velocity',), ())
    assert left.count('perform') == right.count('perform') == 0


def test_a_component_that_is_down_is_not_asked():
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


@pytest.mark.parametrize(
    ('data_type', 'first'),
    [
        ('double', math.nan),
        ('float32', math.nan),
        ('bool', False),
        ('int8', 127),
        ('uint8', 255),
        ('int16', 32767),
        ('uint16', 65535),
        ('int32', 2147483647),
        ('uint32', 4294967295),
    ],
)
def test_an_interface_has_the_value_of_its_type_until_it_is_written(data_type, first):
    handle = CommandInterface('relay', 'coil', data_type=data_type)
    assert handle.value is first or handle.value == first or math.isnan(first)
    assert type(handle.value) is type(first)
    assert handle.is_set == (data_type == 'bool'), 'a truth value has none that means nothing'
    handle.value = 1
    assert handle.is_set


def test_an_interface_starts_with_the_initial_value_of_its_declaration():
    relay = ComponentInfo('relay', ComponentType.GPIO)
    for data_type, value in (('double', 1.0), ('bool', True), ('uint8', 1)):
        handle = StateInterface.of(relay, InterfaceInfo('coil', data_type, initial_value=1.0))
        assert (handle.name, handle.value, handle.data_type) == ('relay/coil', value, data_type)
        assert type(handle.value) is type(value)
    assert math.isnan(StateInterface.of(relay, InterfaceInfo('coil')).value)


def test_an_unknown_data_type_is_reported_with_the_known_ones():
    message = r"'relay/coil' has the data type 'word'; there are: double, float32, bool, int8"
    with pytest.raises(InterfaceError, match=message):
        CommandInterface('relay', 'coil', data_type='word')
