# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Folders that a request names, of which the files are listed."""

from pathlib import Path

from simulation_interfaces.msg import Result

from amr_description.ament_index import resolve_uri
from amr_description.errors import RequestError, ResourceError
from amr_description.trusted_files import distrust_folder


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
    if reason := distrust_folder(folder):
        raise RequestError(f"source '{source}' {reason}", Result.RESULT_NOT_FOUND)
    return folder


def _is_folder(path: Path) -> bool:
    """Return whether there is a folder; a name that none can have, of 3,000 letters, is none."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False
