# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What pages are shown of a simulation in this process: robots, world, states, sensors.

All of it is read between two steps, on the thread of the simulation, and handed over as frames.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
import math

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.control.samples import BodyOdometrySample, OdometrySample
from amr_description.model.frames import Transform
from amr_description.model.kinematics import joint_transform
from amr_description.model.robot import Joint
from amr_description.model.sensors import frame_in
from amr_description.png import png
from amr_description.sim.engine import Engine
from amr_description.sim.robot_view import RobotView
from amr_description.sim.static_geometry import visible_shapes
from amr_description.simulation.readings import Image, Motion, Scan
from amr_description.simulation.robot import Robot
from amr_description.simulation.sensors import IMAGE, SCAN
from amr_description.viewer import marks, protocol
from amr_description.viewer.description import describe_robot, DescribedRobot
from amr_description.viewer.protocol import (
    Command,
    EntityInfo,
    FrameInfo,
    Graph,
    Layout,
    Origin,
    RobotInfo,
    RobotLayout,
    SensorInfo,
    SimulatorInfo,
)
from amr_description.viewer.samples import encode_sample, Sample
from amr_description.viewer.states import LAYOUTS, RobotFloats, StateFrame

_TWISTS = {True: 'geometry_msgs/msg/TwistStamped', False: 'geometry_msgs/msg/Twist'}
_WIDEST = 640
"""Columns, and rows, of a picture that is sent; larger ones lose every other pixel, or more."""


@dataclass
class ShownRobot:
    """A robot of a page."""

    id: str
    """Its namespace, absolute."""
    robot: Robot
    view: RobotView
    described: DescribedRobot
    command: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    """The last of a page: m/s, rad/s, m/s to the left."""

    def __post_init__(self) -> None:
        self._joints = [j for j in self.view.description.joints if j.has_position]
        self._group = self.view.joints([each.name for each in self._joints])

    @property
    def layout(self) -> RobotLayout:
        """What a state has of it."""
        return RobotLayout(self.id, tuple(each.name for each in self._joints), ())

    def info(self, simulator: str) -> RobotInfo:
        """Return what pages are told of it."""
        robot, inside = self.robot, self.id.rstrip('/')
        command = robot.command_topic
        return RobotInfo(
            id=self.id,
            name=self.described.name,
            present=True,
            command=Command(command, _TWISTS[robot.topics.is_stamped]) if command else None,
            odometry=robot.topics.odometry or None,
            truth=f'{inside}/ground_truth/odom',
            wheels=None,
            joint_states=robot.topics.joints or None,
            joint_publisher=None,
            manager=None,
            entity=EntityInfo(simulator, robot.name),
        )

    def sensors(self) -> Iterator[SensorInfo]:
        """Yield those of its sensors that a page can show."""
        for topic, kind in self.robot.sensor_topics.items():
            if kind == SCAN:
                yield SensorInfo(topic, self.id, 'scan', SCAN)
            elif kind == IMAGE:
                yield SensorInfo(topic, self.id, 'picture', IMAGE)

    @property
    def odometry(self) -> OdometrySample | BodyOdometrySample | None:
        """The newest; None: there is none."""
        topic = self.robot.topics.odometry
        return self.robot.sample(topic) if topic else None

    def frames(self) -> Iterator[tuple[FrameInfo, Callable[[], Transform]]]:
        """Yield its frames, parents before children, and what returns where each is."""
        root, last = self.view.description.root.name, self.odometry
        if last is not None:
            yield self._frame(last.frames.child_frame_id, last.frames.frame_id), self._base
        children: dict[str, list[Joint]] = {}
        for joint in self.view.description.joints:
            children.setdefault(joint.parent, []).append(joint)
        waiting = [root]
        while waiting:
            for joint in children.get(waiting.pop(0), ()):
                waiting.append(joint.child)
                yield self._frame(joint.child, joint.parent), self._place_of(joint)

    def _frame(self, name: str, parent: str) -> FrameInfo:
        return FrameInfo(frame_in(self.id, name), frame_in(self.id, parent))

    def _base(self) -> Transform:
        last = self.odometry
        return Transform() if last is None else self.robot.odometry.pose

    def _place_of(self, joint: Joint) -> Callable[[], Transform]:
        if not joint.has_position:
            place = joint_transform(joint)
            return lambda: place
        index = self._joints.index(joint)
        return lambda: joint_transform(joint, self._positions[index])

    def read(self) -> None:
        """Take in where its joints are now."""
        self._positions = self._group.positions()

    def write(self, floats: RobotFloats) -> None:
        """Write its part of a state; :meth:`read` was called."""
        floats.positions[:], floats.velocities[:] = self._positions, self._group.velocities()
        _write(floats.truth, self.robot.truth)
        if self.odometry is None:
            floats.odometry[:] = math.nan
        else:
            _write(floats.odometry, self.robot.odometry)
        floats.command[:] = self.command


class Scene:
    """What is there, until a robot comes or goes."""

    def __init__(self, robots: Mapping[str, ShownRobot], number: int) -> None:
        """``number``: of the scenes before it."""
        self.robots = robots
        """By their names on pages."""
        for each in robots.values():
            each.read()
        found = [frame for each in robots.values() for frame in each.frames()]
        self._places = [place for _, place in found]
        layouts = tuple(each.layout for each in robots.values())
        # Ids begin at 1: pages know a layout of 0 from nowhere.
        self.layout = Layout((number + 1) % LAYOUTS, tuple(frame for frame, _ in found), layouts)
        self._odometries = self._have_odometry()
        self._frame = StateFrame(self.layout)
        self._number = 0

    @property
    def is_complete(self) -> bool:
        """False: a robot's odometry has come, or gone, and its frame with it."""
        return self._odometries == self._have_odometry()

    def _have_odometry(self) -> list[bool]:
        return [each.odometry is not None for each in self.robots.values()]

    def graph(self, simulator: str, world: str) -> Graph:
        """Return what pages are told of it."""
        names = tuple(each.robot.name for each in self.robots.values())
        return Graph(
            tuple(each.info(simulator) for each in self.robots.values()),
            (SimulatorInfo(simulator, names, world, ()),),
            None if self.robots else 'no robot is in the world; sim.spawn adds one',
            tuple(sensor for each in self.robots.values() for sensor in each.sensors()),
        )

    def state(self, time: int) -> bytes:
        """Return where everything is; ``time``: now, ns."""
        for each in self.robots.values():
            each.read()
        for row, place in zip(self._frame.poses, self._places, strict=True):
            pose = place()
            row[:3], row[3:] = pose.translation, pose.rotation
        for each, floats in zip(self.robots.values(), self._frame.robots, strict=True):
            each.write(floats)
        self._number += 1
        return self._frame.encode(self._number, time / NANOSECONDS)

    def sample(self, topic: str) -> Sample | None:
        """Return what a sensor sees now; None: there is no such topic."""
        for each in self.robots.values():
            kind = each.robot.sensor_topics.get(topic)
            if kind == SCAN:
                return Sample(topic, _scan_frame(topic, each.robot.scan_of(topic)))
            if kind == IMAGE:
                return Sample(topic, _picture_frame(topic, each.robot.image(topic)))
        return None


def shown_robot(robot: Robot, view: RobotView) -> ShownRobot:
    """Return a robot as pages see it."""
    described = describe_robot(robot.inside, view.description.text)
    return ShownRobot(robot.inside, robot, view, described)


def world_of(engine: Engine, simulator: str) -> protocol.World:
    """Return the static shapes of a world without robots."""
    return protocol.World(
        simulator,
        tuple(
            marks.Shape(
                name=each.name,
                kind=each.kind.value,
                size=each.size,
                position=each.position,
                orientation=each.rotation,
                colour=each.color,
                points=tuple(value for point in each.points for value in point),
            )
            for each in visible_shapes(engine.spec)
        ),
    )


def _write(floats: np.ndarray, motion: Motion) -> None:
    pose = motion.pose
    floats[:3], floats[3:7] = pose.translation, pose.rotation
    floats[7:] = motion.linear[0], motion.angular[2], motion.linear[1]


def _scan_frame(topic: str, scan: Scan) -> bytes:
    count = len(scan.ranges)
    increment = float(scan.angles[1] - scan.angles[0]) if count > 1 else 0.0
    head = protocol.Scan(
        Origin(topic, scan.frame, scan.time, None),
        float(scan.angles[0]),
        increment,
        scan.range_min,
        scan.range_max,
        count,
    )
    return encode_sample(head, (np.ascontiguousarray(scan.ranges, '<f4'),))


def _picture_frame(topic: str, image: Image) -> bytes:
    height, width = image.pixels.shape[:2]
    thin = -(-max(width, height) // _WIDEST)
    encoding = 'rgb8' if image.pixels.ndim > 2 else 'mono8'  # noqa: PLR2004
    head = protocol.Picture(
        Origin(topic, image.frame, image.time, None),
        'image/png',
        encoding,
        width,
        height,
        None,
        None,
    )
    return encode_sample(head, (png(np.ascontiguousarray(image.pixels[::thin, ::thin])),))
