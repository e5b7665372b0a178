# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``colcon build --symlink-install`` of the checkout, which is a workspace and its only package.

Edits of modules and data files need no build: all is linked. What does: another pyproject.toml,
setup.py, setup.cfg or package.xml, and a data file that comes or goes, as the build globs these.
"""

from collections.abc import Mapping
import os
from pathlib import Path
import shutil

from . import progress, stamps
from .checkout import Checkout, PACKAGE
from .commands import run
from .virtual_environment import python_of, site_packages

MANIFESTS = ('pyproject.toml', 'setup.py', 'setup.cfg', 'package.xml')
DATA_FOLDERS = ('urdf', 'config')
LONGEST_FIRST_LINE = 127  # bytes, of Linux before 5.1


def key(checkout: Checkout) -> str:
    """Return the hash of everything that the build looks at."""
    root = checkout.root
    manifests = [root / name for name in MANIFESTS]
    data = [
        str(file.relative_to(root))
        for folder in DATA_FOLDERS
        for file in stamps.files_below(root / folder)
    ]
    return stamps.digest(
        str(root), stamps.digest_files(manifests, root), checkout.requirements.read_bytes(), *data
    )


def is_complete(checkout: Checkout) -> bool:
    """
    Say whether a build is there that is linked to these sources.

    One may have moved the checkout, deleted ``build/`` alone, have run a plain ``colcon build``,
    which copies, or chosen another Python.
    """
    link, modules = checkout.build / PACKAGE, checkout.root / PACKAGE
    linked = link.is_symlink() and link.resolve() == modules.resolve()
    return linked and site_packages(checkout.install).is_dir()


def build(checkout: Checkout, environment: Mapping[str, str], on_top: bool) -> None:
    """
    Build: from nothing, or on top of a finished earlier build.

    On top, the link to the modules stays, for the sake of running programs. colcon would leave
    links to files, and executables, that are gone: those folders are emptied first.
    """
    progress('building the package with colcon ...')
    stale = [checkout.build, checkout.install]
    if on_top:
        stale = [checkout.install / 'share' / PACKAGE, checkout.install / 'lib' / PACKAGE]
        stale += [checkout.build / folder for folder in DATA_FOLDERS]
    for folder in stale:
        shutil.rmtree(folder, ignore_errors=True)
    run(
        [python_of(checkout.venv), '-m', 'colcon', 'build', '--symlink-install'],
        workspace_environment(checkout, environment),
        'colcon build',
        checkout.root,
    )
    bytecode = ['-m', 'compileall', '-q', '-j', '0', checkout.root / PACKAGE]
    run([python_of(checkout.venv), *bytecode], environment, 'compiling to bytecode')
    for executable in (checkout.install / 'lib' / PACKAGE).iterdir():
        make_startable(executable, python_of(checkout.venv))


def make_startable(executable: Path, python: Path) -> None:
    """
    Have ``executable`` start by way of the shell where the kernel cannot find ``python``.

    That is when its path has spaces, or is longer than the first line of a script may be. Shell
    and Python both read the new beginning; pip gives its executables the same.
    """
    first_line, _, rest = executable.read_text().partition('\n')
    if first_line.startswith('#!"') or len(first_line) > LONGEST_FIRST_LINE:
        start = f"#!/bin/sh\n'''exec' \"{python}\" \"$0\" \"$@\"\n' '''\n"
        executable.write_text(start + rest)


def workspace_environment(checkout: Checkout, environment: Mapping[str, str]) -> dict[str, str]:
    """Return the environment in which colcon sees ``.venv`` as the underlay."""
    path = f'{checkout.venv / "bin"}{os.pathsep}{environment.get("PATH", os.defpath)}'
    return {**environment, 'PATH': path, 'AMENT_PREFIX_PATH': str(checkout.venv)}


def stamp_folder(checkout: Checkout) -> Path:
    """Return the folder whose disappearance makes the build stale."""
    return checkout.root / 'install'
