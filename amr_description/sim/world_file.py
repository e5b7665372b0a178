# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A world (MJCF) as a MuJoCo spec, with the measured solver options where it sets none."""

from collections.abc import Iterator

import mujoco

from amr_description.errors import SimulationError
from amr_description.sim.faults import one_line
from amr_description.sim.resources import world_path

MEASURED_OPTIONS = (
    # Puts the velocity servos of the wheels inside the friction problem; with any other
    # integrator stiff servos and skid-steering do not go together.
    ('integrator', mujoco.mjtIntegrator.mjINT_EULER, mujoco.mjtIntegrator.mjINT_DISCRETE),
    ('cone', mujoco.mjtCone.mjCONE_PYRAMIDAL, mujoco.mjtCone.mjCONE_ELLIPTIC),
    # Friction harder than the normal direction: no creep on slopes.
    ('impratio', 1.0, 1e4),
    # The sparse Newton solver of MuJoCo 4.0.0 hits its iteration cap when robots touch.
    ('jacobian', mujoco.mjtJacobian.mjJAC_AUTO, mujoco.mjtJacobian.mjJAC_DENSE),
)
"""Option, MuJoCo's default, ours: a world that leaves an option at MuJoCo's default gets ours."""


def load_world(world: str) -> mujoco.MjSpec:
    """
    Load a shipped world by name, or any MJCF file by path. Raises SimulationError.

    The physics step of the file is not used: it follows from the control period.
    """
    path = world_path(world)
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as cause:
        raise SimulationError(f"world '{world}': {path}: {one_line(str(cause))}") from cause
    prepare_world(spec)
    return spec


def prepare_world(spec: mujoco.MjSpec) -> None:
    """Set the measured options, and give every static surface a name."""
    for option, default, measured in MEASURED_OPTIONS:
        if getattr(spec.option, option) == default:
            setattr(spec.option, option, measured)
    # MuJoCo's reset after a fault would set time and robots back behind our back.
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    # Links without mass of their own must stay bodies, or their frames are gone.
    spec.compiler.fusestatic = False
    for index, surface in enumerate(static_surfaces(spec)):
        surface.name = surface.name or f'surface_{index}'


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
