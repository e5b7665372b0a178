# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``teleop``: the simulation, and the keys of this terminal drive the robot."""

from typing import Annotated, Any

from amr_description.bringup import Node, Stack
from amr_description.bringup.arguments import with_arguments_of
from amr_description.bringup.stacks.simulation import simulation
from amr_description.errors import UsageError


@with_arguments_of(simulation)
def teleop(
    speed: Annotated[float, 'linear speed at the start, m/s'] = 0.5,
    turn: Annotated[float, 'angular speed at the start, rad/s'] = 1.0,
    latch: Annotated[bool, 'drive on until the next key, also when one is let go'] = False,
    **others: Any,
) -> Stack:
    """The simulation, driven with the keys of this terminal; Ctrl-C ends all."""
    robot = simulation(**others)
    if robot.velocity_topic is None:
        raise UsageError(
            f'urdf:={others["urdf"]}: no controller of the robot takes a velocity, so keys cannot '
            'drive it; the stack simulation brings it up'
        )
    keyboard = Node(
        'teleop_twist_keyboard',
        terminal=True,
        arguments=['--latch'] if latch else [],
        # The controller drops commands whose stamps, in simulated time, are old.
        parameters=[{'speed': speed, 'turn': turn, 'use_sim_time': True}],
        remappings=[('/cmd_vel', robot.velocity_topic.name)],
        start_when=robot.ready_when,
        on_exit='shutdown',
    )
    return Stack(
        [*robot.nodes, keyboard],
        ready_when=robot.ready_when,
        next_steps='drive with the keys that are shown below; Ctrl-C stops all.',
        notes=robot.notes,
    )
