# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Faults of the physics: one line of log for each, with robot, joint, value, cause and remedy.

MuJoCo passes its warnings to one callback of the process; without it, it would write a
MUJOCO_LOG.TXT into the user's folder. A step without a fault costs a look at an empty queue and at
two numbers, and a copy of the state. A robot whose state is lost is frozen as it was before, see
:mod:`amr_description.sim.containment`: no number that is not finite leaves the simulator.
"""

from collections import deque
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from dataclasses import dataclass
import math
import re

import mujoco
import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.log import Log, Severity
from amr_description.sim.actuators import rotor_name
from amr_description.sim.containment import Containment
from amr_description.sim.engine import compiler_message, Engine

LIMIT = 0.2
"""rad between the robot's z and the normal of the ground; suspensions give less."""

_SPREAD = 0.02
"""m, root of the mean square; points that are closer to one line make no plane."""

_UPRIGHT = math.cos(LIMIT)


@dataclass(frozen=True, slots=True)
class Tilt:
    """The attitude of a robot against its ground, rad, as roll and pitch of ROS (nose up: < 0)."""

    roll: float
    pitch: float

    def __str__(self) -> str:
        roll, pitch = round(math.degrees(self.roll)), round(math.degrees(self.pitch))
        return f'pitch {pitch} deg (nose {"up" if pitch < 0 else "down"}), roll {roll} deg'

    @property
    def likely_cause(self) -> str:
        """What a robot that drives has done, and what would do."""
        if abs(self.roll) > abs(self.pitch):
            does, limits = 'turns', 'angular.z.max_velocity and angular.z.max_acceleration'
        elif self.pitch < 0.0:
            does, limits = 'speeds up', 'linear.x.max_acceleration'
        else:
            does = 'brakes, or speeds up backwards,'
            limits = 'linear.x.max_deceleration and linear.x.max_acceleration_reverse'
        return (
            f'it {does} harder than its centre of mass allows: limit {limits} of the '
            'diff_drive_controller, or have that centre lower and further from the axle'
        )


def tilt(model: mujoco.MjModel, data: mujoco.MjData, position: int) -> Tilt | None:
    """
    Return how a robot is tilted against its ground; None: by less than the limit, or in the air.

    Args:
        model: Of the world.
        data: Its present state.
        position: Index into ``qpos`` of the robot's free joint.
    """
    axes = np.empty(9)
    mujoco.mju_quat2Mat(axes, data.qpos[position + 3 : position + 7])
    if axes[8] > _UPRIGHT:  # against the horizon: of most robots, at most times
        return None
    normal = _ground_normal(model, data, int((model.jnt_qposadr <= position).sum()) - 1)
    if normal is None:
        return None
    x, y, z = (normal @ axes.reshape(3, 3)).tolist()
    if z > _UPRIGHT:
        return None
    return Tilt(roll=math.atan2(y, z), pitch=math.atan2(-x, math.hypot(y, z)))


def _ground_normal(model: mujoco.MjModel, data: mujoco.MjData, joint: int) -> np.ndarray | None:
    """Return the unit normal of the ground below the robot of a free joint, upwards, if any."""
    root = model.jnt_bodyid[joint]
    is_own = model.body_rootid[model.geom_bodyid[data.contact.geom]] == root
    touching = is_own[:, 0] != is_own[:, 1]
    points = data.contact.pos[touching]
    if not len(points):
        return None
    _, spread, directions = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    if len(spread) > 1 and spread[1] > _SPREAD * math.sqrt(len(points)):
        normal = directions[2]
    else:
        normals = data.contact.frame[touching, :3]
        normal = (normals * np.sign(normals[:, 2:])).sum(axis=0)
    length = float(np.linalg.norm(normal)) * (1.0 if normal[2] > 0.0 else -1.0)
    return normal / length if length else None


FALL_HEIGHT = -0.1
"""m; a robot whose root is below this height, with no ground under it, is falling."""

HIGHEST_SPEED = 2000.0
"""m/s or rad/s; no part of a robot is so fast, not even the rotor of a drone."""

CAPPED_CHECKS = 5
"""Checks in a row that find the solver at its iteration cap before it is logged."""

SLOW_CHECK_INTERVAL = 100_000_000
"""ns of simulated time between two of the checks that are not made after each step."""

TILTED_CHECKS = 3
"""Slow checks in a row that find a robot tilted before it is logged: no kerb takes so long."""

REPEAT_INTERVAL = 5 * NANOSECONDS
"""ns of simulated time without a fault after which it is logged again as a new one."""

_warnings: deque[str] = deque(maxlen=1000)

_BAD_VALUE = re.compile(r'value in (QPOS|QVEL|QACC|CTRL) at \w+ (\d+)')
_QUANTITY = {'QPOS': 'position', 'QVEL': 'velocity', 'QACC': 'acceleration', 'CTRL': 'command'}

_TIPPED = math.cos(math.radians(30.0))
"""Of the angle between the robot's z and what it was at first; what leans so far falls."""
_FREE = 6
"""Degrees of freedom of a body without joints."""
_LOST = 'lost '
_DEEP = 0.005
"""m; bodies that overlap by more are pushed apart with unphysical forces."""

_TOO_DEEP = 1.0
"""m; a deeper overlap is an effect of the fault, not its cause."""

_ABSURD = 1e5
"""m/s² or rad/s²."""

_LIGHT = 1e-6
"""kg·m² or kg; actuators and contacts accelerate less than this to any speed in one step."""
_ROTOR = rotor_name('')
_DOWN = np.array([0.0, 0.0, -1.0])
_SINK = 0.1
"""m; a robot that stands on a floor is not deeper in it."""
_SKIP = 1e-6
"""m; the distance behind a hit at which a ray continues."""
_MAX_HITS = 100
_FEW = 64
"""Degrees of freedom."""


def collect_mujoco_warnings() -> None:
    """Collect the warnings of MuJoCo, of all worlds in this process."""
    mujoco.set_mju_user_warning(_warnings.append)


class FaultMonitor:
    """Checks the state of an engine after its steps and logs faults."""

    def __init__(self, engine: Engine, log: Log) -> None:
        self.on_fault: Callable[[], None] = lambda: None
        """Called after a fault was logged."""
        self._engine = engine
        self._log = log
        self._views = _Views(engine)
        self._containment = Containment(engine)
        self.reset()

    def bind(self) -> None:
        """Take the present model: a robot has come or gone."""
        self._views = _Views(self._engine)
        self._containment.bind()
        for fault in [each for each in self._last_seen if each.startswith(_LOST)]:
            if fault.removeprefix(_LOST) not in self._containment.frozen:
                del self._last_seen[fault]

    def reset(self) -> None:
        """Start anew: time or robots were reset."""
        _warnings.clear()
        self._containment.bind()
        self._last_seen: dict[str, int] = {}
        self._capped = 0
        self._tilted: dict[str, int] = {}
        self._first_axes: dict[str, np.ndarray] = {}
        self._next_slow_check = 0

    @property
    def lost(self) -> tuple[str, ...]:
        """What is frozen since its physics was lost: robots by name, things of the world."""
        return self._containment.frozen

    def release(self, robot: str = '') -> None:
        """Let a robot, or all that is frozen, move again: it was put elsewhere, or reset."""
        if self._containment.holds:
            self._containment.end(robot)
            self.bind()

    def check(self, roots: Iterable[tuple[str, int]], on_wheels: Container[str] = ()) -> None:
        """
        Check the state after a step.

        Args:
            roots: Of each robot that moves freely its name, and the index of the height of its
                root in ``qpos``.
            on_wheels: The names of those that stand on wheels.
        """
        views, containment = self._views, self._containment
        if containment.holds:
            containment.hold()
        if _warnings:
            self._report_warnings()
        if views.has_high_speed():
            self._check_speeds()
        now = self._engine.time
        containment.keep(now)
        if views.is_solver_capped():
            self._check_solver()
        else:
            self._capped = 0
        if now >= self._next_slow_check:
            self._next_slow_check = now + SLOW_CHECK_INTERVAL
            self._check_slowly(roots, on_wheels)

    def _check_slowly(self, roots: Iterable[tuple[str, int]], on_wheels: Container[str]) -> None:
        data = self._engine.data
        data.warning.number[:] = 0  # else MuJoCo warns of each kind once only
        for name, index in roots:
            height = float(data.qpos[index])
            if height < FALL_HEIGHT and not has_ground(
                self._engine.model, data, data.qpos[index - 2 : index + 1]
            ):
                self._report_fall(name, height)
            if name in on_wheels:
                self._check_tilt(name, index - 2)
            else:
                self._check_tipping(name, index - 2)

    # --- warnings of MuJoCo -------------------------------------------------------------------

    def _report_warnings(self) -> None:
        """Report the warnings of a step; what follows from the first lost state is not one."""
        while _warnings:
            text = _warnings.popleft()
            bad = _BAD_VALUE.search(text)
            if bad is None:
                line = f'MuJoCo: {compiler_message(text)}'
                self._report(Severity.WARN, f'mujoco {text[:20]}', line)
            elif bad[1] == 'CTRL':
                self._report_command(int(bad[2]))
            else:
                self._lose_state(bad[1], int(bad[2]))
                _warnings.clear()

    def _report_command(self, actuator: int) -> None:
        name = name_of_actuator(self._engine.model, actuator)
        value = float(self._engine.data.ctrl[actuator])
        self._report(
            Severity.ERROR,
            f'command {name}',
            f'{name}: the command is {value:g}{self._when}; MuJoCo takes all commands of the '
            'world as 0 then. Command finite values',
        )

    def _lose_state(self, quantity: str, index: int) -> None:
        """Freeze the robot of a number that is not finite, or huge; report it once."""
        model, data = self._engine.model, self._engine.data
        dof = dof_of_position(model, index) if quantity == 'QPOS' else index
        name = name_of_dof(model, dof)
        value = float(getattr(data, quantity.lower())[index])
        cause = likely_cause(model, data, dof)
        since = self._containment.freeze(name.robot, dof) / NANOSECONDS
        whose = f"'{name.robot}'" if name.robot else 'what hangs together with it'
        self._report(
            Severity.ERROR,
            f'{_LOST}{name.robot or name}',
            f'{name}: the {_QUANTITY[quantity]} is not finite, or huge, ({value:g}){self._when}; '
            f'{whose} is frozen as it was at {since:.3f} s, until a reset; the rest goes on. '
            f'Likely: {cause}',
        )

    # --- checks of the state ------------------------------------------------------------------

    def _check_speeds(self) -> None:
        speeds = self._engine.data.qvel
        lost = np.flatnonzero(~np.isfinite(speeds))
        if len(lost):  # in the last step: the next one would warn of it
            self._lose_state('QVEL', int(lost[0]))
            return
        dof = int(np.abs(speeds).argmax())
        speed = float(speeds[dof])
        if abs(speed) < HIGHEST_SPEED:
            return
        model = self._engine.model
        name = name_of_dof(model, dof)
        self._report(
            Severity.ERROR,
            f'speed {name}',
            f'{name}: the velocity is {speed:.4g} {name.unit}{self._when}: the physics explodes '
            f'there. Likely: {likely_cause(model, self._engine.data, dof, speed)}',
        )

    def _check_solver(self) -> None:
        data = self._engine.data
        cap = self._engine.model.opt.iterations
        counts = data.solver_niter[: max(1, data.nisland)].tolist()
        self._capped += 1
        if self._capped < CAPPED_CHECKS:
            return
        dofs: Sequence[int] = range(self._engine.model.nv)
        if data.nisland:
            # MuJoCo counts the iterations of the first 20 islands only.
            capped = {island for island, count in enumerate(counts) if count >= cap}
            dofs = [dof for dof, island in enumerate(data.dof_island.tolist()) if island in capped]
        robots = robots_of_dofs(self._engine.model, dofs)
        names = ', '.join(f"'{name}'" for name in robots) or 'none'
        self._report(
            Severity.WARN,
            f'solver {names}',
            f'robot {names}: the solver stops at its cap of {cap} iterations, {self._capped} '
            f'times in a row{self._when}, with {data.ncon} contacts in the world; motions are '
            'less exact. Likely: bodies wedged between others, or actuators far stronger than the '
            'masses they move. Free them, lower the gains, or raise <option iterations="…"/> in '
            'the world',
        )

    def _report_fall(self, name: str, height: float) -> None:
        model = self._engine.model
        shapes = [
            geom
            for geom in range(model.ngeom)
            if model.body(int(model.geom_bodyid[geom])).name.startswith(f'{name}/')
            and (model.geom_contype[geom] or model.geom_conaffinity[geom])
        ]
        cause = (
            'there is no ground where it is: spawn it above the ground, or drive on it'
            if shapes
            else 'none of its links has a <collision>: give it one'
        )
        self._report(
            Severity.ERROR,
            f'fall {name}',
            f"robot '{name}' is below the ground: its root is at z = {height:.2f} m{self._when}. "
            f'Likely: {cause}',
        )

    def _check_tilt(self, name: str, position: int) -> None:
        found = tilt(self._engine.model, self._engine.data, position)
        self._tilted[name] = self._tilted.get(name, 0) + 1 if found else 0
        if found and self._tilted[name] >= TILTED_CHECKS:
            self._report(
                Severity.WARN,
                f'tilt {name}',
                f"robot '{name}' is not on all its wheels: {found}, against the ground"
                f'{self._when}; odometry is wrong while it is so. Likely: {found.likely_cause}',
                is_physical=False,
            )

    def _check_tipping(self, name: str, position: int) -> None:
        """Report that a robot with joints and without wheels lies: an arm that is not fixed."""
        model, axes = self._engine.model, np.empty(9)
        mujoco.mju_quat2Mat(axes, self._engine.data.qpos[position + 3 : position + 7])
        axis = axes[2::3]
        cosine = float(axis @ self._first_axes.setdefault(name, axis))
        if cosine > _TIPPED:
            return
        root = int((model.jnt_qposadr <= position).sum()) - 1
        tree = model.dof_treeid[model.jnt_dofadr[root]]
        if int((model.dof_treeid == tree).sum()) <= _FREE:
            return  # a thing without joints
        angle = round(math.degrees(math.acos(max(-1.0, cosine))))
        self._report(
            Severity.WARN,
            f'tipped {name}',
            f"robot '{name}' has tipped over, by {angle} deg{self._when}. Likely: it is made to "
            'be bolted down, and none of its links is called world: fix it (fixed:=true)',
            is_physical=False,
        )

    # --- reports ------------------------------------------------------------------------------

    @property
    def _when(self) -> str:
        return f' at {self._engine.time / NANOSECONDS:.3f} s'

    def _report(
        self, severity: Severity, fault: str, line: str, *, is_physical: bool = True
    ) -> None:
        """
        Log ``line``, unless ``fault`` has been there since it was last logged.

        Args:
            severity: Of the line.
            fault: Identifies it.
            line: Of the log.
            is_physical: The simulation is wrong, not what was simulated.
        """
        now = self._engine.time
        seen = self._last_seen.get(fault, -math.inf)
        self._last_seen[fault] = now
        if now - seen > REPEAT_INTERVAL:
            self._log(severity, line)
            if is_physical:
                self.on_fault()


class _Views:
    """
    What is looked at after every step, bound once for each model: 1 µs instead of 3, and 11 where
    the caches hold something else, as the code of NumPy and of MuJoCo's bindings after a step.
    """

    __slots__ = ('_data', '_option', '_speeds', '_few_speeds', '_iterations')

    def __init__(self, engine: Engine) -> None:
        self._data, self._option = engine.data, engine.model.opt
        speeds: np.ndarray = engine.data.qvel
        self._speeds = speeds
        self._few_speeds = memoryview(speeds) if 0 < len(speeds) <= _FEW else None
        """The length of so few is found sooner than NumPy is called."""
        self._iterations = memoryview(engine.data.solver_niter)

    def has_high_speed(self) -> bool:
        """Return whether a velocity may be as high as HIGHEST_SPEED, or not finite."""
        few = self._few_speeds
        if few is not None and math.hypot(*few.tolist()) < HIGHEST_SPEED:
            return False
        # A dot product is cheaper than a maximum; a NaN is not below anything.
        return not self._speeds.dot(self._speeds) < HIGHEST_SPEED**2

    def is_solver_capped(self) -> bool:
        """Return whether the solver, in one of its islands, has made all the iterations it may."""
        most = self._option.iterations
        # Behind those of the islands are old numbers.
        if max(self._iterations) < most:
            return False
        return max(self._iterations[: max(1, self._data.nisland)]) >= most


@dataclass(frozen=True, slots=True)
class DofName:
    """The name of a degree of freedom, or of an actuator, in the words of the URDF."""

    robot: str
    """Empty: it belongs to the file of the world."""
    part: str
    """``joint '…'``, or ``link '…'`` for the free joint of a robot's root."""
    unit: str
    """Of its velocity."""

    def __str__(self) -> str:
        return f"robot '{self.robot}': {self.part}" if self.robot else self.part


def name_of_dof(model: mujoco.MjModel, dof: int) -> DofName:
    """Name an index into ``qvel``."""
    joint = int(model.dof_jntid[dof])
    robot, name = _split(model.joint(joint).name)
    name = name.removesuffix(_ROTOR)
    kind = model.jnt_type[joint]
    if kind == mujoco.mjtJoint.mjJNT_FREE:
        _, link = _split(model.body(int(model.jnt_bodyid[joint])).name)
        unit = 'm/s' if dof - int(model.jnt_dofadr[joint]) < 3 else 'rad/s'
        return DofName(robot, f"link '{link}'", unit)
    unit = 'm/s' if kind == mujoco.mjtJoint.mjJNT_SLIDE else 'rad/s'
    return DofName(robot, f"joint '{name}'", unit)


def dof_of_position(model: mujoco.MjModel, index: int) -> int:
    """Return the first degree of freedom of the joint at an index into ``qpos``."""
    joint = int((model.jnt_qposadr <= index).sum()) - 1  # the last that starts there or before
    return int(model.jnt_dofadr[joint])


def name_of_actuator(model: mujoco.MjModel, actuator: int) -> DofName:
    """Name an index into ``ctrl``, by the joint that it drives if it drives one."""
    if model.actuator_trntype[actuator] == mujoco.mjtTrn.mjTRN_JOINT:
        return name_of_dof(model, int(model.jnt_dofadr[model.actuator_trnid[actuator, 0]]))
    robot, name = _split(model.actuator(actuator).name)
    return DofName(robot, f"actuator '{name}'", '')


def robots_of_dofs(model: mujoco.MjModel, dofs: Sequence[int]) -> list[str]:
    """Return the robots to which degrees of freedom belong, each once, in order."""
    robots = dict.fromkeys(name_of_dof(model, dof).robot for dof in dofs)
    return [robot for robot in robots if robot]


def _split(name: str) -> tuple[str, str]:
    """Split a name in the model into robot and part; no robot: the file of the world."""
    robot, slash, part = name.partition('/')
    return (robot, part) if slash else ('', name)


def has_ground(model: mujoco.MjModel, data: mujoco.MjData, position: np.ndarray) -> bool:
    """Return whether a geom of the world is below a position (m), or just above it."""
    start, hit = position - _DOWN * _SINK, np.zeros(1, np.int32)
    for _ in range(_MAX_HITS):
        distance = mujoco.mj_ray(model, data, start, _DOWN, None, 1, -1, hit)
        if hit[0] < 0:
            return False
        if model.body_weldid[model.geom_bodyid[hit[0]]] == 0:
            return True
        start = start + _DOWN * (distance + _SKIP)  # through a robot
    return False


def likely_cause(
    model: mujoco.MjModel, data: mujoco.MjData, dof: int, velocity: float = math.inf
) -> str:
    """
    Return the most likely cause of a huge velocity, or of a state lost by it, with a remedy.

    Args:
        model: Of the world.
        data: Its present state.
        dof: Index into ``qvel`` where it was found.
        velocity: There; infinite if it is not known.
    """
    root = int(model.body_rootid[model.dof_bodyid[dof]])
    return (
        _command_cause(model, data, int(model.dof_jntid[dof]), velocity)
        or _effort_cause(model, data, root)
        or _inertia_cause(model, dof)
        or _overlap_cause(model, data, root)
        or 'look at the masses and inertias there, at the gains and limits of its actuators, and '
        'at what was commanded'
    )


def _command_cause(
    model: mujoco.MjModel, data: mujoco.MjData, joint: int, velocity: float
) -> str | None:
    """A command to the joint that is about as large as its velocity."""
    for actuator in _actuators(model):
        command = float(data.ctrl[actuator])
        if int(model.actuator_trnid[actuator, 0]) == joint and abs(command) > abs(velocity) / 2.0:
            return (
                f'it is commanded to {command:.4g}: command less, or give the joint a '
                '<limit velocity="…"> in the URDF'
            )
    return None


def _effort_cause(model: mujoco.MjModel, data: mujoco.MjData, root: int) -> str | None:
    """An absurd effort commanded to a motor of the robot whose root is the body ``root``."""
    for actuator in _actuators(model):
        joint = int(model.actuator_trnid[actuator, 0])
        is_its_own = model.body_rootid[model.jnt_bodyid[joint]] == root
        if not is_its_own or model.actuator_biastype[actuator] != mujoco.mjtBias.mjBIAS_NONE:
            continue  # of another robot, or a servo
        effort = float(model.actuator_gainprm[actuator, 0] * data.ctrl[actuator])
        inertia = float(model.dof_M0[model.jnt_dofadr[joint]])
        if abs(effort) > _ABSURD * inertia:
            part = name_of_dof(model, int(model.jnt_dofadr[joint])).part
            return (
                f'{part} is driven with an effort of {effort:.4g}, on an inertia of '
                f'{inertia:.2g}: lower the gains (p, i, d) of the controller that commands it, or '
                'give it a <limit effort="…"> in the URDF'
            )
    return None


def _actuators(model: mujoco.MjModel) -> Iterator[int]:
    """Yield the actuators that drive a joint."""
    joints = model.actuator_trntype == mujoco.mjtTrn.mjTRN_JOINT
    return (index for index in range(model.nu) if joints[index])


def _inertia_cause(model: mujoco.MjModel, dof: int) -> str | None:
    inertia = float(model.dof_M0[dof])
    if inertia >= _LIGHT:
        return None
    _, link = _split(model.body(int(model.dof_bodyid[dof])).name)
    return (
        f'what moves there has an inertia of only {inertia:.2g}: correct <inertial> of link '
        f"'{link}' (a kilogram of 0.1 m has about 0.002 kg·m²)"
    )


def _overlap_cause(model: mujoco.MjModel, data: mujoco.MjData, root: int) -> str | None:
    """The deepest contact of the robot whose root is the body ``root``."""
    deepest, bodies = -_DEEP, None
    for contact in data.contact:
        pair = [int(model.geom_bodyid[geom]) for geom in contact.geom]
        is_its_own = root in (model.body_rootid[body] for body in pair)
        if is_its_own and -_TOO_DEEP < contact.dist < deepest:
            deepest, bodies = float(contact.dist), pair
    if bodies is None:
        return None
    one, other = (model.body(body).name for body in bodies)
    return (
        f"'{one}' and '{other}' are {-deepest:.3f} m inside each other: put them apart, at the "
        'spawn or in the URDF'
    )
