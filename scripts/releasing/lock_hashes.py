# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``scripts/lock``: write the hashes of the lock files, for every Python that they are for.

pip itself says which file it takes of each package on manylinux_2_28, and what its hash is; so a
package without such a file is found here and not by a user.
"""

from collections.abc import Iterable, Mapping
import json
import os
from pathlib import Path
import sys
import tempfile
from typing import Any

import environment as setup_parts
from environment import host, locks, say, SetupError
from environment.checkout import Checkout
from environment.commands import run
from environment.locks import canonical, Pin
from environment.virtual_environment import python_of, WITHOUT_WHEEL

PLATFORMS = (
    *(f'manylinux_2_{minor}_x86_64' for minor in range(28, 4, -1)),
    'manylinux2014_x86_64',
    'manylinux2010_x86_64',
    'manylinux1_x86_64',
)
"""What manylinux_2_28 can load: pip takes such a list by the letter."""
FAILED, INTERRUPTED = 1, 130


def main(arguments: list[str], environment: Mapping[str, str] = os.environ) -> int:
    """Write the lock files anew; return the exit code."""
    setup_parts.program = 'scripts/lock'
    if arguments:
        say(f'takes no arguments, got {" ".join(arguments)}')
        return 2
    checkout = Checkout(Path(__file__).resolve().parents[2])
    variables = host.clean_environment(environment)
    try:
        for lock in sorted(checkout.scripts.glob('*.lock')):
            if lock.name in locks.WITHOUT_HASHES:
                continue
            say(f'{lock.name} ...')
            lock.write_text(with_hashes(lock.read_text(), checkout.venv, variables))
    except (SetupError, OSError) as error:
        say(f'error: {error}')
        return FAILED
    except KeyboardInterrupt:
        say('interrupted; run it again to go on')
        return INTERRUPTED
    return 0


def with_hashes(lock: str, venv: Path, environment: Mapping[str, str]) -> str:
    """
    Return the text of a lock file with the hashes of today's files.

    Args:
        lock: its text.
        venv: whose pip to use.
        environment: the variables of pip, which name the index.

    Raises:
        SetupError: pip finds no file for a package, or no index.
    """
    found: dict[tuple[str, str], set[str]] = {}
    for python in locks.PYTHONS:
        pins = list(locks.pins_of(lock, python).values())
        for is_wheel in (True, False):
            some = [pin for pin in pins if (pin.name not in WITHOUT_WHEEL) == is_wheel]
            options = _for_wheels(python) if is_wheel else ['--no-build-isolation']
            hashes = _hashes(some, options, venv, environment) if some else {}
            for pin in some:
                found.setdefault((pin.name, pin.version), set()).add(hashes[pin.name])
    lines = [
        each if isinstance(each, str) else _hashed(each, found).text()
        for each in locks.parse(lock)
    ]
    return '\n'.join([*lines, ''])


def _hashed(pin: Pin, found: Mapping[tuple[str, str], set[str]]) -> Pin:
    return pin._replace(hashes=tuple(sorted(found[pin.name, pin.version])))


def _for_wheels(python: tuple[int, int]) -> list[str]:
    major, minor = python
    return [
        '--only-binary=:all:',
        '--implementation=cp',
        f'--python-version={major}.{minor}',
        f'--abi=cp{major}{minor}',
        '--abi=abi3',
        '--abi=none',
        *(f'--platform={platform}' for platform in PLATFORMS),
    ]


def _hashes(
    pins: Iterable[Pin], options: list[str], venv: Path, environment: Mapping[str, str]
) -> dict[str, str]:
    """Return name → hash of the file that pip takes of each package; nothing is installed."""
    with tempfile.TemporaryDirectory(prefix='amr-lock-') as scratch:
        report = Path(scratch, 'report.json')
        command = [python_of(venv), '-m', 'pip', 'install', '--dry-run', '--quiet', '--no-deps']
        command += ['--ignore-installed', '--no-input', f'--target={scratch}/target', *options]
        command += [f'--no-binary={",".join(WITHOUT_WHEEL)}', f'--report={report}']
        names = [f'{pin.name}=={pin.version}' for pin in pins]
        run([*command, *names], environment, 'asking for the files of PyPI')
        return hashes_in_report(json.loads(report.read_text()), [pin.name for pin in pins])


def hashes_in_report(report: Mapping[str, Any], names: Iterable[str]) -> dict[str, str]:
    """Return name → ``sha256:…`` of a report of pip, for these names. Raises SetupError."""
    found = {}
    for item in report['install']:
        hashes = item['download_info'].get('archive_info', {}).get('hashes', {})
        if 'sha256' in hashes:
            found[canonical(item['metadata']['name'])] = f'sha256:{hashes["sha256"]}'
    missing = [name for name in names if canonical(name) not in found]
    if missing:
        raise SetupError(f'the index of pip gives no SHA-256 of {", ".join(missing)}')
    return {name: found[canonical(name)] for name in names}


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
