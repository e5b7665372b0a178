# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Write the messages of several bags into one, by their times.

example:
  ros2 bag merge first_bag second_bag -o both
"""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from amr_description.cli.bag.inputs import add_output_arguments, existing_path, open_bags


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('bag_paths', nargs='+', type=existing_path, help='Bags to open.')
    add_output_arguments(parser)


def main(args: Namespace) -> int:
    """Write the bag; return 0."""
    from amr_description.bag.rewriting import Output
    from amr_description.cli.bag.outputs import write

    with open_bags([(Path(path), None) for path in args.bag_paths]) as readers:
        return write(readers, args, Output(Path()))
