# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 bag`` that only read: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
import sys

from amr_description.cli.bag.inputs import add_reader_arguments

SORTING = ('name', 'type', 'count')
# kind -> name, description, type, base class
_PLUGINS = {
    'storage': (
        (
            'mcap',
            'MCAP files, read and written',
            'amr_description.bag.mcap_writer.BagWriter',
            'rosbag2_storage::storage_interfaces::ReadWriteInterface',
        ),
        (
            'sqlite3',
            'files of SQLite, read and written',
            'amr_description.bag.sqlite_file.SqliteFile',
            'rosbag2_storage::storage_interfaces::ReadWriteInterface',
        ),
    ),
    'converter': (),
    'compression': (
        (
            'zstd',
            'Zstandard, of whole files',
            'amr_description.bag.compression',
            'rosbag2_compression::BaseCompressorInterface',
        ),
    ),
    'decompression': (
        (
            'zstd',
            'Zstandard, of files and messages',
            'amr_description.bag.compression',
            'rosbag2_compression::BaseDecompressorInterface',
        ),
    ),
}


class InfoVerb:
    """
    Print information about a bag to the screen.

    A bag without metadata.yaml, as an interruption leaves it, is read to know.
    """

    @staticmethod
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

    @staticmethod
    def main(args: Namespace) -> int:
        """Print it. Raises BagError."""
        from amr_description.bag.info_text import Contents, info_text, topic_names
        from amr_description.bag.reader import BagReader

        if args.topic_name and args.verbose:
            print(
                "Warning! You have set both the '-t' and '-v' parameters. The '-t' parameter will "
                'be ignored.'
            )
        path = Path(args.bag_path)
        with BagReader(path, args.storage or None) as reader:
            if reader.is_rebuilt and path.is_dir():
                print(
                    f'{path} has no metadata.yaml: it was interrupted. This is what its files '
                    f'say; `ros2 bag reindex {path}` writes it',
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


class ListVerb:
    """Print information about available plugins to the screen."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('plugin_type', help='lists available plugins', choices=[*_PLUGINS])
        parser.add_argument(
            '--verbose',
            help='output verbose information about the available plugin',
            action='store_true',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the plugins; return 0."""
        if args.verbose:
            print(f'available {args.plugin_type} plugins are:')
        for name, description, kind, base in _PLUGINS[args.plugin_type]:
            print(f'name: {name}' if args.verbose else name)
            if args.verbose:
                print(f'\t{description}\n\ttype: {kind}\n\tbase_class: {base}')
        return 0


class ReindexVerb:
    """
    Reconstruct metadata file for a bag.

    It is made from what the files say, with QoS and type hashes.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_reader_arguments(parser)

    @staticmethod
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
