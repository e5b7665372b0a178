# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``truth_localizer``: map → odom from the simulator's ground truth, in place of amcl.

With it, navigation can be tried before localisation works, as with ``nav2_loopback_sim``, whose
parameter names it has. The frame ``map`` is that of the world, as in the maps of
``map_of_world``.

=======================  ==========================  ===========================================
topic                    type                        what
=======================  ==========================  ===========================================
``ground_truth/odom``    Odometry                    subscribed: where the robot is
``/tf``, ``/tf_static``  TFMessage                   subscribed: odom → base
``initialpose``          PoseWithCovarianceStamped   subscribed: where the robot is to be
``/tf``                  TFMessage                   map → odom
``amcl_pose``            PoseWithCovarianceStamped   where it is: reliable, transient local,
                                                     depth 1; covariance 0
=======================  ==========================  ===========================================

map → odom is the true pose times the inverse of odom → base at the very same stamp, so that it is
right while the robot drives and turns. It is seen from above: what the robot rolls and pitches is
no error of odometry.

``initialpose`` puts the robot there in the simulator, as in nav2_loopback_sim's, by
``SetEntityState``: x, y and the heading; its height stays, and it stands. With
``set_entity_state:=false`` it shifts the map instead, so that the robot takes itself to be
elsewhere, as it would with amcl.
"""

from contextlib import suppress
from dataclasses import dataclass

from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
import numpy as np
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.time import Time

from amr_description.clock import NANOSECONDS
from amr_description.errors import TransformException
from amr_description.maps.pose import Pose
from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.navigation.ros.entity_mover import EntityMover
from amr_description.navigation.ros.localizer import after, listed, LocalizerTopics
from amr_description.navigation.ros.messages import plane_pose, pose_of
from amr_description.navigation.ros.transform_queue import TransformQueue
from amr_description.parameters import parameter
from amr_description.ros.messages import nanoseconds, stamp_fault, transform_of
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare
from amr_description.ros.runtime import run
from amr_description.simulation.topics.names import ODOM_TOPIC
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener

PURPOSE = (
    'Publish map -> odom from the ground truth of the simulator, and follow /initialpose, so that '
    'navigation can be tried before localisation.'
)

_QOS = QoSProfile(depth=100)
"""Those of 1 s and more: none is to be lost while this process waits for a processor."""
_DEPTH = 50
"""Truths that wait for their odometry."""
_GAP = NANOSECONDS // 2
"""ns: odometry is not interpolated over more, as over the time between two robots."""
_PATIENCE = 5.0
"""s of the wall clock until it is said what is missing."""


@dataclass(frozen=True)
class TruthLocalizerParameters:
    """Names are those of nav2_loopback_sim, ``transform_tolerance`` that of amcl."""

    update_duration: float = parameter(
        0.01, 'The least time between two transforms', unit='s', minimum=0.0, read_only=True
    )
    base_frame_id: str = parameter(
        'base_footprint', 'The frame whose pose is on amcl_pose and initialpose', read_only=True
    )
    map_frame_id: str = parameter('map', 'The frame of the map', not_empty=True, read_only=True)
    odom_frame_id: str = parameter(
        'odom',
        'The frame of odometry; like base_frame_id with the prefix that ground_truth/odom has, '
        'if TF knows it so only',
        not_empty=True,
        read_only=True,
    )
    publish_map_odom_tf: bool = parameter(True, 'Whether map -> odom is published', read_only=True)
    transform_tolerance: float = parameter(
        0.02,
        'How far into the future a transform is stamped: by 0.02 it is there when odometry of '
        '50 Hz is. What is looked up now was found so long ago',
        unit='s',
        minimum=0.0,
        read_only=True,
    )
    set_entity_state: bool = parameter(
        True,
        'Whether initialpose puts the robot there in the simulator; else it shifts the map',
        read_only=True,
    )
    entity: str = parameter(
        '',
        'The robot in the simulator; empty: the only one, or that with the name of the namespace',
        read_only=True,
    )
    simulator: str = parameter(
        '/mujoco_sim', 'The node of the simulator, which serves set_entity_state', read_only=True
    )


@dataclass(frozen=True)
class _TruePlace:
    """Where the robot was at an instant."""

    root: Transform
    """The frame of the ground truth, its root link, in the world."""
    base: Pose
    """The base frame in the world, seen from above."""


class TruthLocalizer(Node):
    """The node."""

    def __init__(self) -> None:
        super().__init__('truth_localizer')
        self._settings = declare(self, TruthLocalizerParameters)
        self._period = round(self._settings.update_duration * NANOSECONDS)
        self._buffer = Buffer(clock=self.get_clock())
        self._listener = TransformListener(self._buffer, self)
        self._queue = TransformQueue[Odometry](self._buffer, self._localize, _DEPTH)
        self._topics = LocalizerTopics(
            self,
            self._settings.map_frame_id,
            tolerance=self._settings.transform_tolerance,
            broadcasts=self._settings.publish_map_odom_tf,
            on_initial_pose=self._on_initial_pose,
        )
        self._mover = EntityMover(self, self._settings.simulator, self._settings.entity)
        self._map_to_world = Pose(0.0, 0.0, 0.0)
        self._place: _TruePlace | None = None
        self._child_frame = ''
        self._last_frames: tuple[str, str] | None = None
        self._latest = self._published = -1
        self._truth = self.create_subscription(Odometry, ODOM_TOPIC, self._on_truth, _QOS)
        after(self, _PATIENCE, self._complain)
        self.get_logger().info(
            f'{self._settings.map_frame_id} -> {self._settings.odom_frame_id} from '
            f'{self._truth.topic_name}'
        )

    def _on_truth(self, message: Odometry) -> None:
        if fault := stamp_fault(message.header.stamp):
            self.get_logger().warning(
                f'a pose of the robot is left out: {fault}', throttle_duration_sec=_PATIENCE
            )
            return
        stamp = nanoseconds(message.header.stamp)
        if stamp < self._latest:  # the simulation was reset
            self._buffer.clear()
            self._queue.clear()
            self._published = -1
        self._latest = stamp
        self._child_frame = message.child_frame_id
        if 0 < stamp - self._published < self._period:
            return
        self._published = stamp
        self._queue.add(message, *self._frames(), stamp)

    def _frames(self) -> tuple[str, str]:
        """
        Return the frames of odometry and of the ground truth, as TF knows them.

        If it does not, as before the first odometry and after a reset, as it knew them, or as they
        should be called.
        """
        child, odom = self._child_frame, self._settings.odom_frame_id
        prefix = child[: child.rfind('/') + 1]
        ways = ((odom, child), (prefix + odom, child), (odom, child.removeprefix(prefix)))
        known = self._known()
        for frames in ways:
            if known.issuperset(frames):
                self._last_frames = frames
                return frames
        return self._last_frames or ways[1]

    def _known(self) -> set[str]:
        records = self._buffer.records()
        return {each.name for each in records} | {each.parent for each in records}

    def _localize(self, message: Odometry, odom_to_child: TransformStamped) -> None:
        stamp = nanoseconds(message.header.stamp)
        odom, child = odom_to_child.header.frame_id, odom_to_child.child_frame_id
        latest = self._buffer.get_latest_common_time(odom, child).nanoseconds
        if latest - stamp > _GAP:
            return
        world_to_odom = pose_of(message.pose.pose).compose(plane_pose(odom_to_child).inverse())
        map_to_odom = self._map_to_world.compose(world_to_odom)
        self._topics.send_transform(stamp, map_to_odom, odom)
        odom_to_base = self._odom_to_base(odom, message)
        if odom_to_base is not None:
            self._place = _TruePlace(
                transform_of(message.pose.pose), world_to_odom.compose(odom_to_base)
            )
            self._topics.send_pose(stamp, map_to_odom.compose(odom_to_base), np.zeros((3, 3)))

    def _odom_to_base(self, odom: str, message: Odometry) -> Pose | None:
        """Return the pose of the base frame, with the prefix of odometry's, if it is known."""
        base = self._settings.base_frame_id
        prefix = odom.removesuffix(self._settings.odom_frame_id)
        if not base.startswith(prefix):
            base = prefix + base
        with suppress(TransformException):
            return plane_pose(
                self._buffer.lookup_transform(odom, base, Time.from_msg(message.header.stamp))
            )
        return None

    def _on_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        place, wanted = self._place, pose_of(message.pose.pose)
        if place is None:
            self.get_logger().warning(
                f'Ignoring initial pose: nothing is known of the robot yet. {self._missing()}'
            )
        elif self._settings.set_entity_state:
            moved = wanted.compose(place.base.inverse())
            # The same motion of all of the robot, which keeps its height, roll and pitch.
            motion = Transform((moved.x, moved.y, 0.0), quaternion_from_yaw(moved.yaw))
            self._mover.move(motion @ place.root)
        else:
            self._map_to_world = wanted.compose(place.base.inverse())

    def _complain(self) -> None:
        if self._place is None:
            self.get_logger().warning(
                f'no pose in {self._settings.map_frame_id} yet. {self._missing()}'
            )

    def _missing(self) -> str:
        """Return what is missing and would do, in a sentence or two."""
        if self._latest < 0:
            topics = (name for name, _ in self.get_topic_names_and_types())
            truths = [name for name in topics if name.endswith(f'/{ODOM_TOPIC}')]
            others = [name for name in truths if self.count_publishers(name)]
            return (
                f'Nothing is on {self._truth.topic_name}, which the simulator publishes in the '
                f'namespace of each robot (ground_truth_rate above 0); there are: '
                f'{listed(others)}. Another namespace: --ros-args -r __ns:=/NAMESPACE'
            )
        (odom, child), known = self._frames(), self._known()
        if not known.issuperset((odom, child)):
            return (
                f"TF has no '{odom}' above '{child}'; its frames: {listed(known)}. The controller "
                "that drives publishes it (enable_odom_tf), and the parameter 'odom_frame_id' "
                'names it'
            )
        return (
            f"TF has '{odom}' and '{child}', but not where '{self._settings.base_frame_id}' is "
            f'in the former at the stamps of {self._truth.topic_name}; base_frame_id is usually '
            f"'{child}'"
        )


def main(args: list[str] | None = None) -> int:
    """Localize until Ctrl-C."""
    if print_help(args, 'truth_localizer', PURPOSE, TruthLocalizerParameters):
        return 0
    return run(TruthLocalizer, args)


if __name__ == '__main__':
    raise SystemExit(main())
