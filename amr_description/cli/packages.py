# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Packages and their executables, from the ament index of ``AMENT_PREFIX_PATH``."""

from collections.abc import Iterator
import os
from pathlib import Path

from ament_index_python import get_package_prefix, get_packages_with_prefixes
from ament_index_python.packages import PackageNotFoundError

from amr_description.cli.excerpt import excerpt
from amr_description.errors import AmrError

_VARIABLE = 'AMENT_PREFIX_PATH'


def packages() -> dict[str, Path]:
    """Return the prefix of each package, sorted by name."""
    if not os.environ.get(_VARIABLE):
        return {}
    return {name: Path(prefix) for name, prefix in sorted(get_packages_with_prefixes().items())}


def prefix_of(package: str) -> Path:
    """Return the prefix of a package. Raises AmrError."""
    if not os.environ.get(_VARIABLE):
        raise AmrError(
            f"Package '{excerpt(package)}' not found: {_VARIABLE} is not set; source "
            'scripts/activate, or the setup.bash of the workspace, first'
        )
    try:
        return Path(get_package_prefix(package))
    except (PackageNotFoundError, ValueError) as error:
        raise AmrError(f"Package '{excerpt(package)}' not found") from error


def executables_of(package: str) -> list[Path]:
    """Return the executables of a package, sorted: what may be executed in ``lib/<package>``."""
    return sorted(_executables_below(prefix_of(package) / 'lib' / package))


def _executables_below(folder: Path) -> Iterator[Path]:
    for path, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith('.')]
        for name in files:
            file = Path(path, name)
            if os.access(file, os.X_OK):
                yield file
