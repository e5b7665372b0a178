# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The mesh files of a URDF: found, read, and put into the spec as triangles.

All files that :mod:`amr_description.model.meshes` reads go this way, so that a shape is the same
whatever its format; only ``.msh`` is left to MuJoCo. A mesh that cannot be had is left out of the
visuals; a collision takes the shape of its link's visual instead, or is left out too. A collision
mesh without thickness gets :data:`THICKNESS`, as its convex hull must have a volume.
"""

from copy import deepcopy
from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

from lxml import etree
import mujoco
import numpy as np

from amr_description.ament_index import resolve_uri
from amr_description.errors import MeshError, ResourceError, SpawnError
from amr_description.log import Log, Severity
from amr_description.model.frames import Vector
from amr_description.model.meshes import FORMATS, load_mesh, TriangleMesh
from amr_description.sim.spawning import SpawnCode

Meshes: TypeAlias = dict[str, TriangleMesh]
"""Triangles by what stands in the spec for a file name."""

THICKNESS = 0.001
"""m, of a collision mesh whose corners are in one plane, on one line or at one point."""

_FLAT = 1e-6
"""m, and the share of the length: a mesh that is thinner has no thickness."""
_SMALLEST_AREA = 1e-12
"""m²; MuJoCo refuses a mesh without any."""
_ONLY_MUJOCO = '.msh'
_FEWEST_VERTICES = 4
_SEEN, _TOUCHED = '#seen', '#touched'
_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
_SIDES = np.array(
    [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
     (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
)  # fmt: skip
"""A box, its outside outside."""
_SIZES = {'box': ('size',), 'cylinder': ('radius', 'length'), 'sphere': ('radius',)}


def resolve_meshes(urdf: etree._Element, source: str, log: Log, *, strict: bool = False) -> Meshes:
    """
    Read every mesh of ``urdf``, and write into it the name of what was read.

    Args:
        urdf: The ``<robot>`` element; edited. Shapes without a volume are left out.
        source: Its file, beside which relative paths are looked for; begins messages.
        log: Gets what is left out or replaced.
        strict: Refuse a mesh of a collision that cannot be had.

    Returns:
        The meshes, scaled, by the name that is written instead; for :func:`insert_meshes`.

    Raises:
        SpawnError: As ``strict`` says.
    """
    meshes: Meshes = {}
    for part in (*urdf.iterfind('link/collision'), *urdf.iterfind('link/visual')):
        if _is_without_size(part):
            part.getparent().remove(part)
    for part in urdf.findall('link/collision'):
        try:
            _resolve(part, source, meshes)
        except SpawnError as error:
            if strict:
                raise
            log(Severity.WARN, f'{error}; {_replace_collision(part, source, meshes)}')
    unseen: list[SpawnError] = []
    for part in urdf.findall('link/visual'):
        try:
            _resolve(part, source, meshes)
        except SpawnError as error:
            unseen.append(error)
            part.getparent().remove(part)
    if unseen:
        others = f', nor are {len(unseen) - 1} others' if len(unseen) > 1 else ''
        log(Severity.WARN, f'{unseen[0]}; it is not drawn in the simulation{others}')
    return meshes


def insert_meshes(spec: mujoco.MjSpec, meshes: Meshes) -> None:
    """Put the triangles into the spec that MuJoCo made of the URDF of :func:`resolve_meshes`."""
    for mesh in spec.meshes:
        triangles = meshes.get(mesh.file)
        if triangles is None:
            continue
        triangles = _with_shared_corners(triangles)
        if f'/{_TOUCHED},' in mesh.file:
            triangles = thickened(triangles)
        # It weighs nothing, and needs no volume so.
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        mesh.file = ''
        vertices = triangles.vertices.astype(np.float32)
        lacking = max(0, _FEWEST_VERTICES - len(vertices))
        mesh.uservert = np.vstack((vertices, *vertices[:1].repeat(lacking, axis=0))).reshape(-1)
        mesh.userface = triangles.faces.astype(np.int32).reshape(-1)


def thickened(mesh: TriangleMesh) -> TriangleMesh:
    """
    Return a mesh whose convex hull has a volume, itself if it has one.

    A flat one is doubled, :data:`THICKNESS` apart; for one that is a line or a point there is the
    box about it.
    """
    used = mesh.vertices[np.unique(mesh.faces)]
    middle = used.mean(axis=0)
    _, columns = np.linalg.eigh((used - middle).T @ (used - middle))
    axes = columns.T
    along = (used - middle) @ axes.T
    extents = np.ptp(along, axis=0)
    is_thin = extents < max(_FLAT, _FLAT * float(extents.max()))
    if not is_thin.any():
        return mesh
    half = axes[is_thin] * (THICKNESS / 2.0)
    if len(half) == 1:
        faces = np.vstack((mesh.faces, mesh.faces + len(mesh.vertices)))
        return TriangleMesh(np.vstack((mesh.vertices - half, mesh.vertices + half)), faces)
    low, high = along.min(axis=0), along.max(axis=0)
    low, high = low - is_thin * THICKNESS / 2.0, high + is_thin * THICKNESS / 2.0
    return TriangleMesh((low + _CORNERS * (high - low)) @ axes + middle, _SIDES)


def _with_shared_corners(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh whose triangles share corners; STL gives each its own."""
    if len(mesh.vertices) < 3 * len(mesh.faces):
        return mesh
    rows = np.ascontiguousarray(mesh.vertices, dtype=np.float32)
    # As np.unique does with whole rows, six times faster: column by column.
    order = np.lexsort(rows.T[::-1])
    ordered = rows[order]
    is_new = np.ones(len(rows), dtype=bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    corner = np.empty_like(order)
    corner[order] = np.cumsum(is_new) - 1
    return TriangleMesh(mesh.vertices[order[is_new]], corner[mesh.faces])


def _is_without_size(part: etree._Element) -> bool:
    """Whether a part has no shape that is known and has a volume, which the checker has said."""
    shape = next(part.iterfind('geometry/*'), None)
    if shape is None or shape.tag not in ('mesh', *_SIZES):
        return True
    if shape.tag == 'mesh':
        return 0.0 in _scale(shape)
    words = ' '.join(shape.get(name, '') for name in _SIZES[shape.tag]).split()
    return any(float(word) == 0.0 for word in words)


def _replace_collision(part: etree._Element, source: str, meshes: Meshes) -> str:
    """Give a collision the shape of a visual of its link, or leave it out; return which."""
    link = part.getparent()
    for visual in link.iterfind('visual'):
        other = deepcopy(visual)
        other.tag = 'collision'
        other.tail = None
        if name := part.get('name'):
            other.set('name', name)
        part.addnext(other)
        try:
            _resolve(other, source, meshes)
        except SpawnError:
            link.remove(other)
            continue
        link.remove(part)
        return 'the shape of its visual is taken'
    link.remove(part)
    return 'it is left out'


def _resolve(part: etree._Element, source: str, meshes: Meshes) -> None:
    """Let the ``<mesh>`` of a part, if it has one, name triangles, not a file. SpawnError."""
    mesh = part.find('geometry/mesh')
    if mesh is None:
        return
    link = part.getparent().get('name', '')
    place = f'{source}:{mesh.sourceline}: mesh of a {part.tag} of link "{link}"'
    path = _mesh_file(mesh.get('filename', ''), source, place)
    if path.suffix.lower() == _ONLY_MUJOCO:
        mesh.set('filename', str(path))
        return
    scale = _scale(mesh)
    try:
        status = path.stat()
        triangles = _load(path, scale, (status.st_mtime_ns, status.st_size))
        if part.tag == 'visual' and _area(triangles) < _SMALLEST_AREA:
            raise MeshError(f'{path}: its triangles have no area')
    except (MeshError, OSError) as cause:
        raise SpawnError(f'{place}: {cause}', SpawnCode.UNSUPPORTED_ASSETS) from cause
    mesh.attrib.pop('scale', None)
    kind = _SEEN if part.tag == 'visual' else _TOUCHED
    x, y, z = scale
    # MuJoCo names the mesh after the file, without folder and type.
    name = f'{path.parent}/{kind},{x!r},{y!r},{z!r}/{path.name}'
    meshes[name] = triangles
    mesh.set('filename', name)


def _scale(mesh: etree._Element) -> Vector:
    x, y, z = (float(word) for word in mesh.get('scale', '1 1 1').split())
    return (x, y, z)


def _area(mesh: TriangleMesh) -> float:
    corners = mesh.vertices[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(normals, axis=1).sum()) / 2.0


def _mesh_file(uri: str, source: str, place: str) -> Path:
    description = Path(source)
    try:
        path = resolve_uri(uri, description.parent if description.is_file() else None)
    except ResourceError as cause:
        raise SpawnError(f'{place}: {uri}: {cause}', SpawnCode.MISSING_ASSETS) from cause
    if not path.is_file():
        found = '' if str(path) == uri else f', which is {path}'
        raise SpawnError(f'{place}: there is no file {uri}{found}', SpawnCode.MISSING_ASSETS)
    if path.suffix.lower() not in (*FORMATS, _ONLY_MUJOCO):
        raise SpawnError(
            f'{place}: {uri}: the simulator reads {", ".join((*FORMATS, _ONLY_MUJOCO))}, not '
            f'{path.suffix}',
            SpawnCode.UNSUPPORTED_ASSETS,
        )
    return path.resolve()


@lru_cache(maxsize=32)  # the robots of a fleet have the same
def _load(path: Path, scale: Vector, version: tuple[int, int]) -> TriangleMesh:
    """Read a mesh file; ``version`` changes with it."""
    return load_mesh(path, scale)
