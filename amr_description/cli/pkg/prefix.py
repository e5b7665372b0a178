# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output the prefix path of a package."""

from argparse import ArgumentParser, Namespace

from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('package_name', help='The package name')
    parser.add_argument(
        '--share', action='store_true', help='Show share directory for the package'
    )


def main(args: Namespace) -> int:
    """Print the prefix; 0."""
    from amr_description.ament_index import packages

    prefix = packages().get(args.package_name)
    if prefix is None:
        raise AmrError('Package not found')
    print(prefix / 'share' / args.package_name if args.share else prefix)
    return 0
