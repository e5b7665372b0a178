# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a bare Debian or Ubuntu lacks, without root: pip with certificates, the headers of Python.

These systems have them in packages of their own. apt fetches packages, and checks their
signatures, for everybody; to unpack them elsewhere than in the system needs no rights either. The
files are kept in the user's cache.
"""

from collections.abc import Mapping
import importlib.util
import os
from pathlib import Path
import shutil
import sys
import sysconfig

from . import progress, SetupError
from .commands import run
from .virtual_environment import python_of, site_packages

VERSION = 'python{}.{}'.format(*sys.version_info)
CERTIFICATES = Path('/etc/ssl/certs/ca-certificates.crt')
PACKAGES = {
    'pip': ('python3-pip-whl', 'ca-certificates'),
    'Python.h': (f'lib{VERSION}-dev',),
}
"""By what is lacking: what is fetched."""
INSTALLED = {
    'pip': f'{VERSION}-venv',
    'Python.h': f'{VERSION}-dev',
}
"""By what is lacking: what a person would install."""


def lacking() -> list[str]:
    """Return what is lacking here of :data:`PACKAGES`; elsewhere than on Debian nothing."""
    if not shutil.which('apt-get') or not shutil.which('dpkg-deb'):
        return []
    found = [] if importlib.util.find_spec('ensurepip') else ['pip']
    if not Path(sysconfig.get_path('include'), 'Python.h').is_file():
        found.append('Python.h')
    return found


class Extras:
    """The unpacked packages."""

    def __init__(self, cache: Path) -> None:
        self._folder = cache / f'debian-{VERSION}'

    def fetch(self, lacks: list[str], environment: Mapping[str, str]) -> None:
        """Fetch what is lacking, unless it is there. Raises SetupError."""
        wanted = [name for name in lacks if not (self._folder / name).is_dir()]
        if not wanted:
            return
        progress(f'fetching {" and ".join(wanted)} of {_system()} by apt-get, without root ...')
        try:
            for name in wanted:
                self._fetch(name, environment)
        except SetupError as error:
            line = ' '.join(['apt install', *(INSTALLED[name] for name in lacks)])
            raise SetupError(f'this Python lacks {" and ".join(lacks)}: {line}\n{error}') from None

    def _fetch(self, name: str, environment: Mapping[str, str]) -> None:
        import tempfile

        self._folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix='unfinished-', dir=self._folder) as scratch:
            os.chmod(scratch, 0o755)  # for the user that apt fetches as
            files = _download(PACKAGES[name], Path(scratch, 'files'), environment)
            unpacked = Path(scratch, 'unpacked')
            for file in files:
                extract = ['dpkg-deb', '--extract', file, unpacked]
                run(extract, environment, f'unpacking {file.name}')
            unpacked.rename(self._folder / name)

    def install_pip(self, venv: Path, environment: Mapping[str, str]) -> None:
        """Install pip into an environment that has none. Raises SetupError."""
        import zipfile

        (wheel,) = self._folder.glob('pip/usr/share/python-wheels/pip-*.whl')
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(site_packages(venv))
        self._give_certificates(venv)
        options = ['--no-index', '--no-deps', '--force-reinstall']  # for what is in bin/
        command = [python_of(venv), '-m', 'pip', 'install', *options, wheel]
        run(command, environment, 'installing pip')
        self._give_certificates(venv)

    def _give_certificates(self, venv: Path) -> None:
        """Have Debian's pip, which knows no certificates but the system's, find some without."""
        if CERTIFICATES.is_file():
            return
        found = sorted(self._folder.glob('pip/usr/share/ca-certificates/mozilla/*.crt'))
        (venv / 'share').mkdir(exist_ok=True)
        whole = venv / 'share' / CERTIFICATES.name
        whole.write_text(''.join(file.read_text() for file in found))
        module = site_packages(venv) / 'pip/_vendor/certifi/core.py'
        ours = f"__import__('sys').prefix + '/share/{CERTIFICATES.name}'"
        module.write_text(module.read_text().replace(f"'{CERTIFICATES}'", ours))

    def copy_headers(self, target: Path) -> None:
        """Copy the headers of Python to ``target``, all into one folder."""
        headers = self._folder / 'Python.h/usr/include'
        shutil.copytree(headers / VERSION, target, dirs_exist_ok=True)
        # The other one of that name is that of all architectures, and refers to this one.
        (of_this_architecture,) = headers.glob(f'*-linux-gnu/{VERSION}/pyconfig.h')
        shutil.copy(of_this_architecture, target)


def _download(
    packages: tuple[str, ...], folder: Path, environment: Mapping[str, str]
) -> list[Path]:
    """Fetch packages into ``folder``, by apt's lists or, if it has none, by our own."""
    folder.mkdir()
    fetch = ['apt-get', 'download', *packages]
    what = f'fetching {" and ".join(packages)}'
    try:
        run(fetch, environment, what, folder)
    except SetupError:
        lists = folder.parent / 'lists'
        (lists / 'partial').mkdir(parents=True)
        cache = folder.parent / 'cache'
        (cache / 'archives/partial').mkdir(parents=True)
        options = [f'-oDir::State::Lists={lists}', f'-oDir::Cache={cache}']
        run(['apt-get', *options, 'update'], environment, 'fetching the lists of packages')
        run([*fetch, *options], environment, what, folder)
    return sorted(folder.glob('*.deb'))


def _system() -> str:
    import platform

    return platform.freedesktop_os_release().get('PRETTY_NAME', 'this system')
