# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The plugins that ``<gazebo>`` blocks ask for, above all the one that hosts ros2_control.

A URDF made for Gazebo runs here unchanged: the simulator takes the place of the plugin and reads
its parameters files, namespace and remappings from this block.
"""

from dataclasses import dataclass

from lxml import etree

from amr_description.model.element_reader import ElementReader, line_of, parse_number
from amr_description.model.findings import quote, raise_error, Report
from amr_description.model.robot import Robot
from amr_description.model.xml_source import parse_xml

_ROS2_CONTROL_PLUGINS = (
    'gz_ros2_control::GazeboSimROS2ControlPlugin',
    'ign_ros2_control::IgnitionROS2ControlPlugin',
)

GAZEBOS_GAIN = 0.1


@dataclass(frozen=True, slots=True)
class GazeboPlugin:
    """
    One ``<plugin>``; the fields after ``line`` are read only for a plugin that hosts ros2_control.

    ``parameters`` are the paths of YAML files as written, ``remappings`` rules such as
    ``odom:=/odom``. ``hold_joints`` keeps joints that nobody commands in place.
    ``position_proportional_gain`` is that of Gazebo's position servo (1/period).
    """

    filename: str
    name: str
    line: int
    parameters: tuple[str, ...] = ()
    controller_manager_name: str = 'controller_manager'
    namespace: str = ''
    remappings: tuple[str, ...] = ()
    hold_joints: bool = True
    position_proportional_gain: float = GAZEBOS_GAIN

    @property
    def hosts_ros2_control(self) -> bool:
        """Whether this plugin starts a controller manager."""
        return self.name in _ROS2_CONTROL_PLUGINS


def gazebo_plugins_of(robot: Robot) -> tuple[GazeboPlugin, ...]:
    """Return the plugins of all ``<gazebo>`` blocks; DescriptionError at the first fault."""
    xml = parse_xml(robot.text, robot.source, raise_error)
    return () if xml is None else read_gazebo_plugins(xml, robot.source, raise_error)


def ros2_control_host_of(robot: Robot) -> GazeboPlugin:
    """
    Return the plugin that hosts ros2_control, the first if there are several; with all defaults
    if there is none. DescriptionError at the first fault.
    """
    hosts = (plugin for plugin in gazebo_plugins_of(robot) if plugin.hosts_ros2_control)
    return next(hosts, GazeboPlugin(filename='', name='', line=0))


def read_gazebo_plugins(
    xml: etree._Element, source: str, report: Report
) -> tuple[GazeboPlugin, ...]:
    """Return what can be read of the plugins below ``xml``, reporting every fault."""
    reader = ElementReader(source, report)
    return tuple(
        _read_plugin(plugin, reader.of(f'gazebo plugin {quote(plugin.get("name", ""))}'))
        for gazebo in xml.iterchildren('gazebo')
        for plugin in gazebo.iterchildren('plugin')
    )


def _read_plugin(element: etree._Element, reader: ElementReader) -> GazeboPlugin:
    name, filename = element.get('name', ''), reader.required(element, 'filename')
    plugin = GazeboPlugin(filename, name, line_of(element))
    if not plugin.hosts_ros2_control:
        return plugin
    files = _texts(element, 'parameters')
    if '' in files:
        reader.error(element, '<parameters> is empty', expected='the path of a YAML file')
    manager = element.findtext('controller_manager_name', '').strip()
    return GazeboPlugin(
        filename=filename,
        name=name,
        line=plugin.line,
        parameters=tuple(filter(None, files)),
        controller_manager_name=manager or plugin.controller_manager_name,
        namespace=element.findtext('ros/namespace', '').strip(),
        remappings=tuple(filter(None, _texts(element, 'ros/remapping'))),
        hold_joints=_read_hold_joints(element, reader),
        position_proportional_gain=_read_gain(element, reader),
    )


def _texts(element: etree._Element, path: str) -> list[str]:
    return [(child.text or '').strip() for child in element.iterfind(path)]


def _read_hold_joints(element: etree._Element, reader: ElementReader) -> bool:
    text = element.findtext('hold_joints', 'true').strip().lower()
    if text not in ('true', 'false', '1', '0'):
        reader.error(element, '<hold_joints>', found=quote(text), expected='true or false')
    return text not in ('false', '0')


def _read_gain(element: etree._Element, reader: ElementReader) -> float:
    text = element.findtext('position_proportional_gain', str(GAZEBOS_GAIN)).strip()
    gain = parse_number(text)
    if not 0.0 < gain < float('inf'):
        reader.error(
            element,
            '<position_proportional_gain>',
            found=quote(text),
            expected='a finite number above 0',
        )
        return GAZEBOS_GAIN
    return gain
