# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where joints stand when a robot is spawned, and again after a reset."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from amr_description.control.interfaces import POSITION, VELOCITY
from amr_description.errors import SpawnError
from amr_description.model.hardware_info import ComponentInfo
from amr_description.model.robot import Robot
from amr_description.sim.actuators import command_bounds
from amr_description.sim.spawning import SpawnCode


@dataclass(frozen=True, slots=True)
class JointState:
    """rad and rad/s, or m and m/s."""

    position: float
    velocity: float


def initial_states(robot: Robot, controlled: Iterable[ComponentInfo]) -> dict[str, JointState]:
    """
    The joints that do not begin at rest at 0.

    ``controlled``: the joints of the ``<ros2_control>`` blocks, whose ``initial_value`` of the
    state interfaces position and velocity counts. Mimic joints follow: multiplier · source +
    offset, and for the velocity without the offset. Raises SpawnError for a position that the
    joint cannot take.
    """
    given: dict[str, dict[str, float]] = {POSITION: {}, VELOCITY: {}}
    follows = {joint.name: joint.mimic for joint in robot.joints}
    for part in controlled:
        follows[part.name] = part.mimic
        for interface in part.state_interfaces:
            if interface.name in given and interface.initial_value is not None:
                given[interface.name][part.name] = interface.initial_value
    _check_positions(robot, given[POSITION])

    def state_of(joint: str) -> JointState:
        return JointState(given[POSITION].get(joint, 0.0), given[VELOCITY].get(joint, 0.0))

    states = {}
    for joint in robot.joints:
        mimic = follows[joint.name]
        state = state_of(joint.name)
        if mimic is not None:
            source = state_of(mimic.joint)
            state = JointState(
                mimic.offset + mimic.multiplier * source.position,
                mimic.multiplier * source.velocity,
            )
        if joint.has_position and state != JointState(0.0, 0.0):
            states[joint.name] = state
    return states


def _check_positions(robot: Robot, positions: Mapping[str, float]) -> None:
    for name, position in positions.items():
        bounds = command_bounds(robot.joint(name), POSITION)
        if not bounds.lower <= position <= bounds.upper:
            raise SpawnError(
                f"{robot.source}: joint '{name}': initial_value {position:.6g} of its position is "
                f'beyond {bounds}',
                SpawnCode.RESOURCE_PARSE_ERROR,
            )
