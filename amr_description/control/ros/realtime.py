# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the control thread of a real robot asks of Linux: priority, cores, memory that stays in RAM.

All of it is optional. Where it is refused, as is usual without a real-time kernel or the rights
for it, there is a warning, and the loop runs as any other thread.
"""

from collections.abc import Sequence
import ctypes
import os

from amr_description.control.contracts import Log, Severity

_LOCK_ALL = 1 | 2
"""MCL_CURRENT | MCL_FUTURE of mlockall(2)."""


def set_fifo_priority(priority: int, log: Log) -> None:
    """Schedule the calling thread by SCHED_FIFO at ``priority``, 1 to 99."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except OSError as error:
        log(
            Severity.WARN,
            'Could not enable FIFO RT scheduling policy: with error number '
            f'<{error.errno}>({error.strerror}). The loop runs without; to allow it, add your '
            "user to a group with 'rtprio 98' in /etc/security/limits.conf",
        )
    else:
        log(
            Severity.INFO,
            f'Successful set up FIFO RT scheduling policy with priority {priority}.',
        )


def set_cpu_affinity(cores: Sequence[int], log: Log) -> None:
    """Run the calling thread on these cores only; none: on any."""
    if not cores:
        return
    available = sorted(os.sched_getaffinity(0))
    try:
        os.sched_setaffinity(0, cores)
    except (OSError, ValueError, OverflowError) as error:
        log(
            Severity.WARN,
            f'Could not set the CPU affinity {list(cores)}: {error}; this process may use the '
            f'cores {available}',
        )


def lock_memory(log: Log) -> None:
    """Keep the memory of the process in RAM, so that no page fault delays a cycle."""
    if ctypes.CDLL(None, use_errno=True).mlockall(_LOCK_ALL) == 0:
        return
    error = ctypes.get_errno()
    log(
        Severity.WARN,
        f'Unable to lock the memory: {os.strerror(error)}; to allow it, add your user to a group '
        "with 'memlock unlimited' in /etc/security/limits.conf",
    )
