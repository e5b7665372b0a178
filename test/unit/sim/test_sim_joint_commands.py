# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Joints commanded by position, velocity and effort, compared with mechanics.

The limits are those promised to users; the comment at each gives the measured value.
"""

import math

from fixtures.sim.arm import (
    ARM,
    arm,
    follow,
    FREE_LIFT,
    GRAVITY,
    LIFT_MASS,
    LINKS,
    load_of,
    SPINDLE_INERTIA,
)
from fixtures.sim.driving import AMR, Drive, Lines
import pytest

from amr_description.errors import SimulationError
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

STEP = 0.002


# --- held --------------------------------------------------------------------------------------


@pytest.mark.parametrize('urdf', [ARM, FREE_LIFT], ids=['limited', 'unlimited'])
def test_a_joint_without_command_carries_its_load(urdf):
    world, robot = arm(urdf)
    group = robot.joints([*LINKS, 'lift'])
    world.step(1000)
    # Measured: 0.03 mrad, by the creep of the clutch.
    assert group.positions() == pytest.approx([0.0] * 3, abs=1e-4)
    settled = group.positions()
    world.step(5000)
    # Measured: 0.013 mrad a second.
    assert group.positions() == pytest.approx(settled, abs=3e-4)
    assert group.efforts()[:2] == pytest.approx([-load for load in load_of(0, 0)], rel=1e-3)


def test_an_overloaded_joint_slips_and_is_pulled_back():
    world, robot = arm()
    other = robot.joints(['lift'])
    follow(world, other, [0.3], 2.0)
    data = world.engine.data
    pull = data.body('arm/carriage').xfrc_applied
    other.hold()
    pull[2] = -100.0
    world.step(100)
    # 120 N on a motor of 100 N: a = 19.62 N / 2 kg, for 0.2 s.
    assert other.positions()[0] - 0.3 == pytest.approx(-0.5 * 9.81 * 0.2**2, rel=0.05)
    assert other.efforts() == pytest.approx([100.0], rel=1e-3)
    pull[2] = 0.0
    for _ in range(100):
        other.hold()
        world.step(5)
    assert other.positions() == pytest.approx([0.3], abs=1e-3)


def test_a_released_joint_falls_freely():
    world, robot = arm()
    lift = robot.joints(['lift'])
    follow(world, lift, [0.4], 1.5)
    lift.release()
    world.step(100)
    assert lift.velocities() == pytest.approx([-GRAVITY * 0.2], rel=1e-4)
    assert lift.efforts() == pytest.approx([0.0], abs=1e-3)
    lift.hold()
    stopped = lift.positions()[0]
    world.step(1000)
    # Slowed by as much as 100 N allow, with a jolt less than that.
    assert lift.velocities() == pytest.approx([0.0], abs=1e-3)
    assert 0.0 < lift.positions()[0] < stopped


# --- position ----------------------------------------------------------------------------------


@pytest.mark.parametrize('targets', [(1.0, -1.0, 0.4), (-0.5, 1.5, 0.2)])
@pytest.mark.parametrize('efforts', [(100, 50), (30, 12)])
def test_a_position_is_reached_without_overshoot_and_held(targets, efforts):
    urdf = ARM.replace('effort="100" velocity="3"', f'effort="{efforts[0]}" velocity="3"')
    world, robot = arm(urdf.replace('effort="50"', f'effort="{efforts[1]}"'))
    group = robot.joints([*LINKS, 'lift'])
    track = follow(world, group, targets, 2.0)
    for index, target in enumerate(targets):
        way = [positions[index] / target for positions, _ in track]
        # Measured: 1e-6 beyond on the way, and at rest.
        assert max(way) < 1.0001
        assert way[-1] == pytest.approx(1.0, abs=1e-4)
    speeds = [max(map(abs, velocities)) for velocities in zip(*(v for _, v in track), strict=True)]
    # The velocity limits of the URDF.
    assert speeds == pytest.approx([3.0, 3.0, 0.5], rel=0.01)
    assert group.velocities() == pytest.approx([0.0] * 3, abs=1e-4)
    loads = load_of(*targets[:2])
    assert group.efforts() == pytest.approx([*(-load for load in loads), 19.62], rel=1e-3)


@pytest.mark.parametrize('mass', [0.05, 200.0, 2000.0])
def test_a_position_is_held_whatever_the_load(mass):
    carriage = '<mass value="2"/>\n      <inertia ixx="0.01"'
    assert carriage in FREE_LIFT
    world, robot = arm(FREE_LIFT.replace(carriage, carriage.replace('"2"', f'"{mass}"')))
    lift = robot.joints(['lift'])
    track = follow(world, lift, [0.4], 2.0)
    # Measured: 0.8 mm of sag under 2000 kg.
    assert max(position for (position,), _ in track) < 0.4 * 1.001
    assert lift.positions() == pytest.approx([0.4], abs=1e-3)
    assert lift.efforts() == pytest.approx([mass * GRAVITY], rel=1e-3)


def test_a_position_is_approached_with_its_time_constant():
    world, robot = arm(FREE_LIFT)
    lift = robot.joints(['lift'])
    lift.command('position', [0.01])
    world.step(20)
    # Below the velocity limit: the rest of the way falls as exp(-t / 0.04 s).
    assert 0.01 - lift.positions()[0] == pytest.approx(0.01 * math.exp(-1.0), rel=0.05)


def test_a_position_beyond_the_range_is_clamped_and_logged():
    log = Lines()
    world, robot = arm(log=log)
    lift = robot.joints(['lift'])
    follow(world, lift, [9.0], 2.0)
    assert lift.positions() == pytest.approx([0.5], abs=2e-4)
    assert (
        "robot 'arm': joint 'lift': the position command 9 is beyond its limits of 0 to 0.5 and "
        'is clamped; <limit lower="…" upper="…"> in the URDF sets the limit'
    ) in log.text


def test_what_is_beyond_the_range_by_rounding_alone_is_clamped_without_a_word():
    log = Lines()
    world, robot = arm(log=log)
    lift = robot.joints(['lift'])
    lift.command('position', [-1.6e-16])
    world.step(5)
    assert 'beyond' not in log.text
    lift.command('position', [-1e-6])
    assert 'beyond' in log.text


@pytest.mark.parametrize('multiplier, offset', [(-1.5, -0.002), (2.0, 0.01)])
def test_a_mimic_joint_follows_with_multiplier_and_offset(multiplier, offset):
    gear = f'multiplier="{multiplier}" offset="{offset}"'
    world, robot = arm(ARM.replace('multiplier="-1.5" offset="-0.002"', gear))
    fingers = robot.joints(['finger', 'other_finger'])
    assert fingers.positions() == [0.0, offset]
    finger = robot.joints(['finger'])
    for position in (0.03, 0.01):
        for _ in range(60):
            finger.command('position', [position])
            world.step(5)
            source, follower = fingers.positions()
            # Also on the way. Measured: 5e-7 m.
            assert follower == pytest.approx(multiplier * source + offset, abs=1e-5)
        assert source == pytest.approx(position, abs=1e-5)


def test_mimic_is_switched_off_by_the_block():
    part = '<joint name="other_finger"'
    world, robot = arm(ARM.replace(f'{part}>', f'{part} mimic="false">'))
    fingers = robot.joints(['finger', 'other_finger'])
    follow(world, robot.joints(['finger']), [0.03], 0.5)
    assert fingers.positions() == pytest.approx([0.03, 0.0], abs=1e-3)


# --- velocity and effort -----------------------------------------------------------------------


def test_a_velocity_is_kept_against_the_load():
    world, robot = arm()
    group = robot.joints(LINKS)
    group.command('velocity', [0.5, -0.8])
    world.step(500)
    # Measured: 0.004 % fast where the load pulls along.
    assert group.velocities() == pytest.approx([0.5, -0.8], rel=0.001)


@pytest.mark.parametrize('torque', [0.5, -2.0])
def test_a_torque_accelerates_an_inertia_as_newton_has_it(torque):
    world, robot = arm()
    spindle = robot.joints(['spindle'])
    spindle.command('effort', [torque])
    world.step(500)
    assert spindle.velocities() == pytest.approx([torque / SPINDLE_INERTIA * 1.0], rel=1e-9)
    assert spindle.efforts() == pytest.approx([torque])
    spindle.command('effort', [0.0])
    before = spindle.velocities()
    world.step(500)
    assert spindle.velocities() == pytest.approx(before, rel=1e-9)


@pytest.mark.parametrize('urdf', [ARM, FREE_LIFT], ids=['limited', 'unlimited'])
def test_a_force_accelerates_a_slide_as_newton_has_it(urdf):
    world, robot = arm(urdf)
    lift = robot.joints(['lift'])
    follow(world, lift, [0.1], 1.0)
    before = lift.velocities()[0]
    lift.command('effort', [LIFT_MASS * (GRAVITY + 1.0)])
    world.step(250)
    assert lift.velocities()[0] - before == pytest.approx(1.0 * 0.5, rel=1e-6)
    assert lift.efforts() == pytest.approx([LIFT_MASS * (GRAVITY + 1.0)], rel=1e-6)


def test_an_effort_beyond_the_limit_is_clamped():
    world, robot = arm()
    lift = robot.joints(['lift'])
    lift.command('effort', [1000.0])
    world.step(50)
    assert lift.velocities() == pytest.approx([(100.0 / LIFT_MASS - GRAVITY) * 0.1], rel=1e-3)


def test_a_motor_stops_at_the_end_of_the_range():
    world, robot = arm()
    group = robot.joints(['shoulder', 'lift'])
    robot.joints(['shoulder']).command('velocity', [3.0])
    robot.joints(['lift']).command('effort', [100.0])
    world.step(1000)
    # Measured: 0.06 mrad and 0.007 mm beyond.
    assert group.positions() == pytest.approx([2.0, 0.5], abs=5e-4)
    assert group.efforts() == pytest.approx([100.0, 100.0], rel=1e-3)


def test_effort_read_is_the_effort_exerted():
    # In a step of a stiff servo, force before and after the step differ two hundred fold.
    world, robot = arm()
    spindle = robot.joints(['spindle'])
    for interface, value in (('velocity', 1.0), ('effort', 0.3), ('velocity', -5.0), ('held', 0)):
        spindle.hold() if interface == 'held' else spindle.command(interface, [value])
        for _ in range(20):
            (before,) = spindle.velocities()
            world.step(1)
            acceleration = (spindle.velocities()[0] - before) / STEP
            assert spindle.efforts() == pytest.approx([SPINDLE_INERTIA * acceleration], abs=1e-6)


def test_effort_read_is_the_effort_exerted_also_at_the_velocity_limit():
    world, robot = arm(FREE_LIFT)
    lift = robot.joints(['lift'])
    lift.command('position', [0.4])
    for _ in range(300):
        (before,) = lift.velocities()
        world.step(1)
        acceleration = (lift.velocities()[0] - before) / STEP
        force = LIFT_MASS * (acceleration + GRAVITY)
        # Not while it still stands at the end of its range, which carries it.
        if lift.positions()[0] > 0.001:
            assert lift.efforts() == pytest.approx([force], abs=1e-6)


@pytest.mark.parametrize(
    'joint, interface, value, message',
    [
        ('spindle', 'position', 1.0, "'spindle' takes no position command: its <ros2_control>"),
        ('finger', 'effort', 1.0, "'finger' takes no effort command"),
        ('lift', 'acceleration', 1.0, "'lift' takes no acceleration command"),
        ('lift', 'position', math.nan, "'lift': the position command is nan; a finite number"),
        ('spindle', 'effort', math.inf, "'spindle': the effort command is inf; a finite number"),
    ],
)
def test_rejected_commands_change_nothing(joint, interface, value, message):
    world, robot = arm()
    group = robot.joints([joint])
    with pytest.raises(SimulationError, match=message):
        group.command(interface, [value])
    world.step(100)
    assert group.positions() == pytest.approx([0.0], abs=1e-4)


# --- the shipped robot -------------------------------------------------------------------------


def test_wheels_have_only_the_speed_servo():
    world = Drive(AMR).world
    spec = world.engine.spec
    assert [actuator.name for actuator in spec.actuators] == [
        f'amr/{joint}/velocity'
        for joint in (
            'joint_wheel_front_left',
            'joint_wheel_front_right',
            'joint_wheel_back_left',
            'joint_wheel_back_right',
        )
    ]
    assert world.engine.model.nv == 6 + 4


def test_wheels_driven_by_torque_accelerate_the_robot_as_newton_has_it():
    command = '<command_interface name="{}"/>'
    drive = Drive(AMR.replace(command.format('velocity'), command.format('effort')))
    torque, radius, mass, inertia = 0.1, 0.1, 7.0, 0.0025
    drive.wheels.command('effort', [torque] * 4)
    drive.world.step(500)
    expected = 4 * torque / radius / (mass + 4 * inertia / radius**2)
    assert drive.speed == pytest.approx(expected * 1.0, rel=0.02)
    assert drive.position[0] > 0.0


# --- commands that do not change -----------------------------------------------------------------

WHEELS = [f'joint_wheel_{where}' for where in ('front_left', 'front_right')]


def spun_up(*speeds):
    """Two groups of the same wheels; the first one has commanded them."""
    world = MujocoWorld('empty')
    robot = world.spawn('amr', AMR)
    groups = robot.joints(WHEELS), robot.joints(WHEELS)
    groups[0].command('velocity', speeds)
    world.step(10)
    return world, *groups


def commands_of(world):
    return [float(world.engine.data.actuator(f'amr/{name}/velocity').ctrl[0]) for name in WHEELS]


def test_a_command_is_in_force_again_after_a_reset_of_the_world():
    world, group, _ = spun_up(2.0, 3.0)
    world.reset()
    assert commands_of(world) == [0.0, 0.0]
    group.command('velocity', [2.0, 3.0])
    assert commands_of(world) == [2.0, 3.0]


def test_a_command_is_in_force_again_after_the_joint_was_held():
    world, group, other = spun_up(2.0, 3.0)
    other.hold()
    group.command('velocity', [2.0, 3.0])
    assert commands_of(world) == [2.0, 3.0]


def test_a_command_is_in_force_after_another_robot_has_come():
    world, group, _ = spun_up(2.0, 3.0)
    world.spawn('other', AMR, Transform((0.0, 3.0, 0.0)))
    group.command('velocity', [2.0, 3.0])
    assert commands_of(world) == [2.0, 3.0]


def test_of_two_who_command_a_joint_the_later_one_counts():
    world, group, other = spun_up(2.0, 3.0)
    for _ in range(2):
        other.command('velocity', [4.0, 5.0])
        assert commands_of(world) == [4.0, 5.0]
        group.command('velocity', [2.0, 3.0])
        assert commands_of(world) == [2.0, 3.0]


def test_zero_is_written_with_its_sign():
    world, group, _ = spun_up(0.0, 3.0)
    group.command('velocity', [-0.0, 3.0])
    assert math.copysign(1.0, commands_of(world)[0]) == -1.0


def test_who_changes_the_list_of_a_command_changes_the_command():
    world, group, _ = spun_up(2.0, 3.0)
    speeds = [4.0, 5.0]
    group.command('velocity', speeds)
    speeds[1] = 6.0
    group.command('velocity', speeds)
    assert commands_of(world) == [4.0, 6.0]
