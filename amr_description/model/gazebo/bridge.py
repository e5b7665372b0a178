# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Configuration files of ``ros_gz_bridge``: what new Gazebo's topics are called in ROS.

A robot made for it has one beside its launch file::

    - ros_topic_name: scan
      gz_topic_name: /world/default/model/rover/link/laser/sensor/lidar/scan
      ros_type_name: sensor_msgs/msg/LaserScan
      gz_type_name: gz.msgs.LaserScan
      direction: GZ_TO_ROS

A ``gz_topic_name`` is compared with the ``<topic>`` of sensors and plugins, without a leading
slash and without ``model/NAME/``; one that Gazebo makes up, as above, by sensor and last part.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
import re
from typing import Any

import yaml

from amr_description.ament_index import path_of
from amr_description.errors import ParameterError, ResourceError, SimulationError
from amr_description.model.gazebo.builder import GazeboTranslation, PluginController
from amr_description.model.gazebo.sensor_tags import topic_part
from amr_description.model.sensors import WorldSensor
from amr_description.parameter_files import load_yaml, YamlError
from amr_description.text import closest_match, quote

_NAMES = ('ros_topic_name', 'gz_topic_name', 'topic_name')
_KEYS = (
    *_NAMES,
    'ros_type_name',
    'gz_type_name',
    'direction',
    'subscriber_queue',
    'publisher_queue',
    'lazy',
    'qos_profile',
)
_DIRECTIONS = ('BIDIRECTIONAL', 'GZ_TO_ROS', 'ROS_TO_GZ')
_MADE_UP = re.compile(r'world/[^/]+/model/.+/sensor/(?P<sensor>[^/]+)/(?P<rest>.+)')
_OF_MODEL = re.compile(r'(?:world/[^/]+/)?model/[^/]+/')
_ALIASES = {'odometry': 'odom', 'joint_state': 'joint_states'}
"""What Gazebo's plugins call a topic by themselves → what it is called here."""
_TOPIC = re.compile(r'[~/]?[A-Za-z_][\w~/{}]*', re.ASCII)
_SHAPE = 'it is a list of  - {ros_topic_name: …, gz_topic_name: …, ros_type_name: …}'


@dataclass(frozen=True, slots=True)
class BridgedTopic:
    """One entry of a file; ``type`` is that in ROS, with ``/msg/``, or ''."""

    name: str
    type: str
    line: int


@dataclass(frozen=True, slots=True)
class Bridge:
    """
    A configuration file of the bridge.

    Attributes:
        source: the file, for messages.
        topics: topic of Gazebo, as it is compared → its name in ROS.
        sensors: (sensor, last part of a topic that Gazebo makes up) → its name in ROS.
    """

    source: str = ''
    topics: Mapping[str, BridgedTopic] = field(default_factory=dict)
    sensors: Mapping[tuple[str, str], BridgedTopic] = field(default_factory=dict)


NO_BRIDGE = Bridge()
"""Topics as they are usually bridged."""


def bridge_of(file: str) -> Bridge:
    """
    Return what topics are called in ROS.

    Args:
        file: the parameter ``bridge`` of a simulation: a path or ``package://`` URI; '': none.

    Raises:
        SimulationError: it is no such file.
    """
    if not file:
        return NO_BRIDGE
    try:
        return read_bridge(path_of(file, 'bridge'))
    except (ParameterError, ResourceError) as error:
        raise SimulationError(str(error)) from error


def read_bridge(path: Path) -> Bridge:
    """Return a configuration file. Raises ParameterError: it is none, with the line."""
    try:
        tree = load_yaml(
            path.read_text(encoding='utf-8'),
            lambda text: yaml.compose(text, Loader=yaml.SafeLoader),
        )
    except OSError as error:
        raise ParameterError(f"bridge file '{path}': {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ParameterError(f"bridge file '{path}': not UTF-8 text ({error})") from error
    except YamlError as error:
        line = ''.join(f':{number}' for number in error.where or ())
        raise ParameterError(f'{path}{line}: {error}') from error
    if tree is not None and not isinstance(tree, yaml.SequenceNode):
        raise ParameterError(f'{path}: it is no configuration of ros_gz_bridge: {_SHAPE}')
    topics: dict[str, BridgedTopic] = {}
    sensors: dict[tuple[str, str], BridgedTopic] = {}
    for node in [] if tree is None else tree.value:
        found = _read_entry(node, str(path))
        if found is None:
            continue
        gz, bridged = found
        if made_up := _MADE_UP.fullmatch(gz):
            sensors.setdefault((made_up['sensor'], made_up['rest']), bridged)
        else:
            gz = _OF_MODEL.sub('', gz, count=1)
            topics.setdefault(_ALIASES.get(gz, gz), bridged)
    return Bridge(str(path), topics, sensors)


def _read_entry(node: yaml.Node, source: str) -> tuple[str, BridgedTopic] | None:
    """Return the topic of Gazebo and its name in ROS; None: it is for ROS alone."""
    line = node.start_mark.line + 1
    where = f'{source}:{line}'
    if not isinstance(node, yaml.MappingNode):
        raise ParameterError(f'{where}: this is no entry of ros_gz_bridge: {_SHAPE}')
    given: dict[str, str] = {}
    for key, value in node.value:
        name, place = str(key.value), f'{source}:{key.start_mark.line + 1}'
        if name in _KEYS and isinstance(value, yaml.ScalarNode):
            given[name] = value.value.strip()
        elif name in _KEYS:
            raise ParameterError(f'{place}: {name} is no text')
        elif meant := closest_match(name, _KEYS):
            raise ParameterError(f'{place}: there is no {quote(name)}; did you mean {meant}?')
    ros = given.get('ros_topic_name') or given.get('topic_name', '')
    gz = given.get('gz_topic_name') or given.get('topic_name', '') or ros
    ros = ros or gz
    if not ros:
        raise ParameterError(f'{where}: an entry has no name of a topic: {_SHAPE}')
    if not _TOPIC.fullmatch(ros):
        raise ParameterError(f'{where}: ros_topic_name {quote(ros)} is no name of a topic of ROS')
    direction = given.get('direction', 'BIDIRECTIONAL').upper()
    if direction not in _DIRECTIONS:
        raise ParameterError(
            f'{where}: direction {quote(direction)} is none of {", ".join(_DIRECTIONS)}'
        )
    kind = given.get('ros_type_name', '')
    if kind.count('/') == 1:
        kind = kind.replace('/', '/msg/')
    return gz.strip('/'), BridgedTopic(ros.rstrip('/'), kind, line)


def bridged(translation: GazeboTranslation, bridge: Bridge) -> GazeboTranslation:
    """
    Return what stands for a robot's plugins and sensors, with topics as a file names them.

    A topic that is in no entry keeps its name.
    """
    if not (bridge.topics or bridge.sensors):
        return translation
    notes: list[str] = []
    sensors = tuple(_bridged_sensor(each, bridge, notes) for each in translation.sensors)
    controllers = tuple(_bridged_controller(each, bridge) for each in translation.controllers)
    return replace(
        translation,
        controllers=controllers,
        sensors=sensors,
        notes=(*translation.notes, *dict.fromkeys(notes)),
    )


def _bridged_controller(controller: PluginController, bridge: Bridge) -> PluginController:
    topics = {
        before: found.name if (found := bridge.topics.get(after.strip('/'))) else after
        for before, after in controller.topics.items()
    }
    return replace(controller, topics=topics)


def _bridged_sensor(sensor: WorldSensor, bridge: Bridge, notes: list[str]) -> WorldSensor:
    names = {}
    for topic, kind in sensor.topics:
        gz = topic.strip('/')
        rest = gz.removeprefix(f'{topic_part(sensor.mount.name)}/')
        found = bridge.topics.get(gz) or bridge.sensors.get((sensor.mount.name, rest))
        if found is None:
            continue
        names[topic] = found.name
        if found.type not in ('', kind):
            notes.append(
                f'{bridge.source}:{found.line}: {quote(found.name)} is {found.type} there; sensor '
                f'{quote(sensor.mount.name)} publishes {kind} on it'
            )

    changes: dict[str, Any] = {
        each: names[getattr(sensor, each)]
        for each in sensor.__dataclass_fields__
        if each.endswith('topic') and getattr(sensor, each) in names
    }
    return replace(sensor, **changes)
