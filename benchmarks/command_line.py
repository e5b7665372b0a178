# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ``ros2`` command: its start, a list of topics, and the rates that it can follow."""

from array import array
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
import os
import re
import signal
import statistics
import subprocess
import threading
import time

from rclpy.node import Node
from sensor_msgs.msg import JointState

from amr_description.ros.messages import fill_stamp
from benchmarks.figures import Figures

_RUNS = 5
_QUICK_RUNS = 3
_HZ = 1000.0
_DOMAINS = 100
_RATE_LINE = re.compile(r'average rate: ([\d.]+)')
_JOINTS = tuple(
    f'joint_wheel_{end}_{side}' for end in ('back', 'front') for side in ('left', 'right')
)


def command_figures(node: Node, seconds: float, *, quick: bool = False) -> Figures:
    """
    Measure; a stack should be running, and nothing else.

    Args:
        node: Publishes the streams.
        seconds: Wall time of each measurement of a stream.
        quick: Only what has a goal.
    """
    listing = _median_time(['ros2', 'topic', 'list'], _QUICK_RUNS if quick else _RUNS)
    share = _hz_share(node, _HZ, seconds)
    doctor = ['ros2', 'doctor']
    alone = _median_time(doctor, _QUICK_RUNS, ROS_DOMAIN_ID=_other_domain())
    rows = [
        ('ros2 topic list', f'{listing:8.2f} s'),
        ('ros2 doctor, where nothing runs', f'{alone:8.2f} s'),
        (f'ros2 topic hz at {_HZ:g} Hz', f'{100.0 * share:8.1f} %'),
    ]
    if not quick:
        rows += [
            ('ros2 doctor, beside a robot', f'{_median_time(doctor):8.2f} s'),
            ('ros2 --help', f'{_median_time(["ros2", "--help"]):8.2f} s'),
            ('ros2 topic echo of JointState at 500 Hz', f'{_echo(node, 500.0, seconds):8.1f} Hz'),
        ]
    lines = [f'{name:<42}{value}' for name, value in rows]
    text = '\n'.join(('the ros2 command', *lines))
    return Figures({'list': listing, 'hz': 100.0 * share, 'doctor': alone}, text)


def _other_domain() -> str:
    """Return a ROS domain in which this measurement has no node."""
    return str((int(os.environ.get('ROS_DOMAIN_ID') or 0) + 1) % _DOMAINS)


def _median_time(command: Sequence[str], runs: int = _RUNS, **variables: str) -> float:
    """Return the median wall time of some runs of a command, s."""
    times = []
    environment = {**os.environ, **variables}
    for _ in range(runs):
        start = time.monotonic()
        subprocess.run(
            command,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env=environment,
            check=command[1] != 'doctor',  # which may find something
        )
        times.append(time.monotonic() - start)
    return statistics.median(times)


def _hz_share(node: Node, rate: float, seconds: float) -> float:
    """Return the last rate that ``ros2 topic hz`` shows, of that which was published."""
    topic = '/benchmark/hz'
    with stream(node, topic, rate) as published:
        text = _output_of(['ros2', 'topic', 'hz', topic], seconds)
        times = published()
    # Of either rate: the intervals between messages. What was before the first one is in neither.
    true_rate = (len(times) - 1) / (times[-1] - times[0])
    shown = _RATE_LINE.findall(text)
    return float(shown[-1]) / true_rate if shown else 0.0


def _echo(node: Node, rate: float, seconds: float) -> float:
    """Return the rate at which ``ros2 topic echo`` prints messages, Hz."""
    topic = '/benchmark/echo'
    with stream(node, topic, rate):
        text = _output_of(['ros2', 'topic', 'echo', topic], seconds)
    stamps = re.findall(r'sec: (\d+)\n +nanosec: (\d+)', text)
    if len(stamps) < 2:
        return 0.0
    first, last = (int(sec) + int(nanosec) * 1e-9 for sec, nanosec in (stamps[0], stamps[-1]))
    return (len(stamps) - 1) / (last - first)


def _output_of(command: Sequence[str], seconds: float) -> str:
    """Return the output of a command that is interrupted after ``seconds``."""
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    timer = threading.Timer(seconds, process.send_signal, [signal.SIGINT])
    timer.start()
    try:
        return process.communicate()[0]
    finally:
        timer.cancel()


@contextmanager
def stream(node: Node, topic: str, rate: float) -> Iterator[Callable[[], Sequence[float]]]:
    """
    Publish joint states of four joints at ``rate`` Hz, stamped with the wall clock.

    Yields what tells when each one was published, s.
    """
    times: list[float] = []
    publisher = node.create_publisher(JointState, topic, 10)
    done = threading.Event()

    def publish() -> None:
        zeros = array('d', [0.0] * len(_JOINTS))
        message = JointState(name=_JOINTS, position=zeros, velocity=zeros, effort=zeros)
        due = time.monotonic()
        while not done.wait(max(0.0, due - time.monotonic())):
            due += 1.0 / rate
            fill_stamp(time.time_ns(), message.header.stamp)
            publisher.publish(message)
            times.append(time.monotonic())

    thread = threading.Thread(target=publish, name='stream')
    thread.start()
    try:
        yield lambda: tuple(times)
    finally:
        done.set()
        thread.join()
        node.destroy_publisher(publisher)
