# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""map → odom from ground truth, over DDS: at one stamp, in namespaces, after resets."""

from contextlib import contextmanager
from itertools import count

import pytest
from simulation_interfaces.msg import Result
from simulation_interfaces.srv import GetEntities, SetEntityState
from support.localizer_host import hosted, MS

from amr_description.maps.pose import Pose
from amr_description.model.frames import Transform
from amr_description.navigation.ros.messages import plane_pose, pose_of
from amr_description.nodes import truth_localizer
from amr_description.nodes.truth_localizer import TruthLocalizer
from amr_description.ros.messages import nanoseconds

TOLERANCE = 20 * MS


def truth_at(stamp: int) -> Pose:
    """Where a robot is that drives and turns: 1 m/s and 2 rad/s."""
    return Pose(2.0 + stamp / 1e9, -1.0, 2.0 * stamp / 1e9)


def odometry_at(stamp: int) -> Pose:
    """The same by its odometry, which began elsewhere and is 10 % off."""
    return Pose(0.9 * stamp / 1e9, 0.1, 1.8 * stamp / 1e9 - 0.3)


def test_it_is_right_at_the_stamp_of_the_truth_while_the_robot_turns():
    with hosted(TruthLocalizer) as host:
        host.send_odometry(980 * MS, odometry_at(980 * MS))
        host.send_odometry(1000 * MS, odometry_at(1000 * MS))
        # The truth of an instant is there before its odometry, and between two of those.
        host.send_truth(1010 * MS, truth_at(1010 * MS))
        host.send_odometry(1020 * MS, odometry_at(1020 * MS))
        found = host.map_to_odom(1010 * MS + TOLERANCE)
        base = found.compose(odometry_at(1010 * MS))
        assert base == pytest.approx(truth_at(1010 * MS), abs=1e-6)
        assert host.pose(1010 * MS) == pytest.approx(truth_at(1010 * MS), abs=1e-6)
        (pose,) = host.poses
        assert pose.header.frame_id == 'map'
        assert not pose.pose.covariance.any()


def test_no_stamp_comes_twice_while_time_stands_still():
    with hosted(TruthLocalizer) as host:
        host.send_odometry(1000 * MS, odometry_at(1000 * MS))
        for number in range(3):
            host.send_truth(1000 * MS, truth_at(1000 * MS))
            host.wait(lambda number=number: len(host.poses) > number)
        host.send_odometry(1020 * MS, odometry_at(1020 * MS))
        host.send_truth(1020 * MS, truth_at(1020 * MS))
        host.map_to_odom(1020 * MS + TOLERANCE)
        stamps = [nanoseconds(each.header.stamp) for each in host.transforms]
        assert stamps == [1000 * MS + TOLERANCE, 1020 * MS + TOLERANCE]


def test_updates_come_no_faster_than_they_are_asked_for():
    with hosted(TruthLocalizer, '-p', 'update_duration:=0.05') as host:
        for stamp in range(1000, 1121, 20):
            host.send_odometry(stamp * MS, odometry_at(stamp * MS))
            host.send_truth(stamp * MS, truth_at(stamp * MS))
            if (stamp - 1000) % 60 == 0:
                host.map_to_odom(stamp * MS + TOLERANCE)
        stamps = [nanoseconds(each.header.stamp) - TOLERANCE for each in host.transforms]
        assert stamps == [1000 * MS, 1060 * MS, 1120 * MS]


def test_after_a_reset_of_the_simulation_it_goes_on():
    with hosted(TruthLocalizer) as host:
        for stamp in (3000 * MS, 3020 * MS):
            host.send_odometry(stamp, odometry_at(stamp))
        host.send_truth(3020 * MS, truth_at(3020 * MS))
        host.map_to_odom(3020 * MS + TOLERANCE)
        before = len(host.transforms)
        stamps = count(20 * MS, 20 * MS)

        def send():
            # Which of the two topics is heard first after the reset is not known.
            stamp = next(stamps)
            host.send_odometry(stamp, Pose(0.5, 0.0, 0.0))
            host.send_truth(stamp, Pose(1.5, 2.0, 0.0))

        send()
        # A hundred times at most: time does not come to where it was.
        host.wait(lambda: len(host.transforms) > before, send)
        assert plane_pose(host.transforms[before]) == pytest.approx((1.0, 2.0, 0.0))
        assert nanoseconds(host.transforms[before].header.stamp) < 3000 * MS


def test_odometry_is_not_interpolated_between_two_robots():
    with hosted(TruthLocalizer) as host:
        host.send_odometry(1000 * MS, Pose(5.0, 0.0, 0.0))
        host.send_truth(1010 * MS, Pose(5.0, 0.0, 0.0))
        # Deleted, and spawned again at the origin: its odometry begins anew.
        host.send_odometry(4000 * MS, Pose(0.0, 0.0, 0.0))
        host.send_truth(4000 * MS, Pose(1.0, 2.0, 0.0))
        assert host.map_to_odom(4000 * MS + TOLERANCE) == pytest.approx((1.0, 2.0, 0.0))
        assert len(host.transforms) == 1


def test_frames_have_the_prefix_of_the_namespace_if_tf_has_it():
    with hosted(
        TruthLocalizer, '-r', 'truth_localizer:__ns:=/robot1', namespace='/robot1'
    ) as host:
        host.send_odometry(1000 * MS, Pose(1.0, 0.0, 0.0), 'robot1/odom', 'robot1/base_footprint')
        host.wait(lambda: host.node.count_subscribers('/robot1/ground_truth/odom'))
        host.send_truth(1000 * MS, Pose(3.0, 1.0, 0.0), 'robot1/base_footprint')
        assert host.map_to_odom(1000 * MS + TOLERANCE) == pytest.approx((2.0, 1.0, 0.0))
        assert host.transforms[0].child_frame_id == 'robot1/odom'
        assert host.pose(1000 * MS) == pytest.approx((3.0, 1.0, 0.0))


def test_the_pose_is_that_of_the_base_frame():
    with hosted(TruthLocalizer, '-p', 'base_frame_id:=base_link') as host:
        host.send_static('base_footprint', 'base_link', Transform((0.2, 0.0, 0.1)))
        host.send_odometry(1000 * MS, Pose(0.0, 0.0, 0.0))
        host.send_truth(1000 * MS, Pose(1.0, 1.0, 0.0))
        assert host.map_to_odom(1000 * MS + TOLERANCE) == pytest.approx((1.0, 1.0, 0.0))

        def is_there():  # the static transform may come after the truth
            host.send_truth(1000 * MS, Pose(1.0, 1.0, 0.0))
            return host.poses

        host.wait(is_there)
        assert host.pose(1000 * MS) == pytest.approx((1.2, 1.0, 0.0))


def begin(host) -> None:
    """Have the robot at (1, 1), turned to the left."""
    host.send_odometry(1000 * MS, Pose(0.0, 0.0, 0.0))
    host.send_truth(1000 * MS, Pose(1.0, 1.0, 1.5))
    host.map_to_odom(1000 * MS + TOLERANCE)


@contextmanager
def simulator(host, names, error=''):
    """The services of a simulator, which note what they are asked."""
    asked = []

    def set_state(request, response):
        asked.append(request)
        response.result.result = Result.RESULT_OPERATION_FAILED if error else Result.RESULT_OK
        response.result.error_message = error
        return response

    def get_entities(request, response):
        assert [each.category for each in request.filters.categories] == [1]
        response.entities, response.result.result = names, Result.RESULT_OK
        return response

    services = [
        host.node.create_service(GetEntities, '/mujoco_sim/get_entities', get_entities),
        host.node.create_service(SetEntityState, '/mujoco_sim/set_entity_state', set_state),
    ]
    host.wait(lambda: host.node.count_clients('/mujoco_sim/set_entity_state'))
    yield asked
    for service in services:
        host.node.destroy_service(service)


def move(host, asked, pose):
    """Send initial poses until the localizer knows of the simulator; return what that is asked."""

    def is_asked():
        host.send_initial_pose(pose)
        return asked

    host.wait(is_asked)
    return asked[0]


def test_an_initial_pose_puts_the_robot_there():
    with hosted(TruthLocalizer) as host:
        begin(host)
        with simulator(host, ['amr']) as asked:
            request = move(host, asked, Pose(-2.0, 0.5, -1.0))
            assert request.entity == 'amr'
            assert pose_of(request.state.pose) == pytest.approx((-2.0, 0.5, -1.0))
            assert request.state.pose.position.z == 0.25
            assert request.state.twist.linear.x == 0.0


def test_of_several_robots_the_one_of_the_parameter_is_moved():
    with hosted(TruthLocalizer, '-p', 'entity:=robot2') as host:
        begin(host)
        with simulator(host, ['robot1', 'robot2']) as asked:
            assert move(host, asked, Pose(0.0, 0.0, 0.0)).entity == 'robot2'


def test_which_of_several_robots_is_meant_has_to_be_said():
    with hosted(TruthLocalizer) as host:
        begin(host)
        with simulator(host, ['left', 'right']) as asked:

            def is_said():
                host.send_initial_pose(Pose(0.0, 0.0, 0.0))
                return any('are left, right' in line for line in host.log)

            host.wait(is_said)
            assert "parameter 'entity'" in host.line('are left, right')
            assert asked == []


def test_what_the_simulator_refuses_is_said():
    with hosted(TruthLocalizer) as host:
        begin(host)
        with simulator(host, ['amr'], "'amr' stands fixed in the world") as asked:
            move(host, asked, Pose(0.0, 0.0, 0.0))
            assert 'set_entity_state answers' in host.line('stands fixed')


def test_without_a_simulator_the_robot_stays():
    with hosted(TruthLocalizer, '-p', 'simulator:=/nobody') as host:
        begin(host)
        host.send_initial_pose(Pose(0.0, 0.0, 0.0))
        line = host.line('no simulator serves /nobody/get_entities')
        assert 'set_entity_state:=false' in line


def test_an_initial_pose_may_shift_the_map_instead():
    with hosted(TruthLocalizer, '-p', 'set_entity_state:=false') as host:
        begin(host)
        host.send_initial_pose(Pose(4.0, 0.0, 0.0))

        def is_there():
            host.send_truth(1000 * MS, Pose(1.0, 1.0, 1.5))
            poses = [pose_of(each.pose.pose) for each in host.poses]
            return poses and poses[-1] == pytest.approx((4.0, 0.0, 0.0))

        host.wait(is_there)
        host.send_odometry(2000 * MS, Pose(1.0, 0.0, 0.0))
        host.send_truth(2000 * MS, Pose(1.0, 1.0, 1.5).compose(Pose(1.0, 0.0, 0.0)))
        assert host.map_to_odom(2000 * MS + TOLERANCE) == pytest.approx((4.0, 0.0, 0.0))
        assert host.pose(2000 * MS) == pytest.approx((5.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ('pose', 'frame', 'said'),
    [
        (Pose(1.0, 0.0, 0.0), '', 'Received initial pose with empty frame_id.'),
        (
            Pose(1.0, 0.0, 0.0),
            'odom',
            'Ignoring initial pose in frame "odom"; initial poses must be in the global frame, '
            '"map"',
        ),
        (Pose(float('nan'), 0.0, 0.0), 'map', 'is not a finite number'),
        (Pose(1e300, 0.0, 0.0), 'map', 'it is at (1e+300, 0), which is no place'),
        (Pose(1.0, 0.0, 0.0), 'map', 'nothing is known of the robot yet'),
    ],
)
def test_an_initial_pose_that_cannot_be_used_is_said(pose, frame, said):
    with hosted(TruthLocalizer) as host:
        host.send_initial_pose(pose, frame)
        host.line(said)


def test_what_is_missing_is_said_once(monkeypatch):
    monkeypatch.setattr(truth_localizer, '_PATIENCE', 0.0)
    with hosted(TruthLocalizer, '-r', 'ground_truth/odom:=truth/odom') as host:
        line = host.line('no pose in map yet.')
        assert 'Nothing is on /truth/odom' in line
        assert 'there are: /ground_truth/odom. Another' in line or 'there are: none.' in line
        assert 'ground_truth_rate above 0' in line


def test_frames_that_tf_does_not_have_are_said():
    with hosted(TruthLocalizer, '-p', 'odom_frame_id:=wheels') as host:
        host.send_odometry(1000 * MS, Pose(0.0, 0.0, 0.0))
        host.send_truth(1000 * MS, Pose(0.0, 0.0, 0.0))

        line = "no 'wheels' above 'base_footprint'; its frames: base_footprint, odom."

        def is_said():
            host.send_initial_pose(Pose(0.0, 0.0, 0.0))
            return any(line in each for each in host.log)

        host.wait(is_said)
