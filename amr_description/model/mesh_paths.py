# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Relative paths in a description: made absolute where its file is still known.

``<mesh filename="meshes/a.stl"/>`` is meant from the folder of the file. Who gets the text alone,
from a topic or a parameter, cannot know that folder: neither the simulator, nor the page, nor
RViz. So whatever reads the file and passes the text on writes ``file://`` URIs into it, which all
of them understand; also for ``package://`` of a package that is not installed, whose sources the
file lies in.
"""

from pathlib import Path
import re
from urllib.parse import quote

from amr_description.ament_index import resolve_uri
from amr_description.errors import ResourceError

_FILE_NAME = re.compile(
    r'(<(?:mesh|texture)\s(?:[^<>"\']|"[^"]*"|\'[^\']*\')*?\bfilename\s*=\s*)("[^"<]*"|\'[^\'<]*\')'
)
_SCHEME = re.compile(r'[A-Za-z][A-Za-z0-9+.-]*:')


def with_absolute_paths(text: str, folder: Path) -> str:
    """
    Return a URDF whose relative paths of meshes and textures are ``file://`` URIs.

    Args:
        text: The URDF; it need not be sound, and keeps its lines.
        folder: That of its file.

    Returns:
        The text; paths that are absolute, URIs that hold without the folder, and what names no
        file, as they were.
    """

    def absolute(match: re.Match[str]) -> str:
        before, quoted = match.groups()
        from html import unescape  # for the few robots that have meshes

        path = unescape(quoted[1:-1]).strip()
        if not path or path.startswith(('/', '~', '$', 'file:///')):
            return match[0]
        try:
            # What has a scheme may be found without the folder too, and stays then.
            if _SCHEME.match(path) and _is_file(path):
                return match[0]
            file = resolve_uri(path, folder)
            if not file.is_file():
                return match[0]
        except (ResourceError, OSError, ValueError):  # such as a name that no file can have
            return match[0]
        return f'{before}"file://{quote(str(file.resolve()))}"'

    return _FILE_NAME.sub(absolute, text)


def _is_file(uri: str) -> bool:
    try:
        return resolve_uri(uri).is_file()
    except ResourceError:
        return False
