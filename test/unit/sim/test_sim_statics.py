# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Slopes, kerbs, torque and energy, against the formulas of mechanics.

The limits are those that a user is promised; the comment at each says what was measured.
"""

import math

from fixtures.sim.driving import AMR, Drive, LEFT, RIGHT, WHEEL_RADIUS
import mujoco
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

GRAVITY = 9.81
WHEELS = [*LEFT, *RIGHT]
MASS, WHEEL_INERTIA, HALF_BASE = 7.0, 0.0025, 0.2
"""kg; kg·m² about the axle; m from the middle to the axles."""


def world_of(tmp_path, geoms, friction):
    path = tmp_path / 'world.xml'
    path.write_text(f'<mujoco><worldbody>{geoms}</worldbody></mujoco>')
    return MujocoWorld(str(path), settings=WorldSettings(friction=friction))


# --- slopes ------------------------------------------------------------------------------------


def on_slope(tmp_path, angle, friction, heading=0.0):
    """A robot on a slope that rises along x by ``angle`` (rad), turned by ``heading``."""
    plane = f'<geom type="plane" size="0 0 1" euler="0 {-math.degrees(angle)} 0"/>'
    world = world_of(tmp_path, plane, friction)
    slope = Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, -angle, 0.0))
    turn = Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, heading))
    return world, world.spawn('amr', AMR, slope @ turn)


@pytest.mark.parametrize('heading', [0.0, math.pi / 2, 0.6])
@pytest.mark.parametrize('friction', [0.3, 0.6, 0.9])
def test_a_slope_holds_up_to_the_friction_limit(tmp_path, friction, heading):
    world, robot = on_slope(tmp_path, math.atan(0.95 * friction), friction, heading)
    world.step(500)
    before = robot.pose('base_footprint')
    world.step(2500)
    # Measured: 0.6 mm at most, by a creep that no setting removes.
    moved = before.inverse() @ robot.pose('base_footprint')
    assert math.hypot(*moved.translation) < 1e-3


@pytest.mark.parametrize('heading', [0.0, math.pi / 2])
@pytest.mark.parametrize('friction', [0.3, 0.6])
def test_beyond_the_limit_it_slides_as_coulomb_has_it(tmp_path, friction, heading):
    angle = math.atan(1.2 * friction)
    world, robot = on_slope(tmp_path, angle, friction, heading)
    world.step(500)
    before = math.hypot(*robot.velocity('base_footprint')[0])
    world.step(500)
    gained = math.hypot(*robot.velocity('base_footprint')[0]) - before
    expected = GRAVITY * (math.sin(angle) - friction * math.cos(angle))
    # Measured: 1.000 and 0.999 of it; at a friction of 0.9 it is 1.02.
    assert gained == pytest.approx(expected, rel=0.01)


# --- kerbs -------------------------------------------------------------------------------------


def sine_at_edge(height):
    """Of the angle between the vertical and the radius of a wheel at the edge of a kerb (m)."""
    return math.sqrt(1.0 - (1.0 - height / WHEEL_RADIUS) ** 2)


def surplus(mu, sine):
    """
    What pushes the robot on while its rear axle, the harder one, climbs; share of the weight.

    The front wheels on top push with all their friction. N: share of the weight across the edge,
    that the moments about the front contacts ask for when the rear wheels leave the ground.
    """
    cosine = math.sqrt(1.0 - sine**2)
    lifted = HALF_BASE / (2.0 * HALF_BASE - WHEEL_RADIUS * sine)
    normal = lifted / (cosine + mu * sine)
    return mu * (1.0 - lifted) + normal * (mu * cosine - sine)


def least_friction(height):
    """With which four driven wheels get over a kerb (m) without momentum: by statics."""
    sine = sine_at_edge(height)
    return next(mu / 1000.0 for mu in range(1, 2000) if surplus(mu / 1000.0, sine) > 0.0)


def least_speed(height, friction):
    """
    At which the momentum makes good what the friction lacks (m/s): by the energy, v²/2 against the
    work that is missing on the way of the hub over the edge. What the impact takes comes on top.
    """
    way = WHEEL_RADIUS * sine_at_edge(height)
    steps, work, least = 1000, 0.0, 0.0
    for step in range(steps):
        sine = (way - way * step / steps) / WHEEL_RADIUS
        work += surplus(friction, sine) * way / steps
        least = min(least, work)
    return math.sqrt(-2.0 * GRAVITY * least)


def climbs(tmp_path, height, friction, speed):
    kerb = f'<geom type="box" pos="0.9 0 {height / 2}" size="0.5 2 {height / 2}"/>'
    world = world_of(tmp_path, f'<geom type="plane" size="0 0 1"/>{kerb}', friction)
    drive = Drive(world=world)
    drive.command(speed, 0.0)
    for _ in range(round(0.9 / speed * 10)):
        world.step(50)
        if drive.position[2] > 0.9 * height:
            return True
    return False


@pytest.mark.parametrize('height', [0.01, 0.02, 0.05])
def test_a_kerb_takes_the_friction_that_statics_asks_for(tmp_path, height):
    mu = least_friction(height)
    # Slow, so that momentum helps little. Measured: from 0.88, 0.92 and 0.96 of it on.
    assert not climbs(tmp_path, height, 0.85 * mu, speed=0.02)
    assert climbs(tmp_path, height, 1.02 * mu, speed=0.02)


@pytest.mark.parametrize('speed', [0.05, 0.1, 0.3])
def test_on_dusty_tiles_20_mm_are_climbed_and_50_mm_are_not(tmp_path, speed):
    assert least_friction(0.02) < 0.42 < least_friction(0.05)
    assert climbs(tmp_path, 0.01, 0.42, speed)
    assert climbs(tmp_path, 0.02, 0.42, speed)
    assert not climbs(tmp_path, 0.05, 0.42, speed)


@pytest.mark.parametrize(
    'height, friction', [(0.03, 0.3), (0.04, 0.42), (0.05, 0.42), (0.05, 0.5), (0.05, 0.6)]
)
def test_momentum_makes_up_for_missing_friction(tmp_path, height, friction):
    speed = least_speed(height, friction)
    assert 0.1 < speed < 0.3
    # Measured: from 1.06 to 1.36 of it on.
    assert not climbs(tmp_path, height, friction, 0.95 * speed)
    assert climbs(tmp_path, height, friction, 1.5 * speed)


def test_on_rough_ground_50_mm_are_climbed(tmp_path):
    assert least_friction(0.05) < 1.0
    assert climbs(tmp_path, 0.05, 1.0, speed=0.05)


# --- walls -------------------------------------------------------------------------------------

WALL = '<geom type="box" pos="1.05 0 0.5" size="0.05 2 0.5" friction="{}"/>'
FLOOR = '<geom type="plane" size="0 0 1" friction="{}"/>'
BUMP = 0.06
"""m; the root may rise by this much when the robot hits a wall at 2 m/s: measured 0.05."""


def rears_up(ground, wall):
    """Whether the moments about the rear contacts lift the front wheels, at these frictions."""
    return ground * (WHEEL_RADIUS + wall * (HALF_BASE + WHEEL_RADIUS)) > HALF_BASE


def rise(drive, speed, seconds):
    """The greatest height on the way, m."""
    highest = 0.0
    drive.command(speed, 0.0)
    for _ in range(round(seconds / drive.period)):
        drive.world.step(drive.steps)
        highest = max(highest, drive.position[2])
    return highest


@pytest.mark.parametrize(
    'ground, wall', [(0.63, 0.63), (0.7, 0.7), (1.0, 0.31), (1.0, 0.36), (0.8, 0.46), (0.8, 0.54)]
)
def test_slow_wheels_climb_a_wall_when_the_moments_say_so(tmp_path, ground, wall):
    world = world_of(tmp_path, FLOOR.format(ground) + WALL.format(wall), math.nan)
    # With one friction for both the limit is a / (a + r). Measured: from 0.98 to 1.03 of it on.
    climbed = rise(Drive(world=world), 0.1, 11.0)
    assert climbed > 0.1 if rears_up(ground, wall) else climbed < 0.01


@pytest.mark.parametrize('heading', [0.0, 0.7])
@pytest.mark.parametrize('speed', [0.1, 0.5, 1.0, 2.0])
def test_a_wall_that_says_nothing_of_friction_is_not_climbed(tmp_path, speed, heading):
    world = world_of(
        tmp_path,
        '<geom type="plane" size="0 0 1"/>' + WALL.replace(' friction="{}"', ''),
        math.nan,
    )
    pose = Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, heading))
    assert rise(Drive(world=world, pose=pose), speed, 1.0 / speed + 4.0) < BUMP


@pytest.mark.parametrize('yaw', [math.pi, math.pi / 2, 2.5])
@pytest.mark.parametrize('speed', [0.1, 0.5, 1.0, 2.0])
def test_robots_that_run_into_each_other_do_not_climb(speed, yaw):
    drive = Drive()
    place = Transform.from_xyz_rpy((1.0, 0.05, 0.0), (0.0, 0.0, yaw))
    other = drive.world.spawn('other', AMR, place)
    wheels = other.joints(WHEELS)
    wheels.command('velocity', [speed / WHEEL_RADIUS] * 4)
    highest = 0.0
    drive.command(speed, 0.0)
    for _ in range(round((0.5 / speed + 3.0) / drive.period)):
        drive.world.step(drive.steps)
        heights = (drive.position[2], other.pose('base_footprint').translation[2])
        highest = max(highest, *heights)
    # Measured: 9 mm at 2 m/s.
    assert highest < 0.02


# --- torque and energy -------------------------------------------------------------------------


def test_wheels_driven_by_torque_roll_without_slip():
    # They are wheels for their effort command, and roll on one point as the others do.
    urdf = AMR.replace(
        '<command_interface name="velocity"/>', '<command_interface name="effort"/>'
    )
    world = MujocoWorld('empty')
    robot = world.spawn('amr', urdf)
    assert [wheel.joint for wheel in robot.wheels] == [
        joint.name for joint in robot.description.joints if joint.has_position
    ]
    wheels = robot.joints(WHEELS)
    world.step(250)
    wheels.command('effort', [0.2] * 4)
    world.step(500)
    speed = robot.velocity('base_footprint')[0][0]
    # a = 4 T / r / (m + 4 I / r²), for 1 s.
    expected = 4 * 0.2 / WHEEL_RADIUS / (MASS + 4 * WHEEL_INERTIA / WHEEL_RADIUS**2)
    assert speed == pytest.approx(expected, rel=0.005)
    assert wheels.velocities() == pytest.approx([speed / WHEEL_RADIUS] * 4, rel=0.005)


def energy(world):
    """Kinetic and potential, J."""
    engine = world.engine
    engine.refresh_kinematics()
    mujoco.mj_energyPos(engine.model, engine.data)
    mujoco.mj_energyVel(engine.model, engine.data)
    return engine.data.energy.tolist()


def test_a_drop_gains_no_energy_and_rest_has_none():
    world = MujocoWorld('empty')
    world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
    start = sum(energy(world)[:2])
    for _ in range(500):
        world.step(1)
        potential, kinetic = energy(world)
        assert potential + kinetic <= start + 1e-9
    highest, _ = rest = energy(world)
    for _ in range(1000):
        world.step(5)
        potential, kinetic = energy(world)
        # Measured: 1e-17 J.
        assert kinetic < 1e-9
        highest = max(highest, potential)
    assert highest == pytest.approx(rest[0], abs=1e-6)


def test_a_robot_that_coasts_gains_no_speed():
    drive = Drive()
    drive.run(0.5, 0.0, 2.0)
    drive.wheels.release()
    speeds = [drive.speed]
    for _ in range(200):
        drive.tick()
        speeds.append(drive.speed)
    assert max(speeds) <= speeds[0] + 1e-6
    # Nothing brakes it either: an URDF has no rolling resistance.
    assert speeds[-1] == pytest.approx(0.5, rel=0.01)
