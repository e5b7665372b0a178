# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""New bags of the messages of others: converted, cut, filtered, merged."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from pathlib import Path
import shutil

from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.reader import BagReader
from amr_description.bag.recording import BagRecording
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError


def _all(_topic: TopicMetadata) -> bool:
    return True


@dataclass(frozen=True)
class RewrittenBag:
    """A bag that is written; times are ns."""

    folder: Path
    holds: Callable[[TopicMetadata], bool] = _all
    """Returns whether a topic is written."""
    start: int | None = None
    """The first time; None: from the begin."""
    end: int | None = None
    """The last time; None: to the end."""
    keeps_latched: bool = False
    """Whether what was latched before ``start`` is written with that time."""
    writer: WriterOptions = field(default_factory=WriterOptions)


def rewrite(readers: Sequence[BagReader], outputs: Sequence[RewrittenBag]) -> list[int]:
    """
    Write bags of the messages of others, and return how many each has.

    Args:
        readers: those of the others; of several the messages are merged by their times, run by
            run. A run of the input is one of the output, with the part of it that is written.
        outputs: what is written. If that fails, or is interrupted, none of them is left.

    Raises:
        BagError: a bag cannot be read or written, or is there already.
    """
    for output in outputs:
        if output.folder.exists():
            raise BagError(f'{output.folder} is there already: choose another name with --output')
    recordings = [BagRecording(readers, output.holds) for output in outputs]
    names = {name for recording in recordings for name in recording.topics}
    everything = BagRecording(readers, lambda topic: topic.name in names)
    with ExitStack() as made:
        writers = [
            _Writer(output, recording, made)
            for output, recording in zip(outputs, recordings, strict=True)
        ]
        starts = [output.start for output in outputs]
        ends = [output.end for output in outputs]
        start = min((each for each in starts if each is not None), default=0)
        first = 0 if None in starts else start
        last = None if None in ends else max(each for each in ends if each is not None)
        for run in range(everything.runs):
            for writer in writers:
                writer.begin(run)
            for message in everything.messages_of_run(run, first, last):
                for writer in writers:
                    writer.write(message)
        counts = [writer.close() for writer in writers]
        made.pop_all()  # they stay
    return counts


class _Writer:
    """One of the bags; it is removed by ``made`` unless it is complete."""

    def __init__(self, output: RewrittenBag, recording: BagRecording, made: ExitStack) -> None:
        self._first = 0 if output.start is None else output.start
        self._last = 2**63 if output.end is None else output.end
        self._topics = recording.topics
        self._recording = recording
        self._keeps_latched = output.keeps_latched and output.start is not None
        self._run = 0
        self._has_begun = False
        self._writer = BagWriter(output.folder, output.writer)
        made.callback(shutil.rmtree, output.folder, ignore_errors=True)
        made.callback(self._writer.close)
        schemas = recording.schemas
        for topic in recording.topics.values():
            self._writer.add_topic(topic, schemas.get(topic.type))

    def begin(self, run: int) -> None:
        """What comes now is of a run."""
        self._run, self._has_begun = run, False

    def write(self, message: BagMessage) -> None:
        if message.topic in self._topics and self._first <= message.log_time <= self._last:
            if not self._has_begun:
                self._begin()
            self._writer.write(message)

    def _begin(self) -> None:
        """Begin a file, unless this one is empty, with what was latched before."""
        self._has_begun = True
        if self._writer.message_count:
            self._writer.split()
        if self._keeps_latched:
            for message in self._recording.latched_before(self._first, self._run):
                self._writer.write(message._replace(log_time=self._first))

    def close(self) -> int:
        if not self._writer.message_count:
            self._begin()
        self._writer.close()
        return self._writer.message_count


def with_custom_data(options: WriterOptions, readers: Sequence[BagReader]) -> WriterOptions:
    """Return options with what users have noted in bags; what is in the options goes before."""
    noted = {key: value for each in readers for key, value in each.metadata.custom_data.items()}
    return replace(options, custom_data={**noted, **options.custom_data})
