# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Commands, verbs and packages of ROS that are not here, and what would do instead."""

INSTEAD_OF_COMMANDS = {
    'ros2 bag': 'record on a machine with ROS 2 Jazzy in the same domain; or write the values of '
    'one topic with `ros2 topic echo --csv TOPIC > FILE`',
    'ros2 component': 'components are C++ nodes, of which there are none here; start nodes with '
    '`ros2 run` and `ros2 launch`',
    'ros2 doctor': 'look with `ros2 topic info --verbose TOPIC`, `ros2 node info NODE` and `ros2 '
    'control list_controllers`, and at a description with `check_urdf FILE`',
    'ros2 multicast': 'see with `ros2 node list` on both machines whether they find each other '
    '(docs/two_machines.md)',
    'ros2 plugin': 'plugins of C++ are not read here; those of the controller manager are listed '
    'by `ros2 control list_controller_types`',
    'ros2 security': 'there are no enclaves; keep a robot to this host, or to one network, with '
    'ROS_AUTOMATIC_DISCOVERY_RANGE (docs/two_machines.md)',
    'ros2 service echo': 'call the service with `ros2 service call`, or log in its node',
    'ros2 test': 'write tests for pytest (docs/test_your_robot.md), run by `colcon test`',
    'ros2 trace': 'see the times of the control loop with `ros2 topic echo /diagnostics`',
    'ros2 wtf': 'look with `ros2 topic info --verbose TOPIC`, `ros2 node info NODE` and `ros2 '
    'control list_controllers`, and at a description with `check_urdf FILE`',
}
"""By command, or command and verb, of the original."""

_PAGE = (
    "what it shows is on the page of 'ros2 launch amr_description display', or, beside a running "
    "robot, of 'ros2 run amr_description viewer'"
)
_GRAPH = (
    "'ros2 node list', 'ros2 node info NODE' and 'ros2 topic info -v TOPIC' tell who is joined"
)
_SIMULATOR = (
    "the simulator here is MuJoCo: 'ros2 launch amr_description simulation', or only the world, "
    "'ros2 run amr_description mujoco_sim'"
)
_NAVIGATION = (
    'it runs on a machine with ROS 2 Jazzy beside the simulator, where '
    "'ros2 launch --discovery subnet amr_description navigation' has all that it asks for "
    '(docs/navigation.md)'
)
_TELEOP = (
    "'ros2 run teleop_twist_keyboard teleop_twist_keyboard', or the page of the viewer, drives"
)

INSTEAD_OF_PACKAGES = {
    'gazebo_ros': _SIMULATOR,
    'joint_state_publisher_gui': (
        "its sliders are on the page of 'ros2 launch amr_description display'"
    ),
    'nav2_bringup': _NAVIGATION,
    'navigation2': _NAVIGATION,
    'ros_gz_bridge': (
        'no bridge is needed: the simulator publishes /clock, joint states, odometry and TF as '
        "ROS topics, and hears commands from them; see 'ros2 topic list'"
    ),
    'ros_gz_sim': _SIMULATOR,
    'rqt': _GRAPH,
    'rqt_console': "'ros2 topic echo /rosout' prints the log of all nodes",
    'rqt_graph': _GRAPH,
    'rqt_plot': "the page of 'ros2 run amr_description viewer' draws plots",
    'rqt_robot_steering': _TELEOP,
    'rqt_tf_tree': "'ros2 run tf2_tools view_frames' draws it",
    'rviz2': _PAGE,
    'slam_toolbox': _NAVIGATION,
}
"""By package: what to do where it is not installed."""
