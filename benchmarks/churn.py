# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``python -m benchmarks.churn``: whether readers that come, go and are killed hold the robot up.

A simulator with one robot and its two controllers runs in a ROS domain of its own. Round after
round twelve processes subscribe to ``/joint_states``, ``/odom``, ``/tf`` and ``/clock``, live for
a random part of a second, and end: half of them by SIGKILL, half in good order. They have the
transports of any ROS 2 program, shared memory among them.

What is measured is the time between two messages on ``/clock``, by the stamps that the simulator's
own writer gives them, so that a late reader does not count. Two threads of the simulator may have
waited for a processor meanwhile, which the kernel counts (``/proc/PID/task/TID/schedstat``): that
much of a gap is the machine's. ``--apart`` has the readers live in another domain: the same load
without any connection, to compare with.

At the end the simulator is asked to stop, by SIGINT.
"""

import argparse
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
import multiprocessing
from multiprocessing.context import ForkServerProcess
import os
from pathlib import Path
import random
import signal
import subprocess
import sys
import time
from typing import Any

from nav_msgs.msg import Odometry
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from amr_description.ament_index import package_share
from amr_description.ros.runtime import program, ros, spinning

READERS = 12
"""Processes a round."""

LATE = 0.05
"""s: a control tick that is later counts."""

_LIFE = (0.1, 0.8)
"""s from the start of a reader to its end."""

_TOPICS = (
    (JointState, '/joint_states'),
    (Odometry, '/diff_drive_controller/odom'),
    (TFMessage, '/tf'),
    (Clock, '/clock'),
)
_PRELOADED = ['rclpy', 'nav_msgs.msg', 'rosgraph_msgs.msg', 'sensor_msgs.msg', 'tf2_msgs.msg']
_OURS = ('FASTRTPS_DEFAULT_PROFILES_FILE', 'FASTDDS_DEFAULT_PROFILES_FILE', 'ROS_SUPER_CLIENT')
_LOOK = 40_000_000
"""ns between two looks at what the kernel has counted."""
_NICE = 10
_FROZEN = 10.0
"""s without ``/clock`` after which the simulator counts as standing for good."""
_PATIENCE = 5.0
"""s for readers to end; one that then still is there is stuck in a lock of a dead one."""
_STOP_TIMEOUT = 15.0
_SHARED_MEMORY = Path('/dev/shm')


def read(life: float, domain: str) -> None:
    """Subscribe for ``life`` s, and end in good order; the process of a reader."""
    os.nice(_NICE)
    os.environ['ROS_DOMAIN_ID'] = domain
    for variable in _OURS:
        os.environ.pop(variable, None)
    rclpy.init(args=[])
    node = Node(f'reader_{os.getpid()}')
    for message_type, topic in _TOPICS:
        qos = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        node.create_subscription(message_type, topic, lambda _: None, qos)
    end = time.monotonic() + life
    while (left := end - time.monotonic()) > 0.0:
        rclpy.spin_once(node, timeout_sec=left)
    node.destroy_node()
    rclpy.shutdown()


@dataclass(frozen=True, slots=True)
class Gap:
    """Time between two messages on ``/clock`` that was too long, and what of it was waiting."""

    at: float
    """s since the start."""
    length: float
    waited: float
    """s for which a thread of the simulator was ready to run and had no processor."""


class ClockObserver:
    """Measures the time between the messages on ``/clock``, as their writer stamps them."""

    def __init__(self, node: Node, process: int) -> None:
        """``process``: the simulator."""
        self.gaps: list[Gap] = []
        self.longest = 0.0
        self.count = self.lost = 0
        self.last_heard = time.monotonic()
        self._process = process
        self._start = time.monotonic()
        self._last_stamp = 0
        self._looks: deque[tuple[int, dict[str, int]]] = deque([(0, {})], maxlen=1000)
        """When, ns of the system clock, as stamps are; and what each thread had waited."""
        self._last_number = sys.maxsize
        node.create_subscription(Clock, '/clock', self._hear, QoSProfile(depth=1000))

    def _hear(self, _: Clock, info: dict[str, Any]) -> None:
        stamp, number = info['source_timestamp'], info['publication_sequence_number']
        if time.time_ns() - self._looks[-1][0] > _LOOK:
            self._look()
        self.lost += max(0, number - self._last_number - 1)
        if number == self._last_number + 1:
            length = (stamp - self._last_stamp) * 1e-9
            self.longest = max(self.longest, length)
            if length > LATE:
                at = time.monotonic() - self._start
                self.gaps.append(Gap(at, length, self._waited_since(self._last_stamp)))
        self._last_stamp, self._last_number = stamp, number
        self.last_heard = time.monotonic()
        self.count += 1

    def _look(self) -> dict[str, int]:
        self._looks.append((time.time_ns(), waited := processor_waits(self._process)))
        return waited

    def _waited_since(self, stamp: int) -> float:
        """
        Return what has been waited since the last look before ``stamp``, s.

        What is heard now may have been sent long ago, as the observer waits for a processor too:
        the last look may be from after the gap.
        """
        before = next((w for at, w in reversed(self._looks) if at <= stamp), self._looks[0][1])
        times = sorted(now - before.get(thread, 0) for thread, now in self._look().items())
        return sum(times[-2:]) * 1e-9


def processor_waits(process: int) -> dict[str, int]:
    """Thread of a process → ns for which it has waited for a processor."""
    times = {}
    for path in Path(f'/proc/{process}/task').glob('*/schedstat'):
        try:
            times[path.parent.name] = int(path.read_text().split()[1])
        except (OSError, IndexError):  # a thread that has ended meanwhile
            continue
    return times


@contextmanager
def simulator(factor: float) -> Iterator[subprocess.Popen[bytes]]:
    """``mujoco_sim`` with a robot and its controllers, active; it is killed if it still runs."""
    share = package_share('amr_description')
    controllers = share / 'config' / 'controllers.yaml'
    process = subprocess.Popen(
        [
            *(sys.executable, '-m', 'amr_description.nodes.mujoco_sim', '--ros-args'),
            *('-p', f'real_time_factor:={factor}', '-p', f'controllers:={controllers}'),
        ],
        stdin=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        _run('create', '-file', str(share / 'urdf' / 'amr.urdf'), '-name', 'amr')
        _run('spawner', 'joint_state_broadcaster', 'diff_drive_controller')
        yield process
    finally:
        process.kill()
        process.wait()


def _run(executable: str, *arguments: str) -> None:
    subprocess.run(
        [sys.executable, '-m', f'amr_description.nodes.{executable}', *arguments],
        stdin=subprocess.DEVNULL,
        timeout=60.0,
        check=True,
    )


class Churn:
    """The readers."""

    def __init__(self, seed: int, domain: int) -> None:
        self._random = random.Random(seed)
        self._domain = str(domain)
        self.stuck = 0
        """Readers that did not end by themselves."""
        self._context = multiprocessing.get_context('forkserver')
        # A reader costs 0.1 s of processor time, and not the second that the imports take.
        self._context.set_forkserver_preload(_PRELOADED)

    def run_round(self) -> None:
        """Have twelve readers come and go."""
        readers = [self._start() for _ in range(READERS)]
        victims = self._random.sample(readers, READERS // 2)
        moments = sorted(self._random.uniform(*_LIFE) for _ in victims)
        begin = time.monotonic()
        for moment, reader in zip(moments, victims, strict=True):
            time.sleep(max(0.0, begin + moment - time.monotonic()))
            reader.kill()
        deadline = begin + _LIFE[1] + _PATIENCE
        for reader in readers:
            reader.join(max(0.0, deadline - time.monotonic()))
        stuck = [reader for reader in readers if reader.is_alive()]
        for reader in stuck:
            reader.kill()
        for reader in readers:
            reader.join()
            reader.close()
        if stuck:
            self.stuck += len(stuck)
            self.remove_ports()

    def remove_ports(self) -> None:
        """
        Take away the ports of the domain in shared memory: readers wait for a dead one in them.

        Otherwise there would be no reader left that gets as far as to subscribe.
        """
        first = 7400 + 250 * int(self._domain)
        for port in range(first, first + 250):
            for name in (f'fastrtps_port{port}', f'sem.fastrtps_port{port}_mutex'):
                (_SHARED_MEMORY / name).unlink(missing_ok=True)

    def _start(self) -> ForkServerProcess:
        life = self._random.uniform(*_LIFE)
        reader = self._context.Process(target=read, args=(life, self._domain), daemon=True)
        reader.start()
        return reader


def churn_figures(options: argparse.Namespace) -> int:
    """Measure and print; return the exit code: 1 when the simulator stood, or did not stop."""
    os.environ['ROS_DOMAIN_ID'] = str(options.domain_id)
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    churn = Churn(options.seed, options.domain_id + (1 if options.apart else 0))
    before = shared_memory()
    frozen = False
    with simulator(options.factor) as process, ros([]):
        node = Node('clock_observer')
        observer = ClockObserver(node, process.pid)
        with spinning(node, executor=SingleThreadedExecutor):  # EventsExecutor has no stamps
            done = 0
            for done in range(1, options.rounds + 1):
                churn.run_round()
                frozen = time.monotonic() - observer.last_heard > _FROZEN
                if done % 10 == 0 or frozen:
                    print(f'{done} rounds, longest {observer.longest * 1e3:.0f} ms', flush=True)
                if frozen:
                    break
            if frozen and options.hold:
                print(f'it stands after {done} rounds: pid {process.pid}', flush=True)
                time.sleep(options.hold)
            frozen = frozen or time.monotonic() - observer.last_heard > 1.0
        took = _stop(process)
    _report(observer, churn, done, frozen, took)
    left = shared_memory() - before
    print(f'left in {_SHARED_MEMORY}: {len(left)} files {" ".join(sorted(left)[:4])}')
    return 1 if frozen or took is None else 0


def shared_memory() -> set[str]:
    """The files that Fast DDS keeps in shared memory."""
    return {path.name for path in _SHARED_MEMORY.glob('*fastrtps*')}


def _stop(process: subprocess.Popen[bytes]) -> float | None:
    """How long the simulator takes to end after SIGINT, s; None: it does not."""
    start = time.monotonic()
    process.send_signal(signal.SIGINT)
    try:
        process.wait(_STOP_TIMEOUT)
    except subprocess.TimeoutExpired:
        return None
    return time.monotonic() - start


def _report(
    observer: ClockObserver, churn: Churn, rounds: int, frozen: bool, took: float | None
) -> None:
    late = [gap for gap in observer.gaps if gap.length - gap.waited > LATE]
    stop = f'not within {_STOP_TIMEOUT:g} s' if took is None else f'{took:.2f} s'
    print(
        f"""
rounds of {READERS} readers                  {rounds:8d}
readers that were stuck themselves    {churn.stuck:8d}
messages on /clock, and lost          {observer.count:8d} {observer.lost:8d}
longest time between two              {observer.longest * 1e3:8.1f} ms
longer than {LATE * 1e3:.0f} ms                     {len(observer.gaps):8d}
... and not for want of a processor   {len(late):8d}
stands for good                       {'yes' if frozen else 'no':>8}
ends after SIGINT                     {stop:>8}"""
    )
    for gap in sorted(observer.gaps, key=lambda each: each.waited - each.length)[:8]:
        print(
            f'  at {gap.at:7.1f} s: {gap.length * 1e3:6.1f} ms, '
            f'{gap.waited * 1e3:6.1f} ms of them without a processor'
        )


def parser() -> argparse.ArgumentParser:
    """Make the parser."""
    options = argparse.ArgumentParser(prog='churn', description=__doc__.split('\n')[1])
    options.add_argument('--rounds', type=int, default=500, help='of twelve readers (500)')
    options.add_argument('--factor', type=float, default=1.0, help='real-time factor (1)')
    options.add_argument('--seed', type=int, default=1, help='when which reader dies (1)')
    options.add_argument('--domain-id', type=int, default=78, help='ROS domain (78)')
    options.add_argument('--apart', action='store_true', help='readers in another domain')
    options.add_argument(
        '--hold', type=float, default=0.0, help='s to wait when it stands, for a debugger (0)'
    )
    return options


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: churn_figures(parser().parse_args(args)))


if __name__ == '__main__':
    sys.exit(main())
