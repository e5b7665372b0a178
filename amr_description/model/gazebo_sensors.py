# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The sensors that ``<gazebo reference="link">`` blocks mount on links."""

from dataclasses import dataclass
import math

from lxml import etree

from amr_description.model.element_reader import ElementReader, line_of, parse_number
from amr_description.model.findings import quote, raise_error
from amr_description.model.frames import Transform
from amr_description.model.gazebo_noise import Noise, read_imu_noise
from amr_description.model.robot import Robot
from amr_description.model.xml_source import parse_xml


@dataclass(frozen=True, slots=True)
class GazeboSensor:
    """One ``<sensor>``; ``place`` (its ``<pose>``) is ``transform_sensor_to_link``."""

    name: str
    type: str
    link: str
    place: Transform
    line: int
    noise: tuple[tuple[str, Noise], ...] = ()
    """Of an IMU: state interface, such as ``angular_velocity.x``, and its noise."""


def gazebo_sensors_of(robot: Robot) -> tuple[GazeboSensor, ...]:
    """Return the sensors of all ``<gazebo>`` blocks; DescriptionError at the first fault."""
    xml = parse_xml(robot.text, robot.source, raise_error)
    if xml is None:
        return ()
    reader = ElementReader(robot.source, raise_error)
    return tuple(
        _read_sensor(sensor, gazebo.get('reference', ''), reader)
        for gazebo in xml.iterchildren('gazebo')
        for sensor in gazebo.iterchildren('sensor')
    )


def _read_sensor(element: etree._Element, link: str, reader: ElementReader) -> GazeboSensor:
    name = reader.required(element, 'name')
    reader = reader.of(f'gazebo sensor {quote(name)}')
    if not link:
        reader.error(
            element,
            'its <gazebo> has no attribute "reference"',
            expected='the link that the sensor is mounted on',
        )
    place = _read_pose(element, reader)
    noise = tuple(read_imu_noise(element, reader))
    return GazeboSensor(name, element.get('type', ''), link, place, line_of(element), noise)


def _read_pose(element: etree._Element, reader: ElementReader) -> Transform:
    text = element.findtext('pose', '0 0 0 0 0 0')
    values = [parse_number(word) for word in text.split()]
    if len(values) != 6 or not all(map(math.isfinite, values)):
        reader.error(element, '<pose>', found=quote(text.strip()), expected='6 numbers, finite')
        return Transform()
    x, y, z, *rpy = values
    return Transform.from_xyz_rpy((x, y, z), (rpy[0], rpy[1], rpy[2]))
