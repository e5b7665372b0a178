# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""switch_controller: its laws, and its checks and messages, word for word."""

import random
import re

import pytest
from support.control_fakes import (
    bring_up,
    FakeController,
    FakeHardware,
    FakeLog,
    make_manager,
    MS,
    start,
)

from amr_description.control.contracts import Input, Port
from amr_description.control.controller_manager import ControllerManager, ManagerDefaults
from amr_description.control.interfaces import LifecycleState
from amr_description.control.switching import NOTHING_TO_SWITCH, Strictness
from amr_description.errors import ControllerError, HardwareDeactivationError, HardwareError
from amr_description.log import Severity

STRICT, BEST_EFFORT = Strictness.STRICT, Strictness.BEST_EFFORT
BOTH = pytest.mark.parametrize('strictness', [STRICT, BEST_EFFORT])


class Bench:
    """Joints a and b; controllers A and A2 claim a, B claims b, AB both, S looks; U is raw."""

    def __init__(self, defaults=None):
        self.log = FakeLog()
        self.hardware = FakeHardware(['a', 'b'])
        self.manager = ControllerManager(bring_up(self.hardware), 100, self.log, defaults=defaults)
        claims = {'A': 'a', 'A2': 'a', 'B': 'b', 'AB': 'ab', 'S': '', 'U': 'a'}
        self.controllers = {
            name: FakeController(name, [f'{joint}/velocity' for joint in joints])
            for name, joints in claims.items()
        }
        for name, controller in self.controllers.items():
            self.manager.load(controller, 'a/Type')
            if name != 'U':
                self.manager.configure(name, None)

    def switch(self, activate='', deactivate='', strictness=STRICT):
        """Switch controllers by names in one text."""
        return self.manager.switch(activate.split(), deactivate.split(), strictness, 0)

    @property
    def active(self):
        controllers = self.manager.snapshot.controllers
        return {c.name for c in controllers if c.state is LifecycleState.ACTIVE}

    @property
    def claims(self):
        return dict(self.manager.resources.claims)

    def refuses(self, message, *request):
        """The request fails with the message and changes nothing."""
        before = self.active, self.claims, self.manager.snapshot
        with pytest.raises(ControllerError, match=message):
            self.switch(*request)
        assert (self.active, self.claims, self.manager.snapshot) == before
        return True

    def check_claims(self):
        """Every claim belongs to an active controller, and it has all that it wants."""
        expected = {
            name: controller.name
            for controller in self.manager.snapshot.controllers
            for name in controller.claimed
        }
        assert self.claims == expected
        for controller in self.manager.snapshot.controllers:
            is_active = controller.state is LifecycleState.ACTIVE
            assert controller.claimed == (controller.required_commands if is_active else ())
        for name in self.active:
            handles = self.controllers[name].handles
            assert [h.name for h in handles] == list(self.controllers[name].requests[0].names)


@pytest.fixture
def bench():
    return Bench()


# --- laws ----------------------------------------------------------------------------------------


def random_request(dice, names):
    return ' '.join(dice.sample(names, dice.randint(0, 3)))


@pytest.mark.parametrize('seed', range(20))
def test_claims_are_conserved_whatever_is_switched_and_whatever_fails(seed):
    dice, bench = random.Random(seed), Bench()
    names = [*bench.controllers, 'nobody']
    for _ in range(200):
        for controller in bench.controllers.values():
            controller.faults = {
                method: dice.choice((ControllerError('no'), RuntimeError('no')))
                for method in ('activate', 'update', 'deactivate')
                if dice.random() < 0.05
            }
        bench.hardware.faults = {'prepare': HardwareError('no')} if dice.random() < 0.05 else {}
        action = dice.random()
        try:
            if action < 0.8:
                request = random_request(dice, names), random_request(dice, names)
                bench.switch(*request, dice.choice((STRICT, BEST_EFFORT)))
            elif action < 0.95:
                bench.manager.tick(0)
            else:
                bench.manager.configure(dice.choice(names), None)
        except ControllerError:
            pass
        bench.check_claims()


@pytest.mark.parametrize('seed', range(20))
def test_strict_does_all_or_nothing(seed):
    dice, bench = random.Random(seed), Bench()
    names = [*bench.controllers, 'nobody']
    outcomes = set()
    for _ in range(200):
        activate, deactivate = random_request(dice, names), random_request(dice, names)
        before = bench.active, bench.claims
        try:
            bench.switch(activate, deactivate, STRICT)
        except ControllerError:
            assert (bench.active, bench.claims) == before
            outcomes.add('refused')
        else:
            expected = before[0] - set(deactivate.split()) | set(activate.split())
            assert bench.active == expected
            outcomes.add('done')
    assert outcomes == {'refused', 'done'}


@pytest.mark.parametrize('seed', range(10))
def test_what_is_switched_on_and_off_again_leaves_no_trace(seed):
    dice, bench = random.Random(seed), Bench()
    request = dice.choice(['A', 'A2', 'AB', 'A B', 'A B S', 'S'])
    before = bench.manager.snapshot
    bench.switch(request)
    assert bench.active == set(request.split())
    bench.switch('', request)
    assert bench.manager.snapshot == before


def test_strictness_has_the_numbers_of_the_service():
    assert {s.name: s.value for s in Strictness} == {
        'BEST_EFFORT': 1, 'STRICT': 2, 'AUTO': 3, 'FORCE_AUTO': 4
    }  # fmt: skip


# --- success -------------------------------------------------------------------------------------


def test_activate_and_deactivate(bench):
    assert bench.switch('A B') == 'Successfully switched controllers!'
    assert bench.active == {'A', 'B'}
    assert bench.claims == {'a/velocity': 'A', 'b/velocity': 'B'}
    assert bench.switch('', 'A') == 'Successfully switched controllers!'
    assert bench.active == {'B'}
    assert bench.log.texts() == [
        'Activating controllers: [ A B ]', 'Deactivating controllers: [ A ]'
    ]  # fmt: skip


def test_best_effort_reports_what_was_done(bench):
    bench.switch('A')
    assert bench.switch('B', 'A', BEST_EFFORT) == (
        'Successfully switched controllers! Deactivated controllers: [ A ] '
        'Activated controllers: [ B ]'
    )


@BOTH
def test_an_interface_is_handed_over_within_one_request(bench, strictness):
    bench.switch('A')
    bench.switch('A2', 'A', strictness)
    assert bench.claims == {'a/velocity': 'A2'}
    calls = [call for call in bench.hardware.calls if call[0] == 'perform']
    assert calls[-1] == ('perform', ('a/velocity',), ('a/velocity',))


@BOTH
def test_the_same_name_in_both_lists_is_a_restart(bench, strictness):
    bench.switch('A')
    bench.controllers['A'].calls.clear()
    bench.switch('A', 'A', strictness)
    assert [call[0] for call in bench.controllers['A'].calls] == ['deactivate', 'activate']
    assert bench.active == {'A'}


@BOTH
def test_a_name_twice_in_a_list_counts_once(bench, strictness):
    bench.switch('A A', '', strictness)
    assert bench.controllers['A'].count('activate') == 1


def test_an_empty_request_is_fine(bench):
    assert bench.switch() == NOTHING_TO_SWITCH


def test_no_tick_is_needed_and_the_next_one_updates(bench):
    """It works while the simulation is paused."""
    bench.switch('A')
    assert bench.controllers['A'].updates == []
    bench.manager.tick(0)
    assert bench.controllers['A'].updates == [(0, 10 * MS)]


def test_inputs_are_open_exactly_while_active():
    manager, controller = make_manager(), FakeController()
    port = Input(Port('~/input', 'std_msgs/msg/Empty', 'nowhere:nothing'))
    controller.inputs = lambda: (port,)
    assert not port.put(1)
    start(manager, controller)
    assert port.put(2)
    manager.switch([], ['fake'], STRICT, 0)
    assert not port.put(3)
    manager.switch(['fake'], [], STRICT, 0)
    assert port.drain() == []


# --- strictness and time-out ---------------------------------------------------------------------


@pytest.mark.parametrize('default', [STRICT, BEST_EFFORT])
def test_a_request_that_leaves_the_strictness_open_gets_the_default_and_a_warning(default):
    bench = Bench(ManagerDefaults(strictness=default))
    if default is STRICT:
        assert bench.refuses('Could not activate', 'A nobody', '', 0)
    else:
        bench.switch('A nobody', '', 0)
        assert bench.active == {'A'}
    assert bench.log.texts(Severity.WARN)[0] == (
        'Controller Manager: to switch controllers you need to specify a strictness level of '
        'controller_manager_msgs::SwitchController::STRICT (2) or ::BEST_EFFORT (1). When '
        f'unspecified, the default is {default.name.lower()}'
    )


@pytest.mark.parametrize(
    ('strictness', 'name'),
    [(Strictness.AUTO, 'AUTO'), (Strictness.FORCE_AUTO, 'FORCE_AUTO'), (7, '7'), (-1, '-1')],
)
def test_a_strictness_that_is_not_there_is_best_effort(bench, strictness, name):
    assert bench.switch('A U', '', strictness).endswith('Activated controllers: [ A ]')
    assert bench.log.texts(Severity.WARN)[0] == (
        f'Controller Manager: strictness {name} is not implemented. Defaulting to BEST_EFFORT'
    )


@pytest.mark.parametrize(('timeout', 'count'), [(None, 0), (0, 1), (1, 0), (10**9, 0)])
def test_no_timeout_can_pass(bench, timeout, count):
    bench.manager.switch(['A'], [], STRICT, 0, timeout)
    assert bench.active == {'A'}
    texts = bench.log.texts(Severity.INFO)
    assert texts.count('Switch controller timeout is set to 0, using default 1s!') == count


def test_a_request_is_logged(bench):
    bench.switch('A B')
    bench.switch('A2', 'A')
    assert bench.log.texts(Severity.INFO) == [
        'Activating controllers: [ A B ]',
        'Activating controllers: [ A2 ]',
        'Deactivating controllers: [ A ]',
    ]


# --- refusals ------------------------------------------------------------------------------------

NOBODY = "controller with name 'nobody' because no controller with this name exists"


def test_strict_refuses_an_unknown_name(bench):
    bench.switch('B')
    aborting = r"Aborting, no controller is switched! \('STRICT' switch\)"
    assert bench.refuses(f'^{aborting} Could not activate {NOBODY}$', 'A nobody')
    assert bench.refuses(f'^{aborting} Could not deactivate {NOBODY}$', 'A', 'B nobody')
    assert "Aborting, no controller is switched! ('STRICT' switch)" in (
        bench.log.texts(Severity.ERROR)
    )


def test_the_deactivate_list_is_checked_first(bench):
    assert bench.refuses('Could not deactivate', 'nobody', 'nobody')


def test_best_effort_drops_an_unknown_name_but_not_a_list_of_nothing_else(bench):
    bench.switch('A nobody', '', BEST_EFFORT)
    assert bench.active == {'A'}
    assert f'Could not activate {NOBODY}' in bench.log.texts(Severity.WARN)
    message = r'None of the controllers to activate exists: \[ nobody \]\. Loaded: \[ A A2 AB B'
    assert bench.refuses(message, 'nobody', '', BEST_EFFORT)
    assert bench.refuses('None of the controllers to deac', 'B', 'nobody', BEST_EFFORT)


@pytest.mark.parametrize(
    ('activate', 'deactivate', 'objection'),
    [
        ('B', '', r"^Controller with name 'B' is already active\.$"),
        (
            'U',
            '',
            r"^Controller with name 'U' is in 'unconfigured' state\. The controller needs to be "
            r"configured to be in 'inactive' state before it can be checked and activated\.$",
        ),
        ('', 'A', "^Controller with name 'A' can not be deactivated since it is not active\\.$"),
        ('', 'U', "^Controller with name 'U' can not be deactivated since it is not active\\.$"),
        ('U', 'U', "^Controller with name 'U' can not be deactivated since it is not active\\.$"),
        ('S A', 'A', "^Controller with name 'A' can not be deactivated"),
    ],
)
def test_wrong_states(bench, activate, deactivate, objection):
    bench.switch('B')
    assert bench.refuses(objection, activate, deactivate)
    assert re.search(objection, bench.log.texts(Severity.ERROR)[0])
    before = set(bench.active)
    bench.switch(activate, deactivate, BEST_EFFORT)
    wanted = {name for name in activate.split() if name != 'U'}
    assert bench.active == before | wanted


@pytest.mark.parametrize(('activate', 'deactivate'), [('B', ''), ('U', ''), ('', 'A'), ('U', 'U')])
def test_best_effort_that_finds_nothing_to_do_succeeds(bench, activate, deactivate):
    bench.switch('B')
    assert bench.switch(activate, deactivate, BEST_EFFORT) == NOTHING_TO_SWITCH
    assert bench.active == {'B'}


@BOTH
@pytest.mark.parametrize(
    ('request_', 'message'),
    [
        ('A2', "command interface 'a/velocity' is currently claimed by another controller"),
        ('AB', "command interface 'a/velocity' is currently claimed by another controller"),
        ('missing', "command interface 'wheel_typo/velocity' is not available"),
        ('blind', "state interface 'a/effort' is not available"),
    ],
)
def test_interfaces_that_are_not_available(bench, request_, message, strictness):
    for controller in (
        FakeController('missing', ['wheel_typo/velocity']),
        FakeController('blind', states=['a/position', 'a/effort']),
    ):
        bench.manager.load(controller, 'a/Type')
        bench.manager.configure(controller.context.name, None)
    bench.switch('A')
    message = rf"^Unable to activate controller '{request_}' since the {message}\.$"
    assert bench.refuses(message, f'{request_} B', '', strictness)
    assert bench.refuses(message, f'{request_} B', '', strictness)


@BOTH
def test_two_controllers_of_one_interface(bench, strictness):
    message = (
        r"^Unable to activate controller 'AB' since the command interface 'b/velocity' will be "
        r'used by another controller that is being activated\.$'
    )
    assert bench.refuses(message, 'B AB', '', strictness)


@BOTH
def test_hardware_that_is_not_active_has_no_commands_available(bench, strictness):
    bench.manager.set_component_state('hardware', LifecycleState.INACTIVE, 0)
    message = (
        r"since the command interface 'a/velocity' is not available\. Its hardware component "
        r"'hardware' is inactive, not active\.$"
    )
    assert bench.refuses(message, 'A', '', strictness)


def test_a_default_lends_the_commands_of_inactive_hardware_too():
    defaults = ManagerDefaults(allow_controller_activation_with_inactive_hardware=True)
    bench = Bench(defaults)
    bench.manager.set_component_state('hardware', LifecycleState.INACTIVE, 0)
    bench.switch('A')
    bench.manager.tick(0)
    assert bench.hardware.count('write') == 0
    bench.manager.set_component_state('hardware', LifecycleState.ACTIVE, 0)
    bench.manager.tick(10 * MS)
    assert bench.hardware.written['a'] == 2.0
    bench.manager.set_component_state('hardware', LifecycleState.UNCONFIGURED, 0)
    assert bench.active == set()
    assert bench.refuses("'a/velocity' is not available.*'hardware' is unconfigured", 'A')


@pytest.mark.parametrize('goes_on', [True, False])
def test_hardware_that_asks_to_be_inactive_stops_its_controllers_unless_disabled(goes_on):
    defaults = ManagerDefaults(deactivate_controllers_on_hardware_self_deactivate=not goes_on)
    bench = Bench(defaults)
    bench.switch('A S')
    bench.hardware.faults['write'] = HardwareDeactivationError('emergency stop')
    bench.manager.tick(0)
    assert bench.manager.snapshot.components[0].state is LifecycleState.INACTIVE
    assert bench.active == ({'A', 'S'} if goes_on else {'S'})


@BOTH
@pytest.mark.parametrize('error', [HardwareError('not now'), TypeError('not now')])
def test_hardware_that_refuses_the_mode(bench, strictness, error):
    bench.switch('A')
    bench.hardware.faults['prepare'] = error
    message = (
        r'^Could not switch controllers since prepare command mode switch was rejected\. .*not now'
    )
    assert bench.refuses(message, 'B', 'A', strictness)
    assert bench.controllers['A'].count('deactivate') == 0


# --- activation that fails -----------------------------------------------------------------------


@pytest.mark.parametrize('error', [ControllerError('too hot'), KeyError('too hot')])
@pytest.mark.parametrize(('strictness', 'left'), [(STRICT, {'S'}), (BEST_EFFORT, {'B', 'S'})])
def test_an_activation_that_fails(bench, strictness, left, error):
    """STRICT deactivates the others of the request again; what was active before stays so."""
    bench.switch('S')
    bench.controllers['A'].faults['activate'] = error
    message = r'Failed switching controllers\.\.\.\. Unable to activate controllers: \[ A \]'
    with pytest.raises(ControllerError, match=message):
        bench.switch('B A', '', strictness)
    assert bench.active == left
    bench.check_claims()
    assert any("Failed to activate 'A'" in text for text in bench.log.texts(Severity.ERROR))
    begun, ended = set(), set()
    performed = [call for call in bench.hardware.calls if call[0] == 'perform']
    for _, start_names, stop_names in performed:
        begun |= set(start_names)
        ended |= set(stop_names)
    assert begun - ended == {f'{name.lower()}/velocity' for name in left - {'S'}}


@pytest.mark.parametrize('error', [ControllerError('too hot'), KeyError('too hot')])
def test_a_controller_whose_activation_fails_is_unconfigured(bench, error):
    """Its own ``activate`` raised; one that only lacks an interface stays inactive."""
    bench.controllers['A'].faults['activate'] = error
    bench.controllers['A'].faults['cleanup'] = RuntimeError('never mind')
    with pytest.raises(ControllerError, match='Unable to activate'):
        bench.switch('A B')
    states = {each.name: each.state for each in bench.manager.snapshot.controllers}
    assert states['A'] is LifecycleState.UNCONFIGURED
    assert states['B'] is LifecycleState.INACTIVE
    assert bench.controllers['A'].count('cleanup') == 1
    assert bench.refuses("'A' is in 'unconfigured' state", 'A')


def test_after_a_failed_activation_the_interface_is_free(bench):
    bench.controllers['A'].faults['activate'] = ControllerError('too hot')
    with pytest.raises(ControllerError, match='Unable to activate'):
        bench.switch('A')
    bench.switch('A2')
    assert bench.claims == {'a/velocity': 'A2'}
