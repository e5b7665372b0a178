# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``.venv``, with exactly the versions of the lock file.

A new one is made beside the old, as ``.venv.new``, and takes its place at the end: programs that
run from the old one, and an interruption, do no harm. pip and venv write the environment's path
into a few text files of ``bin/``, which :func:`relocate` corrects.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
import re
import shutil
import sys

from . import progress, SetupError
from .checkout import PACKAGE
from .commands import beside, run

WITHOUT_WHEEL = ('empy', 'flake8-quotes')
REQUIREMENT = re.compile(r'^([A-Za-z0-9._-]+)==(\S+)')


def python_of(venv: Path) -> Path:
    """Return the interpreter of a virtual environment."""
    return venv / 'bin' / 'python'


def pinned_versions(lock: str) -> dict[str, str]:
    """Return name → version of a lock file's text; raise SetupError on a line that pins none."""
    pins = {}
    for number, line in enumerate(lock.splitlines(), 1):
        text = line.partition('#')[0].strip()
        if not text:
            continue
        match = REQUIREMENT.match(text)
        if not match or match[1] in pins:
            raise SetupError(f'requirements.lock:{number}: want one NAME==VERSION, got {text!r}')
        pins[match[1]] = match[2]
    return pins


def create(venv: Path, lock: Path, environment: Mapping[str, str], first: tuple[str, ...]) -> None:
    """
    Make the environment ``venv`` from nothing, with what is needed to build in it.

    Args:
        venv: where.
        lock: the lock file.
        environment: of the commands.
        first: what the names of the packages to install begin with; :func:`complete` the rest.
    """
    pins = pinned_versions(lock.read_text())
    shutil.rmtree(venv, ignore_errors=True)
    base = getattr(sys, '_base_executable', sys.executable)
    version = '.'.join(map(str, sys.version_info[:3]))
    progress(f'installing {len(pins)} packages for Python {version} ({base}) ...')
    make = [base, '-m', 'venv', '--prompt', PACKAGE, venv]
    run(make, environment, 'making the virtual environment')
    # Before the others: those that have no wheel are built with it.
    _install(venv, [f'setuptools=={pins["setuptools"]}'], environment)
    names = [name for name in pins if name.startswith(first)]
    _install(venv, [f'{name}=={pins[name]}' for name in names], environment)


def complete(venv: Path, lock: Path, environment: Mapping[str, str]) -> None:
    """Install all that ``lock`` pins and that is not there."""
    pins = pinned_versions(lock.read_text())
    _install(venv, [f'{name}=={version}' for name, version in pins.items()], environment)


def _install(venv: Path, what: Sequence[str], environment: Mapping[str, str]) -> None:
    """Install packages, half of them by each of two pips: one keeps a single core busy."""
    with beside(lambda: _pip_install(venv, what[1::2], environment)):
        _pip_install(venv, what[::2], environment)


def _pip_install(venv: Path, what: Sequence[str], environment: Mapping[str, str]) -> None:
    """
    Install packages: never resolved, as every one is in the lock; never built from source, but
    those that have no wheel.
    """
    if not what:
        return
    options = ['--no-deps', '--no-build-isolation', '--no-input', '--only-binary=:all:']
    options += [f'--no-binary={",".join(WITHOUT_WHEEL)}']
    hint = '; is the network there? `pip config list` shows the index used'
    command = [python_of(venv), '-m', 'pip', 'install', *options, *what]
    run(command, environment, 'installing packages', hint=hint)


def relocate(venv: Path, home: Path) -> None:
    """Make ``venv`` fit for being moved to ``home``: correct its path where it was written."""
    for file in [venv / 'pyvenv.cfg', *(venv / 'bin').iterdir()]:
        if file.is_symlink() or not file.is_file():
            continue
        content = file.read_bytes()
        if b'\0' in content[:1024]:  # a program, ruff say
            continue
        changed = content.replace(str(venv).encode(), str(home).encode())
        if changed != content:
            file.write_bytes(changed)


def replace(home: Path, fresh: Path) -> None:
    """Put ``fresh`` in the place of ``home``."""
    old = home.with_name(f'{home.name}.old')
    shutil.rmtree(old, ignore_errors=True)
    if home.exists():
        home.rename(old)
    fresh.rename(home)
    shutil.rmtree(old, ignore_errors=True)
