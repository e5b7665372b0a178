# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``calibrate``: fit the multipliers of a diff_drive_controller to how the robot truly moves.

::

    ros2 run amr_description calibrate                              # /diff_drive_controller
    ros2 run amr_description calibrate --controller my_drive --ros-args -r __ns:=/robot1

In the simulator, which publishes the ground truth (``ground_truth/odom``), the robot is driven
straight, on the spot and along arcs, each in both directions; it needs about three metres of free
ground around it. It prints the errors of the odometry before and after the fit, and the parameters
to set in the controller's file. It changes no parameters itself. However it ends, it stops the
robot.

Exit codes: 0; 1: something is missing, or the fit is impossible; 2: wrong options; 128 + signal.
"""

import argparse
from collections.abc import Sequence
import math
import sys
import threading

from rclpy.node import Node

from amr_description.argument_types import positive
from amr_description.controllers.checks.drive_calibration import (
    CalibrationRun,
    fit,
    Geometry,
    yaw_error,
)
from amr_description.nodes.calibrate.drive import CalibrationDrive, Manoeuvre
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import client_node
from amr_description.ros.signals import StopRequested, StopRequests
from amr_description.ros_arguments import other_arguments

_FULL_TURN = 2.0 * math.pi
_STRAIGHT = ('straight forward', 'straight backward')


def parser() -> argparse.ArgumentParser:
    """Return the parser of the options, without ROS arguments."""
    options = argparse.ArgumentParser(
        prog='calibrate',
        description=__doc__.split('\n', 2)[1],
        allow_abbrev=False,
    )
    options.add_argument(
        '--controller',
        default='diff_drive_controller',
        metavar='NAME',
        help='node of the controller (default: %(default)s)',
    )
    options.add_argument(
        '--linear', type=positive, default=0.4, metavar='M/S', help='default: %(default)s'
    )
    options.add_argument(
        '--angular', type=positive, default=0.8, metavar='RAD/S', help='default: %(default)s'
    )
    options.add_argument(
        '--distance',
        type=positive,
        default=1.5,
        metavar='M',
        help='length of the straight runs (default: %(default)s)',
    )
    options.add_argument(
        '--timeout',
        type=positive,
        default=10.0,
        metavar='S',
        help='longest wait for anything, by the wall clock (default: %(default)s)',
    )
    return options


def manoeuvres(linear: float, angular: float, distance: float) -> tuple[Manoeuvre, ...]:
    """
    Return the runs, each followed by its reverse, so that the robot stays in place.

    Args:
        linear: speed, m/s.
        angular: speed, rad/s.
        distance: length of the straight runs, m.
    """
    return (
        Manoeuvre(_STRAIGHT[0], linear, 0.0, distance=distance),
        Manoeuvre(_STRAIGHT[1], -linear, 0.0, distance=distance),
        Manoeuvre('spin left', 0.0, angular, turn=_FULL_TURN),
        Manoeuvre('spin right', 0.0, -angular, turn=_FULL_TURN),
        Manoeuvre('arc left', linear, angular, turn=_FULL_TURN),
        Manoeuvre('arc right', linear, -angular, turn=_FULL_TURN),
    )


def report(runs: Sequence[CalibrationRun], before: Geometry, after: Geometry) -> str:
    """Return the table of errors: of the angle, or for straight runs, of the distance."""
    rows: list[tuple[str, ...]] = [('run', 'true', 'before', 'error', 'after', 'error')]
    for run in runs:
        turns = not math.isnan(yaw_error(run, before))
        truth = run.truth.turn if turns else run.truth.distance
        row = [run.name, _quantity(truth, turns)]
        for geometry in (before, after):
            odometry = run.odometry(geometry)
            value = odometry.turn if turns else odometry.distance
            row += [_quantity(value, turns), f'{abs(value / truth - 1.0):.1%}']
        rows.append(tuple(row))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return '\n'.join(
        '  '.join(
            cell.ljust(width) if column == 0 else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in rows
    )


def patch(controller: str, geometry: Geometry) -> str:
    """Return the YAML of the parameters; ``controller`` is the full name of its node."""
    name = controller if controller.count('/') > 1 else controller[1:]
    return (
        f'{name}:\n'
        '  ros__parameters:\n'
        f'    wheel_separation_multiplier: {geometry.separation_multiplier:.4f}\n'
        f'    left_wheel_radius_multiplier: {geometry.left_multiplier:.4f}\n'
        f'    right_wheel_radius_multiplier: {geometry.right_multiplier:.4f}'
    )


def calibrate(args: list[str] | None) -> int:
    """Drive the robot, fit the geometry, and print the result; return the exit code."""
    words = sys.argv[1:] if args is None else args
    options = parser().parse_args(other_arguments(words))
    with ros(words) as stop:
        node = client_node('calibrate')
        namespace = node.get_namespace().rstrip('/')
        name = options.controller
        controller = name if name.startswith('/') else f'{namespace}/{name}'
        runs, before = _drive(node, controller, options, stop)
        straight = [run for run in runs if run.name in _STRAIGHT]
        turning = [run for run in runs if run.name not in _STRAIGHT]
        after = fit(straight, turning, before.separation)
        print(report(runs, before, after))
        print('\nOdometry would be right, as far as one geometry can make it, with:\n')
        print(patch(controller, after))
        return 0


def _drive(
    node: Node, controller: str, options: argparse.Namespace, stop: StopRequests
) -> tuple[list[CalibrationRun], Geometry]:
    """Return the runs, and the geometry in the controller's parameters."""
    is_stopping = threading.Event()

    def raise_if_stopped() -> None:
        if is_stopping.is_set():
            assert stop.signum is not None, 'the event is set by a stop request'
            raise StopRequested(stop.signum)

    runs: list[CalibrationRun] = []
    with stop.on_stop(is_stopping.set):
        drive = CalibrationDrive(node, controller, options.timeout, raise_if_stopped)
        try:
            for manoeuvre in manoeuvres(options.linear, options.angular, options.distance):
                runs.append(drive.run(manoeuvre))
                truth = runs[-1].truth
                node.get_logger().info(
                    f'{manoeuvre.name}: truly {truth.distance:.3f} m and '
                    f'{math.degrees(truth.turn):.1f} degrees'
                )
        finally:
            stop.leave()
            drive.stop_robot()
    return runs, drive.geometry


def _quantity(value: float, turns: bool) -> str:
    return f'{math.degrees(value):+.1f} deg' if turns else f'{value:+.4f} m'


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: calibrate(args))
