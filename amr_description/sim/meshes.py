# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The mesh files of a URDF: found and judged before MuJoCo reads them, or read for it.

MuJoCo reads ``.msh``, ``.obj`` and binary ``.stl`` of up to 200,000 triangles. The other files
that :mod:`amr_description.model.meshes` reads (``.dae``, ``.gltf``, ``.glb``, STL as text or
larger) are put into the spec as triangles, without a file in between.
"""

from functools import lru_cache
from pathlib import Path
import struct

from lxml import etree
import mujoco
import numpy as np

from amr_description.ament_index import resolve_uri
from amr_description.control.contracts import Log, Severity
from amr_description.errors import MeshError, ResourceError, SpawnError
from amr_description.model.frames import Vector
from amr_description.model.meshes import FORMATS, load_mesh, TriangleMesh
from amr_description.sim.spawning import SpawnCode

type Meshes = dict[str, TriangleMesh]
"""Triangles by what stands in the spec for a file name."""

_ONLY_MUJOCO = '.msh'
_MOST_TRIANGLES, _FEWEST_VERTICES = 200_000, 4
_HEADER, _RECORD = 84, 50
_SEEN, _TOUCHED = '#seen', '#touched'


def resolve_meshes(urdf: etree._Element, source: str, log: Log) -> Meshes:
    """
    Write the true path of every mesh into ``urdf``.

    Physics needs the shapes of collisions: SpawnError if one cannot be had. A ``<visual>`` whose
    mesh cannot be had is left out, which the log is told.

    Returns:
        The meshes that MuJoCo does not read itself, scaled, by the name that is written instead;
        for :func:`insert_meshes`.
    """
    meshes: Meshes = {}
    for part in (*urdf.iterfind('link/collision'), *urdf.iterfind('link/visual')):
        mesh = part.find('geometry/mesh')
        if mesh is None:
            continue
        place = f'{source}:{mesh.sourceline}: mesh of a {part.tag} of link "{_link(part)}"'
        try:
            path = _mesh_file(mesh.get('filename', ''), source, place)
            if _is_for_mujoco(path):
                mesh.set('filename', str(path))
            else:
                _replace(mesh, path, place, meshes)
        except SpawnError as error:
            if part.tag == 'collision':
                raise
            log(Severity.WARN, f'{error}; it is not drawn')
            part.getparent().remove(part)
    return meshes


def insert_meshes(spec: mujoco.MjSpec, meshes: Meshes) -> None:
    """Put the triangles into the spec that MuJoCo made of the URDF of :func:`resolve_meshes`."""
    for mesh in spec.meshes:
        triangles = meshes.get(mesh.file)
        if triangles is None:
            continue
        if f'/{_SEEN},' in mesh.file:
            # It weighs nothing; a flat one, without a volume, is fine so.
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        mesh.file = ''
        vertices = triangles.vertices.astype(np.float32)
        lacking = max(0, _FEWEST_VERTICES - len(vertices))
        mesh.uservert = np.vstack((vertices, *vertices[:1].repeat(lacking, axis=0))).reshape(-1)
        mesh.userface = triangles.faces.astype(np.int32).reshape(-1)


def _link(part: etree._Element) -> str:
    return part.getparent().get('name', '')


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


def _is_for_mujoco(path: Path) -> bool:
    """Tell whether MuJoCo reads a file: of STL, by its length and the count in its header."""
    suffix = path.suffix.lower()
    if suffix != '.stl':
        return suffix in ('.obj', _ONLY_MUJOCO)
    try:
        with path.open('rb') as stream:
            header = stream.read(_HEADER)
        size = path.stat().st_size
    except OSError:  # said when it is read
        return False
    if len(header) < _HEADER:
        return False
    (count,) = struct.unpack_from('<I', header, _HEADER - 4)
    return 0 < count <= _MOST_TRIANGLES and size == _HEADER + _RECORD * count


def _replace(mesh: etree._Element, path: Path, place: str, meshes: Meshes) -> None:
    """Let ``<mesh>`` name triangles instead of a file; their scale is theirs. SpawnError."""
    x, y, z = (float(word) for word in mesh.attrib.pop('scale', '1 1 1').split())
    try:
        status = path.stat()
        triangles = _load(path, (x, y, z), (status.st_mtime_ns, status.st_size))
    except (MeshError, OSError) as cause:
        raise SpawnError(f'{place}: {cause}', SpawnCode.UNSUPPORTED_ASSETS) from cause
    kind = _SEEN if mesh.getparent().getparent().tag == 'visual' else _TOUCHED
    # MuJoCo names the mesh after the file, without folder and type.
    name = f'{path.parent}/{kind},{x!r},{y!r},{z!r}/{path.name}'
    meshes[name] = triangles
    mesh.set('filename', name)


@lru_cache(maxsize=32)  # the robots of a fleet have the same
def _load(path: Path, scale: Vector, version: tuple[int, int]) -> TriangleMesh:
    """Read a mesh file; ``version`` changes with it."""
    return load_mesh(path, scale)
