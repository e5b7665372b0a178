# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The elements of a ``<sensor>`` of SDF that both Gazebos share: numbers, angles, pictures, noise.

Each value is read with SDF's default and checked; a fault is a finding that says what would do.
A sensor with one is left out, and the rest of the robot goes on.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
import math
import re

from lxml import etree

from amr_description.model.collision_names import find_collisions
from amr_description.model.findings import Finding
from amr_description.model.frames import dot, rotate, Transform
from amr_description.model.gazebo.tags import Noise
from amr_description.model.robot import JointType, Robot
from amr_description.model.sensors import (
    Camera,
    Distortion,
    Intrinsics,
    Lidar,
    ScanAxis,
    SensorMount,
)
from amr_description.model.xml_reader import line_of, parse_number
from amr_description.text import closest_match, quote, quote_all

LEFT_OUT = 'the sensor is left out'
"""What the simulator makes of a fault."""
MOST_RAYS = 2**20
"""Of one scan: the CPU casts them in a second or so, and a cloud of them has 24 MiB."""
MOST_PIXELS = 2**24
"""Of one picture, 48 MiB of colours: twice as many as 4K has."""
_LONGEST_RANGE = 1e6
"""m; what is above it is meant as no limit."""

_LARGEST = 1e9
"""A number of things that is above it counts as this; there are too many of them anyhow."""
_TURN = 2.0 * math.pi
_ROUNDING = 0.02
"""rad; by so much a full turn may be exceeded, such as by 6.3."""
_ENCODINGS = {
    'R8G8B8': 'rgb8',
    'RGB_INT8': 'rgb8',
    'B8G8R8': 'bgr8',
    'BGR_INT8': 'bgr8',
    'L8': 'mono8',
    'L_INT8': 'mono8',
}
_TOPIC = re.compile(r'/?[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*', re.ASCII)
_SIMILAR = 0.6
_ALL_BITS = 0xFFFFFFFF
_NOISES = {'none': False, 'gaussian': True, 'gaussian_quantized': True}


@dataclass(slots=True)
class SensorTag:
    """
    One ``<sensor>`` of a ``<gazebo>`` block, and what is wrong with it.

    ``poses`` are ``transform_link_to_root`` of all links, with all joints at 0.
    """

    element: etree._Element
    link: str
    robot: Robot
    poses: Mapping[str, Transform]
    findings: list[Finding] = field(default_factory=list)
    is_faulty: bool = False

    @property
    def name(self) -> str:
        """Its name, as written."""
        return self.element.get('name', '').strip()

    @property
    def type(self) -> str:
        """Its type, as written."""
        return self.element.get('type', '').strip()

    @property
    def line(self) -> int:
        """The line on which it begins."""
        return line_of(self.element)

    def error(self, what: str, element: etree._Element | None = None, **details: str) -> None:
        """Report a fault with which the sensor cannot be simulated."""
        self.is_faulty = True
        line = self.line if element is None else line_of(element)
        fix = details.get('fix', '')
        taken = f'{LEFT_OUT}; {fix}' if fix else LEFT_OUT  # the simulator says what would do, too
        self.findings.append(
            Finding.error(self.robot.source, line, self._says(what), taken=taken, **details)
        )

    def leave_out(self, what: str, element: etree._Element | None = None, **details: str) -> None:
        """Report what Gazebo leaves out as well, which is no fault of the rest."""
        self.is_faulty = True
        self.warning(what, element, taken=LEFT_OUT, **details)

    def warning(self, what: str, element: etree._Element | None = None, **details: str) -> None:
        """Report what nobody intends, and the simulator can do; ``taken``: what it does."""
        line = self.line if element is None else line_of(element)
        finding = Finding.warning(self.robot.source, line, self._says(what), **details)
        self.findings.append(finding)

    def text(self, *paths: str) -> str:
        """Return the text of the first element that has one; '' if none has."""
        for path in paths:
            found = (self.element.findtext(path) or '').strip()
            if found:
                return found
        return ''

    def number(
        self, path: str, default: float, least: float = -math.inf, expected: str = ''
    ) -> float:
        """
        Return a finite number, or report it and return the default.

        Args:
            path: of its element, below the sensor.
            default: if there is no such element.
            least: the number may have.
            expected: what is expected; '': by ``least``.
        """
        element = self.element.find(path)
        if element is None:
            return default
        text = (element.text or '').strip()
        value = parse_number(text)
        if math.isfinite(value) and value >= least:
            return value
        if not expected:
            expected = 'a finite number' + ('' if least == -math.inf else f' from {least:g} on')
        self.error(_named(path), element, found=quote(text), expected=expected)
        return default

    def count(self, path: str, default: int) -> int:
        """Return a whole number from 1 on, or report it and return the default."""
        expected = 'a whole number from 1 on'
        value = min(self.number(path, float(default), 1.0, expected), _LARGEST)
        if value != int(value):
            self.warning(
                _named(path),
                self.element.find(path),
                found=quote(self.text(path)),
                expected=expected,
                taken=f'{int(value)} is taken',
            )
        return int(value)

    def rate(self) -> float:
        """Return the rate of the sensor, Hz."""
        return self.number('update_rate', 0.0, 0.0, 'Hz: a finite number from 0 on')

    def pose(self, path: str) -> Transform:
        """Return the transform that a ``<pose>`` stands for; none is no motion."""
        element = self.element.find(path)
        if element is None:
            return Transform()
        text = (element.text or '').strip()
        values = [parse_number(word) for word in text.split()]
        if len(values) != 6 or not all(map(math.isfinite, values)):
            self.error('<pose>', element, found=quote(text), expected='6 numbers, finite')
            return Transform()
        if element.get('degrees', '').lower() in ('true', '1'):
            values[3:] = map(math.radians, values[3:])
        x, y, z, roll, pitch, yaw = values
        return Transform.from_xyz_rpy((x, y, z), (roll, pitch, yaw))

    def is_link(self, frame: str) -> bool:
        """Return whether a frame is a link of the robot, without the prefix of a namespace."""
        return self.robot.has_link(frame.rpartition('/')[2])

    def frame(self, *paths: str) -> str:
        """Return the frame that the first element names that is there; '' if none is."""
        name = self.text(*paths).lstrip('/')
        if name and not self.is_link(name):
            path = next(path for path in paths if self.text(path))
            self.warn_of_frame(path.rpartition('/')[2], name, self.element.find(path))
        return name

    def warn_of_frame(self, tag: str, frame: str, element: etree._Element | None) -> None:
        """Report a frame that is no link, so that nobody knows a transform to it."""
        links = [link.name for link in self.robot.links]
        meant = closest_match(frame, links, _SIMILAR)
        self.warning(
            f'<{tag}> is no link of the robot: tf will know no transform to it',
            element,
            found=quote(frame),
            fix=f'write {meant}' if meant else f'there are {quote_all(links)}',
        )

    def collisions(self) -> tuple[str, ...]:
        """Return the names of collisions of a contact sensor, as written; none are all."""
        elements = self.element.findall('contact/collision')
        names = [text for each in elements if (text := (each.text or '').strip())]
        _, unknown = find_collisions(self.robot, self.link, names)
        if unknown:
            self.warning(
                '<collision> of <contact> is none of the robot',
                elements[0],
                found=quote_all(unknown),
                fix=f'write {self.link}_collision for those of its link',
            )
        return tuple(names)

    def sees_robot(self, path: str) -> bool:
        """
        Return whether the ``<visibility_mask>`` of a sensor lets it see the robot's own parts.

        Gazebo shows a sensor what has a bit in common with it: the ``<visibility_flags>`` of a
        visual, all bits if it has none.
        """
        mask = self._bits(self.element.find(path))
        flags = {link.name: _ALL_BITS for link in self.robot.links if link.visuals}
        if mask == _ALL_BITS or not flags:
            return True
        for gazebo in self.element.getroottree().iterfind('gazebo'):
            link, element = gazebo.get('reference', ''), gazebo.find('visual/visibility_flags')
            if link in flags and element is not None:
                flags[link] = self._bits(element)
        hidden = [link for link, bits in flags.items() if not bits & mask]
        if hidden and len(hidden) < len(flags):
            self.warning(
                '<visibility_mask> hides some links from it',
                self.element.find(path),
                found=quote_all(hidden),
                expected='all of the robot, or nothing',
                taken='it sees them',
            )
        return len(hidden) < len(flags)

    def _bits(self, element: etree._Element | None) -> int:
        """Return the bits of a mask, which may be written as 0xFF; all of them by default."""
        text = '' if element is None else (element.text or '').strip()
        try:
            return int(text, 0) & _ALL_BITS if text else _ALL_BITS
        except ValueError:
            self.warning('a mask', element, found=quote(text), expected='bits, such as 0xFF')
            return _ALL_BITS

    def optical_frame(self) -> str:
        """Return the link for the messages of a camera whose tag names none (REP 103)."""
        nearest = [self.link]
        for link in nearest:  # grows: breadth first
            for joint in self.robot.child_joints(link):
                if joint.type is JointType.FIXED and joint.child not in nearest:
                    if 'optical' in joint.child:
                        return joint.child
                    nearest.append(joint.child)
        return self.link

    def is_optical(self, frame: str, pose: Transform) -> bool:
        """
        Return whether a frame has the axes of a camera's optical frame: z forward.

        Args:
            frame: of messages; one that is no link is judged by its name.
            pose: ``transform_sensor_to_link``.
        """
        link = frame.rpartition('/')[2]
        if link not in self.poses or self.link not in self.poses:
            return 'optical' in frame
        x_axis, z_axis = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
        forward = rotate((self.poses[self.link] @ pose).rotation, x_axis)
        return dot(rotate(self.poses[link].rotation, z_axis), forward) > math.sqrt(0.5)

    def topic(self, name: str) -> str:
        """Return a topic, or report that it cannot be one."""
        if name and not _TOPIC.fullmatch(name):
            parts = [topic_part(part) for part in name.split('/') if part]
            meant = ('/' if name.startswith('/') else '') + '/'.join(parts)
            self.error(
                'its topic is no name of one in ROS',
                found=quote(name),
                fix=f'write {meant}' if parts else 'write one',
            )
        return name

    def mount(self, frame: str, inside: str = '') -> SensorMount:
        """
        Return where the sensor is, with the frame of its messages.

        Args:
            frame: of the messages.
            inside: an element with a pose of its own, such as ``camera``.
        """
        pose = self.pose('pose') @ self.pose(f'{inside}/pose') if inside else self.pose('pose')
        return SensorMount(self.name, self.link, pose, frame, self.rate(), line=self.line)

    def axis(self, path: str, samples: int) -> ScanAxis:
        """
        Return the rays of ``<horizontal>`` or ``<vertical>``.

        Args:
            path: of that element, below the sensor.
            samples: if it does not say.
        """
        element = self.element.find(path)
        count = self.count(f'{path}/samples', samples)
        share = min(self.number(f'{path}/resolution', 1.0, 0.0), _LARGEST)
        lower = self._angle(f'{path}/min_angle')
        upper = self._angle(f'{path}/max_angle')
        count = max(1, round(min(count * share, _LARGEST)))
        if count > 1 and lower >= upper and not self.is_faulty:
            self.error(
                f'the angles of <{path.rpartition("/")[2]}>',
                element,
                found=f'<min_angle> {lower:g}, <max_angle> {upper:g}, {count} samples',
                expected='a <max_angle> above <min_angle>',
                fix='swap them' if lower > upper else 'write <samples>1</samples> for one ray',
            )
        return ScanAxis(count, lower, upper)

    def check_rays(self, horizontal: ScanAxis, vertical: ScanAxis) -> None:
        """Report more rays than can be cast."""
        rays = horizontal.samples * vertical.samples
        if rays > MOST_RAYS:
            self.error(
                'its scan has too many rays for a CPU',
                found=f'{horizontal.samples} by {vertical.samples}: {rays} rays',
                expected=f'at most {MOST_RAYS}',
                fix='write fewer <samples>',
            )

    def range(self, path: str) -> tuple[float, float, float]:
        """Return the least and the largest range, m, and the resolution of ``<range>``."""
        element, name = self.element.find(path), path.rpartition('/')[2]
        if element is None or element.find('max') is None:
            self.error(
                f'it has no <{name}> with a <max>'
                if element is None
                else f'<{name}> has no <max>',
                element,
                fix=f'write, in <{path.partition("/")[0]}>, '
                '<range><min>0.1</min><max>10.0</max></range>'
                if '/' in path
                else f'write <{name}><min>0.1</min><max>4.0</max></{name}>',
            )
            return 0.0, 0.0, 0.0
        least = self.number(f'{path}/min', 0.0, 0.0, 'm: a finite number from 0 on')
        most = self.limit(f'{path}/max', 0.0)
        if least >= most and not self.is_faulty:
            self.error(
                '<range>',
                element,
                found=f'<min> {least:g}, <max> {most:g}',
                expected='a <max> above <min>',
                fix='swap them' if least > most else '',
            )
        return least, most, self.number(f'{path}/resolution', 0.0, 0.0)

    def limit(self, path: str, default: float) -> float:
        """Return the upper limit of a distance, m, which may be infinite."""
        text = self.text(path).lower().lstrip('+')
        if text in ('inf', 'infinity'):
            return math.inf
        value = self.number(path, default, 0.0, 'm: a number from 0 on')
        return math.inf if value > _LONGEST_RANGE else value

    def clip(self, path: str, near: float, far: float) -> tuple[float, float]:
        """Return the planes between which a camera sees, m."""
        near = self.number(f'{path}/near', near, 0.0, 'm: a finite number from 0 on')
        far = self.limit(f'{path}/far', far)
        if near >= far and not self.is_faulty:
            self.error(
                '<clip>',
                self.element.find(path),
                found=f'<near> {near:g}, <far> {far:g}',
                expected='a <far> above <near>',
                fix='swap them' if near > far else '',
            )
        return near, far

    def size(self, path: str) -> tuple[int, int]:
        """Return width and height of a picture, pixels."""
        width = self.count(f'{path}/width', 320)
        height = self.count(f'{path}/height', 240)
        if width * height > MOST_PIXELS:
            self.error(
                'its picture is too large',
                self.element.find(path),
                found=f'{width} by {height} pixels',
                expected=f'at most {MOST_PIXELS} pixels',
            )
        return width, height

    def encoding(self, path: str) -> str:
        """Return the encoding of a picture's colours."""
        written = self.text(path)
        found = _ENCODINGS.get(written.upper(), '')
        if not found and written:
            self.warning(
                '<format>',
                self.element.find(path),
                found=quote(written),
                expected=f'one of {", ".join(_ENCODINGS)}',
                taken='its pictures are rgb8',
            )
        return found or 'rgb8'

    def field_of_view(self, path: str) -> float:
        """Return the horizontal field of view of a camera, rad."""
        value = self.number(path, 1.047, 0.0, 'rad: above 0 and below π (3.14)')
        if not 0.0 < value < math.pi and not self.is_faulty:
            in_degrees = f'{value:g}° are {math.radians(value):.4g} rad'
            self.error(
                _named(path),
                self.element.find(path),
                found=quote(self.text(path)),
                expected='rad: above 0 and below π (3.14)',
                fix=in_degrees if math.pi < value < 180.0 else '',
            )
        return value

    def intrinsics(self, path: str) -> Intrinsics | None:
        """Return the matrix K; None if the tag does not give it."""
        if self.element.find(path) is None:
            return None
        focal = 'pixels: a finite number above 0'
        fx, fy = (self.number(f'{path}/{each}', 277.0, 1e-6, focal) for each in ('fx', 'fy'))
        if self.number(f'{path}/s', 0.0):
            self.warning(
                'the skew <s> of <intrinsics> is not simulated', self.element.find(f'{path}/s')
            )
        cx, cy = self.number(f'{path}/cx', 160.0), self.number(f'{path}/cy', 120.0)
        return Intrinsics(fx, fy, cx, cy)

    def distortion(self, path: str) -> Distortion:
        """Return the coefficients of the lens."""
        names = ('k1', 'k2', 'k3', 'p1', 'p2')
        return Distortion(*(self.number(f'{path}/{name}', 0.0) for name in names))

    def noise(self, path: str) -> Noise:
        """Return the noise of ranges or of colours."""
        element = self.element.find(path)
        if element is None:
            return Noise()
        kind = self.text(f'{path}/type') or element.get('type', '').strip() or 'none'
        if kind not in _NOISES:
            self.warning(
                'type of <noise>',
                element,
                found=quote(kind),
                expected=f'one of {", ".join(_NOISES)}',
                taken='it has no noise',
            )
        if not _NOISES.get(kind, False):
            return Noise()
        names = [each for each in Noise.__dataclass_fields__ if each != 'precision']
        signed = ('mean', 'bias_mean')
        values = {
            name: self.number(f'{path}/{name}', 0.0, -math.inf if name in signed else 0.0)
            for name in names
        }
        if kind == 'gaussian_quantized':
            values['precision'] = self.number(f'{path}/precision', 0.0, 0.0)
        return Noise(**values)

    def _angle(self, path: str) -> float:
        """Return an angle of a ray, rad: at most a turn, an elevation at most a quarter."""
        most = _TURN / 4.0 if '/vertical/' in path else _TURN
        value = self.number(path, 0.0, expected='rad: a finite number')
        if abs(value) > most + _ROUNDING:
            self.error(
                _named(path),
                self.element.find(path),
                found=quote(self.text(path)),
                expected=f'rad, {-most:.3g} to {most:.3g}',
                fix=f'{value:g}° are {math.radians(value):.4g} rad',
            )
            return 0.0
        return value

    def _says(self, what: str) -> str:
        return f'gazebo sensor {quote(self.name)}: {what}'


def lidar_of(tag: SensorTag, mount: SensorMount) -> Lidar:
    """Return a lidar by its ``<lidar>`` or ``<ray>`` element, still without topics."""
    inside = 'ray' if tag.element.find('ray') is not None else 'lidar'
    if tag.element.find(inside) is None:
        tag.error('it has no <lidar>', fix='write one, with <scan> and <range>')
        return Lidar(mount, ScanAxis(1, 0.0, 0.0))
    horizontal = tag.axis(f'{inside}/scan/horizontal', 640)
    vertical = ScanAxis(1, 0.0, 0.0)
    if tag.element.find(f'{inside}/scan/vertical') is not None:
        vertical = tag.axis(f'{inside}/scan/vertical', 1)
    tag.check_rays(horizontal, vertical)
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
        sees_robot=tag.sees_robot(f'{inside}/visibility_mask'),
        scan_topic='',
    )


def camera_of(
    tag: SensorTag, mount: SensorMount, inside: str = 'camera', *, has_colour: bool = True
) -> Camera:
    """
    Return a camera by its ``<camera>`` element, still without topics.

    Args:
        tag: of the sensor.
        mount: of the sensor.
        inside: that element; of several ``camera[1]``, ``camera[2]``.
        has_colour: whether it has pictures in colour, whose format counts.
    """
    width, height = tag.size(f'{inside}/image')
    near, far = tag.clip(f'{inside}/clip', 0.1, 100.0)
    depth_near, depth_far = near, far
    if tag.element.find(f'{inside}/depth_camera/clip') is not None:
        depth_near, depth_far = tag.clip(f'{inside}/depth_camera/clip', near, far)
    return Camera(
        mount,
        width,
        height,
        tag.field_of_view(f'{inside}/horizontal_fov'),
        near,
        far,
        depth_near,
        depth_far,
        tag.intrinsics(f'{inside}/lens/intrinsics'),
        tag.distortion(f'{inside}/distortion'),
        tag.noise(f'{inside}/noise'),
        tag.encoding(f'{inside}/image/format') if has_colour else 'rgb8',
        points_are_optical=tag.is_optical(mount.frame, mount.pose),
    )


def topic_part(name: str) -> str:
    """Return a name as part of that of a topic."""
    word = re.sub(r'\W', '_', name, flags=re.ASCII)
    return f'_{word}' if word[:1].isdigit() or not word else word


def _named(path: str) -> str:
    """Return how messages call an element: by its name, and that of the one around it."""
    *_, parent, name = ('', *path.split('/'))
    parent = parent.partition('[')[0]
    return f'<{name}> of <{parent}>' if parent else f'<{name}>'
