# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""ros2 is an extensible command-line tool for ROS 2."""

import argparse
from collections.abc import Sequence
import os

from amr_description import streams
from amr_description.cli.lazy_parser import LazyParser, run

COMMANDS = {
    'action': 'amr_description.cli.action',
    'bag': 'amr_description.cli.bag',
    'control': 'amr_description.cli.control',
    'daemon': 'amr_description.cli.daemon',
    'doctor': 'amr_description.cli.doctor',
    'interface': 'amr_description.cli.interface',
    'launch': 'amr_description.cli.launch',
    'lifecycle': 'amr_description.cli.lifecycle',
    'node': 'amr_description.cli.node',
    'param': 'amr_description.cli.param',
    'pkg': 'amr_description.cli.pkg',
    'run': 'amr_description.cli.run',
    'service': 'amr_description.cli.service',
    'topic': 'amr_description.cli.topic',
    'wtf': 'amr_description.cli.wtf',
}


def main(argv: Sequence[str]) -> int:
    """Run ``ros2`` with the arguments after its name; return the exit code."""
    parser = LazyParser(prog='ros2', description=__doc__)
    parser.add_argument(
        '--use-python-default-buffering',
        action=_DefaultBuffering,
        nargs=0,
        help='Do not force line buffering in stdout and instead use the python default '
        'buffering, which might be affected by PYTHONUNBUFFERED/-u and depends on whatever '
        'stdout is interactive or not',
    )
    parser.read_table(COMMANDS)
    if '_ARGCOMPLETE' in os.environ:  # a shell asks what may come next
        from amr_description.cli.completion import complete

        complete(parser)
    return run(parser, argv)


class _DefaultBuffering(argparse.Action):
    """Takes effect while the command line is read: what follows may already print its help."""

    def __call__(self, *_args: object, **_kwargs: object) -> None:
        streams.make_fully_buffered()
