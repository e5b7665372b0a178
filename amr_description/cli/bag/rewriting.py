# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 bag`` that make bags of others: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal, InvalidOperation
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from amr_description.cli.bag.inputs import (
    add_input_argument,
    add_output_arguments,
    add_reader_arguments,
    add_selection_arguments,
    existing_path,
    open_bags,
    selection,
    several_inputs,
)
from amr_description.errors import BagError

if TYPE_CHECKING:
    from amr_description.bag.reader import BagReader
    from amr_description.bag.rewriting import RewrittenBag

_LATEST = 2**33  # s


class ConvertVerb:
    """
    Given an input bag, write out a new bag with different settings.

    An output file of one bag that has all topics of the input, compressed:
      output_bags:
      - uri: my_converted_bag
        all_topics: true
        all_services: true
        compression_mode: file
        compression_format: zstd
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_input_argument(parser, required=True)
        parser.add_argument(
            '-o',
            '--output-options',
            required=True,
            help='YAML file with options for output bags. Must have one top-level key '
            '"output_bags", which contains a sequence of StorageOptions/RecordOptions objects; an '
            'example is below.',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Write the bags; return 0."""
        from amr_description.bag.rewriting import rewrite, with_custom_data
        from amr_description.cli.bag.output_options import read_outputs

        given = several_inputs(args.input)
        outputs = read_outputs(args.output_options)
        with open_bags(given) as readers:
            outputs = [
                replace(each, writer=with_custom_data(each.writer, readers)) for each in outputs
            ]
            counts = rewrite(readers, outputs)
        print_written([each.folder for each in outputs], counts)
        return 0


class FilterVerb:
    """
    Write some topics of a bag into another.

    examples:
      ros2 bag filter my_bag -o without_images --exclude-regex '/camera/.*'
      ros2 bag filter my_bag -o transforms --topics /tf /tf_static
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_reader_arguments(parser)
        add_output_arguments(parser)
        add_selection_arguments(parser, 'keep')

    @staticmethod
    def main(args: Namespace) -> int:
        """Write the bag; return 0."""
        from amr_description.bag.rewriting import RewrittenBag

        chosen = selection(args)
        with open_bags([(Path(args.bag_path), args.storage or None)]) as readers:
            topics = readers[0].topics
            if not any(chosen.holds(topic) for topic in topics.values()):
                raise BagError(
                    f'no topic of {args.bag_path} is meant; it has {", ".join(sorted(topics))}'
                )
            return write(readers, args, RewrittenBag(Path(), chosen.holds))


class MergeVerb:
    """
    Write the messages of several bags into one, by their times.

    example:
      ros2 bag merge first_bag second_bag -o both
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('bag_paths', nargs='+', type=existing_path, help='Bags to open.')
        add_output_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Write the bag; return 0."""
        from amr_description.bag.rewriting import RewrittenBag

        with open_bags([(Path(path), None) for path in args.bag_paths]) as readers:
            return write(readers, args, RewrittenBag(Path()))


class TrimVerb:
    """
    Write a part of the time of a bag into another.

    What was latched before, such as robot descriptions, maps and fixed transforms, is kept, with
    the time of the begin: the part plays as the whole does. Of a simulation that was reset the
    part of each run is written.

    examples:
      ros2 bag trim my_bag -o part --start-offset 10 --duration 5
      ros2 bag trim my_bag -o part --start-time 1700000010.5 --end-time 1700000015
    """

    @staticmethod
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
            '--start-time',
            type=seconds,
            metavar='S',
            help='Begin at this time, seconds since epoch.',
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

    @staticmethod
    def main(args: Namespace) -> int:
        """Write the bag; return 0."""
        from amr_description.bag.recording import BagRecording
        from amr_description.bag.rewriting import RewrittenBag

        given = (args.start_offset, args.start_time, args.duration, args.end_time)
        if all(each is None for each in given):
            raise BagError(
                'say what to keep by --start-offset, --duration, --start-time, --end-time'
            )
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
                    f'{args.bag_path} has no message from {_text(start)} to {_text(last)} s: it '
                    f'goes from {_text(whole.start)} to {_text(whole.end)} s'
                )
            output = RewrittenBag(Path(), start=start, end=end, keeps_latched=not args.no_latched)
            return write(readers, args, output)


def seconds(text: str) -> int:
    """Read a time in s, which a float would round; return ns."""
    try:
        value = Decimal(text)
    except InvalidOperation:
        value = Decimal(-1)
    if not 0 <= value < _LATEST:
        raise ArgumentTypeError(f"'{text}' is not a number of seconds from 0 on")
    return int(value * 10**9)


def _text(time: int) -> str:
    return f'{Decimal(time) / 10**9:f}'


def write(readers: 'Sequence[BagReader]', args: Namespace, output: 'RewrittenBag') -> int:
    """
    Write a bag, and print what is in it; return 0.

    Args:
        readers: whose messages are taken.
        args: ``output`` and ``storage_preset_profile``.
        output: what is taken; its folder and how it is written are by ``args``.

    Raises:
        BagError: a bag cannot be read or written.
    """
    from amr_description.bag.folder_names import default_folder
    from amr_description.bag.mcap_writer import WriterOptions
    from amr_description.bag.rewriting import rewrite, with_custom_data

    folder = Path(args.output or default_folder())
    writer = with_custom_data(WriterOptions(preset=args.storage_preset_profile), readers)
    print_written([folder], rewrite(readers, [replace(output, folder=folder, writer=writer)]))
    return 0


def print_written(folders: Sequence[Path], counts: Sequence[int]) -> None:
    """Print how many messages each bag has."""
    for folder, count in zip(folders, counts, strict=True):
        print(f'{folder}: {count} messages')
