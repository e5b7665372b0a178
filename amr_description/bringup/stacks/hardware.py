# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The stacks ``mock`` and ``serial``: the robot without the simulator, as on real hardware.

They differ from ``simulation`` in the hardware component only: the same URDF with another
``<hardware>`` element, the same controllers with the same parameters, the same topics.
"""

from collections.abc import Mapping, Sequence
import os
from pathlib import Path
import re
import tempfile
from typing import Annotated
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

from amr_description.bringup import (
    exited_cleanly,
    Node,
    notes_on,
    path_exists,
    path_of,
    robot_description,
    Stack,
    started,
)
from amr_description.bringup.conditions import Condition
from amr_description.bringup.controller_files import controllers_files, URDF
from amr_description.bringup.input_files import Note
from amr_description.bringup.stacks.controllers import plan_controllers, spawners
from amr_description.bringup.stacks.next_steps import next_steps_of
from amr_description.bringup.stacks.simulation import ABOUT_CONTROLLERS
from amr_description.bringup.stacks.visualization import ABOUT_VIEWER, page
from amr_description.errors import DescriptionError

_USES_SIM_TIME = re.compile(
    r'^\s*["\']?use_sim_time["\']?\s*:\s*true\b', re.MULTILINE | re.IGNORECASE
)
_HARDWARE = re.compile(r'<hardware>.*?</hardware>', re.DOTALL)
_SIMULATED_BOARD = {'answer_timeout': '1.0'}
"""s; a board that is a process of a busy computer may answer late, and turns no motors."""
_PSEUDO_TERMINALS = '/dev/pts/'
"""What is behind a port there is a program, perhaps a ``motor_board`` of another terminal."""
_SYSTEM_CLOCK = {'use_sim_time': False}
"""Whatever the file says: with ``simulation``, which shares it, time comes from the simulator."""
_PORT_TIMEOUT = 10.0
"""s; the port of a board that was just plugged in appears after two or three."""


def mock(
    urdf: Annotated[str, 'robot description, URDF or xacro'] = URDF,
    xacro_args: Annotated[str, 'arguments of a xacro file: name:=value …'] = '',
    controllers: Annotated[str, ABOUT_CONTROLLERS] = '',
    viewer: Annotated[bool, ABOUT_VIEWER] = True,
) -> Stack:
    """The robot's controllers over mock hardware: no physics, wheels follow commands."""
    description = swap_hardware(
        robot_description(urdf, xacro_args),
        'mock_components/GenericSystem',
        {'calculate_dynamics': 'true'},
    )
    return _controlled(urdf, description, controllers, viewer)


def serial(
    urdf: Annotated[str, 'robot description, URDF or xacro'] = URDF,
    xacro_args: Annotated[str, 'arguments of a xacro file: name:=value …'] = '',
    controllers: Annotated[str, ABOUT_CONTROLLERS] = '',
    port: Annotated[str, 'port of the motor board; empty: a simulated board is started'] = '',
    left: Annotated[str, 'joints that the left motor turns'] = (
        'joint_wheel_front_left joint_wheel_back_left'
    ),
    right: Annotated[str, 'joints that the right motor turns'] = (
        'joint_wheel_front_right joint_wheel_back_right'
    ),
    viewer: Annotated[bool, ABOUT_VIEWER] = True,
) -> Stack:
    """The robot behind a serial port: a real motor board, or a simulated one."""
    boards: list[Node] = []
    timeout: float | None = _PORT_TIMEOUT
    is_simulated = not port or os.path.realpath(port).startswith(_PSEUDO_TERMINALS)
    if not port:
        timeout = None
        port = str(Path(tempfile.gettempdir(), f'amr_motor_board_{os.getpid()}'))
        boards = [Node('motor_board', arguments=['--link', port], required=False)]
    description = swap_hardware(
        robot_description(urdf, xacro_args),
        'amr_description/SerialBaseSystem',
        {'port': port, 'left_joints': left, 'right_joints': right}
        | (_SIMULATED_BOARD if is_simulated else {}),
    )
    ready = path_exists(port)
    return _controlled(urdf, description, controllers, viewer, boards, ready, timeout)


def _controlled(
    urdf: str,
    description: str,
    controllers: str,
    viewer: bool,
    before: Sequence[Node] = (),
    start_when: Condition | None = None,
    timeout: float | None = None,
) -> Stack:
    """
    Return the stack of a controller manager with its hardware, and the controllers in order.

    Args:
        urdf: the description as given.
        description: its text.
        controllers: the parameter file as given.
        viewer: whether to serve the page.
        before: nodes that are started first.
        start_when: what the controller manager waits for.
        timeout: of that wait, s; None: the default.
    """
    given = controllers_files(controllers, urdf, description)
    # A manager of its own node: in no namespace that a plugin of Gazebo has.
    joined = controllers and ','.join(map(str, given))
    plan = plan_controllers(urdf, description, joined, namespace='/')
    files = [path_of(urdf), *(plan.files or given)]
    ros2_control_node = Node(
        'ros2_control_node',
        parameters=[*files[1:], _SYSTEM_CLOCK],
        on_exit='shutdown',
        start_when=start_when,
        timeout=timeout,
    )
    robot_state_publisher = Node(
        'robot_state_publisher', parameters=[{'robot_description': description}]
    )
    controlled = spawners(plan, start_when)
    up = exited_cleanly(controlled[-1]) if controlled else started(ros2_control_node)
    return Stack(
        [*before, ros2_control_node, robot_state_publisher, *controlled, *page(viewer, up)],
        ready_when=up,
        next_steps=next_steps_of(viewer, plan, description),
        notes=[*notes_on(files), *_notes_on_clock(files[1]), *plan.notes],
    )


def _notes_on_clock(controllers: Path) -> list[Note]:
    """Return a note where the parameters of the controllers ask for a simulator's clock."""
    if not _USES_SIM_TIME.search(controllers.read_text('utf-8', errors='replace')):
        return []
    return [('INFO', f'use_sim_time: false, though {controllers} says true: nobody simulates')]


def swap_hardware(urdf: str, plugin: str, parameters: Mapping[str, str] | None = None) -> str:
    """
    Return a description with another hardware component.

    Args:
        urdf: the description.
        plugin: the type of the component.
        parameters: its ``<param>`` elements.

    Raises:
        DescriptionError: there is not exactly one ``<ros2_control>`` block with a ``<hardware>``.
    """
    try:
        blocks = ElementTree.fromstring(urdf).findall('ros2_control/hardware')
    except ElementTree.ParseError as error:
        raise DescriptionError(f'robot description: {error}') from error
    found = _HARDWARE.findall(urdf)
    if len(blocks) != 1 or len(found) != 1:
        raise DescriptionError(
            f'robot description: {len(blocks)} <ros2_control> blocks with a <hardware>; exactly '
            f'one is needed to put {plugin} in its place'
        )
    lines = [f'<plugin>{escape(plugin)}</plugin>']
    for name, value in (parameters or {}).items():
        lines.append(f'<param name={quoteattr(name)}>{escape(value)}</param>')
    # On one line, and as many lines as before, so that those behind it keep their numbers.
    rest = '\n' * found[0].count('\n')
    element = f'<hardware>{"".join(lines)}{rest}</hardware>'
    return _HARDWARE.sub(lambda _: element, urdf)
