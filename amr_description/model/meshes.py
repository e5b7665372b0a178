# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Mesh files as triangles: ``.stl``, ``.obj``, ``.dae``, ``.gltf`` and ``.glb``.

trimesh, which yourdfpy brings, and pycollada read the files, and they are imported only when there
is one: half a second. What they leave to their caller is done here:

- Unit: COLLADA's ``<unit meter="…"/>`` is applied. The other formats have none; their numbers are
  metres, as URDF has it.
- Up axis: the vertices of a COLLADA file are taken as they are, whatever its ``<up_axis>`` says.
  RViz has Assimp ignore it (``AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION`` in rviz_rendering's
  ``assimp_loader.cpp``), Gazebo drops the rotation that it stands for
  (``UpdatedRootNodeTransform`` in gz-common's ``AssimpLoader.cc``), and MoveIt does likewise
  (geometric_shapes, pull request 52). So every robot that looks right there needs it so; some
  say ``Y_UP`` and mean Z. ``check_urdf`` names the files where this matters. glTF has Y up by its
  specification, without a choice: it is turned by 90° about X, (x, y, z) to (x, -z, y), as RViz
  does (ros2/rviz, pull request 1482).
- Scene: the transforms of all nodes are applied. Lights, cameras, materials are left out, and so
  are files that a file names, but for the buffers of a ``.gltf`` beside it.
- Scale: URDF's, along the axes of the mesh, last. A mesh that is mirrored by it keeps its outside
  outside: the corners of its triangles go round the other way.
"""

from collections.abc import Callable
from dataclasses import dataclass
import io
import json
from pathlib import Path
import re
from stat import S_ISREG
import struct
from typing import Any, TypeAlias
import warnings

import numpy as np
from numpy.typing import NDArray

from amr_description.errors import MeshError
from amr_description.model.collada import prepare
from amr_description.model.frames import Vector
from amr_description.text import one_line

FORMATS = ('.stl', '.obj', '.dae', '.gltf', '.glb')
"""What is read, by suffix, in any case of its letters."""
MAX_BYTES = 256 * 2**20
"""A larger file is refused."""
MAX_CORNERS = 30_000_000
"""Likewise a file that stands for more corners of triangles."""

_Y_UP_TO_Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
_UP_AXIS = re.compile(rb'<up_axis>\s*([XYZ]_UP)\s*</up_axis>')
_STL_HEAD = 84
_STL_RECORD = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('count', '<u2')])
_PACKAGES = {'trimesh': 'trimesh', 'collada': 'pycollada'}
"""What may not be installed, and is not needed for binary STL: modules and their packages."""
_NO_SCALE: Vector = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class TriangleMesh:
    """
    Triangles in the frame in which URDF places a mesh (Z up, before ``<origin>``).

    ``vertices``: (n, 3), m, all finite. ``faces``: (m, 3) indices of vertices, m > 0; the corners
    go round counter-clockwise as seen from outside.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]

    @property
    def size(self) -> Vector:
        """The edges of the box around it along its axes, m."""
        used = self.vertices[self.faces.reshape(-1)]
        x, y, z = (used.max(axis=0) - used.min(axis=0)).tolist()
        return (x, y, z)


def load_mesh(path: Path, scale: Vector = _NO_SCALE) -> TriangleMesh:
    """
    Read a mesh file.

    Args:
        path: The file; its suffix says the format, one of :data:`FORMATS`.
        scale: ``scale`` of URDF's ``<mesh>``, along the axes of the mesh; negative mirrors it.

    Returns:
        All its triangles, as one mesh.

    Raises:
        MeshError: It is not there, empty, too large, of another format, cannot be read, has no
            triangles, or coordinates that are no finite numbers; one line that says which.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        kinds = ', '.join(FORMATS)
        raise MeshError(f'{path}: a mesh of type {suffix!a} is not read; {kinds} are')
    data = read_mesh_file(path)
    with warnings.catch_warnings():
        warnings.simplefilter('ignore')  # of NumPy about pycollada
        try:
            vertices, faces = _READERS[suffix](data, path)
        except MeshError:
            raise
        except Exception as error:  # the libraries raise what they meet in a broken file
            reason = str(error) or type(error).__name__
            missing = _PACKAGES.get(getattr(error, 'name', None) or '')
            if missing:
                raise MeshError(
                    f'{path}: {missing}, which reads {suffix}, is not installed: pip install '
                    f'{missing}'
                ) from error
            raise MeshError(
                f'{path}: it cannot be read as {suffix}: {one_line(reason)}; export it again'
            ) from error
    if not len(faces):
        raise MeshError(f'{path}: there is no triangle in it; export it as triangles')
    vertices = vertices * np.asarray(scale)
    if not np.isfinite(vertices[faces.reshape(-1)]).all():
        raise MeshError(f'{path}: a coordinate of it is no finite number; export it again')
    if np.prod(np.sign(scale)) < 0.0:
        faces = faces[:, ::-1]
    return TriangleMesh(np.ascontiguousarray(vertices), np.ascontiguousarray(faces))


def declared_up_axis(path: Path) -> str | None:
    """
    Return what a COLLADA file says is up, such as ``Y_UP``; it is not applied, see above.

    None: it says nothing, is of another format, or cannot be read.
    """
    if path.suffix.lower() != '.dae':
        return None
    try:
        found = _UP_AXIS.search(read_mesh_file(path))
    except MeshError:
        return None
    return found[1].decode() if found else None


def read_mesh_file(path: Path) -> bytes:
    """Return what a file holds; MeshError if it is no regular file, empty or too large."""
    try:
        status = path.stat()
        if not S_ISREG(status.st_mode):  # a pipe or a device may have no end
            raise MeshError(f'{path}: it is no regular file')
        if status.st_size > MAX_BYTES:
            raise MeshError(f'{path}: it has {status.st_size} bytes, more than {MAX_BYTES}')
        data = path.read_bytes()
    except FileNotFoundError:
        raise MeshError(f'{path}: there is no such file') from None
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or error
        raise MeshError(f'{path}: it cannot be read: {reason}') from error
    if not data:
        raise MeshError(f'{path}: it is empty; export it again')
    return data


def stl_bytes(mesh: TriangleMesh) -> bytes:
    """Return a mesh as binary STL; equal meshes give equal bytes."""
    corners = mesh.vertices[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    records = np.zeros(len(corners), _STL_RECORD)
    records['normal'] = np.divide(normals, lengths, out=normals, where=lengths > 0.0)
    records['corners'] = corners
    return bytes(80) + struct.pack('<I', len(records)) + records.tobytes()


_Arrays: TypeAlias = tuple[NDArray[np.float64], NDArray[np.int64]]


def _read_stl(data: bytes, path: Path) -> _Arrays:
    """Most are binary and whole, and need not wait for trimesh."""
    (count,) = struct.unpack_from('<I', data, _STL_HEAD - 4) if len(data) >= _STL_HEAD else (0,)
    if not count or len(data) != _STL_HEAD + _STL_RECORD.itemsize * count:
        return _triangles(data, 'stl')
    if 3 * count > MAX_CORNERS:
        raise ValueError(f'it has more than {MAX_CORNERS // 3} triangles')
    corners = np.frombuffer(data, _STL_RECORD, count, _STL_HEAD)['corners']
    return corners.reshape(-1, 3).astype(float), np.arange(3 * count).reshape(-1, 3)


def _read_obj(data: bytes, path: Path) -> _Arrays:
    return _triangles(data, 'obj', skip_materials=True)


def _read_dae(data: bytes, path: Path) -> _Arrays:
    collada = prepare(data)
    vertices, faces = _triangles(collada.data, 'dae')
    return vertices * collada.unit, faces


def _read_gltf(data: bytes, path: Path) -> _Arrays:
    _check_gltf(data)
    kind = path.suffix.lower()[1:]
    buffers = _BuffersBeside(path.parent)
    vertices, faces = _triangles(data, kind, skip_materials=True, resolver=buffers)
    return vertices @ _Y_UP_TO_Z_UP.T, faces


_READERS: dict[str, Callable[[bytes, Path], _Arrays]] = {
    '.stl': _read_stl,
    '.obj': _read_obj,
    '.dae': _read_dae,
    '.gltf': _read_gltf,
    '.glb': _read_gltf,
}


def _triangles(data: bytes, kind: str, **options: Any) -> _Arrays:
    """Return the triangles of a file in the frame of its scene, as trimesh reads it."""
    import trimesh

    scene = trimesh.load_scene(io.BytesIO(data), file_type=kind, process=False, **options)
    vertices, faces = [np.empty((0, 3))], [np.empty((0, 3), np.int64)]
    count = corners = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        part = scene.geometry[name]
        if not isinstance(part, trimesh.Trimesh):  # lines and points
            continue
        corners += part.faces.size
        if corners > MAX_CORNERS:
            raise ValueError(f'it has more than {MAX_CORNERS // 3} triangles')
        linear = np.asarray(transform)[:3, :3]
        vertices.append(np.asarray(part.vertices) @ linear.T + np.asarray(transform)[:3, 3])
        own = np.asarray(part.faces, dtype=np.int64)
        if own.size and not 0 <= own.min() <= own.max() < len(part.vertices):
            raise ValueError('a triangle of it has a corner that is not there')
        faces.append((own[:, ::-1] if np.linalg.det(linear) < 0.0 else own) + count)
        count += len(part.vertices)
    return np.vstack(vertices), np.vstack(faces)


class _BuffersBeside:
    """Gives trimesh the buffers that a ``.gltf`` names: files in its folder or below it."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()

    def __getitem__(self, name: str) -> bytes:
        path = (self._folder / name).resolve()
        if not path.is_relative_to(self._folder):
            raise ValueError(f'it names {name!a}, which is not beside it')
        return read_mesh_file(path)

    get = __getitem__


def _check_gltf(data: bytes) -> None:
    """Refuse a glTF file that stands for more than it holds. Raises ValueError."""
    text = data
    if data[:4] == b'glTF':
        (length,) = struct.unpack_from('<I', data, 12)
        text = data[20 : 20 + length]
    tree = json.loads(text)
    accessors = [int(each['count']) for each in tree.get('accessors', ())]
    corners = [
        sum(
            accessors[part.get('indices', part['attributes']['POSITION'])]
            for part in mesh['primitives']
        )
        for mesh in tree.get('meshes', ())
    ]
    nodes = tree.get('nodes', ())
    children = [child for node in nodes for child in node.get('children', ())]
    if len(children) != len(set(children)):
        raise ValueError('a node of it has two parents')
    total = sum(corners[node['mesh']] for node in nodes if 'mesh' in node)
    if max([total, *accessors]) > MAX_CORNERS:
        raise ValueError(f'it has more than {MAX_CORNERS // 3} triangles')
