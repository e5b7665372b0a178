# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The colours of what rays hit: of geom or material, texture, and light by Lambert's law.

As MuJoCo's own renderer, which is OpenGL's fixed pipeline without the highlights::

    color · (emission + Σ spot · attenuation · (ambient + diffuse · max(0, normal · to_light)))

summed over all lights. The headlight is such a light, at the camera and along its axis.
"""

from dataclasses import dataclass
import math

import mujoco
import numpy as np

# --- Textures ------------------------------------------------------------------------------------
#
# A texture is laid on a shape as MuJoCo's own renderer does: a flat one along the shape's z axis,
# a cube from its middle. Each has smaller versions of itself, of which each pixel takes the one
# whose texels are as wide as what the pixel covers: a far floor is grey, and does not flicker. The
# texture of a mesh, which has coordinates for its corners, is only its mean colour.

_RGB = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)
_SKYBOX = int(mujoco.mjtTexture.mjTEXTURE_SKYBOX)
_FLAT = int(mujoco.mjtTexture.mjTEXTURE_2D)
_MESHES = (int(mujoco.mjtGeom.mjGEOM_MESH), int(mujoco.mjtGeom.mjGEOM_SDF))
_FACES = 6
_RED_GREEN_BLUE = 3


class _Image:
    """One square or oblong picture, and its smaller versions."""

    def __init__(self, pixels: np.ndarray) -> None:
        """``pixels``: (height, width, 3), uint8."""
        levels = [pixels.astype(np.float32) / 255.0]
        while min(levels[-1].shape[:2]) > 1:
            larger = levels[-1]
            height, width = larger.shape[0] // 2 * 2, larger.shape[1] // 2 * 2
            even = larger[:height, :width].reshape(height // 2, 2, width // 2, 2, 3)
            levels.append(even.mean(axis=(1, 3)))
        self.size = np.array(pixels.shape[1::-1])
        self._widths = np.array([level.shape[1] for level in levels])
        self._heights = np.array([level.shape[0] for level in levels])
        counts = self._widths * self._heights
        self._starts = np.concatenate(([0], np.cumsum(counts)[:-1]))
        self._texels = np.concatenate([level.reshape(-1, 3) for level in levels])
        self.mean = levels[-1].reshape(-1, 3).mean(axis=0)

    def colors(self, s: np.ndarray, t: np.ndarray, texels: np.ndarray) -> np.ndarray:
        """
        Return colours, (n, 3).

        Args:
            s: (n,), to the right; a whole number begins the picture anew.
            t: (n,), down.
            texels: (n,), how many of them a pixel covers.
        """
        level = np.log2(np.maximum(texels, 1.0))
        level = np.minimum(np.rint(level).astype(np.intp), len(self._widths) - 1)
        width, height = self._widths[level], self._heights[level]
        column = ((s - np.floor(s)) * width).astype(np.intp)
        row = ((t - np.floor(t)) * height).astype(np.intp)
        np.minimum(column, width - 1, out=column)
        np.minimum(row, height - 1, out=row)
        return np.asarray(self._texels[self._starts[level] + row * width + column])


@dataclass(frozen=True, slots=True)
class _Flat:
    image: _Image
    scale: tuple[float, float]
    """1/m: of x and y of the geom's axes."""


@dataclass(frozen=True, slots=True)
class _Cube:
    faces: tuple[_Image, ...]
    scale: np.ndarray
    """1/m, or 1: of the geom's axes."""


class Textures:
    """The textures of one model."""

    def __init__(self, model: mujoco.MjModel) -> None:
        """Read those that geoms have; ``model``: stays as it is."""
        self._images: dict[int, tuple[_Image, ...]] = {}
        self._geoms: dict[int, _Flat | _Cube | np.ndarray] = {}
        for geom in range(model.ngeom):
            material = int(model.geom_matid[geom])
            texture = int(model.mat_texid[material, _RGB]) if material >= 0 else -1
            if texture >= 0:
                self._geoms[geom] = self._laid_on(model, geom, material, texture)
        self._is_textured = np.zeros(model.ngeom, bool)
        self._is_textured[list(self._geoms)] = True
        self._sky = next(
            (
                self._image(model, texture)
                for texture in range(model.ntex)
                if model.tex_type[texture] == _SKYBOX
            ),
            None,
        )

    def apply(
        self,
        data: mujoco.MjData,
        geoms: np.ndarray,
        points: np.ndarray,
        footprints: np.ndarray,
        colors: np.ndarray,
    ) -> None:
        """
        Multiply colours by those of the textures.

        Args:
            data: Has the poses of geoms.
            geoms: (n,), which geom each hit is on.
            points: (n, 3), where, in the world, m.
            footprints: (n,), how wide a pixel is there, m.
            colors: (n, 3); are changed.
        """
        if not self._geoms:
            return
        which = np.flatnonzero(self._is_textured[geoms])
        for geom in np.unique(geoms[which]).tolist():
            hits = which[geoms[which] == geom]
            texture = self._geoms[geom]
            if isinstance(texture, np.ndarray):
                colors[hits] *= texture
                continue
            turn = data.geom_xmat[geom].reshape(3, 3).astype(np.float32)
            local = (points[hits] - data.geom_xpos[geom].astype(np.float32)) @ turn
            colors[hits] *= _lookup(texture, local, footprints[hits])

    def sky(self, directions: np.ndarray) -> np.ndarray | None:
        """Return the colours of the sky, (n, 3), by directions in the world; None: without."""
        if self._sky is None:
            return None
        # OpenGL's y is up.
        x, y, z = directions.T
        turned = np.stack((x, z, -y), axis=-1)
        return _on_cube(self._sky, turned, np.ones(len(turned), np.float32))

    def _laid_on(
        self, model: mujoco.MjModel, geom: int, material: int, texture: int
    ) -> _Flat | _Cube | np.ndarray:
        images = self._image(model, texture)
        mesh = int(model.geom_dataid[geom])
        if int(model.geom_type[geom]) in _MESHES and model.mesh_texcoordadr[mesh] >= 0:
            return np.asarray(images[0].mean, np.float32)
        size = np.where(model.geom_size[geom] > 0.0, model.geom_size[geom], 1.0)
        is_uniform = bool(model.mat_texuniform[material])
        if model.tex_type[texture] == _FLAT:
            repeat = model.mat_texrepeat[material]
            x, y = (repeat if is_uniform else repeat / size[:2]).tolist()
            return _Flat(images[0], (x, y))
        return _Cube(images, np.asarray(1.0 if is_uniform else 1.0 / size, np.float32))

    def _image(self, model: mujoco.MjModel, texture: int) -> tuple[_Image, ...]:
        """Return the one picture of a texture, or the six of a cube."""
        if texture not in self._images:
            height, width = int(model.tex_height[texture]), int(model.tex_width[texture])
            channels, start = int(model.tex_nchannel[texture]), int(model.tex_adr[texture])
            pixels = model.tex_data[start : start + height * width * channels]
            pixels = pixels.reshape(height, width, channels)
            if channels < _RED_GREEN_BLUE:
                pixels = pixels[..., :1].repeat(_RED_GREEN_BLUE, axis=2)
            pixels = pixels[..., :_RED_GREEN_BLUE]
            is_cube = model.tex_type[texture] != _FLAT and height == _FACES * width
            faces = np.split(pixels, _FACES) if is_cube else [pixels]
            self._images[texture] = tuple(map(_Image, faces))
        return self._images[texture]


def _lookup(texture: _Flat | _Cube, local: np.ndarray, footprint: np.ndarray) -> np.ndarray:
    """Return colours at points in the geom's axes."""
    if isinstance(texture, _Cube):
        return _on_cube(texture.faces, local * texture.scale, footprint)
    x, y = texture.scale
    s, t = 0.5 * x * local[:, 0] - 0.5, -0.5 * y * local[:, 1] - 0.5
    width, height = texture.image.size.tolist()
    density = 0.5 * math.sqrt(abs(x * y) * width * height)
    return texture.image.colors(s, t, footprint * np.float32(density))


def _on_cube(faces: tuple[_Image, ...], points: np.ndarray, footprint: np.ndarray) -> np.ndarray:
    """Return colours by direction, as OpenGL looks them up in a cube; see its specification."""
    size = np.abs(points)
    axis = size.argmax(axis=1)
    rows = np.arange(len(points))
    major = points[rows, axis]
    face = 2 * axis + (major < 0.0)
    x, y, z = points.T
    # Of the faces +x, -x, +y, -y, +z, -z.
    across = np.choose(face, (-z, z, x, x, x, -x))
    down = np.choose(face, (-y, -y, z, -z, -y, -y))
    largest = np.maximum(size[rows, axis], 1e-12)
    s, t = 0.5 * (across / largest + 1.0), 0.5 * (down / largest + 1.0)
    np.clip(s, 0.0, 1.0 - 1e-6, out=s)
    np.clip(t, 0.0, 1.0 - 1e-6, out=t)
    colors = np.empty((len(points), 3), np.float32)
    for number in np.unique(face).tolist():
        image = faces[min(number, len(faces) - 1)]
        here = np.flatnonzero(face == number)
        texels = footprint[here] / largest[here] * (0.5 * float(image.size[0]))
        colors[here] = image.colors(s[here], t[here], texels)
    return colors


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
