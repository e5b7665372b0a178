# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
One launch file, tried as it is: whether it comes up, and whether its robot drives.

It is started by ``ros2 launch`` in a process and a ROS domain of its own. Once it says that it is
ready, each topic that takes velocity commands is tried until a robot has moved, by the odometry.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import StrEnum
import math
import os
from pathlib import Path
import queue
import re
import signal
import subprocess
import sys
import threading
import time
from typing import Any

from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data

from amr_description.ros.service_calls import wait_until
from amr_description.ros.type_mismatch import (
    is_wanted,
    listeners,
    other_topics,
    wants_stamped,
)
from amr_description.simulation.topics.names import ODOM_TOPIC
from amr_description.testing.program import DOMAIN, take_domain

_DISCOVERY, _DRIVE = 4.0, 8.0
"""s for the topics of a launch that is ready, and s of commands on one of them."""
_SETTLING = 2.0
"""s after which a process that dies of its parameters has died."""
_SPEED, _PERIOD, _MOVED = 0.3, 0.1, 0.2
"""m/s, s between two commands, and m: more than a robot that is put down slides."""
_STOP_TIMEOUT = 25.0
"""s from SIGINT to SIGKILL."""
_ODOMETRY = 'nav_msgs/msg/Odometry'

_OF_LAUNCH = re.compile(r'\[(?:INFO|WARNING|ERROR)\] \[launch\]: (.*)')
_OF_PROCESS = re.compile(r'\[([\w.-]+-\d+)\] (.*)')
_DEATH = re.compile(r'\[ERROR\] \[([\w.-]+-\d+)\]: process has died \[pid \d+, (exit code -?\d+)')
_FAULT = re.compile(r'^\[(?:ERROR|FATAL)\] (?:\[[^]]*\] ?)*:? ?(.*)|^(\w*(?:Error|Exception): .*)')


class LaunchVerdict(StrEnum):
    """What a launch file does."""

    DRIVES = 'drives'
    COMES_UP = 'comes up'
    NOTHING = 'starts nothing'
    FAILS = 'does not come up'
    REFUSED = 'refused'


@dataclass
class LaunchFinding:
    """What came of one launch file."""

    file: str
    verdict: LaunchVerdict = LaunchVerdict.FAILS
    reason: str = ''
    """Why it is no better; of one that drives, by which topic."""
    seconds: float = 0.0
    left_out: list[str] = field(default_factory=list)
    """What it names that cannot be here, and what does it instead."""


@dataclass
class LaunchLog:
    """What is understood of the lines of a launch, as they come."""

    is_ready: bool = False
    starts_nothing: bool = False
    blocked: str = ''
    """Why it never gets ready."""
    waiting: str = ''
    """What it waits for."""
    deaths: list[str] = field(default_factory=list)
    """Processes that died, each with its last words."""
    left_out: list[str] = field(default_factory=list)
    last: str = ''
    _words: dict[str, str] = field(default_factory=dict)

    def take(self, line: str) -> None:
        """Understand a line."""
        line = line.rstrip()
        self.last = line or self.last
        if died := _DEATH.match(line):
            name, code = died.groups()
            self.deaths.append(f'{name}: {self._words.get(name, f"it died with {code}")}')
        elif said := _OF_LAUNCH.match(line):
            self._take_launch(said[1])
        elif (said := _OF_PROCESS.match(line)) and (fault := _FAULT.match(said[2])):
            self._words[said[1]] = fault[1] or fault[2]

    def _take_launch(self, text: str) -> None:
        if text.startswith('ready in'):
            self.is_ready = True
        elif text.startswith('nothing is started'):
            self.starts_nothing = True
        elif text.startswith('never gets ready'):
            self.blocked = text
        elif ' is left out: ' in text:
            self.left_out.append(text)
        elif ' waits until ' in text:
            self.waiting = text.partition(': ')[2] or text

    @property
    def is_decided(self) -> bool:
        """Whether it is known if it comes up."""
        return self.is_ready or bool(self.blocked)


class RunningLaunch:
    """A launch in a process of its own, whose lines are understood as they come."""

    def __init__(self, path: Path, arguments: Sequence[str], domain: int) -> None:
        """Start it."""
        self.log = LaunchLog()
        self._process = subprocess.Popen(
            [sys.executable, '-m', 'amr_description.cli', 'ros2', 'launch', str(path), *arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**os.environ, DOMAIN: str(domain)},
            start_new_session=True,
        )
        self._lines: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def exit_code(self) -> int | None:
        """None: it runs."""
        return self._process.poll()

    def follow(self, seconds: float, *, until_decided: bool = False) -> bool:
        """
        Understand its lines for so many s, or until it has ended.

        Args:
            seconds: of the wall clock.
            until_decided: stop when it is known whether it comes up.

        Returns:
            Whether it has ended.
        """
        deadline = time.monotonic() + seconds
        while not (until_decided and self.log.is_decided):
            try:
                line = self._lines.get(timeout=max(0.0, deadline - time.monotonic()))
            except queue.Empty:
                return False
            if line is None:
                self._process.wait()
                return True
            self.log.take(line)
        return False

    def stop(self) -> None:
        """End it, and all that it started."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
            try:
                self._process.wait(_STOP_TIMEOUT)
            except subprocess.TimeoutExpired:
                os.killpg(self._process.pid, signal.SIGKILL)
                self._process.wait()
        self._reader.join(_STOP_TIMEOUT)

    def _read(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            self._lines.put(line.decode(errors='replace'))
        self._lines.put(None)


def try_launch_file(
    name: str, path: Path, arguments: Sequence[str], timeout: float
) -> LaunchFinding:
    """
    Try a launch file.

    Args:
        name: how it is called in the table.
        path: the file.
        arguments: ``name:=value``.
        timeout: s until it has to be ready.

    Raises:
        SimulationError: no ROS domain is free.
    """
    found = LaunchFinding(name)
    begin = time.monotonic()
    domain, lock = take_domain()
    launch = RunningLaunch(path, arguments, domain)
    try:
        has_ended = launch.follow(timeout, until_decided=True)
        if not has_ended and launch.log.is_decided:
            has_ended = launch.follow(_SETTLING)
        found.verdict, found.reason = judge_launch(launch.log, launch.exit_code, timeout)
        if found.verdict is LaunchVerdict.COMES_UP and not has_ended:
            with _driver(domain) as driver:
                moved, why = driver.drive()
            found.verdict = LaunchVerdict.DRIVES if moved else LaunchVerdict.COMES_UP
            found.reason = why
    finally:
        launch.stop()
        os.close(lock)
    found.left_out, found.seconds = launch.log.left_out, time.monotonic() - begin
    return found


def judge_launch(
    log: LaunchLog, exit_code: int | None, timeout: float
) -> tuple[LaunchVerdict, str]:
    """
    Return what a launch does before anything is driven, and why it is no better.

    Args:
        log: what it has said.
        exit_code: None: it runs.
        timeout: s that it was given to get ready.
    """
    if log.starts_nothing:
        return LaunchVerdict.NOTHING, ''
    if log.deaths:
        return LaunchVerdict.FAILS, log.deaths[0]
    if log.is_ready:
        return LaunchVerdict.COMES_UP, ''
    if log.blocked:
        return LaunchVerdict.FAILS, log.blocked
    if exit_code is None:
        return LaunchVerdict.FAILS, log.waiting or f'it was not ready within {timeout:g} s'
    refusal = log.last.removeprefix('ros2 launch: ')
    return LaunchVerdict.REFUSED, refusal or f'it ended with {exit_code}'


@contextmanager
def _driver(domain: int) -> Iterator['TrialDriver']:
    """Have a node in the domain of the launch."""
    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain)
    try:
        node = Node('try_launch_files', context=context)
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        yield TrialDriver(node)
    finally:
        rclpy.try_shutdown(context=context)


class TrialDriver:
    """Drives the robots of a graph."""

    def __init__(self, node: Node) -> None:
        """``node``: it is spun here."""
        self._node = node
        self._starts: dict[str, tuple[float, float]] = {}
        self._farthest = 0.0

    def drive(self) -> tuple[bool, str]:
        """Return whether a robot was moved by a command, and by which topic, or why not."""
        topics = wait_until(
            self._node, lambda: other_topics(self._node) or None, timeout=_DISCOVERY
        )
        if not topics:
            return False, ''
        sources = wait_until(self._node, self._odometries, timeout=_DISCOVERY)
        if not sources:
            return False, f'{topics[0]} takes commands, and there is no odometry'
        for source in sources:
            self._node.create_subscription(
                Odometry, source, lambda each, name=source: self._hear(name, each),
                qos_profile_sensor_data,
            )  # fmt: skip
        for topic in sorted(topics, key=len):
            if self._has_moved_by(topic):
                return True, f'by {topic}'
        return False, f'nothing moved by commands on {" and ".join(sorted(topics))}'

    def _odometries(self) -> list[str] | None:
        """Return the topics of the truth, or, without a simulator, those of odometry."""
        names = [
            name
            for name, types in self._node.get_topic_names_and_types()
            if _ODOMETRY in types and self._node.count_publishers(name)
        ]
        return [name for name in names if name.endswith(ODOM_TOPIC)] or names or None

    def _hear(self, source: str, message: Odometry) -> None:
        place = message.pose.pose.position
        start = self._starts.setdefault(source, (place.x, place.y))
        self._farthest = max(self._farthest, math.dist(start, (place.x, place.y)))

    def _has_moved_by(self, topic: str) -> bool:
        """Return whether commands on a topic move a robot."""
        node = self._node
        found = listeners(node, topic)
        stamped = wants_stamped(found, otherwise=is_wanted(found, True))
        kind: Any = TwistStamped if stamped else Twist
        message = kind()
        twist = message.twist if stamped else message
        twist.linear.x = _SPEED
        commands = node.create_publisher(kind, topic, 10)
        timer = node.create_timer(_PERIOD, lambda: commands.publish(message))
        self._starts, self._farthest = {}, 0.0
        try:
            return bool(wait_until(node, lambda: self._farthest > _MOVED or None, timeout=_DRIVE))
        finally:
            timer.cancel()
            commands.publish(kind())
            node.destroy_publisher(commands)
