# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The immutable description of a robot: links joined into a tree, as in URDF.

It is made by :mod:`amr_description.model.urdf`. Units are SI (m, rad, kg, kg·m²). Every part knows
its line of the file.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeAlias, TypeVar

from amr_description.errors import DescriptionError
from amr_description.model.frames import Transform, Vector
from amr_description.model.hardware_info import HardwareInfo, Mimic as Mimic
from amr_description.text import quote, quote_all

Part = TypeVar('Part')

WORLD_LINK = 'world'
"""A robot whose root has this name is fixed to the world."""


class JointType(StrEnum):
    """The joint types of URDF; each equals its text."""

    REVOLUTE = 'revolute'
    CONTINUOUS = 'continuous'
    PRISMATIC = 'prismatic'
    FIXED = 'fixed'
    FLOATING = 'floating'
    PLANAR = 'planar'


@dataclass(frozen=True, slots=True)
class Box:
    """A box about its centre; ``size`` are the full edge lengths x, y, z (m)."""

    size: Vector


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A cylinder about its centre, along z (m)."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class Sphere:
    """A sphere about its centre (m)."""

    radius: float


@dataclass(frozen=True, slots=True)
class Mesh:
    """A mesh; ``filename`` as written (``package://…``, ``file://…``, a path), scale per axis."""

    filename: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry: TypeAlias = Box | Cylinder | Sphere | Mesh


@dataclass(frozen=True, slots=True)
class Material:
    """``color`` is red, green, blue, alpha, each 0..1; ``texture`` a file name as written."""

    name: str
    color: tuple[float, float, float, float] | None = None
    texture: str | None = None


@dataclass(frozen=True, slots=True)
class Visual:
    """A drawn shape; ``origin`` is ``transform_geometry_to_link``."""

    geometry: Geometry
    origin: Transform
    material: Material | None
    name: str
    line: int


@dataclass(frozen=True, slots=True)
class Collision:
    """A colliding shape; ``origin`` is ``transform_geometry_to_link``."""

    geometry: Geometry
    origin: Transform
    name: str
    line: int


@dataclass(frozen=True, slots=True)
class Inertia:
    """The rotational inertia about the centre of mass, along the inertial axes (kg·m²)."""

    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float


@dataclass(frozen=True, slots=True)
class Inertial:
    """Mass (kg) and inertia; ``origin`` (``transform_inertial_to_link``) is the centre of mass."""

    mass: float
    inertia: Inertia
    origin: Transform
    line: int


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body; without ``inertial`` only a frame, such as ``base_footprint``."""

    name: str
    inertial: Inertial | None
    visuals: tuple[Visual, ...]
    collisions: tuple[Collision, ...]
    line: int


@dataclass(frozen=True, slots=True)
class Limit:
    """Limits of position (rad or m), effort (N·m or N) and velocity (rad/s or m/s)."""

    lower: float
    upper: float
    effort: float
    velocity: float


@dataclass(frozen=True, slots=True)
class SafetyController:
    """
    Soft limits of the position (rad or m; ±inf if not given), and gains near them.

    ``k_position`` is in 1/s, ``k_velocity`` in N·m·s/rad or N·s/m.
    """

    soft_lower_limit: float
    soft_upper_limit: float
    k_position: float
    k_velocity: float


@dataclass(frozen=True, slots=True)
class Dynamics:
    """Viscous ``damping`` (N·m·s/rad or N·s/m) and Coulomb ``friction`` (N·m or N) of a joint."""

    damping: float = 0.0
    friction: float = 0.0


@dataclass(frozen=True, slots=True)
class Joint:
    """
    How ``child`` moves relative to ``parent``.

    ``origin`` is ``transform_child_to_parent`` at position 0. ``axis`` is a unit vector in the
    joint's frame, which is the child's frame at position 0; it is not used for fixed and
    floating joints.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Transform
    axis: Vector
    limit: Limit | None
    mimic: Mimic | None
    dynamics: Dynamics | None
    line: int
    safety: SafetyController | None = None

    @property
    def is_moving(self) -> bool:
        """Whether the child can move relative to the parent."""
        return self.type is not JointType.FIXED

    @property
    def has_position(self) -> bool:
        """Whether the position is one number, unlike that of fixed, planar and floating joints."""
        return self.type in (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC)


@dataclass(frozen=True, slots=True)
class Robot:
    """
    A robot description.

    ``links`` and ``joints`` are in the order of the file. ``source`` names the file in messages,
    ``text`` is the URDF itself, as on ``/robot_description``.

    :func:`amr_description.model.urdf.parse` returns only sound trees: one root, every link below
    it once, unique names. The checker also makes unsound ones; every method terminates on those.
    """

    name: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    materials: tuple[Material, ...]
    source: str
    text: str = field(repr=False)
    plugin_hardware: tuple[HardwareInfo, ...] = field(default=(), repr=False)
    """What stands for plugins of Gazebo, beside the ``<ros2_control>`` blocks of ``text``."""
    roots: tuple[Link, ...] = field(init=False, repr=False, compare=False)
    """The links that are not the child of a joint: exactly one in a sound tree."""
    _links: dict[str, Link] = field(init=False, repr=False, compare=False)
    _joints: dict[str, Joint] = field(init=False, repr=False, compare=False)
    _parents: dict[str, Joint] = field(init=False, repr=False, compare=False)
    _children: dict[str, tuple[Joint, ...]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        children: dict[str, list[Joint]] = {}
        for joint in sorted(self.joints, key=lambda joint: joint.name):
            children.setdefault(joint.parent, []).append(joint)
        # Reversed, so that of two parts with one name the first is found.
        indices = {
            '_links': {link.name: link for link in reversed(self.links)},
            '_joints': {joint.name: joint for joint in reversed(self.joints)},
            '_parents': {joint.child: joint for joint in reversed(self.joints)},
            '_children': {link: tuple(joints) for link, joints in children.items()},
        }
        for name, index in indices.items():
            object.__setattr__(self, name, index)
        roots = tuple(link for link in self.links if link.name not in self._parents)
        object.__setattr__(self, 'roots', roots)

    @property
    def root(self) -> Link:
        """The link that is not the child of a joint."""
        return self.roots[0]

    def has_link(self, name: str) -> bool:
        """Return whether there is a link of that name."""
        return name in self._links

    def has_joint(self, name: str) -> bool:
        """Return whether there is a joint of that name."""
        return name in self._joints

    def link(self, name: str) -> Link:
        """Return a link by name. Raises DescriptionError with the known names."""
        return _lookup(self._links, name, 'link', self.source)

    def joint(self, name: str) -> Joint:
        """Return a joint by name. Raises DescriptionError with the known names."""
        return _lookup(self._joints, name, 'joint', self.source)

    def child_joints(self, link: str) -> tuple[Joint, ...]:
        """Return the joints whose parent is ``link``, by name, as urdfdom lists them."""
        return self._children.get(link, ())

    def parent_joint(self, link: str) -> Joint | None:
        """Return the joint whose child is ``link``; None for the root."""
        return self._parents.get(link)

    def walk(self) -> Iterator[tuple[int, Joint]]:
        """
        Yield (depth, joint) from the root down, parents before children; depth is 1 at the root.

        Each link is visited once, also if the tree is unsound; joints to unknown links are left
        out.
        """
        seen = {link.name for link in self.roots}
        for root in self.roots:
            stack = [(1, joint) for joint in reversed(self.child_joints(root.name))]
            while stack:
                depth, joint = stack.pop()
                if joint.child in seen or joint.child not in self._links:
                    continue
                seen.add(joint.child)
                yield depth, joint
                below = reversed(self.child_joints(joint.child))
                stack.extend((depth + 1, next_joint) for next_joint in below)


def held_without_commands(robot: Robot) -> tuple[str, ...]:
    """
    Return the joints of a robot that nobody commands which the simulator holds where they begin.

    They are those with a motor, by their effort limit, of a robot that stands on the ground and
    has nothing that turns on and on: a legged one stays up. All others are free, as in Gazebo.
    """
    if robot.root.name == WORLD_LINK or any(
        joint.type is JointType.CONTINUOUS for joint in robot.joints
    ):
        return ()
    return tuple(
        joint.name
        for joint in robot.joints
        if joint.type in (JointType.REVOLUTE, JointType.PRISMATIC)
        and joint.mimic is None
        and joint.limit is not None
        and joint.limit.effort > 0.0
    )


def _lookup(parts: dict[str, Part], name: str, kind: str, source: str) -> Part:
    if name not in parts:
        known = quote_all([*reversed(parts)])
        raise DescriptionError(f'{source}: there is no {kind} {quote(name)}; there are: {known}')
    return parts[name]
