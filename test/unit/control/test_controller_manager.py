# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controller manager: its tick, the lifecycle of controllers, and what its services return.

Failures and resets: ``test_controller_manager_faults.py``.
"""

import math
import re
import threading

import pytest
from support.control_fakes import (
    collect,
    FakeController,
    FakeHardware,
    FakeLog,
    make_manager,
    MS,
    start,
    WHEELS,
)
from support.loaded_manager import ERRORS, loaded, PERIOD, run, states_of

from amr_description.control.contracts import ControllerContext
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import ALL_INTERFACES, LifecycleState
from amr_description.control.samples import TwistSample
from amr_description.control.switching import Strictness
from amr_description.controllers.broadcasters.joint_state_broadcaster import (
    BroadcasterParameters,
    JointStateBroadcaster,
)
from amr_description.controllers.drives.diff_drive_controller import (
    DiffDriveController,
    DiffDriveParameters,
)
from amr_description.errors import ControllerError
from amr_description.log import Severity
from amr_description.parameters import build

# --- the tick ------------------------------------------------------------------------------------


def test_a_tick_reads_updates_and_writes():
    hardware = FakeHardware(['j'])
    manager = make_manager(hardware)
    start(manager, FakeController(commands=['j/velocity']))
    hardware.calls.clear()
    manager.tick(0)
    assert [call[0] for call in hardware.calls] == ['read', 'write']
    assert hardware.written == {'j': 1.0}
    manager.tick(PERIOD)
    assert hardware.velocities['j'].value == 1.0


def test_the_first_period_is_the_nominal_one_and_then_the_true_one():
    manager = make_manager()
    controller = start(manager, FakeController(), time=5 * MS)
    for time in (20 * MS, 30 * MS, 33 * MS):
        manager.tick(time)
    assert controller.updates == [(20 * MS, PERIOD), (30 * MS, PERIOD), (33 * MS, 3 * MS)]


def test_a_slower_controller_is_updated_at_every_nth_tick():
    manager = make_manager()
    controller = start(manager, FakeController(update_rate=25))
    run(manager, 9, begin=70 * MS)
    assert controller.updates == [(t * MS, 4 * PERIOD) for t in (70, 110, 150)]


@pytest.mark.parametrize('ticks', [1, 2, 3, 4, 5])
def test_after_a_reset_a_slower_controller_is_updated_as_at_first(ticks):
    """Else what it publishes would depend on how long the simulation had run before."""
    manager = make_manager(FakeHardware())
    controller = start(manager, FakeController(update_rate=25))
    run(manager, ticks)
    before = controller.count('update')
    manager.reset(0)
    run(manager, 1)
    assert controller.count('update') == before + 1
    run(manager, 3, begin=PERIOD)
    assert controller.count('update') == before + 1


@pytest.mark.parametrize(
    ('rate', 'runs_at', 'warning'),
    [
        (100, 100, ''),
        (50, 50, ''),
        (1, 1, ''),
        (200, 100, '200 Hz, is above that of the controller manager, 100 Hz'),
        (60, 50, '60 Hz, is not achievable .* at 100 Hz; it runs at 50 Hz'),
        (40, 33, '40 Hz, is not achievable .* at 100 Hz; it runs at 33.3333 Hz'),
        (75, 100, '75 Hz, is not achievable .* at 100 Hz; it runs at 100 Hz'),
    ],
)
def test_rates_are_those_that_divide_the_managers(rate, runs_at, warning):
    log = FakeLog()
    manager = loaded(FakeController(update_rate=rate), log=log)
    assert manager.snapshot.controllers[0].update_rate == runs_at
    warnings = ' '.join(log.texts(Severity.WARN))
    assert re.search(warning, warnings) if warning else warnings == ''


@pytest.mark.parametrize('rate', [0, -5])
def test_a_rate_that_is_not_positive_is_refused(rate):
    with pytest.raises(ControllerError, match=f"'fake' must be above 0 Hz, found {rate}"):
        loaded(FakeController(update_rate=rate))


def test_the_next_tick_is_the_next_multiple_of_the_period_even_after_a_late_one():
    manager = make_manager()
    assert manager.is_due(0)
    for time, following in ((0, 10), (10, 20), (27, 30), (55, 60)):
        manager.tick(time * MS)
        assert manager.next_tick == following * MS
        assert not manager.is_due(following * MS - 1)
        assert manager.is_due(following * MS)


@pytest.mark.parametrize('anew', [ControllerManager.begin, ControllerManager.reset])
def test_time_that_begins_between_two_ticks_begins_with_a_whole_period(anew):
    manager = make_manager()
    run(manager, 3)
    for time, first in ((4 * MS, 10 * MS), (123_456_789, 130 * MS), (50 * MS, 50 * MS), (0, 0)):
        anew(manager, time)
        assert manager.next_tick == first
        assert manager.is_due(time) is (time == first)


def test_the_world_may_give_the_period():
    manager = make_manager(rate=150)
    assert manager.period == 6_666_667
    manager = type(manager)(manager.resources, 150, FakeLog(), period=6_666_668)
    manager.tick(0)
    assert manager.next_tick == 6_666_668


# --- lifecycle -----------------------------------------------------------------------------------


def test_a_controllers_life():
    controller = FakeController()
    manager = loaded(controller)
    seen = [states_of(manager)['fake']]
    for step in (
        lambda: manager.configure('fake', 'parameters'),
        lambda: manager.switch(['fake'], [], Strictness.STRICT, 0),
        lambda: manager.switch([], ['fake'], Strictness.STRICT, 0),
        lambda: manager.cleanup('fake'),
    ):
        step()
        seen.append(states_of(manager)['fake'])
    assert seen == ['unconfigured', 'inactive', 'active', 'inactive', 'unconfigured']
    assert [call[0] for call in controller.calls] == [
        'configure', 'activate', 'deactivate', 'cleanup'
    ]  # fmt: skip
    assert controller.calls[0] == ('configure', 'parameters')
    manager.unload('fake')
    assert manager.snapshot.controllers == ()
    assert states_of(manager) == {}


@pytest.mark.parametrize('verb', ['configure', 'cleanup', 'unload'])
def test_an_unknown_controller(verb):
    arguments = ('nobody', None) if verb == 'configure' else ('nobody',)
    message = f"Could not {verb} controller with name 'nobody' because no controller with this"
    with pytest.raises(ControllerError, match=message):
        getattr(make_manager(), verb)(*arguments)


def test_a_name_twice():
    message = "A controller named 'fake' was already loaded inside the controller manager"
    with pytest.raises(ControllerError, match=message):
        loaded(FakeController(), FakeController())


def test_what_an_active_controller_refuses():
    manager = make_manager()
    start(manager, FakeController())
    with pytest.raises(ControllerError, match="can not be configured from 'active' state"):
        manager.configure('fake', None)
    with pytest.raises(ControllerError, match="can not be cleaned-up from 'active' state"):
        manager.cleanup('fake')
    with pytest.raises(ControllerError, match="'fake' because it is still active"):
        manager.unload('fake')
    assert states_of(manager) == {'fake': 'active'}


def test_configure_from_inactive_cleans_up_first():
    controller = FakeController()
    manager = loaded(controller)
    manager.configure('fake', 1)
    manager.configure('fake', 2)
    assert controller.calls == [('configure', 1), ('cleanup',), ('configure', 2)]


def test_cleanup_and_unload_of_an_unconfigured_one():
    controller = FakeController()
    manager = loaded(controller)
    manager.cleanup('fake')
    manager.unload('fake')
    assert controller.calls == []


@pytest.mark.parametrize('error', ERRORS)
def test_a_configure_that_fails_leaves_it_unconfigured(error):
    controller = FakeController()
    manager = loaded(controller)
    manager.configure('fake', None)
    controller.faults['configure'] = error
    with pytest.raises(ControllerError, match="Failed to configure controller 'fake': .*no, than"):
        manager.configure('fake', None)
    assert states_of(manager) == {'fake': 'unconfigured'}


def test_a_long_configure_on_another_thread_stops_no_tick():
    """A worker is inside `configure` while the manager ticks; events, not time, order the two."""
    manager = make_manager(FakeHardware(['j']))
    driving = start(manager, FakeController('driving', ['j/velocity']))
    slow, entered, leave = FakeController('slow'), threading.Event(), threading.Event()

    def configure(parameters):
        entered.set()
        assert leave.wait(10.0)

    slow.configure = configure
    manager.load(slow, 'a/Type')
    configuring = manager.begin_configure('slow')
    worker = threading.Thread(target=configuring.run, args=(None,))
    worker.start()
    assert entered.wait(10.0)
    run(manager, 5)
    assert len(driving.updates) == 5
    assert states_of(manager) == {'driving': 'active', 'slow': 'unconfigured'}
    leave.set()
    worker.join()
    assert manager.finish_configure(configuring) is slow
    assert states_of(manager) == {'driving': 'active', 'slow': 'inactive'}


def test_a_controller_that_is_being_configured_is_left_alone():
    manager = loaded(FakeController())
    configuring = manager.begin_configure('fake')
    for verb in ('configure', 'cleanup', 'unload'):
        arguments = ('fake', None) if verb == 'configure' else ('fake',)
        message = f"Could not {verb} controller with name 'fake' because it is being configured"
        with pytest.raises(ControllerError, match=message):
            getattr(manager, verb)(*arguments)
    message = "^Controller with name 'fake' is being configured; it can be activated when that has"
    with pytest.raises(ControllerError, match=message):
        manager.switch(['fake'], [], Strictness.STRICT, 0)
    manager.reset(0)
    manager.tick(0)
    configuring.run(None)
    manager.finish_configure(configuring)
    manager.unload('fake')
    assert configuring.loaded.controller.calls == [('configure', None), ('cleanup',)]


def test_a_configuration_that_was_not_run_did_not_happen():
    manager = loaded(FakeController())
    configuring = manager.begin_configure('fake')
    with pytest.raises(ControllerError, match="'fake': it was not configured"):
        manager.finish_configure(configuring)
    assert states_of(manager) == {'fake': 'unconfigured'}
    manager.configure('fake', None)


@pytest.mark.parametrize('kind', ['command', 'state'])
def test_interfaces_that_are_not_unique_are_refused_and_cleaned_up(kind):
    controller = FakeController(**{f'{kind}s': ['j/velocity', 'j/velocity']})
    manager = loaded(controller, components=[FakeHardware(['j'])])
    message = f"The {kind} interfaces of the controller 'fake' are not unique.*'j/velocity'"
    with pytest.raises(ControllerError, match=message):
        manager.configure('fake', None)
    assert states_of(manager) == {'fake': 'unconfigured'}
    assert controller.calls[-1] == ('cleanup',)


@pytest.mark.parametrize('error', ERRORS)
@pytest.mark.parametrize('verb', ['cleanup', 'unload'])
def test_a_cleanup_that_fails_is_logged_and_done(verb, error):
    log, controller = FakeLog(), FakeController()
    manager = loaded(controller, log=log)
    manager.configure('fake', None)
    controller.faults['cleanup'] = error
    getattr(manager, verb)('fake')
    assert states_of(manager) == ({'fake': 'unconfigured'} if verb == 'cleanup' else {})
    assert 'no, thanks' in log.texts(Severity.ERROR)[0]


# --- the two controllers together ----------------------------------------------------------------


def seed_robot(hardware, log=None):
    manager = make_manager(hardware, log=log)
    values = {
        'left_wheel_names': WHEELS[:2],
        'right_wheel_names': WHEELS[2:],
        'wheel_separation': 0.3,
        'wheel_radius': 0.1,
    }
    drive = DiffDriveController(ControllerContext('drive', FakeLog()))
    start(manager, drive, build(DiffDriveParameters, values))
    broadcaster = JointStateBroadcaster(ControllerContext('jsb', FakeLog()))
    start(manager, broadcaster, build(BroadcasterParameters, {}))
    return manager, drive, collect(broadcaster.outputs()[0])


def test_a_wheel_state_of_nan_ends_the_drive_at_rest_and_not_the_broadcaster():
    log, hardware = FakeLog(), FakeHardware()
    manager, drive, joint_states = seed_robot(hardware, log)
    drive.inputs()[0].put(TwistSample(0, 0.5, 0.0))
    run(manager, 5)
    assert set(hardware.written.values()) == {5.0}
    hardware.velocities[WHEELS[3]].value = math.nan
    hardware.positions[WHEELS[3]].value = math.nan
    run(manager, 2, begin=5 * PERIOD)
    assert states_of(manager) == {'drive': 'inactive', 'jsb': 'active'}
    assert set(hardware.written.values()) == {0.0}
    assert len(joint_states) == 7
    assert f'{WHEELS[3]}/position is nan' in log.texts(Severity.ERROR)[0]


def test_an_inactive_drive_takes_no_commands():
    manager, drive, _ = seed_robot(FakeHardware())
    manager.switch([], ['drive'], Strictness.STRICT, 0)
    assert not drive.inputs()[0].put(TwistSample(0, 0.5, 0.0))
    manager.switch(['drive'], [], Strictness.STRICT, 0)
    assert drive.inputs()[0].drain() == []
    assert drive.inputs()[0].put(TwistSample(0, 0.5, 0.0))


# --- snapshots -----------------------------------------------------------------------------------


def test_the_snapshot_has_what_the_services_return():
    manager, _, _ = seed_robot(FakeHardware())
    drive, broadcaster = manager.snapshot.controllers
    commands = tuple(f'{wheel}/velocity' for wheel in WHEELS)
    assert (drive.name, drive.type, drive.update_rate) == ('drive', 'a/Type', 100)
    assert drive.claimed == drive.required_commands == commands
    assert drive.required_states == tuple(f'{wheel}/position' for wheel in WHEELS)
    assert drive.is_chainable
    references = ('drive/angular/velocity', 'drive/linear/velocity')
    assert tuple(sorted(i.name for i in drive.references)) == references
    assert all(i.is_available and not i.is_claimed for i in drive.references)
    assert not broadcaster.is_chainable
    assert len(broadcaster.required_states) == 8
    (component,) = manager.snapshot.components
    assert (component.type, component.plugin, component.rate) == ('system', 'a/Fake', 100)
    assert [i.name for i in manager.snapshot.commands] == sorted(commands + references)
    assert all(i.is_available for i in manager.snapshot.commands)
    assert {i.name for i in manager.snapshot.commands if i.is_claimed} == set(commands)
    assert not any(i.is_claimed for i in manager.snapshot.states)


def test_an_unconfigured_controller_requires_nothing_and_an_inactive_one_claims_nothing():
    manager, _, _ = seed_robot(FakeHardware())
    manager.switch([], ['drive'], Strictness.STRICT, 0)
    drive = manager.snapshot.controllers[0]
    assert (drive.claimed, len(drive.required_commands)) == ((), 4)
    assert len(drive.references) == 2
    assert not any(i.is_available for i in drive.references)
    manager.cleanup('drive')
    drive = manager.snapshot.controllers[0]
    assert drive.required_commands == drive.required_states == drive.references == ()
    assert drive.is_chainable


def test_a_snapshot_is_replaced_not_changed():
    manager, _, _ = seed_robot(FakeHardware())
    before = manager.snapshot
    manager.switch([], ['drive'], Strictness.STRICT, 0)
    assert before.controllers[0].state is LifecycleState.ACTIVE
    assert manager.snapshot.controllers[0].state is LifecycleState.INACTIVE
    with pytest.raises(AttributeError, match='cannot assign'):
        before.controllers = ()


def test_all_interfaces_are_those_of_the_hardware_that_is_there():
    looker = FakeController('looker')
    looker.requests = looker.requests[0], ALL_INTERFACES
    one, two = FakeHardware(['a'], 'one'), FakeHardware(['b'], 'two')
    manager = make_manager(one)
    start(manager, looker)
    assert manager.snapshot.controllers[0].required_states == ('a/position', 'a/velocity')
    manager.resources.add(two)
    manager.set_component_state('two', LifecycleState.ACTIVE, 0)
    manager.switch(['looker'], ['looker'], Strictness.STRICT, 0)
    assert manager.snapshot.controllers[0].required_states == (
        'a/position', 'a/velocity', 'b/position', 'b/velocity'
    )  # fmt: skip
