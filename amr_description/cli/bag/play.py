# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 bag`` that play: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, ArgumentTypeError, FileType, Namespace
from pathlib import Path

from amr_description.bag.topic_selection import TopicSelection
from amr_description.cli.bag.inputs import (
    above_zero,
    add_multi_reader_arguments,
    add_reader_arguments,
    add_selection_arguments,
    finite_float,
    inputs,
    nanoseconds,
    not_negative_float,
    not_negative_int,
    selection,
)

LOG_LEVELS = ('debug', 'info', 'warn', 'error', 'fatal')


class PlayVerb:
    """
    Play back ROS data from a bag.

    examples:
      ros2 bag play my_bag --rate 0.5 --loop
      ros2 bag play my_bag --clock --topics /scan /tf /tf_static
      ros2 bag play my_bag --remap /cmd_vel:=/recorded/cmd_vel
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_multi_reader_arguments(parser)
        add_queue_argument(parser)
        parser.add_argument(
            '-r',
            '--rate',
            type=above_zero,
            default=1.0,
            help='rate at which to play back messages. Valid range > 0.0.',
        )
        add_selection_arguments(parser, 'play')
        add_qos_argument(parser)
        parser.add_argument(
            '-l',
            '--loop',
            action='store_true',
            help='enables loop playback when playing a bagfile: it starts back at the beginning '
            'on reaching the end and plays indefinitely.',
        )
        add_remap_argument(parser)
        _add_clock(parser)
        _add_begin_and_end(parser)
        _add_publishing(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Play to the end, or until a signal; 0 if to the end."""
        from amr_description.bag.playback import PlaybackOptions
        from amr_description.bag.ros.player import PlayerOptions
        from amr_description.cli.bag.playing import overrides_of, play

        chosen = selection(args)
        until = args.playback_until_nsec
        if args.playback_until_sec >= 0.0:
            until = nanoseconds(args.playback_until_sec)
        playback = PlaybackOptions(
            rate=args.rate,
            loop=args.loop,
            start_paused=args.start_paused,
            delay=nanoseconds(args.delay),
            start_offset=nanoseconds(args.start_offset),
            duration=nanoseconds(args.playback_duration) if args.playback_duration >= 0.0 else -1,
            until=until,
            read_ahead=args.read_ahead_queue_size,
        )
        triggers = args.clock_topics or None
        options = PlayerOptions(
            playback=playback,
            clock_frequency=args.clock,
            clock_topics=() if args.clock_topics_all else triggers,
            overrides=overrides_of(args.qos_profile_overrides_path),
            acked_timeout=args.wait_for_all_acked,
            requests_from=args.service_requests_source if args.publish_service_requests else '',
        )
        return play(inputs(args), chosen, options, args)


def add_queue_argument(parser: ArgumentParser) -> None:
    """Add ``read_ahead_queue_size``."""
    parser.add_argument(
        '--read-ahead-queue-size',
        type=int,
        default=1000,
        help='size of message queue rosbag tries to hold in memory to help deterministic '
        'playback. Larger size will result in larger memory needs but might prevent delay of '
        'message playback.',
    )


def add_qos_argument(parser: ArgumentParser) -> None:
    """Add ``qos_profile_overrides_path``, which is an open file."""
    parser.add_argument(
        '--qos-profile-overrides-path',
        type=FileType('r'),
        help='Path to a yaml file defining overrides of the QoS profile for specific topics.',
    )


def add_remap_argument(parser: ArgumentParser) -> None:
    """Add ``remap`` and ``storage_config_file``."""
    parser.add_argument(
        '--remap',
        '-m',
        default='',
        nargs='+',
        help='list of topics to be remapped: in the form "old_topic1:=new_topic1 '
        'old_topic2:=new_topic2 etc."',
    )
    parser.add_argument(
        '--storage-config-file',
        type=FileType('r'),
        help='Path to a yaml file defining storage specific configurations. See storage plugin '
        'documentation for the format of this file.',
    )


def add_offset_argument(parser: ArgumentParser) -> None:
    """Add ``start_offset``, s."""
    parser.add_argument(
        '--start-offset',
        type=not_negative_float,
        default=0.0,
        help='Start the playback player this many seconds into the bag file.',
    )


def positive_float(text: str) -> float:
    """Read a number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float('inf'):
        raise ArgumentTypeError(f"invalid positive_float value: '{text}'")
    return value


def _add_clock(parser: ArgumentParser) -> None:
    clock = parser.add_mutually_exclusive_group()
    clock.add_argument(
        '--clock',
        type=positive_float,
        nargs='?',
        const=40,
        default=0,
        metavar='Hz',
        help='Publish to /clock at a specific frequency in Hz, to act as a ROS Time Source. '
        'Value must be positive. Defaults to not publishing. If specified, /clock topic in the '
        'bag file is excluded to publish.',
    )
    clock.add_argument(
        '--clock-topics',
        default=[],
        nargs='+',
        help='List of topics separated by spaces that will trigger a /clock update when a message '
        'is published on them',
    )
    clock.add_argument(
        '--clock-topics-all',
        action='store_true',
        help='Publishes an update on /clock immediately before each replayed message',
    )


def _add_begin_and_end(parser: ArgumentParser) -> None:
    parser.add_argument(
        '-d',
        '--delay',
        type=positive_float,
        default=0.0,
        help='Sleep duration before play (loops are not affected), in seconds. Negative durations '
        'invalid.',
    )
    parser.add_argument(
        '--playback-duration',
        type=finite_float,
        default=-1.0,
        help='Playback duration, in seconds. Negative durations mark an infinite playback. '
        'Default is -1. When positive, the maximum effective time between `playback-until-*` and '
        'this argument will determine when playback stops.',
    )
    until = parser.add_mutually_exclusive_group()
    until.add_argument(
        '--playback-until-sec',
        type=finite_float,
        default=-1.0,
        help='Playback until timestamp, expressed in seconds since epoch. Mutually exclusive '
        'argument with `--playback-until-nsec`. Use when floating point to integer conversion '
        'error is not a concern. A negative value disables this feature. Default is -1.000000. '
        'When positive, the maximum effective time between `--playback-duration` and this '
        'argument will determine when playback stops.',
    )
    until.add_argument(
        '--playback-until-nsec',
        type=int,
        default=-1,
        help='Playback until timestamp, expressed in nanoseconds since epoch. Mutually exclusive '
        'argument with `--playback-until-sec`. Use when floating point to integer conversion '
        'error matters for your use case. A negative value disables this feature. Default is -1. '
        'When positive, the maximum effective time between `--playback-duration` and this '
        'argument will determine when playback stops.',
    )
    parser.add_argument(
        '--disable-keyboard-controls',
        action='store_true',
        help='disables keyboard controls for playback',
    )
    parser.add_argument(
        '-p',
        '--start-paused',
        action='store_true',
        help='Start the playback player in a paused state.',
    )
    add_offset_argument(parser)


def _add_publishing(parser: ArgumentParser) -> None:
    parser.add_argument(
        '--wait-for-all-acked',
        type=not_negative_int,
        default=-1,
        metavar='TIMEOUT',
        help='Wait until all published messages are acknowledged by all subscribers or until the '
        'timeout elapses in millisecond before play is terminated. Especially for the case of '
        'sending message with big size in a short time. Negative timeout is invalid. 0 means wait '
        'forever until all published messages are acknowledged by all subscribers. Note that this '
        "option is valid only if the publisher's QOS profile is RELIABLE.",
    )
    parser.add_argument(
        '--disable-loan-message',
        action='store_true',
        help='Accepted for scripts: messages are never loaned',
    )
    parser.add_argument(
        '--publish-service-requests',
        action='store_true',
        help='Publish recorded service requests instead of recorded service events',
    )
    parser.add_argument(
        '--service-requests-source',
        default='service_introspection',
        choices=('service_introspection', 'client_introspection'),
        help='Determine the source of the service requests to be replayed. This option only makes '
        'sense if the "--publish-service-requests" option is set. By default, the service '
        'requests replaying from recorded service introspection message.',
    )
    parser.add_argument('--log-level', default='info', choices=LOG_LEVELS, help='Logging level.')


class BurstVerb:
    """
    Burst data from a bag.

    Messages are published as fast as possible. After those that are asked for the player is
    paused, and goes on by its keys and services.
    """

    @staticmethod
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

    @staticmethod
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
