# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Greetings by a topic and by multicast, and how many come from other hosts.

Text, group and port are those of the original, so that both sides may be either.
"""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
import errno
import socket
import struct
import sys

from std_msgs.msg import String

from amr_description.cli.session import open_session
from amr_description.errors import AmrError

DEFAULT_GROUP = '225.0.0.1'
DEFAULT_PORT = 49150

_ROW = '{:<15} {:<20} {:<10}'
_LARGEST = 4096
_QUEUE = 10


class Summary:
    """What was sent and received since the last table."""

    def __init__(self, topic: str, period: float) -> None:
        """Take the name of the topic, and the period of tables, s."""
        self._topic, self._period = topic, period
        self.clear()

    def clear(self) -> None:
        """Begin anew."""
        self.published = self.sent = 0
        self.heard: Counter[str] = Counter()
        self.received: Counter[str] = Counter()

    def table(self) -> str:
        """Return all as text, as the original has it."""
        return '\n'.join(
            [
                'MULTIMACHINE COMMUNICATION SUMMARY',
                f'Topic: {self._topic}, Published Msg Count: {self.published}',
                'Subscribed from:',
                *self._rows(self.heard),
                f'Multicast Group/Port: {DEFAULT_GROUP}/{DEFAULT_PORT}, '
                f'Sent Msg Count: {self.sent}',
                'Received from:',
                *self._rows(self.received),
                '-' * 60,
            ]
        )

    def _rows(self, counts: Counter[str]) -> list[str]:
        heading = _ROW.format('', 'Hostname', f'Msg Count /{self._period}s')
        return [heading, *(_ROW.format('', name, count) for name, count in counts.items())]


def greet(
    topic: str, *, emit_period: float, print_period: float, ttl: int | None, is_once: bool
) -> int:
    """
    Greet until Ctrl-C, and print a table every now and then; 0.

    Args:
        topic: name of the topic.
        emit_period: s between two greetings.
        print_period: s between two tables.
        ttl: how many routers a datagram may pass; None: as the system has it.
        is_once: whether to end after one greeting and a table.

    Raises:
        AmrError: multicast is not possible here.
    """
    summary, own = Summary(topic, print_period), socket.gethostname()
    text = f"hello, it's me {own}"
    with open_session() as session, _multicast(ttl) as (sender, receiver):
        publisher = session.node.create_publisher(String, topic, _QUEUE)
        session.node.create_subscription(
            String, topic, lambda message: count(message.data, own, summary.heard), _QUEUE
        )
        now = session.clock.now
        emit_at = now()
        print_at = emit_at + (emit_period if is_once else print_period)
        while True:
            if now() >= emit_at:
                publisher.publish(String(data=text))
                summary.published += 1
                summary.sent += _sent(sender, text)
                emit_at += emit_period * (1 + int((now() - emit_at) / emit_period))
            for data in _waiting(receiver):
                count(data, own, summary.received)
            if now() >= print_at:
                print(summary.table())
                sys.stdout.flush()
                if is_once:
                    return 0
                summary.clear()
                print_at = now() + print_period
            session.spin(lambda: False, max(0.0, min(emit_at, print_at) - now()))


def count(text: str, own: str, counts: Counter[str]) -> None:
    """Count a greeting by the host that it ends with, if that is not ``own``."""
    name = text.rpartition(' ')[2].strip()
    if name and name != own:
        counts[name] += 1


@contextmanager
def _multicast(ttl: int | None) -> Iterator[tuple[socket.socket, socket.socket]]:
    """Yield a socket that sends, and one that receives and never blocks. Raises AmrError."""
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver,
    ):
        try:
            if ttl is not None:
                sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
            receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
            receiver.bind(('', DEFAULT_PORT))
            group = struct.pack('4sl', socket.inet_aton(DEFAULT_GROUP), socket.INADDR_ANY)
            receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        except OSError as error:
            raise AmrError(
                f'nothing can be received from the multicast group {DEFAULT_GROUP}, port '
                f'{DEFAULT_PORT}: {error.strerror}; see with `ip link` whether this '
                'host has a network interface with the flag MULTICAST'
            ) from None
        receiver.setblocking(False)
        yield sender, receiver


def _sent(sender: socket.socket, text: str) -> int:
    """Send a greeting; return how many were sent: 0 without a way to the group."""
    try:
        sender.sendto(text.encode(), (DEFAULT_GROUP, DEFAULT_PORT))
    except OSError as error:
        if error.errno not in (errno.ENETUNREACH, errno.EHOSTUNREACH, errno.ENETDOWN):
            raise
        return 0
    return 1


def _waiting(receiver: socket.socket) -> Iterator[str]:
    """Yield the greetings that have come."""
    while True:
        try:
            data = receiver.recv(_LARGEST)
        except BlockingIOError:
            return
        yield data.decode(errors='replace')
