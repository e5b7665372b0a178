# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``amr``: a robot on a page of this host, where whoever looks drives it; no ROS, no display."""

import argparse
from collections.abc import Sequence
import sys

from amr_description.errors import AmrError
from amr_description.simulation.in_process import Simulation

_ROBOT = 'package://amr_description/urdf/amr.urdf'
_LAST_PORT = 65535


def main(arguments: Sequence[str] | None = None) -> int:
    """Show the robot until Ctrl-C; return the exit code."""
    options = _parser().parse_args(arguments)
    try:
        with Simulation(
            options.robot,
            options.controllers,
            world=options.world,
            record=options.record,
            xacro_args=options.xacro_args,
            fixed=options.fixed,
        ) as sim:
            sim.show(port=options.port, token=options.token, wait=True)
    except AmrError as error:
        print(f'amr: {error}', file=sys.stderr)
        return error.exit_code
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        'amr',
        description='Simulate a robot in this process, without ROS, and show it on a page that '
        'drives it. Ctrl-C ends it.',
    )
    parser.add_argument(
        'robot',
        nargs='?',
        default=_ROBOT,
        help='a URDF or xacro file, or a package:// URI; default: the robot of this package',
    )
    parser.add_argument(
        'controllers',
        nargs='?',
        help='the parameter file of its controllers, or several between commas; default: those '
        'that the robot names',
    )
    parser.add_argument(
        '--xacro-args',
        default='',
        metavar="'NAME:=VALUE …'",
        help='arguments of a xacro file',
    )
    parser.add_argument(
        '--fixed', action='store_true', help='fix the root link to the world, as that of an arm'
    )
    parser.add_argument(
        '--world', default='empty', help='empty, kerbs, ramp, walls, warehouse or an MJCF file'
    )
    parser.add_argument(
        '--port',
        type=_port,
        default=8080,
        help='of the page, or the next one that is free; 0: any; default: 8080',
    )
    parser.add_argument(
        '--token',
        action='store_true',
        help='of the users of this host, let only who has the address open the page',
    )
    parser.add_argument('--record', metavar='FOLDER', help='record a bag of it')
    return parser


def _port(word: str) -> int:
    """Read the number of a port. Raises ArgumentTypeError."""
    if not (word.isascii() and word.isdigit() and int(word) <= _LAST_PORT):
        raise argparse.ArgumentTypeError(f"'{word}' is no port; 0 to {_LAST_PORT} will do")
    return int(word)
