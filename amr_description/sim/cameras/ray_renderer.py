# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Pictures by a ray for each pixel, which MuJoCo casts on the processor.

It needs nothing of the machine, depth is exact, and two runs give the same bits. Light is that of
:mod:`amr_description.sim.cameras.shading`.

Surfaces are seen from outside only, as those of OpenGL: a camera inside a shape, such as its
housing, sees through it. Nor does the link that carries a camera hide its view nearer than its
near plane.
"""

from dataclasses import dataclass

import mujoco
import numpy as np

from amr_description.model.frames import matrix_from_quaternion
from amr_description.model.sensors import Camera
from amr_description.sim.cameras.lens import intrinsics_of, pixel_directions
from amr_description.sim.cameras.renderer import BACKGROUND, Picture, Renderer, Shot
from amr_description.sim.cameras.shading import Shading, Surface
from amr_description.sim.rays import Hits
from amr_description.sim.state_copy import CopiedScenes

_MOST_LAYERS = 8
"""Of surfaces that a ray passes as they are seen from behind."""


@dataclass(frozen=True, slots=True)
class _Rays:
    """Those of one camera, in the sensor's axes."""

    directions: np.ndarray
    """(n, 3), float64; 1 along x, so that the distance along one is the depth."""
    is_blind: np.ndarray | None
    """(n,): the lens shows nothing there; None: it does everywhere."""
    longest: float
    """The length of the longest."""
    spread: float
    """How wide a pixel is at a depth of 1."""


class RayRenderer(Renderer):
    """See the module."""

    name: str = 'rays'

    def __init__(self) -> None:
        """Nothing is bound yet."""
        self._scenes = CopiedScenes()
        self._bound: mujoco.MjModel | None = None
        self._rays: dict[Camera, _Rays] = {}

    def render(self, shot: Shot) -> Picture:
        """Make one picture."""
        state, camera = shot.state, shot.camera
        self._scene = self._scenes.scene(state)
        if self._bound is not state.model:
            self._bound, self._shading = state.model, Shading(state.model)
        rays = self._rays_of(camera)
        turn = np.array(matrix_from_quaternion(shot.pose.rotation))
        origin = np.array(shot.pose.translation)
        directions = np.ascontiguousarray(rays.directions @ turn.T)
        hits = self._cast(shot, origin, directions, rays.longest)
        shape = camera.height, camera.width
        depth = color = None
        if shot.with_depth:
            depth = _depth_of(hits, camera, rays).reshape(shape)
        if shot.with_color:
            pixels = self._colors(hits, camera, origin, directions, turn[:, 0], rays)
            color = pixels.reshape(*shape, 3)
        return Picture(color, depth)

    def _rays_of(self, camera: Camera) -> _Rays:
        """Return the rays of a camera, which are made once."""
        rays = self._rays.get(camera)
        if rays is None:
            seen = pixel_directions(camera).reshape(-1, 2)
            is_blind = np.isnan(seen[:, 0])
            # From the optical frame's x and y to the sensor's axes.
            directions = np.column_stack((np.ones(len(seen)), -seen[:, 0], -seen[:, 1]))
            directions[is_blind] = (1.0, 0.0, 0.0)
            longest = float(np.linalg.norm(directions, axis=1).max())
            rays = self._rays[camera] = _Rays(
                directions,
                is_blind if is_blind.any() else None,
                longest,
                1.0 / max(intrinsics_of(camera).fx, 1e-9),
            )
        return rays

    def _cast(
        self, shot: Shot, origin: np.ndarray, directions: np.ndarray, longest: float
    ) -> Hits:
        """Return where rays end; the geoms that they pass are left out."""
        near, far = _range_of(shot)
        cutoff = far * longest
        hits = layer = self._scene.cast(origin, directions, cutoff=cutoff, normals=True)
        model = self._scene.model
        carrier = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, shot.body)
        rays = np.arange(len(directions))
        mask = self._scene.all_seen
        for _ in range(_MOST_LAYERS):
            assert hits.normals is not None
            assert layer.normals is not None
            passed = np.einsum('ij,ij->i', layer.normals, directions[rays]) > 0.0
            if carrier >= 0:
                of_carrier = model.geom_bodyid[layer.geoms] == carrier
                passed |= (layer.distances < near) & of_carrier
            passed &= layer.geoms >= 0
            if not passed.any():
                break
            # All at once: what one of these rays has passed is hidden from the others, too.
            rays = rays[passed]
            mask = self._scene.mask(without=[*np.flatnonzero(mask), *layer.geoms[passed]])
            layer = self._scene.cast(
                origin, directions[rays], mask=mask, cutoff=cutoff, normals=True
            )
            hits.geoms[rays], hits.distances[rays] = layer.geoms, layer.distances
            hits.normals[rays] = layer.normals
        return hits

    def _colors(
        self,
        hits: Hits,
        camera: Camera,
        origin: np.ndarray,
        directions: np.ndarray,
        forward: np.ndarray,
        rays: _Rays,
    ) -> np.ndarray:
        """Return the colours of pixels, (n, 3), uint8."""
        assert hits.normals is not None
        is_hit = (hits.geoms >= 0) & (hits.distances <= camera.far)
        if rays.is_blind is not None:
            is_hit &= ~rays.is_blind
        which = np.flatnonzero(is_hit)
        distance = hits.distances[which].astype(np.float32)
        point = directions[which].astype(np.float32)
        point *= distance[:, np.newaxis]
        point += origin.astype(np.float32)
        surface = Surface(
            hits.geoms[which],
            hits.normals[which].astype(np.float32),
            point,
            distance * np.float32(rays.spread),
        )
        colors = self._shading.colors(self._scene.data, surface, forward)
        pixels = np.empty((len(is_hit), 3), np.uint8)
        pixels[which] = _as_bytes(colors)
        nothing = np.flatnonzero(~is_hit)
        if len(nothing):
            sky = self._shading.sky(directions[nothing].astype(np.float32))
            pixels[nothing] = BACKGROUND if sky is None else _as_bytes(sky)
        if rays.is_blind is not None:
            pixels[rays.is_blind] = 0
        return pixels


def _range_of(shot: Shot) -> tuple[float, float]:
    """Return the near and the far end of what is asked for, m along the optical axis."""
    camera, ranges = shot.camera, []
    if shot.with_color:
        ranges.append((camera.near, camera.far))
    if shot.with_depth:
        ranges.append((camera.depth_near, camera.depth_far))
    return min(near for near, _ in ranges), max(far for _, far in ranges)


def _depth_of(hits: Hits, camera: Camera, rays: _Rays) -> np.ndarray:
    """Return depths, (n,), float32, as REP 118 says."""
    depth = hits.distances.astype(np.float32)
    depth[hits.distances > camera.depth_far] = np.inf
    depth[hits.distances < camera.depth_near] = -np.inf
    depth[hits.geoms < 0] = np.inf
    if rays.is_blind is not None:
        depth[rays.is_blind] = np.nan
    return depth


def _as_bytes(colors: np.ndarray) -> np.ndarray:
    scaled = colors * np.float32(255.0)
    scaled += np.float32(0.5)
    np.clip(scaled, 0.0, 255.0, out=scaled)
    return scaled.astype(np.uint8)
