# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where joints stand at spawn and after a reset: ``initial_value`` of their state interfaces."""

from fixtures.sim.arm import ARM, arm, follow
from fixtures.sim.driving import Lines
import pytest

from amr_description.errors import SimulationError, SpawnError


def with_initial(joint, interface, value, urdf=ARM):
    block = f'<joint name="{joint}">'
    before, _, after = urdf.rpartition(block)
    state = f'<state_interface name="{interface}"/>'
    full = f'<state_interface name="{interface}"><param name="initial_value">{value}</param>'
    return before + block + after.replace(state, f'{full}</state_interface>', 1)


def test_initial_positions_are_taken_held_and_come_back():
    urdf = with_initial('shoulder', 'position', 0.7)
    urdf = with_initial('finger', 'position', 0.02, urdf)
    world, robot = arm(urdf)
    names = ['shoulder', 'elbow', 'finger', 'other_finger']
    start = [0.7, 0.0, 0.02, -1.5 * 0.02 - 0.002]
    group = robot.joints(names)
    assert group.positions() == pytest.approx(start, abs=1e-12)
    world.step(500)
    assert group.positions() == pytest.approx(start, abs=2e-4)
    follow(world, robot.joints(['shoulder']), [-0.5], 0.5)
    world.reset()
    assert group.positions() == pytest.approx(start, abs=1e-12)


def test_initial_velocity_of_a_joint_without_command():
    urdf = with_initial('spindle', 'velocity', 4.0)
    commands = '<command_interface name="velocity"/>\n      <command_interface name="effort"/>'
    before, _, after = urdf.rpartition('<joint name="spindle">')
    world, robot = arm(before + '<joint name="spindle">' + after.replace(commands, '', 1))
    spindle = robot.joints(['spindle'])
    assert spindle.velocities() == [4.0]
    world.step(500)
    assert spindle.positions() == pytest.approx([4.0], rel=1e-6)


def test_initial_position_beyond_the_range_begins_at_its_end():
    log = Lines()
    _, robot = arm(with_initial('shoulder', 'position', 3), log=log)
    assert robot.joints(['shoulder']).positions() == [2.0]
    text = "joint 'shoulder': initial_value 3 of its position is beyond its limit of 2; it begins "
    assert f'WARN arm: {text}at 2' in log.text
    with pytest.raises(SpawnError, match="'shoulder': initial_value 3 of its position is beyond "):
        arm(with_initial('shoulder', 'position', 3), strict=True)


def test_a_joint_whose_range_excludes_0_begins_within_it_and_stays():
    log = Lines()
    urdf = ARM.replace('lower="-2" upper="2" effort="50"', 'lower="-3" upper="-0.07" effort="50"')
    world, robot = arm(urdf, log=log)
    elbow = robot.joints(['elbow'])
    assert elbow.positions() == [-0.07]
    world.step(200)
    assert elbow.positions() == pytest.approx([-0.07], abs=1e-3)
    assert 'INFO arm: 0 is beyond the limits of joints, which begin within them: elbow at' in (
        log.text
    )


def test_mimics_by_parameters_of_the_block_follow_too():
    urdf = ARM.replace(
        '<joint name="lift">',
        '<joint name="spindle"><param name="mimic">shoulder</param><param name="multiplier">2'
        '</param><param name="offset">0.1</param><state_interface name="position"/></joint>'
        '<joint name="lift">',
    )
    start = urdf.rindex('<joint name="spindle">')
    urdf = urdf[:start] + urdf[urdf.index('</joint>', start) + len('</joint>') :]
    world, robot = arm(with_initial('shoulder', 'position', 0.3, urdf))
    group = robot.joints(['shoulder', 'spindle'])
    with pytest.raises(SimulationError, match="joint 'spindle' takes no velocity command"):
        robot.joints(['spindle']).command('velocity', [1.0])
    assert group.positions() == pytest.approx([0.3, 0.7])
    follow(world, robot.joints(['shoulder']), [-0.5], 1.0)
    assert group.positions() == pytest.approx([-0.5, -0.9], abs=2e-3)
