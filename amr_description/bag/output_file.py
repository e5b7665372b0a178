# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A file that is written to the end: what was written is there, also if the program is killed."""

from pathlib import Path


class OutputFile:
    """
    As the library of MCAP wants it: ``write``, ``tell``, ``flush``. Nothing waits in a buffer.

    What does not fit on the disk is taken back: the file ends with what was written before, and
    nothing more is written, also if there is room again.
    """

    def __init__(self, path: Path) -> None:
        """Create the file. Raises OSError, also if it is there."""
        self._file = path.open('xb', buffering=0)
        self._size = 0
        self.is_cut_off = False
        """Whether something did not fit."""

    def write(self, data: bytes) -> int:
        """Write all. Raises OSError."""
        if not data:
            return 0
        if self.is_cut_off:
            raise OSError('it was cut off when there was no room')
        rest = memoryview(data)
        try:
            while rest:
                rest = rest[self._file.write(rest) :]
        except OSError:
            self.is_cut_off = True
            self._file.seek(self._size)
            self._file.truncate()
            raise
        self._size += len(data)
        return len(data)

    def tell(self) -> int:
        """Return the size, bytes."""
        return self._size

    def flush(self) -> None:
        """Do nothing: it is done."""

    def close(self) -> None:
        """Close the file."""
        self._file.close()
