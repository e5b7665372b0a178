# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a simulated world, by the colours of what is in it."""

import numpy as np
import pytest
from support.paths import ROOT

from amr_description import Simulation
from amr_description.errors import SimulationError
from amr_description.maps.images import read_image
from amr_description.model.frames import Transform
from amr_description.simulation.readings import Image

URDF = ROOT / 'urdf' / 'amr.urdf'
SMALL = {'width': 64, 'height': 48}


@pytest.fixture(scope='module')
def shared():
    with Simulation(
        URDF, robots={'a': Transform(), 'b': Transform((4.0, 0.0, 0.0))}
    ) as simulation:
        yield simulation


@pytest.fixture
def sim(shared):
    shared.reset()
    return shared


def blue(picture):
    """Return rows and columns of what is of the colour of the robots' bodies."""
    red, green, blue = (picture.pixels[:, :, index].astype(int) for index in range(3))
    return np.nonzero((blue > 60) & (red < 30) & (green < 30))


@pytest.mark.parametrize(('width', 'height'), [(240, 180), (60, 240), (240, 60)])
def test_all_robots_are_in_the_picture_whatever_its_shape(sim, width, height):
    rows, columns = blue(sim.picture(width=width, height=height))
    assert min(rows) > 0
    assert max(rows) < height - 1
    assert min(columns) > 0
    assert max(columns) < width - 1
    assert np.ptp(columns) > 0.4 * min(width, height)  # there are two, 4 m apart


def test_who_stands_behind_the_robots_sees_what_is_left_to_the_left(sim):
    from_behind = sim.picture((-3.0, 0.0, 1.0), (0.0, 1.0, 0.0), **SMALL)
    assert min(blue(from_behind)[1]) > 32
    from_above = sim.picture((0.0, 0.0, 3.0), (0.0, 0.0, 0.0), **SMALL)
    rows, columns = blue(from_above)
    assert np.mean(rows) == pytest.approx(23.5, abs=1.0)
    assert np.mean(columns) == pytest.approx(31.5, abs=1.0)


def test_it_is_of_the_present_instant_and_follows_the_robots(sim):
    before = sim.picture(**SMALL)
    fixed = sim.picture((-3.0, 0.0, 1.0), (0.0, 0.0, 0.0), **SMALL)
    sim.drive_all({'a': (0.5, 0.0), 'b': (0.5, 0.0)}, seconds=2, stop=False)
    after = sim.picture((-3.0, 0.0, 1.0), (0.0, 0.0, 0.0), **SMALL)
    assert (before.time, after.time) == (0.0, 2.0)
    assert len(blue(after)[0]) < len(blue(fixed)[0])  # it is farther away
    assert len(blue(sim.picture(**SMALL))[0]) == pytest.approx(len(blue(before)[0]), rel=0.2)


def test_it_is_saved_and_shown_as_a_png(sim, tmp_path):
    picture = sim.picture(**SMALL)
    picture.save(tmp_path / 'a.png')
    data = (tmp_path / 'a.png').read_bytes()
    assert data == picture._repr_png_()
    assert read_image(data).brightness * 255 == pytest.approx(picture.pixels.mean(axis=-1))


def test_depths_are_no_picture(tmp_path):
    depths = Image(0.0, 'camera', np.ones((2, 3), np.float32))
    assert depths._repr_png_() is None
    with pytest.raises(SimulationError, match='depths are in m, and a PNG file has colours'):
        depths.save(tmp_path / 'a.png')


@pytest.mark.parametrize(
    ('where', 'words'),
    [
        (((1, 2, 3), (1, 2, 3)), r'a camera at \(1, 2, 3\) cannot look at \(1, 2, 3\); it takes'),
        (((1, 2),), r'a camera at \(1, 2\) cannot look at'),
        ((None, (1, 2)), r'cannot look at \(1, 2\)'),
        (((1, 2, float('nan')),), r'a camera at \(1, 2, nan\) cannot'),
        (((1, 2, float('inf')), (1, 2, float('inf'))), r'a camera at \(1, 2, inf\) cannot'),
    ],
)
def test_what_is_no_place_is_refused(sim, where, words):
    with pytest.raises(SimulationError, match=words) as refusal:
        sim.picture(*where)
    assert '\n' not in str(refusal.value)


@pytest.mark.parametrize('size', [{'width': 0}, {'height': 8193}])
def test_what_is_no_size_is_refused(sim, size):
    with pytest.raises(SimulationError, match='each side has 1 to 8192'):
        sim.picture(**size)


def test_a_world_without_robots_is_seen_too():
    with Simulation(URDF, robots={}) as empty:
        assert empty.picture(**SMALL).pixels.any()
