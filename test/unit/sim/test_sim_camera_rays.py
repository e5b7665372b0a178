# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The rays of cameras end where those of MuJoCo end, at all kinds of shapes."""

import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.camera_scenes import camera_of, state_of
from support.examples import examples

from amr_description.model.frames import matrix_from_quaternion, quaternion_from_rpy
from amr_description.model.sensors import Distortion
from amr_description.sim.cameras.ray_caster import Eye, RayCaster
from amr_description.sim.cameras.screen import Screen
from amr_description.sim.state_copy import CopiedScenes

MESH = '<mesh name="mesh" vertex="-1 -1 -1  1 -1 -1  0 1 -1  0 0 1"/>'
FIELD = '<hfield name="field" nrow="3" ncol="3" size="2 2 1 .1" elevation="0 1 0 2 0 1 0 3 1"/>'
KINDS = ('box', 'sphere', 'ellipsoid', 'cylinder', 'capsule', 'plane', 'mesh', 'hfield')
CAMERAS = (camera_of(40, 30), camera_of(40, 30, distortion=Distortion(k1=-0.2, p1=0.01)))

angles = st.floats(-3.0, 3.0)
lengths = st.floats(0.2, 2.0)


@st.composite
def shapes(draw):
    kind = draw(st.sampled_from(KINDS))
    place = [draw(st.floats(-4.0, 4.0)) for _ in range(3)]
    turn = quaternion_from_rpy(*(draw(angles) for _ in range(3)))
    size = [draw(lengths) for _ in range(3)]
    numbers = {'pos': place, 'quat': (turn[3], *turn[:3])}
    named = {'mesh': 'mesh="mesh"', 'hfield': 'hfield="field"'}
    if kind not in named:
        numbers['size'] = size
    words = ' '.join(f'{key}="{" ".join(map(repr, each))}"' for key, each in numbers.items())
    return f'<geom type="{kind}" {words} {named.get(kind, "")}/>'


@examples(25)
@given(st.lists(shapes(), min_size=1, max_size=5), st.tuples(angles, angles, angles))
def test_rays_end_where_those_of_mujoco_end(geoms, rpy):
    state = state_of(''.join(geoms), MESH + FIELD)
    scene = CopiedScenes().scene(state)
    turn = np.array(matrix_from_quaternion(quaternion_from_rpy(*rpy)))
    eye = Eye(np.zeros(3), turn, 100.0, -1, 0.0)
    for camera in CAMERAS:
        screen = Screen.of(camera)
        rays = screen.rays(screen.everywhere).reshape(-1, 3) @ turn.T
        expected = scene.cast(np.zeros(3), rays, normals=True)
        with np.errstate(all='ignore'):
            ends = RayCaster(scene).cast(screen, eye)
            points = rays.reshape(30, 40, 3) * ends.depth[..., np.newaxis]
            normals = ends.normals(scene, points).reshape(-1, 3)
        # MuJoCo's rays also meet surfaces from behind: where one does, ours go on.
        is_behind = np.einsum('ij,ij->i', expected.normals, rays) > 0.0
        distances = np.where(expected.geoms < 0, math.inf, expected.distances)
        depth = ends.depth.ravel()
        assert (depth >= distances - 1e-6)[is_behind].all()
        same = np.isclose(depth, distances, rtol=1e-6, atol=1e-6) | is_behind
        # A ray along an edge may pass it or not.
        assert same.mean() > 0.995
        hit = ~is_behind & (expected.geoms >= 0) & (ends.geoms().ravel() == expected.geoms)
        facing = np.einsum('ij,ij->i', normals[hit], expected.normals[hit])
        assert np.quantile(facing, 0.01) > 0.999 if hit.sum() > 100 else True


def test_what_is_in_no_view_of_the_camera_costs_nothing():
    state = state_of(
        '<geom type="box" size="1 1 1" pos="-5 0 0"/><geom type="sphere" size="1" pos="0 9 0"/>'
        '<geom type="box" size=".1 .1 .1" pos="300 0 0"/>'
    )
    scene = CopiedScenes().scene(state)
    ends = RayCaster(scene).cast(
        Screen.of(CAMERAS[0]), Eye(np.zeros(3), np.eye(3), 100.0, -1, 0.0)
    )
    assert ends.seen == []
    assert np.isinf(ends.depth).all()
    assert (ends.geoms() == -1).all()


@pytest.mark.parametrize('camera', CAMERAS, ids=['pinhole', 'lens'])
def test_an_area_has_all_that_a_box_shows(camera):
    screen = Screen.of(camera)
    rays = screen.rays(screen.everywhere)
    generator = np.random.default_rng(3)
    for _ in range(50):
        middle, half = generator.normal(0.0, 2.0, 3), generator.uniform(0.1, 1.5, 3)
        signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        area = screen.area_of(middle + signs * half)
        inside = np.zeros(screen.shape, bool)
        if area is not None:
            inside[area] = True
        with np.errstate(all='ignore'):
            ends = np.stack(((middle - half) / rays, (middle + half) / rays))
        near, far = ends.min(axis=0).max(axis=-1), ends.max(axis=0).min(axis=-1)
        is_met = (near <= far) & (far > 1e-3)
        assert not (is_met & ~inside).any()
