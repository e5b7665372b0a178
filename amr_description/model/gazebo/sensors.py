# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Lidars, cameras and contact sensors from the ``<sensor>`` tags of ``<gazebo>`` blocks.

New Gazebo's sensors publish on ``<topic>`` by themselves, those of Classic by the plugin in their
tag (:mod:`amr_description.model.gazebo.classic_sensors`). Here each has the topics that it has in
ROS: new Gazebo's as they are usually bridged, ``<topic>`` without a leading ``/model/NAME`` or
slash, in the namespace of the robot.

================================ ==================================================================
type                             topics; without ``<topic>``
================================ ==================================================================
gpu_lidar, lidar, gpu_ray, ray   ``<topic>``, ``<topic>/points``; ``scan``, of several lidars
                                 ``NAME/scan``
camera                           ``<topic>``, ``camera_info`` beside it; ``NAME/image``
depth_camera, depth              ``<topic>``, ``<topic>/points``, ``camera_info`` beside it;
                                 ``NAME/depth_image``
rgbd_camera, rgbd                ``<topic>/image``, ``/depth_image``, ``/points``,
                                 ``/camera_info``; ``NAME``
contact                          ``<topic>``; ``NAME/contact``
sonar                            ``<topic>``: Range; ``NAME/range``
================================ ==================================================================

The frame of the messages is the one that the tag names, else the link that the sensor is on; of a
camera, the link below it that has ``optical`` in its name (REP 103). Gazebo would take
``MODEL/LINK/SENSOR``, which is in no tree of transforms.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
import math

from lxml import etree

from amr_description.model.gazebo.builder import gz_sensor_topic
from amr_description.model.gazebo.classic_sensors import read_classic
from amr_description.model.gazebo.plugins import PluginElement, sensors_of
from amr_description.model.gazebo.sensor_tags import (
    camera_of,
    LEFT_OUT,
    lidar_of,
    SensorTag,
    topic_part,
)
from amr_description.model.gazebo.tags import sensor_faults, WORLD_SENSORS
from amr_description.model.kinematics import link_poses
from amr_description.model.origins import raise_error_of
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import read_hardware
from amr_description.model.sensors import (
    Camera,
    ContactSensor,
    Lidar,
    RANGE,
    RobotSensors,
    ScanAxis,
    WorldSensor,
)
from amr_description.model.xml_reader import parse_xml
from amr_description.text import closest_match, quote, quote_all

SERVED_ELSEWHERE = ('force_torque', 'imu', 'magnetometer')
"""Types whose values are state interfaces of hardware, and published by broadcasters."""
_LACKING = (
    'air_flow',
    'air_pressure',
    'air_speed',
    'altimeter',
    'boundingbox',
    'boundingbox_camera',
    'custom',
    'dvl',
    'gps',
    'logical_camera',
    'multicamera',
    'navsat',
    'rfid',
    'rfidtag',
    'segmentation',
    'segmentation_camera',
    'thermal',
    'thermal_camera',
    'wide_angle_camera',
    'wideanglecamera',
    'wireless_receiver',
    'wireless_transmitter',
)
"""Types that are known to Gazebo and not simulated."""
_TYPES = (*WORLD_SENSORS, *SERVED_ELSEWHERE, *_LACKING)
_FRAMES = ('gz_frame_id', 'ignition_frame_id', 'frame_id')
"""New Gazebo's names of the frame, the newest first; SDF's last."""
_SONAR_RAYS = 9
"""Along either side of the square in which a sonar looks."""
_SIMILAR = 0.6


def robot_sensors_of(robot: Robot) -> RobotSensors:
    """
    Return the sensors of a robot that look at the world.

    Raises DescriptionError: a ``<ros2_control>`` block is invalid.
    """
    report = raise_error_of(robot.text, strict=False)
    xml = parse_xml(robot.text, robot.source, report)
    if xml is None:
        return RobotSensors()
    hardware = read_hardware(xml, robot, report)
    return read_sensors(xml, robot, {each.name for info in hardware for each in info.sensors})


def read_sensors(
    xml: etree._Element, robot: Robot, controlled: Collection[str] = ()
) -> RobotSensors:
    """
    Return the sensors below ``xml`` that look at the world, and what is wrong with any.

    Args:
        xml: the root of the description.
        robot: the description; its tree may be broken.
        controlled: sensors of ``<ros2_control>``, which are its own.
    """
    found = sensors_of(xml)
    poses = link_poses(robot) if found else {}
    tags = [SensorTag(element, link.strip(), robot, poses) for element, link in found]
    faulty: set[str] = set()
    sensors: list[tuple[SensorTag, WorldSensor]] = []
    lacking: list[tuple[str, str]] = []
    for tag in tags:
        _check_place(tag)
        if tag.type in SERVED_ELSEWHERE and not tag.is_faulty:
            _check_instrument(tag, is_controlled=tag.name in controlled)
        if tag.is_faulty:
            faulty.add(tag.name)
        if tag.name in controlled or tag.is_faulty:
            continue
        read = _read(tag)
        if read is None:
            lacking.append((tag.name, tag.type))
        elif not tag.is_faulty:
            sensors += [(tag, each) for each in read]
    sound = _with_own_topics(sensors)
    findings = tuple(each for tag in tags for each in tag.findings)
    return RobotSensors(tuple(sound), findings, tuple(lacking), frozenset(faulty))


def range_finder_of(robot: Robot, name: str) -> Lidar | None:
    """
    Return the Gazebo sensor that stands for a range finder of ``<ros2_control>``, without topics.

    Args:
        robot: the description.
        name: of the sensor, the same in both.

    Returns:
        None if there is no such one, or a faulty one, which is reported elsewhere.
    """
    xml = parse_xml(robot.text, robot.source, raise_error_of(robot.text, strict=False))
    for element, link in () if xml is None else sensors_of(xml):
        if element.get('name') == name and _READERS.get(element.get('type', '')) in (
            _lidar,
            _sonar,
        ):
            tag = SensorTag(element, link.strip(), robot, link_poses(robot))
            is_sonar = element.get('type') == 'sonar'
            lidar = _sonar(tag) if is_sonar else lidar_of(tag, tag.mount(tag.link))
            return None if tag.is_faulty else lidar
    return None


def has_sensors(gazebo: etree._Element) -> bool:
    """Return whether a ``<gazebo>`` block has sensors, whose link is checked here."""
    return gazebo.find('sensor') is not None


def _read(tag: SensorTag) -> list[WorldSensor] | None:
    """Return what a tag stands for, which may be nothing; None: it is not simulated."""
    if not tag.type or tag.type not in _TYPES:
        meant = closest_match(tag.type, _TYPES, _SIMILAR)
        tag.error(
            'its type is none of SDF' if tag.type else 'it has no type',
            found=quote(tag.type) if tag.type else '',
            expected=f'one of {", ".join(WORLD_SENSORS)}, imu, …',
            fix=f'write type="{meant}"' if meant else '',
        )
        return []
    if tag.type in SERVED_ELSEWHERE:
        return []
    classic = _classic_plugin(tag.element)
    if classic is not None:
        return read_classic(tag, classic)
    read = _READERS.get(tag.type)
    return None if read is None else [read(tag)]


def _classic_plugin(sensor: etree._Element) -> PluginElement | None:
    """Return the plugin of Gazebo Classic that publishes what a sensor measures."""
    plugins = (PluginElement(each, []) for each in sensor.iterchildren('plugin'))
    return next((each for each in plugins if each.is_classic), None)


def _check_instrument(tag: SensorTag, *, is_controlled: bool) -> None:
    """Report what is wrong with an IMU and its like; one of ``<ros2_control>`` is needed."""
    for fault in sensor_faults(tag.element, tag.link, tag.robot.source):
        tag.findings.append(fault if is_controlled else replace(fault, taken=LEFT_OUT))
        tag.is_faulty = True


def _check_place(tag: SensorTag) -> None:
    """Report a sensor without a name, or one that is on no link."""
    if not tag.name:
        tag.error('it has no attribute "name"', fix='give it one, such as name="lidar"')
    if not tag.link:
        tag.error(
            'its <gazebo> has no attribute "reference"',
            expected='the link that the sensor is mounted on',
        )
    elif not tag.robot.has_link(tag.link):
        has_joint = tag.robot.has_joint(tag.link)
        if has_joint and tag.type == 'force_torque':
            return
        links = [link.name for link in tag.robot.links]
        meant = closest_match(tag.link, links, _SIMILAR)
        if has_joint:
            meant = tag.robot.joint(tag.link).child
        tag.leave_out(
            'it is mounted on a link that is not there',
            tag.element.getparent(),
            found=quote(tag.link),
            expected=f'one of {quote_all(links)}',
            fix=f'write reference="{meant}"' if meant else '',
        )


def _with_own_topics(
    sensors: Iterable[tuple[SensorTag, WorldSensor]],
) -> list[WorldSensor]:
    """
    Return the sensors without those that would publish on a topic of another type.

    Two on one topic of one type are mixed there, as in Gazebo, which is reported. Range finders
    may be, each message has its frame; cameras that are alike may share what says how they see.
    """
    owners: dict[str, tuple[str, WorldSensor]] = {}
    sound: list[WorldSensor] = []
    for tag, sensor in sensors:
        own = {sensor.mount.full_name(name, ''): kind for name, kind in sensor.topics}
        shared = [topic for topic in own if topic in owners]
        if shared:
            kind, other = owners[shared[0]]
            found = f'{quote_all(shared)}, as {quote(other.mount.name)} on line {other.mount.line}'
            fix = 'give each a <topic> of its own'
            if any(owners[topic][0] != own[topic] for topic in shared):
                tag.error(f'it has a topic of another type, {kind}', found=found, fix=fix)
                continue
            if kind != RANGE and not _see_alike(sensor, other):
                mixed = 'both are on it'
                tag.warning(
                    'it has the topic of another sensor', found=found, taken=mixed, fix=fix
                )
        owners = {topic: (kind, sensor) for topic, kind in own.items()} | owners
        sound.append(sensor)
    return sound


def _see_alike(one: WorldSensor, other: WorldSensor) -> bool:
    """Return whether the same ``camera_info`` holds for two cameras with other pictures."""
    if not (isinstance(one, Camera) and isinstance(other, Camera)):
        return False
    info = {other.camera_info_topic, other.depth_camera_info_topic}
    shared = {name for name, _ in one.topics} & {name for name, _ in other.topics}
    lenses = {
        (each.width, each.height, each.horizontal_fov, each.intrinsics, each.distortion)
        for each in (one, other)
    }
    return shared <= info and len(lenses) == 1 and one.mount.frame == other.mount.frame


def _lidar(tag: SensorTag) -> Lidar:
    unnamed = [
        each
        for each in tag.element.getroottree().iterfind('gazebo/sensor')
        if _READERS.get(each.get('type', '')) is _lidar
        and not gz_sensor_topic(each)
        and _classic_plugin(each) is None
    ]
    default = 'scan' if len(unnamed) < 2 else f'{topic_part(tag.name)}/scan'
    topic = _topic(tag, default)
    lidar = lidar_of(tag, tag.mount(tag.frame(*_FRAMES) or tag.link))
    return replace(lidar, scan_topic=topic, points_topic=f'{topic}/points')


def _camera(tag: SensorTag) -> Camera:
    topic = _topic(tag, f'{topic_part(tag.name)}/image')
    return replace(_any_camera(tag), image_topic=topic, camera_info_topic=_beside(tag, topic))


def _depth_camera(tag: SensorTag) -> Camera:
    topic = _topic(tag, f'{topic_part(tag.name)}/depth_image')
    return replace(
        _any_camera(tag, has_colour=False),
        depth_topic=topic,
        depth_camera_info_topic=_beside(tag, topic),
        points_topic=f'{topic}/points',
    )


def _rgbd_camera(tag: SensorTag) -> Camera:
    topic = _topic(tag, topic_part(tag.name))
    return replace(
        _any_camera(tag),
        image_topic=f'{topic}/image',
        camera_info_topic=_info_topic(tag) or f'{topic}/camera_info',
        depth_topic=f'{topic}/depth_image',
        points_topic=f'{topic}/points',
    )


def _any_camera(tag: SensorTag, *, has_colour: bool = True) -> Camera:
    """Return a camera without topics; ``<optical_frame_id>`` counts before other frames."""
    frame = tag.frame('camera/optical_frame_id', *_FRAMES)
    mount = tag.mount(frame or tag.optical_frame(), 'camera')
    return camera_of(tag, mount, has_colour=has_colour)


def _contact(tag: SensorTag) -> ContactSensor:
    contact = tag.element.find('contact')
    default = gz_sensor_topic(contact) if contact is not None else ''
    topic = _topic(tag, default or f'{topic_part(tag.name)}/contact')
    mount = tag.mount(tag.frame(*_FRAMES) or tag.link)
    return ContactSensor(mount, tag.collisions(), topic)


def _sonar(tag: SensorTag) -> Lidar:
    """Return the rays in the square about the cone of ``<sonar>``, whose nearest one counts."""
    topic = _topic(tag, f'{topic_part(tag.name)}/range')
    mount = tag.mount(tag.frame(*_FRAMES) or tag.link)
    least, most, _ = tag.range('sonar')
    half = math.atan2(tag.number('sonar/radius', 0.5, 0.0), most)
    axis = ScanAxis(_SONAR_RAYS, -half, half)
    return Lidar(
        mount, axis, axis, least, most, scan_topic='', range_topic=topic, radiation_type=0
    )


def _topic(tag: SensorTag, default: str) -> str:
    return tag.topic(gz_sensor_topic(tag.element) or default)


def _info_topic(tag: SensorTag) -> str:
    return tag.topic(tag.text('camera/camera_info_topic').strip('/'))


def _beside(tag: SensorTag, topic: str) -> str:
    """Return the topic of a camera's information: beside its pictures, if the tag names none."""
    folder, slash, _ = topic.rpartition('/')
    return _info_topic(tag) or f'{folder}{slash}camera_info'


_READERS: Mapping[str, Callable[[SensorTag], WorldSensor]] = {
    **dict.fromkeys(('gpu_lidar', 'lidar', 'gpu_ray', 'ray'), _lidar),
    'camera': _camera,
    **dict.fromkeys(('depth_camera', 'depth'), _depth_camera),
    **dict.fromkeys(('rgbd_camera', 'rgbd'), _rgbd_camera),
    'contact': _contact,
    'sonar': _sonar,
}
"""Type of a sensor → what reads its tag."""
