# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which interfaces the packages of the ament index define, and in which files."""

from collections.abc import Mapping
import os
from pathlib import Path

from ament_index_python import get_resource, get_resources

from amr_description.ament_index import packages
from amr_description.cli.interface.definition import InterfaceText, kind_of, KINDS
from amr_description.errors import AmrError
from amr_description.text import did_you_mean, shorten

_RESOURCE = 'rosidl_interfaces'  # registered by rosidl for each package with interfaces


def all_interfaces() -> Mapping[str, list[str]]:
    """Return the interfaces of every package that has any, both sorted."""
    known = get_resources(_RESOURCE) if packages() else {}
    return {package: _interfaces(package) for package in sorted(known)}


def interfaces_of(package: str) -> list[str]:
    """Return the interfaces of a package, ``msg/Name``, sorted. Raises AmrError."""
    if package not in packages():
        raise _unknown_package(package)
    try:
        return _interfaces(package)
    except LookupError:
        return []


def read_definition(name: str) -> InterfaceText:
    """Return the definition of ``package/msg/Name``. Raises AmrError."""
    path = _path(name)
    try:
        text = path.read_text(encoding='utf-8', errors='replace')
    except OSError as error:
        raise AmrError(f"The interface '{path}' cannot be read: {error.strerror}") from error
    return InterfaceText(text, idl=path.suffix == '.idl')


def split_name(name: str) -> tuple[str, str, str]:
    """Return the parts of ``package/msg/Name``. Raises AmrError."""
    parts = name.split('/')
    if len(parts) != 3:
        expected = "Expected three parts separated by '/'"
        raise AmrError(f"Invalid name '{shorten(name)}'. {expected}{_completed(parts)}")
    package, kind, interface = parts
    if kind not in KINDS:
        expected = f'Expected its second part to be one of {", ".join(KINDS)}'
        raise AmrError(f"Invalid name '{shorten(name)}'. {expected}")
    return package, kind, interface


def _path(name: str) -> Path:
    """Return the source file of an interface; if there is none, the .idl generated from it."""
    package, kind, interface = split_name(name)
    prefix = packages().get(package)
    if prefix is None:
        raise _unknown_package(package)
    folder = prefix / 'share' / package / kind
    for path in (folder / f'{interface}.{kind}', folder / f'{interface}.idl'):
        if path.is_file():
            return path
    known = [n.partition('/')[2] for n in interfaces_of(package) if kind_of(n) == kind]
    similar = did_you_mean(interface, known, f'{package}/{kind}/')
    raise AmrError(f"Could not find the interface '{shorten(str(path))}'{similar}")


def _interfaces(package: str) -> list[str]:
    """Return its interfaces and files. Raises LookupError if it defines none."""
    content, _ = get_resource(_RESOURCE, package)
    found = {os.path.splitext(line.strip())[0] for line in content.splitlines()}
    return sorted(name for name in found if kind_of(name) in KINDS and '_' not in name)


def _completed(parts: list[str]) -> str:
    """Return a hint for a name without its middle, as older tools write it."""
    if len(parts) != 2 or parts[0] not in packages():
        return ''
    full = [name for name in interfaces_of(parts[0]) if name.endswith(f'/{parts[1]}')]
    return f'; did you mean {" or ".join(f"{parts[0]}/{name}" for name in full)}?' if full else ''


def _unknown_package(package: str) -> AmrError:
    known = packages()
    hint = did_you_mean(package, known) if known else '; source scripts/activate first'
    return AmrError(f"Unknown package '{shorten(package)}'{hint}")
