# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A world (MJCF) as a MuJoCo spec, with its settings."""

from collections.abc import Iterator
import math

import mujoco

from amr_description.errors import SimulationError
from amr_description.sim.compiling import one_line
from amr_description.sim.engine import NANOSECONDS
from amr_description.sim.resources import world_path
from amr_description.sim.silent_friction import fill_in_friction
from amr_description.sim.world_settings import apply_settings, WorldSettings

_FILE_SETTINGS = WorldSettings()


def load_world(world: str, settings: WorldSettings = _FILE_SETTINGS) -> mujoco.MjSpec:
    """Load a shipped world by name, or any MJCF file by path. Raises SimulationError."""
    path = world_path(world)
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as cause:
        raise SimulationError(f"world '{world}': {path}: {one_line(str(cause))}") from cause
    fill_in_friction(spec, path)
    prepare_world(spec, settings)
    return spec


def prepare_world(spec: mujoco.MjSpec, settings: WorldSettings = _FILE_SETTINGS) -> None:
    """Set the options, and give every static surface a name and its friction."""
    apply_settings(spec.option, settings)
    # Links without mass of their own must stay bodies, or their frames are gone.
    spec.compiler.fusestatic = False
    for index, surface in enumerate(static_surfaces(spec)):
        surface.name = surface.name or f'surface_{index}'
        if not math.isnan(settings.friction):
            surface.friction[0] = settings.friction


def longest_step(spec: mujoco.MjSpec, settings: WorldSettings = _FILE_SETTINGS) -> int:
    """The longest physics step, ns: of the settings, else of the file (MuJoCo's own is 2 ms)."""
    step = settings.physics_step
    if math.isnan(step):
        step = float(spec.option.timestep)
    return max(1, round(step * NANOSECONDS))


def static_surfaces(spec: mujoco.MjSpec) -> tuple[mujoco.MjsGeom, ...]:
    """The geoms of a world that can be touched and never move: what wheels drive on."""
    return tuple(
        geom
        for body in _static_bodies(spec.worldbody)
        for geom in body.geoms
        if geom.contype or geom.conaffinity
    )


def _static_bodies(body: mujoco.MjsBody) -> Iterator[mujoco.MjsBody]:
    yield body
    for child in body.bodies:
        if not child.joints:
            yield from _static_bodies(child)
