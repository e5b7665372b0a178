# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""TurtleBot4Navigator by its own name, against our navigator and a base with a dock."""

import math

from geometry_msgs.msg import PoseWithCovarianceStamped
from irobot_create_msgs.action import Dock, Undock
from irobot_create_msgs.msg import DockStatus
import pytest
from rclpy.action import ActionServer
from rclpy.action.server import GoalResponse
from rclpy.qos import qos_profile_sensor_data
from support.navigator_site import ROOM, site_with_a_navigator
from support.waiting import until
from turtlebot4_navigation.turtlebot4_navigator import TurtleBot4Directions, TurtleBot4Navigator

from amr_description.maps.pose import Pose
from amr_description.navigation.ros.messages import grid_message
from amr_description.ros.runtime import spinning


class Base:
    """A Create 3 as far as its dock goes; it refuses to dock where it is docked."""

    def __init__(self, node):
        self.is_docked = True
        self.status = node.create_publisher(DockStatus, 'dock_status', qos_profile_sensor_data)
        node.create_timer(0.05, lambda: self.status.publish(DockStatus(is_docked=self.is_docked)))
        for kind, name, docked in ((Dock, 'dock', True), (Undock, 'undock', False)):
            ActionServer(
                node,
                kind,
                name,
                lambda handle, kind=kind, docked=docked: self._do(handle, kind, docked),
                goal_callback=lambda _goal, docked=docked: self._take(docked),
            )

    def _take(self, docked):
        return GoalResponse.REJECT if docked == self.is_docked else GoalResponse.ACCEPT

    def _do(self, handle, kind, docked):
        self.is_docked = docked
        handle.succeed()
        return kind.Result(is_docked=docked)


@pytest.fixture(scope='module')
def site():
    with site_with_a_navigator() as site:
        site.base = Base(site)
        site.clicks = site.create_publisher(PoseWithCovarianceStamped, 'initialpose', 10)
        with spinning(site):
            site.maps.publish(grid_message(ROOM))
            yield site


@pytest.fixture(scope='module')
def navigator(site):
    navigator = TurtleBot4Navigator()
    yield navigator
    navigator.destroyNode()


@pytest.mark.parametrize(('direction', 'yaw'), [('NORTH', 0.0), ('WEST', 90.0), ('EAST', 270.0)])
def test_poses_are_on_the_map_and_turned_by_degrees(navigator, direction, yaw):
    pose = navigator.getPoseStamped([1, 2.5], TurtleBot4Directions[direction])
    assert (pose.header.frame_id, pose.pose.position.x, pose.pose.position.y) == ('map', 1.0, 2.5)
    turned = pose.pose.orientation
    assert turned.z == pytest.approx(math.sin(math.radians(yaw / 2)))
    assert turned.w == pytest.approx(math.cos(math.radians(yaw / 2)))


def test_it_docks_and_undocks(site, navigator):
    assert navigator.getDockedStatus() is True
    navigator.dock()  # is refused, and does not wait
    navigator.undock()
    assert site.base.is_docked is False
    until(lambda: not navigator.getDockedStatus())
    navigator.dock()
    assert navigator.isDockComplete()
    assert navigator.isUndockComplete()
    assert site.base.is_docked is True


def test_it_drives_until_it_is_there(site, navigator, capsys):
    navigator.startToPose(navigator.getPoseStamped([0.6, 0.0], TurtleBot4Directions.NORTH))
    assert site.pose.distance(Pose(0.6, 0.0, 0.0)) < 0.3
    assert 'Estimated time of arrival: ' in capsys.readouterr().out
    back = [navigator.getPoseStamped([x, 0.0], 180) for x in (0.3, 0.0)]
    navigator.startFollowWaypoints(back)
    assert site.pose.distance(Pose(0.0, 0.0, 0.0)) < 0.3
    assert '/2' in capsys.readouterr().out
    navigator.startThroughPoses(back)
    navigator.startToPose(navigator.getPoseStamped([99.0, 0.0], 0))  # off the map: it returns


def test_a_path_is_made_of_poses_that_are_given(site, navigator, monkeypatch):
    def enter():
        """Press Enter once two poses were taken."""
        for x in (1.0, 2.0):
            click = PoseWithCovarianceStamped()
            click.pose.pose.position.x = x
            until(lambda: navigator.creating_path and site.clicks.get_subscription_count())
            before = len(taken)
            site.clicks.publish(click)
            until(lambda before=before: len(taken) > before)

    taken = []
    monkeypatch.setattr('builtins.input', enter)
    monkeypatch.setattr(navigator, 'clearAllCostmaps', lambda: taken.append(None))
    path = navigator.createPath()
    assert [each.pose.position.x for each in path] == [1.0, 2.0]
