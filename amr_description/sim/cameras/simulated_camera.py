# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A camera on a robot: what it sees at an instant, with its noise; without ROS."""

from dataclasses import replace
import math

import mujoco
import numpy as np

from amr_description.errors import SimulationError
from amr_description.model.frames import quaternion_from_rpy, Transform, Vector
from amr_description.model.sensors import Camera
from amr_description.sim.cameras.pictures import PointMaker, with_noise
from amr_description.sim.cameras.renderer import RenderedPicture, Renderer, Shot
from amr_description.sim.robot_view import RobotView
from amr_description.sim.sensor_schedule import noise_generator
from amr_description.sim.state_copy import StateCopier, StateCopy

FIELD_OF_VIEW = 1.0
"""rad, horizontal."""
_FROM = np.array((0.45, -0.75, 0.5))
"""From what is looked at to the camera, if no position is given: in front, to the right, above."""
_MARGIN = 1.25
"""So much of the picture is around the robots."""
_NOBODY = 1.0
"""m, the radius of what is looked at in a world without robots: its origin."""


def viewpoint(
    state: StateCopy,
    data: mujoco.MjData,
    position: Vector | None,
    target: Vector | None,
    aspect: float,
) -> Transform:
    """
    Return the pose of a camera in the world: x forward, z up.

    Args:
        state: Of the world with the robots; if no position is given, all are in the picture.
        data: The poses of that state.
        position: Of the camera, m; None: far enough from the target.
        target: What it looks at, m; None: the middle of the robots.
        aspect: Height of the picture, by its width.

    Raises:
        SimulationError: A coordinate is no number, or both are the same point.
    """
    center, radius = _extent_of(state, data)
    to = center if target is None else np.array(target, float)
    if position is None and to.shape == center.shape:
        half = math.atan(math.tan(FIELD_OF_VIEW / 2) * min(1.0, aspect))
        radius += float(np.linalg.norm(to - center))
        at = to + _FROM / np.linalg.norm(_FROM) * _MARGIN * radius / math.sin(half)
    else:
        at = np.array(() if position is None else position, float)
    points = at.shape == to.shape == (3,) and np.isfinite((at, to)).all()
    if not points or np.array_equal(at, to):
        raise SimulationError(
            f'a camera at {_named(at)} cannot look at {_named(to)}; it takes two points of x, y '
            'and z, in m'
        )
    x, y, z = (to - at).tolist()
    turn = quaternion_from_rpy(0.0, -math.atan2(z, math.hypot(x, y)), math.atan2(y, x))
    return Transform((float(at[0]), float(at[1]), float(at[2])), turn)


def _extent_of(state: StateCopy, data: mujoco.MjData) -> tuple[np.ndarray, float]:
    """Return the middle of all robots, m, and the radius of the ball around them."""
    model, prefixes = state.model, tuple(f'{name}/' for name in state.robots)
    bodies = [body for body in range(model.nbody) if model.body(body).name.startswith(prefixes)]
    geoms = np.flatnonzero(np.isin(model.geom_bodyid, bodies) & (model.geom_rbound > 0.0))
    if not len(geoms):
        return np.zeros(3), _NOBODY
    middles, radii = data.geom_xpos[geoms], model.geom_rbound[geoms]
    low = (middles - radii[:, None]).min(axis=0)
    high = (middles + radii[:, None]).max(axis=0)
    center = (low + high) / 2.0
    return center, float((np.linalg.norm(middles - center, axis=1) + radii).max())


def _named(point: np.ndarray) -> str:
    return f'({", ".join(f"{each:g}" for each in np.ravel(point).tolist())})'


class SimulatedCamera:
    """
    A camera on a robot.

    :meth:`shot` is called on the control thread, everything else on any one, but one at a time.
    """

    def __init__(self, camera: Camera, robot: RobotView, states: StateCopier) -> None:
        """
        Take a camera.

        Args:
            camera: Its description.
            robot: The robot that carries it.
            states: Copies the state of an instant.
        """
        self.camera = camera
        self._robot, self._states = robot, states
        self._points: PointMaker | None = None

    def shot(self, *, with_color: bool, with_depth: bool) -> Shot:
        """Return the picture that is to be made of the present instant."""
        mount = self.camera.mount
        return Shot(
            self.camera,
            self._robot.pose(mount.link) @ mount.pose,
            f'{self._robot.name}/{mount.link}',
            self._states.copy(),
            with_color=with_color,
            with_depth=with_depth,
        )

    def picture(self, renderer: Renderer, time: int, shot: Shot) -> RenderedPicture:
        """
        Make a picture, with its noise.

        Args:
            renderer: Makes it.
            time: Of the shot, ns.
            shot: Of this camera.
        """
        camera, picture = self.camera, renderer.render(shot)
        generator = noise_generator(self._robot.seed, camera.mount.path, time)
        if not camera.image_topic:
            return with_noise(picture, camera.noise, generator)
        if picture.color is None:
            return picture
        # The depth of a camera with colours has none.
        colored = with_noise(replace(picture, depth=None), camera.noise, generator)
        return RenderedPicture(colored.color, picture.depth)

    def points(self, picture: RenderedPicture) -> np.ndarray:
        """Return the points of a picture with depth; see :meth:`PointMaker.points`."""
        if self._points is None:
            self._points = PointMaker(self.camera, with_color=bool(self.camera.image_topic))
        assert picture.depth is not None, 'it was asked for'
        return self._points.points(picture.depth, picture.color)
