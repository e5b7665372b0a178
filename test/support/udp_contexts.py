# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Have the participants of the tests themselves share no memory with others.

With ``ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST`` those of a plain ``rclpy.init()`` do, on ports
that all domains of a host have in common: beside a load of six, one of 250 nodes then took 2 s to
be made or to end, in which no thread of the process runs, as rclpy holds the interpreter's lock
(``amr_description.ros.transport``).
"""

from collections.abc import Iterator
from contextlib import contextmanager
import functools
import os
import sys
from unittest import mock

from amr_description.ros.transport import udp_only

_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'


def use_udp_only() -> None:
    """Have every context of this process that is initialised from now on use UDP alone."""
    if (rclpy := sys.modules.get('rclpy')) is None:
        return
    original = rclpy.Context.init

    @functools.wraps(original)
    def init(*arguments, **options):
        if os.environ.get(_RANGE) != 'LOCALHOST':  # as also inside of udp_only()
            return original(*arguments, **options)
        with udp_only():
            return original(*arguments, **options)

    rclpy.Context.init = init


@contextmanager
def as_any_program() -> Iterator[None]:
    """Inside, contexts are initialised as in programs that others wrote."""
    import rclpy

    original = getattr(rclpy.Context.init, '__wrapped__', rclpy.Context.init)
    with mock.patch.object(rclpy.Context, 'init', original):
        yield
