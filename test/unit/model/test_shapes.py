# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Shapes as solids: against MuJoCo, and by laws."""

import math
import random

import mujoco
import pytest

from amr_description.model.frames import dot, Transform, wxyz_from_xyzw
from amr_description.model.robot import Box, Collision, Cylinder, Inertia, Mesh, Sphere
from amr_description.model.shapes import (
    farthest,
    half_sizes,
    moments_along_axes,
    moments_of_solids,
    overlap,
    Solid,
    solids_of,
    volume,
)

DEPTH = 0.002


def some_shape(chance):
    sides = [chance.uniform(0.05, 0.5) for _ in range(3)]
    return chance.choice([Box(tuple(sides)), Cylinder(*sides[:2]), Sphere(sides[0])])


def random_pose(chance, spread=0.4):
    parts = [chance.gauss() for _ in range(4)]
    length = math.hypot(*parts)
    x, y, z = (chance.uniform(-spread, spread) for _ in range(3))
    return Transform((x, y, z), tuple(part / length for part in parts))


def geom(solid, name):
    kind = type(solid.shape).__name__.lower()
    size = half_sizes(solid.shape)
    size = size[1:] if kind == 'cylinder' else size
    place = solid.pose
    attributes = {
        'name': name,
        'type': kind,
        'size': size,
        'pos': place.translation,
        'quat': wxyz_from_xyzw(place.rotation),
    }
    text = (
        f'{key}="{value if isinstance(value, str) else " ".join(map(repr, value))}"'
        for key, value in attributes.items()
    )
    return f'<geom {" ".join(text)} density="1"/>'


def mujoco_model(*solids):
    geoms = ''.join(geom(solid, f'g{index}') for index, solid in enumerate(solids))
    body = f'<body name="b"><freejoint/>{geoms}</body>'
    model = mujoco.MjModel.from_xml_string(f'<mujoco><worldbody>{body}</worldbody></mujoco>')
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.parametrize('seed', range(100))
def test_overlap_is_that_of_mujoco(seed):
    chance = random.Random(seed)
    one, other = (Solid(some_shape(chance), random_pose(chance)) for _ in range(2))
    model, data = mujoco_model(one, other)
    apart = mujoco.mj_geomDistance(model, data, 0, 1, 10.0, None)
    assert overlap(one, other, DEPTH) == overlap(other, one, DEPTH)
    if abs(apart + DEPTH) > DEPTH:  # beside the threshold both are right
        assert overlap(one, other, DEPTH) == (apart < -DEPTH)


@pytest.mark.parametrize('seed', range(50))
def test_moments_of_some_solids_together_are_those_of_mujoco(seed):
    chance = random.Random(seed)
    solids = [
        Solid(some_shape(chance), random_pose(chance)) for _ in range(chance.randrange(1, 4))
    ]
    model, _ = mujoco_model(*solids)
    body = model.body('b')
    mass = float(body.mass[0])
    assert mass == pytest.approx(sum(volume(solid.shape) for solid in solids))
    w, x, y, z = body.iquat
    a, b, c = body.inertia
    theirs = moments_along_axes(Inertia(a, 0, 0, b, 0, c), Transform(rotation=(x, y, z, w)))
    assert moments_of_solids(solids, mass) == pytest.approx(theirs)


@pytest.mark.parametrize('seed', range(30))
def test_farthest_point_is_on_the_shape_and_none_is_farther(seed):
    chance = random.Random(seed)
    solid = Solid(some_shape(chance), random_pose(chance))
    direction = tuple(chance.gauss() for _ in range(3))
    best = dot(farthest(solid, direction), direction)
    x, y, z = half_sizes(solid.shape)
    for _ in range(50):
        other = farthest(solid, tuple(chance.gauss() for _ in range(3)))
        assert dot(other, direction) <= best + 1e-12
        local = solid.pose.inverse().apply(other)
        assert all(abs(a) <= half + 1e-9 for a, half in zip(local, (x, y, z), strict=True))


def test_touching_shapes_do_not_overlap():
    box = Box((0.2, 0.2, 0.2))
    here = Solid(box, Transform())
    assert not overlap(here, Solid(box, Transform((0.2, 0.0, 0.0))), DEPTH)
    assert not overlap(here, Solid(box, Transform((0.199, 0.0, 0.0))), DEPTH)
    assert overlap(here, Solid(box, Transform((0.197, 0.0, 0.0))), DEPTH)
    assert overlap(here, here, DEPTH)


@pytest.mark.parametrize(
    ('shape', 'x'),
    [
        (Mesh('a.stl'), 0.0),
        (Sphere(0.0), 0.0),
        (Sphere(-1.0), 0.0),
        (Sphere(math.nan), 0.0),
        (Sphere(1e300), 0.0),
        (Box((1.0, 1e-300, 1.0)), 0.0),
        (Sphere(1.0), math.nan),
        (Sphere(1.0), 1e300),
    ],
)
def test_shapes_without_size_or_position_are_left_out(shape, x):
    collision = Collision(shape, Transform((x, 0.0, 0.0)), '', 1)
    good = Collision(Sphere(1.0), Transform(), '', 1)
    assert solids_of([collision, good], Transform()) == [Solid(Sphere(1.0), Transform())]
