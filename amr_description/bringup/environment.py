# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The environment variables of a child, and of the shell in which the user goes on."""

from collections.abc import Mapping
import os
from pathlib import Path
import shutil
import sys

from amr_description.bringup.discovery import exports
from amr_description.bringup.packages import package_prefix

# The ROS wheels start each Python twice, to set LD_LIBRARY_PATH; this guard says that it is done.
# The bring-up has both, so its children save 0.1 s each, if they are of the same environment.
WHEELS_GUARD = '_ROS_WHEELS_BOOTSTRAP_COMPLETE'


def child_environment(executable: Path, base: Mapping[str, str]) -> dict[str, str]:
    """
    Return the environment to start an executable in.

    Python's output is unbuffered, as it goes to a pipe and should be seen at once. A Python of
    another environment gets neither the guard of the ROS wheels nor their libraries.
    """
    environment = {**base, 'PYTHONUNBUFFERED': '1'}
    if WHEELS_GUARD in base and not _is_of_this_python(executable, base):
        del environment[WHEELS_GUARD]
        if interpreter_of(executable, base):
            _drop_wheels_libraries(environment)
    return environment


def _is_of_this_python(executable: Path, base: Mapping[str, str]) -> bool:
    interpreter = interpreter_of(executable, base)
    return interpreter is not None and _same_folder(interpreter.parent, Path(sys.prefix) / 'bin')


def _same_folder(one: Path, other: Path) -> bool:
    return one.exists() and other.exists() and one.samefile(other)


def interpreter_of(executable: Path, base: Mapping[str, str]) -> Path | None:
    """Return the Python that the first line of a script names; None: it is no Python script."""
    with executable.open('rb') as file:
        first_line = file.readline(512)
    if not first_line.startswith(b'#!'):
        return None
    words = os.fsdecode(first_line[2:]).split()
    if len(words) > 1 and Path(words[0]).name == 'env':
        words = [shutil.which(words[-1], path=base.get('PATH')) or words[-1]]
    if not words or not Path(words[0]).name.startswith('python'):
        return None
    return Path(words[0])


def _drop_wheels_libraries(environment: dict[str, str]) -> None:
    folders = environment.get('LD_LIBRARY_PATH', '').split(os.pathsep)
    kept = [folder for folder in folders if not folder.startswith(sys.prefix + os.sep)]
    environment['LD_LIBRARY_PATH'] = os.pathsep.join(kept)


def other_shell(package: str, base: Mapping[str, str]) -> str:
    """Return what to type in another shell before ROS commands reach what runs here."""
    prefix = package_prefix(package)
    install = prefix if (prefix / 'setup.bash').is_file() else prefix.parent
    candidates = [install.parent / 'scripts/activate', install / 'setup.bash']
    script = next((path for path in candidates if path.is_file()), None)
    steps = [f'source {_shortest(script)}'] if script else []
    return ' && '.join([*steps, *exports(base)])


def _shortest(path: Path) -> Path:
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
