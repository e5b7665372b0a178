# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Fill the tree that is laid over a prefix: ``lib/ share/ include/`` and ``python/<package>``."""

from pathlib import Path

from amr_description.interface_build import records
from amr_description.interface_build.generators import (
    GeneratedPackage,
    TYPE_DESCRIPTION,
    TYPESUPPORTS,
)

CMAKE_CONFIG = """\
# find_package({name}): its messages are found; there is nothing to compile C++ with.
set({name}_FOUND TRUE)
set({name}_FOUND_AMENT_PACKAGE TRUE)
"""


def stage_package(package: GeneratedPackage, stage: Path) -> None:
    """Copy what a ROS installation holds of ``package``, beside its libraries."""
    _stage_share(package, stage / 'share' / package.name)
    _stage_index(package, stage / 'share' / 'ament_index' / 'resource_index')
    config = stage / 'share' / package.name / 'cmake' / f'{package.name}Config.cmake'
    records.write_if_different(config, CMAKE_CONFIG.format(name=package.name))
    _copy_tree(package.generated('rosidl_generator_py'), stage / 'python' / package.name, '*.py')
    for generator in ('rosidl_generator_c', *TYPESUPPORTS):  # to build other packages on top
        target = stage / 'include' / package.name / package.name
        _copy_tree(package.generated(generator), target, '*.h')


def _stage_share(package: GeneratedPackage, share: Path) -> None:
    """Copy the manifest and, per interface, its source, its ``.idl`` and its description."""
    descriptions = package.generated(TYPE_DESCRIPTION)
    for path in package.source.interfaces:
        records.copy_if_different(package.source.folder / path, share / path)
        for root, suffix in ((package.idl, '.idl'), (descriptions, '.json')):
            file = path.with_suffix(suffix)
            records.copy_if_different(root / file, share / file)
    records.copy_if_different(package.source.folder / 'package.xml', share / 'package.xml')


def _stage_index(package: GeneratedPackage, index: Path) -> None:
    """Write the ament index entries that the ROS tools look packages and interfaces up by."""
    listed = sorted(
        {
            file.as_posix()
            for path in package.source.interfaces
            for file in (path, path.with_suffix('.idl'))
        }
    )
    entries = {
        'packages': '',
        'package_run_dependencies': ';'.join(sorted(package.source.depends)),
        'rosidl_interfaces': '\n'.join(listed),
    }
    for resource, text in entries.items():
        records.write_if_different(index / resource / package.name, text)


def _copy_tree(source: Path, target: Path, pattern: str) -> None:
    """Copy the files that match ``pattern``, keeping their folders."""
    for path in source.rglob(pattern):
        records.copy_if_different(path, target / path.relative_to(source))
