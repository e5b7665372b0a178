# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Make Fast DDS find the others at once.

A new participant announces itself to every possible port of this host, one after the other, and
only then starts to listen (Fast DDS 2.14.5, ``ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST``; also
with shared memory on SUBNET). Who is there already answers within half a millisecond, which is
too early, and does not repeat the answer before its own next announcement: up to 3 s later. Half
of the processes started beside a running stack see nothing of it for 1 to 3 s.

A throughput limit, however high, has Fast DDS announce from a thread of its own; then it listens
first. Measured with 12 processes each: found after 0.03 to 0.4 s, before after 0.04 to 2.9 s.

The first request of a client, too, is faster than the announcement of the client. The server drops
it, and a reader asks a writer that it has found for what it has missed 70 ms later; with the times
of the profiles, 1 ms later. A call by a new client takes 2 to 10 ms so, instead of 85; a message
that was there before comes 0.1 s sooner. Only the first question is asked earlier: what a reader
acknowledges from then on is what it always did.

A reliable message that is lost is asked for at the next heartbeat of its writer. Where no further
message brings one, as behind an answer, a latched topic or the last message of a program, Fast DDS
sends the next after 3 s: beside six busy processes 6 of 80 messages of new publishers were
acknowledged then only. The profiles have it sent every 0.2 s, as long as something is not
acknowledged; so the slowest of 80 took 0.21 s.

This module imports no rclpy.
"""

import os
from pathlib import Path

PROFILE = Path(__file__).with_suffix('.xml')
"""The limit and the times by themselves; the profiles of ``transport.py`` have them too."""

DELIVERY_TIME = 4.0
"""
s, at most, until those who are found have acknowledged what is published reliably. As a rule it
takes 0.1 s, or 0.2 s more until the next heartbeat. But who is found need not have found the
publisher yet, and until then hears nothing of it: on a busy machine for half a second, and for
3 s if the announcement is lost. A publisher that ends before takes its messages with it.
"""

_SUPER_CLIENT = 'ROS_SUPER_CLIENT'


def use_whole_graph() -> None:
    """
    Have the participant of this process, and those of its children, learn of the whole graph
    through a discovery server too, which otherwise shows a node only the topics that it uses.

    A search by type (``create``'s for the simulator) would never end, and ``ros2 topic list`` find
    nothing. Without ``ROS_DISCOVERY_SERVER`` it changes nothing; nor where a user has decided.
    """
    os.environ.setdefault(_SUPER_CLIENT, 'TRUE')
