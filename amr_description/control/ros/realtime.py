# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a control thread asks of Linux: a short time slice; on a robot priority, cores, memory, too.

All of it is optional. Where the latter are refused, as is usual without a real-time kernel or the
rights for it, there is a warning, and the loop runs as any other thread.

From Linux 6.12 on, a thread that wakes runs at once if its time slice is shorter than that of the
one that runs; with equal ones it may wait until that has used its own, some ms, where no core is
free. With some ten programs on two cores, threads that ran 0.5 ms each 10 ms at the same time woke
up 0.26 to 0.63 ms late with the usual slice, and 0.13 with :data:`SHORT_SLICE` (p50; p90: 3.3 to
4.3 and 1.6 to 3.5). That takes no rights, and no share of the processor from anybody.
"""

from collections.abc import Sequence
import ctypes
import os
import platform
import struct

from amr_description.log import Log, Severity

_LOCK_ALL = 1 | 2
"""MCL_CURRENT | MCL_FUTURE of mlockall(2)."""

SHORT_SLICE = 100_000
"""ns: the shortest time slice that Linux grants."""
USUAL_SLICE = 0

_SCHED_SETATTR = {'x86_64': 314, 'aarch64': 274}
"""Of syscall(2); glibc has no function for it before 2.41."""
_ATTRIBUTES = struct.Struct('=IIQiIQQQ')
"""``sched_attr``: size, policy, flags, nice, priority, runtime, deadline, period."""


def set_time_slice(slice_ns: int) -> bool:
    """
    Have the calling thread, and those that it starts, scheduled in slices of that time.

    Args:
        slice_ns: :data:`SHORT_SLICE` or :data:`USUAL_SLICE`.

    Returns:
        Whether Linux takes it, which one before 6.12 then ignores. It is not asked for a thread of
        another policy than SCHED_OTHER, such as SCHED_FIFO.
    """
    number = _SCHED_SETATTR.get(platform.machine())
    if number is None or os.sched_getscheduler(0) != os.SCHED_OTHER:
        return False
    nice = os.getpriority(os.PRIO_PROCESS, 0)  # on Linux that of the thread
    attributes = _ATTRIBUTES.pack(_ATTRIBUTES.size, os.SCHED_OTHER, 0, nice, 0, slice_ns, 0, 0)
    return ctypes.CDLL(None).syscall(number, 0, attributes, 0) == 0


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
