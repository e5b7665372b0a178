# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Fakes of hardware, controllers and logs, and the recorded vectors and traces."""

from collections import Counter
import gzip
import json
import math

from support.paths import TESTS

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import (
    Controller,
    ControllerContext,
    HardwareComponent,
    Output,
    Port,
)
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    StateInterface,
)
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness
from amr_description.log import Severity
from amr_description.model.hardware_info import HardwareInfo, HardwareType

FIXTURES = TESTS / 'fixtures' / 'control'
VECTORS = json.loads((FIXTURES / 'vectors.json').read_text())
TRACES = sorted(path.name.removesuffix('.json.gz') for path in FIXTURES.glob('traces/*.json.gz'))
LEFT = ('joint_wheel_front_left', 'joint_wheel_back_left')
RIGHT = ('joint_wheel_front_right', 'joint_wheel_back_right')
WHEELS = LEFT + RIGHT
MS = 1_000_000
"""ns."""


def load_trace(name):
    """A lock-step recording of diff_drive_controller and joint_state_broadcaster 4.x, 100 Hz."""
    return json.loads(gzip.decompress((FIXTURES / 'traces' / f'{name}.json.gz').read_bytes()))


def nan_for_none(values):
    return [math.nan if value is None else value for value in values]


class FakeLog:
    """Keeps every line, without throttling."""

    def __init__(self):
        self.lines = []

    def __call__(self, severity, text, *, throttle=0.0):
        self.lines.append((severity, text))

    def texts(self, severity=Severity.DEBUG):
        """The lines; not the tracebacks, which name the calls on the way."""
        return [
            text
            for level, text in self.lines
            if level >= severity and not text.startswith('Traceback')
        ]


class Faulty:
    """Records every call of a method, and raises what ``faults`` has under its name."""

    def call(self, method, *arguments):
        self.calls.append((method, *arguments))
        error = self.faults.get(method)
        if error is not None:
            raise error

    def count(self, method):
        return Counter(call[0] for call in self.calls)[method]


class FakeHardware(Faulty, HardwareComponent):
    """
    Wheels without physics: at every read the velocity is the last command, and the position
    follows it.
    """

    def __init__(
        self, joints=WHEELS, name='hardware', log=None, type=HardwareType.SYSTEM, **attributes
    ):
        info = HardwareInfo(name, type, 'a/Fake', **attributes)
        super().__init__(info, log or FakeLog(), None)
        self.faults, self.calls = {}, []
        self.commands = {j: CommandInterface(j, 'velocity') for j in joints}
        self.positions = {j: StateInterface(j, 'position', 0.0) for j in joints}
        self.velocities = {j: StateInterface(j, 'velocity', 0.0) for j in joints}
        self.written = {}

    def state_interfaces(self):
        return [*self.positions.values(), *self.velocities.values()]

    def command_interfaces(self):
        return list(self.commands.values())

    def configure(self):
        self.call('configure')

    def activate(self):
        self.call('activate')

    def deactivate(self):
        self.call('deactivate')

    def cleanup(self):
        self.call('cleanup')

    def shutdown(self):
        self.call('shutdown')

    def reset(self, time):
        self.call('reset', time)

    def prepare_command_mode_switch(self, start, stop):
        self.call('prepare', tuple(start), tuple(stop))

    def perform_command_mode_switch(self, start, stop):
        self.call('perform', tuple(start), tuple(stop))

    def read(self, time, period):
        self.call('read')
        for joint, command in self.commands.items():
            if not math.isnan(command.value):
                self.velocities[joint].value = command.value
            self.positions[joint].value += self.velocities[joint].value * (period / NANOSECONDS)

    def write(self, time, period):
        self.call('write')
        self.written = {joint: command.value for joint, command in self.commands.items()}


class FakeController(Faulty, Controller):
    """Claims the given interfaces, and writes its update count into every command."""

    parameters_type = object

    def __init__(self, name='fake', commands=(), states=(), log=None, update_rate=100):
        super().__init__(ControllerContext(name, log or FakeLog(), update_rate=update_rate))
        self.faults, self.calls = {}, []
        self.requests = InterfaceRequest.individual(commands), InterfaceRequest.individual(states)
        self.handles = ()
        self.updates = []
        """(time, period) of each, ns."""

    def configure(self, parameters):
        self.call('configure', parameters)

    def command_interfaces(self):
        return self.requests[0]

    def state_interfaces(self):
        return self.requests[1]

    def activate(self, commands, states, time):
        self.call('activate')
        self.handles = commands

    def update(self, time, period):
        self.call('update')
        self.updates.append((time, period))
        for handle in self.handles:
            handle.value = float(len(self.updates))

    def deactivate(self, time):
        self.call('deactivate')
        for handle in self.handles:
            handle.value = 0.0
        self.handles = ()

    def cleanup(self):
        self.call('cleanup')

    def reset(self, time):
        self.call('reset', time)

    def set_clock(self, time):
        self.call('set_clock', time)


class FakeChainable(FakeController):
    """Exports references and states; chained, its commands are the sum of its references."""

    is_chainable = True

    def __init__(self, name, commands=(), states=(), references=('x',), exports=(), **options):
        super().__init__(name, commands, states, **options)
        self.offers = (
            tuple(CommandInterface(name, each) for each in references),
            tuple(StateInterface(name, each) for each in exports),
        )
        self.modes = []
        """Whether it was chained, at each update."""

    def references(self):
        return self.offers[0]

    def exported_states(self):
        return self.offers[1]

    def set_chained_mode(self, is_chained):
        self.call('set_chained_mode', is_chained)
        super().set_chained_mode(is_chained)

    def update(self, time, period):
        super().update(time, period)
        self.modes.append(self.is_chained)
        if self.is_chained:
            for handle in self.handles:
                handle.value = sum(r.value for r in self.references() if not math.isnan(r.value))


def bring_up(*components):
    """Return a resource manager with these components, active."""
    resources = ResourceManager(FakeLog())
    for component in components:
        resources.add(component)
        resources.set_state(component.info.name, LifecycleState.ACTIVE)
    return resources


def make_manager(*components, rate=100, log=None):
    return ControllerManager(bring_up(*components), rate, log or FakeLog())


def start(manager, controller, parameters=None, time=0):
    """Load, configure and activate; return the controller."""
    manager.load(controller, 'a/Type')
    manager.configure(controller.context.name, parameters)
    manager.switch([controller.context.name], [], Strictness.STRICT, time)
    return controller


def collect(output):
    """Return a list that fills with the samples of an output."""
    sent = []
    output.sink = sent.append
    return sent


def output():
    return Output(Port('~/output', 'std_msgs/msg/Empty', 'nowhere:nothing'))
