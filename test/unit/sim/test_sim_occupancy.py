# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Maps of worlds, against the rays of simulated lidars in the same worlds."""

import dataclasses
import math

from hypothesis import given, strategies as st
import mujoco
import numpy as np
import pytest
from support.examples import examples
from support.paths import ROOT

from amr_description.errors import MapError, SimulationError
from amr_description.maps.pose import Pose
from amr_description.maps.rasterization import fill_convex
from amr_description.model.description_file import description_at
from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.model.gazebo.sensors import robot_sensors_of
from amr_description.model.kinematics import link_poses
from amr_description.model.sensors import Lidar
from amr_description.model.urdf import parse
from amr_description.sim.lidar import ray_directions, SimulatedLidar
from amr_description.sim.occupancy import (
    LIDAR_HEIGHT,
    map_of_model,
    map_of_world,
    MapSettings,
)
from amr_description.sim.rays import RayScene
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import load_world

POSES = [(0.0, 0.0), (-5.0, 0.3), (-2.5, 1.2), (2.6, -1.1), (3.5, 3.4), (-3.3, -3.5), (5.5, -2.0)]
RAYS = 360


def model_of(text):
    """A compiled world: the geoms of a text around a floor."""
    floor = '<geom type="plane" size="0 0 1"/>'
    return mujoco.MjModel.from_xml_string(f'<mujoco><worldbody>{floor}{text}</worldbody></mujoco>')


def scene_of(model):
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    return RayScene(model, data)


def level_scan(scene, x, y, height, reach=40.0):
    """Return the directions of rays, (n, 2), and how far they get, inf: for ever."""
    angles = np.arange(RAYS) * (math.tau / RAYS) + 1e-3
    rays = np.column_stack((np.cos(angles), np.sin(angles), np.zeros(RAYS)))
    hits = scene.cast(np.array([x, y, height]), rays, cutoff=reach)
    return rays[:, :2], np.where(hits.geoms < 0, np.inf, hits.distances)


def with_neighbours(mask):
    """Return the cells that are set, and those beside them."""
    padded = np.pad(mask, 1)
    return np.any(
        [padded[1 + i : padded.shape[0] - 1 + i, 1 + j : padded.shape[1] - 1 + j]
         for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0,
    )  # fmt: skip


def faults_of_scan(grid, scene, x, y, height=LIDAR_HEIGHT):
    """
    Return how many rays meet something where the map has nothing, and how many get too far.

    A hit lies in an occupied cell, or beside one. And an occupied cell that a ray passes before
    its hit has something in it, that is, no farther from the ray than the diagonal of a cell.
    """
    rays, distances = level_scan(scene, x, y, height)
    step = grid.resolution / 2.0
    is_hit = np.isfinite(distances)
    along = distances[is_hit, None] * rays[is_hit]
    missed = ~states(grid, with_neighbours(grid.cells == 100), along + (x, y))
    ends = np.minimum(distances, 12.0) - 1.5 * grid.resolution
    ways = [
        (x, y) + np.arange(0.0, end, step)[:, None] * ray
        for ray, end in zip(rays, ends, strict=True)
    ]
    crossed = 0
    for way in ways:
        inside = way[states(grid, grid.cells == 100, way)]
        crossed += any(not is_beside(scene, point, height, grid.resolution) for point in inside)
    return int(missed.sum()), crossed


def states(grid, mask, points):
    """Return what a mask of cells says at points (n, 2); False outside of it."""
    columns, rows = ((points - (grid.origin.x, grid.origin.y)) // grid.resolution).astype(int).T
    inside = (rows >= 0) & (rows < grid.height) & (columns >= 0) & (columns < grid.width)
    found = np.zeros(len(points), bool)
    found[inside] = mask[rows[inside], columns[inside]]
    return found


def is_beside(scene, point, height, resolution):
    """Return whether something is as near to a point as two points of a cell can be."""
    _, distances = level_scan(scene, *point, height)
    return distances.min() <= math.sqrt(2.0) * resolution


def test_the_height_is_that_of_the_lidar_of_the_robot():
    robot = parse(description_at(str(ROOT / 'urdf/amr_sensors.urdf.xacro'), warn=print), 'amr')
    poses = link_poses(robot)
    height = poses['lidar_link'].translation[2] - poses['base_footprint'].translation[2]
    assert pytest.approx(height) == LIDAR_HEIGHT


@pytest.mark.parametrize('resolution', [0.05, 0.1, 0.023])
def test_what_the_lidar_sees_in_the_warehouse_is_in_its_map(resolution):
    grid = map_of_world('warehouse', MapSettings(resolution=resolution))
    scene = scene_of(load_world('warehouse').compile())
    for x, y in POSES:
        assert grid.cells[grid.cell_of(x, y)] == 0
        assert np.isfinite(level_scan(scene, x, y, LIDAR_HEIGHT)[1]).all()
        assert faults_of_scan(grid, scene, x, y) == (0, 0)


def test_what_is_just_behind_a_hit_is_occupied():
    """Without any tolerance: a hair behind the surface is the inside of what was hit."""
    grid = map_of_world('warehouse')
    scene = scene_of(load_world('warehouse').compile())
    seen = np.zeros(grid.cells.shape, bool)
    for x, y in POSES:
        rays, distances = level_scan(scene, x, y, LIDAR_HEIGHT)
        for (dx, dy), distance in zip(rays, distances + 1e-4, strict=True):
            seen[grid.cell_of(x + dx * distance, y + dy * distance)] = True
    assert not (seen & (grid.cells != 100)).any()
    assert seen.sum() > 800


def test_scans_of_the_robot_itself_fit_its_map():
    """That of amr_sensors, which stands on its wheels, turned, its lidar with its noise."""
    text = description_at(str(ROOT / 'urdf/amr_sensors.urdf.xacro'), warn=pytest.fail)
    sensors = robot_sensors_of(parse(text)).sensors
    (lidar,) = (each for each in sensors if isinstance(each, Lidar))
    world = MujocoWorld('warehouse')
    grid = map_of_world('warehouse')
    near = with_neighbours(grid.cells == 100)
    for number, (x, y) in enumerate(POSES):
        pose = Transform((x, y, 0.0), quaternion_from_yaw(0.7 * number))
        robot = world.spawn('amr', text, pose)
        sensor = SimulatedLidar(lidar, robot)
        for _ in range(250):
            world.step(1)
        scene = world.ray_scene()
        scan = sensor.measure(world.time, sensor.body(), scene).ranges[0]
        position, turn = scene.pose(sensor.body())
        assert position[2] == pytest.approx(LIDAR_HEIGHT, abs=0.002)
        rays = ray_directions(lidar) @ turn.T
        is_hit = np.isfinite(scan)
        assert is_hit.all()
        ends = position[:2] + scan[:, None] * rays[:, :2]
        assert states(grid, near, ends).mean() == 1.0
        world.remove('amr')


def test_a_map_that_does_not_fit_is_found():
    """The checks of these tests can fail."""
    grid = map_of_world('warehouse')
    scene = scene_of(load_world('warehouse').compile())
    moved = dataclasses.replace(grid, origin=Pose(grid.origin.x - 0.2, grid.origin.y + 0.2, 0.0))
    missed, crossed = faults_of_scan(moved, scene, 0.0, 0.0)
    assert missed > RAYS // 2
    assert crossed > RAYS // 8


_SHAPES = ('box', 'sphere', 'capsule', 'cylinder', 'ellipsoid')


@examples(10)
@given(seed=st.integers(0, 2**32 - 1))
def test_what_rays_see_of_shapes_that_are_turned_anyhow_is_in_the_map(seed):
    random = np.random.default_rng(seed)
    geoms = ''
    for _ in range(6):
        words = [' '.join(map(str, each)) for each in (
            random.uniform(0.03, 0.6, 3),
            random.uniform(0.8, 3.0, 2) * random.choice([-1, 1], 2),
            random.normal(size=4),
        )]  # fmt: skip
        height = random.uniform(-0.3, 0.8)
        kind = random.choice(_SHAPES)
        geoms += (
            f'<geom type="{kind}" size="{words[0]}" pos="{words[1]} {height}" quat="{words[2]}"/>'
        )
    model = model_of(geoms)
    try:
        grid = map_of_model(model, MapSettings(resolution=0.02))
    except MapError:
        return  # something is at the start
    assert faults_of_scan(grid, scene_of(model), 0.0, 0.0) == (0, 0)


@examples(10)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_band_holds_what_is_at_each_of_its_heights(seed):
    random = np.random.default_rng(seed)
    size, turn = random.uniform(0.05, 0.5, 3), random.normal(size=4)
    numbers = [' '.join(map(str, each)) for each in (size, turn)]
    kind = random.choice(_SHAPES)
    model = model_of(
        f'<geom type="{kind}" size="{numbers[0]}" quat="{numbers[1]}" pos="2 0 0.4"/>'
    )
    extent = (-1.0, -1.5, 4.0, 1.5)
    low, high = np.sort(random.uniform(0.01, 1.0, 2))
    band = map_of_model(model, MapSettings(height=low, top=high, extent=extent, start=(-0.5, 0)))
    together = np.zeros(band.cells.shape, bool)
    for height in np.linspace(low, high, 40):
        one = map_of_model(model, MapSettings(height=height, extent=extent, start=(-0.5, 0)))
        together |= one.cells == 100
    occupied = band.cells == 100
    assert not (together & ~occupied).any()
    assert not (occupied & ~with_neighbours(together)).any()


HILL = """
<mujoco><asset>
  <hfield name="hill" nrow="41" ncol="31" size="1.5 2 1 0.1"/>
  <mesh name="wedge" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
  <mesh name="ring" builtin="supertorus" params="24 0.3 1 1" scale="0.6 0.6 0.6"/>
</asset><worldbody>
  <geom type="plane" size="0 0 1"/>
  <geom type="hfield" hfield="hill" pos="3 0 0"/>
  <geom type="mesh" mesh="wedge" pos="-2 1 0" euler="0 0 30"/>
  <geom type="mesh" mesh="ring" pos="0 -2 0.263"/>
</worldbody></mujoco>
"""


def hilly():
    model = mujoco.MjModel.from_xml_string(HILL)
    rows, columns = 41, 31
    y, x = np.meshgrid(np.linspace(-1, 1, rows), np.linspace(-1, 1, columns), indexing='ij')
    model.hfield_data[:] = np.exp(-4.0 * (x * x + y * y)).ravel()
    return model


def test_meshes_and_height_fields_are_cut_along_their_triangles():
    model = hilly()
    for start in ((0.0, 0.0), (-1.2, -1.0)):
        grid = map_of_model(model, MapSettings(resolution=0.02, start=start))
        _, distances = level_scan(scene_of(model), *start, LIDAR_HEIGHT)
        assert np.isfinite(distances).sum() > RAYS // 6
        assert faults_of_scan(grid, scene_of(model), *start) == (0, 0)
    # The hill is solid, up to where exp(-4 r²) is 0.25.
    radius = math.sqrt(math.log(4.0) / 4.0)
    for share in (0.0, 0.5, 0.9):
        assert grid.cells[grid.cell_of(3.0 + 1.5 * radius * share, 0.0)] == 100
        assert grid.cells[grid.cell_of(3.0, 2.0 * radius * share)] == 100
    assert grid.cells[grid.cell_of(3.0 + 1.5 * radius * 1.1, 0.0)] == 0


def test_a_ring_is_solid_and_its_hole_cannot_be_reached():
    grid = map_of_model(hilly(), MapSettings(resolution=0.02))
    assert grid.cells[grid.cell_of(0.0, -2.0)] == -1
    assert grid.cells[grid.cell_of(0.6, -2.0)] == 100


def test_floors_kerbs_and_low_ramps_are_no_walls_but_what_is_as_high_as_the_lidar():
    for world in ('kerbs', 'empty'):
        assert {*np.unique(map_of_world(world).cells)} == {0}
    grid = map_of_world('warehouse')
    assert grid.cells[grid.cell_of(4.5, 0.0)] == 0  # on the ramp
    assert grid.cells[grid.cell_of(5.5, 0.0)] == 0  # on the dock
    assert grid.cells[grid.cell_of(-2.5, 2.0)] == 0  # below a shelf
    steep = model_of(
        '<body pos="1 0 0" euler="0 -30 0"><geom type="box" pos="1 0 -0.1" size="1 1 0.1"/></body>'
    )
    grid = map_of_model(steep, MapSettings())
    where = 1.0 + LIDAR_HEIGHT / math.tan(math.radians(30))
    assert grid.cells[grid.cell_of(where - 0.06, 0.0)] == 0
    assert grid.cells[grid.cell_of(where + 0.01, 0.0)] == 100


def test_a_top_at_the_height_is_no_obstacle_and_a_bottom_is():
    slab = '<geom name="slab" type="box" size="0.5 0.5 0.1" pos="2 0 {}"/>'
    low = map_of_model(model_of(slab.format(0.15)), MapSettings())
    assert {*np.unique(low.cells)} == {0}
    high = map_of_model(model_of(slab.format(0.35)), MapSettings())
    assert (high.cells == 100).sum() == 20 * 20
    on_floor = map_of_model(model_of(''), MapSettings(height=0.0))
    assert {*np.unique(on_floor.cells)} == {0}


def test_what_moves_and_what_cannot_be_seen_is_not_in_the_map():
    model = model_of(
        '<body pos="2 0 0.2"><freejoint/><geom size="0.2"/></body>'
        '<body pos="0 2 0.2" mocap="true"><geom size="0.2"/></body>'
        '<body pos="0 -2 0.2"><joint/><geom size="0.2"/></body>'
        '<geom size="0.2" pos="-2 0 0.2" rgba="1 1 1 0"/>'
        '<geom size="0.2" pos="-2 -2 0.2" group="3"/>'
        '<geom size="0.2" pos="2 2 0.2" contype="0" conaffinity="0"/>'
    )
    grid = map_of_model(model, MapSettings())
    assert {int(each) for each in np.argwhere(grid.cells == 100)[:, 0] // 100} == {2}
    occupied = np.argwhere(grid.cells == 100).mean(axis=0) + 0.5
    x, y = occupied[::-1] * 0.05 + grid.origin[:2]
    assert (x, y) == pytest.approx((2.0, 2.0), abs=0.01)


def test_the_map_of_a_closed_world_ends_behind_its_walls_and_of_an_open_one_far_away():
    grid = map_of_world('warehouse', MapSettings(padding=0.2))
    assert (grid.origin.x, grid.origin.y) == (-6.3, -4.3)
    assert (grid.width, grid.height) == (252, 172)
    assert {*grid.cells[0], *grid.cells[-1], *grid.cells[:, 0], *grid.cells[:, -1]} == {-1}
    open_grid = map_of_world('ramp', MapSettings(start=(1.0, 2.0)))
    low, high = (
        open_grid.center_of(0, 0),
        open_grid.center_of(-1 + open_grid.height, -1 + open_grid.width),
    )
    assert low[0] < -8.9
    assert low[1] < -7.9
    assert high[0] > 10.9
    assert high[1] > 11.9


def test_the_extent_can_be_chosen():
    grid = map_of_world('warehouse', MapSettings(extent=(-1.0, -2.0, 3.0, 1.0), resolution=0.1))
    assert (grid.origin.x, grid.origin.y, grid.width, grid.height) == (-1.0, -2.0, 40, 30)


@pytest.mark.parametrize(
    ('settings', 'words'),
    [
        (MapSettings(start=(0.0, 2.0)), r"at the start, \(0, 2\), there is 'pillar' 0.25 m above"),
        (
            MapSettings(start=(20.0, 20.0), extent=(-1, -1, 1, 1)),
            r'the start, \(20, 20\), is outside',
        ),
        (MapSettings(resolution=0.0), 'the resolution is 0 m; it must be above 0'),
        (MapSettings(resolution=1e-4), 'cells of 0.0001 m, more than'),
        (MapSettings(height=math.nan), 'the height is nan m'),
        (MapSettings(top=0.1), 'the band is 0.25 to 0.1 m'),
        (MapSettings(padding=-1.0), 'the padding is -1 m'),
        (MapSettings(extent=(1, 1, 0, 2)), 'the extent is x 1 to 0 m'),
    ],
)
def test_what_no_map_can_be_made_of_is_said_in_a_line(settings, words):
    with pytest.raises(MapError, match=f"world 'warehouse': .*{words}"):
        map_of_world('warehouse', settings)


def test_a_world_that_is_not_there_is_said():
    with pytest.raises(SimulationError, match="world 'moon': neither a file nor a shipped world"):
        map_of_world('moon')


def test_fill_convex_and_the_section_of_a_wall_agree_on_borders():
    """A wall from 1 to 1.1 m, whose corners are rounded, takes two cells of 5 cm."""
    model = model_of('<geom type="box" size="0.05 5 1" pos="1.05 0 1"/>')
    grid = map_of_model(model, MapSettings(extent=(0, -1, 2, 1), start=(0.5, 0)))
    assert np.flatnonzero((grid.cells == 100).any(axis=0)).tolist() == [20, 21]
    cells = np.zeros((1, 40), bool)
    fill_convex(cells, np.array([[1.0, 0.0], [1.1, 0.0], [1.1, 1.0], [1.0, 1.0]]) * [20, 1])
    assert np.flatnonzero(cells[0]).tolist() == [20, 21]
