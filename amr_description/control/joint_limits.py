# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The limits of a joint: the most restrictive of the URDF's ``<limit>`` and of the ``min`` and
``max`` parameters of its command interfaces.

Bounds of joint commands: what a joint may be told, and how a command is brought there.

The rules are those of ``joint_limits::JointSaturationLimiter`` of ros2_control, one joint at a
time. Two things are kept stricter: where two rules exclude each other (a joint too fast to stop
before its limit, say) the bound of the command itself wins, and a joint that stands beyond its
position limits is held or led back, not given up with an exception.
"""

from collections.abc import Mapping
from dataclasses import dataclass
import math
from typing import TYPE_CHECKING

from amr_description.control.contracts import Log, Severity
from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    EFFORT,
    JERK,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.loaded_component import LoadedComponent
from amr_description.errors import HardwareError
from amr_description.model.hardware_info import ComponentInfo, InterfaceInfo
from amr_description.model.robot import Joint, JointType

if TYPE_CHECKING:
    from amr_description.model.robot import Robot


@dataclass(frozen=True, slots=True)
class JointLimits:
    """
    What the commands of a joint are kept within, SI; ``None`` where there is no limit.

    All but ``position`` (lower, upper) are magnitudes. ``deceleration`` holds where a joint slows
    down, ``acceleration`` where it does not, or where there is no ``deceleration``.
    """

    position: tuple[float, float] | None = None
    velocity: float | None = None
    effort: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None
    jerk: float | None = None

    def __str__(self) -> str:
        """Those there are, for instance ``position [-1, 1], velocity 2``."""
        texts = []
        if self.position is not None:
            texts.append(f'position [{self.position[0]:g}, {self.position[1]:g}]')
        for name in ('velocity', 'effort', 'acceleration', 'deceleration', 'jerk'):
            value = getattr(self, name)
            if value is not None:
                texts.append(f'{name} {value:g}')
        return ', '.join(texts) or 'none'


def limits_of(info: ComponentInfo, joint: Joint | None) -> JointLimits:
    """
    Return the limits of the joint ``info`` whose URDF joint is ``joint``.

    A command interface with ``<limits enable="false"/>`` has none, of either source. A continuous
    joint has no position limits but those of its parameters. Raises HardwareError: no position
    satisfies both.
    """
    commands = {interface.name: interface for interface in info.command_interfaces}
    urdf = None if joint is None else joint.limit
    lower, upper = _magnitudes(commands.get(ACCELERATION))
    return JointLimits(
        position=_position_limits(info.name, commands.get(POSITION), joint),
        velocity=_magnitude(commands.get(VELOCITY), None if urdf is None else urdf.velocity),
        effort=_magnitude(commands.get(EFFORT), None if urdf is None else urdf.effort),
        acceleration=upper,
        deceleration=lower,
        jerk=_magnitude(commands.get(JERK), None),
    )


def _position_limits(
    name: str, interface: InterfaceInfo | None, joint: Joint | None
) -> tuple[float, float] | None:
    lowers, uppers = [], []
    if joint is not None and joint.limit is not None and joint.type is not JointType.CONTINUOUS:
        lowers.append(joint.limit.lower)
        uppers.append(joint.limit.upper)
    if interface is not None:
        if not interface.limits_enabled:
            return None
        lowers += [] if interface.min is None else [interface.min]
        uppers += [] if interface.max is None else [interface.max]
    if not lowers and not uppers:
        return None
    lower, upper = max(lowers, default=-float('inf')), min(uppers, default=float('inf'))
    if lower > upper:
        raise HardwareError(
            f"joint '{name}': no position is within all its limits; its <limit> and the "
            f'parameters min and max of its position command leave from {lower:g} to {upper:g}'
        )
    return lower, upper


def _magnitude(interface: InterfaceInfo | None, urdf: float | None) -> float | None:
    """Return the least of them: commands are bounded to both sides alike."""
    if interface is not None and not interface.limits_enabled:
        return None
    bounds = [abs(bound) for bound in (*_magnitudes(interface), urdf) if bound is not None]
    return min(bounds, default=None)


def _magnitudes(interface: InterfaceInfo | None) -> tuple[float | None, float | None]:
    if interface is None or not interface.limits_enabled:
        return None, None
    lower, upper = interface.min, interface.max
    return None if lower is None else abs(lower), None if upper is None else abs(upper)


POSITION_TOLERANCE = 0.002
"""rad or m beyond a position limit from which on no velocity is allowed any more."""


@dataclass(frozen=True, slots=True)
class JointState:
    """Where a joint is, as far as it is known; ``None`` stands for unknown."""

    position: float | None = None
    velocity: float | None = None


def limit_position(
    command: float, limits: JointLimits, state: JointState, before: float | None, dt: float
) -> float:
    """
    Return the position (rad or m) next to ``command`` that is within the limits and in reach.

    ``before``: the command of the cycle before, ``dt`` s ago; in reach is what the joint gets to
    from there at its greatest velocity.
    """
    reference = before if before is not None else state.position
    if limits.velocity is not None and reference is not None and dt > 0.0:
        speed = limits.velocity
        if limits.acceleration is not None:
            speed = min(speed, abs(state.velocity or 0.0) + limits.acceleration * dt)
        command = _clamp(command, reference - speed * dt, reference + speed * dt)
    return _clamp(command, *limits.position) if limits.position is not None else command


def limit_velocity(
    command: float, limits: JointLimits, state: JointState, before: float | None, dt: float
) -> float:
    """
    Return the velocity (rad/s or m/s) next to ``command`` that is allowed for the next ``dt`` s.

    It is at most one step of acceleration from ``before``, the velocity commanded the cycle
    before, and does not lead beyond a position limit.
    """
    if before is None:
        before = state.velocity
    if limits.acceleration is not None and before is not None and dt > 0.0:
        step = limits.acceleration * dt
        command = _clamp(command, before - step, before + step)
    if limits.position is not None and state.position is not None and dt > 0.0:
        command = _keep_inside(command, limits.position, state.position, dt)
    return _within(command, limits.velocity)


def _keep_inside(
    velocity: float, bounds: tuple[float, float], position: float, dt: float
) -> float:
    lower, upper = bounds
    beyond = max(lower - position, position - upper)
    outwards = velocity >= 0.0 if position > upper else velocity <= 0.0
    if beyond > POSITION_TOLERANCE or (beyond > 0.0 and outwards):
        return 0.0
    return _clamp(velocity, (lower - position) / dt, (upper - position) / dt)


def limit_effort(command: float, limits: JointLimits, state: JointState) -> float:
    """
    Return the effort (N·m or N) next to ``command`` that is allowed.

    None pushes beyond a position limit, or a joint that is too fast already.
    """
    lower, upper = -math.inf, math.inf
    position, velocity = state.position, state.velocity
    if limits.position is not None and position is not None and velocity is not None:
        if position <= limits.position[0] and velocity <= 0.0:
            lower = 0.0
        elif position >= limits.position[1] and velocity >= 0.0:
            upper = 0.0
    if limits.velocity is not None and velocity is not None:
        if velocity < -limits.velocity:
            lower = 0.0
        elif velocity > limits.velocity:
            upper = 0.0
    return _within(_clamp(command, lower, upper), limits.effort)


def limit_acceleration(command: float, limits: JointLimits, state: JointState) -> float:
    """Return the acceleration (rad/s² or m/s²) next to ``command`` that is allowed."""
    brakes = command * (state.velocity or 0.0) < 0.0
    if brakes and limits.deceleration is not None:
        return _within(command, limits.deceleration)
    return _within(command, limits.acceleration)


class JointLimiter:
    """The limiter of one joint: brings its command cells within its limits, once a cycle."""

    def __init__(
        self,
        joint: str,
        limits: JointLimits,
        commands: Mapping[str, CommandInterface],
        states: Mapping[str, StateInterface],
        log: Log,
    ) -> None:
        """``commands``, ``states``: the cells of its hardware component, by their names."""
        self.limits = limits
        self._joint = joint
        self._log = log
        own = (command for command in commands.values() if command.prefix == joint)
        self._commands = [c for c in own if c.data_type in ('double', 'float32')]
        self._states = {s.interface: s for s in states.values() if s.prefix == joint}
        self._before: dict[str, float | None] = {}

    def enforce(self, dt: float) -> None:
        """Bound the commands for the next ``dt`` s; one that is not set stays so."""
        state = JointState(self._known(POSITION), self._known(VELOCITY))
        for cell in self._commands:
            if not cell.is_set:
                self._before[cell.interface] = None
                continue
            limited = self._limited(cell.interface, cell.value, state, dt)
            if limited != cell.value:
                self._tell(cell, limited)
                cell.value = limited
            self._before[cell.interface] = limited if math.isfinite(limited) else None

    def reset(self) -> None:
        """Forget what was commanded before."""
        self._before.clear()

    def _limited(self, interface: str, value: float, state: JointState, dt: float) -> float:
        limits, before = self.limits, self._before.get(interface)
        match interface:
            case 'position':
                return limit_position(value, limits, state, before, dt)
            case 'velocity':
                return limit_velocity(value, limits, state, before, dt)
            case 'effort':
                return limit_effort(value, limits, state)
            case 'acceleration':
                return limit_acceleration(value, limits, state)
            case 'jerk':
                return _within(value, limits.jerk)
        return value

    def _known(self, interface: str) -> float | None:
        cell = self._states.get(interface)
        return cell.value if cell is not None and math.isfinite(cell.value) else None

    def _tell(self, cell: CommandInterface, limited: float) -> None:
        self._log(
            Severity.ERROR,
            f"Command of at least one joint is out of limits. Joint: '{self._joint}', "
            f'{cell.interface} command {cell.value:g} limited to {limited:g}; its limits are '
            f'{self.limits}',
            throttle=1.0,
        )


def limiters_of(owned: LoadedComponent, robot: 'Robot | None', log: Log) -> list[JointLimiter]:
    """
    Make a limiter for every joint of a component, and tell of each, as ros2_control does.

    Raises HardwareError: no command satisfies the limits of a joint.
    """
    limiters = []
    for info in owned.info.joints:
        has_joint = robot is not None and robot.has_joint(info.name)
        limits = limits_of(info, robot.joint(info.name) if has_joint else None)
        log(
            Severity.INFO,
            f"Using JointLimiter for joint '{info.name}' in hardware '{owned.info.name}' : "
            f'{limits}',
        )
        limiters.append(JointLimiter(info.name, limits, owned.commands, owned.states, log))
    return limiters


def value_at_rest(interface: str) -> float:
    """Return the command with which a joint stands still: 0.0, or none where it is not known."""
    return 0.0 if interface in (VELOCITY, EFFORT, ACCELERATION, JERK) else math.nan


def _clamp(value: float, lower: float, upper: float) -> float:
    return min(max(value, lower), upper)


def _within(value: float, bound: float | None) -> float:
    return value if bound is None else _clamp(value, -bound, bound)
