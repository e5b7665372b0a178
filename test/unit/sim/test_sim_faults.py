# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the physics are logged once, in one line, and no file is written."""

import math

from fixtures.sim.driving import AMR, Drive, Lines
import mujoco
import numpy as np
import pytest

from amr_description.errors import SpawnError
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

BESIDE = Transform((0.0, 3.0, 0.0))
DRIVEN = [
    f'joint_wheel_{each}' for each in ('front_left', 'front_right', 'back_left', 'back_right')
]


@pytest.fixture
def log():
    return Lines()


@pytest.fixture
def world(log, tmp_path, monkeypatch):
    """Two robots, in an empty working folder that must be empty afterwards."""
    monkeypatch.chdir(tmp_path)
    world = MujocoWorld('empty', log=log)
    world.spawn('other', AMR, BESIDE)
    world.spawn('amr', AMR)
    yield world
    assert list(tmp_path.iterdir()) == []


def break_wheel(world, quantity, value):
    """Put ``value`` where the physics has the front left wheel of 'amr'."""
    data = world.engine.data
    joint = data.joint('amr/joint_wheel_front_left')
    getattr(joint, quantity)[0] = value


@pytest.mark.parametrize(
    'quantity, value, word',
    [
        ('qvel', math.nan, 'velocity'),
        ('qvel', 1e12, 'velocity'),
        ('qpos', math.inf, 'position'),
    ],
)
def test_lost_state_names_robot_and_joint_once(world, log, quantity, value, word):
    world.step(10)
    assert log.lines == []
    break_wheel(world, quantity, value)
    for _ in range(20):
        world.step(5)
    assert len(log.lines) == 1
    assert (
        f"ERROR robot 'amr': joint 'joint_wheel_front_left': the {word} is not finite" in log.text
    )
    assert "'amr' is frozen as it was at 0.020 s, until a reset; the rest goes on" in log.text


def test_time_goes_on_and_a_reset_heals(world, log):
    break_wheel(world, 'qvel', math.nan)
    world.step(100)
    assert world.time == 200_000_000
    world.reset()
    world.step(500)
    robot = world.robot('amr')
    assert robot.pose('base_footprint').translation == pytest.approx((0, 0, 0), abs=1e-4)
    assert len(log.lines) == 1
    break_wheel(world, 'qvel', math.nan)
    world.step(5)
    assert len(log.lines) == 2


def test_the_robot_of_a_lost_state_is_frozen_and_the_others_go_on(world, log):
    for name in ('amr', 'other'):
        world.robot(name).joints(DRIVEN).command('velocity', [3.0] * 4)
    for _ in range(200):
        world.step(5)
    amr, other = world.robot('amr').pose('base_link'), world.robot('other').pose('base_link')
    break_wheel(world, 'qvel', math.nan)
    for _ in range(200):
        world.step(5)
        data = world.engine.data
        for array in (data.qpos, data.qvel, data.qacc, data.xpos, data.cvel, data.actuator_force):
            assert np.isfinite(array).all()
    assert world.robot('amr').pose('base_link') == amr
    assert world.robot('amr').joints(DRIVEN).velocities() == [0.0] * 4
    way = world.robot('other').pose('base_link').translation[0] - other.translation[0]
    assert way == pytest.approx(3.0 * 0.1 * 2.0, rel=0.02)
    assert len(log.lines) == 1


def test_what_is_frozen_stays_so_when_robots_come_and_time_is_set_and_is_not_moved(world, log):
    world.step(500)
    before = world.robot('amr').pose('base_link')
    break_wheel(world, 'qvel', math.nan)
    world.step(5)
    world.spawn('late', AMR, Transform((-1.5, 0.0, 0.0)))
    world.time = 0
    world.robot('late').joints(DRIVEN).command('velocity', [5.0] * 4)
    for _ in range(240):
        world.step(5)
    assert world.robot('amr').pose('base_link') == before
    assert world.robot('late').pose('base_link').translation[0] == pytest.approx(-0.54, abs=0.05)
    world.remove('late')
    world.faults.release('other')
    world.step(100)
    assert world.robot('amr').pose('base_link') == before
    world.faults.release('amr')  # as who puts it elsewhere does
    world.robot('amr').joints(DRIVEN).command('velocity', [3.0] * 4)
    for _ in range(200):
        world.step(5)
    assert world.robot('amr').pose('base_link').translation[0] > 0.2
    assert len(log.lines) == 1


def test_what_is_lost_after_a_spawn_that_was_refused_is_frozen_where_it_was(world, log):
    world.robot('amr').joints(DRIVEN).command('velocity', [3.0] * 4)
    for _ in range(200):
        world.step(5)
    before = world.robot('amr').pose('base_link').translation
    with pytest.raises(SpawnError, match='deep in'):
        world.spawn('late', AMR, Transform((3.0, 0.0, -0.2)))
    break_wheel(world, 'qvel', math.nan)
    world.step(5)
    assert world.robot('amr').pose('base_link').translation == before


def test_a_loop_that_is_unstable_by_its_gains_is_named_and_no_nan_leaves_the_robot(log):
    """A controller of p and d at 250 Hz, on an inertia that is far too small for them."""
    world = MujocoWorld('empty', timestep=2_000_000, log=log)
    robot = world.spawn('pendulum', PENDULUM)
    (joint,) = [robot.joints(['swing'])]
    for _ in range(250):
        (position,), (speed,) = joint.positions(), joint.velocities()
        assert math.isfinite(position) and math.isfinite(speed)
        joint.command('effort', [5.0 * (1.0 - position) - 0.2 * speed])
        world.advance(4_000_000)
    errors = [text for severity, text in log.lines if 'frozen' in text]
    (line,) = errors
    assert "robot 'pendulum': joint 'swing'" in line
    assert 'lower the gains (p, i, d) of the controller that commands it' in line


def test_a_lost_state_goes_with_its_robot(world, log):
    break_wheel(world, 'qvel', math.nan)
    world.step(10)
    world.remove('amr')
    world.step(100)
    world.spawn('amr', AMR, Transform((0.0, -3.0, 0.0)))
    world.step(10)
    break_wheel(world, 'qvel', math.nan)
    world.step(10)
    assert log.text.count("robot 'amr': joint 'joint_wheel_front_left'") == 2


def test_a_command_that_is_not_finite_is_named_and_the_state_is_kept(world, log):
    engine = world.engine
    (actuator,) = (
        index
        for index in range(engine.model.nu)
        if 'amr/joint_wheel_back_right' in engine.model.actuator(index).name
    )
    engine.data.ctrl[actuator] = math.nan
    world.step(10)
    (line,) = log.text.splitlines()
    assert line.startswith(
        "ERROR robot 'amr': joint 'joint_wheel_back_right': the command is nan at 0.0"
    )
    engine.data.ctrl[actuator] = 0.0
    break_wheel(world, 'qvel', math.nan)
    world.step(10)
    assert 'is frozen as it was' in log.text


def test_the_model_of_the_present_is_checked_after_a_robot_has_come(world, log):
    world.step(10)
    world.spawn('late', AMR, Transform((0.0, -3.0, 0.0)))
    world.step(10)
    break_wheel(world, 'qvel', 5000.0)
    world.faults.check(())
    (line,) = log.text.splitlines()
    assert "robot 'amr': joint 'joint_wheel_front_left': the velocity is 5000 rad/s" in line


@pytest.mark.parametrize(
    'damage, cause',
    [
        (lambda engine, dof: None, 'look at the masses and inertias there'),
        (
            lambda engine, dof: engine.model.dof_M0.__setitem__(dof, 1e-9),
            'what moves there has an inertia of only 1e-09: correct <inertial> of link '
            "'wheel_front_left'",
        ),
        (
            lambda engine, dof: engine.data.ctrl.__setitem__(slice(None), 4000.0),
            'it is commanded to 4000: command less, or give the joint a <limit velocity',
        ),
    ],
    ids=['unknown', 'light', 'commanded'],
)
def test_exploding_velocities_are_named_with_their_likely_cause(world, log, damage, cause):
    engine = world.engine
    world.step(500)  # until it stands: the contacts are at rest
    damage(engine, int(engine.model.joint('amr/joint_wheel_front_left').dofadr[0]))
    break_wheel(world, 'qvel', 5000.0)
    world.faults.check(())
    (line,) = log.text.splitlines()
    assert line.startswith(
        "ERROR robot 'amr': joint 'joint_wheel_front_left': the velocity is 5000 rad/s at "
        '1.000 s: the physics explodes there. '
        f'Likely: {cause}'
    )


def test_the_speed_of_a_whole_robot_has_its_unit_and_an_overlap_is_found(log):
    world = MujocoWorld('empty', log=log)
    world.spawn('amr', AMR)
    world.step(500)
    engine = world.engine
    joint = engine.data.joint('amr/base_footprint/free')
    joint.qpos[2] -= 0.05
    world.step(1)
    joint.qvel[2] = -3000.0
    world.faults.check(())
    (line,) = log.text.splitlines()
    assert "robot 'amr': link 'base_footprint': the velocity is -3000 m/s" in line
    assert "'amr/wheel_" in line
    assert 'm inside each other: put them apart' in line


def test_a_solver_that_stays_at_its_cap_is_named_with_the_robot_that_keeps_it_there(log):
    drive = Drive(log=log)
    drive.world.spawn('other', AMR, BESIDE)
    option = drive.world.engine.model.opt
    option.iterations, option.tolerance = 2, 1e-14
    drive.run(0.5, 1.0, 0.04)
    assert log.lines == []
    drive.run(0.5, 1.0, 1.0)
    (line,) = log.text.splitlines()
    assert line.startswith("WARN robot 'amr': the solver stops at its cap of 2 iterations")
    assert '5 times in a row at 1.050 s, with 8 contacts' in line
    option.iterations = 100
    drive.run(0.0, 0.0, 6.0)
    option.iterations = 2
    drive.run(0.5, 1.0, 1.0)
    assert log.text.count('at its cap') == 2


PENDULUM = """<robot name="pendulum"><link name="world"/><link name="arm">
  <inertial><mass value=".02"/><inertia ixx="7e-5" iyy="7e-5" izz="7e-5" ixy="0" ixz="0" iyz="0"/>
  </inertial></link>
  <joint name="swing" type="continuous"><parent link="world"/><child link="arm"/>
  <axis xyz="0 1 0"/></joint>
  <ros2_control name="s" type="system"><hardware>
  <plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
  <joint name="swing"><command_interface name="effort"/><state_interface name="position"/></joint>
  </ros2_control></robot>"""

LEANING = """<robot name="arm"><link name="base">
  <collision><origin xyz="0 0 .05"/><geometry><box size=".1 .1 .1"/></geometry></collision>
  <inertial><origin xyz="0 0 .05"/><mass value="1"/>
  <inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="arm"><inertial><origin xyz=".5 0 .1"/><mass value="2"/>
  <inertia ixx=".05" iyy=".05" izz=".05" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="lift" type="revolute"><parent link="base"/><child link="arm"/>
  <origin xyz="0 0 .1"/><axis xyz="0 1 0"/>
  <limit lower="-.1" upper=".1" effort="9" velocity="1"/></joint></robot>"""

BOX = """<robot name="box"><link name="box">
  <collision><geometry><box size=".2 .2 .2"/></geometry></collision>
  <inertial><mass value="1"/><inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/>
  </inertial></link></robot>"""


def test_a_solver_at_its_cap_is_told_of_more_islands_than_mujoco_counts(log):
    world = MujocoWorld('empty', log=log)
    world.engine.spec.option.jacobian = mujoco.mjtJacobian.mjJAC_SPARSE  # as is, in islands
    for number in range(22):
        world.spawn(f'box{number}', BOX, Transform((number, 0.0, 0.11)))
    option = world.engine.model.opt
    option.iterations, option.tolerance = 1, 1e-14
    for _ in range(30):
        world.step(5)
    assert world.engine.data.nisland == 22
    (line,) = [text for _, text in log.lines if 'at its cap' in text]
    assert "'box0'" in line


def test_an_absurd_effort_is_named_as_the_cause_and_its_effects_are_not_logged(log):
    driven = '<command_interface name="velocity"/>'
    world = MujocoWorld('empty', log=log)
    robot = world.spawn('amr', AMR.replace(driven, driven.replace('velocity', 'effort')))
    robot.joints(['joint_wheel_back_left']).command('effort', [1e6])
    for _ in range(100):
        world.step(5)
    (line,) = log.text.splitlines()
    assert line.startswith("ERROR robot 'amr': ")
    assert (
        "Likely: joint 'joint_wheel_back_left' is driven with an effort of 1e+06, on an inertia "
        'of 0.0'
    ) in line


def test_a_floor_below_zero_is_ground_too(log, tmp_path):
    path = tmp_path / 'cellar.xml'
    path.write_text(
        '<mujoco><worldbody><geom name="floor" type="plane" size="5 5 1" pos="0 0 -2"/>'
        '</worldbody></mujoco>'
    )
    world = MujocoWorld(str(path), log=log)
    world.spawn('amr', AMR, Transform((0.0, 0.0, -1.8)))
    for _ in range(200):
        world.step(5)
    assert world.robot('amr').pose('base_footprint').translation[2] == pytest.approx(-2, abs=1e-3)
    assert log.lines == []


def test_a_lasting_fault_is_logged_once_and_each_report_calls_on_fault(log, tmp_path):
    path = tmp_path / 'table.xml'
    path.write_text(
        '<mujoco><worldbody><geom name="table" type="box" size="1 1 .1" pos="0 0 -.1"/>'
        '</worldbody></mujoco>'
    )
    world = MujocoWorld(str(path), log=log)
    told = []
    world.faults.on_fault = lambda: told.append(world.time)
    world.spawn('amr', AMR, Transform((5.0, 0.0, 0.0)))
    for _ in range(100):
        world.step(5)
    assert "robot 'amr' is below the ground: its root is at z = -0." in log.text
    assert 'Likely: there is no ground where it is: spawn it above' in log.text
    assert len(log.lines) == len(told) == 1
    root = world.engine.data.joint('amr/base_footprint/free')
    root.qpos[:2], root.qpos[2], root.qvel[:] = 0.0, 0.1, 0.0  # back on the table
    for _ in range(60):
        world.step(50)
    assert len(log.lines) == 1
    root.qpos[0] = 5.0
    for _ in range(100):
        world.step(5)
    assert len(log.lines) == len(told) == 2


def test_robot_without_collision_falls_and_is_named_once(log):
    head, rest = AMR.split('<collision>', 1)
    bare = head + ''.join(part.split('</collision>', 1)[-1] for part in rest.split('<collision>'))
    assert 'collision>' not in bare
    world = MujocoWorld('empty', log=log)
    world.spawn('ghost', bare)
    world.spawn('amr', AMR, BESIDE)
    for _ in range(100):
        world.step(5)
    assert "ERROR robot 'ghost' is below the ground: its root is at z = -" in log.text
    assert 'none of its links has a <collision>: give it one' in log.text
    assert log.text.count('below the ground') == 1
    world.reset()
    world.step(500)
    assert log.text.count('below the ground') == 2


def test_an_arm_that_is_not_bolted_down_is_named_once_with_what_would_do(log):
    world = MujocoWorld('empty', log=log)
    world.spawn('arm', LEANING)
    world.spawn('box', BOX, Transform((1.0, 0.0, 0.3), (0.5, 0.0, 0.0, 0.75**0.5)))
    for _ in range(400):
        world.step(5)
    (line,) = [text for _, text in log.lines if 'tipped' in text]
    assert line.startswith("robot 'arm' has tipped over, by ")
    assert 'none of its links is called world: fix it (fixed:=true)' in line


DOOR = """
<mujoco>
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <body pos="3 0 0.5"><joint name="hinge" type="hinge" axis="0 0 1"/>
      <geom type="box" size="0.4 0.02 0.4" mass="5"/></body>
    <body pos="-3 0 0.5"><joint type="hinge" axis="0 0 1"/>
      <geom type="box" size="0.4 0.02 0.4" mass="5"/></body>
  </worldbody>
</mujoco>
"""


@pytest.mark.parametrize('joint', [0, 1], ids=['named', 'without a name'])
def test_a_thing_of_the_world_that_is_frozen_stays_so_when_robots_come_and_go(
    log, tmp_path, joint
):
    file = tmp_path / 'door.xml'
    file.write_text(DOOR)
    world = MujocoWorld(str(file), log=log)
    data = world.engine.data
    data.qvel[:] = 1.0
    world.step(100)
    data.qvel[joint] = math.nan
    world.step(5)
    angles = world.engine.data.qpos.tolist()
    world.spawn('amr', AMR)
    world.step(100)
    world.remove('amr')
    world.step(100)
    after = world.engine.data.qpos.tolist()
    assert after[joint] == angles[joint]
    assert after[1 - joint] > angles[1 - joint] + 0.1
    world.load('empty')
    assert world.faults.lost == ()
    world.step(5)
