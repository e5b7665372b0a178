# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Content hashes: a part is up to date when its stamp holds the hash of what it is made of."""

from collections.abc import Iterable
import hashlib
import os
from pathlib import Path

IGNORED = {'__pycache__', 'build', '.ruff_cache'}


def digest(*parts: str | bytes) -> str:
    """Return a hash that changes with any part, and with where one ends and the next begins."""
    whole = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        whole.update(b'%d:' % len(data))
        whole.update(data)
    return whole.hexdigest()


def files_below(folder: Path) -> list[Path]:
    """Return the files of a source folder, sorted, without what Python and builds leave there."""
    found = []
    for parent, folders, names in os.walk(folder):
        folders[:] = [
            name for name in folders if name not in IGNORED and not name.endswith('.egg-info')
        ]
        found += [Path(parent, name) for name in names]
    return sorted(found)


def digest_files(files: Iterable[Path], root: Path) -> str:
    """Return a hash of the names, relative to ``root``, and of the contents of ``files``."""
    return digest(
        *(part for file in files for part in (str(file.relative_to(root)), file.read_bytes()))
    )


class Stamp:
    """The hash, in a file, of what something was made of; no file when it is unfinished."""

    def __init__(self, file: Path) -> None:
        self.file = file

    def holds(self, key: str) -> bool:
        """Say whether the thing was made, to its end, of what ``key`` stands for."""
        try:
            return self.file.read_text() == key
        except FileNotFoundError:
            return False

    def exists(self) -> bool:
        """Say whether the thing was made to its end, of whatever."""
        return self.file.exists()

    def remove(self) -> None:
        """Declare the thing unfinished; to be called before changing it."""
        self.file.unlink(missing_ok=True)

    def write(self, key: str) -> None:
        """Declare the thing made of what ``key`` stands for."""
        replace_file(self.file, key)


def replace_file(file: Path, text: str, mode: int = 0o644) -> None:
    """Write ``file`` in one step: readers see the old or the new text, never a part of it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    fresh = file.with_name(f'{file.name}.{os.getpid()}')
    fresh.write_text(text)
    fresh.chmod(mode)
    fresh.replace(file)
