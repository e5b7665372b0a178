# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``<joint>`` elements of URDF -> :class:`~amr_description.model.robot.Joint`."""

import math

from lxml import etree

from amr_description.model.element_reader import ElementReader, line_of
from amr_description.model.findings import quote
from amr_description.model.frames import Vector
from amr_description.model.robot import Dynamics, Joint, JointType, Limit, Mimic
from amr_description.model.urdf_links import read_origin

# URDF's default axis.
_X_AXIS: Vector = (1.0, 0.0, 0.0)
# The types that need limits, with urdfdom's words when they have none.
_LIMITED = {
    JointType.REVOLUTE: 'Joint [{}] is of type REVOLUTE but it does not specify limits',
    JointType.PRISMATIC: 'Joint [{}] is of type PRISMATIC without limits',
}
_WITHOUT_AXIS = (JointType.FIXED, JointType.FLOATING)


def _refusal(*words: str) -> str:
    """Return what urdfdom prints, one message a line, when it refuses a joint."""
    return '\n'.join((*words, 'joint xml is not initialized correctly'))


def read_joints(xml: etree._Element, reader: ElementReader) -> tuple[Joint, ...]:
    """Return every ``<joint>`` below ``xml``; one of unknown type is reported, then fixed."""
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
        reader.error(
            element, '<joint> has no attribute "name"', urdfdom=_refusal('unnamed joint found')
        )
    origin = read_origin(
        element, reader.refused_as(_refusal(f'Malformed parent origin element for joint [{name}]'))
    )
    parent = _read_end(element, 'parent')
    child = _read_end(element, 'child')
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


def _read_end(element: etree._Element, tag: str) -> str:
    """Return the name of the parent or child link; '' (tree.py objects) when it is missing."""
    end = element.find(tag)
    return '' if end is None else end.get('link', '')


def _read_type(element: etree._Element, name: str, reader: ElementReader) -> JointType:
    text = element.get('type')
    if text in JointType:
        return JointType(text)
    known = ', '.join(JointType)
    if text is None:
        words = f"joint [{name}] has no type, check to see if it's a reference."
        reader.error(
            element,
            '<joint> has no attribute "type"',
            expected=f'one of {known}',
            urdfdom=_refusal(words),
        )
    else:
        words = f'Joint [{name}] has no known type [{text}]'
        reader.error(
            element,
            'unknown joint type',
            found=quote(text),
            expected=f'one of {known}',
            urdfdom=_refusal(words),
        )
    return JointType.FIXED


def _read_axis(
    element: etree._Element, kind: JointType, name: str, reader: ElementReader
) -> Vector:
    axis = element.find('axis')
    if axis is None or kind in _WITHOUT_AXIS:
        return _X_AXIS
    refused = reader.refused_as(_refusal(f'Malformed axis element for joint [{name}]'))
    values = refused.numbers(axis, 'xyz', 3, _X_AXIS)
    length = math.hypot(*values)
    if length == 0.0 or math.isinf(length):
        reader.error(
            axis,
            'the axis has no direction',
            found=quote(axis.get('xyz', '')),
            expected='a vector of finite length above 0',
        )
    if not 0.0 < length < math.inf:
        return _X_AXIS
    x, y, z = values
    return (x / length, y / length, z / length)


def _read_limit(
    element: etree._Element, kind: JointType, name: str, reader: ElementReader
) -> Limit | None:
    limit = element.find('limit')
    if limit is None:
        if kind in _LIMITED:
            reader.error(
                element,
                f'a {kind} joint needs limits',
                fix='add <limit lower="…" upper="…" effort="…" velocity="…"/>',
                urdfdom=_refusal(_LIMITED[kind].format(name)),
            )
        return None
    refused = reader.refused_as(_refusal(f'Could not parse limit element for joint [{name}]'))
    return Limit(
        lower=refused.number(limit, 'lower', 0.0),
        upper=refused.number(limit, 'upper', 0.0),
        effort=_read_required_limit(limit, 'effort', name, reader),
        velocity=_read_required_limit(limit, 'velocity', name, reader),
    )


def _read_required_limit(
    limit: etree._Element, attribute: str, name: str, reader: ElementReader
) -> float:
    words = [f'Could not parse limit element for joint [{name}]']
    if limit.get(attribute) is None:
        words.insert(0, f'joint limit: no {attribute}')
    return reader.refused_as(_refusal(*words)).number(limit, attribute)


def _read_mimic(element: etree._Element, name: str, reader: ElementReader) -> Mimic | None:
    mimic = element.find('mimic')
    if mimic is None:
        return None
    refused = reader.refused_as(_refusal(f'Could not parse mimic element for joint [{name}]'))
    return Mimic(
        joint=refused.required(mimic, 'joint'),
        multiplier=refused.number(mimic, 'multiplier', 1.0),
        offset=refused.number(mimic, 'offset', 0.0),
    )


def _read_dynamics(element: etree._Element, name: str, reader: ElementReader) -> Dynamics | None:
    dynamics = element.find('dynamics')
    if dynamics is None:
        return None
    refused = reader.refused_as(_refusal(f'Could not parse dynamics element for joint [{name}]'))
    if dynamics.get('damping') is None and dynamics.get('friction') is None:
        refused.error(
            dynamics,
            '<dynamics> says nothing',
            expected='damping or friction',
            urdfdom=_refusal(
                'joint dynamics element specified with no damping and no friction',
                f'Could not parse dynamics element for joint [{name}]',
            ),
        )
    return Dynamics(
        damping=refused.number(dynamics, 'damping', 0.0),
        friction=refused.number(dynamics, 'friction', 0.0),
    )
