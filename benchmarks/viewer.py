# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The load of the page's node, and the delay from a key to the command on its topic."""

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
from benchmarks.figures import Figures
from benchmarks.processes import processor_time
from benchmarks.stack import driving

_URL = re.compile(r'The page is at (http://\S+)')
_MODULE = 'amr_description.nodes.viewer'
_TIMEOUT = 20.0
_KEYS = 100
"""Commands to measure."""
_STEP = 1e-4
"""rad/s between two commands, to distinguish them."""


def viewer_figures(node: Node, seconds: float, *, quick: bool = False) -> Figures:
    """
    Measure; a stack should be running, and nothing else.

    Args:
        node: Drives the robot, and reads the commands of the page.
        seconds: Wall time of each measurement of the load.
        quick: Only what has a goal.
    """
    values = {}
    lines = ['the page, the robot is driven              states         CPU of its node']
    with viewer() as (process, url):
        for count in (1,) if quick else (1, 5):
            with ExitStack() as stack, driving(node):
                pages = [stack.enter_context(PageClient(url)) for _ in range(count)]
                rate, share = load(node, pages, process.pid, seconds)
            values.setdefault('page', share)
            name = f'{count} page{"s" if count > 1 else ""}'
            lines.append(f'{name:<42}{rate:8.1f} Hz {share:8.1f} % of a core')
        if quick:
            return Figures(values, '\n'.join(lines))
        with PageClient(url) as page:
            times = delays(node, page)
    median, *_ = statistics.quantiles(times, n=2)
    late = statistics.quantiles(times, n=20)[-1]
    name = 'key to command, median and 95th percentile'
    lines.append(f'{name:<42}{1e3 * median:8.1f} ms {1e3 * late:8.1f} ms')
    return Figures(values, '\n'.join(lines))


@contextmanager
def viewer() -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Run a viewer on a free port, while inside; yield the process and its address."""
    process = subprocess.Popen(
        [sys.executable, '-m', _MODULE, '--ros-args', '-p', 'port:=0'],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stderr is not None
        found = next(filter(None, map(_URL.search, process.stderr)), None)
        if found is None:
            raise ViewerError('the viewer has ended without a page')
        yield process, found[1]
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate()


def load(node: Node, pages: list[PageClient], pid: int, seconds: float) -> tuple[float, float]:
    """Return states per second and page (Hz), and the load of the process (%)."""
    wait(node, lambda: all(page.states for page in pages) and _topic(pages[0]))
    settled = time.monotonic() + seconds / 4  # after one-time work, such as reading the model
    wait(node, lambda: time.monotonic() >= settled, seconds)
    states, spent, begin = sum(p.states for p in pages), processor_time(pid), time.monotonic()
    wait(node, lambda: time.monotonic() >= begin + seconds, seconds)
    elapsed = time.monotonic() - begin
    rate = (sum(p.states for p in pages) - states) / len(pages) / elapsed
    return rate, 100.0 * (processor_time(pid) - spent) / elapsed


def delays(node: Node, page: PageClient) -> list[float]:
    """Return the delays from sending a key on a page to the command's callback, s."""
    wait(node, lambda: _topic(page))
    sent: dict[int, float] = {}
    received: dict[int, float] = {}

    def on_command(message: TwistStamped) -> None:
        received.setdefault(round(message.twist.angular.z / _STEP), time.monotonic())

    subscription = node.create_subscription(TwistStamped, _topic(page), on_command, 100)
    try:
        wait(node, lambda: page.send('drive', robot='/', linear=0.0, angular=0.0) or received)
        for number in range(1, _KEYS + 1):
            sent[number] = time.monotonic()
            page.send('drive', robot='/', linear=0.0, angular=number * _STEP)
            wait(node, lambda number=number: number in received)
        page.send('stop', robot='/')
    finally:
        node.destroy_subscription(subscription)
    return [received[number] - at for number, at in sent.items()]


def _topic(page: PageClient) -> str:
    """Return the command topic of the robot; empty until it is known."""
    commands = [each['command'] for each in page.robots if each['id'] == '/']
    return commands[0]['topic'] if commands and commands[0] else ''


def wait(node: Node, condition: Callable[[], object], seconds: float = 0.0) -> None:
    """Spin the node until a condition holds. Raises ViewerError: it does not in time."""
    timeout = seconds + _TIMEOUT
    if wait_until(node, lambda: True if condition() else None, timeout=timeout) is None:
        raise ViewerError(
            f'the page sees no robot to drive after {timeout:g} s; does a stack run?'
        )
