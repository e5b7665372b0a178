# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A physical test of a robot description: it is dropped, left at rest, pushed, rolled and turned.

Deterministic: the same description gives the same numbers. It takes a few seconds of simulated
time, a fraction of a second of wall time.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from itertools import pairwise
import math

import mujoco
import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.control.interfaces import EFFORT, VELOCITY
from amr_description.errors import SimulationError
from amr_description.log import Severity
from amr_description.model.axles import axle_fault, vector_text
from amr_description.model.frames import rotate, Transform, Vector, yaw_of
from amr_description.model.gazebo.translation import translate
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import JointType, Robot, WORLD_LINK
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.wheels import Wheel
from amr_description.sim.actuators import speed_limit
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld
from amr_description.text import quote, quote_all

DROP_HEIGHT = 0.2
"""m; height of the robot's lowest point above the ground."""
PUSH_SHARE, PUSH_TIME = 0.5, 0.1
"""A push to the left: as a share of the robot's weight, and its duration, s."""
ROLL_SPEED, ROLL_TIME, TURN_TIME = 0.3, 0.5, 1.0
"""
Speed of the wheels' rims, m/s, unless their velocity limits are lower; duration of rolling forward
and of turning, s.
"""

_PERIOD = 0.01
_EFFORT_RESPONSE = 0.05
"""s; the time constant of a wheel that is driven by effort."""
_MAX_SETTLING = 5.0
_REST_TIME = 0.2
_STILL, _STILL_TURNING = 0.002, 0.02
"""m/s and rad/s; a slower robot is at rest."""
_MAX_DRIFT = 0.005
_MAX_TILT = math.radians(20.0)
_MIN_SHARE = 0.2
"""Of the way that the wheels roll; a robot that makes less does not drive."""
_MAX_ASIDE = 0.05
"""The share of that way by which the middle of the wheels may be off the robot's heading."""
_MIN_TURN = 0.05
"""Of the yaw of two wheels that do not slip; six in a row on each side reach about 0.1."""
_AHEAD = 0.9
"""The least cosine of the angle of rollers that point ahead; those of mecanum wheels have 0.7."""
_PAIRED = 0.01
"""m; joints of a pair are mirror images of each other within this distance."""
_MIDDLE = 0.001
"""m; a wheel that is closer to the robot's x axis is on neither side."""
_MAX_SPEED = 20.0
_UP: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class DropReport:
    """
    The measurements, in m, s and rad; None for those that were not reached or have no meaning.

    ``failures``: the reasons why the robot does not pass, each in one line.
    """

    stands_fixed: bool = False
    """Its root is called ``world``, so that it was not dropped."""
    rest_time: float | None = None
    """From release to rest."""
    fastest: float = 0.0
    """The greatest speed of the root during the test, m/s."""
    tilt: float | None = None
    """Between the root's z axis and the vertical, at rest."""
    drift: float | None = None
    """Of the root, in one second at rest."""
    push_force: float | None = None
    """N."""
    push_travel: float | None = None
    push_tilt: float | None = None
    """The greatest tilt during the push and until it is at rest again."""
    ahead: float | None = None
    """Distance along the robot's x axis in half a second of rolling."""
    aside: float | None = None
    """Distance along its y axis, meanwhile."""
    veer: float | None = None
    """Yaw, meanwhile."""
    turn: float | None = None
    """Yaw in a second of turning left."""
    left_out: tuple[str, ...] = ()
    """What was not done, and why, each in one line."""
    failures: tuple[str, ...] = ()


class _FailedError(Exception):
    """The robot has failed so that the remaining measurements have no meaning."""


def drop_test(robot: Robot, wheels: Collection[str] = ()) -> DropReport:
    """
    Drop a robot that the checker has found sound by 20 cm onto flat ground, and measure.

    A robot whose root is called ``world`` stands fixed; it is only simulated for a second.

    Args:
        robot: the robot.
        wheels: the joints that a controller names as its wheels. Without any, the wheels are found
            by what they are: round about a joint that takes commands, or on the ground with one.

    Raises:
        SpawnError: the simulator rejects the robot.
    """
    return _DropTest(translate(robot).robot, wheels).run()


class _DropTest:
    """One robot in the empty world, and what has been measured so far."""

    def __init__(self, robot: Robot, named: Collection[str]) -> None:
        self._measured: dict[str, float] = {}
        self._failures: list[str] = []
        self._left_out: list[str] = []
        self._errors: list[str] = []
        self._stands = robot.root.name == WORLD_LINK
        clearance = 0.0 if self._stands else DROP_HEIGHT - _lowest_point(robot)
        self._world = MujocoWorld('empty', log=self._log)
        self._view = self._world.spawn('robot', robot, Transform((0.0, 0.0, clearance)))
        self._root = robot.root.name
        by_speed, by_effort = _commanded(robot, VELOCITY), _commanded(robot, EFFORT)
        self._by_effort = by_effort - by_speed
        self._driven = [
            joint
            for joint in robot.joints
            if joint.name in by_speed | by_effort
            and (joint.name in named if named else joint.type is JointType.CONTINUOUS)
        ]
        self._is_named = bool(named)
        self._standing: set[str] = set()
        self._wheels: list[Wheel] = []

    def run(self) -> DropReport:
        """Run the test, up to the failure that makes the rest meaningless."""
        try:
            if self._stands:
                self._run(1.0)
            else:
                self._fall()
                self._rest()
                self._find_wheels()
                self._push()
                if self._has_omni_wheels():
                    self._left_out.append('not driven: its wheels roll in several directions')
                elif self._wheels:
                    self._roll()
                    self._turn()
        except (_FailedError, SimulationError) as failure:
            self._failures.append(str(failure))
        return DropReport(
            self._stands,
            **self._measured,
            left_out=tuple(self._left_out),
            failures=tuple(self._failures),
        )

    def _has_omni_wheels(self) -> bool:
        """Whether rollers point ahead: such wheels stand at angles, and take other speeds."""
        return any(abs(math.cos(each.angle)) > _AHEAD for each in self._view.rollers.values())

    def _log(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """Keep the errors that the world logs: a lost state, a robot below the ground."""
        if severity >= Severity.ERROR:
            self._errors.append(text)

    def _fall(self) -> None:
        released = self._world.time
        if not self._settle():
            raise _FailedError(
                f'it does not come to rest in {_MAX_SETTLING:g} s: it still moves at '
                f'{self._speed():.3f} m/s'
            )
        self._measured['rest_time'] = (self._world.time - released) / NANOSECONDS - _REST_TIME
        tilt = self._measured['tilt'] = self._tilt()
        if tilt > _MAX_TILT:
            cause = self._axle_faults() if self._has_a_pair() else ''
            raise _FailedError(
                f'it tips over: it rests at a tilt of {math.degrees(tilt):.0f}°{cause}'
            )

    def _rest(self) -> None:
        start = self._pose()
        self._run(1.0)
        drift = self._measured['drift'] = math.dist(start.translation, self._pose().translation)
        if drift > _MAX_DRIFT:
            raise _FailedError(f'it drifts at rest: by {drift * 1000.0:.1f} mm in 1 s')

    def _find_wheels(self) -> None:
        """
        Find the wheels of the robot at rest, and say why there are none.

        A link that stands on the ground and turns with a driven joint is one, whatever its shape:
        its radius is the height of its hub. One that hangs in the air with a vertical axle (a
        lidar, a rotor) is not, if no controller names it.
        """
        self._standing = self._standing_links()
        robot, poses = self._view.description, link_poses(self._view.description)
        by_joint = {wheel.joint: wheel for wheel in self._view.wheels}
        for joint in self._driven:
            wheel = by_joint.get(joint.name)
            if joint.child not in self._standing and not self._is_named:
                fault = axle_fault(robot, poses, joint, self._root)
                if wheel is None or (fault is not None and fault.is_vertical):
                    continue
            hub = self._view.pose(joint.child).translation[2]
            if wheel is not None or hub > _MIDDLE:
                self._wheels.append(wheel or Wheel(joint.child, joint.name, hub, 0.0))
        names = quote_all([joint.name for joint in self._driven])
        if not self._driven:
            self._left_out.append(
                'not driven: no continuous joint takes a velocity or an effort command'
            )
        elif not self._wheels and self._has_a_pair():
            self._failures.append(
                f'it does not drive: it stands on none of the joints that take a command, {names}'
                f'{self._axle_faults()}'
            )
        elif not self._wheels:
            self._left_out.append(
                f'not driven: it stands on none of the joints that take a command, {names}'
            )

    def _has_a_pair(self) -> bool:
        """Return whether two driven joints mirror each other, as wheels do: left and right."""
        to_root = self._pose().inverse()
        hubs = [(to_root @ self._view.pose(joint.child)).translation for joint in self._driven]
        return any(
            math.dist((x, -y, z), other) < _PAIRED < abs(y) for x, y, z in hubs for other in hubs
        )

    def _standing_links(self) -> set[str]:
        """Return the topmost links of the rigid bodies that touch the ground, now."""
        model, data = self._world.engine.model, self._world.engine.data
        standing = set()
        for geoms in data.contact.geom.tolist() if data.ncon else ():
            bodies = [int(model.body_weldid[model.geom_bodyid[geom]]) for geom in geoms]
            if 0 in bodies:
                standing.add(model.body(max(bodies)).name.removeprefix(f'{self._view.name}/'))
        return standing

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
        if self._measured['push_tilt'] > _MAX_TILT:
            raise _FailedError(f'it tips over when it is pushed with {force:.0f} N')
        if not is_still:
            raise _FailedError('it does not come to rest after a push')

    def _roll(self) -> None:
        middle = self._middle_of_wheels()
        moved, veer = self._drive(ROLL_TIME, lambda wheel: 1.0)
        ahead, aside, _ = moved.translation
        self._measured |= {'ahead': ahead, 'aside': aside, 'veer': veer}
        asked = self._roll_speed() * ROLL_TIME
        # On its arc, the middle of the wheels moves along the heading that is half the yaw.
        x, y, _ = map(float.__sub__, moved.apply(middle), middle)
        sideways = y * math.cos(veer / 2.0) - x * math.sin(veer / 2.0)
        faults, least = self._axle_faults(), _MIN_SHARE * asked
        # Wheels that spin on the spot hold the robot on no line.
        if abs(sideways) > _MAX_ASIDE * asked and (abs(ahead) > least or faults):
            self._failures.append(
                f'it goes sideways: positive wheel speeds carry it by {ahead:.3f} m along its x '
                f'and by {sideways:.3f} m along its y{faults}'
            )
        if ahead < -least:
            self._failures.append(
                f'it drives backwards: positive wheel speeds carry it by {ahead:.3f} m along its '
                'x; turn the <axis> of the wheel joints round'
            )
        elif ahead < least and not self._failures:
            self._failures.append(
                f'it does not drive: positive wheel speeds carry it by {ahead:.3f} m along its x, '
                f'of {asked:.3f} m that the wheels roll{faults}'
            )
        self._settle()

    def _turn(self) -> None:
        to_root = self._pose().inverse()
        y = {w.joint: (to_root @ self._view.pose(w.link)).translation[1] for w in self._wheels}
        if not min(y.values()) < 0.0 < max(y.values()):
            if max(map(abs, y.values())) < _MIDDLE:
                self._left_out.append('not turned: its driven wheels are in the middle')
            else:
                self._failures.append(
                    f'it cannot turn: its driven wheels are on one side, {quote_all([*y])}'
                )
            return
        _, turn = self._drive(TURN_TIME, lambda wheel: math.copysign(1.0, -y[wheel.joint]))
        self._measured['turn'] = turn
        asked = self._roll_speed() * TURN_TIME / (math.fsum(map(abs, y.values())) / len(y))
        if self._failures:  # it does not drive as it should, for a reason that is told
            return
        if turn <= -_MIN_TURN * asked:
            self._failures.append(
                'it turns the wrong way: with the right wheels forward and the left ones back it '
                f'yaws by {math.degrees(turn):.1f}°'
            )
        elif turn < _MIN_TURN * asked:
            self._failures.append(
                'it does not turn: with the right wheels forward and the left ones back it yaws '
                f'by {math.degrees(turn):.1f}°, of {math.degrees(asked):.0f}° that they roll'
            )

    def _roll_speed(self) -> float:
        """Return the speed of the wheels' rims, m/s, which no velocity limit is below."""
        joint = self._view.description.joint
        return min([ROLL_SPEED, *(speed_limit(joint(w.joint)) * w.radius for w in self._wheels)])

    def _middle_of_wheels(self) -> Vector:
        """Return the mean of the hubs in the frame of the root."""
        to_root = self._pose().inverse()
        hubs = [(to_root @ self._view.pose(wheel.link)).translation for wheel in self._wheels]
        x, y, z = (math.fsum(parts) / len(hubs) for parts in zip(*hubs, strict=True))
        return (x, y, z)

    def _axle_faults(self) -> str:
        """
        Return the end of a failure: the wheels whose axles explain it; '' if there are none.

        While no wheels are known, they explain it only if no driven joint has the axle of a wheel:
        a lidar beside wheels explains nothing.
        """
        robot, poses = self._view.description, link_poses(self._view.description)
        faults = {
            joint.name: fault
            for joint in self._driven
            if joint.child in self._standing or not self._wheels
            if (fault := axle_fault(robot, poses, joint, self._root)) is not None
        }
        if not self._wheels and len(faults) < len(self._driven):
            return ''
        groups: dict[str, list[str]] = {}
        for name, fault in faults.items():
            found = f'{vector_text(fault.direction)} in the frame of {quote(self._root)}'
            words = f'{fault.what}: found {found}, expected (0, 1, 0); {fault.fix}'
            groups.setdefault(words, []).append(name)
        return ''.join(f'; {quote_all(names)}: {words}' for words, names in groups.items())

    def _drive(self, seconds: float, sign: Callable[[Wheel], float]) -> tuple[Transform, float]:
        """Turn the wheels; return the motion of the root in its frame, and yaw."""
        start, rim = self._pose(), self._roll_speed()
        speeds = [(w, sign(w) * rim / w.radius) for w in self._wheels]
        self._view.joints([w.joint for w, _ in speeds if w.joint not in self._by_effort]).command(
            VELOCITY, [speed for w, speed in speeds if w.joint not in self._by_effort]
        )

        pushed = [(w, speed) for w, speed in speeds if w.joint in self._by_effort]
        starts = self._view.joints([w.joint for w, _ in pushed]).positions()
        begin = self._world.time
        headings = [yaw_of(start.rotation)]

        def push() -> None:
            headings.append(yaw_of(self._pose().rotation))
            passed = (self._world.time - begin) / NANOSECONDS
            for (wheel, speed), position in zip(pushed, starts, strict=True):
                self._push_wheel(wheel, speed, position + speed * passed)

        self._run(seconds, push)
        end = self._pose()
        self._view.joints([wheel.joint for wheel in self._wheels]).hold()
        # Summed, as a small robot turns by more than half a turn.
        steps = pairwise([*headings, yaw_of(end.rotation)])
        yaw = math.fsum(math.remainder(after - before, math.tau) for before, after in steps)
        return start.inverse() @ end, yaw

    def _push_wheel(self, wheel: Wheel, speed: float, target: float) -> None:
        """Control a wheel that has only an effort interface: its speed, rad/s, and target, rad."""
        joint = self._view.joints([wheel.joint])
        model = self._world.engine.model
        mass = float(model.body_subtreemass[model.body(f'robot/{self._root}').id])
        inertia = mass * wheel.radius**2 / len(self._wheels)
        (position,), (velocity,) = joint.positions(), joint.velocities()
        acceleration = (speed - velocity) / _EFFORT_RESPONSE + (
            target - position
        ) / _EFFORT_RESPONSE**2
        joint.command(EFFORT, [inertia * acceleration])

    def _settle(self) -> bool:
        """Run until the robot has been still for a while; return False if it never was."""
        still = 0.0
        for _ in range(round(_MAX_SETTLING / _PERIOD)):
            self._run(_PERIOD)
            still = still + _PERIOD if self._is_still() else 0.0
            if still >= _REST_TIME - _PERIOD / 2.0:
                return True
        return False

    def _run(self, seconds: float, each: Callable[[], None] | None = None) -> float:
        """Advance; ``each`` is called before every period. Return the greatest tilt meanwhile."""
        steps = round(_PERIOD * NANOSECONDS / self._world.timestep)
        tilt = 0.0
        for _ in range(round(seconds / _PERIOD)):
            if each is not None:
                each()
            self._world.step(steps)
            if self._errors:
                raise _FailedError(self._errors[0])
            tilt = max(tilt, self._tilt())
            speed = self._speed()
            self._measured['fastest'] = max(speed, self._measured.get('fastest', 0.0))
            if not speed < _MAX_SPEED:
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
    """Return the joints that have a command interface of this name."""
    joints = (joint for hardware in hardware_of(robot) for joint in hardware.joints)
    return {j.name for j in joints if any(i.name == interface for i in j.command_interfaces)}


def _lowest_point(robot: Robot) -> float:
    """Return the height of the lowest colliding point while the root is at the origin, m."""
    world = MujocoWorld('empty')
    # High up: all of it is above the plane to which distances are measured.
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
