# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Command interfaces of ros2_control as MuJoCo actuators named ``<joint>/<interface>``."""

from collections.abc import Callable

import mujoco

from amr_description.control.interfaces import VELOCITY
from amr_description.model.robot import Joint

SERVO_GAIN = 1e4
"""N·m·s/rad; a stiff speed servo. MuJoCo's discrete integrator solves it with the friction."""

COMMAND_SMOOTHING = 0.02
"""
s; the time constant of the first-order lag between command and servo. A step of the command would
otherwise enter as 250 m/s² of slip acceleration and lift the wheels.
"""

FASTEST_JOINT = 100.0
"""rad/s or m/s; the bound of a command to a joint whose URDF has no velocity limit."""


def actuator_name(joint: str, interface: str) -> str:
    """The name of the actuator behind a command interface."""
    return f'{joint}/{interface}'


def speed_limit(joint: Joint) -> float:
    """The velocity limit of the URDF, or FASTEST_JOINT; rad/s or m/s."""
    if joint.limit is not None and joint.limit.velocity > 0.0:
        return joint.limit.velocity
    return FASTEST_JOINT


def add_velocity_servo(spec: mujoco.MjSpec, joint: Joint) -> None:
    """A servo that brings the joint to the commanded speed within its effort limit."""
    servo = _add(spec, joint, VELOCITY)
    servo.set_to_velocity(kv=SERVO_GAIN)
    servo.dyntype = mujoco.mjtDyn.mjDYN_FILTEREXACT
    servo.dynprm[0] = COMMAND_SMOOTHING
    limit = speed_limit(joint)
    servo.ctrllimited = True
    servo.ctrlrange = [-limit, limit]


def _add(spec: mujoco.MjSpec, joint: Joint, interface: str) -> mujoco.MjsActuator:
    return spec.add_actuator(
        name=actuator_name(joint.name, interface),
        target=joint.name,
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
    )


ACTUATORS: dict[str, Callable[[mujoco.MjSpec, Joint], None]] = {VELOCITY: add_velocity_servo}
"""What makes the actuator of a command interface; the simulator takes no other commands."""
