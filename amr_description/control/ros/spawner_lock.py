# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A lock of spawners: two of this host never work on one controller at the same time.

One would configure it anew while the other activates it. Spawners of other controllers, and of
other robots, do not wait for each other; ros2_control has a single lock for the whole machine.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, ExitStack
import fcntl
import os
from pathlib import Path

from rclpy.node import Node

from amr_description.ros.service_calls import wait_until

_LOG_PERIOD = 10.0
"""s: how often it is logged that another one has the lock."""


@contextmanager
def exclusive_lock(node: Node, manager: str, controllers: Sequence[str]) -> Iterator[None]:
    """
    Be the only spawner of these controllers of ``manager`` (an absolute name) while inside.

    The locks are files in ``$ROS_HOME/locks`` (``~/.ros/locks``), and end with the process, in any
    case. Where that folder cannot be written there is no lock.
    """
    prefix = f'{node.context.get_domain_id()}{manager.replace("/", ".")}'
    with ExitStack() as stack:
        for name in sorted(set(controllers)):  # in one order, so that no two wait in a circle
            try:
                path = _folder() / f'spawner.{prefix}.{name}.lock'
                file = stack.enter_context(path.open('a'))
            except (OSError, RuntimeError) as error:
                node.get_logger().debug(f'without a lock: {error}')
                continue
            _acquire(node, file.fileno(), f'controller {name} of {manager} ({path})')
        yield


def _folder() -> Path:
    """Return the folder of the locks. Raises OSError; RuntimeError where nobody has a home."""
    folder = Path(os.environ.get('ROS_HOME') or Path.home() / '.ros') / 'locks'
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _acquire(node: Node, descriptor: int, what: str) -> None:
    def taken() -> bool | None:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return None
        return True

    def log_wait() -> None:
        node.get_logger().warning(f'Waiting for the spawner that works on {what}')

    wait_until(node, taken, log_wait, every=_LOG_PERIOD)
