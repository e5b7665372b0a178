# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Where the time of a piece of code goes: a tree of its calls, without the cost of watching. Pure.

:class:`CallRecorder` is a profile function (``sys.setprofile``), so it hears the calls of one
thread only. Watching makes every call slower, by what :func:`cost_of_watching` measures;
:meth:`CallTree.without_overhead` takes it away again.
"""

from array import array
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import PurePath
import sys
import time
from types import CodeType, FrameType
from typing import Any, Self, TypeAlias

Event: TypeAlias = tuple[int, Any]
"""
Clock reading (ns) at which a call begins, or its negative at which it ends; and the code or the
function in C.
"""

_BEGINNINGS = ('call', 'c_call')
_PYTHON_EVENTS = ('call', 'return')
_C = 'C: '


class CallRecorder:
    """The calls of a thread, to be made trees of; ``sys.setprofile(recorder)`` starts it."""

    def __init__(self, clock: Callable[[], int] = time.perf_counter_ns) -> None:
        """``clock``: ns."""
        # Nothing here makes an object that stays: memory that is new is dear.
        self._times = array('q')
        self._functions: list[Any] = []
        self._clock = clock

    def __call__(self, frame: FrameType, event: str, function: Any) -> None:
        """Record an event; see ``sys.setprofile``."""
        now = self._clock()
        self._times.append(now if event in _BEGINNINGS else -now)
        self._functions.append(frame.f_code if event in _PYTHON_EVENTS else function)

    @property
    def events(self) -> Iterable[Event]:
        """What was recorded."""
        return zip(self._times, self._functions, strict=True)


@dataclass
class CallTree:
    """The calls of one function at one place in the tree, and what these have called."""

    name: str
    module: str = ''
    calls: float = 0.0
    total: float = 0.0
    """Time in it and in what it has called; µs in what is printed, ns while it is recorded."""
    children: dict[str, Self] = field(default_factory=dict)

    @property
    def place(self) -> tuple[str, str]:
        """Its name and module."""
        return self.name, self.module

    @property
    def own(self) -> float:
        """Time in it alone."""
        return self.total - sum(child.total for child in self.children.values())

    def add(self, events: Iterable[Event]) -> None:
        """
        Add what was recorded below this function.

        An end without its beginning is left out (some functions in C have no other), as is a call
        that has not ended.
        """
        path: list[tuple[CallTree, int]] = []
        here: CallTree = self
        for at, what in events:
            place = place_of(what)
            if at > 0:
                path.append((here, at))
                here = here._child(*place)
            elif any(place == each.place for each in _open(path, here)):
                ended = None
                while ended != place:
                    ended = here.place
                    parent, begin = path.pop()
                    here.calls += 1
                    here.total += -at - begin
                    here = parent

    def _child(self, name: str, module: str) -> 'CallTree':
        key = f'{module}:{name}'
        child = self.children.get(key)
        if child is None:
            child = self.children[key] = type(self)(name, module)
        return child

    def per(self, count: int, unit: float) -> 'CallTree':
        """Return the mean of ``count`` repetitions, with times divided by ``unit``."""
        children = {key: child.per(count, unit) for key, child in self.children.items()}
        total, calls = self.total / count / unit, self.calls / count
        return CallTree(self.name, self.module, calls, total, children)

    def without_overhead(
        self, share: float, total: float, exact: Mapping[str, float] | None = None
    ) -> 'CallTree':
        """
        Return the tree as if nobody had watched.

        Args:
            share: What watching costs for each call; one half of it counts in the caller.
            total: What all takes without watching. All is slower while it is watched, as the
                caches hold less of it; so the rest is scaled.
            exact: What functions take without watching, by their names, where that is known.
        """
        tree, exact = self._without(share), exact or {}
        watched = {
            name: sum(each.own for each in tree.walk() if each.name == name) for name in exact
        }
        known = {name: took for name, took in exact.items() if watched[name] > 0.0}
        if sum(known.values()) >= total:  # measured at another moment: it says nothing
            known = {}
        rest = tree.total - sum(watched[name] for name in known)
        scale = max(0.0, total - sum(known.values())) / rest if rest > 0.0 else 0.0
        return tree._scaled(scale, {name: took / watched[name] for name, took in known.items()})

    def _without(self, share: float) -> 'CallTree':
        children = {key: child._without(share) for key, child in self.children.items()}
        calls = self.calls + sum(child.calls for child in self.children.values())
        return self._of(max(0.0, self.own - share * 0.5 * calls), children)

    def _scaled(self, factor: float, factors: Mapping[str, float]) -> 'CallTree':
        children = {key: child._scaled(factor, factors) for key, child in self.children.items()}
        return self._of(self.own * factors.get(self.name, factor), children)

    def _of(self, own: float, children: dict[str, 'CallTree']) -> 'CallTree':
        total = own + sum(child.total for child in children.values())
        return CallTree(self.name, self.module, self.calls, total, children)

    def walk(self) -> Iterable['CallTree']:
        """Yield this one and all below."""
        yield self
        for child in self.children.values():
            yield from child.walk()

    def lines(self, least: float, indent: int = 0) -> Iterable[str]:
        """Yield a line for each function that takes ``least`` or more, callers first."""
        place = '  ' * indent + self.name
        calls = f'{self.calls:6.2f}' if self.calls else '      '
        yield f'{self.total:8.1f} {self.own:8.1f} {calls}  {place:<52} {self.module}'.rstrip()
        by_time = sorted(self.children.values(), key=lambda child: -child.total)
        for child in by_time:
            if child.total >= least:
                yield from child.lines(least, indent + 1)

    def by_module(self) -> dict[str, float]:
        """Return the own time of the functions of each module, the greatest first."""
        times: dict[str, float] = {}
        for each in self.walk():
            if each is not self:
                times[each.module] = times.get(each.module, 0.0) + each.own
        return dict(sorted(times.items(), key=lambda item: -item[1]))

    def as_json(self) -> Mapping[str, Any]:
        """Return the tree as JSON has it; see :meth:`from_json`."""
        children = [child.as_json() for child in self.children.values()]
        return dict(
            name=self.name,
            module=self.module,
            calls=self.calls,
            total=self.total,
            children=children,
        )

    @classmethod
    def from_json(cls, read: Mapping[str, Any]) -> Self:
        """Return the tree of :meth:`as_json`."""
        children = {
            f'{child["module"]}:{child["name"]}': cls.from_json(child)
            for child in read['children']
        }
        return cls(read['name'], read['module'], read['calls'], read['total'], children)


def cost_of_watching(repetitions: int = 2000) -> float:
    """Return how much longer one call takes while it is recorded, ns."""

    def empty() -> None:
        pass

    def run() -> int:
        begin = time.thread_time_ns()
        for _ in range(repetitions):
            empty()
        return time.thread_time_ns() - begin

    before = sys.getprofile()
    plain, watched = [], []
    for _ in range(10):
        plain.append(run())
        sys.setprofile(CallRecorder())
        watched.append(run())
        sys.setprofile(before)
    return max(0.0, (min(watched) - min(plain)) / repetitions)


def _open(path: Sequence[tuple[CallTree, int]], here: CallTree) -> Iterable[CallTree]:
    """Return the calls that have begun and not ended, the last one first."""
    if path:
        yield here
    for each, _ in path[:0:-1]:
        yield each


def place_of(what: Any) -> tuple[str, str]:
    """Return name and module of a code object, or of a function in C."""
    if isinstance(what, CodeType):
        parts = PurePath(what.co_filename).with_suffix('').parts
        for package in ('amr_description', 'rclpy', 'numpy'):
            if package in parts:
                last = len(parts) - 1 - parts[::-1].index(package)
                return what.co_qualname, '/'.join(parts[last:])
        return what.co_qualname, parts[-1]
    module = getattr(what, '__module__', None)
    if not module:
        owner = getattr(what, '__self__', None)
        module = type(owner).__name__ if owner is not None else 'builtins'
    return getattr(what, '__name__', str(what)), f'{_C}{module}'
