# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Sensors of public descriptions have the topics, types and frames that their own files expect."""

from fixtures.sim.public_sensors import HUSKY_BRIDGE, ROBOTS
import pytest

from amr_description.model import checks
from amr_description.model.gazebo.bridge import bridged, read_bridge
from amr_description.model.gazebo.translation import translate
from amr_description.model.sensors import Camera
from amr_description.model.urdf import parse


def translated(name, tmp_path):
    file = tmp_path / 'bridge.yaml'
    file.write_text(HUSKY_BRIDGE if name == 'husky' else '')
    return bridged(translate(parse(ROBOTS[name].urdf(name))), read_bridge(file))


@pytest.mark.parametrize('name', ROBOTS)
def test_all_that_they_expect_is_there(name, tmp_path):
    found = translated(name, tmp_path)
    assert not found.not_simulated and not found.notes
    topics = {
        sensor.mount.full_name(topic, '/'): (kind.rpartition('/')[2], sensor.mount.frame)
        for sensor in found.sensors
        for topic, kind in sensor.topics
    }
    expected = ROBOTS[name].topics
    assert {topic: topics.get(topic) for topic in expected} == expected
    beside = {topic for topic in topics if topic not in expected}
    assert all(topic.endswith('/points') for topic in beside)  # of a lidar, as the type has them


@pytest.mark.parametrize('name', ROBOTS)
def test_nothing_is_wrong_with_their_tags(name):
    told = [each.text for each in checks.check(ROBOTS[name].urdf(name), name)]
    assert not [text for text in told if 'gazebo sensor' in text]


@pytest.mark.parametrize('name', ROBOTS)
def test_points_are_right_in_the_frame_that_they_name(name, tmp_path):
    """These frames are optical, but for one camera without depth."""
    for sensor in translated(name, tmp_path).sensors:
        if isinstance(sensor, Camera):
            assert sensor.points_are_optical is (name != 'andino')


def test_in_a_namespace_nothing_is_outside_but_what_says_so(tmp_path):
    outside = {'/velodyne_points'}
    for name in ROBOTS:
        found = translated(name, tmp_path)
        names = {
            each.mount.full_name(topic, '/r1')
            for each in found.sensors
            for topic, _ in each.topics
        }
        assert {topic for topic in names if not topic.startswith('/r1/')} <= outside
