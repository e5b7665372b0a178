# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rays into the world: what they meet, and that nothing else is touched."""

import threading

from hypothesis import given, strategies as st
import mujoco
import numpy as np
import pytest
from support.examples import examples

from amr_description.sim.rays import RayScene

_SHAPES = ('box', 'sphere', 'capsule', 'cylinder', 'ellipsoid')


def drawn_world(random):
    """Return a world of bodies that are turned anyhow; some of their geoms touch nothing."""
    bodies = []
    for _ in range(8):
        geoms = []
        for _ in range(random.integers(1, 4)):
            size, at = random.uniform(0.1, 1.5, 3), random.uniform(-2.0, 2.0, 3)
            touches = random.integers(2)
            geoms.append(
                f'<geom type="{random.choice(_SHAPES)}" size="{_words(size)}" pos="{_words(at)}" '
                f'contype="{touches}" conaffinity="{touches}"/>'
            )
        at, turn = random.uniform(-6.0, 6.0, 3), random.normal(size=4)
        free = random.choice(['', '<freejoint/>'])
        bodies.append(
            f'<body pos="{_words(at)}" quat="{_words(turn)}">{free}{"".join(geoms)}'
            '<geom size="0.01"/></body>'
        )
    ground = '<geom type="plane" size="0 0 1" pos="0 0 -7"/>'
    text = f'<mujoco><worldbody>{ground}{"".join(bodies)}</worldbody></mujoco>'
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    return model, data


def _words(numbers):
    return ' '.join(map(str, numbers))


def drawn_rays(random, count=60):
    rays = random.normal(size=(count, 3))
    return random.uniform(-5.0, 5.0, 3), rays / np.linalg.norm(rays, axis=1)[:, None]


@examples(25)
@given(seed=st.integers(0, 2**32 - 1))
def test_all_rays_together_meet_what_each_meets_alone(seed):
    random = np.random.default_rng(seed)
    model, data = drawn_world(random)
    origin, rays = drawn_rays(random)
    alone = [mujoco.mj_ray(model, data, origin, ray, None, True, -1, None) for ray in rays]
    scene = RayScene(model, data)
    assert scene.cast(origin, rays).distances.tolist() == alone
    # The bounds are those of bodies, wherever these are by now.
    data.qpos[:] += 0.3
    mujoco.mj_kinematics(model, data)
    alone = [mujoco.mj_ray(model, data, origin, ray, None, True, -1, None) for ray in rays]
    assert scene.cast(origin, rays).distances.tolist() == alone


def test_the_model_is_left_as_it_is():
    random = np.random.default_rng(0)
    model, data = drawn_world(random)
    groups, bounds = model.geom_group.copy(), model.bvh_aabb.copy()
    scene = RayScene(model, data)
    scene.cast(*drawn_rays(random), mask=scene.mask(without=[0, 3]))
    assert (model.geom_group == groups).all()
    assert (model.bvh_aabb == bounds).all()


def test_masks_say_what_is_met():
    random = np.random.default_rng(1)
    scene = RayScene(*drawn_world(random))
    origin, rays = drawn_rays(random, 500)
    seen = {*scene.cast(origin, rays).geoms.tolist()} - {-1}
    some = sorted(seen)[:3]
    assert {*scene.cast(origin, rays, mask=scene.mask(only=some)).geoms} - {-1} == {*some}
    without = scene.cast(origin, rays, mask=scene.mask(without=some))
    assert not {*without.geoms} & {*some}


def test_normals_point_outwards_and_cutoff_leaves_out_what_is_farther():
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><geom type="box" size="1 1 1"/>'
        '<geom size="1" pos="9 0 0"/></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    scene = RayScene(model, data)
    axes = np.vstack((np.eye(3), -np.eye(3)))
    inside = scene.cast(np.zeros(3), axes, normals=True)
    assert inside.distances.tolist() == [1.0] * 6
    assert (inside.normals == axes).all()
    outside = scene.cast(np.array([4.0, 0.0, 0.0]), axes, normals=True, cutoff=3.5)
    assert outside.distances.tolist() == [-1.0, -1.0, -1.0, 3.0, -1.0, -1.0]
    assert outside.geoms.tolist() == [-1, -1, -1, 0, -1, -1]
    assert outside.normals[3].tolist() == [1.0, 0.0, 0.0]


def test_a_copy_is_cast_at_by_another_thread_while_the_world_goes_on():
    random = np.random.default_rng(2)
    model, data = drawn_world(random)
    scene = RayScene(model, data)
    origin, rays = drawn_rays(random, 2000)
    expected = scene.cast(origin, rays).distances
    copied, found = scene.copy(), []
    thread = threading.Thread(
        target=lambda: found.extend(copied.cast(origin, rays).distances for _ in range(20))
    )
    thread.start()
    while thread.is_alive():
        mujoco.mj_step(model, data)
        scene.cast(origin, rays[:50], mask=scene.mask(without=[1]))
    thread.join()
    assert all((each == expected).all() for each in found)
    assert len(found) == 20
    copied.take(scene)
    assert (copied.cast(origin, rays).distances == scene.cast(origin, rays).distances).all()


FIELD = """
<mujoco><asset><hfield name="field" nrow="{rows}" ncol="{columns}" size="3 2 1.5 0.5"/></asset>
  <worldbody>
    <geom name="field" type="hfield" hfield="field" pos="0.3 -0.2 0.1" euler="5 10 40"/>
    <geom size="0.5" pos="1 0 2"/>
  </worldbody>
</mujoco>
"""


@examples(8)
@given(seed=st.integers(0, 2**32 - 1), rows=st.integers(2, 9), columns=st.integers(2, 9))
def test_a_height_field_is_met_where_mujoco_meets_it(seed, rows, columns):
    random = np.random.default_rng(seed)
    model = mujoco.MjModel.from_xml_string(FIELD.format(rows=rows, columns=columns))
    model.hfield_data[:] = random.uniform(0.0, 1.0, rows * columns)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    scene = RayScene(model, data)
    rays = random.normal(size=(60, 3))
    # From above, from below and from beside it.
    for origin in (random.uniform(2.0, 5.0, 3), random.uniform(-5.0, -2.0, 3)):
        aimed = random.uniform(-1.5, 1.5, (60, 3)) - origin
        for directions in (rays, aimed):
            hits = scene.cast(origin, directions, normals=True)
            geoms, normal = np.empty(1, np.int32), np.empty(3)
            for index, ray in enumerate(directions):
                alone = mujoco.mj_ray(model, data, origin, ray, None, True, -1, geoms, normal)
                assert hits.distances[index] == pytest.approx(alone, abs=1e-5)
                assert hits.geoms[index] == geoms[0]
                assert hits.normals[index] == pytest.approx(normal, abs=1e-4)
