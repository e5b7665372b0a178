# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the command-line programs of tf2 share: a listener that runs, and how they print."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import signal
import sys
from typing import Any, TypeVar

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from rclpy.utilities import remove_ros_args

from amr_description import streams
from amr_description.ros.runtime import argument_errors, program, ros, spinning
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener

Listener = TypeVar('Listener', bound=TransformListener)


def arguments_of(args: list[str] | None) -> list[str]:
    """Return the arguments of a program without those for ROS; None: those of the process."""
    return remove_ros_args(args)[0 if args is not None else 1 :]


@contextmanager
def listening(
    name: str,
    args: list[str] | None,
    listener: Callable[..., Listener] = TransformListener,  # type: ignore[assignment]
    **options: Any,
) -> Iterator[tuple[Node, Buffer, Listener]]:
    """
    Run a node with a listener in a thread while inside.

    Args:
        name: of the node.
        args: the command line, with its ROS arguments; None: that of the process.
        listener: called with a buffer, the node and ``options``.
        options: further arguments of ``listener``.
    """
    with ros(args):
        with argument_errors():
            node = Node(name)
            buffer = Buffer(clock=node.get_clock())
            running = listener(buffer, node, **options)
        with spinning(node):
            yield node, buffer, running


def wait_for_transform(
    node: Node, buffer: Buffer, source: str, target: str, time: Time | None = None
) -> None:
    """
    Wait until a transform can be looked up; log at once, and every second, why it cannot.

    Args:
        node: logs.
        buffer: in which it is looked up.
        source: the frame to which coordinates are transformed, as tf2_echo calls it.
        target: the frame in which they are given.
        time: of the transform; None: the latest.
    """
    lookup = (source, target, time or Time())
    timeout = Duration()
    while not (found := buffer.can_transform(*lookup, timeout, return_debug_tuple=True))[0]:
        node.get_logger().info(f'Waiting for transform {source} ->  {target}: {found[1]}')
        timeout = Duration(seconds=1)


def run_tool(body: Callable[[], int | None]) -> int:
    """Run a program that prints; return its exit code: 0 after Ctrl-C, its normal end."""

    def printing() -> int | None:
        if hasattr(sys.stdout, 'reconfigure'):  # names of frames come from the network
            sys.stdout.reconfigure(errors='backslashreplace')
        try:
            return body()
        except BrokenPipeError:  # | head has read enough
            streams.abandon_stdout()
            return 128 + signal.SIGPIPE

    return program(printing, stopped=0)


def print_now(text: str) -> None:
    """Print text and flush it."""
    print(text, flush=True)
