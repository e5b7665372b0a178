# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The URDF of a robot as MuJoCo's own reader needs it.

With its defaults that reader welds the robot to the world, fuses links without a joint into it
(most of the mass is lost then), gives a link without ``<inertial>`` the mass of water in its
collision shapes, and looks for meshes by their bare names. Its settings are therefore written into
the XML before it reads it, and with them what a robot is taken as that is not quite sound.
"""

from lxml import etree

from amr_description.log import Log
from amr_description.model.checks.markup import ROBOT
from amr_description.model.findings import raise_error
from amr_description.model.mended_inertials import mended_inertials
from amr_description.model.robot import Inertial, Joint, Robot
from amr_description.model.xml_reader import parse_xml, plain_numbers
from amr_description.sim.meshes import Meshes, resolve_meshes

MIN_RANGE = 2e-6
"""rad or m; the range of a joint whose limits are equal."""

COLLISION = '/collision:'
"""
Stands in the name of a collision between those of its link and its number, until its geom is known
(:func:`~amr_description.sim.robot_spec.build_robot`).
"""

_COMPILER = {
    'fusestatic': 'false',
    'discardvisual': 'false',
    'strippath': 'false',
    'inertiafromgeom': 'false',
}
_VECTORS = {'xyz': 3, 'rpy': 3, 'scale': 3, 'size': 3, 'rgba': 4}
_MOMENTS = ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')


def prepared_xml(robot: Robot, log: Log, *, strict: bool) -> tuple[str, Meshes]:
    """
    Return the URDF with MuJoCo's compiler settings and resolved mesh paths, and the meshes that
    MuJoCo does not read itself. Collisions are named by link and number.

    Args:
        robot: A robot that the checker has found sound.
        log: Gets what is left out, or taken as something else.
        strict: Refuse a collision whose mesh cannot be had.

    Raises:
        SpawnError: As ``strict`` says.
    """
    root = parse_xml(robot.text, robot.source, raise_error)
    assert root is not None, 'raise_error does not return from an error'
    compiler = _child(_child(root, 'mujoco'), 'compiler')
    for key, value in _COMPILER.items():
        compiler.set(key, value)
    for shape in (*root.iterfind('link/visual'), *root.iterfind('link/collision')):
        # MuJoCo names its geoms by it, and rejects a name that a visual and a collision share.
        shape.attrib.pop('name', None)
    for link in root.iterfind('link'):
        for number, collision in enumerate(link.iterchildren('collision')):
            collision.set('name', f'{link.get("name")}{COLLISION}{number}')
    _drop_repeated(root)
    for shape in (*root.iterfind('link/visual'), *root.iterfind('link/collision')):
        # The first counts, as in urdfdom; the checker has named the others.
        for geometry in shape.iterfind('geometry'):
            for other in tuple(geometry.iterchildren(etree.Element))[1:]:
                geometry.remove(other)
    _set_inertials(root, robot)
    for limit in root.iterfind('joint/limit'):
        # MuJoCo takes the amount of a negative one, which elsewhere means that there is none.
        if float(limit.get('effort', '0')) < 0.0:
            limit.set('effort', '0')
    _write_as_taken(root, robot)
    meshes = resolve_meshes(root, robot.source, log, strict=strict)
    return etree.tostring(root, encoding='unicode'), meshes


def _drop_repeated(root: etree._Element) -> None:
    """Remove what the checker says is ignored: a second element of which there is one."""
    stack = [(root, ROBOT)]
    while stack:
        element, grammar = stack.pop()
        seen: set[str] = set()
        for child in tuple(element.iterchildren(etree.Element)):
            known = grammar.children.get(child.tag)
            if child.tag in seen and child.tag in grammar.single:
                element.remove(child)
            elif known is not None and not known.open:
                stack.append((child, known))
            seen.add(child.tag)


def _child(parent: etree._Element, tag: str) -> etree._Element:
    found = parent.find(tag)
    return etree.SubElement(parent, tag) if found is None else found


def _set_inertials(root: etree._Element, robot: Robot) -> None:
    """Write what the simulator takes for an ``<inertial>`` that no solver does."""
    mended = mended_inertials(robot)
    for link in root.iterfind('link'):
        name = link.get('name', '')
        if name not in mended:
            continue
        old = link.find('inertial')
        origin = None if old is None else old.find('origin')
        for inertial in link.findall('inertial'):
            link.remove(inertial)
        new = mended[name].inertial
        if new is not None:
            link.append(_inertial_element(new, origin))


def _inertial_element(inertial: Inertial, origin: etree._Element | None) -> etree._Element:
    element = etree.Element('inertial')
    if origin is not None:
        element.append(origin)
    etree.SubElement(element, 'mass', value=repr(inertial.mass))
    moments = {key: repr(getattr(inertial.inertia, key)) for key in _MOMENTS}
    etree.SubElement(element, 'inertia', moments)
    return element


def _write_as_taken(root: etree._Element, robot: Robot) -> None:
    """Write limits, mimics and vectors as the reader has taken them, not as the file has them."""
    elements = {element.get('name'): element for element in root.iterfind('joint')}
    for joint in robot.joints:
        element = elements[joint.name]
        limit = element.find('limit')
        for mimic in element.findall('mimic') if joint.mimic is None else ():
            element.remove(mimic)
        if joint.limit is None or limit is None:
            continue
        if joint.limit.lower == joint.limit.upper:
            _keep_limit(root, joint)
        elif _swapped(limit):
            limit.set('lower', repr(joint.limit.lower))
            limit.set('upper', repr(joint.limit.upper))
    for element in root.iter('origin', 'axis', 'mesh', 'box', 'color'):
        for key, count in _VECTORS.items():
            if key in element.attrib:
                element.set(key, plain_numbers(element.get(key, ''), count))


def _swapped(limit: etree._Element) -> bool:
    return float(limit.get('lower', '0')) > float(limit.get('upper', '0'))


def _keep_limit(root: etree._Element, joint: Joint) -> None:
    """Widen a range of 0, which MuJoCo ignores: the joint would move freely."""
    assert joint.limit is not None
    for element in root.iterfind('joint'):
        if element.get('name') == joint.name:
            limit = element.find('limit')
            limit.set('lower', repr(joint.limit.lower - MIN_RANGE / 2.0))
            limit.set('upper', repr(joint.limit.upper + MIN_RANGE / 2.0))
