# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics of a lidar or range finder: LaserScan, PointCloud2, Range.

One of a few rays measures on the control thread: 0.15 ms for 360 rays, so that its scan goes out
in the cycle of its instant. One of many, or whose rays take long as the world has fine meshes,
measures on the thread of the :class:`~amr_description.simulation.topics.worker.SensorWorker`.
Either way its bits are the same. Where time waits, only the number of rays counts, so that the
order of messages does not depend on how fast the machine is.
"""

from collections.abc import Callable
from functools import partial
import time as wall

from amr_description.model.sensors import Lidar
from amr_description.sim.lidar import SimulatedLidar
from amr_description.sim.sensor_schedule import CycleBudget
from amr_description.sim.state_copy import StateCopy
from amr_description.simulation.topics.lidar_messages import (
    points_encoder,
    range_encoder,
    scan_encoder,
    ScanEncoder,
)
from amr_description.simulation.topics.sensor_topics import SensorContext, SensorTopics

MOST_RAYS = 1500
"""What all lidars together may cast on the control thread in one cycle, 0.6 ms in ``warehouse``.

Those that would exceed it, such as the fifth of a fleet, measure on the other thread."""
LONGEST = 0.001
"""s of processor time of one measurement; in real time a slower lidar leaves the thread."""


def ray_budget() -> CycleBudget:
    """Return the rays that the lidars of one world may cast on the control thread."""
    return CycleBudget(MOST_RAYS)


class LidarTopics(SensorTopics):
    """The topics of one lidar."""

    def __init__(self, lidar: Lidar, context: SensorContext) -> None:
        """
        Create the topics.

        Args:
            lidar: The sensor.
            context: What it is given.

        Raises:
            SimulationError: The robot has no such link.
        """
        self._context = context
        self._rays = lidar.horizontal.samples * lidar.vertical.samples
        self._has_many_rays = self._rays > MOST_RAYS
        self._is_slow = False
        self._task = context.worker.task(
            f"lidar '{lidar.mount.name}' of '{context.robot.name}'",
            'a lower <update_rate> or fewer <samples> would do',
        )
        self._lidar = SimulatedLidar(lidar, context.robot)
        frame = context.frame(lidar.mount.frame or lidar.mount.link)
        kinds: tuple[tuple[str, str, Callable[[Lidar, str], ScanEncoder]], ...] = (
            (lidar.scan_topic, 'LaserScan', scan_encoder),
            (lidar.points_topic, 'PointCloud2', points_encoder),
            (lidar.range_topic, 'Range', range_encoder),
        )
        self._topics = tuple(
            context.advertise(
                name, lidar.mount, f'sensor_msgs/msg/{kind}', encoder_of(lidar, frame)
            )
            for name, kind, encoder_of in kinds
            if name
        )

    @property
    def is_heard(self) -> bool:
        """Whether anybody subscribes to one of them; nothing is measured else."""
        return any(topic.is_heard for topic in self._topics)

    def measure(self, time: int) -> None:
        """Measure, and publish; ``time``: of this cycle, ns."""
        context, lidar = self._context, self._lidar
        is_aside = self._has_many_rays or (self._is_slow and context.worker.is_paced())
        if not (is_aside or context.ray_budget.take(time, self._rays)):
            # For good: each thread would find out anew what it sees.
            is_aside = self._has_many_rays = True
        if is_aside:
            state = context.states.copy()
            self._task.request(partial(self._make, time, lidar.body(), state))
            return
        begin = wall.thread_time()
        scene = context.world.ray_scene()
        is_usual = lidar.is_bound_to(scene)
        scan = lidar.measure(time, lidar.body(), scene)
        for topic in self._topics:
            topic.send(scan)
        self._is_slow = is_usual and wall.thread_time() - begin > LONGEST

    def _make(self, time: int, body: int, state: StateCopy) -> None:
        """Measure from a copy, and publish; on the thread of the worker."""
        scan = self._lidar.measure(time, body, self._context.scenes.scene(state))
        for topic in self._topics:
            if topic.is_heard:
                topic.write_aside(scan)
