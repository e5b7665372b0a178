# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is said about the failure that stopped a stack, last of all, where it is read."""

from collections.abc import Collection, Mapping, Sequence
import re
import signal

from amr_description.bringup.conditions import NameOf
from amr_description.bringup.description import Node
from amr_description.bringup.progress import Failure
from amr_description.bringup.waits import Expired

_LONGEST_REASON = 500  # characters
_ROS_LOG_PREFIX = re.compile(r'\[[A-Z]+\] \[[\d.]+\] \[\S+\]: ')


def post_mortem(
    name: str, failure: Failure, last_lines: Collection[str], never_started: Sequence[str]
) -> list[str]:
    """
    Return the texts to print: the last lines of the process, then one line that says it all.

    :param last_lines: What the process wrote last.
    :param never_started: The names of the nodes that were not started because of it.
    """
    texts = []
    if len(last_lines) > 1:
        texts.append('\n    '.join([f'the last lines of {name}:', *last_lines]))
    spoken = [_ROS_LOG_PREFIX.sub('', line.strip()) for line in last_lines if line.strip()]
    reason = f': {spoken[-1][:_LONGEST_REASON]}' if spoken else ', without a word'
    missing = f' (never started: {", ".join(never_started)})' if never_started else ''
    return [*texts, f'stopped because {name} {manner(failure)}{missing}{reason}']


def expiry(
    expired: Expired, name_of: NameOf, last_lines: Mapping[Node, Collection[str]]
) -> list[str]:
    """Return the texts to print: the last lines of who was waited for, then one line."""
    awaited = [node for node in expired.condition.nodes if expired.situation.states[node].running]
    told = {name_of(node): last_lines.get(node) for node in awaited}
    texts = [
        '\n    '.join([f'the last lines of {name}:', *lines])
        for name, lines in told.items()
        if lines
    ]
    return [*texts, f'stopped because {expired.text(name_of)}']


def manner(failure: Failure) -> str:
    """Return in words how the process ended."""
    again = f', as did {failure.restarts} new starts' if failure.restarts else ''
    if failure.returncode >= 0:
        return f'ended with exit code {failure.returncode}{again}'
    return f'died of {signal_name(-failure.returncode)}{again}'


def signal_name(number: int) -> str:
    """Return the name of a signal, ``SIGKILL``."""
    try:
        return signal.Signals(number).name
    except ValueError:  # a real-time signal
        return f'signal {number}'
