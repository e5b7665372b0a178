# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a simulation in this process publishes beside its controllers, and the recording of all of it.

Sensors, ground truth and the rest are made when the first recording begins: before they have no
subscribers. Then each message is that which the simulator over ROS records at the same time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from typing import Any, TYPE_CHECKING

from amr_description.clock import NANOSECONDS
from amr_description.control.loop import Loop
from amr_description.log import Log
from amr_description.model.sensors import WorldSensor
from amr_description.parameters import specs
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.parameters import SimulationParameters
from amr_description.simulation.publishing import LATCHED, PlainPublisher
from amr_description.simulation.topics.link_transforms import LinkTransforms, SpawnedRobot

if TYPE_CHECKING:  # for who records
    from amr_description.simulation.run_recording import RunRecording
    from amr_description.simulation.topics.ground_truth import GroundTruth
    from amr_description.simulation.topics.sensor_manager import SensorManager

_WORLD = '/mujoco_sim/world'
BEFORE = -NANOSECONDS
"""ns; sensors measure at time 0, too."""


@dataclass
class PublishedRobot:
    """A robot of which there are topics."""

    spawned: SpawnedRobot
    sensors: Sequence[WorldSensor]
    since: int
    """Up to when no sensor measures, ns: when it was spawned; :data:`BEFORE` time 0."""


class Published:
    """See the module."""

    def __init__(
        self,
        world: MujocoWorld,
        log: Log,
        settings: SimulationParameters,
    ) -> None:
        """
        Publish nothing yet.

        Args:
            world: The simulated world, which is still without robots.
            log: Of the simulator.
            settings: Of the simulation.
        """
        self.publisher = PlainPublisher(log)
        self._world, self._log, self._settings = world, log, settings
        self.loop: Loop
        """Publishes by :attr:`publisher`; set once it is made."""
        self._robots: dict[str, PublishedRobot] = {}
        self._topics: _Topics | None = None

    def add(self, robot: SpawnedRobot, sensors: Sequence[WorldSensor]) -> None:
        """Take in a robot that is in the world."""
        since = self._world.time or BEFORE
        published = self._robots[robot.name] = PublishedRobot(robot, sensors, since)
        if self._topics is not None:
            self._topics.add(published, since)
            self._topics.recording.update()

    def remove(self, name: str) -> None:
        """Let go of a robot that is removed."""
        self._robots.pop(name, None)
        if self._topics is not None:
            self._topics.remove(name)
            self._topics.recording.update()

    def restart(self) -> None:
        """Have all that has a rate be due in the next cycle: time goes back."""
        for robot in self._robots.values():
            robot.since = BEFORE
        if self._topics is not None:
            self._topics.truth.restart()
            self._topics.sensors.restart()
            self._topics.recording.restart()

    def record(self, folder: str | Path) -> None:
        """Begin to record to a folder, which is made. Raises SimulationError."""
        if self._topics is None:
            self._topics = self._make()
        self._topics.recording.switch(str(folder))

    def _make(self) -> '_Topics':
        from amr_description.simulation.run_recording import describe_run, RunRecording
        from amr_description.simulation.topics.ground_truth import GroundTruth
        from amr_description.simulation.topics.sensor_manager import SensorManager
        from amr_description.simulation.topics.world_markers import TYPE, world_markers

        world, log, publisher, settings = self._world, self._log, self.publisher, self._settings
        loop, values = self.loop, _values(settings)
        markers = world_markers(MujocoWorld(settings.world, settings=settings.physics).engine)
        publisher.messages(_WORLD, TYPE, LATCHED).publish(lambda: markers)

        def has_ticked(time: int) -> bool:
            return loop.latest_tick == time

        truth = GroundTruth(publisher, world, settings.ground_truth_rate, has_ticked)
        renderer = settings.camera_renderer
        sensors = SensorManager(publisher, world, log, lambda: False, has_ticked, renderer)

        def spawned() -> list[SpawnedRobot]:
            return [each.spawned for each in self._robots.values()]

        recording = RunRecording(
            publisher,
            on_loop=lambda call: call(),
            time=lambda: world.time,
            has_ticked=has_ticked,
            is_paced=lambda: False,
            describe=lambda: describe_run(
                {**values, 'seed': world.seed}.__getitem__, settings.world, spawned()
            ),
            robots=spawned,
            transforms=LinkTransforms(world),
            log=log,
        )
        recording.on_begin = truth.restart
        topics = _Topics(truth, sensors, recording)
        latest = BEFORE if loop.latest_tick is None else loop.latest_tick
        for robot in self._robots.values():
            topics.add(robot, max(robot.since, latest))
        return topics

    def end_recording(self) -> None:
        """Complete the bag, if there is one. Raises SimulationError."""
        if self._topics is not None:
            self._topics.recording.end()

    def close(self) -> None:
        """End the recording; what goes wrong is logged."""
        if self._topics is not None:
            self._topics.recording.close()
            self._topics.sensors.close()


@dataclass(frozen=True)
class _Topics:
    """What is made with the first recording."""

    truth: 'GroundTruth'
    sensors: 'SensorManager'
    recording: 'RunRecording'

    def add(self, robot: PublishedRobot, since: int) -> None:
        spawned = robot.spawned
        self.truth.add(spawned.name, spawned.namespace)
        self.sensors.add(spawned.name, spawned.namespace, robot.sensors, since)

    def remove(self, name: str) -> None:
        self.truth.remove(name)
        self.sensors.remove(name)


def _values(settings: SimulationParameters) -> dict[str, Any]:
    """Return the values of all parameters by their names, such as ``physics.gravity``."""
    return {
        spec.name: reduce(getattr, spec.name.split('.'), settings)
        for spec in specs(SimulationParameters)
    }
