# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A COLLADA file (``.dae``) made ready for pycollada: its geometry alone, checked and bounded.

pycollada drops a part whose material or picture is broken; a shape has neither, so they are taken
out before it reads. It also makes 0 of coordinates that are no numbers, follows references to
nodes as often as they are named, and leaves out primitives that it does not know: each is refused
here instead. A document type declaration, and with it every entity, is refused too.
"""

from dataclasses import dataclass
import math

from lxml import etree

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
