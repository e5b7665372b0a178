# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The bags that a verb reads, and other arguments that several verbs have."""

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, ExitStack
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING

from amr_description.bag.topic_selection import TopicSelection
from amr_description.errors import BagError

if TYPE_CHECKING:
    from amr_description.bag.reader import BagReader

_LATEST = 2.0**63  # ns
READERS = ('sqlite3', 'mcap')
PRESETS = ('none', 'fastwrite', 'zstd_fast', 'zstd_small')


def existing_path(text: str) -> str:
    """Read the path of a bag."""
    if not os.path.exists(text):
        raise ArgumentTypeError(f"Bag path '{text}' does not exist!")
    return text


def above_zero(text: str) -> float:
    """Read a number above 0."""
    value = _float(text)
    if not 0.0 < value < float('inf'):
        raise ArgumentTypeError(f'{text} is not in the valid range (> 0.0)')
    return value


def not_negative_float(text: str) -> float:
    """Read a number from 0 on."""
    value = finite_float(text)
    if value < 0.0:
        raise ArgumentTypeError(f'Value {text} is less than zero.')
    return value


def finite_float(text: str) -> float:
    """Read a number."""
    value = _float(text)
    if not math.isfinite(value):
        raise ArgumentTypeError(f'{text} is not a finite number')
    return value


def not_negative_int(text: str) -> int:
    """Read an integer from 0 on."""
    try:
        value = int(text)
    except ValueError:
        raise ArgumentTypeError(f'{text} is not the valid type (int)') from None
    if value < 0:
        raise ArgumentTypeError(f'Value {text} is less than zero.')
    return value


def _float(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ArgumentTypeError(f'{text} is not the valid type (float)') from None


def nanoseconds(seconds: float) -> int:
    """Return a time in ns, at most as large as times can be."""
    return round(min(seconds * 1e9, _LATEST))


def add_reader_arguments(parser: ArgumentParser) -> None:
    """Add ``bag_path`` and ``storage`` of a verb that reads one bag."""
    parser.add_argument('bag_path', type=existing_path, help='Bag to open.')
    parser.add_argument(
        '-s',
        '--storage',
        default='',
        choices=READERS,
        help='Storage implementation of bag. By default attempts to detect automatically - use '
        'this argument to override.',
    )


def add_multi_reader_arguments(parser: ArgumentParser) -> None:
    """Add ``bag_path``, ``storage`` and ``input`` of a verb that reads one bag or several."""
    parser.add_argument(
        'bag_path',
        nargs='?',
        type=existing_path,
        help='Bag to open. Use --input instead to provide an input bag with a specific storage '
        'ID.',
    )
    parser.add_argument(
        '-s',
        '--storage',
        default='',
        choices=READERS,
        help='Storage implementation of bag. By default attempts to detect automatically - use '
        'this argument to override. (deprecated: use --input to provide an input bag with a '
        'specific storage ID)',
    )
    add_input_argument(parser)


def add_input_argument(parser: ArgumentParser, *, required: bool = False) -> None:
    """Add ``input``: for each bag its path, and perhaps its storage."""
    parser.add_argument(
        '-i',
        '--input',
        required=required,
        action='append',
        nargs='+',
        metavar=('uri', 'storage_id'),
        help='URI (and optional storage ID) of an input bag. May be provided more than once for '
        f'multiple input bags. Storage ID options are: {", ".join(READERS)}.',
    )


def add_selection_arguments(parser: ArgumentParser, what: str) -> None:
    """Add the flags of :func:`selection`; ``what`` a verb does with the topics: ``play``."""
    _add_names(parser, '', what)
    parser.add_argument(
        '-e',
        '--regex',
        default='',
        help=f'{what.capitalize()} only topics and services matches with regular expression.',
    )
    parser.add_argument(
        '-x',
        '--exclude-regex',
        default='',
        help='regular expressions to exclude topics and services from replay.'
        if what == 'play'
        else 'regular expressions to exclude topics and services.',
    )
    _add_names(parser, 'exclude-', what)


def _add_names(parser: ArgumentParser, prefix: str, what: str) -> None:
    for name in ('topic', 'service'):
        parser.add_argument(
            f'--{prefix}{name}s',
            default=[],
            metavar=name,
            nargs='+',
            help=f'Space-delimited list of {name}s {"not " if prefix else ""}to {what}.',
        )


def add_output_arguments(parser: ArgumentParser) -> None:
    """Add ``output`` and ``storage_preset_profile`` of a verb that writes a bag."""
    parser.add_argument(
        '-o',
        '--output',
        help='Destination of the bagfile to create, defaults to a timestamped folder in the '
        'current directory.',
    )
    parser.add_argument(
        '--storage-preset-profile',
        default='none',
        choices=PRESETS,
        help='Select a preset configuration for storage plugin "mcap". Profiles: none: Default '
        'profile, no special settings; fastwrite: Disables CRC and chunking for faster writing; '
        'zstd_fast: Use Zstd chunk compression on Fastest level; zstd_small: Use Zstd chunk '
        'compression on Slowest level, for smallest file size.',
    )


def selection(args: Namespace) -> TopicSelection:
    """Return which topics the flags mean. Raises UsageError."""
    return TopicSelection(
        topics=args.topics,
        services=args.services,
        regex=args.regex,
        exclude_regex=args.exclude_regex,
        exclude_topics=args.exclude_topics,
        exclude_services=args.exclude_services,
    )


def inputs(args: Namespace) -> list[tuple[Path, str | None]]:
    """Return path and storage of each bag that is given. Raises BagError."""
    if args.bag_path and args.input:
        raise _error('bag_path and --input cannot be given together')
    if args.bag_path:
        return [(Path(args.bag_path), args.storage or None)]
    if not args.input:
        raise _error('Must specify bag_path or --input')
    return several_inputs(args.input)


def several_inputs(given: Sequence[Sequence[str]]) -> list[tuple[Path, str | None]]:
    """Return path and storage of each ``--input``. Raises BagError."""
    found = []
    for words in given:
        if len(words) > 2:
            raise _error(f'--input expects 1 or 2 arguments, {len(words)} provided')
        path, storage = words[0], words[1] if len(words) > 1 else None
        if not os.path.exists(path):
            raise _error(f"Bag path '{path}' does not exist!")
        if storage and storage not in READERS:
            raise _error(f"Unknown storage ID '{storage}', options are: {', '.join(READERS)}")
        found.append((Path(path), storage))
    return found


@contextmanager
def open_bags(given: Sequence[tuple[Path, str | None]]) -> Iterator['list[BagReader]']:
    """Open bags, and close them. Raises BagError."""
    from amr_description.bag.reader import BagReader

    with ExitStack() as stack:
        yield [stack.enter_context(BagReader(path, storage)) for path, storage in given]


def _error(text: str) -> BagError:
    return BagError(f'[ERROR] [ros2bag]: {text}')
