# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``tf2_monitor``: the rates, publishers and delays of transforms.

::

    ros2 run tf2_ros tf2_monitor                  # all frames
    ros2 run tf2_ros tf2_monitor odom base_link   # the chain between two frames

It prints the lines of the original every 10 s. Instead of ``<no authority available>`` it names
the nodes that publish on the topic.
"""

import threading
from typing import Any

from rclpy.node import Node
from tf2_msgs.msg import TFMessage

from amr_description.errors import TransformException
from amr_description.ros.messages import nanoseconds
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import (
    DEFAULT_STATIC_TF_TOPIC,
    DEFAULT_TF_TOPIC,
    TransformListener,
)
from amr_description.tf2_ros.statistics import TransformStatistics
from amr_description.tf2_ros.tools import (
    arguments_of,
    listening,
    print_now,
    run_tool,
    wait_for_transform,
)

USAGE = """\
TF_Monitor: usage: tf2_monitor [framea frameb]

Print every 10 s how often transforms come and how late they are: of all frames, or of those on
the way from one to another."""

_SAMPLES = 20  # delays of a chain, between two reports
_SAMPLE_TIME = 0.5  # s


class MonitoringListener(TransformListener):
    """Keeps statistics of the transforms that it puts into the buffer."""

    def __init__(self, buffer: Buffer, node: Node, **options: Any) -> None:
        self._lock = threading.Lock()
        self._statistics = TransformStatistics()
        super().__init__(buffer, node, **options)

    def callback(self, data: TFMessage) -> None:
        """Handle a message on /tf."""
        self._note(DEFAULT_TF_TOPIC, data, static=False)
        super().callback(data)

    def static_callback(self, data: TFMessage) -> None:
        """Handle a message on /tf_static."""
        self._note(DEFAULT_STATIC_TF_TOPIC, data, static=True)
        super().static_callback(data)

    def add_chain_delay(self, way: tuple[str, str]) -> None:
        """Note the present delay of the chain between two frames, if it is known."""
        try:
            latest = self.buffer.get_latest_common_time(*way)
        except TransformException:
            return
        with self._lock:
            self._statistics.add_chain_delay(latest.nanoseconds, self._now())

    def report(self, chain: list[str] | None) -> str:
        """Return the report; ``chain``: the frames of it, None for all frames."""
        publishers = self.publishers()
        with self._lock:
            return self._statistics.report(publishers, chain)

    def _note(self, topic: str, data: TFMessage, *, static: bool) -> None:
        received = [(one.child_frame_id, nanoseconds(one.header.stamp)) for one in data.transforms]
        with self._lock:
            self._statistics.add_message(topic, received, self._now(), static=static)

    def _now(self) -> int:
        return self.node.get_clock().now().nanoseconds


def monitor(args: list[str] | None) -> int:
    """Print until Ctrl-C; return the exit code."""
    frames = arguments_of(args)
    wants_help = not {'-h', '--help'}.isdisjoint(frames)
    if wants_help or len(frames) not in (0, 2):
        print_now(USAGE)
        return 0 if wants_help else 1
    with listening('tf2_monitor_main', args, MonitoringListener) as (node, buffer, listener):
        if frames:
            wait_for_transform(node, buffer, *frames)
        print_now(f'Gathering data on {" -> ".join(frames) or "all frames"} for 10 seconds...')
        while True:
            for _ in range(_SAMPLES):
                if frames:
                    listener.add_chain_delay((frames[0], frames[1]))
                threading.Event().wait(_SAMPLE_TIME)
            print_now(_report(buffer, listener, frames))


def main(args: list[str] | None = None) -> int:
    """Print until Ctrl-C."""
    return run_tool(lambda: monitor(args))


def _report(buffer: Buffer, listener: MonitoringListener, frames: list[str]) -> str:
    try:
        return listener.report(buffer.chain(*frames) if frames else None)
    except TransformException as error:  # the chain existed before; time may have jumped back
        return f'Exception thrown:{error}'


if __name__ == '__main__':
    raise SystemExit(main())
