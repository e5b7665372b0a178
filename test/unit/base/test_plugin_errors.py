# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Third-party controllers, any method of which may raise at any time: the robot goes on."""

import contextlib
import random

import pytest
from support.control_fakes import FakeController, FakeHardware, FakeLog, make_manager, MS, start

from amr_description.control.contracts import Controller, ControllerContext, Input, Port
from amr_description.control.interfaces import CommandInterface, InterfaceRequest, LifecycleState
from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError
from amr_description.log import Severity

METHODS = (
    'activate',
    'cleanup',
    'command_interfaces',
    'configure',
    'deactivate',
    'exported_states',
    'inputs',
    'references',
    'reset',
    'set_chained_mode',
    'set_clock',
    'state_interfaces',
    'update',
)
PERIOD = 10 * MS


def raising(name):
    """Return the method of that name, which raises while it is in ``faults``."""

    def method(self, *arguments):
        if name in self.faults:
            raise ZeroDivisionError(name)
        return getattr(Tame, name)(self, *arguments)

    return method


class Tame(Controller):
    """Claims given interfaces, exports one reference, and subscribes to one topic."""

    parameters_type = object
    is_chainable = True

    def __init__(self, name, command):
        super().__init__(ControllerContext(name, FakeLog()))
        self.faults = set()
        self.input = Input(Port('~/input', 'std_msgs/msg/Empty', 'nowhere:nothing'))
        self._request = InterfaceRequest.individual([command])
        self._reference = CommandInterface(name, 'x')

    def configure(self, parameters):
        pass

    def command_interfaces(self):
        return self._request

    def references(self):
        return (self._reference,)

    def inputs(self):
        return (self.input,)

    def activate(self, commands, states, time):
        pass

    def update(self, time, period):
        pass


Strange = type('Strange', (Tame,), {name: raising(name) for name in METHODS})


class Bench:
    """front → drive → joint a, rival → joint a, aside → joint b; some are others' fallbacks."""

    def __init__(self):
        self.manager = make_manager(FakeHardware(['a', 'b']))
        self.time = 0
        self.controllers = {
            name: Strange(name, command)
            for name, command in (
                ('front', 'drive/x'),
                ('drive', 'a/velocity'),
                ('rival', 'a/velocity'),
                ('aside', 'b/velocity'),
            )
        }
        fallbacks = {'front': ['rival'], 'drive': ['rival'], 'aside': ['front', 'drive']}
        for name, controller in self.controllers.items():
            self.manager.load(controller, 'a/Type', fallbacks.get(name, ()))
            self.manager.configure(name, None)

    def switch(self, activate=(), deactivate=(), strictness=Strictness.STRICT):
        self.manager.switch(activate, deactivate, strictness, self.time)

    def tick(self):
        self.time += PERIOD
        self.manager.tick(self.time)

    def check(self):
        """Only active controllers have claims, available references and open inputs."""
        claims, available = self.manager.resources.claims, self.manager.resources
        commands = available.available_commands()
        for loaded in self.manager.loaded:
            held = {name for name, holder in claims.items() if holder == loaded.name}
            assert held == (set(loaded.required_commands) if loaded.is_active else set())
            assert (f'{loaded.name}/x' in commands) == loaded.is_active
            assert loaded.controller.input.is_open == loaded.is_active

    @property
    def active(self):
        return {loaded.name for loaded in self.manager.loaded if loaded.is_active}


@pytest.mark.parametrize('seed', range(150))
def test_no_exception_of_a_plugin_stops_the_loop_or_leaves_a_claim(seed):
    chance = random.Random(seed)
    bench = Bench()
    names = list(bench.controllers)

    def some():
        return chance.sample(names, chance.randint(0, 3))

    asked = {
        'configure': lambda: bench.manager.configure(chance.choice(names), None),
        'cleanup': lambda: bench.manager.cleanup(chance.choice(names)),
        'switch': lambda: bench.switch(some(), some(), chance.choice(list(Strictness)[:2])),
    }
    always = {
        'break': lambda: bench.controllers[chance.choice(names)].faults.add(
            chance.choice(METHODS)
        ),
        'mend': lambda: bench.controllers[chance.choice(names)].faults.clear(),
        'tick': bench.tick,
        'reset': lambda: bench.manager.reset(bench.time),
        'set clock': lambda: bench.manager.set_clock(bench.time),
        'hardware': lambda: bench.manager.set_component_state(
            'hardware', chance.choice(list(LifecycleState)[1:4]), bench.time
        ),
    }
    for _ in range(60):
        what = chance.choice([*asked, *always, 'switch', 'tick', 'break'])
        if what in asked:
            with contextlib.suppress(ControllerError):
                asked[what]()
        else:
            always[what]()
        bench.check()
    bench.manager.shut_down(bench.time)
    bench.check()


def test_a_controller_whose_inputs_raise_is_not_configured():
    bench = Bench()
    bench.controllers['aside'].faults.add('inputs')
    with pytest.raises(ControllerError, match='ZeroDivisionError: inputs'):
        bench.manager.configure('aside', None)
    bench.check()


@pytest.mark.parametrize('method', ['command_interfaces', 'state_interfaces', 'inputs'])
def test_a_fallback_that_cannot_be_asked_again_starts_nevertheless(method):
    bench = Bench()
    bench.switch(['drive'])
    bench.controllers['drive'].faults.add('update')
    bench.controllers['rival'].faults.add(method)
    bench.tick()
    assert bench.active == {'rival'}
    bench.switch(deactivate=['rival'])
    assert bench.active == set()
    bench.check()


class UnspeakableError(Exception):
    def __str__(self):
        raise ValueError('not that either')


@pytest.mark.parametrize(
    ('error', 'text'),
    [
        (UnspeakableError(), 'its text cannot be formatted'),
        (ValueError('port \udcff'), r'port \udcff'),
    ],
)
def test_an_error_whose_text_cannot_be_formatted_is_logged(error, text):
    log = FakeLog()
    manager = make_manager(FakeHardware(['j']), log=log)
    controller = start(manager, FakeController())
    controller.faults['update'] = error
    manager.tick(0)
    assert manager.snapshot.active_controllers == ()
    errors = '\n'.join(log.texts(Severity.ERROR))
    assert text in errors
