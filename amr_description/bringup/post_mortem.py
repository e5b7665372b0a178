# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is said about the failure that stopped a stack, last of all, where it is read."""

from collections.abc import Collection, Sequence
import re
import signal

from amr_description.bringup.progress import Failure

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


def manner(failure: Failure) -> str:
    """Return in words how the process ended."""
    if failure.returncode > 0:
        return f'ended with exit code {failure.returncode}'
    try:
        return f'died of {signal.Signals(-failure.returncode).name}'
    except ValueError:  # a real-time signal
        return f'died of signal {-failure.returncode}'
