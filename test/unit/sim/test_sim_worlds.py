# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped worlds, driven through."""

from fixtures.sim.driving import AMR, Drive
import mujoco
import numpy as np
import pytest

from amr_description.ament_index import shipped_worlds
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import static_surfaces

WORLDS = ('empty', 'kerbs', 'ramp', 'walls', 'warehouse')


def test_the_shipped_worlds_are_these():
    assert tuple(shipped_worlds()) == WORLDS


@pytest.mark.parametrize('name', WORLDS)
def test_a_robot_may_be_put_at_the_origin_and_rests_there(name):
    world = MujocoWorld(name)
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
    world.step(500)
    assert robot.pose('base_footprint').translation == pytest.approx((0, 0, 0), abs=1e-4)
    linear, angular = robot.velocity('base_footprint')
    assert (*linear, *angular) == pytest.approx([0.0] * 6, abs=1e-3)


@pytest.mark.parametrize('name', WORLDS)
def test_every_wheel_has_its_contact_with_every_static_surface(name):
    world = MujocoWorld(name)
    surfaces = {surface.name for surface in static_surfaces(world.engine.spec)}
    assert len(surfaces) == world.engine.model.ngeom  # all of them can be touched
    world.spawn('amr', AMR)
    pairs = {(pair.geomname1, pair.geomname2) for pair in world.engine.spec.pairs}
    treads = {f'amr/wheel_{a}_{b}/wheel' for a in ('front', 'back') for b in ('left', 'right')}
    assert pairs == {(tread, surface) for tread in treads for surface in surfaces}


def test_over_the_ramp():
    drive = Drive(world=MujocoWorld('ramp'))
    heights = []
    for _ in range(12):
        drive.run(0.5, 0.0, 1.0)
        heights.append(drive.position[2])
    assert max(heights) == pytest.approx(0.3, abs=1e-3)
    x, y, z = drive.position
    # 1.7276 - 1.7014 m up and 0.8771 - 0.8242 m down are lost by the slopes, ±wheels on the edges.
    assert drive.odometry.x - x == pytest.approx(0.079, abs=0.02)
    assert (y, z) == pytest.approx((0.0, 0.0), abs=1e-3)


def test_a_robot_may_stand_on_the_ramp():
    # On the middle of the steeper slope, 20 degrees down.
    drive = Drive(world=MujocoWorld('ramp'))
    drive.run(0.5, 0.0, 8.6)
    drive.run(0.0, 0.0, 1.0)
    before = drive.position
    assert 0.1 < before[2] < 0.2
    drive.run(0.0, 0.0, 10.0)
    # Measured: 0.3 mm in 10 s.
    assert drive.position == pytest.approx(before, abs=1e-3)


@pytest.mark.parametrize('speed', [0.1, 0.3])
def test_low_kerbs_are_climbed_and_the_high_one_stops(speed):
    drive = Drive(world=MujocoWorld('kerbs'))
    heights = []
    for _ in range(24):
        drive.run(speed, 0.0, 0.25 / speed)
        heights.append((drive.position[0], drive.position[2]))
    for begin, height in ((1.0, 0.01), (3.0, 0.02)):
        on_top = [z for x, z in heights if begin + 0.3 < x < begin + 0.7]
        assert on_top
        assert on_top == pytest.approx([height] * len(on_top), abs=2e-4)
    # The front wheels are up, the rear wheels do not get over the edge.
    before = drive.position
    assert 5.1 < before[0] < 5.15
    drive.run(speed, 0.0, 2.0)
    assert drive.position == pytest.approx(before, abs=1e-3)


@pytest.mark.parametrize('name, speed, face', [('walls', -0.5, -3.0), ('warehouse', -1.0, -6.0)])
def test_walls_stop_and_are_not_climbed(name, speed, face):
    drive = Drive(world=MujocoWorld(name))
    for _ in range(20):
        drive.run(speed, 0.0, 0.5)
        assert abs(drive.position[2]) < 0.03
    # The wheels reach 0.3 m behind the middle.
    assert drive.position[0] == pytest.approx(face + 0.3, abs=0.01)


def test_onto_the_dock_of_the_warehouse():
    drive = Drive(world=MujocoWorld('warehouse'))
    drive.run(0.5, 0.0, 10.7)
    drive.run(0.0, 0.0, 1.0)
    assert drive.position == pytest.approx((5.33, 0.0, 0.08), abs=0.02)
    drive.run(0.0, 0.5, 6.0)
    # It turns up there as on the ground: every surface has the wheels' contact.
    assert drive.yaw == pytest.approx(drive.odometry.heading, rel=0.05)


def test_a_level_scan_of_the_warehouse_sees_its_things_beside_a_free_aisle():
    world = MujocoWorld('warehouse')
    world.step(1)
    model, data, count = world.engine.model, world.engine.data, 360
    angles = np.linspace(-np.pi, np.pi, count, endpoint=False)
    rays = np.stack((np.cos(angles), np.sin(angles), np.zeros(count)), axis=1)
    geoms, ranges = np.full(count, -1, np.int32), np.zeros(count)
    mujoco.mj_multiRay(
        model, data, [0, 0, 0.25], rays.ravel(), None, 1, -1, geoms, ranges, None, count, 100.0
    )
    seen = {model.geom(int(geom)).name for geom in geoms}
    assert {'east', 'west', 'pillar', 'crate_5', 'crate_7', 'bin', 'left_leg'} <= seen
    assert ranges.min() > 1.6
    # Through the doorway, and no farther elsewhere in the west.
    assert ranges[0] == pytest.approx(6.0)
    assert ranges[20] == pytest.approx(4.05 / np.cos(angles[20] + np.pi))
