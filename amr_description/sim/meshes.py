# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The mesh files of a URDF: found and judged before MuJoCo reads them."""

from pathlib import Path

from lxml import etree

from amr_description.ament_index import resolve_uri
from amr_description.control.contracts import Log, Severity
from amr_description.errors import ResourceError, SpawnError
from amr_description.sim.spawning import SpawnCode

FORMATS = ('.stl', '.obj', '.msh')
"""What MuJoCo reads."""


def resolve_meshes(urdf: etree._Element, source: str, log: Log) -> None:
    """
    Write the true path of every mesh into ``urdf``.

    Physics needs the shapes of collisions: SpawnError if one cannot be had. A ``<visual>`` whose
    mesh cannot be had is left out, which the log is told.
    """
    for part in (*urdf.iterfind('link/collision'), *urdf.iterfind('link/visual')):
        mesh = part.find('geometry/mesh')
        if mesh is None:
            continue
        place = f'{source}:{mesh.sourceline}: mesh of a {part.tag} of link "{_link(part)}"'
        try:
            mesh.set('filename', str(_mesh_file(mesh.get('filename', ''), source, place)))
        except SpawnError as error:
            if part.tag == 'collision':
                raise
            log(Severity.WARN, f'{error}; it is not drawn')
            part.getparent().remove(part)


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
    if path.suffix.lower() not in FORMATS:
        raise SpawnError(
            f'{place}: {uri}: the simulator reads {", ".join(FORMATS)}, not {path.suffix}',
            SpawnCode.UNSUPPORTED_ASSETS,
        )
    return path.resolve()
