# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A metre forward, a quarter turn, and sideways where wheels can: command, truth and odometry.

Measured at a steady speed: the robot is under way before the measurement begins, so that limits of
acceleration, which the parameters may set as they like, do not count. A robot that gets nowhere
near the speed that it is asked for, be it by its odometry or in truth (odometry may be that of the
command), is asked for 80 % of what it reaches.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import Any, TypeAlias

from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry

from amr_description.errors import AmrError
from amr_description.model.frames import conjugate, rotate, yaw_of
from amr_description.simulation.readings import Motion
from amr_description.testing.lock_step import LatestMessage
from amr_description.testing.readings import motion_of_odometry
from amr_description.testing.simulation import Simulation
from amr_description.testing.trial.bring_up import Active, topics_of
from amr_description.testing.trial.findings import MotionResult
from amr_description.testing.trial.verdict import TOLERANCE

_TYPES: dict[str, Any] = {
    'geometry_msgs/msg/TwistStamped': TwistStamped,
    'geometry_msgs/msg/Twist': Twist,
}
_ODOMETRY = 'nav_msgs/msg/Odometry'
_SPEED, _TURN = 0.3, 0.5
"""m/s and rad/s."""
_RADIUS = 4.0
"""m, of the arc of a robot that cannot turn on the spot."""
_PERIOD = 0.1
"""s between two commands."""
_NOWHERE_NEAR = 0.95
"""
Of the speed that is asked: what reaches less is asked for less than it reaches. One with a limit
of its own then moves as told, one whose wheels slip or are of another size does not, as before.
"""
_SLOWEST = 1e-3
"""m/s or rad/s; what is slower does not move."""
_LONGEST_START, _LONGEST_STRETCH, _LONGEST_STOP = 10.0, 60.0, 10.0
"""s of simulated time."""

_STEERED = ('Ackermann', 'Bicycle', 'Tricycle', 'Steering')
_SIDEWAYS = ('Mecanum', 'Omni', 'Planar')

Command: TypeAlias = tuple[float, float, float]
"""Forward and to the left in m/s, turn to the left in rad/s."""


@dataclass(frozen=True)
class Displacement:
    """Where a robot has got to from where it was: m in its old axes, and rad."""

    ahead: float
    left: float
    turn: float


def travel(start: Motion, end: Motion) -> Displacement:
    """Return the way between two readings."""
    way = [b - a for a, b in zip(start.pose.translation, end.pose.translation, strict=True)]
    back = conjugate(start.pose.rotation)
    ahead, left, _ = rotate(back, (way[0], way[1], way[2]))
    turn = yaw_of(end.pose.rotation) - yaw_of(start.pose.rotation)
    return Displacement(ahead, left, math.remainder(turn, math.tau))


class DriveTrial:
    """What is driven: a topic of an active controller, with its type, and its odometry."""

    def __init__(
        self,
        sim: Simulation,
        controller: Active,
        active: Sequence[Active] = (),
        wheelbase: float = 0.0,
    ) -> None:
        """
        Find the topics.

        Args:
            sim: The simulation.
            controller: Whose topic of commands it is.
            active: All; what drives is among these if the controller commands its references.
            wheelbase: m, of a car that takes angular.z as the angle of its tyres; 0: as a turn.

        Raises:
            LookupError: The controller subscribes to no Twist.
        """
        commanded = {each.partition('/')[0] for each in controller.claimed}
        self._drive = next((each for each in active if each.name in commanded), controller)
        self._sim = sim
        self._wheelbase = wheelbase
        node = sim.node
        found = topics_of(sim, node.get_subscriber_names_and_types_by_node, controller, _TYPES)
        if not found:
            raise LookupError(f'{controller.name} subscribes to no Twist')
        self.topic, kind = found[0]
        self._type = _TYPES[kind]
        published = node.get_publisher_names_and_types_by_node
        topics = topics_of(sim, published, self._drive, (_ODOMETRY,))
        self._odometry = LatestMessage(node, Odometry, topics[0][0]) if topics else None

    @property
    def parts(self) -> dict[str, tuple[Command, float]]:
        """Return what is driven: command, and how far in m or rad."""
        kind = self._drive.type
        sideways = any(word in kind for word in _SIDEWAYS)
        arc = any(word in kind for word in _STEERED) and not sideways
        turn = (_SPEED, 0.0, _SPEED / _RADIUS) if arc else (0.0, 0.0, _TURN)
        return {
            'forward': ((_SPEED, 0.0, 0.0), 1.0),
            'turn': (turn, math.pi / 2),
            **({'sideways': ((0.0, _SPEED, 0.0), 0.5)} if sideways else {}),
        }

    def try_all(self) -> list[MotionResult]:
        """DriveTrial all parts; one that fails to be commanded ends it."""
        found = []
        for what, (command, far) in self.parts.items():
            try:
                found.append(self._try(what, command, far))
            except AmrError as error:
                found.append(self._motion(what, far, None, None, f'{error}'))
                break
        return found

    def close(self) -> None:
        """Stop listening."""
        if self._odometry is not None:
            self._odometry.close()

    def _try(self, what: str, command: Command, far: float) -> MotionResult:
        """DriveTrial one part."""
        axis = {'forward': 0, 'sideways': 1, 'turn': 2}[what]
        full = command[axis]
        reached = self._start(command, axis)
        if reached < _SLOWEST:
            speeds = ', '.join(
                f'{name} {_speed_of(reading, axis):.3f}'
                for name, reading in zip(('truth', 'odometry'), self._readings(), strict=True)
                if reading is not None
            )
            self._stop()
            note = f'commanded {full:g}, it does not move: {speeds}'
            return self._motion(what, far, 0.0, None, note)
        note = ''
        if reached < _NOWHERE_NEAR * full:
            scale = 0.8 * reached / full
            note = f'it reaches {reached:.3f} of {full:g} (m/s, rad/s); asked {0.8 * reached:.3f}'
            command = (command[0] * scale, command[1] * scale, command[2] * scale)
            far = min(far, command[axis] * _LONGEST_STRETCH)
            self._start(command, axis)
        begin, begin_odometry = self._sim.truth, self._read_odometry()
        self._command(command, far / command[axis])
        end, end_odometry = self._sim.truth, self._read_odometry()
        self._stop()
        truth = travel(begin, end)
        measured = None
        if begin_odometry is not None and end_odometry is not None:
            way = travel(begin_odometry, end_odometry)
            # Odometry is some cycles old, at a steady speed by the same share of the way.
            passed = end_odometry.time - begin_odometry.time
            share = (end.time - begin.time) / passed if passed > 0.0 else math.nan
            measured = _along(way, axis) * share
        if axis < 2 and abs(truth.turn) > TOLERANCE:
            note = f'{note + "; " if note else ""}it turns by {truth.turn:+.3f} rad meanwhile'
        return self._motion(what, far, _along(truth, axis), measured, note)

    def _motion(
        self, what: str, far: float, truth: float | None, odometry: float | None, note: str
    ) -> MotionResult:
        is_fine = truth is not None and abs(truth - far) <= TOLERANCE * far
        return MotionResult(self._drive.name, what, far, truth, odometry, is_fine, note)

    def _start(self, command: Command, axis: int) -> float:
        """Command until the speed along an axis is steady; return its amount."""
        last = math.nan
        end = self._sim.time + _LONGEST_START
        while self._sim.time < end:
            self._command(command, 0.5)
            speed = self._speed(axis)
            wanted = command[axis]
            if abs(speed - wanted) < 0.01 * wanted or abs(speed - last) < 0.01 * speed:
                break
            last = speed
        return speed

    def _speed(self, axis: int) -> float:
        """Return the amount of the speed along an axis: the lesser of odometry and truth."""
        return min(abs(_speed_of(each, axis)) for each in self._readings() if each is not None)

    def _readings(self) -> tuple[Motion, Motion | None]:
        """Return truth and odometry."""
        return self._sim.truth, self._read_odometry()

    def _read_odometry(self) -> Motion | None:
        message = self._odometry.take() if self._odometry is not None else None
        return None if message is None else motion_of_odometry(message)

    def _command(self, command: Command, seconds: float) -> None:
        """Command for a time, ten times a second."""
        left = seconds
        while left > 1e-9:
            self._sim.send(self.topic, self._message(command))
            self._sim.run(min(left, _PERIOD))
            left -= _PERIOD

    def _stop(self) -> None:
        end = self._sim.time + _LONGEST_STOP
        while self._sim.time < end:
            self._command((0.0, 0.0, 0.0), 5 * _PERIOD)
            if not self._sim.robot.is_moving:
                return

    def _message(self, command: Command) -> Any:
        message = self._type()
        twist = message.twist if self._type is TwistStamped else message
        speed, sideways, turn = command
        if self._wheelbase and speed:
            turn = math.atan(self._wheelbase * turn / speed)
        twist.linear.x, twist.linear.y, twist.angular.z = speed, sideways, turn
        return message


def _speed_of(reading: Motion, axis: int) -> float:
    return (reading.linear[0], reading.linear[1], reading.angular[2])[axis]


def _along(way: Displacement, axis: int) -> float:
    return (way.ahead, way.left, way.turn)[axis]
