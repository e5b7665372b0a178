# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The plugins of ``<gazebo>`` blocks that are no sensors: what each is, and what it says.

A robot made for Gazebo names a plugin by its library, its class, or both::

    Gazebo Classic   filename="libgazebo_ros_diff_drive.so"
    new Gazebo       filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive"
                     filename="libignition-gazebo-diff-drive-system.so" …

:func:`kind_of` gives all of them one name, such as ``diff-drive``; what it becomes is said in
:mod:`amr_description.model.gazebo.translation`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
import math
import re

from lxml import etree

from amr_description.model.gazebo.tags import GazeboPlugin
from amr_description.model.xml_reader import line_of, parse_number
from amr_description.text import quote, truth

SIZES = (1e-3, 100.0)
"""m, of wheels and between them; the controllers have the same bounds."""
CLASSIC = 'gazebo-ros-'
"""What the kinds of Gazebo Classic's ROS plugins begin with."""

_WORLD_MATTERS = (
    'air-pressure',
    'air-speed',
    'altimeter',
    'contact',
    'force-torque',
    'forcetorque',
    'imu',
    'logical-camera',
    'magnetometer',
    'nav-sat',
    'navsat',
    'physics',
    'scene-broadcaster',
    'sensors',
    'user-commands',
    'gazebo-ros-factory',
    'gazebo-ros-init',
    'gazebo-ros-state',
)
"""Kinds of plugins that every world has, or that serve sensors."""

_LIBRARY = re.compile(r'(?:lib)?(?:gz-sim|ignition-gazebo)\d*-(?P<kind>[a-z0-9-]+?)-system\d*')
_CLASS = re.compile(r'(?:gz::sim|ignition::gazebo)(?:::v\d+)?::systems::(?P<kind>\w+)')
_CAPITAL = re.compile(r'(?<=[a-z0-9])(?=[A-Z])')


def kind_of(filename: str, name: str) -> str:
    """
    Return the kind of a plugin: ``diff-drive``, ``gazebo-ros-diff-drive``; '' for another one.

    Args:
        filename: of the library, with or without folder, ``lib`` and ``.so``.
        name: of the plugin, in new Gazebo its class.
    """
    if found := _CLASS.fullmatch(name.strip()):
        return _CAPITAL.sub('-', found['kind']).lower()
    library = filename.strip().rpartition('/')[2].removesuffix('.so')
    if found := _LIBRARY.fullmatch(library):
        return found['kind']
    kind = library.removeprefix('lib').replace('_', '-')
    return kind if kind.startswith(CLASSIC) else ''


@dataclass(frozen=True, slots=True)
class PluginTag:
    """The element of a plugin that gives a parameter of the controller that stands for it."""

    name: str
    line: int
    per: float = 1.0
    """What is written, by what it means: 2 for a diameter that gives a radius."""
    also: str = ''
    """Another element, of which the parameter is made, too."""

    @property
    def text(self) -> str:
        """What messages call it."""
        return f'<{self.name}>{f" and <{self.also}>" if self.also else ""}'

    def written(self, value: float) -> str:
        """Return how it is to be written for a value of the parameter."""
        if self.also:
            return f'{self.text} of {value * self.per:.4g} in all'
        return f'<{self.name}>{value * self.per:.4g}</{self.name}>'


@dataclass(frozen=True, slots=True)
class PluginElement:
    """
    A ``<plugin>`` of a ``<gazebo>`` block, and its parameters.

    A parameter may have several names, of which the first that is there counts: those of ROS 1 are
    still in many files. One that cannot be read is as if it were not there, and is noted.
    """

    element: etree._Element
    notes: list[str] = field(default_factory=list)
    faults: list[tuple[int, str]] = field(default_factory=list)
    """Lines, and why a plugin that begins there, or has an element there, is left out."""

    @property
    def kind(self) -> str:
        """See :func:`kind_of`."""
        return kind_of(self.filename, self.name)

    @property
    def filename(self) -> str:
        """The library, as written."""
        return self.element.get('filename', '').strip()

    @property
    def name(self) -> str:
        """The name of the plugin, as written."""
        return self.element.get('name', '').strip()

    @property
    def is_classic(self) -> bool:
        """Whether it is one of Gazebo Classic's ROS plugins."""
        return self.kind.startswith(CLASSIC)

    @property
    def library(self) -> str:
        """The file name of the library, without its folder."""
        return self.filename.rpartition('/')[2]

    @property
    def is_world_matter(self) -> bool:
        """
        Whether it only hosts ros2_control, or has Gazebo simulate what is named elsewhere.

        A sensor that such a plugin serves is named by itself.
        """
        hosts = GazeboPlugin(self.filename, self.name, 0).hosts_ros2_control
        return hosts or self.kind in _WORLD_MATTERS

    def texts(self, *names: str) -> list[str]:
        """Return the texts of all elements of a name, without empty ones."""
        for name in names:
            found = [(each.text or '').strip() for each in self.element.iterchildren(name)]
            if any(found):
                return [text for text in found if text]
        return []

    def text(self, *names: str, default: str = '') -> str:
        """Return one text."""
        return next(iter(self.texts(*names)), default)

    def numbers(self, *names: str) -> list[float]:
        """Return the numbers of all elements of a name; inf and nan, with a sign, are numbers."""
        return [value for text in self.texts(*names) for value in self._number(names[0], text)]

    def number(self, *names: str, default: float) -> float:
        """Return one number."""
        return next(iter(self.numbers(*names)), default)

    def sizes(self, *names: str, default: float, per: float = 1.0) -> list[float]:
        """
        Return what elements of a name give as a size, m; empty, and a fault, if one is none.

        Args:
            names: of the elements, the first that is there counts.
            default: where there is none, in what is returned.
            per: what is written, by what is returned: 2 for a diameter that gives a radius.
        """
        found: list[float] = []
        tag = next((name for name in names if self.texts(name)), names[0])
        for each in self.element.iterchildren(tag):
            if text := (each.text or '').strip():
                found.append(parse_number(text) / per)
                if not SIZES[0] <= found[-1] <= SIZES[1]:
                    least, most = (per * bound for bound in SIZES)
                    said = f'<{tag}> is {quote(text)}; a number from {least:g} to {most:g} m'
                    self.fail(f'{said} will do', line_of(each))
                    return []
        return found or [default]

    def vector(self, *names: str) -> tuple[float, float, float]:
        """Return three numbers; zeros if there are not three, finite ones."""
        values = [parse_number(word) for word in self.text(*names).split()]
        if len(values) != 3 or not all(map(math.isfinite, values)):
            if values:
                self.note(f'<{names[0]}> is {quote(self.text(*names))}; 0 0 0 is taken')
            return 0.0, 0.0, 0.0
        x, y, z = values
        return x, y, z

    @property
    def line(self) -> int:
        """On which it begins."""
        return line_of(self.element)

    def tag(self, *names: str, per: float = 1.0, also: str = '') -> PluginTag:
        """Return the element that gives a number, or would: then the line is the plugin's."""
        found = (each for name in names for each in self.element.iterchildren(name))
        first = next(found, None)
        if first is None:
            return PluginTag(names[0], self.line, per, also)
        return PluginTag(str(first.tag), line_of(first), per, also)

    def flag(self, *names: str, default: bool) -> bool:
        """Return a truth value: true or false, 1 or 0."""
        text = self.text(*names)
        if not text:
            return default
        value = truth(text.lower())
        if value is None:
            self.note(f'<{names[0]}> is {quote(text)}; {str(default).lower()} is taken')
            return default
        return value

    def topic(self, base: str, *names: str) -> str:
        """
        Return the topic of one of Gazebo Classic's plugins.

        Args:
            base: as the plugin calls it, such as ``odom`` or ``~/out``.
            names: elements that name another; those of ROS 1.
        """
        rules = [
            (each.text or '').strip().partition(':=')
            for each in self.element.iterfind('ros/*')
            if each.tag in ('remapping', 'argument')
        ]
        for before, sign, after in rules:
            if sign and before.strip().lstrip('/').rpartition(' ')[2] == base:
                return after.strip() or base
        named = self.text(*names) if names else ''
        return named or base

    @property
    def namespace(self) -> str:
        """The namespace of its topics, without slashes at its ends; ROS 1's too."""
        text = self.element.findtext('ros/namespace') or self.text('robotNamespace')
        return text.strip().strip('/')

    def note(self, text: str) -> None:
        """Note what is to be said of it."""
        self.notes.append(f'plugin {quote(self.name or self.filename)}: {text}')

    def fail(self, text: str, line: int = 0) -> None:
        """Note that it cannot work, and why; ``line``: of an element, 0: its own."""
        self.note(f'it cannot work: {text}')
        self.faults.append((line or self.line, self.notes[-1]))

    def _number(self, name: str, text: str) -> Iterator[float]:
        word = text.lower().lstrip('+')
        value = float(word) if word.lstrip('-') in ('inf', 'nan') else parse_number(text)
        if math.isnan(value) and 'nan' not in word:
            self.note(f'<{name}> is {quote(text)}, which is no number; its default is taken')
        else:
            yield value


def plugins_of(
    xml: etree._Element, notes: list[str], faults: list[tuple[int, str]] | None = None
) -> Sequence[PluginElement]:
    """Return the plugins of ``<gazebo>`` blocks, without those of sensors; they fill the lists."""
    faults = [] if faults is None else faults
    return [
        PluginElement(each, notes, faults)
        for gazebo in xml.iterchildren('gazebo')
        for each in gazebo.iterchildren('plugin')
    ]


def sensors_of(xml: etree._Element) -> Sequence[tuple[etree._Element, str]]:
    """Return the sensors of ``<gazebo>`` blocks, and the link that each is mounted on."""
    return [
        (each, gazebo.get('reference', ''))
        for gazebo in xml.iterchildren('gazebo')
        for each in gazebo.iterchildren('sensor')
    ]
