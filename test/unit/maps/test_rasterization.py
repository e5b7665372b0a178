# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which cells shapes touch, and which are reached."""

from collections import deque

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.examples import examples

from amr_description.maps.rasterization import fill_between, fill_convex, reached
from amr_description.model.planar_hull import planar_hull


def filled(corners, shape=(6, 8)):
    cells = np.zeros(shape, bool)
    fill_convex(cells, np.array(corners, float))
    return cells


def cells_of(mask):
    return {(int(row), int(column)) for row, column in np.argwhere(mask)}


def test_a_shape_that_ends_at_a_border_does_not_touch_what_is_behind():
    for less in (0.0, 1e-7, -1e-7):
        x, y = 1.0 + less, 3.0 - less
        assert cells_of(filled([(x, x), (y, x), (y, y), (x, y)])) == {
            (1, 1), (1, 2), (2, 1), (2, 2),
        }  # fmt: skip


def test_segments_and_points_take_the_cells_that_they_are_in():
    assert cells_of(filled([(2.5, 3.5)])) == {(3, 2)}
    assert cells_of(filled([(2.0, 3.0)])) == {(3, 2)}
    assert cells_of(filled([(2.0, 1.0), (2.0, 4.0)])) == {(1, 2), (2, 2), (3, 2)}
    assert cells_of(filled([(0.5, 0.5), (3.5, 2.0)])) == {(0, 0), (0, 1), (1, 1), (1, 2), (1, 3)}


def test_what_is_outside_of_the_grid_is_left_out():
    assert filled([(-9, -9), (99, -9), (99, 99), (-9, 99)]).all()
    for corners in ([(-5, 1), (-1, 2)], [(9, 1), (12, 2)], [(1, -5), (2, -1)], [(1, 7), (2, 9)]):
        assert not filled(corners).any()


@examples(60)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_cell_is_set_if_and_only_if_the_shape_touches_it(seed):
    random = np.random.default_rng(seed)
    corners = planar_hull(random.uniform(-2.0, 10.0, (random.integers(1, 7), 2)))
    mask = filled(corners)
    # Points of the shape lie in cells that are set ...
    weights = random.dirichlet(np.ones(len(corners)), 200)
    for x, y in weights @ corners:
        if 0 <= x < 8 and 0 <= y < 6:
            assert mask[int(y), int(x)]
    # ... and a line between the shape and a cell that is not set separates them.
    for row in range(6):
        for column in range(8):
            square = np.array([(column + i, row + j) for i in (0, 1) for j in (0, 1)], float)
            assert mask[row, column] != is_separated(corners, square)


def is_separated(one, other):
    """By the theorem of the separating axis; shapes that are apart by less than 1e-4 are not."""
    edges = [
        after - corner
        for shape in (one, planar_hull(other))
        for corner, after in zip(shape, np.roll(shape, -1, axis=0), strict=True)
    ]
    axes = [np.array([-y, x]) / np.hypot(x, y) for x, y in edges if np.hypot(x, y) > 0]
    if len(one) <= 2:
        axes += [np.array(each) for each in ((1.0, 0.0), (0.0, 1.0))]
        axes += [edge / np.linalg.norm(edge) for edge in edges if edge.any()]
    return any(
        (one @ axis).max() < (other @ axis).min() + 1e-5
        or (other @ axis).max() < (one @ axis).min() + 1e-5
        for axis in axes
    )


def test_what_is_inside_of_curves_is_filled():
    square = [(1, 1), (7, 1), (7, 5), (1, 5)]
    hole = [(3, 2), (3, 4), (5, 4), (5, 2)]
    segments = [(ring[i], ring[(i + 1) % 4]) for ring in (square, hole) for i in range(4)]
    cells = np.zeros((6, 8), bool)
    fill_between(cells, np.array(segments, float))
    expected = np.zeros((6, 8), bool)
    expected[1:5, 1:7] = True
    expected[2:4, 3:5] = False
    assert (cells == expected).all()
    fill_between(cells, np.empty((0, 2, 2)))
    assert (cells == expected).all()


@examples(30)
@given(seed=st.integers(0, 2**32 - 1))
def test_what_is_reached_is_what_steps_to_the_sides_reach(seed):
    random = np.random.default_rng(seed)
    free = random.random((random.integers(1, 25), random.integers(1, 25))) < random.uniform(
        0.4, 0.9
    )
    start = tuple(int(random.integers(0, size)) for size in free.shape)
    expected = np.zeros_like(free)
    queue = deque([start] if free[start] else [])
    while queue:
        row, column = queue.popleft()
        if not (0 <= row < free.shape[0] and 0 <= column < free.shape[1]):
            continue
        if free[row, column] and not expected[row, column]:
            expected[row, column] = True
            queue += [(row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)]
    assert (reached(free, [start]) == expected).all()


@pytest.mark.parametrize(
    ('points', 'corners'),
    [
        ([(0, 0), (2, 0), (2, 1), (0, 1), (1, 0.5), (1, 0)], [(0, 0), (2, 0), (2, 1), (0, 1)]),
        ([(1, 1), (0, 0), (2, 2)], [(0, 0), (2, 2)]),
        ([(1, 1), (1, 1)], [(1, 1)]),
    ],
)
def test_hulls_go_round_without_points_on_their_edges(points, corners):
    assert planar_hull(np.array(points, float)).tolist() == [list(map(float, c)) for c in corners]
