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
from amr_description.sim.cameras.seen_geoms import HIDDEN, SEEN_GROUPS, seen_model
from amr_description.sim.cameras.shading import Hits, Shading
from amr_description.sim.state_copy import CopiedPoses

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


@dataclass(slots=True)
class _Cast:
    """Where rays end; (n,) each, normals (n, 3)."""

    geom: np.ndarray
    distance: np.ndarray
    normal: np.ndarray


class RayRenderer(Renderer):
    """See the module."""

    name = 'rays'

    def __init__(self) -> None:
        """Nothing is bound yet."""
        self._poses = CopiedPoses()
        self._bound: mujoco.MjModel | None = None
        self._rays: dict[Camera, _Rays] = {}

    def render(self, shot: Shot) -> Picture:
        """Make one picture."""
        state, camera = shot.state, shot.camera
        if self._bound is not state.model:
            self._bound = state.model
            self._model = seen_model(state.model, state.robots)
            self._shading = Shading(self._model)
        data = self._poses.data(state)
        rays = self._rays_of(camera)
        turn = np.array(matrix_from_quaternion(shot.pose.rotation))
        origin = np.array(shot.pose.translation)
        directions = np.ascontiguousarray(rays.directions @ turn.T)
        carrier = mujoco.mj_name2id(state.model, mujoco.mjtObj.mjOBJ_BODY, shot.body)
        near, far = _range_of(camera, shot)
        cast = self._cast(data, origin, directions, far * rays.longest, (carrier, near))
        shape = camera.height, camera.width
        depth = color = None
        if shot.with_depth:
            depth = _depth_of(cast, camera, rays).reshape(shape)
        if shot.with_color:
            pixels = self._colors(data, cast, shot, origin, directions, turn[:, 0], rays)
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
        self,
        data: mujoco.MjData,
        origin: np.ndarray,
        directions: np.ndarray,
        cutoff: float,
        carrier: tuple[int, float],
    ) -> _Cast:
        """
        Cast rays from a point.

        Args:
            data: Has the poses of geoms.
            origin: In the world, m.
            directions: (n, 3), in the world.
            cutoff: m; what is farther may be missed.
            carrier: The body that carries the camera, and how near it is not seen.
        """
        body, near = carrier
        cast = self._cast_once(data, origin, directions, cutoff)
        bodies = self._model.geom_bodyid
        hidden = np.zeros(self._model.ngeom, bool)
        rays, layer = np.arange(len(directions)), cast
        for _ in range(_MOST_LAYERS):
            passed = _seen_from_behind(layer, directions[rays])
            if body >= 0:
                passed |= (layer.distance < near) & (bodies[layer.geom] == body)
            passed &= layer.geom >= 0
            if not passed.any():
                break
            # All at once: what one ray of them has passed is hidden from the others, too.
            rays = rays[passed]
            hidden[layer.geom[passed]] = True
            groups = self._model.geom_group.copy()
            self._model.geom_group[hidden] = HIDDEN
            layer = self._cast_once(data, origin, directions[rays], cutoff)
            self._model.geom_group[:] = groups
            cast.geom[rays], cast.distance[rays] = layer.geom, layer.distance
            cast.normal[rays] = layer.normal
        return cast

    def _cast_once(
        self, data: mujoco.MjData, origin: np.ndarray, directions: np.ndarray, cutoff: float
    ) -> _Cast:
        count = len(directions)
        cast = _Cast(np.empty(count, np.int32), np.empty(count), np.empty((count, 3)))
        mujoco.mj_multiRay(
            self._model,
            data,
            origin,
            directions.reshape(-1),
            SEEN_GROUPS,
            True,
            -1,
            cast.geom,
            cast.distance,
            cast.normal.reshape(-1),
            count,
            cutoff,
        )
        return cast

    def _colors(
        self,
        data: mujoco.MjData,
        cast: _Cast,
        shot: Shot,
        origin: np.ndarray,
        directions: np.ndarray,
        forward: np.ndarray,
        rays: _Rays,
    ) -> np.ndarray:
        """Return the colours of pixels, (n, 3), uint8."""
        is_hit = (cast.geom >= 0) & (cast.distance <= shot.camera.far)
        if rays.is_blind is not None:
            is_hit &= ~rays.is_blind
        which = np.flatnonzero(is_hit)
        distance = cast.distance[which].astype(np.float32)
        point = directions[which].astype(np.float32)
        point *= distance[:, np.newaxis]
        point += origin.astype(np.float32)
        hits = Hits(
            cast.geom[which],
            cast.normal[which].astype(np.float32),
            point,
            distance * np.float32(rays.spread),
        )
        colors = self._shading.colors(data, hits, forward)
        pixels = np.empty((len(is_hit), 3), np.uint8)
        pixels[which] = _as_bytes(colors)
        nothing = np.flatnonzero(~is_hit)
        if len(nothing):
            sky = self._shading.sky(directions[nothing].astype(np.float32))
            pixels[nothing] = BACKGROUND if sky is None else _as_bytes(sky)
        if rays.is_blind is not None:
            pixels[rays.is_blind] = 0
        return pixels


def _range_of(camera: Camera, shot: Shot) -> tuple[float, float]:
    """Return the near and the far end of what is asked for, m along the optical axis."""
    ranges = []
    if shot.with_color:
        ranges.append((camera.near, camera.far))
    if shot.with_depth:
        ranges.append((camera.depth_near, camera.depth_far))
    return min(near for near, _ in ranges), max(far for _, far in ranges)


def _seen_from_behind(cast: _Cast, directions: np.ndarray) -> np.ndarray:
    return np.asarray(np.einsum('ij,ij->i', cast.normal, directions) > 0.0)


def _depth_of(cast: _Cast, camera: Camera, rays: _Rays) -> np.ndarray:
    """Return depths, (n,), float32, as REP 118 says."""
    depth = cast.distance.astype(np.float32)
    depth[cast.distance > camera.depth_far] = np.inf
    depth[cast.distance < camera.depth_near] = -np.inf
    depth[cast.geom < 0] = np.inf
    if rays.is_blind is not None:
        depth[rays.is_blind] = np.nan
    return depth


def _as_bytes(colors: np.ndarray) -> np.ndarray:
    scaled = colors * np.float32(255.0)
    scaled += np.float32(0.5)
    np.clip(scaled, 0.0, 255.0, out=scaled)
    return scaled.astype(np.uint8)
