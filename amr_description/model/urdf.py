# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
URDF text -> :class:`~amr_description.model.robot.Robot`.

:func:`parse` stops at the first fault with a DescriptionError; :func:`read_robot` reports every
fault and goes on, for the checker. Links are read in ``urdf_links.py``, joints in
``urdf_joints.py``. :data:`TREE_RULES` then check that they form one tree: each takes a Robot,
sound or not, and yields findings in the order in which urdfdom would stop at them.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

from lxml import etree

from amr_description.model.findings import Finding, Report
from amr_description.model.origins import raise_error_of
from amr_description.model.robot import Joint, Material, Robot
from amr_description.model.urdf_joints import read_joints
from amr_description.model.urdf_links import read_links, read_material
from amr_description.model.xml_reader import decode, ElementReader, parse_xml, read_file
from amr_description.text import quote, quote_all


def load(path: str | Path) -> Robot:
    """Return the robot of a URDF file. Raises DescriptionError, as :func:`parse`."""
    return parse(read_file(path), str(path))


def parse(text: str | bytes, source: str = '<string>') -> Robot:
    """
    Return the robot that a URDF describes.

    Masses and the like are checked by :mod:`amr_description.model.checks`.

    Args:
        text: the URDF.
        source: names the file in messages.

    Raises:
        DescriptionError: (``source:line: …``) the first fault that makes it unusable as a tree of
            links, in XML, names, numbers, joints or roots.
    """
    if isinstance(text, bytes):
        text = decode(text, source)
    report = raise_error_of(text, strict=False)
    xml = parse_xml(text, source, report)
    assert xml is not None, 'raise_error does not return from an error'
    is_urdf(xml, source, report)
    return read_robot(xml, text, source, report)


def read_robot(xml: etree._Element, text: str, source: str, report: Report) -> Robot:
    """Return the robot as far as it can be read, sound or not; report every fault."""
    reader = ElementReader(source, report)
    name = _read_head(xml, reader)
    materials: dict[str, Material] = {}
    for element in xml.iterchildren('material'):
        material = read_material(element, reader)
        if material.name in materials:
            reader.error(
                element,
                f'material {quote(material.name)} is not unique',
                fix='give every material a name of its own',
                urdfdom=f"material '{material.name}' is not unique.",
            )
        materials.setdefault(material.name, material)
    links = read_links(xml, reader, materials)
    joints = read_joints(xml, reader)
    robot = Robot(name, links, joints, tuple(materials.values()), source, text)
    for rule in TREE_RULES:
        for finding in rule(robot):
            report(finding)
    return robot


def is_urdf(xml: etree._Element, source: str, report: Report) -> bool:
    """Return whether a text is of a robot; report if it is not: nothing in it is to be checked."""
    if xml.tag == 'robot':
        return True
    ElementReader(source, report).error(
        xml,
        'this is no URDF',
        found=f'the root element <{xml.tag}>',
        expected='<robot>',
        fix='give the URDF of the robot, with the plugins and sensors in <gazebo> tags'
        if xml.tag == 'sdf'
        else '',
        urdfdom="Could not find the 'robot' element in the xml file",
    )
    return False


def _read_head(xml: etree._Element, reader: ElementReader) -> str:
    """Return the name of the ``<robot>`` element; check name and version."""
    name = xml.get('name', '')
    if not name:
        reader.error(
            xml,
            '<robot> has no attribute "name"',
            fix='write <robot name="…">',
            # An empty name is one to urdfdom.
            urdfdom='' if 'name' in xml.attrib else 'No name given for the robot.',
        )
    version = xml.get('version', '1.0').strip()
    if version not in ('1', '1.0'):
        reader.error(
            xml,
            'version of <robot>',
            found=quote(version),
            expected='1.0',
            urdfdom="Invalid 'version' specified; only version 1.0 is currently supported",
        )
    return name


def ends_are_given(robot: Robot) -> Iterator[Finding]:
    """Every joint names a parent and a child link."""
    for joint in robot.joints:
        for end, link in (('child', joint.child), ('parent', joint.parent)):
            if not link:
                yield Finding.error(
                    robot.source,
                    joint.line,
                    f'joint {quote(joint.name)} has no {end} link',
                    fix=f'add <{end} link="…"/>',
                    urdfdom=(
                        f'Failed to build tree: Joint [{joint.name}] is missing a parent and/or '
                        'child link specification.'
                    ),
                )


def ends_are_known(robot: Robot) -> Iterator[Finding]:
    """Every joint joins two links that exist."""
    known = f'one of {quote_all([link.name for link in robot.links])}'
    for joint in robot.joints:
        for end, link in (('child', joint.child), ('parent', joint.parent)):
            if link and not robot.has_link(link):
                yield Finding.error(
                    robot.source,
                    joint.line,
                    f'joint {quote(joint.name)}: its {end} link is not defined',
                    found=quote(link),
                    expected=known,
                    fix=f'add <link name="{link}"> or correct the name',
                    urdfdom=_unknown_end_in_urdfdom(end, link, joint.name),
                )


def one_root(robot: Robot) -> Iterator[Finding]:
    """Exactly one link is not the child of a joint."""
    roots = [link.name for link in robot.roots]
    if robot.links and not roots:
        yield Finding.error(
            robot.source,
            robot.links[0].line,
            'the robot has no root: every link is the child of some joint',
            fix='remove the joint that closes the circle',
            urdfdom=(
                'Failed to find root link: No root link found. The robot xml is not a valid tree.'
            ),
        )
    if len(roots) > 1:
        first, second, *_ = sorted(roots)
        yield Finding.error(
            robot.source,
            robot.roots[1].line,
            f'the robot has {len(roots)} roots',
            found=quote_all(roots),
            expected="one link that is nobody's child",
            fix=f'join {quote(roots[1])} to the others by a joint',
            urdfdom=(f'Failed to find root link: Two root links found: [{first}] and [{second}]'),
        )


def one_parent(robot: Robot) -> Iterator[Finding]:
    """No link is the child of two joints."""
    first: dict[str, Joint] = {}
    for joint in robot.joints:
        if joint.child in first:
            yield Finding.error(
                robot.source,
                joint.line,
                f'link {quote(joint.child)} has two parents',
                found=f'joints {quote(first[joint.child].name)} and {quote(joint.name)}',
                expected='one joint per child',
                fix='remove one of the joints',
            )
        elif joint.child:
            first[joint.child] = joint


def no_cycle(robot: Robot) -> Iterator[Finding]:
    """Every link is below the root; one that has a parent and is not is part of a circle."""
    settled = {link.name for link in robot.roots} | {joint.child for _, joint in robot.walk()}
    for link in robot.links if robot.roots else ():
        circle = _circle_above(robot, link.name, settled)
        if circle:
            yield Finding.error(
                robot.source,
                link.line,
                'joints form a circle that hangs on nothing',
                found=quote_all(circle),
                fix='remove one of these joints, or let one start at a link of the tree',
            )


TREE_RULES: tuple[Callable[[Robot], Iterator[Finding]], ...] = (
    ends_are_given,
    ends_are_known,
    one_root,
    one_parent,
    no_cycle,
)


def _unknown_end_in_urdfdom(end: str, link: str, joint: str) -> str:
    if end == 'child':
        return f'Failed to build tree: child link [{link}] of joint [{joint}] not found'
    return (
        f'Failed to build tree: parent link [{link}] of joint [{joint}] not found.  This is not '
        'valid according to the URDF spec. Every link you refer to from a joint needs to be '
        'explicitly defined in the robot description. To fix this problem you can either remove '
        f'this joint [{joint}] from your urdf file, or add "<link name="{link}" />" to your urdf '
        'file.'
    )


def _circle_above(robot: Robot, link: str, settled: set[str]) -> list[str]:
    """
    Return the joints of the circle above ``link``; [] if there is none or it is known already.

    Adds the links that it visits to ``settled``, where later calls stop, so that all calls
    together take linear time.
    """
    passed: dict[str, str] = {}
    joint = robot.parent_joint(link)
    while joint is not None and link not in settled:
        settled.add(link)
        passed[link] = joint.name
        link = joint.parent
        joint = robot.parent_joint(link)
    names = list(passed.values())
    return names[list(passed).index(link) :] if link in passed else []
