# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``rosbag2_py``: bags read and written from Python, one message after the other.

What reads takes any bag that ``ros2 bag`` reads. Times are ns, messages are bytes: see
``rclpy.serialization``.
"""

# ruff: noqa: N815

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
import re

from rclpy.duration import Duration
from rclpy.time import Time

from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.metadata import BagMetadata as _Metadata
from amr_description.bag.reader import BagReader, STORAGES
from amr_description.bag.storage import BagMessage, TopicMetadata as _Topic
from amr_description.clock import NANOSECONDS
from amr_description.errors import BagError


@dataclass
class StorageOptions:
    """Where a bag is, and how it is written; what the original has beside it does nothing here."""

    uri: str
    storage_id: str = ''
    max_bagfile_size: int = 0
    """Bytes."""
    max_bagfile_duration: int = 0
    """s"""
    max_cache_size: int = 0
    storage_preset_profile: str = ''
    storage_config_uri: str = ''
    snapshot_mode: bool = False
    start_time_ns: int = -1
    end_time_ns: int = -1
    custom_data: dict[str, str] = field(default_factory=dict)


@dataclass
class ConverterOptions:
    """The formats of messages: there is ``cdr`` alone."""

    input_serialization_format: str = ''
    output_serialization_format: str = ''


@dataclass
class StorageFilter:
    """Which topics are read; nothing: all."""

    topics: list[str] = field(default_factory=list)
    topics_regex: str = ''
    exclude_topics: list[str] = field(default_factory=list)
    regex_to_exclude: str = ''

    def chosen(self, topics: Iterable[str]) -> list[str]:
        """Return those of these topics that are read."""
        wants_all = not (self.topics or self.topics_regex)
        return [
            each
            for each in topics
            if (wants_all or each in self.topics or _matches(self.topics_regex, each))
            and each not in self.exclude_topics
            and not _matches(self.regex_to_exclude, each)
        ]


def _matches(pattern: str, topic: str) -> bool:
    return bool(pattern) and re.fullmatch(pattern, topic) is not None


@dataclass
class TopicMetadata:
    """What a bag knows of a topic."""

    id: int
    name: str
    type: str
    serialization_format: str = 'cdr'
    offered_qos_profiles: list[object] = field(default_factory=list)
    type_description_hash: str = ''


@dataclass
class TopicInformation:
    """A topic, and how many messages of it there are."""

    topic_metadata: TopicMetadata
    message_count: int


@dataclass
class FileInformation:
    """A file of a bag."""

    path: str
    starting_time: Time
    duration: Duration
    message_count: int


@dataclass
class BagMetadata:
    """What ``metadata.yaml`` says."""

    version: int
    bag_size: int
    storage_identifier: str
    relative_file_paths: list[str]
    files: list[FileInformation]
    duration: Duration
    starting_time: Time
    message_count: int
    topics_with_message_count: list[TopicInformation]
    compression_format: str
    compression_mode: str
    custom_data: dict[str, str]
    ros_distro: str


class ReadOrderSortBy(Enum):
    """By what messages are sorted."""

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


@dataclass
class ReadOrder:
    """In which order messages are read."""

    sort_by: ReadOrderSortBy = ReadOrderSortBy.ReceivedTimestamp
    reverse: bool = False


class SequentialReader:
    """Reads a bag, one message after the other. What cannot be read raises RuntimeError."""

    def __init__(self) -> None:
        self._bag: BagReader | None = None
        self._filter = StorageFilter()
        self._order = ReadOrder()
        self._bounds: tuple[int | None, int | None] = (None, None)
        self._left: Iterator[BagMessage] = iter(())
        self._next: BagMessage | None = None

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions) -> None:
        """Open a bag."""
        _require_cdr(converter_options)
        begin, end = storage_options.start_time_ns, storage_options.end_time_ns
        self._bounds = (begin if begin >= 0 else None, end if end >= 0 else None)
        self.close()
        self._bag = _opened(storage_options.uri, storage_options.storage_id)
        self._begin(self._bounds[0])

    def open_uri(self, uri: str) -> None:
        """Open a bag, of whatever storage."""
        self.open(StorageOptions(uri), ConverterOptions())

    def close(self) -> None:
        """Close it."""
        if self._bag is not None:
            self._bag.close()
        self._bag, self._next = None, None

    def has_next(self) -> bool:
        """Return whether there is one more message."""
        self._opened()
        return self._next is not None

    def read_next(self) -> tuple[str, bytes, int]:
        """Return the next message: its topic, its bytes, and when it was received, ns."""
        self._opened()
        message = self._next
        if message is None:
            raise RuntimeError('No next message is available.')
        self._go_on()
        return message.topic, message.data, message.log_time

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """Return the topics of the bag."""
        return [_topic(number, each) for number, each in enumerate(self._opened().topics.values())]

    def get_metadata(self) -> BagMetadata:
        """Return what the bag says of itself."""
        return _metadata(self._opened())

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """Read these topics alone, from here on."""
        self._filter = storage_filter
        self._begin(self._bounds[0] if self._next is None else self._next.log_time)

    def reset_filter(self) -> None:
        """Read all topics again."""
        self.set_filter(StorageFilter())

    def set_read_order(self, read_order: ReadOrder) -> bool:
        """Read in this order, from the beginning; return whether it can be had."""
        if read_order.sort_by is ReadOrderSortBy.File:
            return False
        self._order = read_order
        self._begin(self._bounds[0])
        return True

    def seek(self, timestamp: int) -> None:
        """Go on with the first message from a time on, ns; backwards, with the last until then."""
        self._begin(timestamp)

    def _opened(self) -> BagReader:
        if self._bag is None:
            raise RuntimeError('Bag is not open. Call open() before reading.')
        return self._bag

    def _begin(self, time: int | None) -> None:
        bag = self._opened()
        begin, end = self._bounds
        if self._order.reverse:
            end = time if time is not None and time != begin else end
        else:
            begin = time
        topics = self._filter.chosen(bag.topics)
        messages: Iterable[BagMessage] = bag.messages(topics, begin, end)
        if self._order.sort_by is ReadOrderSortBy.PublishedTimestamp:
            messages = sorted(messages, key=lambda each: each.publish_time)
        if self._order.reverse:
            messages = reversed([*messages])
        self._left = iter(messages)
        self._go_on()

    def _go_on(self) -> None:
        try:
            self._next = next(self._left, None)
        except BagError as error:
            raise RuntimeError(str(error)) from error


SequentialCompressionReader = SequentialReader


class SequentialWriter:
    """Writes a bag, one message after the other. What cannot be written raises RuntimeError."""

    def __init__(self) -> None:
        self._bag: BagWriter | None = None

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions) -> None:
        """Make a bag; its folder must not be there yet."""
        _require_cdr(converter_options)
        storage = storage_options.storage_id or 'mcap'
        if storage not in STORAGES:
            raise RuntimeError(f"storage '{storage}' is not written; {' and '.join(STORAGES)} are")
        try:
            options = WriterOptions(
                storage=storage,
                preset=storage_options.storage_preset_profile or 'none',
                max_bag_size=storage_options.max_bagfile_size,
                max_bag_duration=storage_options.max_bagfile_duration * NANOSECONDS,
                custom_data=storage_options.custom_data,
            )
            self._bag = BagWriter(Path(storage_options.uri), options)
        except BagError as error:
            raise RuntimeError(str(error)) from error

    def create_topic(self, topic: TopicMetadata) -> None:
        """Declare a topic, before its first message."""
        own = _Topic(
            topic.name, topic.type, topic.serialization_format or 'cdr', (),
            topic.type_description_hash,
        )  # fmt: skip
        self._written(lambda bag: bag.add_topic(own))

    def write(
        self, topic_name: str, message: bytes, timestamp: int, sequence_number: int = 0
    ) -> None:
        """Write a message that was received, and sent, at a time, ns."""
        del sequence_number  # no storage here has it
        bag = self._opened()
        if topic_name not in bag.topics:
            raise RuntimeError(
                f"Failed to write on topic '{topic_name}'. Call create_topic() before first write."
            )
        sent = BagMessage(topic_name, bytes(message), timestamp, timestamp)
        self._written(lambda bag: bag.write(sent))

    def split_bagfile(self) -> None:
        """Begin a new file."""
        self._written(lambda bag: bag.split())

    def close(self) -> None:
        """Complete the bag; one that is not closed is complete when the writer is forgotten."""
        if self._bag is not None:
            bag, self._bag = self._bag, None
            _attempt(bag.close)

    def __del__(self) -> None:
        self.close()

    def _opened(self) -> BagWriter:
        if self._bag is None:
            raise RuntimeError('Bag is not open. Call open() before writing.')
        return self._bag

    def _written(self, act: Callable[[BagWriter], object]) -> None:
        bag = self._opened()
        _attempt(lambda: act(bag))


def _attempt(act: Callable[[], object]) -> None:
    try:
        act()
    except BagError as error:
        raise RuntimeError(str(error)) from error


class Info:
    """What a bag says of itself."""

    def read_metadata(self, uri: str, storage_id: str = '') -> BagMetadata:
        """Return it. Raises RuntimeError."""
        bag = _opened(uri, storage_id)
        try:
            return _metadata(bag)
        finally:
            bag.close()


def get_registered_readers() -> set[str]:
    """Return the storages that are read."""
    return {*STORAGES}


def get_registered_writers() -> set[str]:
    """Return the storages that are written."""
    return {*STORAGES}


def get_registered_serializers() -> set[str]:
    """Return the formats of messages that can be written."""
    return {'cdr'}


def get_registered_deserializers() -> set[str]:
    """Return the formats of messages that can be read."""
    return {'cdr'}


def get_default_storage_id() -> str:
    """Return the storage of which new bags are."""
    return 'mcap'


def _require_cdr(options: ConverterOptions) -> None:
    formats = {options.input_serialization_format, options.output_serialization_format}
    if formats - {'', 'cdr'}:
        raise RuntimeError(f'messages are of the format cdr here, found {sorted(formats)}')


def _opened(uri: str, storage_id: str) -> BagReader:
    try:
        return BagReader(Path(uri.removeprefix('file://')), storage_id or None)
    except BagError as error:
        raise RuntimeError(str(error)) from error


def _topic(number: int, topic: _Topic) -> TopicMetadata:
    return TopicMetadata(
        number,
        topic.name,
        topic.type,
        topic.serialization_format,
        [*topic.offered_qos_profiles],
        topic.type_description_hash,
    )


def _metadata(bag: BagReader) -> BagMetadata:
    told: _Metadata = bag.metadata
    return BagMetadata(
        told.version,
        bag.size,
        told.storage_identifier,
        [*told.relative_file_paths],
        [
            FileInformation(
                each.path,
                Time(nanoseconds=each.starting_time),
                Duration(nanoseconds=each.duration),
                each.message_count,
            )
            for each in told.files
        ],
        Duration(nanoseconds=told.duration),
        Time(nanoseconds=told.starting_time),
        told.message_count,
        [
            TopicInformation(_topic(number, each.topic_metadata), each.message_count)
            for number, each in enumerate(told.topics_with_message_count)
        ],
        told.compression_format,
        told.compression_mode,
        dict(told.custom_data),
        told.ros_distro,
    )
