# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The extended Kalman filter of robot_localization: motion in space with 15 states.

The state is the pose of the robot in a world-fixed frame, its velocity and its linear
acceleration, both in the robot's own axes (:class:`StateMember`). Between measurements the
acceleration and the turn rates are constant (or follow from a command, :class:`ControlLimits`)::

    x' = f(x) = x + (R(r, p, y) (v dt + a dt² / 2),  E(r, p) ω dt,  a dt,  0,  0)
    P' = F P Fᵀ + Q dt,  F = ∂f/∂x

with R = Rz Ry Rx and E the matrix that makes rates of roll, pitch and yaw of turn rates about the
robot's axes. A measurement z of some states, H x = z, corrects it (Joseph's form)::

    S = H P Hᵀ + R,  K = P Hᵀ S⁻¹,  x += K (z - H x),  P = (I - K H) P (I - K H)ᵀ + K R Kᵀ

Source: T. Moore and D. Stouch, A Generalized Extended Kalman Filter Implementation for the Robot
Operating System, IAS-13, 2014. Defaults are those of robot_localization 3.8 (Jazzy).

Times are integer ns, lengths m, angles rad.
"""

from dataclasses import dataclass
import enum
import math
import sys
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from amr_description.clock import NANOSECONDS

Array: TypeAlias = NDArray[np.float64]

STATE_SIZE = 15
NO_THRESHOLD = sys.float_info.max
"""No measurement is that far away, in standard deviations."""

_LEAST_VARIANCE = 1e-9
"""Of a measurement: no sensor is without an error, and S must have an inverse."""


class StateMember(enum.IntEnum):
    """What the numbers of a state are, in the order of ``odom0_config``."""

    X = 0
    Y = 1
    Z = 2
    ROLL = 3
    PITCH = 4
    YAW = 5
    VX = 6
    VY = 7
    VZ = 8
    VROLL = 9
    VPITCH = 10
    VYAW = 11
    AX = 12
    AY = 13
    AZ = 14


POSE = slice(0, 6)
POSITION = slice(0, 3)
ANGLES = slice(3, 6)
TWIST = slice(6, 12)
VELOCITY = slice(6, 9)
TURN_RATE = slice(9, 12)
ACCELERATION = slice(12, 15)
_COMMANDED_ACCELERATION = (StateMember.AX, StateMember.AY, StateMember.AZ)

PROCESS_NOISE = (
    0.05, 0.05, 0.06, 0.03, 0.03, 0.06,
    0.025, 0.025, 0.04, 0.01, 0.01, 0.02,
    0.01, 0.01, 0.015,
)  # fmt: skip
"""The diagonal of Q by default, 1/s of the square of each state's unit."""
INITIAL_VARIANCE = 1e-9
"""Of each state, by default."""


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """What one sensor says of some states, at one instant."""

    source: str
    time: int
    """ns"""
    values: Array
    """15; only those count that are in ``used``."""
    covariance: Array
    """15 × 15"""
    used: NDArray[np.bool_]
    """15"""
    threshold: float = NO_THRESHOLD
    """Mahalanobis distance from which on the measurement is rejected."""
    control: 'ControlInput | None' = None
    """The latest command when it was received."""


@dataclass(frozen=True, slots=True, eq=False)
class ControlInput:
    """A commanded velocity."""

    velocity: Array
    """6: m/s along x, y, z, rad/s about them, in the robot's axes."""
    time: int
    """ns"""


@dataclass(frozen=True, slots=True)
class ControlLimits:
    """How commanded velocities are followed; six of each, as of :class:`ControlInput`."""

    used: tuple[bool, ...]
    timeout: int
    """ns; an older command is taken for one to stand still."""
    acceleration_limits: tuple[float, ...]
    """m/s², rad/s²"""
    acceleration_gains: tuple[float, ...]
    """1/s: acceleration for each m/s, or rad/s, that is missing."""
    deceleration_limits: tuple[float, ...]
    deceleration_gains: tuple[float, ...]


class Outcome(enum.Enum):
    """What became of a measurement."""

    FUSED = 'fused'
    REJECTED = 'rejected'
    """It is farther from the state than its threshold."""
    UNUSABLE = 'unusable'
    """None of its values is a number, or its covariance is none."""


@dataclass(frozen=True, slots=True)
class Tuning:
    """What the filter starts with, again after each reset."""

    process_noise: Array
    """Q, 15 × 15, 1/s"""
    initial_covariance: Array
    """P, 15 × 15"""
    initial_state: Array
    """15"""
    dynamic_process_noise: bool = False
    """Whether Q of the pose grows with the square of the speed."""
    control: ControlLimits | None = None

    @classmethod
    def default(cls) -> 'Tuning':
        """Return that of robot_localization."""
        covariance = np.eye(STATE_SIZE) * INITIAL_VARIANCE
        return cls(np.diag(PROCESS_NOISE), covariance, np.zeros(STATE_SIZE))


class Ekf:
    """The filter: a state, its covariance, and the time that they are of."""

    def __init__(self, tuning: Tuning | None = None) -> None:
        """Begin with no measurement; ``tuning``: None: the default."""
        self.tuning = tuning or Tuning.default()
        self.state: Array
        """15"""
        self.covariance: Array
        """P, 15 × 15"""
        self.time = 0
        """ns; of the state."""
        self.is_initialized = False
        """Whether there was a measurement."""
        self.control: ControlInput | None = None
        self.reset()

    def reset(self) -> None:
        """Begin anew, as if there had been no measurement."""
        self.state = self.tuning.initial_state.copy()
        self.covariance = self.tuning.initial_covariance.copy()
        self.time = 0
        self.is_initialized = False
        self.control = None

    def process(self, measurement: Measurement) -> Outcome:
        """
        Predict to the time of a measurement, and correct by it.

        One that is older than the state corrects it without a prediction. The first one is taken
        as the state, as far as it measures it.
        """
        used = _usable(measurement)
        if not self.is_initialized:
            self.state[used] = measurement.values[used]
            both = np.ix_(used, used)
            self.covariance[both] = measurement.covariance[both]
            self.is_initialized = True
            self.time = measurement.time
            return Outcome.FUSED
        if measurement.time > self.time:
            self.predict(measurement.time)
        return self.correct(measurement)

    def predict(self, time: int) -> None:
        """Project the state to a later time, ns."""
        dt = (time - self.time) / NANOSECONDS
        if self.tuning.control is not None:
            self._apply_control(self.tuning.control, time, dt)
        transfer = transfer_matrix(self.state, dt)
        jacobian = transfer_jacobian(self.state, dt, transfer)
        noise = self._process_noise()
        self.state = transfer @ self.state
        self._wrap()
        self.covariance = jacobian @ self.covariance @ jacobian.T + dt * noise
        self.time = time

    def correct(self, measurement: Measurement) -> Outcome:
        """Correct the state by a measurement of its instant."""
        used = _usable(measurement)
        if not used.size:
            return Outcome.UNUSABLE
        noise = measurement.covariance[np.ix_(used, used)].copy()
        variances = np.abs(np.diagonal(noise))
        np.fill_diagonal(noise, np.maximum(variances, _LEAST_VARIANCE))
        cross = self.covariance[:, used]
        try:
            inverse = np.linalg.inv(cross[used] + noise)
        except np.linalg.LinAlgError:
            return Outcome.UNUSABLE
        innovation = measurement.values[used] - self.state[used]
        is_angle = (used >= StateMember.ROLL) & (used <= StateMember.YAW)
        innovation[is_angle] = _wrapped(innovation[is_angle])
        squared_distance = float(innovation @ inverse @ innovation)
        # Not **, which raises an OverflowError where this is infinite.
        if squared_distance >= measurement.threshold * measurement.threshold:
            return Outcome.REJECTED
        gain = cross @ inverse
        self.state = self.state + gain @ innovation
        residual = np.eye(STATE_SIZE)
        residual[:, used] -= gain
        self.covariance = residual @ self.covariance @ residual.T + gain @ noise @ gain.T
        self._wrap()
        return Outcome.FUSED

    def _process_noise(self) -> Array:
        """Return Q, 1/s: of the pose it is scaled by the square of the speed if that is asked."""
        if not self.tuning.dynamic_process_noise:
            return self.tuning.process_noise
        noise = self.tuning.process_noise.copy()
        noise[POSE, POSE] *= float(self.state[TWIST] @ self.state[TWIST])
        return noise

    def _apply_control(self, limits: ControlLimits, time: int, dt: float) -> None:
        """Accelerate towards the commanded velocity, or to rest if the command is too old."""
        is_alive = self.control is not None and time - self.control.time < limits.timeout
        for axis in range(6):
            if not limits.used[axis]:
                continue
            wanted = float(self.control.velocity[axis]) if self.control and is_alive else 0.0
            acceleration = _commanded_acceleration(
                float(self.state[TWIST][axis]), wanted, limits, axis
            )
            if axis < 3:
                self.state[_COMMANDED_ACCELERATION[axis]] = acceleration
            else:
                self.state[StateMember.VX + axis] += acceleration * dt

    def _wrap(self) -> None:
        self.state[ANGLES] = _wrapped(self.state[ANGLES])


def transfer_matrix(state: Array, dt: float) -> Array:
    """Return A with f(x) = A(x) x: the state ``dt`` s later."""
    roll, pitch, yaw = (float(angle) for angle in state[ANGLES])
    matrix = np.eye(STATE_SIZE)
    rotation = _rotation(roll, pitch, yaw)
    matrix[POSITION, VELOCITY] = rotation * dt
    matrix[POSITION, ACCELERATION] = rotation * (0.5 * dt * dt)
    matrix[ANGLES, TURN_RATE] = _euler_rates(roll, pitch) * dt
    matrix[VELOCITY, ACCELERATION] = np.eye(3) * dt
    return matrix


def transfer_jacobian(state: Array, dt: float, transfer: Array | None = None) -> Array:
    """
    Return ∂f/∂x, 15 × 15.

    Args:
        state: 15.
        dt: s.
        transfer: A of the same state, if it is known already.
    """
    roll, pitch, yaw = (float(angle) for angle in state[ANGLES])
    jacobian = (transfer_matrix(state, dt) if transfer is None else transfer).copy()
    way = state[VELOCITY] * dt + state[ACCELERATION] * (0.5 * dt * dt)
    about_x, about_y, about_z = _axis_rotations(roll, pitch, yaw)
    jacobian[POSITION, StateMember.ROLL] = about_z @ about_y @ _derivative(0, roll) @ way
    jacobian[POSITION, StateMember.PITCH] = about_z @ _derivative(1, pitch) @ about_x @ way
    jacobian[POSITION, StateMember.YAW] = _derivative(2, yaw) @ about_y @ about_x @ way
    by_roll, by_pitch = _euler_rate_derivatives(roll, pitch)
    jacobian[ANGLES, StateMember.ROLL] += by_roll @ state[TURN_RATE] * dt
    jacobian[ANGLES, StateMember.PITCH] += by_pitch @ state[TURN_RATE] * dt
    return jacobian


def _usable(measurement: Measurement) -> NDArray[np.intp]:
    """Return the indices of the states that a measurement has numbers for."""
    finite = np.isfinite(measurement.values) & np.isfinite(np.diagonal(measurement.covariance))
    used = np.flatnonzero(measurement.used & finite)
    if not np.isfinite(measurement.covariance[np.ix_(used, used)]).all():
        return used[:0]
    return used


def _wrapped(angles: Array) -> Array:
    """Return the same angles, rad, from -π to π."""
    return angles - math.tau * np.round(angles / math.tau)


def _commanded_acceleration(
    velocity: float, wanted: float, limits: ControlLimits, axis: int
) -> float:
    """Return the acceleration of one axis towards a commanded velocity."""
    missing = wanted - velocity
    # One towards the other direction is a braking first; 0.01 is the tolerance of the original.
    target = wanted if abs(missing) <= abs(wanted) + 0.01 else 0.0
    limit, gain = limits.acceleration_limits[axis], limits.acceleration_gains[axis]
    if abs(target) < abs(velocity):
        limit, gain = limits.deceleration_limits[axis], limits.deceleration_gains[axis]
    return min(max(gain * missing, -limit), limit)


def _axis_rotations(roll: float, pitch: float, yaw: float) -> tuple[Array, Array, Array]:
    """Return the rotations about x, y and z."""
    sr, cr = math.sin(roll), math.cos(roll)
    sp, cp = math.sin(pitch), math.cos(pitch)
    sy, cy = math.sin(yaw), math.cos(yaw)
    return (
        np.array(((1.0, 0.0, 0.0), (0.0, cr, -sr), (0.0, sr, cr))),
        np.array(((cp, 0.0, sp), (0.0, 1.0, 0.0), (-sp, 0.0, cp))),
        np.array(((cy, -sy, 0.0), (sy, cy, 0.0), (0.0, 0.0, 1.0))),
    )


def _rotation(roll: float, pitch: float, yaw: float) -> Array:
    """Return R = Rz Ry Rx, from the robot's axes to those of the world."""
    about_x, about_y, about_z = _axis_rotations(roll, pitch, yaw)
    return about_z @ about_y @ about_x


def _derivative(axis: int, angle: float) -> Array:
    """Return the derivative of the rotation about an axis by its angle."""
    sin, cos = math.sin(angle), math.cos(angle)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.zeros((3, 3))
    matrix[first, first] = matrix[second, second] = -sin
    matrix[first, second], matrix[second, first] = -cos, cos
    return matrix


def _euler_rates(roll: float, pitch: float) -> Array:
    """Return E: rates of roll, pitch, yaw of turn rates about the robot's x, y, z."""
    sr, cr, tp, cp = math.sin(roll), math.cos(roll), math.tan(pitch), math.cos(pitch)
    return np.array(((1.0, sr * tp, cr * tp), (0.0, cr, -sr), (0.0, sr / cp, cr / cp)))


def _euler_rate_derivatives(roll: float, pitch: float) -> tuple[Array, Array]:
    """Return the derivatives of E by roll and by pitch."""
    sr, cr, tp, cp = math.sin(roll), math.cos(roll), math.tan(pitch), math.cos(pitch)
    by_roll = ((0.0, cr * tp, -sr * tp), (0.0, -sr, -cr), (0.0, cr / cp, -sr / cp))
    by_pitch = (
        (0.0, sr / (cp * cp), cr / (cp * cp)),
        (0.0, 0.0, 0.0),
        (0.0, sr * tp / cp, cr * tp / cp),
    )
    return np.array(by_roll), np.array(by_pitch)
