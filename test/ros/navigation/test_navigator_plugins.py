# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A navigator whose planner is a function of the user's, named by a parameter."""

from geometry_msgs.msg import PoseStamped
import pytest
from support.navigator_site import ROOM, site_with_a_navigator

from amr_description.errors import ParameterError
from amr_description.maps.pose import Pose
from amr_description.navigation.ros.messages import grid_message, pose_message

MODULE = """
def plan(costmap, start, goal):
    assert goal.x < 1.5, 'too far'
    return [(start.x, start.y), (0.25, 0.75), (goal.x, goal.y)]
"""


@pytest.fixture
def module(tmp_path, monkeypatch):
    (tmp_path / 'planner_of_mine.py').write_text(MODULE)
    monkeypatch.syspath_prepend(str(tmp_path))
    return 'planner_of_mine'


def stamped(x, y):
    message = PoseStamped(pose=pose_message(Pose(x, y, 0.0)))
    message.header.frame_id = 'map'
    return message


def test_it_plans_and_its_fault_is_the_end_of_the_goal_alone(module):
    with site_with_a_navigator(**{'planner.plugin': f'{module}/plan'}) as site:
        site.maps.publish(grid_message(ROOM))
        site.until(lambda: site.goal('compute_path_to_pose', goal=stamped(1.0, 1.0))[0] == 4)
        _, result = site.goal('compute_path_to_pose', goal=stamped(1.0, 1.0))
        places = [(each.pose.position.x, each.pose.position.y) for each in result.path.poses]
        assert places == [(0.0, 0.0), (0.25, 0.75), (1.0, 1.0)]
        _, result = site.goal('compute_path_to_pose', goal=stamped(2.0, 0.0))
        assert result.error_code == 200
        words = 'the planner has failed: AssertionError: too far (planner_of_mine.py:3)'
        assert result.error_msg == words
        assert site.goal('compute_path_to_pose', goal=stamped(1.0, 1.0))[0] == 4


@pytest.mark.parametrize('parameter', ['planner.plugin', 'FollowPath.plugin'])
def test_a_name_of_nothing_is_refused_at_the_start(parameter):
    with (
        pytest.raises(ParameterError, match="'nowhere.at_all/f' is not known"),
        site_with_a_navigator(**{parameter: 'nowhere.at_all/f'}),
    ):
        pytest.fail('it has started')
