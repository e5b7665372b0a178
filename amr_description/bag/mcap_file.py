# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
An MCAP file, also one that was cut off anywhere.

What is complete in it is found by its summary; without one, by going through the file once. Both
give the same: parts of records, each with the times between which its messages lie.
"""

from collections.abc import Collection, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
import heapq
from io import BytesIO
from pathlib import Path
import struct
from typing import NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Channel, Chunk, Metadata, Schema
from mcap.stream_reader import get_chunk_data_stream
import zstandard

from amr_description.bag import compression, metadata, qos_text
from amr_description.bag.metadata import BagMetadata, FileInformation, TopicInformation
from amr_description.bag.storage import BagMessage, FileExtent, TopicMetadata
from amr_description.errors import BagError
from amr_description.text import shorten

MAGIC = b'\x89MCAP0\r\n'
_HEAD = struct.Struct('<BQ')  # opcode and length of a record
_MESSAGE = struct.Struct('<HIQQ')  # channel, sequence, log_time, publish_time
_CHUNK_TIMES = struct.Struct('<QQ')
_UNCHUNKED_PART = 1 << 20  # bytes; of files without chunks
# Of what reads bytes that anybody may have written.
_FAULTS = (
    McapError, struct.error, zstandard.ZstdError, EOFError, LookupError, MemoryError,
    OverflowError, RuntimeError, TypeError, ValueError,
)  # fmt: skip


class Part(NamedTuple):
    """Records in a row, in a chunk or not, and the times of the messages in them, ns."""

    start: int
    end: int
    offset: int
    """Of the first record in the file, or of the chunk."""
    length: int
    is_chunk: bool
    channels: frozenset[int] | None
    """Of which there are messages; None: not known."""


@dataclass
class _Content:
    parts: list[Part] = field(default_factory=list)
    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    counts: dict[int, int] = field(default_factory=dict)
    metadata_offsets: list[int] = field(default_factory=list)
    starting_time: int = 0
    end_time: int = 0
    is_complete: bool = True


class McapFile:
    """A file that is open to read; ``close`` it."""

    def __init__(self, path: Path) -> None:
        """Find what is in the file. Raises BagError."""
        self.path = path
        self._stream = compression.open_file(path)
        try:
            head = self._stream.read(len(MAGIC))
            if not MAGIC.startswith(head):
                raise BagError(f'{path} is not an MCAP file: it does not begin as one')
            self._content = self._summary() or self._scanned()
        except BaseException:
            self._stream.close()
            raise

    def close(self) -> None:
        """Close the file."""
        self._stream.close()

    @property
    def is_complete(self) -> bool:
        """Whether whoever wrote it came to the end."""
        return self._content.is_complete

    @property
    def topics(self) -> list[TopicInformation]:
        """Each topic, and how many messages of it there are."""
        found: dict[str, TopicInformation] = {}
        for number, channel in self._content.channels.items():
            schema = self._content.schemas.get(channel.schema_id)
            topic = TopicMetadata(
                channel.topic,
                schema.name if schema else '',
                channel.message_encoding,
                qos_text.from_text(
                    channel.metadata.get('offered_qos_profiles', ''),
                    f'{self.path}: offered_qos_profiles of {channel.topic}',
                ),
                channel.metadata.get('topic_type_hash', ''),
            )
            information = found.setdefault(channel.topic, TopicInformation(topic))
            information.message_count += self._content.counts.get(number, 0)
        return list(found.values())

    @property
    def schemas(self) -> dict[str, str]:
        """The text of each type, by its name; of those that have one."""
        return {
            schema.name: schema.data.decode(errors='replace')
            for schema in self._content.schemas.values()
            if schema.data
        }

    @property
    def information(self) -> FileInformation:
        """Its times, and how many messages there are."""
        content = self._content
        return FileInformation(
            self.path.name,
            content.starting_time,
            content.end_time - content.starting_time,
            sum(content.counts.values()),
        )

    @property
    def extent(self) -> FileExtent | None:
        """Between which times there are messages, and of what; None: there are none."""
        content = self._content
        names = {each.topic for n, each in content.channels.items() if content.counts.get(n)}
        return FileExtent(content.starting_time, content.end_time, names) if names else None

    @property
    def own_metadata(self) -> BagMetadata | None:
        """What rosbag2 has written into the file itself, if it has."""
        for offset in reversed(self._content.metadata_offsets):
            with suppress(*_FAULTS, OSError, BagError):  # the file plays without it
                self._stream.seek(offset + _HEAD.size)
                record = Metadata.read(ReadDataStream(self._stream))
                text = record.metadata.get('serialized_metadata')
                if record.name == 'rosbag2' and text:
                    return metadata.from_text(text, str(self.path))
        return None

    def parts(self, topics: Collection[str] | None, start: int, end: int) -> list[Part]:
        """Return the parts that may have messages of these topics in [start, end], ns."""
        wanted = None if topics is None else self._numbers(topics)
        return [
            part
            for part in self._content.parts
            if part.end >= start
            and part.start <= end
            and (wanted is None or part.channels is None or part.channels & wanted)
        ]

    def messages_of(self, part: Part, topics: Collection[str] | None) -> Iterator[BagMessage]:
        """Yield the messages of a part as they are in the file. Raises BagError."""
        names = {number: each.topic for number, each in self._content.channels.items()}
        wanted = names.keys() if topics is None else self._numbers(topics)
        for opcode, data, at, length in _records(self._data(part)):
            if opcode == Opcode.MESSAGE:
                if length < _MESSAGE.size or at + length > len(data):
                    raise BagError(f'{self.path}: there is no whole message at byte {part.offset}')
                channel, _, log_time, publish_time = _MESSAGE.unpack_from(data, at)
                if channel in wanted:
                    body = data[at + _MESSAGE.size : at + length]
                    yield BagMessage(names[channel], body, log_time, publish_time)

    def _numbers(self, topics: Collection[str]) -> set[int]:
        channels = self._content.channels.items()
        return {number for number, each in channels if each.topic in topics}

    def _data(self, part: Part) -> bytes:
        try:
            self._stream.seek(part.offset)
            data = self._stream.read(part.length)
            return _unpacked(data[_HEAD.size :]) if part.is_chunk else data
        except (*_FAULTS, OSError) as error:
            raise BagError(
                f'{self.path}: a chunk of it, at byte {part.offset}, cannot be read: '
                f'{shorten(str(error) or type(error).__name__)}'
            ) from error

    def _summary(self) -> _Content | None:
        """Return what the summary says; None: there is none that is of use."""
        self._stream.seek(0)
        try:
            summary = SeekingReader(self._stream).get_summary()
        except (*_FAULTS, OSError):
            return None
        if summary is None or summary.statistics is None:
            return None
        statistics = summary.statistics
        if statistics.message_count and not summary.chunk_indexes:
            return None
        if len(summary.channels) < statistics.channel_count:
            return None
        if len(summary.schemas) < statistics.schema_count:
            return None
        if any(not index.message_index_offsets for index in summary.chunk_indexes):
            return None
        parts = [
            Part(
                index.message_start_time,
                index.message_end_time,
                index.chunk_start_offset,
                index.chunk_length,
                True,
                frozenset(index.message_index_offsets),
            )
            for index in summary.chunk_indexes
        ]
        return _Content(
            parts,
            summary.schemas,
            summary.channels,
            dict(statistics.channel_message_counts),
            [index.offset for index in summary.metadata_indexes],
            statistics.message_start_time,
            statistics.message_end_time,
        )

    def _scanned(self) -> _Content:
        """Go through the file; what is behind the last complete record is left out."""
        content = _Content(is_complete=False)
        size = self._stream.seek(0, 2)
        offset = len(MAGIC)
        loose = _LooseRecords(content)
        while offset + _HEAD.size <= size:
            self._stream.seek(offset)
            opcode, length = _HEAD.unpack(self._stream.read(_HEAD.size))
            whole = _HEAD.size + length
            if opcode == 0 or offset + whole > size:
                break
            if opcode in (Opcode.DATA_END, Opcode.FOOTER):
                content.is_complete = True
                break
            if opcode in (Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE):
                try:
                    loose.add(offset, opcode, self._stream.read(length))
                except _FAULTS:
                    break
            else:
                loose.end()
                if opcode == Opcode.METADATA:
                    content.metadata_offsets.append(offset)
                elif opcode == Opcode.CHUNK and not self._add_chunk(content, offset, length):
                    break
            offset += whole
        loose.end()
        content.starting_time = min((part.start for part in content.parts), default=0)
        content.end_time = max((part.end for part in content.parts), default=0)
        return content

    def _add_chunk(self, content: _Content, offset: int, length: int) -> bool:
        body = self._stream.read(length)
        found = _Content()
        try:
            loose = _LooseRecords(found)
            for opcode, data, at, size in _records(_unpacked(body)):
                loose.add(at, opcode, data[at : at + size])
            loose.end()
        except _FAULTS:
            return False  # it was not written to its end
        content.schemas.update(found.schemas)
        content.channels.update(found.channels)
        for number, count in found.counts.items():
            content.counts[number] = content.counts.get(number, 0) + count
        start, end = _CHUNK_TIMES.unpack_from(body)
        if found.counts:
            numbers = frozenset(found.counts)
            content.parts.append(Part(start, end, offset, _HEAD.size + length, True, numbers))
        return True


class _LooseRecords:
    """Schemas, channels and messages in a row: what they say, and the parts that they make."""

    def __init__(self, content: _Content) -> None:
        self._content = content
        self._numbers: set[int] = set()
        self._first = self._next = self._start = self._end = 0

    def add(self, offset: int, opcode: int, body: bytes) -> None:
        content = self._content
        if opcode == Opcode.SCHEMA:
            schema = Schema.read(ReadDataStream(BytesIO(body)))
            content.schemas[schema.id] = schema
        elif opcode == Opcode.CHANNEL:
            channel = Channel.read(ReadDataStream(BytesIO(body)))
            content.channels[channel.id] = channel
        elif opcode == Opcode.MESSAGE:
            number, _, log_time, _ = _MESSAGE.unpack_from(body)
            content.counts[number] = content.counts.get(number, 0) + 1
            if not self._numbers:
                self._first, self._start, self._end = offset, log_time, log_time
            self._numbers.add(number)
            self._start, self._end = min(self._start, log_time), max(self._end, log_time)
            self._next = offset + _HEAD.size + len(body)
            if self._next - self._first > _UNCHUNKED_PART:
                self.end()

    def end(self) -> None:
        """Whatever else comes is not a part of this row."""
        if self._numbers:
            self._content.parts.append(
                Part(
                    self._start,
                    self._end,
                    self._first,
                    self._next - self._first,
                    False,
                    frozenset(self._numbers),
                )
            )
            self._numbers = set()


def _records(data: bytes) -> Iterator[tuple[int, bytes, int, int]]:
    """Yield opcode, data, and where in it the body of each record begins and how long it is."""
    at = 0
    while at + _HEAD.size <= len(data):
        opcode, length = _HEAD.unpack_from(data, at)
        at += _HEAD.size
        yield opcode, data, at, length
        at += length


def _unpacked(body: bytes) -> bytes:
    """Return the records of the body of a chunk."""
    chunk = Chunk.read(ReadDataStream(BytesIO(body)))
    stream, size = get_chunk_data_stream(chunk)
    return stream.read(size)


def in_order(
    files: list[McapFile], topics: Collection[str] | None, start: int, end: int
) -> Iterator[BagMessage]:
    """
    Yield the messages of all files by their log times, from ``start`` to ``end``, ns.

    Those of one time come as they were written. Only parts whose times overlap are in memory.
    """
    waiting = [
        (part.start, order, part.offset, file, part)
        for order, file in enumerate(files)
        for part in file.parts(topics, start, end)
    ]
    waiting.sort(key=lambda each: each[:3], reverse=True)
    queue: list[tuple[int, int, BagMessage]] = []
    number = 0
    while waiting or queue:
        while waiting and (not queue or waiting[-1][0] <= queue[0][0]):
            *_, file, part = waiting.pop()
            for message in file.messages_of(part, topics):
                if start <= message.log_time <= end:
                    heapq.heappush(queue, (message.log_time, number, message))
                number += 1
        if queue:
            yield heapq.heappop(queue)[2]
