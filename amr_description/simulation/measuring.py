# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Readings of sensors, made of what they measure at the present instant."""

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.log import Log
from amr_description.model.frames import Vector
from amr_description.model.sensors import (
    Camera,
    ContactSensor,
    frame_in,
    Lidar,
    SensorMount,
    WorldSensor,
)
from amr_description.sim.cameras.choice import ChosenRenderer
from amr_description.sim.cameras.pictures import encoded
from amr_description.sim.cameras.renderer import RenderedPicture, Shot
from amr_description.sim.cameras.simulated_camera import FIELD_OF_VIEW, SimulatedCamera, viewpoint
from amr_description.sim.contact_sensor import SimulatedContacts
from amr_description.sim.lidar import (
    cloud_rays,
    LidarScan as Measurement,
    met_ranges,
    scan_angles,
    SimulatedLidar,
)
from amr_description.sim.robot_view import RobotView
from amr_description.sim.state_copy import CopiedPoses, StateCopier
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.readings import Contact, Image, Points, Scan

_NOWHERE = SensorMount('picture', '')
"""On no link of any robot."""


class Measuring:
    """Measures for all sensors of a world, each of which is prepared when it is first read."""

    def __init__(self, world: MujocoWorld, camera_renderer: str, log: Log) -> None:
        """
        Prepare nothing yet.

        Args:
            world: The simulated world.
            camera_renderer: One of :data:`~amr_description.sim.cameras.CHOICES`.
            log: Of the simulator.
        """
        self._world, self._log = world, log
        self._states, self._poses = StateCopier(world), CopiedPoses()
        self._renderer = ChosenRenderer(camera_renderer, log)
        self._lidars: dict[RobotView, dict[str, SimulatedLidar]] = {}
        self._cameras: dict[RobotView, dict[str, SimulatedCamera]] = {}
        self._bumpers: dict[RobotView, dict[str, SimulatedContacts]] = {}

    def scan(self, view: RobotView, lidar: Lidar, namespace: str) -> Scan:
        """Return what a lidar sees, of several rings the middle one."""
        scan = self._lidar(view, lidar)
        lower, _, increment = scan_angles(lidar.horizontal)
        ranges = scan.ranges[scan.middle_ring]
        return Scan(
            *self._header(lidar.mount, namespace),
            ranges=ranges,
            angles=lower + increment * np.arange(len(ranges)),
            range_min=float(np.float32(lidar.range_min)),  # as the message has them
            range_max=float(np.float32(lidar.range_max)),
        )

    def image(self, view: RobotView, camera: Camera, namespace: str) -> Image:
        """Return the colours that a camera sees, or their greys."""
        color = self._shoot(view, camera, with_color=True)[1].color
        assert color is not None, 'it was asked for'
        pixels = encoded(color, camera.encoding) if camera.encoding == 'mono8' else color
        return Image(*self._header(camera.mount, namespace), pixels)

    def depth(self, view: RobotView, camera: Camera, namespace: str) -> Image:
        """Return the depths that a camera sees."""
        depth = self._shoot(view, camera, with_depth=True)[1].depth
        assert depth is not None, 'it was asked for'
        return Image(*self._header(camera.mount, namespace), depth)

    def points(self, view: RobotView, sensor: WorldSensor, namespace: str) -> Points:
        """Return the cloud that a camera or lidar sees."""
        time, frame = self._header(sensor.mount, namespace)
        if isinstance(sensor, Lidar):
            ranges = met_ranges(self._lidar(view, sensor))
            return Points(time, frame, ranges[:, :, None] * cloud_rays(sensor))
        assert isinstance(sensor, Camera), 'nothing else has points'
        has_color = bool(sensor.image_topic)
        camera, picture = self._shoot(view, sensor, with_color=has_color, with_depth=True)
        if sensor.points_frame:
            frame = frame_in(namespace, sensor.points_frame)
        return Points(time, frame, camera.points(picture)[:, :, :3])

    def contacts(self, view: RobotView, sensor: ContactSensor) -> list[Contact]:
        """Return what touches a contact sensor."""
        known, path = self._bumpers.setdefault(view, {}), sensor.mount.path
        if path not in known:
            known[path] = SimulatedContacts(sensor, self._world, view, self._log)
        return [Contact(each.own, each.other) for each in known[path].read()]

    def picture(
        self, position: Vector | None, target: Vector | None, width: int, height: int
    ) -> Image:
        """Return what a camera sees that no robot carries; see :func:`viewpoint`."""
        state = self._states.copy()
        pose = viewpoint(state, self._poses.data(state), position, target, height / width)
        camera = Camera(_NOWHERE, width, height, FIELD_OF_VIEW, near=0.01, image_topic='picture')
        shot = Shot(camera, pose, body='', state=state, with_color=True, with_depth=False)
        color = self._renderer.render(shot).color
        assert color is not None, 'it was asked for'
        return Image(self._world.time / NANOSECONDS, 'world', color)

    def forget(self, view: RobotView) -> None:
        """Let go of the sensors of a robot."""
        self._lidars.pop(view, None)
        self._cameras.pop(view, None)
        self._bumpers.pop(view, None)

    def close(self) -> None:
        """Let go of everything."""
        self._renderer.close()

    def _header(self, mount: SensorMount, namespace: str) -> tuple[float, str]:
        """Return time, s, and frame."""
        frame = frame_in(namespace, mount.frame or mount.link)
        return self._world.time / NANOSECONDS, frame

    def _lidar(self, view: RobotView, lidar: Lidar) -> Measurement:
        known, path = self._lidars.setdefault(view, {}), lidar.mount.path
        if path not in known:
            known[path] = SimulatedLidar(lidar, view)
        simulated = known[path]
        return simulated.measure(self._world.time, simulated.body(), self._world.ray_scene())

    def _shoot(
        self,
        view: RobotView,
        camera: Camera,
        *,
        with_color: bool = False,
        with_depth: bool = False,
    ) -> tuple[SimulatedCamera, RenderedPicture]:
        known, path = self._cameras.setdefault(view, {}), camera.mount.path
        if path not in known:
            known[path] = SimulatedCamera(camera, view, self._states)
        simulated = known[path]
        shot = simulated.shot(with_color=with_color, with_depth=with_depth)
        return simulated, simulated.picture(self._renderer, self._world.time, shot)
