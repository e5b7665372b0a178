# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of package specific executables."""

from argparse import ArgumentParser, Namespace


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('package_name', nargs='?', help='The package name')
    parser.add_argument('--full-path', action='store_true', help='Show full path of executables')


def main(args: Namespace) -> int:
    """Print one executable per line, of one package or of all; 0."""
    from amr_description.ament_index import executables_of, packages

    for package in [args.package_name] if args.package_name else packages():
        for path in executables_of(package):
            print(path if args.full_path else f'{package} {path.name}')
    return 0
