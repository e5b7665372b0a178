# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Bring-up: start a stack of processes in the right order, and leave nothing behind.

A stack is a function that returns a :class:`Stack`; its parameters are what a user may type as
``name:=value``. A whole file, started by ``bringup my_stack.py times:=3``::

    from amr_description.bringup import exited_cleanly, Node, Stack

    def my_stack(times: int = 1) -> Stack:
        \"\"\"Look for the robot, then talk.\"\"\"
        look = Node('look', package='my_robot', arguments=['--times', times])
        talk = Node('talker', start_when=exited_cleanly(look))
        return Stack([look, talk])

All that a stack can say, by example: docs/write_your_own_stack.md.

What stands where:

====================== ============================================================================
description.py         pure: Node, Group, Stack and Respawn, the words of a stack
kinds.py               pure: what kind of value each word takes
conditions.py          pure: when a node starts: what a condition is, how they combine
node_conditions.py     pure: by what became of the other nodes, and what they wrote
outside_conditions.py  pure: by what is on the ROS graph, and by files
handlers.py            pure: what is done when a node ends, or when the stack stops
situation.py           pure: what conditions judge
placement.py           pure: the tree of groups and stacks, flattened
arguments.py           pure: name:=value, from the signature of the stack's function
progress.py            pure: what may start now, what failed, when it is ready or over
waits.py               pure: how long each wait may take
blame.py               pure: where in a user's code an error arose
packages.py            where the ament index has packages, executables and shared files
parameter_file.py      pure: parameters as the YAML that rcl reads
urdf_text.py           the text of a description; xacro runs in a child process
file_notes.py          which files are used, and whether another copy of one is edited
job.py                 a node made ready to run: name, command line, environment
discovery.py           who finds the nodes: domain, range, peers, discovery server
environment.py         pure: the environment of a child, and of the user's next shell
listing.py             what ``--print`` prints
line_splitter.py       pure: bytes from a pipe -> lines
child.py               one running process: its session, its output, its end
orchestrator.py        the engine: start, watch, stop
outlook.py             the ROS graph and files, looked at while a condition asks
lifeline.py            what a child sees of the orchestrator's life; the guardian is started here
guardian.py            a program of its own: ends what is left, whatever became of the orchestrator
log_folder.py          the folder of log files of one run
narrator.py            what the orchestrator says of a stack, in launch's words
post_mortem.py         pure: what is said of the failure that stopped a stack
console.py             what a person reads: prefixes, colours, log files
start_status.py        what a start waits for, told while it takes
early_signals.py       signals before the orchestrator listens
event_log.py           what happens in a run, for programs: events.jsonl
terminal.py            one process with the terminal, as a shell gives it
run_registry.py        the runs of this user on this host
unique_names.py        pure: nodes that there can be only one of
run_commands.py        ``bringup status`` and ``bringup stop``
process_usage.py       what processes use of the machine
main.py                the command ``bringup``
stack_files.py         finds stacks, by name or in files of users; include
stacks/                the ready-made stacks
====================== ============================================================================

Only the standard library is imported here, so that no crash of rclpy can take the supervisor down.
"""

from amr_description.ament_index import path_of
from amr_description.bringup.conditions import (
    after,
    all_of,
    any_of,
    exited_cleanly,
    failed,
    logged,
    on_request,
    started,
)
from amr_description.bringup.description import Group, Node, ready, Respawn, Stack
from amr_description.bringup.graph_conditions import path_exists, ros_node, service, topic
from amr_description.bringup.handlers import Exited, Shutdown, Stopping
from amr_description.bringup.input_files import notes_on
from amr_description.bringup.stack_files import include
from amr_description.bringup.urdf_text import robot_description

__all__ = [
    'Exited',
    'Group',
    'Node',
    'Respawn',
    'Shutdown',
    'Stack',
    'Stopping',
    'after',
    'all_of',
    'any_of',
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
