# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""List all interface types available."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.interface.kinds import add_kind_arguments, kind_of, wanted_kinds

_TITLES = {'msg': 'Messages:', 'srv': 'Services:', 'action': 'Actions:'}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_kind_arguments(parser)


def main(args: Namespace) -> int:
    """Print the types, sorted, below a heading for each kind; 0."""
    from amr_description.cli.interface.index import all_interfaces

    known = all_interfaces()
    for kind in wanted_kinds(args):
        print(_TITLES[kind])
        for package, names in known.items():
            for name in names:
                if kind_of(name) == kind:
                    print(f'    {package}/{name}')
    return 0
