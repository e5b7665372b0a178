# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Make the wheel: build the packages, then hand setuptools the staged tree."""

import os
from pathlib import Path
import shutil
import sys

from setuptools import Distribution, setup
from setuptools.command.build import build

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))  # a copy of this folder has it on PYTHONPATH

from amr_description.interface_build.build import build as build_interfaces  # noqa: E402


class BinaryDistribution(Distribution):
    """Says that the wheel fits one Python and one platform, as setuptools sees no extension."""

    def has_ext_modules(self) -> bool:
        """Return True."""
        return True


class BuildInterfaces(build):
    """Build all, and put Python packages into site-packages, the rest into the prefix."""

    def run(self) -> None:
        """Run the build; called by setuptools."""
        base = Path(self.build_base).resolve()
        stage = base / 'stage'
        build_interfaces(HERE, stage, base / 'work')
        super().run()
        shutil.copytree(stage / 'python', self.build_lib, dirs_exist_ok=True)
        data_files: dict[str, list[str]] = {}
        for top in ('lib', 'share', 'include'):
            for path in sorted((stage / top).rglob('*')):
                if path.is_file():
                    target = str(path.parent.relative_to(stage))
                    data_files.setdefault(target, []).append(os.path.relpath(path, HERE))
        self.distribution.data_files = list(data_files.items())


setup(distclass=BinaryDistribution, cmdclass={'build': BuildInterfaces}, packages=[])
