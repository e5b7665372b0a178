# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A file of ``rosbag2_storage_sqlite3``, the storage of older distributions, to read.

By the standard library: ``rosbags`` would bring four packages with it, for two tables.
"""

from collections.abc import Collection, Iterator
from pathlib import Path
import shutil
import sqlite3
import tempfile

from amr_description.bag import compression, qos_text
from amr_description.bag.metadata import FileInformation, TopicInformation
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError

MAGIC = b'SQLite format 3\0'


class SqliteFile:
    """A file that is open to read; ``close`` it."""

    def __init__(self, path: Path) -> None:
        """Open it; what was interrupted while it was written is read up to there. BagError."""
        self.path = path
        self._unpacked: str | None = None
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
            self._topics = self._read_topics()
        except (OSError, sqlite3.Error) as error:
            self._remove()
            raise BagError(f'cannot read {path}: {error}') from error

    def close(self) -> None:
        """Close the file."""
        self._base.close()
        self._remove()

    def _remove(self) -> None:
        if self._unpacked:
            Path(self._unpacked).unlink(missing_ok=True)

    def _read_topics(self) -> dict[int, TopicMetadata]:
        columns = {row[1] for row in self._base.execute('PRAGMA table_info(topics)')}
        wanted = ['id', 'name', 'type', 'serialization_format']
        optional = ['offered_qos_profiles', 'type_description_hash']
        names = ', '.join([*wanted, *(each if each in columns else "''" for each in optional)])
        return {
            number: TopicMetadata(
                name,
                type_name,
                serialization,
                qos_text.from_text(qos or '', f'{self.path}: offered_qos_profiles of {name}'),
                type_hash or '',
            )
            for number, name, type_name, serialization, qos, type_hash in self._base.execute(
                f'SELECT {names} FROM topics ORDER BY id'  # noqa: S608 - names of columns above
            )
        }

    @property
    def topics(self) -> list[TopicInformation]:
        """Each topic, and how many messages of it there are."""
        rows = self._base.execute('SELECT topic_id, COUNT(*) FROM messages GROUP BY topic_id')
        counts = dict(rows)
        return [
            TopicInformation(topic, counts.get(number, 0))
            for number, topic in self._topics.items()
        ]

    @property
    def schemas(self) -> dict[str, str]:
        """The text of each type, by its name; older files have none."""
        try:
            rows = self._base.execute(
                'SELECT topic_type, encoded_message_definition FROM message_definitions '
                "WHERE encoding = 'ros2msg'"
            )
            return {name: text for name, text in rows if text}
        except sqlite3.Error:
            return {}

    @property
    def information(self) -> FileInformation:
        """Its times, and how many messages there are."""
        first, last, count = self._base.execute(
            'SELECT MIN(timestamp), MAX(timestamp), COUNT(*) FROM messages'
        ).fetchone()
        first = first or 0
        return FileInformation(self.path.name, first, (last or 0) - first, count)

    def messages(
        self, topics: Collection[str] | None, start: int, end: int
    ) -> Iterator[BagMessage]:
        """Yield the messages from ``start`` to ``end``, ns, by their times. Raises BagError."""
        names = {
            number: topic.name
            for number, topic in self._topics.items()
            if topics is None or topic.name in topics
        }
        try:
            rows = self._base.execute(
                'SELECT topic_id, timestamp, data FROM messages '
                'WHERE timestamp BETWEEN ? AND ? ORDER BY timestamp, id',
                (start, end),
            )
            for number, time, data in rows:
                if number in names:
                    yield BagMessage(names[number], bytes(data), time, time)
        except sqlite3.Error as error:
            raise BagError(f'cannot read {self.path}: {error}') from error
