# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where files are: ROS packages' share folders, ``package://`` and ``file://``, shipped worlds."""

from collections.abc import Callable, Mapping
from pathlib import Path
from urllib.parse import parse_qsl, unquote, urlsplit

from ament_index_python.packages import get_package_share_directory, PackageNotFoundError

from amr_description.errors import SimulationError
from amr_description.model.description_file import description_text, is_xacro

OWN_PACKAGE = 'amr_description'
_SOURCE_TREE = Path(__file__).resolve().parents[2]


def package_share(package: str) -> Path:
    """
    The share folder of a ROS package; our own is also found in a source tree that is not built.

    Raises SimulationError.
    """
    try:
        return Path(get_package_share_directory(package))
    except (PackageNotFoundError, OSError, ValueError) as cause:
        if package == OWN_PACKAGE and (_SOURCE_TREE / 'config').is_dir():
            return _SOURCE_TREE
        raise SimulationError(
            f"package '{package}' is not found in AMENT_PREFIX_PATH; build it and source its "
            'workspace first'
        ) from cause


def resolve_uri(uri: str, folder: Path | None = None) -> Path:
    """
    The file that ``package://<package>/<path>``, ``file://<path>`` or a plain path means.

    A relative plain path is looked up in ``folder`` (that of the description, when it is known).
    The file need not exist. Raises SimulationError for an unknown package or scheme.
    """
    try:
        parts = urlsplit(uri)
    except ValueError as error:
        raise SimulationError(
            f'{uri!a} is no URI: {error}; package://, file:// or a path will do'
        ) from error
    path = unquote(parts.path)
    match parts.scheme:
        case 'package':
            return package_share(parts.netloc) / path.lstrip('/')
        case 'file':
            return Path(path)
        case '':
            return (folder or Path()) / uri
        case scheme:
            raise SimulationError(
                f"'{uri}': scheme '{scheme}' is not known; package://, file:// or a path will do"
            )


def description_at(
    uri: str, mappings: Mapping[str, str] | None = None, *, warn: Callable[[str], object]
) -> str:
    """
    The URDF at a URI; of a xacro file, expanded with ``mappings`` and those of the URI itself.

    ``package://cart/urdf/cart.urdf.xacro?wheel_radius=0.2&camera=true``. ``warn`` is told, in a
    line each, what is probably not meant. Raises SimulationError, DescriptionError.
    """
    file, _, query = uri.partition('?')
    if not is_xacro(file):
        file, query = uri, ''
    given = dict(parse_qsl(query, keep_blank_values=True)) | dict(mappings or {})
    return description_text(resolve_uri(file), given, warn=warn)


def shipped_worlds() -> dict[str, Path]:
    """The worlds of this package: name → file."""
    folder = package_share(OWN_PACKAGE) / 'config' / 'worlds'
    return {path.stem: path for path in sorted(folder.glob('*.xml'))}


def world_path(world: str) -> Path:
    """The file of a world given as a shipped name or as a path. Raises SimulationError."""
    shipped = shipped_worlds()
    path = shipped.get(world) or Path(world).expanduser()
    if path.is_file():
        return path
    raise SimulationError(
        f"world '{world}': neither a file nor a shipped world; shipped are: {', '.join(shipped)}"
    )
