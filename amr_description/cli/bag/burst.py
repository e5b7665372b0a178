# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Burst data from a bag.

Messages are published as fast as possible. After those that are asked for the player is paused,
and goes on by its keys and services.
"""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from amr_description.bag.topic_selection import TopicSelection
from amr_description.cli.bag.inputs import add_reader_arguments, nanoseconds, not_negative_int
from amr_description.cli.bag.play import (
    add_offset_argument,
    add_qos_argument,
    add_queue_argument,
    add_remap_argument,
)


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_reader_arguments(parser)
    add_queue_argument(parser)
    for name in ('topic', 'service'):
        parser.add_argument(
            f'--{name}s',
            default=[],
            nargs='+',
            help=f'{name}s to replay, separated by space. At least one {name} needs to be '
            f"specified. If this parameter isn't specified, all {name}s will be replayed.",
        )
    add_qos_argument(parser)
    add_remap_argument(parser)
    add_offset_argument(parser)
    parser.add_argument(
        '-n',
        '--num-messages',
        type=not_negative_int,
        default=0,
        help='Burst the specified number of messages, then pause.',
    )
    parser.set_defaults(log_level='info', disable_keyboard_controls=False)


def main(args: Namespace) -> int:
    """Play to the end, or until a signal; 0 if to the end."""
    from amr_description.bag.playback import PlaybackOptions
    from amr_description.bag.ros.player import PlayerOptions
    from amr_description.cli.bag.playing import overrides_of, play

    playback = PlaybackOptions(
        start_paused=True,
        start_offset=nanoseconds(args.start_offset),
        read_ahead=args.read_ahead_queue_size,
    )
    options = PlayerOptions(
        playback=playback, overrides=overrides_of(args.qos_profile_overrides_path)
    )
    chosen = TopicSelection(topics=args.topics, services=args.services)
    given = [(Path(args.bag_path), args.storage or None)]
    return play(given, chosen, options, args, burst=args.num_messages)
