# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Collects the sections of a ROS graph, by a probe each, within one window of time.

A probe publishes nothing, calls no service that changes anything, and holds nobody up: where
messages are large, or many, it subscribes with best effort and a short queue.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, Protocol, TypeAlias

from rclpy.node import Node

from amr_description.doctor.observations import Observations
from amr_description.doctor.ros.clock import ClockProbe
from amr_description.doctor.ros.commands import CommandProbe
from amr_description.doctor.ros.controllers import ControllersProbe
from amr_description.doctor.ros.description import DescriptionProbe
from amr_description.doctor.ros.graph import GraphProbe
from amr_description.doctor.ros.navigation import NavigationProbe
from amr_description.doctor.ros.probe_context import ProbeContext
from amr_description.doctor.ros.sensors import SensorsProbe
from amr_description.doctor.ros.transforms import TransformsProbe
from amr_description.text import one_line

WINDOW = 3.0
"""s: longest time in which messages and answers are waited for."""


class Probe(Protocol):
    """Observes one section."""

    def begin(self, context: ProbeContext) -> None:
        """Subscribe and ask; the graph is complete, as far as can be known."""

    @property
    def is_done(self) -> bool:
        """Whether nothing more would be learnt by waiting; asked after each callback."""

    def observe(self) -> Any:
        """Return the section as seen until now; at the end of the window, done or not."""


Spin: TypeAlias = Callable[[Callable[[], bool], float], bool]
"""Runs the callbacks of the node until a function returns True, at most for so many s."""

PROBES: dict[str, Callable[[], Probe]] = {
    'graph': GraphProbe,
    'clock': ClockProbe,
    'commands': CommandProbe,
    'description': DescriptionProbe,
    'controllers': ControllersProbe,
    'transforms': TransformsProbe,
    'sensors': SensorsProbe,
    'navigation': NavigationProbe,
}
"""Fields of Observations, and what makes the probe of each."""


class Guarded:
    """A probe that takes no other one with it when it raises, whatever a robot has sent."""

    def __init__(self, make: Callable[[], Probe]) -> None:
        """``make`` makes the probe."""
        self._make = make
        self._probe: Probe | None = None
        self.fault = ''
        """Why nothing is observed; empty: it is."""

    def begin(self, context: ProbeContext) -> None:
        """Make the probe, and let it begin."""
        with self._kept():
            self._probe = self._make()
            self._probe.begin(context)

    @property
    def is_done(self) -> bool:
        """Whether nothing more would be learnt by waiting."""
        with self._kept():
            return bool(self.fault) or self._probe is None or self._probe.is_done
        return True

    def observe(self) -> Any:
        """Return the section; None: there is a fault."""
        with self._kept():
            return None if self.fault or self._probe is None else self._probe.observe()
        return None

    @contextmanager
    def _kept(self) -> Iterator[None]:
        try:
            yield
        except Exception as error:
            self.fault = one_line(f'{type(error).__name__}: {error}')


class RosExamination:
    """Observes a graph step by step, for a program that has other work meanwhile."""

    def __init__(self, node: Node, probes: Mapping[str, Callable[[], Probe]] = PROBES) -> None:
        """Begin all ``probes``; whoever has ``node`` spins it, and destroys it in the end."""
        self._context = ProbeContext(node)
        self._probes = {name: Guarded(make) for name, make in probes.items()}
        for each in self._probes.values():
            each.begin(self._context)

    @property
    def is_done(self) -> bool:
        """Whether nothing more would be learnt by waiting."""
        return all([each.is_done for each in self._probes.values()])

    def observe(self) -> Observations:
        """Return what was seen."""
        return _observed(self._probes)

    def end(self) -> None:
        """Destroy what the probes shared, whether they have observed or not."""
        self._context.destroy()


def collect(
    node: Node,
    spin: Spin,
    *,
    window: float = WINDOW,
    probes: Mapping[str, Callable[[], Probe]] = PROBES,
    **sections: Any,
) -> Observations:
    """
    Observe a graph.

    Args:
        node: whose subscriptions and clients are made; the graph around it has been discovered.
        spin: runs its callbacks.
        window: longest time, s; it ends as soon as all probes are done.
        probes: by section.
        sections: what was observed otherwise, of the host.
    """
    with what_is_made_goes(node):
        examination = RosExamination(node, probes)
        try:
            spin(lambda: examination.is_done, window)
            return replace(examination.observe(), **sections)
        finally:
            examination.end()


def _observed(probes: Mapping[str, Guarded]) -> Observations:
    found = {name: each.observe() for name, each in probes.items()}
    faults = {name: each.fault for name, each in probes.items() if each.fault}
    return Observations(**found, faults=faults or None)


@contextmanager
def what_is_made_goes(node: Node) -> Iterator[None]:
    """Destroy the subscriptions, clients and timers that the block makes: a page looks again."""
    before = {*node.subscriptions, *node.clients, *node.timers}
    try:
        yield
    finally:
        for subscription in {*node.subscriptions} - before:
            node.destroy_subscription(subscription)
        for client in {*node.clients} - before:
            node.destroy_client(client)
        for timer in {*node.timers} - before:
            node.destroy_timer(timer)
