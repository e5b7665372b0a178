# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The mode of each joint's actuators, and the force that they exert.

A joint follows one command interface at a time, is held, or is free. The gains of an inactive
actuator are 0, so that it exerts exactly no force; one that becomes active starts from the joint's
present motion. Gains are written to the running model and to the spec, from which the next model
is compiled.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
import enum
import math

import mujoco
import numpy as np

from amr_description.control.interfaces import EFFORT, POSITION, VELOCITY
from amr_description.sim.actuators import actuator_name, COMMANDS, POSITION_TIME, rotor_name
from amr_description.sim.engine import Engine

_JOINT = mujoco.mjtObj.mjOBJ_JOINT
_ACTUATOR = mujoco.mjtObj.mjOBJ_ACTUATOR


class ActuatorMode(enum.StrEnum):
    """What a joint follows: a command interface, the position at which it is held, or nothing."""

    POSITION = POSITION
    VELOCITY = VELOCITY
    EFFORT = EFFORT
    HELD = 'held'
    FREE = 'free'


_ACTIVE: Mapping[ActuatorMode, Sequence[str]] = {
    ActuatorMode.POSITION: (VELOCITY, POSITION),
    ActuatorMode.VELOCITY: (VELOCITY,),
    ActuatorMode.EFFORT: (EFFORT,),
    ActuatorMode.HELD: (VELOCITY, POSITION),
    ActuatorMode.FREE: (),
}
"""The active actuators of each mode; see :mod:`amr_description.sim.actuators`."""
NO_TARGETS: Mapping[str, float] = {}


class RobotActuators:
    """The actuators of one robot: of each joint that has a command interface."""

    def __init__(
        self, engine: Engine, robot: str, commands: Mapping[str, Collection[str]]
    ) -> None:
        """Hold all joints. ``commands``: joint → its command interfaces."""
        self.commands = commands
        self.changes = 0
        """
        How often a mode was switched, or a joint commanded by somebody else; a changed count
        invalidates what is remembered of both.
        """
        self._commanders: dict[str, object] = {}
        self._joints = {
            joint: JointActuators(engine, robot, joint)
            for joint, interfaces in commands.items()
            if any(interface in COMMANDS for interface in interfaces)
        }

    def start(self) -> None:
        """Hold all joints, after their positions and velocities were set."""
        self.changes += 1
        for actuators in self._joints.values():
            actuators.switch(ActuatorMode.FREE)
            actuators.switch(ActuatorMode.HELD)

    def switch(self, joints: Iterable[str], mode: ActuatorMode) -> None:
        """Switch joints to a mode; those without actuators are always free."""
        for name in joints:
            actuators = self._joints.get(name)
            if actuators is not None and actuators.mode is not mode:
                actuators.switch(mode)
                self.changes += 1

    def command(self, joints: Iterable[str], mode: ActuatorMode, commander: object) -> None:
        """Switch joints to the mode of commands, which ``commander`` writes from now on."""
        self.switch(joints, mode)
        for name in joints:
            if self._commanders.get(name) is not commander:
                self._commanders[name] = commander
                self.changes += 1

    def hold(
        self, joints: Iterable[str], targets: Mapping[str, float] = NO_TARGETS
    ) -> Mapping[str, float]:
        """
        Hold joints; one that has slipped meanwhile is pulled back.

        Args:
            joints: Their names.
            targets: Where each is held, rad or m; one without: where it stops.

        Returns:
            The targets of those that a spring holds.
        """
        joints = tuple(joints)
        self.switch(joints, ActuatorMode.HELD)
        held: dict[str, float] = {}
        for name in joints:
            actuators = self._joints.get(name)
            if actuators is not None and not math.isnan(actuators.target):
                held[name] = actuators.target = targets.get(name, actuators.target)
                actuators.pull_to_target()
        return held


class JointActuators:
    """The actuators of one joint, and its clutch if it has one."""

    def __init__(self, engine: Engine, robot: str, joint: str) -> None:
        """Bind what :func:`~amr_description.sim.actuators.add_actuators` added; hold the joint."""
        self._engine = engine
        spec = engine.spec
        self._joint = f'{robot}/{joint}'
        rotor = f'{robot}/{rotor_name(joint)}'
        clutch = spec.tendon(rotor)
        self._rotor = '' if clutch is None else rotor
        self._clutch_friction = 0.0 if clutch is None else clutch.frictionloss
        names = {i: f'{robot}/{actuator_name(joint, i)}' for i in COMMANDS}
        actuators = {interface: spec.actuator(name) for interface, name in names.items()}
        self._gains = {
            interface: (actuator.gainprm.copy(), actuator.biasprm.copy())
            for interface, actuator in actuators.items()
            if actuator is not None
        }
        self._names = {interface: names[interface] for interface in self._gains}
        self._generation = -1
        self.mode = ActuatorMode.FREE
        self.target = math.nan
        """Where the spring pulls to while the joint is held, rad or m; NaN without a spring."""
        self.switch(ActuatorMode.HELD)

    def switch(self, mode: ActuatorMode) -> None:
        """Activate the actuators of a mode without a jolt; their commands start at 0."""
        before, active = self._active(self.mode), self._active(mode)
        joint = self._engine.data.joint(self._joint)
        position, velocity = float(joint.qpos[0]), float(joint.qvel[0])
        if VELOCITY in active and VELOCITY not in before:
            self._align_rotor(position, velocity)
        for interface in self._names:
            self._set_gains(interface, interface in active)
        for name in self._names.values():
            self._engine.data.actuator(name).ctrl[:] = 0.0
        self._set_clutch(VELOCITY in active)
        self.mode = mode
        self.target = math.nan
        if POSITION in active:
            # The spring alone stops the joint, at the target that follows from its present speed.
            self._smoothed_command[:] = 0.0
            self.target = self._within_range(position + velocity * POSITION_TIME)
            self.pull_to_target()
        elif VELOCITY in active and before != active:
            self._smoothed_command[:] = velocity

    def pull_to_target(self) -> None:
        """Set the spring of a held joint to its target, corrected by the slip of the clutch."""
        if self._generation != self._engine.generation:
            self._bind_spring()
        joint, rotor, spring = self._spring
        data = self._engine.data
        data.ctrl[spring] = self.target + data.qpos[rotor] - data.qpos[joint]

    def _bind_spring(self) -> None:
        """Look up the addresses of joint, rotor and spring command in MuJoCo's vectors."""
        model = self._engine.model
        joints = (self._joint, self._rotor or self._joint)
        joint, rotor = (int(model.joint(name).qposadr[0]) for name in joints)
        spring = model.actuator(self._names[POSITION]).id
        self._spring = joint, rotor, int(model.actuator_ctrladr[spring])
        self._generation = self._engine.generation

    @property
    def _smoothed_command(self) -> np.ndarray:
        """A view of the speed servo's command after its first-order lag, rad/s or m/s."""
        address = self._engine.model.actuator(self._names[VELOCITY]).actadr[0]
        return self._engine.data.act[address : address + 1]

    def _active(self, mode: ActuatorMode) -> list[str]:
        return [interface for interface in _ACTIVE[mode] if interface in self._names]

    def _align_rotor(self, position: float, velocity: float) -> None:
        if self._rotor:
            rotor = self._engine.data.joint(self._rotor)
            rotor.qpos[:], rotor.qvel[:] = position, velocity

    def _set_gains(self, interface: str, is_active: bool) -> None:
        # Behind an open clutch the servo keeps the rotor from spinning up.
        is_active = is_active or (interface == VELOCITY and bool(self._rotor))
        name = self._names[interface]
        gains, biases = self._gains[interface]
        for actuator in (self._engine.model.actuator(name), self._engine.spec.actuator(name)):
            actuator.gainprm[:] = gains if is_active else 0.0
            actuator.biasprm[:] = biases if is_active else 0.0

    def _set_clutch(self, closed: bool) -> None:
        """Close or open the clutch: its friction loss is the effort limit, or 0."""
        if self._rotor:
            friction = self._clutch_friction if closed else 0.0
            model = self._engine.model
            model.tendon_frictionloss[model.tendon(self._rotor).id] = friction
            self._engine.spec.tendon(self._rotor).frictionloss = friction

    def _within_range(self, position: float) -> float:
        joint = self._engine.model.joint(self._joint)
        if not joint.limited[0]:
            return position
        lower, upper = joint.range.tolist()
        return min(max(position, lower), upper)


@dataclass(frozen=True, slots=True)
class _JointAddresses:
    """The indices of a joint and its actuators in MuJoCo's vectors; -1: no such actuator."""

    dof: int
    driven: int
    """The degree of freedom of the rotor, of a joint with a clutch; else that of the joint."""
    servo: int
    spring: int


class EffortReader:
    """
    Reads the generalised force of the actuators on some joints during the last physics step.

    MuJoCo reports a servo's force at the velocity before the step, while its discrete integrator
    applies the force at the velocity after it. For a stiff servo the two differ much: by
    h (b_v a + b_p v), with the derivatives b_v and b_p of the force by velocity and position, and
    a and v after the step.
    """

    def __init__(self, engine: Engine, robot: str, joints: Sequence[str]) -> None:
        """Bind joints of the present model; the effort of one without actuators is 0."""
        model, data = engine.model, engine.data
        self._joints = [_addresses_of(model, robot, joint) for joint in joints]
        # The arrays themselves: an attribute of MuJoCo's objects costs 1 µs per access.
        self._forces, self._actuator_forces = data.qfrc_actuator, data.actuator_force
        self._velocities, self._accelerations = data.qvel, data.qacc
        self._by_velocity, self._by_position = (model.actuator_biasprm[:, i] for i in (2, 1))
        self._force_limits = model.actuator_forcerange[:, 1]
        self._option = model.opt

    def __call__(self) -> list[float]:
        """N·m or N."""
        is_implicit = self._option.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE
        step = self._option.timestep if is_implicit else 0.0
        return [self._effort(joint, step) for joint in self._joints]

    def _effort(self, joint: _JointAddresses, step: float) -> float:
        driven, servo, spring = joint.driven, joint.servo, joint.spring
        force = self._forces[driven]
        if driven != joint.dof:
            force += self._forces[joint.dof]
        if servo >= 0:
            force += step * self._by_velocity[servo] * self._accelerations[driven]
        # The force of a saturated spring does not depend on the position.
        if spring >= 0 and abs(self._actuator_forces[spring]) < self._force_limits[spring]:
            force += step * self._by_position[spring] * self._velocities[driven]
        return float(force)


def _addresses_of(model: mujoco.MjModel, robot: str, joint: str) -> _JointAddresses:
    def find(kind: mujoco.mjtObj, name: str) -> int:
        return mujoco.mj_name2id(model, kind, f'{robot}/{name}')

    index, rotor = find(_JOINT, joint), find(_JOINT, rotor_name(joint))
    return _JointAddresses(
        dof=int(model.jnt_dofadr[index]),
        driven=int(model.jnt_dofadr[index if rotor < 0 else rotor]),
        servo=find(_ACTUATOR, actuator_name(joint, VELOCITY)),
        spring=find(_ACTUATOR, actuator_name(joint, POSITION)),
    )
