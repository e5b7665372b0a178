# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which nodes of a stack there can be only one of in a ROS domain.

Two of one name answer each other's services and publish the same topics. What is known to be so:
a node that the stack names, and those programs of ours that go by a fixed name. Steps and tools
may be there several times: they end soon, or name themselves.
"""

from argparse import ArgumentParser
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from amr_description.bringup.job import Job

# executable -> names of its nodes, the first of which `name=` changes
_FIXED = {
    'mujoco_sim': ('mujoco_sim', 'controller_manager'),
    'robot_state_publisher': ('robot_state_publisher',),
    'ros2_control_node': ('controller_manager',),
}


def add_option(parser: ArgumentParser) -> None:
    """Add the option that lets them be there twice."""
    parser.add_argument(
        '-f',
        '--force',
        action='store_true',
        help='start although a running stack has nodes of the same names',
    )


def of(jobs: 'Sequence[Job]') -> set[str]:
    """Return their full names: ``/mujoco_sim``, ``/robot1/controller_manager``."""
    pairs = ((job.placed.namespace or '', name) for job in jobs for name in _names(job))
    return {f'{namespace.rstrip("/")}/{name}' for namespace, name in pairs}


def _names(job: 'Job') -> Sequence[str]:
    node = job.node
    fixed = _FIXED.get(node.executable, ()) if node.package == 'amr_description' else ()
    return (node.name, *fixed[1:]) if node.name else fixed
