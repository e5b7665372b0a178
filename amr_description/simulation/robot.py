# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot of a simulation in this process: what it is sent, and what is read of it."""

from collections.abc import Iterator, Mapping
import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Input
from amr_description.control.samples import (
    BodyOdometrySample,
    JointStateSample,
    OdometrySample,
    TwistSample,
)
from amr_description.errors import SimulationError
from amr_description.model.frames import conjugate, rotate, Transform
from amr_description.sim.robot_view import RobotView
from amr_description.simulation.api import RobotApi
from amr_description.simulation.local_manager import LocalManager
from amr_description.simulation.plain_controllers import Newest
from amr_description.simulation.readings import Joint, Joints, Motion
from amr_description.simulation.sensors import RobotSensors
from amr_description.simulation.spawned_controllers import BROADCASTER, Topics
from amr_description.simulation.tracebacks import is_for_the_test

__tracebackhide__ = is_for_the_test


class Robot(RobotApi):
    """See :class:`~amr_description.simulation.api.RobotApi`."""

    def __init__(
        self,
        view: RobotView,
        namespace: str,
        manager: LocalManager | None,
        topics: Topics,
        sensors: RobotSensors,
    ) -> None:
        """
        Take a robot.

        Args:
            view: In the world.
            namespace: As it was given.
            manager: None: it has no hardware.
            topics: Of its active controllers.
            sensors: That look at the world.
        """
        self.name, self.namespace = view.name, namespace
        self.command_topic = topics.command
        self.manager = manager
        """Its controllers can be loaded, switched and so on."""
        self._view, self._topics, self._sensors = view, topics, sensors
        self._odometry: tuple[Any, Any] = (None, None)
        """The newest that was read: its sample, and what it says."""
        self._outputs: Mapping[str, Newest] = manager.outputs if manager else {}

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
        sample = self._newest(self._topics.odometry, 'drive')
        if sample is not self._odometry[0]:  # it is published at half the rate of most loops
            self._odometry = (sample, _motion_of(sample))
        return self._odometry[1]

    @property
    def joints(self) -> dict[str, Joint]:
        """The last state of each joint, by name, from the JointStateBroadcaster."""
        sample: JointStateSample = self._newest(self._topics.joints, BROADCASTER)
        rows = zip(sample.name, sample.position, sample.velocity, sample.effort, strict=True)
        return Joints({name: Joint(*values) for name, *values in rows})

    def inputs(self, topic: str) -> Iterator[Input[Any]]:
        """Yield the inputs of its controllers with a topic, by its full name."""
        for controller in self.manager.served.values() if self.manager else ():
            yield from controller.inputs.get(topic, ())

    @property
    def subscribed(self) -> list[str]:
        """The full names of the topics that its controllers subscribe to."""
        served = self.manager.served.values() if self.manager else ()
        return sorted({topic for each in served for topic in each.inputs})

    def sample(self, topic: str) -> Any | None:
        """
        Return the newest sample that a controller has published on a topic, by its full name.

        Of :mod:`amr_description.control.samples`, or whatever its Port takes. None: nothing was
        published since the reset, or by no controller of this robot.
        """
        found = self._outputs.get(topic)
        return None if found is None else found.sample

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
