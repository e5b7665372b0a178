# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available interface types within one package."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.interface.kinds import add_kind_arguments, kind_of, wanted_kinds


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_kind_arguments(parser)
    parser.add_argument('package_name', help="Name of the ROS package (e.g. 'example_interfaces')")


def main(args: Namespace) -> int:
    """Print one type per line; 0."""
    from amr_description.cli.interface.index import interfaces_of

    kinds = wanted_kinds(args)
    for name in interfaces_of(args.package_name):
        if kind_of(name) in kinds:
            print(f'{args.package_name}/{name}')
    return 0
