# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How the constraints of a step are solved when there are many robots.

With a dense Jacobian, which one robot needs least time with, a step of n robots takes time as n².
With a sparse one it takes time as n; but in MuJoCo 4.0.0 the sparse Newton solver can stop at its
cap of iterations where bodies that move freely touch each other (mujoco#3767; seen in 1 of 300
steps of a crowd of seven robots, wrong by 2 mm/s). So from :data:`FEWEST` robots on the Jacobian
is sparse, but dense in the steps in which two kinematic trees touch. In islands the results are
equal to 1e-13 m/s, in crowds, at walls and at rest.

MuJoCo solves for each island (bodies that touch each other, here a robot) by itself, which costs
at each step and pays where an island needs more iterations than others. While one iteration is
enough for all, they are solved for together.

Processor time of 5 steps of 20 robots, µs:

=====================  =====  ==============  ================  ===============
robots                 dense  sparse, always  sparse, always    this
                              in islands      together
=====================  =====  ==============  ================  ===============
at rest                1388   935             651               647
half drive, in arcs    2357   1738            2670              1666
all drive into walls   4001   3197            4698              3078
=====================  =====  ==============  ================  ===============

What is decided depends on the state and on the number of steps made, not on how many of them are
asked for at once.
"""

import math

import mujoco
import numpy as np

from amr_description.sim.rollers import remake_constraints, RollerContacts

FEWEST = 4
"""Robots; with three, dense and sparse take the same time."""

INTERVAL = 5
"""Physics steps between two looks at the number of iterations."""

_NO_ISLANDS = int(mujoco.mjtDisableBit.mjDSBL_ISLAND)
_DENSE, _SPARSE = mujoco.mjtJacobian.mjJAC_DENSE, mujoco.mjtJacobian.mjJAC_SPARSE
_MARGIN = 0.1
"""m; by so much two robots can come closer in an interval: 10 m/s, with steps of 2 ms."""


class FleetSolver:
    """Chooses between dense and sparse, islands and none, for the model of a world."""

    def __init__(self, rollers: RollerContacts) -> None:
        """Begin without a model. ``rollers``: of the wheels of all robots."""
        self._rollers = rollers
        self._neighbours: _Neighbours | None = None
        self._together = False
        self._steps = 0
        self._flags = 0

    def __bool__(self) -> bool:
        """Return whether it has something to choose: the model has robots enough."""
        return self._neighbours is not None

    def bind(self, model: mujoco.MjModel) -> None:
        """Take a model that was compiled anew, whose options are those of the world."""
        self._flags = int(model.opt.disableflags)
        self._neighbours = None
        if _is_for(model):
            self._neighbours = _Neighbours(model)
            self.begin(model)

    def begin(self, model: mujoco.MjModel) -> None:
        """Begin anew, after the state was reset."""
        if self._neighbours is not None:
            model.opt.jacobian = _SPARSE
            self._steps = 0
            self._solve_together(model, False)

    def state(self) -> bytes:
        """Return what the next step depends on, beside the state of MuJoCo."""
        return bytes((self._together, self._steps)) if self else b''

    def step(self, model: mujoco.MjModel, data: mujoco.MjData, count: int) -> None:
        """Advance by ``count`` physics steps."""
        while count:
            part = min(count, INTERVAL - self._steps)
            self._advance(model, data, part)
            count -= part
            self._steps += part
            if self._steps == INTERVAL:
                self._steps = 0
                iterations = data.solver_niter[: max(1, data.nisland)]
                self._solve_together(model, max(iterations.tolist()) <= 1)

    def _solve_together(self, model: mujoco.MjModel, together: bool) -> None:
        self._together = together
        model.opt.disableflags = self._flags | (_NO_ISLANDS if together else 0)

    def _advance(self, model: mujoco.MjModel, data: mujoco.MjData, count: int) -> None:
        neighbours = self._neighbours
        assert neighbours is not None, 'the engine asks whether there is something to choose'
        if not self._rollers and not neighbours.are_near(data):
            mujoco.mj_step(model, data, count)
            return
        for _ in range(count):
            mujoco.mj_step1(model, data)
            touches = neighbours.touch(data)
            if touches:
                # Begun anew: making the constraints again is not enough (NaN, or a crash).
                model.opt.jacobian, model.opt.disableflags = _DENSE, self._flags
                mujoco.mj_step1(model, data)
            if self._rollers.turn(data):
                remake_constraints(model, data)
            mujoco.mj_step2(model, data)
            if touches:
                model.opt.jacobian = _SPARSE
                self._solve_together(model, self._together)


def _is_for(model: mujoco.MjModel) -> bool:
    """Return whether a model has robots enough, and options that are ours to choose."""
    names = (model.body(root).name for root in model.tree_bodyadr.tolist())
    robots = {name.partition('/')[0] for name in names if '/' in name}
    option = model.opt
    return (
        len(robots) >= FEWEST
        and option.jacobian == _DENSE
        and option.solver == mujoco.mjtSolver.mjSOL_NEWTON
        # Its steps cannot be divided, see sim/rollers.py.
        and option.integrator != mujoco.mjtIntegrator.mjINT_RK4
        and not _are_coupled(model)
    )


def _are_coupled(model: mujoco.MjModel) -> bool:
    """Return whether an equality or a tendon of the world holds two trees together."""
    if (model.tendon_treenum > 1).any():
        return True
    bodies = np.column_stack((model.eq_obj1id, model.eq_obj2id))
    kinds = model.eq_objtype
    if np.isin(kinds, (mujoco.mjtObj.mjOBJ_BODY, mujoco.mjtObj.mjOBJ_SITE)).any():
        return True  # URDF has none of them
    joints = bodies[model.eq_type == mujoco.mjtEq.mjEQ_JOINT]
    joints = joints[joints[:, 1] >= 0]
    trees = model.dof_treeid[model.jnt_dofadr[joints]]
    return bool((trees[:, 0] != trees[:, 1]).any())


class _Neighbours:
    """
    Tells whether kinematic trees touch, or could do so within :data:`INTERVAL` steps.

    Each is in a sphere around its root, whatever its joints' positions; so looking at contacts,
    which needs calls into C for each step, is left out where these are apart.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        trees = model.body_treeid[model.geom_bodyid]
        self._tree_of_geom = trees
        roots = model.tree_bodyadr
        self._centres, self._rows, self._positions = _places(model, roots)
        self.reaches = np.array(_reaches(model))
        """The radii of the spheres, m."""
        one, other = np.triu_indices(len(roots), 1)
        limits = self.reaches[one] + self.reaches[other] + _MARGIN
        self._one, self._other = one, other
        self._limits = np.where(limits > 0.0, limits * limits, 0.0)  # -inf: without any geom

    def are_near(self, data: mujoco.MjData) -> bool:
        """Return whether two trees could touch each other in the next steps."""
        centres = self.centres(data)
        apart = centres[self._one] - centres[self._other]
        return bool((np.einsum('ij,ij->i', apart, apart) < self._limits).any())

    def centres(self, data: mujoco.MjData) -> np.ndarray:
        """Return the centres of the spheres, m, a row each."""
        self._centres[self._rows] = data.qpos[self._positions]
        return self._centres

    def touch(self, data: mujoco.MjData) -> bool:
        """Return whether two trees touch each other, by the contacts that were last found."""
        one, other = self._tree_of_geom[data.contact.geom].T
        return bool(((one != other) & (one >= 0) & (other >= 0)).any())


def _places(model: mujoco.MjModel, roots: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """
    Return where the roots of all trees are, m, and which of them are free.

    Returns:
        The places, those of free ones unset; the rows of these; the indices of their three
        coordinates in ``qpos``.
    """
    still = mujoco.MjData(model)
    mujoco.mj_kinematics(model, still)
    joints = model.body_jntadr[roots]
    is_free = model.jnt_type[joints] == mujoco.mjtJoint.mjJNT_FREE
    first = model.jnt_qposadr[joints[is_free]]
    return still.xpos[roots], np.flatnonzero(is_free), first[:, None] + np.arange(3)


def _reaches(model: mujoco.MjModel) -> list[float]:
    """Return how far from its root each tree can have a geom that collides, m."""
    reaches = [-math.inf] * model.ntree
    trees, bodies = model.body_treeid.tolist(), model.geom_bodyid.tolist()
    to_body = _lengths(model)
    collides = (model.geom_contype | model.geom_conaffinity) != 0
    collides[model.pair_geom1] = collides[model.pair_geom2] = True
    sizes = np.linalg.norm(model.geom_pos, axis=1) + model.geom_rbound + model.geom_margin
    for geom, size in enumerate(sizes.tolist()):
        tree = trees[bodies[geom]]
        if tree >= 0 and collides[geom]:
            reaches[tree] = max(reaches[tree], to_body[bodies[geom]] + size)
    return reaches


def _lengths(model: mujoco.MjModel) -> list[float]:
    """Return the greatest distance of each body from where the root of its tree is, m."""
    parents, roots = model.body_parentid.tolist(), {*model.tree_bodyadr.tolist()}
    lengths = [0.0] * model.nbody
    offsets = np.linalg.norm(model.body_pos, axis=1).tolist()
    for body, tree in enumerate(model.body_treeid.tolist()):
        if tree >= 0 and body not in roots:
            lengths[body] = lengths[parents[body]] + offsets[body]
        first = int(model.body_jntadr[body])
        for joint in range(first, first + int(model.body_jntnum[body])):
            lengths[body] += _travel(model, joint)
    return lengths


def _travel(model: mujoco.MjModel, joint: int) -> float:
    """Return how far a joint can move the origin of its body, m; a free one is the root."""
    kind = model.jnt_type[joint]
    if kind == mujoco.mjtJoint.mjJNT_FREE:
        return 0.0
    if kind != mujoco.mjtJoint.mjJNT_SLIDE:
        return 2.0 * float(np.linalg.norm(model.jnt_pos[joint]))
    if not model.jnt_limited[joint]:
        return math.inf
    start = float(model.qpos0[model.jnt_qposadr[joint]])
    return float(np.abs(model.jnt_range[joint] - start).max())
