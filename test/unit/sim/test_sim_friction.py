# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The friction that a URDF made for Gazebo gives its links."""

from statistics import mean

from fixtures.sim.driving import AMR, Lines, ROOT
import pytest

from amr_description.sim.friction import link_frictions
from amr_description.sim.spawning import read_description
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

TWO_WHEELS = (ROOT / 'test' / 'fixtures' / 'sim' / 'two_wheels.urdf').read_text()


def with_friction(urdf, **frictions):
    blocks = ''.join(
        f'<gazebo reference="{link}"><mu1>{mu}</mu1><mu2>{mu}</mu2></gazebo>'
        for link, mu in frictions.items()
    )
    return urdf.replace('</robot>', f'{blocks}</robot>')


@pytest.mark.parametrize('friction', [1.0, 0.5, 0.01])
def test_a_caster_drags_with_its_own_friction(friction):
    world = MujocoWorld('empty')
    robot = world.spawn('robot', with_friction(TWO_WHEELS, caster=friction))
    wheels = robot.joints(['left', 'right'])
    for tick in range(300):
        # Within 1.5 s, or it would rear up.
        wheels.command('velocity', [-10.0 * min(1.0, tick / 150)] * 2)
        world.step(5)
    efforts = []
    for _ in range(100):
        world.step(5)
        efforts.append(sum(wheels.efforts()))
    # Moments about the axle: chassis of 4 kg 0.02 m behind, caster of 0.1 kg 0.14 m behind.
    load = 9.81 * (4 * 0.02 + 0.1 * 0.14) / 0.14
    assert mean(efforts) == pytest.approx(-friction * load * 0.05, rel=0.02, abs=1e-4)


@pytest.mark.parametrize('wheels, ground, counts', [(0.2, 1.0, 0.2), (50.0, 0.3, 0.3)])
def test_the_smaller_friction_of_the_two_counts(wheels, ground, counts):
    names = [f'wheel_{a}_{b}' for a in ('front', 'back') for b in ('left', 'right')]
    world = MujocoWorld('empty', settings=WorldSettings(friction=ground))
    robot = world.spawn('amr', with_friction(AMR, **dict.fromkeys(names, wheels)))
    joints = robot.joints([f'joint_{name}' for name in names])
    joints.command('velocity', [10.0] * 4)
    world.step(1500)
    joints.command('velocity', [-10.0] * 4)
    world.step(25)
    before = robot.velocity('base_footprint')[0][0]
    world.step(50)
    after = robot.velocity('base_footprint')[0][0]
    # It slides: a = µ g, for 0.1 s.
    assert before - after == pytest.approx(counts * 9.81 * 0.1, rel=0.02)


def test_a_friction_that_is_no_number_is_logged_and_ignored():
    log = Lines()
    bad = with_friction(AMR, base_link='smooth', wheel_front_left=-1, nobody=0.5)
    assert link_frictions(read_description(bad, 'amr.urdf'), log) == {}
    assert '<mu1> of link "base_link" is "smooth"; a number from 0 on is needed' in log.text
    assert '<mu1> of link "wheel_front_left" is "-1"' in log.text


def test_the_form_of_sdf_is_read_too():
    inside = (
        '<collision><surface><friction><ode><mu>0.3</mu></ode></friction></surface></collision>'
    )
    urdf = AMR.replace('</robot>', f'<gazebo reference="base_link">{inside}</gazebo></robot>')
    assert link_frictions(read_description(urdf, 'amr'), Lines()) == {'base_link': 0.3}
