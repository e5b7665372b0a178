# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Any topic, of each message of which pages plot some numbers."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from rclpy.node import Node

from amr_description.cdr.fields import FieldReader, NOT_THERE, part_at, steps_of, why_no_number
from amr_description.cdr.layouts import FieldGroup, Many, Number, Text
from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError
from amr_description.ros.layouts import layout_of
from amr_description.ros.message_types import message_type
from amr_description.ros.polled_topic import NumberedMessage
from amr_description.text import shorten
from amr_description.viewer.protocol import Origin, Values
from amr_description.viewer.ros.forms import constants_of
from amr_description.viewer.ros.message_feed import unreadable
from amr_description.viewer.ros.source import SourceTopic, TopicSource
from amr_description.viewer.ros.topic_rate import Rate
from amr_description.viewer.samples import encode_sample

_DEPTH = 250
"""Messages that DDS keeps until the next poll: a quarter of a second of the fastest topics."""
_DEPTH_LARGE = 10
"""… of messages with octets: pictures, clouds."""
_MOST = 500
"""Messages of one poll; the rest is for the next one."""
_PERIOD = 1 / 15
"""s between two samples, at least: each costs more than a message of it."""
_AGAIN = 2.0
"""s until a page is told once more why there are no values."""
_TRUTHS = {'0': 'false', '1': 'true'}
_SMALL = {'int8', 'uint8', 'octet', 'char'}
"""What enumerations usually are: of others only constants count that have the field's name."""
_NO_ENUMERATIONS = {'float', 'double', 'long double'}
_MOST_TEXTS = 100
"""Of a field that have a value of their own; of more, the rest has one together."""
_STAMP = ('header.stamp.sec', 'header.stamp.nanosec')


class StateNames:
    """The names of the values at a path of messages, by the values as texts; '': none."""

    def __init__(self, layout: FieldGroup, path: str) -> None:
        steps = steps_of(layout, path)
        part = part_at(layout, steps)
        self.is_text = isinstance(part, Text)
        self.names: dict[str, str] = {}
        self._values: dict[str, float] = {}
        if isinstance(part, Number) and part.name == 'boolean':
            self.names = _TRUTHS
        elif isinstance(part, Number) and part.name not in _NO_ENUMERATIONS:
            group = part_at(layout, steps[:-1])
            name = str(steps[-1])
            if isinstance(group, FieldGroup):
                self.names = _names_of_constants(group, name, is_small=part.name in _SMALL)

    def value_of(self, text: str) -> float:
        """Return the number that stands for a text."""
        if (known := self._values.get(text)) is not None:
            return known
        value = float(min(len(self._values), _MOST_TEXTS))
        if value < _MOST_TEXTS:
            self._values[text] = value
        self.names = {**self.names, f'{value:g}': shorten(text) if value < _MOST_TEXTS else '…'}
        return value


_NO_STATES: Mapping[str, StateNames] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Fields:
    """The paths that are plotted, and what reads them; replaced as a whole."""

    paths: tuple[str, ...]
    faults: dict[str, str]
    """Why there is no number at a path."""
    read: Callable[[bytes], list[float]]
    """Returns the numbers, in the order of the paths; the first two are those of the stamp."""
    states: dict[str, StateNames]
    """The names of the values of those that have any."""

    @property
    def names(self) -> dict[str, dict[str, str]]:
        """By the path of a state, the names of its values, as known now."""
        return {path: each.names for path, each in self.states.items() if each.names}


class FieldFeed:
    """One topic; made and destroyed on the ROS thread, polled on the server's thread."""

    def __init__(
        self, node: Node, source: TopicSource, receive_time: Callable[[int], float]
    ) -> None:
        """
        Subscribe.

        Args:
            node: That subscribes.
            source: The topic.
            receive_time: Returns the time of the states, s, for a system time, ns.
        """
        self._source = source
        self._receive_time = receive_time
        self._topic: SourceTopic | None = None
        self._fault: bytes | None = None
        self._due = 0.0
        self._type: Any = None
        self._fields: Fields | None = None
        self._rate = Rate()
        self._last: int | None = None
        """The number of the last message, by DDS."""
        self._next = 0
        """The number of the next one, as pages are told."""
        self._stamp = -np.inf
        try:
            self._type = source.message_type()
            depth = _DEPTH_LARGE if _is_large(layout_of(self._type)) else _DEPTH
            self._topic = SourceTopic(node, source, self._type, depth)
        except AmrError as error:
            self._fault = unreadable(source.topic, 'values', str(error))

    def set_paths(self, paths: Iterable[str]) -> None:
        """Plot these from now on."""
        wanted = tuple(sorted(paths))
        if self._topic is not None and (self._fields is None or self._fields.paths != wanted):
            known = {} if self._fields is None else self._fields.states
            self._fields = fields_of(self._type, wanted, known)

    def take(self, now: float, *, is_wanted: bool) -> bytes | None:  # noqa: ARG002
        """Return a sample of all new messages; None: there are none."""
        topic, fields = self._topic, self._fields
        if now < self._due:
            return None
        if self._fault is not None:
            self._due = now + _AGAIN
            return self._fault
        self._due = now + _PERIOD
        if topic is None or fields is None:
            return None
        rows: list[tuple[int, list[float]]] = []
        lost, last = 0, None
        for last in self._messages(topic):
            lost += self._lost_before(last)
            try:
                rows.append((last.received, fields.read(last.data)))
            except ValueError:  # it is broken
                lost += 1
        if last is None:
            return None
        self._rate.add(last if self._source.is_alone else last._replace(number=None), len(rows))
        first, self._next = self._next + lost, self._next + lost + len(rows)
        return self._sample(fields, rows, first) if rows else None

    def settle(self) -> None:
        """See :meth:`SourceTopic.settle`."""
        if self._topic is not None:
            self._topic.settle()

    def destroy(self) -> None:
        """Unsubscribe."""
        if self._topic is not None:
            self._topic.destroy()

    def _messages(self, topic: SourceTopic) -> Iterator[NumberedMessage]:
        for _ in range(_MOST):
            if (message := topic.take_numbered()) is None:
                return
            yield message

    def _lost_before(self, message: NumberedMessage) -> int:
        """Return how many messages did not come before this one, as far as DDS tells."""
        before, self._last = self._last, message.number
        if before is None or message.number is None or not self._source.is_alone:
            return 0
        return max(0, message.number - before - 1)

    def _sample(self, fields: Fields, rows: list[tuple[int, list[float]]], first: int) -> bytes:
        table = np.array([values for _, values in rows], '<f8')
        stamps = table[:, 0] + table[:, 1] / NANOSECONDS
        for row, (received, _) in enumerate(rows):
            if not stamps[row]:
                self._stamp = stamps[row] = max(self._stamp, self._receive_time(received))
        count, path_count = len(rows), len(fields.paths)
        head = Values(
            Origin(self._source.topic, '', float(stamps[-1]), self._rate.value),
            fields.paths,
            count,
            first,
            fields.faults,
            fields.names,
        )
        columns = np.ascontiguousarray(table[:, 2 : 2 + path_count].T)
        return encode_sample(head, [stamps, columns])


def fields_of(
    message_class: Any, paths: tuple[str, ...], known: Mapping[str, StateNames] = _NO_STATES
) -> Fields:
    """
    Return what reads these paths of the messages of a class; those that lead nowhere, too.

    ``known``: the names of states of before, whose texts keep their numbers.
    """
    layout = layout_of(message_class)
    faults = {path: why for path in paths if (why := why_no_number(layout, path, or_text=True))}
    stamp = () if why_no_number(layout, _STAMP[0]) else _STAMP
    good = [path for path in paths if path not in faults]
    states = {path: known.get(path) or StateNames(layout, path) for path in good}
    read = FieldReader(layout, (*stamp, *good)).read
    texts = [(2 + paths.index(path), states[path]) for path in good if states[path].is_text]
    if stamp and not faults and not texts:
        return Fields(paths, {}, read, states)
    places = [2 + paths.index(path) for path in good]
    nothing: list[Any] = [0.0, 0.0, *(NOT_THERE for _ in paths)]

    def read_and_place(data: bytes) -> list[float]:
        values, found = nothing.copy(), read(data)
        values[: len(stamp)] = found[: len(stamp)]
        for place, value in zip(places, found[len(stamp) :], strict=True):
            values[place] = value
        for place, state in texts:
            if isinstance(values[place], str):
                values[place] = state.value_of(values[place])
        return values

    return Fields(paths, faults, read_and_place, states)


def _is_large(layout: FieldGroup) -> bool:
    """Return whether messages have octets, as pictures and clouds do."""
    return any(
        isinstance(field, Many) and isinstance(field.element, Number) and field.element.size == 1
        for _, field in layout.fields
    )


def _names_of_constants(group: FieldGroup, name: str, *, is_small: bool) -> dict[str, str]:
    found = constants_of(message_type(group.name), group, name)
    names: dict[str, str] = {}
    for constant, value in found.items():
        is_own = constant.startswith(f'{name.upper()}_')
        if isinstance(value, int) and (is_own or is_small):
            names.setdefault(str(value), constant)
    return names
