# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The samples of controllers of degrees of freedom (PID) and of grippers: plain values.

Stamps are integer nanoseconds; what is not known is NaN.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DofCommandSample:
    """A control_msgs/MultiDOFCommand; each tuple may be empty."""

    names: tuple[str, ...]
    values: tuple[float, ...]
    rates: tuple[float, ...]
    """Their derivatives."""


@dataclass(frozen=True, slots=True)
class DofState:
    """A control_msgs/SingleDOFState, in the units of the interfaces."""

    name: str
    reference: float
    feedback: float
    feedback_rate: float
    error: float
    error_rate: float
    time_step: float
    """s."""
    output: float


@dataclass(frozen=True, slots=True)
class DofStatesSample:
    """A control_msgs/MultiDOFStateStamped."""

    stamp: int
    states: tuple[DofState, ...]


@dataclass(frozen=True, slots=True)
class PidStateSample:
    """A control_msgs/PidState."""

    stamp: int
    time_step: int
    """ns."""
    error: float
    error_rate: float
    p_error: float
    i_error: float
    d_error: float
    p_term: float
    i_term: float
    d_term: float
    i_max: float
    i_min: float
    output: float


@dataclass(frozen=True, slots=True)
class SetBoolRequest:
    """A request of std_srvs/SetBool."""

    is_on: bool


@dataclass(frozen=True, slots=True)
class SetBoolResponse:
    """A response of std_srvs/SetBool."""

    success: bool
    message: str = ''


@dataclass(frozen=True, slots=True)
class GripperGoal:
    """
    A goal of control_msgs/GripperCommand, or of ParallelGripperCommand, which may have any number
    of values.
    """

    position: tuple[float, ...]
    """rad or m."""
    velocity: tuple[float, ...]
    """rad/s or m/s, at most."""
    effort: tuple[float, ...]
    """N·m or N, at most."""


@dataclass(frozen=True, slots=True)
class GripperState:
    """The result and the feedback of these actions."""

    joint: str
    position: float
    effort: float
    stalled: bool
    reached_goal: bool
