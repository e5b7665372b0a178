"""Exercise 3: odometry by wheels."""

import math

from conftest import expect
import pytest

from amr_description import Simulation

RADIUS, SEPARATION = 0.1, 0.846  # m; that of amr, as its wheels scrub: config/controllers.yaml


@pytest.fixture
def odometry(submitted):
    return submitted('odometry').Odometry(0.1, 0.5)


@pytest.mark.points(5)
def test_straight(odometry):
    """Straight ahead, it knows how far."""
    for step in range(1, 101):
        odometry.update(0.1 * step, 0.1 * step)
    ratio, said = odometry.x, f'the robot has rolled 1 m; yours says {odometry.x:.2f} m'
    expect(abs(ratio) > 1e-6, 'update() leaves the pose as it is')
    expect(abs(ratio - 2.0) > 0.01, f'{said}: is that the radius, or the diameter?')
    expect(ratio < 5.0, f'{said}: the angles are since the beginning, not since the last call')
    expect(abs(ratio - 1.0) < 0.001, said)
    expect(abs(odometry.y) + abs(odometry.yaw) < 1e-9, 'it rolled straight; yours has turned')


@pytest.mark.points(5)
def test_turn(odometry):
    """On the spot, it knows by how much, and which way."""
    for step in range(1, 101):
        odometry.update(-0.025 * step, 0.025 * step)
    said = f'the robot has turned left by 1 rad; yours says {odometry.yaw:.2f} rad'
    expect(abs(odometry.yaw + 1.0) > 0.01, f'{said}: to the left is positive')
    expect(abs(odometry.yaw - 0.5) > 0.01, f'{said}: the whole separation lies between the sides')
    expect(abs(odometry.yaw - 1.0) < 0.001, said)
    expect(math.hypot(odometry.x, odometry.y) < 1e-6, 'it turned on the spot; yours has moved')


@pytest.mark.points(5)
def test_simulation(submitted):
    """It keeps to a robot that drives an eight."""
    odometry = submitted('odometry').Odometry(RADIUS, SEPARATION)
    with Simulation('package://amr_description/urdf/amr.urdf') as sim:
        for angular in (0.9, -0.9):
            for _ in range(70):
                sim.drive(0.4, angular, seconds=0.05, stop=False)
                sides = (
                    [sim.joints[f'joint_wheel_{end}_{side}'].position for end in ('front', 'back')]
                    for side in ('left', 'right')
                )
                odometry.update(*(0.5 * sum(side) for side in sides))
        off = math.hypot(odometry.x - sim.truth.x, odometry.y - sim.truth.y)
    expect(off < 0.1, f'after an eight of 2.8 m yours is {off:.2f} m off; 0.10 m is allowed')
