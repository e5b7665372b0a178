# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Have Fast DDS use UDP alone: no participant of ours shares memory with another process.

The shared-memory transport of Fast DDS 2.14 guards its ports by mutexes in ``/dev/shm`` that are
not robust: a process that is killed while it holds one, or while it makes a port, leaves it so for
ever. Whoever publishes to that port then waits for 2 s, or for good. rclpy keeps the interpreter's
lock while it publishes, so every thread of the process waits with it: control loop, services,
signal handlers, any watchdog in Python; a publishing thread does not help, and only SIGKILL ends
the process. Sending by UDP waits for nobody: what a receiver, or a network, cannot take is
dropped, and sent again if reliable.

Peers that have shared memory as well are reached by UDP. Of images of 0.9 MB at 30 Hz, best
effort, 93 % arrived by UDP, and 28 % through a shared segment of 0.5 MB, as is the default; the
processor time is the same. The sockets ask for buffers of 4 MB, and get what ``net.core.rmem_max``
grants.

``ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST`` has rmw_fastrtps_cpp add a shared-memory transport of
its own to whatever a profile says. So rclpy is initialised with the range SYSTEM_DEFAULT instead,
with which it adds nothing, together with a profile that keeps discovery on this host as LOCALHOST
does. Only with static peers it is SUBNET: the peers are taken then, and this participant announces
itself to the network by multicast, too, which LOCALHOST would not.

LOCALHOST announces itself to this host only, but Fast DDS listens to all: a participant of another
host that has this one among its static peers would be heard, and could drive, or exhaust our
memory (Fast DDS 2.14.5). So unless the user has opened the network, every socket is bound to
127.0.0.1. Whoever is on this host is reached all the same, whatever is set there: nodes of rclpy
that listen on all interfaces, on the subnet, or by shared memory.

===========================================  ======================================================
what the user has set                        what holds
===========================================  ======================================================
nothing, LOCALHOST, or OFF                   ``udp_loopback.xml``: this host only
LOCALHOST and static peers, or a server      ``udp_localhost.xml``
SUBNET, SYSTEM_DEFAULT                       ``udp.xml``
``FASTDDS_BUILTIN_TRANSPORTS``               that, and ``discovery.xml``
``FASTRTPS_DEFAULT_PROFILES_FILE``           that file, and nothing of ours
===========================================  ======================================================

(ROS takes SUBNET where no range is set.)

This module imports no rclpy.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
import os
from pathlib import Path

from amr_description.ros.discovery import PROFILE

UDP = Path(__file__).with_name('udp.xml')
UDP_LOCALHOST = Path(__file__).with_name('udp_localhost.xml')
UDP_LOOPBACK = Path(__file__).with_name('udp_loopback.xml')

_PROFILE_VARIABLES = ('FASTRTPS_DEFAULT_PROFILES_FILE', 'FASTDDS_DEFAULT_PROFILES_FILE')
_TRANSPORTS = 'FASTDDS_BUILTIN_TRANSPORTS'
_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
_LOCALHOST_ONLY = 'ROS_LOCALHOST_ONLY'  # deprecated; 1 wins over the range and over static peers
_PEERS = 'ROS_STATIC_PEERS'
_SERVER = 'ROS_DISCOVERY_SERVER'
OWN_PROFILES = {
    os.path.realpath(profile) for profile in (PROFILE, UDP, UDP_LOCALHOST, UDP_LOOPBACK)
}


@contextmanager
def udp_only() -> Iterator[None]:
    """
    Inside, initialise a context of rclpy; its participant will have no shared memory.

    The profile stays in the environment: Fast DDS reads it when the first node is made.
    """
    # A parent process may have found this package by another path, as colcon links to the sources.
    given = (os.environ.get(variable) for variable in _PROFILE_VARIABLES)
    inherited = {os.path.realpath(file) for file in given if file}
    if inherited - OWN_PROFILES:
        yield
    elif os.environ.get(_TRANSPORTS):
        os.environ[_PROFILE_VARIABLES[0]] = str(PROFILE)
        yield
    else:
        changes = _changes(os.environ)
        open_to_some = UDP_LOCALHOST if changes else UDP
        profile = UDP_LOOPBACK if is_closed(os.environ) else open_to_some
        os.environ[_PROFILE_VARIABLES[0]] = str(profile)
        previous = {variable: os.environ.get(variable) for variable in changes}
        os.environ.update(changes)
        try:
            yield
        finally:
            for variable, value in previous.items():
                if value is None:
                    del os.environ[variable]
                else:
                    os.environ[variable] = value


def _changes(environment: Mapping[str, str]) -> dict[str, str]:
    """What to tell rcl where the user keeps discovery on this host; elsewhere nothing."""
    if environment.get(_LOCALHOST_ONLY) == '1':
        return {_LOCALHOST_ONLY: '0', _RANGE: 'SYSTEM_DEFAULT', _PEERS: ''}
    discovery_range = environment.get(_RANGE)
    if discovery_range == 'LOCALHOST' or (discovery_range != 'OFF' and is_closed(environment)):
        return {_RANGE: 'SUBNET' if environment.get(_PEERS) else 'SYSTEM_DEFAULT'}
    return {}


def is_closed(environment: Mapping[str, str]) -> bool:
    """Return whether participants with these variables talk to this host only."""
    if environment.get(_SERVER):
        return False
    if environment.get(_LOCALHOST_ONLY) == '1':
        return True
    discovery_range = environment.get(_RANGE)
    return discovery_range == 'OFF' or (
        discovery_range in (None, '', 'LOCALHOST') and not environment.get(_PEERS)
    )


def is_udp_only() -> bool:
    """Return whether a context that was initialised inside of :func:`udp_only` uses UDP alone."""
    given = (os.environ.get(variable) for variable in _PROFILE_VARIABLES)
    profiles = {os.path.realpath(file) for file in given if file}
    return bool(profiles) and profiles <= OWN_PROFILES and not os.environ.get(_TRANSPORTS)


def reaches_other_hosts() -> bool:
    """Return whether participants of this environment look for others beyond this host."""
    return not is_closed(os.environ)
