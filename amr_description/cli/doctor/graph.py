# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Observes the ROS graph for ``ros2 doctor``: needs rclpy."""

from collections.abc import Iterator
from contextlib import contextmanager, ExitStack
from dataclasses import replace
from typing import Unpack

from amr_description.cli import graph
from amr_description.cli.discovery import wait_for_discovery
from amr_description.cli.session import open_session, Session
from amr_description.doctor.host import Sections
from amr_description.doctor.observations import Observations
from amr_description.doctor.rules.machine import overloaded
from amr_description.errors import AmrError
from amr_description.ros.rclpy_internals import RCLError


@contextmanager
def sessions() -> Iterator[Session]:
    """Yield a session. Raises AmrError: no node can be made."""
    with ExitStack() as stack:
        try:
            session = stack.enter_context(open_session())
        except RCLError as error:
            raise AmrError(f'no node can be made: {error}') from None
        yield session


def observe(session: Session, **host: Unpack[Sections]) -> Observations:
    """
    Observe what is in the domain of a session.

    Args:
        session: of the verb; may be used again.
        host: the sections of the host.
    """
    wait_for_discovery(session, None)
    own = session.node.get_fully_qualified_name()
    others = [each for each in graph.nodes(session.node, hidden=True) if each.full_name != own]
    host['processes'] = replace(host['processes'], is_alone=not others)
    if not others:
        return Observations(**host)
    from amr_description.doctor.ros.collector import collect, WINDOW  # with many messages

    # On a busy machine messages and answers come late.
    is_busy = any(overloaded(Observations(machine=host['machine'])))
    window = 2 * WINDOW if is_busy else WINDOW
    return collect(session.node, session.spin, window=window, **host)
