# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``<joint>`` elements of URDF -> :class:`~amr_description.model.robot.Joint`."""

from collections.abc import Mapping
from dataclasses import replace
import math

from lxml import etree

from amr_description.model.findings import Finding
from amr_description.model.frames import Vector
from amr_description.model.robot import Dynamics, Joint, JointType, Limit, Mimic, SafetyController
from amr_description.model.urdf_links import read_origin
from amr_description.model.xml_reader import ElementReader, line_of, parse_number
from amr_description.text import closest_match, quote, quote_all

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
    """Return every ``<joint>`` below ``xml``; report an unknown type and read it as fixed."""
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
    return tuple(_with_possible_mimic(joint, joints, reader) for joint in joints.values())


def _with_possible_mimic(
    joint: Joint, joints: Mapping[str, Joint], reader: ElementReader
) -> Joint:
    """Return a joint; without its mimic, which is reported, where there is nothing to follow."""
    name = '' if joint.mimic is None else joint.mimic.joint
    source = joints.get(name)
    if not name or (source and source is not joint and source.has_position and joint.has_position):
        return joint
    what, found = 'mimics a joint that is not there', quote(name)
    expected = f'another one of {quote_all(list(joints))}'
    taken = 'it moves by itself' if joint.has_position else 'it stays as it is'
    if source is joint:
        found = 'itself'
    elif source is not None:
        odd = joint if source.has_position else source
        what, found = f'cannot mimic {found}', f'{quote(odd.name)} of type {odd.type}'
        expected = 'two joints of type revolute, continuous or prismatic'
    where = f'joint {quote(joint.name)} {what}'
    reader.report(
        Finding.warning(
            reader.source, joint.line, where, found=found, expected=expected, taken=taken
        )
    )
    return replace(joint, mimic=None)


def _read_joint(element: etree._Element, reader: ElementReader) -> Joint:
    name = element.get('name', '')
    reader = reader.of(f'joint {quote(name)}')
    if not name:
        # An empty name is one to urdfdom.
        words = '' if element.get('name') is not None else _refusal('unnamed joint found')
        reader.error(element, '<joint> has no attribute "name"', urdfdom=words)
    malformed = f'Malformed parent origin element for joint [{name}]'
    words = _refusal(*_vector_words(element.find('origin'), 'xyz', 'rpy'), malformed)
    origin = read_origin(element, reader.refused_as(words))
    _check_calibration(element, name, reader)
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
        safety=_read_safety(element, name, reader),
    )


def _read_end(element: etree._Element, tag: str) -> str:
    """Return the name of the parent or child link; '' if missing, which TREE_RULES report."""
    end = element.find(tag)
    return '' if end is None else end.get('link', '')


def _read_type(element: etree._Element, name: str, reader: ElementReader) -> JointType:
    text = element.get('type')
    if text in set(JointType):
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
        meant = closest_match(text, [str(each) for each in JointType])
        reader.error(
            element,
            'unknown joint type',
            found=quote(text),
            expected=f'one of {known}',
            fix=f'write type="{meant}"' if meant else '',
            urdfdom=_refusal(words),
        )
    return JointType.FIXED


def _read_axis(
    element: etree._Element, kind: JointType, name: str, reader: ElementReader
) -> Vector:
    axis = element.find('axis')
    if axis is None or kind in _WITHOUT_AXIS:
        return _X_AXIS
    reason = ': '.join([f'Malformed axis element for joint [{name}]', *_vector_words(axis, 'xyz')])
    values = reader.refused_as(_refusal(reason)).numbers(axis, 'xyz', 3, _X_AXIS)
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
    words = f'Could not parse limit element for joint [{name}]'
    lower, upper = (_number(limit, key, reader, words, 0.0) for key in ('lower', 'upper'))
    if kind in _LIMITED and lower > upper:  # as macros that mirror a joint make them
        reader.warning(
            element,
            'the lower limit is above the upper one',
            found=f'lower {lower:g}, upper {upper:g}',
            taken='they are swapped',
        )
        lower, upper = upper, lower
    return Limit(
        lower=lower,
        upper=upper,
        effort=_number(limit, 'effort', reader, words),
        velocity=_number(limit, 'velocity', reader, words),
    )


def _number(
    element: etree._Element,
    attribute: str,
    reader: ElementReader,
    words: str,
    default: float | None = None,
) -> float:
    """Return a number; ``words`` is what urdfdom prints, after the reason, for a fault in it."""
    text = element.get(attribute)
    kind = element.tag.partition('_')[0]  # urdfdom says "safety" of a <safety_controller>
    reason = f'joint {kind}: no {attribute}'
    if text is not None:
        reason = f'{attribute} value ({text}) is not a valid float'
    return reader.refused_as(_refusal(reason, words)).number(element, attribute, default)


def _vector_words(element: etree._Element | None, *attributes: str) -> list[str]:
    """Return the message of urdfdom for the first malformed vector; [] if all are well-formed."""
    if element is None:
        return []
    for attribute in attributes:
        text = element.get(attribute, '0 0 0')
        parts = text.split()
        for part in parts:
            if math.isnan(parse_number(part)):
                return [
                    f'Unable to parse component [{part}] to a double (while parsing a vector '
                    'value)'
                ]
        if len(parts) != 3:
            return [
                f'Parser found {len(parts)} elements but 3 expected while parsing vector [{text}]'
            ]
    return []


def _read_mimic(element: etree._Element, name: str, reader: ElementReader) -> Mimic | None:
    mimic = element.find('mimic')
    if mimic is None:
        return None
    words = f'Could not parse mimic element for joint  [{name}]'
    missing = _refusal('joint mimic: no mimic joint specified', words)
    return Mimic(
        joint=reader.refused_as(missing).required(mimic, 'joint'),
        multiplier=_number(mimic, 'multiplier', reader, words, 1.0),
        offset=_number(mimic, 'offset', reader, words, 0.0),
    )


def _read_dynamics(element: etree._Element, name: str, reader: ElementReader) -> Dynamics | None:
    dynamics = element.find('dynamics')
    if dynamics is None:
        return None
    words = f'Could not parse joint_dynamics element for joint [{name}]'
    if dynamics.get('damping') is None and dynamics.get('friction') is None:
        reader.error(
            dynamics,
            '<dynamics> says nothing',
            expected='damping or friction',
            urdfdom=_refusal(
                'joint dynamics element specified with no damping and no friction',
                words,
            ),
        )
    return Dynamics(
        damping=_number(dynamics, 'damping', reader, words, 0.0),
        friction=_number(dynamics, 'friction', reader, words, 0.0),
    )


def _read_safety(
    element: etree._Element, name: str, reader: ElementReader
) -> SafetyController | None:
    safety = element.find('safety_controller')
    if safety is None:
        return None
    words = f'Could not parse safety element for joint [{name}]'
    return SafetyController(
        soft_lower_limit=_number(safety, 'soft_lower_limit', reader, words, -math.inf),
        soft_upper_limit=_number(safety, 'soft_upper_limit', reader, words, math.inf),
        k_position=_number(safety, 'k_position', reader, words, 0.0),
        k_velocity=_number(safety, 'k_velocity', reader, words),
    )


def _check_calibration(element: etree._Element, name: str, reader: ElementReader) -> None:
    """Report a malformed ``<calibration>``: it is not used, but urdfdom refuses the file."""
    calibration = element.find('calibration')
    if calibration is not None:
        words = f'Could not parse calibration element for joint  [{name}]'
        _number(calibration, 'rising', reader, words, 0.0)
        _number(calibration, 'falling', reader, words, 0.0)
