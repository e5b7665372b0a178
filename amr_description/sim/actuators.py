# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Command interfaces of ros2_control as MuJoCo actuators named ``<joint>/<interface>``.

A commanded joint has a stiff **speed servo**. On top of it a **spring** pulls towards a target
position; its force is limited to ``servo gain · velocity limit``, so that together they are a
cascade: speed = (target - position) / :data:`POSITION_TIME`, within the velocity limit, whatever
the load and the inertia. A **motor** exerts the commanded effort. Which of them act is decided in
:mod:`amr_description.sim.actuator_modes`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math

import mujoco

from amr_description.control.interfaces import EFFORT, POSITION, VELOCITY
from amr_description.model.robot import Joint, JointType

COMMANDS = (POSITION, VELOCITY, EFFORT)
"""The command interfaces of a simulated joint."""

SERVO_GAIN = 1e4
"""N·m·s/rad, of the speed servo. MuJoCo's discrete integrator solves it with the friction."""

LOAD_SERVO_GAIN = 1e6
"""
The same, of a joint that may carry a load. Measured on a slide: 200 kg sink by 0.08 mm and 2000 kg
by 0.8 mm; with 1e4 it would be a hundred times as much, and anything above 100 kg would overshoot.
"""

COMMAND_SMOOTHING = 0.02
"""
s; the time constant of the first-order lag between command and servo. A step of the command would
otherwise enter as 250 m/s² of slip acceleration and lift the wheels.
"""

POSITION_TIME = 0.04
"""
s; the time constant with which a position is approached. Measured on an arm of two links, 3 kg and
0.9 m, with steps of 1 to 1.5 rad at 3 rad/s and a load of 13 N·m: no overshoot down to motors of
30 N·m, 8 % with 20 N·m, which cannot brake it in time; at 0.02 s 5 % and 14 %.
"""

FASTEST_JOINT = 100.0
"""rad/s or m/s; the velocity limit of a joint whose URDF has none."""

LARGEST_COMMAND = 1e10
"""MuJoCo accepts no larger number."""

ROTOR_MASS, ROTOR_INERTIA = 1e-3, 1e-5
"""kg and kg·m²; small compared with any wheel."""

CLUTCH_SOLREF, CLUTCH_IMPEDANCE = (0.004, 1.0), (0.9999, 0.9999, 0.001, 0.5, 2.0)
"""
Nearly rigid below the limit: at an impedance of 0.95 a turning robot loses 13 % of its speed in
the clutch; at 0.999 and MuJoCo's time constant (0.02 s) an arm sinks by 1 degree a minute. With
these it sinks by 0.04 degrees, unless
:meth:`~amr_description.sim.actuator_modes.RobotActuators.hold` corrects that.
"""

LIMIT_SOLREF, LIMIT_IMPEDANCE = (0.004, 1.0), (0.99, 0.999, 0.001, 0.5, 2.0)
"""A hard end stop; with MuJoCo's own a motor of 100 N·m pushes the joint 8 mrad beyond."""


@dataclass(frozen=True, slots=True)
class CommandBounds:
    """The smallest and the largest command; rad, rad/s, N·m or m, m/s, N."""

    lower: float
    upper: float

    def __str__(self) -> str:
        if self.lower == -self.upper:
            return f'its limit of {self.upper:.6g}'
        return f'its limits of {self.lower:.6g} to {self.upper:.6g}'


def actuator_name(joint: str, interface: str) -> str:
    """Return the name of the actuator behind a command interface."""
    return f'{joint}/{interface}'


def rotor_name(joint: str) -> str:
    """Return the name of the rotor of an effort-limited joint, of its joint and of its clutch."""
    return f'{joint}/rotor'


def speed_limit(joint: Joint) -> float:
    """Return the velocity limit of the URDF, or FASTEST_JOINT; rad/s or m/s."""
    if joint.limit is not None and joint.limit.velocity > 0.0:
        return joint.limit.velocity
    return FASTEST_JOINT


def effort_limit(joint: Joint) -> float:
    """Return the effort limit of the URDF, N·m or N; infinite without one, or where it is 0."""
    if joint.limit is not None and joint.limit.effort > 0.0:
        return joint.limit.effort
    return math.inf


def command_bounds(joint: Joint, interface: str) -> CommandBounds:
    """Return the range of commands to ``interface`` that the URDF allows; always finite."""
    if interface == VELOCITY:
        most = speed_limit(joint)
    elif interface == EFFORT:
        most = min(effort_limit(joint), LARGEST_COMMAND)
    elif joint.limit is not None and joint.type is not JointType.CONTINUOUS:
        return CommandBounds(joint.limit.lower, joint.limit.upper)
    else:
        most = LARGEST_COMMAND
    return CommandBounds(-most, most)


def add_actuators(spec: mujoco.MjSpec, joint: Joint, interfaces: Sequence[str]) -> None:
    """
    Add the actuators that a joint needs for its command interfaces and to be held without command.

    A continuous joint that is only commanded by velocity, such as a wheel, is held by its speed
    servo alone; any other, which may carry a load, also by a spring.

    Args:
        spec: Edited.
        joint: Of the robot in ``spec``.
        interfaces: The names of its command interfaces.
    """
    if not any(interface in COMMANDS for interface in interfaces):
        return
    # Clutch and motor command apply the effort limit; MuJoCo's force limit makes servos chatter.
    moved = spec.joint(joint.name)
    moved.actfrclimited = False
    moved.solref_limit, moved.solimp_limit = LIMIT_SOLREF, LIMIT_IMPEDANCE
    driven = joint.name
    if math.isfinite(effort_limit(joint)):
        driven = _add_clutch(spec, joint)
    carries = joint.type is not JointType.CONTINUOUS or bool({POSITION, EFFORT} & {*interfaces})
    gain = LOAD_SERVO_GAIN if carries else SERVO_GAIN
    _add_servo(spec, joint, driven, gain)
    if carries:
        _add_spring(spec, joint, driven, gain)
    if EFFORT in interfaces:
        _add(spec, joint.name, EFFORT, joint.name).set_to_motor()


def _add(spec: mujoco.MjSpec, joint: str, interface: str, driven: str) -> mujoco.MjsActuator:
    return spec.add_actuator(
        name=actuator_name(joint, interface),
        target=driven,
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
    )


def _add_servo(spec: mujoco.MjSpec, joint: Joint, driven: str, gain: float) -> None:
    """Add the servo that holds the joint at a speed."""
    servo = _add(spec, joint.name, VELOCITY, driven)
    servo.set_to_velocity(kv=gain)
    servo.dyntype = mujoco.mjtDyn.mjDYN_FILTEREXACT
    servo.dynprm[0] = COMMAND_SMOOTHING
    limit = speed_limit(joint)
    servo.ctrllimited = True
    servo.ctrlrange = [-limit, limit]


def _add_spring(spec: mujoco.MjSpec, joint: Joint, driven: str, gain: float) -> None:
    """Add the spring that pulls the joint to a position; the servo is its damping."""
    spring = _add(spec, joint.name, POSITION, driven)
    spring.set_to_position(kp=gain / POSITION_TIME)
    force = gain * speed_limit(joint)
    spring.forcelimited = True
    spring.forcerange = [-force, force]


def _add_clutch(spec: mujoco.MjSpec, joint: Joint) -> str:
    """
    Put a slip clutch with the joint's effort limit between servo and joint; return the rotor.

    A stiff servo whose force is limited jumps from limit to limit (measured: a robot with a limit
    of 5 N·m hops off the ground). Instead the servo drives a rotor without load, and dry friction
    of the limit's size couples rotor and joint: the solver finds that force together with the
    contacts, and it equals the limit exactly once the joint cannot follow.
    """
    link = spec.joint(joint.name).parent
    moved = spec.joint(joint.name)
    rotor = link.parent.add_body(name=rotor_name(joint.name), pos=link.pos, quat=link.quat)
    rotor.mass = ROTOR_MASS
    rotor.inertia = [ROTOR_INERTIA] * 3
    rotor.explicitinertial = True
    rotor.gravcomp = 1.0  # it has a mass for the solver only, no weight
    rotor.add_joint(name=rotor_name(joint.name), type=moved.type, axis=moved.axis)
    clutch = spec.add_tendon(name=rotor_name(joint.name))
    clutch.wrap_joint(joint.name, 1.0)
    clutch.wrap_joint(rotor_name(joint.name), -1.0)
    clutch.frictionloss = effort_limit(joint)
    clutch.solref_friction = CLUTCH_SOLREF
    clutch.solimp_friction = CLUTCH_IMPEDANCE
    return rotor_name(joint.name)
