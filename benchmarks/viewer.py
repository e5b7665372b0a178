# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the page costs, and how soon what it says is on the robot's topic."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, ExitStack
import re
import signal
import statistics
import subprocess
import sys
import time

from geometry_msgs.msg import TwistStamped
from rclpy.node import Node

from amr_description.errors import ViewerError
from amr_description.ros.service_calls import wait_until
from amr_description.viewer.client import PageClient
from benchmarks.robot_state_publisher import processor_time

_URL = re.compile(r'The page is at (http://\S+)')
_MODULE = 'amr_description.nodes.viewer'
_PATIENCE = 20.0
_KEYS = 100
_STEP = 1e-4
"""rad/s between two commands, that tells them apart."""


def viewer_figures(node: Node, seconds: float) -> str:
    """
    Measure, and return a table; a stack should be running, and be left alone.

    ``seconds``: wall time of each measurement of the load.
    """
    lines = ['the page                                   states         CPU of its node']
    with _viewer() as (process, url):
        for count in (1, 5):
            with ExitStack() as stack:
                pages = [stack.enter_context(PageClient(url)) for _ in range(count)]
                rate, load = _measured(node, pages, process.pid, seconds)
            name = f'{count} page{"s" if count > 1 else ""}'
            lines.append(f'{name:<42}{rate:8.1f} Hz {load:8.1f} % of a core')
        with PageClient(url) as page:
            delays = _delays(node, page)
    median, *_ = statistics.quantiles(delays, n=2)
    late = statistics.quantiles(delays, n=20)[-1]
    name = 'key to command, median and 95th percentile'
    lines.append(f'{name:<42}{1e3 * median:8.1f} ms {1e3 * late:8.1f} ms')
    return '\n'.join(lines)


@contextmanager
def _viewer() -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A viewer on a port of its own, and its address."""
    process = subprocess.Popen(
        [sys.executable, '-m', _MODULE, '--ros-args', '-p', 'port:=0'],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stderr is not None
        found = next(filter(None, map(_URL.search, process.stderr)))
        yield process, found[1]
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate()


def _measured(
    node: Node, pages: list[PageClient], pid: int, seconds: float
) -> tuple[float, float]:
    """States per second and page (Hz), and the load of the process (%)."""
    _wait(node, lambda: all(page.states for page in pages) and _topic(pages[0]))
    settled = time.monotonic() + seconds / 4  # the model has been read, and what else comes once
    _wait(node, lambda: time.monotonic() >= settled, seconds)
    states, spent, begin = sum(p.states for p in pages), processor_time(pid), time.monotonic()
    _wait(node, lambda: time.monotonic() >= begin + seconds, seconds)
    elapsed = time.monotonic() - begin
    rate = (sum(p.states for p in pages) - states) / len(pages) / elapsed
    return rate, 100.0 * (processor_time(pid) - spent) / elapsed


def _delays(node: Node, page: PageClient) -> list[float]:
    """From what a page says to the callback that hears the command: s, of each of some keys."""
    _wait(node, lambda: _topic(page))
    said: dict[int, float] = {}
    heard: dict[int, float] = {}

    def hear(message: TwistStamped) -> None:
        heard.setdefault(round(message.twist.angular.z / _STEP), time.monotonic())

    subscription = node.create_subscription(TwistStamped, _topic(page), hear, 100)
    try:
        _wait(node, lambda: page.send('drive', robot='/', linear=0.0, angular=0.0) or heard)
        for number in range(1, _KEYS + 1):
            said[number] = time.monotonic()
            page.send('drive', robot='/', linear=0.0, angular=number * _STEP)
            _wait(node, lambda number=number: number in heard)
        page.send('stop', robot='/')
    finally:
        node.destroy_subscription(subscription)
    return [heard[number] - at for number, at in said.items()]


def _topic(page: PageClient) -> str:
    """Where the commands of the robot go; nothing, as long as that is not known."""
    commands = [each['command'] for each in page.robots if each['id'] == '/']
    return commands[0]['topic'] if commands and commands[0] else ''


def _wait(node: Node, condition: Callable[[], object], seconds: float = 0.0) -> None:
    """Serve the node until a condition holds. Raises ViewerError: it does not."""
    timeout = seconds + _PATIENCE
    if wait_until(node, lambda: True if condition() else None, timeout=timeout) is None:
        raise ViewerError(
            f'the page sees no robot to drive after {timeout:g} s; does a stack run?'
        )
