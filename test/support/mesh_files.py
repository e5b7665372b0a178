# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Mesh files of known shape, as text: a box in each format."""

import base64
import itertools
import json
import struct

UNIT_CORNERS = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
FACES = [
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
    (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
]  # fmt: skip
"""Counter-clockwise as seen from outside."""


def box(size, center=(0.0, 0.0, 0.0)):
    """The corners of a box about a centre, in the order of FACES."""
    return [
        tuple(c + s * u for c, s, u in zip(center, size, p, strict=True)) for p in UNIT_CORNERS
    ]


def words(values):
    return ' '.join(repr(each) for each in values)


def dae(corners, faces=FACES, *, meter=None, up=None, matrix=None, nodes='', positions=None):
    """A COLLADA file; ``nodes`` replaces the scene's, and ``matrix`` is that of its one."""
    unit = '' if meter is None else f'<unit name="u" meter="{meter}"/>'
    axis = '' if up is None else f'<up_axis>{up}</up_axis>'
    text = words(itertools.chain(*corners)) if positions is None else positions
    place = '' if matrix is None else f'<matrix>{words(itertools.chain(*matrix))}</matrix>'
    scene = nodes or f'<node id="n">{place}<instance_geometry url="#g"/></node>'
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>{unit}{axis}</asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="{3 * len(corners)}">{text}</float_array>
<technique_common><accessor source="#pa" count="{len(corners)}" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{len(faces)}"><input semantic="VERTEX" source="#v" offset="0"/>
<p>{words(itertools.chain(*faces))}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">{scene}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""


def obj(corners, faces=FACES):
    lines = [f'v {words(each)}' for each in corners]
    return '\n'.join(lines + ['f ' + ' '.join(str(i + 1) for i in face) for face in faces]) + '\n'


def ascii_stl(corners, faces=FACES):
    facets = [
        'facet normal 0 0 0\nouter loop\n'
        + ''.join(f'vertex {words(corners[i])}\n' for i in face)
        + 'endloop\nendfacet\n'
        for face in faces
    ]
    return f'solid box\n{"".join(facets)}endsolid box\n'


def binary_stl(corners, faces=FACES):
    body = b''.join(
        struct.pack('<12fH', 0, 0, 0, *(x for i in face for x in corners[i]), 0) for face in faces
    )
    return bytes(80) + struct.pack('<I', len(faces)) + body


def gltf_tree(corners, faces=FACES, uri=None):
    """The tree of a glTF file and its buffer; ``uri`` of the buffer."""
    points = struct.pack(f'<{3 * len(corners)}f', *itertools.chain(*corners))
    indices = struct.pack(f'<{3 * len(faces)}H', *itertools.chain(*faces))
    data = points + indices
    buffer = {'byteLength': len(data)}
    if uri is not None:
        buffer['uri'] = uri
    columns = list(zip(*corners, strict=True))
    tree = {
        'asset': {'version': '2.0'},
        'scene': 0,
        'scenes': [{'nodes': [0]}],
        'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
        'accessors': [
            {'bufferView': 0, 'componentType': 5126, 'count': len(corners), 'type': 'VEC3',
             'min': [min(c) for c in columns], 'max': [max(c) for c in columns]},
            {'bufferView': 1, 'componentType': 5123, 'count': 3 * len(faces), 'type': 'SCALAR'},
        ],
        'bufferViews': [
            {'buffer': 0, 'byteOffset': 0, 'byteLength': len(points)},
            {'buffer': 0, 'byteOffset': len(points), 'byteLength': len(indices)},
        ],
        'buffers': [buffer],
    }  # fmt: skip
    return tree, data


def gltf(corners, faces=FACES):
    _, data = gltf_tree(corners, faces)
    uri = f'data:application/octet-stream;base64,{base64.b64encode(data).decode()}'
    return json.dumps(gltf_tree(corners, faces, uri)[0])


def glb(corners, faces=FACES):
    tree, data = gltf_tree(corners, faces)
    text = json.dumps(tree).encode()
    text += b' ' * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    chunks = struct.pack('<I4s', len(text), b'JSON') + text
    chunks += struct.pack('<I4s', len(data), b'BIN\0') + data
    return struct.pack('<4sII', b'glTF', 2, 12 + len(chunks)) + chunks


def write(path, content):
    """Write text or bytes; return the path."""
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path
