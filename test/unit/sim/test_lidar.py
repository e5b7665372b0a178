# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Laws of simulated lidars: geometry, REP 117, noise, what is seen."""

import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.examples import examples

from amr_description.errors import SimulationError
from amr_description.model.frames import Transform
from amr_description.model.gazebo import Noise
from amr_description.model.sensors import Lidar, ScanAxis, SensorMount
from amr_description.sim.lidar import scan_angles, SimulatedLidar
from amr_description.sim.world import MujocoWorld

POST = """
<robot name="post">
  <link name="world"/>
  <joint name="stand" type="fixed"><parent link="world"/><child link="post"/></joint>
  <link name="post">{parts}
    <inertial>
      <mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
  </link>
</robot>
"""
"""A robot that stands where it is put."""
CIRCLE = ScanAxis(360, -math.pi, math.pi)
HALL = """
<mujoco><worldbody>
  <geom type="box" size="0.1 50 5" pos="8.1 0 0"/>
  <geom type="box" size="0.1 50 5" pos="-6.1 0 0"/>
  <geom type="box" size="50 0.1 5" pos="0 3.1 0"/>
  <geom type="box" size="50 0.1 5" pos="0 -2.1 0"/>
</worldbody></mujoco>
"""
"""A room from x = -6 to 8, from y = -2 to 3."""


def lidar(horizontal=CIRCLE, pose=None, **fields):
    """Return a lidar on the link of a post."""
    mount = SensorMount('lidar', 'post', pose or Transform())
    return Lidar(mount, horizontal, **{'range_min': 0.1, 'range_max': 30.0} | fields)


class Scene:
    """A world with one post."""

    def __init__(self, tmp_path, world=HALL, parts='', seed=0):
        path = tmp_path / 'world.xml'
        path.write_text(world)
        self.world = MujocoWorld(str(path), seed=seed)
        self.parts = parts

    def scan(self, description, pose=None, time=0):
        """Measure once, from a place; the post is gone after that."""
        robot = self.world.spawn('post', POST.format(parts=self.parts), pose or Transform())
        try:
            return self.measure(robot, description, time)
        finally:
            self.world.remove('post')

    def measure(self, robot, description, time=0):
        scene, sensor = self.world.ray_scene(), SimulatedLidar(description, robot)
        return sensor.measure(sensor.view(time, scene), scene)


@pytest.fixture(scope='module')
def hall(tmp_path_factory):
    return Scene(tmp_path_factory.mktemp('hall'))


def to_walls(x, y, angle):
    """Return the distance from a point in the hall to its walls, by the equations of planes."""
    cos, sin = math.cos(angle), math.sin(angle)
    along_x = ((8.0 if cos > 0.0 else -6.0) - x) / cos if cos else math.inf
    along_y = ((3.0 if sin > 0.0 else -2.0) - y) / sin if sin else math.inf
    return min(along_x, along_y)


angles = st.floats(-math.pi, math.pi)


@examples(25)
@given(x=st.floats(-5.0, 7.0), y=st.floats(-1.0, 2.0), yaw=angles)
def test_walls_are_where_they_are(hall, x, y, yaw):
    scan = hall.scan(lidar(), Transform.from_xyz_rpy((x, y, 0.0), (0.0, 0.0, yaw)))
    expected = [to_walls(x, y, yaw + angle) for angle in np.linspace(-math.pi, math.pi, 360)]
    assert scan.ranges[0] == pytest.approx(expected, rel=1e-6)


def karto_length(angle_min, angle_max, angle_increment, length):
    """Return how many ranges slam_toolbox expects; from its laser_utils.cpp and Karto."""
    span = np.float32(abs(np.float32(angle_max) - np.float32(angle_min)))
    epsilon = float(np.finfo(np.float32).eps) * 2.0 * math.pi
    is_circle = abs(float(span) - 2.0 * math.pi) < angle_increment - epsilon
    if span > 6.10865 and round(float(span) / angle_increment) + 1 == length:
        is_circle = False
    return round((angle_max - angle_min) / angle_increment) + (0 if is_circle else 1)


@pytest.mark.parametrize(
    ('samples', 'lower', 'upper'),
    [
        (360, -3.14, 3.14),
        (360, 0.0, 6.28),
        (360, -math.pi, math.pi),
        (720, -math.pi, math.pi * (1.0 - 2.0 / 720)),
        (8, 0.0, math.pi * 1.75),
        (8, -math.pi, 0.9 * math.pi),
        (2, -3.0, 3.0),
        (1, 0.0, 0.0),
        (1, -1.0, 1.0),
    ],
)
def test_slam_toolbox_accepts_the_length_of(samples, lower, upper):
    assert karto_length(*scan_angles(ScanAxis(samples, lower, upper)), samples) == samples


@examples(300)
@given(
    samples=st.integers(1, 5000), lower=st.floats(-2.0 * math.pi, math.pi), span=st.floats(1e-3, 7)
)
def test_slam_toolbox_accepts_every_length(samples, lower, span):
    assert karto_length(*scan_angles(ScanAxis(samples, lower, lower + span)), samples) == samples


def test_the_increment_is_that_of_the_rays():
    lower, upper, increment = scan_angles(ScanAxis(360, -3.14, 3.14))
    assert (lower, upper) == pytest.approx((-3.14, 3.14))
    assert increment == pytest.approx(6.28 / 359)


def test_misses_are_inf_and_what_is_too_near_is_minus_inf(hall):
    description = lidar(ScanAxis(4, 0.0, 1.5 * math.pi), range_min=2.5, range_max=7.0)
    east, north, west, south = hall.scan(description).ranges[0].tolist()
    assert (east, north, west, south) == (
        math.inf,
        pytest.approx(3.0),
        pytest.approx(6.0),
        -math.inf,
    )


@examples(20)
@given(x=st.floats(0.0, 5.0), resolution=st.sampled_from([0.001, 0.01, 0.015]))
def test_ranges_are_multiples_of_the_resolution(hall, x, resolution):
    description = lidar(ScanAxis(1, 0.0, 0.0), range_resolution=resolution)
    (distance,) = hall.scan(description, Transform((x, 0.0, 0.0))).ranges[0].tolist()
    assert distance == pytest.approx(8.0 - x, abs=resolution / 2.0 + 1e-6)
    assert distance / resolution == pytest.approx(round(distance / resolution), abs=1e-3)


def test_noise_has_the_mean_and_the_deviation_that_it_is_given(hall):
    description = lidar(ScanAxis(4000, -0.2, 0.2), noise=Noise(mean=0.03, stddev=0.02))
    exact = hall.scan(lidar(ScanAxis(4000, -0.2, 0.2))).ranges
    errors = hall.scan(description).ranges - exact
    assert errors.mean() == pytest.approx(0.03, abs=4 * 0.02 / math.sqrt(4000))
    assert errors.std() == pytest.approx(0.02, rel=4 / math.sqrt(8000))


def test_noise_follows_from_seed_and_time_alone(hall, tmp_path):
    description = lidar(noise=Noise(stddev=0.02))
    first = hall.scan(description, time=100).ranges
    hall.scan(description, time=200)
    assert hall.scan(description, time=100).ranges.tobytes() == first.tobytes()
    assert not np.any(hall.scan(description, time=200).ranges == first)
    assert not np.any(Scene(tmp_path, seed=1).scan(description, time=100).ranges == first)


def test_a_link_that_is_not_there(hall):
    with pytest.raises(SimulationError, match="there is no link 'nose' in the world; there are: "):
        hall.scan(Lidar(SensorMount('lidar', 'nose'), CIRCLE))
