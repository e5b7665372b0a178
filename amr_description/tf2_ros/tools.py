# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the programs of tf2 have in common: they listen, and print for whom it may concern."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import os
import signal
import sys
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from rclpy.utilities import remove_ros_args

from amr_description.ros.runtime import argument_errors, program, ros, spinning
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener


def words_of(args: list[str] | None) -> list[str]:
    """Return the words of a command line without ROS arguments; None: that of the process."""
    return remove_ros_args(args)[0 if args is not None else 1 :]


@contextmanager
def listening[Listener: TransformListener](
    name: str,
    args: list[str] | None,
    listener: Callable[..., Listener] = TransformListener,
    **options: Any,
) -> Iterator[tuple[Node, Buffer, Listener]]:
    """
    Run a node that listens to transforms, in a thread, while inside.

    :param listener: Makes the listener of a buffer, a node and ``options``.
    """
    with ros(args):
        with argument_errors():
            node = Node(name)
            buffer = Buffer(clock=node.get_clock())
            ears = listener(buffer, node, **options)
        with spinning(node):
            yield node, buffer, ears


def wait_for_transform(
    node: Node, buffer: Buffer, source: str, target: str, time: Time | None = None
) -> None:
    """Wait until a transform can be looked up; say now, and every second, why it cannot."""
    way = (source, target, time or Time())
    patience = Duration()
    while not (found := buffer.can_transform(*way, patience, return_debug_tuple=True))[0]:
        node.get_logger().info(f'Waiting for transform {source} ->  {target}: {found[1]}')
        patience = Duration(seconds=1)


def tool(body: Callable[[], int | None]) -> int:
    """Run a tool that prints; return its exit code: 0 after Ctrl-C, its normal end."""

    def printing() -> int | None:
        if hasattr(sys.stdout, 'reconfigure'):  # names of frames come from the network
            sys.stdout.reconfigure(errors='backslashreplace')
        try:
            return body()
        except BrokenPipeError:  # | head has seen enough
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 128 + signal.SIGPIPE

    return program(printing, stopped=0)


def say(text: str) -> None:
    """Print lines, at once."""
    print(text, flush=True)
