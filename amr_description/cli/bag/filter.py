# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Write some topics of a bag into another.

examples:
  ros2 bag filter my_bag -o without_images --exclude-regex '/camera/.*'
  ros2 bag filter my_bag -o transforms --topics /tf /tf_static
"""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from amr_description.cli.bag.inputs import (
    add_output_arguments,
    add_reader_arguments,
    add_selection_arguments,
    open_bags,
    selection,
)
from amr_description.errors import BagError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_reader_arguments(parser)
    add_output_arguments(parser)
    add_selection_arguments(parser, 'keep')


def main(args: Namespace) -> int:
    """Write the bag; return 0."""
    from amr_description.bag.rewriting import Output
    from amr_description.cli.bag.outputs import write

    chosen = selection(args)
    with open_bags([(Path(args.bag_path), args.storage or None)]) as readers:
        topics = readers[0].topics
        if not any(chosen.holds(topic) for topic in topics.values()):
            raise BagError(
                f'no topic of {args.bag_path} is meant; it has {", ".join(sorted(topics))}'
            )
        return write(readers, args, Output(Path(), chosen.holds))
