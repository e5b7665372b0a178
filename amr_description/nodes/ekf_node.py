# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``ekf_node``: one odometry of wheels, IMU and other sensors, as of robot_localization.

::

    ros2 run robot_localization ekf_node --ros-args --params-file config/ekf.yaml
"""

from rclpy.executors import SingleThreadedExecutor

from amr_description.navigation.ros.ekf_node import EkfNode
from amr_description.ros.node_help import print_help
from amr_description.ros.runtime import run

_PURPOSE = 'Fuse wheel odometry, IMU and other sensors into one odometry, odometry/filtered.'
_NOTES = (
    'Its parameters are those of robot_localization: odom0, imu0, pose0, twist0 … name topics, '
    'odom0_config … which of 15 values each of them measures; config/ekf.yaml is an example.'
)


def main(args: list[str] | None = None) -> int:
    """Fuse until Ctrl-C."""
    if print_help(args, 'ekf_node', _PURPOSE, notes=_NOTES):
        return 0
    # The executor with which it was seen to go on after simulated time jumped back.
    return run(EkfNode, args, executor=SingleThreadedExecutor)


if __name__ == '__main__':
    raise SystemExit(main())
