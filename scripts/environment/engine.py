# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulation without ROS, in its own environment: ``scripts/test engine [--lowest] [ARGUMENTS]``.

It has the packages of scripts/engine.lock and engine-tests.lock, and none of ROS; by ``--lowest``
those of pyproject.toml at their lower bounds. Its Python is that of ``AMR_PYTHON``, else the first
of VERSIONS that is here, else this one; 3.12 is ROS's. Other arguments are pytest's.
Any system will do: ``python scripts/environment/engine.py``.
"""

from collections.abc import Mapping, Sequence
import hashlib
import importlib.util
import os
from pathlib import Path
import shutil
import subprocess
import sys

ROOT = Path(__file__).resolve().parents[2]
TESTS = ROOT / 'scripts' / 'engine-tests.lock'
LOCKS = (ROOT / 'scripts' / 'engine.lock', TESTS)
LOWEST = '--lowest'
VERSIONS = ('3.11', '3.14', '3.13')
"""Of Pythons that are looked for, the first one counts: the oldest, which lacks most."""
FOLDERS = (
    'base', 'model', 'control', 'controllers', 'controller_manager', 'hardware', 'sim',
    'simulation', 'navigation', 'bag', 'trials',
)  # fmt: skip
"""Of test/unit/: what the simulation is made of. Exceptions: test/support/without_ros.py."""
NOT_OF_THE_ENGINE = ('ros', 'test')
"""Extras of pyproject.toml."""
_OF_ROS = ('AMENT_PREFIX_PATH', 'PYTHONPATH', 'ROS_DISTRO', 'LD_LIBRARY_PATH')


def find_python(environment: Mapping[str, str]) -> str:
    """Return the Python of the environment that is to be made."""
    asked = environment.get('AMR_PYTHON')
    if asked:
        return asked
    home = Path(environment.get('PYENV_ROOT') or Path.home() / '.pyenv')
    for version in VERSIONS:
        of_pyenv = sorted(home.glob(f'versions/{version}.*/bin/python{version}'))
        for python in (shutil.which(f'python{version}'), *of_pyenv):
            # A shim of pyenv says that another version is chosen.
            if python and not subprocess.call([python, '-c', ''], stderr=subprocess.DEVNULL):
                return str(python)
    return sys.executable


def lower_bounds() -> list[str]:
    """Return all that pyproject.toml names for the simulation, at its lower bounds."""
    import tomllib  # the Python of Ubuntu 22.04, which may run this, has none

    project = tomllib.loads((ROOT / 'pyproject.toml').read_text(encoding='utf-8'))['project']
    extras = project['optional-dependencies'].items()
    further = (each for name, some in extras if name not in NOT_OF_THE_ENGINE for each in some)
    return [each.replace('>=', '==') for each in (*project['dependencies'], *further)]


def prepared(python: str, *, lowest: bool = False) -> Path:
    """
    Return the Python of an environment with the packages of the locks, which is made once.

    ``lowest``: With those of :func:`lower_bounds` instead, and what they require.
    """
    tests = [f'-r{TESTS}']
    if lowest:
        packages = [*lower_bounds(), *tests]
    else:
        packages = ['--no-deps', *(f'-r{path}' for path in LOCKS)]
    about = subprocess.check_output(
        [python, '-c', 'import sys; print(*sys.version_info[:3], sep=".")'], text=True
    ).strip()
    contents = [path.read_bytes() for path in LOCKS] + [each.encode() for each in packages]
    key = hashlib.sha256(b''.join(contents)).hexdigest()[:12]
    folder = ROOT / 'build' / 'engine' / f'{about}-{key}'
    own = folder / ('Scripts/python.exe' if os.name == 'nt' else 'bin/python')
    if (folder / 'complete').exists():
        return own
    shutil.rmtree(folder, ignore_errors=True)
    # The pip of the Python that runs this will do: to put one there takes a fifth of the time that
    # the packages take. To compile all modules, of which few are imported, takes as long again.
    has_pip = importlib.util.find_spec('pip') is not None
    options = ['--without-pip'] if has_pip else []
    subprocess.check_call([python, '-m', 'venv', *options, str(folder)])
    own_pip, ours = [str(own), '-m', 'pip'], [sys.executable, '-m', 'pip', '--python', str(own)]
    pip = ours if has_pip else own_pip
    install = [*pip, 'install', '--quiet', '--only-binary=:all:', '--no-compile']
    install += ['--no-input', '--disable-pip-version-check']
    subprocess.check_call([*install, *packages])
    (folder / 'complete').touch()
    return own


def environment_of(environment: Mapping[str, str]) -> dict[str, str]:
    """Return an environment in which this checkout is imported, and nothing of ROS."""
    kept = {name: value for name, value in environment.items() if name not in _OF_ROS}
    return {**kept, 'PYTHONPATH': os.pathsep.join((str(ROOT), str(ROOT / 'test')))}


def main(arguments: Sequence[str]) -> int:
    """Run the tests; return the exit code."""
    lowest = LOWEST in arguments
    arguments = [each for each in arguments if each != LOWEST]
    python = prepared(find_python(os.environ), lowest=lowest)
    options = ['--noconftest', '-p', 'support.without_ros', '-p', 'no:cacheprovider']
    tests = arguments or ['-q', *(f'test/unit/{folder}' for folder in FOLDERS)]
    return subprocess.call(
        [str(python), '-m', 'pytest', *options, *tests], env=environment_of(os.environ), cwd=ROOT
    )


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
