# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Pictures by the renderer that this machine has: OpenGL, or else rays.

They are those of rays within what OpenGL's rounding allows: it draws at the centres of pixels as
rays look through them, with depths of 32 bits.
"""

import math

import numpy as np
import pytest
from support.camera_scenes import camera_of, state_of, take

from amr_description.errors import RenderingError
from amr_description.log import Severity
from amr_description.model.frames import quaternion_from_rpy, Transform
from amr_description.model.sensors import Distortion, Intrinsics
from amr_description.sim.cameras.choice import ChosenRenderer
from amr_description.sim.cameras.ray_renderer import RayRenderer

SHAPES = """
    <geom type="plane" size="0 0 1" pos="0 0 -1" rgba=".8 .8 .8 1"/>
    <geom type="box" size=".5 .5 .5" pos="4 1 0" rgba="1 0 0 1"/>
    <geom type="box" size=".5 .3 .6" euler="10 20 30" pos="3 -1 0" rgba="0 0 1 1"/>
    <geom type="box" size="9 9 9" pos="0 0 0" rgba="0 0 0 0"/>
    <geom type="box" size="5 5 .1" pos="8 0 2" material="checker"/>
    <body name="amr/link">
      <geom type="cylinder" size=".2 .3" pos="2 0 -.6" group="1" rgba="0 1 0 1"/>
      <geom type="cylinder" size=".5 .9" pos="2 0 -.6"/>
    </body>
"""
CHECKER = (
    '<texture name="checker" type="2d" builtin="checker" rgb1="1 1 1" rgb2="0 0 0" width="64" '
    'height="64"/><material name="checker" texture="checker" texrepeat="1 1" texuniform="true"/>'
)
# Without highlights, which rays leave out.
DULL = '<visual><headlight specular="0 0 0"/></visual>'


@pytest.fixture(scope='module')
def lines():
    return []


@pytest.fixture(scope='module')
def renderer(lines):
    renderer = ChosenRenderer('auto', lambda severity, text, **_: lines.append((severity, text)))
    yield renderer
    renderer.close()


@pytest.mark.parametrize(
    'camera',
    [
        camera_of(160, 120, far=30.0, depth_far=30.0),
        camera_of(160, 120, intrinsics=Intrinsics(150.0, 100.0, 70.0, 65.0)),
        camera_of(160, 120, distortion=Distortion(k1=-0.1, k2=0.01, p1=0.01)),
    ],
    ids=['pinhole', 'matrix', 'lens'],
)
def test_pictures_are_those_of_rays(renderer, lines, camera):
    state = state_of(SHAPES, CHECKER, DULL, robots=['amr'])
    pose = Transform((0.1, 0.2, 0.3), quaternion_from_rpy(0.1, 0.15, -0.1))
    found, expected = (take(each, camera, state, pose) for each in (renderer, RayRenderer()))
    assert len(lines) == 1
    assert lines[0][0] == Severity.INFO
    # But for pixels at edges, which show the one or the other.
    both = np.isfinite(found.depth) & np.isfinite(expected.depth)
    assert both.mean() > 0.3
    assert (np.isfinite(found.depth) == np.isfinite(expected.depth)).mean() > 0.98
    # A lens takes the nearest pixel of a pinhole's picture.
    limit = 1e-3 if camera.distortion.is_none else 5e-2
    difference = np.abs(found.depth[both] - expected.depth[both]) / expected.depth[both]
    assert np.quantile(difference, 0.95) < limit
    difference = np.abs(found.color.astype(int) - expected.color).max(axis=-1)
    assert np.quantile(difference, 0.9) <= 10


def test_a_picture_is_the_same_each_time(renderer):
    state = state_of(SHAPES, CHECKER)
    first, second = (take(renderer, camera_of(), state) for _ in range(2))
    assert first.color.tobytes() == second.color.tobytes()
    assert first.depth.tobytes() == second.depth.tobytes()


def test_worlds_and_sizes_may_change(renderer):
    for number in range(3):
        pose = f'pos="{2 + number} 0 0"'
        state = state_of(f'<geom type="box" size=".5 5 5" {pose}/>')
        for size in (40, 120):
            camera = camera_of(size, size)
            depth = take(renderer, camera, state, color=False).depth
            assert depth == pytest.approx(1.5 + number, abs=1e-3)


def test_a_camera_without_a_near_and_a_far_plane_sees(renderer):
    camera = camera_of(near=0.0, far=math.inf, depth_near=0.0, depth_far=math.inf)
    picture = take(renderer, camera, state_of('<geom type="box" size="1 9 9" pos="5 0 0"/>'))
    assert picture.depth == pytest.approx(4.0, abs=1e-3)
    assert len({*picture.color[30, 40]}) == 1


def test_where_opengl_is_not_there_rays_make_the_pictures():
    def make():
        raise RenderingError('libEGL.so.1 is not on this machine')

    state = state_of(SHAPES, CHECKER)
    for choice, severity in (('auto', Severity.INFO), ('gl', Severity.WARN)):
        lines = []
        renderer = ChosenRenderer(choice, lambda *line, **_: lines.append(line), make)  # noqa: B023
        for _ in range(2):
            take(renderer, camera_of(), state)
        assert renderer.name == 'rays'
        assert lines == [
            (
                severity,
                f'Pictures of cameras are made by rays: camera_renderer:={choice}, but OpenGL '
                'does not work here: libEGL.so.1 is not on this machine',
            )
        ]


def test_opengl_that_fails_later_is_replaced_by_rays():
    class Failing(RayRenderer):
        name = 'gl'
        description = 'some driver'
        is_closed = False

        def render(self, shot):
            raise RenderingError('OpenGL fails: out of memory')

        def close(self):
            self.is_closed = True

    lines = []
    failing = Failing()
    renderer = ChosenRenderer('gl', lambda *line, **_: lines.append(line), lambda: failing)
    picture = take(renderer, camera_of(), state_of(SHAPES, CHECKER))
    assert math.isfinite(picture.depth[30, 40])
    assert failing.is_closed
    assert [severity for severity, _ in lines] == [Severity.INFO, Severity.WARN]
    assert lines[1][1].startswith('OpenGL fails: out of memory; pictures of cameras are made by')
