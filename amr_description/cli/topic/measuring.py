# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 topic hz``, ``bw`` and ``delay`` share: they wait for a topic, and report on it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, ParamSpec

from rclpy.clock import Clock, ClockType
from rclpy.experimental import EventsExecutor
from rclpy.qos import qos_profile_sensor_data

from amr_description.cli import graph
from amr_description.cli.names import full_name
from amr_description.cli.session import open_session, Session
from amr_description.ros.message_types import message_type

Arguments = ParamSpec('Arguments')

_PERIOD = 1.0  # s


@dataclass(frozen=True)
class MeasuredTopic:
    """A topic of the graph; ``name`` is absolute."""

    session: Session
    name: str
    message_class: Any
    failures: list[OSError] = field(default_factory=list)
    """Of writing, as after ``| head``: EventsExecutor would log each exception of a callback."""

    def subscribe(self, receive: Callable[[Any], None], *, raw: bool = True) -> None:
        """Call ``receive`` with each message, or with its bytes if ``raw``."""
        self.session.node.create_subscription(
            self.message_class, self.name, self._noting(receive), qos_profile_sensor_data, raw=raw
        )

    def every_second(self, report: Callable[[], None]) -> None:
        """Call ``report`` once per second, also while simulation time is stopped."""
        clock = Clock(clock_type=ClockType.STEADY_TIME)
        self.session.node.create_timer(_PERIOD, self._noting(report), clock=clock)

    def serve(self) -> None:
        """Run callbacks until Ctrl-C. Raises OSError: the output cannot be written."""
        self.session.serve(lambda: bool(self.failures))
        if self.failures:
            raise self.failures[0]

    def _noting(self, callback: Callable[Arguments, None]) -> Callable[Arguments, None]:
        def call(*args: Arguments.args, **kwargs: Arguments.kwargs) -> None:
            try:
                callback(*args, **kwargs)
            except OSError as error:
                self.failures.append(error)

        return call


@contextmanager
def measured_topic(name: str, *, use_sim_time: bool) -> Iterator[MeasuredTopic]:
    """
    Yield a topic once it is there, then run callbacks until Ctrl-C.

    Raises:
        AmrError: It is not there.
        OSError: The output cannot be written.
    """
    with open_session(use_sim_time=use_sim_time, executor=EventsExecutor) as session:
        topic = full_name(session.node, name)
        message_class = message_type(graph.wait_for_type(session, topic))
        measured = MeasuredTopic(session, topic, message_class)
        yield measured
        measured.serve()
