# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages of a bag as samples: the last one of a topic until a time, and numbers of all."""

import asyncio
from base64 import b64encode
from collections.abc import Callable, Set as AbstractSet
from functools import partial
from pathlib import Path
import threading
import time
from typing import TypeAlias

import numpy as np

from amr_description.bag.reader import BagReader
from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, ViewerError
from amr_description.ros.layouts import layout_of
from amr_description.ros.message_types import message_type
from amr_description.viewer.backend import Watched
from amr_description.viewer.bags import SeriesData
from amr_description.viewer.protocol import Channel
from amr_description.viewer.ros import message_feed
from amr_description.viewer.ros.field_feed import fields_of
from amr_description.viewer.ros.recorded import Recorded
from amr_description.viewer.ros.sensor_samples import sample_of, unreadable
from amr_description.viewer.samples import Sample
from amr_description.viewer.tracks import NOTHING, thinned

_PERIOD = 1 / 30
"""s between two samples of a topic, at least."""
_RATE_SPAN = 3 * NANOSECONDS
_MOST_VALUES = 60_000
"""Of a series: a page keeps 65,536 one by one."""

_Key: TypeAlias = tuple[Channel, str]


class BagSamples:
    """
    The messages that pages show, on the server's thread; other threads read and convert them.

    Args:
        reader: of the bag, which nobody else reads from any more.
        recorded: what it says.
    """

    def __init__(self, reader: BagReader, recorded: Recorded) -> None:
        self._reader = reader
        self._reading = threading.Lock()
        self._recorded = recorded
        self._sensors = {each.topic: each for each in recorded.graph.sensors}
        self._feeds: dict[_Key, _Feed] = {}
        self._whole: AbstractSet[str] = frozenset()

    def watch(self, watched: Watched) -> None:
        """Make samples of these topics, as far as there are."""
        self._whole = watched.whole
        keys: set[_Key] = {('sensor', each) for each in watched.sensors & self._sensors.keys()}
        keys |= {('message', each) for each in watched.messages & self._recorded.topics.keys()}
        self._feeds = {key: self._feeds.get(key) or self._feed(key) for key in keys}

    def take(self, wanted: AbstractSet[_Key], at: int) -> list[Sample]:
        """Return what is new at a time of the bag, ns, of channels that pages can take."""
        now = time.monotonic()
        taken = ((key, each.take(at, now)) for key, each in self._feeds.items() if key in wanted)
        return [
            Sample(topic, frame, channel, self._is_map(channel, topic))
            for (channel, topic), frame in taken
            if frame is not None
        ]

    def _is_map(self, channel: Channel, topic: str) -> bool:
        return channel == 'sensor' and self._sensors[topic].kind == 'map'

    def _feed(self, key: _Key) -> '_Feed':
        return _Feed(partial(self._frame, key), self._recorded, key[1])

    def _frame(self, key: _Key, time: int, rate: float | None) -> bytes:
        """Return the sample of the message of a time; one that cannot be shown says why."""
        channel, topic = key
        kind = self._recorded.topics[topic].type
        try:
            with self._reading:
                *_, message = self._reader.messages([topic], time, time)
            if channel == 'sensor':
                kind = self._sensors[topic].message
                is_whole = topic in self._whole
                return sample_of(kind, message.data, topic, rate, is_whole=is_whole)
            layout = layout_of(message_type(kind, f'The type of {topic}'))
            return message_feed.sample_of(layout, message.data, topic, rate)
        except (AmrError, ValueError) as error:
            if channel == 'sensor':
                return unreadable(topic, str(error))
            return message_feed.unreadable(topic, channel, str(error))


class _Feed:
    """One topic: the index of the message that is shown, and the next sample in the making."""

    def __init__(
        self, convert: Callable[[int, float | None], bytes], recorded: Recorded, topic: str
    ) -> None:
        self._convert = convert
        self._times = recorded.times[topic]
        self._shown = NOTHING
        self._due = 0.0
        self._work: asyncio.Future[bytes] | None = None

    def take(self, at: int, now: float) -> bytes | None:
        """Return a new sample; None: there is none yet."""
        if self._work is not None:
            if not self._work.done():
                return None
            work, self._work = self._work, None
            return work.result()
        # What was latched before the recorder came was received as it began.
        index = max(self._times.index(at), 0) if len(self._times) == 1 else self._times.index(at)
        if index in (self._shown, NOTHING) or now < self._due:
            return None
        self._shown, self._due = index, now + _PERIOD
        loop = asyncio.get_running_loop()
        rate = self._times.rate(index, _RATE_SPAN)
        self._work = loop.run_in_executor(None, self._convert, self._times.time(index), rate)
        return None


def read_series(
    path: Path, recorded: Recorded, topic: str, field: str, is_over: threading.Event
) -> SeriesData:
    """
    Return a number of all messages of a topic.

    Args:
        path: of the bag.
        recorded: what it says.
        topic: in the bag.
        field: its path.
        is_over: set when nobody waits for it any more.

    Raises:
        ViewerError: there is no such topic or number, or nobody waits.
        BagError: the bag cannot be read.
    """
    known = recorded.topics.get(topic)
    if known is None:
        raise ViewerError(f'the recording has no topic {topic}')
    fields = fields_of(message_type(known.type, f'The type of {topic}'), (field,))
    if field in fields.faults:
        raise ViewerError(fields.faults[field])
    stamps: list[float] = []
    values: list[float] = []
    with BagReader(path) as reader:
        reader.keep_last_run()
        for message in reader.messages([topic]):
            if is_over.is_set():
                raise ViewerError('nobody waits for it any more')
            try:
                seconds, nanoseconds, value = fields.read(message.data)
            except ValueError:  # it is broken
                continue
            stamp = seconds + nanoseconds / NANOSECONDS
            stamps.append(stamp or recorded.time(message.log_time))
            values.append(value)
    times, numbers = thinned(np.array(stamps, '<f8'), np.array(values, '<f8'), _MOST_VALUES)
    return SeriesData(
        b64encode(times.tobytes()).decode(),
        b64encode(numbers.tobytes()).decode(),
        fields.names.get(field, {}),
    )
