# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ROS packages, their executables and files: the ament index of ``AMENT_PREFIX_PATH``, and URIs.

A package is found in the first prefix whose index names it, as in ``ament_index_python``, which is
not needed here: the simulation runs where no ROS is. What cannot be found raises
:class:`~amr_description.errors.ResourceError`.

A workspace may have a package of this one's name, as the tutorial makes it. It overlays this one:
its executables and files are found first, and what it lacks is found here.
"""

from collections.abc import Iterator
from contextlib import suppress
import glob
import os
from pathlib import Path
import re
from urllib.parse import unquote, urlsplit

from amr_description.errors import ResourceError, SimulationError
from amr_description.text import did_you_mean, shorten, suggestion

OWN_PACKAGE = 'amr_description'
_OWN_EXECUTABLE = 'ros2_control_node'  # by which an installation of it is known
_INDEX = 'share/ament_index/resource_index/packages'
_STANDS_IN = b'of amr_description'
"""
What the index says of a package in whose place something of ours is (``scripts/environment``).

Programs of others find it there; here it counts as not installed, so that this is said.
"""
_MANIFESTS = ('package.xml', *(f'src/{"*/" * depth}package.xml' for depth in range(4)))
_NAME = re.compile(r'[a-zA-Z0-9][a-zA-Z0-9_-]+')  # REP 127, with what it exempts
_MODULES = Path(__file__).resolve().parents[1]
_VARIABLE = 'AMENT_PREFIX_PATH'
MODEL_VARIABLES = (
    'GZ_SIM_RESOURCE_PATH', 'IGN_GAZEBO_RESOURCE_PATH', 'GAZEBO_MODEL_PATH', 'SDF_PATH'
)  # fmt: skip
"""Where Gazebo looks for ``model://``: lists of folders."""
_FIND = re.compile(r'\$\((?:find|find-pkg-share)\s+([\w-]+)\s*\)(.*)')


def prefixes() -> list[Path]:
    """Return the install folders of the sourced underlay and workspaces."""
    return [Path(prefix) for prefix in os.environ.get(_VARIABLE, '').split(os.pathsep) if prefix]


def packages() -> dict[str, Path]:
    """Return the prefix of each installed package, sorted by the package's name."""
    found: dict[str, Path] = {}
    for prefix in reversed(prefixes()):  # the first one counts
        with suppress(OSError):  # no folder, or none of an index
            names = (each.name for each in (prefix / _INDEX).iterdir() if _is_package(each))
            found |= dict.fromkeys((name for name in names if not name.startswith('.')), prefix)
    return dict(sorted(found.items()))


def _is_package(entry: Path) -> bool:
    """Return whether an entry of an index is of a package, and of none that has a stand-in."""
    if not entry.is_file():
        return False
    return entry.stat().st_size != len(_STANDS_IN) or entry.read_bytes() != _STANDS_IN


def stands_in(package: str, prefix: Path) -> bool:
    """Return whether what a prefix has of a package is something of ours in its place."""
    entry = prefix / _INDEX / package
    return entry.is_file() and not _is_package(entry)


def is_installed(package: str) -> bool:
    """Return whether a package is in the ament index."""
    try:
        package_prefix(package)
    except ResourceError:
        return False
    return True


def package_prefix(package: str) -> Path:
    """Return the folder that a package is installed in. Raises ResourceError."""
    if not prefixes():
        raise ResourceError(
            f"Package '{shorten(package)}' not found: {_VARIABLE} is empty; source "
            'scripts/activate or the setup.bash of the workspace first'
        )
    with suppress(OSError, ValueError):  # a name that no file can have
        for prefix in prefixes() if _NAME.fullmatch(package) else ():
            if _is_package(prefix / _INDEX / package):
                return prefix
    searched = ', '.join(map(str, prefixes()))
    raise ResourceError(
        f"Package '{shorten(package)}' not found, searching: {searched}"
        + did_you_mean(package, packages())
    )


def package_share(package: str) -> Path:
    """
    Return the share folder of a package. Raises ResourceError.

    This package is also found in a source tree that was not built, and where pip has put it.
    """
    try:
        return package_prefix(package) / 'share' / package
    except ResourceError as error:
        if package == OWN_PACKAGE and (own := _share_of(_MODULES)) is not None:
            return own
        raise ResourceError(
            f"package '{package}' is not found in {_VARIABLE}; build it and source its workspace "
            'first'
        ) from error


def _share_of(modules: Path) -> Path | None:
    """
    Return the share folder of this package by the folder that has its modules, or None.

    It is that folder in a source tree. Of an installation it is ``share/amr_description`` in one
    of the folders above: ``<prefix>/lib/python3.13/site-packages``, ``<prefix>/Lib/site-packages``
    on Windows, and others of users and of ``pip install --target``.
    """
    above = (each / 'share' / OWN_PACKAGE for each in (modules, *modules.parents[:3]))
    folders = (each for each in (modules, *above) if (each / 'package.xml').is_file())
    return next(folders, None)


def own_prefix() -> Path | None:
    """Return the folder that this package itself is installed in; None: it is not installed."""
    folders = (prefix / 'lib' / OWN_PACKAGE for prefix in prefixes())
    return next((path.parents[1] for path in folders if (path / _OWN_EXECUTABLE).is_file()), None)


def own_share() -> Path:
    """Return the share folder of this package itself. Raises ResourceError."""
    prefix = own_prefix()
    if prefix is not None:
        return prefix / 'share' / OWN_PACKAGE
    return _share_of(_MODULES) or package_share(OWN_PACKAGE)


def overlay() -> Path | None:
    """Return the prefix of a package of this one's name that overlays it, if there is one."""
    own = own_prefix()
    first = next((p for p in prefixes() if (p / _INDEX / OWN_PACKAGE).is_file()), None)
    return first if own is not None and first != own else None


def is_own(executable: Path) -> bool:
    """Return whether a file of a package of this one's name is of this package itself."""
    own = own_prefix()
    return own is None or executable.is_relative_to(own)


def _prefixes_of(package: str) -> list[Path]:
    """Return where to look for what is in a package, in this order. Raises ResourceError."""
    first, own = package_prefix(package), own_prefix()
    return [first, own] if package == OWN_PACKAGE and own not in (None, first) else [first]


def shared_file(package: str, below: str) -> Path:
    """
    Return a path in the share folder of a package, where there may be no file.

    Raises ResourceError as :func:`package_share` does.
    """
    path = package_share(package) / below
    if package == OWN_PACKAGE and not path.exists() and (own_share() / below).exists():
        return own_share() / below
    return path


def executables_of(package: str) -> list[Path]:
    """
    Return all executable files in ``lib/<package>``, sorted by path; of each name the first.

    Raises ResourceError with the text of ``ros2 run``, which does not say where it searched.
    """
    if prefixes() and not is_installed(package):
        raise ResourceError(f"Package '{shorten(package)}' not found")
    first, *others = (prefix / 'lib' / package for prefix in _prefixes_of(package))
    found = list(_executables_below(first))
    names = {path.name for path in found}
    for folder in others:
        found += (path for path in _executables_below(folder) if path.name not in names)
    return sorted(found)


def executable_of(package: str, name: str) -> Path:
    """Return ``<prefix>/lib/<package>/<name>``. Raises ResourceError with the closest name."""
    folders = [prefix / 'lib' / package for prefix in _prefixes_of(package)]
    for folder in folders:
        if _is_executable(folder / name):
            return folder / name
    files = (file for folder in folders for file in folder.glob('*'))
    known = sorted(file.name for file in files if _is_executable(file))
    raise ResourceError(
        f"executable '{name}' not found on the libexec directory '{folders[0]}'"
        + suggestion(name, known)
    )


def resolve_uri(uri: str, folder: Path | None = None) -> Path:
    """
    Return the path of a URI in a description; the file need not exist.

    A package that is not installed is looked for beside the description too, where it lies in the
    sources: among the folders above, those with its name, and in them those that have
    its name and hold a ``package.xml``, or the file.

    Args:
        uri: ``package://<package>/<path>``, ``model://<model>/<path>``, ``file://<path>`` or a
            plain path. A model is a folder of one of :data:`MODEL_VARIABLES`, else a package.
        folder: the base of a relative path, usually the folder of the description.

    Raises:
        ResourceError: the package is not installed, or the scheme is not known.
    """
    try:
        parts = urlsplit(uri)
    except ValueError as error:
        raise ResourceError(
            f'{uri!a} is no URI: {error}; package://, file:// or a path will do'
        ) from error
    path = unquote(parts.path)
    match parts.scheme:
        case 'package':
            return _in_package(parts.netloc, path.lstrip('/'), folder)
        case 'model':
            return _of_model(uri, unquote(parts.netloc), path.lstrip('/'), folder)
        case 'file' if parts.netloc not in ('', 'localhost'):
            return (folder or Path()) / f'{unquote(parts.netloc)}{path}'
        case 'file':
            return (folder or Path()) / path
        case '':
            return (folder or Path()) / uri
        case scheme:
            raise ResourceError(
                f"'{uri}': scheme '{scheme}' is not known; package://, file:// or a path will do"
            )


def _in_package(package: str, below: str, folder: Path | None) -> Path:
    """Return a path in the share folder of a package, or in its sources. Raises ResourceError."""
    try:
        return shared_file(package, below)
    except ResourceError:
        around = None if folder is None else package_around(package, folder, below)
        if around is None:
            raise
        return around / below


def package_around(package: str, folder: Path, below: str = 'package.xml') -> Path | None:
    """
    Return the folder of a package that a file lies in or beside, where it is not installed.

    Args:
        package: Its name, which is that of the folder.
        folder: That of the file.
        below: A file by which a folder beside it is known, too, as by a ``package.xml``.
    """
    for above in (folder.absolute(), *folder.absolute().parents):
        if above.name == package and above.is_dir():
            return above
        if any((above / package / file).is_file() for file in ('package.xml', below)):
            return above / package
    return None


def _of_model(uri: str, model: str, below: str, folder: Path | None) -> Path:
    """Return a path of a model where Gazebo would find it, else of the package. ResourceError."""
    for variable in MODEL_VARIABLES:
        for each in filter(None, os.environ.get(variable, '').split(os.pathsep)):
            path = Path(each, model, below)
            if path.is_file():
                return path
    try:
        return _in_package(model, below, folder)
    except ResourceError as error:
        raise ResourceError(
            f"'{uri}': no folder of {MODEL_VARIABLES[0]} has it, and there is no package '{model}'"
        ) from error


def parameter_path(text: str, folder: Path | None = None) -> Path:
    """
    Return the path that ``<parameters>`` of a URDF names; the file need not exist.

    ``$(find package)`` counts as in xacro, in a URDF that did not go through it. Raises
    ResourceError, as :func:`resolve_uri`.
    """
    match = _FIND.match(text)
    if match is not None:
        return shared_file(match[1], match[2].lstrip('/'))
    return resolve_uri(text, folder)


def path_of(file: str, argument: str = '') -> Path:
    """
    Return the absolute path of a file that exists. Raises ResourceError.

    Args:
        file: ``package://<package>/<path below its share folder>``, or a path, in which ``~`` is
            the home folder.
        argument: of which it is the value, for the message.
    """
    if file.startswith('package://'):
        package, _, below = file.removeprefix('package://').partition('/')
        path = shared_file(package, below)
    else:
        path = Path(file).expanduser().absolute()
    if not path.is_file():
        asked = f'{argument}:={file}' if argument else f"'{file}'"
        if path.is_dir():
            raise ResourceError(f'{asked}: it is a folder: {path}')
        raise ResourceError(f'{asked}: no such file: {path}{hint_at(path)}')
    return path


def source_of(installed: Path) -> Path | None:
    """
    Return the source file that an installed file is copied from; None: it is not known.

    The installed one need not be there: so it is of a source that is newer than the last build.
    """
    for prefix in prefixes():
        share = prefix / 'share'
        if installed.is_relative_to(share) and len(installed.relative_to(share).parts) > 1:
            package, *below = installed.relative_to(share).parts
            found = (folder.joinpath(*below) for folder in sources_of(package, prefix))
            return next((file for file in found if file.is_file()), None)
    return None


def sources_of(package: str, prefix: Path) -> Iterator[Path]:
    """Yield the source folders of a package that a colcon workspace has installed in a prefix."""
    for workspace in (prefix.parent, prefix.parent.parent):
        if not (workspace / 'build' / package).is_dir():
            continue
        for pattern in _MANIFESTS:
            for manifest in sorted(workspace.glob(pattern)):
                if package_in(manifest) == package:
                    yield manifest.parent


def package_in(manifest: Path) -> str | None:
    """Return the name in a package.xml; None if there is none."""
    try:
        text = manifest.read_text('utf-8', errors='replace')
    except OSError:
        return None
    name = re.search(r'<name>\s*(\S+?)\s*</name>', text)
    return name[1] if name else None


def hint_at(missing: Path) -> str:
    """Return what would do about a file that is not there: cd, build, or another name; or ''."""
    with suppress(OSError):  # as of a folder that is gone, or of a mount that does not answer
        return _hint_at(missing.absolute())
    return ''


def _hint_at(missing: Path) -> str:
    if (source := source_of(missing)) is not None:
        return not_installed(source)
    if folders := _folders_with(missing):
        return f'; it is in {" and in ".join(folders)}: cd {folders[0]}'
    return did_you_mean(
        missing.name, [each.name for each in missing.parent.glob('*') if each.is_file()]
    )


def _folders_with(missing: Path) -> list[str]:
    """Return the folders, one or two below the present one, from which a file would be found."""
    here = Path.cwd()
    if not missing.is_relative_to(here):
        return []
    name = missing.relative_to(here)
    depths = (f'*/{glob.escape(str(name))}', f'*/*/{glob.escape(str(name))}')
    found = (each for depth in depths for each in sorted(here.glob(depth)) if each.is_file())
    return [str(each.relative_to(here)).removesuffix(f'/{name}') for each in found]


def not_installed(source: Path) -> str:
    """Return what would do about a source file that no build has installed so far."""
    return f'; {source} is not installed: colcon build, if setup.py or CMakeLists.txt names it'


def shipped_worlds() -> dict[str, Path]:
    """Return the worlds of this package: name → file."""
    folder = own_share() / 'config' / 'worlds'
    return {path.stem: path for path in sorted(folder.glob('*.xml'))}


def world_path(world: str) -> Path:
    """Return the file of a world, given by shipped name or path. Raises SimulationError."""
    shipped = shipped_worlds()
    path = shipped.get(world) or Path(world).expanduser()
    if path.is_file():
        return path
    raise SimulationError(
        f"world '{world}': neither a file nor a shipped world{did_you_mean(world, [*shipped])}; "
        f'shipped are: {", ".join(shipped)}'
    )


def _executables_below(folder: Path) -> Iterator[Path]:
    for path, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith('.')]
        yield from (file for name in files if _is_executable(file := Path(path, name)))


def _is_executable(path: Path) -> bool:
    return path.is_file() and os.access(path, os.X_OK)
