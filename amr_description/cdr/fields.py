# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Some parts of messages of any type, read without making messages of them.

rclpy builds a Python object for every field: 60 µs for an Odometry, of which a picture needs ten
numbers. A :class:`FieldReader` is made once for a layout and some paths, as ``ros2 topic echo
--field`` and PlotJuggler write them, and takes 2 µs for ten numbers:

====================== ==========================================================================
``twist.linear.x``     a number; a truth is 0 or 1
``header.frame_id``    a string
``position[2]``        of one element; if there is none, NaN
``name[]``             of each element, in a list
``transforms[].x[].y`` of each element of each, in a list of lists
``ranges``             numbers of an array: a NumPy view of the message, without a copy
``points``             messages of nothing but numbers of one type: a view, a row each
====================== ==========================================================================

Where the parts stand depends on nothing but the lengths of the strings and sequences before them.
So a reader goes through a message once, and then reads all that have the same lengths by one
``struct``.

Little is believed: bytes that end too early raise ValueError, as do strings that are no UTF-8;
what the numbers say is for the caller to check. What follows the last part is not looked at.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from operator import itemgetter
import re
import struct
from typing import Any, TypeAlias

import numpy as np

from amr_description.cdr.cursor import BEGIN, Cursor, ORDERS
from amr_description.cdr.layouts import FieldGroup, Layout, Many, Number, Text
from amr_description.errors import AmrError
from amr_description.text import did_you_mean, shorten

NOT_THERE = float('nan')
"""The value of an element that a sequence does not have."""
MOST_PARTS = 200_000
"""Of one message: numbers, strings and arrays. More are refused."""
_STEP = re.compile(r'\.?([A-Za-z]\w*)|\[(\d{0,9})\]')
_LONG = 128
"""Bytes of a string that is no name, but a text."""
_MOST_SHAPES = 8
"""Of messages that take turns, such as those of several publishers of ``/tf``."""

Step: TypeAlias = str | int | None
"""A field, an element, or each element."""
Found: TypeAlias = 'int | list[Found]'
"""Which of the parts a value is, or those of its elements."""


class FieldReader:
    """Reads the parts at some paths."""

    def __init__(self, layout: FieldGroup, paths: Sequence[str]) -> None:
        """
        Prepare to read messages of a layout.

        Raises AmrError: one of the paths leads to no number, string or array of numbers.
        """
        self._layout = layout
        self._wanted = _Wanted()
        values: dict[str, int] = {}
        for path in paths:
            values.setdefault(path, len(values))
        for path, value in values.items():
            self._wanted.add(steps_of(layout, path), value)
        self._order = [values[path] for path in paths]
        self._shapes: list[_Shape] = []
        self._size = -1
        """Of the last message that has been walked through, bytes."""

    def read(self, data: bytes) -> list[Any]:
        """Return the values of a message. Raises ValueError: it is broken."""
        for shape in self._shapes:
            if (values := shape.read(data)) is not None:
                return values
        try:
            walk = _Walk(data, self._layout, self._wanted)
            # What comes once, as contacts and paths do, is read faster than a struct is made.
            if len(data) != self._size:
                self._size = len(data)
                parts = walk.parts()
                return [_take(parts, walk.found.get(each, [])) for each in self._order]
            shape = _Shape(walk, self._order)
        except struct.error as error:
            raise ValueError(f'{len(data)} bytes end within a message: {error}') from None
        self._shapes = [shape, *self._shapes[: _MOST_SHAPES - 1]]
        return shape.values(data)


def why_no_number(layout: FieldGroup, path: str, *, or_text: bool = False) -> str:
    """Return why messages have no single number (or text) at a path, in a line; '': they have."""
    try:
        steps = steps_of(layout, path)
    except AmrError as error:
        return str(error)
    if None in steps:
        return _no_path(path)
    part = part_at(layout, steps)
    fits = isinstance(part, Number) or (or_text and isinstance(part, Text))
    return '' if fits else f"'{shorten(path)}' is no number, but {_kind(part)}"


def steps_of(layout: FieldGroup, path: str) -> list[Step]:
    """Return the steps of a path to a part that can be read. Raises AmrError."""
    steps: list[Step] = []
    part: Layout = layout
    at = 0
    while at < len(path):
        step = _STEP.match(path, at)
        if step is None or path.startswith('.', at) != bool(at and step[1]):
            raise AmrError(_no_path(path))
        part = _below(part, step, shorten(path[:at]))
        steps.append(step[1] or (int(step[2]) if step[2] else None))
        at = step.end()
    is_array = isinstance(part, Many) and row_of(part.element) is not None
    is_text = isinstance(part, Text) and not part.is_wide
    if not steps or not (is_array or is_text or isinstance(part, Number)):
        raise AmrError(f"'{shorten(path)}' is no number, but {_kind(part)}")
    return steps


def part_at(layout: Layout, steps: Iterable[Step]) -> Layout:
    """Return the layout of the part that steps lead to."""
    for step in steps:
        found = layout.field(str(step)) if isinstance(layout, FieldGroup) else None
        layout = layout.element if isinstance(layout, Many) else found or layout
    return layout


def row_of(layout: Layout) -> tuple[Number, int] | None:
    """Return the type of all numbers of a part, and how many there are; None: it has others."""
    match layout:
        case Number():
            return layout, 1
        case FieldGroup(fields=fields) if fields:
            rows = [row_of(each) for _, each in fields]
            first = rows[0]
            if first is None or any(each is None or each[0] != first[0] for each in rows):
                return None
            return first[0], sum(each[1] for each in rows if each is not None)
        case _:
            return None


def _no_path(path: str) -> str:
    return f"'{shorten(path)}' is no path to a field, such as a.b[2].c"


def _below(layout: Layout, step: re.Match[str], before: str) -> Layout:
    name, index = step[1], step[2]
    if name is not None and isinstance(layout, FieldGroup):
        if (found := layout.field(name)) is not None:
            return found
        names = [field for field, _ in layout.fields]
        known = did_you_mean(name, names) or f'; there are: {", ".join(names) or "none"}'
        raise AmrError(f"{layout.name} has no field '{shorten(name)}'{known}")
    if index is not None and isinstance(layout, Many):
        if index and layout.count is not None and int(index) >= layout.count:
            raise AmrError(f"'{before}' has {layout.count} elements; there is no [{index}]")
        return layout.element
    what = f'a field {shorten(name)}' if name is not None else f'an element [{index}]'
    raise AmrError(f"'{before}' is {_kind(layout)}, without {what}")


def _kind(layout: Layout) -> str:
    match layout:
        case Number(name=name):
            return f'a number ({name})'
        case Text():
            return 'a string'
        case FieldGroup(name=name):
            return f'a message ({name})'
        case Many(count=None):
            return 'a sequence'
        case _:
            return 'an array'


@dataclass(slots=True)
class _Wanted:
    """What is wanted of a part."""

    values: list[int] = field(default_factory=list)
    """Which values are the part, or in it."""
    whole: list[int] = field(default_factory=list)
    """Which of them are the part itself."""
    fields: dict[str, '_Wanted'] = field(default_factory=dict)
    elements: dict[int, '_Wanted'] = field(default_factory=dict)
    each: '_Wanted | None' = None

    def add(self, steps: Sequence[Step], value: int) -> None:
        """Want what the steps lead to as this value."""
        self.values.append(value)
        match steps:
            case []:
                self.whole.append(value)
            case [str(name), *rest]:
                self.fields.setdefault(name, _Wanted()).add(rest, value)
            case [int(index), *rest]:
                self.elements.setdefault(index, _Wanted()).add(rest, value)
            case [_, *rest]:
                self.each = self.each or _Wanted()
                self.each.add(rest, value)


class _Walk(Cursor):
    """
    Goes through a message, and notes where the wanted parts stand.

    Attributes:
        places: Of all parts but arrays: place, and code of ``struct``.
        arrays: Place, type and count of each.
        found: Which parts each value is: an only one, or none, or a list; arrays count from -1
            downwards.
    """

    def __init__(self, data: bytes, layout: FieldGroup, wanted: _Wanted) -> None:
        """Raises ValueError, struct.error: the bytes are no such message."""
        super().__init__(data)
        self.places: list[tuple[int, str]] = []
        self._parts: dict[tuple[int, str], int] = {}
        self.arrays: list[tuple[int, np.dtype[Any], int]] = []
        self.found: dict[int, list[Found]] = {value: [] for value in wanted.values}
        if wanted.values:
            self._walk(layout, wanted, self.found, is_last=True)

    def parts(self) -> list[Any]:
        """Return all parts; raises struct.error, ValueError."""
        order, data = ORDERS[self.order], self.data
        made = [
            struct.unpack_from(f'{order}{code}', data, BEGIN + at)[0] for at, code in self.places
        ]
        return [*made, *_views(data, self.arrays)]

    def _walk(
        self,
        layout: Layout,
        wanted: _Wanted | None,
        into: dict[int, list[Found]],
        *,
        is_last: bool,
    ) -> None:
        """Go behind a part; of the last one, only to the last of what is wanted."""
        if wanted is None:
            self.skip(layout)
            return
        if wanted.whole:
            begin, part = self.at, self._note(layout)
            for value in wanted.whole:
                into[value].append(part)
            if len(wanted.whole) == len(wanted.values):
                return
            self.at = begin
        if isinstance(layout, FieldGroup):
            last = [name for name, _ in layout.fields if name in wanted.fields][-1]
            for name, part_layout in layout.fields:
                ends = is_last and name == last
                self._walk(part_layout, wanted.fields.get(name), into, is_last=ends)
                if ends:
                    return
        else:
            assert isinstance(layout, Many), 'as its path was found'
            self._walk_through(layout, wanted, into, is_last=is_last)

    def _note(self, layout: Layout) -> int:
        """Note a part that is wanted, and go behind it; return which it is."""
        if len(self.places) + len(self.arrays) >= MOST_PARTS:
            raise ValueError(f'{len(self.data)} bytes have more than {MOST_PARTS} parts')
        match layout:
            case Number():
                place = self.align(layout), layout.code
                self.at += layout.size
            case Text():
                size = self.count()
                place = self.at, f'{size}s'
                self.go(size)
            case Many(element=element, count=count) if (row := row_of(element)) is not None:
                number, width = row
                count = self.count() if count is None else count
                dtype = np.dtype(f'{ORDERS[self.order]}{number.code}')
                if not isinstance(element, Number):
                    dtype = np.dtype((dtype, (width,)))
                self.arrays.append((self.align(number) if count else self.at, dtype, count))
                self.go(count * width * number.size)
                return -len(self.arrays)
            case _:
                raise AssertionError(layout)
        if place not in self._parts:  # else it is wanted by another path, too
            self._parts[place] = len(self.places)
            self.places.append(place)
        return self._parts[place]

    def _walk_through(
        self, layout: Many, wanted: _Wanted, into: dict[int, list[Found]], *, is_last: bool
    ) -> None:
        count = self.count() if layout.count is None else layout.count
        each = wanted.each
        lists: dict[int, list[Found]] = {} if each is None else {n: [] for n in each.values}
        for value, parts in lists.items():
            into[value].append(parts)
        if each is None:
            self._walk_to(layout.element, wanted.elements, count, into, is_last=is_last)
            return
        if count > len(self.data):
            raise ValueError(f'{len(self.data)} bytes cannot have {count} elements')
        for index in range(count):
            begin = self.at
            if index in wanted.elements:
                self._walk(layout.element, wanted.elements[index], into, is_last=False)
                self.at = begin
            self._walk(layout.element, each, lists, is_last=False)

    def _walk_to(
        self,
        element: Layout,
        wanted: Mapping[int, _Wanted],
        count: int,
        into: dict[int, list[Found]],
        *,
        is_last: bool,
    ) -> None:
        """Go through some of so many elements."""
        indices = sorted(index for index in wanted if index < count)
        done = 0
        for index in indices:
            self.skip_elements(element, index - done)
            done = index + 1
            ends = is_last and index == indices[-1]
            self._walk(element, wanted[index], into, is_last=ends)
            if ends:
                return
        self.skip_elements(element, count - done)


class _Shape:
    """Messages with the same lengths before the wanted parts, which so have the same places."""

    def __init__(self, walk: _Walk, order: Sequence[int]) -> None:
        """
        Remember what was found on a walk. Raises struct.error: its message ends too early.

        Args:
            walk: Through one of these messages.
            order: Of the values, in which they are returned.
        """
        reads = [(at, 'I', -1) for at in dict.fromkeys(walk.counts)]
        reads += [(at, code, part) for part, (at, code) in enumerate(walk.places)]
        form, end = f'{ORDERS[walk.order]}BB', 2  # the first two bytes tell how it is encoded
        counts, places = [0, 1], {}
        for place, (at, code, part) in enumerate(sorted(reads), start=len(counts)):
            form += f'{BEGIN + at - end}x{code}'
            end = BEGIN + at + struct.calcsize(f'<{code}')
            if part < 0:
                counts.append(place)
            else:
                places[part] = place
        self._unpack = struct.Struct(form).unpack_from
        self._lengths_of = itemgetter(*counts)
        self._lengths = self._lengths_of(self._unpack(walk.data))
        self._arrays = walk.arrays
        self._texts = [places[part] for part, (_, code) in enumerate(walk.places) if 's' in code]
        self._takes = [_taker(walk.found.get(each, []), places) for each in order]

    def read(self, data: bytes) -> list[Any] | None:
        """Return the values of a message; None: its lengths are others, or it is too short."""
        try:
            found = self._unpack(data)
        except struct.error:
            return None
        return self._values_of(data, found) if self._lengths_of(found) == self._lengths else None

    def values(self, data: bytes) -> list[Any]:
        """Return the values of one of these messages. Raises ValueError."""
        return self._values_of(data, self._unpack(data))

    def _values_of(self, data: bytes, found: Sequence[Any]) -> list[Any]:
        if self._texts:
            found = [*found]
            for place in self._texts:
                found[place] = _decoded(found[place])
        if self._arrays:
            found = [*found, *_views(data, self._arrays)]
        return [take(found) for take in self._takes]


def _views(data: bytes, arrays: Sequence[tuple[int, np.dtype[Any], int]]) -> list[Any]:
    """Return arrays, the last one first."""
    return [
        np.frombuffer(data, dtype, count, BEGIN + at) if count else np.empty(0, dtype)
        for at, dtype, count in reversed(arrays)
    ]


def _decoded(octets: bytes) -> str:
    """Return a string; raises ValueError."""
    return _name(octets) if len(octets) < _LONG else octets.removesuffix(b'\0').decode()


@lru_cache(maxsize=4096)
def _name(octets: bytes) -> str:
    """Return a string that is remembered: the names in the messages of a topic are the same."""
    return octets.removesuffix(b'\0').decode()


def _take(parts: Sequence[Any], found: Sequence[Found]) -> Any:
    """Return a value of a walk."""
    return _resolved(parts, found[0]) if found else NOT_THERE


def _resolved(parts: Sequence[Any], found: Found) -> Any:
    if isinstance(found, list):
        return [_resolved(parts, each) for each in found]
    part = parts[found]
    return _decoded(part) if isinstance(part, bytes) else part


def _taker(found: Sequence[Found], places: dict[int, int]) -> Callable[[Sequence[Any]], Any]:
    """Return what takes a value out of the parts of a message."""
    return _taker_of(found[0], places) if found else lambda _: NOT_THERE


def _taker_of(found: Found, places: dict[int, int]) -> Callable[[Sequence[Any]], Any]:
    if isinstance(found, int):
        return itemgetter(places.get(found, found))
    if not all(isinstance(each, int) for each in found):
        takers = [_taker_of(each, places) for each in found]
        return lambda parts: [take(parts) for take in takers]
    which = [places.get(each, each) for each in found if isinstance(each, int)]
    if which and which == [*range(which[0], which[0] + len(which))] and which[0] >= 0:
        part = slice(which[0], which[0] + len(which))
        return lambda parts: [*parts[part]]
    return lambda parts: [parts[each] for each in which]
