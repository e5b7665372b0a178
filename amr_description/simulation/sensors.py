# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the sensors of a robot see at the present instant, whatever their rates.

They measure when they are read, from the state of that instant and with its noise: no time passes,
and what is not read costs nothing. What they measure with is imported with the first sensor.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from amr_description.errors import SimulationError
from amr_description.log import Log
from amr_description.model.sensors import Camera, ContactSensor, Lidar, WorldSensor
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.readings import Contact, Image, Points, Scan
from amr_description.simulation.tracebacks import is_for_the_test

if TYPE_CHECKING:  # a tenth of the start; most robots have no such sensors
    from amr_description.simulation.measuring import Measuring

__tracebackhide__ = is_for_the_test

_Sensor = TypeVar('_Sensor', Camera, Lidar, ContactSensor)

SCAN, IMAGE, CLOUD = (
    'sensor_msgs/msg/LaserScan',
    'sensor_msgs/msg/Image',
    'sensor_msgs/msg/PointCloud2',
)
DEPTH = f'{IMAGE} (depth)'
CONTACTS = ('ros_gz_interfaces/msg/Contacts', 'gazebo_msgs/msg/ContactsState')


class SensorTopics:
    """The topics of the sensors of one robot, by which they are called."""

    def __init__(self, name: str, sensors: Sequence[WorldSensor], namespace: str) -> None:
        """
        Take the topics.

        Args:
            name: Of the robot, for errors.
            sensors: Of its description.
            namespace: Of its topics, absolute.
        """
        self._name, self._namespace = name, namespace
        found = [*_topics_of(sensors, namespace)]
        self.sensors = {topic: sensor for topic, _, sensor in found}
        """By the full names of their topics."""
        self.kinds = {topic: kind for topic, kind, _ in found}
        """Types of messages; of depths :data:`DEPTH`."""

    def chosen(self, kinds: Sequence[str], topic: str) -> str:
        """
        Return the full name of the only topic of some kinds, or of the one that is named.

        Raises SimulationError, which lists those that are there.
        """
        topics = [name for name, kind in self.kinds.items() if kind in kinds]
        wanted = f'{self._namespace.rstrip("/")}/{topic}' if topic[:1] not in ('', '/') else topic
        if wanted in topics or (len(topics) == 1 and not topic):
            return wanted or topics[0]
        kind = kinds[0].replace(DEPTH, f'{IMAGE} of depth')
        all_of_it = ', '.join(f'{name} ({kind})' for name, kind in self.kinds.items()) or 'none'
        if topics and not topic:
            raise SimulationError(
                f"'{self._name}' has {len(topics)} topics of {kind}; name one: {', '.join(topics)}"
            )
        asked = f"'{wanted}' of {kind}" if topic else f'of {kind}'
        raise SimulationError(
            f"no sensor of '{self._name}' has a topic {asked}; its sensors have: {all_of_it}"
        )


class Instruments:
    """What the sensors of a world measure with."""

    def __init__(self, world: MujocoWorld, camera_renderer: str, log: Log) -> None:
        """
        Measure with nothing yet.

        Args:
            world: The simulated world.
            camera_renderer: One of :data:`~amr_description.sim.cameras.CHOICES`.
            log: Of the simulator.
        """
        self._world, self._camera_renderer, self._log = world, camera_renderer, log

    @cached_property
    def measuring(self) -> 'Measuring':
        """They themselves."""
        from amr_description.simulation.measuring import Measuring

        return Measuring(self._world, self._camera_renderer, self._log)

    def forget(self, view: RobotView) -> None:
        """Let go of the sensors of a robot."""
        if 'measuring' in self.__dict__:
            self.measuring.forget(view)

    def close(self) -> None:
        """Let go of everything."""
        if 'measuring' in self.__dict__:
            self.measuring.close()


class RobotSensors:
    """The sensors of one robot."""

    def __init__(
        self,
        instruments: Instruments,
        view: RobotView,
        sensors: Sequence[WorldSensor],
        namespace: str,
        altered: Mapping[str, Sequence[Callable[[Scan], Scan]]],
    ) -> None:
        """
        Take the sensors.

        Args:
            instruments: Of the world.
            view: The robot in the world.
            sensors: Of its description.
            namespace: Of its topics, absolute.
            altered: What is made of scans that are read, by the names of robots.
        """
        self._instruments, self._view, self._namespace = instruments, view, namespace
        self._altered = altered
        self._topics = SensorTopics(view.name, sensors, namespace)

    @property
    def kinds(self) -> Mapping[str, str]:
        """By the full names of topics: types of messages; of depths :data:`DEPTH`."""
        return self._topics.kinds

    def scan(self, topic: str = '') -> Scan:
        """Return what a lidar sees now; of the only one, or of that with a topic."""
        lidar = self._found(Lidar, (SCAN,), topic)
        scan = self._measuring.scan(self._view, lidar, self._namespace)
        for alter in self._altered.get(self._view.name, ()):
            scan = alter(scan)
        return scan

    def image(self, topic: str = '') -> Image:
        """Return the colours that a camera sees now."""
        camera = self._found(Camera, (IMAGE,), topic)
        return self._measuring.image(self._view, camera, self._namespace)

    def depth(self, topic: str = '') -> Image:
        """Return the depths that a camera sees now."""
        camera = self._found(Camera, (DEPTH,), topic)
        return self._measuring.depth(self._view, camera, self._namespace)

    def points(self, topic: str = '') -> Points:
        """Return the cloud that a camera or lidar sees now."""
        sensor = self._topics.sensors[self._topics.chosen((CLOUD,), topic)]
        return self._measuring.points(self._view, sensor, self._namespace)

    def contacts(self, topic: str = '') -> list[Contact]:
        """Return what touches a contact sensor now."""
        sensor = self._found(ContactSensor, CONTACTS, topic)
        return self._measuring.contacts(self._view, sensor)

    def close(self) -> None:
        """Let go of them, as their robot is removed."""
        self._instruments.forget(self._view)

    @property
    def _measuring(self) -> 'Measuring':
        return self._instruments.measuring

    def _found(self, kind: type[_Sensor], kinds: Sequence[str], topic: str) -> _Sensor:
        """Return the sensor of a topic. Raises SimulationError."""
        sensor = self._topics.sensors[self._topics.chosen(kinds, topic)]
        assert isinstance(sensor, kind), 'its topics are of this kind'
        return sensor


def _topics_of(
    sensors: Sequence[WorldSensor], namespace: str
) -> Iterator[tuple[str, str, WorldSensor]]:
    """Yield (topic, its type, its sensor) of the sensors of a robot."""
    for sensor in sensors:
        depth = sensor.depth_topic if isinstance(sensor, Camera) else None
        for name, kind in sensor.topics:
            yield sensor.mount.full_name(name, namespace), DEPTH if name == depth else kind, sensor
