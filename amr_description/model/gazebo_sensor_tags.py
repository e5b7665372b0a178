# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The elements of a ``<sensor>`` of SDF that both Gazebos share: numbers, angles, pictures, noise.

Each value is read with SDF's default and checked; a fault is a finding that says what would do.
A sensor with one is left out, and the rest of the robot goes on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
import math
import re

from lxml import etree

from amr_description.model.findings import Finding
from amr_description.model.frames import rotate, Transform, Vector
from amr_description.model.gazebo import Noise
from amr_description.model.robot import JointType, Robot
from amr_description.model.sensors import Distortion, Intrinsics, ScanAxis
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
        self.findings.append(
            Finding.error(self.robot.source, line, self._says(what), taken=LEFT_OUT, **details)
        )

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
        value = self.number(path, float(default), 1.0, 'a whole number from 1 on')
        if value != int(value):
            element = self.element.find(path)
            found = quote(self.text(path))
            self.error(_named(path), element, found=found, expected='a whole number from 1 on')
            return default
        return int(value)

    def rate(self) -> float:
        """Return the rate of the sensor, Hz."""
        return self.number('update_rate', 0.0, 0.0, 'Hz: a finite number from 0 on')

    def pose(self) -> Transform:
        """Return ``transform_sensor_to_link``."""
        element = self.element.find('pose')
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

    def frame(self, *paths: str) -> str:
        """Return the frame that an element names; '' if none does. Warn of one that is no link."""
        name = self.text(*paths).lstrip('/')
        if name and not self.robot.has_link(name.rpartition('/')[2]):
            links = [link.name for link in self.robot.links]
            meant = closest_match(name, links, _SIMILAR)
            path = next(path for path in paths if self.text(path))
            self.warning(
                f'<{path.rpartition("/")[2]}> is no link of the robot, so that tf knows no '
                'transform to it',
                self.element.find(path),
                found=quote(name),
                fix=f'write {meant}' if meant else f'write the name of a link: {quote_all(links)}',
            )
        return name

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
        return _dot(rotate(self.poses[link].rotation, z_axis), forward) > math.sqrt(0.5)

    def topic(self, name: str, element: str = 'topic') -> str:
        """Return a topic, or report that it cannot be one."""
        if name and not _TOPIC.fullmatch(name):
            parts = [re.sub(r'\W', '_', part, flags=re.ASCII) for part in name.split('/')]
            parts = [f'_{part}' if part[:1].isdigit() else part for part in parts if part]
            meant = ('/' if name.startswith('/') else '') + '/'.join(parts)
            self.error(
                f'<{element}> is no name of a topic of ROS',
                self.element.find(element),
                found=quote(name),
                fix=f'write {meant}' if parts else 'write one, or remove it',
            )
        return name

    def axis(self, path: str, samples: int) -> ScanAxis:
        """
        Return the rays of ``<horizontal>`` or ``<vertical>``.

        Args:
            path: of that element, below the sensor.
            samples: if it does not say.
        """
        element = self.element.find(path)
        count = self.count(f'{path}/samples', samples)
        share = self.number(f'{path}/resolution', 1.0, 0.0)
        lower = self._angle(f'{path}/min_angle')
        upper = self._angle(f'{path}/max_angle')
        count = max(1, round(count * share))
        if count > 1 and lower >= upper and not self.is_faulty:
            self.error(
                f'the angles of <{path.rpartition("/")[2]}>',
                element,
                found=f'<min_angle> {lower:g}, <max_angle> {upper:g}, {count} samples',
                expected='a <max_angle> above <min_angle>',
                fix='swap them' if lower > upper else 'write <samples>1</samples> for one ray',
            )
        return ScanAxis(count, lower, upper)

    def rays_are_few(self, horizontal: ScanAxis, vertical: ScanAxis) -> bool:
        """Return whether they can be cast; report it otherwise."""
        rays = horizontal.samples * vertical.samples
        if rays > MOST_RAYS:
            self.error(
                'its scan has too many rays for a CPU',
                found=f'{horizontal.samples} by {vertical.samples}: {rays} rays',
                expected=f'at most {MOST_RAYS}',
                fix='write fewer <samples>',
            )
        return rays <= MOST_RAYS

    def range(self, path: str) -> tuple[float, float, float]:
        """Return the least and the largest range, m, and the resolution of ``<range>``."""
        element = self.element.find(path)
        if element is None or element.find('max') is None:
            self.error(
                'it has no <range> with a <max>' if element is None else '<range> has no <max>',
                element,
                fix=f'write, in <{path.partition("/")[0]}>, '
                '<range><min>0.1</min><max>10.0</max></range>',
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


def tags_of(
    sensors: Sequence[tuple[etree._Element, str]], robot: Robot, poses: Mapping[str, Transform]
) -> list[SensorTag]:
    """Return the ``<sensor>`` tags of a robot, each with the link that it is mounted on."""
    return [SensorTag(element, link.strip(), robot, poses) for element, link in sensors]


def _named(path: str) -> str:
    """Return how messages call an element: by its name, and that of the one around it."""
    *_, parent, name = ('', *path.split('/'))
    return f'<{name}> of <{parent}>' if parent else f'<{name}>'


def _dot(a: Vector, b: Vector) -> float:
    return math.sumprod(a, b)
