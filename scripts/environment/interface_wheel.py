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
from .checkout import Checkout
from .commands import run
from .locks import pinned_versions, pins_of
from .virtual_environment import pip_install, python_of

# Reads .idl files. In a folder that only builds look into (interface_build/generators.py).
PARSER = 'lark-parser'
PARSER_FOLDER = 'lib/interface_build'
# The modules of interface_build/ that the wheel is built by: another one needs no new wheel.
BUILDER = ('build', 'generators', 'libraries', 'packages', 'records', 'stage', 'toolchain')
# The compiler that needs no root: a wheel, for machines without gcc and clang.
ZIG = 'ziglang'
NO_COMPILER = 3  # exit code of `interface_build --check`
# What the build reads of the environment: headers, generators, the template engine, numpy's ABI.
COMPILED_AGAINST = ('ros-', 'numpy', 'empy', 'setuptools')
# Of what begins so, what it does not read: CMake's side of ROS, for workspaces of users.
NOT_COMPILED_AGAINST = re.compile(r'ros-(jazzy-)?(ament-(cmake|package)|domain-coordinator)')
NEEDED_TO_BUILD = (*COMPILED_AGAINST, 'catkin-pkg', 'PyYAML')


def key(checkout: Checkout) -> str:
    """Return the hash of everything that the wheel depends on."""
    pins = pinned_versions(checkout.requirements.read_text())
    against = [
        f'{name}=={version}'
        for name, version in sorted(pins.items())
        if name.startswith(COMPILED_AGAINST) and not NOT_COMPILED_AGAINST.match(name)
    ]
    tools = pinned_versions(checkout.tools.read_text(), name=checkout.tools.name)
    parser = f'{PARSER}=={tools[PARSER]}'
    files = [*stamps.files_below(checkout.interfaces), *builder_files(checkout.root)]
    sources = stamps.digest_files(files, checkout.root)
    python = sys.implementation.cache_tag or ''
    return stamps.digest(sources, *against, parser, python, platform.machine())


def builder_files(root: Path) -> list[Path]:
    """Return the modules of the checkout ``root`` that the wheel is built by."""
    return [root / 'amr_description' / 'interface_build' / f'{name}.py' for name in BUILDER]


def install_parser(checkout: Checkout, venv: Path, environment: Mapping[str, str]) -> None:
    """Install what reads ``.idl`` files, unless it is there."""
    target = venv / PARSER_FOLDER
    if not target.is_dir():
        pins = pins_of(checkout.tools.read_text(), name=checkout.tools.name)
        pip_install(venv, [pins[PARSER]], environment, target)


def install(checkout: Checkout, venv: Path, cache: Path, environment: Mapping[str, str]) -> None:
    """
    Install the wheel into ``venv``, from the cache or built there and then, and what users need to
    build interface packages of their own.
    """
    install_parser(checkout, venv, environment)
    wheel = built(checkout, venv, cache, environment)
    options = ['--no-deps', '--no-index', '--force-reinstall']
    command = [python_of(venv), '-m', 'pip', 'install', *options, wheel]
    run(command, environment, f'installing {wheel.name}')


def built(checkout: Checkout, venv: Path, cache: Path, environment: Mapping[str, str]) -> Path:
    """Return the wheel in the cache; ``venv``, to build it, has :data:`NEEDED_TO_BUILD`."""
    folder = cache / 'interfaces' / key(checkout)[:24]
    if not list(folder.glob('*.whl')):
        _build(checkout, venv, folder, environment)
    return next(folder.glob('*.whl'))


def _build(checkout: Checkout, venv: Path, target: Path, environment: Mapping[str, str]) -> None:
    """Build in a copy, which keeps the sources clean, and move the wheel to ``target``."""
    import tempfile

    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix='amr-interfaces-') as scratch:
        environment = _with_tools(checkout, venv, Path(scratch), environment)
        copy = Path(scratch, 'interfaces')
        shutil.copytree(checkout.interfaces, copy, ignore=shutil.ignore_patterns(*stamps.IGNORED))
        progress(
            'compiling the interface packages that PyPI lacks, once for this machine: two to four '
            'minutes on two cores ...'
        )
        fresh = Path(tempfile.mkdtemp(dir=target.parent, prefix='unfinished-'))
        options = ['--no-deps', '--no-index', '--no-build-isolation', '--wheel-dir', fresh]
        try:
            command = [python_of(venv), '-m', 'pip', 'wheel', *options, copy]
            work = copy / 'build' / 'work'
            run(command, environment, 'building interfaces/', count=lambda _: _compiled(work))
            shutil.rmtree(target, ignore_errors=True)
            fresh.rename(target)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)


def _compiled(work: Path) -> str:
    """Return how far the compiler is; '' before it begins."""
    sources = sum(1 for pattern in ('unit_*.c*', '*.ep.*.c') for _ in work.rglob(pattern))
    objects = sum(1 for _ in work.rglob('*.o'))
    if objects == sources:
        return 'linking' if objects else ''
    return f'{objects} of {sources} files compiled' if objects else ''


def _with_tools(
    checkout: Checkout, venv: Path, scratch: Path, environment: Mapping[str, str]
) -> Mapping[str, str]:
    """Return the environment to build in: with the parser, and a compiler if there is none."""
    import subprocess

    install_parser(checkout, venv, environment)
    tools, root = scratch / 'tools', checkout.root
    environment = {
        **environment,
        'PYTHONPATH': f'{tools}{os.pathsep}{root}',
        'ZIG_GLOBAL_CACHE_DIR': os.fspath(scratch / 'zig-cache'),
    }
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
            pins = pins_of(checkout.tools.read_text(), name=checkout.tools.name)
            pip_install(venv, [pins[ZIG]], environment, tools)
        except SetupError as error:
            raise SetupError(f'{complaint}\n{error}') from None
    elif check.returncode != 0:
        raise SetupError(complaint)
    return environment
