# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A file of ``rosbag2_storage_sqlite3``, the storage of older distributions, to read.

By the standard library: ``rosbags`` would bring four packages with it, for two tables.
"""

from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cached_property
from pathlib import Path
import shutil
import sqlite3
import tempfile
from typing import Any

from amr_description.bag import compression, qos_text
from amr_description.bag.metadata import FileInformation, TopicInformation
from amr_description.bag.storage import BagMessage, FileExtent, TopicMetadata
from amr_description.errors import BagError
from amr_description.text import shorten

MAGIC = b'SQLite format 3\0'
_LATEST = 2**63 - 1  # ns; larger integers SQLite does not know


class SqliteFile:
    """A file that is open to read; ``close`` it."""

    def __init__(self, path: Path) -> None:
        """Open it; what was interrupted while it was written is read up to there. BagError."""
        self.path = path
        self._unpacked: str | None = None
        self._base: sqlite3.Connection | None = None
        try:
            if path.suffix == compression.SUFFIX:
                with (
                    compression.open_file(path) as source,
                    tempfile.NamedTemporaryFile(suffix='.db3', delete=False) as sink,
                ):
                    self._unpacked = sink.name
                    shutil.copyfileobj(source, sink)
            uri = Path(self._unpacked or path).absolute().as_uri()
            self._base = sqlite3.connect(
                f'{uri}?mode=ro',
                uri=True,
                check_same_thread=False,  # a player reads in its thread what another one opened
            )
            with self._faults():
                self._topics = self._read_topics()
        except (OSError, sqlite3.Error) as error:
            self.close()
            raise BagError(f'cannot read {path}: {error}') from error
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the file."""
        if self._base is not None:
            self._base.close()
        if self._unpacked:
            Path(self._unpacked).unlink(missing_ok=True)

    @contextmanager
    def _faults(self) -> Iterator[None]:
        try:
            yield
        except (sqlite3.Error, TypeError, ValueError) as error:
            # Columns of SQLite have no types: whatever is in them, it is not as rosbag2 writes it.
            raise BagError(f'cannot read {self.path}: {shorten(str(error))}') from error

    def _rows(self, query: str, values: Sequence[int] = ()) -> Iterator[tuple[Any, ...]]:
        """Yield the rows. Raises BagError."""
        if self._base is None:
            raise BagError(f'{self.path} is closed')
        with self._faults():
            # `yield from` would close the cursor, perhaps after the file.
            yield from map(tuple, self._base.execute(query, values))

    def _read_topics(self) -> dict[int, TopicMetadata]:
        columns = {row[1] for row in self._rows('PRAGMA table_info(topics)')}
        wanted = ['id', 'name', 'type', 'serialization_format']
        optional = ['offered_qos_profiles', 'type_description_hash']
        names = ', '.join([*wanted, *(each if each in columns else "''" for each in optional)])
        found = {}
        for number, *texts in self._rows(f'SELECT {names} FROM topics ORDER BY id'):  # noqa: S608
            name, type_name, serialization, qos, type_hash = map(_text, texts)
            where = f'{self.path}: offered_qos_profiles of {shorten(name)}'
            found[number] = TopicMetadata(
                name, type_name, serialization, qos_text.from_text(qos, where), type_hash
            )
        return found

    @cached_property
    def _counts(self) -> dict[int, int]:
        return dict(self._rows('SELECT topic_id, COUNT(*) FROM messages GROUP BY topic_id'))

    @cached_property
    def _times(self) -> tuple[int, int]:
        with self._faults():
            [(first, last)] = self._rows('SELECT MIN(timestamp), MAX(timestamp) FROM messages')
            return (0, 0) if first is None else (_time(first), _time(last))

    @property
    def topics(self) -> list[TopicInformation]:
        """Each topic, and how many messages of it there are."""
        return [
            TopicInformation(topic, self._counts.get(number, 0))
            for number, topic in self._topics.items()
        ]

    @property
    def schemas(self) -> dict[str, str]:
        """The text of each type, by its name; older files have none."""
        rows = self._rows(
            'SELECT topic_type, encoded_message_definition FROM message_definitions '
            "WHERE encoding = 'ros2msg'"
        )
        with suppress(BagError):
            return {name: text for name, text in rows if isinstance(text, str) and text}
        return {}

    @property
    def information(self) -> FileInformation:
        """Its times, and how many messages there are."""
        first, last = self._times
        return FileInformation(self.path.name, first, last - first, sum(self._counts.values()))

    @property
    def extent(self) -> FileExtent | None:
        """Between which times there are messages, and of what; None: there are none. BagError."""
        first, last = self._times
        names = {topic.name for topic in self._topics.values()}  # to count would read the file
        return FileExtent(first, last, names) if last else None

    def messages(
        self, topics: Collection[str] | None, start: int, end: int
    ) -> Iterator[BagMessage]:
        """Yield the messages from ``start`` to ``end``, ns, by their times. Raises BagError."""
        names = {
            number: topic.name
            for number, topic in self._topics.items()
            if topics is None or topic.name in topics
        }
        rows = self._rows(
            'SELECT topic_id, timestamp, data FROM messages '
            'WHERE timestamp BETWEEN ? AND ? ORDER BY timestamp, id',
            (min(max(start, 0), _LATEST), min(max(end, -1), _LATEST)),
        )
        for number, time, data in rows:
            if number in names:
                if not isinstance(data, bytes):
                    raise BagError(f'cannot read {self.path}: a message of it has no data')
                yield BagMessage(names[number], data, time, time)


def _text(value: Any) -> str:
    """Return what a column has. Raises TypeError: it is none of texts."""
    if value is not None and not isinstance(value, str):
        raise TypeError(f'a text is {type(value).__name__}')
    return value or ''


def _time(value: Any) -> int:
    """Return what a column has. Raises ValueError: it is none of times."""
    if not isinstance(value, int) or value < 0:
        raise ValueError('the time of a message is none')
    return value
