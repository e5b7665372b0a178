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
from amr_description.sim.cameras.renderer import BACKGROUND, RenderedPicture, Renderer, Shot
from amr_description.sim.cameras.screen import Screen
from amr_description.sim.cameras.shading import HitSurfaces, Shading
from amr_description.sim.state_copy import CopiedScenes

_DIRECTIONAL = int(mujoco.mjtLightType.mjLIGHT_DIRECTIONAL)
_SPOT = int(mujoco.mjtLightType.mjLIGHT_SPOT)
_RAYS = 320
"""In a row and in a column."""
_AFAR = 1000.0
"""How many times the size of what is seen a directional light is away from it."""
_CLEARANCE = 2e-3
"""m between a shape and what lies on it without a shadow."""


def shadow_light(model: mujoco.MjModel) -> int:
    """Return the light of which shadows are seen: the first that casts some; -1: there is none."""
    kinds = np.isin(model.light_type, (_DIRECTIONAL, _SPOT))
    lights = np.flatnonzero(kinds & (model.light_active != 0) & (model.light_castshadow != 0))
    return int(lights[0]) if len(lights) else -1


def in_shadow(
    caster: RayCaster,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    light: int,
    geoms: np.ndarray,
    points: np.ndarray,
) -> np.ndarray:
    """
    Return which points a light does not reach, (n,).

    Args:
        caster: Of the scene.
        model: Has the light.
        data: Has its pose.
        light: Its id; directional, or a spot.
        geoms: (n,): on which geom each point is.
        points: (n, 3), in the world, m; at least one.
    """
    forward = data.light_xdir[light] / np.linalg.norm(data.light_xdir[light])
    turn = _turn_to(forward)
    low, high = points.min(axis=0).astype(float), points.max(axis=0).astype(float)
    if model.light_type[light] == _DIRECTIONAL:
        reach = _AFAR * (1.0 + float(np.linalg.norm(high - low)))
        origin = (low + high) / 2.0 - reach * forward
    else:
        origin = data.light_xpos[light].copy()
    seen = (points - origin) @ turn
    depth = seen[:, 0]
    is_ahead = depth > 0.0
    x, y = -seen[:, 1] / depth, -seen[:, 2] / depth
    if model.light_type[light] == _SPOT:
        limit = np.tan(np.radians(min(float(model.light_cutoff[light]), 80.0)))
        is_ahead &= (np.abs(x) <= limit) & (np.abs(y) <= limit)
    if not is_ahead.any():
        return np.zeros(len(points), bool)
    columns, across = _grid(x, is_ahead)
    rows, down = _grid(y, is_ahead)
    step = float(across[0, 1] - across[0, 0])
    ends = caster.cast(Screen(across, down.T, step), Eye(origin, turn, np.inf, -1, 0.0))
    is_behind = ends.depth[rows, columns] < depth - _CLEARANCE
    return np.asarray(is_behind & is_ahead & (ends.geoms()[rows, columns] != geoms))


def _grid(values: np.ndarray, is_used: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return for each value the number of the ray next to it, and where the rays are, (1, n)."""
    low, high = float(values[is_used].min()), float(values[is_used].max())
    step = max((high - low) / _RAYS, 1e-12)
    number = np.where(is_used, (values - low) / step, 0.0).astype(np.intp)
    centres = low + step * (np.arange(_RAYS) + 0.5)
    return np.minimum(number, _RAYS - 1), centres[np.newaxis]


def _turn_to(forward: np.ndarray) -> np.ndarray:
    """Return axes (3, 3) of which the first, x, is a direction: from them to the world."""
    aside = np.cross((0.0, 0.0, 1.0) if abs(forward[2]) < 0.9 else (1.0, 0.0, 0.0), forward)
    aside /= np.linalg.norm(aside)
    return np.column_stack((forward, aside, np.cross(forward, aside)))


class RayRenderer(Renderer):
    """See the module."""

    name: str = 'rays'

    def __init__(self) -> None:
        """Nothing is bound yet."""
        self._scenes = CopiedScenes()
        self._bound: mujoco.MjModel | None = None
        self._screens: dict[Camera, Screen] = {}

    def render(self, shot: Shot) -> RenderedPicture:
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
            return RenderedPicture(
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
        surface = HitSurfaces(
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

    def _shadows(self, surface: HitSurfaces) -> tuple[int, np.ndarray] | None:
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
