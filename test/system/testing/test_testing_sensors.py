# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a test reads of sensors: the present instant, the same bits every time, nothing unasked."""

import math

import numpy as np
import pytest
from sensor_msgs.msg import LaserScan
from support.paths import ROOT

from amr_description.errors import SimulationError
from amr_description.model.description_file import description_at
from amr_description.model.frames import Transform

URDF = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
SPREAD = 0.03
"""m: six times the deviation of the lidar's noise."""
BUMPER = """
  <gazebo reference="base_link">
    <sensor name="bumper" type="contact">
      <topic>bumper</topic><contact><collision>base_link_collision</collision></contact>
    </sensor>
  </gazebo>
</robot>
"""

pytest_plugins = ['amr_description.testing.fixtures']


@pytest.fixture
def sim(simulation):
    return simulation(URDF, world='walls')


@pytest.fixture
def fleet(simulation):
    """Two robots with bumpers."""
    text = description_at(str(URDF), warn=pytest.fail)
    poses = {'robot1': Transform(), 'robot2': Transform((1.0, 0.0, 0.0))}
    return simulation(text.replace('</robot>', BUMPER), world='walls', robots=poses)


def test_a_wall_is_where_it_is_at_every_instant(sim):
    """Also between two measurements of the sensor, and at time 0."""
    for _ in range(3):
        scan = sim.scan
        assert (scan.time, scan.frame) == (sim.time, 'lidar_link')
        assert scan.angles[180] == pytest.approx(0.0, abs=1e-6)
        assert scan.ranges[0] == pytest.approx(3.0 + sim.truth.x, abs=SPREAD)
        assert scan.ranges[90] == pytest.approx(2.0 + sim.truth.y, abs=SPREAD)
        sim.drive(0.3, 0.0, seconds=0.312, stop=False)


def test_the_same_calls_give_the_same_bits(sim):
    found = []
    for _ in range(2):
        sim.reset()
        found.append([sim.scan.ranges.tobytes()])
        sim.drive(0.5, 0.7, seconds=0.4)
        found[-1] += [sim.scan.ranges.tobytes(), sim.scan.ranges.tobytes()]
    assert found[0] == found[1]
    first, second, again = found[0]
    assert first != second == again


def test_what_is_measured_when_it_is_due_is_what_is_read(sim):
    """The noise follows from the instant, not from who asked."""
    heard = []
    subscription = sim.node.create_subscription(LaserScan, '/scan', heard.append, 10)
    try:
        sim.wait(lambda: sim.scan and heard, 'a scan')
        sim.reset()
        sim.run(0.1)
        read = sim.scan
        heard.clear()
        sim.run(0.01)  # the tick at the end of a step belongs to the next one
        sim.wait(lambda: heard, 'the scan that is due')
        assert np.asarray(heard[0].ranges, np.float32).tobytes() == read.ranges.tobytes()
    finally:
        sim.node.destroy_subscription(subscription)


def test_a_camera_sees_the_wall_before_it(sim):
    """The east wall, 0.5 m high, of which the camera sees the middle; it is 0.24 m before base."""
    sim.drive(0.0, -0.6, seconds=0.2)
    depth, image = sim.depth(), sim.image('camera/image')
    assert depth.time == image.time == sim.time
    assert (depth.frame, image.frame) == ('camera_optical_frame',) * 2
    assert (depth.pixels.shape, image.pixels.shape) == ((240, 320), (240, 320, 3))
    # Along the optical axis, through the middle of the picture.
    expected = (3.0 - sim.truth.x) / math.cos(sim.truth.yaw) - 0.24
    assert depth.pixels[120, 160] == pytest.approx(expected, abs=0.01)
    assert image.pixels[120, 160] == pytest.approx(image.pixels[120, 161], abs=40)


@pytest.mark.parametrize(
    'read, words',
    [
        (lambda sim: sim.contacts(), "no sensor of 'amr' has a topic of ros_gz_interfaces/msg/Co"),
        (
            lambda sim: sim.points(),
            "'amr' has 2 topics of sensor_msgs/msg/PointCloud2; name one: ",
        ),
        (lambda sim: sim.scan_of('front'), "has a topic '/front' of sensor_msgs/msg/LaserScan; "),
        (lambda sim: sim.depth('/scan'), 'its sensors have: /scan (sensor_msgs/msg/LaserScan), '),
    ],
)
def test_a_topic_that_is_not_there_is_one_line_with_those_that_are(sim, read, words):
    with pytest.raises(SimulationError) as caught:
        read(sim)
    assert words in str(caught.value)
    assert '\n' not in str(caught.value)


def test_robots_see_each_other_in_frames_of_their_own(fleet):
    one, two = fleet.robots.values()
    assert (one.scan.frame, two.scan.frame) == ('robot1/lidar_link', 'robot2/lidar_link')
    # From the middle of one to the lidar of the other, radius 0.04.
    assert one.scan.ranges[180] == pytest.approx(0.96, abs=SPREAD)
    assert two.scan_of('scan').ranges[0] == pytest.approx(0.96, abs=SPREAD)
    assert math.isclose(one.scan.ranges[90], two.scan.ranges[90], abs_tol=2 * SPREAD)


def test_a_bumper_says_what_it_touches_and_that_it_touches_nothing(fleet):
    one, two = fleet.robots.values()
    assert one.contacts() == two.contacts() == []
    fleet.drive_all({'robot1': (0.4, 0.0)}, seconds=1.5, stop=False)
    contacts = one.contacts()
    assert {each.first for each in contacts} == {'robot1::base_link::base_link_collision'}
    assert all(each.second.startswith('robot2::wheel_back_') for each in contacts)
