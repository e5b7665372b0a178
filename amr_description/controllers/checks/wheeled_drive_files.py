# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The mecanum, omni wheel and steering drives of parameter files, held against a robot.

A wrong size, a wheel at another corner or an axle that points the other way keeps no controller
from running: the robot goes elsewhere than its odometry. Everything here is a warning, at the line
of the parameter. Drives with joints that the robot lacks are left out.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
import math
from typing import Any, TYPE_CHECKING

from amr_description.controllers import CONTROLLERS
from amr_description.controllers.checks.parameter_faults import (
    controller_parameters,
    ControllerParameters,
    type_here,
)
from amr_description.controllers.checks.parameter_sections import listed_controllers, read_sections
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import null_log
from amr_description.model.axles import vector_text
from amr_description.model.findings import Finding, Severity, SourceLocation
from amr_description.model.frames import conjugate, dot, rotate, Transform, Vector
from amr_description.model.gazebo.builder import GazeboTranslation, PluginController
from amr_description.model.gazebo.drives import CORNERS, MECANUM
from amr_description.model.gazebo.physics import gazebo_physics_of
from amr_description.model.gazebo.plugins import PluginTag
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import Joint, JointType, Robot
from amr_description.model.urdf import read_robot
from amr_description.model.wheels import described_rollers, find_wheels, Rollers
from amr_description.model.xml_reader import parse_xml
from amr_description.parameters import build
from amr_description.text import quote

if TYPE_CHECKING:  # a robot has one of these drives, and is not to wait for the others
    from amr_description.controllers.drives.diff_drive_controller import DiffDriveParameters
    from amr_description.controllers.drives.mecanum_drive_controller import MecanumDriveParameters
    from amr_description.controllers.drives.omni_wheel_drive_controller import (
        OmniWheelDriveParameters,
    )
    from amr_description.controllers.drives.steering_controllers import SteeringParameters

_TOLERANCE = 0.02
"""Of a size, as for differential drives."""
_ALIGNED = 0.9
"""The least cosine between an axle and where it should point: 26°."""
_NEARLY = math.radians(5.0)
_UP: Vector = (0.0, 0.0, 1.0)
_LEFT: Vector = (0.0, 1.0, 0.0)
_NO_TAGS: Mapping[str, PluginTag] = {}
_CORNERS = {
    'front_left_wheel': (1, 1),
    'front_right_wheel': (1, -1),
    'rear_right_wheel': (-1, -1),
    'rear_left_wheel': (-1, 1),
}


def wheeled_drive_findings(robot: Robot, paths: Sequence[str]) -> tuple[Finding, ...]:
    """
    Return what is wrong with such drives of parameter files on a robot.

    Args:
        robot: the robot, its tree sound.
        paths: of the parameter files; what cannot be read is left to others.
    """
    try:
        found = read_sections(paths)
    except ParameterError:
        return ()
    findings: list[Finding] = []
    for each in listed_controllers(found):
        try:
            table = CONTROLLERS.find(type_here(each.type)).parameters_type
        except ControllerError:
            continue
        check = _check_of(table)
        if check is None:
            continue
        read = controller_parameters(found, each.node, each.type, each.location)
        if read.is_sound:
            drive = _Drive(each.name, robot, read)
            findings += check(drive, build(table, read.values))
    return tuple(findings)


def plugin_findings(robot: Robot, plugins: Sequence[PluginController]) -> tuple[Finding, ...]:
    """
    Return what is wrong with the mecanum and steering drives that stand for plugins of Gazebo.

    Args:
        robot: the robot, its tree sound.
        plugins: the controllers, at whose lines and elements the findings are.
    """
    findings: list[Finding] = []
    for each in plugins:
        table = CONTROLLERS.find(each.type).parameters_type
        check = _check_of(table)
        if check is None or not each.tags:
            continue
        places = {name: SourceLocation(robot.source, tag.line) for name, tag in each.tags.items()}
        read = ControllerParameters(
            SourceLocation(robot.source, each.line), dict(each.parameters), places
        )
        findings += check(_Drive(each.name, robot, read, each.tags), build(table, read.values))
    return tuple(findings)


def wheeled_drive_faults(text: str, source: str, paths: Sequence[str]) -> tuple[Finding, ...]:
    """
    Return :func:`wheeled_drive_findings` on a URDF whose faults are left to the checker.

    Args:
        text: the URDF; with faults of its own there are no findings.
        source: names its file.
        paths: of the parameter files.
    """
    faults: list[Finding] = []
    xml = parse_xml(text, source, faults.append)
    robot = None if xml is None else read_robot(xml, text, source, faults.append)
    is_sound = not any(each.severity is Severity.ERROR for each in faults)
    if robot is None or len(robot.roots) != 1 or not is_sound:
        return ()
    return wheeled_drive_findings(robot, paths)


@dataclass(frozen=True, slots=True)
class _WheelMount:
    """Where the joint of a wheel is, m, and where its axis points, in the frame of the base."""

    joint: str
    x: float
    y: float
    axis: Vector


class _Drive:
    """One controller, and the robot."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        read: ControllerParameters,
        tags: Mapping[str, PluginTag] = _NO_TAGS,
    ) -> None:
        """``tags``: of a plugin, the elements of its parameters."""
        self.robot = robot
        self._tags = tags
        self._name = name
        self._read = read
        self._poses = link_poses(robot, {})

    def has(self, joints: Sequence[str]) -> bool:
        """Return whether all of some joints are there and move."""
        return all(self.robot.has_joint(j) and self.robot.joint(j).has_position for j in joints)

    def link_of(self, joint: str) -> str:
        """Return the link that a joint moves."""
        return self.robot.joint(joint).child

    def mounts(self, joints: Sequence[str], base: str) -> list[_WheelMount]:
        """Return where joints are; ``base``: the link of the controller, else the root."""
        frame = self._poses.get(base, Transform())
        back = conjugate(frame.rotation)
        found = []
        for name in joints:
            joint = self.robot.joint(name)
            pose = self._poses[joint.child]
            pairs = zip(pose.translation, frame.translation, strict=True)
            dx, dy, dz = (a - b for a, b in pairs)
            x, y, _ = rotate(back, (dx, dy, dz))
            axis = rotate(back, rotate(pose.rotation, joint.axis))
            found.append(_WheelMount(name, x, y, axis))
        return found

    def warn(self, parameters: Sequence[str], what: str, **details: Any) -> Finding:
        """Return a warning on the line of the first of some parameters that is set."""
        locations = self._read.locations
        location = next((locations[p] for p in parameters if p in locations), self._read.location)
        return Finding.warning(*location, f'{self._name}: {what}', **details)

    def size(self, parameter: str, found: float, true: float, of: str) -> Iterator[Finding]:
        """Warn of a size that is not that of the robot; a true one of 0 is not known."""
        if true > 0.0 and abs(found - true) > _TOLERANCE * true:
            tag = self._tags.get(parameter)
            per = tag.per if tag else 1.0
            written = tag.written(true) if tag else f'{parameter.rpartition(".")[2]}: {true:.4g}'
            yield self.warn(
                (parameter,),
                f'{tag.text if tag else parameter} is not that of the robot',
                found=f'{found * per:g} m',
                expected=f'{true * per:.4g} m, {of if per == 1.0 else f"{per:g} times {of}"}',
                fix=f'write {written}',
            )

    def radius(self, parameter: str, found: float, joints: Sequence[str]) -> Iterator[Finding]:
        """Warn of a radius that is not that of the wheels."""
        wheels = find_wheels(self.robot, joints)
        radius = wheels[0].radius if wheels else 0.0
        yield from self.size(parameter, found, radius, 'the radius of the collision shape')

    def axles(self, mounts: Sequence[_WheelMount], parameters: Sequence[str]) -> Iterator[Finding]:
        """Warn of wheels that turn backwards, or not about y."""
        for mount in mounts:
            along = dot(mount.axis, _LEFT)
            if along < _ALIGNED:
                what = 'turns backwards' if along < -_ALIGNED else 'does not roll ahead'
                yield self.warn(
                    parameters,
                    f'the wheel of joint {quote(mount.joint)} {what}',
                    found=f'an axis {vector_text(mount.axis)} in the frame of the base',
                    expected='(0, 1, 0): to the left',
                )


def _check_of(table: type) -> Callable[[_Drive, Any], Iterator[Finding]] | None:
    names = (f'{each.__module__}:{each.__name__}' for each in table.__mro__)
    return next((_CHECKS[name] for name in names if name in _CHECKS), None)


def _check_mecanum(drive: _Drive, parameters: 'MecanumDriveParameters') -> Iterator[Finding]:
    joints = parameters.command_joints
    if not drive.has(joints):
        return
    mounts = drive.mounts(joints, parameters.base_frame_id)
    xs, ys = [p.x for p in mounts], [p.y for p in mounts]
    middle = 0.5 * (max(xs) + min(xs)), 0.5 * (max(ys) + min(ys))
    for mount, (name, corner) in zip(mounts, _CORNERS.items(), strict=True):
        sides = mount.x - middle[0], mount.y - middle[1]
        if sides[0] * corner[0] <= 0.0 or sides[1] * corner[1] <= 0.0:
            yield drive.warn(
                (f'{name}_command_joint_name',),
                f'joint {quote(mount.joint)} is not at the corner of {name}',
                found=f'({sides[0]:.3g}, {sides[1]:.3g}) m from the middle of the wheels',
                expected=f'x {_sign(corner[0])}, y {_sign(corner[1])}: x ahead, y to the left',
            )
            return
    reach = 0.5 * (max(xs) - min(xs)) + 0.5 * (max(ys) - min(ys))
    sizes = parameters.kinematics
    yield from drive.radius('kinematics.wheels_radius', sizes.wheels_radius, joints)
    yield from drive.size(
        'kinematics.sum_of_robot_center_projection_on_X_Y_axis',
        sizes.sum_of_robot_center_projection_on_X_Y_axis,
        reach,
        'half of the wheelbase and half of the track',
    )
    yield from drive.axles(mounts, [f'{name}_command_joint_name' for name in _CORNERS])


def _check_omni(drive: _Drive, parameters: 'OmniWheelDriveParameters') -> Iterator[Finding]:
    joints = parameters.wheel_names
    if not drive.has(joints):
        return
    yield from drive.radius('wheel_radius', parameters.wheel_radius, joints)
    mounts = drive.mounts(joints, parameters.base_frame_id)
    far = sum(math.hypot(mount.x, mount.y) for mount in mounts) / len(mounts)
    yield from drive.size('robot_radius', parameters.robot_radius, far, 'as far as the wheels are')
    for index, mount in enumerate(mounts):
        wanted = parameters.wheel_offset + math.tau * index / len(mounts)
        angle = math.atan2(mount.y, mount.x)
        if abs(math.remainder(angle - wanted, math.tau)) > _NEARLY:
            yield drive.warn(
                ('wheel_names',),
                f'joint {quote(mount.joint)} is not where wheel {index + 1} of {len(mounts)} is',
                found=f'{math.degrees(angle):.0f} degrees from x',
                expected=f'{math.degrees(math.remainder(wanted, math.tau)):.0f} degrees, '
                'counter-clockwise from wheel_offset',
            )
            return
        outwards = mount.axis[0] * math.cos(angle) + mount.axis[1] * math.sin(angle)
        if outwards < _ALIGNED:
            yield drive.warn(
                ('wheel_names',),
                f'the axle of joint {quote(mount.joint)} does not point outwards',
                found=f'an axis {vector_text(mount.axis)} in the frame of the base',
                expected=vector_text((math.cos(angle), math.sin(angle), 0.0)),
            )


def _check_rollers(drive: _Drive, parameters: 'DiffDriveParameters') -> Iterator[Finding]:
    """A differential drive on mecanum wheels turns as these do."""
    joints = (*parameters.left_wheel_names, *parameters.right_wheel_names)
    if not drive.has(joints):
        return
    described = described_rollers(drive.robot, gazebo_physics_of(drive.robot))
    angles = [described[link].angle for link in map(drive.link_of, joints) if link in described]
    if len(angles) < len(joints) or any(abs(math.sin(2.0 * angle)) < _ALIGNED for angle in angles):
        return
    mounts = drive.mounts(joints, parameters.base_frame_id)
    xs, ys = [p.x for p in mounts], [p.y for p in mounts]
    wanted = max(xs) - min(xs) + max(ys) - min(ys)
    found = parameters.wheel_separation * parameters.wheel_separation_multiplier
    if abs(found - wanted) > _TOLERANCE * wanted:
        factor = wanted / parameters.wheel_separation
        yield drive.warn(
            ('wheel_separation_multiplier', 'wheel_separation'),
            'its wheels have rollers, and turn the robot as those of a mecanum drive do',
            found=f'an effective separation of {found:.3g} m',
            expected=f'{wanted:.3g} m: wheelbase and track',
            fix=f'write wheel_separation_multiplier: {factor:.3g}, or use the '
            'mecanum_drive_controller',
        )


def _check_steering(drive: _Drive, parameters: 'SteeringParameters') -> Iterator[Finding]:
    parameters = parameters.modernized(null_log)
    traction, steering = parameters.traction_joints_names, parameters.steering_joints_names
    if not (traction and steering and drive.has((*traction, *steering))):
        return
    driven = drive.mounts(traction, parameters.base_frame_id)
    steered = drive.mounts(steering, parameters.base_frame_id)
    base = abs(_mean(steered) - _mean(driven))
    yield from drive.size('wheelbase', parameters.wheelbase, base, 'from axle to axle')
    for name in ('traction_wheels_radius', 'traction_wheel_radius'):
        if hasattr(parameters, name):
            yield from drive.radius(name, getattr(parameters, name), traction)
    names = ('traction_joints_names', 'rear_wheels_names', 'front_wheels_names')
    yield from _check_pair(drive, driven, parameters, 'traction', names)
    yield from drive.axles(driven, names)
    names = ('steering_joints_names', 'front_wheels_names', 'rear_wheels_names')
    yield from _check_pair(drive, steered, parameters, 'steering', names)
    for mount in steered:
        if dot(mount.axis, _UP) < _ALIGNED:
            yield drive.warn(
                names,
                f'joint {quote(mount.joint)} does not steer to the left where it is positive',
                found=f'an axis {vector_text(mount.axis)} in the frame of the base',
                expected='(0, 0, 1): up',
            )
    yield from _check_rolling(drive, steering, names)


def _check_pair(
    drive: _Drive,
    mounts: Sequence[_WheelMount],
    parameters: 'SteeringParameters',
    kind: str,
    names: Sequence[str],
) -> Iterator[Finding]:
    """Two joints are right before left, as far apart as their track."""
    if len(mounts) != 2:
        return
    right, left = mounts
    if right.y > left.y:
        yield drive.warn(
            names,
            f'the {kind} joints are not in the order right, left',
            found=f'{right.joint}, {left.joint}',
            fix=f'write [{left.joint}, {right.joint}]',
        )
    track = getattr(parameters, f'{kind}_track_width', 0.0)
    if track:
        yield from drive.size(f'{kind}_track_width', track, abs(left.y - right.y), 'apart')


def _check_rolling(
    drive: _Drive, steering: Sequence[str], names: Sequence[str]
) -> Iterator[Finding]:
    """A wheel that is steered rolls on a joint of its own."""
    robot = drive.robot
    joints = [j for j in robot.joints if j.name in steering or _follows(j, steering)]
    for joint in joints:
        below = _below(robot, joint.child)
        rolls = any(j.type is JointType.CONTINUOUS for j in robot.joints if j.parent in below)
        if not rolls and any(robot.link(link).collisions for link in below):
            yield drive.warn(
                names,
                f'the wheel on joint {quote(joint.name)} is steered and cannot roll: it slides',
                found=f'no continuous joint below {quote(joint.child)}',
                expected='a link for the wheel there, on a continuous joint',
            )


def _follows(joint: Joint, names: Sequence[str]) -> bool:
    return joint.mimic is not None and joint.mimic.joint in names


def _below(robot: Robot, link: str) -> set[str]:
    """Return a link, and all links below it."""
    found, waiting = {link}, [link]
    while waiting:
        parent = waiting.pop()
        children = {j.child for j in robot.joints if j.parent == parent} - found
        found |= children
        waiting += children
    return found


def _mean(mounts: Sequence[_WheelMount]) -> float:
    return sum(mount.x for mount in mounts) / len(mounts)


def _sign(value: int) -> str:
    return '> 0' if value > 0 else '< 0'


_DRIVES = 'amr_description.controllers.drives'
_CHECKS: Mapping[str, Callable[[_Drive, Any], Iterator[Finding]]] = {
    f'{_DRIVES}.diff_drive_controller:DiffDriveParameters': _check_rollers,
    f'{_DRIVES}.mecanum_drive_controller:MecanumDriveParameters': _check_mecanum,
    f'{_DRIVES}.omni_wheel_drive_controller:OmniWheelDriveParameters': _check_omni,
    f'{_DRIVES}.steering_controllers:SteeringParameters': _check_steering,
}
"""By the table of parameters, or one that it extends."""


MECANUM_DRIVE = 'mecanum_drive_controller/MecanumDriveController'
OMNI_WHEEL_DRIVE = 'omni_wheel_drive_controller/OmniWheelDriveController'

_EIGHTH = math.pi / 4.0
_SIGNS = (-1.0, 1.0, -1.0, 1.0)
"""Of their angles: front left, front right, rear right, rear left; an X from above."""


def rollers_of_controllers(robot: Robot, paths: Sequence[str]) -> dict[str, Rollers]:
    """
    Return the rollers of wheels, by joint, as their controllers have them.

    Args:
        robot: the robot; joints that it does not have are left out.
        paths: of the parameter files; what cannot be read is left to the manager.
    """
    try:
        found = read_sections(paths)
    except ParameterError:
        return {}
    rollers: dict[str, Rollers] = {}
    for each in listed_controllers(found):
        kind = type_here(each.type)
        if kind in (MECANUM_DRIVE, OMNI_WHEEL_DRIVE):
            read = controller_parameters(found, each.node, kind, each.location)
            if read.is_sound:
                rollers.update(_rollers(kind, read.values))
    return {joint: each for joint, each in rollers.items() if robot.has_joint(joint)}


def mecanum_rollers(joints: Sequence[str]) -> dict[str, Rollers]:
    """Return the rollers of four wheels: front left, front right, rear right, rear left."""
    return {joint: Rollers(sign * _EIGHTH) for joint, sign in zip(joints, _SIGNS, strict=True)}


def _rollers(kind: str, values: dict[str, object]) -> Iterator[tuple[str, Rollers]]:
    if kind == MECANUM_DRIVE:
        from amr_description.controllers.drives.mecanum_drive_controller import (
            MecanumDriveParameters,
        )

        yield from mecanum_rollers(build(MecanumDriveParameters, values).command_joints).items()
    else:
        names = values.get('wheel_names')
        for joint in names if isinstance(names, Sequence) else ():
            yield joint, Rollers(0.0)


def rollers_of_plugins(translation: GazeboTranslation) -> dict[str, Rollers]:
    """Return the rollers of wheels, by joint, that a mecanum drive of Gazebo names."""
    found: dict[str, Rollers] = {}
    for each in translation.controllers:
        if each.type == MECANUM:
            found |= mecanum_rollers(
                [each.parameters[f'{corner}_wheel_command_joint_name'] for corner in CORNERS]
            )
    return found
