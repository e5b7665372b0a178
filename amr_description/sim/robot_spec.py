# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The MuJoCo spec of one robot, from its URDF: bodies, actuators, wheels, initial joint states.

MuJoCo's own URDF reader does most of it, from the XML of :mod:`amr_description.sim.prepared_xml`;
the rest is edited in the spec.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
import math

import mujoco

from amr_description.control.interfaces import POSITION, QUANTITIES, VELOCITY
from amr_description.errors import SpawnError
from amr_description.log import Log, Severity
from amr_description.model.base_interfaces import BASE
from amr_description.model.gazebo.physics import gazebo_physics_of
from amr_description.model.hardware_info import ComponentInfo
from amr_description.model.robot import held_without_commands, Joint, JointType, Robot, WORLD_LINK
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.wheels import described_rollers, FREE_PART, Rollers, Wheel
from amr_description.sim.actuators import add_actuators, command_bounds, COMMANDS
from amr_description.sim.base_servo import add_base_servo
from amr_description.sim.engine import compiler_message, compiler_warnings
from amr_description.sim.gazebo_physics import apply_gazebo_physics, wheel_geom_name
from amr_description.sim.meshes import insert_meshes
from amr_description.sim.prepared_xml import COLLISION, prepared_xml
from amr_description.sim.spawning import SpawnCode
from amr_description.sim.wheel_shapes import make_wheels
from amr_description.text import quote_all

_GRIP = 1.0


def rollers_of(
    wheels: Iterable[Wheel],
    described: Mapping[str, Rollers],
    named: Mapping[str, Rollers],
    frictions: Mapping[str, float],
    log: Log,
) -> dict[str, Rollers]:
    """
    Return the rollers of wheels by geom.

    A wheel that was only to be pushed along is often given hardly any friction. If a controller
    drives it, that is taken as its friction across its rollers.

    Args:
        wheels: of the robot.
        described: the rollers that the description tells of, by link; they count more.
        named: those that a controller has, by joint.
        frictions: sliding frictions of links, by geom.
        log: gets a line on wheels with hardly any friction.
    """
    found: dict[str, Rollers] = {}
    slippery: list[Wheel] = []
    for wheel in wheels:
        geom = wheel_geom_name(wheel.link)
        friction = frictions.get(geom, math.inf)
        if wheel.link in described:
            found[geom] = described[wheel.link]
        elif wheel.joint in named:
            found[geom] = named[wheel.joint]
            if friction <= FREE_PART:
                found[geom] = replace(found[geom], grip=_GRIP, free=friction)
                slippery.append(wheel)
    if slippery:
        friction = frictions[wheel_geom_name(slippery[0].link)]
        log(
            Severity.WARN,
            f'the wheels of joints {quote_all([wheel.joint for wheel in slippery])} have rollers '
            f'for their controller, and a friction of {friction:g} in the description: taken as '
            f'that across the rollers, and {_GRIP:g} along their axes',
        )
    return found


MIMIC_SOLREF, MIMIC_SOLIMP = (0.004, 1.0), (0.999, 0.9999, 0.001, 0.5, 2.0)
"""Of the equality constraint of a mimic joint: nearly rigid, as gears are."""

_NO_ROLLERS: Mapping[str, Rollers] = {}


@dataclass(frozen=True, slots=True)
class JointPlace:
    """Position and velocity of a joint: rad and rad/s, or m and m/s."""

    position: float
    velocity: float


@dataclass(frozen=True, slots=True)
class RobotSpec:
    """One robot, ready to be attached to a world."""

    spec: mujoco.MjSpec
    wheels: tuple[Wheel, ...]
    """
    The links that touch the ground as wheels, driven ones first. The geom of each is called
    :func:`wheel_geom_name`.
    """
    rollers: Mapping[str, Rollers]
    """Of mecanum and omni wheels, by geom."""
    slipping: Collection[str]
    """The geoms of wheels without rollers that slip in proportion to the force."""
    casters: tuple[str, ...]
    """The names of the geoms of a wheeled robot that touch and are no wheels: possible casters."""
    frictions: Mapping[str, float]
    """The sliding friction of the named geoms whose link has one of its own."""
    commands: Mapping[str, Collection[str]]
    """The command interfaces of each joint in a ``<ros2_control>`` block."""
    initial_states: Mapping[str, JointPlace]
    """Of the joints that do not begin at rest at 0."""
    free_joint: str | None
    """The name of the root's free joint; None: the robot stands fixed in the world."""
    collisions: Mapping[str, Sequence[int]]
    """By link, of each of its geoms in order: the number of its collision, -1 of a visual."""


def root_joint(robot: Robot) -> str:
    """Return the name of the free joint of a robot that does not stand fixed."""
    return f'{robot.root.name}/free'


def build_robot(
    robot: Robot,
    log: Log,
    *,
    strict: bool = False,
    named_rollers: Mapping[str, Rollers] = _NO_ROLLERS,
) -> RobotSpec:
    """
    Build the spec of a robot.

    Args:
        robot: A robot that the checker has found sound.
        log: Gets what is left out or taken as something else, and the warnings of MuJoCo's
            compiler.
        strict: Refuse a robot without mass, and a collision whose mesh cannot be read.
        named_rollers: Of wheels, by joint, whose controller says that they have rollers; what the
            description says of the same wheel counts more.

    Raises:
        SpawnError: MuJoCo rejects the model, or as ``strict`` says.
    """
    if strict:
        _refuse_massless(robot)
    hardware = hardware_of(robot)
    controlled = [joint for info in hardware for joint in info.joints]
    commands = _commands_of(controlled, robot, log)
    try:
        spec, collisions = _read(robot, log, strict=strict)
        _replace_floating_joints(spec, robot)
        if robot.root.name != WORLD_LINK:
            spec.worldbody.first_body().add_freejoint(name=root_joint(robot))
        for name, interfaces in commands.items():
            # Commands without an actuator are rejected by the hardware component that claims them.
            if robot.joint(name).has_position:
                add_actuators(spec, robot.joint(name), interfaces)
        _couple_mimics(spec, robot, controlled)
        wheels = make_wheels(spec, robot, commands)
        casters = _name_casters(spec) if wheels else ()
        physics = gazebo_physics_of(robot)
        frictions = apply_gazebo_physics(spec, robot, physics, wheels, log)
        rollers = described_rollers(robot, physics)
        rollers = rollers_of(wheels, rollers, named_rollers, frictions, log)
        slipping = {wheel_geom_name(each) for each in physics.slipping}.difference(rollers)
        if any(gpio.name == BASE for info in hardware for gpio in info.gpios):
            add_base_servo(spec, root_joint(robot))
        # Compiled alone first: a robot that MuJoCo rejects never gets into the world.
        with compiler_warnings(log, robot.source):
            spec.copy().compile()
    except ValueError as cause:
        raise SpawnError(
            f'{robot.source}: MuJoCo refuses the model: {compiler_message(str(cause))}',
            SpawnCode.RESOURCE_PARSE_ERROR,
        ) from cause
    _warn_of_fall(spec, robot, log)
    free = None if robot.root.name == WORLD_LINK else root_joint(robot)
    initial = initial_states(robot, controlled, log, strict=strict)
    return RobotSpec(
        spec, wheels, rollers, slipping, casters, frictions, commands, initial, free, collisions
    )


def _read(
    robot: Robot, log: Log, *, strict: bool
) -> tuple[mujoco.MjSpec, dict[str, tuple[int, ...]]]:
    """Return what MuJoCo reads, its geoms without names, and :attr:`RobotSpec.collisions`."""
    xml, meshes = prepared_xml(robot, log, strict=strict)
    spec = mujoco.MjSpec.from_string(xml)
    collisions = {}
    for body in spec.bodies:
        numbers = []
        for geom in body.geoms:
            _, is_collision, number = geom.name.rpartition(COLLISION)
            numbers.append(int(number) if is_collision else -1)
            if is_collision:
                geom.name = ''
        collisions[body.name] = tuple(numbers)
    insert_meshes(spec, meshes)
    return spec, collisions


def _held_joints(robot: Robot, log: Log) -> dict[str, tuple[str, ...]]:
    """Return the commands of the joints that are held as nothing commands the robot."""
    held = held_without_commands(robot)
    if held:
        why = 'nothing commands its joints; held are'
        log(Severity.INFO, f'{robot.source}: {why}: {quote_all(held)}')
    return dict.fromkeys(held, (POSITION,))


def _warn_of_fall(spec: mujoco.MjSpec, robot: Robot, log: Log) -> None:
    touches = any(geom.contype or geom.conaffinity for geom in spec.geoms)
    if robot.root.name != WORLD_LINK and not touches:
        log(
            Severity.WARN,
            f'{robot.source}: no shape of it touches anything, so it falls through the ground; '
            'give its links a <collision>, or fix it to the world (fixed:=true)',
        )


def _refuse_massless(robot: Robot) -> None:
    if robot.root.name != WORLD_LINK and not any(link.inertial for link in robot.links):
        raise SpawnError(
            f'{robot.source}: no link has mass, so nothing can move the robot; add <inertial> '
            'with <mass value="…"/> (kg) and <inertia …/> (kg·m²)',
            SpawnCode.RESOURCE_PARSE_ERROR,
        )


def _commands_of(
    controlled: Iterable[ComponentInfo], robot: Robot, log: Log
) -> dict[str, tuple[str, ...]]:
    """Return what each joint, which two blocks may share, is commanded by, or held."""
    commands: dict[str, tuple[str, ...]] = {}
    for joint in controlled:
        commands[joint.name] = commands.get(joint.name, ()) + _quantities(joint)
    return commands if any(commands.values()) else commands | _held_joints(robot, log)


def _quantities(joint: ComponentInfo) -> tuple[str, ...]:
    """
    Return what a joint is commanded by.

    One whose commands are not simulated is held; one that follows another has no commands.
    """
    if joint.mimic is not None:
        return ()
    names = [QUANTITIES.get(interface.name, '') for interface in joint.command_interfaces]
    known = tuple(name for name in names if name in COMMANDS)
    return known or ((VELOCITY,) if names else ())


def _replace_floating_joints(spec: mujoco.MjSpec, robot: Robot) -> None:
    """
    Replace each floating joint below another link by three slides and a ball.

    MuJoCo has free joints below the world only. The motion is the same.
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


def _couple_mimics(spec: mujoco.MjSpec, robot: Robot, controlled: Sequence[ComponentInfo]) -> None:
    """
    Stiffen the equality constraints that MuJoCo made of ``<mimic>``.

    Where ``<ros2_control>`` says ``mimic="false"`` the constraint is deleted; where it has the
    parameter ``mimic`` and the URDF no ``<mimic>``, one is added.
    """
    independent = {joint.name for joint in controlled if joint.mimic is None}
    for joint in controlled:
        mimic = joint.mimic
        if mimic is not None and robot.joint(joint.name).mimic is None:
            coupling = spec.add_equality(
                type=mujoco.mjtEq.mjEQ_JOINT, name1=joint.name, name2=mimic.joint
            )
            coupling.data[:2] = mimic.offset, mimic.multiplier
    for coupling in tuple(spec.equalities):
        if coupling.name1 in independent:
            spec.delete(coupling)
        else:
            coupling.solref = MIMIC_SOLREF
            coupling.solimp = MIMIC_SOLIMP


def _name_casters(spec: mujoco.MjSpec) -> tuple[str, ...]:
    """Name the geoms that collide and are no wheels; return the names."""
    names: list[str] = []
    for body in spec.bodies:
        others = [
            geom for geom in body.geoms if not geom.name and (geom.contype or geom.conaffinity)
        ]
        for number, geom in enumerate(others):
            geom.name = f'{body.name}/caster_{number}'
            names.append(geom.name)
    return tuple(names)


def initial_states(
    robot: Robot, controlled: Iterable[ComponentInfo], log: Log, *, strict: bool = False
) -> dict[str, JointPlace]:
    """
    Return where joints are at spawn and after a reset: those that do not begin at rest at 0.

    A joint begins within its limits, so that no end stop throws it. Mimic joints follow their
    source: multiplier · position + offset, multiplier · velocity.

    Args:
        robot: All joints, with their limits.
        controlled: The joints of the ``<ros2_control>`` blocks; ``initial_value`` of their state
            interfaces position and velocity is applied.
        log: Gets what begins elsewhere than asked.
        strict: Refuse an initial value beyond the limits of its joint.

    Raises:
        SpawnError: A strict one has such an initial value.
    """
    given: dict[str, dict[str, float]] = {POSITION: {}, VELOCITY: {}}
    mimics = {joint.name: joint.mimic for joint in robot.joints}
    for part in controlled:
        mimics[part.name] = part.mimic
        for interface in part.state_interfaces:
            if interface.name in given and interface.initial_value is not None:
                given[interface.name][part.name] = interface.initial_value
    leading = [joint for joint in robot.joints if mimics[joint.name] is None]
    given[POSITION] = _within_limits(robot, leading, given[POSITION], log, strict=strict)

    def state_of(joint: str) -> JointPlace:
        return JointPlace(given[POSITION].get(joint, 0.0), given[VELOCITY].get(joint, 0.0))

    states = {}
    for joint in robot.joints:
        mimic = mimics[joint.name]
        state = state_of(joint.name)
        if mimic is not None:
            source = state_of(mimic.joint)
            state = JointPlace(
                mimic.offset + mimic.multiplier * source.position,
                mimic.multiplier * source.velocity,
            )
        if joint.has_position and state != JointPlace(0.0, 0.0):
            states[joint.name] = state
    return states


def _within_limits(
    robot: Robot,
    joints: Iterable[Joint],
    positions: Mapping[str, float],
    log: Log,
    *,
    strict: bool,
) -> dict[str, float]:
    """
    Return the initial positions of those joints that do not begin at 0.

    Args:
        robot: Names the description in messages.
        joints: Those that follow no other one.
        positions: What the description asks for, by joint.
        log: Gets what is not within the limits.
        strict: Refuse that, if it was asked for.

    Raises:
        SpawnError: A strict one has an initial value beyond the limits.
    """
    moved: dict[str, float] = {}
    elsewhere = []
    for joint in joints:
        asked = positions.get(joint.name, 0.0)
        bounds = command_bounds(joint, POSITION)
        begin = asked
        if joint.has_position and bounds.lower <= bounds.upper:
            begin = min(max(asked, bounds.lower), bounds.upper)
        if begin != asked and joint.name in positions:
            text = (
                f"{robot.source}: joint '{joint.name}': initial_value {asked:.6g} of its position "
                f'is beyond {bounds}'
            )
            if strict:
                raise SpawnError(text, SpawnCode.RESOURCE_PARSE_ERROR)
            log(Severity.WARN, f'{text}; it begins at {begin:.6g}')
        elif begin != asked:
            elsewhere.append(f'{joint.name} at {begin:.6g}')
        if begin:
            moved[joint.name] = begin
    if elsewhere:
        text = f'{robot.source}: 0 is beyond the limits of joints, which begin within them: '
        log(Severity.INFO, f'{text}{", ".join(elsewhere)}')
    return moved
