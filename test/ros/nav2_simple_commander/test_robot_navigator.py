# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""BasicNavigator by its own name, against the navigator of this package, in one process."""

import math

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav2_msgs.srv import LoadMap, ManageLifecycleNodes
from nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult
import pytest
from support.navigator_site import ROOM, site_with_a_navigator

from amr_description.maps.map_files import save_map
from amr_description.maps.pose import Pose
from amr_description.navigation.ros.managed_names import ManagedNames
from amr_description.navigation.ros.map_service import MapService
from amr_description.navigation.ros.messages import grid_message, pose_message
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import spinning


class Localizer:
    """Is active as amcl is, and says where the robot is once it was told."""

    def __init__(self, site):
        self.names, self.told = ManagedNames(site, ['amcl'], lambda: True), []
        self.poses = site.create_publisher(PoseWithCovarianceStamped, 'amcl_pose', LATCHED)
        site.create_subscription(PoseWithCovarianceStamped, 'initialpose', self._take, 10)

    def _take(self, message):
        self.told.append(message)
        self.poses.publish(message)


@pytest.fixture(scope='module')
def site():
    with site_with_a_navigator() as site:
        site.localizer = Localizer(site)
        with spinning(site):
            site.maps.publish(grid_message(ROOM))
            yield site


@pytest.fixture(scope='module')
def navigator(site):
    navigator = BasicNavigator()
    navigator.setInitialPose(stamped(0.0, 0.0))
    navigator.waitUntilNav2Active()
    assert site.localizer.told[-1].header.frame_id == 'map'
    yield navigator
    navigator.destroyNode()


def stamped(x, y):
    message = PoseStamped(pose=pose_message(Pose(x, y, 0.0)))
    message.header.frame_id = 'map'
    return message


def finish(navigator):
    """Wait for the end of the task; return its result and the last feedback."""
    feedback = None
    while not navigator.isTaskComplete():
        feedback = navigator.getFeedback() or feedback
    return navigator.getResult(), feedback


@pytest.mark.usefixtures('site')
def test_without_a_task_all_is_complete():
    idle = BasicNavigator('idle')
    assert idle.isTaskComplete()
    assert idle.getResult() is TaskResult.UNKNOWN
    assert idle.getFeedback() is None
    idle.destroyNode()


def test_it_drives_to_poses_along_paths_and_to_waypoints(site, navigator):
    assert navigator.goToPose(stamped(0.6, 0.0))
    result, feedback = finish(navigator)
    assert result is TaskResult.SUCCEEDED
    assert feedback.distance_remaining < 0.6
    assert site.pose.distance(Pose(0.6, 0.0, 0.0)) < 0.3
    path = navigator.getPath(stamped(0.0, 0.0), stamped(0.0, 0.5), use_start=True)
    assert path.poses[-1].pose.position.y == 0.5
    longer = navigator.getPathThroughPoses(
        stamped(0.0, 0.0), [stamped(0.5, 0.5), stamped(0.0, 0.5)], use_start=True
    )
    assert len(longer.poses) > len(path.poses)
    smooth = navigator.smoothPath(longer)
    assert len(smooth.poses) == len(longer.poses)
    for begin in (
        lambda: navigator.followPath(navigator.getPath(stamped(0.0, 0.0), stamped(0.0, 0.0))),
        lambda: navigator.goThroughPoses([stamped(0.3, 0.0), stamped(0.5, 0.0)]),
        lambda: navigator.followWaypoints([stamped(0.3, 0.0), stamped(0.0, 0.0)]),
    ):
        assert begin()
        assert finish(navigator)[0] is TaskResult.SUCCEEDED
    assert site.pose.distance(Pose(0.0, 0.0, 0.0)) < 0.3


def test_behaviors(site, navigator):
    begin = site.pose
    assert navigator.spin(spin_dist=0.8)
    assert finish(navigator)[0] is TaskResult.SUCCEEDED
    assert math.cos(site.pose.yaw - begin.yaw - 0.8) > 0.95
    for move in (navigator.driveOnHeading, navigator.backup):
        assert move(0.2, 0.2)
        assert finish(navigator)[0] is TaskResult.SUCCEEDED
    assert navigator.assistedTeleop(time_allowance=1)
    assert finish(navigator)[0] is TaskResult.FAILED  # its time is over


def test_a_task_is_cancelled(navigator):
    assert navigator.goToPose(stamped(2.0, 2.0))
    navigator.cancelTask()
    assert finish(navigator)[0] is TaskResult.CANCELED


def test_what_cannot_be_done_is_said(navigator):
    assert navigator.getPath(stamped(0.0, 0.0), stamped(99.0, 0.0)) is None
    assert navigator.goToPose(stamped(99.0, 0.0))
    assert finish(navigator)[0] is TaskResult.FAILED
    assert navigator.dockRobotByID('one') is False
    assert navigator.dockRobotByPose(stamped(0.0, 0.0), 'charger') is False
    assert navigator.undockRobot() is False
    assert navigator.followGpsWaypoints([]) is False
    assert navigator.isTaskComplete()


def test_costmaps(navigator):
    assert navigator.getGlobalCostmap().metadata.size_x == 120
    assert navigator.getLocalCostmap().metadata.size_x == 60
    navigator.clearAllCostmaps()
    navigator.clearCostmapExceptRegion(1.0)
    navigator.clearCostmapAroundRobot(1.0)
    navigator.clearCostmapAroundPose(stamped(0.0, 0.0), 1.0)


def test_maps_and_lifecycle_managers(site, navigator, tmp_path):
    asked = []

    def manage(request, response):
        asked.append(request.command)
        response.success = True
        return response

    service = MapService(site, 'another/map', 'map')
    site.create_service(LoadMap, 'map_server/load_map', service.load)
    site.create_service(ManageLifecycleNodes, 'lifecycle_manager_navigation/manage_nodes', manage)
    site.executor.wake()
    _, file = save_map(ROOM, tmp_path / 'room')
    assert navigator.changeMap(str(file))
    assert not navigator.changeMap(str(tmp_path / 'none.yaml'))
    while not any('manage_nodes' in name for name, _ in navigator.get_service_names_and_types()):
        navigator.isTaskComplete()
    navigator.lifecycleStartup()
    navigator.lifecycleShutdown()
    assert asked == [0, 4]
