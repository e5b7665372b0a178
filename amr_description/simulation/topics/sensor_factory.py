# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the sensors of a world measure with, and what makes their topics.

It is loaded with the first sensor: this is a tenth of the simulator's imports.
"""

from collections.abc import Callable, Mapping
from typing import Any

from amr_description.log import Log
from amr_description.model.sensors import Camera, ContactSensor, Lidar
from amr_description.sim.cameras.choice import ChosenRenderer
from amr_description.sim.state_copy import CopiedScenes, StateCopier
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.advertising import Topics
from amr_description.simulation.topics.camera import CameraTopics
from amr_description.simulation.topics.contact import ContactTopics
from amr_description.simulation.topics.lidar import LidarTopics, ray_budget
from amr_description.simulation.topics.sensor_topics import SensorContext, SensorTopics
from amr_description.simulation.topics.worker import SensorWorker

TOPICS: Mapping[type, Callable[[Any, SensorContext], SensorTopics]] = {
    Lidar: LidarTopics,
    ContactSensor: ContactTopics,
    Camera: CameraTopics,
}
"""Type of a sensor's description → what makes its topics."""


class SensorFactory:
    """What all sensors of a world share."""

    def __init__(
        self,
        topics: Topics,
        world: MujocoWorld,
        log: Log,
        is_paced: Callable[[], bool],
        camera_renderer: str,
        begin_thread: Callable[[], None] | None,
    ) -> None:
        """Take what the SensorManager was given."""
        self._topics = topics
        self._world = world
        self._log = log
        self._worker = SensorWorker(topics.followers, log, is_paced, begin_thread)
        self._states = StateCopier(world)
        self._scenes = CopiedScenes()
        self._ray_budget = ray_budget()
        self.renderer = ChosenRenderer(camera_renderer, log)
        """Of the pictures of cameras."""

    def context(self, name: str, namespace: str) -> SensorContext:
        """Return what a sensor of a robot is given, by the name of that in the world."""
        return SensorContext(
            self._topics,
            self._world,
            self._world.robot(name),
            namespace,
            self._log,
            self._worker,
            self._states,
            self._scenes,
            self._ray_budget,
            self.renderer,
        )

    def stop(self) -> None:
        """Begin no measurement any more, and have nobody wait for one."""
        self._worker.stop()

    def close(self) -> None:
        """End the thread that measures; the control thread has ended."""
        self._worker.close(self.renderer.close)
