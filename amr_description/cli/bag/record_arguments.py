# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The arguments of ``ros2 bag record``, with the names and texts of Jazzy."""

from argparse import ArgumentParser, FileType, RawDescriptionHelpFormatter
from typing import Any

STORAGES = ('sqlite3', 'mcap')
PRESETS = {
    'none': 'Default profile, no special settings.',
    'fastwrite': 'Disables CRC and chunking for faster writing.',
    'zstd_fast': 'Use Zstd chunk compression on Fastest level.',
    'zstd_small': 'Use Zstd chunk compression on Slowest level, for smallest file size.',
}
_CACHE = 100 * 1024 * 1024  # bytes
_WITHOUT_SPLIT = (
    'Default: %(default)d, recording written in single bagfile and splitting is disabled.'
)


class _LinesKept(RawDescriptionHelpFormatter):
    """Keeps the line breaks in texts of help."""

    def _split_lines(self, text: str, width: int) -> list[str]:
        return [each for line in text.splitlines() for each in super()._split_lines(line, width)]


def add_recorder_arguments(parser: ArgumentParser) -> None:
    """Add all."""
    parser.formatter_class = _LinesKept
    parser.add_argument(
        '-o',
        '--output',
        help='Destination of the bagfile to create, '
        'defaults to a timestamped folder in the current directory.',
    )
    parser.add_argument(
        '-s',
        '--storage',
        default='mcap',
        choices=STORAGES,
        help="Storage identifier to be used, defaults to '%(default)s'.",
    )
    _add_topics(parser)
    _add_excludes(parser)
    _add_discovery(parser)
    _add_splitting(parser)
    _add_control(parser)
    _add_storage(parser)
    _add_compression(parser)


def _list(
    parser: Any, flag: str, metavar: str, text: str, default: list[str] | None = None
) -> None:
    parser.add_argument(flag, nargs='+', metavar=metavar, default=default, help=text)


def _switch(parser: ArgumentParser, *flags: str, text: str) -> None:
    parser.add_argument(*flags, action='store_true', help=text)


def _add_topics(parser: ArgumentParser) -> None:
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        'topics_positional',
        metavar='[Topic ...]',
        nargs='*',
        default=[],
        help='Space-delimited list of topics to record. (deprecated)',
    )
    _list(group, '--topics', 'Topic', 'Space-delimited list of topics to record.', [])
    _list(parser, '--services', 'ServiceName', 'Space-delimited list of services to record.')
    _list(
        parser, '--topic-types', 'TopicType', 'Space-delimited list of topic types to record.', []
    )
    _switch(
        parser,
        '-a',
        '--all',
        text='Record all topics and services (Exclude hidden topic).',
    )
    _switch(parser, '--all-topics', text='Record all topics (Exclude hidden topic).')
    _switch(parser, '--all-services', text='Record all services via service event topics.')
    parser.add_argument(
        '-e',
        '--regex',
        default='',
        help='Record only topics and services containing provided regular expression. '
        'Note:  --all, --all-topics or --all-services will override --regex.',
    )


def _add_excludes(parser: ArgumentParser) -> None:
    parser.add_argument(
        '--exclude-regex',
        default='',
        help='Exclude topics and services containing provided regular expression. '
        'Works on top of '
        '--all, --all-topics, --all-services, --topics, --services or --regex.',
    )
    for flag, metavar, what, others, default in (
        ('--exclude-topic-types', 'ExcludeTopicTypes', 'topic types', 'topics', []),
        ('--exclude-topics', 'Topic', 'topics', 'topics', None),
        ('--exclude-services', 'ServiceName', 'services', 'services', None),
    ):
        _list(
            parser,
            flag,
            metavar,
            f'Space-delimited list of {what} not being recorded. '
            f'Works on top of --all, --all-{others}, --{others} or --regex.',
            default,
        )


def _add_discovery(parser: ArgumentParser) -> None:
    _switch(
        parser,
        '--include-unpublished-topics',
        text='Discover and record topics which have no publisher. '
        'Subscriptions on such topics will be made with default QoS unless otherwise '
        'specified in a QoS overrides file.',
    )
    _switch(
        parser,
        '--include-hidden-topics',
        text='Discover and record hidden topics as well. '
        'These are topics used internally by ROS 2 implementation.',
    )
    _switch(
        parser,
        '--no-discovery',
        text='Disables topic auto discovery during recording: only topics present at '
        'startup will be recorded.',
    )
    parser.add_argument(
        '-p',
        '--polling-interval',
        type=int,
        default=100,
        help='Time in ms to wait between querying available topics for recording. '
        'It has no effect if --no-discovery is enabled.',
    )
    _switch(parser, '--ignore-leaf-topics', text='Ignore topics without a subscription.')
    parser.add_argument(
        '--qos-profile-overrides-path',
        type=FileType('r'),
        help='Path to a yaml file defining overrides of the QoS profile for specific topics.',
    )
    parser.add_argument(
        '-f',
        '--serialization-format',
        default='',
        choices=(),
        help='The rmw serialization format in which the messages are saved, defaults to the '
        'rmw currently in use.',
    )


def _add_splitting(parser: ArgumentParser) -> None:
    parser.add_argument(
        '-b',
        '--max-bag-size',
        type=int,
        default=0,
        help=f'Maximum size in bytes before the bagfile will be split. {_WITHOUT_SPLIT}',
    )
    parser.add_argument(
        '-d',
        '--max-bag-duration',
        type=int,
        default=0,
        help=f'Maximum duration in seconds before the bagfile will be split. {_WITHOUT_SPLIT} '
        'If both splitting by size and duration are enabled, '
        'the bag will split at whichever threshold is reached first.',
    )
    parser.add_argument(
        '--max-cache-size',
        type=int,
        default=_CACHE,
        help='Maximum size (in bytes) of messages to hold in each buffer of cache. '
        'Default: %(default)d. The cache is handled through double buffering, '
        'which means that in pessimistic case up to twice the parameter value of memory '
        'is needed. A rule of thumb is to cache an order of magnitude corresponding to '
        'about one second of total recorded data volume. '
        'If the value specified is 0, then every message is directly written to disk.',
    )


def _add_control(parser: ArgumentParser) -> None:
    _switch(
        parser,
        '--disable-keyboard-controls',
        text='disables keyboard controls for recorder',
    )
    _switch(parser, '--start-paused', text='Start the recorder in a paused state.')
    _switch(
        parser,
        '--use-sim-time',
        text='Use simulation time for message timestamps by subscribing to the /clock topic. '
        'Until first /clock message is received, no messages will be written to bag.',
    )
    parser.add_argument(
        '--node-name',
        default='rosbag2_recorder',
        help='Specify the recorder node name. Default is %(default)s.',
    )
    parser.add_argument(
        '--custom-data',
        metavar='KEY=VALUE',
        nargs='*',
        help='Space-delimited list of key=value pairs. Store the custom data in metadata '
        'under the "rosbag2_bagfile_information/custom_data". The key=value pair can '
        'appear more than once. The last value will override the former ones.',
    )
    _switch(
        parser,
        '--snapshot-mode',
        text='Enable snapshot mode. Messages will not be written to the bagfile until '
        'the "/rosbag2_recorder/snapshot" service is called. e.g. \n '
        'ros2 service call /rosbag2_recorder/snapshot rosbag2_interfaces/Snapshot',
    )
    parser.add_argument(
        '--log-level',
        default='info',
        choices=['debug', 'info', 'warn', 'error', 'fatal'],
        help='Logging level.',
    )


def _add_storage(parser: ArgumentParser) -> None:
    parser.add_argument(
        '--storage-config-file',
        type=FileType('r'),
        help='Path to a yaml file defining storage specific configurations. '
        'See mcap plugin documentation for the format of this file.',
    )
    profiles = '\n'.join(f'{name}: {text}' for name, text in PRESETS.items())
    parser.add_argument(
        '--storage-preset-profile',
        default='none',
        choices=list(PRESETS),
        help='Select a preset configuration for storage plugin "mcap". '
        'Settings in this profile can still be overridden by other explicit options '
        f'and --storage-config-file. Profiles:\n{profiles}',
    )


def _add_compression(parser: ArgumentParser) -> None:
    parser.add_argument(
        '--compression-queue-size',
        type=int,
        default=1,
        help='Number of files or messages that may be queued for compression '
        'before being dropped.  Default is %(default)d.',
    )
    parser.add_argument(
        '--compression-threads',
        type=int,
        default=0,
        help='Number of files or messages that may be compressed in parallel. '
        'Default is %(default)d, which will be interpreted as the number of CPU cores.',
    )
    parser.add_argument(
        '--compression-threads-priority',
        type=int,
        default=0,
        help='Compression threads scheduling priority. \nFor Windows the valid values are:'
        ' THREAD_PRIORITY_LOWEST=-2, THREAD_PRIORITY_BELOW_NORMAL=-1 and'
        ' THREAD_PRIORITY_NORMAL=0. Please refer to'
        ' https://learn.microsoft.com/en-us/windows/win32/api/processthreadsapi/'
        'nf-processthreadsapi-setthreadpriority for details.\n'
        'For POSIX compatible OSes this is the "nice" value. The nice value range is'
        ' -20 to +19 where -20 is highest, 0 default and +19 is lowest.'
        ' Please refer to https://man7.org/linux/man-pages/man2/nice.2.html for details.\n'
        'Default is %(default)d.',
    )
    parser.add_argument(
        '--compression-mode',
        default='none',
        choices=['none', 'file', 'message'],
        help='Choose mode of compression for the storage. Default: %(default)s.',
    )
    parser.add_argument(
        '--compression-format',
        default='',
        choices=['zstd'],
        help='Choose the compression format/algorithm. '
        'Has no effect if no compression mode is chosen. Default: %(default)s.',
    )
