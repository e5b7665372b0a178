# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which of a joint's actuators act: one command interface at a time, holding still, or none.

An actuator that does not act has the gains 0, so that it exerts exactly no force; one that begins
to act starts from the joint's present motion. The gains are written to the model that runs and to
the spec that the next model is compiled from.

The force that reaches a joint from its actuators.
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


class Mode(enum.StrEnum):
    """What a joint does."""

    POSITION = POSITION
    VELOCITY = VELOCITY
    EFFORT = EFFORT
    HELD = 'held'
    FREE = 'free'


_ACTING: Mapping[Mode, Sequence[str]] = {
    Mode.POSITION: (VELOCITY, POSITION),
    Mode.VELOCITY: (VELOCITY,),
    Mode.EFFORT: (EFFORT,),
    Mode.HELD: (VELOCITY, POSITION),
    Mode.FREE: (),
}
"""The actuators of each mode; see :mod:`amr_description.sim.actuators`."""


class JointActuators:
    """The actuators of one commanded joint."""

    def __init__(self, engine: Engine, robot: str, joint: str) -> None:
        """Bind what :func:`~amr_description.sim.actuators.add_actuators` made."""
        self._engine = engine
        spec = engine.spec
        self._joint = f'{robot}/{joint}'
        rotor = f'{robot}/{rotor_name(joint)}'
        clutch = spec.tendon(rotor)
        self._rotor = '' if clutch is None else rotor
        self._grip = 0.0 if clutch is None else clutch.frictionloss
        names = {i: f'{robot}/{actuator_name(joint, i)}' for i in COMMANDS}
        actuators = {interface: spec.actuator(name) for interface, name in names.items()}
        self._gains = {
            interface: (actuator.gainprm.copy(), actuator.biasprm.copy())
            for interface, actuator in actuators.items()
            if actuator is not None
        }
        self._names = {interface: names[interface] for interface in self._gains}
        self._generation = -1
        self.mode = Mode.FREE
        self.target = math.nan
        """Where the spring pulls while the joint is held, rad or m; NaN if it has none."""
        self.switch(Mode.HELD)

    def switch(self, mode: Mode) -> None:
        """Let other actuators act, without a jolt; commands begin at rest."""
        before, acting = self._acting(self.mode), self._acting(mode)
        joint = self._engine.data.joint(self._joint)
        position, velocity = float(joint.qpos[0]), float(joint.qvel[0])
        if VELOCITY in acting and VELOCITY not in before:
            self._take_rotor_along(position, velocity)
        for interface in self._names:
            self._set_gains(interface, interface in acting)
        for name in self._names.values():
            self._engine.data.actuator(name).ctrl[:] = 0.0
        self._set_grip(VELOCITY in acting)
        self.mode = mode
        self.target = math.nan
        if POSITION in acting:
            # The spring alone brings it to a stop, as the present speed has it.
            self._lag[:] = 0.0
            self.target = self._within_range(position + velocity * POSITION_TIME)
            self.pull_to_target()
        elif VELOCITY in acting and before != acting:
            self._lag[:] = velocity

    def pull_to_target(self) -> None:
        """Pull a joint with a spring to where it is held, by the rotor if it has slipped."""
        if self._generation != self._engine.generation:
            self._find_spring()
        joint, rotor, spring = self._spring
        data = self._engine.data
        data.ctrl[spring] = self.target + data.qpos[rotor] - data.qpos[joint]

    def _find_spring(self) -> None:
        """Where joint, rotor and the spring's target stand in MuJoCo's vectors."""
        model = self._engine.model
        joints = (self._joint, self._rotor or self._joint)
        joint, rotor = (int(model.joint(name).qposadr[0]) for name in joints)
        spring = model.actuator(self._names[POSITION]).id
        self._spring = joint, rotor, int(model.actuator_ctrladr[spring])
        self._generation = self._engine.generation

    @property
    def _lag(self) -> np.ndarray:
        """The smoothed command of the speed servo, rad/s or m/s."""
        address = self._engine.model.actuator(self._names[VELOCITY]).actadr[0]
        return self._engine.data.act[address : address + 1]

    def _acting(self, mode: Mode) -> list[str]:
        return [interface for interface in _ACTING[mode] if interface in self._names]

    def _take_rotor_along(self, position: float, velocity: float) -> None:
        if self._rotor:
            rotor = self._engine.data.joint(self._rotor)
            rotor.qpos[:], rotor.qvel[:] = position, velocity

    def _set_gains(self, interface: str, acts: bool) -> None:
        # Behind an open clutch the servo keeps the rotor from spinning away.
        acts = acts or (interface == VELOCITY and bool(self._rotor))
        name = self._names[interface]
        gains, biases = self._gains[interface]
        for actuator in (self._engine.model.actuator(name), self._engine.spec.actuator(name)):
            actuator.gainprm[:] = gains if acts else 0.0
            actuator.biasprm[:] = biases if acts else 0.0

    def _set_grip(self, closed: bool) -> None:
        """Close or open the clutch."""
        if self._rotor:
            grip = self._grip if closed else 0.0
            model = self._engine.model
            model.tendon_frictionloss[model.tendon(self._rotor).id] = grip
            self._engine.spec.tendon(self._rotor).frictionloss = grip

    def _within_range(self, position: float) -> float:
        joint = self._engine.model.joint(self._joint)
        if not joint.limited[0]:
            return position
        lower, upper = joint.range.tolist()
        return min(max(position, lower), upper)


class JointActuatorSet:
    """The commanded joints of one robot."""

    def __init__(
        self, engine: Engine, robot: str, commands: Mapping[str, Collection[str]]
    ) -> None:
        """``commands``: the command interfaces of each joint; all joints are held."""
        self.commands = commands
        self.changes = 0
        """Counts the switches: who remembers a mode looks here whether it still holds."""
        self._drives = {
            joint: JointActuators(engine, robot, joint)
            for joint, interfaces in commands.items()
            if any(interface in COMMANDS for interface in interfaces)
        }

    def start(self) -> None:
        """Hold all joints, after their state was set."""
        self.changes += 1
        for drive in self._drives.values():
            drive.switch(Mode.FREE)
            drive.switch(Mode.HELD)

    def switch(self, joints: Iterable[str], mode: Mode) -> None:
        """Bring joints into a mode, where they are not in it; one that has no drive is free."""
        for name in joints:
            drive = self._drives.get(name)
            if drive is not None and drive.mode is not mode:
                drive.switch(mode)
                self.changes += 1

    def hold(self, joints: Iterable[str]) -> None:
        """Hold joints; one that has slipped since is brought back."""
        joints = tuple(joints)
        self.switch(joints, Mode.HELD)
        for name in joints:
            drive = self._drives.get(name)
            if drive is not None and not math.isnan(drive.target):
                drive.pull_to_target()


_JOINT = mujoco.mjtObj.mjOBJ_JOINT
_ACTUATOR = mujoco.mjtObj.mjOBJ_ACTUATOR


@dataclass(frozen=True, slots=True)
class _Place:
    """Where a joint and its actuators stand in MuJoCo's vectors; -1 for an actuator it has not."""

    dof: int
    driven: int
    """The rotor's, behind a slip clutch; else the joint's own."""
    servo: int
    spring: int


class EffortReader:
    """
    Reads the actuators' generalised force on some joints during the last physics step.

    MuJoCo tells a servo's force at the velocity before the step, while its discrete integrator
    applies the force at the velocity after it, which for a stiff servo is another matter: by
    h (b_v a + b_p v), with the derivatives b_v and b_p of the force by velocity and position, and
    a and v after the step.
    """

    def __init__(self, engine: Engine, robot: str, joints: Sequence[str]) -> None:
        """Bind joints of the present model; those that nothing drives have no effort."""
        model, data = engine.model, engine.data
        self._places = [_place(model, robot, joint) for joint in joints]
        # The arrays themselves: to look each up in MuJoCo's objects would cost 1 µs.
        self._forces, self._actuator_forces = data.qfrc_actuator, data.actuator_force
        self._velocities, self._accelerations = data.qvel, data.qacc
        self._by_velocity, self._by_position = (model.actuator_biasprm[:, i] for i in (2, 1))
        self._most_forces = model.actuator_forcerange[:, 1]
        self._option = model.opt

    def __call__(self) -> list[float]:
        """N·m or N."""
        is_implicit = self._option.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE
        step = self._option.timestep if is_implicit else 0.0
        return [self._effort(place, step) for place in self._places]

    def _effort(self, place: _Place, step: float) -> float:
        driven, servo, spring = place.driven, place.servo, place.spring
        force = self._forces[driven]
        if driven != place.dof:
            force += self._forces[place.dof]
        if servo >= 0:
            force += step * self._by_velocity[servo] * self._accelerations[driven]
        # A spring whose force is cut off does not depend on the position.
        if spring >= 0 and abs(self._actuator_forces[spring]) < self._most_forces[spring]:
            force += step * self._by_position[spring] * self._velocities[driven]
        return float(force)


def _place(model: mujoco.MjModel, robot: str, joint: str) -> _Place:
    def find(kind: mujoco.mjtObj, name: str) -> int:
        return mujoco.mj_name2id(model, kind, f'{robot}/{name}')

    index, rotor = find(_JOINT, joint), find(_JOINT, rotor_name(joint))
    return _Place(
        dof=int(model.jnt_dofadr[index]),
        driven=int(model.jnt_dofadr[index if rotor < 0 else rotor]),
        servo=find(_ACTUATOR, actuator_name(joint, VELOCITY)),
        spring=find(_ACTUATOR, actuator_name(joint, POSITION)),
    )
