# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The hashes of installed message types."""

from functools import cache
import json

from amr_description.ament_index import package_share
from amr_description.errors import ResourceError


@cache
def type_hash(type_name: str) -> str:
    """Return ``RIHS01_…`` of ``package/kind/Name``; empty: it is not installed."""
    package, kind, name = type_name.split('/')
    try:
        text = (package_share(package) / kind / f'{name}.json').read_text(encoding='utf-8')
        hashes = json.loads(text)['type_hashes']
    except (OSError, ResourceError, ValueError, KeyError):
        return ''
    return next((each['hash_string'] for each in hashes if each['type_name'] == type_name), '')
