# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Of what a recorded run consists: what is needed to run it again.

In a recording of the simulator it is a latched message on :data:`TOPIC`
(``std_msgs/msg/String``), which is in the recording only, in JSON::

    {"parameters": {"world": "ramp"},          # of mujoco_sim, where they are not the defaults
     "controllers": "controller_manager: …",   # the parameter file, as a text; or empty, or a list
     "robots": [{"name": "amr", "namespace": "/", "position": [0, 0, 0], "rotation": [0, 0, 0, 1],
                 "description": "<robot …"}],
     "commands": ["/diff_drive_controller/cmd_vel"]}  # which act, at the times of their messages
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
import json
from typing import Any, TypeAlias

from amr_description.errors import BagError

TOPIC = '/mujoco_sim/run'
TYPE = 'std_msgs/msg/String'

Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True)
class RunRobot:
    """A robot of a run, as it was spawned."""

    name: str
    namespace: str
    """Absolute."""
    position: Vector
    """m, in the world."""
    rotation: Quaternion
    """x, y, z, w."""
    description: str
    """Its URDF."""


@dataclass(frozen=True)
class RunDescription:
    """See the module."""

    parameters: Mapping[str, Any] = field(default_factory=dict)
    controllers: tuple[str, ...] = ()
    """Texts of the parameter files."""
    robots: tuple[RunRobot, ...] = ()
    commands: tuple[str, ...] = ()
    """Topics of which the messages are those that controllers have acted on."""

    def to_text(self) -> str:
        """Return it as JSON."""
        robots = [
            {
                'name': each.name,
                'namespace': each.namespace,
                'position': list(each.position),
                'rotation': list(each.rotation),
                'description': each.description,
            }
            for each in self.robots
        ]
        texts = self.controllers
        node = {
            'parameters': dict(self.parameters),
            'controllers': list(texts) if len(texts) > 1 else ''.join(texts),
            'robots': robots,
            'commands': list(self.commands),
        }
        return json.dumps(node, ensure_ascii=False)


def from_text(text: str) -> RunDescription:
    """Return the description of a JSON text. Raises BagError."""
    try:
        node = json.loads(text)
        robots = [
            RunRobot(
                str(each['name']),
                str(each['namespace']),
                _numbers(each['position'], 3),
                _numbers(each['rotation'], 4),
                str(each['description']),
            )
            for each in node['robots']
        ]
        given = node['controllers']
        texts = given if isinstance(given, list) else [given]
        return RunDescription(
            dict(node['parameters']),
            tuple(str(each) for each in texts if each),
            tuple(robots),
            tuple(str(each) for each in node['commands']),
        )
    except (ValueError, KeyError, TypeError) as error:
        raise BagError(f'{TOPIC}: not the description of a run: {error!r}') from error


def _numbers(node: Any, count: int) -> Any:
    values = tuple(float(each) for each in node)
    if len(values) != count:
        raise ValueError(f'{count} numbers are wanted, not {len(values)}')
    return values
