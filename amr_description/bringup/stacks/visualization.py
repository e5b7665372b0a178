# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a stack shows its user: the page in the browser, and RViz where it is installed."""

from amr_description.ament_index import is_installed
from amr_description.bringup import Node, path_of, Respawn
from amr_description.bringup.conditions import Condition

ANEW = Respawn()
"""Of what a robot does not stand on: controllers and simulator go on when it fails."""
ABOUT_VIEWER = 'whether to serve the page in the browser: the robot, its values, driving'
"""The help text of every stack's ``viewer:=``."""


def page(wanted: bool, start_when: Condition | None = None) -> list[Node]:
    """
    Return the node that serves the page, if it is wanted; its failure does not stop the stack, and
    it is started again.

    Args:
        wanted: the stack's argument ``viewer``.
        start_when: best the readiness of the stack, since there is nothing to show before.
    """
    return [Node('viewer', required=False, respawn=ANEW, start_when=start_when)] if wanted else []


def rviz(config: str) -> list[Node]:
    """
    Return RViz, if it is installed, with a configuration of ``config/rviz``.

    Closing its window does not stop the stack.
    """
    if not is_installed('rviz2'):
        return []
    file = path_of(f'package://amr_description/config/rviz/{config}.rviz')
    return [Node('rviz2', package='rviz2', arguments=['-d', file], required=False)]
