# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Velocity commands: who sends them, what they say, and what the drives take.

Times are integer ns, velocities m/s and rad/s.
"""

from dataclasses import dataclass

from amr_description.clock import NANOSECONDS


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandSeen:
    """A command."""

    received: int
    """Of the system clock of the machine that listens."""
    publisher: str = ''
    """The node that sent it; empty: not known."""
    age: int | None = None
    """
    The present minus its stamp, at reception, by ``/clock`` where there is one; None: it has no
    stamp, or 0, which counts as the time of arrival.
    """
    is_simulated: bool = False
    """``age`` is by ``/clock``."""
    linear: tuple[float, float] = (0.0, 0.0)
    """Along x and y."""
    angular: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedCommandTopic:
    """A topic of commands, and what came on it."""

    name: str
    publishers: tuple[str, ...] = ()
    """Nodes, each once."""
    subscriptions: tuple[str, ...] = ()
    seen: tuple[CommandSeen, ...] = ()
    """In the order of reception."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedDrive:
    """A controller that takes commands, by its parameters."""

    node: str
    topics: tuple[str, ...]
    """Of commands, to which it subscribes."""
    timeout: float | None = None
    """s after which a command ends; 0: never; None: not known."""
    timeout_parameter: str = 'cmd_vel_timeout'
    limits: tuple[tuple[str, float, float], ...] = ()
    """Of components: the prefix of the parameters (``linear.x``), least, most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StopLock:
    """A lock that holds robots at rest, as ``emergency_stop``."""

    topic: str
    holders: tuple[str, ...]
    """The nodes that publish it."""
    is_locked: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedCommands:
    """All that was seen of commands."""

    topics: tuple[ObservedCommandTopic, ...] = ()
    drives: tuple[ObservedDrive, ...] = ()
    locks: tuple[StopLock, ...] = ()
    seconds: float = 0.0
    """How long was listened, s."""

    def drives_on(self, topic: str) -> tuple[ObservedDrive, ...]:
        """Return the drives that subscribe to a topic."""
        return tuple(each for each in self.drives if topic in each.topics)


def series_of(seen: tuple[CommandSeen, ...]) -> list[list[CommandSeen]]:
    """Return the commands of each publisher."""
    series: dict[str, list[CommandSeen]] = {}
    for command in seen:
        series.setdefault(command.publisher, []).append(command)
    return list(series.values())


def median_period(seen: list[CommandSeen]) -> float:
    """Return the median time between two commands or more, s."""
    times = [each.received for each in seen]
    gaps = sorted(later - earlier for earlier, later in zip(times, times[1:], strict=False))
    return gaps[len(gaps) // 2] / NANOSECONDS
