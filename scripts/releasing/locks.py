# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The packages of PyPI, each with the hash of its file: what users of the wheels install.

The versions are those of ``scripts/requirements.lock``. pip itself says which file it takes of
each for CPython 3.12 on manylinux_2_28, and what its hash is; so a package without such a file is
found here and not by a user. Of the few that PyPI has only the sources of, a wheel is made here:
pip would build them with whatever setuptools is the newest on that day, which no hash holds.
"""

from collections.abc import Iterable, Mapping
import json
import os
from pathlib import Path
import re
import tempfile
from typing import Any

from environment import SetupError
from environment.commands import run
from environment.virtual_environment import pinned_versions, python_of, WITHOUT_WHEEL

from releasing import ReleaseError

DEVELOPMENT = (
    'apsw',
    'backports.zstd',
    'hypothesis',
    'rosbags',
    'ruamel.yaml',
    'ruff',
    'sortedcontainers',
)
"""What only the tests and the code of this project need."""
PLATFORMS = (
    *(f'manylinux_2_{minor}_x86_64' for minor in range(28, 4, -1)),
    'manylinux2014_x86_64',
    'manylinux2010_x86_64',
    'manylinux1_x86_64',
)
"""What manylinux_2_28 can load: pip takes such a list by the letter."""
PYTHON = (
    '--implementation=cp',
    '--python-version=3.12',
    '--abi=cp312',
    '--abi=abi3',
    '--abi=none',
)
_HEAD = """\
# amr_description {version} and all that it needs, for CPython 3.12 on x86-64 Linux with glibc 2.28
# or later.
# The wheels of the release lie beside this file; the others come from PyPI.
#     python3.12 -m venv ros
#     ros/bin/pip install --no-deps -r {name}
# --no-deps: it is complete, and leaves out what others require on paper and nothing here uses.
--find-links .
--only-binary :all:
"""


def released_pins(lock: str) -> dict[str, str]:
    """Return name → version of what users install. Raises ReleaseError."""
    try:
        pins = pinned_versions(lock)
    except SetupError as error:
        raise ReleaseError(str(error)) from None
    missing = [name for name in (*DEVELOPMENT, *WITHOUT_WHEEL) if name not in pins]
    if missing:
        raise ReleaseError(
            f'scripts/requirements.lock no longer has {", ".join(missing)}: take it out of '
            'DEVELOPMENT in scripts/releasing/locks.py, or WITHOUT_WHEEL in scripts/environment/'
        )
    return {name: version for name, version in pins.items() if name not in DEVELOPMENT}


def hashes_from_index(
    pins: Mapping[str, str], venv: Path, environment: Mapping[str, str]
) -> dict[str, str]:
    """
    Return name → SHA-256 of the file that pip takes of each package; nothing is installed.

    Args:
        pins: name → version.
        venv: whose pip to use.
        environment: the variables of pip, which name the index.

    Raises:
        SetupError: pip finds no file for one, or no index.
    """
    with tempfile.TemporaryDirectory(prefix='amr-release-') as scratch:
        report = Path(scratch, 'report.json')
        options = ['--dry-run', '--quiet', '--ignore-installed', '--no-deps', '--no-input']
        options += ['--only-binary=:all:', *PYTHON, f'--target={scratch}/target']
        options += [f'--platform={platform}' for platform in PLATFORMS]
        names = [f'{name}=={version}' for name, version in pins.items()]
        command = [python_of(venv), '-m', 'pip', 'install', *options, f'--report={report}', *names]
        run(command, environment, 'asking for the files of PyPI')
        return hashes_in_report(json.loads(report.read_text()), pins)


def hashes_in_report(report: Mapping[str, Any], pins: Iterable[str]) -> dict[str, str]:
    """Return name → SHA-256 of a report of pip, for these names. Raises ReleaseError."""
    found = {}
    for item in report['install']:
        hashes = item['download_info'].get('archive_info', {}).get('hashes', {})
        if 'sha256' in hashes:
            found[canonical(item['metadata']['name'])] = hashes['sha256']
    missing = [name for name in pins if canonical(name) not in found]
    if missing:
        raise ReleaseError(f'the index of pip gives no SHA-256 of {", ".join(missing)}')
    return {name: found[canonical(name)] for name in pins}


def wheels_from_sources(
    pins: Mapping[str, str], venv: Path, folder: Path, environment: Mapping[str, str]
) -> list[Path]:
    """Make a wheel of each package that PyPI has none of; return their paths in ``folder``."""
    names = [f'{name}=={pins[name]}' for name in WITHOUT_WHEEL]
    options = ['--no-deps', '--no-build-isolation', '--no-input', '--wheel-dir', os.fspath(folder)]
    options += [f'--no-binary={",".join(WITHOUT_WHEEL)}']
    command = [python_of(venv), '-m', 'pip', 'wheel', *options, *names]
    run(command, environment, f'building {" and ".join(WITHOUT_WHEEL)}')
    return sorted(folder.glob('*.whl'))


def requirements_text(
    version: str, pins: Mapping[str, str], hashes: Mapping[str, str], name: str
) -> str:
    """
    Return the text of the file that pip reads.

    Args:
        version: that is released.
        pins: name → version of everything, the wheels of the release first.
        hashes: name → SHA-256 of the file of each.
        name: of the file, for its head.
    """
    lines = [f'{each}=={pins[each]} --hash=sha256:{hashes[each]}' for each in pins]
    return '\n'.join([_HEAD.format(version=version, name=name) + lines[0], *lines[1:], ''])


def canonical(name: str) -> str:
    """Return the name of a distribution as indexes compare it (PEP 503)."""
    return re.sub(r'[-_.]+', '-', name).lower()
