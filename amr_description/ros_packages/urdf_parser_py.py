# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``urdf_parser_py.urdf``: a robot description as objects that a program reads, changes and writes.

What a tag has stands once, in ``FIELDS`` of its class. Comments, and tags that are not known, are
left out, but for ``<gazebo>``, ``<transmission>`` and ``<ros2_control>``, which stay as they are.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Self, TypeAlias

from lxml import etree

Numbers: TypeAlias = Sequence[float]


class ParseError(Exception):
    """A description is not as it has to be; with the path of the tag."""


@dataclass(frozen=True)
class Field:
    """One thing that a tag has."""

    name: str
    kind: Any
    """``float``, ``str``, ``list`` of numbers; or the class of a tag below it."""
    tag: str = ''
    """The tag below that has it; '': it is an attribute."""
    attribute: str = ''
    """The attribute of that tag; '': it is the whole tag, or its text."""
    required: bool = False
    default: Any = None
    many: bool = False
    """Whether there may be several, in a list."""


class Element:
    """Base of all tags."""

    TAG: ClassVar[str] = ''
    FIELDS: ClassVar[tuple[Field, ...]] = ()

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """Take values in the order of the fields, or by their names."""
        names = [each.name for each in self.FIELDS]
        given = dict(zip(names, args, strict=False)) | kwargs
        if unknown := [*(set(given) - set(names)), *args[len(names) :]]:
            raise TypeError(f'{type(self).__name__} has no {unknown[0]!r}')
        for each in self.FIELDS:
            value = given.get(each.name)
            setattr(self, each.name, [] if value is None and each.many else value)

    def check_valid(self) -> None:
        """Raise ParseError unless it is whole; called when it was read."""

    @classmethod
    def from_xml(cls, node: Any, path: str = '') -> Self:
        """Return what a tag says. Raises ParseError."""
        made = cls()
        path = f'{path}/{node.tag}' + (f"[@name='{node.get('name')}']" if node.get('name') else '')
        for each in cls.FIELDS:
            setattr(made, each.name, _read(node, each, path))
        try:
            made.check_valid()
        except (ParseError, AssertionError, ValueError) as error:
            raise ParseError(f'{path}: {error}') from None
        return made

    def to_xml(self, tag: str = '') -> Any:
        """Return it as a tag."""
        node = etree.Element(tag or self.TAG)
        for each in self.FIELDS:
            _write(node, each, getattr(self, each.name))
        return node

    def to_xml_string(self, addHeader: bool = True) -> str:  # noqa: N803
        """Return it as text, with the line that XML begins with."""
        text: str = etree.tostring(self.to_xml(), pretty_print=True, encoding='unicode')
        return f'<?xml version="1.0" encoding="utf-8"?>\n{text}' if addHeader else text

    @classmethod
    def from_xml_string(cls, xml_string: str | bytes) -> Self:
        """Return what a text says. Raises ParseError."""
        data = xml_string.encode() if isinstance(xml_string, str) else xml_string
        parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True)
        try:
            node = etree.fromstring(data, parser)
        except etree.XMLSyntaxError as error:
            raise ParseError(f'no XML: {error}') from None
        return cls.from_xml(node)

    @classmethod
    def from_xml_file(cls, file_path: Any) -> Self:
        """Return what a file says. Raises ParseError, OSError."""
        with open(file_path, 'rb') as file:
            return cls.from_xml_string(file.read())

    load_xml_file = from_xml_file
    load_xml_string = from_xml_string

    def __repr__(self) -> str:
        values = ', '.join(f'{each.name}={getattr(self, each.name)!r}' for each in self.FIELDS)
        return f'{type(self).__name__}({values})'

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(getattr(self, f.name) == getattr(other, f.name) for f in self.FIELDS)

    __hash__ = object.__hash__


def _read(node: Any, each: Field, path: str) -> Any:
    found = [node] if not each.tag else node.findall(each.tag) if each.tag != '*' else list(node)
    if each.many:
        return [_value(one, each, path) for one in found]
    value = None
    if found and (not each.attribute or found[0].get(each.attribute) is not None):
        value = _value(found[0], each, path)
    if value is None and each.required:
        raise ParseError(f'{path}: {each.tag or each.attribute} is missing')
    return each.default if value is None else value


def _value(node: Any, each: Field, path: str) -> Any:
    if isinstance(each.kind, type) and issubclass(each.kind, Element):
        return each.kind.from_xml(node, path)
    if each.kind is etree:
        return node
    text = node.get(each.attribute) if each.attribute else (node.text or '').strip()
    convert: Callable[[str], Any] = each.kind if each.kind is not list else _numbers
    if each.kind is Geometry:
        return geometry_of(node, path)
    try:
        return convert(text)
    except ValueError:
        raise ParseError(f"{path}: {each.attribute or each.tag}='{text}' is no number") from None


def _numbers(text: str) -> list[float]:
    return [float(word) for word in text.split()]


def _write(node: Any, each: Field, value: Any) -> None:
    values = value if each.many else [] if value is None else [value]
    for one in values:
        if each.kind is etree:
            node.append(one)
        elif each.kind is Geometry:
            etree.SubElement(node, each.tag).append(one.to_xml())
        elif isinstance(one, Element):
            node.append(one.to_xml(each.tag))
        else:
            below = etree.SubElement(node, each.tag) if each.tag else node
            text = ' '.join(map(_text, one)) if each.kind is list else _text(one)
            if each.attribute:
                below.set(each.attribute, text)
            else:
                below.text = text


def _text(value: Any) -> str:
    return f'{value:.15g}' if isinstance(value, float) else str(value)


def _attribute(name: str, kind: Any, **options: Any) -> Field:
    return Field(name, kind, attribute=name, **options)


class Pose(Element):
    """Where something is: ``<origin>``, m and rad."""

    TAG = 'origin'
    FIELDS = (
        _attribute('xyz', list, default=[0.0, 0.0, 0.0]),
        _attribute('rpy', list, default=[0.0, 0.0, 0.0]),
    )
    xyz: Numbers
    rpy: Numbers

    def check_valid(self) -> None:
        for name, value in (('xyz', self.xyz), ('rpy', self.rpy)):
            if len(value) != 3:
                raise ParseError(f'{name} takes three numbers')

    @property
    def position(self) -> Numbers:
        """As ``xyz``."""
        return self.xyz

    @property
    def rotation(self) -> Numbers:
        """As ``rpy``."""
        return self.rpy


_NAME = _attribute('name', str, required=True)
_ORIGIN = Field('origin', Pose, 'origin')


class Box(Element):
    """A box."""

    TAG = 'box'
    FIELDS = (_attribute('size', list, required=True),)


class Cylinder(Element):
    """A cylinder along z."""

    TAG = 'cylinder'
    FIELDS = (
        _attribute('radius', float, required=True),
        _attribute('length', float, required=True),
    )


class Sphere(Element):
    """A sphere."""

    TAG = 'sphere'
    FIELDS = (_attribute('radius', float, required=True),)


class Mesh(Element):
    """A file with triangles."""

    TAG = 'mesh'
    FIELDS = (_attribute('filename', str, required=True), _attribute('scale', list))


class Geometry:
    """One of :data:`SHAPES`."""


SHAPES: dict[str, type[Element]] = {each.TAG: each for each in (Box, Cylinder, Sphere, Mesh)}


def geometry_of(node: Any, path: str) -> Element:
    """Return the shape in ``<geometry>``. Raises ParseError."""
    known = [each for each in node if each.tag in SHAPES]
    if len(known) != 1:
        raise ParseError(f'{path}/geometry: it takes one of {", ".join(SHAPES)}')
    return SHAPES[known[0].tag].from_xml(known[0], f'{path}/geometry')


_GEOMETRY = Field('geometry', Geometry, 'geometry', required=True)


class Color(Element):
    """Red, green, blue and opacity, 0 to 1."""

    TAG = 'color'
    FIELDS = (_attribute('rgba', list, required=True),)


class Texture(Element):
    """A picture."""

    TAG = 'texture'
    FIELDS = (_attribute('filename', str, required=True),)


class Material(Element):
    """A colour or a picture, under a name."""

    TAG = 'material'
    FIELDS = (
        Field('name', str, attribute='name'),
        Field('color', Color, 'color'),
        Field('texture', Texture, 'texture'),
    )


class Visual(Element):
    """What is seen of a link."""

    TAG = 'visual'
    FIELDS = (
        _GEOMETRY,
        Field('material', Material, 'material'),
        _ORIGIN,
        Field('name', str, attribute='name'),
    )


class Collision(Element):
    """What of a link touches others."""

    TAG = 'collision'
    FIELDS = (_GEOMETRY, _ORIGIN, Field('name', str, attribute='name'))


class Inertia(Element):
    """Moments of inertia, kg m²."""

    TAG = 'inertia'
    KEYS: ClassVar[tuple[str, ...]] = ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')
    FIELDS = tuple(_attribute(key, float, required=True) for key in KEYS)

    def to_matrix(self) -> list[list[float]]:
        """Return the rows of the matrix."""
        a, b, c, d, e, f = (getattr(self, key) for key in self.KEYS)
        return [[a, b, c], [b, d, e], [c, e, f]]


class Inertial(Element):
    """Mass, kg, and how it is distributed."""

    TAG = 'inertial'
    FIELDS = (
        Field('mass', float, 'mass', 'value', required=True),
        Field('inertia', Inertia, 'inertia'),
        _ORIGIN,
    )


class JointLimit(Element):
    """N or Nm, m or rad, m/s or rad/s."""

    TAG = 'limit'
    FIELDS = (
        _attribute('effort', float, required=True),
        _attribute('velocity', float, required=True),
        _attribute('lower', float, default=0.0),
        _attribute('upper', float, default=0.0),
    )


class JointDynamics(Element):
    """Damping and friction."""

    TAG = 'dynamics'
    FIELDS = (_attribute('damping', float), _attribute('friction', float))


class JointMimic(Element):
    """A joint that follows another one."""

    TAG = 'mimic'
    FIELDS = (
        _attribute('joint', str, required=True),
        _attribute('multiplier', float),
        _attribute('offset', float),
    )


class SafetyController(Element):
    """Soft limits."""

    TAG = 'safety_controller'
    FIELDS = (
        _attribute('k_velocity', float, required=True),
        _attribute('k_position', float, default=0.0),
        _attribute('soft_lower_limit', float, default=0.0),
        _attribute('soft_upper_limit', float, default=0.0),
    )


class JointCalibration(Element):
    """Where edges are seen."""

    TAG = 'calibration'
    FIELDS = (_attribute('rising', float, default=0.0), _attribute('falling', float, default=0.0))


class Joint(Element):
    """What joins two links."""

    TAG = 'joint'
    TYPES: ClassVar[tuple[str, ...]] = (
        'unknown', 'revolute', 'continuous', 'prismatic', 'floating', 'planar', 'fixed',
    )  # fmt: skip
    FIELDS = (
        _NAME,
        Field('parent', str, 'parent', 'link', required=True),
        Field('child', str, 'child', 'link', required=True),
        _attribute('type', str, required=True),
        Field('axis', list, 'axis', 'xyz'),
        _ORIGIN,
        Field('limit', JointLimit, 'limit'),
        Field('dynamics', JointDynamics, 'dynamics'),
        Field('safety_controller', SafetyController, 'safety_controller'),
        Field('calibration', JointCalibration, 'calibration'),
        Field('mimic', JointMimic, 'mimic'),
    )
    name: str
    parent: str
    child: str
    type: str

    def __init__(self, *args: Any, joint_type: str | None = None, **kwargs: Any) -> None:
        if joint_type is not None:
            kwargs['type'] = joint_type
        super().__init__(*args, **kwargs)

    @property
    def joint_type(self) -> str:
        """As ``type``."""
        return self.type

    def check_valid(self) -> None:
        if self.type not in self.TYPES:
            raise ParseError(f"type='{self.type}': it takes one of {', '.join(self.TYPES)}")


class Link(Element):
    """A body."""

    TAG = 'link'
    FIELDS = (
        _NAME,
        Field('visuals', Visual, 'visual', many=True),
        Field('inertial', Inertial, 'inertial'),
        Field('collisions', Collision, 'collision', many=True),
        _ORIGIN,
    )
    name: str
    visuals: list[Visual]
    collisions: list[Collision]

    @property
    def visual(self) -> Visual | None:
        """The first one."""
        return self.visuals[0] if self.visuals else None

    @property
    def collision(self) -> Collision | None:
        """The first one."""
        return self.collisions[0] if self.collisions else None


class Robot(Element):
    """A robot."""

    TAG = 'robot'
    FIELDS = (
        _NAME,
        _attribute('version', str, default='1.0'),
        Field('links', Link, 'link', many=True),
        Field('joints', Joint, 'joint', many=True),
        Field('materials', Material, 'material', many=True),
        Field('gazebos', etree, 'gazebo', many=True),
        Field('transmissions', etree, 'transmission', many=True),
        Field('ros2_controls', etree, 'ros2_control', many=True),
    )
    name: str
    version: str
    links: list[Link]
    joints: list[Joint]

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **{'version': '1.0', **kwargs} if len(args) < 2 else kwargs)

    @property
    def link_map(self) -> dict[str, Link]:
        """The links by their names."""
        return {link.name: link for link in self.links}

    @property
    def joint_map(self) -> dict[str, Joint]:
        """The joints by their names."""
        return {joint.name: joint for joint in self.joints}

    @property
    def parent_map(self) -> dict[str, tuple[str, str]]:
        """By each link that has one: its joint, and the link above."""
        return {joint.child: (joint.name, joint.parent) for joint in self.joints}

    @property
    def child_map(self) -> dict[str, list[tuple[str, str]]]:
        """By each link that has some: the joints and links below."""
        found: dict[str, list[tuple[str, str]]] = {}
        for joint in self.joints:
            found.setdefault(joint.parent, []).append((joint.name, joint.child))
        return found

    def add_link(self, link: Link) -> None:
        """Add one."""
        self.links.append(link)

    def add_joint(self, joint: Joint) -> None:
        """Add one."""
        self.joints.append(joint)

    def get_root(self) -> str:
        """Return the link that is below no other. Raises ParseError: there is none, or several."""
        below = self.parent_map
        roots = [link.name for link in self.links if link.name not in below]
        if len(roots) != 1:
            raise ParseError(f'a robot has one root, and not {roots}')
        return roots[0]

    def get_chain(
        self, root: str, tip: str, joints: bool = True, links: bool = True, fixed: bool = True
    ) -> list[str]:
        """
        Return the names on the way from a link to one below it.

        Args:
            root: Where it begins.
            tip: Where it ends.
            joints: Whether the joints are named.
            links: Whether the links are.
            fixed: Whether fixed joints are among them.

        Raises:
            KeyError: the one is not below the other.
        """
        above, by_name = self.parent_map, self.joint_map
        chain = [tip] if links else []
        while tip != root:
            joint, tip = above[tip]
            if joints and (fixed or by_name[joint].type != 'fixed'):
                chain.append(joint)
            if links:
                chain.append(tip)
        return chain[::-1]

    def check_valid(self) -> None:
        if self.version != '1.0':
            raise ParseError(f"version='{self.version}': it takes 1.0")


URDF = Robot
