# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The joints that a page can move by the controllers of a robot: which, by what topic, to where.

Pure: a list of controllers and topics in, messages as plain numbers out. Three kinds of controller
are known by what they hear: ``~/joint_trajectory`` (a trajectory of all joints), ``~/commands``
(one position for each joint, in their order) and the action ``~/gripper_cmd`` (one joint).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from amr_description.errors import ViewerError
from amr_description.viewer.protocol import Command, ControllerInfo, Controllers

TRAJECTORY = 'trajectory_msgs/msg/JointTrajectory'
POSITIONS = 'std_msgs/msg/Float64MultiArray'
GRIPPER = 'control_msgs/action/GripperCommand'
PARALLEL_GRIPPER = 'control_msgs/action/ParallelGripperCommand'
ACTIONS = (GRIPPER, PARALLEL_GRIPPER)
_TOPICS = {
    TRAJECTORY: 'joint_trajectory',
    POSITIONS: 'commands',
    GRIPPER: 'gripper_cmd',
    PARALLEL_GRIPPER: 'gripper_cmd',
}
_POSITION = 'position'

SPEED = 1.0
"""rad/s or m/s; a trajectory takes a joint to its place no faster, nor than its limit allows."""
SHORTEST = 0.1
"""s; no trajectory is shorter."""
MEMORY = 2.0
"""
s: how long a joint that is not asked for stays where a page has last put it.

Then its measured position counts: another program may have moved it. Measured at every message of
a slider that is being dragged, the other joints would creep down under their weight.
"""


@dataclass(frozen=True, slots=True)
class ControllerJoints:
    """The joints of an active controller, in its order, and the topic or action for them."""

    controller: str
    topic: str
    message: str
    joints: tuple[str, ...]


def is_joint_command(topic: str, message: str) -> bool:
    """Return whether a topic may be one of those that move joints."""
    return topic.rpartition('/')[2] == _TOPICS.get(message)


def joint_groups(
    controllers: Iterable[ControllerInfo], topics: Sequence[Command]
) -> tuple[ControllerJoints, ...]:
    """Return the groups of the active controllers that hear one of these topics."""
    found = []
    for controller in controllers:
        claims = [each.split('/') for each in controller.claims]
        if controller.state != 'active' or not claims:
            continue
        for topic in topics:
            if topic.topic.split('/')[-2:-1] != [controller.name]:
                continue
            interfaces = {claim[-1] for claim in claims}
            if topic.message != POSITIONS or interfaces == {_POSITION}:
                # joint/position, or pid_controller/joint/position of one that is chained
                joints = tuple(dict.fromkeys(claim[-2] for claim in claims if len(claim) > 1))
                found.append(ControllerJoints(controller.name, topic.topic, topic.message, joints))
    return tuple(found)


def with_moves(controllers: Controllers, groups: Iterable[ControllerJoints]) -> Controllers:
    """Return a list of controllers that tells which joints pages can move by each."""
    moves = {group.controller: group.joints for group in groups}
    listed = (replace(each, moves=moves.get(each.name, ())) for each in controllers.controllers)
    return replace(controllers, controllers=tuple(listed))


@dataclass(slots=True)
class GroupTargets:
    """Where a page has put the joints of a group: rad or m, and when: s."""

    group: ControllerJoints
    positions: dict[str, float] = field(default_factory=dict)
    at: float = 0.0

    def targets(
        self, asked: Mapping[str, float], measured: Mapping[str, float], now: float
    ) -> list[float]:
        """
        Return the positions of all joints of the group, some of which are asked for.

        Raises ViewerError: nothing is known of one of the others.
        """
        if now - self.at > MEMORY:
            self.positions = {}
        known = {**measured, **self.positions, **asked}
        unknown = [joint for joint in self.group.joints if joint not in known]
        if unknown:
            raise ViewerError(
                f'{self.group.controller} takes the positions of all its joints, and that of '
                f"'{unknown[0]}' is not known: no joint states come"
            )
        self.positions = {joint: known[joint] for joint in self.group.joints}
        self.at = now
        return [*self.positions.values()]

    def duration(self, measured: Mapping[str, float], speeds: Mapping[str, float]) -> float:
        """
        Return how long a trajectory to the targets takes, s.

        Args:
            measured: Where the joints are, rad or m.
            speeds: The limits of those that have one, rad/s or m/s.
        """
        times = [
            abs(target - measured.get(joint, target)) / min(SPEED, speeds.get(joint) or SPEED)
            for joint, target in self.positions.items()
        ]
        return max(SHORTEST, *times)
