# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The navigator in the stack at factor 1, by its actions and topics, as of Nav2."""

import math
import os
import signal
import threading

from action_msgs.msg import GoalStatus
from fixtures.bringup.running import Bringup
from geometry_msgs.msg import PointStamped, PolygonStamped, PoseStamped, TwistStamped
from nav2_msgs.action import (
    ComputePathToPose,
    FollowPath,
    NavigateThroughPoses,
    NavigateToPose,
)
from nav_msgs.msg import OccupancyGrid, Odometry, Path
import pytest
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.parameter import Parameter
from ros_gz_interfaces.msg import Contacts
from support.paths import ROOT
from support.ros_processes import PATIENCE, running
from support.warehouse_goals import CONTACT_TOPIC, feeling_robot, random_goals

from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.ros.messages import pose_message, pose_of
from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import wait_until

GROUND = 'ground::link::collision'
LONGEST = 180.0
"""s for a goal; only a robot that is stuck takes as long."""


class Operator(Node):
    """Sends goals, and hears what comes of them."""

    def __init__(self):
        super().__init__('operator')
        self.heard = {}
        self.touched = set()
        for kind, topic, qos in (
            (Odometry, 'ground_truth/odom', 10),
            (Path, 'plan', 10),
            (PointStamped, 'lookahead_point', 10),
            (TwistStamped, 'cmd_vel', 10),
            (OccupancyGrid, 'global_costmap/costmap', LATCHED),
            (PolygonStamped, 'local_costmap/published_footprint', 10),
        ):
            self.create_subscription(kind, topic, self._take(topic), qos)
        self.create_subscription(Contacts, CONTACT_TOPIC, self._feel, 100)
        self.goal_pose = self.create_publisher(PoseStamped, 'goal_pose', 10)
        self.clients_of = {
            kind: ActionClient(self, kind, name)
            for kind, name in (
                (NavigateToPose, 'navigate_to_pose'),
                (NavigateThroughPoses, 'navigate_through_poses'),
                (ComputePathToPose, 'compute_path_to_pose'),
                (FollowPath, 'follow_path'),
            )
        }

    def _take(self, topic):
        return lambda message: self.heard.__setitem__(topic, message)

    def _feel(self, message):
        for each in message.contacts:
            pair = (each.collision1.name, each.collision2.name)
            if GROUND not in pair:
                self.touched.add(pair)

    def until(self, condition, timeout=PATIENCE):
        found = wait_until(self, lambda: condition() or None, every=0.05, timeout=timeout)
        assert found, 'waited in vain'
        return found

    def send(self, kind, feedback=None, **fields):
        """Return the handle of a goal."""
        client = self.clients_of[kind]
        self.until(client.server_is_ready)
        sent = client.send_goal_async(kind.Goal(**fields), feedback_callback=feedback)
        self.until(sent.done)
        return sent.result()

    def end(self, handle):
        """Return status and result of a goal."""
        done = handle.get_result_async()
        self.until(done.done, timeout=LONGEST)
        return done.result().status, done.result().result

    @property
    def pose(self):
        return pose_of(self.heard['ground_truth/odom'].pose.pose)

    def stands(self):
        twist = self.heard['ground_truth/odom'].twist.twist
        return abs(twist.linear.x) < 0.01 and abs(twist.angular.z) < 0.02

    @property
    def commanded(self):
        """The last command; None: the robot may drive already, but its commands are not heard."""
        command = self.heard.get('cmd_vel')
        return command and command.twist

    def moves(self):
        return abs(self.heard['ground_truth/odom'].twist.twist.linear.x) > 0.1

    def is_told_to_stand(self):
        twist = self.commanded
        return twist is not None and twist.linear.x == twist.angular.z == 0.0


def stamped(pose, frame='map'):
    message = PoseStamped(pose=pose_message(pose))
    message.header.frame_id = frame
    return message


@pytest.fixture(scope='module')
def up(tmp_path_factory):
    folder = tmp_path_factory.mktemp('navigator')
    own = {'AMENT_PREFIX_PATH': str(ROOT / 'install' / 'amr_description')}
    arguments = (
        'viewer:=false',
        f'urdf:={feeling_robot(folder)}',
        f'controllers:={ROOT / "config" / "controllers.yaml"}',
        'navigator:=false',
    )
    with Bringup(folder, 'navigation', *arguments, **own) as up:
        up.expect('ready in')
        rclpy.init(args=[])
        yield up
        rclpy.try_shutdown()
        assert up.end(signal.SIGINT) == 0
        assert 'process has died' not in up.output


@pytest.fixture(scope='module')
def navigator(up):
    on_all = ('--ros-args', '-r', 'map:=obstacle_map', '-p', 'use_sim_time:=true')
    world = ('warehouse', '--publish', '--height', '0.02', '--top', '0.4')
    named = ('-r', '__node:=obstacle_map')
    file = str(ROOT / 'config' / 'navigator.yaml')
    with (
        running('map_of_world', *world, *on_all, *named, until='Published a map'),
        running('navigator', *on_all, '--params-file', file, until='Drives to goals') as process,
    ):
        said = []
        reading = threading.Thread(target=lambda: said.extend(process.stderr))
        reading.start()
        yield said
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
        reading.join()


@pytest.fixture(scope='module')
def operator(navigator):
    operator = Operator()
    for client in operator.clients_of.values():
        operator.until(client.server_is_ready)
    operator.until(lambda: 'ground_truth/odom' in operator.heard)
    operator.until(lambda: operator.end(plan_ahead(operator))[0] == GoalStatus.STATUS_SUCCEEDED)
    yield operator
    for client in operator.clients_of.values():
        client.destroy()  # destroy_node leaves them, and they hold the node in the graph
    operator.destroy_node()


def plan_ahead(operator):
    """Ask for a path, of which there is one as soon as map and pose are known."""
    return operator.send(ComputePathToPose, goal=stamped(Pose(1.5, 0.0, 0.0)))


@pytest.mark.long  # the stack's own test drives to one
@pytest.mark.parametrize('count', [20])
def test_random_goals_are_reached_without_touching_anything(operator, count):
    for goal in random_goals(count, seed=4):
        feedback = []
        status, result = operator.end(
            operator.send(NavigateToPose, feedback.append, pose=stamped(goal))
        )
        assert (status, result.error_code, result.error_msg) == (
            GoalStatus.STATUS_SUCCEEDED,
            NavigateToPose.Result.NONE,
            '',
        )
        operator.until(operator.stands)
        pose = operator.pose
        away, turn = pose.distance(goal), math.degrees(wrapped(pose.yaw - goal.yaw))
        last = feedback[-1].feedback
        seconds = last.navigation_time.sec + last.navigation_time.nanosec * 1e-9
        print(
            f'({goal.x:.2f}, {goal.y:.2f}, {goal.yaw:.2f}) in {seconds:.1f} s: '
            f'{1000 * away:.0f} mm, {turn:.1f} degrees, {last.number_of_recoveries} recoveries'
        )
        assert away < 0.10
        assert abs(turn) < 5.0
        assert last.distance_remaining < 0.3
        assert not operator.touched
        assert pose_of(operator.heard['plan'].poses[-1].pose).distance(goal) < 1e-6


def test_topics_are_those_of_nav2(operator):
    operator.send(NavigateToPose, pose=stamped(Pose(1.0, 1.0, 0.0)))
    topics = (
        'plan',
        'lookahead_point',
        'global_costmap/costmap',
        'local_costmap/published_footprint',
    )
    operator.until(lambda: {*topics} <= operator.heard.keys())
    assert {operator.heard[topic].header.frame_id for topic in topics} == {'map'}
    assert {-1, 0, 99, 100} <= {*operator.heard['global_costmap/costmap'].data}
    assert len(operator.heard['local_costmap/published_footprint'].polygon.points) == 4


def test_parameters_may_be_set_while_it_drives(operator):
    def set_speed(speed):
        parameter = Parameter('FollowPath.desired_linear_vel', value=speed)
        request = SetParameters.Request(parameters=[parameter.to_parameter_msg()])
        client = operator.create_client(SetParameters, '/navigator/set_parameters')
        operator.until(client.service_is_ready)
        done = client.call_async(request)
        operator.until(done.done)
        operator.destroy_client(client)
        return done.result().results[0]

    handle = operator.send(NavigateToPose, pose=stamped(far_from(operator)))
    operator.until(operator.moves)
    assert set_speed(0.2).successful
    operator.until(lambda: operator.commanded and 0.0 < operator.commanded.linear.x <= 0.2)
    assert 'desired_linear_vel' in set_speed(-1.0).reason
    assert set_speed(0.5).successful
    handle.cancel_goal_async()
    operator.end(handle)


def test_a_canceled_goal_stops_the_robot(operator):
    handle = operator.send(NavigateToPose, pose=stamped(far_from(operator)))
    operator.until(operator.moves)
    handle.cancel_goal_async()
    status, _ = operator.end(handle)
    assert status == GoalStatus.STATUS_CANCELED
    operator.until(operator.is_told_to_stand)
    operator.until(operator.stands)


def far_from(operator):
    """A pose at the other end of the aisle, which is 3 m away at least."""
    return Pose(2.5, 0.0, 0.0) if operator.pose.x < -0.5 else Pose(-3.5, 0.0, 3.14)


@pytest.mark.long
def test_a_new_goal_ends_the_one_before(operator):
    first = operator.send(NavigateToPose, pose=stamped(far_from(operator)))
    operator.until(operator.moves)
    here = operator.pose
    near = Pose(here.x, 0.3, here.yaw)
    second = operator.send(NavigateToPose, pose=stamped(near))
    assert operator.end(first)[0] == GoalStatus.STATUS_ABORTED
    assert operator.end(second)[0] == GoalStatus.STATUS_SUCCEEDED
    assert operator.pose.distance(near) < 0.1


@pytest.mark.long  # short: the stack's own test drives to one
def test_goal_pose_is_driven_to_as_from_rviz(operator):
    goal = Pose(operator.pose.x, -0.5, 0.0)
    operator.goal_pose.publish(stamped(goal))
    operator.until(lambda: operator.pose.distance(goal) < 0.1, timeout=LONGEST)
    operator.until(operator.is_told_to_stand, timeout=LONGEST)


@pytest.mark.long
def test_poses_are_driven_through(operator):
    x = operator.pose.x
    left = set()
    handle = operator.send(
        NavigateThroughPoses,
        lambda each: left.add(each.feedback.number_of_poses_remaining),
        poses=[stamped(Pose(x, 0.6, 0.0)), stamped(Pose(x, -0.6, 0.0))],
    )
    status, result = operator.end(handle)
    assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, 0)
    assert left == {2, 1}


@pytest.mark.long
def test_a_path_is_computed_and_followed(operator):
    x = operator.pose.x
    status, result = operator.end(
        operator.send(ComputePathToPose, goal=stamped(Pose(x, 0.6, 1.57)))
    )
    assert status == GoalStatus.STATUS_SUCCEEDED
    assert result.path.header.frame_id == 'map'
    status, ended = operator.end(operator.send(FollowPath, path=result.path))
    assert (status, ended.error_code) == (GoalStatus.STATUS_SUCCEEDED, FollowPath.Result.NONE)
    assert operator.pose.distance(Pose(x, 0.6, 1.57)) < 0.1


BAD = {
    'unknown frame': (stamped(Pose(1.0, 0.0, 0.0), 'moon'), 202, '"moon" passed to'),
    'no frame': (stamped(Pose(1.0, 0.0, 0.0), ''), 202, 'has no frame_id'),
    'outside': (stamped(Pose(50.0, 0.0, 0.0)), 204, 'is outside of the map, which reaches from'),
    'far': (stamped(Pose(9e8, 0.0, 0.0)), 204, 'is outside of the map'),
    'huge': (stamped(Pose(1e300, 0.0, 0.0)), 200, 'no place'),
    'in a shelf': (stamped(Pose(0.0, 4.58, 0.0)), 206, 'choose a free one'),
}
BAD['NaN'] = (stamped(Pose(1.0, 0.0, 0.0)), 200, 'no unit quaternion')
BAD['NaN'][0].pose.orientation.w = math.nan


@pytest.mark.parametrize('case', BAD)
def test_a_goal_that_cannot_be_is_one_line_and_its_code(operator, case):
    goal, code, text = BAD[case]
    status, result = operator.end(operator.send(NavigateToPose, pose=goal))
    assert status == GoalStatus.STATUS_ABORTED
    assert (result.error_code, '\n' in result.error_msg) == (code, False)
    assert text in result.error_msg


def test_behavior_trees_are_refused(operator, navigator):
    handle = operator.send(
        NavigateToPose, pose=stamped(Pose(1.0, 0.0, 0.0)), behavior_tree='mine.xml'
    )
    assert not handle.accepted
    operator.until(lambda: any('there are no behavior trees here' in line for line in navigator))


def test_the_robot_stops_when_localisation_ceases(operator, up):
    handle = operator.send(NavigateToPose, pose=stamped(far_from(operator)))
    operator.until(operator.moves)
    pid = next(pid for name, pid in up.pids().items() if name.startswith('truth_localizer'))
    os.kill(pid, signal.SIGSTOP)
    try:
        status, result = operator.end(handle)
    finally:
        os.kill(pid, signal.SIGCONT)
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == 202
    assert 's old: localisation, or the odometry' in result.error_msg
    operator.until(operator.stands)
