# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules on the axles of wheels, and on angles in degrees, which turn them anywhere.

The wheels that a controller names are checked by their names, whatever their shape: with a wrong
axle a wheel cannot be told from a link that turns for another reason.
"""

from collections.abc import Iterator
import math

from lxml import etree

from amr_description.model.axles import angles_text, axle_fault, AxleFault, vector_text
from amr_description.model.checks.context import CheckContext, DriveSettings
from amr_description.model.findings import Finding
from amr_description.model.frames import Vector
from amr_description.model.robot import Joint
from amr_description.model.xml_reader import line_of, parse_number
from amr_description.text import quote, quote_all

# rad; beyond a full turn nobody writes an angle, with a margin for 6.2832.
_FULL_TURN = math.tau + 0.01
# Degrees of two turns; larger numbers are no angle at all.
_MOST_DEGREES = 720.0
_EXPECTED = '(0, 1, 0): level, to the left'


def axles_are_across(context: CheckContext) -> Iterator[Finding]:
    """
    The wheels that a controller names turn about the y axis of its base, within 26°.

    Wheels with the same fault share a finding. Where an angle on the way from the base to the
    wheel is in degrees, it is named as the cause. With ``--controllers``, whatever the shape of
    the wheels.
    """
    for drive in context.inputs.drives:
        groups: dict[tuple[str, str, str], list[Joint]] = {}
        for joint, fault, cause in _faults(context, drive):
            what, fix = fault.what, fault.fix
            if cause is not None:
                own = 'its <origin>' if cause is joint else f'joint {quote(cause.name)}'
                angles = _written(context)[cause.name]
                what += f', as the {_rpy_text(angles)} of {own} looks like degrees'
                fix = f'write {angles_text(_in_radians(angles))} in {own}'
            found = (
                f'{vector_text(fault.direction)} in the frame of {quote(_base(context, drive))}'
            )
            groups.setdefault((what, found, fix), []).append(joint)
        for (what, found, fix), joints in groups.items():
            # Gazebo drives with such a plugin, too; a controller's is known to be wrong.
            finding = context.warning if drive.is_plugin else context.error
            yield finding(
                joints[0].line,
                f'{_named(joints)} of {drive.name}: {what}',
                found=found,
                expected=_EXPECTED,
                fix=fix,
            )


def angles_are_in_radians(context: CheckContext) -> Iterator[Finding]:
    """
    No rpy of an ``<origin>`` looks like degrees: beyond a full turn, and whole or half a number.

    Those to which :func:`axles_are_across` puts down the axle of a wheel are not reported again.
    """
    told = {
        cause.name
        for drive in context.inputs.drives
        for _, _, cause in _faults(context, drive)
        if cause is not None
    }
    groups: dict[Vector, list[tuple[int, str]]] = {}
    for origin, owner in _origins(context.xml):
        joint = owner.get('name', '') if owner.tag == 'joint' else None
        angles = _angles(origin)
        if joint not in told and any(map(_is_degrees, angles)):
            groups.setdefault(angles, []).append((line_of(origin), _label(owner)))
    for angles, places in groups.items():
        more = f' and {len(places) - 3} more' if len(places) > 3 else ''
        worst = max(map(abs, angles))
        yield context.warning(
            places[0][0],
            f'the rpy of {", ".join(label for _, label in places[:3])}{more} looks like degrees',
            found=f'{_rpy_text(angles)}, up to {worst / math.tau:.1f} turns',
            expected='radians',
            fix=f'write {angles_text(_in_radians(angles))}',
        )


def lying_flat(context: CheckContext) -> Finding | None:
    """
    Return the finding on wheels of which all turn about the vertical; None if they do not.

    It is no rule: a drone has rotors of that kind, so it counts only for a robot that tips over.
    """
    robot, root = context.robot, context.robot.root.name
    joints = [robot.joint(wheel.joint) for wheel in context.wheels]
    faults = [axle_fault(robot, context.poses, joint, root) for joint in joints]
    flat = [fault for fault in faults if fault is not None and fault.is_vertical]
    if not flat or len(flat) < len(joints):
        return None
    return context.warning(
        joints[0].line,
        f'{_named(joints)}: {flat[0].what}, and the robot tips over',
        found=f'{vector_text(flat[0].direction)} in the frame of {quote(root)}',
        expected=_EXPECTED,
        fix=flat[0].fix,
    )


def _faults(
    context: CheckContext, drive: DriveSettings
) -> Iterator[tuple[Joint, AxleFault, Joint | None]]:
    """Yield the wheels of a drive with a wrong axle, and the joint whose angles are in degrees."""
    robot = context.robot
    base = _base(context, drive) if robot.roots else ''
    for name in dict.fromkeys(drive.wheels):
        joint = robot.joint(name) if robot.has_joint(name) else None
        if joint is None or not joint.has_position or not _is_placed(context, joint):
            continue
        fault = axle_fault(robot, context.poses, joint, base)
        if fault is not None:
            yield joint, fault, _joint_in_degrees(context, joint)


def _base(context: CheckContext, drive: DriveSettings) -> str:
    """Return the link whose x axis is the drive direction: the controller's, else the root."""
    return drive.base_frame if drive.base_frame in context.poses else context.robot.roots[0].name


def _is_placed(context: CheckContext, joint: Joint) -> bool:
    """Return whether both links of a joint hang below a root."""
    return {joint.parent, joint.child} <= context.poses.keys()


def _named(joints: list[Joint]) -> str:
    plural = 's' if len(joints) > 1 else ''
    return f'wheel joint{plural} {quote_all([joint.name for joint in joints])}'


def _joint_in_degrees(context: CheckContext, wheel: Joint) -> Joint | None:
    """Return the joint nearest to a wheel, its own first, whose rpy looks like degrees."""
    written = _written(context)
    joint: Joint | None = wheel
    passed: set[str] = set()  # an unsound tree may have a circle
    while joint is not None and joint.name not in passed:
        if any(map(_is_degrees, written.get(joint.name, ()))):
            return joint
        passed.add(joint.name)
        joint = context.robot.parent_joint(joint.parent)
    return None


def _written(context: CheckContext) -> dict[str, Vector]:
    """Return the rpy of each joint that has one, as the file has it."""
    return {
        owner.get('name', ''): _angles(origin)
        for origin, owner in _origins(context.xml)
        if owner.tag == 'joint'
    }


def _origins(xml: etree._Element) -> Iterator[tuple[etree._Element, etree._Element]]:
    """Yield each ``<origin>`` of joints, shapes and inertials, and the element that it is of."""
    for path in ('joint', 'link/inertial', 'link/visual', 'link/collision'):
        for owner in xml.iterfind(path):
            for origin in owner.iterfind('origin'):
                yield origin, owner


def _label(owner: etree._Element) -> str:
    """Return what messages call the part that an origin is of."""
    if owner.tag == 'joint':
        return f'joint {quote(owner.get("name", ""))}'
    link = owner.getparent()
    return f'the {owner.tag} of link {quote("" if link is None else link.get("name", ""))}'


def _angles(origin: etree._Element) -> Vector:
    """Return the rpy of an origin as written; 0 for what is no list of three numbers."""
    words = origin.get('rpy', '').split()
    if len(words) != 3:
        return (0.0, 0.0, 0.0)
    roll, pitch, yaw = map(parse_number, words)
    return (roll, pitch, yaw)


def _rpy_text(angles: Vector) -> str:
    """Return an attribute as written."""
    return f'rpy="{" ".join(f"{angle:g}" for angle in angles)}"'


def _is_degrees(angle: float) -> bool:
    """Return whether an angle is too large for radians, and round in degrees."""
    return _FULL_TURN < abs(angle) <= _MOST_DEGREES and (2.0 * angle).is_integer()


def _in_radians(angles: Vector) -> Vector:
    """Return angles in radians; those that are not whole in degrees, as 1.57, are it already."""
    roll, pitch, yaw = (
        math.radians(angle) if (2.0 * angle).is_integer() else angle for angle in angles
    )
    return (roll, pitch, yaw)
