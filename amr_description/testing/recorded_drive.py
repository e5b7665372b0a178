# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A controller that drives a winding course and records every state interface, bit by bit.

It commands a diff_drive_controller in the control loop itself, at the simulated times of its
updates, so that runs at any real-time factor have the same commands at the same instants::

    recorded_drive:
      ros__parameters:
        type: amr_description.testing.recorded_drive/RecordedDrive
        seconds: 30.0
        log: /tmp/first.log
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from pathlib import Path
import struct
from typing import BinaryIO

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Controller
from amr_description.control.interfaces import (
    ALL_INTERFACES,
    CommandInterface,
    InterfaceRequest,
    StateInterface,
    VELOCITY,
)
from amr_description.parameters import parameter


@dataclass(frozen=True)
class RecordedDriveParameters:
    """See the module."""

    log: str = parameter('', 'The file to write, below another name until it is complete')
    seconds: float = parameter(
        30.0, 'Length of the drive', unit='s', above=0.0, magnitude=(1e-3, 1e6)
    )
    follower: str = parameter('diff_drive_controller', 'The controller to command')


class RecordedDrive(Controller):
    """Each update is a record: time (ns, int64), then every state interface (double)."""

    parameters_type = RecordedDriveParameters
    _file: BinaryIO | None = None

    def configure(self, parameters: RecordedDriveParameters) -> None:
        """Store the parameters."""
        self._parameters = parameters

    def command_interfaces(self) -> InterfaceRequest:
        """Request the references of the follower."""
        follower = self._parameters.follower
        return InterfaceRequest.individual(
            [f'{follower}/linear/{VELOCITY}', f'{follower}/angular/{VELOCITY}']
        )

    def state_interfaces(self) -> InterfaceRequest:
        """Request all of the hardware: of joints and of sensors."""
        return ALL_INTERFACES

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Open the log."""
        self._linear, self._angular = commands
        self._states = states
        self._begin = time
        self._record = struct.Struct(f'<q{len(states)}d')
        self._file = self._path('.part').open('wb')

    def update(self, time: int, period: int) -> None:
        """Record the states; then command a weaving drive, to and fro."""
        passed = (time - self._begin) / NANOSECONDS
        if self._file is None:
            return
        self._file.write(self._record.pack(time, *(state.value for state in self._states)))
        self._linear.value = 0.6 * math.cos(0.4 * passed)
        self._angular.value = 1.2 * math.sin(1.7 * passed)
        if passed >= self._parameters.seconds:
            self.deactivate(time)
            self._path('.part').rename(self._path(''))

    def reset(self, time: int) -> None:
        """Start the log again."""
        self._begin = time
        if self._file is not None:
            self._file.seek(0)
            self._file.truncate()

    def deactivate(self, time: int) -> None:
        """Stop, and close the log."""
        self._linear.value = self._angular.value = 0.0
        if self._file is not None:
            self._file.close()
            self._file = None

    def _path(self, ending: str) -> Path:
        return Path(self._parameters.log + ending)
