# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Who else can change a file, or may read it: another user of this host must not change what we read,
nor have us read what is not his to read.
"""

import os
from pathlib import Path
from stat import S_IMODE, S_IROTH, S_ISDIR, S_ISVTX, S_IWGRP, S_IWOTH, S_IXOTH

_ROOT = 0


def changed_by_others(path: Path) -> str:
    """Return who else can change a file, or what is in a folder; '': this user and root alone."""
    status = path.stat()
    mode = S_IMODE(status.st_mode)
    if status.st_uid not in (_ROOT, os.geteuid()):
        return f'{path} belongs to the user {status.st_uid}'
    if S_ISDIR(status.st_mode) and mode & S_ISVTX:
        return ''  # as /tmp: others cannot replace what is in it
    is_shared = mode & S_IWGRP and status.st_gid not in (_ROOT, os.getegid())
    return f'others may write to {path}' if mode & S_IWOTH or is_shared else ''


def hidden_from_others(path: Path) -> str:
    """Return that its mode has not all read a file, or list a folder; '': it has."""
    mode = path.stat().st_mode
    needed = S_IROTH | (S_IXOTH if S_ISDIR(mode) else 0)
    return '' if mode & needed == needed else f'not everybody may read {path}'
