# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Write a part of the time of a bag into another.

What was latched before, such as robot descriptions, maps and fixed transforms, is kept, with the
time of the begin: the part plays as the whole does. Of a simulation that was reset the part of
each run is written.

examples:
  ros2 bag trim my_bag -o part --start-offset 10 --duration 5
  ros2 bag trim my_bag -o part --start-time 1700000010.5 --end-time 1700000015
"""

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from decimal import Decimal, InvalidOperation
from itertools import chain
from pathlib import Path

from amr_description.cli.bag.inputs import add_output_arguments, add_reader_arguments, open_bags
from amr_description.errors import BagError

_LATEST = 2**33  # s


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_reader_arguments(parser)
    add_output_arguments(parser)
    start = parser.add_mutually_exclusive_group()
    start.add_argument(
        '--start-offset',
        type=seconds,
        metavar='S',
        help='Begin this many seconds after the first message.',
    )
    start.add_argument(
        '--start-time', type=seconds, metavar='S', help='Begin at this time, seconds since epoch.'
    )
    end = parser.add_mutually_exclusive_group()
    end.add_argument(
        '--duration', type=seconds, metavar='S', help='End this many seconds after the begin.'
    )
    end.add_argument(
        '--end-time', type=seconds, metavar='S', help='End at this time, seconds since epoch.'
    )
    parser.add_argument(
        '--no-latched',
        action='store_true',
        help='Leave out what was latched before the begin.',
    )


def seconds(text: str) -> int:
    """Read a time in s, which a float would round; return ns."""
    try:
        value = Decimal(text)
    except InvalidOperation:
        value = Decimal(-1)
    if not 0 <= value < _LATEST:
        raise ArgumentTypeError(f"'{text}' is not a number of seconds from 0 on")
    return int(value * 10**9)


def main(args: Namespace) -> int:
    """Write the bag; return 0."""
    from amr_description.bag.recording import BagRecording
    from amr_description.bag.rewriting import Output
    from amr_description.cli.bag.outputs import write

    given = (args.start_offset, args.start_time, args.duration, args.end_time)
    if all(each is None for each in given):
        raise BagError('say what to keep by --start-offset, --duration, --start-time, --end-time')
    with open_bags([(Path(args.bag_path), args.storage or None)]) as readers:
        whole = BagRecording(readers)
        start = whole.start + (args.start_offset or 0)
        if args.start_time is not None:
            start = args.start_time
        end = args.end_time
        if args.duration is not None:
            end = start + args.duration
        last = whole.end if end is None else end
        parts = (whole.messages_of_run(run, start, last) for run in range(whole.runs))
        if next(chain.from_iterable(parts), None) is None:
            raise BagError(
                f'{args.bag_path} has no message from {_text(start)} to {_text(last)} s: it goes '
                f'from {_text(whole.start)} to {_text(whole.end)} s'
            )
        output = Output(Path(), start=start, end=end, keeps_latched=not args.no_latched)
        return write(readers, args, output)


def _text(time: int) -> str:
    return f'{Decimal(time) / 10**9:f}'
