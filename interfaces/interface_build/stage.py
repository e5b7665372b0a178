# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Fill the tree that is laid over a prefix: ``lib/ share/ include/`` and ``python/<package>``."""

from pathlib import Path
import shutil

from interface_build.generators import GeneratedPackage, TYPE_DESCRIPTION, TYPESUPPORTS


def stage_package(package: GeneratedPackage, stage: Path) -> None:
    """Copy what a ROS installation holds of ``package``, beside its libraries."""
    _stage_share(package, stage / 'share' / package.name)
    _stage_index(package, stage / 'share' / 'ament_index' / 'resource_index')
    _copy_tree(package.generated('rosidl_generator_py'), stage / 'python' / package.name, '*.py')
    for generator in ('rosidl_generator_c', *TYPESUPPORTS):  # to build other packages on top
        target = stage / 'include' / package.name / package.name
        _copy_tree(package.generated(generator), target, '*.h')


def _stage_share(package: GeneratedPackage, share: Path) -> None:
    """Copy the manifest and, per interface, its source, its ``.idl`` and its description."""
    descriptions = package.generated(TYPE_DESCRIPTION)
    for path in package.source.interfaces:
        (share / path.parent).mkdir(parents=True, exist_ok=True)
        shutil.copy(package.source.folder / path, share / path)
        for root, suffix in ((package.idl, '.idl'), (descriptions, '.json')):
            shutil.copy(root / path.with_suffix(suffix), share / path.with_suffix(suffix))
    shutil.copy(package.source.folder / 'package.xml', share)


def _stage_index(package: GeneratedPackage, index: Path) -> None:
    """Write the ament index entries that the ROS tools look packages and interfaces up by."""
    listed = sorted(
        file.as_posix()
        for path in package.source.interfaces
        for file in (path, path.with_suffix('.idl'))
    )
    entries = {
        'packages': '',
        'package_run_dependencies': ';'.join(sorted(package.source.depends)),
        'rosidl_interfaces': '\n'.join(listed),
    }
    for resource, text in entries.items():
        (index / resource).mkdir(parents=True, exist_ok=True)
        (index / resource / package.name).write_text(text)


def _copy_tree(source: Path, target: Path, pattern: str) -> None:
    """Copy the files that match ``pattern``, keeping their folders."""
    for path in source.rglob(pattern):
        copy = target / path.relative_to(source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, copy)
