# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``<joint>`` elements of URDF -> :class:`~amr_description.model.robot.Joint`."""

import math

from lxml import etree

from amr_description.model.findings import quote
from amr_description.model.frames import Vector
from amr_description.model.robot import Dynamics, Joint, JointType, Limit, Mimic
from amr_description.model.urdf_links import read_origin
from amr_description.model.xml_reader import ElementReader, line_of

# URDF's default axis.
_X_AXIS: Vector = (1.0, 0.0, 0.0)
_LIMITED = (JointType.REVOLUTE, JointType.PRISMATIC)
_WITHOUT_AXIS = (JointType.FIXED, JointType.FLOATING)


def read_joints(xml: etree._Element, reader: ElementReader) -> tuple[Joint, ...]:
    """Return every ``<joint>`` below ``xml``; one of unknown type is reported and then taken as fixed."""
    joints: dict[str, Joint] = {}
    for element in xml.iterchildren('joint'):
        joint = _read_joint(element, reader)
        if joint.name in joints:
            reader.error(
                element,
                f'joint {quote(joint.name)} is not unique',
                found=f'the first on line {joints[joint.name].line}',
                fix='give every joint a name of its own',
                urdfdom=f"joint '{joint.name}' is not unique.",
            )
        joints.setdefault(joint.name, joint)
    return tuple(joints.values())


def _read_joint(element: etree._Element, reader: ElementReader) -> Joint:
    name = element.get('name', '')
    reader = reader.of(f'joint {quote(name)}')
    if not name:
        reader.error(element, '<joint> has no attribute "name"', urdfdom='unnamed joint found')
    origin = read_origin(
        element, reader.refused_as(f'Malformed parent origin element for joint [{name}]')
    )
    parent = _read_end(element, 'parent', name, reader)
    child = _read_end(element, 'child', name, reader)
    kind = _read_type(element, name, reader)
    return Joint(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        origin=origin,
        axis=_read_axis(element, kind, name, reader),
        limit=_read_limit(element, kind, name, reader),
        mimic=_read_mimic(element, name, reader),
        dynamics=_read_dynamics(element, name, reader),
        line=line_of(element),
    )


def _read_end(element: etree._Element, tag: str, name: str, reader: ElementReader) -> str:
    end = element.find(tag)
    link = '' if end is None else end.get('link', '')
    if not link:
        reader.error(
            element,
            f'the joint has no {tag} link',
            fix=f'add <{tag} link="…"/>',
            urdfdom=(
                f'Failed to build tree: Joint [{name}] is missing a parent and/or child link specification.'
            ),
        )
    return link


def _read_type(element: etree._Element, name: str, reader: ElementReader) -> JointType:
    text = element.get('type')
    if text in JointType:
        return JointType(text)
    known = ', '.join(JointType)
    if text is None:
        words = f"joint [{name}] has no type, check to see if it's a reference."
        reader.error(
            element, '<joint> has no attribute "type"', expected=f'one of {known}', urdfdom=words
        )
    else:
        words = f'Joint [{name}] has no known type [{text}]'
        reader.error(
            element,
            'unknown joint type',
            found=quote(text),
            expected=f'one of {known}',
            urdfdom=words,
        )
    return JointType.FIXED


def _read_axis(
    element: etree._Element, kind: JointType, name: str, reader: ElementReader
) -> Vector:
    axis = element.find('axis')
    if axis is None or kind in _WITHOUT_AXIS:
        return _X_AXIS
    refused = reader.refused_as(f'Malformed axis element for joint [{name}]')
    values = refused.numbers(axis, 'xyz', 3, _X_AXIS)
    length = math.hypot(*values)
    if length == 0.0:
        reader.error(
            axis,
            'the axis has no direction',
            found=quote(axis.get('xyz', '')),
            expected='a vector not of length 0',
        )
    if not length > 0.0:
        return _X_AXIS
    x, y, z = values
    return (x / length, y / length, z / length)


def _read_limit(
    element: etree._Element, kind: JointType, name: str, reader: ElementReader
) -> Limit | None:
    limit = element.find('limit')
    if limit is None:
        if kind in _LIMITED:
            words = {
                JointType.REVOLUTE: f'Joint [{name}] is of type REVOLUTE but it does not specify limits',
                JointType.PRISMATIC: f'Joint [{name}] is of type PRISMATIC without limits',
            }
            reader.error(
                element,
                f'a {kind} joint needs limits',
                fix='add <limit lower="…" upper="…" effort="…" velocity="…"/>, or make the joint continuous',
                urdfdom=words[kind],
            )
        return None
    refused = reader.refused_as(f'Could not parse limit element for joint [{name}]')
    return Limit(
        lower=refused.number(limit, 'lower', 0.0),
        upper=refused.number(limit, 'upper', 0.0),
        effort=refused.number(limit, 'effort'),
        velocity=refused.number(limit, 'velocity'),
    )


def _read_mimic(element: etree._Element, name: str, reader: ElementReader) -> Mimic | None:
    mimic = element.find('mimic')
    if mimic is None:
        return None
    refused = reader.refused_as(f'Could not parse mimic element for joint [{name}]')
    return Mimic(
        joint=refused.required(mimic, 'joint'),
        multiplier=refused.number(mimic, 'multiplier', 1.0),
        offset=refused.number(mimic, 'offset', 0.0),
    )


def _read_dynamics(element: etree._Element, name: str, reader: ElementReader) -> Dynamics | None:
    dynamics = element.find('dynamics')
    if dynamics is None:
        return None
    refused = reader.refused_as(f'Could not parse dynamics element for joint [{name}]')
    if dynamics.get('damping') is None and dynamics.get('friction') is None:
        refused.error(
            dynamics,
            '<dynamics> says nothing',
            expected='damping or friction',
            urdfdom='joint dynamics element specified with no damping and no friction',
        )
    return Dynamics(
        damping=refused.number(dynamics, 'damping', 0.0),
        friction=refused.number(dynamics, 'friction', 0.0),
    )
