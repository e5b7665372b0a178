# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
URDF text -> :class:`~amr_description.model.robot.Robot`.

Two ways in: :func:`parse` stops at the first fault with a DescriptionError, :func:`read_robot`
reports every fault and goes on, for the checker. Links are read in ``urdf_links.py``, joints in
``urdf_joints.py``, and ``tree.py`` sees that they make one tree.
"""

from pathlib import Path

from lxml import etree

from amr_description.model.element_reader import ElementReader
from amr_description.model.findings import quote, raise_error, Report
from amr_description.model.robot import Material, Robot
from amr_description.model.tree import TREE_RULES
from amr_description.model.urdf_joints import read_joints
from amr_description.model.urdf_links import read_links, read_material
from amr_description.model.xml_source import decode, parse_xml, read_file


def load(path: str | Path) -> Robot:
    """Return the robot of a URDF file; DescriptionError when it cannot be read or is not sound."""
    return parse(read_file(path), str(path))


def parse(text: str | bytes, source: str = '<string>') -> Robot:
    """
    Return the robot that URDF describes; ``source`` names the file in messages.

    DescriptionError (``source:line: …``) at the first fault that makes it unusable as a tree of
    links: XML, names, numbers, joints, roots. Masses and the like are judged by
    :mod:`amr_description.model.checks`.
    """
    if isinstance(text, bytes):
        text = decode(text, source)
    xml = parse_xml(text, source, raise_error)
    assert xml is not None, 'raise_error does not return from an error'
    return read_robot(xml, text, source, raise_error)


def read_robot(xml: etree._Element, text: str, source: str, report: Report) -> Robot:
    """Return what can be read below ``xml``, sound or not, and report every fault."""
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


def _read_head(xml: etree._Element, reader: ElementReader) -> str:
    """Return the name of the ``<robot>`` element after judging tag, name and version."""
    if xml.tag != 'robot':
        reader.error(
            xml,
            'this is no URDF',
            found=f'the root element <{xml.tag}>',
            expected='<robot>',
            urdfdom="Could not find the 'robot' element in the xml file",
        )
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
