# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A URDF as a MuJoCo spec of one robot, with its actuators and its wheels.

MuJoCo's own URDF reader does the most. Left alone it welds the robot to the world, fuses links
without a joint into it (most of the mass is gone then) and looks for meshes by their bare names;
what it must be told is written into the XML before it reads, the rest is edited in the spec.

Where joints stand when a robot is spawned, and again after a reset.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from itertools import combinations

from lxml import etree
import mujoco

from amr_description.control.contracts import Log
from amr_description.control.interfaces import EFFORT, POSITION, VELOCITY
from amr_description.errors import SpawnError
from amr_description.model.findings import raise_error
from amr_description.model.hardware_info import ComponentInfo
from amr_description.model.robot import Joint, JointType, Robot, WORLD_LINK
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.wheels import find_passive_wheels, find_wheels, Wheel
from amr_description.model.xml_reader import parse_xml
from amr_description.sim.actuators import add_actuators, command_bounds
from amr_description.sim.engine import compiler_warnings, one_line
from amr_description.sim.friction import (
    link_frictions,
    make_slippery,
    SIDE_FRICTION,
    SIDE_PRIORITY,
)
from amr_description.sim.meshes import insert_meshes, Meshes, resolve_meshes
from amr_description.sim.spawning import SpawnCode


@dataclass(frozen=True, slots=True)
class JointState:
    """rad and rad/s, or m and m/s."""

    position: float
    velocity: float


def initial_states(robot: Robot, controlled: Iterable[ComponentInfo]) -> dict[str, JointState]:
    """
    The joints that do not begin at rest at 0.

    ``controlled``: the joints of the ``<ros2_control>`` blocks, whose ``initial_value`` of the
    state interfaces position and velocity counts. Mimic joints follow: multiplier · source +
    offset, and for the velocity without the offset. Raises SpawnError for a position that the
    joint cannot take.
    """
    given: dict[str, dict[str, float]] = {POSITION: {}, VELOCITY: {}}
    follows = {joint.name: joint.mimic for joint in robot.joints}
    for part in controlled:
        follows[part.name] = part.mimic
        for interface in part.state_interfaces:
            if interface.name in given and interface.initial_value is not None:
                given[interface.name][part.name] = interface.initial_value
    _check_positions(robot, given[POSITION])

    def state_of(joint: str) -> JointState:
        return JointState(given[POSITION].get(joint, 0.0), given[VELOCITY].get(joint, 0.0))

    states = {}
    for joint in robot.joints:
        mimic = follows[joint.name]
        state = state_of(joint.name)
        if mimic is not None:
            source = state_of(mimic.joint)
            state = JointState(
                mimic.offset + mimic.multiplier * source.position,
                mimic.multiplier * source.velocity,
            )
        if joint.has_position and state != JointState(0.0, 0.0):
            states[joint.name] = state
    return states


def _check_positions(robot: Robot, positions: Mapping[str, float]) -> None:
    for name, position in positions.items():
        bounds = command_bounds(robot.joint(name), POSITION)
        if not bounds.lower <= position <= bounds.upper:
            raise SpawnError(
                f"{robot.source}: joint '{name}': initial_value {position:.6g} of its position is "
                f'beyond {bounds}',
                SpawnCode.RESOURCE_PARSE_ERROR,
            )


MIMIC_SOLREF, MIMIC_SOLIMP = (0.004, 1.0), (0.999, 0.9999, 0.001, 0.5, 2.0)
"""A mimic joint follows as if by gears."""

LEAST_RANGE = 2e-6
"""rad or m; the range of a joint whose lower limit is its upper one."""

_DRIVING = {VELOCITY, EFFORT}
"""The command interfaces by which a wheel is driven."""

_COMPILER = {'fusestatic': 'false', 'discardvisual': 'false', 'strippath': 'false'}


@dataclass(frozen=True, slots=True)
class RobotSpec:
    """One robot, ready to be attached to a world."""

    spec: mujoco.MjSpec
    wheels: tuple[Wheel, ...]
    """
    The links that touch the ground as wheels, each with a geom of :func:`tread_name`; those that
    are driven come first.
    """
    balls: tuple[str, ...]
    """The geoms of a wheeled robot that are spheres and no wheels: casters, if they bear."""
    commands: Mapping[str, Collection[str]]
    """The command interfaces of each joint in a ``<ros2_control>`` block."""
    initial: Mapping[str, JointState]
    """The joints that do not begin at rest at 0."""
    free_joint: str | None
    """The joint by which it moves in the world; None: it stands fixed."""


def root_joint(robot: Robot) -> str:
    """The name of the free joint of a robot that does not stand fixed."""
    return f'{robot.root.name}/free'


def tread_name(link: str) -> str:
    """The name of the geom with which a wheel touches the ground."""
    return f'{link}/tread'


def build_robot(robot: Robot, log: Log) -> RobotSpec:
    """Build the spec of a sound robot; ``log`` is told what is left out. Raises SpawnError."""
    if robot.root.name != WORLD_LINK and not any(link.inertial for link in robot.links):
        raise SpawnError(
            f'{robot.source}: no link has mass, so nothing can move the robot; add <inertial> '
            'with <mass value="…"/> (kg) and <inertia …/> (kg·m²)',
            SpawnCode.RESOURCE_PARSE_ERROR,
        )
    controlled = [joint for hardware in hardware_of(robot) for joint in hardware.joints]
    commands: dict[str, tuple[str, ...]] = {}
    for joint in controlled:
        # Two blocks may share a joint.
        names = tuple(interface.name for interface in joint.command_interfaces)
        commands[joint.name] = commands.get(joint.name, ()) + names
    try:
        xml, meshes = _prepared_xml(robot, log)
        spec = mujoco.MjSpec.from_string(xml)
        insert_meshes(spec, meshes)
        _loosen_floating_links(spec, robot)
        if robot.root.name != WORLD_LINK:
            spec.worldbody.first_body().add_freejoint(name=root_joint(robot))
        for joint, interfaces in commands.items():
            # What has no actuator is refused by the hardware component that asks for it.
            if robot.joint(joint).has_position:
                add_actuators(spec, robot.joint(joint), interfaces)
        _couple_mimics(spec, [joint.name for joint in controlled if joint.mimic is None])
        wheels = find_wheels(robot, [j for j, i in commands.items() if _DRIVING & {*i}])
        if wheels:
            wheels += find_passive_wheels(robot, commands)
        for wheel in wheels:
            _make_tread(spec, wheel)
        balls = _name_balls(spec) if wheels else ()
        make_slippery(spec, link_frictions(robot, log))
        _exclude_self_collision(spec, robot)
        # Tried alone first, so that a robot that MuJoCo refuses never touches the world.
        with compiler_warnings(log, robot.source):
            spec.copy().compile()
    except ValueError as cause:
        raise SpawnError(
            f'{robot.source}: MuJoCo refuses the model: {one_line(str(cause))}',
            SpawnCode.RESOURCE_PARSE_ERROR,
        ) from cause
    free = None if robot.root.name == WORLD_LINK else root_joint(robot)
    initial = initial_states(robot, controlled)
    return RobotSpec(spec, wheels, balls, commands, initial, free)


def _prepared_xml(robot: Robot, log: Log) -> tuple[str, Meshes]:
    """
    The URDF with MuJoCo's compiler settings and the true paths of its meshes, and those meshes
    that MuJoCo does not read itself.
    """
    root = parse_xml(robot.text, robot.source, raise_error)
    assert root is not None, 'raise_error does not return from an error'
    extension = root.find('mujoco')
    if extension is None:
        extension = etree.SubElement(root, 'mujoco')
    compiler = extension.find('compiler')
    if compiler is None:
        compiler = etree.SubElement(extension, 'compiler')
    for key, value in _COMPILER.items():
        compiler.set(key, value)
    for shape in (*root.iterfind('link/visual'), *root.iterfind('link/collision')):
        # MuJoCo would name its geoms so, and refuse a name that a visual and a collision share.
        shape.attrib.pop('name', None)
    for joint in robot.joints:
        if joint.limit is not None and joint.limit.lower == joint.limit.upper:
            _keep_limit(root, joint)
    meshes = resolve_meshes(root, robot.source, log)
    return etree.tostring(root, encoding='unicode'), meshes


def _keep_limit(root: etree._Element, joint: Joint) -> None:
    """A range of nothing is one that MuJoCo leaves out, so that the joint would move freely."""
    assert joint.limit is not None
    for element in root.iterfind('joint'):
        if element.get('name') == joint.name:
            limit = element.find('limit')
            limit.set('lower', repr(joint.limit.lower - LEAST_RANGE / 2.0))
            limit.set('upper', repr(joint.limit.upper + LEAST_RANGE / 2.0))


def _loosen_floating_links(spec: mujoco.MjSpec, robot: Robot) -> None:
    """
    Let a floating joint below another link be three slides and a ball.

    MuJoCo has free joints below the world alone. The motion is the same.
    """
    for joint in robot.joints:
        if joint.type is not JointType.FLOATING or joint.parent == WORLD_LINK:
            continue
        spec.delete(spec.joint(joint.name))
        link = spec.body(joint.child)
        for name, axis in zip('xyz', ((1, 0, 0), (0, 1, 0), (0, 0, 1)), strict=True):
            slide = mujoco.mjtJoint.mjJNT_SLIDE
            link.add_joint(name=f'{joint.name}/{name}', type=slide, axis=axis)
        link.add_joint(name=f'{joint.name}/ball', type=mujoco.mjtJoint.mjJNT_BALL)


def _couple_mimics(spec: mujoco.MjSpec, independent: Collection[str]) -> None:
    """
    Stiffen the couplings that MuJoCo made of ``<mimic>``: offset + multiplier · source.

    ``independent``: joints for which ``<ros2_control>`` says ``mimic="false"``, among others.
    """
    for coupling in tuple(spec.equalities):
        if coupling.name1 in independent:
            spec.delete(coupling)
        else:
            coupling.solref = MIMIC_SOLREF
            coupling.solimp = MIMIC_SOLIMP


def _make_tread(spec: mujoco.MjSpec, wheel: Wheel) -> None:
    """
    Make the wheel's round collision shape an ellipsoid of its size.

    An ellipsoid touches a flat ground in one point; a cylinder's edge gives contacts that come and
    go as the wheel turns.
    """
    shapes = [g for g in spec.body(wheel.link).geoms if g.contype or g.conaffinity]
    tread = shapes[wheel.collision]
    tread.name = tread_name(wheel.link)
    tread.type = mujoco.mjtGeom.mjGEOM_ELLIPSOID
    tread.size = [wheel.radius, wheel.radius, wheel.half_width]
    tread.friction[0], tread.priority = SIDE_FRICTION, SIDE_PRIORITY


def _name_balls(spec: mujoco.MjSpec) -> tuple[str, ...]:
    """Name the spheres that touch and are no wheels; return the names."""
    spheres = [
        geom
        for geom in spec.geoms
        if geom.type == mujoco.mjtGeom.mjGEOM_SPHERE and (geom.contype or geom.conaffinity)
    ]
    for number, ball in enumerate(spheres):
        ball.name = f'{ball.parent.name}/ball_{number}'
    return tuple(ball.name for ball in spheres)


def _exclude_self_collision(spec: mujoco.MjSpec, robot: Robot) -> None:
    """Links of one robot do not touch each other: Gazebo's default (``self_collide`` off)."""
    touching = [link.name for link in robot.links if link.collisions]
    for one, other in combinations(touching, 2):
        if WORLD_LINK not in (one, other):
            spec.add_exclude(bodyname1=one, bodyname2=other)
