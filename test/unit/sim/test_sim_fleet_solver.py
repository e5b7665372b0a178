# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Many robots: each step as a dense Jacobian solves it, faster where that is the same."""

import math

from fixtures.sim.driving import AMR, LEFT, RIGHT
from fixtures.sim.mecanum import mecanum
from fixtures.sim.scenario import ARM
import mujoco
import numpy as np
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.fleet_solver import _Neighbours, FEWEST
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

_STATE = mujoco.mjtState.mjSTATE_INTEGRATION
_DENSE, _SPARSE = mujoco.mjtJacobian.mjJAC_DENSE, mujoco.mjtJacobian.mjJAC_SPARSE
_NO_ISLANDS = int(mujoco.mjtDisableBit.mjDSBL_ISLAND)


def facing(x, y, yaw):
    return Transform((x, y, 0.0), (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)))


def ring(count, radius):
    """Places on a circle, each facing its centre, nearly."""
    for angle in (math.tau * number / count for number in range(count)):
        yield facing(radius * math.cos(angle), radius * math.sin(angle), angle + math.pi + 0.1)


def fleet(places, urdf=AMR, wheels=(*LEFT, *RIGHT), world='empty', **options):
    """A world with a robot at each place, and their wheels."""
    world = MujocoWorld(world, **options)
    robots = [world.spawn(f'robot{n}', urdf, place, lift=True) for n, place in enumerate(places)]
    return world, [robot.joints(list(wheels)) for robot in robots]


class Plain:
    """One step from the state of a world by the plain way: dense, in islands."""

    def __init__(self, world):
        self.model = world.engine.spec.compile()
        self.model.opt.timestep = world.engine.model.opt.timestep
        assert self.model.opt.jacobian == _DENSE
        assert not int(self.model.opt.disableflags) & _NO_ISLANDS
        self.data = mujoco.MjData(self.model)
        self._state = np.empty(mujoco.mj_stateSize(self.model, _STATE))

    def speeds(self, data):
        """qvel after a step from the state of ``data``."""
        mujoco.mj_getState(self.model, data, self._state, _STATE)
        mujoco.mj_setState(self.model, self.data, self._state, _STATE)
        mujoco.mj_step(self.model, self.data)
        return self.data.qvel.copy()


@pytest.mark.parametrize('count', [1, FEWEST - 1])
def test_a_few_robots_are_solved_for_as_the_world_says(count):
    world, _ = fleet(ring(count, 3.0))
    option = world.engine.model.opt
    flags = world.engine.spec.option.disableflags
    world.step(10)
    assert (option.jacobian, option.disableflags) == (_DENSE, flags)


def test_it_is_dense_again_when_one_leaves():
    world, _ = fleet(ring(FEWEST, 3.0))
    assert world.engine.model.opt.jacobian == _SPARSE
    world.remove('robot0')
    assert world.engine.model.opt.jacobian == _DENSE


def test_at_rest_all_are_solved_for_together_and_in_a_hurry_one_by_one():
    world, wheels = fleet(ring(FEWEST, 3.0))
    world.step(500)
    assert world.engine.data.nisland == 0
    for number, each in enumerate(wheels):
        each.command('velocity', [9.0, -9.0, float(number), 3.0])
    world.step(20)
    assert world.engine.data.nisland == FEWEST


def test_a_crowd_moves_as_with_the_plain_way():
    """To the last bit in steps in which robots touch; else but for the order of additions."""
    world, wheels = fleet(ring(6, 0.75))
    plain, data = Plain(world), world.engine.data
    apart = touching = 0
    for tick in range(240):
        if tick % 60 == 0:
            for number, each in enumerate(wheels):
                each.command('velocity', [6.0 + number % 3, 7.0, 6.0, 5.0 + tick // 60])
        expected = plain.speeds(data)
        iterations = plain.data.solver_niter[: plain.data.nisland].max()
        world.step(1)
        trees = world.engine.model.body_treeid[world.engine.model.geom_bodyid[data.contact.geom]]
        if any(one != other for one, other in trees.tolist() if min(one, other) >= 0):
            touching += 1
            assert data.qvel.tobytes() == expected.tobytes()
        else:
            apart += 1
            # Together, all robots stop at the tolerance of the worst: measured 5e-6.
            assert np.abs(data.qvel - expected).max() < (1e-9 if iterations <= 1 else 1e-4)
        world.step(4)
    assert (apart > 30, touching > 30) == (True, True)


def test_mecanum_wheels_of_many_robots_have_their_rollers():
    """A robot of many moves as one that is alone."""
    names = [f'{end}_{side}_joint' for end in ('front', 'rear') for side in ('left', 'right')]
    tracks = []
    for count in (1, FEWEST):
        world, wheels = fleet(list(ring(FEWEST, 2.0))[:count], mecanum(), names)
        wheels[0].command('velocity', [-4.0, 4.0, 4.0, -4.0])
        world.step(400)
        tracks.append(world.robot('robot0').pose('base_link').translation)
    assert math.dist(tracks[0][:2], (2.0, 0.0)) > 0.1
    assert math.dist(*tracks) < 1e-9


@pytest.mark.parametrize('counts', [(1,), (7, 5)])
def test_what_is_chosen_does_not_depend_on_how_steps_are_handed_over(counts):
    states = []
    for parts in ((5,), counts):
        world, wheels = fleet(ring(FEWEST, 0.7))
        for each in wheels:
            each.command('velocity', [5.0, 5.0, 5.5, 5.5])
        for _ in range(240 // sum(parts)):
            for part in parts:
                world.step(part)
        states.append(world.state())
    assert states[0] == states[1]


def test_after_a_reset_it_chooses_as_at_first():
    world, wheels = fleet(ring(FEWEST, 0.7))

    def run():
        world.reset()
        for each in wheels:
            each.command('velocity', [5.0, 5.0, 5.5, 5.5])
        world.step(93)
        return world.state()

    assert run() == run()


def test_what_a_world_or_a_user_asks_for_is_kept(tmp_path):
    cases = {
        '<option jacobian="sparse"/>': WorldSettings(),
        '<option integrator="RK4"/>': WorldSettings(),
        '': WorldSettings(solver='CG'),
        '<equality><connect body1="one" body2="two" anchor="0 0 0"/></equality>': WorldSettings(),
    }
    for text, settings in cases.items():
        path = tmp_path / 'world.xml'
        path.write_text(
            f"""<mujoco>{text}<worldbody><geom type="plane" size="0 0 1"/>
            <body name="one" pos="9 0 1"><freejoint/><geom size=".1"/></body>
            <body name="two" pos="9 1 1"><freejoint/><geom size=".1"/></body>
            </worldbody></mujoco>"""
        )
        world, _ = fleet(ring(FEWEST, 3.0), world=str(path), settings=settings)
        option = world.engine.model.opt
        before = option.jacobian, option.disableflags
        world.step(20)
        assert (option.jacobian, option.disableflags) == before
        assert option.disableflags == world.engine.spec.option.disableflags


LIFT = """<robot name="lift"><link name="base"/>
  <link name="mast"><collision><origin xyz="0.1 0 0"/><geometry><box size=".1 .1 1"/></geometry>
    </collision><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"
    iyz="0"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="mast"/>
    <origin xyz="0 .2 .3"/><axis xyz="0 0 1"/>
    <limit lower="-.5" upper="2" effort="1" velocity="1"/></joint>
</robot>"""
FIXED = LIFT.replace('"base"', '"world"')


@pytest.mark.parametrize(
    'urdf', [AMR, mecanum(), LIFT, FIXED], ids=['amr', 'mecanum', 'lift', 'fixed']
)
def test_every_geom_stays_in_the_sphere_of_its_robot(urdf):
    """Wherever the joints are: two whose spheres are apart do not touch."""
    world, _ = fleet(ring(1, 2.0), urdf, wheels=())
    model, data = world.engine.model, mujoco.MjData(world.engine.model)
    neighbours = _Neighbours(model)
    random = np.random.default_rng(5)
    limited = model.jnt_limited.astype(bool)
    farthest = np.zeros(model.ntree)
    for _ in range(200):
        data.qpos[:] = model.qpos0
        for joint, address in enumerate(model.jnt_qposadr.tolist()):
            if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
                data.qpos[address + 3 : address + 7] = random.normal(size=4)
            else:
                low, high = model.jnt_range[joint] if limited[joint] else (-3.2, 3.2)
                data.qpos[address] = random.uniform(low, high)
        mujoco.mj_kinematics(model, data)
        centres = neighbours.centres(data)
        for geom, body in enumerate(model.geom_bodyid.tolist()):
            tree = model.body_treeid[body]
            if model.geom_contype[geom] and tree >= 0:
                distance = np.linalg.norm(data.geom_xpos[geom] - centres[tree])
                farthest[tree] = max(farthest[tree], distance + model.geom_rbound[geom])
    assert (farthest <= neighbours.reaches + 1e-9).all()
    assert (neighbours.reaches < 3.0 * farthest).all()


def test_robots_without_collision_are_near_nothing():
    world, _ = fleet([Transform((0.0, 0.0, 0.0))] * 2, ARM, wheels=())
    assert not _Neighbours(world.engine.model).are_near(world.engine.data)


def test_a_joint_without_end_reaches_everywhere():
    world, _ = fleet(ring(2, 50.0))
    neighbours = _Neighbours(world.engine.model)
    assert not neighbours.are_near(world.engine.data)
    spec = world.engine.spec
    spec.body('robot0/wheel_front_left').add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE)
    model = spec.compile()
    assert _Neighbours(model).are_near(mujoco.MjData(model))
