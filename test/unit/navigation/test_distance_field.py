# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The exact Euclidean distance transform, against every pair of cells."""

import numpy as np
from numpy.typing import NDArray
import pytest

from amr_description.navigation import distance_field
from amr_description.navigation.distance_field import distances


def by_every_pair(occupied: NDArray[np.bool_], resolution: float) -> NDArray[np.float64]:
    rows, columns = np.indices(occupied.shape)
    found = np.full(occupied.shape, np.inf)
    for row, column in np.argwhere(occupied):
        np.minimum(found, np.sqrt((rows - row) ** 2 + (columns - column) ** 2), out=found)
    return resolution * found


@pytest.mark.parametrize('share', [0.002, 0.02, 0.3, 0.9])
@pytest.mark.parametrize('shape', [(1, 1), (1, 37), (37, 1), (23, 64), (64, 23), (33, 65), (2, 3)])
def test_it_is_the_distance_to_the_nearest_of_all_occupied_cells(shape, share):
    random = np.random.default_rng(round(1000 * share) + 7 * shape[0] + shape[1])
    occupied = random.random(shape) < share
    occupied[random.integers(shape[0]), random.integers(shape[1])] = True
    np.testing.assert_allclose(
        distances(occupied, 0.05), by_every_pair(occupied, 0.05), rtol=1e-12
    )


def test_one_occupied_cell_is_as_far_as_its_middle():
    occupied = np.zeros((5, 9), dtype=np.bool_)
    occupied[1, 2] = True
    found = distances(occupied, 0.5)
    assert found[1, 2] == 0.0
    assert found[4, 6] == 0.5 * 5.0
    assert found[0, 2] == found[1, 3] == 0.5


def test_nothing_is_near_where_nothing_is_occupied():
    assert np.isinf(distances(np.zeros((3, 4), dtype=np.bool_), 0.05)).all()


def test_a_large_map_is_made_in_blocks_of_rows_that_fit_together(monkeypatch):
    occupied = np.random.default_rng(5).random((50, 40)) < 0.01
    whole = distances(occupied, 0.05)
    monkeypatch.setattr(distance_field, '_CELLS_AT_ONCE', 3 * 40)
    np.testing.assert_array_equal(distances(occupied, 0.05), whole)
