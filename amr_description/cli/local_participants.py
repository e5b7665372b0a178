# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Counts the DDS participants on this host, which discovery has to find.

Each listens to its discovery messages at a UDP port of its own, and by the port formula of the
DDS standard (DDSI-RTPS 2.5, 9.6.2.3) that port tells its domain:
``7400 + 250 * domain + 10 + 2 * participant``. Linux lists the ports in use.
"""

from collections.abc import Iterable
from contextlib import suppress

_TABLES = ('/proc/net/udp', '/proc/net/udp6')
_PORT_BASE = 7400
_DOMAIN_GAIN = 250
_PARTICIPANT_GAIN = 2
_UNICAST_OFFSET = 10
_PARTICIPANTS = range(120)


def count_local_participants(domain: int) -> int:
    """Return how many participants of a domain run on this host, ours included."""
    return len(participant_ids(_lines(), domain))


def participant_ids(table: Iterable[str], domain: int) -> set[int]:
    """
    Return the participants of a domain, from the lines of ``/proc/net/udp``.

    A participant has the port after that too, for its data; a lone port is some other program's:
    the ports of the highest domains lie among those that Linux gives to any socket.
    """
    ports = {int(line.split()[1].rpartition(':')[2], 16) for line in table}
    first = _PORT_BASE + _DOMAIN_GAIN * domain + _UNICAST_OFFSET
    own = ((participant, first + _PARTICIPANT_GAIN * participant) for participant in _PARTICIPANTS)
    return {participant for participant, port in own if port in ports and port + 1 in ports}


def _lines() -> Iterable[str]:
    for path in _TABLES:
        with suppress(OSError), open(path) as table:
            next(table)  # the heading
            yield from table
