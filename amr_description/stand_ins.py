# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Packages of ROS that are not installed: executables of ours in their place, or what would do."""

STAND_INS = {
    ('controller_manager', 'hardware_spawner'): 'hardware_spawner',
    ('controller_manager', 'ros2_control_node'): 'ros2_control_node',
    ('controller_manager', 'spawner'): 'spawner',
    ('controller_manager', 'spawner.py'): 'spawner',  # as Foxy has it
    ('controller_manager', 'unspawner'): 'unspawner',
    ('controller_manager', 'unspawner.py'): 'unspawner',
    ('demo_nodes_py', 'listener'): 'demo_listener',
    ('demo_nodes_py', 'talker'): 'demo_talker',
    ('joint_state_publisher', 'joint_state_publisher'): 'joint_state_publisher',
    ('joy', 'joy_node'): 'joy_node',
    ('nav2_map_server', 'map_saver_cli'): 'map_saver_cli',
    ('nav2_map_server', 'map_server'): 'map_server',
    ('py_pubsub', 'listener'): 'listener',
    ('py_pubsub', 'talker'): 'talker',
    ('robot_localization', 'ekf_node'): 'ekf_node',
    ('robot_localization', 'navsat_transform_node'): 'navsat_transform_node',
    ('robot_state_publisher', 'robot_state_publisher'): 'robot_state_publisher',
    ('ros_gz_sim', 'create'): 'create',
    ('teleop_twist_joy', 'teleop_node'): 'teleop_twist_joy',
    ('teleop_twist_keyboard', 'teleop_twist_keyboard'): 'teleop_twist_keyboard',
    ('tf2_ros', 'static_transform_publisher'): 'static_transform_publisher',
    ('tf2_ros', 'tf2_echo'): 'tf2_echo',
    ('tf2_ros', 'tf2_monitor'): 'tf2_monitor',
    ('tf2_tools', 'view_frames'): 'view_frames',
    ('tf2_tools', 'view_frames.py'): 'view_frames',
    ('twist_mux', 'twist_mux'): 'twist_mux',
    ('xacro', 'xacro'): 'xacro',
}
"""(package, executable) -> our executable that replaces it where the package is not installed."""

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
    '(docs/nav2.md)'
)
_NO_BRIDGE = (
    'no bridge is needed: the simulator publishes /clock, joint states, odometry and TF as '
    "ROS topics, and hears commands from them; see 'ros2 topic list'"
)
_TELEOP = (
    "'ros2 run teleop_twist_keyboard teleop_twist_keyboard', or the page of the viewer, drives"
)
_GAMEPAD = (
    "'ros2 run joy joy_node' and 'ros2 run teleop_twist_joy teleop_node' drive, or a gamepad at "
    "the page of 'ros2 run amr_description viewer'"
)
_SENSOR = (
    'it is the driver of a device; the simulator measures by the <gazebo><sensor> of the robot '
    'description, and publishes that (docs/sensors.md)'
)

_ELSEWHERE = (
    'it is C++, or made by C++, and not here: it runs on a machine with ROS 2 Jazzy beside this '
    'one (docs/two_machines.md)'
)
_FROM_SOURCE = 'its sources can be cloned into a workspace and built there with colcon'

_DRIVERS = (
    'camera_ros',
    'coin_d4_driver',
    'depthai_ros_driver',
    'hls_lfcd_lds_driver',
    'ld08_driver',
    'ldlidar',
    'ldlidar_node',
    'ldlidar_stl_ros2',
    'livox_ros_driver2',
    'lslidar_driver',
    'micro_ros_agent',
    'orbbec_camera',
    'ouster_ros',
    'realsense2_camera',
    'rplidar_ros',
    'sick_scan_xd',
    'sllidar_ros2',
    'urg_node',
    'urg_node2',
    'usb_cam',
    'v4l2_camera',
    'velodyne_driver',
    'velodyne_pointcloud',
    'xv_11_driver',
    'ydlidar_ros2_driver',
    'zed_wrapper',
)

_OF_CPP = (
    'apriltag_ros',
    'depth_image_proc',
    'depthimage_to_laserscan',
    'image_proc',
    'image_transport',
    'image_view',
    'imu_complementary_filter',
    'imu_filter_madgwick',
    'laser_filters',
    'octomap_server',
    'pointcloud_to_laserscan',
    'rf2o_laser_odometry',
    'rtabmap_odom',
    'rtabmap_slam',
    'stereo_image_proc',
    'topic_tools',
)

INSTEAD_OF_PACKAGES = {
    **dict.fromkeys(_DRIVERS, _SENSOR),
    **dict.fromkeys(_OF_CPP, _ELSEWHERE),
    'foxglove_bridge': _PAGE,
    'gazebo_ros': _SIMULATOR,
    'joint_state_publisher_gui': (
        "its sliders are on the page of 'ros2 launch amr_description display'"
    ),
    'joy': _GAMEPAD,
    'joy_linux': _GAMEPAD,
    'joy_teleop': _GAMEPAD,
    'nav2_bringup': _NAVIGATION,
    'cartographer_ros': _NAVIGATION,
    'navigation2': _NAVIGATION,
    **dict.fromkeys(
        (
            'nav2_amcl',
            'nav2_behaviors',
            'nav2_bt_navigator',
            'nav2_collision_monitor',
            'nav2_controller',
            'nav2_costmap_2d',
            'nav2_lifecycle_manager',
            'nav2_planner',
            'nav2_recoveries',
            'nav2_route',
            'nav2_smoother',
            'nav2_velocity_smoother',
            'nav2_waypoint_follower',
            'opennav_docking',
        ),
        _NAVIGATION,
    ),  # fmt: skip
    'ros_gz_bridge': _NO_BRIDGE,
    'ros_gz_image': _NO_BRIDGE,
    'ros_gz_sim': _SIMULATOR,
    'rosapi': _FROM_SOURCE,
    'rosbridge_server': _FROM_SOURCE,
    'rqt': _GRAPH,
    'rqt_console': "'ros2 topic echo /rosout' prints the log of all nodes",
    'rqt_graph': _GRAPH,
    'rqt_plot': "the page of 'ros2 run amr_description viewer' draws plots",
    'rqt_robot_steering': _TELEOP,
    'rqt_tf_tree': "'ros2 run tf2_tools view_frames' draws it",
    'rviz2': _PAGE,
    'slam_toolbox': _NAVIGATION,
    'teleop_twist_joy': _GAMEPAD,
    'turtlesim': (
        "the robot of 'ros2 launch amr_description simulation' does what its turtle does: it is "
        'driven by velocities, and seen on the page'
    ),
}
"""By package: what to do where it is not installed."""

_PIP = 'pip install {}'
_NO_LINTER = (
    'this linter is not here: leave its test out, as by "colcon test --pytest-args -k \'not '
    'linter\'", or run it on a machine with ROS 2 Jazzy'
)
_ROS_1 = 'it is of ROS 1; in ROS 2 it is {}'
INSTEAD_OF_MODULES = {
    'PIL': _PIP.format('Pillow'),
    'PyKDL': _ELSEWHERE,
    'actionlib': _ROS_1.format('rclpy.action'),
    **dict.fromkeys(
        (
            'ament_black',
            'ament_clang_format',
            'ament_cpplint',
            'ament_lint_cmake',
            'ament_mypy',
            'ament_pycodestyle',
            'ament_uncrustify',
            'ament_xmllint',
        ),
        _NO_LINTER,
    ),
    'bson': _PIP.format('pymongo') + ', as rosbridge needs it',
    'cv2': _PIP.format('opencv-python-headless'),
    'dynamic_reconfigure': _ROS_1.format('the parameters of a node, and ros2 param'),
    'kdl_parser_py': _ELSEWHERE,
    'lark': _PIP.format('lark') + ', as the original launch needs it',
    'moveit': _ELSEWHERE,
    'moveit_configs_utils': _FROM_SOURCE,
    'moveit_py': _ELSEWHERE,
    'open3d': _PIP.format('open3d'),
    'osrf_pycommon': _FROM_SOURCE,
    'py_trees': _PIP.format('py_trees'),
    'py_trees_ros': _FROM_SOURCE,
    'pyqtgraph': _PIP.format('pyqtgraph'),
    'python_qt_binding': _GRAPH,
    'qt_gui': _GRAPH,
    'ros2_numpy': _FROM_SOURCE,
    'rosbag': _ROS_1.format('rosbag2_py'),
    'rosbridge_library': _FROM_SOURCE,
    'roslaunch': _ROS_1.format('launch, and ros2 launch'),
    'roslib': _ROS_1.format('ament_index_python'),
    'rospkg': _ROS_1.format('ament_index_python'),
    'rospy': _ROS_1.format('rclpy'),
    'rqt_gui': _GRAPH,
    'rqt_gui_py': _GRAPH,
    'rviz_common': _PAGE,
    'simple_pid': _PIP.format('simple-pid'),
    'sros2': _FROM_SOURCE,
    'tf': _ROS_1.format('tf2_ros, and tf_transformations for angles'),
    'tf2_kdl': _ELSEWHERE,
    'transforms3d': _PIP.format('transforms3d'),
}
"""By module of Python: what to do where it cannot be imported."""
_COMMANDS_OF_ROS = (
    'ros2bag', 'ros2component', 'ros2doctor', 'ros2interface', 'ros2launch', 'ros2lifecycle',
    'ros2run',
)  # fmt: skip


def hint_of_module(name: str) -> str:
    """Return what to do about a module of ROS that is not found; '': nothing is known of it."""
    root = name.partition('.')[0]
    if root.endswith(('_msgs', '_srvs', '_interfaces', '_actions')):
        return (
            'it has messages: its sources can be cloned into a workspace, where "colcon build" '
            'generates them (docs/your_own_messages.md)'
        )
    if root in _COMMANDS_OF_ROS:
        return 'the command ros2 is here, but has no such module'
    return INSTEAD_OF_MODULES.get(root) or INSTEAD_OF_PACKAGES.get(root, '')
