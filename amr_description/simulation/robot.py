# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot of a simulation in this process: what it is sent, and what is read of it."""

from collections.abc import Iterable, Iterator, Mapping
import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.control.samples import (
    BodyOdometrySample,
    JointStateSample,
    OdometrySample,
    TwistSample,
)
from amr_description.errors import SimulationError
from amr_description.model.frames import conjugate, rotate, Transform
from amr_description.model.robot import Robot as RobotDescription
from amr_description.model.sensors import frame_in
from amr_description.sim.robot_view import RobotView
from amr_description.simulation.api import RobotApi
from amr_description.simulation.local_manager import LocalManager
from amr_description.simulation.plain_controllers import Newest, PlainController
from amr_description.simulation.readings import Joint, Joints, Motion
from amr_description.simulation.sensors import RobotSensors
from amr_description.simulation.spawned_controllers import BROADCASTER, Topics
from amr_description.simulation.topics.link_transforms import (
    fixed_places,
    moving_places,
    SpawnedRobot,
    TYPE as TF_TYPE,
)
from amr_description.simulation.tracebacks import is_for_the_test

__tracebackhide__ = is_for_the_test


class Robot(RobotApi):
    """See :class:`~amr_description.simulation.api.RobotApi`."""

    def __init__(
        self,
        view: RobotView,
        spawned: SpawnedRobot,
        namespace: str,
        manager: LocalManager | None,
        topics: Topics,
        sensors: RobotSensors,
    ) -> None:
        """
        Take a robot.

        Args:
            view: In the world.
            spawned: The same, as it was spawned.
            namespace: As it was given.
            manager: None: it has no hardware.
            topics: Of its active controllers.
            sensors: That look at the world.
        """
        self.name, self.namespace = view.name, namespace
        self.inside = spawned.namespace
        """The namespace that its topics are in, absolute."""
        self.command_topic = topics.command
        self.manager = manager
        """Its controllers can be loaded, switched and so on."""
        self._view, self._spawned, self._sensors = view, spawned, sensors
        self.root_frame = frame_in(spawned.namespace, spawned.robot.root.name)
        """Of TF."""
        self.topics = topics
        """Of its active controllers, when it was spawned."""
        self.sensor_topics: Mapping[str, str] = sensors.kinds
        """Of what its sensors see, by name: types of messages."""
        self._odometry: tuple[Any, Any] = (None, None)
        """The newest that was read: its sample, and what it says."""
        self._outputs: Mapping[str, Newest] = manager.outputs if manager else {}

    @property
    def description(self) -> RobotDescription:
        """Its links and joints."""
        return self._view.description

    def twist(self, linear: float, angular: float) -> TwistSample:
        """Return a command, m/s and rad/s, for :attr:`command_topic`."""
        return TwistSample(0, float(linear), float(angular))

    @property
    def truth(self) -> Motion:
        """How the robot's root link really moves in the world, at this instant."""
        view = self._view
        root = view.description.root.name
        pose = view.pose(root)
        back = conjugate(pose.rotation)
        # By way of the axes of the world, as over ROS: the same bits.
        linear, angular = (rotate(pose.rotation, each) for each in view.velocity(root))
        return Motion(view.time / NANOSECONDS, pose, rotate(back, linear), rotate(back, angular))

    @property
    def odometry(self) -> Motion:
        """The last odometry of the drive, with its own stamp (:attr:`Motion.time`)."""
        sample = self._newest(self.topics.odometry, 'drive')
        if sample is not self._odometry[0]:  # it is published at half the rate of most loops
            self._odometry = (sample, _motion_of(sample))
        return self._odometry[1]

    @property
    def has_odometry(self) -> bool:
        """Whether its drive has published odometry since the reset."""
        return self.sample(self.topics.odometry) is not None

    @property
    def joints(self) -> dict[str, Joint]:
        """The last state of each joint, by name, from the JointStateBroadcaster."""
        sample: JointStateSample = self._newest(self.topics.joints, BROADCASTER)
        rows = zip(sample.name, sample.position, sample.velocity, sample.effort, strict=True)
        return Joints({name: Joint(*values) for name, *values in rows})

    def ports(self, kind: type, name: str) -> Iterator[Any]:
        """Yield the inputs, services or actions of its controllers with a name, a full one."""
        for controller in self._served:
            yield from controller.ports[kind].get(name, ())

    def names_of(self, kind: type) -> list[str]:
        """Return the full names of all inputs, services or actions."""
        return sorted({name for each in self._served for name in each.ports[kind]})

    @property
    def _served(self) -> Iterable[PlainController]:
        return self.manager.served.values() if self.manager else ()

    def sample(self, topic: str) -> Any | None:
        """
        Return the newest sample that a controller has published on a topic, by its full name.

        Of :mod:`amr_description.control.samples`, or whatever its Port takes. None: nothing was
        published since the reset, or by no controller of this robot.
        """
        found = self._outputs.get(topic)
        return None if found is None else found.sample

    def transform(self, target: str, source: str) -> Transform:
        """
        Return the pose of the frame ``source`` in the frame ``target``, as tf2 looks it up.

        Links are where they are at this instant; what controllers say of frames, such as where the
        robot is by its odometry, is the newest of it.

        Raises SimulationError: there is no such frame, or nothing connects the two.
        """
        places: dict[str, dict[str, Transform]] = {self.root_frame: {}}
        for parent, child, place in self._places():
            places.setdefault(child, {})[parent] = place
            places.setdefault(parent, {})[child] = place.inverse()
        for frame in (target, source):
            if frame not in places:
                known = ', '.join(sorted(places)) or 'none'
                raise SimulationError(f"there is no frame '{frame}'; there are: {known}")
        found, waiting = {source: Transform()}, [source]
        for frame in waiting:
            for neighbour, place in places[frame].items():
                if neighbour not in found:
                    found[neighbour] = place @ found[frame]
                    waiting.append(neighbour)
        if target not in found:
            raise SimulationError(f"nothing connects the frames '{target}' and '{source}'")
        return found[target]

    def _places(self) -> Iterator[tuple[str, str, Transform]]:
        """Yield frames of parents and children, and where the child is in the parent."""
        from amr_description.messages.plain import PlainMessage  # for who asks
        from amr_description.messages.writers import writer_of

        yield from fixed_places(self._spawned)
        yield from moving_places(self._spawned, self._view)
        outputs = [each for controller in self._served for each in controller.outputs.values()]
        for output in outputs:
            if output.port.message != TF_TYPE or output.sample is None:
                continue
            message = PlainMessage(TF_TYPE)
            writer_of(output.port)(output.sample, message)
            for each in message.transforms:
                place, turn = each.transform.translation, each.transform.rotation
                pose = Transform((place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w))
                yield each.header.frame_id, each.child_frame_id, pose

    def forget(self) -> None:
        """Drop the samples so far: time went back."""
        for output in self._outputs.values():
            output.forget()

    def close(self) -> None:
        """Let go of its sensors, as it is removed."""
        self._sensors.close()

    def _newest(self, topic: str, controller: str) -> Any:
        sample = self.sample(topic)
        if sample is not None:
            return sample
        if not topic:
            raise SimulationError(f"'{self.name}' began without an active {controller}")
        if not self._view.time:
            raise SimulationError(
                f'nothing is on {topic} at time 0; let time pass: step(), run() or drive()'
            )
        raise SimulationError(f"nothing was published on '{topic}'; is its controller active?")


def _motion_of(sample: OdometrySample | BodyOdometrySample) -> Motion:
    """Return odometry as a message would have it."""
    time = sample.stamp / NANOSECONDS
    if isinstance(sample, BodyOdometrySample):
        return Motion(time, sample.pose, sample.linear, sample.angular)
    half = sample.heading * 0.5
    pose = Transform((sample.x, sample.y, 0.0), (0.0, 0.0, math.sin(half), math.cos(half)))
    return Motion(time, pose, (sample.linear, sample.lateral, 0.0), (0.0, 0.0, sample.angular))
