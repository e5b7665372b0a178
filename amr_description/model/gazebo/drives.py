# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What Gazebo's plugins that move a robot, or say where it is, become: :data:`DRIVES`.
"""

from collections.abc import Callable, Mapping
import math
from typing import Any

from amr_description.model.gazebo.builder import Builder, gz_topic, node_name, origin_of
from amr_description.model.gazebo.plugins import PluginElement, PluginTag
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import Robot
from amr_description.model.wheels import find_wheels
from amr_description.text import quote, quote_all

_ACKERMANN = 'amr_description/GazeboAckermannDrive'
MECANUM = 'amr_description/GazeboMecanumDrive'
CORNERS = ('front_left', 'front_right', 'rear_right', 'rear_left')
"""Its wheels, as the parameters of its controller name them."""
_DRIVE = 'amr_description/GazeboDiffDrive'
_MOVE = 'amr_description/GazeboPlanarMove'
_DRIVES = (_ACKERMANN, _DRIVE, MECANUM)
"""They publish the transform from odom to base."""
_NO_TAGS: Mapping[str, PluginTag] = {}
_ODOMETRY = 'amr_description/GazeboOdometryPublisher'
_UNKNOWN_VARIANCE = 1e12
_WORLD_FRAMES = ('', 'world', '/world', 'map', '/map')


def _diff_drive(builder: Builder, plugin: PluginElement) -> None:
    left, right = _wheel_names(plugin)
    if len(left) != len(right):
        plugin.fail(f'{len(left)} joints are on the left and {len(right)} on the right')
        return
    if not builder.can_drive(plugin, left + right):
        return
    classic = plugin.is_classic
    apart = 0.34 if classic else 1.0
    separations = plugin.sizes('wheel_separation', 'wheelSeparation', default=apart)
    if classic:
        radii = plugin.sizes('wheel_diameter', 'wheelDiameter', default=0.075, per=2.0)
    else:
        radii = plugin.sizes('wheel_radius', default=0.2)
    if not separations or not radii:
        return
    for what, values in (('separations', separations), ('radii', radii)):
        if any(value != values[0] for value in values):
            plugin.note(f'its pairs of wheels have different {what}; that of the first counts')
    torque = math.inf
    if classic:
        torque = plugin.number('max_wheel_torque', 'wheelTorque', 'torque', default=5.0)
    builder.command(left + right, 'velocity', torque=torque)
    parameters: dict[str, Any] = {
        'left_wheel_names': left,
        'right_wheel_names': right,
        'wheel_separation': separations[0],
        'wheel_radius': radii[0],
    }
    name = 'gazebo_diff_drive'
    radius = ('wheel_diameter', 'wheelDiameter') if classic else ('wheel_radius',)
    tags = {
        'wheel_separation': plugin.tag('wheel_separation', 'wheelSeparation'),
        'wheel_radius': plugin.tag(*radius, per=2.0 if classic else 1.0),
    }
    if classic:
        acceleration = plugin.number('max_wheel_acceleration', 'wheelAcceleration', default=0.0)
        if acceleration > 0.0:
            parameters['max_wheel_acceleration'] = acceleration
        _classic_drive(builder, plugin, parameters, _DRIVE, name, tags)
    else:
        parameters |= _limits(plugin, ('linear.x', 'angular.z'))
        _gz_drive(builder, plugin, parameters, _DRIVE, 'diff_drive', tags)


def _wheel_names(plugin: PluginElement) -> tuple[list[str], list[str]]:
    left = plugin.texts('left_joint', 'leftJoint')
    right = plugin.texts('right_joint', 'rightJoint')
    if not left:
        left = plugin.texts('leftFrontJoint') + plugin.texts('leftRearJoint')
        right = plugin.texts('rightFrontJoint') + plugin.texts('rightRearJoint')
    return left, right


def _mecanum(builder: Builder, plugin: PluginElement) -> None:
    """New Gazebo's drive of four mecanum wheels; Classic's is planar move."""
    corners = ('front_left', 'front_right', 'back_right', 'back_left')
    names = tuple(zip(CORNERS, corners, strict=True))  # of controllers, and of Gazebo
    joints = [plugin.texts(f'{corner}_joint') for corner in corners]
    wheels = [names[0] for names in joints if names]
    if len(wheels) < len(corners):
        plugin.fail('it does not name four wheels')
        return
    if any(len(names) > 1 for names in joints):
        plugin.note('the first wheel of each corner is driven, the others roll freely')
    if not builder.can_drive(plugin, wheels):
        return
    separations = plugin.sizes('wheel_separation', default=1.0)
    bases = plugin.sizes('wheelbase', default=1.0)
    radii = plugin.sizes('wheel_radius', default=0.2)
    if not (separations and bases and radii):
        return
    builder.command(wheels, 'velocity')
    parameters: dict[str, Any] = {
        **{f'{n}_wheel_command_joint_name': j for n, j in zip(CORNERS, wheels, strict=True)},
        'kinematics.wheels_radius': radii[0],
        'kinematics.sum_of_robot_center_projection_on_X_Y_axis': 0.5 * (separations[0] + bases[0]),
        **_limits(plugin, ('linear.x', 'linear.y', 'angular.z')),
    }
    tags = {
        'kinematics.wheels_radius': plugin.tag('wheel_radius'),
        'kinematics.sum_of_robot_center_projection_on_X_Y_axis': plugin.tag(
            'wheel_separation', per=2.0, also='wheelbase'
        ),
        **{f'{n}_wheel_command_joint_name': plugin.tag(f'{c}_joint') for n, c in names},
    }
    _gz_drive(builder, plugin, parameters, MECANUM, 'mecanum_drive', tags)


def _ackermann(builder: Builder, plugin: PluginElement) -> None:
    """New Gazebo's car."""
    steering = [plugin.text('right_steering_joint'), plugin.text('left_steering_joint')]
    sides = [plugin.texts('right_joint'), plugin.texts('left_joint')]
    traction = [_unsteered(builder.robot, side, steering) for side in sides]
    if not all(traction) or not all(steering):
        plugin.fail('it does not name driven and steered joints of both sides')
        return
    if any(len(side) > 1 for side in sides):
        plugin.note(f'{quote_all(traction)} are driven; its other wheels roll freely')
    given = {
        'wheelbase': plugin.sizes('wheel_base', default=1.0),
        'traction_track_width': plugin.sizes('wheel_separation', default=1.0),
        'steering_track_width': plugin.sizes('kingpin_width', default=0.8),
        'traction_wheels_radius': plugin.sizes('wheel_radius', default=0.2),
    }
    if not all(given.values()):
        return
    sizes = {name: values[0] for name, values in given.items()}
    if _can_steer(builder, plugin, traction, steering, sizes):
        parameters = _car(traction, steering, sizes)
        tags = {
            'wheelbase': plugin.tag('wheel_base'),
            'traction_track_width': plugin.tag('wheel_separation'),
            'steering_track_width': plugin.tag('kingpin_width'),
            'traction_wheels_radius': plugin.tag('wheel_radius'),
            'traction_joints_names': plugin.tag('left_joint'),
            'steering_joints_names': plugin.tag('left_steering_joint'),
        }
        _gz_drive(builder, plugin, parameters, _ACKERMANN, 'ackermann_steering', tags)


def _classic_ackermann(builder: Builder, plugin: PluginElement) -> None:
    """Classic's car, which measures the model instead of being told its sizes; a vendor's, too."""
    robot = builder.robot
    is_of_vendor = plugin.kind != 'gazebo-ros-ackermann-drive'
    sides = ('right', 'left')
    rear = [plugin.text(f'rear_{side}_joint', f'{side}RearJoint') for side in sides]
    front = [plugin.text(f'front_{side}_joint', f'{side}FrontJoint') for side in sides]
    steering = [plugin.text(f'{side}_steering_joint', f'{side}HingeJoint') for side in sides]
    if is_of_vendor and not any(steering):
        steering = [_joint_above(robot, wheel) for wheel in front]
    lacking = [name for name in (*rear, *front, *steering) if not robot.has_joint(name)]
    if lacking:
        plugin.fail(f'there is no joint {quote_all(lacking)}')
        return
    poses = link_poses(robot, {})
    places = [poses[robot.joint(name).child].translation for name in (*rear, *front)]
    (x, right, _), (_, left, _), (ahead, front_right, _), (_, front_left, _) = places
    radii = [wheel.radius for wheel in find_wheels(robot, rear)]
    if not radii and is_of_vendor:
        radii = plugin.sizes('wheelDiameter', default=0.15, per=2.0)
    radii = radii or plugin.sizes('wheel_radius', default=0.0)
    if not radii:
        return
    sizes = {
        'wheelbase': abs(ahead - x),
        'traction_track_width': abs(left - right),
        'steering_track_width': abs(front_left - front_right),
        'traction_wheels_radius': radii[0],
    }
    if not _can_steer(builder, plugin, rear, steering, sizes):
        return
    parameters = _car(rear, steering, sizes)
    parameters |= {
        'angular_is_steering': not is_of_vendor,
        'max_steer': plugin.number('max_steer', default=0.6),
    }
    _classic_drive(builder, plugin, parameters, _ACKERMANN, 'gazebo_ackermann_drive')


def _joint_above(robot: Robot, name: str) -> str:
    """Return the joint that the link of a wheel's joint hangs on, which steers it; '': none."""
    parent = robot.joint(name).parent if robot.has_joint(name) else ''
    return next((each.name for each in robot.joints if each.child == parent), '')


def _unsteered(robot: Robot, wheels: list[str], steering: list[str]) -> str:
    """Return the wheel of a side that is not steered, else the first one; '' for none."""
    steered = [robot.joint(name).child for name in steering if robot.has_joint(name)]
    fixed = (
        name
        for name in wheels
        if robot.has_joint(name) and robot.joint(name).parent not in steered
    )
    return next(fixed, wheels[0] if wheels else '')


def _can_steer(
    builder: Builder,
    plugin: PluginElement,
    traction: list[str],
    steering: list[str],
    sizes: Mapping[str, float],
) -> bool:
    """Have the joints of a car commanded; return False, and note it, if they cannot be."""
    if not (
        builder.can_drive(plugin, traction) and builder.can_drive(plugin, steering, 'position')
    ):
        return False
    if not min(sizes.values()) > 0.0:
        plugin.fail('distances and size of the wheels must be above 0')
        return False
    builder.command(traction, 'velocity')
    builder.command(steering, 'position')
    return True


def _car(traction: list[str], steering: list[str], sizes: Mapping[str, float]) -> dict[str, Any]:
    return {'traction_joints_names': traction, 'steering_joints_names': steering, **sizes}


def _planar_move(builder: Builder, plugin: PluginElement) -> None:
    """The odometry of Classic's is the true pose in the world; new Gazebo's has none."""
    if not builder.move_base(plugin):
        return
    if not plugin.is_classic:
        topics = {'~/cmd_vel': gz_topic(plugin, 'topic', 'cmd_vel')}
        builder.add(_MOVE, {}, topics, name='velocity_control', origin=origin_of(plugin))
        return
    name = node_name(plugin.name, 'gazebo_planar_move')
    topics = {'~/cmd_vel': plugin.topic('cmd_vel', 'commandTopic')}
    builder.add(_MOVE, {}, topics, name=name, origin=origin_of(plugin), namespace=plugin.namespace)
    rate = plugin.number('publish_rate', 'odometryRate', default=20.0)
    publishes = plugin.flag('publish_odom', default=True)
    transforms = plugin.flag('publish_odom_tf', default=True)
    _classic_truth(builder, plugin, name, rate, publishes=publishes, transforms=transforms)


def _odometry_publisher(builder: Builder, plugin: PluginElement) -> None:
    """New Gazebo's: the true pose; on /tf only if no drive publishes it, or by its own wish."""
    drives = any(each.type in _DRIVES for each in builder.controllers)
    robot = builder.robot
    rate = plugin.number('odom_publish_frequency', default=50.0)
    transforms, frame = _gz_transform(plugin, default='' if drives else '/tf')
    builder.truth(robot.root.name)
    parameters: dict[str, Any] = {
        'link': robot.root.name,
        'odom_frame_id': plugin.text('odom_frame', default='odom'),
        'base_frame_id': plugin.text('robot_base_frame', default=_base(robot)),
        'publish_rate': rate if rate > 0.0 else 1000.0,
        'enable_odom_tf': transforms,
        'dimensions': 3 if plugin.number('dimensions', default=2.0) == 3.0 else 2,
        'offset.xyz': list(plugin.vector('xyz_offset')),
        'offset.rpy': list(plugin.vector('rpy_offset')),
    }
    _note_noise(plugin)
    has_odom = any('odom' in each.topics.values() for each in builder.controllers)
    topic = gz_topic(plugin, 'odom_topic', 'odometry' if has_odom else 'odom')
    topics = {'~/odom': topic, '/tf': frame}
    name = 'odometry_publisher'
    builder.add(_ODOMETRY, parameters, topics, name=name, origin=origin_of(plugin))


def _p3d(builder: Builder, plugin: PluginElement) -> None:
    """Classic's pose of a link in the world, as odometry; its twist is along the world's axes."""
    link = plugin.text('body_name', 'bodyName')
    if not builder.robot.has_link(link):
        links = quote_all([each.name for each in builder.robot.links])
        plugin.fail(f'there is no link {quote(link)}; there are: {links}')
        return
    frame = plugin.text('frame_name', 'frameName', default='world')
    if frame not in _WORLD_FRAMES and builder.robot.has_link(frame):
        plugin.note(f'the pose is that in the world, not in the link {quote(frame)}')
    rate = plugin.number('update_rate', 'updateRate', default=0.0)
    _note_noise(plugin)
    builder.truth(link)
    parameters: dict[str, Any] = {
        'link': link,
        'odom_frame_id': frame,
        'base_frame_id': link,
        'publish_rate': rate if rate > 0.0 else 1000.0,
        'enable_odom_tf': False,
        'dimensions': 3,
        'twist_in_world': True,
        'offset.in_world': True,
        'offset.xyz': list(plugin.vector('xyz_offset', 'xyz_offsets', 'xyzOffsets')),
        'offset.rpy': list(plugin.vector('rpy_offset', 'rpy_offsets', 'rpyOffsets')),
    }
    topics = {'~/odom': plugin.topic('odom', 'topicName'), '/tf': '/tf'}
    name = node_name(plugin.name, 'gazebo_p3d')
    builder.add(
        _ODOMETRY,
        parameters,
        topics,
        name=name,
        origin=origin_of(plugin),
        namespace=plugin.namespace,
    )


# --- what drives have in common ------------------------------------------------------------------


def _classic_drive(
    builder: Builder,
    plugin: PluginElement,
    parameters: dict[str, Any],
    kind: str,
    name: str,
    tags: Mapping[str, PluginTag] = _NO_TAGS,
) -> None:
    """Add a wheeled drive of Classic, with odometry from its wheels or from the world."""
    is_ros1 = bool(plugin.texts('leftJoint', 'leftFrontJoint', 'commandTopic'))
    name = node_name(plugin.name, name)
    publishes = plugin.flag('publish_odom', 'publishOdom', default=is_ros1)
    transforms = plugin.flag('publish_odom_tf', 'publishOdomTF', 'broadcastTF', default=is_ros1)
    rate = plugin.number('update_rate', 'updateRate' if is_ros1 else 'update_rate', default=100.0)
    rate = rate if rate > 0.0 else 1000.0
    source = plugin.text('odometry_source', 'odometrySource', default='1')
    from_wheels = source.lower() in ('0', 'encoder')
    parameters |= {
        'odom_frame_id': plugin.text('odometry_frame', 'odometryFrame', default='odom'),
        'base_frame_id': plugin.text(
            'robot_base_frame', 'robotBaseFrame', default='base_footprint'
        ),
        'publish_rate': rate,
        'publish_odom': publishes and from_wheels,
        'enable_odom_tf': transforms and from_wheels,
        **_classic_covariances(plugin),
    }
    topics = {'~/cmd_vel': plugin.topic('cmd_vel', 'commandTopic'), '/tf': '/tf'}
    if kind != _DRIVE:
        del parameters['publish_rate']
    if from_wheels:
        topics[_odometry_port(kind)] = plugin.topic('odom', 'odometryTopic')
    builder.add(
        kind,
        parameters,
        topics,
        name=name,
        origin=origin_of(plugin),
        namespace=plugin.namespace,
        line=plugin.line,
        tags=tags,
    )
    if not from_wheels:
        _classic_truth(builder, plugin, name, rate, publishes=publishes, transforms=transforms)


def _classic_truth(
    builder: Builder,
    plugin: PluginElement,
    drive: str,
    rate: float,
    *,
    publishes: bool,
    transforms: bool,
) -> None:
    """Add the odometry that Classic's drives take from the world."""
    if not publishes and not transforms:
        return
    root = builder.robot.root.name
    builder.truth(root)
    parameters: dict[str, Any] = {
        'link': root,
        'odom_frame_id': plugin.text('odometry_frame', 'odometryFrame', default='odom'),
        'base_frame_id': plugin.text(
            'robot_base_frame', 'robotBaseFrame', default='base_footprint'
        ),
        'publish_rate': rate if rate > 0.0 else 1000.0,
        'publish_odom': publishes,
        'enable_odom_tf': transforms,
        'dimensions': 3,
        **_classic_covariances(plugin),
    }
    topics = {'~/odom': plugin.topic('odom', 'odometryTopic'), '/tf': '/tf'}
    builder.add(
        _ODOMETRY,
        parameters,
        topics,
        name=f'{drive}_odometry',
        origin=origin_of(plugin),
        namespace=plugin.namespace,
    )


def _classic_covariances(plugin: PluginElement) -> dict[str, list[float]]:
    x, y = (plugin.number(f'covariance_{axis}', default=1e-5) for axis in 'xy')
    yaw = plugin.number('covariance_yaw', default=1e-3)
    diagonal = [x, y, _UNKNOWN_VARIANCE, _UNKNOWN_VARIANCE, _UNKNOWN_VARIANCE, yaw]
    return {'pose_covariance_diagonal': diagonal, 'twist_covariance_diagonal': diagonal}


def _gz_drive(
    builder: Builder,
    plugin: PluginElement,
    parameters: dict[str, Any],
    kind: str,
    name: str,
    tags: Mapping[str, PluginTag] = _NO_TAGS,
) -> None:
    """Add a wheeled drive of new Gazebo, with odometry from its wheels."""
    rate = plugin.number('odom_publish_frequency', default=50.0)
    transforms, frame = _gz_transform(plugin, default='/tf')
    parameters |= {
        'odom_frame_id': plugin.text('frame_id', default='odom'),
        'base_frame_id': plugin.text('child_frame_id', default=_base(builder.robot)),
        'publish_rate': rate if rate > 0.0 else 1000.0,
        'enable_odom_tf': transforms,
    }
    topics = {
        '~/cmd_vel': gz_topic(plugin, 'topic', 'cmd_vel'),
        _odometry_port(kind): gz_topic(plugin, 'odom_topic', 'odom'),
        '/tf': frame,
    }
    if kind != _DRIVE:
        del parameters['publish_rate']
    builder.add(
        kind,
        parameters,
        topics,
        name=name,
        origin=origin_of(plugin),
        line=plugin.line,
        tags=tags,
    )


def _odometry_port(kind: str) -> str:
    """Return what a drive calls the topic of its odometry."""
    return '~/odom' if kind == _DRIVE else '~/odometry'


def _gz_transform(plugin: PluginElement, default: str) -> tuple[bool, str]:
    """Return whether and where the transform is published: /tf, or a topic that is not bridged."""
    given = plugin.text('tf_topic')
    if not given:
        return bool(default), default or '/tf'
    return True, '/tf' if given.rpartition('/')[2] in ('tf', 'pose') else given


def _limits(plugin: PluginElement, axes: tuple[str, ...]) -> dict[str, float]:
    """
    Return new Gazebo's limits as those of a rate limiter.

    Gazebo limits a change of speed to ``[min dt, max dt]``, whether the robot speeds up or brakes.
    """
    found: dict[str, float] = {}
    for axis in axes:
        kind = axis.partition('.')[0]
        for quantity, names in (
            ('velocity', (('max_velocity',), ('min_velocity',))),
            (
                'acceleration',
                (
                    ('max_acceleration', 'max_deceleration_reverse'),
                    ('max_deceleration', 'max_acceleration_reverse'),
                ),
            ),
            ('jerk', (('max_jerk',), ('min_jerk',))),
        ):
            for bound, targets in zip(('max', 'min'), names, strict=True):
                value = plugin.number(
                    f'{bound}_{kind}_{quantity}', f'{bound}_{quantity}', default=math.nan
                )
                has_sign = value >= 0.0 if bound == 'max' else value <= 0.0
                if math.isfinite(value) and has_sign:
                    found |= {f'{axis}.{target}': value for target in targets}
    return found


def _note_noise(plugin: PluginElement) -> None:
    if plugin.number('gaussian_noise', 'gaussianNoise', default=0.0) != 0.0:
        plugin.note('its odometry is the truth, without <gaussian_noise>')


def _base(robot: Robot) -> str:
    return robot.root.name


DRIVES: Mapping[str, Callable[[Builder, PluginElement], None]] = {
    'ackermann-steering': _ackermann,
    'diff-drive': _diff_drive,
    'gazebo-ros-ackerman': _classic_ackermann,
    'gazebo-ros-ackerman-drive': _classic_ackermann,
    'gazebo-ros-ackermann-drive': _classic_ackermann,
    'gazebo-ros-diff-drive': _diff_drive,
    'gazebo-ros-skid-steer-drive': _diff_drive,
    'gazebo-ros-force-based-move': _planar_move,
    'gazebo-ros-planar-move': _planar_move,
    'mecanum-drive': _mecanum,
    'velocity-control': _planar_move,
    'odometry-publisher': _odometry_publisher,
    'gazebo-ros-p3d': _p3d,
}
"""Kind of a plugin → what adds its controllers."""

FIRST = ('ackermann-steering', 'diff-drive', 'mecanum-drive', 'velocity-control')
"""Kinds that are translated before others, which look whether there is a drive."""
