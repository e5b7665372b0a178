# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What tests change in a simulation, by variations and faults: what it does, and that it ends."""

import math

import numpy as np
import pytest
from support.paths import ROOT

from amr_description.errors import AmrError, SimulationError, TrialsError
from amr_description.model.frames import Transform
from amr_description.trials import faults, variations
from amr_description.trials.one_run import Simulations

URDF = ROOT / 'urdf' / 'amr.urdf'
SENSORS = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
LEFT, RIGHT = 'joint_wheel_front_left', 'joint_wheel_front_right'
CHANGES = {
    'mass': lambda sim, rng: variations.scale_mass(sim, 1.5),
    'mass of a link': lambda sim, rng: variations.scale_mass(sim, 9.0, 'wheel_back_left'),
    'friction': lambda sim, rng: variations.scale_friction(sim, 0.05),
    'radius': lambda sim, rng: variations.scale_wheel_radius(sim, 1.05),
    'start': lambda sim, rng: variations.move_start(sim, 0.5, 0.2, 0.3),
    'drop': lambda sim, rng: faults.drop_sensor(sim, f'{LEFT}/velocity', after=0.5),
    'freeze': lambda sim, rng: faults.freeze_sensor(sim, LEFT, after=0.5),
    'drift': lambda sim, rng: faults.drift_sensor(sim, f'{LEFT}/position', 0.2),
    'noise': lambda sim, rng: faults.add_noise(sim, f'{LEFT}/velocity', 0.1, rng),
    'stuck': lambda sim, rng: faults.stick_motor(sim, LEFT, after=0.5),
    'weak': lambda sim, rng: faults.weaken_motor(sim, LEFT, 0.5),
    'slip': lambda sim, rng: faults.slip_wheel(sim, 'wheel_front_left', after=0.3, until=0.6),
    'late': lambda sim, rng: faults.delay_commands(sim, 0.1, rng, jitter=0.1),
    'lost': lambda sim, rng: faults.lose_commands(sim, 0.5, rng),
    'tilt': lambda sim, rng: faults.tilt_floor(sim, pitch=-0.1),
}
LEVER = """<robot name="arm"><link name="world"/><link name="base"/>
  <joint name="to_world" type="fixed"><parent link="world"/><child link="base"/>
    <origin xyz="0 0 1"/></joint>
  <link name="lever"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="lever"/>
    <axis xyz="0 1 0"/><limit lower="-1.5" upper="1.5" effort="30" velocity="2"/></joint>
  <ros2_control name="arm" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="hinge"><command_interface name="position"/>
      <state_interface name="position"/></joint>
  </ros2_control></robot>"""
LEVER_CONTROLLERS = """
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    arm: {type: forward_command_controller/ForwardCommandController}
arm:
  ros__parameters: {joints: [hinge], interface_name: position}
"""


@pytest.fixture(scope='module')
def simulations():
    simulations = Simulations()
    yield simulations
    simulations.close()


@pytest.fixture
def simulate(simulations):
    simulations.begin(0, fresh=False, bag='')
    yield simulations
    simulations.end()


def driven(simulate, change=None, seed=1):
    """A drive of 1 s, changed; the simulation, and the bits it ends with."""
    sim = simulate(URDF)
    if change is not None:
        change(sim, np.random.default_rng(seed))
    sim.drive(0.5, 0.4, seconds=1, stop=False)
    return sim, sim.world.state() + repr((sim.odometry, sim.joints)).encode()


@pytest.mark.parametrize('name', CHANGES)
def test_a_change_acts_repeats_by_its_seed_and_is_gone_after_a_reset(simulate, name):
    _, plain = driven(simulate)
    constants = simulate(URDF).world.engine.constants()
    _, changed = driven(simulate, CHANGES[name])
    assert changed != plain
    sim, again = driven(simulate, CHANGES[name])
    assert again == changed
    sim.reset()
    assert sim.world.engine.constants() == constants
    assert driven(simulate)[1] == plain


@pytest.mark.parametrize('name', ['noise', 'late', 'lost'])
def test_another_seed_gives_another_drive(simulate, name):
    assert driven(simulate, CHANGES[name], 1)[1] != driven(simulate, CHANGES[name], 2)[1]


def test_a_heavier_robot_weighs_more(simulate):
    sim = simulate(URDF)
    weight = sim.world.engine.model.body_subtreemass[0]
    variations.scale_mass(sim, 1.5)
    assert sim.world.engine.model.body_subtreemass[0] == pytest.approx(1.5 * weight)


def test_larger_wheels_drive_farther_than_the_odometry_says(simulate):
    sim = simulate(URDF)
    variations.scale_wheel_radius(sim, 1.05)
    sim.drive(0.5, 0.0, seconds=2)
    assert sim.odometry.x == pytest.approx(1.0, abs=1e-3)
    assert sim.truth.x == pytest.approx(1.05, abs=1e-3)
    assert sim.truth.z == pytest.approx(0.05 * 0.1, abs=1e-4)


def test_on_ice_the_wheels_turn_in_place(simulate):
    sim = simulate(URDF)
    variations.scale_friction(sim, 0.02)
    sim.drive(0.5, 0.0, seconds=1, stop=False)
    # µ g t²/2, while it slips.
    assert sim.truth.x == pytest.approx(0.02 * 9.81 / 2, rel=0.1)
    assert sim.truth.x < 0.3 < sim.odometry.x


@pytest.mark.parametrize('side', [1.0, -1.0])
def test_on_a_tilted_floor_of_ice_a_robot_slides_down(simulate, side):
    sim = simulate(URDF)
    variations.scale_friction(sim, 0.02)
    faults.tilt_floor(sim, pitch=side * 0.2)
    sim.run(1.0)
    way = 9.81 / 2 * (math.sin(0.2) - 0.02 * math.cos(0.2))
    assert sim.truth.x == pytest.approx(side * way, rel=0.05)
    assert sim.truth.y == pytest.approx(0.0, abs=1e-3)
    sim = simulate(URDF)
    variations.scale_friction(sim, 0.02)
    faults.tilt_floor(sim, roll=side * 0.2)
    sim.run(1.0)
    assert sim.truth.y == pytest.approx(-side * way, rel=0.05)


def test_a_start_is_in_the_axes_of_the_robot_and_odometry_begins_there(simulate):
    sim = simulate(
        URDF, pose=Transform((1.0, 0.0, 0.0), (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))
    )
    variations.move_start(sim, x=0.5, y=0.2, yaw=math.pi / 2)
    sim.step(100)
    assert (sim.truth.x, sim.truth.y) == pytest.approx((0.8, 0.5), abs=1e-3)
    assert abs(sim.truth.yaw) == pytest.approx(math.pi, abs=1e-3)
    assert (sim.odometry.x, sim.odometry.y) == pytest.approx((0.0, 0.0), abs=1e-3)


def test_a_stuck_motor_stays_and_a_weak_one_is_slow_for_their_time(simulate):
    sim = simulate(URDF)
    faults.stick_motor(sim, LEFT, after=1.0, until=2.0)
    faults.weaken_motor(sim, RIGHT, 0.5)
    velocities = []
    for _ in range(3):
        sim.drive(0.5, 0.0, seconds=1, stop=False)
        velocities.append((sim.joints[LEFT].velocity, sim.joints[RIGHT].velocity))
    assert [each for pair in velocities for each in pair] == pytest.approx(
        [5.0, 2.5, 0.0, 2.5, 5.0, 2.5], abs=0.05
    )


def test_a_stuck_motor_does_not_creep_under_load(simulate, tmp_path):
    file = tmp_path / 'arm.yaml'
    file.write_text(LEVER_CONTROLLERS)
    sim = simulate(LEVER, str(file))
    sim.run(0.1)
    faults.stick_motor(sim, 'hinge')
    sim.run(0.1)
    begin = sim.joints['hinge'].position
    sim.send('/arm/commands', {'data': [0.5]})
    sim.run(10.0)
    assert sim.joints['hinge'].position == pytest.approx(begin, abs=1e-5)


def test_a_fault_of_one_robot_is_none_of_another(simulate):
    sim = simulate(URDF, robots={'a': Transform(), 'b': Transform((0.0, 2.0, 0.0))})
    with pytest.raises(SimulationError, match='there are 2 robots; name one: a, b'):
        faults.weaken_motor(sim, LEFT, 0.5)
    faults.weaken_motor(sim, LEFT, 0.5, robot='b')
    faults.drift_sensor(sim, f'{RIGHT}/velocity', 2.0, robot='b')
    sim.drive_all({'a': (0.5, 0.0), 'b': (0.5, 0.0)}, seconds=1, stop=False)
    a, b = sim.robots['a'].joints, sim.robots['b'].joints
    assert (a[LEFT].velocity, b[LEFT].velocity) == pytest.approx((5.0, 2.5), abs=0.05)
    assert (a[RIGHT].velocity, b[RIGHT].velocity) == pytest.approx((5.0, 7.0), abs=0.1)


def test_a_reset_undoes_what_was_changed_before_the_physics_was_lost(simulate):
    sim = simulate(URDF)
    constants, state = sim.world.engine.constants(), sim.world.state()
    variations.scale_mass(sim, 1.5)
    sim.world.engine.data.qvel[0] = math.nan
    sim.run(0.1)
    assert sim.world.faults.lost == ('amr',)
    sim.reset()
    assert (sim.world.engine.constants(), sim.world.state()) == (constants, state)
    sim.world.engine.data.qvel[0] = math.nan
    sim.run(0.1)
    with pytest.raises(SimulationError, match='the physics of "amr" is lost: the model is chang'):
        variations.scale_mass(sim, 1.5)
    sim.reset()
    assert (sim.world.engine.constants(), sim.world.state()) == (constants, state)


def test_sensors_drop_freeze_and_drift_for_their_time(simulate):
    sim = simulate(SENSORS)
    faults.freeze_sensor(sim, 'imu', after=0.5, until=1.0)
    faults.drift_sensor(sim, f'{LEFT}/velocity', 2.0, after=0.5)
    handles = {
        state.name: state
        for name in ('imu', LEFT)
        for states in sim.altered.states(name).values()
        for state in states
    }
    turn = handles['imu/angular_velocity.z']
    sim.drive(0.0, 1.0, seconds=0.495, stop=False)
    before, wheel = turn.value, sim.joints[LEFT].velocity
    sim.drive(0.0, 0.0, seconds=0.4, stop=False)
    assert turn.value == pytest.approx(before, abs=0.05)
    assert abs(turn.value) > 0.5
    assert handles[f'{LEFT}/velocity'].value == pytest.approx(2.0 * 0.39, abs=0.05)
    assert wheel < 0.0
    sim.drive(0.0, 0.0, seconds=0.2, stop=False)
    assert abs(turn.value) < 0.01


def test_late_commands_arrive_in_their_order_and_lost_ones_never(simulate):
    sim = simulate(URDF)
    faults.delay_commands(sim, 0.3, until=0.05)
    sim.drive(0.5, 0.0, seconds=0.2, stop=False)
    assert sim.truth.x == pytest.approx(0.0, abs=1e-3)
    sim.drive(0.5, 0.0, seconds=0.4, stop=False)
    assert sim.truth.x > 0.05
    sim = simulate(URDF)
    faults.lose_commands(sim, 1.0, np.random.default_rng(0))
    sim.drive(0.5, 0.0, seconds=1)
    assert sim.truth.x == pytest.approx(0.0, abs=1e-3)


def test_a_scan_is_changed_as_it_is_read(simulate):
    sim = simulate(SENSORS, world='walls')
    plain = sim.scan.ranges
    faults.drop_sensor(sim, faults.SCAN, after=0.5)
    assert (sim.scan.ranges == plain).all()
    sim.run(0.6)
    assert np.isnan(sim.scan.ranges).all()
    sim.reset()
    assert (sim.scan.ranges == plain).all()


def test_the_noise_of_sensors_follows_the_seed_of_a_reset(simulate):
    sim = simulate(SENSORS, world='walls')
    first = sim.scan.ranges
    sim.reset(seed=7)
    assert not (sim.scan.ranges == first).all()
    seventh = sim.scan.ranges
    sim.reset()
    assert (sim.scan.ranges == seventh).all()
    sim.reset(seed=0)
    assert (sim.scan.ranges == first).all()
    with pytest.raises(SimulationError, match='a seed of -1 is asked'):
        sim.reset(seed=-1)


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        (lambda s: variations.scale_mass(s, 0.0), 'a mass times 0.0; a finite factor above 0'),
        (lambda s: variations.scale_mass(s, 1.0, 'nose'), 'no mass of "nose"; there are: base_li'),
        (lambda s: variations.scale_friction(s, 1.0, 'base_link'), 'no wheel of "base_link"'),
        (lambda s: variations.scale_wheel_radius(s, math.nan), 'a radius times nan'),
        (lambda s: variations.scale_mass(s, 1.0, robot='b'), "no robot 'b'; there are: amr"),
        (lambda s: variations.move_start(s, math.inf), 'a start at inf, 0.0 m'),
        (lambda s: faults.drop_sensor(s, 'imu'), "the state interfaces 'imu'; there are those of"),
        (lambda s: faults.stick_motor(s, 'neck'), "no joint 'neck'"),
        (lambda s: faults.weaken_motor(s, LEFT, math.nan), 'a share of nan'),
        (lambda s: faults.weaken_motor(s, LEFT, -0.5), 'a share of -0.5; a finite number from 0'),
        (lambda s: faults.slip_wheel(s, 'wheel_front_left', 0.0), 'a share of friction of 0.0'),
        (lambda s: faults.delay_commands(s, -0.1), 'a delay of -0.1; a finite number from 0 on'),
        (lambda s: faults.delay_commands(s, 0.1, jitter=0.1), 'a jitter of 0.1 s needs the gen'),
        (lambda s: faults.lose_commands(s, 2.0, np.random.default_rng()), '2.0 of all commands'),
        (lambda s: faults.drop_sensor(s, LEFT, after=2, until=1), 'a fault after 2 s until 1 s'),
        (lambda s: faults.tilt_floor(s, math.nan), 'gravity tilted by nan and 0.0 rad'),
    ],
)
def test_what_cannot_be_changed_is_said(simulate, change, words):
    sim = simulate(URDF)
    constants = sim.world.engine.constants()
    with pytest.raises((SimulationError, TrialsError), match=words):
        change(sim)
    sim.reset()
    assert sim.world.engine.constants() == constants


def test_robots_come_and_go_before_the_model_is_changed():
    sim = Simulations()(URDF, ROOT / 'config' / 'controllers.yaml', activate=[])
    variations.scale_mass(sim, 1.1)
    with pytest.raises(SimulationError, match='a robot comes or goes after masses'):
        sim.spawn('other', Transform((0.0, 3.0, 0.0)))
    sim.reset()
    sim.spawn('other', Transform((0.0, 3.0, 0.0)))
    with pytest.raises(SimulationError, match='there are 2 robots; name one: amr, other'):
        variations.scale_mass(sim, 1.1)
    variations.scale_mass(sim, 1.1, robot='other')
    sim.close()


def test_a_late_command_is_that_which_was_sent(simulate):
    sim = simulate(URDF)
    faults.delay_commands(sim, 0.1)
    message = {'twist': {'linear': {'x': 0.5}}}
    sim.send(sim.robot.command_topic, message)
    message['twist']['linear']['x'] = -0.5
    with pytest.raises(AmrError, match='fast'):
        sim.send(sim.robot.command_topic, {'twist': {'linear': {'x': 'fast'}}})
    sim.run(0.4)
    assert sim.truth.x > 0.05
