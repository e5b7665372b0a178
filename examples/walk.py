# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Four legs that trot, by a policy of one's own: ``python examples/walk.py``.

:class:`Walker` is a controller as any other: it is told what the robot measures, by name, fifty
times a second, and answers with the positions of twelve joints. The policy here is a trot that is
written by hand; one that was learned takes its place in :func:`policy`. The description,
``quadruped.urdf.xacro``, has links and joints only.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math
from pathlib import Path

from amr_description import Simulation
from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Controller
from amr_description.control.interfaces import (
    CommandInterface,
    IMU_INTERFACES,
    InterfaceRequest,
    POSITION,
    StateInterface,
)
from amr_description.parameters import parameter

HERE = Path(__file__).parent
LEGS = ('front_left', 'front_right', 'rear_left', 'rear_right')
PARTS = ('hip', 'thigh', 'calf')
JOINTS = tuple(f'{leg}_{part}_joint' for leg in LEGS for part in PARTS)
IMU = 'imu'

LENGTH = 0.16
"""m, of a thigh and of a calf."""
HEIGHT, STEP, LIFT = 0.26, 0.08, 0.04
"""m: of the hips above the feet; how far and how high a foot steps."""
PERIOD = 0.4
"""s of two steps: those of two legs across each other, then those of the others."""
GET_UP = 1.0
"""s from the pose it has at first until it trots."""
LARGEST_TILT = 0.7
"""rad; a robot that leans further keeps its joints where they are."""


def policy(observed: Mapping[str, float], time: float, speed: float) -> dict[str, float]:
    """
    Return where the joints are to be, rad, by name.

    Args:
        observed: What is measured: ``imu/orientation.x``, ``front_left_hip_joint/position``, …
        time: s since it was switched on.
        speed: As a share of the fastest; below 0 backwards.
    """
    if tilt(observed) > LARGEST_TILT:
        return {name: observed[f'{name}/{POSITION}'] for name in JOINTS}
    share = min(1.0, time / GET_UP)
    wanted: dict[str, float] = {}
    for index, leg in enumerate(LEGS):
        phase = (time / PERIOD + (0.0 if index in (0, 3) else 0.5)) % 1.0
        ahead, up = foot(phase, speed) if share == 1.0 else (0.0, 0.0)
        height = HEIGHT if share == 1.0 else HEIGHT + (1.0 - share) * (2.0 * LENGTH - HEIGHT)
        angles = (0.0, *bent(ahead, up - height))
        wanted |= {f'{leg}_{part}_joint': angle for part, angle in zip(PARTS, angles, strict=True)}
    return wanted


def tilt(observed: Mapping[str, float]) -> float:
    """Return the angle between the robot's z axis and the vertical, rad."""
    x, y = (observed[f'{IMU}/orientation.{axis}'] for axis in 'xy')
    return math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (x * x + y * y))))


def foot(phase: float, speed: float) -> tuple[float, float]:
    """Return where a foot is ahead of its hip and above the ground, m; it pushes until 0.5."""
    if phase < 0.5:
        return speed * STEP * (0.5 - 2.0 * phase), 0.0
    swing = 2.0 * phase - 1.0
    return speed * STEP * (swing - 0.5), LIFT * math.sin(math.pi * swing)


def bent(ahead: float, up: float) -> tuple[float, float]:
    """Return the angles of thigh and calf, rad, of a foot ahead of the hip and above it, m."""
    square = ahead * ahead + up * up
    calf = -math.acos(max(-1.0, min(1.0, square / (2.0 * LENGTH * LENGTH) - 1.0)))
    return math.atan2(-ahead, -up) - calf / 2.0, calf


@dataclass(frozen=True)
class WalkerParameters:
    """What the parameter file may say of it."""

    joints: tuple[str, ...] = parameter(JOINTS, 'What it moves', not_empty=True)
    speed: float = parameter(1.0, 'As a share of the fastest', minimum=-1.0, maximum=1.0)


class Walker(Controller):
    """Asks the policy, and writes what it answers."""

    parameters_type = WalkerParameters

    def configure(self, parameters: WalkerParameters) -> None:
        """Take over the parameters."""
        self._joints, self._speed = parameters.joints, parameters.speed
        self._commands: Sequence[CommandInterface] = ()
        self._states: Sequence[StateInterface] = ()
        self._began = 0

    def command_interfaces(self) -> InterfaceRequest:
        """Return the positions of all joints."""
        return InterfaceRequest.individual(f'{name}/{POSITION}' for name in self._joints)

    def state_interfaces(self) -> InterfaceRequest:
        """Return what the policy is told."""
        imu = (f'{IMU}/{each}' for each in IMU_INTERFACES)
        return InterfaceRequest.individual([*imu, *self.command_interfaces().names])

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Begin to get up."""
        self._commands, self._states, self._began = commands, states, time

    def update(self, time: int, period: int) -> None:
        """Tell it what is measured, do what it says."""
        observed = {each.name: each.value for each in self._states}
        wanted = policy(observed, (time - self._began) / NANOSECONDS, self._speed)
        for command in self._commands:
            command.value = wanted[command.prefix]

    def deactivate(self, time: int) -> None:
        """Leave the joints where they are: the hardware holds them."""
        self._commands = ()

    def reset(self, time: int) -> None:
        """Get up again."""
        self._began = time


def main() -> None:
    """Walk for five seconds, and say how far it came."""
    with Simulation(HERE / 'quadruped.urdf.xacro', controllers=HERE / 'quadruped.yaml') as sim:
        for second in range(1, 6):
            sim.run(1.0)
            truth = sim.truth
            print(f'{second} s: {truth.x:.2f} m ahead, {truth.y:.2f} aside, hips {truth.z:.2f} up')


if __name__ == '__main__':
    main()
