# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command line of ``scripts/bench``, and which parts it asks for. Pure."""

import argparse
from collections.abc import Sequence

from benchmarks.goals import GOALS

PARTS = (
    'speed',
    'engine',
    'latency',
    'stack',
    'page',
    'robot_state_publisher',
    'fleet',
    'fleet_start',
    'sensors',
    'recording',
    'playing',
    'memory',
    'cold',
    'profile',
)
"""In the order in which they run."""
_QUICK = ('speed', 'engine', 'latency', 'stack', 'robot_state_publisher')
_ON_REQUEST = {
    'cold': 'it takes minutes: --only cold, or --check',
    'profile': 'it has no goal: --profile',
}


def chosen_parts(options: argparse.Namespace) -> tuple[str, ...]:
    """Return the parts that the options ask for."""
    if options.profile:
        return ('profile',)
    if options.only:
        return tuple(options.only)
    if options.quick:
        return _QUICK
    left_out = ('profile',) if options.check else tuple(_ON_REQUEST)
    return tuple(part for part in PARTS if part not in left_out)


def why_left_out(parts: Sequence[str], *, quick: bool) -> dict[str, str]:
    """Return the reason for each figure whose part is not run."""
    return {
        goal.key: _ON_REQUEST.get(goal.part)
        or ('--quick leaves it out' if quick else 'it was not asked for')
        for goal in GOALS
        if goal.part not in parts
    }


def parser() -> argparse.ArgumentParser:
    """Make the parser."""
    options = argparse.ArgumentParser(
        prog='bench', description='Measure the stack, and compare the figures with their goals.'
    )
    kind = options.add_mutually_exclusive_group()
    kind.add_argument(
        '--quick', action='store_true', help='a minute: without fleets and the simulated hour'
    )
    kind.add_argument(
        '--profile', action='store_true', help='a cycle by part and the start by phase instead'
    )
    kind.add_argument(
        '--only', nargs='+', metavar='PART', choices=PARTS, help=f'some of: {", ".join(PARTS)}'
    )
    options.add_argument(
        '--check', action='store_true', help='exit with 1 if a goal is missed, and say which'
    )
    options.add_argument('--seconds', type=float, help='of each measurement (5; quick: 3)')
    options.add_argument('--domain-id', type=int, default=77, help='ROS domain to use (77)')
    return options
