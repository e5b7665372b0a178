# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Check ROS setup and other potential issues.

It looks at this machine, at the environment of this shell and at all nodes that it finds, for 3 s
at most, and changes nothing. Each finding says what was seen, why it matters and what mends it.

Exit codes: 0: no check failed; 1: one did (--include-warnings: or has a warning).
"""

from argparse import ArgumentParser, Namespace

from amr_description.argument_types import positive

VERBS = {
    'hello': 'amr_description.cli.doctor.hello',
}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command without a verb."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument('--report', '-r', action='store_true', help='Print all reports.')
    group.add_argument(
        '--report-failed',
        '-rf',
        action='store_true',
        help='Print reports of failed checks only.',
    )
    parser.add_argument(
        '--exclude-packages',
        '-ep',
        action='store_true',
        help='Exclude package checks or report.',
    )
    parser.add_argument(
        '--include-warnings',
        '-iw',
        action='store_true',
        help='Include warnings as failed checks. Warnings are ignored by default.',
    )
    parser.add_argument('--json', action='store_true', help='Print JSON')
    parser.add_argument(
        '--watch',
        nargs='?',
        type=positive,
        const=5.0,
        metavar='S',
        help='Check again and again, every S s (default: 5), and print only what is new or gone',
    )


def main(args: Namespace) -> int:
    """Examine, and print what was found; 1: a check failed."""
    from amr_description.cli.doctor.examination import examine_and_print, watch

    return watch(args) if args.watch else examine_and_print(args)
