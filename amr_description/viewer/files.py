# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The files that a page is made of: found by name in one folder, told apart by their content."""

from dataclasses import dataclass
import hashlib
from pathlib import Path

TYPES = {
    '.html': 'text/html; charset=utf-8',
    '.js': 'text/javascript; charset=utf-8',
    '.css': 'text/css; charset=utf-8',
    '.json': 'application/json',
    '.map': 'application/json',
    '.webmanifest': 'application/manifest+json',
    '.txt': 'text/plain; charset=utf-8',
    '.svg': 'image/svg+xml',
    '.png': 'image/png',
    '.jpg': 'image/jpeg',
    '.jpeg': 'image/jpeg',
    '.ico': 'image/x-icon',
    '.woff2': 'font/woff2',
    '.stl': 'model/stl',
    '.obj': 'model/obj',
    '.dae': 'model/vnd.collada+xml',
}
"""Content types by suffix; nothing else is served."""


@dataclass(frozen=True, slots=True)
class Content:
    """What a file holds; ``tag`` changes with it."""

    data: bytes
    kind: str
    tag: str


def digest(data: bytes) -> str:
    """Return a short hash of some content."""
    return hashlib.sha256(data).hexdigest()[:20]


class StaticFiles:
    """
    The files below a folder that have a known type.

    A path is looked up among the names that there are, so that none leads out of the folder.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: dict[Path, tuple[tuple[int, int], Content]] = {}

    def get(self, path: str) -> Content | None:
        """Return the file of a URL path such as ``/index.html``; None: there is none."""
        file = self._files().get(path)
        try:
            return self._read(file) if file else None
        except OSError:  # a build is just replacing it
            return None

    def _read(self, file: Path) -> Content:
        status = file.stat()
        version = (status.st_mtime_ns, status.st_size)
        known = self._known.get(file)
        if known is None or known[0] != version:
            data = file.read_bytes()
            known = (version, Content(data, TYPES[file.suffix.lower()], digest(data)))
            self._known[file] = known
        return known[1]

    def _files(self) -> dict[str, Path]:
        return {
            f'/{file.relative_to(self._folder).as_posix()}': file
            for file in self._folder.rglob('*')
            if file.suffix.lower() in TYPES and file.is_file()
        }
