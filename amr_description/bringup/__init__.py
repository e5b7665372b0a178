# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Bring-up: starts a stack of processes in the right order, and leaves none of them behind.

A stack is a function that returns a :class:`Stack`; its parameters are the arguments that a user
types as ``name:=value``. A whole file, started by ``bringup my_stack.py times:=3``::

    from amr_description.bringup import exited_cleanly, Node, Stack

    def my_stack(times: int = 1) -> Stack:
        \"\"\"Look for the robot, then talk.\"\"\"
        look = Node('look', package='my_robot', arguments=['--times', times])
        talk = Node('talker', start_when=exited_cleanly(look))
        return Stack([look, talk])

All of it by example: docs/stacks.md. Modules marked "pure" start no process and read
no clock:

======================== =========================================================================
``description.py``       pure: what a stack is written with: Node, Group, Stack, Respawn
``conditions.py``        pure: when a node starts: conditions, and the state they are evaluated on
``graph_conditions.py``  pure: … on the ROS graph and on files
``handlers.py``          pure: what happens when a node ends, or the stack stops
``validation.py``        pure: type checks for what users write
``user_errors.py``       pure: an exception of a user's code as one line, with its location

``main.py``              the command ``bringup``; --print
``arguments.py``         pure: name:=value, from the signature of a stack's function
``stack_files.py``       finds stacks by name or in users' files; include
``stacks/``              the ready-made stacks
``urdf_text.py``         the text of a robot description; xacro in a child process
``controller_files.py``  the parameter file of the controllers where none is given; namespaces
``input_files.py``       hashes of the files used; a warning where another copy differs
``placement.py``         pure: the tree of groups and stacks, flattened
``command_line.py``      one process per node: name, command line, parameter files
``environment.py``       environment variables: discovery, children, the next shell

``orchestrator.py``      the event loop: starts, watches and ends the processes
``scheduler.py``         pure: what may start, what failed, when it is ready or over; timeouts
``graph_watcher.py``     observes the ROS graph and files while a condition asks
``diagnosis.py``         what the doctor finds when a start has failed
``process.py``           one running process: its process group, its output, its end
``fork_server.py``       starts executables of this package without their imports
``terminal.py``          … that has the terminal, as a shell gives it to a foreground job
``lifeline.py``          parent-death pipe: how children notice the orchestrator's end
``guardian.py``          reaper process: ends what is left after the orchestrator

``reporter.py``          every event of a stack, for the console and for the log of events
``console.py``           the screen and the log files: prefixes, colours, status line
``run_log.py``           the log folder of a run; events.jsonl
``run_registry.py``      the runs of this user on this host; no two nodes of one name
``run_commands.py``      ``bringup status`` and ``bringup stop``
``process_usage.py``     CPU and memory of processes
======================== =========================================================================

The supervisor loads no rclpy, no DDS and no MuJoCo: it starts at once, and no crash of theirs can
take it down.
"""

from amr_description.ament_index import path_of
from amr_description.bringup.conditions import (
    after,
    all_of,
    any_of,
    exited,
    exited_cleanly,
    failed,
    logged,
    on_request,
    started,
)
from amr_description.bringup.description import Group, Node, ready, Respawn, Stack
from amr_description.bringup.graph_conditions import path_exists, ros_node, service, topic
from amr_description.bringup.handlers import EventHandler, Exited, Log, Shutdown, Stopping
from amr_description.bringup.input_files import notes_on
from amr_description.bringup.stack_files import include
from amr_description.bringup.urdf_text import robot_description

__all__ = [
    'EventHandler',
    'Exited',
    'Group',
    'Log',
    'Node',
    'Respawn',
    'Shutdown',
    'Stack',
    'Stopping',
    'after',
    'all_of',
    'any_of',
    'exited',
    'exited_cleanly',
    'failed',
    'include',
    'logged',
    'notes_on',
    'on_request',
    'path_exists',
    'path_of',
    'ready',
    'robot_description',
    'ros_node',
    'service',
    'started',
    'topic',
]
