# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where everything is, and the lock that keeps two set-ups of one checkout apart."""

from collections.abc import Iterator, Mapping
import contextlib
import fcntl
import os
from pathlib import Path
from typing import NamedTuple

from . import say, SetupError, stamps

PACKAGE = 'amr_description'


class Checkout(NamedTuple):
    """A clone of the repository."""

    root: Path

    @property
    def venv(self) -> Path:
        """The virtual environment."""
        return self.root / '.venv'

    @property
    def scripts(self) -> Path:
        """The folder of this module's, and of the lock files."""
        return self.root / 'scripts'

    @property
    def requirements(self) -> Path:
        """The lock file of ``.venv``."""
        return self.scripts / 'requirements.lock'

    @property
    def tools(self) -> Path:
        """The lock file of what is fetched where it is needed."""
        return self.scripts / 'tools.lock'

    @property
    def interfaces(self) -> Path:
        """The sources of the interface packages."""
        return self.root / 'interfaces'

    @property
    def build(self) -> Path:
        """Where colcon builds the package; holds its metadata and a link to its modules."""
        return self.root / 'build' / PACKAGE

    @property
    def install(self) -> Path:
        """The installed package's prefix."""
        return self.root / 'install' / PACKAGE

    def check(self) -> None:
        """Raise :class:`SetupError` when the path itself cannot work."""
        if ':' in str(self.root) or '\n' in str(self.root):
            raise SetupError(
                f'the path {str(self.root)!r} contains a colon or a line break, which no search'
                ' path (PATH, AMENT_PREFIX_PATH) can hold; move the checkout'
            )


def cache_folder(environment: Mapping[str, str]) -> Path:
    """Return the user's cache for this project, or a temporary folder when there is none."""
    import tempfile  # where there is something to do, which is seldom

    home = environment.get('HOME', '')
    base = environment.get('XDG_CACHE_HOME') or (f'{home}/.cache' if home else '')
    try:
        folder = Path(base, PACKAGE)
        if not folder.is_absolute():
            raise FileNotFoundError
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return Path(tempfile.gettempdir(), f'{PACKAGE}-{os.getuid()}')
    return folder


@contextlib.contextmanager
def one_at_a_time(checkout: Checkout) -> Iterator[None]:
    """
    Hold the checkout's lock; the system frees it however this process ends.

    What :mod:`.commands` runs inherits it: were this process killed, the lock would last as long
    as what it has started, and is still at work in the checkout.
    """
    file = checkout.root / '.setup.lock'
    with file.open('w') as lock:
        os.set_inheritable(lock.fileno(), True)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say('another one is at work here; waiting for it')
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def stamp(folder: Path, name: str) -> stamps.Stamp:
    """Return the stamp ``name`` of what lives in ``folder``, and vanishes with it."""
    return stamps.Stamp(folder / '.setup' / name)
