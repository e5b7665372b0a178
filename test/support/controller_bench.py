# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller without a manager: configured, with its interfaces, inputs and outputs."""

from support.control_fakes import collect, FakeLog, MS

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.controllers import CONTROLLERS
from amr_description.parameters import build

PERIOD = 10 * MS


class ControllerBench:
    """A configured controller of a type; ``__`` in the names of parameters stands for a dot."""

    def __init__(self, kind, *, name='it', robot=None, **values):
        found = CONTROLLERS.find(kind)
        self.log, self.time = FakeLog(), 0
        self.controller = found(ControllerContext(name, self.log, robot=robot))
        table = {key.replace('__', '.'): value for key, value in values.items()}
        self.controller.configure(build(found.parameters_type, table))
        self.sent = {each.port.name: collect(each) for each in self.controller.outputs()}
        self.commands, self.states = [], []

    def activate(self, states=None, value=0.0):
        """Activate with these states, else with those it asks for, all of a value; open inputs."""
        names = self.controller.command_interfaces().names
        if not self.commands:  # another activation finds the same
            self.commands = [CommandInterface(*each.split('/', 1)) for each in names]
        if states is None:
            names = self.controller.state_interfaces().names
            states = [StateInterface(*each.rsplit('/', 1), value) for each in names]
        self.states = states
        self.controller.activate(self.commands, self.states, self.time)
        for port in self.controller.inputs():
            port.open()

    def update(self, count=1):
        """Update, every 10 ms; return the commands."""
        for _ in range(count):
            self.time += PERIOD
            self.controller.update(self.time, PERIOD)
        return [command.value for command in self.commands]
