# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Each robot rests on its wheels' true radius, so that its odometry needs no other."""

import re
from statistics import mean, pstdev

from fixtures.sim.arm import ARM
from fixtures.sim.driving import AMR, Drive, Lines, ROOT, SEPARATION as TOLD
import pytest

from amr_description.log import null_log
from amr_description.model.frames import Transform
from amr_description.sim import wheel_trim
from amr_description.sim.robot_spec import build_robot
from amr_description.sim.spawning import read_description
from amr_description.sim.wheel_contact import WHEEL_CONTACT
from amr_description.sim.wheel_trim import trimmed_contacts
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

TWO_WHEELS = (ROOT / 'test' / 'fixtures' / 'sim' / 'two_wheels.urdf').read_text()
RADIUS, SEPARATION = 0.05, 0.34


SWIVEL = """<joint name="swivel" type="continuous">
    <parent link="base_link"/><child link="fork"/><origin xyz="-0.1 0 -0.05"/><axis xyz="0 0 1"/>
  </joint>
  <link name="fork">
    <inertial><mass value="0.1"/>
      <inertia ixx="0.0001" ixy="0" ixz="0" iyy="0.0001" iyz="0" izz="0.0001"/></inertial>
  </link>
  <joint name="roll" type="continuous">
    <parent link="fork"/><child link="caster"/>
    <origin xyz="-0.03 0 -0.025" rpy="-1.5708 0 0"/><axis xyz="0 0 1"/>
  </joint>
"""


def with_swivel_caster():
    """Two driven wheels, and one that turns and rolls freely."""
    ball = TWO_WHEELS.index('<joint name="caster_joint"')
    end = TWO_WHEELS.index('</joint>', ball) + len('</joint>')
    return (TWO_WHEELS[:ball] + SWIVEL + TWO_WHEELS[end:]).replace(
        '<sphere radius="0.025"/>', '<cylinder radius="0.025" length="0.02"/>'
    )


def heavier(factor):
    """The amr, its chassis so many times as heavy."""
    head, chassis, tail = re.split(r'(<mass value="5.0"/>\s*<inertia [^>]*>)', AMR)
    number = re.compile(r'"([0-9.]+)"')
    return head + number.sub(lambda n: f'"{float(n[1]) * factor}"', chassis) + tail


def contacts(urdf, gravity=9.81):
    model = build_robot(read_description(urdf, 'robot'), null_log)
    return trimmed_contacts(model, WHEEL_CONTACT, gravity)


@pytest.mark.parametrize('gravity', [1.62, 9.81])
@pytest.mark.parametrize(
    'urdf',
    [AMR, heavier(0.2), heavier(10.0), TWO_WHEELS, with_swivel_caster()],
    ids=['amr', 'light', 'heavy', 'two wheels', 'swivel caster'],
)
def test_it_rests_on_its_wheels_true_radius(urdf, gravity):
    world = MujocoWorld('empty', settings=WorldSettings(gravity=gravity))
    robot = world.spawn('robot', urdf, Transform((0.0, 0.0, 0.02)))
    world.step(2500)
    for wheel in robot.wheels:
        # Measured: 3 µm; untrimmed 650 µm (two wheels), 130 and 170 µm (light and heavy).
        assert robot.pose(wheel.link).translation[2] == pytest.approx(wheel.radius, abs=1e-5)


@pytest.mark.parametrize(
    'left, right', [(10.0, 10.0), (20.0, 20.0), (-10.0, -10.0), (-3.4, 3.4), (4.0, 8.0)]
)
def test_it_drives_and_turns_as_its_wheels_say(left, right):
    world = MujocoWorld('empty')
    robot = world.spawn('robot', TWO_WHEELS)
    wheels = robot.joints(['left', 'right'])
    for tick in range(200):
        # Within 1.5 s, or it would rear up on the way back.
        share = min(1.0, tick / 150)
        wheels.command('velocity', [share * left, share * right])
        world.step(5)
    speeds, rates = [], []
    for _ in range(100):
        world.step(5)
        (forward, _, _), (_, _, yaw_rate) = robot.velocity('base_footprint')
        speeds.append(forward)
        rates.append(yaw_rate)
    # Measured: within 0.05 %; with MuJoCo's default contact of the ball 2 to 12 % short.
    assert mean(speeds) == pytest.approx((left + right) / 2 * RADIUS, rel=0.002, abs=0.001)
    assert mean(rates) == pytest.approx((right - left) / SEPARATION * RADIUS, rel=0.002, abs=1e-3)


@pytest.mark.parametrize('left, right', [(-3.4, 3.4), (4.0, 8.0)])
def test_a_caster_that_rolls_does_not_shake_the_robot(left, right):
    world = MujocoWorld('empty')
    robot = world.spawn('robot', with_swivel_caster())
    assert [wheel.joint for wheel in robot.wheels] == ['left', 'right', 'roll']
    robot.joints(['left', 'right']).command('velocity', [left, right])
    world.step(1500)
    accelerations, before = [], robot.velocity('base_link')[0][2]
    for _ in range(500):
        world.step(1)
        after = robot.velocity('base_link')[0][2]
        accelerations.append((after - before) / 0.002)
        before = after
    # Measured: 0.0000; with MuJoCo's own contacts 0.29 and 0.05 m/s².
    assert pstdev(accelerations) < 0.01
    forward, yaw_rate = robot.velocity('base_footprint')[0][0], robot.velocity('base_link')[1][2]
    assert forward == pytest.approx((left + right) / 2 * RADIUS, rel=0.002, abs=0.001)
    assert yaw_rate == pytest.approx((right - left) / SEPARATION * RADIUS, rel=0.002)


def test_a_ball_that_does_not_bear_keeps_its_own_contact():
    assert 'caster/caster_0' in contacts(TWO_WHEELS)
    lifted = TWO_WHEELS.replace('xyz="-0.12 0 -0.075"', 'xyz="-0.02 0 0.1"')
    # It rests on the end of its chassis instead.
    assert set(contacts(lifted)) == {
        'left_wheel/wheel', 'right_wheel/wheel', 'base_link/caster_0'
    }  # fmt: skip


def test_the_shipped_robot_keeps_the_measured_margin():
    for contact in contacts(AMR).values():
        assert contact.margin == pytest.approx(WHEEL_CONTACT.margin, abs=5e-6)


def test_only_the_margin_is_trimmed():
    for contact in contacts(TWO_WHEELS).values():
        assert contact.margin != WHEEL_CONTACT.margin
        assert (contact.solref, contact.solimp) == (WHEEL_CONTACT.solref, WHEEL_CONTACT.solimp)
        assert contact.solreffriction == WHEEL_CONTACT.solreffriction


def test_a_robot_that_does_not_stand_on_wheels_keeps_its_contacts():
    assert contacts(ARM) == {}
    # In free fall nothing rests.
    assert set(contacts(AMR, gravity=0.0).values()) == {WHEEL_CONTACT}
    # On its back, so to speak: a chassis deeper than the wheels reach.
    bellied = AMR.replace('<box size="0.5 0.3 0.1"/>', '<box size="0.5 0.3 0.3"/>')
    settings = contacts(bellied)
    assert settings.pop('base_link/caster_0').margin < WHEEL_CONTACT.margin
    assert set(settings.values()) == {WHEEL_CONTACT}


def warnings_about(urdf):
    log = Lines()
    trimmed_contacts(
        build_robot(read_description(urdf, 'robot'), null_log), WHEEL_CONTACT, 9.81, log
    )
    return log.text


def test_a_caster_that_slides_and_bears_more_than_the_wheels_is_told():
    """By Coulomb they cannot pull it; loads by the moments about the axle."""
    assert warnings_about(TWO_WHEELS) == ''
    assert warnings_about(AMR) == ''
    back = TWO_WHEELS.replace('<mass value="4"/>', '<origin xyz="-0.08 0 0"/><mass value="4"/>')
    load = 9.81 * (4 * 0.1 + 0.1 * 0.14) / 0.14
    told = warnings_about(back)
    assert told.startswith('WARN "caster" slide on the ground and hold the robot with ')
    drag, pull = map(float, re.findall(r'with ([\d.]+) N', told))
    assert (drag, pull) == pytest.approx((load, 9.81 * 4.7 - load), rel=0.01)
    rolls = '<gazebo reference="caster"><mu1>0.01</mu1></gazebo></robot>'
    assert warnings_about(back.replace('</robot>', rolls)) == ''


def test_the_same_robot_settles_once_and_any_other_anew(monkeypatch):
    monkeypatch.setattr(wheel_trim, '_KNOWN', {})
    settled = []
    settle = wheel_trim._settle
    monkeypatch.setattr(
        wheel_trim, '_settle', lambda *model: settled.append(model) or settle(*model)
    )
    first = contacts(TWO_WHEELS)
    assert contacts(TWO_WHEELS) == first
    assert len(settled) == 1
    assert contacts(TWO_WHEELS, gravity=1.62) != first
    assert contacts(AMR) != contacts(heavier(10.0))
    assert len(settled) == 4


def test_faults_while_trimming_are_not_logged_for_the_world():
    log = Lines()
    world = MujocoWorld('empty', log=log)
    # No step can carry that; in the world it would be logged as a lost state.
    assert set(contacts(TWO_WHEELS, gravity=1e20).values()) == {WHEEL_CONTACT}
    world.step(10)
    assert log.lines == []
    world.spawn('robot', TWO_WHEELS)
    world.engine.data.qvel[0] = 1e20
    world.step(10)
    assert len(log.lines) >= 1


def turned(urdf):
    """How much of the turn that is told a robot makes, at a steady speed."""
    drive = Drive(urdf)
    wheels = drive.wheels
    drive.command(0.0, 0.5)
    drive.world.step(1500)
    rates = []
    for _ in range(100):
        drive.world.step(10)
        rates.append(drive.robot.velocity('base_footprint')[1][2])
    assert wheels.velocities() == pytest.approx([-2.115, -2.115, 2.115, 2.115], rel=0.01)
    return mean(rates) / 0.5


def test_wheels_that_slip_by_force_turn_a_robot_alike_wherever_its_weight_is():
    """Gazebo's WheelSlip. With equal loads: b / (a² + b²) of the speed of the wheels, ±a, ±b."""
    aside = AMR.replace('<mass value="5.0"/>', '<origin xyz="0.06 -0.06 0"/><mass value="5.0"/>')
    assert aside != AMR
    wheels = ''.join(
        f'<wheel link_name="wheel_{row}_{side}">'
        '<slip_compliance_lateral>1</slip_compliance_lateral></wheel>'
        for row in ('front', 'back')
        for side in ('left', 'right')
    )
    plugin = (
        f'<plugin filename="libgz-sim-wheel-slip-system.so" name="WheelSlip">{wheels}</plugin>'
    )
    slipping = aside.replace('</robot>', f'<gazebo>{plugin}</gazebo></robot>')
    closed = TOLD / 2 * 0.15 / (0.2**2 + 0.15**2)
    # Measured: 1.015, and by each wheel's load 0.9.
    assert turned(slipping) == pytest.approx(closed, rel=0.01)
    assert turned(aside) < 0.95 * closed
