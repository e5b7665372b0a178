# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The limits of joints, and how commands are kept within them.

The limits of a joint are the most restrictive of the URDF's ``<limit>`` and of the ``min`` and
``max`` parameters of its command interfaces.

The rules are those of ``joint_limits::JointSaturationLimiter`` of ros2_control, one joint at a
time, with two differences: if two rules exclude each other (a joint too fast to stop before its
limit, for instance) the limit of the commanded quantity itself wins, and a joint beyond its
position limits is held or brought back, instead of failing with an exception.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
import math
import sys

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
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import ComponentInfo, InterfaceInfo
from amr_description.model.robot import Joint, JointType, Robot

POSITION_TOLERANCE = 0.002
"""rad or m: a joint that is farther beyond a position limit must not move at all."""

ANY_NUMBER = (-sys.float_info.max, sys.float_info.max)
"""The range of the commands that are finite."""


@dataclass(frozen=True, slots=True)
class JointLimits:
    """
    The limits of a joint, SI; None: no limit.

    All but ``position`` (lower, upper) are magnitudes. ``deceleration`` applies while a joint
    slows down, ``acceleration`` otherwise, or without a ``deceleration``.
    """

    position: tuple[float, float] | None = None
    velocity: float | None = None
    effort: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None
    jerk: float | None = None

    def __str__(self) -> str:
        """Return for instance ``position [-1, 1], velocity 2``."""
        texts = []
        if self.position is not None:
            texts.append(f'position [{self.position[0]:g}, {self.position[1]:g}]')
        for name in ('velocity', 'effort', 'acceleration', 'deceleration', 'jerk'):
            value = getattr(self, name)
            if value is not None:
                texts.append(f'{name} {value:g}')
        return ', '.join(texts) or 'none'


@dataclass(frozen=True, slots=True)
class JointState:
    """The measured state of a joint, rad or m, rad/s or m/s; None: unknown."""

    position: float | None = None
    velocity: float | None = None


class JointLimiter:
    """Keeps the commands of one joint within its limits, once a cycle."""

    def __init__(
        self,
        joint: str,
        limits: JointLimits,
        commands: Mapping[str, CommandInterface],
        states: Mapping[str, StateInterface],
        log: Log,
    ) -> None:
        """
        Take a joint.

        Args:
            joint: its name.
            limits: of the joint.
            commands: all command interfaces of its hardware component.
            states: all state interfaces of its hardware component.
            log: for commands beyond the limits.
        """
        self.limits = limits
        self._joint = joint
        self._log = log
        own = (command for command in commands.values() if command.prefix == joint)
        self._commands = [c for c in own if c.data_type in ('double', 'float32')]
        self._states = {s.interface: s for s in states.values() if s.prefix == joint}
        self._before: dict[str, float | None] = {}

    def enforce(self, dt: float) -> None:
        """Limit the commands for the next ``dt`` s; those that are not set stay so."""
        state = JointState(self._measured(POSITION), self._measured(VELOCITY))
        for command in self._commands:
            if not command.is_set:
                self._before[command.interface] = None
                continue
            limited = self._limited(command.interface, command.value, state, dt)
            if limited != command.value:
                self._log_limited(command, limited)
                command.value = limited
            self._before[command.interface] = limited if math.isfinite(limited) else None

    def fixed_bounds(self) -> dict[str, tuple[float, float]] | None:
        """
        Return the range of each command, by name, if nothing else limits them; else None.

        Within it :meth:`enforce` changes nothing: neither the state of the joint counts, nor what
        was commanded before.
        """
        limits = self.limits
        has_position, has_speed = limits.position is not None, limits.velocity is not None
        depends = {
            POSITION: has_speed,
            VELOCITY: has_position or limits.acceleration is not None,
            EFFORT: has_position or has_speed,
            ACCELERATION: limits.deceleration is not None,
        }
        if any(depends.get(command.interface) for command in self._commands):
            return None
        return {command.name: self._range_of(command.interface) for command in self._commands}

    def _range_of(self, interface: str) -> tuple[float, float]:
        limits = self.limits
        if interface == POSITION:
            return limits.position or ANY_NUMBER
        bounds = {
            VELOCITY: limits.velocity,
            EFFORT: limits.effort,
            ACCELERATION: limits.acceleration,
            JERK: limits.jerk,
        }
        bound = bounds.get(interface)
        return ANY_NUMBER if bound is None else (-bound, bound)

    def reset(self) -> None:
        """Forget the previous commands."""
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

    def _measured(self, interface: str) -> float | None:
        state = self._states.get(interface)
        return state.value if state is not None and math.isfinite(state.value) else None

    def _log_limited(self, command: CommandInterface, limited: float) -> None:
        self._log(
            Severity.ERROR,
            f"Command of at least one joint is out of limits. Joint: '{self._joint}', "
            f'{command.interface} command {command.value:g} limited to {limited:g}; its limits '
            f'are {self.limits}',
            throttle=1.0,
        )


class CommandRanges:
    """
    The ranges in which the commands of a component need no limiting, as almost always.

    To compare is 1 µs for four wheels, to limit them 5.
    """

    __slots__ = ('loaded', '_ranges')

    def __init__(self, loaded: LoadedComponent, limiters: Iterable[JointLimiter]) -> None:
        self.loaded = loaded
        ranges = dict.fromkeys(loaded.commands, ANY_NUMBER)
        self._ranges: list[tuple[CommandInterface, float, float]] | None = None
        for limiter in limiters:
            bounds = limiter.fixed_bounds()
            if bounds is None:
                return  # they depend on the state: there is nothing to compare with
            ranges |= bounds
        least, most = ANY_NUMBER
        self._ranges = [
            (loaded.commands[name], max(least, lower), min(most, upper))
            for name, (lower, upper) in ranges.items()
        ]

    def hold(self) -> bool:
        """Return whether every command is within its range, or NaN: there is none."""
        if self._ranges is None:
            return False
        try:
            for command, lower, upper in self._ranges:
                value = command.value
                if not lower <= value <= upper and value == value:
                    return False
        except Exception:  # a third-party controller may have written anything
            return False
        return True


def limiters_of(component: LoadedComponent, robot: Robot | None, log: Log) -> list[JointLimiter]:
    """
    Return a limiter for every joint of a component; each is logged, as ros2_control does.

    Args:
        component: the hardware component.
        robot: the URDF, if there is one.
        log: for the limiters.

    Raises:
        HardwareError: no position satisfies the limits of a joint.
    """
    limiters = []
    for info in component.info.joints:
        joint = robot.joint(info.name) if robot and robot.has_joint(info.name) else None
        limits = limits_of(info, joint)
        log(
            Severity.INFO,
            f"Using JointLimiter for joint '{info.name}' in hardware '{component.info.name}' : "
            f'{limits}',
        )
        limiters.append(JointLimiter(info.name, limits, component.commands, component.states, log))
    return limiters


def limits_of(info: ComponentInfo, joint: Joint | None) -> JointLimits:
    """
    Return the limits of a joint.

    A command interface with ``<limits enable="false"/>`` has none, from either source. A
    continuous joint has no position limits except those of its parameters.

    Args:
        info: the joint in the ``<ros2_control>`` block.
        joint: the joint in the URDF, if there is one.

    Raises:
        HardwareError: no position satisfies both.
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


def limit_position(
    command: float, limits: JointLimits, state: JointState, before: float | None, dt: float
) -> float:
    """
    Return the closest position (rad or m) within the limits that the joint can reach.

    Args:
        command: rad or m.
        limits: of the joint.
        state: of the joint.
        before: the previous command, from which the joint starts at its greatest velocity.
        dt: since the previous command, s.
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
    Return the closest velocity (rad/s or m/s) that is allowed for the next ``dt`` s.

    It is at most one step of acceleration away from the previous command, and does not lead beyond
    a position limit.

    Args:
        command: rad/s or m/s.
        limits: of the joint.
        state: of the joint.
        before: the previous command.
        dt: s.
    """
    if before is None:
        before = state.velocity
    if limits.acceleration is not None and before is not None and dt > 0.0:
        step = limits.acceleration * dt
        command = _clamp(command, before - step, before + step)
    if limits.position is not None and state.position is not None and dt > 0.0:
        command = _keep_inside(command, limits.position, state.position, dt)
    return _within(command, limits.velocity)


def limit_effort(command: float, limits: JointLimits, state: JointState) -> float:
    """
    Return the closest effort (N·m or N) that is allowed.

    It neither pushes a joint beyond a position limit, nor one that is too fast already.
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
    """Return the closest acceleration (rad/s² or m/s²) that is allowed."""
    brakes = command * (state.velocity or 0.0) < 0.0
    if brakes and limits.deceleration is not None:
        return _within(command, limits.deceleration)
    return _within(command, limits.acceleration)


def value_at_rest(interface: str) -> float:
    """Return the command that stops a joint: 0.0, or NaN (no command) for other interfaces."""
    return 0.0 if interface in (VELOCITY, EFFORT, ACCELERATION, JERK) else math.nan


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
    """Return the smallest limit: commands are limited alike in both directions."""
    if interface is not None and not interface.limits_enabled:
        return None
    bounds = [abs(bound) for bound in (*_magnitudes(interface), urdf) if bound is not None]
    return min(bounds, default=None)


def _magnitudes(interface: InterfaceInfo | None) -> tuple[float | None, float | None]:
    if interface is None or not interface.limits_enabled:
        return None, None
    lower, upper = interface.min, interface.max
    return None if lower is None else abs(lower), None if upper is None else abs(upper)


def _keep_inside(
    velocity: float, bounds: tuple[float, float], position: float, dt: float
) -> float:
    lower, upper = bounds
    beyond = max(lower - position, position - upper)
    outwards = velocity >= 0.0 if position > upper else velocity <= 0.0
    if beyond > POSITION_TOLERANCE or (beyond > 0.0 and outwards):
        return 0.0
    return _clamp(velocity, (lower - position) / dt, (upper - position) / dt)


def _within(value: float, bound: float | None) -> float:
    return value if bound is None else _clamp(value, -bound, bound)


def _clamp(value: float, lower: float, upper: float) -> float:
    return min(max(value, lower), upper)
