# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The force that reaches a joint from its actuators."""

from collections.abc import Sequence

import mujoco
import numpy as np

from amr_description.control.interfaces import POSITION, VELOCITY
from amr_description.sim.actuators import actuator_name, rotor_name
from amr_description.sim.engine import Engine, NANOSECONDS


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
        self._model, self._data = engine.model, engine.data
        self._step = engine.timestep / NANOSECONDS
        self._dofs = self._addresses(robot, joints)
        rotors = self._addresses(robot, [rotor_name(joint) for joint in joints])
        self._has_rotor = rotors >= 0
        # Behind a slip clutch servo and spring work on the rotor.
        self._driven = np.where(self._has_rotor, rotors, self._dofs)
        self._servos = self._actuators(robot, joints, VELOCITY)
        self._springs = self._actuators(robot, joints, POSITION)

    def __call__(self) -> list[float]:
        """N·m or N."""
        model, data = self._model, self._data
        force = data.qfrc_actuator[self._driven]
        force += self._has_rotor * data.qfrc_actuator[self._dofs]
        if model.opt.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE:
            has_servo, servos = self._servos
            damping = has_servo * model.actuator_biasprm[servos, 2]
            has_spring, springs = self._springs
            cut_off = np.abs(data.actuator_force[springs]) >= model.actuator_forcerange[springs, 1]
            stiffness = (has_spring & ~cut_off) * model.actuator_biasprm[springs, 1]
            acceleration, velocity = data.qacc[self._driven], data.qvel[self._driven]
            force += self._step * (damping * acceleration + stiffness * velocity)
        return force.tolist()

    def _addresses(self, robot: str, joints: Sequence[str]) -> np.ndarray:
        """Where the joints stand in MuJoCo's velocities; -1 for one that is not there."""
        kind = mujoco.mjtObj.mjOBJ_JOINT
        indices = [mujoco.mj_name2id(self._model, kind, f'{robot}/{joint}') for joint in joints]
        return np.array([-1 if i < 0 else self._model.jnt_dofadr[i] for i in indices], int)

    def _actuators(
        self, robot: str, joints: Sequence[str], interface: str
    ) -> tuple[np.ndarray, np.ndarray]:
        """Whether each joint has this actuator, and its index, any for one that has none."""
        kind = mujoco.mjtObj.mjOBJ_ACTUATOR
        names = [f'{robot}/{actuator_name(joint, interface)}' for joint in joints]
        indices = np.array([mujoco.mj_name2id(self._model, kind, name) for name in names], int)
        return indices >= 0, np.maximum(indices, 0)
