# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``<gazebo>`` blocks: the plugin that hosts ros2_control, and the sensors on links with their noise.

A URDF made for Gazebo runs here unchanged: the simulator replaces the plugin and reads its
parameter files, namespace and remappings from the block.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
import math

from lxml import etree

from amr_description.model.findings import Finding, Report
from amr_description.model.frames import Quaternion, quaternion_from_rpy, Transform
from amr_description.model.origins import raise_error_of
from amr_description.model.robot import Robot
from amr_description.model.xml_reader import ElementReader, line_of, parse_number, parse_xml
from amr_description.text import quote, truth

_ROS2_CONTROL_PLUGINS = (
    'gz_ros2_control::GazeboSimROS2ControlPlugin',
    'ign_ros2_control::IgnitionROS2ControlPlugin',
)
_ROS2_CONTROL_LIBRARIES = (
    'gz_ros2_control-system',
    'ign_ros2_control-system',
    'gazebo_ros2_control',
)
"""New Gazebo's, Ignition's and Classic's, without ``lib`` and ``.so``."""
GAZEBO_POSITION_GAIN = 0.1
"""1/period: the default gain of Gazebo's position servo."""

WORLD_SENSORS = (
    'gpu_lidar',
    'lidar',
    'gpu_ray',
    'ray',
    'camera',
    'depth_camera',
    'depth',
    'rgbd_camera',
    'rgbd',
    'contact',
    'sonar',
)
"""Types of sensors that look at the world: :mod:`amr_description.model.gazebo.sensors`."""

GAUSSIAN_TYPES = ('gaussian', 'gaussian_quantized')
TYPES = ('none', *GAUSSIAN_TYPES)
_NOISES = tuple(
    (f'{inside}/{axis}/noise', f'{interface}.{axis}')
    for inside, interface in (
        ('imu/angular_velocity', 'angular_velocity'),
        ('imu/linear_acceleration', 'linear_acceleration'),
        ('force_torque/force', 'force'),
        ('force_torque/torque', 'torque'),
        ('magnetometer', 'magnetic_field'),
    )
    for axis in 'xyz'
)
"""Where a tag has noise, and the state interface that has it."""
_FORMER_NOISES = (('rate', 'angular_velocity'), ('accel', 'linear_acceleration'))
"""Parts of ``<imu><noise>`` before SDF 1.5, each for x, y and z."""
_HALF = math.sqrt(0.5)
REFERENCES: Mapping[str, Quaternion] = {
    'ENU': (0.0, 0.0, 0.0, 1.0),
    'NED': (_HALF, _HALF, 0.0, 0.0),
    'NWU': (0.0, 0.0, _HALF, _HALF),
}
"""
``<localization>`` of an IMU → the orientation of that frame in the world, whose x is east and y
north.
"""
_REFERENCE = 'imu/orientation_reference_frame'
_NEVER_NEGATIVE = (
    'stddev',
    'bias_stddev',
    'dynamic_bias_stddev',
    'dynamic_bias_correlation_time',
    'precision',
)


@dataclass(frozen=True, slots=True)
class GazeboPlugin:
    """
    One ``<plugin>``; the fields after ``line`` are read only for a plugin that hosts ros2_control.

    ``parameters`` are the paths of YAML files as written, ``remappings`` rules such as
    ``odom:=/odom``. ``hold_joints`` keeps joints where they are that no controller commands.
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
    position_proportional_gain: float = GAZEBO_POSITION_GAIN

    @property
    def hosts_ros2_control(self) -> bool:
        """Whether this plugin starts a controller manager."""
        library = self.filename.rpartition('/')[2].removeprefix('lib').removesuffix('.so')
        return self.name in _ROS2_CONTROL_PLUGINS or library in _ROS2_CONTROL_LIBRARIES


def gazebo_plugins_of(robot: Robot) -> tuple[GazeboPlugin, ...]:
    """Return the plugins of all ``<gazebo>`` blocks. Raises DescriptionError."""
    report = raise_error_of(robot.text)
    xml = parse_xml(robot.text, robot.source, report)
    return () if xml is None else read_gazebo_plugins(xml, robot.source, report)


def ros2_control_host_of(robot: Robot) -> GazeboPlugin:
    """
    Return the first plugin that hosts ros2_control, or one with all defaults if there is none.

    Raises DescriptionError at the first fault.
    """
    hosts = (plugin for plugin in gazebo_plugins_of(robot) if plugin.hosts_ros2_control)
    return next(hosts, GazeboPlugin(filename='', name='', line=0))


def read_gazebo_plugins(
    xml: etree._Element, source: str, report: Report
) -> tuple[GazeboPlugin, ...]:
    """Return the plugins below ``xml`` as far as they can be read; report every fault."""
    reader = ElementReader(source, report)
    return tuple(
        _read_plugin(plugin, reader.of(f'gazebo plugin {quote(plugin.get("name", ""))}'))
        for gazebo in xml.iterchildren('gazebo')
        for plugin in gazebo.iterchildren('plugin')
    )


@dataclass(frozen=True, slots=True)
class Noise:
    """
    The ``<noise>`` of a sensor, as in SDF; all in the unit of the measured quantity, times in s.

    The sensor reports ``value + bias + normal(mean, stddev)``. The bias is drawn once, from
    ``normal(bias_mean, bias_stddev)``, with either sign alike. A dynamic bias then changes as a
    Gauss–Markov process: ``bias' = exp(-dt / tau) bias + normal(0, s)`` with
    ``s² = dynamic_bias_stddev² tau / 2 (1 - exp(-2 dt / tau))``.
    """

    mean: float = 0.0
    stddev: float = 0.0
    bias_mean: float = 0.0
    bias_stddev: float = 0.0
    dynamic_bias_stddev: float = 0.0
    dynamic_bias_correlation_time: float = 0.0
    precision: float = 0.0
    """The reported value is a multiple of it; 0: it is not rounded."""

    @property
    def is_some(self) -> bool:
        """Whether the reported value is another than the true one."""
        return self != Noise()

    @property
    def has_dynamic_bias(self) -> bool:
        """Whether the bias changes over time."""
        return self.dynamic_bias_stddev > 0.0 and self.dynamic_bias_correlation_time > 0.0


@dataclass(frozen=True, slots=True)
class GazeboSensor:
    """One ``<sensor>``; ``pose`` is ``transform_sensor_to_link``."""

    name: str
    type: str
    link: str
    pose: Transform
    line: int
    noise: tuple[tuple[str, Noise], ...] = ()
    """(state interface, such as ``angular_velocity.x``, its noise)."""
    localization: str = ''
    """Of an IMU: the frame of its orientation, of :data:`REFERENCES` or CUSTOM; '': the world."""
    custom_reference: Quaternion = (0.0, 0.0, 0.0, 1.0)
    """Likewise: the orientation of the frame CUSTOM in the world."""
    frame: str = 'child'
    """Of a force-torque sensor: the axes, those of ``child``, ``parent`` or ``sensor``."""
    measure_direction: str = 'child_to_parent'
    """Likewise: whose wrench on whom it measures, or ``parent_to_child``."""

    @property
    def reference(self) -> Quaternion | None:
        """The orientation in the world of the frame of an IMU's orientation; None: the world."""
        if self.localization == 'CUSTOM':
            return self.custom_reference
        return REFERENCES.get(self.localization)

    @property
    def has_unknown_reference(self) -> bool:
        """Whether that frame is none that is known."""
        return self.localization not in ('', 'CUSTOM', *REFERENCES)


def gazebo_sensors_of(robot: Robot) -> tuple[GazeboSensor, ...]:
    """
    Return the sensors of all ``<gazebo>`` blocks that can be read, and all that see the world.

    What is wrong with the others is told by the checker, see :func:`sensor_faults`; those that
    look at the world are read by :mod:`amr_description.model.gazebo.sensors`.
    """
    xml = parse_xml(robot.text, robot.source, raise_error_of(robot.text))
    if xml is None:
        return ()
    found = []
    for gazebo in xml.iterchildren('gazebo'):
        for element in gazebo.iterchildren('sensor'):
            faults: list[Finding] = []
            reader = ElementReader(robot.source, faults.append)
            sensor = _read_sensor(element, gazebo.get('reference', ''), reader)
            if not faults or sensor.type in WORLD_SENSORS:
                found.append(sensor)
    return tuple(found)


def sensor_faults(element: etree._Element, link: str, source: str) -> tuple[Finding, ...]:
    """Return what is wrong with the ``<sensor>`` of an instrument, such as an IMU, on a link."""
    faults: list[Finding] = []
    _read_sensor(element, link, ElementReader(source, faults.append))
    return tuple(faults)


def _read_noises(sensor: etree._Element, reader: ElementReader) -> Iterator[tuple[str, Noise]]:
    """Yield the noise of each state interface that has some, such as ``angular_velocity.x``."""
    for path, interface in _NOISES:
        element = sensor.find(path)
        if element is not None:
            noise = _read_noise(element, reader.of(f'{reader.label}: {interface}'))
            if noise is not None:
                yield interface, noise
    former = sensor.find('imu/noise')
    if former is None:
        return
    kind = _noise_type(former)
    for part, quantity in _FORMER_NOISES:
        element = former.find(part)
        if element is not None:
            noise = _read_noise(element, reader.of(f'{reader.label}: <{part}>'), kind)
            if noise is not None:
                yield from ((f'{quantity}.{axis}', noise) for axis in 'xyz')


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
    if truth(text) is None:
        reader.error(element, '<hold_joints>', found=quote(text), expected='true or false')
    return truth(text) is not False


def _read_gain(element: etree._Element, reader: ElementReader) -> float:
    text = element.findtext('position_proportional_gain', str(GAZEBO_POSITION_GAIN)).strip()
    gain = parse_number(text)
    if not 0.0 < gain < float('inf'):
        reader.error(
            element,
            '<position_proportional_gain>',
            found=quote(text),
            expected='a finite number above 0',
        )
        return GAZEBO_POSITION_GAIN
    return gain


def _read_sensor(element: etree._Element, link: str, reader: ElementReader) -> GazeboSensor:
    name = reader.required(element, 'name')
    reader = reader.of(f'gazebo sensor {quote(name)}')
    if not link:
        reader.error(
            element,
            'its <gazebo> has no attribute "reference"',
            expected='the link that the sensor is mounted on',
        )
    pose = _read_pose(element, reader)
    return GazeboSensor(
        name=name,
        type=element.get('type', ''),
        link=link,
        pose=pose,
        line=line_of(element),
        noise=tuple(_read_noises(element, reader)),
        localization=element.findtext(f'{_REFERENCE}/localization', '').strip(),
        custom_reference=_read_custom(element, reader),
        frame=element.findtext('force_torque/frame', 'child').strip(),
        measure_direction=element.findtext(
            'force_torque/measure_direction', 'child_to_parent'
        ).strip(),
    )


def _read_pose(element: etree._Element, reader: ElementReader) -> Transform:
    text = element.findtext('pose', '0 0 0 0 0 0')
    values = [parse_number(word) for word in text.split()]
    if len(values) != 6 or not all(map(math.isfinite, values)):
        reader.error(element, '<pose>', found=quote(text.strip()), expected='6 numbers, finite')
        return Transform()
    x, y, z, *rpy = values
    return Transform.from_xyz_rpy((x, y, z), (rpy[0], rpy[1], rpy[2]))


def _read_custom(element: etree._Element, reader: ElementReader) -> Quaternion:
    text = element.findtext(f'{_REFERENCE}/custom_rpy', '0 0 0')
    values = [parse_number(word) for word in text.split()]
    if len(values) != 3 or not all(map(math.isfinite, values)):
        reader.error(
            element, '<custom_rpy>', found=quote(text.strip()), expected='3 numbers, finite'
        )
        return (0.0, 0.0, 0.0, 1.0)
    roll, pitch, yaw = values
    return quaternion_from_rpy(roll, pitch, yaw)


def _noise_type(element: etree._Element) -> str:
    """Return the type, an attribute, or as before SDF 1.5 an element."""
    return element.get('type') or element.findtext('type', '').strip() or 'none'


def _read_noise(element: etree._Element, reader: ElementReader, kind: str = '') -> Noise | None:
    """Return what a tag says; ``kind``: of noise, '' as the tag itself says."""
    kind = kind or _noise_type(element)
    if kind not in TYPES:
        reader.error(
            element, 'type of <noise>', found=quote(kind), expected=f'one of {", ".join(TYPES)}'
        )
    if kind not in GAUSSIAN_TYPES:
        return None
    values = {}
    for name in Noise.__dataclass_fields__:
        text = element.findtext(name)
        if text is None or (name == 'precision' and kind == 'gaussian'):
            continue
        values[name] = value = parse_number(text.strip())
        least = 0.0 if name in _NEVER_NEGATIVE else -math.inf
        if not (math.isfinite(value) and value >= least):
            expected = 'a finite number' if least else 'a finite number from 0 on'
            reader.error(element, f'<{name}>', found=quote(text.strip()), expected=expected)
    return Noise(**values)
