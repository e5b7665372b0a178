# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Switching the mode of a joint, also while robots are spawned, removed and reset."""

from itertools import pairwise
import math

from fixtures.sim.arm import ARM, arm, follow, FREE_LIFT, GRAVITY, LIFT_MASS, LINKS, load_of
import pytest

from amr_description.model.frames import Transform

STEP = 0.002


def peak_acceleration(world, group, steps):
    """The greatest |acceleration| of the joint in these steps, rad/s² or m/s²."""
    peak, (before,) = 0.0, group.velocities()
    for _ in range(steps):
        world.step(1)
        (after,) = group.velocities()
        peak, before = max(peak, abs(after - before) / STEP), after
    return peak


MODES = ('position', 'velocity', 'effort', 'held')


@pytest.mark.parametrize('first', MODES)
@pytest.mark.parametrize('second', MODES)
def test_a_switch_at_rest_moves_nothing(first, second):
    world, robot = arm()
    group = robot.joints(LINKS)

    def command(mode):
        if mode == 'held':
            group.hold()
        else:
            efforts = [-load for load in load_of(*group.positions())]
            group.command(mode, {'position': start, 'effort': efforts}.get(mode, [0.0, 0.0]))

    follow(world, group, [0.4, -0.3], 1.0)
    start = group.positions()
    for mode in (first, second) * 5:
        command(mode)
        world.step(5)
        # Measured: 8e-5 rad/s, and 5e-6 rad by velocity, which does not come back.
        assert group.velocities() == pytest.approx([0.0, 0.0], abs=1e-3)
    assert group.positions() == pytest.approx(start, abs=1e-4)


@pytest.mark.parametrize('urdf', [ARM, FREE_LIFT], ids=['limited', 'unlimited'])
def test_a_moving_slide_starts_its_new_mode_at_its_speed(urdf):
    world, robot = arm(urdf)
    lift = robot.joints(['lift'])
    follow(world, lift, [0.1], 1.0)
    lift.command('effort', [LIFT_MASS * (GRAVITY + 1.0)])
    world.step(150)
    assert lift.velocities() == pytest.approx([0.3], rel=1e-3)
    (before,) = lift.positions()
    lift.hold()
    # It slows down with the time constant 0.04 s: a = v / T at most, and stops v T farther on.
    assert peak_acceleration(world, lift, 200) < 1.05 * 0.3 / 0.04
    assert lift.positions()[0] - before == pytest.approx(0.3 * 0.04, rel=0.05)
    assert lift.velocities() == pytest.approx([0.0], abs=1e-4)


@pytest.mark.parametrize('mode, value', [('velocity', 2.0), ('effort', 0.2)])
def test_a_turning_joint_is_stopped_without_swinging_back(mode, value):
    world, robot = arm()
    spindle = robot.joints(['spindle'])
    spindle.command(mode, [value])
    world.step(500)
    assert spindle.velocities() == pytest.approx([2.0], rel=1e-3)
    (before,) = spindle.positions()
    spindle.hold()
    speeds = [2.0]
    for _ in range(200):
        world.step(1)
        speeds += spindle.velocities()
    assert all(later <= earlier + 1e-9 for earlier, later in pairwise(speeds))
    assert speeds[-1] == pytest.approx(0.0, abs=1e-3)
    assert spindle.positions()[0] - before == pytest.approx(2.0 * 0.04, rel=0.05)


def test_a_joint_held_near_the_end_of_its_range_does_not_press_against_it():
    world, robot = arm()
    lift = robot.joints(['lift'])
    follow(world, lift, [0.49], 2.0)
    lift.command('effort', [100.0])
    world.step(6)
    (position,), (velocity,) = lift.positions(), lift.velocities()
    # Where the speed would carry it is beyond the end.
    assert 0.49 < position < 0.5 < position + velocity * 0.04
    for _ in range(100):
        lift.hold()
        world.step(5)
    assert lift.positions() == pytest.approx([0.5], abs=1e-4)
    # Measured: 20 N, the load; it could press with 100.
    assert lift.efforts()[0] == pytest.approx(LIFT_MASS * GRAVITY, rel=0.01)


def test_a_turning_joint_starts_its_new_mode_at_its_speed():
    world, robot = arm()
    spindle = robot.joints(['spindle'])
    spindle.command('effort', [0.5])
    world.step(500)
    spindle.command('velocity', [5.0])
    # Measured: 4e-12 rad/s². Were the servo to begin at rest, 5 / 0.02 s.
    assert peak_acceleration(world, spindle, 100) < 1e-6
    world.step(200)
    assert spindle.velocities() == pytest.approx([5.0], rel=1e-6)


def test_only_the_last_command_is_active():
    world, robot = arm()
    lift, again = robot.joints(['lift']), robot.joints(['spindle', 'lift'])
    follow(world, lift, [0.3], 1.0)
    again.command('effort', [0.0, LIFT_MASS * GRAVITY])
    world.step(100)
    assert lift.positions() == pytest.approx([0.3], abs=2e-4)
    follow(world, lift, [0.2], 1.0)
    assert lift.positions() == pytest.approx([0.2], abs=2e-4)


# --- the world around --------------------------------------------------------------------------


def busy_arm():
    world, robot = arm()
    robot.joints(['spindle']).command('effort', [0.2])
    robot.joints(['shoulder']).release()
    robot.joints(['lift']).command('position', [0.3])
    robot.joints(['elbow']).command('velocity', [-0.5])
    world.step(100)
    return world, robot


def test_modes_survive_that_robots_are_spawned_and_removed():
    (world, robot), (alone, undisturbed) = busy_arm(), busy_arm()
    names = [*LINKS, 'lift', 'spindle']
    other = world.spawn('other', ARM, Transform((5.0, 0.0, 0.0)))
    for each in (world, alone):
        each.step(100)
    assert robot.joints(names).positions() == pytest.approx(
        undisturbed.joints(names).positions(), abs=1e-9
    )
    assert other.joints(names).positions() == pytest.approx([0.0] * 4, abs=2e-4)
    world.remove('other')
    for each in (world, alone):
        each.step(100)
    assert robot.joints(names).positions() == pytest.approx(
        undisturbed.joints(names).positions(), abs=1e-9
    )


def test_reset_holds_every_joint_at_its_initial_position():
    world, robot = busy_arm()
    group = robot.joints([*LINKS, 'lift', 'spindle'])
    world.reset()
    assert group.positions() == [0.0] * 4
    world.step(500)
    assert group.positions() == pytest.approx([0.0] * 4, abs=2e-4)


def test_same_commands_give_the_same_bits_also_after_a_reset():
    def run(world, robot):
        group = robot.joints(LINKS)
        for tick in range(60):
            mode = ('position', 'velocity', 'effort')[tick // 20]
            group.command(mode, [0.3 * math.sin(tick), -0.2])
            world.step(5)
        return group.positions(), group.velocities(), group.efforts()

    world, robot = arm()
    first = run(world, robot)
    assert run(*arm()) == first
    world.reset()
    assert run(world, robot) == first
