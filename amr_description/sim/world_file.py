# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The world: an MJCF file, by name or path, as a MuJoCo spec with its physics options.

:class:`WorldSettings` take precedence over the file, the file over the measured defaults:

=================  ==================  =====================================================
option             default             why not MuJoCo's default
=================  ==================  =====================================================
``gravity``        9.81 m/s² down
``friction``       0.5                 with 1 driven wheels climb walls: see
                                       :mod:`amr_description.sim.friction`
``physics_step``   2 ms                MuJoCo's own; the settings of
                                       :mod:`amr_description.sim.wheel_contact` are tuned for it.
                                       It is the longest step: see ``sim/engine.py``
``integrator``     ``discrete``        it solves the stiff speed servos of the wheels together with
                                       the friction; with any other the robot loses 0.8 of a turn,
                                       or never comes to rest
``cone``           ``elliptic``        same friction in all directions
``impratio``       1e4                 friction harder than the normal direction: no creep on
                                       slopes
``solver``         ``Newton``          MuJoCo's own
``iterations``     100                 MuJoCo's own
``jacobian``       ``dense``           faster for one robot, and MuJoCo 4.0.0's sparse Newton hits
                                       its iteration cap when robots touch; sparse with many robots
                                       that do not, see ``sim/fleet_solver.py``
=================  ==================  =====================================================

An option that a file sets to MuJoCo's own default looks the same as one that it does not set: the
Euler integrator has to be chosen by ``integrator``.
"""

from collections.abc import Iterator
from dataclasses import dataclass
import math
from pathlib import Path
import re

import mujoco

from amr_description.ament_index import world_path
from amr_description.clock import NANOSECONDS
from amr_description.errors import SimulationError
from amr_description.parameters import parameter
from amr_description.sim.engine import compiler_message
from amr_description.sim.friction import apply_default_friction, count_the_smaller

AS_IN_WORLD = 'world'

_INTEGRATORS = {
    'Euler': mujoco.mjtIntegrator.mjINT_EULER,
    'RK4': mujoco.mjtIntegrator.mjINT_RK4,
    'implicit': mujoco.mjtIntegrator.mjINT_IMPLICIT,
    'implicitfast': mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    'discrete': mujoco.mjtIntegrator.mjINT_DISCRETE,
}
_CONES = {
    'pyramidal': mujoco.mjtCone.mjCONE_PYRAMIDAL,
    'elliptic': mujoco.mjtCone.mjCONE_ELLIPTIC,
}
_SOLVERS = {
    'PGS': mujoco.mjtSolver.mjSOL_PGS,
    'CG': mujoco.mjtSolver.mjSOL_CG,
    'Newton': mujoco.mjtSolver.mjSOL_NEWTON,
}

_MOST_REPLICAS = 5_000
"""MuJoCo takes over 15 s to read a hundred thousand."""
_COMMENT = re.compile('<!--.*?-->', re.DOTALL)
_REPLICATE = re.compile(r'<replicate\b[^>]*?\bcount="\s*(\d{1,18})\s*"[^>]*>|(</replicate\s*>)')

MEASURED_OPTIONS = (
    ('integrator', mujoco.mjtIntegrator.mjINT_EULER, mujoco.mjtIntegrator.mjINT_DISCRETE),
    ('cone', mujoco.mjtCone.mjCONE_PYRAMIDAL, mujoco.mjtCone.mjCONE_ELLIPTIC),
    ('impratio', 1.0, 1e4),
    ('jacobian', mujoco.mjtJacobian.mjJAC_AUTO, mujoco.mjtJacobian.mjJAC_DENSE),
)
"""Option, MuJoCo's default, ours; an option at MuJoCo's default is set to ours."""


@dataclass(frozen=True)
class WorldSettings:
    """Physics of the world; NaN, 0 and 'world' leave an option as in the world's file."""

    gravity: float = parameter(
        math.nan,
        'Acceleration of free fall, down; NaN: as in the world',
        unit='m/s²',
        nan=True,
        magnitude=(1e-9, 1e4),
        read_only=True,
    )
    friction: float = parameter(
        math.nan,
        'Sliding friction of every static surface; NaN: as in the world',
        nan=True,
        minimum=0.0,
        magnitude=(1e-9, 1e4),
        read_only=True,
    )
    physics_step: float = parameter(
        math.nan,
        'The longest physics step, the control period is divided into equal ones; NaN: that of '
        'the world',
        unit='s',
        nan=True,
        above=0.0,
        magnitude=(1e-6, 1.0),
        read_only=True,
    )
    integrator: str = parameter(
        AS_IN_WORLD, 'Integrator', choices=(AS_IN_WORLD, *_INTEGRATORS), read_only=True
    )
    cone: str = parameter(
        AS_IN_WORLD, 'Friction cone', choices=(AS_IN_WORLD, *_CONES), read_only=True
    )
    impratio: float = parameter(
        math.nan,
        'How much harder friction is than the normal direction of a contact; NaN: as in the world',
        nan=True,
        above=0.0,
        magnitude=(1e-3, 1e4),
        read_only=True,
    )
    solver: str = parameter(
        AS_IN_WORLD, 'Constraint solver', choices=(AS_IN_WORLD, *_SOLVERS), read_only=True
    )
    iterations: int = parameter(
        0,
        'The most iterations of the solver in a step; 0: as in the world',
        minimum=0,
        magnitude=(1, 1_000_000),
        read_only=True,
    )


_FILE_SETTINGS = WorldSettings()


def load_world(world: str, settings: WorldSettings = _FILE_SETTINGS) -> mujoco.MjSpec:
    """
    Load a shipped world by name, or any MJCF file by path.

    Args:
        world: Name or path.
        settings: Take precedence over the options of the file.

    Raises:
        SimulationError: There is no such world, or MuJoCo cannot read it.
    """
    path = world_path(world)
    _check_replicas(world, path)
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as cause:
        raise SimulationError(
            f"world '{world}': {path}: {compiler_message(str(cause))}"
        ) from cause
    for geom in spec.geoms:
        if not all(map(math.isfinite, geom.friction)):
            named = f"the geom '{geom.name}'" if geom.name else 'a geom'
            raise SimulationError(
                f"world '{world}': {path}: the friction of {named} is "
                f'{" ".join(f"{each:g}" for each in geom.friction)}; finite numbers are needed'
            )
    apply_default_friction(spec, path)
    prepare_world(spec, settings)
    return spec


def _check_replicas(world: str, path: Path) -> None:
    """Raise SimulationError: ``<replicate>`` would make more bodies than can be simulated."""
    try:
        text = path.read_text('utf-8', errors='replace')
    except OSError as error:
        raise SimulationError(f"world '{world}': {path}: {error.strerror}") from error
    text = _COMMENT.sub('', text)
    counts: list[int] = []
    total = 0
    for count, end in _REPLICATE.findall(text):
        if end:
            counts[-1:] = []
            continue
        counts.append(int(count))
        total += math.prod(counts)
    if total > _MOST_REPLICAS:
        raise SimulationError(
            f"world '{world}': {path}: <replicate> makes {total} copies, and {_MOST_REPLICAS} are "
            'the most'
        )


def prepare_world(spec: mujoco.MjSpec, settings: WorldSettings = _FILE_SETTINGS) -> None:
    """Set the options of ``spec``; give every static surface a name and its friction."""
    apply_settings(spec.option, settings)
    # Links without mass must stay bodies: their frames are needed.
    spec.compiler.fusestatic = False
    for index, surface in enumerate(static_surfaces(spec)):
        surface.name = surface.name or f'surface_{index}'
        if not math.isnan(settings.friction):
            surface.friction[0] = settings.friction
    count_the_smaller(spec.geoms)


def apply_settings(option: mujoco.MjOption, settings: WorldSettings) -> None:
    """Set the measured options, then those of ``settings``; all but the physics step."""
    for name, default, measured in MEASURED_OPTIONS:
        if getattr(option, name) == default:
            setattr(option, name, measured)
    if not math.isnan(settings.gravity):
        option.gravity = [0.0, 0.0, -settings.gravity]
    if not math.isnan(settings.impratio):
        option.impratio = settings.impratio
    if settings.iterations:
        option.iterations = settings.iterations
    for name, table in (('integrator', _INTEGRATORS), ('cone', _CONES), ('solver', _SOLVERS)):
        chosen = getattr(settings, name)
        if chosen != AS_IN_WORLD:
            setattr(option, name, table[chosen])
    # MuJoCo would reset time and robots by itself after a fault.
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET


def longest_step(spec: mujoco.MjSpec, settings: WorldSettings = _FILE_SETTINGS) -> int:
    """Return the longest physics step, ns: of the settings, else of the file (default 2 ms)."""
    step = settings.physics_step
    if math.isnan(step):
        step = float(spec.option.timestep)
    return max(1, round(step * NANOSECONDS))


def static_surfaces(spec: mujoco.MjSpec) -> tuple[mujoco.MjsGeom, ...]:
    """Return the geoms that collide and never move: the surfaces that wheels drive on."""
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
