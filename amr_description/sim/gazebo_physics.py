# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``<gazebo reference="…">`` says of links and joints, put into the spec of a robot.

Links of one robot do not touch each other, which is Gazebo's default, but for those that say so
(``<selfCollide>``), each of the two. Two of these that are in each other at the start, as parts
that a designer has put together are, never touch: they would burst apart.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

import mujoco

from amr_description.log import Log, Severity
from amr_description.model.gazebo.physics import GazeboPhysics
from amr_description.model.robot import Robot, WORLD_LINK
from amr_description.model.wheels import Wheel
from amr_description.sim.friction import apply_link_frictions
from amr_description.text import quote_all


def wheel_geom_name(link: str) -> str:
    """Return the name of the geom with which a wheel touches the ground."""
    return f'{link}/wheel'


def apply_gazebo_physics(
    spec: mujoco.MjSpec, robot: Robot, physics: GazeboPhysics, wheels: Sequence[Wheel], log: Log
) -> Mapping[str, float]:
    """
    Give a robot the frictions, springs, gravity and self-collisions that Gazebo is told of.

    Args:
        spec: Of the robot; edited.
        robot: Its description.
        physics: What Gazebo is told.
        wheels: Their geoms have names.
        log: Gets what is left out.

    Returns:
        The sliding friction of the named geoms whose link has one of its own.
    """
    for fault in physics.faults:
        log(Severity.WARN, fault)
    if physics.unknown:
        log(Severity.WARN, physics.unknown)
    if physics.solver:
        log(Severity.INFO, physics.solver)
    for name, joint in physics.joints.items():
        if robot.joint(name).has_position and joint.spring_stiffness > 0.0:
            spring = spec.joint(name)
            spring.stiffness = [joint.spring_stiffness, 0.0, 0.0]  # of a polynomial
            spring.springref = joint.spring_reference
    for name, link in physics.links.items():
        if not link.has_gravity and spec.body(name) is not None:
            spec.body(name).gravcomp = 1.0
    frictions = apply_link_frictions(
        spec, physics.links, {wheel_geom_name(wheel.link) for wheel in wheels}
    )
    _exclude_self_collision(spec, robot, physics, log)
    return frictions


def _exclude_self_collision(
    spec: mujoco.MjSpec, robot: Robot, physics: GazeboPhysics, log: Log
) -> None:
    touching = [link.name for link in robot.links if link.collisions]
    if physics.self_collides:
        selves = set(touching)
    else:
        selves = {name for name, link in physics.links.items() if link.self_collides}
    kept = {pair for pair in combinations(touching, 2) if selves.issuperset(pair)}
    overlapping = kept & set(_overlapping(spec)) if kept else set()
    for one, other in combinations(touching, 2):
        if WORLD_LINK not in (one, other) and (one, other) not in kept - overlapping:
            spec.add_exclude(bodyname1=one, bodyname2=other)
    if overlapping:
        pairs = quote_all([f'{one} and {other}' for one, other in sorted(overlapping)])
        log(
            Severity.WARN,
            f'{robot.source}: links that collide with their own robot are in each other at the '
            f'start, and do not touch: {pairs}',
        )


def _overlapping(spec: mujoco.MjSpec) -> Iterator[tuple[str, str]]:
    """Yield the pairs of bodies that touch with all joints at 0, in either order."""
    model = spec.copy().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for one, other in data.contact.geom.tolist():
        names = [model.body(int(model.geom_bodyid[geom])).name for geom in (one, other)]
        yield names[0], names[1]
        yield names[1], names[0]
