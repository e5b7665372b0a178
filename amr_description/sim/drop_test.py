# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The physical test of a description: dropped, left at rest, pushed, rolled, turned; in numbers.

Deterministic: the same description gives the same numbers. It takes a few seconds of simulated
time, a fraction of a second of the machine's.
"""

from collections.abc import Callable
from dataclasses import dataclass
import math

import mujoco
import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Severity
from amr_description.control.interfaces import EFFORT, VELOCITY
from amr_description.errors import SimulationError
from amr_description.model.frames import rotate, Transform, Vector, yaw_of
from amr_description.model.robot import Robot, WORLD_LINK
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.wheels import Wheel
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld

DROP_HEIGHT = 0.2
"""m, of the lowest point of the robot above the ground."""
PUSH_SHARE, PUSH_TIME = 0.5, 0.1
"""A push to the left: this share of the robot's weight, for so many s."""
ROLL_SPEED, ROLL_TIME, TURN_TIME = 0.3, 0.5, 1.0
"""m/s of the wheels' rims, forward and against each other; s."""

_TICK = 0.01
_RESPONSE = 0.05
"""s; the time constant of a wheel that is driven by effort."""
_LONGEST_SETTLING = 5.0
_REST_TIME = 0.2
_STILL, _STILL_TURNING = 0.002, 0.02
"""m/s and rad/s; slower is at rest."""
_MOST_DRIFT = 0.005
_MOST_TILT = math.radians(20.0)
_LEAST_SHARE = 0.2
_FASTEST = 20.0
_UP: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class DropReport:
    """
    What was measured; m, s, rad. What was not reached, or has no meaning, is None.

    ``failures`` are the reasons why the robot does not pass, each in one line.
    """

    stands_fixed: bool = False
    """It was not dropped: its root is called ``world``."""
    rest_time: float | None = None
    """From the release until it stands still."""
    fastest: float = 0.0
    """The greatest speed of the root on the way, m/s."""
    tilt: float | None = None
    """Between the root's z axis and the vertical, at rest."""
    drift: float | None = None
    """Over the ground in the second after."""
    push_force: float | None = None
    """N."""
    push_travel: float | None = None
    push_tilt: float | None = None
    """The greatest tilt while it was pushed and came to rest again."""
    ahead: float | None = None
    """Along the robot's x in half a second at ROLL_SPEED."""
    aside: float | None = None
    """Along its y, meanwhile."""
    veer: float | None = None
    """The yaw, meanwhile."""
    turn: float | None = None
    """The yaw in a second of turning left."""
    failures: tuple[str, ...] = ()


class _FailedError(Exception):
    """What comes after has no meaning."""


def drop_test(robot: Robot) -> DropReport:
    """
    Drop a sound robot 20 cm onto flat ground, and see what it does.

    A robot whose root is called ``world`` stands fixed and is only watched for a second. Raises
    SpawnError when the simulator does not take it.
    """
    return _DropTest(robot).run()


class _DropTest:
    """One robot in an empty world, on the way through the test."""

    def __init__(self, robot: Robot) -> None:
        self._measured: dict[str, float] = {}
        self._failures: list[str] = []
        self._heard: list[str] = []
        self._stands = robot.root.name == WORLD_LINK
        clearance = 0.0 if self._stands else DROP_HEIGHT - _lowest_point(robot)
        self._world = MujocoWorld('empty', log=self._hear)
        self._view = self._world.spawn('robot', robot, Transform((0.0, 0.0, clearance)))
        self._root = robot.root.name
        by_speed, by_effort = _commanded(robot, VELOCITY), _commanded(robot, EFFORT)
        self._wheels = [w for w in self._view.wheels if w.joint in by_speed | by_effort]
        self._by_effort = by_effort - by_speed

    def run(self) -> DropReport:
        """Go through it as far as it makes sense."""
        try:
            if self._stands:
                self._run(1.0)
            else:
                self._fall()
                self._rest()
                self._push()
                if self._wheels:
                    self._roll()
                    self._turn()
        except (_FailedError, SimulationError) as failure:
            self._failures.append(str(failure))
        return DropReport(self._stands, **self._measured, failures=tuple(self._failures))

    def _hear(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """The log of the world: a state that is lost, a robot below the ground."""
        if severity >= Severity.ERROR:
            self._heard.append(text)

    def _fall(self) -> None:
        released = self._world.time
        if not self._settle():
            raise _FailedError(
                f'it does not come to rest in {_LONGEST_SETTLING:g} s: it still moves at '
                f'{self._speed():.3f} m/s'
            )
        self._measured['rest_time'] = (self._world.time - released) / NANOSECONDS - _REST_TIME
        tilt = self._measured['tilt'] = self._tilt()
        if tilt > _MOST_TILT:
            raise _FailedError(f'it tips over: it rests at a tilt of {math.degrees(tilt):.0f}°')

    def _rest(self) -> None:
        start = self._pose()
        self._run(1.0)
        drift = self._measured['drift'] = math.dist(start.translation, self._pose().translation)
        if drift > _MOST_DRIFT:
            raise _FailedError(f'it drifts at rest: by {drift * 1000.0:.1f} mm in 1 s')

    def _push(self) -> None:
        start, engine = self._pose(), self._world.engine
        body = engine.model.body(f'robot/{self._root}').id
        force = PUSH_SHARE * float(engine.model.body_subtreemass[body]) * 9.81
        self._measured['push_force'] = force
        x, y, _ = rotate(start.rotation, (0.0, force, 0.0))

        def push() -> None:
            engine.data.qfrc_applied[:] = 0.0
            mujoco.mj_applyFT(
                engine.model,
                engine.data,
                np.array([x, y, 0.0]),
                np.zeros(3),
                engine.data.subtree_com[body],
                body,
                engine.data.qfrc_applied,
            )

        tilt = self._run(PUSH_TIME, push)
        engine.data.qfrc_applied[:] = 0.0
        is_still = self._settle()
        self._measured['push_tilt'] = max(tilt, self._tilt())
        self._measured['push_travel'] = math.dist(start.translation, self._pose().translation)
        if self._measured['push_tilt'] > _MOST_TILT:
            raise _FailedError(f'it tips over when it is pushed with {force:.0f} N')
        if not is_still:
            raise _FailedError('it does not come to rest after a push')

    def _roll(self) -> None:
        ahead, aside, veer = self._drive(ROLL_TIME, lambda wheel: 1.0)
        self._measured |= {'ahead': ahead, 'aside': aside, 'veer': veer}
        asked = ROLL_SPEED * ROLL_TIME
        if ahead < -_LEAST_SHARE * asked:
            self._failures.append(
                f'it drives backwards: positive wheel speeds carry it by {ahead:.3f} m along its '
                'x; turn the <axis> of the wheel joints round'
            )
        elif ahead < _LEAST_SHARE * asked:
            self._failures.append(
                f'it does not drive: positive wheel speeds carry it by {ahead:.3f} m along its x, '
                f'of {asked:.3f} m that the wheels roll'
            )
        self._settle()

    def _turn(self) -> None:
        y = {
            wheel.joint: (self._pose().inverse() @ self._view.pose(wheel.link)).translation[1]
            for wheel in self._wheels
        }
        if not min(y.values()) < 0.0 < max(y.values()):
            return
        _, _, turn = self._drive(TURN_TIME, lambda wheel: math.copysign(1.0, -y[wheel.joint]))
        self._measured['turn'] = turn
        if turn <= 0.0 < self._measured['ahead']:
            self._failures.append(
                'it turns the wrong way: with the right wheels forward and the left ones back it '
                f'yaws by {math.degrees(turn):.1f}°'
            )

    def _drive(self, seconds: float, sign: Callable[[Wheel], float]) -> tuple[float, float, float]:
        """Turn the wheels at ROLL_SPEED; return how far it went along x and y, and the yaw."""
        start = self._pose()
        speeds = [(w, sign(w) * ROLL_SPEED / w.radius) for w in self._wheels]
        self._view.joints([w.joint for w, _ in speeds if w.joint not in self._by_effort]).command(
            VELOCITY, [speed for w, speed in speeds if w.joint not in self._by_effort]
        )

        pushed = [(w, speed) for w, speed in speeds if w.joint in self._by_effort]
        places = self._view.joints([w.joint for w, _ in pushed]).positions()
        begin = self._world.time

        def push() -> None:
            passed = (self._world.time - begin) / NANOSECONDS
            for (wheel, speed), place in zip(pushed, places, strict=True):
                self._push_wheel(wheel, speed, place + speed * passed)

        self._run(seconds, push)
        moved = start.inverse() @ self._pose()
        self._view.joints([wheel.joint for wheel in self._wheels]).hold()
        return moved.translation[0], moved.translation[1], yaw_of(moved.rotation)

    def _push_wheel(self, wheel: Wheel, speed: float, place: float) -> None:
        """Drive a wheel that takes effort only to where it has to be (rad), at this speed."""
        joint = self._view.joints([wheel.joint])
        model = self._world.engine.model
        mass = float(model.body_subtreemass[model.body(f'robot/{self._root}').id])
        inertia = mass * wheel.radius**2 / len(self._wheels)
        (here,), (present,) = joint.positions(), joint.velocities()
        acceleration = (speed - present) / _RESPONSE + (place - here) / _RESPONSE**2
        joint.command(EFFORT, [inertia * acceleration])

    def _settle(self) -> bool:
        """Run until it has been still for a while; tell whether it came to that."""
        still = 0.0
        for _ in range(round(_LONGEST_SETTLING / _TICK)):
            self._run(_TICK)
            still = still + _TICK if self._is_still() else 0.0
            if still >= _REST_TIME - _TICK / 2.0:
                return True
        return False

    def _run(self, seconds: float, each: Callable[[], None] | None = None) -> float:
        """Advance; ``each`` comes before every tick. Return the greatest tilt on the way."""
        steps = round(_TICK * NANOSECONDS / self._world.timestep)
        tilt = 0.0
        for _ in range(round(seconds / _TICK)):
            if each is not None:
                each()
            self._world.step(steps)
            if self._heard:
                raise _FailedError(self._heard[0])
            tilt = max(tilt, self._tilt())
            speed = self._speed()
            self._measured['fastest'] = max(speed, self._measured.get('fastest', 0.0))
            if not speed < _FASTEST:
                raise _FailedError(f'it explodes: its root moves at {speed:.3g} m/s')
        return tilt

    def _pose(self) -> Transform:
        return self._view.pose(self._root)

    def _tilt(self) -> float:
        cosine = rotate(self._pose().rotation, _UP)[2]
        return math.acos(min(1.0, max(-1.0, cosine)))

    def _speed(self) -> float:
        return 0.0 if self._stands else math.hypot(*self._view.velocity(self._root)[0])

    def _is_still(self) -> bool:
        linear, angular = self._view.velocity(self._root)
        return math.hypot(*linear) < _STILL and math.hypot(*angular) < _STILL_TURNING


def _commanded(robot: Robot, interface: str) -> set[str]:
    """The joints that have this command interface."""
    joints = (joint for hardware in hardware_of(robot) for joint in hardware.joints)
    return {j.name for j in joints if any(i.name == interface for i in j.command_interfaces)}


def _lowest_point(robot: Robot) -> float:
    """Return the height of the lowest point that touches, the root at the origin (m)."""
    world = MujocoWorld('empty')
    # High up, so that nothing of it is below the plane to which distances are measured.
    high = 100.0
    view: RobotView = world.spawn('robot', robot, Transform((0.0, 0.0, high)))
    model, data = world.engine.model, world.engine.data
    mujoco.mj_forward(model, data)
    root = model.body(f'{view.name}/{robot.root.name}').id
    ground = [
        geom for geom in range(model.ngeom) if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE
    ]
    touching = [
        geom
        for geom in range(model.ngeom)
        if model.body_rootid[model.geom_bodyid[geom]] == root
        and (model.geom_contype[geom] or model.geom_conaffinity[geom])
    ]
    return min(
        (
            mujoco.mj_geomDistance(model, data, plane, geom, 2.0 * high, None) - high
            for plane in ground
            for geom in touching
        ),
        default=0.0,
    )
