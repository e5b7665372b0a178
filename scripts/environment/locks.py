# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
r"""
The lock files: which version of each package, and the hashes of its files.

They are requirement files of pip. Where Pythons need different versions, or some need none, a line
has a marker; ``scripts/lock`` writes the hashes below each line::

    numpy==2.4.6 ; python_version < "3.12" \
        --hash=sha256:…
"""

from collections.abc import Iterable, Iterator
from pathlib import Path
import re
import sys
from typing import NamedTuple

from . import SetupError

PYTHONS = ((3, 12), (3, 13), (3, 14), (3, 11))
"""Those that all files are locked for; ``scripts/setup`` prefers them in this order."""

WITHOUT_HASHES = ('engine.lock', 'engine-tests.lock')
"""Those of the simulation without ROS: they are for any system, each of which has other files."""

_PIN = re.compile(r'([A-Za-z0-9._-]+)==(\S+)(?: *; *(python_version *(?:<|>=) *"3\.\d+"))?')
_HASH = re.compile(r' +--hash=(sha256:[0-9a-f]{64})')


class Pin(NamedTuple):
    """One line of a lock file, with what continues it."""

    name: str
    version: str
    marker: str = ''
    """Of the Pythons that it is for: ``python_version < "3.12"``; empty: all."""
    hashes: tuple[str, ...] = ()

    def is_for(self, python: tuple[int, int]) -> bool:
        """Say whether this Python, (3, 12), needs it."""
        match = re.search(r'(<|>=) *"3\.(\d+)"', self.marker)
        return not match or (python < (3, int(match[2]))) == (match[1] == '<')

    def requirement(self) -> str:
        """Return it without its hashes."""
        marker = f' ; {self.marker}' if self.marker else ''
        return f'{self.name}=={self.version}{marker}'

    def text(self) -> str:
        """Return it as it stands in the file."""
        hashes = (f'    --hash={each}' for each in self.hashes)
        return ' \\\n'.join([self.requirement(), *hashes])


def parse(text: str, name: str = 'requirements.lock') -> Iterator[Pin | str]:
    """Yield the pins of a lock file, for any Python, and the lines between. Raises SetupError."""
    lines = iter(enumerate(text.splitlines(), 1))
    for number, line in lines:
        whole = line.partition('#')[0].rstrip()
        while whole.endswith('\\'):
            whole = whole[:-1].rstrip() + next(lines, (0, ''))[1].rstrip()
        if not whole:
            yield line
            continue
        match = _PIN.match(whole)
        rest = whole[match.end() :] if match else ''
        if not match or _HASH.sub('', rest).strip():
            raise SetupError(f'{name}:{number}: want one NAME==VERSION, got {whole!r}')
        yield Pin(match[1], match[2], match[3] or '', tuple(_HASH.findall(rest)))


def pins_of(
    lock: str, python: tuple[int, int] | None = None, *, name: str = 'requirements.lock'
) -> dict[str, Pin]:
    """
    Return the pins for a Python, this one unless it is given, by their names.

    ``name``: of the file.

    Raises SetupError, also when there are two for a name.
    """
    python = python or sys.version_info[:2]
    pins: dict[str, Pin] = {}
    for pin in parse(lock, name):
        if isinstance(pin, str) or not pin.is_for(python):
            continue
        if pin.name in pins:
            raise SetupError(f'{name}: want one version of {pin.name}, got two')
        pins[pin.name] = pin
    return pins


def pinned_versions(
    lock: str, python: tuple[int, int] | None = None, *, name: str = 'requirements.lock'
) -> dict[str, str]:
    """Return name → version for a Python, this one unless it is given. Raises SetupError."""
    return {name: pin.version for name, pin in pins_of(lock, python, name=name).items()}


def canonical(name: str) -> str:
    """Return the name of a distribution as indexes compare it (PEP 503)."""
    return re.sub(r'[-_.]+', '-', name).lower()


def write_requirements(file: Path, pins: Iterable[Pin]) -> Path:
    """Write what pip installs from, with ``--require-hashes``; return its path."""
    file.write_text(''.join(f'{pin.text()}\n' for pin in pins))
    return file
