# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""All sensors of all robots of a world: which one measures, and when."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeAlias

from amr_description.errors import AmrError
from amr_description.log import Log, Severity
from amr_description.model.sensors import WorldSensor
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.advertising import Topics

if TYPE_CHECKING:  # a tenth of the simulator's start; most robots have no such sensors
    from amr_description.sim.sensor_schedule import SensorSchedule
    from amr_description.simulation.topics.sensor_factory import SensorFactory
    from amr_description.simulation.topics.sensor_topics import SensorContext, SensorTopics

    _Sensor: TypeAlias = tuple[SensorSchedule, SensorTopics, SensorContext]


class SensorManager:
    """
    The sensors of all robots of a world.

    :meth:`add` and :meth:`remove` are called on the ROS thread, :meth:`report` on the control
    thread.
    """

    def __init__(
        self,
        topics: Topics,
        world: MujocoWorld,
        log: Log,
        is_paced: Callable[[], bool],
        has_ticked: Callable[[int], bool] = lambda time: True,
        camera_renderer: str = 'auto',
        begin_thread: Callable[[], None] | None = None,
    ) -> None:
        """
        Measure and publish from now on, at the end of control cycles.

        Args:
            topics: Publish at the end of a cycle.
            world: The simulated world.
            log: Of the simulator.
            is_paced: See :class:`~amr_description.simulation.topics.worker.SensorWorker`.
            has_ticked: Whether the controllers have ticked at a time, ns. Sensors measure at
                ticks, so that the odometry of their instant goes out before.
            camera_renderer: One of :data:`~amr_description.sim.cameras.CHOICES`.
            begin_thread: What the thread that measures does first; None: there is none.
        """
        self._topics = topics
        self._begin_thread = begin_thread
        self._world = world
        self._log = log
        self._is_paced = is_paced
        self._has_ticked = has_ticked
        self._camera_renderer = camera_renderer
        self._equipment: SensorFactory | None = None
        self._robots: dict[str, tuple[_Sensor, ...]] = {}
        self._is_requested = False
        self.on_first: Callable[[], None] | None = None
        """Called when the first sensor comes."""
        topics.reporters.append(self.report)

    def add(
        self,
        name: str,
        namespace: str,
        sensors: Sequence[WorldSensor],
        since: int | None = None,
    ) -> None:
        """
        Create the topics of a robot.

        Args:
            name: Of the robot in the world.
            namespace: Of its topics, absolute.
            sensors: Of the robot.
            since: Which instants are past, ns; None: all up to now.
        """
        if not sensors:
            return
        from amr_description.sim.sensor_schedule import SensorSchedule
        from amr_description.simulation.topics.sensor_factory import SensorFactory, TOPICS

        if self._equipment is None:
            self._equipment = SensorFactory(
                self._topics,
                self._world,
                self._log,
                self._is_paced,
                self._camera_renderer,
                self._begin_thread,
            )
        if self.on_first is not None:
            self.on_first()
            self.on_first = None
        now = self._world.time if since is None else since
        made = []
        for sensor in sensors:
            context = self._equipment.context(name, namespace)
            try:
                topics = TOPICS[type(sensor)](sensor, context)
            except AmrError as error:
                context.withdraw()  # some of its topics may be there
                text = f"sensor '{sensor.mount.name}' of '{name}' measures nothing: "
                self._log(Severity.WARN, f'{text}{error}')
                continue
            made.append((SensorSchedule(sensor.mount.rate, now), topics, context))
        self._robots = self._robots | {name: tuple(made)}

    def remove(self, name: str) -> None:
        """Remove the topics of a robot that is removed from the world."""
        sensors = self._robots.get(name)
        if sensors is not None:
            self._robots = {key: each for key, each in self._robots.items() if key != name}
            for _, _, context in sensors:
                context.withdraw()

    def stop(self) -> None:
        """Have the control thread wait for no measurement any more."""
        if self._equipment is not None:
            self._equipment.stop()

    def close(self) -> None:
        """End the thread that measures; the control thread has ended."""
        if self._equipment is not None:
            self._equipment.close()

    def restart(self) -> None:
        """Have all measure at time 0, which time goes back to; on the control thread."""
        for sensors in self._robots.values():
            for schedule, _, _ in sensors:
                schedule.restart()

    def request(self) -> None:
        """Have the sensors with subscribers measure in the next cycle; on the control thread."""
        self._is_requested = True

    def report(self, time: int) -> None:
        """Have the sensors with subscribers measure that are due at ``time``, ns, or requested."""
        if not self._robots:
            return
        is_requested, self._is_requested = self._is_requested, False
        is_tick = self._has_ticked(time)
        if not (is_tick or is_requested):
            return
        present = self._world.names
        for name, sensors in self._robots.items():
            if name in present:
                for schedule, topics, _ in sensors:
                    is_due = is_tick and schedule.is_due(time)
                    if is_requested and topics.has_subscribers:
                        topics.answer(time)
                    elif is_due and topics.has_subscribers:
                        topics.measure(time)
