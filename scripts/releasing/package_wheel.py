# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
This package as a wheel: what colcon installs, and what an environment needs to be a ROS prefix.

setuptools makes a wheel of the modules and of ``share/``. The executables it would put on the
PATH, all thirty; here they go where ``ros2 run`` looks, as with colcon.
"""

from collections.abc import Mapping
import configparser
import os
from pathlib import Path
import tempfile

from environment.commands import run
from environment.virtual_environment import python_of

from releasing import archives, prefix_files, sources
from releasing.archives import Member

_SCRIPTS = 'console_scripts'


def build(
    root: Path, venv: Path, folder: Path, epoch: int, environment: Mapping[str, str]
) -> Path:
    """
    Make the wheel from the files that git knows; return its path.

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
        return archives.write(completed(archives.read(wheel)), folder, epoch)


def completed(members: Mapping[str, Member]) -> dict[str, Member]:
    """Return the files of a wheel of setuptools with what makes it a ROS prefix."""
    info = archives.dist_info(members)
    data = f'{info.removesuffix(".dist-info")}.data'
    entry_points = _parsed(members[f'{info}/entry_points.txt'].content.decode())
    scripts = [f'{name} = {path}' for name, path in entry_points[_SCRIPTS].items()]
    entry_points.remove_section(_SCRIPTS)
    entry_points.read_string(prefix_files.plugins())
    whole = {
        **members,
        f'{info}/entry_points.txt': Member(_written(entry_points).encode()),
    }
    for folder, texts, executable in (
        (f'{data}/scripts', prefix_files.commands(), True),
        (f'{data}/data/lib/{prefix_files.PACKAGE}', prefix_files.executables(scripts), True),
        (f'{data}/data', prefix_files.tools(), True),
        (f'{data}/data', prefix_files.hooks() | prefix_files.cmake_packages(), False),
        ('', prefix_files.modules(), False),
    ):
        for name, text in texts.items():
            path = f'{folder}/{name}' if folder else name
            if path in whole:
                raise ValueError(f'{path} is twice in the wheel')
            whole[path] = Member(text.encode(), executable)
    return whole


def _parsed(text: str) -> configparser.ConfigParser:
    parser = configparser.ConfigParser(delimiters=('=',), interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign]  # names keep their case
    parser.read_string(text)
    return parser


def _written(parser: configparser.ConfigParser) -> str:
    blocks = [
        '\n'.join([f'[{name}]', *(f'{key} = {value}' for key, value in parser[name].items()), ''])
        for name in parser.sections()
    ]
    return '\n'.join(blocks)
