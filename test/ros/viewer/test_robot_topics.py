# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is heard of a robot. The contacts of wheels: until the wheels are known, and then while
somebody watches.
"""

from dataclasses import replace

import numpy as np
import pytest

from amr_description.ros.readers import InterfaceValues, JointValues
from amr_description.viewer.graph import FoundRobot
from amr_description.viewer.protocol import Layout
from amr_description.viewer.ros import robot_topics
from amr_description.viewer.ros.robot_topics import RobotTopics
from amr_description.viewer.states import StateFrame

LEFT = {'contact': 1.0, 'normal_force': 20.0, 'slip_along': 0.5, 'slip_across': -0.5}
MESSAGE = InterfaceValues(['left', 'right'], [LEFT, {'contact': 0.0}])


class Topic:
    """Instead of a PolledTopic: what it is given is taken once."""

    def __init__(self, _node, _type, name, *_, **_options):
        self.name = name
        self.message = None
        self.is_open = True

    def take(self):
        message, self.message = self.message, None
        return message

    def destroy(self):
        self.is_open = False


@pytest.fixture
def opened(monkeypatch):
    """All topics that were subscribed to."""
    topics = []

    def subscribe(*arguments):
        topics.append(Topic(*arguments))
        return topics[-1]

    monkeypatch.setattr(robot_topics, 'PolledTopic', subscribe)
    return topics


@pytest.fixture
def robot(opened):
    nothing = dict.fromkeys(
        ('command', 'odometry', 'truth', 'joint_states', 'joint_publisher', 'manager', 'activity',
         'introspection')
    )  # fmt: skip
    found = FoundRobot(
        id='/',
        description='/d',
        wheels='/ground_truth/wheels',
        joint_commands=(),
        is_present=True,
        **nothing,
    )
    return RobotTopics(None, found, ())


def publish(opened):
    opened[-1].message = MESSAGE


def wheels(robot, frame):
    """What a state says of the wheels, after what has come since the last one."""
    (floats,) = frame.robots
    robot.write(floats, robot.take(0))
    return floats.wheels


@pytest.fixture
def frame(robot, opened):
    """A state, after the wheels are known."""
    publish(opened)
    assert robot.take(0) == []
    return StateFrame(Layout(1, (), (robot.layout,)))


def test_the_names_of_the_wheels_are_learnt_and_then_nobody_listens(robot, opened, frame):
    assert robot.layout.wheels == ('left', 'right')
    assert np.isnan(wheels(robot, frame)).all()
    assert opened[-1].is_open
    robot.watch(set())
    assert not opened[-1].is_open


def test_wheels_are_heard_until_they_are_known(robot, opened):
    robot.watch(set())
    robot.watch(set())
    assert [each.is_open for each in opened] == [True]


def test_what_is_watched_is_in_the_states_and_is_no_longer_known_after_that(robot, opened, frame):
    robot.watch({'wheels'})
    publish(opened)
    for _ in range(2):  # the latest value stays
        left, right = wheels(robot, frame)
        assert left.tolist() == [1.0, 20.0, 0.5, -0.5]
        assert (right[0], np.isnan(right[1:]).all()) == (0.0, True)
    robot.watch(set())
    assert np.isnan(wheels(robot, frame)).all()
    assert robot.take(0) == []
    assert robot.layout.wheels == ('left', 'right')


def test_what_is_watched_again_begins_unknown(robot, opened, frame):
    for _ in range(2):
        robot.watch({'wheels'})
        assert np.isnan(wheels(robot, frame)).all()
        publish(opened)
        assert wheels(robot, frame)[0][1] == 20.0
        robot.watch(set())
        assert np.isnan(wheels(robot, frame)).all()
    assert [each.is_open for each in opened] == [False, False]


def test_a_layout_laid_out_anew_has_no_value_that_nobody_watches(robot, opened, frame):
    robot.watch({'wheels'})
    publish(opened)
    wheels(robot, frame)
    robot.watch(set())
    robot.take(0)
    again = StateFrame(Layout(2, (), (robot.layout,)))
    robot.write(again.robots[0])
    assert np.isnan(again.robots[0].wheels).all()


@pytest.mark.parametrize(
    ('topic', 'known'), [('/joint_states', {'arm': 0.25}), ('/other/joint_states', {})]
)
def test_joints_stay_known_when_other_topics_of_the_robot_change(robot, opened, topic, known):
    before = RobotTopics(None, replace(robot.found, joint_states='/joint_states'), ('arm',))
    joint_states = next(each for each in opened[1:] if each.name == '/joint_states')
    joint_states.message = JointValues(0, ['arm'], [0.25], [])
    before.take(0)
    found = replace(robot.found, joint_states=topic, odometry='/odom')
    after = RobotTopics(None, found, ('arm',))
    after.keep_joint_states(before)
    assert after.positions() == known


@pytest.fixture
def wall(monkeypatch):
    """The wall clock, s: a list whose last element is now."""
    times = [100.0]
    monkeypatch.setattr(robot_topics, 'monotonic', lambda: times[-1])
    return times


@pytest.fixture
def measured(opened, robot, wall):
    """A robot whose odometry and joint states have just come, and its state."""
    found = replace(robot.found, odometry='/odom', joint_states='/joint_states')
    topics = RobotTopics(None, found, ('arm',))
    by_name = {each.name: each for each in opened}
    by_name['/odom'].message = MOTION
    by_name['/joint_states'].message = JointValues(0, ['arm'], [0.25], [0.5])
    frame = StateFrame(Layout(1, (), (topics.layout,)))
    topics.write(frame.robots[0], topics.take(0))
    return topics, frame.robots[0]


MOTION = (0.0,) * 6 + (1.0, 0.3, 0.0, 0.4)


def test_ages_are_those_of_the_latest_messages_of_each_kind(measured, wall):
    topics, _ = measured
    wall.append(103.0)
    ages = topics.ages(103.0)
    assert (ages.odometry, ages.joint_states) == (3.0, 3.0)
    assert ages.truth is ages.command is None


def test_what_a_dead_publisher_has_published_is_not_known_after_a_second(measured, wall):
    topics, floats = measured
    topics.unpublished = frozenset({'odometry', 'joint_states', 'truth'})
    wall.append(100.9)
    assert topics.take(0) == []
    wall.append(101.1)
    new = topics.take(0)
    assert sorted(new) == ['joint_states', 'odometry']
    topics.write(floats, new)
    assert np.isnan(floats.odometry).all()
    assert np.isnan(floats.positions).all() and np.isnan(floats.velocities).all()
    assert topics.ages(101.1).odometry is None
    assert topics.positions() == {}
    topics.write(floats)  # a new layout
    assert np.isnan(floats.odometry).all()


def test_a_silent_publisher_that_is_there_keeps_its_values(measured, wall):
    topics, floats = measured
    wall.append(160.0)
    topics.write(floats, topics.take(0))
    assert floats.odometry[7] == pytest.approx(0.3)


def test_a_robot_moves_as_its_odometry_says_lately_else_its_joints(measured, wall):
    topics, _ = measured
    assert topics.motion(100.1) == pytest.approx(50.0)  # 0.5 m/s, sideways included
    assert topics.motion(101.0) is None
    without = replace(topics.found, odometry=None)
    joints = RobotTopics(None, without, ('arm',))
    joints.keep_joint_states(topics)
    assert joints.motion(100.1) is None  # kept, but not measured lately
