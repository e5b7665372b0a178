# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``<link>`` and ``<material>`` elements of URDF -> :class:`~amr_description.model.robot.Link`."""

import math

from lxml import etree

from amr_description.model.findings import NO_SHAPE
from amr_description.model.frames import Transform
from amr_description.model.robot import (
    Box,
    Collision,
    Cylinder,
    Geometry,
    Inertia,
    Inertial,
    Link,
    Material,
    Mesh,
    Sphere,
    Visual,
)
from amr_description.model.xml_reader import ElementReader, line_of
from amr_description.text import quote

_ZERO = (0.0, 0.0, 0.0)
_GEOMETRIES = ('box', 'cylinder', 'sphere', 'mesh')


def read_links(
    xml: etree._Element, reader: ElementReader, materials: dict[str, Material]
) -> tuple[Link, ...]:
    """Return every ``<link>`` below ``xml``; ``materials`` are the global ones, by name."""
    links: dict[str, Link] = {}
    for element in xml.iterchildren('link'):
        link = _read_link(element, reader, materials)
        if link.name in links:
            reader.error(
                element,
                f'link {quote(link.name)} is not unique',
                found=f'the first on line {links[link.name].line}',
                fix='give every link a name of its own',
                urdfdom=f"link '{link.name}' is not unique.",
            )
        links.setdefault(link.name, link)
    if not links:
        reader.error(
            xml,
            'the robot has no <link>',
            fix='add at least <link name="base_link"/>',
            urdfdom='No link elements found in urdf file',
        )
    return tuple(links.values())


def _read_link(
    element: etree._Element, reader: ElementReader, materials: dict[str, Material]
) -> Link:
    name = element.get('name', '')
    reader = reader.of(f'link {quote(name)}')
    if not name:
        reader.error(element, '<link> has no attribute "name"')
    inertial = element.find('inertial')
    return Link(
        name=name,
        inertial=None if inertial is None else _read_inertial(inertial, reader),
        visuals=tuple(
            Visual(
                geometry=geometry,
                origin=read_origin(visual, reader),
                material=_read_visual_material(visual, reader, materials),
                name=visual.get('name', ''),
                line=line_of(visual),
            )
            for visual in element.iterchildren('visual')
            if (geometry := _read_geometry(visual, reader)) is not None
        ),
        collisions=tuple(
            Collision(
                geometry=geometry,
                origin=read_origin(collision, reader),
                name=collision.get('name', ''),
                line=line_of(collision),
            )
            for collision in element.iterchildren('collision')
            if (geometry := _read_geometry(collision, reader)) is not None
        ),
        line=line_of(element),
    )


def read_origin(element: etree._Element, reader: ElementReader) -> Transform:
    """Return the ``<origin>`` of an element, the identity when there is none."""
    origin = element.find('origin')
    if origin is None:
        return Transform()
    xyz = reader.vector(origin, 'xyz', _ZERO)
    rpy = reader.vector(origin, 'rpy', _ZERO)
    return Transform.from_xyz_rpy(xyz, rpy)


def _rgba(reader: ElementReader, color: etree._Element) -> tuple[float, float, float, float]:
    red, green, blue, alpha = reader.numbers(color, 'rgba', 4)
    return red, green, blue, alpha


def _read_inertial(element: etree._Element, reader: ElementReader) -> Inertial:
    """Return mass and inertia; NaN stands for what is not given."""
    mass, inertia = element.find('mass'), element.find('inertia')
    if mass is None:
        reader.warning(
            element,
            '<inertial> has no <mass>',
            taken='it has none',
            fix='add <mass value="…"/> in kg',
        )
    if inertia is None:
        reader.warning(
            element,
            '<inertial> has no <inertia>',
            taken='it has those of a small ball',
            fix='add <inertia ixx="…" ixy="0" ixz="0" iyy="…" iyz="0" izz="…"/> in kg·m²',
        )
    moments = (
        math.nan if inertia is None else _read_moment(inertia, key, reader)
        for key in ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')
    )
    return Inertial(
        mass=math.nan if mass is None else reader.number(mass, 'value'),
        inertia=Inertia(*moments),
        origin=read_origin(element, reader),
        line=line_of(element),
    )


def _read_moment(inertia: etree._Element, key: str, reader: ElementReader) -> float:
    """Return a moment; one beside the diagonal that is not given is 0, another NaN."""
    if inertia.get(key) is not None:
        return reader.number(inertia, key)
    is_beside = key[1] != key[2]
    reader.warning(
        inertia,
        f'<inertia> has no attribute "{key}"',
        expected='a number',
        taken='it is 0' if is_beside else 'they are those of a small ball',
    )
    return 0.0 if is_beside else math.nan


def _read_geometry(element: etree._Element, reader: ElementReader) -> Geometry | None:
    geometry = element.find('geometry')
    shape = None if geometry is None else next(geometry.iterchildren(etree.Element), None)
    expected = ', '.join(f'<{name}>' for name in _GEOMETRIES)
    if shape is None:
        reader.warning(
            element,
            f'<{element.tag}> has no shape',
            expected=f'<geometry> with one of {expected}',
            taken=NO_SHAPE,
        )
        return None
    match shape.tag:
        case 'box':
            return Box(reader.vector(shape, 'size'))
        case 'cylinder':
            return Cylinder(reader.number(shape, 'radius'), reader.number(shape, 'length'))
        case 'sphere':
            return Sphere(reader.number(shape, 'radius'))
        case 'mesh':
            scale = reader.vector(shape, 'scale', (1.0, 1.0, 1.0))
            return Mesh(reader.required(shape, 'filename'), scale)
    reader.warning(
        shape, 'unknown geometry', found=f'<{shape.tag}>', expected=expected, taken=NO_SHAPE
    )
    return None


def read_material(element: etree._Element, reader: ElementReader) -> Material:
    """Return a ``<material>`` element, with what it defines itself; its name may be empty."""
    name = element.get('name')
    if name is None:
        reader.error(element, '<material> has no attribute "name"')
    color, texture = element.find('color'), element.find('texture')
    if texture is not None and not texture.get('filename', '').strip():
        reader.warning(texture, '<texture> has no attribute "filename"', taken='it is left out')
        texture = None
    return Material(
        name=name or '',
        color=None if color is None else _rgba(reader, color),
        texture=None if texture is None else texture.get('filename', '').strip(),
    )


def _read_visual_material(
    visual: etree._Element, reader: ElementReader, materials: dict[str, Material]
) -> Material | None:
    """
    Return a visual's look: its own, else the global one of that name (a new one becomes global, as
    urdfdom).
    """
    element = visual.find('material')
    if element is None:
        return None
    material = read_material(element, reader)
    if material.color is not None or material.texture is not None:
        materials.setdefault(material.name, material)
        return material
    if material.name not in materials:
        reader.warning(
            element,
            f'material {quote(material.name)} is not defined',
            fix='add <color rgba="…"/> here or a <material> with a color below <robot>',
        )
    return materials.get(material.name, material)
