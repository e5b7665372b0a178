# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where in a model something went wrong, in the names of the URDF, and what most likely did it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import math

import mujoco
import numpy as np

from amr_description.sim.actuators import rotor_name

_DEEP = 0.005
"""m; bodies that overlap by more are pushed apart with forces that nothing real has."""

_TOO_DEEP = 1.0
"""m; it was thrown there: an effect, no cause."""

_ABSURD = 1e5
"""m/s² or rad/s²."""

_LIGHT = 1e-6
"""kg·m² or kg; what an actuator or a contact moves to any speed within a step."""


_ROTOR = rotor_name('')

_DOWN = np.array([0.0, 0.0, -1.0])
_SINK = 0.1
"""m; what stands on a floor is not deeper in it."""
_SKIP = 1e-6
"""m; a ray goes on so far behind what it has hit."""
_MOST_HITS = 100


@dataclass(frozen=True, slots=True)
class Place:
    """A degree of freedom of a robot."""

    robot: str
    """Empty: it belongs to the world's own file."""
    part: str
    """``joint '…'``, or ``link '…'`` of a robot's root, which moves freely."""
    unit: str
    """Of its velocity."""

    def __str__(self) -> str:
        return f"robot '{self.robot}': {self.part}" if self.robot else self.part


def place_of_dof(model: mujoco.MjModel, dof: int) -> Place:
    """Name an index into ``qvel``."""
    joint = int(model.dof_jntid[dof])
    robot, name = _split(model.joint(joint).name)
    name = name.removesuffix(_ROTOR)
    kind = model.jnt_type[joint]
    if kind == mujoco.mjtJoint.mjJNT_FREE:
        _, link = _split(model.body(int(model.jnt_bodyid[joint])).name)
        unit = 'm/s' if dof - int(model.jnt_dofadr[joint]) < 3 else 'rad/s'
        return Place(robot, f"link '{link}'", unit)
    unit = 'm/s' if kind == mujoco.mjtJoint.mjJNT_SLIDE else 'rad/s'
    return Place(robot, f"joint '{name}'", unit)


def dof_of_position(model: mujoco.MjModel, index: int) -> int:
    """The first degree of freedom of the joint at an index into ``qpos``."""
    joint = int((model.jnt_qposadr <= index).sum()) - 1  # the last that begins there or before
    return int(model.jnt_dofadr[joint])


def place_of_actuator(model: mujoco.MjModel, actuator: int) -> Place:
    """Name an index into ``ctrl``, by the joint that it drives if it drives one."""
    if model.actuator_trntype[actuator] == mujoco.mjtTrn.mjTRN_JOINT:
        return place_of_dof(model, int(model.jnt_dofadr[model.actuator_trnid[actuator, 0]]))
    robot, name = _split(model.actuator(actuator).name)
    return Place(robot, f"actuator '{name}'", '')


def robots_of_dofs(model: mujoco.MjModel, dofs: Sequence[int]) -> list[str]:
    """The robots to which degrees of freedom belong, each once, in order."""
    robots = dict.fromkeys(place_of_dof(model, dof).robot for dof in dofs)
    return [robot for robot in robots if robot]


def _split(name: str) -> tuple[str, str]:
    """Robot and part of a name in the world; what is of the world's own file has no robot."""
    robot, slash, part = name.partition('/')
    return (robot, part) if slash else ('', name)


def has_ground(model: mujoco.MjModel, data: mujoco.MjData, place: np.ndarray) -> bool:
    """Whether there is anything of the world itself below a place (m), or just above it."""
    start, hit = place - _DOWN * _SINK, np.zeros(1, np.int32)
    for _ in range(_MOST_HITS):
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
    The best explanation of a huge velocity (or of what comes after it) at ``dof``, with a remedy.
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
    """A command of the joint that is about as fast as it became."""
    for actuator in _actuators(model):
        command = float(data.ctrl[actuator])
        if int(model.actuator_trnid[actuator, 0]) == joint and abs(command) > abs(velocity) / 2.0:
            return (
                f'it is commanded to {command:.4g}: command less, or give the joint a '
                '<limit velocity="…"> in the URDF'
            )
    return None


def _effort_cause(model: mujoco.MjModel, data: mujoco.MjData, root: int) -> str | None:
    """A motor of the robot whose root is the body ``root``, told to exert an absurd effort."""
    for actuator in _actuators(model):
        joint = int(model.actuator_trnid[actuator, 0])
        is_its_own = model.body_rootid[model.jnt_bodyid[joint]] == root
        if not is_its_own or model.actuator_biastype[actuator] != mujoco.mjtBias.mjBIAS_NONE:
            continue  # of another, or a servo
        effort = float(model.actuator_gainprm[actuator, 0] * data.ctrl[actuator])
        inertia = float(model.dof_M0[model.jnt_dofadr[joint]])
        if abs(effort) > _ABSURD * inertia:
            where = place_of_dof(model, int(model.jnt_dofadr[joint])).part
            return (
                f'{where} is driven with an effort of {effort:.4g}, on an inertia of '
                f'{inertia:.2g}: command less, or give it a <limit effort="…"> in the URDF'
            )
    return None


def _actuators(model: mujoco.MjModel) -> Iterator[int]:
    """Those that drive a joint."""
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
