# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf --inertia``: the ``<inertial>`` of a link, from the shapes that it has."""

from amr_description.errors import DescriptionError, MeshError, UsageError
from amr_description.model.mesh_solids import (
    joined,
    MassProperties,
    solid_mesh,
    solid_primitive,
    SolidBody,
)
from amr_description.model.mesh_uses import FindFile
from amr_description.model.meshes import load_mesh
from amr_description.model.origins import place_in
from amr_description.model.robot import Collision, Link, Mesh, Robot, Visual
from amr_description.model.shapes import sizes, Solid
from amr_description.text import quote, quote_all

# Digits of the numbers: more than any CAD file knows, few enough to be read.
_DIGITS = 6


def inertial_element(
    robot: Robot, link: str, mass: float | None, density: float | None, find_file: FindFile
) -> str:
    """
    Return the ``<inertial>`` element of a link as text.

    The link is taken as homogeneous, filled by its collision shapes; by its visual ones when it
    has no others. Shapes that overlap count twice.

    Args:
        robot: The robot.
        link: The name of the link.
        mass: kg; None: ``density``, or what the link weighs in the description.
        density: kg/m³, or None.
        find_file: Finds the files of meshes.

    Raises:
        DescriptionError: There is no such link, it has no shape, or one that has no volume.
        UsageError: Nothing says what it weighs.
    """
    part = _link(robot, link)
    bodies = [_body(each, part, find_file) for each in (part.collisions or part.visuals)]
    if not bodies:
        raise DescriptionError(
            f'{place_in(robot.text, robot.source, part.line)}: link {quote(link)} has neither '
            '<collision> nor <visual>, so no shape to weigh'
        )
    if mass is None and density is None:
        if part.inertial is None:
            raise UsageError(
                f'link {quote(link)} has no <inertial> that says its mass; add --mass KG or '
                '--density KG/M3 (steel 7850, aluminium 2700, PLA 1240)'
            )
        mass = part.inertial.mass
    if mass is not None:
        density = mass / sum(body.volume for body in bodies)
    assert density is not None, 'one of the two was given or found'
    return element(joined(bodies, density))


def element(found: MassProperties) -> str:
    """Return mass properties as an ``<inertial>`` element."""
    inertia = found.inertia
    moments = ' '.join(
        f'{name}="{_number(getattr(inertia, name), inertia.ixx + inertia.iyy + inertia.izz)}"'
        for name in ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')
    )
    reach = (inertia.ixx / found.mass) ** 0.5
    xyz = ' '.join(_number(each, reach) for each in found.center)
    return (
        '<inertial>\n'
        f'  <origin xyz="{xyz}" rpy="0 0 0"/>\n'
        f'  <mass value="{found.mass:.{_DIGITS}g}"/>\n'
        f'  <inertia {moments}/>\n'
        '</inertial>'
    )


def _number(value: float, whole: float) -> str:
    """Return a number as text; 0 for what is rounding beside ``whole``."""
    return f'{0.0 if abs(value) < 1e-9 * whole else value:.{_DIGITS}g}'


def _link(robot: Robot, name: str) -> Link:
    for link in robot.links:
        if link.name == name:
            return link
    known = quote_all([link.name for link in robot.links])
    raise DescriptionError(f'{robot.source}: there is no link {quote(name)}; there are: {known}')


def _body(part: Visual | Collision, link: Link, find_file: FindFile) -> SolidBody:
    kind = 'collision' if isinstance(part, Collision) else 'visual'
    shape, name = part.geometry, f'the {kind} of link {quote(link.name)}, line {part.line}'
    if isinstance(shape, Mesh):
        mesh = load_mesh(find_file(shape.filename), shape.scale)
        return solid_mesh(mesh, part.origin, f'{name} ({shape.filename})')
    if min(sizes(shape)) <= 0.0:
        raise MeshError(f'{name}: it has no volume')
    return solid_primitive(Solid(shape, part.origin))
