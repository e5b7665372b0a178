# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The friction that a URDF made for Gazebo gives its links."""

from statistics import mean

from fixtures.sim.driving import AMR, ROOT
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

LOAD = 9.81 * (4 * 0.02 + 0.1 * 0.14) / 0.14
"""N on the caster: moments about the axle, chassis 0.02 m and caster 0.14 m behind it."""
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
    assert mean(efforts) == pytest.approx(-friction * LOAD * 0.05, rel=0.02, abs=1e-4)


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


SKID = TWO_WHEELS.replace(
    '<geometry><sphere radius="0.025"/>',
    '<origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.025" length="0.04"/>',
)


@pytest.mark.parametrize('ground', [1.0, 0.5])
@pytest.mark.parametrize('own, counts', [(None, 1.0), (0.5, 0.5), (0.1, 0.1), (30.0, 1.0)])
def test_a_skid_drags_with_the_smaller_friction_and_the_wheels_roll(ground, own, counts):
    """As Coulomb has it: with less drag than the wheels can pull, they do not slip."""
    world = MujocoWorld('empty', settings=WorldSettings(friction=ground))
    robot = world.spawn('robot', SKID if own is None else with_friction(SKID, caster=own))
    wheels = robot.joints(['left', 'right'])
    for tick in range(100):
        wheels.command('velocity', [6.0 * min(1.0, tick / 50)] * 2)
        world.step(5)
    start, rolled = robot.pose('base_link').translation[0], sum(wheels.positions())
    efforts = []
    for _ in range(50):
        world.step(5)
        efforts.append(sum(wheels.efforts()))
    way = robot.pose('base_link').translation[0] - start
    assert way == pytest.approx((sum(wheels.positions()) - rolled) / 2 * 0.05, rel=0.002)
    assert mean(efforts) == pytest.approx(min(ground, counts) * LOAD * 0.05, rel=0.02)


SLED = """<robot name="sled"><link name="base_link">
<inertial><mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<collision><geometry><box size="1 1 0.02"/></geometry></collision></link></robot>"""


@pytest.mark.parametrize(
    'own, ground, counts', [(None, 0.5, 0.5), (0.8, 0.5, 0.5), (0.2, 0.5, 0.2), (None, 1.5, 1.0)]
)
def test_the_smaller_friction_counts_without_wheels_too(own, ground, counts):
    world = MujocoWorld('empty', settings=WorldSettings(friction=ground, gravity=10.0))
    urdf = SLED if own is None else with_friction(SLED, base_link=own)
    world.spawn('sled', urdf, Transform((0.0, 0.0, 0.011)))
    model = world.engine.model
    contact = model.geom('ground'), model.geom(model.ngeom - 1)
    first = max(contact, key=lambda geom: geom.priority)
    assert first.friction[0] == pytest.approx(counts)
    assert contact[0].priority != contact[1].priority
