# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``interfaces/`` as a wheel.

Compiling takes most of a minute, so the wheel is kept in the user's cache under a hash of all
that it is made of; a second clone installs it in a second.
"""

from collections.abc import Mapping
import os
from pathlib import Path
import platform
import shutil
import subprocess
import sys
import tempfile

from . import say, SetupError, stamps
from .commands import run
from .virtual_environment import pinned_versions, python_of

# The compiler that needs no root: a wheel, for machines without gcc and clang.
ZIG = 'ziglang==0.17.1'
NO_COMPILER = 3  # exit code of `python -m interface_build --check`
# What the build reads of the environment: headers, generators, the template engine, numpy's ABI.
COMPILED_AGAINST = ('ros-', 'numpy', 'empy', 'lark-parser', 'setuptools')


def key(interfaces: Path, lock: Path) -> str:
    """Return the hash of everything that the wheel depends on."""
    pins = pinned_versions(lock.read_text())
    against = [
        f'{name}=={version}'
        for name, version in sorted(pins.items())
        if name.startswith(COMPILED_AGAINST)
    ]
    return stamps.digest(
        stamps.digest_files(stamps.files_below(interfaces), interfaces),
        *against,
        sys.implementation.cache_tag or '',
        platform.machine(),
    )


def install(
    interfaces: Path, lock: Path, venv: Path, cache: Path, environment: Mapping[str, str]
) -> None:
    """Install the wheel into ``venv``, from the cache or built there and then."""
    folder = cache / 'interfaces' / key(interfaces, lock)[:24]
    if not list(folder.glob('*.whl')):
        _build(interfaces, venv, folder, environment)
    wheel = next(folder.glob('*.whl'))
    command = [
        python_of(venv),
        '-m',
        'pip',
        'install',
        '--no-deps',
        '--no-index',
        '--force-reinstall',
        wheel,
    ]
    run(command, environment, f'installing {wheel.name}')


def _build(interfaces: Path, venv: Path, target: Path, environment: Mapping[str, str]) -> None:
    """Build in a copy, which keeps the sources clean, and move the wheel to ``target``."""
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix='amr-interfaces-') as folder:
        environment = _with_compiler(interfaces, venv, Path(folder), environment)
        copy = Path(folder, 'interfaces')
        shutil.copytree(interfaces, copy, ignore=shutil.ignore_patterns(*stamps.IGNORED))
        say('compiling the interface packages that PyPI lacks, a minute or so ...')
        fresh = Path(tempfile.mkdtemp(dir=target.parent, prefix='unfinished-'))
        try:
            command = [
                python_of(venv),
                '-m',
                'pip',
                'wheel',
                '--no-deps',
                '--no-index',
                '--no-build-isolation',
                '--wheel-dir',
                fresh,
                copy,
            ]
            run(command, environment, 'building interfaces/')
            shutil.rmtree(target, ignore_errors=True)
            fresh.rename(target)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)


def _with_compiler(
    interfaces: Path, venv: Path, scratch: Path, environment: Mapping[str, str]
) -> Mapping[str, str]:
    """Return the environment to build in: as it is if it has a compiler, else with zig's."""
    check = subprocess.run(
        [python_of(venv), '-m', 'interface_build', '--check'],
        cwd=interfaces,
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
    )
    if check.returncode == 0:
        return environment
    if check.returncode != NO_COMPILER:
        raise SetupError(check.stderr.strip().removeprefix('error: '))
    say('no C++ compiler here; fetching zig from PyPI for this once (100 MB) ...')
    packages = scratch / 'zig'
    fetch = [
        python_of(venv),
        '-m',
        'pip',
        'install',
        '--no-deps',
        '--only-binary=:all:',
        '--target',
        packages,
        ZIG,
    ]
    try:
        run(fetch, environment, f'fetching {ZIG}')
    except SetupError as error:
        raise SetupError(f'{check.stderr.strip().removeprefix("error: ")}\n{error}') from None
    return {
        **environment,
        'PYTHONPATH': os.fspath(packages),
        'ZIG_GLOBAL_CACHE_DIR': os.fspath(scratch / 'zig-cache'),
    }
