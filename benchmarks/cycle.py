# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
One robot in a simulator with a probe: its speed, and where the time of a cycle goes.

``python -m benchmarks.cycle [--heard none|clock|stack] [--seconds S]`` prints the processor time
of a cycle of the control loop by part, while the robot drives in a circle. It is good for a
comparison on a busy machine too, see :mod:`benchmarks.probed_simulator`.
"""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager, ExitStack
import json
import os
from pathlib import Path
import subprocess
import sys
import tempfile
from typing import Any

from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from amr_description.ament_index import package_share
from amr_description.errors import BringupError
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import wait_until
from amr_description.viewer.client import PageClient
from benchmarks.adapted_controllers import adapted
from benchmarks.profiles import Profile, profile_text, Speed
from benchmarks.stack import driving, end, run, running, TIMEOUT
from benchmarks.viewer import viewer

HEARD = ('none', 'clock', 'stack')
"""Who subscribes: nobody; one reader of /clock; robot_state_publisher and the node of a page."""

_ARRIVAL = 1.0
"""s of sending a command, of which one arrives."""
_CONTROLLERS = ('joint_state_broadcaster', 'diff_drive_controller')


class Simulator:
    """A running :mod:`benchmarks.probed_simulator`."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        """``process``: its input and output are pipes."""
        self._process = process

    @property
    def pid(self) -> int:
        """Of the process."""
        return self._process.pid

    def ask(self, what: str, **arguments: float) -> None:
        """Ask its probe; :meth:`answer` has to follow."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps({'what': what, **arguments}) + '\n')
        self._process.stdin.flush()

    def answer(self) -> Any:
        """Return the answer. Raises BringupError: it has ended."""
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise BringupError('the simulator has ended')
        return json.loads(line)

    def profile(self, seconds: float) -> Profile:
        """Measure a cycle. Raises BringupError: the robot does not drive."""
        profile = self.profile_at_rest(seconds)
        if profile.speed < 0.1:
            raise BringupError('the robot does not drive')
        return profile

    def time(self) -> float:
        """Return the simulated time, s."""
        self.ask('time')
        return float(self.answer())

    def profile_at_rest(self, seconds: float) -> Profile:
        """Measure a cycle, whether the robot drives or not."""
        self.ask('profile', seconds=seconds)
        return Profile.from_json(self.answer())

    def speed(self, seconds: float, rounds: int = 3) -> Speed:
        """Measure the speed for ``seconds`` of the wall clock, in rounds."""
        self.ask('speed', seconds=seconds, rounds=rounds)
        answer = self.answer()
        return Speed(tuple(answer['full']), tuple(answer['bare']))


@contextmanager
def controlled_robot(
    factor: float = 0.0, update_rate: int = 100, *, description: str = '', world: str = 'empty'
) -> Iterator[Simulator]:
    """
    Run a probed simulator and a robot with active controllers, and nothing else, while inside.

    A command stays in force for ever: at factor 0 its timeout would pass within milliseconds.

    Args:
        factor: The real-time factor; 0: as fast as possible.
        update_rate: Of the controller manager, Hz.
        description: Of the robot; '': amr.
        world: The world.
    """
    share = package_share('amr_description')
    shipped = (share / 'config' / 'controllers.yaml').read_text(encoding='utf-8')
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / 'controllers.yaml'
        file.write_text(adapted(shipped, update_rate), encoding='utf-8')
        urdf = share / 'urdf' / 'amr.urdf'
        if description:
            urdf = Path(folder) / 'robot.urdf'
            urdf.write_text(description, encoding='utf-8')
        given = (f'real_time_factor:={factor}', f'controllers:={file}', f'world:={world}')
        parameters = tuple(word for each in given for word in ('-p', each))
        process = subprocess.Popen(
            [
                *(sys.executable, '-m', 'benchmarks.probed_simulator'),
                *('--ros-args', *parameters, '--log-level', 'error'),
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        try:
            run('create', '-file', str(urdf), '-name', 'amr', '-z', '0.2')
            run('spawner', *_CONTROLLERS)
            yield Simulator(process)
        finally:
            end(process)


@contextmanager
def driven_robot(node: Node) -> Iterator[Simulator]:
    """Run a simulator as fast as possible with a robot that drives in a circle, while inside."""
    with controlled_robot() as simulator:
        with driving(node):
            wait_until(node, lambda: None, timeout=_ARRIVAL)
        yield simulator


@contextmanager
def listeners(node: Node, heard: str) -> Iterator[None]:
    """Have somebody listen to the simulator (one of :data:`HEARD`), while inside."""
    urdf = str(package_share('amr_description') / 'urdf' / 'amr.urdf')
    with ExitStack() as stack:
        if heard == 'stack':
            use_sim_time = ('--ros-args', '-p', 'use_sim_time:=true')
            stack.enter_context(running('robot_state_publisher', urdf, *use_sim_time))
            _, url = stack.enter_context(viewer())
            page = stack.enter_context(PageClient(url))
            if not wait_until(node, lambda: _shows_robot(node, page) or None, timeout=TIMEOUT):
                raise BringupError('the page shows no robot')
        elif heard == 'clock':
            clock = node.create_subscription(Clock, '/clock', lambda _: None, 10)
            stack.callback(node.destroy_subscription, clock)
        yield


def _shows_robot(node: Node, page: PageClient) -> bool:
    """Whether the page hears what it shows, and no more the wheels, whose names it knows."""
    is_known = any(robot['joints'] and robot['wheels'] for robot in page.layouts)
    return is_known and not node.count_subscribers('/ground_truth/wheels')


def main() -> int:
    """Measure and print."""
    options = argparse.ArgumentParser(prog='benchmarks.cycle', description='A cycle by part.')
    options.add_argument('--heard', choices=HEARD, default='stack', help='who subscribes (stack)')
    options.add_argument('--seconds', type=float, default=10.0, help='wall time (10)')
    chosen = options.parse_args()
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    with ros([]):
        node = Node('benchmark')
        with driven_robot(node) as simulator, listeners(node, chosen.heard):
            print(profile_text(chosen.heard, simulator.profile(chosen.seconds)))
        node.destroy_node()
    return 0


if __name__ == '__main__':
    sys.exit(program(main))
