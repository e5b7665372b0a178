# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The force that reaches a joint from its actuators."""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco

from amr_description.control.interfaces import POSITION, VELOCITY
from amr_description.sim.actuators import actuator_name, rotor_name
from amr_description.sim.engine import Engine

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
