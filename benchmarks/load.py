# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a whole stack takes: processor time in real time, memory after an hour, its set-up."""

from collections.abc import Sequence
from contextlib import ExitStack
import os
from pathlib import Path
import subprocess
import tempfile
import time

from nav_msgs.msg import Odometry
from rclpy.node import Node

from amr_description.errors import BringupError
from amr_description.ros.service_calls import wait_until
from benchmarks.cycle import driven_robot, listeners
from benchmarks.environment import without_checkout
from benchmarks.figures import Figures
from benchmarks.processes import name_of, processes_below, processor_time, resident
from benchmarks.stack import BringUp, driving, ROOT, TIMEOUT

_SETTLED = 300.0
"""s of simulated time, until all that grows only once has grown."""
_HOUR = 3600.0
_HOUR_TIMEOUT = 600.0
_COLD_TIMEOUT = 900.0
_SETUP = 'scripts/setup: '
"""What its lines begin with."""
_DRIVES = 0.1
"""m/s: a robot that is faster drives."""


def load_figures(node: Node, run: BringUp, seconds: float) -> Figures:
    """Measure the processor time of all processes of a stack, driven; no page is open."""
    with driving(node):
        time.sleep(1.0)
        processes, begin = processes_below(run.pid), time.monotonic()
        before = {pid: processor_time(pid) for pid in processes}
        time.sleep(seconds)
        spent = {pid: processor_time(pid) - before[pid] for pid in processes}
        wall = time.monotonic() - begin
    shares = {name_of(pid): 100.0 * took / wall for pid, took in spent.items()}
    load = 100.0 * sum(spent.values()) / wall
    rows = [
        f'{name:<42}{share:8.1f} % of a core'
        for name, share in sorted(shares.items(), key=lambda item: -item[1])
        if share >= 0.1
    ]
    head = 'the stack at factor 1, driven, page closed'
    return Figures({'load': load}, '\n'.join((f'{head:<42}{load:8.1f} % of a core', *rows)))


def memory_figures(node: Node) -> Figures:
    """Measure what a simulator has more of memory after an hour of simulated time, driven."""
    with driven_robot(node) as simulator, listeners(node, 'clock'):
        deadline = time.monotonic() + _HOUR_TIMEOUT

        def pass_time(until: float) -> int:
            """Return the resident memory (bytes) at a simulated time (s)."""
            while True:
                simulator.ask('time')
                if simulator.answer() >= until:
                    return resident(simulator.pid)
                if time.monotonic() > deadline:
                    raise BringupError(f'an hour takes more than {_HOUR_TIMEOUT:g} s')
                time.sleep(0.2)

        settled = pass_time(_SETTLED)
        begin = time.monotonic()
        after = pass_time(_SETTLED + _HOUR)
        wall = time.monotonic() - begin
    text = (
        f'an hour of simulated time in {wall:.0f} s: {settled / 1e6:.1f} MB before, '
        f'{after / 1e6:.1f} MB after'
    )
    return Figures({'memory': (after - settled) / 1e6}, text)


def fleet_start_figures(node: Node, robots: int = 10) -> Figures:
    """Measure the time from the command to the moment at which all robots of a fleet drive."""
    names = [f'robot{number}' for number in range(1, robots + 1)]
    driven: dict[str, float] = {}

    def watch(name: str) -> object:
        def on_odometry(message: Odometry) -> None:
            if message.twist.twist.linear.x > _DRIVES:
                driven.setdefault(name, time.monotonic())

        return node.create_subscription(Odometry, f'/{name}/odom', on_odometry, 1)

    with ExitStack() as stack:
        for name in names:
            stack.callback(node.destroy_subscription, watch(name))
        begin = time.monotonic()
        run = BringUp('fleet', f'robots:={robots}', 'viewer:=false')
        stack.callback(run.stop)
        stack.enter_context(driving(node, _topics(names), wait=False))
        if not wait_until(
            node, lambda: len(driven) == robots or None, timeout=TIMEOUT + 2.0 * robots
        ):
            raise BringupError(f'{len(driven)} of {robots} robots drive')
        return Figures({'fleet start': max(driven.values()) - begin})


def _topics(names: Sequence[str]) -> list[str]:
    return [f'/{name}/diff_drive_controller/cmd_vel' for name in names]


def cold_figures() -> Figures:
    """
    Measure a new clone of this checkout's last commit: set-up, start, both controllers active.

    What uv and pip have cached stays cached; what is fetched from elsewhere is fetched. Nothing
    of this checkout is used.
    """
    with tempfile.TemporaryDirectory() as folder:
        clone = Path(folder) / 'clone'
        subprocess.run(['git', 'clone', '-q', str(ROOT), str(clone)], check=True)
        run = BringUp('simulation', root=clone, environment=without_checkout(os.environ, ROOT))
        try:
            ready = run.wait_until_ready(_COLD_TIMEOUT)
            said = (f'{at:8.1f} s  {line}' for at, line in run.lines if _SETUP in line)
            head = f'a cold set-up and start: ready after {ready:.1f} s'
            return Figures({'cold': ready}, '\n'.join((head, *said)))
        finally:
            run.stop()
