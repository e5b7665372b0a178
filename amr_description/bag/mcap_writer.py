# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``BagWriter``: a folder of MCAP files, or of SQLite's, as rosbag2 writes it."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

from mcap.writer import Writer

from amr_description.bag import compression, metadata, qos_text, schemas
from amr_description.bag.mcap_options import DEFAULTS, PRESETS
from amr_description.bag.metadata import BagMetadata, FileInformation, TopicInformation
from amr_description.bag.reader import reindexed, STORAGES
from amr_description.bag.sqlite_file import SqliteOutput
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError
from amr_description.text import quote


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
        """Nothing waits in a buffer."""

    def close(self) -> None:
        """Close the file."""
        self._file.close()


MINIMUM_SPLIT_SIZE = 1024
"""Bytes: rosbag2 splits at no smaller ones."""


@dataclass(frozen=True)
class WriterOptions:
    """How a bag is written."""

    storage: str = 'mcap'
    """Or ``sqlite3``, for programs that read nothing else: it has no presets and settings."""
    preset: str = 'none'
    settings: Mapping[str, Any] = field(default_factory=dict)
    """For the library of MCAP, above those of the preset."""
    max_bag_size: int = 0
    """Bytes of a file from which on the next one begins; 0: it never does."""
    max_bag_duration: int = 0
    """Nanoseconds, likewise."""
    compress_files: bool = False
    """Each file with Zstandard when it is complete."""
    custom_data: Mapping[str, str] = field(default_factory=dict)
    on_split: Callable[[Path, Path], None] | None = None
    """Called with the file that was closed and the one that was opened."""

    def __post_init__(self) -> None:
        """Raise BagError for what the storage does not have."""
        presets = [*PRESETS] if self.storage == 'mcap' else ['none']
        if self.preset not in presets:
            what = f'storage_preset_profile of {self.storage}: want one of'
            raise BagError(f'{what} {", ".join(presets)}, not {quote(self.preset)}')
        if self.settings and self.storage != 'mcap':
            raise BagError(f'storage {self.storage} has no setting {min(self.settings)}: mcap has')


class BagWriter:
    """
    Writes a bag: topics are declared, messages written, and at the end it is closed.

    What is killed before leaves all but what was written since the last chunk was full, or since
    :meth:`flush`: the reader finds it, though there is no ``metadata.yaml``.
    """

    def __init__(self, folder: Path, options: WriterOptions | None = None) -> None:
        """Make the folder and the first file. Raises BagError, also if the folder is there."""
        self.options = options or WriterOptions()
        if 0 < self.options.max_bag_size < MINIMUM_SPLIT_SIZE:
            raise BagError(
                'Invalid bag splitting size given. Please provide a value greater than '
                f'{MINIMUM_SPLIT_SIZE}. Specified value of {self.options.max_bag_size}'
            )
        self.folder = folder
        self.metadata = BagMetadata(
            self.options.storage, custom_data=dict(self.options.custom_data)
        )
        self._topics: dict[str, TopicMetadata] = {}
        self._counts: dict[str, int] = {}
        self._texts: dict[str, str] = {}
        self._file: _McapFile | SqliteOutput | None = None
        self._is_closed = False
        self._has_failed = False
        try:
            folder.mkdir(parents=True)
            self._file = self._open()
        except OSError as error:
            raise BagError(f'cannot create the bag {folder}: {error}') from error

    def __enter__(self) -> 'BagWriter':
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()

    @property
    def path(self) -> Path:
        """The file that is written to now, or was last."""
        return self.folder / Path(self.metadata.relative_file_paths[-1])

    @property
    def topics(self) -> Mapping[str, TopicMetadata]:
        """Those that were declared, by name."""
        return self._topics

    @property
    def message_count(self) -> int:
        """Of all files."""
        return self.metadata.message_count

    def add_topic(self, topic: TopicMetadata, schema: str | None = None) -> None:
        """
        Declare a topic, or change its QoS in the files that follow.

        Args:
            topic: of which messages will come.
            schema: its text; None: that of the installed type.

        Raises:
            BagError: the disk is full, say.
        """
        if topic.type not in self._texts:
            text = schemas.schema_text(topic.type) if schema is None else schema
            self._texts[topic.type] = text
        is_new = topic.name not in self._topics
        self._topics[topic.name] = topic
        self._counts.setdefault(topic.name, 0)
        if is_new and self._file:
            with self._failing(f'cannot write {self.path}'):
                self._file.add_topic(topic, self._texts[topic.type])

    def write(self, message: BagMessage) -> None:
        """Write a message of a topic that was declared. Raises BagError: the disk is full, say."""
        file = self._file
        if file is None:
            raise BagError(f'the bag {self.folder} is closed')
        if file.information.message_count and self._is_full(file, message.log_time):
            self.split()
            file = self._file or file
        try:
            file.write(message)
        except OSError as error:
            self._has_failed = True
            raise BagError(f'cannot write {self.path}: {error}') from error
        self._counts[message.topic] += 1
        self.metadata.message_count += 1

    def flush(self) -> None:
        """Have all that was written in the file: nothing of it is lost from now on."""
        if self._file:
            with self._failing(f'cannot write {self.path}'):
                self._file.flush()

    def split(self) -> None:
        """Go on in a new file. Raises BagError."""
        closed = self._close_file()
        with self._failing(f'cannot create a file of the bag {self.folder}'):
            self._file = self._open()
        if self.options.on_split:
            self.options.on_split(closed, self.path)

    def close(self) -> BagMetadata:
        """
        Complete the file and ``metadata.yaml``; again: nothing.

        After an error the bag has what was written before, and ``metadata.yaml`` says so, if there
        is room for it. Raises BagError.
        """
        if self._is_closed:
            return self.metadata
        self._is_closed = True
        try:
            self._close_file()
        finally:
            if self._has_failed:
                with suppress(BagError):
                    found = reindexed(self.folder)
                    found.custom_data |= self.options.custom_data
                    metadata.write(self.folder, found)
        if not self._has_failed:
            metadata.write(self.folder, self._complete_metadata())
        return self.metadata

    @contextmanager
    def _failing(self, what: str) -> Iterator[None]:
        """Raise BagError, which begins with ``what``, in place of an OSError."""
        try:
            yield
        except (OSError, BagError) as error:
            self._has_failed = True
            if isinstance(error, BagError):
                raise
            raise BagError(f'{what}: {error}') from error

    def _is_full(self, file: '_McapFile | SqliteOutput', log_time: int) -> bool:
        options = self.options
        return (
            0 < options.max_bag_size <= file.size
            or 0 < options.max_bag_duration < log_time - file.information.starting_time
        )

    def _open(self) -> '_McapFile | SqliteOutput':
        options = self.options
        name = f'{self.folder.name}_{len(self.metadata.files)}{STORAGES[options.storage][0]}'
        path = self.folder / name
        file: _McapFile | SqliteOutput
        if options.storage == 'mcap':
            file = _McapFile(path, {**PRESETS[options.preset], **options.settings})
        else:
            file = SqliteOutput(path)
        self.metadata.relative_file_paths.append(name)
        self.metadata.files.append(file.information)
        for topic in self._topics.values():
            file.add_topic(topic, self._texts[topic.type])
        return file

    def _close_file(self) -> Path:
        file, path = self._file, self.path
        self._file = None
        if file is None:
            return path
        with self._failing(f'cannot write {path}'):
            file.close(self._complete_metadata())
            if self.options.compress_files:
                path = compression.compress_file(path)
                file.information.path = path.name
                self.metadata.relative_file_paths[-1] = path.name
        return path

    def _complete_metadata(self) -> BagMetadata:
        whole = self.metadata
        whole.span_files()
        whole.topics_with_message_count = [
            TopicInformation(topic, self._counts[name]) for name, topic in self._topics.items()
        ]
        if self.options.compress_files:
            whole.compression_format, whole.compression_mode = 'zstd', 'FILE'
        return whole


class _McapFile:
    """
    One file of a bag. Methods raise OSError; after one it ends with what was written before.

    The library then has lost what did not fit, and still counts it: nothing more is written.
    """

    def __init__(self, path: Path, settings: Mapping[str, Any]) -> None:
        self.information = FileInformation(path.name)
        self._output = OutputFile(path)
        self._writer = Writer(self._output, **{**DEFAULTS, **settings})  # type: ignore[arg-type]
        self._writer.start('ros2', f'amr_description, mcap {version("mcap")}')
        self._waiting = 0  # bytes of messages that may still wait for their chunk to be full
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}
        self._counts: dict[str, int] = {}

    @property
    def size(self) -> int:
        """Bytes, with those that wait."""
        return self._output.tell() + self._waiting

    def add_topic(self, topic: TopicMetadata, text: str) -> None:
        if topic.type not in self._schemas:
            encoding = schemas.ENCODING if text else ''
            self._schemas[topic.type] = self._writer.register_schema(
                topic.type, encoding, text.encode()
            )
        self._channels[topic.name] = self._writer.register_channel(
            topic.name,
            topic.serialization_format,
            self._schemas[topic.type],
            {
                'offered_qos_profiles': qos_text.to_text(topic.offered_qos_profiles),
                'topic_type_hash': topic.type_description_hash,
            },
        )

    def write(self, message: BagMessage) -> None:
        before = self._output.tell()
        self._writer.add_message(
            self._channels[message.topic], message.log_time, message.data, message.publish_time
        )
        self._waiting = 0 if self._output.tell() > before else self._waiting + len(message.data)
        self._counts[message.topic] = self._counts.get(message.topic, 0) + 1
        self.information.include(message.log_time)

    def flush(self) -> None:
        self._writer.flush()
        self._waiting = 0

    def close(self, whole: BagMetadata) -> None:
        """Complete the file, which also has the metadata of itself alone: it plays alone."""
        alone = whole.of_file(self.information, self._counts)
        try:
            if self._output.is_cut_off:
                return
            self.flush()
            text = metadata.to_text(alone, with_root=False)
            self._writer.add_metadata('rosbag2', {'serialized_metadata': text})
            self._writer.finish()
        finally:
            self._output.close()
