# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The environment variables of this process, and what they name."""

from collections.abc import Mapping
from dataclasses import dataclass, field

PROFILES = ('FASTRTPS_DEFAULT_PROFILES_FILE', 'FASTDDS_DEFAULT_PROFILES_FILE')
"""Name a profile of Fast DDS; the first is that of Jazzy's."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Environment:
    """What the shell has set."""

    variables: Mapping[str, str] = field(default_factory=dict)
    file_faults: Mapping[str, str] = field(default_factory=dict)
    """Variables that name a file that cannot be used → why: ``is not there``."""
    missing_folders: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Variables that are lists of folders → those that are not there."""
    rmw_implementations: frozenset[str] = frozenset()
    """That are installed; empty: not known."""
    is_from_wheels: bool = True
    """Whether rclpy is one of PyPI's, and none of ``/opt/ros``."""
    python_version: str = '3.12'
    fastdds_version: str = ''
    """Empty: not known."""
    unheard_servers: tuple[str, ...] = ()
    """Discovery servers of ``ROS_DISCOVERY_SERVER`` on this host at whose port nobody listens."""

    def value(self, name: str) -> str:
        """Return a variable; empty: it is not set, or empty."""
        return self.variables.get(name, '')


def is_open(environment: Environment) -> bool:
    """Return whether programs with these variables listen to other hosts."""
    if environment.value('ROS_DISCOVERY_SERVER') or any(map(environment.value, PROFILES)):
        return True
    if environment.value('ROS_LOCALHOST_ONLY') == '1':
        return False
    reach = environment.value('ROS_AUTOMATIC_DISCOVERY_RANGE')
    return reach in ('SUBNET', 'SYSTEM_DEFAULT') or (
        reach != 'OFF' and bool(environment.value('ROS_STATIC_PEERS'))
    )


def reaches_network(environment: Environment) -> bool:
    """Return whether nodes of other hosts are looked for by multicast."""
    if environment.value('ROS_LOCALHOST_ONLY') == '1' or environment.value('ROS_STATIC_PEERS'):
        return False
    if any(environment.value(name) for name in ('ROS_DISCOVERY_SERVER', *PROFILES)):
        return False
    return environment.value('ROS_AUTOMATIC_DISCOVERY_RANGE') in ('', 'SUBNET')
