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
from stat import S_IMODE, S_ISDIR, S_ISREG, S_ISVTX, S_IWGRP, S_IWOTH

from amr_description.ament_index import prefixes

_ROOT = 0


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
        if reason := _changed_by_others(each):
            return (
                f'is not taken from a request: {reason}; what would do: a file of a package, as '
                'package://PACKAGE/FILE, or the text of the description, as '
                "'ros2 run amr_description create -file' sends it"
            )
    return ''


def _changed_by_others(path: Path) -> str:
    status = path.stat()
    mode = S_IMODE(status.st_mode)
    if status.st_uid not in (_ROOT, os.geteuid()):
        return f'{path} belongs to the user {status.st_uid}'
    if S_ISDIR(status.st_mode) and mode & S_ISVTX:
        return ''  # as /tmp: others cannot replace what is in it
    is_shared = mode & S_IWGRP and status.st_gid not in (_ROOT, os.getegid())
    return f'others may write to {path}' if mode & S_IWOTH or is_shared else ''
