# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules on ``<ros2_control>`` blocks, and on what controllers assume about the robot.

Findings about controllers name lines of their parameter files. Unknown joints and tags of a block
are reported where it is read (:mod:`amr_description.model.ros2_control_tag`).
"""

from collections.abc import Iterator
import math

from amr_description.model.checks.context import CheckContext, DriveSettings
from amr_description.model.findings import Finding
from amr_description.model.gazebo.physics import gazebo_physics_of
from amr_description.model.hardware_info import ComponentInfo, ComponentType, HardwareInfo
from amr_description.model.robot import JointType
from amr_description.model.wheels import described_rollers
from amr_description.text import closest_match, quote, quote_all

# A difference of more than this share is an error, not rounding.
_TOLERANCE = 0.01
# Of a radius with a multiplier, which may be that of a real wheel, fitted.
_FITTED_TOLERANCE = 0.02
# m; wheels of one side that are farther apart along x scrub sideways in a turn.
_SCRUBBING = 0.01
# Of a separation with a multiplier, which is measured on some ground.
_MEASURED_TOLERANCE = 0.05
_MANY_COORDINATES = (JointType.PLANAR, JointType.FLOATING)
_OF_JOINTS = ('position', 'velocity', 'acceleration', 'effort', 'torque', 'force', 'current')
# Between a typing error ("velocty", 0.93) and another word ("speed", 0.15).
_MISSPELT = 0.8
# Names of plugins are long, and alike: gz_ and gazebo_ros2_control/…System, 0.87.
_MISSPELT_PLUGIN = 0.93


def commanded_joints_have_a_position(context: CheckContext) -> Iterator[Finding]:
    """Commanded joints have a position that is one number: they are not planar or floating."""
    for hardware, component in _components(context):
        if component.type is not ComponentType.JOINT or not component.command_interfaces:
            continue
        robot, name = context.robot, component.name
        if robot.has_joint(name) and robot.joint(name).type in _MANY_COORDINATES:
            yield context.error(
                component.line,
                f'joint {quote(name)} of ros2_control {quote(hardware.name)} takes commands',
                found=f'type {robot.joint(name).type} in the URDF',
                expected='revolute, continuous or prismatic: a position that is one number',
            )


def components_offer_interfaces(context: CheckContext) -> Iterator[Finding]:
    """Every component has an interface, or is a sensor of parameters; who moves can be read."""
    for hardware, component in _components(context):
        where = f'{component.type} {quote(component.name)} of ros2_control {quote(hardware.name)}'
        if component.type is ComponentType.SENSOR and component.parameters:
            continue  # cameras and lidars of mujoco_ros2_control have parameters only
        if not component.command_interfaces and not component.state_interfaces:
            yield context.warning(
                component.line,
                f'{where} has no interface',
                fix='add <state_interface name="…"/>, or remove it',
            )
        elif component.type is ComponentType.JOINT and not component.state_interfaces:
            yield context.warning(
                component.line,
                f'{where} takes commands, and nobody can read what it does',
                fix='add <state_interface name="position"/> and <state_interface '
                'name="velocity"/>',
            )


def plugins_are_spelt_right(context: CheckContext) -> Iterator[Finding]:
    """No ``<plugin>`` has a misspelt name of one that is shipped."""
    for hardware in context.hardware:
        shipped = context.inputs.hardware_plugins
        meant = closest_match(hardware.plugin, shipped, _MISSPELT_PLUGIN)
        if meant and hardware.plugin not in shipped:
            yield context.error(
                hardware.line,
                f'ros2_control {quote(hardware.name)}: there is no hardware plugin '
                f'{quote(hardware.plugin)}',
                fix=f'did you mean {quote(meant)}?',
            )


def interface_names_are_spelt_right(context: CheckContext) -> Iterator[Finding]:
    """No interface of a joint has a misspelt name of a standard one."""
    for hardware, component in _components(context):
        if component.type is not ComponentType.JOINT:
            continue
        for interface in (*component.command_interfaces, *component.state_interfaces):
            name = interface.name
            meant = closest_match(name, _OF_JOINTS, _MISSPELT) if name.isalpha() else ''
            if meant and name != meant:
                yield context.warning(
                    component.line,
                    f'joint {quote(component.name)} of ros2_control {quote(hardware.name)}: an '
                    'interface that no controller asks for',
                    found=quote(name),
                    fix=f'write name="{meant}"',
                )


def one_block_commands(context: CheckContext) -> Iterator[Finding]:
    """No command interface is offered by two blocks."""
    first: dict[tuple[str, str], str] = {}
    for hardware, component in _components(context):
        for interface in component.command_interfaces:
            key = (component.name, interface.name)
            if first.setdefault(key, hardware.name) != hardware.name:
                yield context.error(
                    component.line,
                    f'command interface "{component.name}/{interface.name}" is offered twice',
                    found=f'by ros2_control {quote(first[key])} and {quote(hardware.name)}',
                    fix='remove one',
                )


def wheel_names_are_joints(context: CheckContext) -> Iterator[Finding]:
    """
    Each wheel of a controller is a joint with a velocity command and a state interface.

    With ``--controllers``.
    """
    for drive in context.inputs.drives:
        if drive.is_plugin:
            continue  # it has them by being one
        for parameter, names in _named_wheels(drive):
            for name in names:
                yield from _check_wheel(context, drive, parameter, name)


def base_frame_is_the_root(context: CheckContext) -> Iterator[Finding]:
    """
    The base frame of odometry is the root of the robot: a frame has one parent in TF.

    With ``--controllers``.
    """
    roots = context.robot.roots
    for drive in context.inputs.drives if roots else ():
        base, root = drive.base_frame, roots[0].name
        if not drive.publishes_transform or base == root or drive.is_plugin:
            continue
        joint = context.robot.parent_joint(base)
        yield drive.warning(
            'base_frame_id',
            f'{quote(base)} gets two parents in TF'
            if joint is not None
            else 'base_frame_id is no link of the robot',
            found=f'{quote(drive.odom_frame)} from odometry, {quote(joint.parent)} from the URDF'
            if joint is not None
            else quote(base),
            expected=f'the root of the URDF, {quote(root)}',
            fix=f'write base_frame_id: {root}',
        )


def sides_are_not_swapped(context: CheckContext) -> Iterator[Finding]:
    """The left wheels are on the left (y > 0), the right ones on the right."""
    for drive in context.inputs.drives:
        left, right = _mean_y(context, drive.left_wheels), _mean_y(context, drive.right_wheels)
        if left < right:
            names = 'left_wheel_names and right_wheel_names'
            yield drive.warning(
                'left_wheel_names',
                'left and right wheels are swapped: turns are inverted',
                found=f'the left wheels at y = {left:g} m, the right ones at y = {right:g} m',
                expected='the left wheels at the greater y',
                fix=f'swap {"<left_joint> and <right_joint>" if drive.is_plugin else names}',
            )


def wheel_radius_agrees(context: CheckContext) -> Iterator[Finding]:
    """
    The radius, with the multiplier of each side, is that of the wheels' collision shapes.

    Within 1 %, with a multiplier 2 %.
    """
    for drive in context.inputs.drives:
        radii = {wheel.joint: wheel.radius for wheel in context.wheels_of(drive)}
        sides = (
            ('left', drive.left_wheels, drive.left_radius_multiplier),
            ('right', drive.right_wheels, drive.right_radius_multiplier),
        )
        for side, names, multiplier in sides:
            tolerance = _TOLERANCE if multiplier == 1.0 else _FITTED_TOLERANCE
            wrong = (
                (name, radius)
                for name in names
                if (radius := radii.get(name, 0.0))
                and abs(radius - drive.radius * multiplier) > tolerance * radius
            )
            name, radius = next(wrong, ('', 0.0))
            if name:
                yield _wrong_radius(drive, side, multiplier, name, radius)
                break


def _wrong_radius(
    drive: DriveSettings, side: str, multiplier: float, name: str, radius: float
) -> Finding:
    """Return the finding on a wheel of another radius than a drive has, m."""
    per = drive.per('wheel_radius')
    found, expected = f'{drive.radius * per:g} m', f'{radius * per:g} m'
    of = 'diameter' if per == 2.0 else 'radius'
    fix = f'write {drive.written("wheel_radius", radius / multiplier)}'
    if multiplier != 1.0:
        found = f'{drive.radius * multiplier:g} m, {drive.radius:g} m times {multiplier:g}'
        if abs(drive.radius - radius) <= _FITTED_TOLERANCE * radius:
            fix = f'write {side}_wheel_radius_multiplier: 1.0'
    return drive.warning(
        'wheel_radius' if multiplier == 1.0 else f'{side}_wheel_radius_multiplier',
        f'{drive.named("wheel_radius")} is not that of {quote(name)}',
        found=found,
        expected=f'{expected}, the {of} of its collision shape',
        fix=fix,
    )


def wheel_separation_agrees(context: CheckContext) -> Iterator[Finding]:
    """
    The separation is the distance between the left and the right wheels along y.

    Within 1 %.
    """
    for drive in context.inputs.drives:
        apart = _track(context, drive)
        scrubs = drive.is_plugin and _length(context, drive) > _SCRUBBING
        if abs(apart - drive.separation) > _TOLERANCE * apart and not scrubs:
            yield drive.warning(
                'wheel_separation',
                f'{drive.named("wheel_separation")} is not that of the wheels',
                found=f'{drive.separation:g} m',
                expected=f'{apart:g} m between the joints on the left and on the right',
                fix=f'write {drive.written("wheel_separation", apart)}',
            )


def scrubbing_is_accounted_for(context: CheckContext) -> Iterator[Finding]:
    """
    A robot with fixed wheels one behind the other has a separation multiplier.

    Such wheels scrub sideways in a turn, and the robot turns less than their speeds say: for the
    Coulomb friction of four equal wheels, L apart along x and W along y, by 1 + (L / W)². A plugin
    of Gazebo has no multiplier, but a separation that may be greater. It fits within 5 %.
    """
    for drive in context.inputs.drives:
        length, width = _length(context, drive), _track(context, drive)
        if not (length > _SCRUBBING and width > 0.0) or _is_widened(context, drive):
            continue
        guess = 1.0 + length / width * (length / width)
        if drive.separation_multiplier != 1.0:
            if not _has_rollers(context, drive):  # which do not scrub
                yield from _fits_scrubbing(drive, width * guess, guess)
            continue
        if drive.is_plugin:
            yield drive.warning(
                'wheel_separation',
                'wheels one behind the other scrub in a turn; the robot turns less than told',
                found=f'{drive.named("wheel_separation")} of {drive.separation:g} m',
                expected=f'about {width * guess:.3g} m, 1 + (L/W)² = {guess:.2f} times as much',
                fix=f'write {drive.written("wheel_separation", width * guess)}, then measure a '
                'full turn',
            )
            continue
        yield drive.warning(
            'wheel_separation',
            'wheels one behind the other scrub in a turn; odometry will turn more than the robot',
            found='wheel_separation_multiplier 1.0',
            expected=f'about 1 + (L/W)² = {guess:.2f}',
            fix=f'write wheel_separation_multiplier: {guess:.2f}, then measure a full turn',
        )


def _has_rollers(context: CheckContext, drive: DriveSettings) -> bool:
    robot = context.robot
    wheels = {joint.child for joint in robot.joints if joint.name in drive.left_wheels}
    return not wheels.isdisjoint(described_rollers(robot, gazebo_physics_of(robot)))


def _fits_scrubbing(drive: DriveSettings, needed: float, guess: float) -> Iterator[Finding]:
    """Compare a separation with its multiplier to what scrubbing makes of that of the wheels."""
    told = drive.separation * drive.separation_multiplier
    if abs(told - needed) > _MEASURED_TOLERANCE * needed:
        yield drive.warning(
            'wheel_separation_multiplier',
            'wheels one behind the other scrub in a turn, and wheel_separation with its '
            f'multiplier does not fit that: the robot turns {100.0 * told / needed:.0f} % of what '
            'is told',
            found=f'{told:.4g} m',
            expected=f'{needed:.4g} m, that of the wheels times 1 + (L/W)² = {guess:.2f}',
            fix=f'write wheel_separation_multiplier: {needed / drive.separation:.2f}, unless it '
            'was measured on the ground that the robot drives on',
        )


def _length(context: CheckContext, drive: DriveSettings) -> float:
    """Return how far the wheels of a side are apart along x, m."""
    x = [
        context.poses[joint.child].translation[0]
        for joint in context.robot.joints
        if joint.name in drive.left_wheels
        and joint.type is JointType.CONTINUOUS
        and joint.child in context.poses
    ]
    return max(x, default=0.0) - min(x, default=0.0)


def _is_widened(context: CheckContext, drive: DriveSettings) -> bool:
    """Return whether a plugin's separation is greater for wheels that scrub, by half at least."""
    length, width = _length(context, drive), _track(context, drive)
    if not (drive.is_plugin and length > _SCRUBBING and width > 0.0):
        return False
    return drive.separation >= width * (1.0 + 0.5 * (length / width) ** 2)


def _components(context: CheckContext) -> Iterator[tuple[HardwareInfo, ComponentInfo]]:
    for hardware in context.hardware:
        for component in hardware.components:
            yield hardware, component


def _named_wheels(drive: DriveSettings) -> tuple[tuple[str, tuple[str, ...]], ...]:
    return (
        ('left_wheel_names', drive.left_wheels),
        ('right_wheel_names', drive.right_wheels),
    )


def _check_wheel(
    context: CheckContext, drive: DriveSettings, parameter: str, name: str
) -> Iterator[Finding]:
    robot = context.robot
    what = f'{parameter} holds {quote(name)}'
    if not robot.has_joint(name):
        moving = [joint.name for joint in robot.joints if joint.has_position]
        meant = closest_match(name, moving)
        yield drive.error(
            parameter,
            f'{what}, which is no joint of the robot',
            expected=f'joints of {robot.source}: {quote_all(moving)}',
            fix=f'write "{meant}"' if meant else '',
        )
        return
    feedback = 'position' if drive.position_feedback else 'velocity'
    for kind, interface, offered in (
        ('command', 'velocity', _offered(context, name, 'command_interfaces')),
        ('state', feedback, _offered(context, name, 'state_interfaces')),
    ):
        if interface not in offered and not (kind == 'state' and drive.open_loop):
            yield drive.error(
                parameter,
                f'{what}, which has no {kind} interface "{interface}"',
                found=quote_all(sorted(offered)),
                fix=f'add <{kind}_interface name="{interface}"/> to it in <ros2_control>',
            )


def _offered(context: CheckContext, joint: str, interfaces: str) -> set[str]:
    """Return the names of the command or state interfaces of a joint in all blocks."""
    components: list[ComponentInfo] = [
        component
        for hardware in context.hardware
        for component in hardware.joints
        if component.name == joint
    ]
    return {each.name for component in components for each in getattr(component, interfaces)}


def _mean_y(context: CheckContext, names: tuple[str, ...]) -> float:
    """Return the mean y of the wheels that exist (m); NaN if none does."""
    y = [
        context.poses[joint.child].translation[1]
        for joint in context.robot.joints
        if joint.name in names and joint.child in context.poses
    ]
    return math.fsum(y) / len(y) if y and all(map(math.isfinite, y)) else math.nan


def _track(context: CheckContext, drive: DriveSettings) -> float:
    """Return the distance of left and right wheels along y (m); NaN if it is not known."""
    return abs(_mean_y(context, drive.left_wheels) - _mean_y(context, drive.right_wheels))
