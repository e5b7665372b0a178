# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``simulation``: the robot in MuJoCo, both controllers active, ready to drive."""

import os
import re
from typing import Annotated
from xml.etree import ElementTree

from amr_description.bringup import (
    exited_cleanly,
    Node,
    notes_on,
    path_of,
    robot_description,
    Stack,
)
from amr_description.bringup.controller_files import controllers_file, URDF
from amr_description.bringup.environment import setup_command
from amr_description.bringup.stacks.visualization import ABOUT_VIEWER, page
from amr_description.errors import UsageError

_NO_NAME = re.compile(r'[^A-Za-z0-9_.-]')
ABOUT_CONTROLLERS = (
    'parameters of the controllers; empty: the file that the URDF names, for amr the shipped one'
)


def simulation(
    urdf: Annotated[str, 'robot description, URDF or xacro'] = URDF,
    xacro_args: Annotated[str, 'arguments of a xacro file: name:=value …'] = '',
    controllers: Annotated[str, ABOUT_CONTROLLERS] = '',
    world: Annotated[str, 'world to simulate'] = 'empty',
    rtf: Annotated[float, 'real-time factor; 0 is as fast as possible'] = 1.0,
    paused: Annotated[bool, 'whether time stands still at first'] = False,
    viewer: Annotated[bool, ABOUT_VIEWER] = True,
) -> Stack:
    """The robot in MuJoCo with both controllers, ready to drive."""
    if not rtf >= 0:
        raise UsageError(f'rtf:={rtf}: a real-time factor is 0 (as fast as possible) or more')
    description = robot_description(urdf, xacro_args)
    file = controllers_file(controllers, urdf, description)

    # 1. The simulated world, empty so far; it publishes /clock.
    mujoco_sim = Node(
        'mujoco_sim',
        parameters=[
            {'world': world, 'real_time_factor': rtf, 'paused': paused, 'controllers': str(file)}
        ],
        on_exit='shutdown',
    )

    # 2. The URDF, published as /robot_description and as transforms.
    robot_state_publisher = Node(
        'robot_state_publisher',
        parameters=[{'robot_description': description, 'use_sim_time': True}],
    )

    # 3. The robot is spawned; its <ros2_control> block brings up /controller_manager.
    name = entity_name(description)
    create = Node('create', arguments=['-topic', 'robot_description', '-name', name, '-z', '0.2'])

    # 4. The controllers, one after the other, once there is a controller manager.
    joint_state_broadcaster = Node(
        'spawner', arguments=['joint_state_broadcaster'], start_when=exited_cleanly(create)
    )
    diff_drive_controller = Node(
        'spawner',
        arguments=['diff_drive_controller'],
        start_when=exited_cleanly(joint_state_broadcaster),
    )

    return Stack(
        [
            mujoco_sim,
            robot_state_publisher,
            create,
            joint_state_broadcaster,
            diff_drive_controller,
            *page(viewer, exited_cleanly(diff_drive_controller)),
        ],
        ready_when=exited_cleanly(diff_drive_controller),
        next_steps=how_to_drive(viewer),
        notes=notes_on([path_of(urdf), file]),
    )


def entity_name(urdf: str) -> str:
    """Return the robot's name, with ``_`` for what the name of an entity may not have."""
    try:
        name = ElementTree.fromstring(urdf).get('name', '')
    except ElementTree.ParseError:  # robot_state_publisher says where
        name = ''
    return _NO_NAME.sub('_', name) or 'robot'


def how_to_drive(viewer: bool) -> str:
    """Return the next steps of a user; ``viewer``: whether the page is served."""
    page = 'open the page whose address comes below, or ' if viewer else ''
    return f"""{page}drive with, in another shell,
    {setup_command('amr_description', os.environ)}
    ros2 run amr_description teleop_twist_keyboard --ros-args -p stamped:=true \\
        -r /cmd_vel:=/diff_drive_controller/cmd_vel
or for one command
    ros2 topic pub --once /diff_drive_controller/cmd_vel geometry_msgs/msg/TwistStamped \\
        "{{header: {{frame_id: base_link}}, twist: {{linear: {{x: 0.5}}, angular: {{z: 0.0}}}}}}"
Ctrl-C stops all."""
