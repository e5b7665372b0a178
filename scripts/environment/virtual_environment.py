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
import shutil
import sys

from . import locks, progress
from .checkout import PACKAGE
from .commands import beside, run
from .locks import Pin

WITHOUT_WHEEL = ('empy', 'flake8-quotes')


def python_of(venv: Path) -> Path:
    """Return the interpreter of a virtual environment."""
    return venv / 'bin' / 'python'


def site_packages(venv: Path) -> Path:
    """Return where the packages of an environment of this Python are."""
    major, minor = sys.version_info[:2]
    return venv / 'lib' / f'python{major}.{minor}' / 'site-packages'


def create(venv: Path, environment: Mapping[str, str], *, with_pip: bool = True) -> None:
    """Make an empty environment; without pip where this Python has none to put there."""
    shutil.rmtree(venv, ignore_errors=True)
    base = getattr(sys, '_base_executable', sys.executable)
    version = '.'.join(map(str, sys.version_info[:3]))
    progress(f'making an environment of Python {version} ({base}) ...')
    options = [] if with_pip else ['--without-pip']
    make = [base, '-m', 'venv', '--prompt', PACKAGE, *options, venv]
    run(make, environment, 'making the virtual environment')


def begin(venv: Path, lock: Path, environment: Mapping[str, str], first: tuple[str, ...]) -> None:
    """Install those that others are built with: what begins so; :func:`complete` the rest."""
    pins = locks.pins_of(lock.read_text())
    progress(f'installing {len(pins)} packages ...')
    # Before the others: those that have no wheel are built with it.
    _install(venv, [pins['setuptools']], environment)
    _install(venv, [pin for name, pin in pins.items() if name.startswith(first)], environment)


def complete(venv: Path, lock: Path, environment: Mapping[str, str]) -> None:
    """Install all that ``lock`` pins and that is not there."""
    _install(venv, list(locks.pins_of(lock.read_text()).values()), environment)


def _install(venv: Path, pins: Sequence[Pin], environment: Mapping[str, str]) -> None:
    """Install packages, half of them by each of two pips: one keeps a single core busy."""
    with beside(lambda: pip_install(venv, pins[1::2], environment)):
        pip_install(venv, pins[::2], environment)


def pip_install(
    venv: Path, pins: Sequence[Pin], environment: Mapping[str, str], target: Path | None = None
) -> None:
    """
    Install packages: never resolved, as every one is in a lock; no file but those whose hashes are
    there; never built from source, but those that have no wheel.

    Args:
        venv: whose pip to use.
        pins: the packages.
        environment: of pip.
        target: the folder to put them in; None: the environment.
    """
    import tempfile

    if not pins:
        return
    options = ['--no-deps', '--no-build-isolation', '--no-input', '--only-binary=:all:']
    options += [f'--no-binary={",".join(WITHOUT_WHEEL)}', '--require-hashes']
    options += ['--target', str(target)] if target else []
    with tempfile.TemporaryDirectory(prefix='amr-lock-') as scratch:
        lock = locks.write_requirements(Path(scratch, 'requirements.txt'), pins)
        command = [python_of(venv), '-m', 'pip', 'install', *options, '-r', lock]
        run(command, environment, 'installing packages', count=lambda lines: _count(lines, pins))


def _count(lines: Sequence[str], pins: Sequence[Pin]) -> str:
    """Return how far pip is by what it has printed; '' before it says so."""
    found = sum(line.startswith(('Collecting ', 'Requirement already')) for line in lines)
    if any(line.startswith('Installing collected') for line in lines):
        return f'unpacking {found} packages'
    return f'{found} of {len(pins)} packages fetched' if found else ''


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
