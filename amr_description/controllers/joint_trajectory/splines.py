# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A trajectory of joints: points in time, and what is between them.

Between two points each joint follows the polynomial of the least degree that meets what both of
them specify: positions: linear; velocities, too: cubic; accelerations, too: quintic. Efforts are
interpolated linearly. A point without positions gets them by integration: its velocities (or, if
there are none, those of its accelerations) are reached linearly in time.

Before the first point is the state in which the trajectory was begun, so that a trajectory that
replaces another one in flight goes on from there.

The semantics are those of ``Trajectory`` in joint_trajectory_controller 4.x. Times are integer
nanoseconds. All work is done when it is needed: a point is brought into the order of the joints
when its segment begins, so a trajectory of a million points costs the control thread nothing.
"""

from bisect import bisect_right
from collections.abc import Callable, Sequence
import math
from typing import TypeAlias

from amr_description.clock import NANOSECONDS
from amr_description.control.trajectory_samples import TrajectoryPoint

Values: TypeAlias = tuple[float, ...]

_HALF_TURN_WIDTH = 1e-9
"""rad: how near to a half turn the direction of a wrapping joint is that of its positions."""


def shortest_angular_distance(start: float, end: float) -> float:
    """Return ``end − start`` brought into −π … π, rad."""
    return math.remainder(end - start, math.tau)


def unwrapped(start: float, end: float) -> float:
    """Return the angle, rad, a multiple of a turn away from ``start``, that is next to ``end``."""
    distance = shortest_angular_distance(start, end)
    if abs(abs(distance) - math.pi) < _HALF_TURN_WIDTH:
        distance = math.copysign(distance, end - start)
    return end - distance


class Segment:
    """The polynomials between two points, one a joint, about the time of the first one."""

    __slots__ = ('begin', '_coefficients', '_degree', '_efforts', '_zeros')

    def __init__(self, begin: int, a: TrajectoryPoint, end: int, b: TrajectoryPoint) -> None:
        """
        Make them.

        Args:
            begin: time of ``a``, ns.
            a: with positions.
            end: time of ``b``, ns, later.
            b: with positions.
        """
        self.begin = begin
        duration = (end - begin) / NANOSECONDS
        has_velocities = bool(a.velocities and b.velocities)
        has_accelerations = has_velocities and bool(a.accelerations and b.accelerations)
        self._degree = 5 if has_accelerations else 3 if has_velocities else 1
        self._zeros = (0.0,) * len(a.positions)
        self._efforts: tuple[tuple[float, float], ...] = ()
        if any(a.effort) or any(b.effort):
            efforts = zip(a.effort or self._zeros, b.effort or self._zeros, strict=True)
            self._efforts = tuple((e0, (e1 - e0) / duration) for e0, e1 in efforts)
        match self._degree:
            case 5:
                self._coefficients = _quintics(a, b, duration)
            case 3:
                self._coefficients = _cubics(a, b, duration)
            case _:
                positions = zip(a.positions, b.positions, strict=True)
                self._coefficients = tuple((p0, (p1 - p0) / duration) for p0, p1 in positions)

    def at(self, time: int) -> TrajectoryPoint:
        """Return the point at a time of the segment, ns: all four, in floats."""
        s = (time - self.begin) / NANOSECONDS
        efforts = tuple([e + de * s for e, de in self._efforts]) or self._zeros
        if self._degree == 1:
            return TrajectoryPoint(
                tuple([c0 + c1 * s for c0, c1 in self._coefficients]),
                tuple([c1 for _, c1 in self._coefficients]),
                self._zeros,
                efforts,
            )
        evaluate = _evaluate_quintic if self._degree == 5 else _evaluate_cubic
        positions, velocities, accelerations = zip(
            *[evaluate(c, s) for c in self._coefficients], strict=True
        )
        return TrajectoryPoint(positions, velocities, accelerations, efforts)


def _cubics(a: TrajectoryPoint, b: TrajectoryPoint, t: float) -> tuple[Values, ...]:
    """Return c₀ … c₃ of each joint; ``t``: duration, s."""
    rows = []
    for p0, v0, p1, v1 in zip(a.positions, a.velocities, b.positions, b.velocities, strict=True):
        slope = (p1 - p0) / t
        rows.append((p0, v0, (3.0 * slope - 2.0 * v0 - v1) / t, (v0 + v1 - 2.0 * slope) / t**2))
    return tuple(rows)


def _quintics(a: TrajectoryPoint, b: TrajectoryPoint, t: float) -> tuple[Values, ...]:
    """Return c₀ … c₅ of each joint; ``t``: duration, s."""
    starts = zip(a.positions, a.velocities, a.accelerations, strict=True)
    ends = zip(b.positions, b.velocities, b.accelerations, strict=True)
    rows = []
    for (p0, v0, a0), (p1, v1, a1) in zip(starts, ends, strict=True):
        # What is left for the three upper terms at the end: of position, velocity, acceleration.
        dp = (p1 - p0 - v0 * t - 0.5 * a0 * t**2) / t**3
        dv = (v1 - v0 - a0 * t) / t**2
        da = (a1 - a0) / t
        rows.append(
            (
                p0,
                v0,
                0.5 * a0,
                10.0 * dp - 4.0 * dv + 0.5 * da,
                (-15.0 * dp + 7.0 * dv - da) / t,
                (6.0 * dp - 3.0 * dv + 0.5 * da) / t**2,
            )
        )
    return tuple(rows)


def _evaluate_cubic(c: Values, s: float) -> tuple[float, float, float]:
    c0, c1, c2, c3 = c
    return (
        c0 + s * (c1 + s * (c2 + s * c3)),
        c1 + s * (2.0 * c2 + s * 3.0 * c3),
        2.0 * c2 + s * 6.0 * c3,
    )


def _evaluate_quintic(c: Values, s: float) -> tuple[float, float, float]:
    c0, c1, c2, c3, c4, c5 = c
    return (
        c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
        c1 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5))),
        2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5)),
    )


def integrated(
    a: TrajectoryPoint, b: TrajectoryPoint, duration: float
) -> tuple[TrajectoryPoint, TrajectoryPoint]:
    """
    Return both points with what is needed to interpolate between them.

    Args:
        a: with positions.
        b: perhaps without: then they come of its velocities, and these, if it has none, of its
            accelerations, by the trapezoidal rule.
        duration: s.
    """
    if b.positions:
        return a, b
    zeros = (0.0,) * len(a.positions)
    v0 = a.velocities or zeros
    a0, v1 = a.accelerations, b.velocities
    if not v1:
        a0 = a0 or zeros
        ramps = zip(v0, a0, b.accelerations, strict=True)
        v1 = tuple([v + 0.5 * (x + y) * duration for v, x, y in ramps])
    ramps = zip(a.positions, v0, v1, strict=True)
    p1 = tuple([p + 0.5 * (x + y) * duration for p, x, y in ramps])
    return (
        TrajectoryPoint(a.positions, v0, a0, a.effort),
        TrajectoryPoint(p1, v1, b.accelerations, b.effort),
    )


def _unchanged(point: TrajectoryPoint) -> TrajectoryPoint:
    return point


class JointOrder:
    """Brings the points of a message into the order of the joints, and completes partial ones."""

    def __init__(
        self, names: Sequence[str], joints: Sequence[str], positions: Sequence[float]
    ) -> None:
        """
        Compare the names.

        Args:
            names: of the message.
            joints: of the controller.
            positions: of the joints that the message lacks, which stay there.
        """
        self._is_same = tuple(names) == tuple(joints)
        self._numbers = [names.index(joint) if joint in names else -1 for joint in joints]
        self._positions = positions

    def __call__(self, point: TrajectoryPoint) -> TrajectoryPoint:
        """Return the point with a value for each joint, where it has any."""
        if self._is_same:
            return point
        zeros = (0.0,) * len(self._positions)
        return TrajectoryPoint(
            self._ordered(point.positions, self._positions),
            self._ordered(point.velocities, zeros),
            self._ordered(point.accelerations, zeros),
            self._ordered(point.effort, zeros),
        )

    def _ordered(self, values: Sequence[float], others: Sequence[float]) -> tuple[float, ...]:
        if not values:
            return ()
        return tuple(
            [
                values[number] if number >= 0 else other
                for number, other in zip(self._numbers, others, strict=True)
            ]
        )


class Trajectory:
    """Points in time, sampled from the moment when it is begun."""

    def __init__(
        self,
        points: Sequence[TrajectoryPoint],
        times: Sequence[int],
        start: int = 0,
        *,
        order: Callable[[TrajectoryPoint], TrajectoryPoint] = _unchanged,
        has_splines: bool = True,
    ) -> None:
        """
        Take the points.

        Args:
            points: at least one; what ``order`` makes of them is in the order of the joints.
            times: of the points, from the start, ns, increasing.
            start: ns; 0: when it is begun.
            order: called for a point when it is needed.
            has_splines: False: the next point counts as soon as the one before is reached.
        """
        self._raw = points
        self._order = order
        self._times = times
        self._has_splines = has_splines
        self._before = TrajectoryPoint()
        self._time_before = 0
        self._last = len(points) - 1
        self._chain: list[TrajectoryPoint] = []
        """Points so far, each with positions; used only where some have to be integrated."""
        self._segment: tuple[int, Segment] | None = None
        self._end: TrajectoryPoint | None = None
        self.start = start
        self.is_begun = False

    @classmethod
    def holding(cls, point: TrajectoryPoint) -> 'Trajectory':
        """Return one that stays where it is."""
        return cls((point,), (0,))

    def begin(
        self, time: int, state: TrajectoryPoint, wraps: Sequence[bool] = (), *, start: int = 0
    ) -> tuple[float, ...]:
        """
        Set the point before the first one.

        Args:
            time: of ``state``, ns.
            state: where the joints are, with positions.
            wraps: whether each joint is continuous; such a joint takes the shortest way to the
                first point. Empty: none is.
            start: begin of a trajectory without a time of its own, ns; 0: ``time``.

        Returns:
            By how much each joint's position is ahead of that by which the trajectory knows it,
            rad: whole turns.
        """
        first = self._point(0)
        zeros = (0.0,) * len(state.positions)
        positions = state.positions
        if any(wraps) and first.positions:
            ways = zip(positions, first.positions, wraps, strict=True)
            positions = tuple([unwrapped(p, q) if wrap else p for p, q, wrap in ways])
        # Of one degree with what follows.
        self._before = TrajectoryPoint(
            positions,
            state.velocities or (zeros if first.velocities else ()),
            state.accelerations or (zeros if first.accelerations else ()),
            state.effort,
        )
        self._time_before = time
        self.start = self.start or start or time
        self.is_begun = True
        return tuple([p - q for p, q in zip(state.positions, positions, strict=True)])

    def shift(self, delay: int) -> None:
        """Have all of it happen ``delay`` ns later: the clock was set."""
        if self.is_begun:
            self.start += delay
            self._time_before += delay
            self._segment = None
        elif self.start:
            self.start += delay

    def sample(self, time: int) -> tuple[TrajectoryPoint, int] | None:
        """
        Return where the joints should be at a time, ns, and which segment that is in.

        Segment −1 ends at the first point, segment k begins at point k; the last one has no end.
        None: the time is before that in which the trajectory was begun.
        """
        if not self.is_begun or time < self._time_before:
            return None
        index = bisect_right(self._times, time - self.start) - 1
        if index >= self._last:
            return self.end_point(), self._last
        if not self._has_splines:
            return self._stepped(index), index
        if self._segment is None or self._segment[0] != index:
            self._segment = (index, self._segment_of(index))
        return self._segment[1].at(time), index

    def is_over(self, index: int) -> bool:
        """Whether a segment is the one behind the last point."""
        return index >= self._last

    def time_of(self, index: int) -> int:
        """Return when a segment begins, ns; the one before the first point: when it ends."""
        return self.start + self._times[max(index, 0)]

    def end_point(self) -> TrajectoryPoint:
        """Return the last point, with zeros for what it does not specify."""
        if self._end is None:
            self._end = _completed(self._positioned(self._last))
        return self._end

    def _stepped(self, index: int) -> TrajectoryPoint:
        return _completed(self._before if index < 0 else self._positioned(index + 1))

    def _segment_of(self, index: int) -> Segment:
        begin = self._time_before if index < 0 else self.time_of(index)
        end = self.time_of(index + 1)
        b = self._positioned(index + 1)  # first: it may complete the point before it
        a = self._before if index < 0 else self._positioned(index)
        return Segment(begin, a, end, b)

    def _point(self, index: int) -> TrajectoryPoint:
        return self._order(self._raw[index])

    def _positioned(self, index: int) -> TrajectoryPoint:
        """Return a point with positions, if need be by integration from the begin."""
        point = self._point(index)
        if point.positions and not self._chain:
            return point
        chain = self._chain
        while len(chain) <= index:
            number = len(chain)
            before = chain[-1] if chain else self._before
            begin = self.time_of(number - 1) if chain else self._time_before
            duration = (self.time_of(number) - begin) / NANOSECONDS
            before, after = integrated(before, self._point(number), duration)
            if chain:
                chain[-1] = before
            else:
                self._before = before
            chain.append(after)
        return chain[index]


def _completed(point: TrajectoryPoint) -> TrajectoryPoint:
    zeros = (0.0,) * len(point.positions)
    return TrajectoryPoint(
        point.positions,
        point.velocities or zeros,
        point.accelerations or zeros,
        point.effort or zeros,
    )


def decelerating(state: TrajectoryPoint, decelerations: Sequence[float]) -> Trajectory:
    """
    Return a trajectory on which each joint comes to rest by a deceleration of its own.

    Args:
        state: where the joints are, with velocities.
        decelerations: of each joint, above 0.
    """
    joints = list(zip(state.positions, state.velocities, decelerations, strict=True))
    stops = [round(abs(v) / a * NANOSECONDS) for _, v, a in joints]
    points, times = [], sorted({0, *stops})
    for time in times:
        moments = [min(time, stop) / NANOSECONDS for stop in stops]
        rows = list(zip(joints, moments, strict=True))
        points.append(
            TrajectoryPoint(
                tuple(p + v * t - math.copysign(0.5 * a * t * t, v) for (p, v, a), t in rows),
                tuple(
                    v - math.copysign(a * t, v) if time < stop else 0.0
                    for ((_, v, a), t), stop in zip(rows, stops, strict=True)
                ),
            )
        )
    return Trajectory(points, times)
