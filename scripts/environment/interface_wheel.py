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
import re
import shutil
import sys

from . import progress, SetupError, stamps
from .commands import run
from .virtual_environment import pinned_versions, python_of

# Reads .idl files. In a folder that only builds look into (interface_build/generators.py).
PARSER = 'lark-parser==0.12.0'
PARSER_FOLDER = 'lib/interface_build'
# The modules of interface_build/ that the wheel is built by: another one needs no new wheel.
BUILDER = ('build', 'generators', 'libraries', 'packages', 'records', 'stage', 'toolchain')
# The compiler that needs no root: a wheel, for machines without gcc and clang.
ZIG = 'ziglang==0.17.1'
NO_COMPILER = 3  # exit code of `interface_build --check`
# What the build reads of the environment: headers, generators, the template engine, numpy's ABI.
COMPILED_AGAINST = ('ros-', 'numpy', 'empy', 'setuptools')
# Of what begins so, what it does not read: CMake's side of ROS, for workspaces of users.
NOT_COMPILED_AGAINST = re.compile(r'ros-(jazzy-)?(ament-(cmake|package)|domain-coordinator)')
NEEDED_TO_BUILD = (*COMPILED_AGAINST, 'catkin-pkg', 'PyYAML')


def key(interfaces: Path, lock: Path) -> str:
    """Return the hash of everything that the wheel depends on."""
    pins = pinned_versions(lock.read_text())
    against = [
        f'{name}=={version}'
        for name, version in sorted(pins.items())
        if name.startswith(COMPILED_AGAINST) and not NOT_COMPILED_AGAINST.match(name)
    ]
    files = [*stamps.files_below(interfaces), *builder_files(interfaces.parent)]
    sources = stamps.digest_files(files, interfaces.parent)
    python = sys.implementation.cache_tag or ''
    return stamps.digest(sources, *against, PARSER, python, platform.machine())


def builder_files(root: Path) -> list[Path]:
    """Return the modules of the checkout ``root`` that the wheel is built by."""
    return [root / 'amr_description' / 'interface_build' / f'{name}.py' for name in BUILDER]


def install_parser(venv: Path, environment: Mapping[str, str]) -> None:
    """Install what reads ``.idl`` files, unless it is there."""
    target = venv / PARSER_FOLDER
    if not target.is_dir():
        fetch = [python_of(venv), '-m', 'pip', 'install', '--no-deps', '--only-binary=:all:']
        run([*fetch, '--target', target, PARSER], environment, f'fetching {PARSER}')


def install(
    interfaces: Path, lock: Path, venv: Path, cache: Path, environment: Mapping[str, str]
) -> None:
    """
    Install the wheel into ``venv``, from the cache or built there and then, and what users need to
    build interface packages of their own.
    """
    install_parser(venv, environment)
    wheel = built(interfaces, lock, venv, cache, environment)
    options = ['--no-deps', '--no-index', '--force-reinstall']
    command = [python_of(venv), '-m', 'pip', 'install', *options, wheel]
    run(command, environment, f'installing {wheel.name}')


def built(
    interfaces: Path, lock: Path, venv: Path, cache: Path, environment: Mapping[str, str]
) -> Path:
    """Return the wheel in the cache; ``venv``, to build it, has :data:`NEEDED_TO_BUILD`."""
    folder = cache / 'interfaces' / key(interfaces, lock)[:24]
    if not list(folder.glob('*.whl')):
        _build(interfaces, venv, folder, environment)
    return next(folder.glob('*.whl'))


def _build(interfaces: Path, venv: Path, target: Path, environment: Mapping[str, str]) -> None:
    """Build in a copy, which keeps the sources clean, and move the wheel to ``target``."""
    import tempfile

    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix='amr-interfaces-') as scratch:
        environment = _with_tools(interfaces, venv, Path(scratch), environment)
        copy = Path(scratch, 'interfaces')
        shutil.copytree(interfaces, copy, ignore=shutil.ignore_patterns(*stamps.IGNORED))
        progress(
            'compiling the interface packages that PyPI lacks, once for this machine: two to four '
            'minutes on two cores ...'
        )
        fresh = Path(tempfile.mkdtemp(dir=target.parent, prefix='unfinished-'))
        options = ['--no-deps', '--no-index', '--no-build-isolation', '--wheel-dir', fresh]
        try:
            command = [python_of(venv), '-m', 'pip', 'wheel', *options, copy]
            run(command, environment, 'building interfaces/')
            shutil.rmtree(target, ignore_errors=True)
            fresh.rename(target)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)


def _with_tools(
    interfaces: Path, venv: Path, scratch: Path, environment: Mapping[str, str]
) -> Mapping[str, str]:
    """Return the environment to build in: with the parser, and a compiler if there is none."""
    import subprocess

    install_parser(venv, environment)
    tools, root = scratch / 'tools', interfaces.parent
    environment = {
        **environment,
        'PYTHONPATH': f'{tools}{os.pathsep}{root}',
        'ZIG_GLOBAL_CACHE_DIR': os.fspath(scratch / 'zig-cache'),
    }
    fetch = [python_of(venv), '-m', 'pip', 'install', '--no-deps', '--only-binary=:all:']
    fetch += ['--target', tools]
    check = subprocess.run(
        [python_of(venv), '-P', root / 'amr_description' / 'interface_build', '--check'],
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
    )
    complaint = check.stderr.strip().removeprefix('error: ')
    if check.returncode == NO_COMPILER:
        progress('no C++ compiler here; fetching zig from PyPI for this once (100 MB) ...')
        try:
            run([*fetch, ZIG], environment, f'fetching {ZIG}')
        except SetupError as error:
            raise SetupError(f'{complaint}\n{error}') from None
    elif check.returncode != 0:
        raise SetupError(complaint)
    return environment
