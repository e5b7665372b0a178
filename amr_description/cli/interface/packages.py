# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of packages that provide interfaces."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.interface.kinds import add_kind_arguments, kind_of, wanted_kinds


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_kind_arguments(parser)


def main(args: Namespace) -> int:
    """Print one package per line; 0."""
    from amr_description.cli.interface.index import all_interfaces

    kinds = wanted_kinds(args)
    for package, names in all_interfaces().items():
        if any(kind_of(name) in kinds for name in names):
            print(package)
    return 0
