# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The texts of the licenses that ``ros2 pkg create --license`` knows, by their SPDX names."""

from pathlib import Path

LICENSES = (
    'Apache-2.0',
    'BSL-1.0',
    'BSD-2.0',
    'BSD-2-Clause',
    'BSD-3-Clause',
    'GPL-3.0-only',
    'LGPL-3.0-only',
    'MIT',
    'MIT-0',
)
"""In the order of the original."""
# The Lesser GPL is an addition to the GPL, and nothing without it.
_PARTS = {'LGPL-3.0-only': ('LGPL-3.0-only', 'GPL-3.0-only')}


def text_of(license_name: str, holder: str, year: int) -> str:
    """
    Return the text of one of :data:`LICENSES`.

    Args:
        license_name: its SPDX name.
        holder: whose the package is; in the notice of those licenses that have one.
        year: since when.
    """
    folder = Path(__file__).parent
    parts = _PARTS.get(license_name, (license_name,))
    text = '\n'.join((folder / f'{part}.txt').read_text(encoding='utf-8') for part in parts)
    return text.replace('{year}', str(year)).replace('{holder}', holder)
