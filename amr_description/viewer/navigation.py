# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Who drives robots to goals, and how a goal of a page goes; a part of ``protocol.py``.

Poses are seen from above: m and rad, in a frame of TF by the name that the states have it by.
"""

from dataclasses import dataclass
from typing import ClassVar, Literal


@dataclass(frozen=True, slots=True)
class Navigator:
    """Who hears of a robot's goals and of its pose; ``None``: nobody does."""

    robot: str
    goal: str | None  #: the topic of goals, geometry_msgs/msg/PoseStamped
    action: str | None  #: the action nav2_msgs/action/NavigateToPose
    initial_pose: str | None  #: the topic of poses, geometry_msgs/msg/PoseWithCovarianceStamped


@dataclass(frozen=True, slots=True)
class GoalStatus:
    """How the last goal that a page gave to a robot goes. Sent to every page on every change."""

    type: ClassVar[str] = 'goal'
    robot: str
    client: str  #: the page that gave it
    #: 'published': by the topic, of which nothing is heard again; 'active': the action says how
    #: far it is, and takes ``cancel_goal``
    state: Literal['published', 'active', 'reached', 'cancelled', 'failed']
    frame: str
    x: float
    y: float
    yaw: float
    text: str = ''  #: why it was cancelled, or has failed
    distance: float | None = None  #: m to go, along the path; ``None``: not told
    time: float | None = None  #: s to go, as estimated
    recoveries: int = 0  #: times that it had to recover, as by spinning or backing up
