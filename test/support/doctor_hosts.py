# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the doctor sees of a host in good order, for tests."""

from dataclasses import replace

from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.environment import Environment
from amr_description.doctor.observations.machine import Disk, Interface, Machine, Python
from amr_description.doctor.observations.processes import ObservedProcess, Processes
from amr_description.doctor.table import examine

GIGABYTE = 10**9
BUSY_MACHINE = {'overloaded', 'memory_short'}
"""Rules that are true of a machine with much else to do, and no fault of what is tested."""
SUFFIX = '.cpython-312-x86_64-linux-gnu.so'
LOOPBACK = Interface(name='lo', is_loopback=True, has_multicast=False, addresses=('127.0.0.1',))
ETHERNET = Interface(name='eth0', addresses=('192.0.2.2',))
PYTHON = Python(
    version='3.12.1',
    executable='/venv/bin/python',
    extension_suffix=SUFFIX,
    rclpy_folder='/venv/lib/python3.12/site-packages/rclpy',
    rclpy_suffixes=(SUFFIX,),
    rclpy_version='7.1.6',
)
MACHINE = Machine(
    system='Linux 6.1.0',
    architecture='x86_64',
    c_library='glibc 2.36',
    processors=2,
    load=2.5,
    python=PYTHON,
    encoding='UTF-8',
    memory=8 * GIGABYTE,
    free_memory=4 * GIGABYTE,
    stalled_by_memory=0.0,
    disks=(
        Disk(purpose='log files', folder='/home/a/.ros/log', free=GIGABYTE, total=9 * GIGABYTE),
        Disk(purpose='shared memory', folder='/dev/shm', free=64_000_000, total=64_000_000),
    ),
    interfaces=(LOOPBACK, ETHERNET),
)
SIMULATOR = ObservedProcess(
    pid=100, command='mujoco_sim', domain=0, most_open_files=1024, open_files=20
)


def host(*, machine=MACHINE, processes=(), **changes):
    """
    A healthy host, or one with a fault.

    Args:
        machine: the whole section, or the changes of it.
        processes: of ROS.
        changes: of the environment by its fields, and ``runs``, ``is_alone``, ``left_memory``,
            ``own_domain`` of the processes.
    """
    if isinstance(machine, dict):
        machine = replace(MACHINE, **machine)
    of_processes = {
        name: changes.pop(name) for name in ('runs', 'is_alone', 'left_memory') if name in changes
    }
    return Observations(
        machine=machine,
        environment=Environment(**changes),
        processes=Processes(domain=0, processes=tuple(processes), **of_processes),
    )


def found(seen):
    """The names of the rules that find something."""
    return [finding.rule for finding in examine(seen)]
