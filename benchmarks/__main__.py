# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``benchmark``: how much of the physics' speed the whole stack keeps, and how long a start takes.

The stack is started as a user starts it, in a ROS domain of its own: once as fast as possible
(real-time factor 0), to see how fast that is, and once in real time, to see how long a warm start
takes. Then a simulator is filled with 1, 5, 10 and 20 robots. The same robots, stepped by nothing
but ``mj_step``, are measured beside it; one of them before and after, so that a machine that
changes its speed meanwhile is noticed.
"""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import os
import signal
import subprocess
import sys
import threading
import time

from rclpy.node import Node
from simulation_interfaces.srv import GetEntityState

from amr_description.ament_index import package_share
from amr_description.errors import BringupError
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import call, wait_until
from benchmarks.bare_loop import bare_real_time_factor
from benchmarks.command_line import command_figures
from benchmarks.fleet import fleet_figures
from benchmarks.robot_state_publisher import transform_figures
from benchmarks.startup import stages_of, table
from benchmarks.viewer import viewer_figures

_BRINGUP = 'import sys; from amr_description.bringup.main import main; sys.exit(main())'
_READY = '[INFO] [launch]: ready in'
_START_TIMEOUT = 60.0
_STOP_TIMEOUT = 15.0


class BringUp:
    """One run of the stack ``simulation``; its lines are kept with the time of their coming."""

    def __init__(self, factor: int) -> None:
        """Start it at a real-time factor."""
        self.lines: list[tuple[float, str]] = []
        self._is_ready = threading.Event()
        self._start = time.monotonic()
        self._process = subprocess.Popen(
            [sys.executable, '-c', _BRINGUP, 'simulation', f'rtf:={factor}'],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors='replace',
            start_new_session=True,
        )
        self._reader = threading.Thread(target=self._read, name='bring-up output')
        self._reader.start()

    def wait_until_ready(self) -> None:
        """Raises BringupError when it ends, or is not ready in time."""
        self._is_ready.wait(_START_TIMEOUT)
        stages_of(self.lines)

    def stop(self) -> None:
        """End it as Ctrl-C does, and wait for that."""
        self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(_STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            raise BringupError(
                f'the bring-up did not end within {_STOP_TIMEOUT:g} s of SIGINT'
            ) from None
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
def bring_up(factor: int) -> Iterator[BringUp]:
    """The stack at a real-time factor, ready; it is ended in every way out."""
    run = BringUp(factor)
    try:
        run.wait_until_ready()
        yield run
    finally:
        run.stop()


def real_time_factor(node: Node, seconds: float) -> float:
    """Simulated over wall time of the running simulator, over ``seconds`` of wall time."""
    simulated_before, wall_before = _simulated_time(node)
    deadline = wall_before + seconds
    wait_until(node, lambda: time.monotonic() >= deadline or None, lambda: None, every=seconds)
    simulated_after, wall_after = _simulated_time(node)
    return (simulated_after - simulated_before) / (wall_after - wall_before)


def _simulated_time(node: Node) -> tuple[float, float]:
    """Simulated time, s, and the wall time at which that was told."""
    request = GetEntityState.Request(entity='amr')
    response = call(node, GetEntityState, '/mujoco_sim/get_entity_state', request)
    stamp = response.state.header.stamp
    return stamp.sec + stamp.nanosec * 1e-9, time.monotonic()


def parser() -> argparse.ArgumentParser:
    """Make the parser."""
    options = argparse.ArgumentParser(prog='bench', description=__doc__.split('\n')[1])
    options.add_argument(
        '--seconds', type=float, default=5.0, help='how long each speed is measured (5)'
    )
    options.add_argument(
        '--domain-id', type=int, default=77, help='ROS domain in which it happens (77)'
    )
    return options


def benchmark(options: argparse.Namespace) -> int:
    """Measure and print; return the exit code."""
    os.environ['ROS_DOMAIN_ID'] = str(options.domain_id)
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    urdf = (package_share('amr_description') / 'urdf' / 'amr.urdf').read_text(encoding='utf-8')
    with ros([]):
        node = Node('benchmark')
        before = bare_real_time_factor(urdf, options.seconds / 2)
        print('as fast as possible ...', flush=True)
        with bring_up(0):
            full = real_time_factor(node, options.seconds)
        # The run before has warmed the caches.
        print('in real time ...', flush=True)
        with bring_up(1) as run:
            stages = stages_of(run.lines)
            print('the ros2 command ...', flush=True)
            commands = command_figures(node, options.seconds)
            print('the page ...', flush=True)
            page = viewer_figures(node, options.seconds)
        print('robot_state_publisher ...', flush=True)
        transforms = transform_figures(node, options.seconds)
        after = bare_real_time_factor(urdf, options.seconds / 2)
        print('many robots ...', flush=True)
        fleet = fleet_figures(node, urdf, options.seconds / 2)
        node.destroy_node()
    bare = (before + after) / 2
    print(f"""
{table(stages)}

real-time factor                        at factor 0
mj_step alone, before and after      {before:8.1f} {after:8.1f}
full stack                           {full:8.1f}
full stack / mj_step alone           {full / bare:8.3f}

{fleet}

{commands}

{transforms}

{page}""")
    return 0


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: benchmark(parser().parse_args(args)))


if __name__ == '__main__':
    sys.exit(main())
