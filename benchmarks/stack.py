# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stacks that are measured: started as a user does it, driven, and ended."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
import signal
import subprocess
import sys
import threading
import time
from typing import Any

from geometry_msgs.msg import TwistStamped
from rclpy.node import Node

from amr_description.errors import BringupError
from amr_description.ros.service_calls import wait_until

ROOT = Path(__file__).parents[1]
"""The checkout."""
COMMAND_TOPIC = '/diff_drive_controller/cmd_vel'
TIMEOUT = 60.0
"""s, for what should take a few."""

_READY = '[INFO] [launch]: ready in'
_START_TIMEOUT = 120.0
_STOP_TIMEOUT = 15.0
_SPEED = (0.5, 0.5)
"""m/s and rad/s: a circle."""
_COMMAND_PERIOD = 0.1
"""s, as a page or a joystick sends them."""


class BringUp:
    """One run of a stack; each line of its output is kept with its time."""

    def __init__(
        self, *words: str, root: Path = ROOT, environment: Mapping[str, str] | None = None
    ) -> None:
        """
        Start ``scripts/run``.

        Args:
            words: Of its command line.
            root: The checkout.
            environment: None: that of this program.
        """
        self.lines: list[tuple[float, str]] = []
        self._is_ready = threading.Event()
        self._start = time.monotonic()
        self._process = subprocess.Popen(
            [str(root / 'scripts' / 'run'), *words],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors='replace',
            start_new_session=True,
            env=environment,
        )
        self._reader = threading.Thread(target=self._read, name='bring-up output')
        self._reader.start()

    @property
    def pid(self) -> int:
        """Of the bring-up."""
        return self._process.pid

    def wait_until_ready(self, timeout: float = _START_TIMEOUT) -> float:
        """Return the time from the start, s. Raises BringupError: it has ended, or takes long."""
        self._is_ready.wait(timeout)
        for at, line in self.lines:
            if line.startswith(_READY):
                return at
        last = self.lines[-1][1] if self.lines else 'nothing'
        raise BringupError(f'the stack is not ready after {timeout:g} s; its last line: {last}')

    def stop(self) -> None:
        """Send SIGINT and wait for the end. Raises BringupError: it does not end."""
        try:
            end(self._process)
        finally:
            self._reader.join(_STOP_TIMEOUT)

    def _read(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            self.lines.append((time.monotonic() - self._start, line.rstrip('\n')))
            if line.startswith(_READY):
                self._is_ready.set()
        self._is_ready.set()


@contextmanager
def bring_up(*words: str) -> Iterator[BringUp]:
    """Run a stack, ready to use, while inside."""
    run = BringUp(*words)
    try:
        run.wait_until_ready()
        yield run
    finally:
        run.stop()


def run(executable: str, *arguments: str) -> None:
    """Run an executable to its end. Raises BringupError: it fails."""
    command = _command(executable, *arguments)
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False)
    if done.returncode:
        raise BringupError(f'{executable} has failed: {done.stderr.strip()}')


@contextmanager
def running(executable: str, *arguments: str) -> Iterator[subprocess.Popen[bytes]]:
    """Run an executable of this package while inside."""
    process = subprocess.Popen(
        _command(executable, *arguments), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        yield process
    finally:
        end(process)


def _command(executable: str, *arguments: str) -> list[str]:
    return [sys.executable, '-m', f'amr_description.nodes.{executable}', *arguments]


def end(process: subprocess.Popen[Any]) -> None:
    """Send SIGINT and wait for the end. Raises BringupError: it does not end."""
    process.send_signal(signal.SIGINT)
    try:
        process.wait(_STOP_TIMEOUT)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        raise BringupError(
            f'{process.args} did not end within {_STOP_TIMEOUT:g} s of SIGINT'
        ) from None


# --- driving --------------------------------------------------------------------------------


def command() -> TwistStamped:
    """Return a command without a stamp: it counts as stamped when it arrives."""
    message = TwistStamped()
    message.twist.linear.x, message.twist.angular.z = _SPEED
    return message


@contextmanager
def driving(
    node: Node, topics: Sequence[str] = (COMMAND_TOPIC,), *, wait: bool = True
) -> Iterator[None]:
    """
    Send commands to robots, from a thread, while inside.

    Args:
        node: Publishes them.
        topics: One for each robot.
        wait: Until all robots subscribe.
    """
    publishers = [node.create_publisher(TwistStamped, topic, 1) for topic in topics]
    done = threading.Event()

    def publish() -> None:
        message = command()
        while not done.wait(_COMMAND_PERIOD):
            for publisher in publishers:
                publisher.publish(message)

    thread = threading.Thread(target=publish, name='driving')
    try:
        if wait:
            _wait_for_subscribers(node, publishers)
        thread.start()
        yield
    finally:
        done.set()
        if thread.ident is not None:
            thread.join()
        for publisher in publishers:
            node.destroy_publisher(publisher)


def _wait_for_subscribers(node: Node, publishers: Sequence[Any]) -> None:
    def all_heard() -> bool | None:
        return all(each.get_subscription_count() for each in publishers) or None

    if not wait_until(node, all_heard, timeout=TIMEOUT):
        silent = next(each for each in publishers if not each.get_subscription_count())
        raise BringupError(f'nobody subscribes to {silent.topic_name} within {TIMEOUT:g} s')
