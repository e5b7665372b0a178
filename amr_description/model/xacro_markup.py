# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Whether a description file is xacro: what is in it decides, since many are called ``.urdf``.

No XML library is loaded: the supervisor of a stack asks before it starts anything.
"""

from pathlib import Path
import re

SUFFIX = '.xacro'
_COMMENT = re.compile(r'<!--.*?-->', re.DOTALL)
_NAMESPACE = re.compile(r'\sxmlns:xacro\s*=')
_SUBSTITUTION = re.compile(r'\$\((?:find|arg|eval|env|optenv|dirname|cwd)[ )]')


def is_xacro(path: str | Path, text: str | None = None) -> bool:
    """
    Return whether a file is to be expanded.

    A file that is called ``.xacro`` is, in any case; a plain URDF comes out as it was.

    Args:
        path: the file.
        text: what is in it; None: it is read.
    """
    if is_named_xacro(path):
        return True
    if text is None:
        try:
            text = Path(path).read_text('utf-8', errors='replace')
        except (OSError, ValueError):  # whoever reads it for good says why
            return False
    text = _COMMENT.sub('', text)
    found = (_NAMESPACE.search(text), _SUBSTITUTION.search(text))
    return has_xacro_elements(text) or any(found)


def is_named_xacro(path: str | Path) -> bool:
    """Return whether a file is called ``.xacro``."""
    return str(path).endswith(SUFFIX)


def has_xacro_elements(text: str) -> bool:
    """Return whether a text has elements of xacro, outside of comments."""
    return '<xacro:' in _COMMENT.sub('', text)
