# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``check_navigation``: whether a robot has all that Nav2 and slam_toolbox need of it.

::

    ros2 run amr_description check_navigation
    ros2 run amr_description check_navigation --drive --ros-args -r cmd_vel:=/base/cmd_vel
    ros2 run amr_description check_navigation --ros-args -r __ns:=/robot1  # and --odom-frame …

It listens to the robot, simulated or real, with the QoS of Nav2 and slam_toolbox (Jazzy), neither
of which has to be there, and prints a line for each demand: passed, failed or not checked, what
was asked, what was found, what would do. It ends as soon as all is known.

Exit codes: 0: no demand failed; 1: one did; 2: wrong options, or --drive is refused; 128 + signal.
"""

import argparse
import sys
import threading

from amr_description import streams
from amr_description.argument_types import positive
from amr_description.navigation.contract.findings import CheckVerdict
from amr_description.navigation.contract.observations import ContractFrames, ContractObservations
from amr_description.navigation.contract.report import as_json, as_text
from amr_description.navigation.contract.rules import examine
from amr_description.navigation.ros.contract.collector import Collector
from amr_description.navigation.ros.contract.driving import ContractDrive, RivalWatch
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import client_node, wait_until
from amr_description.ros.signals import StopRequested, StopRequests
from amr_description.ros_arguments import other_arguments

_REPORT_PERIOD = 5.0
"""s between two lines that say what is waited for."""


def parser() -> argparse.ArgumentParser:
    """Return the parser of the options, without ROS arguments."""
    options = argparse.ArgumentParser(
        prog='check_navigation',
        description=__doc__.split('``: ', 1)[1].split('\n', 1)[0],
        epilog='Topics: /clock, /tf, /tf_static, odom, scan, cmd_vel, map, initialpose, '
        'robot_description; others by --ros-args -r FROM:=TO, a namespace by -r __ns:=/NAME. '
        'Exit codes: 0: no demand failed; 1: one did; 2: wrong options, or --drive is refused.',
        allow_abbrev=False,
    )
    options.add_argument(
        '--duration',
        type=positive,
        default=10.0,
        metavar='S',
        help='longest time to listen, by the system clock (default: %(default)s)',
    )
    options.add_argument('--json', action='store_true', help='print JSON')
    options.add_argument(
        '--drive',
        action='store_true',
        help='drive the robot, a metre ahead and on the spot, to check speeds and brakes; refused '
        'where somebody else publishes commands',
    )
    options.add_argument(
        '--stamped',
        action='store_true',
        help='Nav2 is configured with enable_stamped_cmd_vel: true',
    )
    names = ContractFrames()
    for option, default, what in (
        ('map', names.map, 'of the map'),
        ('odom', names.odom, 'of odometry'),
        ('base', names.base, 'of the robot'),
        ('footprint', names.footprint, 'of the robot on the ground'),
    ):
        options.add_argument(
            f'--{option}-frame',
            default=default,
            metavar='FRAME',
            help=f'frame {what} (default: %(default)s)',
        )
    return options


def check_navigation(args: list[str] | None) -> int:
    """Listen, drive if that is asked for, and print; return the exit code."""
    words = sys.argv[1:] if args is None else args
    options = parser().parse_args(other_arguments(words))
    frames = ContractFrames(
        options.map_frame, options.odom_frame, options.base_frame, options.footprint_frame
    )
    with ros(words) as stop:
        node = client_node('check_navigation')
        collector = Collector(node, frames, is_stamped=options.stamped)
        _listen(collector, options.duration, RivalWatch(collector) if options.drive else None)
        if options.drive:
            _drive(collector, stop)
        seen = collector.observations()
        return _report(seen, is_json=options.json)


def _listen(collector: Collector, duration: float, rivals: RivalWatch | None) -> None:
    """
    Wait until enough has come, but no longer than ``duration`` s.

    Raises UsageError: somebody commands the robot that is to be driven afterwards.
    """
    logger = collector.node.get_logger()

    def is_over() -> bool | None:
        if rivals is not None:
            rivals.look()
        return not collector.awaited() or None

    wait_until(
        collector.node,
        is_over,
        lambda: logger.info(f'waiting for {", ".join(collector.awaited())}'),
        every=_REPORT_PERIOD,
        timeout=duration,
        of_message=True,
    )


def _drive(collector: Collector, stop: StopRequests) -> None:
    """Drive the robot, and stop it in every way out. Raises UsageError: it is refused."""
    if not collector.odometry:
        name = collector.node.resolve_topic_name('odom')
        collector.not_driven = f'the robot was not driven, as no odometry came on {name}'
        return
    is_stopping = threading.Event()

    def raise_if_stopped() -> None:
        if is_stopping.is_set():
            assert stop.signum is not None, 'the event is set by a stop request'
            raise StopRequested(stop.signum)

    with stop.on_stop(is_stopping.set):
        drive = ContractDrive(collector, raise_if_stopped)
        try:
            collector.drive = drive.run()
        finally:
            drive.stop()


def _report(seen: ContractObservations, *, is_json: bool) -> int:
    """Print all findings; return the exit code."""
    findings = examine(seen)
    try:
        print((as_json if is_json else as_text)(findings, seen), flush=True)
    except BrokenPipeError:  # as of `| head`
        streams.abandon_stdout()
    return int(any(finding.verdict is CheckVerdict.FAILED for finding in findings))


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: check_navigation(args))


if __name__ == '__main__':
    raise SystemExit(main())
