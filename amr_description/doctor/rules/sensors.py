# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the section ``sensors``."""

from collections import Counter
from collections.abc import Iterable, Iterator
import math
import shlex

from amr_description.clock import NANOSECONDS
from amr_description.doctor.findings import error, Finding, Rule, warning
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.sensors import (
    ObservedImage,
    ObservedJoints,
    ObservedScan,
    ObservedTravel,
)
from amr_description.doctor.observations.transforms import Tree
from amr_description.doctor.rules.wording import right_clock
from amr_description.navigation.contract.observations import ScanGeometry
from amr_description.text import closest_match

_BYTES = {
    'rgb8': 3,
    'bgr8': 3,
    'rgba8': 4,
    'bgra8': 4,
    'mono8': 1,
    '8UC1': 1,
    '8UC3': 3,
    '8UC4': 4,
    'mono16': 2,
    '16UC1': 2,
    '32FC1': 4,
    'rgb16': 6,
    'bgr16': 6,
    'yuv422': 2,
    'yuv422_yuy2': 2,
    'bayer_rggb8': 1,
    'bayer_bggr8': 1,
    'bayer_gbrg8': 1,
    'bayer_grbg8': 1,
}
"""Of a pixel, by the encodings of sensor_msgs/image_encodings.hpp."""

_OLDEST = {False: 2 * NANOSECONDS, True: 10 * NANOSECONDS}
"""ns from the stamp of a message to its reception, by whether time is simulated."""
_LEAST_WAY = 0.3
"""m that a robot has to go before its odometry is judged."""
_LEAST_TURN = 0.5
"""rad, of the same."""
_SHARE = 0.25
"""Of a way or a turn, that odometry may be wrong by."""
_NO_SIZE = (0, 0)
"""Of a camera_info without a calibration."""
_SHOWN = 4


def sensor_frame_missing(seen: Observations) -> Iterator[Finding]:
    """
    The frame of a sensor is known to tf2.

    Gazebo calls frames ``robot/link/sensor`` unless ``<gz_frame_id>`` is set; a driver has a
    parameter ``frame_id``. Or publish a static transform.
    """
    if seen.sensors is None or seen.transforms is None:
        return
    for each in seen.sensors.framed:
        tree = seen.transforms.tree_of(each.topic) or Tree()
        frame = each.frame.removeprefix('/')
        if frame in tree.frames or not tree.frames:
            continue
        meant = _meant(frame, tree)
        who = _names(each.publishers) or 'its publisher'
        yield error(
            'sensor_frame_missing',
            f"the messages on {each.topic}, of {who}, are in the frame '{frame}', which nobody "
            f'publishes on {tree.topic}'
            if frame
            else f'the messages on {each.topic}, of {who}, have no frame: header.frame_id is '
            'empty',
            'nothing can transform them: they are not drawn, and costmaps and SLAM drop them',
            f"set frame_id (in Gazebo: <gz_frame_id>) of {who} to '{meant}', or ros2 run tf2_ros "
            f'static_transform_publisher --frame-id {shlex.quote(meant)} --child-frame-id '
            f'{shlex.quote(frame)}'
            if meant
            else 'ros2 run tf2_ros static_transform_publisher --frame-id base_link '
            f'--child-frame-id {shlex.quote(frame or "laser")}',
        )


def sensor_stamp(seen: Observations) -> Iterator[Finding]:
    """
    The stamp of a message is the time of its measurement.

    It is more than 2 s (in a simulation 10 s) from the arrival: see tf_stale.
    """
    if seen.sensors is None:
        return
    is_simulated = seen.transforms is not None and seen.transforms.is_simulated
    sources = (*seen.sensors.framed, *seen.sensors.joints)
    for each in sources:
        if each.age is None or abs(each.age) <= _OLDEST[is_simulated]:
            continue
        who = _names(each.publishers) or 'its publisher'
        late = f'{abs(each.age) / NANOSECONDS:.1f} s'
        yield error(
            'sensor_stamp',
            f'the stamps on {each.topic}, of {who}, are {late} '
            f'{"old" if each.age > 0 else "of the future"} when they come',
            'no transform is known at such a time: "earlier than all the data in the transform '
            'cache", or "extrapolation into the future"',
            '; '.join(f'ros2 param set {name} use_sim_time true' for name in each.publishers[:2])
            + ', or restart it with -p use_sim_time:=true'
            if is_simulated
            else f'stamp with the time of the measurement; {right_clock(each.publishers)}',
        )


def scan_length(seen: Observations) -> Iterator[Finding]:
    """
    A scan has as many ranges as its angles say.

    slam_toolbox computes the number from the angles, and refuses others.
    """
    if not (scans := _scans(seen)):
        return
    from amr_description.navigation.contract.scan_length import expected_length  # with numpy

    for each in scans:
        geometry = ScanGeometry(
            each.angle_min, each.angle_max, each.angle_increment, 0.0, 0.0, each.count
        )
        expected = expected_length(geometry)
        if not each.messages or expected == each.count:
            continue
        lower, increment = each.angle_min, each.angle_increment
        upper = lower + increment * (each.count - 1)
        yield error(
            'scan_length',
            f'scans on {each.topic} have {each.count} ranges; '
            + (
                f'their angles, {each.angle_min:.4g} to {each.angle_max:.4g} rad by '
                f'{increment:.4g}, make {expected}'
                if expected is not None
                else f'their angle_increment is {increment:g}'
            ),
            'slam_toolbox refuses every scan: "LaserRangeScan contains … range readings, '
            'expected …"',
            f'set angle_max to {upper:.6g} in {_names(each.publishers)}: angle_min + '
            'angle_increment * (number of ranges - 1)',
        )


def scan_empty(seen: Observations) -> Iterator[Finding]:
    """
    A lidar sees something.

    All ranges are 0 or NaN, where one without a hit has ``inf`` (REP 117). It stands still or is
    covered; Gazebo's needs OpenGL.
    """
    for each in _scans(seen):
        if not each.count or each.hits:
            continue
        kinds = {'inf': each.infinite, '0': each.zeros, 'NaN': each.invalid}
        kind = max(kinds, key=lambda name: kinds[name])
        if kind == 'inf' or kinds[kind] < each.count:
            continue  # an empty world is like this
        yield warning(
            'scan_empty',
            f'all {each.count} ranges of the scans on {each.topic}, of '
            f'{_names(each.publishers)}, are {kind}',
            'nothing is seen: no map, no obstacles; by REP 117 a ray that meets nothing is inf',
            'see whether the lidar turns and its lens is free; in Gazebo without a GPU: export '
            'LIBGL_ALWAYS_SOFTWARE=1 before the simulator is started',
        )


def image_layout(seen: Observations) -> Iterator[Finding]:
    """
    Data, step, encoding and size of a picture agree.

    Pictures are looked at only while somebody else subscribes.
    """
    for each in _images(seen):
        pixel = _BYTES.get(each.encoding)
        who = _names(each.publishers)
        if pixel is not None and each.step < pixel * each.width:
            yield error(
                'image_layout',
                f'pictures on {each.topic}, of {who}, are {each.width} pixels of {each.encoding} '
                f'wide, and have {each.step} bytes a row instead of {pixel * each.width}',
                'cv_bridge and viewers refuse them, or show them askew',
                f'set step = {pixel} * width in {who}, or the encoding that the data has',
            )
        elif pixel is not None and each.size != each.step * each.height:
            yield error(
                'image_layout',
                f'pictures on {each.topic}, of {who}, have {each.size} bytes instead of '
                f'{each.step} * {each.height} = {each.step * each.height}',
                'cv_bridge and viewers refuse them',
                f'make data step * height bytes long in {who}',
            )
        elif not each.encoding:
            yield error(
                'image_layout',
                f'pictures on {each.topic}, of {who}, have no encoding',
                'nobody knows what their bytes mean',
                f"set encoding in {who}, such as 'rgb8'",
            )


def camera_info(seen: Observations) -> Iterator[Finding]:
    """
    A camera publishes its camera_info, of the size of its pictures.

    It has a calibration.
    """
    for each in _images(seen):
        who = _names(each.publishers)
        if each.info_size is None or {*each.publishers}.isdisjoint(each.info_publishers):
            continue  # the pictures of another node beside the camera's, as with marks in them
        if each.info_size not in ((each.width, each.height), _NO_SIZE):
            yield error(
                'camera_info',
                f'pictures on {each.topic} have {each.width} x {each.height} pixels, and '
                f'{each.info_topic}, of {_names(each.info_publishers)}, is for '
                f'{each.info_size[0]} x {each.info_size[1]}',
                'rectified pictures, point clouds and tags are at wrong places',
                f'calibrate at the size that is published, or set the size of {who} to '
                f'{each.info_size[0]} x {each.info_size[1]}',
            )
        elif not each.focal_length or each.info_size == _NO_SIZE:
            yield warning(
                'camera_info',
                f'{each.info_topic}, of {_names(each.info_publishers)}, is not calibrated: the '
                'focal length in k is 0',
                'what takes pictures for measurements, as image_proc and apriltag, refuses them',
                'ros2 run camera_calibration cameracalibrator --size 8x6 --square 0.025 '
                f'--ros-args -r image:={each.topic}',
            )


def imu_orientation(seen: Observations) -> Iterator[Finding]:
    """
    An orientation is a rotation, or marked as missing.

    All zeros are none. Without one, set ``orientation_covariance[0]`` to -1.
    """
    for each in seen.sensors.imus if seen.sensors is not None else ():
        length = math.hypot(*each.orientation)
        who = _names(each.publishers)
        if each.has_orientation and not abs(length - 1.0) < 0.05:
            yield warning(
                'imu_orientation',
                f'the orientation on {each.topic}, of {who}, is a quaternion of length '
                f'{length:.3g}',
                'filters as robot_localization and imu_tools diverge or ignore the IMU',
                f'set orientation_covariance[0] to -1 in {who}, if it measures no orientation',
            )


def joint_state_fields(seen: Observations) -> Iterator[Finding]:
    """
    Joint states name each joint once, with a position that is a number.

    ``name`` and ``position`` are of one length.
    """
    for each in _joints(seen):
        twice = [name for name, count in Counter(each.names).items() if count > 1]
        what = ''
        if twice:
            what = f'names {_names(twice)} twice'
        elif each.positions not in (0, len(each.names)):
            what = f'has {len(each.names)} names and {each.positions} positions'
        elif each.not_numbers:
            what = f'has no number as the position of {_names(each.not_numbers)}'
        if what:
            yield error(
                'joint_state_fields',
                f'a message on {each.topic}, of {each.publisher}, {what}',
                'robot_state_publisher drops it, or places links nowhere',
                f'mend {each.publisher}: name, position, velocity and effort have equal lengths, '
                'and each joint is named once',
            )


def joint_state_publishers(seen: Observations) -> Iterator[Finding]:
    """
    A joint has one publisher of its state.

    Mostly a ``joint_state_publisher`` runs beside a robot or a simulation.
    """
    by_topic: dict[str, list[ObservedJoints]] = {}
    for each in _joints(seen):
        by_topic.setdefault(each.topic, []).append(each)
    for topic, found in by_topic.items():
        for first, second in _pairs_of(found):
            both = sorted({*first.names} & {*second.names})
            if not both:
                continue
            fakes = [
                each.publisher for each in (first, second) if 'joint_state_pub' in each.publisher
            ]
            yield error(
                'joint_state_publishers',
                f'{_names(both)} on {topic} have two publishers: {first.publisher} and '
                f'{second.publisher}',
                'the robot is drawn at both places in turn, and its links jump',
                f'end {fakes[0] if fakes else second.publisher}'
                + (', which only makes up what the robot does' if fakes else ''),
            )
            break


def odometry_diverges(seen: Observations) -> Iterator[Finding]:
    """
    Odometry is near the truth of the simulator.

    They differ by more than a quarter: the wheels in the parameters are not those of the robot, or
    they slip. ``calibrate`` measures how far (docs/your_own_robot.md).
    """
    for each in seen.sensors.travels if seen.sensors is not None else ():
        wrong = [text for text in (_wrong_way(each), _wrong_turn(each)) if text]
        if wrong:
            yield warning(
                'odometry_diverges',
                f'in {each.seconds:.1f} s {each.topic}, of {_names(each.publishers)}, '
                f'{" and ".join(wrong)}',
                'maps are bent and goals missed: wheel_radius, wheel_separation or its multiplier '
                'are not those of the robot, or the wheels slip',
                'ros2 run amr_description calibrate',
            )


RULES: tuple[Rule, ...] = (
    joint_state_publishers,
    joint_state_fields,
    sensor_frame_missing,
    sensor_stamp,
    scan_length,
    scan_empty,
    image_layout,
    camera_info,
    imu_orientation,
    odometry_diverges,
)


def _wrong_way(each: ObservedTravel) -> str:
    off = abs(each.distance - each.true_distance)
    longest = max(each.distance, each.true_distance)
    if longest < _LEAST_WAY or off <= _SHARE * longest:
        return ''
    return f'says {each.distance:.2f} m, and the robot went {each.true_distance:.2f} m'


def _wrong_turn(each: ObservedTravel) -> str:
    off, largest = abs(each.turn - each.true_turn), max(abs(each.turn), abs(each.true_turn))
    if largest < _LEAST_TURN or off <= _SHARE * largest:
        return ''
    return f'says {each.turn:.2f} rad, and the robot turned by {each.true_turn:.2f} rad'


def _meant(frame: str, tree: Tree) -> str:
    """Return the frame that is meant by one that is not there; empty: not known."""
    last = frame.rpartition('/')[2]
    return last if last in tree.frames else closest_match(frame, sorted(tree.frames), 0.6)


def _pairs_of(found: list[ObservedJoints]) -> Iterator[tuple[ObservedJoints, ObservedJoints]]:
    for place, first in enumerate(found):
        for second in found[place + 1 :]:
            yield first, second


def _scans(seen: Observations) -> tuple[ObservedScan, ...]:
    return () if seen.sensors is None else seen.sensors.scans


def _images(seen: Observations) -> tuple[ObservedImage, ...]:
    return () if seen.sensors is None else seen.sensors.images


def _joints(seen: Observations) -> tuple[ObservedJoints, ...]:
    return () if seen.sensors is None else seen.sensors.joints


def _names(names: Iterable[str]) -> str:
    found = [*dict.fromkeys(names)]
    more = f' and {len(found) - _SHOWN} more' if len(found) > _SHOWN else ''
    return ', '.join(found[:_SHOWN]) + more
