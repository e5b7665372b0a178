# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The meshes of a robot, each file read once: what the checker's rules on meshes look at."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from amr_description.errors import AmrError, MeshError
from amr_description.model.frames import Vector
from amr_description.model.robot import Collision, Link, Mesh, Robot, Visual

if TYPE_CHECKING:
    from amr_description.model.meshes import TriangleMesh

FindFile: TypeAlias = Callable[[str], Path]
"""The file that a URI or path means, whether it is there or not; AmrError when none is meant."""

# MuJoCo's own format, which nothing else reads.
_ONLY_MUJOCO = '.msh'


@dataclass(frozen=True, slots=True, eq=False)
class MeshUse:
    """
    A ``<mesh>`` of a link whose file is there.

    ``triangles`` are scaled, in the frame of the mesh; None when they cannot be had, and then
    ``error`` says why.
    """

    link: Link
    part: Visual | Collision
    mesh: Mesh
    path: Path
    triangles: 'TriangleMesh | None'
    error: str = ''

    @property
    def touches(self) -> bool:
        """Whether it is that of a collision."""
        return isinstance(self.part, Collision)


def find_meshes(robot: Robot, find_file: FindFile) -> tuple[MeshUse, ...]:
    """Return the meshes of all links, in the order of the file."""
    read: dict[tuple[Path, Vector], MeshUse] = {}
    uses = []
    for link, part, mesh, path in _named(robot, find_file):
        key = (path, mesh.scale)
        if key not in read:
            triangles, error = _load(path, mesh.scale)
            read[key] = MeshUse(link, part, mesh, path, triangles, error)
        uses.append(MeshUse(link, part, mesh, path, read[key].triangles, read[key].error))
    return tuple(uses)


def _named(
    robot: Robot, find_file: FindFile
) -> Iterator[tuple[Link, Visual | Collision, Mesh, Path]]:
    for link in robot.links:
        parts: tuple[Visual | Collision, ...] = (*link.visuals, *link.collisions)
        for part in parts:
            if not isinstance(part.geometry, Mesh):
                continue
            try:
                path = find_file(part.geometry.filename)
                if path.suffix.lower() == _ONLY_MUJOCO or not path.is_file():
                    continue
            except (AmrError, OSError, ValueError):  # the rules on files say so
                continue
            yield link, part, part.geometry, path


def _load(path: Path, scale: Vector) -> 'tuple[TriangleMesh | None, str]':
    # Not at the top: what has no mesh need not wait for what reads them.
    from amr_description.model.meshes import load_mesh

    try:
        return load_mesh(path, scale), ''
    except MeshError as error:
        return None, str(error)
