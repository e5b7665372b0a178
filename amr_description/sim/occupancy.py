# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The map of a world: what a level lidar sees, as cells that are free, occupied or unknown.

It is the section of the world at the height of the lidar: a cell that something touches there is
occupied; one that can be reached from where the robot starts, without one that is occupied, is
free; all others, as those behind walls, are unknown. So the floor, kerbs and ramps are no
obstacles, unless they are as high as the lidar.

What counts is what a simulated lidar can see (see :mod:`amr_description.sim.rays`) and what never
moves: no robots, nothing on joints, no mocap bodies.
"""

from dataclasses import dataclass
import math
from typing import TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from amr_description.errors import MapError
from amr_description.maps.grid import FREE, OccupancyGrid, OCCUPIED, UNKNOWN
from amr_description.maps.pose import Pose
from amr_description.maps.rasterization import (
    fill_between,
    fill_convex,
    Mask,
    reached,
)
from amr_description.sim.rays import RayScene
from amr_description.sim.sections import GeomSection, section
from amr_description.sim.world_file import load_world

LIDAR_HEIGHT = 0.25
"""m: of the rays of ``urdf/amr_sensors.urdf.xacro`` above the ground."""
AROUND = 10.0
"""m: how far the map of an open world reaches from the start, at least."""
MOST_CELLS = 1 << 26
"""A map of more is refused."""

_CORNERS = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])

Extent: TypeAlias = tuple[float, float, float, float]
"""Lowest x, lowest y, highest x, highest y, m."""


@dataclass(frozen=True, slots=True)
class MapSettings:
    """How the map of a world is made; lengths in m, in the frame of the world."""

    height: float = LIDAR_HEIGHT
    """Of the section."""
    top: float | None = None
    """All that is between ``height`` and this counts; None: what is at ``height``."""
    resolution: float = 0.05
    """Edge of a cell."""
    start: tuple[float, float] = (0.0, 0.0)
    """From where what is free can be reached."""
    padding: float = 0.5
    """How far the map reaches beyond the start and everything that never moves."""
    extent: Extent | None = None
    """Of the map, in place of that."""


def map_of_world(world: str, settings: MapSettings | None = None) -> OccupancyGrid:
    """
    Return the map of a world.

    Args:
        world: A shipped one by name, or any MJCF file by path.
        settings: None: the defaults.

    Returns:
        Its origin is not turned, and a multiple of the resolution.

    Raises:
        SimulationError: There is no such world, or it cannot be read.
        MapError: A setting cannot be used.
    """
    try:
        return map_of_model(load_world(world).compile(), settings or MapSettings())
    except MapError as error:
        raise MapError(f"world '{world}': {error}") from error


def map_of_model(model: mujoco.MjModel, settings: MapSettings) -> OccupancyGrid:
    """Return the map of a compiled world; see :func:`map_of_world`. Raises MapError."""
    _check(settings)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    static = _Static(model, data, _static_geoms(model, data))
    cells, lowest = _cells(static, settings, 0.0)
    if settings.extent is None and _is_open(cells):
        cells, lowest = _cells(static, settings, AROUND)
    origin = Pose(float(lowest[0]), float(lowest[1]), 0.0)
    return OccupancyGrid(cells, settings.resolution, origin)


@dataclass(frozen=True, slots=True)
class _Static:
    """What never moves in a world."""

    model: mujoco.MjModel
    data: mujoco.MjData
    geoms: list[int]

    def section(self, geom: int, settings: MapSettings) -> GeomSection:
        """Return what of a geom is in the map."""
        high = settings.height if settings.top is None else settings.top
        return section(self.model, self.data, geom, settings.height, high)


def _cells(
    static: _Static, settings: MapSettings, around: float
) -> tuple[NDArray[np.int8], NDArray[np.float64]]:
    """Return cells, and their lower left corner, m; they reach ``around`` m from the start."""
    resolution = settings.resolution
    lowest, shape = _frame(static, settings, around)
    occupied = np.zeros(shape, np.bool_)
    for geom in static.geoms:
        _fill(occupied, static.section(geom, settings), lowest, resolution)
    column, row = (int(each) for each in (np.array(settings.start) - lowest) // resolution)
    if not (0 <= row < shape[0] and 0 <= column < shape[1]):
        raise MapError(_outside(settings, lowest, shape))
    if occupied[row, column]:
        corner = lowest + np.array((column, row)) * resolution
        raise MapError(
            f'at the start, {_point(settings.start)}, there is {_named(static, settings, corner)} '
            f'{settings.height:g} m above the ground; give a start on the free floor'
        )
    cells = np.full(shape, UNKNOWN, np.int8)
    cells[reached(~occupied, [(row, column)])] = FREE
    cells[occupied] = OCCUPIED
    return cells, lowest


def _is_open(cells: NDArray[np.int8]) -> bool:
    """Return whether one can drive out of a map."""
    rim = (cells[0], cells[-1], cells[:, 0], cells[:, -1])
    return any(bool((each == FREE).any()) for each in rim)


def _check(settings: MapSettings) -> None:
    """Raise MapError for settings of which no map can be made."""
    if not (math.isfinite(settings.resolution) and settings.resolution > 0.0):
        raise MapError(f'the resolution is {settings.resolution:g} m; it must be above 0')
    if not math.isfinite(settings.height):
        raise MapError(f'the height is {settings.height:g} m; it must be a number')
    if settings.top is not None and not settings.height <= settings.top < math.inf:
        raise MapError(
            f'the band is {settings.height:g} to {settings.top:g} m; its top must not be below'
        )
    if not 0.0 <= settings.padding < math.inf:
        raise MapError(f'the padding is {settings.padding:g} m; it must not be below 0')
    if settings.extent is not None:
        x, y, to_x, to_y = settings.extent
        if not (-math.inf < x < to_x < math.inf and -math.inf < y < to_y < math.inf):
            raise MapError(
                f'the extent is x {x:g} to {to_x:g} m, y {y:g} to {to_y:g} m; each must grow'
            )


def _static_geoms(model: mujoco.MjModel, data: mujoco.MjData) -> list[int]:
    """Return the visible geoms that never move."""
    bodies = np.flatnonzero(model.body_weldid == 0)
    still = [body for body in bodies if not _is_mocap(model, int(body))]
    seen = RayScene(model, data).is_seen()
    return [int(each) for each in np.flatnonzero(np.isin(model.geom_bodyid, still) & seen)]


def _is_mocap(model: mujoco.MjModel, body: int) -> bool:
    """Return whether a body, or one that it hangs on, is moved from outside."""
    return bool(model.body_mocapid[model.body_rootid[body]] >= 0)


def _frame(
    static: _Static, settings: MapSettings, around: float
) -> tuple[NDArray[np.float64], tuple[int, int]]:
    """Return the lower left corner of a map, m, and its height and width in cells."""
    if settings.extent is not None:
        low, high = np.array(settings.extent[:2]), np.array(settings.extent[2:])
    else:
        start = np.array([settings.start])
        bounds = [start, start - around, start + around]
        bounds += [
            each
            for geom in static.geoms
            if (each := _bounds(static.model, static.data, geom)) is not None
        ]
        corners = np.concatenate(bounds)
        low = corners.min(axis=0) - settings.padding
        high = corners.max(axis=0) + settings.padding
    # Rounded, so that 6.1 m are 122 cells of 0.05 m, and no 123rd.
    first = np.floor(np.round(low / settings.resolution, 6))
    last = np.ceil(np.round(high / settings.resolution, 6))
    width, height = (max(1, int(each)) for each in last - first)
    if width * height > MOST_CELLS:
        raise MapError(
            f'its map would have {width} x {height} cells of {settings.resolution:g} m, more than '
            f'{MOST_CELLS}; a coarser resolution, or a smaller extent, will do'
        )
    return np.round(first * settings.resolution, 9), (height, width)


def _bounds(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> NDArray[np.float64] | None:
    """Return x and y of the corners of a box around a geom, (8, 2); None: it has no end."""
    turn = data.geom_xmat[geom].reshape(3, 3)
    center, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
        if not model.geom_size[geom, :2].all():
            return None
        center, half = np.zeros(3), np.append(model.geom_size[geom, :2], 0.0)
    corners: NDArray[np.float64] = (center + half * _CORNERS) @ turn.T + data.geom_xpos[geom]
    return corners[:, :2]


def _fill(
    occupied: Mask, cut: GeomSection, lowest: NDArray[np.float64], resolution: float
) -> None:
    """Set the cells that a section touches."""
    for part in cut.parts:
        fill_convex(occupied, (part - lowest) / resolution)
    if cut.outline is not None:
        fill_between(occupied, (cut.outline - lowest) / resolution)


def _named(static: _Static, settings: MapSettings, corner: NDArray[np.float64]) -> str:
    """Return the name of what takes the cell with this lower left corner."""
    model = static.model
    for geom in static.geoms:
        one = np.zeros((1, 1), np.bool_)
        _fill(one, static.section(geom, settings), corner, settings.resolution)
        if one.any():
            named = model.geom(geom).name or model.body(int(model.geom_bodyid[geom])).name
            return f"'{named}'"
    return 'something'


def _outside(settings: MapSettings, lowest: NDArray[np.float64], shape: tuple[int, int]) -> str:
    highest = lowest + np.array(shape[::-1]) * settings.resolution
    return (
        f'the start, {_point(settings.start)}, is outside of the map, which reaches from '
        f'{_point(lowest)} to {_point(highest)}; give a start or an extent that fit'
    )


def _point(point: NDArray[np.float64] | tuple[float, float]) -> str:
    return f'({point[0]:g}, {point[1]:g})'
