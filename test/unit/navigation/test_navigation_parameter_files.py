# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
config/nav2_params.yaml and config/mapper_params_online_async.yaml: every name and type is known.

The tables are those of the sources of Jazzy: the ``declare_parameter`` calls of navigation2 1.3
and slam_toolbox 2.8, and the files nav2_bringup/params/nav2_params.yaml and
slam_toolbox/config/mapper_params_online_async.yaml. The names of plugins are those of their
``plugins.xml``.
"""

import pytest
from support.paths import ROOT
import yaml

from amr_description.parameter_files import dotted, flatten, read_parameter_file, sections

NAV2, SLAM = 'nav2_params.yaml', 'mapper_params_online_async.yaml'

_SCAN = {
    'topic': str, 'data_type': str, 'max_obstacle_height': float, 'min_obstacle_height': float,
    'clearing': bool, 'marking': bool, 'inf_is_valid': bool, 'raytrace_max_range': float,
    'raytrace_min_range': float, 'obstacle_max_range': float, 'obstacle_min_range': float,
    'observation_persistence': float, 'expected_update_rate': float, 'sensor_frame': str,
}  # fmt: skip

PLUGINS = {
    'nav2_bt_navigator::NavigateToPoseNavigator': {},
    'nav2_bt_navigator::NavigateThroughPosesNavigator': {},
    'nav2_controller::SimpleProgressChecker': {
        'required_movement_radius': float, 'movement_time_allowance': float,
    },
    'nav2_controller::SimpleGoalChecker': {
        'stateful': bool, 'xy_goal_tolerance': float, 'yaw_goal_tolerance': float,
    },
    'nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController': {
        **dict.fromkeys(
            (
                'desired_linear_vel', 'lookahead_dist', 'min_lookahead_dist',
                'max_lookahead_dist', 'lookahead_time', 'rotate_to_heading_angular_vel',
                'transform_tolerance', 'min_approach_linear_velocity',
                'approach_velocity_scaling_dist', 'max_allowed_time_to_collision_up_to_carrot',
                'cost_scaling_dist', 'cost_scaling_gain', 'inflation_cost_scaling_factor',
                'regulated_linear_scaling_min_radius', 'regulated_linear_scaling_min_speed',
                'curvature_lookahead_dist', 'rotate_to_heading_min_angle', 'max_angular_accel',
                'cancel_deceleration', 'max_robot_pose_search_dist',
            ),
            float,
        ),
        **dict.fromkeys(
            (
                'use_velocity_scaled_lookahead_dist', 'use_regulated_linear_velocity_scaling',
                'use_cost_regulated_linear_velocity_scaling', 'use_fixed_curvature_lookahead',
                'use_rotate_to_heading', 'use_cancel_deceleration', 'allow_reversing',
                'interpolate_curvature_after_goal', 'use_collision_detection',
            ),
            bool,
        ),
    },
    'nav2_costmap_2d::ObstacleLayer': {
        'enabled': bool, 'observation_sources': str, 'footprint_clearing_enabled': bool,
        'max_obstacle_height': float, 'combination_method': int,
        **{f'scan.{name}': kind for name, kind in _SCAN.items()},
    },
    'nav2_costmap_2d::StaticLayer': {
        'enabled': bool, 'map_topic': str, 'map_subscribe_transient_local': bool,
        'subscribe_to_updates': bool, 'transform_tolerance': float,
    },
    'nav2_costmap_2d::InflationLayer': {
        'enabled': bool, 'cost_scaling_factor': float, 'inflation_radius': float,
        'inflate_unknown': bool, 'inflate_around_unknown': bool,
    },
    'nav2_navfn_planner::NavfnPlanner': {
        'tolerance': float, 'use_astar': bool, 'allow_unknown': bool,
        'use_final_approach_orientation': bool,
    },
    'nav2_smoother::SimpleSmoother': {
        'tolerance': float, 'max_its': int, 'do_refinement': bool, 'w_data': float,
        'w_smooth': float, 'refinement_num': int,
    },
    'nav2_behaviors::Spin': {},
    'nav2_behaviors::BackUp': {},
    'nav2_behaviors::DriveOnHeading': {},
    'nav2_behaviors::AssistedTeleop': {},
    'nav2_behaviors::Wait': {},
    'nav2_waypoint_follower::WaitAtWaypoint': {'enabled': bool, 'waypoint_pause_duration': int},
    'opennav_docking::SimpleChargingDock': {
        'docking_threshold': float, 'staging_x_offset': float, 'staging_yaw_offset': float,
        'use_external_detection_pose': bool, 'use_battery_status': bool,
        'use_stall_detection': bool, 'external_detection_timeout': float, 'filter_coef': float,
    },
    'nav2_amcl::DifferentialMotionModel': {},
    'nav2_amcl::OmniMotionModel': {},
}  # fmt: skip
"""By name: the parameters of the plugin, and their types."""

_EVERYWHERE = {'use_sim_time': bool}
_COMMANDS = {'enable_stamped_cmd_vel': bool}
_COSTMAP = {
    'update_frequency': float, 'publish_frequency': float, 'global_frame': str,
    'robot_base_frame': str, 'rolling_window': bool, 'width': int, 'height': int,
    'resolution': float, 'footprint': str, 'footprint_padding': float, 'robot_radius': float,
    'plugins': list, 'filters': list, 'always_send_full_costmap': bool,
    'track_unknown_space': bool, 'transform_tolerance': float, 'origin_x': float,
    'origin_y': float, 'unknown_cost_value': int, 'lethal_cost_threshold': int,
    'trinary_costmap': bool, 'initial_transform_timeout': float,
}  # fmt: skip

NODES = {
    '/amcl': {
        **dict.fromkeys(
            (
                'alpha1', 'alpha2', 'alpha3', 'alpha4', 'alpha5', 'laser_likelihood_max_dist',
                'laser_max_range', 'laser_min_range', 'transform_tolerance', 'update_min_a',
                'update_min_d', 'z_hit', 'z_max', 'z_rand', 'z_short', 'pf_err', 'pf_z',
                'recovery_alpha_fast', 'recovery_alpha_slow', 'save_pose_rate', 'sigma_hit',
                'lambda_short', 'beam_skip_distance', 'beam_skip_threshold',
                'beam_skip_error_threshold', 'initial_pose.x', 'initial_pose.y',
                'initial_pose.z', 'initial_pose.yaw',
            ),
            float,
        ),
        **dict.fromkeys(
            (
                'base_frame_id', 'global_frame_id', 'odom_frame_id', 'scan_topic', 'map_topic',
                'robot_model_type', 'laser_model_type',
            ),
            str,
        ),
        **dict.fromkeys(('max_beams', 'max_particles', 'min_particles', 'resample_interval'), int),
        **dict.fromkeys(
            (
                'set_initial_pose', 'tf_broadcast', 'do_beamskip', 'always_reset_initial_pose',
                'first_map_only',
            ),
            bool,
        ),
    },
    '/bt_navigator': {
        'global_frame': str, 'robot_base_frame': str, 'odom_topic': str,
        'transform_tolerance': float, 'filter_duration': float, 'bt_loop_duration': int,
        'default_server_timeout': int, 'wait_for_service_timeout': int,
        'action_server_result_timeout': float, 'navigators': list, 'error_code_names': list,
        'default_nav_to_pose_bt_xml': str, 'default_nav_through_poses_bt_xml': str,
        'plugin_lib_names': list, 'always_reload_bt_xml': bool,
    },
    '/controller_server': {
        **_COMMANDS, 'odom_topic': str, 'controller_frequency': float,
        'costmap_update_timeout': float, 'min_x_velocity_threshold': float,
        'min_y_velocity_threshold': float, 'min_theta_velocity_threshold': float,
        'failure_tolerance': float, 'progress_checker_plugins': list,
        'goal_checker_plugins': list, 'controller_plugins': list, 'speed_limit_topic': str,
        'use_realtime_priority': bool, 'publish_zero_velocity': bool, 'odom_duration': float,
        'action_server_result_timeout': float,
    },
    '/local_costmap/local_costmap': _COSTMAP,
    '/global_costmap/global_costmap': _COSTMAP,
    '/map_server': {'topic_name': str, 'frame_id': str, 'yaml_filename': str},
    '/map_saver': {
        'save_map_timeout': float, 'free_thresh_default': float, 'occupied_thresh_default': float,
        'map_subscribe_transient_local': bool,
    },
    '/planner_server': {
        'expected_planner_frequency': float, 'costmap_update_timeout': float,
        'planner_plugins': list, 'action_server_result_timeout': float,
    },
    '/smoother_server': {
        'smoother_plugins': list, 'costmap_topic': str, 'footprint_topic': str,
        'robot_base_frame': str, 'transform_tolerance': float,
        'action_server_result_timeout': float,
    },
    '/behavior_server': {
        **_COMMANDS, 'local_costmap_topic': str, 'global_costmap_topic': str,
        'local_footprint_topic': str, 'global_footprint_topic': str, 'cycle_frequency': float,
        'behavior_plugins': list, 'local_frame': str, 'global_frame': str,
        'robot_base_frame': str, 'transform_tolerance': float, 'simulate_ahead_time': float,
        'max_rotational_vel': float, 'min_rotational_vel': float, 'rotational_acc_lim': float,
        'action_server_result_timeout': float,
    },
    '/waypoint_follower': {
        'loop_rate': int, 'stop_on_failure': bool, 'action_server_result_timeout': float,
        'global_frame_id': str, 'waypoint_task_executor_plugin': str,
    },
    '/velocity_smoother': {
        **_COMMANDS, 'smoothing_frequency': float, 'scale_velocities': bool, 'feedback': str,
        'max_velocity': list, 'min_velocity': list, 'max_accel': list, 'max_decel': list,
        'odom_topic': str, 'odom_duration': float, 'deadband_velocity': list,
        'velocity_timeout': float, 'use_realtime_priority': bool,
    },
    '/collision_monitor': {
        **_COMMANDS, 'base_frame_id': str, 'odom_frame_id': str, 'cmd_vel_in_topic': str,
        'cmd_vel_out_topic': str, 'state_topic': str, 'transform_tolerance': float,
        'source_timeout': float, 'base_shift_correction': bool, 'stop_pub_timeout': float,
        'polygons': list, 'observation_sources': list, 'FootprintApproach.type': str,
        'FootprintApproach.action_type': str, 'FootprintApproach.footprint_topic': str,
        'FootprintApproach.time_before_collision': float,
        'FootprintApproach.simulation_time_step': float, 'FootprintApproach.min_points': int,
        'FootprintApproach.visualize': bool, 'FootprintApproach.enabled': bool, 'scan.type': str,
        'scan.topic': str, 'scan.enabled': bool, 'scan.source_timeout': float,
    },
    '/docking_server': {
        **_COMMANDS,
        **dict.fromkeys(
            (
                'controller_frequency', 'initial_perception_timeout', 'wait_charge_timeout',
                'dock_approach_timeout', 'undock_linear_tolerance', 'undock_angular_tolerance',
                'dock_prestaging_tolerance', 'controller.k_phi', 'controller.k_delta',
                'controller.v_linear_min', 'controller.v_linear_max',
            ),
            float,
        ),
        'max_retries': int, 'base_frame': str, 'fixed_frame': str, 'dock_backwards': bool,
        'dock_plugins': list, 'docks': list,
    },
    '/slam_toolbox': {
        **dict.fromkeys(
            (
                'solver_plugin', 'ceres_linear_solver', 'ceres_preconditioner',
                'ceres_trust_strategy', 'ceres_dogleg_type', 'ceres_loss_function', 'odom_frame',
                'map_frame', 'base_frame', 'scan_topic', 'mode', 'map_file_name', 'map_name',
            ),
            str,
        ),
        **dict.fromkeys(
            (
                'use_map_saver', 'debug_logging', 'enable_interactive_mode', 'use_scan_matching',
                'use_scan_barycenter', 'do_loop_closing', 'use_response_expansion',
                'map_start_at_dock', 'restamp_tf',
            ),
            bool,
        ),
        **dict.fromkeys(
            (
                'throttle_scans', 'stack_size_to_use', 'scan_buffer_size',
                'loop_match_minimum_chain_size', 'min_pass_through', 'scan_queue_size',
            ),
            int,
        ),
        **dict.fromkeys(
            (
                'transform_publish_period', 'map_update_interval', 'resolution',
                'min_laser_range', 'max_laser_range', 'minimum_time_interval',
                'transform_timeout', 'tf_buffer_duration', 'minimum_travel_distance',
                'minimum_travel_heading', 'scan_buffer_maximum_scan_distance',
                'link_match_minimum_response_fine', 'link_scan_maximum_distance',
                'loop_search_maximum_distance', 'loop_match_maximum_variance_coarse',
                'loop_match_minimum_response_coarse', 'loop_match_minimum_response_fine',
                'correlation_search_space_dimension', 'correlation_search_space_resolution',
                'correlation_search_space_smear_deviation', 'loop_search_space_dimension',
                'loop_search_space_resolution', 'loop_search_space_smear_deviation',
                'distance_variance_penalty', 'angle_variance_penalty',
                'fine_search_angle_offset', 'coarse_search_angle_offset',
                'coarse_angle_resolution', 'minimum_angle_penalty', 'minimum_distance_penalty',
                'occupancy_threshold',
            ),
            float,
        ),
    },
}  # fmt: skip
"""By full name: the parameters of the node itself, and their types."""

LISTS_OF_PLUGINS = {
    'navigators', 'progress_checker_plugins', 'goal_checker_plugins', 'controller_plugins',
    'plugins', 'planner_plugins', 'smoother_plugins', 'behavior_plugins', 'dock_plugins',
}  # fmt: skip
NAMES_OF_PLUGINS = {'waypoint_task_executor_plugin'}
OF_CLASS = {'robot_model_type'}
STARTED = {
    'controller_server', 'smoother_server', 'planner_server', 'behavior_server', 'bt_navigator',
    'waypoint_follower', 'velocity_smoother', 'collision_monitor', 'docking_server',
}  # fmt: skip
"""By navigation_launch.py of Jazzy."""


def nodes_of(file):
    """Return the parameters of each node of a file, by dotted name."""
    content = read_parameter_file(ROOT / 'config' / file)
    return {
        each.pattern: {dotted(keys): value for keys, value in flatten(each.parameters)}
        for each in sections(content)
    }


ALL = {**nodes_of(NAV2), **nodes_of(SLAM)}
CASES = pytest.mark.parametrize('node', ALL)


def plugins_in(parameters):
    """Return the class of each plugin of a node, by the name that it has there."""
    names = [name for key in LISTS_OF_PLUGINS & parameters.keys() for name in parameters[key]] + [
        parameters[key] for key in NAMES_OF_PLUGINS & parameters.keys()
    ]
    return {name: parameters[f'{name}.plugin'] for name in names}


def test_the_files_are_yaml_without_doubled_keys():
    for file in (NAV2, SLAM):
        text = (ROOT / 'config' / file).read_text(encoding='utf-8')
        tree = yaml.compose(text)
        pending = [tree]
        while pending:
            each = pending.pop()
            if isinstance(each, yaml.MappingNode):
                keys = [key.value for key, _ in each.value]
                assert len(set(keys)) == len(keys), keys
                pending += [value for _, value in each.value]


def test_every_node_that_is_started_has_a_section():
    found = {name.strip('/') for name in nodes_of(NAV2)}
    assert found >= STARTED
    assert {'amcl', 'map_server', 'local_costmap/local_costmap'} < found
    assert nodes_of(SLAM).keys() == {'/slam_toolbox'}


@CASES
def test_every_plugin_is_one_of_jazzy(node):
    parameters = ALL[node]
    for class_name in plugins_in(parameters).values():
        assert class_name in PLUGINS
    for key in OF_CLASS & parameters.keys():
        assert parameters[key] in PLUGINS
    used = {f'{name}.plugin' for name in plugins_in(parameters)}
    assert used == {name for name in parameters if name.endswith('.plugin')}


@CASES
def test_every_parameter_is_known_and_has_its_type(node):
    known = {**_EVERYWHERE, **NODES[node]}
    for name, class_name in plugins_in(ALL[node]).items():
        known |= {f'{name}.{key}': kind for key, kind in PLUGINS[class_name].items()}
        known[f'{name}.plugin'] = str
    for name, value in ALL[node].items():
        assert name in known, f'{node} has no parameter {name}'
        assert type(value) is known[name], f'{node}: {name} is {value!r}'
        if isinstance(value, list):
            assert len({type(item) for item in value}) == 1, f'{node}: {name} is {value!r}'


@CASES
def test_every_node_goes_by_the_simulated_time(node):
    assert ALL[node]['use_sim_time'] is True


def test_all_that_command_or_hear_commands_use_the_same_type():
    uses = {
        node: ALL[node].get('enable_stamped_cmd_vel')
        for node in NODES
        if 'enable_stamped_cmd_vel' in NODES[node]
    }
    assert len(uses) == 5
    assert {*uses.values()} == {True}


def test_speeds_of_a_node_do_not_exceed_those_of_the_smoother():
    top = ALL['/velocity_smoother']
    controller, behaviors = ALL['/controller_server'], ALL['/behavior_server']
    assert controller['FollowPath.desired_linear_vel'] <= top['max_velocity'][0]
    assert controller['FollowPath.rotate_to_heading_angular_vel'] <= top['max_velocity'][2]
    assert controller['FollowPath.max_angular_accel'] <= top['max_accel'][2]
    assert behaviors['max_rotational_vel'] <= top['max_velocity'][2]
    assert behaviors['rotational_acc_lim'] <= top['max_accel'][2]
    assert top['min_velocity'] == [-each for each in top['max_velocity']]
    assert top['max_decel'] == [-each for each in top['max_accel']]
    assert {len(top[key]) for key in ('max_velocity', 'max_accel', 'deadband_velocity')} == {3}


def test_the_controller_knows_the_slope_of_the_inflation():
    inflation = ALL['/local_costmap/local_costmap']['inflation_layer.cost_scaling_factor']
    assert ALL['/controller_server']['FollowPath.inflation_cost_scaling_factor'] == inflation


def test_the_commands_go_from_node_to_node_to_the_mux():
    monitor = ALL['/collision_monitor']
    assert monitor['cmd_vel_in_topic'] == 'cmd_vel_smoothed'
    text = (ROOT / 'config/twist_mux.yaml').read_text(encoding='utf-8')
    [section] = yaml.safe_load(text).values()
    inputs = section['ros__parameters']['topics']
    assert inputs['navigation']['topic'] == monitor['cmd_vel_out_topic']
