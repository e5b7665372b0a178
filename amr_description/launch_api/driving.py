# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a user would type next, once a launch file of theirs is up: what drives the robot in it."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from amr_description.bringup.description import Node
from amr_description.bringup.stacks.controllers import plan_controllers
from amr_description.bringup.stacks.next_steps import how_to_drive, velocity_topic
from amr_description.errors import AmrError
from amr_description.launch_api.files_in_place import value_of

_MANAGERS = ('mujoco_sim', 'ros2_control_node')


def next_steps(nodes: Sequence[Node], *, has_page: bool) -> str:
    """
    Return how the one robot of a launch file is driven; '': that is not known.

    Args:
        nodes: All that are started.
        has_page: Whether the page is.
    """
    managers = [node for node in nodes if node.executable in _MANAGERS]
    texts = {text for node in nodes if (text := value_of(node, 'robot_description'))}
    spawned = {word for node in nodes if node.executable == 'spawner' for word in node.arguments}
    spaces = {node.namespace for node in nodes if node.executable == 'create'}
    if len(managers) != 1 or len(texts) != 1 or len(spaces) > 1:
        return ''
    files = value_of(managers[0], 'controllers') or ','.join(
        str(each) for each in managers[0].parameters if isinstance(each, Path)
    )
    if '--controller-ros-args' in spawned:  # which may give the topic another name
        return ''
    with suppress(AmrError):  # who reads it says what is wrong
        (space,) = spaces or {None}
        plan = plan_controllers(
            'robot_description', texts.pop(), files, namespace=(space or '').rstrip('/')
        )
        if not plan.is_that_of_amr:
            plan = replace(
                plan, declared=tuple(each for each in plan.declared if each.name in spawned)
            )
        elif not spawned.issuperset(plan.names):
            return ''
        if topic := velocity_topic(plan):
            names = {str(a): str(b) for a, b in managers[0].remappings}
            return how_to_drive(has_page, replace(topic, name=names.get(topic.name, topic.name)))
    return ''
