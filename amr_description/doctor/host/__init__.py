# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Reads this machine, its processes and the environment, without ROS; changes nothing.

===================  =============================================================================
``machine.py``       system, Python, memory, disks, network
``environment.py``   environment variables, and the files and servers that they name
``processes.py``     the processes of ROS, by the sockets of DDS and the runs of bring-ups
===================  =============================================================================
"""

from collections.abc import Mapping
import os
from typing import TypedDict

from amr_description.doctor.host.environment import read_environment
from amr_description.doctor.host.machine import read_machine
from amr_description.doctor.host.processes import read_processes
from amr_description.doctor.observations.environment import Environment
from amr_description.doctor.observations.machine import Machine
from amr_description.doctor.observations.processes import Processes


class Sections(TypedDict):
    """The sections of a host, as keywords of Observations."""

    machine: Machine
    environment: Environment
    processes: Processes


def read_host(variables: Mapping[str, str] = os.environ) -> Sections:
    """
    Observe this host; it takes some 50 ms.

    Args:
        variables: the environment that is examined.
    """
    return {
        'machine': read_machine(variables),
        'environment': read_environment(variables),
        'processes': read_processes(variables),
    }
