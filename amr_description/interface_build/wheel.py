# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Interface packages as a wheel: for those without colcon, and for a package index."""

import base64
from collections.abc import Iterator, Sequence
import hashlib
import os
from pathlib import Path
import re
import sys
import sysconfig
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build import build, definitions, packages
from amr_description.interface_build.packages import InterfacePackage

IGNORED = {'build', 'install', 'log'}
MARKERS = ('COLCON_IGNORE', 'AMENT_IGNORE')
METADATA = """\
Metadata-Version: 2.1
Name: {name}
Version: {version}
Summary: ROS 2 interface packages: {packages}
Requires-Python: ==3.{minor}.*
"""
WHEEL = """\
Wheel-Version: 1.0
Generator: amr_description
Root-Is-Purelib: false
Tag: {tag}
"""


def find_interface_packages(root: Path) -> list[InterfacePackage]:
    """
    Return the packages with interfaces that are ``root`` or below it, dependencies first.

    Raises:
        InterfaceBuildError: there is none, or one cannot be read.
    """
    found = []
    for folder, folders, files in os.walk(root):
        if set(files) & set(MARKERS):
            folders.clear()
        elif 'package.xml' in files:
            folders.clear()
            if any(any(Path(folder).glob(f'{kind}/*.{kind}')) for kind in packages.KINDS):
                found.append(packages.read_package(Path(folder), any_folder=True))
        folders[:] = sorted(set(folders) - IGNORED)
        folders[:] = [name for name in folders if not name.startswith('.')]
    if not found:
        kinds = ', '.join(f'{kind}/*.{kind}' for kind in packages.KINDS)
        raise InterfaceBuildError(f'{root}: no package.xml with interfaces beside it ({kinds})')
    return packages.in_order(found)


def check(found: Sequence[InterfacePackage], known: dict[str, frozenset[str]]) -> None:
    """Raise InterfaceBuildError with a line for each fault of the first package that has any."""
    for package in found:
        definitions.check_package(package, known).raise_faults(package.folder)
        messages = (path.stem for path in package.interfaces if path.suffix == '.msg')
        known = {**known, package.name: frozenset(messages)}


def build_wheel(root: Path, output: Path, name: str = '') -> Path:
    """
    Build the interface packages at or below ``root``; return the wheel.

    Args:
        root: a package, or a folder of packages.
        output: the folder for the wheel; made if it is not there.
        name: of the wheel; '': that of the package, or of the folder of several.

    Raises:
        InterfaceBuildError: with a line for each fault.
        OSError: ``output`` cannot be written.
    """
    found = find_interface_packages(root)
    underlay = packages.find_underlay(Path(sys.prefix))
    check(found, definitions.installed_messages(underlay))
    with tempfile.TemporaryDirectory(prefix='interface_build-') as folder:
        stage = Path(folder, 'stage')
        build.build_packages(found, underlay, build.Target(stage, Path(folder, 'work')), print)
        name = name or (found[0].name if len(found) == 1 else f'{root.resolve().name}_interfaces')
        version = max((_version(package) for package in found), key=_numbers)
        output.mkdir(parents=True, exist_ok=True)
        return write_wheel(stage, output, name, version)


def _version(package: InterfacePackage) -> str:
    root = ElementTree.parse(package.folder / 'package.xml').getroot()
    return root.findtext('version', '0.0.0').strip()


def _numbers(version: str) -> list[int]:
    return [int(number) for number in re.findall(r'\d+', version)]


def write_wheel(stage: Path, output: Path, name: str, version: str) -> Path:
    """Write the wheel of a staged tree into the folder ``output``; return its path."""
    name = re.sub(r'[-_.]+', '_', name).lower()
    python = f'cp{sys.version_info.major}{sys.version_info.minor}'
    tag = f'{python}-{python}-{re.sub("[-.]", "_", sysconfig.get_platform())}'
    staged = sorted(path.name for path in (stage / 'python').iterdir())
    metadata = METADATA.format(
        name=name, version=version, packages=', '.join(staged), minor=sys.version_info.minor
    )
    info = f'{name}-{version}.dist-info'
    contents = dict(_contents(stage, f'{name}-{version}.data/data'))
    contents[f'{info}/METADATA'] = metadata.encode()
    contents[f'{info}/WHEEL'] = WHEEL.format(tag=tag).encode()
    record = ''.join(f'{path},{_checksum(data)},{len(data)}\n' for path, data in contents.items())
    contents[f'{info}/RECORD'] = f'{record}{info}/RECORD,,\n'.encode()
    wheel = output / f'{name}-{version}-{tag}.whl'
    unfinished = wheel.with_suffix('.unfinished')
    with zipfile.ZipFile(unfinished, 'w', zipfile.ZIP_DEFLATED) as archive:
        for path, data in contents.items():
            archive.writestr(zipfile.ZipInfo(path), data, zipfile.ZIP_DEFLATED)
    return unfinished.replace(wheel)


def _contents(stage: Path, prefix: str) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of each staged file, as a wheel holds them."""
    for path in sorted(stage.rglob('*')):
        if path.is_file():
            top, *rest = path.relative_to(stage).parts
            place = '/'.join(rest) if top == 'python' else '/'.join([prefix, top, *rest])
            yield place, path.read_bytes()


def _checksum(data: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest())
    return f'sha256={digest.decode().rstrip("=")}'
