# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``BagReader``: the messages of a bag in the order of their times, from whatever is there.

A file whose times begin again, as after the reset of a simulation, is the begin of another run:
runs are read one after the other, each in the order of its times.
"""

from collections.abc import Collection, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cached_property
import heapq
from itertools import chain
import os
from pathlib import Path

from amr_description.bag import compression, mcap_file, metadata, sqlite_file
from amr_description.bag.mcap_file import McapFile
from amr_description.bag.metadata import BagMetadata, TopicInformation
from amr_description.bag.sqlite_file import SqliteFile
from amr_description.bag.storage import BagMessage, FileExtent, TopicMetadata
from amr_description.errors import BagError
from amr_description.text import shorten

STORAGES = {'mcap': ('.mcap',), 'sqlite3': ('.db3',)}
"""The ends of the names of files, by the name of their storage."""
_LATEST = 2**63 - 1  # ns; larger ones SQLite does not know
_DISORDER = 100_000_000
"""ns by which a file may begin before the end of the one before: what came late to a recorder."""


class BagReader:
    """
    Reads a folder with or without ``metadata.yaml``, or one file; ``close`` it.

    Without ``metadata.yaml``, as after an interruption, the files say what is in them.
    """

    def __init__(
        self, path: Path, storage: str | None = None, *, with_metadata: bool = True
    ) -> None:
        """
        Open all files of the bag.

        Args:
            path: a folder, or a file.
            storage: ``mcap`` or ``sqlite3``; None: what the bag says.
            with_metadata: go by ``metadata.yaml``, if it is there; otherwise by the files alone.

        Raises:
            BagError: there is no bag, or it cannot be read.
        """
        self.path = path
        self._files: list[McapFile] | list[SqliteFile] = []
        given: BagMetadata | None = None
        if not path.exists():
            raise BagError(f'No such bag: {path} does not exist')
        if path.is_dir():
            if with_metadata and (path / metadata.FILE_NAME).exists():
                given = metadata.read(path)
            paths = _paths(path, given, storage)
        else:
            paths = [path]
        self.is_rebuilt = given is None
        """Whether there was no ``metadata.yaml``."""
        self.storage = storage or (given.storage_identifier if given else storage_of(paths[0]))
        if self.storage not in STORAGES:
            raise BagError(
                f"{path}: storage '{shorten(self.storage)}' is not known; mcap and sqlite3 are"
            )
        self._open(paths)
        try:
            if given is None:
                given = self._own_metadata() if path.is_file() else None
            self.metadata = given or rebuilt(self._files, self.storage)
        except BaseException:
            self.close()
            raise
        self._is_packed = self.metadata.compression_mode.upper() == 'MESSAGE'

    def __enter__(self) -> 'BagReader':
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Close all files."""
        for file in self._files:
            file.close()

    @property
    def file_paths(self) -> list[Path]:
        """The files, in their order."""
        return [file.path for file in self._files]

    @property
    def topics(self) -> dict[str, TopicMetadata]:
        """The topics by their names."""
        information = self.metadata.topics_with_message_count
        return {each.topic_metadata.name: each.topic_metadata for each in information}

    @property
    def schemas(self) -> dict[str, str]:
        """The text of each type that the bag has, by its name."""
        found: dict[str, str] = {}
        for file in self._files:
            found.update(file.schemas)
        return found

    @property
    def size(self) -> int:
        """Bytes of all files."""
        return sum(path.stat().st_size for path in self.file_paths)

    def messages(
        self,
        topics: Collection[str] | None = None,
        start: int | None = None,
        end: int | None = None,
    ) -> Iterator[BagMessage]:
        """
        Yield the messages in the order of their log times, over all files of a run.

        Args:
            topics: which; None: all.
            start: the first log time of each run, ns; None: from the beginning.
            end: the last log time of each run, ns; None: to the end.

        Raises:
            BagError: a part of the bag cannot be read.
        """
        runs = range(len(self.runs))
        return chain.from_iterable(self.messages_of_run(each, topics, start, end) for each in runs)

    @property
    def runs(self) -> list[tuple[int, int]]:
        """
        The first and the last time of each run, ns: one, unless times begin again in a file.

        Raises BagError.
        """
        return [(begin, end) for begin, end, _ in self._runs]

    @property
    def run_of_files(self) -> list[int]:
        """In which run each of the files is. Raises BagError."""
        return [run for run, (*_, files) in enumerate(self._runs) for _ in files]

    @cached_property
    def _runs(self) -> list[tuple[int, int, list[McapFile | SqliteFile]]]:
        files = list[McapFile | SqliteFile](self._files)
        return [
            (begin, end, [files[each] for each in indices])
            for begin, end, indices in runs_of([file.extent for file in files])
        ]

    def keep_last_run(self) -> None:
        """
        Go on as if the last run in which time passes was all; BagError.

        A simulation that ends leaves one without any, as it removes its robots at a last time 0.
        """
        if len(self._runs) == 1:
            return
        found = self._runs
        kept = next((each for each in reversed(found) if each[1] > each[0]), found[-1])
        for *_, files in found:
            if files is not kept[2]:
                for file in files:
                    file.close()
        if self.storage == 'mcap':
            self._files = [file for file in kept[2] if isinstance(file, McapFile)]
        else:
            self._files = [file for file in kept[2] if isinstance(file, SqliteFile)]
        self._runs = [kept]
        self.metadata = rebuilt(self._files, self.storage)

    def messages_of_run(
        self,
        run: int,
        topics: Collection[str] | None = None,
        start: int | None = None,
        end: int | None = None,
    ) -> Iterator[BagMessage]:
        """Yield the messages of a run, as :meth:`messages`; of one that is not there none."""
        if run >= len(self._runs):
            return
        *_, of_run = self._runs[run]
        first, last = start or 0, _LATEST if end is None else end
        found: Iterable[BagMessage]
        if self.storage == 'mcap':
            files = [file for file in of_run if isinstance(file, McapFile)]
            found = mcap_file.in_order(files, topics, first, last)
        else:
            bases = [file for file in of_run if isinstance(file, SqliteFile)]
            found = heapq.merge(
                *(base.messages(topics, first, last) for base in bases),
                key=lambda message: message.log_time,
            )
        for message in found:
            yield (
                message._replace(data=compression.decompress(message.data))
                if self._is_packed
                else message
            )

    def _open(self, paths: list[Path]) -> None:
        try:
            if self.storage == 'mcap':
                self._files = mcap = []
                for path in paths:
                    mcap.append(McapFile(path))
            else:
                self._files = sqlite = []
                for path in paths:
                    sqlite.append(SqliteFile(path))
        except BaseException:
            self.close()
            raise

    def _own_metadata(self) -> BagMetadata | None:
        file = self._files[0]
        own = file.own_metadata if isinstance(file, McapFile) and file.is_complete else None
        if own:
            # It may have been renamed since, or split from the bag that it was written for.
            own.relative_file_paths = [file.path.name]
            information = file.information
            own.files = [information]
            own.message_count = information.message_count
            own.topics_with_message_count = file.topics
            own.starting_time, own.duration = information.starting_time, information.duration
        return own


def runs_of(extents: Sequence[FileExtent | None]) -> list[tuple[int, int, list[int]]]:
    """
    Return the runs of files, in their order: the first and the last time, ns, and which files.

    Files of other topics at the same times, as of two recorders, are of one run.
    """
    runs: list[tuple[int, int, list[int]]] = [(0, 0, [])]
    topics: set[str] = set()
    for index, extent in enumerate(extents):
        if extent is None:
            runs[-1][2].append(index)
            continue
        begin, end, files = runs[-1]
        if not topics:
            begin, end = extent.begin, extent.end
        is_again = extent.begin < end and (extent.begin <= begin or extent.begin < end - _DISORDER)
        if is_again and topics & extent.topics:
            topics = set(extent.topics)
            runs.append((extent.begin, extent.end, [index]))
        else:
            topics |= extent.topics
            runs[-1] = min(begin, extent.begin), max(end, extent.end), [*files, index]
    return runs


def rebuilt(files: Iterable[McapFile] | Iterable[SqliteFile], storage: str) -> BagMetadata:
    """Return what ``metadata.yaml`` would say of files."""
    found = BagMetadata(storage)
    topics: dict[str, TopicInformation] = {}
    for file in files:
        found.relative_file_paths.append(file.path.name)
        found.files.append(file.information)
        if file.path.suffix == compression.SUFFIX:
            found.compression_format, found.compression_mode = 'zstd', 'FILE'
        for each in file.topics:
            name = each.topic_metadata.name
            if name in topics:
                topics[name].message_count += each.message_count
            else:
                topics[name] = each
        own = file.own_metadata if isinstance(file, McapFile) else None
        if own:
            found.custom_data.update(own.custom_data)
            found.ros_distro = own.ros_distro
    found.span_files()
    found.message_count = sum(each.message_count for each in found.files)
    found.topics_with_message_count = list(topics.values())
    return found


def reindexed(folder: Path, storage: str | None = None) -> BagMetadata:
    """
    Return what the files of a folder say, whatever ``metadata.yaml`` does.

    Of an older one the custom data is kept. Raises BagError.
    """
    with BagReader(folder, storage, with_metadata=False) as reader:
        found = reader.metadata
    if (folder / metadata.FILE_NAME).exists():
        with suppress(BagError):
            older = metadata.read(folder)
            if older.compression_mode.upper() == 'MESSAGE':  # only it knows
                found.compression_mode = older.compression_mode
                found.compression_format = older.compression_format
            found.custom_data = {**older.custom_data, **found.custom_data}
    return found


def storage_of(path: Path) -> str:
    """Return the name of the storage that a file is of. Raises BagError."""
    with compression.open_file(path) as stream:
        head = stream.read(len(sqlite_file.MAGIC))
    if head.startswith(mcap_file.MAGIC):
        return 'mcap'
    if head == sqlite_file.MAGIC:
        return 'sqlite3'
    if mcap_file.MAGIC.startswith(head) and '.mcap' in path.suffixes:
        return 'mcap'  # cut off in its very beginning
    raise BagError(f'{path} is not a bag: it begins neither as an MCAP file nor as one of SQLite')


def files_in(folder: Path, storage: str | None = None) -> list[Path]:
    """Return the files of a bag in a folder, by the numbers in their names. Raises BagError."""
    ends = [end for name in ([storage] if storage else STORAGES) for end in STORAGES[name]]
    names = tuple(ends) + tuple(end + compression.SUFFIX for end in ends)
    found = {path for path in folder.iterdir() if path.name.endswith(names)}
    # Both are there if a recorder was killed when it had just compressed one.
    found -= {path.with_name(path.name + compression.SUFFIX) for path in found}
    if not found:
        raise BagError(
            f'{folder} is not a bag: there is neither {metadata.FILE_NAME} nor a file *.mcap or '
            '*.db3 in it'
        )
    return sorted(found, key=_number_and_name)


def _number_and_name(path: Path) -> tuple[int, str]:
    number = path.name.partition('.')[0].rpartition('_')[2]
    return (int(number) if number.isdecimal() else -1, path.name)


def _paths(folder: Path, given: BagMetadata | None, storage: str | None) -> list[Path]:
    if given is None:
        return files_in(folder, storage)
    # Before version 4 the paths had the folder in them.
    paths = [folder / path for path in given.relative_file_paths]
    # os.path takes names that are too long, or none at all.
    paths = [path if os.path.exists(path) else folder / path.name for path in paths]
    missing = [path for path in paths if not os.path.exists(path)]
    if missing:
        raise BagError(
            f'{folder / metadata.FILE_NAME} names {shorten(missing[0].name)}, which is not there; '
            f'`ros2 bag reindex {folder}` makes it anew from the files that are'
        )
    if not paths:
        raise BagError(f'{folder / metadata.FILE_NAME} names no file')
    return paths
