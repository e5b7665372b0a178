# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A camera on a robot: what it sees at an instant, with its noise; without ROS."""

from dataclasses import replace

import numpy as np

from amr_description.model.sensors import Camera
from amr_description.sim.cameras.pictures import PointMaker, with_noise
from amr_description.sim.cameras.renderer import RenderedPicture, Renderer, Shot
from amr_description.sim.robot_view import RobotView
from amr_description.sim.sensor_schedule import noise_generator
from amr_description.sim.state_copy import StateCopier


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
