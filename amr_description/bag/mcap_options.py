# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How MCAP files are written: the presets of rosbag2, and its file of options."""

from collections.abc import Mapping
from typing import Any

from mcap.writer import CompressionType, IndexType

from amr_description.bag import yaml_text
from amr_description.bag.yaml_text import shown
from amr_description.errors import BagError
from amr_description.text import did_you_mean, quote

DEFAULTS: Mapping[str, Any] = {
    'chunk_size': 768 * 1024,
    'compression': CompressionType.NONE,
    'enable_crcs': False,
}
"""For the library of MCAP; checksums would cost a tenth of the time."""
_ZSTD = {'compression': CompressionType.ZSTD}
PRESETS: Mapping[str, Mapping[str, Any]] = {
    'none': {},
    'fastwrite': {'use_chunking': False},
    'zstd_fast': _ZSTD,
    'zstd_small': {**_ZSTD, 'chunk_size': 4 * 1024 * 1024, 'enable_crcs': True},
}
"""
What each ``--storage-preset-profile`` asks of the library.

Of the levels of Zstandard it has one: larger chunks are what makes files smaller.
"""
_COMPRESSIONS = {
    'None': CompressionType.NONE,
    'Lz4': CompressionType.LZ4,
    'Zstd': CompressionType.ZSTD,
}
# Its name in the file, that of the library, what it is if the file says true.
_SWITCHES = {
    'noChunkCRC': ('enable_crcs', False),
    'noSummaryCRC': ('enable_crcs', False),
    'noChunking': ('use_chunking', False),
    'noRepeatedSchemas': ('repeat_schemas', False),
    'noRepeatedChannels': ('repeat_channels', False),
    'noStatistics': ('use_statistics', False),
    'noSummaryOffsets': ('use_summary_offsets', False),
}
_INDEXES = {
    'noAttachmentIndex': IndexType.ATTACHMENT,
    'noChunkIndex': IndexType.CHUNK,
    'noMessageIndex': IndexType.MESSAGE,
    'noMetadataIndex': IndexType.METADATA,
}
_WITHOUT_EFFECT = ('noAttachmentCRC', 'noSummary', 'forceCompression', 'compressionLevel')


def settings_from_text(text: str, path: str) -> dict[str, Any]:
    """
    Return what a ``--storage-config-file`` asks of the library.

    Raises BagError, which begins with ``path``.
    """
    node = yaml_text.load(text, path) or {}
    if not isinstance(node, Mapping):
        raise BagError(f'{path}: want options of MCAP as {{compression: Zstd}}')
    settings: dict[str, Any] = {}
    for name, value in node.items():
        _read_option(settings, name, value, path)
    return settings


def _read_option(settings: dict[str, Any], name: Any, value: Any, path: str) -> None:
    if name in _SWITCHES:
        key, wanted = _SWITCHES[name]
        settings[key] = wanted if _truth(value, name, path) else not wanted
    elif name in _INDEXES:
        indexes = settings.get('index_types', IndexType.ALL)
        is_left_out = _truth(value, name, path)
        settings['index_types'] = indexes & ~_INDEXES[name] if is_left_out else indexes
    elif name == 'chunkSize':
        if type(value) is not int or value <= 0:
            raise BagError(f'{path}: chunkSize: want bytes, not {shown(value)}')
        settings['chunk_size'] = value
    elif name == 'compression':
        if not isinstance(value, str) or value not in _COMPRESSIONS:
            raise BagError(
                f'{path}: compression: want one of {", ".join(_COMPRESSIONS)}, not {shown(value)}'
            )
        settings['compression'] = _COMPRESSIONS[value]
    elif name not in _WITHOUT_EFFECT:
        known = [*_SWITCHES, *_INDEXES, 'chunkSize', 'compression', *_WITHOUT_EFFECT]
        suggestion = did_you_mean(str(name), known)
        raise BagError(f'{path}: there is no option {quote(str(name))}{suggestion}')


def _truth(value: Any, name: str, path: str) -> bool:
    if not isinstance(value, bool):
        raise BagError(f'{path}: {name}: want true or false, not {shown(value)}')
    return value
