# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A servo that moves the body of a robot over the ground: Gazebo's planar move.

Gazebo sets the velocity of the body, again and again, and lets the solver do what it likes in
between. Here three speed servos act on the body, along x and y and about z of the root link, so
stiff that the friction of its wheels is nothing to them::

    F = m / τ · (v_commanded − v),   τ = 20 µs:   μ = 1 costs 0.2 mm/s

They act at the centre of mass, so that accelerating does not tip the robot over. Height, roll and
pitch are left to gravity and the wheels, where Gazebo's Classic sets them to zero, too.
"""

import math

import mujoco
import numpy as np

from amr_description.model.base_interfaces import COMMAND_AXES
from amr_description.sim.actuators import COMMAND_SMOOTHING

_TIME = 2e-5
"""s, τ."""
_CENTRE = 'gazebo_base/centre_of_mass'
_GEARS = ((1, 0, 0, 0, 0, 0), (0, 1, 0, 0, 0, 0), (0, 0, 0, 0, 0, 1))


def add_base_servo(spec: mujoco.MjSpec, free_joint: str) -> None:
    """
    Add the servos to the spec of one robot.

    Args:
        spec: Edited.
        free_joint: The name of the root's free joint.
    """
    model = spec.copy().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    joint = model.joint(free_joint)
    body, first = int(joint.bodyid[0]), int(joint.dofadr[0])
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)
    mass, about_z = inertia[first, first], inertia[first + 5, first + 5]
    centre = data.xmat[body].reshape(3, 3).T @ (data.subtree_com[body] - data.xpos[body])
    spec.worldbody.first_body().add_site(name=_CENTRE, pos=centre)
    for axis, gear, moved in zip(COMMAND_AXES, _GEARS, (mass, mass, about_z), strict=True):
        servo = spec.add_actuator(
            name=servo_name(axis),
            target=_CENTRE,
            trntype=mujoco.mjtTrn.mjTRN_SITE,
        )
        servo.gear = gear
        servo.set_to_velocity(kv=moved / _TIME)
        servo.dyntype = mujoco.mjtDyn.mjDYN_FILTEREXACT
        servo.dynprm[0] = COMMAND_SMOOTHING


def servo_name(axis: str) -> str:
    """Return the name of the servo of one of the command axes."""
    return f'gazebo_base/{axis}'


def command_base_servo(
    model: mujoco.MjModel, data: mujoco.MjData, robot: str, twist: tuple[float, float, float]
) -> None:
    """
    Command the velocity of a robot's root link, in its own axes: m/s, m/s, rad/s.

    The centre of mass c then moves with ``v + ω × c``.
    """
    x, y, yaw = twist
    c_x, c_y, _ = model.site(f'{robot}/{_CENTRE}').pos
    values = x - yaw * c_y, y + yaw * c_x, yaw
    for axis, value in zip(COMMAND_AXES, values, strict=True):
        if not math.isfinite(value):
            raise ValueError(f'a velocity of {value} is commanded')
        data.actuator(f'{robot}/{servo_name(axis)}').ctrl[:] = value
