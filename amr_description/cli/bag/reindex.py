# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Reconstruct metadata file for a bag.

It is made from what the files say, with QoS and type hashes.
"""

from argparse import ArgumentParser, Namespace
from pathlib import Path
import sys

from amr_description.cli.bag.inputs import add_reader_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_reader_arguments(parser)


def main(args: Namespace) -> int:
    """Write ``metadata.yaml``. Raises BagError."""
    from amr_description.bag import metadata
    from amr_description.bag.reader import reindexed

    folder = Path(args.bag_path)
    if not folder.is_dir():
        print('[ERROR] [ros2bag]: Must specify a bag directory', file=sys.stderr)
        return 1
    metadata.write(folder, reindexed(folder, args.storage or None))
    return 0
