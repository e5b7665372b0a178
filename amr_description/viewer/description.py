# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot description for the page: joints, meshes, and the findings of check_urdf."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from html import unescape
import math
import os
from pathlib import Path
import re
from stat import S_ISREG

from amr_description.ament_index import resolve_uri
from amr_description.errors import MeshError, ResourceError
from amr_description.model import findings
from amr_description.model.checks import examine
from amr_description.model.meshes import load_mesh, stl_bytes
from amr_description.model.origins import line_from
from amr_description.model.robot import Collision, Joint, JointType, Mesh, Robot, Visual
from amr_description.text import one_line
from amr_description.viewer.http import digest
from amr_description.viewer.protocol import Finding, JointInfo, Model

SOURCE = 'robot_description'
_LARGEST_MESH = 256 * 1024 * 1024
_MESHES = {'.stl', '.obj', '.dae'}
_CONVERTED = {'.gltf', '.glb'}
"""The page gets them as STL."""
_IMAGES = {'.png', '.jpg', '.jpeg'}
"""Nothing else is served, whatever a description names."""
_IMAGE_OF_COLLADA = re.compile(r'<init_from>\s*(?:<ref>\s*)?([^<]+?)\s*</')


@dataclass(frozen=True, slots=True)
class DescribedRobot:
    """The message for the pages, and the files that it refers to, by the names in their URLs."""

    name: str
    message: Model
    files: Mapping[str, Path | bytes]
    """What is in a file, or instead of one that the page does not read."""
    speeds: Mapping[str, float]
    """The velocity limits of joints that have one, rad/s or m/s."""
    fixed: tuple[Joint, ...] = ()
    """Those that do not move."""

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints that have a position."""
        return tuple(joint.name for joint in self.message.joints)


def describe_robot(robot: str, text: str) -> DescribedRobot:
    """Read the description ``text`` of the robot with id ``robot``; errors become findings."""
    examination = examine(text, SOURCE)
    model, told = examination.robot, [_finding(each, text) for each in examination.findings]
    meshes: dict[str, str] = {}
    files: dict[str, Path | bytes] = {}
    tried: set[str] = set()
    wanted = [*_files_of(model)] if model else []
    while wanted:
        uri = wanted.pop(0)
        if uri in tried:
            continue
        tried.add(uri)
        try:
            file = served_file(uri)
        except (ResourceError, MeshError) as error:
            told.append(Finding('warning', None, None, f'{uri} cannot be drawn: {error}', ''))
            continue
        meshes[uri], files[file.name] = f'/mesh/{file.name}', file.content
        if file.name.endswith('.dae'):
            wanted += _images_of_collada(uri, file.data)
    message = Model(
        robot=robot,
        urdf=text,
        root=model.roots[0].name if model and model.roots else '',
        meshes=meshes,
        joints=tuple(_joint(each) for each in model.joints if each.has_position) if model else (),
        findings=tuple(told),
    )
    limits = {each.name: each.limit for each in model.joints if each.limit} if model else {}
    speeds = {name: limit.velocity for name, limit in limits.items() if limit.velocity > 0.0}
    joints = model.joints if model else ()
    fixed = tuple(each for each in joints if not each.is_moving)
    return DescribedRobot(model.name if model else '', message, files, speeds, fixed)


def _files_of(robot: Robot) -> Iterator[str]:
    for link in robot.links:
        parts: tuple[Visual | Collision, ...] = (*link.visuals, *link.collisions)
        for part in parts:
            if isinstance(part.geometry, Mesh):
                yield part.geometry.filename
    yield from _textures(robot)


def _textures(robot: Robot) -> Iterable[str]:
    looks = [*robot.materials, *(v.material for link in robot.links for v in link.visuals)]
    return [look.texture for look in looks if look and look.texture]


def _images_of_collada(uri: str, data: bytes) -> Iterator[str]:
    """Yield the URIs of the images that a COLLADA file names, in its own folder or below."""
    folder = uri[: uri.rindex('/') + 1]
    for found in _IMAGE_OF_COLLADA.findall(data.decode(errors='replace')):
        name = unescape(found)
        if Path(name).suffix.lower() in _IMAGES and not name.startswith('/') and '://' not in name:
            yield folder + name.removeprefix('./')


@dataclass(frozen=True, slots=True)
class ServedFile:
    """A mesh or image: the name in its URL, what is served, and what is in the file itself."""

    name: str
    content: Path | bytes
    data: bytes


def served_file(uri: str, given: tuple[str, bytes] | None = None) -> ServedFile:
    """
    Read a mesh or image for pages.

    Args:
        uri: Of the file.
        given: Its name and what is in it, of one that came with a message.

    Raises:
        ResourceError: There is no such file, or it is of another kind.
        MeshError: It cannot be converted.
    """
    file = resolve_uri(uri) if given is None else Path(given[0] or uri)
    if given is not None:
        _check_kind(file)
    data = _read(file) if given is None else given[1]
    content: Path | bytes = file if given is None else data
    suffix = file.suffix.lower()
    if suffix in _CONVERTED:
        if given is not None:
            raise ResourceError(f'a {suffix} that comes with a message is not drawn')
        content, suffix = stl_bytes(load_mesh(file)), '.stl'
    return ServedFile(f'{digest(data)}{suffix}', content, data)


def _read(file: Path) -> bytes:
    """
    Read a mesh or image. Raises ResourceError.

    Who names a link of another kind than the file that it leads to does not want to see a mesh:
    anybody can publish a description, and whoever opens the page gets its files.
    """
    _check_kind(file)
    try:
        status = file.stat()
        if not S_ISREG(status.st_mode):  # a pipe or a device may have no end
            raise ResourceError(f'{file} is no regular file')
        _check_kind(Path(os.path.realpath(file)))
        if status.st_size > _LARGEST_MESH:
            raise ResourceError(f'it has {status.st_size} bytes, more than {_LARGEST_MESH}')
        return file.read_bytes()
    except (OSError, ValueError) as error:
        raise ResourceError(f'{file}: {getattr(error, "strerror", None) or error}') from error


def _check_kind(file: Path) -> None:
    """Raise ResourceError: it is neither a mesh nor an image, by its name."""
    suffix, known = file.suffix.lower(), _MESHES | _CONVERTED | _IMAGES
    if suffix not in known:
        raise ResourceError(f'the page draws {", ".join(sorted(known))}, not {suffix!a}')


def _joint(joint: Joint) -> JointInfo:
    lower, upper = -math.pi, math.pi
    if joint.type is not JointType.CONTINUOUS and joint.limit is not None:
        lower, upper = joint.limit.lower, joint.limit.upper
    if not (math.isfinite(lower) and math.isfinite(upper)):
        lower, upper = -math.pi, math.pi
    return JointInfo(
        name=joint.name,
        kind=joint.type.value,  # type: ignore[arg-type]
        lower=lower,
        upper=upper,
        zero=0.0 if lower <= 0.0 <= upper else (lower + upper) / 2,
        follows=joint.mimic.joint if joint.mimic else None,
    )


def _finding(finding: findings.Finding, urdf: str) -> Finding:
    parts = [f'found {finding.found}'] if finding.found else []
    parts += [f'expected {finding.expected}'] if finding.expected else []
    text = f'{finding.what}: {", ".join(parts)}' if parts else finding.what
    at = finding.line or None
    if finding.source != SOURCE:  # the line is one of the file that the text is from
        text = f'{Path(finding.source).name}: {text}'
        at = line_from(urdf, finding.source, finding.line)
    if finding.context:
        text = f'{text} ({finding.context})'
    return Finding(
        level='error' if finding.severity is findings.Severity.ERROR else 'warning',
        line=finding.line or None,
        at=at,
        text=one_line(text),
        remedy=one_line(finding.fix),
    )
