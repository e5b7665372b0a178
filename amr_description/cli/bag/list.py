# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Print information about available plugins to the screen."""

from argparse import ArgumentParser, Namespace

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
            'files of SQLite, read only: `ros2 bag convert` makes MCAP files of them',
            'amr_description.bag.sqlite_file.SqliteFile',
            'rosbag2_storage::storage_interfaces::ReadOnlyInterface',
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


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('plugin_type', help='lists available plugins', choices=[*_PLUGINS])
    parser.add_argument(
        '--verbose',
        help='output verbose information about the available plugin',
        action='store_true',
    )


def main(args: Namespace) -> int:
    """Print the plugins; return 0."""
    if args.verbose:
        print(f'available {args.plugin_type} plugins are:')
    for name, description, kind, base in _PLUGINS[args.plugin_type]:
        print(f'name: {name}' if args.verbose else name)
        if args.verbose:
            print(f'\t{description}\n\ttype: {kind}\n\tbase_class: {base}')
    return 0
