# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``<gazebo reference="…">``: what a URDF made for Gazebo says of the physics of links and joints.

A value is the text of its element or the attribute ``value``, as in sdformat: ``<mu1>0.1</mu1>``,
``<mu1 value="0.1"/>``; of two the last one counts. Plugins and sensors are read elsewhere.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
import math
from typing import Any

from lxml import etree

from amr_description.model.findings import raise_error
from amr_description.model.frames import Vector
from amr_description.model.gazebo.slip import slipping_links
from amr_description.model.origins import place_in
from amr_description.model.robot import Robot
from amr_description.model.xml_reader import line_of, parse_number, parse_xml
from amr_description.text import quote, truth


@dataclass(frozen=True, slots=True)
class GazeboLink:
    """What Gazebo is told of a link; None: nothing."""

    mu1: float | None = None
    """Sliding friction along :attr:`direction`, or in all directions."""
    mu2: float | None = None
    """Sliding friction across it."""
    direction: Vector | None = None
    """``<fdir1>``, in the frame :attr:`direction_frame`, not normalised."""
    direction_frame: str = ''
    """The link of ``expressed_in``; empty: the collision's own frame."""
    self_collides: bool = False
    """Whether it touches links of its own robot that say so too."""
    has_gravity: bool = True


@dataclass(frozen=True, slots=True)
class GazeboJoint:
    """What Gazebo is told of a joint: a spring, effort = -stiffness · (position - reference)."""

    spring_stiffness: float = 0.0
    """N·m/rad or N/m."""
    spring_reference: float = 0.0
    """rad or m."""


@dataclass(frozen=True, slots=True)
class GazeboPhysics:
    """What Gazebo is told of a robot's physics, by link and by joint; what is left out."""

    links: Mapping[str, GazeboLink] = field(default_factory=dict)
    joints: Mapping[str, GazeboJoint] = field(default_factory=dict)
    self_collides: bool = False
    """Whether all links touch each other: ``<self_collide>`` of the whole robot."""
    faults: tuple[str, ...] = ()
    """Values that are none, one line each."""
    solver: str = ''
    """One line about settings of Gazebo's solver, which has no counterpart; empty: none."""
    unknown: str = ''
    """One line about elements that are not known here; empty: none."""
    slipping: Collection[str] = ()
    """Links that Gazebo lets slip in proportion to the force."""


_MU1 = ('mu1', 'mu', 'collision/surface/friction/ode/mu')
_MU2 = ('mu2', 'collision/surface/friction/ode/mu2')
_FDIR1 = ('fdir1', 'collision/surface/friction/ode/fdir1')
_SLIP = tuple(f'{path}slip{n}' for path in ('', 'collision/surface/friction/ode/') for n in (1, 2))
_SELF_COLLIDE = ('selfCollide', 'self_collide')
_SOLVER = frozenset(
    ('kp', 'kd', 'maxVel', 'max_vel', 'minDepth', 'min_depth', 'maxContacts', 'max_contacts')
    + ('stopCfm', 'stopErp', 'stopKp', 'stopKd', 'fudgeFactor', 'cfmDamping', 'dampingFactor')
    + ('velocity_decay', 'physics', 'soft_cfm', 'soft_erp', 'dampingThreshold')
)
_READ = frozenset((*_MU1, *_MU2, *_FDIR1, *_SLIP, *_SELF_COLLIDE, 'gravity', 'turnGravityOff'))
_READ_OF_JOINTS = frozenset(('springStiffness', 'springReference'))
# Colours, what is read elsewhere, and what is so here anyway: fixed joints keep their links.
_OTHERS = frozenset(
    ('material', 'visual', 'collision', 'plugin', 'sensor', 'preserveFixedJoint')
    + ('disableFixedJointLumping', 'provideFeedback', 'implicitSpringDamper', 'laserRetro')
    + ('laser_retro', 'static', 'pose', 'transparency', 'allow_auto_disable', 'inertial')
)


def gazebo_physics_of(robot: Robot) -> GazeboPhysics:
    """Return what the ``<gazebo>`` blocks of a robot say of its physics."""
    root = parse_xml(robot.text, robot.source, raise_error)
    assert root is not None, 'raise_error does not return from an error'
    reader = _PhysicsReader(robot, slipping_links(root))
    for block in root.iterchildren('gazebo'):
        reader.read(block)
    return reader.result()


class _PhysicsReader:
    """Reads one block after the other."""

    def __init__(self, robot: Robot, slipping: Iterable[str]) -> None:
        self._robot = robot
        self._links: dict[str, GazeboLink] = {}
        self._joints: dict[str, GazeboJoint] = {}
        self._faults: list[str] = []
        self._self_collides = False
        self._slipping = {*slipping}
        self._solver: dict[str, int] = {}
        self._unknown: dict[str, int] = {}

    def read(self, block: etree._Element) -> None:
        """Read a ``<gazebo>``; one that refers to nothing is left out, which the checker says."""
        name = block.get('reference')
        if name is None:
            self._self_collides |= self._truth(block, _SELF_COLLIDE, 'the robot', default=False)
            return
        if self._robot.has_link(name):
            self._read_link(block, name)
        if self._robot.has_joint(name):
            self._read_joint(block, name)
        if self._robot.has_link(name) or self._robot.has_joint(name):
            self._count(block)

    def result(self) -> GazeboPhysics:
        """Return what was read."""
        return GazeboPhysics(
            links=self._links,
            joints=self._joints,
            self_collides=self._self_collides,
            faults=tuple(self._faults),
            solver=self._line(
                self._solver,
                "set contacts and stops of Gazebo's solver; this one has its own",
            ),
            unknown=self._line(self._unknown, 'are not known here, and are left out'),
            slipping=frozenset(self._slipping),
        )

    def _line(self, counts: Mapping[str, int], what: str) -> str:
        if not counts:
            return ''
        tags = ', '.join(f'<{tag}> ({count})' for tag, count in sorted(counts.items()))
        return f'{self._robot.source}: {tags} of <gazebo> {what}'

    def _read_link(self, block: etree._Element, name: str) -> None:
        values: dict[str, Any] = {}
        owner = f'link {quote(name)}'
        for key, tags in (('mu1', _MU1), ('mu2', _MU2)):
            number = self._number(block, tags, owner, least=0.0)
            if number is not None:
                values[key] = number
        found = _last(block, _FDIR1)
        if found is not None:
            values.update(self._direction(found, owner))
        if _last(block, _SELF_COLLIDE) is not None:
            values['self_collides'] = self._truth(block, _SELF_COLLIDE, owner, default=False)
        if _last(block, ('gravity',)) is not None:
            values['has_gravity'] = self._truth(block, ('gravity',), owner, default=True)
        if _last(block, ('turnGravityOff',)) is not None:
            values['has_gravity'] = not self._truth(
                block, ('turnGravityOff',), owner, default=False
            )
        slips = [parse_number(_text(found)) for tag in _SLIP for found in block.findall(tag)]
        if any(slip > 0.0 for slip in slips):
            self._slipping.add(name)
        if values:
            self._links[name] = replace(self._links.get(name, GazeboLink()), **values)

    def _read_joint(self, block: etree._Element, name: str) -> None:
        owner = f'joint {quote(name)}'
        stiffness = self._number(block, ('springStiffness',), owner, least=0.0)
        reference = self._number(block, ('springReference',), owner, least=-math.inf)
        if stiffness is not None or reference is not None:
            old = self._joints.get(name, GazeboJoint())
            self._joints[name] = GazeboJoint(
                old.spring_stiffness if stiffness is None else stiffness,
                old.spring_reference if reference is None else reference,
            )

    def _direction(self, found: etree._Element, owner: str) -> Iterator[tuple[str, Any]]:
        numbers = [parse_number(word) for word in _text(found).split()]
        if len(numbers) != 3 or not all(map(math.isfinite, numbers)) or not any(numbers):
            self._fault(found, owner, 'three numbers that are not all 0')
            return
        yield 'direction', tuple(numbers)
        for attribute, frame in found.attrib.items():
            # sdformat has it in a namespace: gz:expressed_in, ignition:expressed_in.
            if etree.QName(attribute).localname.endswith('expressed_in'):
                yield 'direction_frame', frame.strip()

    def _number(
        self, block: etree._Element, tags: tuple[str, ...], owner: str, *, least: float
    ) -> float | None:
        found = _last(block, tags)
        if found is None:
            return None
        number = parse_number(_text(found))
        if number >= least:
            return number
        self._fault(found, owner, 'a number' if least else 'a number from 0 on')
        return None

    def _truth(
        self, block: etree._Element, tags: tuple[str, ...], owner: str, *, default: bool
    ) -> bool:
        found = _last(block, tags)
        if found is None:
            return default
        value = truth(_text(found).lower())
        if value is None:
            self._fault(found, owner, 'true or false')
        return default if value is None else value

    def _fault(self, found: etree._Element, owner: str, needed: str) -> None:
        place = place_in(self._robot.text, self._robot.source, line_of(found))
        self._faults.append(
            f'{place}: <{found.tag}> of {owner} is "{_text(found)}"; {needed} is needed, and it '
            'is left out'
        )

    def _count(self, block: etree._Element) -> None:
        is_joint = self._robot.has_joint(block.get('reference', ''))
        read = _READ | _READ_OF_JOINTS if is_joint else _READ
        for child in block.iterchildren(etree.Element):
            if child.tag in read or child.tag in _OTHERS:
                continue
            counts = self._solver if child.tag in _SOLVER else self._unknown
            counts[child.tag] = counts.get(child.tag, 0) + 1


def _last(block: etree._Element, tags: tuple[str, ...]) -> etree._Element | None:
    """Return the last element of the first of ``tags`` that a block has."""
    return next((found[-1] for tag in tags if (found := block.findall(tag))), None)


def _text(element: etree._Element) -> str:
    return (element.get('value') or element.text or '').strip()
