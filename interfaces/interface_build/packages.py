# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What there is to build: the interface packages of a folder, in dependency order."""

from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
import xml.etree.ElementTree as ElementTree

from interface_build import BuildError

KINDS = ('msg', 'srv', 'action')

# What a generated service or action refers to, whether package.xml names it or not.
IMPLIED_BY_SERVICES = {'builtin_interfaces', 'service_msgs'}
IMPLIED_BY_ACTIONS = IMPLIED_BY_SERVICES | {'action_msgs', 'unique_identifier_msgs'}


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


def read_package(folder: Path) -> InterfacePackage:
    """Read one package; raise :class:`BuildError` when its manifest or its files are unusable."""
    manifest = folder / 'package.xml'
    try:
        name = ElementTree.parse(manifest).getroot().findtext('name', '').strip()
    except ElementTree.ParseError as error:
        raise BuildError(f'{manifest}: not well-formed XML: {error}') from None
    if name != folder.name:
        raise BuildError(
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
        raise BuildError(f'{folder}: no interface found (msg/*.msg, srv/*.srv, action/*.action)')
    return InterfacePackage(name, folder, manifest_dependencies(manifest), interfaces)


def find_packages(root: Path) -> list[InterfacePackage]:
    """Return the packages in the direct subfolders of ``root``, dependencies first."""
    packages = {
        manifest.parent.name: read_package(manifest.parent)
        for manifest in sorted(root.glob('*/package.xml'))
    }
    if not packages:
        raise BuildError(f'{root}: no folder with a package.xml')
    graph = {name: sorted(package.needed & packages.keys()) for name, package in packages.items()}
    try:
        return [packages[name] for name in TopologicalSorter(graph).static_order()]
    except CycleError as error:
        raise BuildError(f'packages need each other: {" -> ".join(error.args[1])}') from None


def interface_dependencies(
    package: InterfacePackage, packages: list[InterfacePackage], prefix: Path
) -> list[str]:
    """
    Return every interface package that ``package`` reaches, sorted by name.

    Looked up among ``packages``, then in ``prefix`` (``lib/`` and ``share/`` of the installed
    ones); a name that is no interface package (a build tool, say) is passed over.
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
        elif (prefix / 'lib' / f'lib{name}__rosidl_generator_c.so').exists():
            found.add(name)
            pending |= manifest_dependencies(prefix / 'share' / name / 'package.xml')
    return sorted(found - {package.name})
