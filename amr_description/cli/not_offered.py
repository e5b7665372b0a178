# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Commands and verbs of ROS that are not here, and what would do instead."""

INSTEAD_OF_COMMANDS = {
    'ros2 component': 'components are C++ nodes, of which there are none here; start nodes with '
    '`ros2 run` and `ros2 launch`',
    'ros2 multicast': 'see with `ros2 doctor hello` on both machines whether they hear each other '
    '(docs/two_machines.md)',
    'ros2 plugin': 'plugins of C++ are not read here; those of the controller manager are listed '
    'by `ros2 control list_controller_types`',
    'ros2 security': 'there are no enclaves; keep a robot to this host, or to one network, with '
    'ROS_AUTOMATIC_DISCOVERY_RANGE (docs/two_machines.md)',
    'ros2 service echo': 'call the service with `ros2 service call`, or log in its node',
    'ros2 test': 'write tests for pytest (docs/test_your_robot.md), run by `colcon test`',
    'ros2 trace': 'see the times of the control loop with `ros2 topic echo /diagnostics`',
}
"""By command, or command and verb, of the original."""
