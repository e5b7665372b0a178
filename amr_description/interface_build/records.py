# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a file was made of: a command, and the files that it read. Made of the same, it is up to date.

Files are told apart by size and time of change, as generators leave what does not change alone.
"""

from collections.abc import Iterable, Sequence
import hashlib
import json
from pathlib import Path
import shutil


def digest(*parts: bytes | str) -> str:
    """Return a hash that changes with any part, and with where one ends and the next begins."""
    whole = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        whole.update(b'%d:' % len(data))
        whole.update(data)
    return whole.hexdigest()


def write_if_different(file: Path, text: str) -> None:
    """Write a file, unless it has that text: its time of change then stays."""
    if not file.is_file() or file.read_text() != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


def copy_if_different(source: Path, target: Path) -> None:
    """Copy a file, unless the target has the same content: its time of change then stays."""
    content = source.read_bytes()
    if not target.is_file() or target.read_bytes() != content:
        target.parent.mkdir(parents=True, exist_ok=True)
        target.unlink(missing_ok=True)  # it may be loaded, or a link to the source
        shutil.copyfile(source, target)


def is_current(output: Path, record: Path, command: Sequence[str]) -> bool:
    """Say whether ``output`` is there, made by this command from the inputs as they are now."""
    try:
        made_by, inputs = json.loads(record.read_text())
        return (
            output.exists()
            and made_by == digest(*command)
            and all(_state(Path(name)) == state for name, state in inputs.items())
        )
    except (OSError, ValueError):
        return False


def write(record: Path, command: Sequence[str], inputs: Iterable[Path]) -> None:
    """Write down what was made by ``command`` from ``inputs``."""
    states = {str(path): _state(path) for path in inputs}
    record.write_text(json.dumps([digest(*command), states]))


def _state(path: Path) -> list[int]:
    status = path.stat()
    return [status.st_size, status.st_mtime_ns]


def dependencies(file: Path) -> list[Path]:
    """Return the files that a compiler's dependency file (``-MMD``) names behind the colon."""
    text = file.read_text().replace('\\\n', ' ').partition(': ')[2]
    names = text.replace('\\ ', '\0').split()
    return [Path(name.replace('\0', ' ')) for name in names]
