# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ROS needs of the package `amr_description` beside pyproject.toml, which has all else.

Data files in ``share/``, and executables in ``lib/amr_description/``, where ``ros2 run`` looks.
"""

from collections.abc import Iterator
import os
from pathlib import Path
import subprocess

from setuptools import setup
from setuptools.command.develop import develop
from setuptools.command.install_scripts import install_scripts

PACKAGE = 'amr_description'
EXECUTABLES = f'{PACKAGE}.executables'
"""The group of entry points in pyproject.toml."""
EXECUTABLE = """\
{header}
# Written by setup.py. Whatever PYTHONPATH says, the modules are those that were installed with it:
# a workspace may have a package of the same name.
import sys

sys.path.insert(0, {folder!r})
from {module} import {name}

sys.exit({name}{attributes}())
"""
SHARED_FOLDERS = ('urdf', 'config')


def shared_files(folder: str) -> list[tuple[str, list[str]]]:
    """Return (target, files) of every directory below `folder`, as `data_files` wants them."""
    directories = [Path(folder), *(path for path in Path(folder).rglob('*') if path.is_dir())]
    found = {
        directory: sorted(str(path) for path in directory.iterdir() if path.is_file())
        for directory in sorted(directories)
    }
    return [(f'share/{PACKAGE}/{directory}', files) for directory, files in found.items() if files]


class OwnExecutables:
    """
    Writes executables that need no metadata of the package, as those of setuptools do.

    To find the metadata takes 15 ms, of 150 to 250 ms that a node needs to start.
    """

    def executables(self, folder: str) -> Iterator[tuple[str, str]]:
        """
        Yield the name and the text of each executable.

        Args:
            folder: That has the modules.
        """
        python = self.get_finalized_command('build_scripts').executable
        header = f'#!{subprocess.list2cmdline([python])}'
        for line in self.distribution.entry_points[EXECUTABLES]:
            executable, entry_point = map(str.strip, line.split('='))
            module, _, path = entry_point.partition(':')
            name, dot, attributes = path.partition('.')
            yield (
                executable,
                EXECUTABLE.format(
                    header=header,
                    folder=folder,
                    module=module,
                    name=name,
                    attributes=dot + attributes,
                ),
            )


class Develop(OwnExecutables, develop):
    """``colcon build --symlink-install``."""

    def install_wrapper_scripts(self, dist: object) -> None:
        """As in setuptools; the modules are in the folder that links to the sources."""
        for name, text in self.executables(os.path.abspath(self.egg_base)):
            self.write_script(name, text)


class InstallScripts(OwnExecutables, install_scripts):
    """``colcon build``; a wheel has none."""

    def run(self) -> None:
        """As in setuptools; the modules are in the folder that they are copied to."""
        self.outfiles = []
        if self.no_ep:  # a wheel
            return
        modules = os.path.abspath(self.get_finalized_command('install').install_lib)
        for name, text in self.executables(modules):
            self.write_script(name, text)


setup(
    license='Apache-2.0',
    python_requires='>=3.11,<3.15',  # those that scripts/requirements.lock is for
    cmdclass={'develop': Develop, 'install_scripts': InstallScripts},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        # colcon links what is named here into the folder in which it runs this file.
        (f'share/{PACKAGE}', ['package.xml', 'pyproject.toml']),
        *(entry for folder in SHARED_FOLDERS for entry in shared_files(folder)),
    ],
)
