# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The bag that a verb makes of others."""

from argparse import Namespace
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from amr_description.bag.folder_names import default_folder
from amr_description.bag.mcap_writer import WriterOptions
from amr_description.bag.reader import BagReader
from amr_description.bag.rewriting import Output, rewrite, with_custom_data


def write(readers: Sequence[BagReader], args: Namespace, output: Output) -> int:
    """
    Write a bag, and print what is in it; return 0.

    Args:
        readers: whose messages are taken.
        args: ``output`` and ``storage_preset_profile``.
        output: what is taken; its folder and how it is written are by ``args``.

    Raises:
        BagError: a bag cannot be read or written.
    """
    folder = Path(args.output or default_folder())
    writer = with_custom_data(WriterOptions(preset=args.storage_preset_profile), readers)
    print_written([folder], rewrite(readers, [replace(output, folder=folder, writer=writer)]))
    return 0


def print_written(folders: Sequence[Path], counts: Sequence[int]) -> None:
    """Print how many messages each bag has."""
    for folder, count in zip(folders, counts, strict=True):
        print(f'{folder}: {count} messages')
