# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``display``: look at a description and move its joints; nothing is simulated."""

import shlex
from typing import Annotated
from xml.etree import ElementTree

from amr_description.bringup import Node, notes_on, path_of, robot_description, Stack, started
from amr_description.bringup.controller_files import ABOUT_SENSORS, URDF, with_sensors
from amr_description.bringup.stacks.visualization import ABOUT_VIEWER, page, rviz

_MOVABLE = ('revolute', 'continuous', 'prismatic')


def display(
    urdf: Annotated[str, 'robot description, URDF or xacro'] = URDF,
    xacro_args: Annotated[str, 'arguments of a xacro file: name:=value …'] = '',
    sensors: Annotated[bool, ABOUT_SENSORS] = False,
    reload: Annotated[bool, 'show each change of the description when its file is saved'] = True,
    viewer: Annotated[bool, ABOUT_VIEWER] = True,
) -> Stack:
    """The robot of a description, with a slider for every movable joint."""
    urdf = with_sensors(urdf, sensors)
    description = robot_description(urdf, xacro_args)

    # 1. The URDF, published as /robot_description and as transforms.
    robot_state_publisher = Node(
        'robot_state_publisher', parameters=[{'robot_description': description}]
    )

    # … and again whenever a file of it is saved.
    watcher = Node(
        'description_watcher',
        arguments=[path_of(urdf), *shlex.split(xacro_args)],
        required=False,
    )

    # 2. The joint positions, set by sliders.
    joint_state_publisher = Node('joint_state_publisher')

    # 3. The page, and RViz.
    return Stack(
        [
            robot_state_publisher,
            joint_state_publisher,
            *([watcher] if reload else []),
            *page(viewer, started(joint_state_publisher)),
            *rviz('display'),
        ],
        next_steps=how_to_move(movable_joint(description)),
        notes=notes_on([path_of(urdf)]),
    )


def movable_joint(urdf: str) -> str:
    """Return the name of the first joint with a slider; '' if there is none."""
    try:
        joints = ElementTree.fromstring(urdf).findall('joint')
    except ElementTree.ParseError:  # robot_state_publisher says where
        return ''
    movable = (j for j in joints if j.get('type') in _MOVABLE and j.find('mimic') is None)
    return next((joint.get('name', '') for joint in movable), '')


def how_to_move(joint: str) -> str:
    """Return the next steps of a user; ``joint``: one that can be moved, if there is one."""
    line = f"""; or move a joint with
    ros2 topic pub --once /joint_state_publisher/set_joint_positions \\
        sensor_msgs/msg/JointState "{{name: [{joint}], position: [0.5]}}\""""
    return f"""open the page whose address the viewer prints{line if joint else ''}
Ctrl-C stops all."""
