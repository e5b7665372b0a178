# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Packages of ROS that are not installed: executables of ours in their place, or what would do."""

# (package, executable) -> our executable that replaces it if the package is not installed, with
# the arguments that make it compatible; they come last, so arguments of the user win.
STAND_INS = {
    ('controller_manager', 'hardware_spawner'): 'hardware_spawner',
    ('controller_manager', 'ros2_control_node'): 'ros2_control_node',
    ('controller_manager', 'spawner'): 'spawner',
    ('controller_manager', 'unspawner'): 'unspawner',
    ('demo_nodes_py', 'listener'): 'listener --ros-args -r __node:=listener -r topic:=chatter',
    ('demo_nodes_py', 'talker'): 'talker --ros-args -r __node:=talker -r topic:=chatter',
    ('joint_state_publisher', 'joint_state_publisher'): 'joint_state_publisher',
    ('nav2_map_server', 'map_saver_cli'): 'map_saver_cli',
    ('nav2_map_server', 'map_server'): 'map_server',
    ('py_pubsub', 'listener'): 'listener',
    ('py_pubsub', 'talker'): 'talker',
    ('robot_localization', 'ekf_node'): 'ekf_node',
    ('robot_state_publisher', 'robot_state_publisher'): 'robot_state_publisher',
    ('ros_gz_sim', 'create'): 'create',
    ('teleop_twist_keyboard', 'teleop_twist_keyboard'): 'teleop_twist_keyboard',
    ('tf2_ros', 'static_transform_publisher'): 'static_transform_publisher',
    ('tf2_ros', 'tf2_echo'): 'tf2_echo',
    ('tf2_ros', 'tf2_monitor'): 'tf2_monitor',
    ('tf2_tools', 'view_frames'): 'view_frames',
    ('twist_mux', 'twist_mux'): 'twist_mux',
    ('xacro', 'xacro'): 'xacro',
}

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
