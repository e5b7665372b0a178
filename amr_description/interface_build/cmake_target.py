# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Build the interfaces of a package of a workspace; called by ``rosidl_generate_interfaces.cmake``.

It runs whenever the package is built, and does nothing when what the package is made of is as it
was at the last build: its definitions, the messages of others that these refer to, this program.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
import json
import os
from pathlib import Path
import shutil
import sys
import traceback

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build import records
from amr_description.interface_build.packages import (
    find_underlay,
    interface_dependencies,
    InterfacePackage,
    KINDS,
    manifest_dependencies,
    Underlay,
)
from amr_description.text import one_line

FAILED = 1


@dataclass(frozen=True)
class Request:
    """What CMake asks for."""

    name: str
    source: Path
    """The folder of the package."""
    build: Path
    """The folder for all that is made."""
    install: Path
    """The prefix that it will be installed to."""
    interfaces: tuple[tuple[Path, Path], ...]
    """The folder of each interface file, and its path there: ``msg/Name.msg``."""
    dependencies: frozenset[str]
    """What CMakeLists.txt names behind DEPENDENCIES."""

    @property
    def stage(self) -> Path:
        """The tree that CMake installs."""
        return self.build / 'stage'

    @property
    def files(self) -> list[Path]:
        """All definitions."""
        return [folder / path for folder, path in self.interfaces]


def read_request(text: str) -> Request:
    """Read lines of ``key=value``, as the CMake function writes them."""
    values: dict[str, list[str]] = {}
    for line in text.splitlines():
        key, _, value = line.partition('=')
        values.setdefault(key, []).append(value)
    source = Path(values['source'][0])
    interfaces = []
    for value in values['interface']:
        folder, is_tuple, path = value.rpartition(':')
        interfaces.append((Path(folder) if is_tuple else source, Path(path)))
    return Request(
        name=values['name'][0],
        source=source,
        build=Path(values['build'][0]),
        install=Path(values['install'][0]),
        interfaces=tuple(interfaces),
        dependencies=frozenset(values.get('dependency', [])),
    )


def key(
    request: Request, text: str, used: Iterable[tuple[str, str]], prefixes: Iterable[Path]
) -> str:
    """
    Return the hash of all that the package is made of.

    Args:
        request: what CMake asks for.
        text: the request as it was written.
        used: package and name of the messages of other packages that it refers to.
        prefixes: where these are, the first one first.
    """
    places = [*prefixes, Path(sys.prefix)]
    described: list[str | bytes] = []
    for package, name in sorted(used):
        candidates = (prefix / 'share' / package / 'msg' / f'{name}.json' for prefix in places)
        found = next((file for file in candidates if file.exists()), None)
        described += [package, name, found.read_bytes() if found else b'']
    programs = sorted(Path(__file__).parent.glob('*.py'))
    generators = Path(sys.prefix, 'share', 'rosidl_generator_c', 'package.xml')
    files = [*programs, generators, request.source / 'package.xml', *request.files]
    return records.digest(text, *(file.read_bytes() for file in files), *described)


def build(request: Request, text: str, prefixes: Sequence[Path]) -> bool:
    """
    Bring the package up to date; say whether there was anything to do.

    Args:
        request: what CMake asks for.
        text: the request as it was written.
        prefixes: those of packages that are installed, the first one first.

    Raises:
        InterfaceBuildError: with a line for each fault.
    """
    stamp, asked = request.build / 'built.json', request.build / 'asked'
    try:
        made_of, found = json.loads(stamp.read_text())
        used = [(package, name) for package, name in found]
    except (OSError, ValueError):
        made_of, used = '', []
    if request.stage.is_dir() and key(request, text, used, prefixes) == made_of:
        return False
    stamp.unlink(missing_ok=True)
    if not asked.is_file() or asked.read_text() != text:
        for folder in (request.stage, request.build / 'work', request.build / 'definitions'):
            shutil.rmtree(folder, ignore_errors=True)
        records.write_if_different(asked, text)
    used = sorted(_build(request, prefixes))
    stamp.write_text(json.dumps([key(request, text, used, prefixes), used]))
    return True


def _build(request: Request, prefixes: Sequence[Path]) -> frozenset[tuple[str, str]]:
    """Build; return the messages of other packages that were used."""
    from amr_description.interface_build import build as building, definitions

    found = find_underlay(Path(sys.prefix), prefixes)
    others = {name: prefix for name, prefix in found.prefixes.items() if name != request.name}
    underlay = Underlay(found.wheels, others)
    package = _package(request)
    check = definitions.check_package(package, definitions.installed_messages(underlay))
    check.raise_faults(package.folder)
    _check_dependencies(request, {name for name, _ in check.used}, underlay)
    reached = interface_dependencies(package, [package], underlay)
    places = dict.fromkeys(others[name] for name in reached)
    lib = request.install / 'lib'
    run_path = [
        os.path.relpath(place / 'lib', lib)
        for place in places
        if place not in (request.install, underlay.wheels)
    ]
    target = building.Target(request.stage, request.build / 'work', run_path)
    building.build_packages([package], underlay, target, lambda line: print(line, flush=True))
    return check.used


def _package(request: Request) -> InterfacePackage:
    """Return the package; definitions of several folders are put into one."""
    depends = manifest_dependencies(request.source / 'package.xml') | request.dependencies
    paths = tuple(path for _, path in request.interfaces)
    for path in paths:
        if path.parent.as_posix() not in KINDS:
            raise InterfaceBuildError(
                f'{request.source}/CMakeLists.txt: {path} is not in msg/, srv/ or action/'
            )
    folder = request.source
    if any(base != request.source for base, _ in request.interfaces):
        folder = request.build / 'definitions'
        for base, path in request.interfaces:
            records.copy_if_different(base / path, folder / path)
        records.copy_if_different(request.source / 'package.xml', folder / 'package.xml')
    return InterfacePackage(request.name, folder, depends, paths)


def _check_dependencies(request: Request, used: set[str], underlay: Underlay) -> None:
    """Raise InterfaceBuildError for packages that CMakeLists.txt does not name."""
    named = InterfacePackage('', Path(), request.dependencies, ())
    known = {*interface_dependencies(named, [], underlay), 'builtin_interfaces'}
    missing = sorted(used - known)
    if missing:
        raise InterfaceBuildError(
            f'{request.source}/CMakeLists.txt: the messages use {", ".join(missing)}: name it in '
            'rosidl_generate_interfaces(... DEPENDENCIES ...), and in package.xml'
        )


def main(args: Sequence[str]) -> int:
    """Run the program: its argument is the file of the request; return the exit code."""
    text = Path(args[0]).read_text()
    prefixes = [Path(each) for each in os.environ.get('AMENT_PREFIX_PATH', '').split(':') if each]
    request = read_request(text)
    # Of Ninja's output, in which its own words are too, workspace/cmake.py could not tell them.
    faults = request.build / 'faults'
    faults.unlink(missing_ok=True)
    try:
        build(request, text, prefixes)
    except InterfaceBuildError as error:
        return _report(f'{error}\n', faults)
    except Exception as error:  # of rosidl, whose parts have no common base
        log = request.build / 'failure.log'
        log.write_text(traceback.format_exc())
        what = one_line(f'{type(error).__name__}: {error}')
        return _report(f'{request.source}: rosidl fails: {what}; where: {log}\n', faults)
    return 0


def _report(text: str, faults: Path) -> int:
    """Write why it failed; return the exit code."""
    sys.stderr.write(text)
    faults.write_text(text)
    return FAILED
