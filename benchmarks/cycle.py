# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The processor time of a cycle of the control loop, by part; the robot drives in a circle.

``python -m benchmarks.cycle [--heard none|clock|stack] [--seconds S]`` prints it; it is good for
a comparison on a busy machine, see :mod:`benchmarks.probed_simulator`.
"""

import argparse
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, ExitStack
from dataclasses import dataclass
import json
import os
from pathlib import Path
import signal
import subprocess
import sys
import tempfile
from typing import Any, Self

from geometry_msgs.msg import TwistStamped
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from amr_description.ament_index import package_share
from amr_description.errors import BringupError
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import wait_until
from amr_description.viewer.client import PageClient
from benchmarks.call_tree import CallTree
from benchmarks.viewer import viewer

HEARD = ('none', 'clock', 'stack')
"""Who subscribes: nobody; one reader of /clock; robot_state_publisher and the node of a page."""

_TIMEOUT = 60.0
_STOP_TIMEOUT = 15.0
_LEAST = 0.5
"""µs: what takes less is not printed."""
_SPEED = (0.5, 0.5)
"""m/s and rad/s."""


@dataclass(frozen=True)
class Measured:
    """What the probe has measured."""

    cycle: float
    """Processor time of the control thread for one cycle, µs."""
    bare: float
    """That of ``mj_step`` alone, for the same period, µs."""
    batches: int
    period: float
    """Simulated time of a cycle, s."""
    speed: float
    """The greatest speed of a degree of freedom at the end: it is driven."""
    tree: CallTree
    """Of one cycle; µs."""

    @property
    def ratio(self) -> float:
        """Of the speed of ``mj_step`` alone."""
        return self.bare / self.cycle

    def as_json(self) -> Mapping[str, Any]:
        """Return it as JSON has it."""
        return {**self.__dict__, 'tree': self.tree.as_json()}

    @classmethod
    def from_json(cls, read: Mapping[str, Any]) -> Self:
        """Return what :meth:`as_json` was made of."""
        return cls(**{**read, 'tree': CallTree.from_json(read['tree'])})


def profile_text(heard: str, measured: Measured) -> str:
    """Return the cycle by part as text."""
    modules = measured.tree.by_module()
    rest = measured.cycle - sum(modules.values())
    return '\n'.join(
        (
            f'a cycle of {measured.period * 1e3:g} ms, processor time of the control thread; '
            f'heard: {heard}',
            f'{measured.cycle:8.1f} µs a cycle',
            f'{measured.bare:8.1f} µs mj_step alone, {measured.ratio:.3f} of the cycle',
            f'{measured.cycle - measured.bare:8.1f} µs besides the physics',
            '',
            f'{"total µs":>8} {"own µs":>8} {"calls":>6}',
            *measured.tree.lines(_LEAST),
            '',
            'own µs of the functions of a module',
            *(f'{took:8.1f} {name}' for name, took in modules.items() if took >= _LEAST),
            f'{rest:8.1f} the rest',
        )
    )


def cycle_figures(node: Node, heard: str, seconds: float) -> Measured:
    """Measure a cycle. Raises BringupError: the simulator ends, or the robot does not drive."""
    with ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        simulator = stack.enter_context(_probed_simulator(Path(folder)))
        urdf = str(package_share('amr_description') / 'urdf' / 'amr.urdf')
        _run('create', '-file', urdf, '-name', 'amr', '-z', '0.2')
        _run('spawner', 'joint_state_broadcaster', 'diff_drive_controller')
        if heard == 'stack':
            stack.enter_context(running('robot_state_publisher', urdf, *USE_SIM_TIME))
            _, url = stack.enter_context(viewer())
            page = stack.enter_context(PageClient(url))
            wait_until(node, lambda: page.states or None, timeout=_TIMEOUT)
        elif heard == 'clock':
            clock = node.create_subscription(Clock, '/clock', lambda _: None, 10)
            stack.callback(node.destroy_subscription, clock)
        drive(node)
        measured = _ask(simulator, seconds)
    if measured.speed < 0.1:
        raise BringupError('the robot does not drive')
    return measured


USE_SIM_TIME = ('--ros-args', '-p', 'use_sim_time:=true')


def drive(node: Node) -> None:
    """Send a command until it must have arrived. Raises BringupError: nobody subscribes."""
    publisher = node.create_publisher(TwistStamped, '/diff_drive_controller/cmd_vel', 1)
    try:
        heard = wait_until(
            node, lambda: publisher.get_subscription_count() or None, timeout=_TIMEOUT
        )
        if not heard:
            raise BringupError('nobody subscribes to /diff_drive_controller/cmd_vel')
        message = TwistStamped()
        message.twist.linear.x, message.twist.angular.z = _SPEED
        # A subscription that this side has seen may not have seen this side yet.
        for _ in range(20):
            publisher.publish(message)
            wait_until(node, lambda: None, timeout=0.05)
    finally:
        node.destroy_publisher(publisher)


@contextmanager
def _probed_simulator(folder: Path) -> Iterator[subprocess.Popen[str]]:
    shipped = package_share('amr_description') / 'config' / 'controllers.yaml'
    file = folder / 'controllers.yaml'
    file.write_text(driven_for_ever(shipped.read_text(encoding='utf-8')), encoding='utf-8')
    parameters = ('-p', 'real_time_factor:=0.0', '-p', f'controllers:={file}')
    arguments = ('--ros-args', *parameters, '--log-level', 'warn')
    process = subprocess.Popen(
        [sys.executable, '-m', 'benchmarks.probed_simulator', *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        end(process)


def driven_for_ever(controllers: str) -> str:
    """Return a file of controllers with a ``cmd_vel_timeout`` of 0: a command stays in force."""
    return controllers.replace(
        'publish_rate: 50.0', 'publish_rate: 50.0\n    cmd_vel_timeout: 0.0'
    )


def _ask(simulator: subprocess.Popen[str], seconds: float) -> Measured:
    assert simulator.stdin is not None and simulator.stdout is not None
    simulator.stdin.write(f'{seconds}\n')
    simulator.stdin.flush()
    answer = simulator.stdout.readline()
    if not answer:
        raise BringupError('the simulator has ended')
    return Measured.from_json(json.loads(answer))


def _run(executable: str, *arguments: str) -> None:
    """Run an executable to its end. Raises BringupError: it fails."""
    command = _command(executable, *arguments)
    done = subprocess.run(command, capture_output=True, text=True, timeout=_TIMEOUT, check=False)
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


def main() -> int:
    """Measure and print."""
    options = argparse.ArgumentParser(prog='benchmarks.cycle', description=__doc__.split('\n')[1])
    options.add_argument('--heard', choices=HEARD, default='stack', help='who subscribes (stack)')
    options.add_argument('--seconds', type=float, default=10.0, help='wall time (10)')
    chosen = options.parse_args()
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    with ros([]):
        node = Node('benchmark')
        print(profile_text(chosen.heard, cycle_figures(node, chosen.heard, chosen.seconds)))
        node.destroy_node()
    return 0


if __name__ == '__main__':
    sys.exit(program(main))
