# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A file of ``rosbag2_storage_sqlite3``, the storage of older distributions, to read and to write.

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

from amr_description.bag import compression, metadata, qos_text, schemas
from amr_description.bag.metadata import (
    BagMetadata,
    FileInformation,
    ROS_DISTRO,
    TopicInformation,
)
from amr_description.bag.storage import BagMessage, FileExtent, TopicMetadata
from amr_description.errors import BagError
from amr_description.text import shorten

MAGIC = b'SQLite format 3\0'
_LATEST = 2**63 - 1  # ns; larger integers SQLite does not know
_VERSION = 4  # of the tables: Iron's to Jazzy's
_AT_ONCE = 1_000_000  # bytes of messages that may be lost when a program is killed
_TABLES = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(
  id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(
  id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
  serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,
  type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(
  id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
  encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(
  id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
  data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
"""


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


class SqliteOutput:
    """One file of a bag that is written. Methods raise OSError."""

    def __init__(self, path: Path) -> None:
        """Create the file. Raises OSError, also if there is such a bag."""
        self.information = FileInformation(path.name)
        self._counts: dict[str, int] = {}
        self._numbers: dict[str, int] = {}
        self._types: set[str] = set()
        self._waiting = self._written = 0
        with self._faults():
            # A recorder writes in another thread than the one that opened it.
            self._base = sqlite3.connect(path, check_same_thread=False, isolation_level=None)
            self._base.executescript(f'PRAGMA synchronous = NORMAL; {_TABLES} BEGIN;')
            self._base.execute('INSERT INTO schema VALUES (?, ?)', (_VERSION, ROS_DISTRO))

    @staticmethod
    @contextmanager
    def _faults() -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as error:
            raise OSError(str(error)) from error

    @property
    def size(self) -> int:
        """Bytes of the messages."""
        return self._written

    def add_topic(self, topic: TopicMetadata, text: str) -> None:
        """Declare a topic; ``text``: of its type."""
        with self._faults():
            if topic.type not in self._types:
                self._types.add(topic.type)
                encoding = schemas.ENCODING if text else ''
                self._base.execute(
                    'INSERT INTO message_definitions VALUES (NULL, ?, ?, ?, ?)',
                    (topic.type, encoding, text, topic.type_description_hash),
                )
            self._numbers[topic.name] = len(self._numbers) + 1
            self._base.execute(
                'INSERT INTO topics VALUES (?, ?, ?, ?, ?, ?)',
                (
                    self._numbers[topic.name],
                    topic.name,
                    topic.type,
                    topic.serialization_format,
                    qos_text.to_text(topic.offered_qos_profiles),
                    topic.type_description_hash,
                ),
            )

    def write(self, message: BagMessage) -> None:
        """Write a message; that it was sent at another time than received, no column has."""
        with self._faults():
            self._base.execute(
                'INSERT INTO messages VALUES (NULL, ?, ?, ?)',
                (self._numbers[message.topic], message.log_time, message.data),
            )
        self._counts[message.topic] = self._counts.get(message.topic, 0) + 1
        self.information.include(message.log_time)
        self._written += len(message.data)
        self._waiting += len(message.data)
        if self._waiting >= _AT_ONCE:
            self.flush()

    def flush(self) -> None:
        """Have all that was written in the file."""
        self._waiting = 0
        with self._faults():
            self._base.execute('COMMIT')
            self._base.execute('BEGIN')

    def close(self, whole: BagMetadata) -> None:
        """Complete the file, which also has the metadata of itself alone: it plays alone."""
        text = metadata.to_text(whole.of_file(self.information, self._counts))
        try:
            with self._faults():
                self._base.execute('INSERT INTO metadata VALUES (NULL, ?, ?)', (_VERSION, text))
                self._base.execute('COMMIT')
        finally:
            self._base.close()


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
