# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What users of the wheels install: ``scripts/requirements.lock`` without what is for developers.

Of the few packages that PyPI has only the sources of, a wheel is made here: pip would build them
with whatever setuptools is the newest on that day, which no hash holds.
"""

from collections.abc import Iterable, Mapping
import os
from pathlib import Path

from environment import SetupError
from environment.commands import run
from environment.locks import parse, Pin, write_requirements
from environment.virtual_environment import python_of, WITHOUT_WHEEL

from releasing import ReleaseError

DEVELOPMENT = (
    'apsw',
    'backports.zstd',
    'hypothesis',
    'rosbags',
    'ruamel.yaml',
    'ruff',
    'sortedcontainers',
)
"""What only the tests and the code of this project need."""
OF_ROS = ('argcomplete', 'empy')
"""What the command ``ros2`` and ROS itself need in just this version, beside their own wheels."""
_HEAD = """\
# amr_description {version} and all that it needs, for CPython {pythons} on x86-64 Linux with
# glibc 2.28 or later.
# The wheels of the release lie beside this file; the others come from PyPI.
#     python3 -m venv ros
#     ros/bin/pip install --no-deps -r {name}
# --no-deps: it is complete, and leaves out what others require on paper and nothing here uses.
--find-links .
--only-binary :all:
"""


def released_pins(lock: str) -> list[Pin]:
    """Return what users install, for every Python. Raises ReleaseError."""
    try:
        pins = [pin for pin in parse(lock) if isinstance(pin, Pin)]
    except SetupError as error:
        raise ReleaseError(str(error)) from None
    names = {pin.name for pin in pins}
    missing = [name for name in (*DEVELOPMENT, *WITHOUT_WHEEL) if name not in names]
    if missing:
        raise ReleaseError(
            f'scripts/requirements.lock no longer has {", ".join(missing)}: take it out of '
            'DEVELOPMENT in scripts/releasing/locks.py, or WITHOUT_WHEEL in scripts/environment/'
        )
    return [pin for pin in pins if pin.name not in DEVELOPMENT]


def pins_of_ros(lock: str) -> list[Pin]:
    """Return what runs ROS, without what builds workspaces. Raises ReleaseError."""
    pins = released_pins(lock)
    return [pin for pin in pins if pin.name.startswith('ros-') or pin.name in OF_ROS]


def wheels_from_sources(
    lock: str, venv: Path, folder: Path, environment: Mapping[str, str]
) -> list[Path]:
    """Make a wheel of each package that PyPI has none of; return their paths in ``folder``."""
    pins = [pin for pin in released_pins(lock) if pin.name in WITHOUT_WHEEL]
    requirements = write_requirements(folder / 'requirements.txt', pins)
    options = ['--no-deps', '--no-build-isolation', '--no-input', '--wheel-dir', os.fspath(folder)]
    options += [f'--no-binary={",".join(WITHOUT_WHEEL)}', '--require-hashes']
    command = [python_of(venv), '-m', 'pip', 'wheel', *options, '-r', requirements]
    run(command, environment, f'building {" and ".join(WITHOUT_WHEEL)}')
    return sorted(folder.glob('*.whl'))


def requirements_text(version: str, pins: Iterable[Pin], name: str, pythons: str) -> str:
    """
    Return the text of the file that pip reads.

    Args:
        version: that is released.
        pins: of everything, the wheels of the release first.
        name: of the file, for its head.
        pythons: that there are wheels of the interfaces for: ``3.12, 3.13``.
    """
    head = _HEAD.format(version=version, name=name, pythons=pythons)
    return head + ''.join(f'{pin.text()}\n' for pin in pins)
