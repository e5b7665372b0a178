# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Pictures by a ray for each pixel, on the processor.

It needs nothing of the machine, depth is exact, and two runs give the same bits. Light is that of
:mod:`amr_description.sim.cameras.shading`, with the shadows of one light.

Surfaces are seen from outside only, as those of OpenGL: a camera inside a shape, such as its
housing, sees through it. Nor does the link that carries a camera hide its view nearer than its
near plane.
"""

import mujoco
import numpy as np

from amr_description.model.frames import matrix_from_quaternion
from amr_description.model.sensors import Camera
from amr_description.sim.cameras.ray_caster import Ends, Eye, RayCaster
from amr_description.sim.cameras.renderer import BACKGROUND, Picture, Renderer, Shot
from amr_description.sim.cameras.screen import Screen
from amr_description.sim.cameras.shading import Shading, Surface
from amr_description.sim.cameras.shadows import in_shadow, shadow_light
from amr_description.sim.state_copy import CopiedScenes


class RayRenderer(Renderer):
    """See the module."""

    name: str = 'rays'

    def __init__(self) -> None:
        """Nothing is bound yet."""
        self._scenes = CopiedScenes()
        self._bound: mujoco.MjModel | None = None
        self._screens: dict[Camera, Screen] = {}

    def render(self, shot: Shot) -> Picture:
        """Make one picture."""
        state, camera = shot.state, shot.camera
        self._scene = self._scenes.scene(state)
        if self._bound is not state.model:
            self._bound, self._shading = state.model, Shading(state.model)
            self._caster = RayCaster(self._scene)
            self._shadow_light = shadow_light(state.model)
        screen = self._screens.get(camera)
        if screen is None:
            screen = self._screens[camera] = Screen.of(camera)
        near, far = _range_of(shot)
        eye = Eye(
            np.array(shot.pose.translation),
            np.array(matrix_from_quaternion(shot.pose.rotation)),
            far,
            mujoco.mj_name2id(state.model, mujoco.mjtObj.mjOBJ_BODY, shot.body),
            near,
        )
        with np.errstate(all='ignore'):  # of rays that end nowhere
            ends = self._caster.cast(screen, eye)
            return Picture(
                self._colors(ends, screen, eye, camera.far) if shot.with_color else None,
                _depth_of(ends, screen, camera) if shot.with_depth else None,
            )

    def _colors(self, ends: Ends, screen: Screen, eye: Eye, far: float) -> np.ndarray:
        """Return the colours of pixels, (height, width, 3), uint8."""
        is_hit = ends.depth <= far
        points = np.empty((*screen.shape, 3), np.float32)
        directions = [screen.linear(row, screen.everywhere) for row in eye.turn]
        for axis, along in enumerate(directions):
            np.multiply(along, ends.depth, out=points[..., axis], where=is_hit)
            points[..., axis] += eye.origin[axis]
        normals = ends.normals(self._scene, points)
        which = np.flatnonzero(is_hit)
        depth = ends.depth.ravel()[which]
        surface = Surface(
            ends.geoms().ravel()[which],
            normals.reshape(-1, 3)[which],
            points.reshape(-1, 3)[which],
            depth.astype(np.float32) * np.float32(screen.spread),
        )
        pixels = np.empty((is_hit.size, 3), np.uint8)
        shadows = self._shadows(surface) if len(which) else None
        colors = self._shading.colors(self._scene.data, surface, eye.turn[:, 0], shadows)
        pixels[which] = _as_bytes(colors)
        nothing = np.flatnonzero(~is_hit)
        if len(nothing):
            seen = np.stack([each.ravel()[nothing] for each in directions], axis=-1)
            sky = self._shading.sky(seen.astype(np.float32))
            pixels[nothing] = BACKGROUND if sky is None else _as_bytes(sky)
        if screen.is_blind is not None:
            pixels[screen.is_blind.ravel()] = 0
        return pixels.reshape(*screen.shape, 3)

    def _shadows(self, surface: Surface) -> tuple[int, np.ndarray] | None:
        """Return a light, and the indices of surfaces that it does not reach."""
        light = self._shadow_light
        if light < 0:
            return None
        scene = self._scene
        unlit = in_shadow(
            self._caster, scene.model, scene.data, light, surface.geom, surface.point
        )
        return light, np.flatnonzero(unlit)


def _range_of(shot: Shot) -> tuple[float, float]:
    """Return the near and the far end of what is asked for, m along the optical axis."""
    camera, ranges = shot.camera, []
    if shot.with_color:
        ranges.append((camera.near, camera.far))
    if shot.with_depth:
        ranges.append((camera.depth_near, camera.depth_far))
    return min(near for near, _ in ranges), max(far for _, far in ranges)


def _depth_of(ends: Ends, screen: Screen, camera: Camera) -> np.ndarray:
    """Return depths, (height, width), float32, as REP 118 says."""
    depth = ends.depth.astype(np.float32)
    depth[ends.depth > camera.depth_far] = np.inf
    depth[ends.depth < camera.depth_near] = -np.inf
    if screen.is_blind is not None:
        depth[screen.is_blind] = np.nan
    return depth


def _as_bytes(colors: np.ndarray) -> np.ndarray:
    scaled = colors * np.float32(255.0)
    scaled += np.float32(0.5)
    np.clip(scaled, 0.0, 255.0, out=scaled)
    return scaled.astype(np.uint8)
