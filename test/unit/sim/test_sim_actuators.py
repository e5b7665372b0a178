# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The effort limit of a driven joint: a motor that cannot do more, and does not rattle."""

import math
from statistics import pstdev

from fixtures.sim.driving import AMR, Drive
import pytest

from amr_description.model.frames import Transform
from amr_description.model.robot import Joint, JointType, Limit
from amr_description.sim.actuators import effort_limit, FASTEST_JOINT, speed_limit

GRAVITY = 9.81
MASS = 7.0
RADIUS = 0.1


def amr_with_limit(effort):
    limit = f'<limit effort="{effort}" velocity="50"/>'
    return AMR.replace('<axis xyz="0 0 -1"/>', f'<axis xyz="0 0 -1"/>{limit}')


def joint_with(limit):
    return Joint(
        'wheel', JointType.CONTINUOUS, 'base', 'tyre', Transform(), (0, 0, 1), limit, None, None, 1
    )


@pytest.mark.parametrize(
    'limit, effort, speed',
    [
        (None, math.inf, FASTEST_JOINT),
        (Limit(0.0, 0.0, 0.0, 0.0), math.inf, FASTEST_JOINT),
        (Limit(0.0, 0.0, 2.5, 30.0), 2.5, 30.0),
    ],
)
def test_limits_of_the_urdf(limit, effort, speed):
    assert effort_limit(joint_with(limit)) == effort
    assert speed_limit(joint_with(limit)) == speed


def test_limited_motor_accelerates_the_robot_as_newton_has_it():
    # Four motors at their limit: a = 4 τ / r / (m + 4 I / r²), with I of the wheels.
    torque, inertia = 0.25, 0.0025
    expected = 4 * torque / RADIUS / (MASS + 4 * inertia / RADIUS**2)
    drive = Drive(amr_with_limit(torque))
    drive.command(5.0, 0.0)
    drive.world.step(50)
    before = drive.speed
    drive.world.step(250)
    assert (drive.speed - before) / 0.5 == pytest.approx(expected, rel=0.01)
    assert drive.wheels.efforts() == pytest.approx([torque] * 4, rel=0.01)


def test_motor_too_weak_to_scrub_does_not_turn_the_robot():
    # Sliding takes about µ m g / 4 · r = 1.7 N·m a wheel.
    drive = Drive(amr_with_limit(1.0))
    drive.run(0.0, 1.0, 2.0)
    assert abs(drive.yaw) < 0.01


@pytest.mark.parametrize('effort', [2, 10, 1000])
def test_strong_motor_with_a_limit_drives_like_one_without(effort):
    limited, free = Drive(amr_with_limit(effort)), Drive()
    for drive in (limited, free):
        drive.run(0.0, 1.0, 3.0)
        drive.run(0.5, 0.0, 2.0)
    assert limited.yaw == pytest.approx(free.yaw, rel=0.02)
    assert math.dist(limited.position, free.position) < 0.02


def test_limited_motor_does_not_rattle():
    drive = Drive(amr_with_limit(5))
    drive.run(0.0, 1.0, 1.0)
    speeds = []
    for _ in range(250):
        drive.world.step(1)
        speeds.append(drive.wheels.velocities())
    # A stiff servo with its force cut off, instead of a clutch, gives more than 1 rad/s here.
    assert max(pstdev(wheel) for wheel in zip(*speeds, strict=True)) < 0.01


def test_limited_robots_come_and_go():
    drive = Drive(amr_with_limit(5))
    other = Drive(amr_with_limit(5), Transform((3.0, 0.0, 0.0)), drive.world, 'other')
    drive.world.remove('amr')
    other.run(0.5, 0.0, 1.0)
    assert other.position[0] == pytest.approx(0.489, abs=0.01)
    assert drive.world.names == ('other',)
