# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics of one sensor of one robot: what each kind of sensor implements."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field

from amr_description.log import Log
from amr_description.model.sensors import frame_in, SensorMount
from amr_description.sim.cameras.renderer import Renderer
from amr_description.sim.robot_view import RobotView
from amr_description.sim.sensor_schedule import CycleBudget
from amr_description.sim.state_copy import CopiedScenes, StateCopier
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.advertising import Encode, Topic, Topics
from amr_description.simulation.topics.worker import SensorWorker


@dataclass(frozen=True, slots=True)
class SensorContext:
    """What a sensor is given."""

    topics: Topics
    """Publish at the end of a cycle, after the transforms of the same instant."""
    world: MujocoWorld
    robot: RobotView
    """The robot that carries the sensor; its ``seed`` seeds the noise."""
    namespace: str
    """Of the robot, absolute: ``/`` or ``/robot1``."""
    log: Log
    worker: SensorWorker
    """Makes measurements that take long, on its thread."""
    states: StateCopier
    """Copies the state of an instant for it."""
    scenes: CopiedScenes
    """What is to be seen in these copies; on the thread of ``worker``."""
    ray_budget: CycleBudget
    """The rays that lidars may cast on the control thread in one cycle."""
    renderer: Renderer
    """Makes the pictures of cameras; on the thread of ``worker``."""
    advertised: list[Topic] = field(default_factory=list)
    """The topics of this sensor."""

    def advertise(self, name: str, mount: SensorMount, message: str, encode: Encode) -> Topic:
        """Make a topic of the sensor. Raises AmrError."""
        topic = self.topics.advertise(self.topic(name, mount), message, encode)
        self.advertised.append(topic)
        return topic

    def withdraw(self) -> None:
        """Remove the topics of the sensor."""
        for topic in self.advertised:
            self.topics.withdraw(topic)
        self.advertised.clear()

    def topic(self, name: str, mount: SensorMount) -> str:
        """Return the full name of a topic of a sensor; '' stays ''."""
        return mount.full_name(name, self.namespace)

    def frame(self, name: str) -> str:
        """Return a frame with the prefix that all frames of the robot have: its namespace."""
        return frame_in(self.namespace, name)


class SensorTopics(ABC):
    """
    The topics of one sensor of one robot.

    Made by :data:`~amr_description.simulation.topics.sensor_factory.TOPICS`; all else is called on
    the control thread, at the end of a cycle.
    """

    @property
    @abstractmethod
    def has_subscribers(self) -> bool:
        """Whether anybody subscribes to one of them; nothing is measured else."""

    @abstractmethod
    def measure(self, time: int) -> None:
        """
        Measure, and publish.

        What takes long is done by another thread, from a copy of the state of this instant, with
        this stamp; see :class:`SensorWorker`.

        Args:
            time: Of this cycle, ns.
        """

    def answer(self, time: int) -> None:
        """
        Measure, and publish whatever there is, since somebody asked.

        For sensors that publish nothing when there is nothing to say.

        Args:
            time: Of this cycle, ns.
        """
        self.measure(time)
