# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the plugins of Gazebo Classic in ``<sensor>`` tags publish, of ROS 2 and of ROS 1.

================================== ================================================================
``libgazebo_ros_….so``             topics, before ``<remapping>`` rules or elements that name them
================================== ================================================================
``ray_sensor``                     ``~/out``, of ``<output_type>``
``laser``, ``gpu_laser`` (ROS 1)   ``<topicName>``, else ``scan``
``block_laser`` (ROS 1)            ``<topicName>``, else ``points``
``range`` (ROS 1)                  ``<topicName>``, else ``range``
``velodyne_laser``, ``…_gpu_…``    ``~/out``; ROS 1: ``<topicName>``, else ``velodyne_points``
``camera``                         ``NAME/image_raw``, ``NAME/camera_info``; of ``type="depth"``
                                   also ``NAME/depth/image_raw``, ``NAME/depth/camera_info`` and
                                   ``NAME/points``; NAME is ``<camera_name>``, else the sensor's
``camera``, ``multicamera``        of ``type="multicamera"`` ``NAME/CAMERA/image_raw`` and
                                   ``…/camera_info``, CAMERA is the name of a ``<camera>``
``depth_camera``,                  as ``camera`` with ``type="depth"``; the latter's pictures are
``openni_kinect`` (ROS 1)          ``NAME/ir/image_raw`` if no element names them
``bumper``                         ``bumper_states``
================================== ================================================================

The frame is ``<frame_name>``, else the link that the sensor is on, for a bumper ``world``. Where
ROS 1 took ``/world`` for others the link is taken, too.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
import math
from typing import TypeAlias

from amr_description.model.gazebo.builder import node_name
from amr_description.model.gazebo.plugins import PluginElement
from amr_description.model.gazebo.sensor_tags import (
    camera_of,
    lidar_of,
    SensorTag,
    topic_part,
)
from amr_description.model.gazebo.tags import Noise
from amr_description.model.robot import WORLD_LINK
from amr_description.model.sensors import Camera, ContactSensor, Lidar, SensorMount, WorldSensor
from amr_description.text import quote

Read: TypeAlias = Callable[[SensorTag, PluginElement], list[WorldSensor]]

_LIDARS = ('gpu_lidar', 'gpu_ray', 'lidar', 'ray')
_CAMERAS = ('camera', 'depth', 'depth_camera', 'multicamera')
_SCAN, _CLOUD, _OLD_CLOUD, _RANGE = 'LaserScan', 'PointCloud2', 'PointCloud', 'Range'
_OUTPUTS = (_SCAN, _CLOUD, _OLD_CLOUD, _RANGE)
_ULTRASOUND, _INFRARED = 0, 1
_OF_ROS1 = (
    'cameraName',
    'imageTopicName',
    'cameraInfoTopicName',
    'depthImageTopicName',
    'pointCloudTopicName',
)
_NEAREST_DEPTH = 0.4
"""m: the default of ``<min_depth>``."""
_FARTHEST_DEPTH_OF_ROS1 = 5.0


def read_classic(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor] | None:
    """
    Return what a sensor's plugin publishes; None: it is not simulated.

    What cannot be read of the plugin is reported as what is wrong with the sensor.
    """
    kind = plugin.kind.removeprefix('gazebo-ros-')
    types, read = _READERS.get(kind, ((), None))
    if read is None:
        return None
    if tag.type not in types:
        tag.error(
            f'plugin {quote(plugin.library)} does not work in it',
            found=f'type {quote(tag.type)}',
            expected=f'one of {", ".join(types)}',
        )
        return []
    sensors = read(tag, plugin)
    for note in dict.fromkeys(plugin.notes):
        tag.warning(note)
    return sensors


def _mount(
    tag: SensorTag, plugin: PluginElement, inside: str = '', default: str = ''
) -> SensorMount:
    """
    Return where a sensor is, with the frame of its messages.

    Args:
        tag: of the sensor.
        plugin: that publishes what it measures.
        inside: an element with a pose of its own.
        default: a frame that is no link and is none the less right; '': the link.
    """
    frame = plugin.text('frame_name', 'frameName').lstrip('/') or default or tag.link
    if frame != default and not tag.is_link(frame):
        tag.warn_of_frame('frame_name', frame, plugin.element)
    mount = tag.mount(frame, inside)
    limit = _number(tag, plugin, 'update_rate', 'updateRate')
    slowest = min(filter(None, (limit, mount.rate)), default=0.0)
    return replace(mount, namespace=plugin.namespace, rate=slowest)


def _number(tag: SensorTag, plugin: PluginElement, *names: str, default: float = 0.0) -> float:
    """Return a number from 0 on of a plugin, or report it and return the default."""
    value = plugin.number(*names, default=default)
    if value >= 0.0:
        return value
    tag.error(
        f'<{names[0]}> of its plugin',
        plugin.element,
        found=quote(plugin.text(*names)),
        expected='a number from 0 on',
    )
    return default


def _topic(
    tag: SensorTag, plugin: PluginElement, base: str, *names: str, default: str = ''
) -> str:
    """
    Return a topic, relative to the namespace.

    Args:
        tag: of the sensor.
        plugin: that publishes it.
        base: as a plugin of ROS 2 calls it; rules are for this name.
        names: elements of ROS 1 that name it.
        default: if nothing names it; '': the base.
    """
    topic = plugin.topic(base, *names)
    if topic == base and default:
        topic = default
    if topic.startswith('~'):
        node = node_name(plugin.name, topic_part(tag.name))
        topic = f'{node}{topic[1:]}'
    return tag.topic(topic)


def _rays(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    written = plugin.text('output_type', 'outputType')
    output = written.rpartition('/')[2] or _CLOUD
    if output not in _OUTPUTS:
        tag.error(
            '<output_type>',
            found=quote(written),
            expected=', '.join(f'sensor_msgs/{each}' for each in _OUTPUTS),
        )
        return []
    is_sound = plugin.text('radiation_type', 'radiationType').lower() == 'ultrasound'
    topic = _topic(tag, plugin, '~/out', 'topicName')
    lidar = lidar_of(tag, _mount(tag, plugin))
    return [_published(tag, lidar, output, topic, _ULTRASOUND if is_sound else _INFRARED)]


def _published(
    tag: SensorTag, lidar: Lidar, output: str, topic: str, radiation: int = _INFRARED
) -> Lidar:
    """Return a lidar that publishes one kind of message."""
    if output == _SCAN:
        return replace(lidar, scan_topic=topic)
    if output == _RANGE:
        return replace(lidar, range_topic=topic, radiation_type=radiation)
    if output == _OLD_CLOUD:
        tag.warning(
            'sensor_msgs/PointCloud is not published, which ROS has given up',
            taken=f'{quote(topic)} has sensor_msgs/msg/PointCloud2',
        )
    return replace(lidar, points_topic=topic)


def _laser(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    topic = _topic(tag, plugin, 'scan', 'topicName')
    return [_published(tag, lidar_of(tag, _mount(tag, plugin)), _SCAN, topic)]


def _block_laser(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    topic = _topic(tag, plugin, 'points', 'topicName')
    return [_published(tag, lidar_of(tag, _mount(tag, plugin)), _OLD_CLOUD, topic)]


def _range(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    topic = _topic(tag, plugin, 'range', 'topicName')
    lidar = _noisy(tag, plugin, 'gaussianNoise')
    is_sound = plugin.text('radiation', default='ultrasound').lower() == 'ultrasound'
    return [_published(tag, lidar, _RANGE, topic, _ULTRASOUND if is_sound else _INFRARED)]


def _velodyne(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    default = '' if plugin.element.find('ros') is not None else 'velodyne_points'
    topic = _topic(tag, plugin, '~/out', 'topicName', default=default)
    lidar = _noisy(tag, plugin, 'gaussian_noise', 'gaussianNoise')
    least = max(lidar.range_min, _number(tag, plugin, 'min_range'))
    most = min(lidar.range_max, _number(tag, plugin, 'max_range', default=math.inf))
    if least >= most and not tag.is_faulty:
        tag.error(
            '<min_range> and <max_range> of its plugin leave no range',
            found=f'{least:g} m to {most:g} m, with <range>',
        )
    return [_published(tag, replace(lidar, range_min=least, range_max=most), _CLOUD, topic)]


def _noisy(tag: SensorTag, plugin: PluginElement, *names: str) -> Lidar:
    """Return a lidar with the noise of its plugin, where the sensor has none."""
    lidar = lidar_of(tag, _mount(tag, plugin))
    deviation = _number(tag, plugin, *names)
    if deviation > 0.0 and not lidar.noise.stddev:
        return replace(lidar, noise=Noise(stddev=deviation))
    return lidar


def _camera(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    if tag.type == 'multicamera':
        return _cameras(tag, plugin)
    camera = _with_baseline(camera_of(tag, _mount(tag, plugin, 'camera')), plugin)
    folder = _folder(tag, plugin)
    camera = replace(
        camera,
        image_topic=_image_topic(tag, plugin, folder, 'image_raw', 'imageTopicName'),
        camera_info_topic=_image_topic(tag, plugin, folder, 'camera_info', 'cameraInfoTopicName'),
    )
    is_deep = tag.type in ('depth', 'depth_camera')
    return [_with_depth(tag, plugin, camera, folder) if is_deep else camera]


def _depth_camera(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    """ROS 1's own plugins for depth, which take a sensor of any type of camera."""
    ir = 'ir/' if plugin.kind.endswith('openni-kinect') else ''
    camera = _with_baseline(camera_of(tag, _mount(tag, plugin, 'camera')), plugin)
    folder = _folder(tag, plugin)
    image = _image_topic(tag, plugin, folder, f'{ir}image_raw', 'imageTopicName')
    info = _image_topic(tag, plugin, folder, f'{ir}camera_info', 'cameraInfoTopicName')
    camera = replace(camera, image_topic=image, camera_info_topic=info)
    return [_with_depth(tag, plugin, camera, folder)]


def _with_depth(tag: SensorTag, plugin: PluginElement, camera: Camera, folder: str) -> Camera:
    farthest = _FARTHEST_DEPTH_OF_ROS1 if _is_of_ros1(plugin) else math.inf
    near = _number(tag, plugin, 'min_depth', 'pointCloudCutoff', default=_NEAREST_DEPTH)
    far = _number(tag, plugin, 'max_depth', 'pointCloudCutoffMax', default=farthest)
    near, far = max(near, camera.near), min(far, camera.far)
    if near >= far and not tag.is_faulty:
        tag.error(
            '<min_depth> and <max_depth> of its plugin leave no depth',
            found=f'{near:g} m to {far:g} m, with <clip>',
        )
    return replace(
        camera,
        depth_near=near,
        depth_far=far,
        depth_topic=_image_topic(tag, plugin, folder, 'depth/image_raw', 'depthImageTopicName'),
        depth_camera_info_topic=_image_topic(
            tag, plugin, folder, 'depth/camera_info', 'depthImageCameraInfoTopicName'
        ),
        points_topic=_image_topic(tag, plugin, folder, 'points', 'pointCloudTopicName'),
    )


def _cameras(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    """Several cameras in one sensor, such as a stereo pair: the right one has a baseline."""
    found: list[WorldSensor] = []
    elements = tag.element.findall('camera')
    if not elements:
        tag.error('it has no <camera>', fix='write one <camera name="left"> for each')
    for number, element in enumerate(elements, 1):
        inside = f'camera[{number}]'
        mount = _mount(tag, plugin, inside)
        name = element.get('name', '').strip() or f'camera_{number}'
        camera = camera_of(tag, replace(mount, name=f'{tag.name}/{name}'), inside)
        folder = f'{_folder(tag, plugin)}/{topic_part(name)}'.lstrip('/')
        found.append(
            replace(
                _with_baseline(camera, plugin) if 'right' in name else camera,
                image_topic=_image_topic(tag, plugin, folder, 'image_raw', 'imageTopicName'),
                camera_info_topic=_image_topic(
                    tag, plugin, folder, 'camera_info', 'cameraInfoTopicName'
                ),
            )
        )
    return found


def _is_of_ros1(plugin: PluginElement) -> bool:
    return bool(plugin.texts(*_OF_ROS1))


def _folder(tag: SensorTag, plugin: PluginElement) -> str:
    """Return what the topics of a camera begin with; '' for nothing."""
    named = plugin.text('camera_name', 'cameraName').rstrip('/')
    return named or ('' if _is_of_ros1(plugin) else topic_part(tag.name))


def _image_topic(tag: SensorTag, plugin: PluginElement, folder: str, base: str, name: str) -> str:
    """Return a topic of a camera; ``name`` is the element of ROS 1 that names it."""
    given = plugin.text(name) or base
    whole = given if given.startswith('/') or not folder else f'{folder}/{given}'
    return _topic(tag, plugin, whole)


def _with_baseline(camera: Camera, plugin: PluginElement) -> Camera:
    baseline = plugin.number('hack_baseline', 'hackBaseline', default=0.0)
    return replace(camera, baseline=baseline if math.isfinite(baseline) else 0.0)


def _bumper(tag: SensorTag, plugin: PluginElement) -> list[WorldSensor]:
    mount = _mount(tag, plugin, default=WORLD_LINK)
    topic = _topic(tag, plugin, 'bumper_states', 'bumperTopicName')
    return [ContactSensor(mount, tag.collisions(), topic, 'gazebo_msgs/msg/ContactsState')]


_READERS: Mapping[str, tuple[tuple[str, ...], Read]] = {
    'ray-sensor': (_LIDARS, _rays),
    'laser': (_LIDARS, _laser),
    'gpu-laser': (_LIDARS, _laser),
    'block-laser': (_LIDARS, _block_laser),
    'range': (_LIDARS, _range),
    'velodyne-laser': (_LIDARS, _velodyne),
    'velodyne-gpu-laser': (_LIDARS, _velodyne),
    'camera': (_CAMERAS, _camera),
    'multicamera': (('multicamera',), _camera),
    'depth-camera': (_CAMERAS[:3], _depth_camera),
    'openni-kinect': (_CAMERAS[:3], _depth_camera),
    'bumper': (('contact',), _bumper),
}
"""Kind of a plugin → the types of sensors that it works in, and what reads it."""
