"""Exercise 7: localisation."""

import functools
import math

from conftest import expect
import pytest

from amr_description import Simulation
from amr_description.maps.pose import Pose
from amr_description.sim.occupancy import map_of_world

WORLD = 'warehouse'
TICK = 0.1  # s
GAIN = 1.1  # odometry says a tenth too much
BEGUN = Pose(0.15, -0.1, 0.08)  # what it is told is so far off


@functools.cache
def recording():
    """Scans, movements and true poses of a drive, and the map."""
    robot = 'package://amr_description/urdf/amr_sensors.urdf.xacro'
    steps, last = [], Pose(0.0, 0.0, 0.0)
    with Simulation(robot, world=WORLD) as sim:
        lidar = sim.transform('base_footprint', sim.scan.frame).translation[0]
        for tick in range(100):
            sim.drive(0.3, 0.5 if tick % 40 < 20 else -0.5, seconds=TICK, stop=False)
            scan = sim.scan
            now = Pose(sim.truth.x, sim.truth.y, sim.truth.yaw)
            lidar_at = now.compose(Pose(lidar, 0.0, 0.0))
            moved = last.inverse().compose(lidar_at)
            steps.append((moved, scan.angles, scan.ranges, lidar_at))
            last = lidar_at
    return steps[1:], steps[0][3], map_of_world(WORLD)


@pytest.fixture
def errors(submitted):
    """How far the pose of the student is from the truth, m and rad; and that of odometry."""
    steps, start, grid = recording()
    believed = start.compose(BEGUN)
    localiser = submitted('localiser').Localiser(grid, tuple(believed))
    dead = believed
    for moved, angles, ranges, _ in steps:
        told = Pose(*(GAIN * value for value in moved))
        localiser.moved(*told)
        localiser.saw(angles, ranges)
        dead = dead.compose(told)
    truth = steps[-1][3]
    x, y, yaw = localiser.pose
    turned = abs(math.remainder(yaw - truth.yaw, math.tau))
    return (
        truth.distance(Pose(x, y, yaw)),
        turned,
        dead.distance(Pose(x, y, yaw)),
        believed,
        (x, y),
    )


@pytest.mark.points(5)
def test_moves(errors):
    """The pose moves with odometry."""
    *_, believed, found = errors
    expect(math.dist(found, believed[:2]) > 0.01, 'your pose stays where it was: moved()')


@pytest.mark.points(5)
def test_position(errors):
    """At the end it is right by 0.15 m."""
    off, _, from_odometry, *_ = errors
    said = f'after ten seconds your pose is {off:.2f} m off; 0.15 m are allowed'
    expect(from_odometry > 0.1, f'{said}: it is that of odometry alone, saw() changes nothing')
    expect(off < 0.15, said)


@pytest.mark.points(5)
def test_heading(errors):
    """At the end it is right by 0.08 rad."""
    _, turned, *_ = errors
    expect(turned < 0.08, f'after ten seconds your yaw is {turned:.2f} rad off; 0.08 are allowed')
