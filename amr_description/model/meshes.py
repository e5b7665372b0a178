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
import math
from pathlib import Path
import re
from stat import S_ISREG
import struct
from typing import Any, TypeAlias
import warnings

from lxml import etree
import numpy as np
from numpy.typing import NDArray

from amr_description.errors import MeshError
from amr_description.model.frames import Vector
from amr_description.text import one_line

# --- COLLADA -------------------------------------------------------------------------------------
#
# pycollada drops a part whose material or picture is broken; a shape has neither, so they are
# taken out before it reads. It also makes 0 of coordinates that are no numbers, follows references
# to nodes as often as they are named, and leaves out primitives that it does not know: each is
# refused here instead. A document type declaration, and with it every entity, is refused too.

_LARGEST_SCENE = 2**28
"""Characters of indices, over all instances of a geometry: about 30 million triangles."""
_HEAD = 65536
_NO_DOCTYPE = 'a document type declaration is refused; remove <!DOCTYPE'
_SURPLUS = (
    'library_animations', 'library_animation_clips', 'library_cameras', 'library_controllers',
    'library_effects', 'library_force_fields', 'library_images', 'library_lights',
    'library_materials', 'library_physics_materials', 'library_physics_models',
    'library_physics_scenes', 'bind_material', 'extra', 'instance_camera', 'instance_controller',
    'instance_light',
)  # fmt: skip
_UNREAD = ('tristrips', 'trifans', 'convex_mesh', 'spline', 'brep')


@dataclass(frozen=True, slots=True)
class Collada:
    """The geometry of a file; ``unit`` is the length of its unit in m."""

    data: bytes
    unit: float


def prepare(data: bytes) -> Collada:
    """
    Return the XML of a COLLADA file with only what its shape is made of.

    Raises:
        ValueError: It is no COLLADA file, or one that cannot be read; the text says why.
    """
    if b'<!DOCTYPE' in data[:_HEAD]:
        raise ValueError(_NO_DOCTYPE)
    # Without entities there is nothing that grows; the caller bounds the size of the file.
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, load_dtd=False, huge_tree=True, remove_pis=True,
        remove_comments=True,
    )  # fmt: skip
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise ValueError(f'not well-formed XML: {error.msg}') from None
    if root.getroottree().docinfo.internalDTD is not None:
        raise ValueError(_NO_DOCTYPE)
    space, _, name = root.tag.rpartition('}')
    if name != 'COLLADA':
        raise ValueError(f'its root element is <{name}>, not <COLLADA>')
    _Checker(root, f'{space}}}' if space else '').check()
    return Collada(etree.tostring(root), _unit(root, f'{space}}}' if space else ''))


def _unit(root: etree._Element, space: str) -> float:
    """Return the length of ``<asset><unit meter="…"/>``, m; 1 where none is given."""
    element = root.find(f'{space}asset/{space}unit')
    text = '1' if element is None else element.get('meter', '1')
    try:
        unit = float(text)
    except ValueError:
        unit = math.nan
    if not 0.0 < unit < math.inf:
        raise ValueError(f'<unit meter="{text}"/> is no length in m')
    return unit


class _Checker:
    """Takes out what is no shape, and refuses what pycollada would read wrongly."""

    def __init__(self, root: etree._Element, space: str) -> None:
        self._root = root
        self._space = space
        self._sizes: dict[str, int] = {}
        self._open: set[str] = set()

    def check(self) -> None:
        etree.strip_elements(self._root, *(self._space + each for each in _SURPLUS))
        for name in _UNREAD:
            if self._root.find(f'.//{self._space}{name}') is not None:
                raise ValueError(f'<{name}> is not read; export the mesh as triangles')
        self._check_numbers()
        self._by_id = {each.get('id'): each for each in self._root.iter() if each.get('id')}
        scenes = [*self._root.iter(self._space + 'visual_scene')]
        try:
            if sum(self._size(scene) for scene in scenes) > _LARGEST_SCENE:
                raise ValueError('its scene names its geometries too often, or they are too large')
        except RecursionError:
            raise ValueError('its nodes refer to each other too deeply') from None

    def _check_numbers(self) -> None:
        """pycollada reads a coordinate that is NaN as 0."""
        sources = {
            each.get('source', '')[1:]
            for each in self._root.iter(self._space + 'input')
            if each.get('semantic') == 'POSITION'
        }
        for source in self._root.iter(self._space + 'source'):
            if source.get('id') in sources:
                array = source.find(self._space + 'float_array')
                if array is not None and 'nan' in (array.text or '').lower():
                    raise ValueError('a coordinate is NaN')

    def _size(self, node: etree._Element) -> int:
        """Return the characters of indices below a node, each instance counted, at least 1."""
        size = 1
        for child in node.iterchildren(etree.Element):
            name = child.tag.removeprefix(self._space)
            if name == 'node':
                size += self._size(child)
            elif name in ('instance_node', 'instance_geometry'):
                size += self._size_of(child.get('url', '')[1:], name)
        return size

    def _size_of(self, key: str, kind: str) -> int:
        target = self._by_id.get(key)
        if target is None:
            return 1
        if key not in self._sizes:
            if key in self._open:
                raise ValueError(f'its node "{key}" contains itself')
            self._open.add(key)
            if kind == 'instance_node':
                self._sizes[key] = self._size(target)
            else:
                indices = target.iter(self._space + 'p')
                self._sizes[key] = 1 + sum(len(each.text or '') for each in indices)
        return self._sizes[key]


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
