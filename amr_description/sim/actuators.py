# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Command interfaces of ros2_control as MuJoCo actuators named ``<joint>/<interface>``."""

from collections.abc import Callable
import math

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


ROTOR_MASS, ROTOR_INERTIA = 1e-3, 1e-5
"""kg and kg·m²; small beside any wheel."""

CLUTCH_IMPEDANCE = (0.999, 0.999, 0.001, 0.5, 2.0)
"""Nearly rigid below the limit: at 0.95 a turning robot loses 13 % of its speed in the clutch."""


def actuator_name(joint: str, interface: str) -> str:
    """The name of the actuator behind a command interface."""
    return f'{joint}/{interface}'


def rotor_name(joint: str) -> str:
    """The name of the rotor, its joint and its clutch behind an effort-limited joint."""
    return f'{joint}/rotor'


def speed_limit(joint: Joint) -> float:
    """The velocity limit of the URDF, or FASTEST_JOINT; rad/s or m/s."""
    if joint.limit is not None and joint.limit.velocity > 0.0:
        return joint.limit.velocity
    return FASTEST_JOINT


def effort_limit(joint: Joint) -> float:
    """The effort limit of the URDF, N·m or N; infinite when it has none or writes 0."""
    if joint.limit is not None and joint.limit.effort > 0.0:
        return joint.limit.effort
    return math.inf


def add_velocity_servo(spec: mujoco.MjSpec, joint: Joint) -> None:
    """A servo that holds the joint at the commanded speed, within the limits of the URDF."""
    driven = joint.name
    if math.isfinite(effort_limit(joint)):
        driven = _add_clutch(spec, joint)
    servo = spec.add_actuator(
        name=actuator_name(joint.name, VELOCITY),
        target=driven,
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
    )
    servo.set_to_velocity(kv=SERVO_GAIN)
    servo.dyntype = mujoco.mjtDyn.mjDYN_FILTEREXACT
    servo.dynprm[0] = COMMAND_SMOOTHING
    limit = speed_limit(joint)
    servo.ctrllimited = True
    servo.ctrlrange = [-limit, limit]


def _add_clutch(spec: mujoco.MjSpec, joint: Joint) -> str:
    """
    Put a slip clutch of the joint's effort limit between servo and joint; return what to drive.

    Cutting the force of a stiff servo makes it bang from limit to limit (measured: a robot with a
    limit of 5 N·m hops off the ground). The servo drives a rotor without a load instead, and dry
    friction of the limit's size couples rotor and joint: the solver finds that force together
    with the contacts, and it is exactly the limit once the joint cannot follow.
    """
    moved = spec.joint(joint.name)
    link = moved.parent
    moved.actfrclimited = False
    rotor = link.parent.add_body(name=rotor_name(joint.name), pos=link.pos, quat=link.quat)
    rotor.mass = ROTOR_MASS
    rotor.inertia = [ROTOR_INERTIA] * 3
    rotor.explicitinertial = True
    rotor.add_joint(name=rotor_name(joint.name), type=moved.type, axis=moved.axis)
    clutch = spec.add_tendon(name=rotor_name(joint.name))
    clutch.wrap_joint(joint.name, 1.0)
    clutch.wrap_joint(rotor_name(joint.name), -1.0)
    clutch.frictionloss = effort_limit(joint)
    clutch.solimp_friction = CLUTCH_IMPEDANCE
    return rotor_name(joint.name)


ACTUATORS: dict[str, Callable[[mujoco.MjSpec, Joint], None]] = {VELOCITY: add_velocity_servo}
"""What makes the actuator of a command interface; the simulator takes no other commands."""
