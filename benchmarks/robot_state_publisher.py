# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""robot_state_publisher: the rate that it keeps, and its load."""

from collections.abc import Iterator
from contextlib import contextmanager
import signal
import subprocess
import sys
import time

from rclpy.node import Node
from tf2_msgs.msg import TFMessage

from amr_description.ament_index import package_share
from amr_description.ros.service_calls import wait_until
from benchmarks.command_line import stream
from benchmarks.figures import Figures
from benchmarks.processes import processor_time

_FOLDER = '/benchmark'
_JOINT_STATES = f'{_FOLDER}/joint_states'


def transform_figures(node: Node, seconds: float, *, quick: bool = False) -> Figures:
    """
    Measure: joint states of four wheels in, 20 Hz of transforms out.

    Args:
        node: Publishes the joint states.
        seconds: Wall time of each measurement.
        quick: Only what has a goal.
    """
    values = {}
    lines = ['robot_state_publisher                        /tf          CPU']
    for rate in (100.0,) if quick else (100.0, 1000.0):
        with _publisher() as process, stream(node, _JOINT_STATES, rate):
            published, load = _measured(node, process.pid, seconds)
        values.setdefault('transforms', load)
        name = f'{rate:g} Hz of joint states'
        lines.append(f'{name:<42}{published:8.2f} Hz {load:8.1f} % of a core')
    return Figures(values, '\n'.join(lines))


@contextmanager
def _publisher() -> Iterator[subprocess.Popen]:
    """Run a robot_state_publisher with topics of its own, while inside."""
    urdf = package_share('amr_description') / 'urdf' / 'amr.urdf'
    remappings = [
        word
        for topic in ('joint_states', 'robot_description', '/tf', '/tf_static')
        for word in ('-r', f'{topic}:={_FOLDER}/{topic.removeprefix("/")}')
    ]
    module = 'amr_description.nodes.robot_state_publisher'
    process = subprocess.Popen(
        [sys.executable, '-m', module, str(urdf), '--ros-args', *remappings],
        stderr=subprocess.DEVNULL,
    )
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()


def _measured(node: Node, pid: int, seconds: float) -> tuple[float, float]:
    """Return transforms per second by their stamps (Hz), and the load of the process (%)."""
    stamps: list[float] = []

    def on_transforms(message: TFMessage) -> None:
        stamp = message.transforms[0].header.stamp
        stamps.append(stamp.sec + stamp.nanosec * 1e-9)

    subscription = node.create_subscription(TFMessage, f'{_FOLDER}/tf', on_transforms, 1000)
    try:
        wait_until(node, lambda: stamps or None, lambda: None, every=1.0, timeout=20.0)
        stamps.clear()
        before, begin = processor_time(pid), time.monotonic()
        end = begin + seconds
        wait_until(node, lambda: time.monotonic() >= end or None, lambda: None, every=seconds)
        load = (processor_time(pid) - before) / (time.monotonic() - begin)
    finally:
        node.destroy_subscription(subscription)
    if len(stamps) < 2:
        return 0.0, 100.0 * load
    return (len(stamps) - 1) / (stamps[-1] - stamps[0]), 100.0 * load
