# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A bench for controllers of wheeled robots: interfaces without hardware, and their samples."""

import math

from support.control_fakes import collect, FakeLog, MS

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.samples import TwistSample
from amr_description.parameters import build

PERIOD = 10 * MS


class WheelBench:
    """A configured and activated controller whose states are what is commanded, if ``follows``."""

    def __init__(self, controller_class, values, *, follows=True, chained=False, namespace='/'):
        self.log = FakeLog()
        self.follows = follows
        self.controller = controller_class(ControllerContext('drive', self.log, namespace))
        self.controller.configure(build(controller_class.parameters_type, values))
        self.sent = {port.port.name: collect(port) for port in self.controller.outputs()}
        self.time = 0
        commands = self.controller.command_interfaces().names
        self.commands = {name: CommandInterface(*name.split('/')) for name in commands}
        states = self.controller.state_interfaces().names
        self.states = {name: StateInterface(*name.split('/'), 0.0) for name in states}
        self.controller.set_chained_mode(chained)
        self.activate()

    def activate(self):
        self.controller.activate([*self.commands.values()], [*self.states.values()], self.time)
        for port in self.controller.inputs():
            port.open()

    def send(self, linear=0.0, lateral=0.0, angular=0.0, stamp=None):
        """Command on the topic; the stamp is that of the next update."""
        stamp = self.time + PERIOD if stamp is None else stamp
        sample = TwistSample(stamp, linear, angular, lateral=lateral)
        self.controller.inputs()[0].put(sample)

    def refer(self, *values):
        """Command as a preceding controller does."""
        for reference, value in zip(self.controller.references(), values, strict=True):
            reference.value = value

    def update(self, times=1, period=PERIOD):
        """Update; return what is commanded then."""
        for _ in range(times):
            self.time += period
            self.controller.update(self.time, period)
            if self.follows:
                self.follow(period)
        return self.commanded

    def follow(self, period):
        """Let the joints move as commanded."""
        for name, state in self.states.items():
            joint, interface = name.split('/')
            command = self.commands.get(name) or self.commands[f'{joint}/velocity']
            if math.isnan(command.value):
                continue
            if command.interface == interface:
                state.value = command.value
            else:
                state.value += command.value * period * 1e-9

    def drive(self, linear=0.0, lateral=0.0, angular=0.0, seconds=0.01):
        """Command a twist all the time, and return what is commanded then."""
        for _ in range(round(seconds * 1e9 / PERIOD)):
            self.send(linear, lateral, angular)
            self.update()
        return self.commanded

    @property
    def commanded(self):
        return tuple(command.value for command in self.commands.values())

    def pose(self, topic='~/odometry'):
        """Return x, y and heading of the latest odometry."""
        last = self.sent[topic][-1]
        return last.x, last.y, last.heading
