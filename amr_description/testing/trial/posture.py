# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How a robot is there, at rest and after each motion: upright, on something, and finite.

One that stands on legs is asked for what these can do while they stand. A leg that bends in its
own plane lifts or lowers the robot, and its foot stays where it is. A hip that spreads legs pushes
feet over the ground: what holds them, friction times the weight, is as much as many motors can do.
So joints that turn a leg about another axis than across are held.
"""

import math

from amr_description.model.frames import rotate
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import held_without_commands, Joint, JointType, Robot
from amr_description.simulation.readings import Motion
from amr_description.testing.simulation import Simulation
from amr_description.testing.trial.bring_up import logged
from amr_description.testing.trial.findings import RestResult

REST = 3.0
"""s without a command."""
REST_WITHIN = 2.0
"""s in which a robot is to stand."""
BOLTED_DOWN = (
    'as what is made to be bolted down does: none of its links is called world, fixed:=true'
)
_STILL_LINEAR, _STILL_ANGULAR = 0.01, 0.05
"""m/s and rad/s; a slower robot stands."""
_EXPLOSION = 5.0
"""m/s: a fall from more than a metre, which nothing spawned on the ground has before it."""
_FALLEN = 0.5
"""m, below where it was spawned."""
_TIPPED = math.radians(15.0)
"""rad; more than springs give a robot that stands, or that brakes."""
_SAMPLE = 0.1
"""s between two looks at a robot at rest."""
_STRAIGHT_UP = (0.0, 0.0, 1.0)
_FROZEN = 'is frozen as it was'
_TOUCHES_NOTHING = 'no shape of it touches anything'
_LEG = 3
"""So many joints or more has a leg."""
_ACROSS = 0.7
"""Of an axis, along y of the root; more than half of its turn is in the leg's plane."""
_REACH = 0.1
"""m; what ends so much higher than the lowest limb is no leg."""


def tilt_between(before: Motion, now: Motion) -> float:
    """Return the angle between the z axes of a robot at two instants, rad."""
    one, other = (rotate(each.pose.rotation, _STRAIGHT_UP) for each in (before, now))
    cosine = sum(a * b for a, b in zip(one, other, strict=True))
    return math.acos(max(-1.0, min(1.0, cosine)))


class Posture:
    """Looks at one robot, against how it was spawned."""

    def __init__(self, sim: Simulation, *, rolls: bool = False) -> None:
        """Take how it is now; ``rolls``: whether it has wheels."""
        self._sim, self._rolls = sim, rolls
        self._begin = sim.truth

    def rest(self) -> tuple[RestResult, list[str]]:
        """Let :data:`REST` pass; return how it has stood, and what is wrong with that."""
        sim, begin = self._sim, self._begin
        fastest, last_moving = 0.0, 0.0
        now = begin
        while sim.time < REST - 1e-6:
            sim.run(_SAMPLE)
            now = sim.truth
            speed, turn = math.hypot(*now.linear), math.hypot(*now.angular)
            if self.lost():
                break
            fastest = max(fastest, speed)
            if speed > _STILL_LINEAR or turn > _STILL_ANGULAR:
                last_moving = sim.time
        rest = RestResult(
            seconds=last_moving if last_moving < REST - 1e-6 else math.inf,
            fastest=fastest,
            drop=begin.z - now.z,
            shift=math.hypot(now.x - begin.x, now.y - begin.y),
            tilt=tilt_between(begin, now),
        )
        if faults := self.faults():
            return rest, faults
        if fastest > _EXPLOSION:
            return rest, [f'it explodes: {fastest:.1f} m/s']
        if rest.seconds > REST_WITHIN:
            return rest, [unrest(math.hypot(*now.linear), math.hypot(*now.angular))]
        return rest, []

    def lost(self) -> str:
        """Return what the simulator says of a state that it has lost; '': it has not."""
        now = self._sim.truth
        lines = [line for line in logged(self._sim.log) if _FROZEN in line]
        if lines:
            return lines[0]
        values = (now.x, now.y, now.z, *now.linear, *now.angular)
        return '' if all(map(math.isfinite, values)) else 'its pose is not finite'

    def faults(self) -> list[str]:
        """Return what is wrong with how it is now."""
        if lost := self.lost():
            return [f'its state is lost: {lost}']
        now = self._sim.truth
        fallen = self._begin.z - now.z
        if fallen > _FALLEN:
            lines = [each for each in logged(self._sim.log) if _TOUCHES_NOTHING in each]
            why = f': {lines[0]}' if lines else ''
            return [f'it falls, by {fallen:.1f} m{why}']
        tilt = tilt_between(self._begin, now)
        return [tipped(tilt, rolls=self._rolls)] if has_tipped(tilt) else []


def has_tipped(tilt: float) -> bool:
    """Return whether a tilt, rad, is one of a robot that has tipped over."""
    return tilt > _TIPPED


def tipped(tilt: float, *, rolls: bool = False) -> str:
    """Return that a robot has tipped over, by an angle, rad; of one that rolls nothing else."""
    why = '' if rolls else f', {BOLTED_DOWN}'
    return f'it has tipped over, by {math.degrees(tilt):.0f}°{why}'


def unrest(linear: float, angular: float) -> str:
    """Return how a robot does not rest; its speeds at the end are in m/s and rad/s."""
    return (
        f'it still moves after {REST_WITHIN:g} s: {linear:.3f} m/s, {angular:.3f} rad/s at the end'
    )


# --- legs ---------------------------------------------------------------------------------------


def _limbs_of(robot: Robot) -> list[list[Joint]]:
    """Return the joints of each limb that has as many as a leg and holds itself."""
    held = held_without_commands(robot)

    def chain(joint: Joint) -> list[Joint]:
        own = [joint] if joint.name in held else []
        return own + [each for child in robot.child_joints(joint.child) for each in chain(child)]

    stack, limbs = [robot.root.name], []
    while stack:
        for joint in robot.child_joints(stack.pop()):
            if joint.type is JointType.FIXED:
                stack.append(joint.child)
            elif len(limb := chain(joint)) >= _LEG:
                limbs.append(limb)
    return limbs


def stands_on_legs(robot: Robot) -> bool:
    """Return whether it has two limbs or more, of joints that hold it up."""
    return len(_limbs_of(robot)) > 1


def spreading_joints(robot: Robot) -> frozenset[str]:
    """Return the joints of legs that would push feet over the ground; none without legs."""
    limbs = _limbs_of(robot)
    if len(limbs) < 2:
        return frozenset()
    poses = link_poses(robot)
    ends = [min(poses[joint.child].translation[2] for joint in limb) for limb in limbs]
    return frozenset(
        joint.name
        for limb, end in zip(limbs, ends, strict=True)
        if end <= min(ends) + _REACH
        for joint in limb
        if abs(rotate(poses[joint.child].rotation, joint.axis)[1]) < _ACROSS
    )
