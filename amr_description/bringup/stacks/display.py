# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``display``: look at a description and move its joints; nothing is simulated."""

from typing import Annotated

from amr_description.bringup import Node, notes_on, path_of, robot_description, Stack, started
from amr_description.bringup.stacks.simulation import URDF
from amr_description.bringup.stacks.visualization import ABOUT_VIEWER, page, rviz


def display(
    urdf: Annotated[str, 'robot description, URDF or xacro'] = URDF,
    xacro_args: Annotated[str, 'arguments of a xacro file: name:=value …'] = '',
    viewer: Annotated[bool, ABOUT_VIEWER] = True,
) -> Stack:
    """The robot of a description, with a slider for every movable joint."""
    # 1. The URDF, published as /robot_description and as transforms.
    robot_state_publisher = Node(
        'robot_state_publisher',
        parameters=[{'robot_description': robot_description(urdf, xacro_args)}],
    )

    # 2. The joint positions, set by sliders.
    joint_state_publisher = Node('joint_state_publisher')

    # 3. The page, and RViz.
    return Stack(
        [
            robot_state_publisher,
            joint_state_publisher,
            *page(viewer, started(joint_state_publisher)),
            *rviz('display'),
        ],
        next_steps="""open the page whose address the viewer prints; or move a joint with
    ros2 topic pub --once /joint_state_publisher/set_joint_positions \\
        sensor_msgs/msg/JointState "{name: [joint_wheel_front_left], position: [0.5]}"
Ctrl-C stops all.""",
        notes=notes_on([path_of(urdf)]),
    )
