# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What fails in a robot: sensors, motors, wheels, commands, the level of the floor.

Each is one line of a test, holds from a time on until another, and is undone by the next reset::

    sim = simulate('package://amr_description/urdf/amr.urdf')
    stick_motor(sim, 'joint_wheel_front_left', after=1.0)
    delay_commands(sim, 0.2, rng, jitter=0.05)

They draw only from the generator that they are given: by the same seed they give the same bits. A
state is a joint or a sensor of the ``<ros2_control>`` block, for all that is measured of it, or
one of its interfaces, ``imu/angular_velocity.z``; ``scan``: what ``sim.scan`` reads.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
import math
from typing import TypeAlias

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.errors import SimulationError, TrialsError
from amr_description.simulation.in_process import Simulation
from amr_description.simulation.readings import Scan

SCAN = 'scan'
"""The lidar, which controllers do not read."""
Change: TypeAlias = Callable[[np.ndarray, float], np.ndarray]
"""From what was measured, and the time since the fault began, s, to what is read."""


def drop_sensor(
    sim: Simulation,
    sensor: str,
    *,
    after: float = 0.0,
    until: float = math.inf,
    robot: str = '',
) -> None:
    """
    Have a sensor measure nothing: NaN.

    Args:
        sim: The simulation.
        sensor: A joint, a sensor, one of their interfaces, or ``scan``.
        after: s of simulated time; the fault begins here.
        until: s; it ends here.
        robot: Its name; empty: the only one.

    Raises:
        SimulationError: There is no such sensor.
    """

    def drop(values: np.ndarray, since: float) -> np.ndarray:
        return np.full_like(values, math.nan)

    _measure(sim, sensor, lambda: drop, after, until, robot)


def freeze_sensor(
    sim: Simulation,
    sensor: str,
    *,
    after: float = 0.0,
    until: float = math.inf,
    robot: str = '',
) -> None:
    """Have a sensor repeat what it has measured last; as :func:`drop_sensor`."""

    def freezing() -> Change:
        kept: list[np.ndarray] = []

        def freeze(values: np.ndarray, since: float) -> np.ndarray:
            if not kept:
                kept.append(values.copy())
            return kept[0]

        return freeze

    _measure(sim, sensor, freezing, after, until, robot)


def drift_sensor(
    sim: Simulation,
    sensor: str,
    rate: float,
    *,
    after: float = 0.0,
    until: float = math.inf,
    robot: str = '',
) -> None:
    """Have a sensor measure more and more, by ``rate`` a second; as :func:`drop_sensor`."""
    _require_finite('a drift', rate)

    def drift(values: np.ndarray, since: float) -> np.ndarray:
        return values + rate * since

    _measure(sim, sensor, lambda: drift, after, until, robot)


def add_noise(
    sim: Simulation,
    sensor: str,
    stddev: float,
    rng: np.random.Generator,
    *,
    after: float = 0.0,
    until: float = math.inf,
    robot: str = '',
) -> None:
    """Add normal noise to what a sensor measures, in its unit; as :func:`drop_sensor`."""
    _require_finite('a noise', stddev, least=0.0)
    own = _child(rng)

    def add(values: np.ndarray, since: float) -> np.ndarray:
        return values + stddev * own.standard_normal(len(values))

    _measure(sim, sensor, lambda: add, after, until, robot)


def stick_motor(
    sim: Simulation, joint: str, *, after: float = 0.0, until: float = math.inf, robot: str = ''
) -> None:
    """
    Have a joint stop and stay where it is, whatever it is commanded.

    Args:
        sim: The simulation.
        joint: With a command interface.
        after: s of simulated time; the fault begins here.
        until: s; it ends here.
        robot: Its name; empty: the only one.

    Raises:
        SimulationError: There is no such joint, or nothing commands it.
    """
    group = sim.altered.robot(robot).joints([joint])
    holds = _span(after, until)
    targets: dict[str, float] = {}

    def stick() -> None:
        targets.update(group.hold_at(targets))

    for loaded in sim.altered.commands(joint, robot):
        sim.altered.around_write(loaded, lambda time: stick if holds(time) else None)


def weaken_motor(
    sim: Simulation,
    joint: str,
    share: float,
    *,
    after: float = 0.0,
    until: float = math.inf,
    robot: str = '',
) -> None:
    """Have a joint follow this share of its velocity or effort; as :func:`stick_motor`."""
    _require_finite('a share', share, least=0.0)
    holds = _span(after, until)
    for loaded, commands in sim.altered.commands(joint, robot).items():
        scaled = [each for each in commands if each.interface in ('velocity', 'effort')]
        if not scaled:
            raise SimulationError(
                f"the joint '{joint}' is commanded by {commands[0].interface}; a motor that is "
                'weak has commands of velocity or effort'
            )
        sim.altered.around_write(loaded, _scaling(scaled, share, holds))


def slip_wheel(
    sim: Simulation,
    wheel: str,
    share: float = 0.05,
    *,
    after: float = 0.0,
    until: float = math.inf,
    robot: str = '',
) -> None:
    """
    Have a wheel run over oil: this share of its friction is left.

    Args:
        sim: The simulation.
        wheel: Its link.
        share: Above 0.
        after: s of simulated time; the fault begins here.
        until: s; it ends here.
        robot: Its name; empty: the only one.

    Raises:
        SimulationError: There is no such wheel.
    """
    _require_finite('a share of friction', share, least=1e-6)
    view, model, holds = sim.altered.robot(robot), sim.altered.model, _span(after, until)
    model.scale_friction(view, 1.0, [wheel])  # raises, if there is no such wheel
    slips = False

    def look(time: int) -> None:
        nonlocal slips
        if holds(time) != slips:
            slips = not slips
            model.scale_friction(view, share if slips else 1.0 / share, [wheel])

    look(sim.world.time)
    sim.altered.on_cycle(look)


def delay_commands(
    sim: Simulation,
    seconds: float,
    rng: np.random.Generator | None = None,
    *,
    jitter: float = 0.0,
    after: float = 0.0,
    until: float = math.inf,
) -> None:
    """
    Have commands arrive late, in their order.

    Args:
        sim: The simulation.
        seconds: At least; to the next cycle.
        rng: For the jitter.
        jitter: s; up to so much later, any of it as likely.
        after: s of simulated time; the fault begins here.
        until: s; it ends here.

    Raises:
        TrialsError: A jitter is asked for without a generator, or a time is below 0.
    """
    for value in (seconds, jitter):
        _require_finite('a delay', value, least=0.0)
    if jitter and rng is None:
        raise TrialsError(f'a jitter of {jitter} s needs the generator that it is drawn from')
    own, holds = _child(rng), _span(after, until)

    def arrival(time: int) -> int:
        if not holds(time):
            return time
        late = seconds + (jitter * float(own.random()) if jitter else 0.0)
        return time + round(late * NANOSECONDS)

    sim.altered.dispatch(arrival)


def lose_commands(
    sim: Simulation,
    share: float,
    rng: np.random.Generator,
    *,
    after: float = 0.0,
    until: float = math.inf,
) -> None:
    """Have this share of all commands never arrive; otherwise as :func:`delay_commands`."""
    if not 0.0 <= share <= 1.0:
        raise TrialsError(f'{share} of all commands are to be lost; 0 to 1 will do')
    own, holds = _child(rng), _span(after, until)

    def arrival(time: int) -> int | None:
        return None if holds(time) and own.random() < share else time

    sim.altered.dispatch(arrival)


def tilt_floor(sim: Simulation, roll: float = 0.0, pitch: float = 0.0) -> None:
    """
    Tilt the floor, by gravity that points elsewhere: all that is flat stays so for the robot.

    Args:
        sim: The simulation.
        roll: About the x axis of the world, rad.
        pitch: About its y axis, rad; above 0: down towards x.

    Raises:
        SimulationError: An angle is not finite.
    """
    sim.altered.model.tilt_gravity(roll, pitch)


def _measure(
    sim: Simulation,
    sensor: str,
    make: Callable[[], Change],
    after: float,
    until: float,
    robot: str,
) -> None:
    """Change what a sensor measures while a fault holds; ``make``: a change for each component."""
    holds = _span(after, until)
    begin = round(after * NANOSECONDS)
    if sensor == SCAN:
        change_scan = make()

        def changed(scan: Scan) -> Scan:
            time = round(scan.time * NANOSECONDS)
            if not holds(time):
                return scan
            ranges = change_scan(scan.ranges, (time - begin) / NANOSECONDS)
            return replace(scan, ranges=ranges.astype(scan.ranges.dtype))

        sim.altered.scans.setdefault(sim.altered.robot(robot).name, []).append(changed)
        return

    def altering(states: Sequence[StateInterface]) -> Callable[[int], None]:
        change = make()

        def alter(time: int) -> None:
            if holds(time):
                values = np.array([state.value for state in states], dtype=float)
                read = change(values, (time - begin) / NANOSECONDS)
                for state, value in zip(states, read.tolist(), strict=True):
                    state.value = value

        return alter

    for loaded, states in sim.altered.states(sensor, robot).items():
        sim.altered.after_read(loaded, altering(states))


def _scaling(
    commands: Sequence[CommandInterface], share: float, holds: Callable[[int], bool]
) -> Callable[[int], Callable[[], None] | None]:
    def scale(time: int) -> Callable[[], None] | None:
        if not holds(time):
            return None
        given = [command.value for command in commands]
        for command in commands:
            command.value *= share

        def bring_back() -> None:
            for command, value in zip(commands, given, strict=True):
                command.value = value

        return bring_back

    return scale


def _span(after: float, until: float) -> Callable[[int], bool]:
    """Return whether a time in ns is in a span of s. Raises TrialsError: it is empty."""
    if not 0.0 <= after < until:
        raise TrialsError(f'a fault after {after} s until {until} s; 0 <= after < until will do')
    begin = round(after * NANOSECONDS)
    end = None if math.isinf(until) else round(until * NANOSECONDS)
    return lambda time: begin <= time and (end is None or time < end)


def _child(rng: np.random.Generator | None) -> np.random.Generator:
    """Return a stream of its own: what else is drawn does not depend on how often a fault acts."""
    return np.random.default_rng(0 if rng is None else int(rng.integers(2**63)))


def _require_finite(what: str, value: float, least: float = -math.inf) -> None:
    if not (math.isfinite(value) and value >= least):
        which = '' if math.isinf(least) else f' from {least:g} on'
        raise TrialsError(f'{what} of {value}; a finite number{which} will do')
