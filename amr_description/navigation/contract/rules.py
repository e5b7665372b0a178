# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The table of rules, in the order in which a robot is put together."""

from collections.abc import Iterable

from amr_description.navigation.contract import (
    command_rules,
    frame_rules,
    map_rules,
    odometry_rules,
    scan_rules,
    time_rules,
)
from amr_description.navigation.contract.findings import Finding, Rule
from amr_description.navigation.contract.observations import ContractObservations

_CLOCK = 'time source of rclcpp, tf2, costmaps'
_BRINGUP = 'frames of nav2_params.yaml and mapper_params_online_async.yaml'
_SLAM = 'slam_toolbox'
_SMOOTHER = 'velocity_smoother'

RULES = (
    Rule('clock.publishers', 'one node publishes /clock', _CLOCK, time_rules.one_clock),
    Rule('clock.rate', '100 Hz of simulated time or more', _CLOCK, time_rules.clock_rate),
    Rule('clock.order', 'time does not go back', 'tf2, costmaps', time_rules.clock_order),
    Rule('time.use_sim_time', 'the same in all nodes', _CLOCK, time_rules.same_time),
    Rule(
        'time.real_time_factor',
        '0.9 to 1.1',
        'controller_server, costmap_2d, behaviors, velocity_smoother of Jazzy',
        time_rules.real_time_factor,
    ),
    Rule(
        'tf.frames', 'odom, base_link and base_footprint exist', _BRINGUP, frame_rules.both_bases
    ),
    Rule('tf.odometry', 'odom → base is dynamic', 'REP 105', frame_rules.odometry_moves),
    Rule('tf.one_parent', 'each frame has one publisher', 'tf2', frame_rules.one_parent),
    Rule(
        'tf.others', 'other frames are static or of joints', 'tf2', frame_rules.others_stand_still
    ),
    Rule('tf.rate', 'odom → base at 30 Hz or more', _SLAM, frame_rules.odometry_rate),
    Rule('tf.order', 'its stamps increase', 'tf2', frame_rules.odometry_order),
    Rule(
        'tf.at_scans',
        'odom → frame of the scan is known at its stamp within 0.2 s',
        'slam_toolbox, amcl, costmap_2d: tf2_ros::MessageFilter',
        frame_rules.known_at_scans,
    ),
    Rule('odom.qos', 'nav_msgs/msg/Odometry, reliable', 'OdomSmoother', odometry_rules.reliable),
    Rule('odom.rate', '20 Hz or more', 'OdomSmoother', odometry_rules.rate),
    Rule('odom.order', 'its stamps increase', 'OdomSmoother', odometry_rules.ordered),
    Rule('odom.frames', 'odom, and the child is the base', 'REP 105', odometry_rules.frames),
    Rule('odom.twist', 'in the axes of the child', 'OdomSmoother', odometry_rules.twist),
    Rule(
        'odom.covariance',
        'variances above 0, for an EKF',
        'robot_localization',
        odometry_rules.covariances,
    ),
    Rule('scan.published', 'sensor_msgs/msg/LaserScan', 'SensorDataQoS', scan_rules.published),
    Rule('scan.rate', '5 to 20 Hz', 'costmap_2d, slam_toolbox', scan_rules.rate),
    Rule('scan.order', 'its stamps increase', 'tf2_ros::MessageFilter', scan_rules.in_order),
    Rule('scan.frame', 'fixed to the base', 'laser_utils', frame_rules.scan_frame_fixed),
    Rule('scan.length', 'the number of ranges of its angles', 'Karto', scan_rules.length),
    Rule('scan.ranges', '+inf where nothing is met', 'REP 117', scan_rules.ranges),
    Rule('scan.geometry', 'constant', 'laser_utils', scan_rules.constant),
    Rule(
        'scan.age',
        'not of the future, and less than 0.3 s old',
        'transform_tolerance of costmap_2d, source_timeout of collision_monitor',
        scan_rules.age,
    ),
    Rule('scan.range_max', '3 m or more', 'raytrace_max_range of costmap_2d', scan_rules.reach),
    Rule('slam.max_laser_range', 'not above range_max', 'laser_utils', scan_rules.slam_reach),
    Rule('cmd_vel.listener', 'the robot subscribes', _SMOOTHER, command_rules.listened_to),
    Rule(
        'cmd_vel.type',
        'Twist, unless enable_stamped_cmd_vel',
        'TwistPublisher of nav2_util',
        command_rules.of_one_type,
    ),
    Rule('drive.linear', 'reaches 0.5 m/s', _SMOOTHER, command_rules.linear_speed),
    Rule('drive.angular', 'reaches 2.0 rad/s', _SMOOTHER, command_rules.angular_speed),
    Rule('drive.braking', 'stands 1 s after the last command', _SMOOTHER, command_rules.braking),
    Rule('drive.progress', '0.5 m within 10 s', 'progress_checker', command_rules.progress),
    Rule('costmap.footprint', 'holds the collisions', 'costmap_2d', map_rules.footprint),
    Rule(
        'map.published',
        'nav_msgs/msg/OccupancyGrid, reliable, transient local',
        'static_layer, amcl',
        map_rules.map_published,
    ),
    Rule('map.initial_pose', 'somebody takes /initialpose', 'amcl', map_rules.initial_pose),
    Rule('map.to_odom', 'map is above odom', 'REP 105', map_rules.map_to_odom),
)


def examine(seen: ContractObservations, rules: Iterable[Rule] = RULES) -> list[Finding]:
    """Return the finding of each rule."""
    return [_finding(rule, seen) for rule in rules]


def _finding(rule: Rule, seen: ContractObservations) -> Finding:
    outcome = rule.check(seen)
    return Finding(
        rule.name, outcome.verdict, rule.asked, outcome.found, outcome.advice, rule.source
    )
