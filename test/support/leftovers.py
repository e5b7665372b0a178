# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Ends what a test has left to the garbage collection."""

import gc
import os

_known = {'files': [], 'sockets': 0}


def collect_participants():
    """
    Collect garbage where this process has more sockets than after the last time.

    A node that was not destroyed, or that rclpy destroys in part, is in a cycle of references, and
    its participant lives as long: under its name, in the graph of the tests that follow, until a
    collection ends it in the midst of one.
    """
    files = os.listdir('/proc/self/fd')
    if files == _known['files']:  # after most tests; a participant has ten and more
        return
    sockets = _open_sockets(files)
    if sockets > _known['sockets']:
        gc.collect()
        files = os.listdir('/proc/self/fd')
        sockets = _open_sockets(files)
    _known.update(files=files, sockets=sockets)


def _open_sockets(files):
    count = 0
    for name in files:
        try:
            count += os.readlink(f'/proc/self/fd/{name}').startswith('socket:')
        except OSError:  # closed in the meantime, by another thread
            continue
    return count
