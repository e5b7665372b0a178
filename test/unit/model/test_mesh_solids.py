# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Volume, mass, inertia and hull of meshes against closed forms and laws."""

import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.mesh_files import box, FACES

from amr_description.errors import MeshError
from amr_description.model.frames import Transform
from amr_description.model.mesh_solids import (
    count_edges,
    Edges,
    hull_ratio,
    hull_volume,
    joined,
    solid_mesh,
    solid_primitive,
)
from amr_description.model.meshes import TriangleMesh
from amr_description.model.robot import Box, Cylinder, Sphere
from amr_description.model.shapes import Solid


def mesh_of(vertices, faces=FACES):
    return TriangleMesh(np.array(vertices, float), np.array(faces, np.int64))


def body_of(mesh, pose=None):
    return solid_mesh(mesh, pose or Transform(), 'mesh')


def ball(radius, rings=48):
    """A sphere of triangles, the same round its axis; its corners lie on the sphere."""
    points, faces = [(0.0, 0.0, radius), (0.0, 0.0, -radius)], []
    for i in range(1, rings):
        theta = math.pi * i / rings
        for j in range(2 * rings):
            phi = math.pi * j / rings
            r = radius * math.sin(theta)
            points.append((r * math.cos(phi), r * math.sin(phi), radius * math.cos(theta)))
    n = 2 * rings
    for j in range(n):
        k = (j + 1) % n
        faces.append((0, 2 + j, 2 + k))
        faces.append((1, 2 + (rings - 2) * n + k, 2 + (rings - 2) * n + j))
        for i in range(rings - 2):
            a, b = 2 + i * n + j, 2 + i * n + k
            faces += [(a, a + n, b + n), (a, b + n, b)]
    return mesh_of(points, faces)


def tetrahedron():
    """The corner of a unit cube: x + y + z <= 1."""
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    return mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], faces)


def soup(mesh):
    """The same triangles with corners of their own, as STL has them."""
    corners = mesh.vertices[mesh.faces].reshape(-1, 3)
    return mesh_of(corners, np.arange(len(corners)).reshape(-1, 3))


def test_a_box_weighs_what_a_box_weighs():
    a, b, c = size = (0.2, 0.4, 0.6)
    found = joined([body_of(soup(mesh_of(box(size, (1.0, 2.0, 3.0)))))], density=1000.0)
    assert found.mass == pytest.approx(48.0)
    assert found.center == pytest.approx((1.0, 2.0, 3.0))
    inertia = found.inertia
    assert inertia.ixx == pytest.approx(48.0 * (b * b + c * c) / 12.0)
    assert inertia.iyy == pytest.approx(48.0 * (a * a + c * c) / 12.0)
    assert inertia.izz == pytest.approx(48.0 * (a * a + b * b) / 12.0)
    assert (inertia.ixy, inertia.ixz, inertia.iyz) == pytest.approx((0, 0, 0), abs=1e-12)


def test_a_tetrahedron_has_its_closed_form():
    # Integrals of 1, x, x², xy over x + y + z <= 1: 1/6, 1/24, 1/60, 1/120.
    body = body_of(tetrahedron())
    assert body.volume == pytest.approx(1.0 / 6.0)
    assert body.center == pytest.approx([0.25] * 3)
    diagonal = 2.0 * (1.0 / 60.0 - 1.0 / 96.0)
    across = -(1.0 / 120.0 - 1.0 / 96.0)
    assert body.inertia == pytest.approx(across + (diagonal - across) * np.eye(3))


def test_a_ball_of_triangles_nears_the_ball():
    body = body_of(ball(0.5))
    volume = 4.0 / 3.0 * math.pi * 0.125
    assert body.volume == pytest.approx(volume, rel=4e-3) and body.volume < volume
    assert body.inertia == pytest.approx(0.4 * volume * 0.25 * np.eye(3), rel=1e-2, abs=1e-9)


finite = st.floats(-10.0, 10.0)
poses = st.builds(
    Transform.from_xyz_rpy, st.tuples(finite, finite, finite), st.tuples(finite, finite, finite)
)


@given(poses)
def test_a_moved_body_weighs_the_same_and_turns_the_same(pose):
    # A tetrahedron with three different moments.
    mesh = mesh_of(tetrahedron().vertices * (0.3, 0.5, 0.9), tetrahedron().faces)
    still, moved = body_of(mesh), body_of(mesh, pose)
    assert moved.volume == pytest.approx(still.volume)
    assert moved.center == pytest.approx(pose.apply(tuple(still.center)), abs=1e-9)
    expected = np.linalg.eigvalsh(still.inertia)
    assert np.linalg.eigvalsh(moved.inertia) == pytest.approx(expected, rel=1e-6)


@given(st.floats(1e-3, 1e3))
def test_volume_grows_with_the_third_power_and_inertia_with_the_fifth(scale):
    one, other = tetrahedron(), mesh_of(tetrahedron().vertices * scale, tetrahedron().faces)
    assert body_of(other).volume == pytest.approx(scale**3 * body_of(one).volume)
    assert body_of(other).inertia == pytest.approx(scale**5 * body_of(one).inertia)
    assert count_edges(other) == count_edges(one)
    assert hull_ratio(other) == pytest.approx(1.0)


def test_a_mesh_far_from_its_origin_keeps_its_digits():
    near, far = body_of(mesh_of(box((0.1, 0.2, 0.3)))), mesh_of(box((0.1, 0.2, 0.3), (1e4, 0, 0)))
    assert body_of(far).inertia == pytest.approx(near.inertia, rel=1e-6, abs=1e-12)


def test_a_mesh_inside_out_weighs_the_same():
    mesh = mesh_of(box((1, 2, 3)), [face[::-1] for face in FACES])
    assert body_of(mesh).volume == pytest.approx(6.0)
    assert body_of(mesh).inertia == pytest.approx(body_of(mesh_of(box((1, 2, 3)))).inertia)


def test_primitives_and_meshes_are_joined_about_their_common_centre():
    # Two halves of a box, one of them a mesh, are the box.
    half = solid_primitive(Solid(Box((1.0, 1.0, 1.0)), Transform((0.5, 0.0, 0.0))))
    other = body_of(mesh_of(box((1.0, 1.0, 1.0))), Transform((-0.5, 0.0, 0.0)))
    found = joined([half, other], density=3.0)
    assert (found.mass, found.center) == (pytest.approx(6.0), pytest.approx((0, 0, 0)))
    assert found.inertia.ixx == pytest.approx(1.0)
    assert found.inertia.iyy == pytest.approx(6.0 * (4.0 + 1.0) / 12.0)


@pytest.mark.parametrize(
    'shape, moments',
    [
        (Sphere(0.5), [math.pi / 6 * 0.1] * 3),
        (Cylinder(1.0, 2.0), [2 * math.pi * 7 / 12, 2 * math.pi * 7 / 12, math.pi]),
    ],
)
def test_a_turned_primitive_has_its_moments(shape, moments):
    pose = Transform.from_xyz_rpy((1, 2, 3), (0.3, -0.4, 1.0))
    body = solid_primitive(Solid(shape, pose))
    assert sorted(np.linalg.eigvalsh(body.inertia)) == pytest.approx(sorted(moments))


@pytest.mark.parametrize('number', [1, 2])
def test_a_hole_is_counted(number):
    mesh = soup(mesh_of(box((1, 1, 1)), FACES[number:]))
    open_edges = {1: 3, 2: 4}[number]
    total = {1: 18, 2: 17}[number]
    assert count_edges(mesh) == Edges(open_edges, total)
    with pytest.raises(MeshError, match=f'not closed.*: {open_edges} of its {total} edges'):
        body_of(mesh)


def test_a_triangle_that_faces_the_other_way_opens_a_mesh():
    assert count_edges(mesh_of(box((1, 1, 1)), [FACES[0][::-1], *FACES[1:]])) == Edges(3, 18)


def test_a_flat_mesh_has_no_volume():
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 1)])
    assert count_edges(mesh).open == 0
    with pytest.raises(MeshError, match='encloses no volume'):
        body_of(mesh)
    assert hull_ratio(mesh) == math.inf


def test_the_hull_of_a_convex_shape_is_the_shape():
    assert hull_ratio(mesh_of(box((1e-3, 1.0, 5.0)))) == pytest.approx(1.0)
    assert hull_ratio(tetrahedron()) == pytest.approx(1.0)
    assert hull_ratio(ball(0.5)) == pytest.approx(1.0, abs=0.02)


def test_the_hull_of_two_boxes_includes_the_space_between_them():
    apart = box((1, 1, 1)) + box((1, 1, 1), (9.0, 0.0, 0.0))
    faces = FACES + [tuple(i + 8 for i in face) for face in FACES]
    assert hull_ratio(mesh_of(apart, faces)) == pytest.approx(5.0)


@given(st.lists(st.tuples(finite, finite, finite), min_size=1, max_size=40))
def test_a_hull_is_no_larger_than_the_box_and_no_smaller_than_any_tetrahedron(points):
    points = np.array(points)
    volume = hull_volume(points)
    size = points.max(axis=0) - points.min(axis=0)
    assert 0.0 <= volume <= np.prod(size) * (1.0 + 1e-9)
    for a, b, c, d in zip(points, points[1:], points[2:], points[3:], strict=False):
        inner = abs(np.linalg.det(np.array([b - a, c - a, d - a]))) / 6.0
        assert volume >= inner * 0.999 - 1e-6


@given(st.integers(0, 2**32 - 1))
def test_points_within_do_not_change_a_hull(seed):
    inside = np.random.default_rng(seed).uniform(-0.5, 0.5, (200, 3))
    assert hull_volume(np.vstack((box((1, 1, 1)), inside))) == pytest.approx(1.0)
