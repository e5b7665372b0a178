# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which system the compiled libraries of a wheel need, read by ``objdump`` and ``readelf``.

The loader refuses a library that names a version of a symbol that its glibc or libstdc++ does not
have. manylinux_2_28 (PEP 600) is what every Linux with glibc 2.28 and the libstdc++ of GCC 8 has.
"""

from collections.abc import Collection, Iterable, Iterator
import os
from pathlib import Path
import re
import subprocess

from releasing import ReleaseError

PLATFORM = 'manylinux_2_28_x86_64'
LIMITS = {
    'GLIBC': (2, 28),
    'GLIBCXX': (3, 4, 24),
    'CXXABI': (1, 3, 11),
    'GCC': (7, 0, 0),
}
"""The newest version of each kind that the platform has; of any other kind it has none."""
SYSTEM_LIBRARIES = {
    'ld-linux-x86-64.so.2',
    'libc.so.6',
    'libdl.so.2',
    'libgcc_s.so.1',
    'libm.so.6',
    'libpthread.so.0',
    'librt.so.1',
    'libstdc++.so.6',
}
_COMMENT = re.compile(r'^ +\[ *[0-9a-f]+\] +(.+)$', re.MULTILINE)
_NEEDED = re.compile(r'^ +NEEDED +(\S+)$', re.MULTILINE)
_VERSION = re.compile(r'^ +0x[0-9a-f]+ 0x[0-9a-f]+ \d+ (\S+)$', re.MULTILINE)


def headers(library: Path) -> str:
    """Return what ``objdump -p`` prints of a library. Raises ReleaseError."""
    return _printed('objdump', '-p', library)


def compilers(libraries: Iterable[Path]) -> list[str]:
    """Return the compilers that left their names in libraries. Raises ReleaseError."""
    printed = _printed('readelf', '--string-dump=.comment', *libraries)
    return sorted({' '.join(name.split()) for name in _COMMENT.findall(printed)})


def _printed(program: str, *words: str | Path) -> str:
    """Return what a program of binutils prints. Raises ReleaseError."""
    try:
        done = subprocess.run(
            [program, *words], capture_output=True, text=True, env={**os.environ, 'LC_ALL': 'C'}
        )
    except FileNotFoundError:
        raise ReleaseError(
            f'there is no {program} here, which reads libraries (Debian, Ubuntu: binutils)'
        ) from None
    if done.returncode != 0:
        raise ReleaseError(f'{program}: {done.stderr.strip()}')
    return done.stdout


def needed_versions(text: str) -> list[str]:
    """Return the versions of symbols that a library needs: ``GLIBC_2.2.5``."""
    _, _, references = text.partition('Version References:')
    return _VERSION.findall(references)


def needed_libraries(text: str) -> list[str]:
    """Return the libraries that a library is linked to: ``libc.so.6``."""
    return _NEEDED.findall(text)


def is_provided(version: str) -> bool:
    """Return whether the platform has a version of symbols."""
    kind, _, number = version.rpartition('_')
    limit = LIMITS.get(kind)
    if limit is None or not re.fullmatch(r'[\d.]+', number):
        return False
    return tuple(map(int, number.split('.'))) <= limit


def faults(name: str, text: str, provided: Collection[str]) -> Iterator[str]:
    """
    Yield what keeps a library from being loaded somewhere on the platform.

    Args:
        name: of the library, for the message.
        text: its headers.
        provided: the libraries that are installed with it.
    """
    for version in needed_versions(text):
        if not is_provided(version):
            yield f'{name} needs {version}'
    for library in needed_libraries(text):
        if library not in SYSTEM_LIBRARIES and library not in provided:
            yield f'{name} needs {library}, which no wheel has'


def newest(versions: Collection[str]) -> dict[str, str]:
    """Return of each kind of version the newest."""
    found: dict[str, tuple[int, ...]] = {}
    for version in versions:
        kind, _, number = version.rpartition('_')
        found[kind] = max(found.get(kind, ()), tuple(map(int, number.split('.'))))
    return {kind: '.'.join(map(str, number)) for kind, number in sorted(found.items())}


def check(folder: Path, provided: Collection[str]) -> dict[str, str]:
    """
    Return of each kind of version the newest that the libraries below ``folder`` need.

    Args:
        folder: an unpacked wheel.
        provided: the libraries of the other wheels.

    Raises:
        ReleaseError: one would not be loaded everywhere on the platform.
    """
    libraries = sorted(folder.rglob('*.so*'))
    own = {path.name for path in libraries}
    texts = {path.name: headers(path) for path in libraries}
    found = [
        fault for name, text in texts.items() for fault in faults(name, text, own | {*provided})
    ]
    if found:
        more = f' ({len(found)} such faults)' if len(found) > 1 else ''
        raise ReleaseError(
            f'not for {PLATFORM}: {found[0]}{more}; build where GCC and glibc are no newer than '
            'those of Debian 12, or with the zig of PyPI: CC="python -m ziglang cc -target '
            'x86_64-linux-gnu.2.28", CXX alike'
        )
    return newest({version for text in texts.values() for version in needed_versions(text)})
