# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages about what pages send by forms: their fields, services that are called, goals of actions.

What is published by forms is in ``requests.py``.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, TypeAlias


@dataclass(frozen=True, slots=True)
class FieldInfo:
    """A field of what is sent: what ``definition`` is answered, for each field."""

    name: str
    kind: str  #: "double", "string", or the type of a message: "geometry_msgs/msg/Vector3"
    #: of an array its length, 0 for any; ``None``: it is none
    length: int | None
    fields: 'tuple[FieldInfo, ...]'  #: of a message
    value: Any  #: the default, of what is neither a message nor an array
    constants: Mapping[str, Any]  #: by name, those of the message that may be its value


@dataclass(frozen=True, slots=True)
class CallInfo:
    """A service or an action that somebody serves."""

    name: str
    kind: str  #: its type: "std_srvs/srv/Trigger"
    is_action: bool


@dataclass(frozen=True, slots=True)
class Services:
    """All services and actions, to pages that watch ``services``, and on every change."""

    type: ClassVar[str] = 'services'
    services: tuple[CallInfo, ...]


@dataclass(frozen=True, slots=True)
class GoalProgress:
    """How a goal goes that this page has sent by ``send_goal``: to that page alone."""

    type: ClassVar[str] = 'goal_progress'
    goal: int  #: the id of that request
    state: Literal['active', 'succeeded', 'canceled', 'aborted', 'lost']
    text: str  #: YAML: the latest feedback, at the end the result; of a lost one, why it is


@dataclass(frozen=True, slots=True)
class CallService:
    """Call a service: the data of the reply are its response, in YAML."""

    types: ClassVar[tuple[str, ...]] = ('call_service',)
    id: int
    service: str
    kind: str  #: its type: "std_srvs/srv/SetBool"
    values: Mapping[str, Any]  #: as those of ``publish``


@dataclass(frozen=True, slots=True)
class SendGoal:
    """
    Send a goal to an action; the reply tells that it is accepted, GoalProgress how it goes.

    It is cancelled when this page ends, and by STOP of the robot in whose namespace the action is;
    while that stop holds it is refused.
    """

    types: ClassVar[tuple[str, ...]] = ('send_goal',)
    id: int
    action: str
    kind: str  #: its type: "nav2_msgs/action/NavigateToPose"
    values: Mapping[str, Any]  #: as those of ``publish``


@dataclass(frozen=True, slots=True)
class CancelSent:
    """Cancel a goal that this page has sent."""

    types: ClassVar[tuple[str, ...]] = ('cancel_sent',)
    id: int
    goal: int  #: the id of the request that sent it


CallRequest: TypeAlias = CallService | SendGoal | CancelSent
"""What services and actions are asked."""
