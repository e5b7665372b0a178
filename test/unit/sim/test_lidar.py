# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Laws of simulated lidars: geometry, REP 117, noise, what is seen."""

from dataclasses import replace
import math

from fixtures.sim.driving import AMR, Drive
from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.examples import examples

from amr_description.errors import SimulationError
from amr_description.model.frames import conjugate, rotate, Transform
from amr_description.model.gazebo.tags import Noise
from amr_description.model.sensors import Lidar, ScanAxis, SensorMount
from amr_description.sim.lidar import scan_angles, SimulatedLidar
from amr_description.sim.state_copy import CopiedScenes, StateCopier
from amr_description.sim.static_geometry import ShapeKind, visible_shapes
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import load_world

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
        return sensor.measure(time, sensor.body(), scene)


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


SHIFT = ScanAxis(41, -0.2, 0.2)


@examples(10)
@given(x=st.floats(-2.0, 2.0), step=st.floats(0.05, 3.0))
def test_parallel_motion_shortens_the_rays_to_a_wall_by_the_same_factor(hall, x, step):
    before, after = (
        hall.scan(lidar(SHIFT), Transform((at, 0.5, 0.0))).ranges[0] for at in (x, x + step)
    )
    assert after / before == pytest.approx(np.full(41, (8.0 - x - step) / (8.0 - x)), rel=1e-5)


@examples(10)
@given(turns=st.integers(1, 359))
def test_turning_the_robot_turns_the_scan(hall, turns):
    axis = ScanAxis(360, 0.0, 2.0 * math.pi * 359.0 / 360.0)
    at = (1.0, 0.5, 0.0)
    turned = Transform.from_xyz_rpy(at, (0.0, 0.0, 2.0 * math.pi * turns / 360.0))
    before, after = (hall.scan(lidar(axis), pose).ranges[0] for pose in (Transform(at), turned))
    assert after == pytest.approx(np.roll(before, -turns), rel=1e-5)


@examples(10)
@given(x=st.floats(1.5, 5.0), yaw=st.floats(-0.7, 0.7), half=st.tuples(*[st.floats(0.1, 0.6)] * 2))
def test_a_box_has_its_size(tmp_path_factory, x, yaw, half):
    box = f"""<geom type="box" size="{half[0]} {half[1]} 1" pos="{x} 0 0" euler="0 0 {yaw}"/>"""
    world = f"""<mujoco><compiler angle="radian"/><worldbody>{box}</worldbody></mujoco>"""
    ranges = Scene(tmp_path_factory.mktemp('box'), world).scan(lidar(ScanAxis(2001, -1.5, 1.5)))
    angle = np.linspace(-1.5, 1.5, 2001)
    met = np.isfinite(ranges.ranges[0])
    points = (ranges.ranges[0] * [np.cos(angle), np.sin(angle)])[:, met] - [[x], [0.0]]
    turn = np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
    along, across = np.abs(turn @ points)
    # Each point is on one of the sides, and the corners that are seen are reached.
    on_side = np.minimum(abs(along - half[0]), abs(across - half[1]))
    assert on_side == pytest.approx(np.zeros(met.sum()), abs=1e-5)
    assert across.max() == pytest.approx(half[1], abs=0.02)
    assert along.max() == pytest.approx(half[0], abs=1e-5)


@examples(10)
@given(elevation=st.floats(0.02, 0.3), height=st.floats(0.2, 2.0))
def test_rings_meet_the_ground_where_their_elevation_says(ground, elevation, height):
    rings = lidar(ScanAxis(5, -3.0, 3.0), vertical=ScanAxis(3, -elevation, elevation))
    down, level, up = ground.scan(rings, Transform((0.0, 0.0, height))).ranges
    expected = height / math.sin(elevation)
    assert down == pytest.approx(np.full(5, expected if expected <= 30.0 else math.inf), rel=1e-5)
    assert np.isinf(level).all()
    assert np.isinf(up).all()


@pytest.fixture(scope='module')
def ground(tmp_path_factory):
    world = '<mujoco><worldbody><geom type="plane" size="0 0 1"/></worldbody></mujoco>'
    return Scene(tmp_path_factory.mktemp('ground'), world)


HILL = """
<mujoco>
  <asset><hfield name="hill" nrow="3" ncol="3" size="2 2 1 1"
    elevation="0 0 0 0 1 0 0 0 0"/></asset>
  <worldbody><geom type="hfield" hfield="hill"/></worldbody>
</mujoco>
"""


def test_rays_meet_a_height_field(tmp_path):
    """A pyramid of 1 m in the middle of 4 by 4 m: its sides rise by 1 in 2."""
    scene = Scene(tmp_path, HILL)
    down = Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, math.pi / 2.0, 0.0))
    for x in (-1.5, -0.5, 0.25, 1.0):
        (distance,) = scene.scan(
            lidar(ScanAxis(1, 0.0, 0.0), down), Transform((x, 0.0, 4.0))
        ).ranges[0]
        assert distance == pytest.approx(3.0 + abs(x) / 2.0, abs=1e-5)


def test_rays_go_into_the_mouth_of_a_mesh(tmp_path):
    """A U of three walls, as one mesh, whose convex hull is closed."""
    write_obj(tmp_path / 'u.obj')
    world = """
    <mujoco><asset><mesh name="u" file="u.obj" inertia="shell"/></asset>
    <worldbody><geom type="mesh" mesh="u"/></worldbody></mujoco>
    """
    scene = Scene(tmp_path, world)
    # The mesh is centred by MuJoCo, and put back by the pose of its geom.
    ahead = lidar(ScanAxis(1, 0.0, 0.0))
    mouth, arm = (scene.scan(ahead, Transform((-3.0, y, 0.5))).ranges[0, 0] for y in (0.0, 0.9))
    assert (mouth, arm) == (pytest.approx(3.8, abs=1e-4), pytest.approx(2.0, abs=1e-4))


def write_obj(path):
    """Write boxes of a U that is open towards -x: arms at y = ±0.9, the back at x = 0.9."""
    boxes = [((0.0, 0.9), (1.0, 0.1)), ((0.0, -0.9), (1.0, 0.1)), ((0.9, 0.0), (0.1, 0.8))]
    lines, faces = [], []
    quads = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    for number, ((x, y), (a, b)) in enumerate(boxes):
        lines += [
            f'v {x + i * a} {y + j * b} {k}' for k in (0.0, 1.0) for j in (-1, 1) for i in (-1, 1)
        ]
        faces += ['f ' + ' '.join(str(8 * number + corner) for corner in quad) for quad in quads]
    path.write_text('\n'.join(lines + faces))


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


HOUSED = """
<visual><geometry><box size="0.3 0.3 0.3"/></geometry></visual>
<visual><origin xyz="1 0 0"/><geometry><box size="0.2 0.2 0.2"/></geometry></visual>
<collision><origin xyz="0 1 0"/><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
"""
"""A housing around the lidar, a part in front of it, and a collision on its left."""
CROSS = ScanAxis(4, 0.0, 1.5 * math.pi)


@pytest.mark.parametrize(('range_min', 'ahead'), [(0.0, 0.9), (0.16, 0.9), (1.0, 8.0)])
def test_a_lidar_looks_through_its_housing_and_sees_other_parts(tmp_path, range_min, ahead):
    scene = Scene(tmp_path, HALL, HOUSED)
    ranges = scene.scan(lidar(CROSS, range_min=range_min)).ranges[0]
    assert ranges == pytest.approx([ahead, 3.0, 6.0, 2.0])


def test_the_parts_of_the_robot_are_not_seen_if_the_tag_says_so(tmp_path):
    scene = Scene(tmp_path, HALL, HOUSED)
    assert scene.scan(lidar(CROSS, sees_robot=False)).ranges[0] == pytest.approx([8, 3, 6, 2])


ARM = """
<robot name="post">
  <link name="world"/>
  <joint name="stand" type="fixed"><parent link="world"/><child link="post"/></joint>
  <link name="post">{inertial}
    <visual><geometry><sphere radius="0.01"/></geometry></visual>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="post"/><child link="hand"/><axis xyz="1 0 0"/><limit lower="0" upper="5"
      effort="1" velocity="1"/>
  </joint>
  <link name="hand">{inertial}
    <visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual>
  </link>
</robot>
"""
INERTIAL = """
<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
"""


def test_parts_that_move_are_seen_where_they_are(tmp_path):
    scene = Scene(tmp_path, HALL)
    robot = scene.world.spawn('post', ARM.format(inertial=INERTIAL), Transform())
    seen = []
    for position in (2.0, 0.15):
        scene.world.engine.data.joint('post/slide').qpos = position
        scene.world.engine.invalidate_kinematics()
        seen.append(scene.measure(robot, lidar(ScanAxis(1, 0.0, 0.0))).ranges[0, 0])
    assert seen == [pytest.approx(1.9), -math.inf]


SEEN_BY_ITS_VISUAL = """
<visual><geometry><box size="0.4 0.4 2"/></geometry></visual>
<collision><geometry><box size="1 1 2"/></geometry></collision>
"""
COLLISION_ALONE = '<collision><geometry><box size="1 1 2"/></geometry></collision>'
TRANSPARENT = """
<visual><geometry><box size="0.4 0.4 2"/></geometry>
  <material name="glass"><color rgba="1 1 1 0"/></material></visual>
"""


@pytest.mark.parametrize(
    ('parts', 'distance'), [(SEEN_BY_ITS_VISUAL, 2.8), (COLLISION_ALONE, 2.5), (TRANSPARENT, 8.0)]
)
def test_robots_are_seen_by_their_visuals_if_they_have_any(tmp_path, parts, distance):
    scene = Scene(tmp_path, HALL)
    scene.world.spawn('other', POST.format(parts=parts), Transform((3.0, 0.0, 0.0)))
    assert scene.scan(lidar(ScanAxis(1, 0.0, 0.0))).ranges[0, 0] == pytest.approx(distance)


def test_intensity_is_the_luminance_of_what_is_met(tmp_path):
    colors = {'1 0 0 1': 0.2126, '0 1 0 1': 0.7152, '0 0 1 1': 0.0722, '1 1 1 0.5': 1.0}
    boxes = ''.join(
        f'<geom type="box" size="0.5 0.5 0.5" pos="{3 + i} {3 * i - 3} 0" rgba="{color}"/>'
        for i, color in enumerate(colors)
    )
    scene = Scene(tmp_path, f'<mujoco><worldbody>{boxes}</worldbody></mujoco>')
    bearings = [math.atan2(3 * i - 3, 3 + i) for i in range(4)]
    for bearing, luminance in zip(bearings, colors.values(), strict=True):
        scan = scene.scan(lidar(ScanAxis(1, bearing, bearing)))
        assert scan.intensities[0, 0] == pytest.approx(255.0 * luminance)
    assert scene.scan(lidar(ScanAxis(1, 2.0, 2.0))).intensities[0, 0] == 0.0


def test_scanning_does_not_change_the_future():
    states = []
    for scans in (False, True):
        world = MujocoWorld('warehouse')
        robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
        sensor = SimulatedLidar(replace(lidar(), mount=SensorMount('lidar', 'base_link')), robot)
        for _ in range(20):
            world.step(5)
            if scans:
                sensor.measure(world.time, sensor.body(), world.ray_scene())
        states.append(world.state())
    assert states[0] == states[1]


def test_two_worlds_give_the_same_bytes_whoever_looked_before():
    runs = []
    for begin in (0, 12):
        drive = Drive(world=MujocoWorld('warehouse'))
        mount = SensorMount('lidar', 'base_link', Transform((0.0, 0.0, 0.3)))
        description = replace(lidar(noise=Noise(stddev=0.01, bias_stddev=0.02)), mount=mount)
        sensor, scans = SimulatedLidar(description, drive.robot), []
        for tick in range(20):
            drive.command(0.5, 0.3)
            drive.tick()
            if tick >= begin:
                scan = sensor.measure(drive.world.time, sensor.body(), drive.world.ray_scene())
                scans.append(scan.ranges.tobytes())
        runs.append(scans)
    assert runs[0][12:] == runs[1]
    assert len({*runs[0]}) == 20


def test_a_copy_measures_the_same(tmp_path):
    scene = Scene(tmp_path, HALL)
    robot = scene.world.spawn('post', ARM.format(inertial=INERTIAL), Transform((1.0, 0.5, 0.0)))
    sensor = SimulatedLidar(lidar(noise=Noise(stddev=0.01)), robot)
    states, scenes = StateCopier(scene.world), CopiedScenes()
    for step in range(3):
        scene.world.step(20)
        ranges = [
            sensor.measure(step, sensor.body(), each).ranges.tobytes()
            for each in (scene.world.ray_scene(), scenes.scene(states.copy()))
        ]
        assert ranges[0] == ranges[1]


@pytest.fixture(scope='module')
def warehouse():
    return MujocoWorld('warehouse')


@pytest.fixture(scope='module')
def solid():
    shapes = visible_shapes(load_world('warehouse'))
    return [each for each in shapes if each.kind is not ShapeKind.PLANE]


def level_distance(shape, origin, angles):
    """Return where level rays from a point meet a shape, by plane geometry; inf: nowhere."""
    rays = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    if shape.kind is ShapeKind.BOX:
        return _to_box(shape, origin, rays)
    # The others stand upright: a level section is a circle.
    assert abs(rotate(shape.rotation, (0.0, 0.0, 1.0))[2]) == pytest.approx(1.0)
    height = abs(origin[2] - shape.position[2])
    radius, half = shape.size[0] / 2.0, shape.size[2] / 2.0
    if shape.kind is ShapeKind.CYLINDER:
        section = radius if height < half else 0.0
    else:
        beyond = max(0.0, height - (half - radius))
        section = math.sqrt(max(0.0, radius**2 - beyond**2))
    to_centre = np.array(shape.position[:2]) - origin[:2]
    along = rays @ to_centre
    chord = section**2 - (to_centre @ to_centre - along**2)
    with np.errstate(invalid='ignore'):
        distance = along - np.sqrt(chord)
    return np.where((chord > 0.0) & (distance > 0.0), distance, math.inf)


def _to_box(shape, origin, rays):
    """Return where rays enter the three slabs of a box at once."""
    back = conjugate(shape.rotation)
    start = np.array(rotate(back, tuple(origin - np.array(shape.position))))
    axes = np.array([rotate(back, axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))])
    ways, half = rays @ axes, np.array(shape.size) / 2.0
    with np.errstate(divide='ignore', invalid='ignore'):
        sides = np.stack(((-half - start) / ways, (half - start) / ways))
    enter, leave = sides.min(axis=0).max(axis=1), sides.max(axis=0).min(axis=1)
    return np.where((enter < leave) & (enter > 0.0), enter, math.inf)


@examples(8)
@given(
    x=st.floats(-3.5, 3.5),
    y=st.floats(-0.9, 0.9),
    height=st.sampled_from([0.15, 0.33, 0.69, 1.62]),
)
def test_a_scan_of_the_warehouse_is_what_plane_geometry_says(warehouse, solid, x, y, height):
    origin, angles = np.array([x, y, height]), np.linspace(-math.pi, math.pi, 360)
    expected = np.min([level_distance(each, origin, angles) for each in solid], axis=0)
    robot = warehouse.spawn('post', POST.format(parts=''), Transform((x, y, height)))
    try:
        scene, sensor = warehouse.ray_scene(), SimulatedLidar(lidar(range_min=0.0), robot)
        ranges = sensor.measure(0, sensor.body(), scene).ranges[0]
    finally:
        warehouse.remove('post')
    assert ranges == pytest.approx(expected, rel=1e-5)
