# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
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

from argparse import ArgumentParser, Namespace
from dataclasses import replace

from amr_description.cli.bag.inputs import add_input_argument, open_bags, several_inputs


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_input_argument(parser, required=True)
    parser.add_argument(
        '-o',
        '--output-options',
        required=True,
        help='YAML file with options for output bags. Must have one top-level key "output_bags", '
        'which contains a sequence of StorageOptions/RecordOptions objects; an example is '
        'below.',
    )


def main(args: Namespace) -> int:
    """Write the bags; return 0."""
    from amr_description.bag.rewriting import rewrite, with_custom_data
    from amr_description.cli.bag.output_options import read_outputs
    from amr_description.cli.bag.outputs import print_written

    given = several_inputs(args.input)
    outputs = read_outputs(args.output_options)
    with open_bags(given) as readers:
        outputs = [
            replace(each, writer=with_custom_data(each.writer, readers)) for each in outputs
        ]
        counts = rewrite(readers, outputs)
    print_written([each.folder for each in outputs], counts)
    return 0
