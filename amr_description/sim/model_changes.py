# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Changes of a compiled model: masses, frictions, wheels, gravity; and the way back, bit for bit.

They are made in the running model, in a millisecond, and hold until :meth:`ModelChanges.undo`. The
spec is not changed: after a recompile, as when a robot comes or goes, nothing would be left of
them. So :meth:`ModelChanges.require_none` refuses that.
"""

from collections.abc import Callable, Iterator, Sequence
from copy import copy
import math
from typing import Any

import mujoco
import numpy as np
import numpy.typing as npt

from amr_description.errors import SimulationError
from amr_description.model.frames import Transform, Vector
from amr_description.sim.engine import Engine
from amr_description.sim.entity_state import pose_of, set_state
from amr_description.sim.robot_view import RobotView
from amr_description.text import quote_all

_STATISTIC = ('center', 'extent', 'meaninertia', 'meanmass', 'meansize')
_ROUND = (
    mujoco.mjtGeom.mjGEOM_SPHERE,
    mujoco.mjtGeom.mjGEOM_CAPSULE,
    mujoco.mjtGeom.mjGEOM_CYLINDER,
    mujoco.mjtGeom.mjGEOM_ELLIPSOID,
)
_SLIDING = 2
"""The first two frictions of a pair; the others are of turning and rolling."""


class ModelChanges:
    """What is changed of one engine's model; see the module."""

    def __init__(self, engine: Engine, lost: Callable[[], Sequence[str]]) -> None:
        """``lost``: returns the robots whose physics is lost: that has changed the model, too."""
        self._engine, self._lost = engine, lost
        self._before: dict[str, npt.NDArray[Any]] = {}
        """All arrays of the model: what follows from a mass, MuJoCo knows."""
        self._statistic: dict[str, Any] = {}
        self._gravity: npt.NDArray[np.float64] | None = None

    def __bool__(self) -> bool:
        """Whether anything is changed."""
        return self._gravity is not None

    def require_none(self) -> None:
        """Raise SimulationError: a robot that came or went now would undo the changes."""
        if self:
            raise SimulationError(
                'a robot comes or goes after masses, frictions, wheels or gravity were changed; '
                'spawn() and remove() before that, or after reset()'
            )

    def scale_mass(self, robot: RobotView, factor: float, links: Sequence[str] = ()) -> None:
        """
        Multiply mass and inertia of links.

        Args:
            robot: Of the world.
            factor: Above 0.
            links: Names; none: all of the robot.

        Raises:
            SimulationError: There is no such link with a mass, or the factor is no good.
        """
        self._require_above_zero('mass', factor)
        bodies = [*self._bodies(robot, links)]
        self._keep()
        model = self._engine.model
        model.body_mass[bodies] *= factor
        model.body_inertia[bodies] *= factor
        # With data of its own: the state of the simulation is not touched.
        mujoco.mj_setConst(model, mujoco.MjData(model))

    def scale_friction(self, robot: RobotView, factor: float, links: Sequence[str] = ()) -> None:
        """Multiply the sliding friction of wheels on the ground; arguments as for the mass."""
        self._require_above_zero('friction', factor)
        geoms = self._wheels(robot, links)
        self._keep()
        model = self._engine.model
        model.geom_friction[geoms, 0] *= factor
        pairs = np.isin(model.pair_geom1, geoms) | np.isin(model.pair_geom2, geoms)
        model.pair_friction[pairs, :_SLIDING] *= factor

    def scale_radius(self, robot: RobotView, factor: float, links: Sequence[str] = ()) -> None:
        """Multiply the radius of wheels, on which the robot then stands; as for the mass."""
        self._require_above_zero('radius', factor)
        geoms = self._wheels(robot, links)
        model = self._engine.model
        if not np.isin(model.geom_type[geoms], _ROUND).all():
            raise SimulationError(
                f"'{robot.name}' has wheels that are meshes; in the description they can be "
                'cylinders, spheres or capsules, whose radius can be changed'
            )
        self._keep()
        grows = (factor - 1.0) * max(float(model.geom_size[geom, 0]) for geom in geoms)
        for geom in geoms:
            # Of an ellipsoid, which stands for a cylinder, two half axes.
            is_ellipsoid = model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_ELLIPSOID
            model.geom_size[geom, : 2 if is_ellipsoid else 1] *= factor
            # Bounds may be too large, never too small.
            grown = max(1.0, factor)
            model.geom_rbound[geom] *= grown
            model.geom_aabb[geom, 3:] *= grown
        pose, still = pose_of(robot), (0.0, 0.0, 0.0)
        x, y, z = pose.translation
        raised = Transform((x, y, z + grows), pose.rotation)
        set_state(self._engine, robot, raised, still, still)

    def tilt_gravity(self, roll: float, pitch: float) -> None:
        """
        Turn the direction of gravity, as if the floor was tilted.

        Args:
            roll: Of the floor about x, rad.
            pitch: About y, rad; nose up for one that looks along x: < 0.
        """
        if not (math.isfinite(roll) and math.isfinite(pitch)):
            raise SimulationError(f'gravity tilted by {roll} and {pitch} rad; finite numbers do')
        self._keep()
        gravity = self._engine.model.opt.gravity
        strength = float(np.linalg.norm(gravity))
        gravity[:] = [strength * each for each in _down(roll, pitch)]

    def undo(self) -> None:
        """Bring everything back, bit for bit."""
        if self._gravity is None:
            return
        model = self._engine.model
        for name, values in self._before.items():
            array = getattr(model, name)
            if not np.array_equal(array, values, equal_nan=array.dtype.kind == 'f'):
                array[:] = values
        for name, value in self._statistic.items():
            setattr(model.stat, name, value)
        model.opt.gravity[:] = self._gravity
        self._gravity = None

    def _keep(self) -> None:
        """Remember the model as it is before the first change."""
        if self._gravity is not None:
            return
        if lost := self._lost():
            raise SimulationError(
                f'the physics of {quote_all(lost)} is lost: the model is changed after reset()'
            )
        model = self._engine.model
        arrays = {name: getattr(model, name) for name in dir(model) if name[0] != '_'}
        self._before = {
            name: array.copy() for name, array in arrays.items() if isinstance(array, np.ndarray)
        }
        self._statistic = {name: copy(getattr(model.stat, name)) for name in _STATISTIC}
        self._gravity = model.opt.gravity.copy()

    def _require_above_zero(self, what: str, factor: float) -> None:
        if not (math.isfinite(factor) and factor > 0.0):
            raise SimulationError(f'a {what} times {factor}; a finite factor above 0 will do')

    def _bodies(self, robot: RobotView, links: Sequence[str]) -> Iterator[int]:
        model = self._engine.model
        masses = {
            model.body(body).name.partition('/')[2]: body
            for body in range(model.nbody)
            if model.body(body).name.startswith(f'{robot.name}/') and model.body_mass[body] > 0.0
        }
        names = [link.name for link in robot.description.links]
        known = [name for name in names if name in masses]
        yield from (masses[name] for name in _chosen(robot, 'mass', known, links))

    def _wheels(self, robot: RobotView, links: Sequence[str]) -> list[int]:
        """Return the ids of the geoms that touch the ground as wheels."""
        model = self._engine.model
        pairs = {*model.pair_geom1.tolist(), *model.pair_geom2.tolist()}
        geoms: dict[str, list[int]] = {each.link: [] for each in robot.wheels}
        for geom in sorted(pairs):
            name = model.body(int(model.geom_bodyid[geom])).name
            owner, _, link = name.partition('/')
            if owner == robot.name and link in geoms:
                geoms[link].append(geom)
        chosen = _chosen(robot, 'wheel', [link for link in geoms if geoms[link]], links)
        return [geom for link in chosen for geom in geoms[link]]


def _chosen(
    robot: RobotView, what: str, known: Sequence[str], links: Sequence[str]
) -> Sequence[str]:
    """Return links, all that are known if none is named. Raises SimulationError."""
    wrong = [link for link in links if link not in known]
    if wrong or not known:
        asked = quote_all(wrong) if wrong else 'any link'
        raise SimulationError(
            f"'{robot.name}': no {what} of {asked}; there are: {', '.join(known) or 'none'}"
        )
    return links or known


def _down(roll: float, pitch: float) -> Vector:
    """Return the unit vector that points down over a floor that is turned by these angles."""
    return (
        math.sin(pitch),
        -math.sin(roll) * math.cos(pitch),
        -math.cos(roll) * math.cos(pitch),
    )
