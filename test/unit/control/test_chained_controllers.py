# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Controllers in chains: order, modes, switching, and failures."""

import math

import pytest
from support.control_fakes import (
    FakeChainable,
    FakeController,
    FakeHardware,
    FakeLog,
    make_manager,
    MS,
)

from amr_description.control.interfaces import ALL_INTERFACES, LifecycleState
from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError
from amr_description.log import Severity

STRICT, BEST_EFFORT = Strictness.STRICT, Strictness.BEST_EFFORT
BOTH = pytest.mark.parametrize('strictness', [STRICT, BEST_EFFORT])
PERIOD = 10 * MS


class Bench:
    """
    head → middle → tail → joint a, where ``→`` is a command.

    other wants the same reference as middle, side the second one of tail; reader reads its state.
    """

    def __init__(self, fallbacks=None):
        self.log = FakeLog()
        self.hardware = FakeHardware(['a', 'b'])
        self.manager = make_manager(self.hardware, log=self.log)
        self.controllers = {
            controller.context.name: controller
            for controller in (
                FakeController('head', ['middle/x']),
                FakeController('other', ['tail/x']),
                FakeController('reader', states=['tail/speed']),
                FakeController('side', ['tail/y']),
                FakeChainable('middle', ['tail/x']),
                FakeChainable('tail', ['a/velocity'], references='xy', exports=['speed']),
            )
        }
        for name, controller in self.controllers.items():
            self.manager.load(controller, 'a/Type', (fallbacks or {}).get(name, ()))
            self.manager.configure(name, None)

    def switch(self, activate='', deactivate='', strictness=STRICT):
        """Switch controllers by names in one text."""
        return self.manager.switch(activate.split(), deactivate.split(), strictness, 0)

    def refuses(self, message, *request):
        before = self.active, dict(self.manager.resources.claims), self.manager.snapshot
        with pytest.raises(ControllerError, match=message):
            self.switch(*request)
        after = self.active, dict(self.manager.resources.claims), self.manager.snapshot
        return after == before

    def __getitem__(self, name):
        return next(c for c in self.manager.snapshot.controllers if c.name == name)

    @property
    def active(self):
        return set(self.manager.snapshot.active_controllers)

    @property
    def chained(self):
        return {c.name for c in self.manager.snapshot.controllers if c.is_chained}

    def lifecycle(self, name):
        """Return the lifecycle calls of a controller since the last call of this."""
        calls = [call[0] for call in self.controllers[name].calls if call[0] != 'update']
        self.controllers[name].calls.clear()
        return calls


@pytest.fixture
def bench():
    return Bench()


# --- order and flow ------------------------------------------------------------------------------


def test_the_list_is_in_the_order_of_the_updates(bench):
    names = [controller.name for controller in bench.manager.snapshot.controllers]
    assert names.index('head') < names.index('middle') < names.index('tail')
    assert max(map(names.index, ('other', 'side'))) < names.index('tail') < names.index('reader')


def test_a_command_passes_the_whole_chain_within_one_tick(bench):
    bench.switch('head middle tail side')
    assert bench.chained == {'middle', 'tail'}
    for k in (1, 2, 3):
        bench.manager.tick(k * PERIOD)
        assert bench.hardware.written['a'] == 2.0 * k  # of head, by way of middle, and of side
    assert bench.controllers['tail'].modes == [True] * 3


@pytest.mark.parametrize('request_', ['tail middle head', 'head middle tail', 'middle head tail'])
@BOTH
def test_the_order_of_the_names_does_not_matter(bench, request_, strictness):
    bench.switch(request_, '', strictness)
    assert bench.active == {'head', 'middle', 'tail'}
    bench.switch('', request_, strictness)
    assert bench.active == bench.chained == set()
    assert bench.hardware.commands['a'].value == 0.0


def test_a_chain_can_be_built_and_taken_down_one_by_one(bench):
    for name in ('tail', 'middle', 'head'):
        bench.switch(name)
    assert bench.chained == {'middle', 'tail'}
    for name in ('head', 'middle', 'tail'):
        bench.switch('', name)
    assert bench.active == set()
    assert bench.manager.resources.claims == {}


# --- the mode ------------------------------------------------------------------------------------


def test_a_controller_that_becomes_commanded_is_restarted_in_chained_mode_and_back(bench):
    bench.switch('tail')
    assert bench.lifecycle('tail') == ['configure', 'activate']
    assert bench.chained == set()
    bench.switch('middle')
    assert bench.lifecycle('tail') == ['deactivate', 'set_chained_mode', 'activate']
    assert bench['tail'].is_chained
    bench.switch('side')
    assert bench.lifecycle('tail') == []
    bench.switch('', 'middle')
    assert bench.lifecycle('tail') == []
    assert bench.chained == {'tail'}
    message = bench.switch('', 'side', BEST_EFFORT)
    assert bench.lifecycle('tail') == ['deactivate', 'set_chained_mode', 'activate']
    assert (bench.active, bench.chained) == ({'tail'}, set())
    assert message == (
        'Successfully switched controllers! Deactivated controllers: [ side tail ] '
        'Activated controllers: [ tail ]'
    )


def test_a_preceding_controller_may_be_replaced_without_a_restart(bench):
    bench.switch('tail middle')
    bench.lifecycle('tail')
    bench.switch('other', 'middle')
    assert (bench.active, bench.chained) == ({'tail', 'other'}, {'tail'})
    assert bench.lifecycle('tail') == []
    assert bench.manager.resources.claims['tail/x'] == 'other'


def test_reading_a_state_does_not_chain_a_controller(bench):
    bench.switch('tail reader')
    assert bench.chained == set()
    assert bench.lifecycle('tail')[-1] == 'activate'


@pytest.mark.parametrize('fault', [ControllerError('never'), ValueError('never')])
def test_a_controller_may_refuse_the_chained_mode(bench, fault):
    bench.controllers['tail'].faults['set_chained_mode'] = fault
    with pytest.raises(ControllerError, match=r'to activate controllers: \[ tail middle \]'):
        bench.switch('middle tail')
    assert (bench.active, bench.chained) == (set(), set())
    bench.switch('tail')
    assert bench.active == {'tail'}


# --- refusals ------------------------------------------------------------------------------------


def test_a_following_controller_must_be_active_or_activated_too(bench):
    refusal = (
        "^Unable to activate controller with name '{}' because following controller with name "
    )
    message = refusal.format('head') + "'middle' is not active and will not be activated"
    assert bench.refuses(message, 'head tail')
    message = refusal.format('reader') + "'tail' is not active and will not be activated"
    assert bench.refuses(message, 'reader')
    bench.switch('tail middle')
    message = refusal.format('middle') + "'tail' is currently active but will be deactivated"
    assert bench.refuses(message, 'middle', 'tail middle')


def test_best_effort_drops_controllers_that_lack_one_they_need(bench):
    bench.switch('head tail', '', BEST_EFFORT)
    assert bench.active == {'tail'}
    bench.controllers['late'] = FakeChainable('late', ['middle/x'])
    bench.switch('head other', '', BEST_EFFORT)
    assert bench.active == {'tail', 'other'}


def test_a_chainable_controller_in_use_cannot_be_deactivated(bench):
    bench.switch('tail middle reader')
    message = (
        "^Unable to deactivate controller with name 'tail' because preceding controller with name "
        r"'middle' is currently active and will not be deactivated\.$"
    )
    assert bench.refuses(message, '', 'tail')
    assert bench.refuses(message, '', 'tail reader')
    assert bench.refuses(message.replace('middle', 'reader'), '', 'tail middle')
    assert bench.refuses(message, 'tail', 'tail')
    assert bench.switch('', 'tail', BEST_EFFORT).startswith('After checking the controllers')
    assert bench.active == {'tail', 'middle', 'reader'}
    assert any("'tail' because preceding" in text for text in bench.log.texts(Severity.WARN))


def test_a_chainable_controller_that_will_be_used_cannot_be_deactivated(bench):
    bench.switch('tail')
    message = (
        "^Unable to deactivate controller with name 'tail' because preceding controller with name "
        r"'middle' is inactive and will be activated\.$"
    )
    assert bench.refuses(message, 'middle', 'tail')
    bench.switch('middle', 'tail', BEST_EFFORT)
    assert bench.active == {'tail', 'middle'}


def test_a_chain_is_restarted_as_a_whole(bench):
    bench.switch('tail middle head')
    names = 'tail middle head'
    for name in names.split():
        bench.lifecycle(name)
    bench.switch(names, names)
    assert (bench.active, bench.chained) == (set(names.split()), {'tail', 'middle'})
    for name in names.split():
        calls = bench.lifecycle(name)
        assert calls[0] == 'deactivate'
        assert calls[-1] == 'activate'


@BOTH
def test_a_reference_is_claimed_by_one_controller(bench, strictness):
    bench.switch('tail middle')
    refusal = "^Unable to activate controller 'other' since the command interface 'tail/x' "
    assert bench.refuses(f'{refusal}is currently claimed by', 'other', '', strictness)
    bench.switch('', 'middle')
    assert bench.refuses(f'{refusal}will be used by another', 'middle other', '', strictness)


def test_references_of_a_controller_that_is_not_loaded_are_not_available(bench):
    bench.switch('tail')
    bench.manager.unload('middle')
    assert bench.refuses("since the command interface 'middle/x' is not available", 'head')
    assert bench['head'].chain_connections == ()


# --- activation that fails -----------------------------------------------------------------------


@BOTH
def test_an_active_controller_goes_on_unchained_if_its_preceding_one_fails(bench, strictness):
    bench.switch('tail reader')
    bench.controllers['middle'].faults['activate'] = ControllerError('too hot')
    with pytest.raises(ControllerError, match=r'Unable to activate controllers: \[ middle \]'):
        bench.switch('middle', '', strictness)
    assert (bench.active, bench.chained) == ({'tail', 'reader'}, set())
    assert bench.manager.resources.claims == {'a/velocity': 'tail'}
    bench.manager.tick(0)
    assert bench.controllers['tail'].modes == [False]


@BOTH
def test_if_a_following_controller_fails_its_preceding_ones_are_deactivated(bench, strictness):
    bench.switch('tail reader')
    bench.controllers['tail'].faults['activate'] = ControllerError('too hot')
    with pytest.raises(ControllerError, match=r'to activate controllers: \[ tail middle \]'):
        bench.switch('middle', '', strictness)
    assert bench.active == bench.chained == set()
    assert bench.manager.resources.claims == {}


@pytest.mark.parametrize(('strictness', 'left'), [(STRICT, set()), (BEST_EFFORT, {'tail'})])
def test_a_chain_of_which_one_fails(bench, strictness, left):
    bench.controllers['middle'].faults['activate'] = KeyError('too hot')
    with pytest.raises(ControllerError, match=r'activate controllers: \[ middle head \]'):
        bench.switch('head middle tail', '', strictness)
    assert (bench.active, bench.chained) == (left, set())


def test_hardware_that_fails_to_change_its_mode_leaves_no_incomplete_chain(bench):
    bench.switch('tail reader')
    bench.hardware.faults['perform'] = OSError('stuck')
    with pytest.raises(ControllerError, match='Error while performing mode switch. .*stuck'):
        bench.switch('middle')
    assert bench.active == bench.chained == set()
    assert bench.hardware.commands['a'].value == 0.0


# --- faults --------------------------------------------------------------------------------------


@pytest.mark.parametrize('failing', ['head', 'middle', 'tail'])
def test_a_member_that_fails_takes_its_chain_down_and_nothing_else(bench, failing):
    bench.manager.load(FakeController('free', ['b/velocity']), 'a/Type')
    bench.manager.configure('free', None)
    bench.switch('head middle tail reader free')
    bench.manager.tick(0)
    bench.controllers[failing].faults['update'] = ControllerError('too hot')
    bench.manager.tick(PERIOD)
    assert (bench.active, bench.chained) == ({'free'}, set())
    assert bench.hardware.written == {'a': 0.0, 'b': 2.0}
    assert bench.manager.resources.claims == {'b/velocity': 'free'}
    assert bench.log.texts(Severity.ERROR)[1:] == [
        'Deactivating controllers : [ head middle tail reader ] as their update resulted in an '
        'error!'
    ]


def test_a_reader_that_fails_is_deactivated_alone(bench):
    bench.switch('middle tail reader')
    bench.controllers['reader'].faults['update'] = ControllerError('too hot')
    bench.manager.tick(0)
    assert (bench.active, bench.chained) == ({'middle', 'tail'}, {'tail'})


def test_hardware_that_fails_takes_the_chain_down(bench):
    bench.switch('head middle tail')
    bench.hardware.faults['read'] = OSError('cable off')
    bench.manager.tick(0)
    assert bench.active == bench.chained == set()


def test_a_reset_that_fails_takes_the_chain_down(bench):
    bench.switch('head middle tail')
    bench.controllers['head'].faults['reset'] = OSError('cable off')
    bench.manager.reset(0)
    assert bench.active == set()


# --- fallbacks -----------------------------------------------------------------------------------


def test_when_a_controller_fails_its_fallbacks_start_as_a_chain():
    bench = Bench(fallbacks={'head': ['tail', 'other']})
    bench.switch('head middle tail')
    bench.controllers['head'].faults['update'] = ControllerError('too hot')
    bench.manager.tick(0)
    assert (bench.active, bench.chained) == ({'tail', 'other'}, {'tail'})
    bench.manager.tick(PERIOD)
    assert bench.hardware.written['a'] == 1.0
    assert bench.log.texts(Severity.ERROR)[1:] == [
        'Deactivating controllers : [ head middle tail ] as their update resulted in an error!',
        'Activating fallback controllers : [ tail other ]',
    ]


def test_a_fallback_takes_the_interfaces_that_it_needs():
    bench = Bench()
    spare = FakeController('spare', ['a/velocity', 'b/velocity'])
    risky = FakeController('risky')
    bench.manager.load(spare, 'a/Type')
    bench.manager.load(risky, 'a/Type', ['spare'])
    for name in ('spare', 'risky'):
        bench.manager.configure(name, None)
    bench.switch('risky middle tail')
    risky.faults['update'] = ZeroDivisionError('by zero')
    bench.manager.tick(0)
    assert bench.active == {'spare'}
    raised, *texts = bench.log.texts(Severity.ERROR)
    assert raised.startswith(
        "Caught exception of type : ZeroDivisionError while updating controller 'risky': by zero "
        '(control_fakes.py:'
    )
    assert texts == [
        'Deactivating controllers : [ risky ] as their update resulted in an error!',
        'Deactivating controllers : [ middle tail ] using the command interfaces needed for the '
        'fallback controllers to activate',
        'Activating fallback controllers : [ spare ]',
    ]


def test_a_fallback_that_is_active_already_stays_so():
    bench = Bench(fallbacks={'reader': ['tail']})
    bench.switch('tail reader')
    bench.lifecycle('tail')
    bench.controllers['reader'].faults['update'] = ControllerError('too hot')
    bench.manager.tick(0)
    assert bench.active == {'tail'}
    assert bench.lifecycle('tail') == []
    assert len(bench.log.texts(Severity.ERROR)) == 3
    assert bench.log.texts(Severity.ERROR)[-1].startswith('Activating fallback')


def test_a_fallback_that_fails_in_the_same_tick_is_not_started_again():
    bench = Bench(fallbacks={'reader': ['tail']})
    bench.switch('tail reader')
    for name in ('tail', 'reader'):
        bench.controllers[name].faults['update'] = ControllerError('too hot')
    bench.manager.tick(0)
    assert bench.active == set()
    assert not any('fallback' in text for text in bench.log.texts(Severity.ERROR))


@pytest.mark.parametrize(
    ('do', 'why'),
    [
        (None, "following controller with name 'tail' is not active"),
        ('unload', "name 'side' because no controller with this name exists"),
        ('cleanup', "name 'side' is in 'unconfigured' state"),
    ],
)
def test_a_fallback_that_cannot_start_is_logged_and_the_actuators_are_safe(do, why):
    bench = Bench(fallbacks={'other': ['side']})
    bench.switch('tail other')
    bench.manager.tick(0)
    if do:
        getattr(bench.manager, do)('side')
    bench.controllers['other'].faults['update'] = ControllerError('too hot')
    bench.manager.tick(PERIOD)
    assert bench.active == set()
    assert bench.hardware.written['a'] == 0.0
    last = bench.log.texts(Severity.ERROR)[-1]
    assert last.startswith('Could not activate the fallback controllers: ')
    assert why in last


def test_a_fallback_that_requests_all_interfaces_gets_all():
    bench = Bench()
    greedy, risky = FakeController('greedy'), FakeController('risky')
    greedy.requests = ALL_INTERFACES, greedy.requests[1]
    bench.manager.load(greedy, 'a/Type')
    bench.manager.load(risky, 'a/Type', ['greedy'])
    for name in ('greedy', 'risky'):
        bench.manager.configure(name, None)
    bench.switch('risky middle tail')
    risky.faults['update'] = ControllerError('too hot')
    bench.manager.tick(0)
    assert bench.active == {'greedy'}
    assert bench.manager.resources.claims == {'a/velocity': 'greedy', 'b/velocity': 'greedy'}


def test_a_controller_cannot_be_its_own_fallback(bench):
    message = r"^Controller 'new' cannot be a fallback controller for itself\.$"
    with pytest.raises(ControllerError, match=message):
        bench.manager.load(FakeController('new'), 'a/Type', ['other', 'new'])
    assert 'new' not in [each.name for each in bench.manager.snapshot.controllers]


def test_fallbacks_must_be_configured_before_the_activation():
    bench = Bench(fallbacks={'side': ['spare']})
    bench.switch('tail')
    message = (
        "^Controller with name 'side' cannot be activated, as its fallback controller : 'spare' "
        'need to be configured and be in inactive/active state!$'
    )
    assert bench.refuses(message, 'side')
    bench.manager.load(FakeController('spare', ['a/velocity', 'c/velocity']), 'a/Type')
    assert bench.refuses(message, 'side')
    bench.manager.configure('spare', None)
    message = (
        "^Controller with name 'side' cannot be activated, as not all of its fallback controller's"
        " : 'spare' command interfaces are currently available! Missing: c/velocity$"
    )
    assert bench.refuses(message, 'side')


def test_a_fallback_must_not_need_what_the_same_request_deactivates():
    bench = Bench(fallbacks={'risky': ['other']})
    bench.manager.load(FakeController('risky'), 'a/Type', ['other'])
    bench.manager.configure('risky', None)
    bench.switch('tail')
    message = "fallback controller's : 'other' command .* currently available! Missing: tail/x$"
    assert bench.refuses(message, 'risky', 'tail')
    bench.switch('risky')


# --- what is offered -----------------------------------------------------------------------------


def test_exported_interfaces_are_listed_once_configured_and_available_while_active(bench):
    def offered(name):
        interfaces = bench.manager.snapshot.commands + bench.manager.snapshot.states
        return next((i.is_available, i.is_claimed) for i in interfaces if i.name == name)

    assert offered('tail/x') == offered('tail/speed') == (False, False)
    bench.switch('tail')
    assert offered('tail/x') == offered('tail/speed') == (True, False)
    bench.switch('middle')
    assert offered('tail/x') == (True, True)
    assert offered('tail/y') == (True, False)
    assert bench['middle'].chain_connections == (('tail', ('tail/x',)),)
    bench.switch('', 'middle tail')
    bench.manager.cleanup('tail')
    assert not any(i.name.startswith('tail/') for i in bench.manager.snapshot.commands)
    assert bench['middle'].chain_connections == ()


def test_a_request_for_all_interfaces_leaves_out_its_own(bench):
    greedy = FakeChainable('greedy', exports=['own'])
    greedy.requests = ALL_INTERFACES, ALL_INTERFACES
    bench.manager.load(greedy, 'a/Type')
    bench.manager.configure('greedy', None)
    bench.manager.unload('tail')
    for _ in range(2):
        bench.switch('greedy', 'greedy' if 'greedy' in bench.active else '')
        assert set(bench['greedy'].claimed) == {'a/velocity', 'b/velocity'}
        assert 'greedy/own' not in bench['greedy'].required_states


def test_a_controller_of_all_interfaces_can_be_commanded_from_the_first():
    bench = Bench()
    greedy = FakeChainable('greedy')
    greedy.requests = ALL_INTERFACES, greedy.requests[1]
    for controller in (greedy, FakeController('pilot', ['greedy/x'])):
        bench.manager.load(controller, 'a/Type')
        bench.manager.configure(controller.context.name, None)
    bench.switch('pilot greedy')
    assert (bench.active, bench.chained) == ({'pilot', 'greedy'}, {'greedy'})


def test_the_mode_is_kept_for_a_controller_that_does_not(bench):
    bench.controllers['tail'].set_chained_mode = lambda is_chained: None
    bench.switch('tail middle')
    assert bench.chained == {'tail'}
    bench.switch('', 'middle')
    assert bench.chained == set()


@pytest.mark.parametrize(
    ('offers', 'message'),
    [
        ({'references': 'xx'}, 'The reference interfaces of the controller .* are not unique'),
        ({'exports': ['s', 's']}, 'The exported state interfaces of the controller .* not unique'),
    ],
)
def test_exported_interfaces_must_be_unique(bench, offers, message):
    bench.manager.load(FakeChainable('new', **offers), 'a/Type')
    with pytest.raises(ControllerError, match=message):
        bench.manager.configure('new', None)


def test_exported_interfaces_begin_with_the_name_of_their_controller(bench):
    unnamed = FakeChainable('unnamed')
    unnamed.offers = FakeChainable('tail').offers
    bench.manager.load(unnamed, 'a/Type')
    message = "The reference interface 'tail/x' of the controller 'unnamed' must be named 'u"
    with pytest.raises(ControllerError, match=message):
        bench.manager.configure('unnamed', None)
    bench.manager.load(FakeChainable('a', references=['velocity']), 'a/Type')
    with pytest.raises(ControllerError, match="'a/velocity' of the controller 'a' is there alr"):
        bench.manager.configure('a', None)


def test_a_circular_chain_is_refused(bench):
    bench.manager.unload('tail')
    bench.manager.load(FakeChainable('tail', ['middle/x']), 'a/Type')
    message = (
        "^Failed to configure controller 'tail': circular chain of controllers: "
        '(middle -> tail -> middle|tail -> middle -> tail)$'
    )
    with pytest.raises(ControllerError, match=message):
        bench.manager.configure('tail', None)
    assert bench['tail'].state is LifecycleState.UNCONFIGURED
    assert bench['middle'].state is LifecycleState.INACTIVE


def test_the_command_of_a_slower_controller_stays_in_force(bench):
    bench.manager.load(FakeController('slow', ['tail/x'], update_rate=50), 'a/Type')
    bench.manager.configure('slow', None)
    bench.switch('slow tail side')
    written = []
    for k in range(4):
        bench.manager.tick(k * PERIOD)
        written.append(bench.hardware.written['a'])
    assert written == [2.0, 3.0, 5.0, 6.0]  # 1, 1, 2, 2 of slow and 1, 2, 3, 4 of side
    assert not math.isnan(written[0])
