# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Who else can change a file: another user of this host must not do so between us and it."""

import os
from pathlib import Path
from stat import S_IMODE, S_ISDIR, S_ISVTX, S_IWGRP, S_IWOTH

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
