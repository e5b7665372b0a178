# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A diff_drive_controller without a robot: separation 1 m, radius 0.1 m, encoders at 0.1 and 0.2.

That is the bench of its upstream tests, with one wheel a side.
"""

from support.control_fakes import collect, FakeLog, MS

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import (
    CommandInterface,
    StateInterface,
)
from amr_description.control.samples import TwistSample
from amr_description.controllers.drives.diff_drive_controller import (
    DiffDriveController,
    DiffDriveParameters,
)
from amr_description.parameters import build

WHEELS = {'left_wheel_names': ['left_wheel'], 'right_wheel_names': ['right_wheel']}
SIZES = {'wheel_separation': 1.0, 'wheel_radius': 0.1}
PERIOD = 10 * MS


class Bench:
    """A configured controller, with interfaces."""

    def __init__(self, namespace='/', **values):
        self.log = FakeLog()
        self.controller = DiffDriveController(ControllerContext('drive', self.log, namespace))
        self.configure(**values)
        self.left, self.right = (
            CommandInterface(name, 'velocity') for name in ('left_wheel', 'right_wheel')
        )
        readings = {'position': (0.1, 0.2), 'velocity': (0.01, 0.02)}
        self.states = {
            interface: [
                StateInterface('left_wheel', interface, left),
                StateInterface('right_wheel', interface, right),
            ]
            for interface, (left, right) in readings.items()
        }
        self.time = 0

    def configure(self, **values):
        self.controller.configure(build(DiffDriveParameters, WHEELS | SIZES | values))
        ports = self.controller.outputs()
        self.odom, self.tf, *rest = (collect(port) for port in ports)
        self.limited = rest[0] if rest else None

    def activate(self, feedback='position', time=0, chained=False):
        states = self.states[feedback] if feedback else []
        self.controller.set_chained_mode(chained)
        self.controller.activate([self.left, self.right], states, time)
        for port in self.controller.inputs():
            port.open()
        self.time = time
        return self

    def deactivate(self):
        for port in self.controller.inputs():
            port.close()
        self.controller.deactivate(self.time)

    def refer(self, linear, angular):
        """Command as a preceding controller does."""
        for reference, value in zip(self.controller.references(), (linear, angular), strict=True):
            reference.value = value

    def send_unstamped(self, linear, angular=0.0):
        self.controller.inputs()[1].put(TwistSample(0, linear, angular))

    def send(self, linear, angular=0.0, stamp=None):
        stamp = self.time if stamp is None else stamp
        self.controller.inputs()[0].put(TwistSample(stamp, linear, angular))

    def update(self, period=PERIOD, times=1):
        for _ in range(times):
            self.time += period
            self.controller.update(self.time, period)
        return self.wheels

    def drive(self, linear, angular=0.0, period=PERIOD):
        self.send(linear, angular, self.time + period)
        return self.update(period)

    @property
    def wheels(self):
        return self.left.value, self.right.value
