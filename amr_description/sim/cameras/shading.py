# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The colours of what rays hit: of geom or material, texture, and light by Lambert's law.

As MuJoCo's own renderer, which is OpenGL's fixed pipeline without the highlights::

    color · (emission + Σ spot · attenuation · (ambient + diffuse · max(0, normal · to_light)))

summed over all lights. The headlight is such a light, at the camera and along its axis.
"""

from dataclasses import dataclass

import mujoco
import numpy as np

from amr_description.sim.cameras.textures import Textures

_DIRECTIONAL = int(mujoco.mjtLightType.mjLIGHT_DIRECTIONAL)
_SPOT = int(mujoco.mjtLightType.mjLIGHT_SPOT)
_NOWHERE = np.zeros(0, np.intp)


@dataclass(frozen=True, slots=True)
class HitSurfaces:
    """
    The surfaces that rays have met.

    Attributes:
        geom: (n,), ids.
        normal: (n, 3), outward, of length 1, in the world.
        point: (n, 3), in the world, m.
        footprint: (n,), how wide a pixel is there, across the line of sight, m.
    """

    geom: np.ndarray
    normal: np.ndarray
    point: np.ndarray
    footprint: np.ndarray


class Shading:
    """The colours of one model."""

    def __init__(self, model: mujoco.MjModel) -> None:
        """Read colours, materials and textures; ``model``: stays as it is."""
        self._model = model
        rgba = model.geom_rgba[:, :3].astype(np.float32)
        emission = np.zeros(model.ngeom, np.float32)
        has_material = model.geom_matid >= 0
        material = model.geom_matid[has_material]
        if model.nmat:
            rgba[has_material] = model.mat_rgba[material, :3]
            emission[has_material] = model.mat_emission[material]
        self._rgba, self._emission = rgba, emission
        self._glows = bool(emission.any())
        self._textures = Textures(model)

    def colors(
        self,
        data: mujoco.MjData,
        surface: HitSurfaces,
        forward: np.ndarray,
        shadows: tuple[int, np.ndarray] | None = None,
    ) -> np.ndarray:
        """
        Return the colours of surfaces: (n, 3), float32, 0 to 1.

        Args:
            data: Has the poses of geoms and lights.
            surface: What is seen.
            forward: Where the camera looks, in the world.
            shadows: A light, and which of the surfaces it does not reach, (n,).
        """
        light = self._light(data, surface, forward, shadows or (-1, _NOWHERE))
        if self._glows:
            light += self._emission[surface.geom, np.newaxis]
        light *= self._rgba[surface.geom]
        # OpenGL's colours of vertices have a limit, also where a texture makes them darker.
        np.minimum(light, 1.0, out=light)
        self._textures.apply(data, surface.geom, surface.point, surface.footprint, light)
        return light

    def sky(self, directions: np.ndarray) -> np.ndarray | None:
        """Return the colours of the sky, (n, 3), 0 to 1, by directions; None: it has none."""
        return self._textures.sky(directions)

    def _light(
        self,
        data: mujoco.MjData,
        surface: HitSurfaces,
        forward: np.ndarray,
        shadows: tuple[int, np.ndarray],
    ) -> np.ndarray:
        """Return what falls on each hit, (n, 3)."""
        model = self._model
        headlight = model.vis.headlight
        ambient = np.zeros(3)
        towards, diffuse = [], []
        if headlight.active:
            ambient += headlight.ambient
            towards.append(-forward)
            diffuse.append(headlight.diffuse)
        others = []
        column = -1  # of the light that casts shadows
        for light in np.flatnonzero(model.light_active).tolist():
            if model.light_type[light] == _DIRECTIONAL:
                column = len(towards) if light == shadows[0] else column
                ambient += model.light_ambient[light]
                towards.append(-data.light_xdir[light])
                diffuse.append(model.light_diffuse[light])
            else:
                others.append(light)
        total = np.empty((len(surface.geom), 3), np.float32)
        total[:] = ambient
        if towards:
            # One product for all that come from afar.
            facing = surface.normal @ np.array(towards, np.float32).T
            np.maximum(facing, 0.0, out=facing)
            if column >= 0:
                facing[shadows[1], column] = 0.0
            total += facing @ np.array(diffuse, np.float32)
        for light in others:
            unlit = shadows[1] if light == shadows[0] else _NOWHERE
            total += self._from_a_place(data, surface, light, unlit)
        return total

    def _from_a_place(
        self, data: mujoco.MjData, surface: HitSurfaces, light: int, unlit: np.ndarray
    ) -> np.ndarray:
        """Return what a light at a place gives, (n, 3)."""
        model = self._model
        towards = data.light_xpos[light].astype(np.float32) - surface.point
        distance = np.sqrt(np.einsum('ij,ij->i', towards, towards))
        towards /= np.maximum(distance, 1e-6)[:, np.newaxis]
        constant, linear, quadratic = model.light_attenuation[light].tolist()
        strength = 1.0 / (constant + distance * (linear + distance * quadratic))
        if model.light_type[light] == _SPOT:
            along = -(towards @ data.light_xdir[light].astype(np.float32))
            is_lit = along >= np.cos(np.radians(float(model.light_cutoff[light])))
            exponent = float(model.light_exponent[light])
            strength *= is_lit * np.maximum(along, 0.0) ** exponent
        facing = np.maximum(np.einsum('ij,ij->i', surface.normal, towards), 0.0)
        facing[unlit] = 0.0
        lit = facing[:, np.newaxis] * model.light_diffuse[light].astype(np.float32)
        lit += model.light_ambient[light].astype(np.float32)
        lit *= strength[:, np.newaxis]
        return np.asarray(lit)
