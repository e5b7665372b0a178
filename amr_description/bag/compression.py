# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Files and messages that rosbag2 has compressed: ``--compression-mode file`` and ``message``."""

from pathlib import Path
import shutil
import tempfile
from typing import IO

import zstandard

from amr_description.errors import BagError

FORMATS = ('zstd',)
SUFFIX = '.zstd'


def compress_file(path: Path) -> Path:
    """Replace a file by a compressed one, which has ``.zstd`` behind its name. Raises BagError."""
    target = path.with_name(path.name + SUFFIX)
    part = target.with_name(target.name + '.part')  # who is killed leaves nothing that looks whole
    try:
        with path.open('rb') as source, part.open('wb') as sink:
            zstandard.ZstdCompressor().copy_stream(source, sink)
        part.replace(target)
        path.unlink()
    except OSError as error:
        raise BagError(f'cannot compress {path}: {error}') from error
    finally:
        part.unlink(missing_ok=True)
    return target


def open_file(path: Path) -> IO[bytes]:
    """
    Open a file to read and seek, by way of a temporary one if it is compressed.

    Raises BagError.
    """
    try:
        if path.suffix != SUFFIX:
            return path.open('rb')
        with path.open('rb') as source:
            unpacked = tempfile.TemporaryFile()  # noqa: SIM115 - the caller closes it
            try:
                reader = zstandard.ZstdDecompressor().stream_reader(source)
                shutil.copyfileobj(reader, unpacked)
            except BaseException:
                unpacked.close()
                raise
    except (OSError, zstandard.ZstdError) as error:
        raise BagError(f'cannot read {path}: {error}') from error
    unpacked.seek(0)
    return unpacked


def decompress(data: bytes) -> bytes:
    """Return what a message was before. Raises BagError."""
    try:
        return zstandard.ZstdDecompressor().decompressobj().decompress(data)
    except zstandard.ZstdError as error:
        raise BagError(f'a message cannot be decompressed: {error}') from error
