# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which files a request may name: the simulator reads them as its own user, whoever asks.

Every user of a host reaches its services, and a xacro file is a program. So a request is not to
have another user's file run, or wait for a pipe: regular files only, and of these the ones in
packages of the ament index, and those that nobody but the simulator's user or root can change.
"""

import os
from pathlib import Path
from stat import S_ISREG

from simulation_interfaces.msg import Result

from amr_description.ament_index import prefixes, resolve_uri
from amr_description.errors import RequestError, ResourceError
from amr_description.ownership import changed_by_others


def folder_of(source: str) -> Path:
    """Return the folder that a request names. Raises RequestError."""
    try:
        folder = resolve_uri(source)
    except ResourceError as error:
        raise RequestError(str(error), Result.RESULT_NOT_FOUND) from error
    if not _is_folder(folder):
        raise RequestError(
            f"source '{source}' is no folder; package://<package>/<folder>, file:// or a path "
            'will do',
            Result.RESULT_NOT_FOUND,
        )
    return folder


def _is_folder(path: Path) -> bool:
    """Return whether there is a folder; a name that none can have, of 3,000 letters, is none."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def distrust(path: Path) -> str:
    """Return why a request may not name a file, and what would do; '': it may, or is not there."""
    try:
        if not S_ISREG(path.stat().st_mode):
            return 'is no regular file'
    except (OSError, ValueError):  # who reads it says why
        return ''
    absolute = Path(os.path.normpath(path.absolute()))
    if any(absolute.is_relative_to(prefix.absolute()) for prefix in prefixes()):
        return ''
    real = Path(os.path.realpath(absolute))
    for each in (real, *real.parents):
        if reason := changed_by_others(each):
            return (
                f'is not taken from a request: {reason}; what would do: a file of a package, as '
                'package://PACKAGE/FILE, or the text of the description, as '
                "'ros2 run amr_description create -file' sends it"
            )
    return ''
