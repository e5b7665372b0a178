# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Wait for what others do meanwhile: threads, processes, the graph."""

import time

from support.ros_processes import PATIENCE


def until(condition, *, every=0.01, shown=lambda: ''):
    """
    Wait until a condition is true, and return what it returned.

    Args:
        condition: asked ``every`` s; it may do what has to go on meanwhile.
        every: s.
        shown: returns what is shown when it was waited for in vain.
    """
    deadline = time.monotonic() + PATIENCE
    while not (found := condition()):
        assert time.monotonic() < deadline, f'waited in vain {shown()}'
        time.sleep(every)
    return found
