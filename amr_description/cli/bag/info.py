# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Print information about a bag to the screen.

A bag without metadata.yaml, as an interruption leaves it, is read to know.
"""

from argparse import ArgumentParser, Namespace
from pathlib import Path
import sys

from amr_description.cli.bag.inputs import add_reader_arguments

SORTING = ('name', 'type', 'count')


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_reader_arguments(parser)
    parser.add_argument(
        '-t', '--topic-name', action='store_true', help='Only display topic names.'
    )
    parser.add_argument(
        '-v',
        '--verbose',
        action='store_true',
        help='Display request/response information for services',
    )
    parser.add_argument(
        '--sort',
        default='name',
        choices=SORTING,
        help='Configuration for sorting of output. By default sorts by topic name - use this '
        'argument to override.',
    )


def main(args: Namespace) -> int:
    """Print it. Raises BagError."""
    from amr_description.bag.info_text import Contents, info_text, topic_names
    from amr_description.bag.reader import BagReader

    if args.topic_name and args.verbose:
        print(
            "Warning! You have set both the '-t' and '-v' parameters. The '-t' parameter will be "
            'ignored.'
        )
    path = Path(args.bag_path)
    with BagReader(path, args.storage or None) as reader:
        if reader.is_rebuilt and path.is_dir():
            print(
                f'{path} has no metadata.yaml: it was interrupted. This is what its files say; '
                f'`ros2 bag reindex {path}` writes it',
                file=sys.stderr,
            )
        if args.topic_name and not args.verbose:
            for name in topic_names(reader.metadata, args.sort):
                print(name)
            return 0
        contents = None
        if args.verbose:
            contents = Contents()
            for message in reader.messages():
                contents.add(message)
        print(info_text(reader.metadata, reader.size, contents, args.sort))
    return 0
