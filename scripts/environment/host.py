# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Judge the machine and the shell that we were started from, before anything is downloaded."""

from collections.abc import Mapping
import os
from pathlib import Path
import platform

from . import SetupError

GLIBC = (2, 28)  # manylinux_2_28, the tag of the ROS wheels
MACHINE = 'x86_64'  # the only one they are built for

# pip would install elsewhere than into the environment at hand.
PIP_REDIRECTIONS = ('PIP_TARGET', 'PIP_PREFIX', 'PIP_ROOT', 'PIP_REQUIRE_VIRTUALENV')
# Set by a sourced ROS; the build must not take its packages from there.
ROS_VARIABLES = (
    'AMENT_PREFIX_PATH',
    'COLCON_PREFIX_PATH',
    'CMAKE_PREFIX_PATH',
    'ROS_DISTRO',
    'ROS_VERSION',
    'ROS_PYTHON_VERSION',
)


def check_host(
    system: str | None = None, machine: str | None = None, libc: tuple[str, str] | None = None
) -> None:
    """Raise :class:`SetupError` unless the ROS wheels of PyPI can be loaded here."""
    system = system or platform.system()
    machine = machine or platform.machine()
    libc = libc or platform.libc_ver()
    wanted = f'Linux on {MACHINE} with glibc {GLIBC[0]}.{GLIBC[1]} or later'
    advice = 'in a container (docker run -it debian:12), or install ROS 2 Jazzy on Ubuntu 24.04'
    if (system, machine) != ('Linux', MACHINE):
        raise SetupError(f'the ROS wheels need {wanted}; this is {system} on {machine}; {advice}')
    name, version = libc
    numbers = tuple(int(part) for part in version.split('.')[:2] if part.isdigit())
    if name != 'glibc' or numbers < GLIBC:
        found = f'{name} {version}' if name else 'another C library (musl?)'
        raise SetupError(f'the ROS wheels need {wanted}; this has {found}; {advice}')


def foreign_ros(environment: Mapping[str, str]) -> str | None:
    """Return the prefix of the ROS that was sourced in this shell, None if there is none."""
    for prefix in environment.get('AMENT_PREFIX_PATH', '').split(os.pathsep):
        index = Path(prefix, 'share/ament_index/resource_index/packages/rclpy')
        if prefix and index.exists() and not Path(prefix, 'pyvenv.cfg').exists():
            return prefix
    return None


def clean_environment(environment: Mapping[str, str]) -> dict[str, str]:
    """
    Return ``environment`` without what would mix another Python or ROS into ours.

    A foreign PYTHONPATH or LD_LIBRARY_PATH makes our Python load that other rclpy, half of it,
    and ends in "_rclpy_pybind11 not found".
    """
    kept = {
        name: value
        for name, value in environment.items()
        if name not in (*ROS_VARIABLES, *PIP_REDIRECTIONS)
        and name not in ('PYTHONPATH', 'PYTHONHOME', 'LD_LIBRARY_PATH', 'VIRTUAL_ENV')
        and name != '_ROS_WHEELS_BOOTSTRAP_COMPLETE'
    }
    return kept | {'PIP_USER': '0', 'PIP_DISABLE_PIP_VERSION_CHECK': '1'}


def foreign_settings(environment: Mapping[str, str]) -> list[str]:
    """Name, for a message, what :func:`clean_environment` leaves out and a person set."""
    ros = foreign_ros(environment)
    found = [f'the sourced {ros}'] if ros else []
    found += [
        name
        for name in ('PYTHONPATH', 'PYTHONHOME', 'LD_LIBRARY_PATH')
        if environment.get(name) and not ros
    ]
    if environment.get('CONDA_PREFIX'):
        found.append(f'the conda environment {environment["CONDA_PREFIX"]}')
    return found
