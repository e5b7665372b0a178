# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Measure the stack: its speed compared with MuJoCo alone, its start, and the load of its parts.

The stack is started as a user starts it, in a ROS domain of its own: once as fast as possible
(real-time factor 0), to measure its speed, and once in real time, to measure a warm start, the
``ros2`` command and the page. Then robot_state_publisher is measured, and a simulator with 1, 5,
10 and 20 robots. The same robots stepped by ``mj_step`` alone are the reference; that of one robot
is measured before and after, to notice a machine that changes its speed meanwhile.
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
from benchmarks.bare_loop import bare_real_time_factor
from benchmarks.command_line import command_figures
from benchmarks.fleet import fleet_figures
from benchmarks.real_time import GET_STATE, real_time_factor
from benchmarks.robot_state_publisher import transform_figures
from benchmarks.startup import phases_of, table
from benchmarks.viewer import viewer_figures

_BRINGUP = 'import sys; from amr_description.bringup.main import main; sys.exit(main())'
_READY = '[INFO] [launch]: ready in'
_START_TIMEOUT = 60.0
_STOP_TIMEOUT = 15.0


class BringUp:
    """One run of the stack ``simulation``; each line of its output is kept with its time."""

    def __init__(self, factor: int) -> None:
        """Start the stack at a real-time factor."""
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
        """Raise BringupError: it has ended, or is not ready in time."""
        self._is_ready.wait(_START_TIMEOUT)
        phases_of(self.lines)

    def stop(self) -> None:
        """Send SIGINT and wait for the end. Raises BringupError: it does not end."""
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
    """Run the stack at a real-time factor, ready to use, while inside."""
    run = BringUp(factor)
    try:
        run.wait_until_ready()
        yield run
    finally:
        run.stop()


def parser() -> argparse.ArgumentParser:
    """Make the parser."""
    options = argparse.ArgumentParser(prog='bench', description=__doc__.split('\n')[1])
    options.add_argument(
        '--seconds', type=float, default=5.0, help='duration of each measurement (5)'
    )
    options.add_argument('--domain-id', type=int, default=77, help='ROS domain to use (77)')
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
            get_state = node.create_client(GetEntityState, GET_STATE)
            full = real_time_factor(node, get_state, 'amr', options.seconds)
            node.destroy_client(get_state)
        # The first run has warmed the caches.
        print('in real time ...', flush=True)
        with bring_up(1) as run:
            phases = phases_of(run.lines)
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
{table(phases)}

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
    """Run the benchmarks; return the exit code."""
    return program(lambda: benchmark(parser().parse_args(args)))


if __name__ == '__main__':
    sys.exit(main())
