# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which of several velocity commands goes on to the wheels: ``twist_mux`` without ROS.

The rules are those of twist_mux 4.5 (``topic_handle.hpp``, ``twist_mux.cpp``):

- An input is *masked* while its latest command is older than its timeout, and while a lock of a
  higher priority than its own is locked.
- A command goes on if of all inputs that are not masked its own has the highest priority; of
  equal ones, the first by name.
- A lock is locked while its latest message is true, and, if it has a timeout, while that message
  is older. So a lock whose publisher has died stops the robot.

Two things are otherwise here. What has never been heard has expired whatever the clock shows: in
the original an input that is silent outranks others until simulated time has passed its timeout.
And a message from the future, of before a reset of simulated time, has expired, too.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.errors import ParameterError
from amr_description.parameters import build, parameter, specs
from amr_description.text import closest_match

HIGHEST_PRIORITY = 255


@dataclass(frozen=True)
class ChannelParameters:
    """The parameters of an input, ``topics.NAME.…``, or of a lock, ``locks.NAME.…``."""

    topic: str = parameter('', 'Topic to subscribe to', not_empty=True)
    timeout: float = parameter(
        0.0,
        'Age above which the latest message has expired; 0: it never does',
        unit='s',
        minimum=0,
    )
    priority: int = parameter(0, 'From 0 to 255: the higher one wins')


@dataclass(frozen=True, slots=True)
class Channel:
    """An input, or a lock."""

    name: str
    """With ``topics.`` or ``locks.`` before it, as in diagnostics."""
    topic: str
    timeout: int
    """ns; 0: its messages never expire"""
    priority: int
    """0 to 255"""


@dataclass(frozen=True)
class MuxSettings:
    """What a file of twist_mux says."""

    inputs: tuple[Channel, ...]
    """By name."""
    locks: tuple[Channel, ...]
    """By name."""
    remarks: tuple[str, ...]
    """One line for each thing that is hardly meant so."""


def read_settings(values: Mapping[str, Any]) -> MuxSettings:
    """
    Return the inputs and locks of a node's parameters.

    Args:
        values: by dotted name, ``topics.navigation.topic``; others are ignored.

    Raises:
        ParameterError: a parameter is missing, or is not what it should be.
    """
    remarks: list[str] = []
    inputs = tuple(_channels('topics', values, remarks))
    locks = tuple(_channels('locks', values, remarks))
    remarks += _remarks_on(inputs)
    return MuxSettings(inputs, locks, tuple(remarks))


def _channels(group: str, values: Mapping[str, Any], remarks: list[str]) -> Iterator[Channel]:
    """Yield the channels below a prefix, by name; append to ``remarks``."""
    known = [row.name for row in specs(ChannelParameters)]
    below = [name for name in values if name.startswith(f'{group}.')]
    for prefix in sorted({name.rpartition('.')[0] for name in below}):
        if prefix == group:
            raise ParameterError(
                f"parameter '{group}' holds a table for each name, "
                f'{group}: {{NAME: {{topic: …, timeout: …, priority: …}}}}, found '
                + ', '.join(sorted(name for name in below if name.rpartition('.')[0] == group))
            )
        given = {name: values[name] for name in below if name.rpartition('.')[0] == prefix}
        others = [name for name in given if name.rpartition('.')[2] not in known]
        for row in specs(ChannelParameters, f'{prefix}.'):
            if row.name not in given:
                raise ParameterError(_missing(row.name, others))
            adopted = row.adopt(given[row.name])
            if type(adopted) is not type(given[row.name]):
                remarks.append(
                    f"parameter '{row.name}': {given[row.name]} is taken as {adopted}, which "
                    'twist_mux itself ends for: write it so'
                )
            given[row.name] = adopted
        remarks += [f"parameter '{name}' is none of twist_mux: ignored" for name in others]
        yield _channel(prefix, build(ChannelParameters, given, f'{prefix}.'), remarks)


def _missing(name: str, others: Sequence[str]) -> str:
    prefix, _, wanted = name.rpartition('.')
    meant = closest_match(wanted, [each.rpartition('.')[2] for each in others])
    found = f', found {prefix}.{meant}' if meant else ''
    return (
        f"could not load parameter '{name}'{found}: each of topics and locks has a topic, a "
        'timeout (s) and a priority (0 to 255)'
    )


def _channel(name: str, given: ChannelParameters, remarks: list[str]) -> Channel:
    priority = min(max(given.priority, 0), HIGHEST_PRIORITY)
    if priority != given.priority:
        remarks.append(
            f"parameter '{name}.priority' is {given.priority}: priorities are from 0 to "
            f'{HIGHEST_PRIORITY}, so it is {priority}'
        )
    return Channel(name, given.topic, round(given.timeout * NANOSECONDS), priority)


def _remarks_on(inputs: Sequence[Channel]) -> Iterator[str]:
    if not inputs:
        yield (
            'no topics are given, so nothing goes on to cmd_vel_out: the parameter file needs '
            'NODE_NAME: {ros__parameters: {topics: {…}}}'
        )
    for each in inputs:
        if each.priority == 0:
            yield f"parameter '{each.name}.priority' is 0: no command of it goes on; write 1"
        below = [other.name for other in inputs if other.priority < each.priority]
        if each.timeout == 0 and below:
            yield (
                f"parameter '{each.name}.timeout' is 0: its first command masks "
                f'{", ".join(below)} for good'
            )


class _Heard:
    """What has come last on a channel."""

    def __init__(self, channel: Channel) -> None:
        self.channel = channel
        self.at: int | None = None
        """ns; None: nothing was heard yet."""
        self.is_true = False
        """Of a lock."""

    def has_expired(self, now: int) -> bool:
        timeout = self.channel.timeout
        return self.at is None or (timeout > 0 and not 0 <= now - self.at <= timeout)


class TwistMux:
    """The latest of each input and lock, and who of them may command. Times are in ns."""

    def __init__(self, inputs: Iterable[Channel], locks: Iterable[Channel]) -> None:
        self._inputs = {each.name: _Heard(each) for each in inputs}
        self._locks = {each.name: _Heard(each) for each in locks}

    def hear_lock(self, name: str, is_true: bool, now: int) -> None:
        """Take a message of a lock."""
        lock = self._locks[name]
        lock.at, lock.is_true = now, is_true

    def hear_command(self, name: str, now: int) -> bool:
        """Take a command of an input; return whether it goes on to the wheels."""
        self._inputs[name].at = now
        return self.winner(now) == name

    def winner(self, now: int) -> str | None:
        """Return the input whose commands go on; None: there is none."""
        lock_priority = self.lock_priority(now)
        best, highest = None, 0  # strictly above: what has priority 0 never wins
        for name in sorted(self._inputs):
            priority = self._inputs[name].channel.priority
            if priority > highest and not self._is_masked(name, lock_priority, now):
                best, highest = name, priority
        return best

    def lock_priority(self, now: int) -> int:
        """Return the highest priority of a lock that is locked; 0: none is."""
        locked = (each for name, each in self._locks.items() if self.is_locked(name, now))
        return max((each.channel.priority for each in locked), default=0)

    def is_locked(self, name: str, now: int) -> bool:
        """Return whether a lock stops the inputs below its priority."""
        lock = self._locks[name]
        is_late = lock.channel.timeout > 0 and lock.has_expired(now)
        return lock.is_true or is_late

    def is_masked(self, name: str, now: int) -> bool:
        """Return whether an input is silent or locked."""
        return self._is_masked(name, self.lock_priority(now), now)

    def _is_masked(self, name: str, lock_priority: int, now: int) -> bool:
        found = self._inputs[name]
        return found.has_expired(now) or found.channel.priority < lock_priority

    def report(self, now: int) -> list[tuple[str, str]]:
        """Return keys and values of the diagnostics."""
        lock_priority = self.lock_priority(now)
        lines = []
        for name, each in sorted(self._inputs.items()):
            state = 'masked' if self._is_masked(name, lock_priority, now) else 'unmasked'
            lines.append((f'velocity {name}', f' {state} {_described(each.channel)}'))
        for name, each in sorted(self._locks.items()):
            state = 'locked' if self.is_locked(name, now) else 'free'
            lines.append((f'lock {name}', f' {state} {_described(each.channel)}'))
        # The original measures neither of the two: they are 0 always.
        return [
            *lines,
            ('current priority', str(lock_priority)),
            ('loop time in [sec]', '0'),
            ('data age in [sec]', '0'),
        ]


def _described(channel: Channel) -> str:
    timeout = channel.timeout / NANOSECONDS
    return f'(listening to {channel.topic} @ {timeout:f}s with priority #{channel.priority})'
