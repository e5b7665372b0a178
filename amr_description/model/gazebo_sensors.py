# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Lidars, cameras and contact sensors from the ``<sensor>`` tags of ``<gazebo>`` blocks.

New Gazebo's sensors publish on ``<topic>`` by themselves, those of Classic by the plugin in their
tag. Here each has the topics that it has in ROS: new Gazebo's as they are usually bridged,
``<topic>`` without a leading ``/model/NAME``.

================================ ==================================================================
type                             topics; without ``<topic>``
================================ ==================================================================
gpu_lidar, lidar, gpu_ray, ray   ``<topic>``, ``<topic>/points``; ``scan``
camera                           ``<topic>``, ``camera_info`` beside it; ``NAME/image``
depth_camera, depth              ``<topic>``, ``<topic>/points``, ``camera_info`` beside it;
                                 ``NAME/depth_image``
rgbd_camera, rgbd                ``<topic>/image``, ``/depth_image``, ``/points``,
                                 ``/camera_info``; ``NAME``
================================ ==================================================================

The frame of the messages is the one that the tag names, else the link that the sensor is on; of a
camera, the link below it that has ``optical`` in its name (REP 103). Gazebo would take
``MODEL/LINK/SENSOR``, which is in no tree of transforms.
"""

from collections.abc import Callable, Iterable, Mapping
import re

from lxml import etree

from amr_description.model.findings import Finding
from amr_description.model.gazebo_builder import gz_topic
from amr_description.model.gazebo_plugins import PluginElement, sensors_of
from amr_description.model.gazebo_sensor_tags import SensorTag, tags_of
from amr_description.model.kinematics import link_poses
from amr_description.model.origins import raise_error_of, relocated
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import read_hardware
from amr_description.model.sensors import (
    Camera,
    Lidar,
    NO_NOISE,
    RobotSensors,
    ScanAxis,
    SensorMount,
    WorldSensor,
)
from amr_description.model.xml_reader import parse_xml

_FRAMES = ('gz_frame_id', 'ignition_frame_id', 'frame_id')
"""New Gazebo's names of the frame, the newest first; SDF's last."""
_DEFAULT_TOPIC = '__default_topic__'


def robot_sensors_of(robot: Robot) -> RobotSensors:
    """
    Return the sensors of a robot that look at the world.

    Those that ``<ros2_control>`` has under the same name are its own. Raises DescriptionError: a
    ``<ros2_control>`` block is invalid.
    """
    report = raise_error_of(robot.text, strict=False)
    xml = parse_xml(robot.text, robot.source, report)
    if xml is None:
        return RobotSensors()
    hardware = read_hardware(xml, robot, report)
    return read_sensors(xml, robot, {each.name for info in hardware for each in info.sensors})


def read_sensors(
    xml: etree._Element, robot: Robot, controlled: Iterable[str] = ()
) -> RobotSensors:
    """
    Return the sensors below ``xml``.

    Args:
        xml: the root of the description.
        robot: the description.
        controlled: the sensors that are those of ``<ros2_control>``.
    """
    found = [each for each in sensors_of(xml) if each[0].get('name', '') not in controlled]
    poses = link_poses(robot) if found else {}
    sensors: list[WorldSensor] = []
    lacking: list[tuple[str, str]] = []
    findings: list[Finding] = []
    for tag in tags_of(found, robot, poses):
        read = _READERS.get(tag.type)
        if read is None or _classic_plugin(tag) is not None:
            lacking.append((tag.name, tag.type))
            continue
        if not robot.has_link(tag.link):
            continue
        sensor = read(tag)
        findings += tag.findings
        if not tag.is_faulty:
            sensors.append(sensor)
    notes = tuple(relocated(each, robot.text).as_taken().text for each in findings)
    return RobotSensors(tuple(sensors), notes, tuple(lacking))


def _classic_plugin(tag: SensorTag) -> PluginElement | None:
    """Return the plugin of Gazebo Classic that publishes what a sensor measures."""
    plugins = (PluginElement(each) for each in tag.element.iterchildren('plugin'))
    return next((each for each in plugins if each.is_classic), None)


def _lidar(tag: SensorTag) -> Lidar:
    inside = 'lidar' if tag.element.find('lidar') is not None else 'ray'
    topic = tag.topic(_gz_topic(tag, 'scan'))
    mount = _mount(tag, tag.frame(*_FRAMES) or tag.link)
    return lidar_of(tag, inside, mount, topic, f'{topic}/points')


def lidar_of(tag: SensorTag, inside: str, mount: SensorMount, scan: str, points: str) -> Lidar:
    """
    Return a lidar.

    Args:
        tag: of the sensor.
        inside: the element that describes the rays, ``lidar`` or ``ray``.
        mount: of the sensor.
        scan: topic of scans.
        points: topic of clouds.
    """
    horizontal = tag.axis(f'{inside}/scan/horizontal', 640)
    vertical = ScanAxis(1, 0.0, 0.0)
    if tag.element.find(f'{inside}/scan/vertical') is not None:
        vertical = tag.axis(f'{inside}/scan/vertical', 1)
    tag.rays_are_few(horizontal, vertical)
    least, most, resolution = tag.range(f'{inside}/range')
    noise = tag.noise(f'{inside}/noise')
    return Lidar(
        mount,
        horizontal,
        vertical,
        least,
        most,
        resolution,
        noise,
        scan_topic=scan,
        points_topic=points,
    )


def _camera(tag: SensorTag) -> Camera:
    topic = tag.topic(_gz_topic(tag, f'{_topic_of(tag.name)}/image'))
    return camera_of(tag, _camera_mount(tag), image=topic, info=_beside(tag, topic))


def _depth_camera(tag: SensorTag) -> Camera:
    topic = tag.topic(_gz_topic(tag, f'{_topic_of(tag.name)}/depth_image'))
    info = _beside(tag, topic)
    return camera_of(
        tag, _camera_mount(tag), depth=topic, depth_info=info, points=f'{topic}/points'
    )


def _rgbd_camera(tag: SensorTag) -> Camera:
    topic = tag.topic(_gz_topic(tag, _topic_of(tag.name)))
    return camera_of(
        tag,
        _camera_mount(tag),
        image=f'{topic}/image',
        info=_info_topic(tag) or f'{topic}/camera_info',
        depth=f'{topic}/depth_image',
        points=f'{topic}/points',
    )


def camera_of(
    tag: SensorTag,
    mount: SensorMount,
    *,
    image: str = '',
    info: str = '',
    depth: str = '',
    depth_info: str = '',
    points: str = '',
) -> Camera:
    """Return a camera by its ``<camera>`` element, with topics; '' is one that it has not."""
    width, height = tag.size('camera/image')
    near, far = tag.clip('camera/clip', 0.1, 100.0)
    depth_near, depth_far = near, far
    if tag.element.find('camera/depth_camera/clip') is not None:
        depth_near, depth_far = tag.clip('camera/depth_camera/clip', near, far)
    return Camera(
        mount,
        width,
        height,
        tag.field_of_view('camera/horizontal_fov'),
        near,
        far,
        depth_near,
        depth_far,
        tag.intrinsics('camera/lens/intrinsics'),
        tag.distortion('camera/distortion'),
        tag.noise('camera/noise') if tag.element.find('camera/noise') is not None else NO_NOISE,
        tag.encoding('camera/image/format') if image else 'rgb8',
        image_topic=image,
        camera_info_topic=info,
        depth_topic=depth,
        depth_camera_info_topic=depth_info,
        points_topic=points,
        points_are_optical=tag.is_optical(mount.frame, mount.pose),
    )


def _mount(tag: SensorTag, frame: str) -> SensorMount:
    return SensorMount(tag.name, tag.link, tag.pose(), frame, tag.rate(), line=tag.line)


def _camera_mount(tag: SensorTag) -> SensorMount:
    """Return the mount of a camera; ``<optical_frame_id>`` counts before the other names."""
    frame = tag.frame('camera/optical_frame_id', *_FRAMES)
    return _mount(tag, frame or tag.optical_frame())


def _gz_topic(tag: SensorTag, default: str) -> str:
    topic = gz_topic(PluginElement(tag.element), 'topic', default)
    return default if topic.strip('/') == _DEFAULT_TOPIC else topic.rstrip('/')


def _info_topic(tag: SensorTag) -> str:
    return tag.topic(tag.text('camera/camera_info_topic'), 'camera/camera_info_topic')


def _beside(tag: SensorTag, topic: str) -> str:
    """Return the topic of a camera's information: beside its pictures, if the tag names none."""
    folder, slash, _ = topic.rpartition('/')
    return _info_topic(tag) or f'{folder}{slash}camera_info'


def _topic_of(name: str) -> str:
    """Return the name of a sensor as part of a topic."""
    word = re.sub(r'\W', '_', name, flags=re.ASCII)
    return f'_{word}' if word[:1].isdigit() or not word else word


_READERS: Mapping[str, Callable[[SensorTag], WorldSensor]] = {
    **dict.fromkeys(('gpu_lidar', 'lidar', 'gpu_ray', 'ray'), _lidar),
    'camera': _camera,
    **dict.fromkeys(('depth_camera', 'depth'), _depth_camera),
    **dict.fromkeys(('rgbd_camera', 'rgbd'), _rgbd_camera),
}
"""Type of a sensor → what reads its tag."""
