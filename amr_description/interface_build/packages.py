# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What there is to build: the interface packages of a folder, in dependency order."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
import xml.etree.ElementTree as ElementTree

from amr_description.errors import InterfaceBuildError

KINDS = ('msg', 'srv', 'action')

# What a generated service or action refers to, whether package.xml names it or not.
IMPLIED_BY_SERVICES = {'builtin_interfaces', 'service_msgs'}
IMPLIED_BY_ACTIONS = IMPLIED_BY_SERVICES | {'action_msgs', 'unique_identifier_msgs'}


@dataclass(frozen=True)
class Underlay:
    """What is built against: the ROS of PyPI, and interface packages that are installed."""

    wheels: Path
    """The prefix of the ROS of PyPI."""
    prefixes: Mapping[str, Path]
    """The prefix of each interface package, by its name."""

    def share(self, name: str) -> Path:
        """Return the folder of a package's definitions and descriptions."""
        return self.prefixes[name] / 'share' / name

    @property
    def library_folders(self) -> tuple[Path, ...]:
        """Where shared libraries are, each folder once."""
        return tuple(dict.fromkeys(each / 'lib' for each in (*self.overlays, self.wheels)))

    @property
    def overlays(self) -> tuple[Path, ...]:
        """The prefixes beside that of the wheels, each once."""
        found = dict.fromkeys(self.prefixes.values())
        return tuple(prefix for prefix in found if prefix != self.wheels)


def find_underlay(wheels: Path, prefixes: Iterable[Path] = ()) -> Underlay:
    """Return the interface packages below ``prefixes``, the first one first, and the wheels."""
    found: dict[str, Path] = {}
    for prefix in (*prefixes, wheels):
        for share in sorted(prefix.glob('share/*')):
            library = prefix / 'lib' / f'lib{share.name}__rosidl_generator_c.so'
            if library.exists() and any((share / kind).is_dir() for kind in KINDS):
                found.setdefault(share.name, prefix)
    return Underlay(wheels, found)


@dataclass(frozen=True)
class InterfacePackage:
    """A folder with a ``package.xml``, and interface files in ``msg/``, ``srv/``, ``action/``."""

    name: str
    folder: Path
    depends: frozenset[str]
    """Names of all the packages that the manifest needs to build or to run."""
    interfaces: tuple[Path, ...]
    """Relative to ``folder``: ``msg/TFMessage.msg``."""

    @property
    def needed(self) -> frozenset[str]:
        """``depends`` and what its services and actions imply."""
        kinds = {path.suffix for path in self.interfaces}
        implied = IMPLIED_BY_ACTIONS if '.action' in kinds else set()
        implied |= IMPLIED_BY_SERVICES if '.srv' in kinds else set()
        return (self.depends | implied) - {self.name}


def manifest_dependencies(manifest: Path) -> frozenset[str]:
    """Return the names that a ``package.xml`` needs when building against it or running."""
    root = ElementTree.parse(manifest).getroot()
    tags = ('depend', 'build_depend', 'build_export_depend', 'exec_depend')
    return frozenset(
        element.text.strip() for tag in tags for element in root.iter(tag) if element.text
    )


def read_package(folder: Path, *, any_folder: bool = False) -> InterfacePackage:
    """
    Read one package.

    Args:
        folder: of its ``package.xml``.
        any_folder: the folder may be called otherwise than the package.

    Raises:
        InterfaceBuildError: its manifest or its files are unusable.
    """
    manifest = folder / 'package.xml'
    try:
        name = ElementTree.parse(manifest).getroot().findtext('name', '').strip()
    except ElementTree.ParseError as error:
        raise InterfaceBuildError(f'{manifest}: not well-formed XML: {error}') from None
    if not name or (name != folder.name and not any_folder):
        raise InterfaceBuildError(
            f'{manifest}: the package is called {name!r}, its folder {folder.name!r};'
            ' give both the same name'
        )
    interfaces = tuple(
        path.relative_to(folder)
        for kind in KINDS
        for path in sorted(folder.glob(f'{kind}/*'))
        if path.suffix == f'.{kind}'
    )
    if not interfaces:
        raise InterfaceBuildError(
            f'{folder}: no interface found (msg/*.msg, srv/*.srv, action/*.action)'
        )
    return InterfacePackage(name, folder, manifest_dependencies(manifest), interfaces)


def find_packages(root: Path) -> list[InterfacePackage]:
    """Return the packages in the direct subfolders of ``root``, dependencies first."""
    found = [read_package(manifest.parent) for manifest in sorted(root.glob('*/package.xml'))]
    if not found:
        raise InterfaceBuildError(f'{root}: no folder with a package.xml')
    return in_order(found)


def in_order(found: Iterable[InterfacePackage]) -> list[InterfacePackage]:
    """Return packages dependencies first; raise InterfaceBuildError if they need each other."""
    packages = {package.name: package for package in found}
    graph = {name: sorted(package.needed & packages.keys()) for name, package in packages.items()}
    try:
        return [packages[name] for name in TopologicalSorter(graph).static_order()]
    except CycleError as error:
        raise InterfaceBuildError(
            f'packages need each other: {" -> ".join(error.args[1])}'
        ) from None


def interface_dependencies(
    package: InterfacePackage, packages: Sequence[InterfacePackage], underlay: Underlay
) -> list[str]:
    """
    Return every interface package that ``package`` reaches, sorted by name.

    Looked up among ``packages``, then among the installed ones; a name that is no interface
    package (a build tool, say) is passed over.
    """
    ours = {other.name: other for other in packages}
    pending, found = set(package.needed), set()
    while pending:
        name = pending.pop()
        if name in found:
            continue
        if name in ours:
            found.add(name)
            pending |= ours[name].needed
        elif name in underlay.prefixes:
            found.add(name)
            pending |= manifest_dependencies(underlay.share(name) / 'package.xml')
    return sorted(found - {package.name})
