# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The visible static geometry of a world, as shapes to draw."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

import mujoco
import numpy as np

from amr_description.model.frames import Quaternion, Vector, xyzw_from_wxyz

_Type = mujoco.mjtGeom
Color: TypeAlias = tuple[float, float, float, float]


class ShapeKind(StrEnum):
    """Kinds of shapes; each is centred on its pose and extends along its axes by ``size``."""

    BOX = 'box'
    SPHERE = 'sphere'
    CYLINDER = 'cylinder'
    CAPSULE = 'capsule'
    PLANE = 'plane'
    TRIANGLES = 'triangles'


@dataclass(frozen=True, slots=True)
class VisibleShape:
    """
    One geom, in the frame ``world``.

    ``size``: full extents along x, y, z, m; 0 along an infinite side of a plane. ``color``: red,
    green, blue, alpha in 0..1. ``points``: the corners of triangles, three each, in the shape's
    own axes, counter-clockwise as seen from outside.
    """

    name: str
    kind: ShapeKind
    size: Vector
    position: Vector
    rotation: Quaternion
    color: Color
    points: tuple[Vector, ...] = ()


def visible_shapes(spec: mujoco.MjSpec) -> tuple[VisibleShape, ...]:
    """
    Return the visible static geoms of a world without robots.

    ``spec`` itself stays as it is: a copy of it is compiled. A geom without a name gets one of its
    kind and number.
    """
    model = spec.copy().compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    static = [
        geom for geom in range(model.ngeom) if model.body_weldid[model.geom_bodyid[geom]] == 0
    ]
    shapes = (_shape(model, data, geom) for geom in static if _color(model, geom)[3] > 0.0)
    return tuple(shape for shape in shapes if shape is not None)


def _shape(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> VisibleShape | None:
    """Return a geom as a shape; None for one that is not drawn, such as a line."""
    a, b, c = (float(each) for each in model.geom_size[geom])
    points: tuple[Vector, ...] = ()
    match _Type(model.geom_type[geom]):
        case _Type.mjGEOM_PLANE:
            kind, size = ShapeKind.PLANE, (2 * a, 2 * b, 0.0)
        case _Type.mjGEOM_BOX:
            kind, size = ShapeKind.BOX, (2 * a, 2 * b, 2 * c)
        case _Type.mjGEOM_SPHERE:
            kind, size = ShapeKind.SPHERE, (2 * a, 2 * a, 2 * a)
        case _Type.mjGEOM_ELLIPSOID:
            kind, size = ShapeKind.SPHERE, (2 * a, 2 * b, 2 * c)
        case _Type.mjGEOM_CYLINDER:
            kind, size = ShapeKind.CYLINDER, (2 * a, 2 * a, 2 * b)
        case _Type.mjGEOM_CAPSULE:
            kind, size = ShapeKind.CAPSULE, (2 * a, 2 * a, 2 * (a + b))
        case _Type.mjGEOM_MESH:
            points = tuple(_mesh(model, int(model.geom_dataid[geom])))
            kind, size = ShapeKind.TRIANGLES, _extent(points)
        case _Type.mjGEOM_HFIELD:
            points = tuple(_height_field(model, int(model.geom_dataid[geom])))
            kind, size = ShapeKind.TRIANGLES, _extent(points)
        case _:
            return None
    rotation = np.empty(4)
    mujoco.mju_mat2Quat(rotation, data.geom_xmat[geom])
    return VisibleShape(
        name=model.geom(geom).name or f'{kind}_{geom}',
        kind=kind,
        size=size,
        position=_vector(data.geom_xpos[geom]),
        rotation=xyzw_from_wxyz(rotation.tolist()),
        color=_color(model, geom),
        points=points,
    )


def _color(model: mujoco.MjModel, geom: int) -> Color:
    """Return the color of the material, or else of the geom; textures are ignored."""
    material = int(model.geom_matid[geom])
    color = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
    r, g, b, a = (float(each) for each in color)
    return (r, g, b, a)


def _mesh(model: mujoco.MjModel, mesh: int) -> Iterator[Vector]:
    first = model.mesh_vertadr[mesh]
    vertices = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
    start = model.mesh_faceadr[mesh]
    for corner in model.mesh_face[start : start + model.mesh_facenum[mesh]].ravel():
        yield _vector(vertices[corner])


def _height_field(model: mujoco.MjModel, field: int) -> Iterator[Vector]:
    """Yield two triangles for each cell of the grid; columns along x, rows along y."""
    rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
    radius_x, radius_y, height, _ = (float(each) for each in model.hfield_size[field])
    start = model.hfield_adr[field]
    heights = model.hfield_data[start : start + rows * columns].reshape(rows, columns) * height
    x = np.linspace(-radius_x, radius_x, columns)
    y = np.linspace(-radius_y, radius_y, rows)

    def point(row: int, column: int) -> Vector:
        return (float(x[column]), float(y[row]), float(heights[row, column]))

    for row in range(rows - 1):
        for column in range(columns - 1):
            a, b = point(row, column), point(row, column + 1)
            c, d = point(row + 1, column + 1), point(row + 1, column)
            yield from (a, b, c, a, c, d)


def _extent(points: tuple[Vector, ...]) -> Vector:
    return _vector(np.ptp(np.array(points), axis=0)) if points else (0.0, 0.0, 0.0)


def _vector(values: np.ndarray) -> Vector:
    x, y, z = (float(each) for each in values)
    return (x, y, z)
