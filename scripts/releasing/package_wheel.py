# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
This package as two wheels: the simulation without ROS for any system, and what makes it a ROS.

The first is what setuptools makes of the checkout: modules, ``share/`` and the command ``amr``.
The second is the extra ``ros`` of the first: commands, executables where ``ros2 run`` looks,
hooks, and modules under their names in ROS. Who wants no ROS has none of these names.
"""

from collections.abc import Mapping
import configparser
import email
import os
from pathlib import Path
import tempfile

from environment import launchers
from environment.commands import run
from environment.virtual_environment import python_of

from releasing import archives, locks, prefix_files, sources
from releasing.archives import Member

_EXECUTABLES = 'amr_description.executables'
_METADATA = """\
Metadata-Version: 2.1
Name: amr-description-ros
Version: {version}
Summary: What makes a virtual environment with amr-description an installation of ROS 2 Jazzy
License: Apache-2.0
Requires-Python: {pythons}
{requires}
"""
_WHEEL = """\
Wheel-Version: 1.0
Generator: amr_description
Root-Is-Purelib: true
Tag: py3-none-any
"""


def build(
    root: Path, venv: Path, folder: Path, epoch: int, environment: Mapping[str, str]
) -> list[Path]:
    """
    Make both wheels from the files that git knows; return their paths.

    Args:
        root: the checkout.
        venv: whose setuptools to use.
        folder: where to.
        epoch: the time of all files in it, in seconds since 1970.
        environment: the variables of pip.
    """
    with tempfile.TemporaryDirectory(prefix='amr-release-') as scratch:
        copy = Path(scratch, 'sources')
        sources.copy(root, copy)
        command = [python_of(venv), '-m', 'pip', 'wheel', '--no-deps', '--no-index']
        command += ['--no-build-isolation', '--wheel-dir', scratch, os.fspath(copy)]
        run(command, environment, 'building the wheel of this package')
        (wheel,) = Path(scratch).glob('*.whl')
        members = archives.read(wheel)
        lock = (root / 'scripts' / 'requirements.lock').read_text(encoding='utf-8')
        return [archives.write(each, folder, epoch) for each in (members, of_ros(members, lock))]


def of_ros(package: Mapping[str, Member], lock: str) -> dict[str, Member]:
    """
    Return the files of the wheel that makes an environment with the other one a ROS prefix.

    Args:
        package: The files of the other one.
        lock: The text of requirements.lock, for the versions of what it requires.
    """
    own = archives.dist_info(package)
    metadata = email.message_from_bytes(package[f'{own}/METADATA'].content)
    version = metadata['Version']
    entry_points = _parsed(package[f'{own}/entry_points.txt'].content.decode())
    executables = [f'{name} = {path}' for name, path in entry_points[_EXECUTABLES].items()]
    required = [f'{name}=={version}' for name in ('amr-description', 'amr-description-interfaces')]
    required += [pin.requirement() for pin in locks.pins_of_ros(lock)]
    about = _METADATA.format(
        version=version,
        pythons=metadata['Requires-Python'],
        requires='\n'.join(f'Requires-Dist: {each}' for each in required),
    )
    table = package[str(launchers.STAND_INS)].content.decode()
    info = f'amr_description_ros-{version}'
    data = f'{info}.data'
    whole: dict[str, Member] = {}
    for folder, texts, executable in (
        (f'{info}.dist-info', {'METADATA': about, 'WHEEL': _WHEEL}, False),
        (f'{info}.dist-info', {'entry_points.txt': prefix_files.plugins()}, False),
        (f'{data}/scripts', prefix_files.commands(), True),
        (f'{data}/data/lib/{prefix_files.PACKAGE}', prefix_files.executables(executables), True),
        (f'{data}/data', prefix_files.tools(), True),
        (f'{data}/data', prefix_files.stand_ins(table, programs=True), True),
        (f'{data}/data', prefix_files.stand_ins(table, programs=False), False),
        (f'{data}/data', prefix_files.hooks() | prefix_files.cmake_packages(), False),
        ('', prefix_files.modules(), False),
    ):
        for name, text in texts.items():
            path = f'{folder}/{name}' if folder else name
            if path in whole or path in package:
                raise ValueError(f'{path} is twice in the wheels')
            whole[path] = Member(text.encode(), executable)
    return whole


def _parsed(text: str) -> configparser.ConfigParser:
    parser = configparser.ConfigParser(delimiters=('=',), interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign]  # names keep their case
    parser.read_string(text)
    return parser
