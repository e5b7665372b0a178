# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bytes from a pipe, as they come, into lines of text."""

LONGEST_LINE = 32_768  # bytes; a longer one is shown in pieces rather than held in memory


class LineSplitter:
    """Collects what a process writes and hands out whole lines, without their line ends."""

    def __init__(self, longest: int = LONGEST_LINE) -> None:
        """``longest``: bytes after which a line is cut."""
        self._longest = longest
        self._rest = b''

    def feed(self, data: bytes) -> list[str]:
        """Add what was read; return the lines that are complete now."""
        *lines, self._rest = (self._rest + data).split(b'\n')
        pieces = [piece for line in lines for piece in self._cut(line)]
        *full, self._rest = self._cut(self._rest)
        return [_text(piece) for piece in pieces + full]

    def flush(self) -> list[str]:
        """Return the unfinished last line, if there is one: nothing more will come."""
        rest, self._rest = self._rest, b''
        return [_text(rest)] if rest else []

    def _cut(self, line: bytes) -> list[bytes]:
        pieces = []
        while len(line) > self._longest:
            end = _start_of_character(line, self._longest)
            pieces.append(line[:end])
            line = line[end:]
        return [*pieces, line]


def _start_of_character(line: bytes, index: int) -> int:
    """Return the last index, at most 3 before ``index``, at which a UTF-8 character begins."""
    for back in range(4):
        if line[index - back] & 0xC0 != 0x80:
            return index - back
    return index


def _text(line: bytes) -> str:
    return line.removesuffix(b'\r').decode(errors='replace')
