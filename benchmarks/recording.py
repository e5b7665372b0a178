# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 bag record`` records of many small messages, and of large ones."""

import os
from pathlib import Path
import signal
import subprocess
import tempfile
import time

from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Image
from std_msgs.msg import String

from amr_description.bag import metadata
from amr_description.errors import BringupError
from amr_description.ros.rclpy_internals import bytes_publisher
from amr_description.ros.service_calls import wait_until
from benchmarks.figures import Figures
from benchmarks.processes import processor_time
from benchmarks.stack import TIMEOUT

_SMALL = (String(data='x' * 91), 20_000.0, 5000)
_LARGE = (Image(data=bytes(1_000_000)), 200.0, 50)
"""A message, how many a second, and how many the publisher keeps."""
_SETTLED = 1.0  # s; what was sent last arrives, and is written
_SHORTEST = 0.0005  # s that are slept


def recording_figures(node: Node, seconds: float) -> Figures:
    """Measure each stream for a time, s, without anything else running."""
    lines, values = [], {}
    for key, name, (message, rate, depth) in (
        ('small', 'messages of 100 B, 20,000/s', _SMALL),
        ('large', 'images of 1 MB, 200/s', _LARGE),
    ):
        share, load, sent = _recorded(node, message, rate, depth, seconds)
        values[key] = 100.0 * share
        lines.append(f'{name:<42}{100.0 * share:8.2f} % recorded, {100.0 * load:.0f} % of a core')
        lines.append(f'{"":<42}{sent:8.0f} /s sent')
    return Figures(values, '\n'.join(('ros2 bag record', *lines)))


def _recorded(
    node: Node, message: String | Image, rate: float, depth: int, seconds: float
) -> tuple[float, float, float]:
    """Return the recorded share, the load of the recorder, and the rate at which was sent, Hz."""
    data = serialize_message(message)
    publisher = node.create_publisher(type(message), '/recorded', QoSProfile(depth=depth))
    publish = bytes_publisher(publisher)
    # In memory, as it is not the disk that is measured.
    memory = '/dev/shm' if os.path.isdir('/dev/shm') else None  # noqa: S108
    with tempfile.TemporaryDirectory(dir=memory) as folder:
        bag = Path(folder, 'bag')
        recorder = subprocess.Popen(
            ['ros2', 'bag', 'record', '--topics', '/recorded', '-o', str(bag)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            if not wait_until(
                node, lambda: publisher.get_subscription_count() or None, timeout=TIMEOUT
            ):
                raise BringupError('ros2 bag record has not subscribed')
            time.sleep(_SETTLED)
            before, began = processor_time(recorder.pid), time.monotonic()
            count = round(rate * seconds)
            for number in range(count):
                left = began + number / rate - time.monotonic()
                if left > _SHORTEST:
                    time.sleep(left)
                publish(data)
            took = time.monotonic() - began
            time.sleep(_SETTLED)
            load = (processor_time(recorder.pid) - before) / took
            recorder.send_signal(signal.SIGINT)
            recorder.wait(TIMEOUT)
        finally:
            recorder.kill()
            recorder.wait()
            node.destroy_publisher(publisher)
        return metadata.read(bag).message_count / count, load, count / took
