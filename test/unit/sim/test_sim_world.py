# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated world: robots that come and go, time, reset, determinism."""

import math

from fixtures.sim.driving import AMR, Drive, LEFT, Lines, RIGHT, ROOT
import pytest

from amr_description.control.world import JointGroup, World
from amr_description.errors import SimulationError, SpawnError
from amr_description.model.frames import Transform
from amr_description.model.kinematics import link_poses
from amr_description.sim.spawning import SpawnCode
from amr_description.sim.world import MujocoWorld

ARM = (ROOT / 'test' / 'fixtures' / 'urdf' / 'arm.urdf').read_text()
WHEELS = [*LEFT, *RIGHT]


@pytest.fixture
def world():
    return MujocoWorld('empty')


def states(world, steps):
    """Positions, velocities and true pose after each of ``steps`` control ticks."""
    robot = world.robot('amr')
    wheels = robot.joints(WHEELS)
    log = []
    for tick in range(steps):
        wheels.command('velocity', [5.0, 5.0, 5.0 * math.sin(tick / 20), 1.0])
        world.step(5)
        log.append((wheels.positions(), wheels.velocities(), robot.pose('wheel_front_left')))
    return log


# --- time ----------------------------------------------------------------------------------------


def test_time_is_a_count_of_steps(world):
    assert world.time == 0
    world.step(7)
    world.step()
    assert world.time == 16_000_000
    world.timestep = 1_250_000
    assert world.time == 16_000_000
    world.step(4)
    assert world.time == 21_000_000


def test_time_of_many_steps_is_exact():
    world = MujocoWorld('empty', timestep=1_666_667)
    for _ in range(60):
        world.step(10)
    assert world.time == 600 * 1_666_667


def test_physics_step_must_be_positive(world):
    with pytest.raises(SimulationError, match='physics step of 0 ns is asked'):
        world.timestep = 0


# --- robots come and go --------------------------------------------------------------------------


def test_robots_satisfy_the_contract(world):
    robot: World = world.spawn('amr', AMR)
    wheels: JointGroup = robot.joints(WHEELS)
    assert wheels.positions() == [0.0] * 4
    assert wheels.efforts() == [0.0] * 4
    assert robot.time == world.time


def test_spawn_pose_is_that_of_the_root(world):
    pose = Transform.from_xyz_rpy((1.0, 2.0, 0.2), (0.0, 0.0, 0.7))
    robot = world.spawn('amr', AMR, pose)
    assert robot.pose('base_footprint').translation == pytest.approx(pose.translation)
    assert robot.pose('base_footprint').rotation == pytest.approx(pose.rotation)


@pytest.mark.parametrize('urdf', [AMR, ARM], ids=['floating', 'fixed'])
def test_every_link_is_where_forward_kinematics_has_it(world, urdf):
    pose = Transform.from_xyz_rpy((1.0, 2.0, 0.5), (0.0, 0.0, 0.7))
    robot = world.spawn('robot', urdf, pose)
    joints = [joint.name for joint in robot.description.joints if joint.has_position]
    positions = dict(zip(joints, robot.joints(joints).positions(), strict=True))
    for link, transform_link_to_root in link_poses(robot.description, positions).items():
        expected = pose @ transform_link_to_root
        assert robot.pose(link).translation == pytest.approx(expected.translation, abs=1e-9)
        assert robot.pose(link).apply((1, 2, 3)) == pytest.approx(expected.apply((1, 2, 3)))


def test_velocity_is_in_the_axes_of_the_link():
    drive = Drive(pose=Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 2.0)))
    drive.run(0.5, 1.0, 3.0)
    linear, angular = drive.robot.velocity('base_footprint')
    assert linear[0] == pytest.approx(0.5, rel=0.1)
    assert angular == pytest.approx((0.0, 0.0, 1.0), abs=0.05)
    # It is the derivative of the pose.
    before = drive.robot.pose('base_link')
    linear, angular = drive.robot.velocity('base_link')
    drive.world.step(1)
    after = drive.robot.pose('base_link')
    moved = (before.inverse() @ after).translation
    assert [d / 0.002 for d in moved] == pytest.approx(linear, abs=0.01)


def test_others_drive_on_when_one_comes_and_one_goes(world):
    alone = MujocoWorld('empty')
    for each in (world, alone):
        each.spawn('amr', AMR)
    undisturbed = states(alone, 60)
    disturbed = states(world, 20)
    world.spawn('other', AMR, Transform((5.0, 0.0, 0.0)))
    wheels = world.robot('amr').joints(WHEELS)
    assert wheels.positions() == disturbed[-1][0]
    assert world.names == ('amr', 'other')
    world.remove('other')
    assert world.names == ('amr',)
    assert wheels.positions() == disturbed[-1][0]
    assert wheels.velocities() == disturbed[-1][1]
    assert world.time == 20 * 10_000_000
    assert undisturbed[19][0] == disturbed[-1][0]


def test_each_robot_takes_its_own_commands(world):
    names = ['a', 'b', 'c']
    robots = [world.spawn(n, AMR, Transform((0.0, 2.0 * i, 0.0))) for i, n in enumerate(names)]
    for robot, speed in zip(robots, (5.0, 0.0, -2.0), strict=True):
        robot.joints(WHEELS).command('velocity', [speed] * 4)
    world.step(500)
    ahead = [robot.pose('base_footprint').translation[0] for robot in robots]
    assert ahead == pytest.approx([0.49, 0.0, -0.195], abs=0.01)


def test_view_of_a_removed_robot_is_dead(world):
    robot = world.spawn('amr', AMR)
    wheels = robot.joints(WHEELS)
    world.remove('amr')
    with pytest.raises(SimulationError, match="robot 'amr': joint .* is not in the simulated wo"):
        wheels.positions()
    with pytest.raises(SimulationError, match="robot 'amr': there is no link 'base_link'"):
        robot.pose('base_link')
    world.spawn('amr', AMR)
    assert wheels.positions() == [0.0] * 4


def test_unknown_names_are_reported_with_the_known_ones(world):
    with pytest.raises(SimulationError, match="no robot 'amr'; there are: none"):
        world.remove('amr')
    robot = world.spawn('amr', AMR)
    with pytest.raises(SimulationError, match="no robot 'rma'; there are: amr"):
        world.robot('rma')
    with pytest.raises(SimulationError, match="no joint 'wheel'.*joint_wheel_front_left"):
        robot.joints(['wheel'])
    with pytest.raises(SimulationError, match="no link 'wheel'.*base_footprint, base_link"):
        robot.pose('wheel')


def test_refused_robot_leaves_the_world_as_it_was(world):
    world.spawn('amr', AMR)
    before = states(world, 3)[-1][0]
    broken = AMR.replace('<box size="0.5 0.3 0.1"/>', '<box size="-1 0.3 0.1"/>')
    with pytest.raises(SpawnError) as refusal:
        world.spawn('broken', broken)
    assert refusal.value.code == SpawnCode.RESOURCE_PARSE_ERROR
    assert world.names == ('amr',)
    assert world.robot('amr').joints(WHEELS).positions() == before
    world.spawn('broken', AMR, Transform((0.0, 3.0, 0.0)))


def test_name_that_the_world_has_already_is_refused_and_undone(tmp_path):
    path = tmp_path / 'taken.xml'
    ground = '<geom type="plane" size="0 0 1"/><body name="amr/base_link"/>'
    path.write_text(f'<mujoco><worldbody>{ground}</worldbody></mujoco>')
    world = MujocoWorld(str(path))
    with pytest.raises(SpawnError, match="'amr' cannot be put into the world: .*repeated name"):
        world.spawn('amr', AMR)
    assert world.names == ()
    world.step(10)
    world.spawn('other', AMR)
    world.step(500)
    height = world.robot('other').pose('base_footprint').translation[2]
    assert height == pytest.approx(0.0, abs=1e-4)


# --- reset and determinism -----------------------------------------------------------------------


def test_reset_is_a_fresh_start(world):
    world.spawn('amr', AMR, Transform((0.0, 0.0, 0.05)))
    first = states(world, 100)
    world.reset()
    assert world.time == 0
    assert world.robot('amr').pose('base_footprint').translation == (0.0, 0.0, 0.05)
    assert world.robot('amr').joints(WHEELS).velocities() == [0.0] * 4
    assert states(world, 100) == first


def test_same_commands_at_the_same_steps_give_the_same_bits():
    def run(chunks):
        world = MujocoWorld('empty')
        robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
        wheels = robot.joints(WHEELS)
        for tick in range(200):
            wheels.command('velocity', [tick * 0.1, 3.0, -tick * 0.05, 2.0])
            for steps in chunks:
                world.step(steps)
        return wheels.positions(), wheels.velocities(), robot.pose('base_link')

    assert run([5]) == run([5]) == run([1, 1, 1, 1, 1]) == run([2, 3])


def test_reading_the_state_does_not_change_it():
    def run(look):
        world = MujocoWorld('empty')
        robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
        wheels = robot.joints(WHEELS)
        wheels.command('velocity', [5.0, 5.0, 1.0, 1.0])
        for _ in range(300):
            world.step(1)
            if look:
                robot.pose('wheel_back_left')
                robot.velocity('base_link')
        return wheels.positions(), robot.pose('base_link'), robot.velocity('base_link')

    assert run(look=True) == run(look=False)


# --- joint groups --------------------------------------------------------------------------------


@pytest.mark.parametrize('order', [[0, 1, 2, 3], [3, 1, 0, 2], [2], [3, 0], []])
def test_joints_come_in_the_order_asked_for(world, order):
    robot = world.spawn('amr', AMR)
    commands = [1.0, 2.0, 3.0, 4.0]
    robot.joints(WHEELS).command('velocity', commands)
    world.step(500)
    everything = robot.joints(WHEELS)
    some = robot.joints([WHEELS[i] for i in order])
    assert some.positions() == [everything.positions()[i] for i in order]
    assert some.velocities() == [everything.velocities()[i] for i in order]
    assert some.efforts() == [everything.efforts()[i] for i in order]
    some.command('velocity', [10.0 + i for i in order])
    world.step(500)
    expected = [10.0 + i if i in order else commands[i] for i in range(4)]
    assert everything.velocities() == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize('bad', [math.nan, math.inf, -math.inf])
def test_command_that_is_no_number_is_refused(world, bad):
    wheels = world.spawn('amr', AMR).joints(WHEELS)
    wheels.command('velocity', [1.0] * 4)
    with pytest.raises(SimulationError, match=f"'{RIGHT[0]}': the velocity command is {bad}"):
        wheels.command('velocity', [2.0, 2.0, bad, 2.0])
    world.step(500)
    assert wheels.velocities() == pytest.approx([1.0] * 4, rel=0.01)


def test_a_command_beyond_the_limit_is_clamped_and_logged():
    axis = '<axis xyz="0 0 -1"/>'
    limited = AMR.replace(axis, f'{axis}<limit effort="0" velocity="3"/>')
    log = Lines()
    world = MujocoWorld('empty', log=log)
    wheels = world.spawn('amr', limited).joints(WHEELS)
    wheels.command('velocity', [3.0] * 4)
    assert 'clamped' not in log.text
    wheels.command('velocity', [7.0] * 4)
    assert "WARN robot 'amr': joint 'joint_wheel_front_left': the velocity command 7" in log.text
    assert 'beyond its limit of 3' in log.text
    world.step(500)
    assert wheels.velocities() == pytest.approx([3.0] * 4, rel=0.01)


def test_joint_without_a_command_interface_takes_no_command(world):
    first = AMR.index('<command_interface name="velocity"/>')
    plain = AMR[:first] + AMR[first:].replace('<command_interface name="velocity"/>', '', 1)
    wheels = world.spawn('amr', plain).joints(WHEELS)
    assert wheels.velocities() == [0.0] * 4
    with pytest.raises(SimulationError, match="'joint_wheel_front_left' takes no velocity comm"):
        wheels.command('velocity', [1.0] * 4)


def test_another_world_takes_the_place_of_one_without_robots():
    world = MujocoWorld('empty')
    world.spawn('amr', AMR, Transform((0.0, 0.0, 0.05)))
    with pytest.raises(SimulationError, match='"amr": still in the world; delete first'):
        world.load('walls')
    world.step(10)
    world.remove('amr')
    world.load('walls')
    assert world.time == 0
    fresh = MujocoWorld('walls')
    for each in (world, fresh):
        each.spawn('amr', AMR, Transform((0.0, 0.0, 0.05)))
        each.step(300)
    assert world.state() == fresh.state()


def test_what_is_no_world_leaves_the_present_one_as_it_is():
    world = MujocoWorld('walls')
    before = world.engine.model
    with pytest.raises(SimulationError, match="world 'nowhere'"):
        world.load('nowhere')
    assert world.engine.model is before
