# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Counts the DDS participants on this host, which discovery has to find.

Each listens to its discovery messages at a UDP port of its own, and by the port formula of the
DDS standard (DDSI-RTPS 2.5, 9.6.2.3) that port tells its domain:
``7400 + 250 * domain + 10 + 2 * participant``. Linux lists the ports in use.
"""

from collections.abc import Collection
from contextlib import suppress

from amr_description.ros.udp_sockets import udp_sockets

_PORT_BASE = 7400
_DOMAIN_GAIN = 250
_PARTICIPANT_GAIN = 2
_UNICAST_OFFSET = 10
_PARTICIPANTS = range(120)


def count_local_participants(domain: int) -> int:
    """Return how many participants of a domain run on this host, ours included."""
    with suppress(OSError):
        return len(participant_ids(udp_sockets(), domain))
    return 0


def participant_ids(ports: Collection[int], domain: int) -> set[int]:
    """
    Return the participants of a domain, from the UDP ports in use.

    A participant has the port after that too, for its data; a lone port is some other program's:
    the ports of the highest domains lie among those that Linux gives to any socket.
    """
    first = _PORT_BASE + _DOMAIN_GAIN * domain + _UNICAST_OFFSET
    own = ((participant, first + _PARTICIPANT_GAIN * participant) for participant in _PARTICIPANTS)
    return {participant for participant, port in own if port in ports and port + 1 in ports}
