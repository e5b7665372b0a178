# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What clients of Nav2's servers ask the navigator, in one process, of a point that drives."""

import math

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, PoseStamped
from lifecycle_msgs.srv import GetState
from nav2_msgs.srv import ClearEntireCostmap, GetCostmap, LoadMap
from nav_msgs.msg import Path
import pytest
from support.navigator_site import ROOM, site_with_a_navigator

from amr_description.maps.map_files import save_map
from amr_description.maps.pose import Pose
from amr_description.navigation.ros.map_service import MapService
from amr_description.navigation.ros.messages import grid_message, pose_message

SUCCEEDED, ABORTED = GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_ABORTED


@pytest.fixture(scope='module')
def site():
    with site_with_a_navigator() as site:
        state = site.ask(GetState, 'bt_navigator/get_state').current_state
        assert (state.id, state.label) == (2, 'inactive')  # it has no map yet
        site.maps.publish(grid_message(ROOM))
        # It is active when it knows where it is.
        site.until(lambda: site.ask(GetState, 'bt_navigator/get_state').current_state.id == 3)
        yield site


def stamped(x, y, yaw=0.0):
    message = PoseStamped(pose=pose_message(Pose(x, y, yaw)))
    message.header.frame_id = 'map'
    return message


@pytest.mark.parametrize(
    'name',
    [
        'bt_navigator',
        'planner_server',
        'controller_server',
        'smoother_server',
        'behavior_server',
        'waypoint_follower',
    ],
)
def test_it_is_active_under_the_names_of_nav2_once_it_can_drive(site, name):
    site.until(lambda: site.ask(GetState, f'{name}/get_state').current_state.label == 'active')
    assert site.ask(GetState, f'{name}/get_state').current_state.id == 3


def test_behaviors_move_the_robot_and_say_how_far(site):
    begin, told = site.pose, []
    status, result = site.goal(
        'drive_on_heading', told, target=Point(x=0.3), speed=0.3, time_allowance=Duration(sec=10)
    )
    assert (status, result.error_code) == (SUCCEEDED, 0)
    assert site.pose.x - begin.x == pytest.approx(0.3, abs=0.1)
    assert result.total_elapsed_time.sec + result.total_elapsed_time.nanosec > 0
    assert 0.0 < max(each.distance_traveled for each in told) < 0.4
    begin = site.pose
    assert site.goal('backup', target=Point(x=0.3), speed=0.3)[0] == SUCCEEDED
    assert site.pose.x - begin.x == pytest.approx(-0.3, abs=0.1)
    begin, told = site.pose, []
    assert site.goal('spin', told, target_yaw=-1.0)[0] == SUCCEEDED
    assert site.pose.yaw - begin.yaw == pytest.approx(-1.0, abs=0.15)
    assert max(each.angular_distance_traveled for each in told) > 0.5
    told = []
    assert site.goal('wait', told, time=Duration(nanosec=300_000_000))[0] == SUCCEEDED
    assert all(each.time_left.sec == 0 for each in told)


@pytest.mark.parametrize(
    ('name', 'fields', 'code'),
    [
        ('backup', {'target': Point(x=0.1, y=0.1), 'speed': 0.1}, 713),
        ('backup', {'target': Point(x=0.1), 'speed': 0.0}, 713),
        ('backup', {'target': Point(x=math.nan), 'speed': 0.1}, 713),
        ('drive_on_heading', {'target': Point(x=0.1), 'speed': -0.1}, 724),
        ('drive_on_heading', {'target': Point(x=9.0), 'speed': 1.0}, 723),
        ('spin', {'target_yaw': math.inf}, 700),
        ('spin', {'target_yaw': 3.0, 'time_allowance': Duration(nanosec=200_000_000)}, 701),
        ('assisted_teleop', {'time_allowance': Duration(nanosec=200_000_000)}, 731),
        ('follow_waypoints', {}, 600),
        ('compute_path_through_poses', {}, 309),
        ('compute_path_through_poses', {'goals': [stamped(99.0, 0.0)]}, 304),
        ('smooth_path', {}, 505),
    ],
)
def test_what_cannot_be_done_has_the_code_of_its_action(site, name, fields, code):
    status, result = site.goal(name, **fields)
    assert (status, result.error_code) == (ABORTED, code)
    assert result.error_msg


def test_paths_lead_through_poses_and_are_smoothed(site):
    start = stamped(0.0, 0.0)
    _, direct = site.goal(
        'compute_path_to_pose', start=start, goal=stamped(1.0, 1.0), use_start=True
    )
    status, through = site.goal(
        'compute_path_through_poses',
        start=start,
        goals=[stamped(1.0, 0.0), stamped(1.0, 1.0)],
        use_start=True,
    )
    assert status == SUCCEEDED
    places = [(each.pose.position.x, each.pose.position.y) for each in through.path.poses]
    assert (1.0, 0.0) in places
    assert places[-1] == (1.0, 1.0)
    assert len(places) > len(direct.path.poses)
    bent = Path(poses=[stamped(0.0, 0.0), stamped(0.5, 0.5), stamped(1.0, 0.0)])
    status, smooth = site.goal('smooth_path', path=bent)
    assert (status, smooth.was_completed) == (SUCCEEDED, True)
    assert 0.0 < smooth.path.poses[1].pose.position.y < 0.5


def test_waypoints_are_driven_to_and_those_that_are_missed_are_named(site):
    poses = [stamped(0.5, 0.0), stamped(99.0, 0.0), stamped(0.0, 0.0)]
    told = []
    status, result = site.goal('follow_waypoints', told, poses=poses)
    assert status == SUCCEEDED
    ((index, code),) = [(each.index, each.error_code) for each in result.missed_waypoints]
    assert (index, code) == (1, 204)
    assert site.pose.distance(Pose(0.0, 0.0, 0.0)) < 0.3
    assert {each.current_waypoint for each in told} >= {0, 2}


@pytest.mark.parametrize('name', ['follow_gps_waypoints', 'dock_robot', 'undock_robot'])
def test_what_is_not_here_is_refused_at_once(site, name):
    assert site.goal(name) is None


def test_costmaps_are_read_and_cleared(site):
    whole = site.ask(GetCostmap, 'global_costmap/get_costmap').map
    assert (whole.metadata.size_x, whole.metadata.size_y) == (120, 120)
    assert whole.metadata.resolution == pytest.approx(0.05)
    assert whole.metadata.origin.position.x == -3.0
    assert (len(whole.data), whole.header.frame_id) == (120 * 120, 'map')
    local = site.ask(GetCostmap, 'local_costmap/get_costmap').map
    assert (local.metadata.size_x, len(local.data)) == (60, 3600)
    assert local.metadata.origin.position.x == pytest.approx(site.pose.x - 1.5, abs=0.1)
    for name in ('global_costmap', 'local_costmap'):
        site.ask(ClearEntireCostmap, f'{name}/clear_entirely_{name}')


def test_a_map_is_replaced_by_that_of_a_file(site, tmp_path):
    service = MapService(site, 'another/map', 'map')
    site.create_service(LoadMap, 'map_server/load_map', service.load)
    found = site.ask(LoadMap, 'map_server/load_map', map_url=str(tmp_path / 'none.yaml'))
    assert found.result == LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST
    _, file = save_map(ROOM, tmp_path / 'room')
    found = site.ask(LoadMap, 'map_server/load_map', map_url=str(file))
    assert (found.result, found.map.info.width) == (LoadMap.Response.RESULT_SUCCESS, 120)
