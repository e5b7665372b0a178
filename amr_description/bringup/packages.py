# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where packages are: the ament index of the folders in ``AMENT_PREFIX_PATH``."""

import os
from pathlib import Path

from amr_description.bringup.arguments import suggestion
from amr_description.errors import BringupError


def prefixes() -> list[Path]:
    """Return the install folders that the sourced underlay and workspaces announce."""
    return [Path(p) for p in os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep) if p]


def is_installed(package: str) -> bool:
    """Tell whether a package is in the ament index."""
    return any(_has(prefix, package) for prefix in prefixes())


def package_prefix(package: str) -> Path:
    """Return the folder that a package is installed in."""
    for prefix in prefixes():
        if _has(prefix, package):
            return prefix
    if not prefixes():
        raise BringupError(
            f"Package '{package}' not found: AMENT_PREFIX_PATH is empty; source scripts/activate "
            'or the setup.bash of the workspace first'
        )
    searched = ', '.join(map(str, prefixes()))
    raise BringupError(f"Package '{package}' not found, searching: {searched}")


def _has(prefix: Path, package: str) -> bool:
    return (prefix / 'share/ament_index/resource_index/packages' / package).is_file()


def executable_of(package: str, name: str) -> Path:
    """Return the path of an executable, ``<prefix>/lib/<package>/<name>``."""
    folder = package_prefix(package) / 'lib' / package
    path = folder / name
    if _is_executable(path):
        return path
    known = sorted(p.name for p in folder.glob('*') if _is_executable(p))
    raise BringupError(
        f"executable '{name}' not found on the libexec directory '{folder}'"
        + suggestion(name, known)
    )


def _is_executable(path: Path) -> bool:
    return path.is_file() and os.access(path, os.X_OK)


def path_of(file: str) -> Path:
    """
    Return the absolute path of a file that exists.

    :param file: ``package://<package>/<path below its share folder>``, or an ordinary path.
    """
    if file.startswith('package://'):
        package, _, below = file.removeprefix('package://').partition('/')
        path = package_prefix(package) / 'share' / package / below
    else:
        path = Path(file).expanduser().absolute()
    if not path.is_file():
        found = 'that is a folder' if path.is_dir() else 'there is no such file'
        raise BringupError(f"'{file}' asked for, {found} at {path}")
    return path
