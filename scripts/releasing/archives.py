# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Wheels, read and written so that the same contents are the same bytes.

A wheel is a zip file. What is in it besides names and contents (times, order, modes, how it was
compressed) depends on the machine that made it; here it is a function of the contents.
"""

import base64
from collections.abc import Mapping
import hashlib
from pathlib import Path
import time
from typing import NamedTuple
import zipfile

_FIRST_TIME = 315532800  # 1980-01-01: a zip file knows none before
_REGULAR_FILE = 0o100000
_UNIX = 3


class Member(NamedTuple):
    """A file in a wheel."""

    content: bytes
    executable: bool = False


def read(wheel: Path) -> dict[str, Member]:
    """Return the files of a wheel by their paths, without its RECORD."""
    with zipfile.ZipFile(wheel) as archive:
        return {
            info.filename: Member(archive.read(info), bool(info.external_attr >> 16 & 0o100))
            for info in archive.infolist()
            if not info.is_dir() and not info.filename.endswith('.dist-info/RECORD')
        }


def dist_info(members: Mapping[str, Member]) -> str:
    """Return the folder of the metadata."""
    return next(name for name in members if name.endswith('.dist-info/WHEEL')).partition('/')[0]


def write(members: Mapping[str, Member], folder: Path, epoch: int) -> Path:
    """
    Write a wheel, named by its metadata, with a RECORD; return its path.

    Args:
        members: its files.
        folder: where to.
        epoch: the time of all files in it, in seconds since 1970.
    """
    info = dist_info(members)
    tag = _field(members[f'{info}/WHEEL'].content, 'Tag')
    record = f'{info}/RECORD'
    whole = {**dict(sorted(members.items())), record: Member(_record(members, record))}
    path = folder / f'{info.removesuffix(".dist-info")}-{tag}.whl'
    moment = time.gmtime(max(epoch, _FIRST_TIME))[:6]
    with zipfile.ZipFile(path, 'w', zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, member in whole.items():
            entry = zipfile.ZipInfo(name, moment)
            entry.create_system = _UNIX
            entry.compress_type = zipfile.ZIP_DEFLATED
            mode = _REGULAR_FILE | (0o755 if member.executable else 0o644)
            entry.external_attr = mode << 16
            archive.writestr(entry, member.content, compresslevel=9)
    return path


def retagged(members: Mapping[str, Member], tag: str) -> dict[str, Member]:
    """Return the files of a wheel for the pythons and platforms of ``tag``."""
    name = f'{dist_info(members)}/WHEEL'
    lines = members[name].content.decode().splitlines()
    kept = [line for line in lines if line and not line.startswith('Tag:')]
    return {**members, name: Member('\n'.join([*kept, f'Tag: {tag}', '']).encode())}


def digest(path: Path) -> str:
    """Return the SHA-256 of a file, in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _field(text: bytes, name: str) -> str:
    """Return the first value of a header."""
    return next(
        line.partition(':')[2].strip()
        for line in text.decode().splitlines()
        if line.startswith(f'{name}:')
    )


def _record(members: Mapping[str, Member], own_name: str) -> bytes:
    """Return the list of all files with their hashes, by which installers know what is theirs."""
    lines = []
    for name, member in sorted(members.items()):
        hashed = base64.urlsafe_b64encode(hashlib.sha256(member.content).digest())
        quoted = f'"{name}"' if ',' in name else name
        lines.append(f'{quoted},sha256={hashed.decode().rstrip("=")},{len(member.content)}')
    return '\n'.join([*lines, f'{own_name},,', '']).encode()
