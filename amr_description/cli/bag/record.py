# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Record ROS data to a bag.

A bag that is interrupted plays: at most the last second of it is lost.

examples:
  ros2 bag record --all
  ros2 bag record --topics /scan /tf /tf_static -o my_bag
  ros2 bag record --regex '/camera/.*' --max-bag-size 1000000000
"""

from argparse import ArgumentParser, Namespace
import os
import sys

from amr_description.bag.folder_names import default_folder
from amr_description.cli.bag.record_arguments import add_recorder_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_recorder_arguments(parser)


def main(args: Namespace) -> int:
    """Record until Ctrl-C or SIGTERM: 0; 1 if something goes wrong."""
    folder = args.output or default_folder()
    if args.topics_positional:
        print(
            '[WARN] [ros2bag]: Positional "topics" argument deprecated. Please use optional '
            '"--topics" argument instead.'
        )
        args.topics = args.topics_positional
    wrong = objection(args, folder)
    if wrong:
        print(f'[ERROR] [ros2bag]: {wrong}', file=sys.stderr)
        return 1
    for note in notes(args):
        print(f'[WARN] [ros2bag]: {note}')
    from amr_description.cli.bag.recording import record

    return record(args, folder)


def objection(args: Namespace, folder: str) -> str | None:
    """Return why a command line will not do; None: it will."""
    everything = args.all or args.all_topics or args.topic_types or args.regex
    chosen = args.all_services or args.services or args.topics
    if not (everything or chosen):
        return (
            'Need to specify at least one option out of --all, --all-topics, '
            '--all-services, --services, --topics, --topic-types or --regex'
        )
    if args.exclude_regex and not (everything or args.all_services):
        return (
            '--exclude-regex argument requires either --all, '
            '--all-topics, --topic-types, --all-services or --regex'
        )
    if args.exclude_topics and not everything:
        return (
            '--exclude-topics argument requires either --all, --all-topics, '
            '--topic-types or --regex'
        )
    if args.exclude_topic_types and not everything:
        return '--exclude-topic-types argument requires either --all, --all-topics or --regex'
    if args.exclude_services and not (args.all or args.all_services or args.regex):
        return '--exclude-services argument requires either --all, --all-services or --regex'
    if os.path.isdir(folder):
        return f"Output folder '{folder}' already exists."
    if args.use_sim_time and args.no_discovery:
        return (
            '--use-sim-time and --no-discovery both set, but are incompatible settings. '
            'The /clock topic needs to be discovered to record with sim time.'
        )
    return _objection_to_storage(args)


def _objection_to_storage(args: Namespace) -> str | None:
    if args.compression_format and args.compression_mode == 'none':
        return 'Invalid choice: Cannot specify compression format without a compression mode.'
    if args.compression_queue_size < 0:
        return 'Compression queue size must be at least 0.'
    if args.storage == 'sqlite3' and args.storage_preset_profile not in ('', 'none'):
        return (
            f'storage sqlite3 has no --storage-preset-profile {args.storage_preset_profile}: '
            'it is one of mcap'
        )
    if args.compression_mode == 'message':
        return (
            f'storage {args.storage} does not take --compression-mode message: messages in '
            'chunks are compressed by --storage-preset-profile zstd_fast, files by '
            '--compression-mode file'
        )
    if args.snapshot_mode and args.max_cache_size <= 0:
        return 'in snapshot mode messages are held in memory: --max-cache-size must not be 0'
    for name in ('max_bag_size', 'max_bag_duration', 'max_cache_size'):
        if getattr(args, name) < 0:
            return f'--{name.replace("_", "-")} must not be negative'
    wrong = [each for each in args.custom_data or () if '=' not in each]
    if wrong:
        return f"--custom-data: want KEY=VALUE, not '{wrong[0]}'"
    return None


def notes(args: Namespace) -> list[str]:
    """Return what is to be said of a command line that will do."""
    found = []
    if (args.all or args.all_services) and args.services:
        found.append('--all or --all-services will override --services')
    if (args.all or args.all_topics) and args.topics:
        found.append('--all or --all-topics will override --topics')
    if (args.all or args.all_topics or args.all_services) and args.regex:
        found.append('--all, --all-topics or --all-services will override --regex')
    return found
