# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Completions from what is installed, without the graph."""

from argparse import Namespace
from collections.abc import Iterable
import sys
from typing import Any

from amr_description.ament_index import executables_of, packages as installed_packages


def packages(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return every package."""
    return installed_packages()


def run_packages(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the packages with executables, and those that ours replace."""
    from amr_description.stand_ins import STAND_INS

    folders = installed_packages().items()
    runnable = (name for name, prefix in folders if (prefix / 'lib' / name).is_dir())
    return {*runnable, *(package for package, _ in STAND_INS)}


def executables(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the executables of the package on the line."""
    from amr_description.stand_ins import STAND_INS

    if args.package_name in installed_packages():
        return [path.name for path in executables_of(args.package_name)]
    return [name for package, name in STAND_INS if package == args.package_name]


def launch_packages(_args: Namespace, prefix: str) -> Iterable[str]:
    """Return the packages with stacks or launch files, and files that may be one."""
    from argcomplete.completers import FilesCompleter

    from amr_description.cli.launch_files import launchable_names, MARKUP

    endings = [ending.removeprefix('.') for ending in ('.py', *MARKUP)]
    known = (name for name in installed_packages() if launchable_names(name))
    return [*known, *FilesCompleter(endings)(prefix=prefix)]


def launch_files(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the stacks and launch files of the package on the line."""
    from amr_description.cli.launch_files import launchable_names

    return launchable_names(args.package_name)


def launch_arguments(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the arguments of the stack on the line, ``name:=``."""
    from amr_description.bringup.arguments import declared
    from amr_description.bringup.stack_files import find_stack
    from amr_description.cli.launch_files import find_launch_file

    stack, _ = find_launch_file(args.package_name, args.launch_file_name, [])
    return [f'{argument.name}:=' for argument in declared(find_stack(stack))]


def files(_args: Namespace, prefix: str) -> Iterable[str]:
    """Return files and folders."""
    from argcomplete.completers import FilesCompleter

    return FilesCompleter()(prefix=prefix)


def folders(_args: Namespace, prefix: str) -> Iterable[str]:
    """Return folders."""
    from argcomplete.completers import DirectoriesCompleter

    return DirectoriesCompleter()(prefix=prefix)


def licenses(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the licenses whose text is here."""
    from amr_description.cli.pkg.licenses import LICENSES

    return LICENSES


def nothing(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return no word: a new name is typed."""
    return ()


def interfaces(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return every ``package/msg/Name``, services and actions included."""
    from amr_description.cli.interface.index import all_interfaces

    return [f'{package}/{name}' for package, names in all_interfaces().items() for name in names]


def interface_packages(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the packages that define interfaces."""
    from amr_description.cli.interface.index import all_interfaces

    return all_interfaces()


def message(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the fields of the message type on the line, with their defaults."""
    from amr_description.ros.message_types import message_type

    return [_fields(message_type(args.message_type)())]


def request(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the fields of the request of the service type on the line, with their defaults."""
    from amr_description.ros.message_types import service_type

    return [_fields(service_type(args.service_type).Request())]


def _fields(value: Any) -> str:
    """Return YAML on one line, as it would be typed."""
    import yaml

    from amr_description.ros.message_text import to_yaml

    fields = yaml.safe_load(to_yaml(value))
    return yaml.safe_dump(
        fields, default_flow_style=True, sort_keys=False, width=sys.maxsize
    ).strip()
