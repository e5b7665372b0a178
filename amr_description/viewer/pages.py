# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The connected pages, and what each of them is sent; all on the server's thread.

Nothing waits for a page: a frame that is sent goes to the write buffer of its connection. A page
gets no state while its buffer holds anything, so the states that it gets are never old (the
system's own send buffer is kept small, see ``server``). Nor does it get a sample: the newest of
each topic waits for it, and replaces the one that waited before; plotted values wait one after the
other, in bounded memory, and the oldest are dropped. Of messages that say how something is, too,
the newest waits. It is disconnected when its buffer grows too large, and by websockets when it
does not answer pings.
"""

from collections import deque
from collections.abc import Container, Iterable

from websockets.asyncio.connection import broadcast
from websockets.asyncio.server import ServerConnection

from amr_description.viewer.backend import Watched
from amr_description.viewer.encoding import encode
from amr_description.viewer.protocol import Channel, REPLACED, ServerMessage
from amr_description.viewer.requests import Part
from amr_description.viewer.samples import Sample

MOST_PAGES = 32
_LARGEST_BUFFER = 64 * 1024 * 1024
"""Bytes; a page whose write buffer is larger is disconnected."""
_LARGEST_QUEUE = 1024 * 1024
"""Bytes of plotted values that wait for a page: 10 fields at 1 kHz for 12 s."""


class Page:
    """One page; ``name`` is what the other pages call it."""

    def __init__(self, name: str, connection: ServerConnection) -> None:
        self.name = name
        self.connection = connection
        self.pending = 0
        """Requests in progress."""
        self.watched = Watched()
        """What it shows."""
        self.waiting: dict[tuple[Channel, str], bytes] = {}
        """The newest sample of each channel that was not sent yet."""
        self._messages: dict[tuple[str, str], str] = {}
        """(type, subject) -> the newest text frame that says how something is, not sent yet."""
        self._values: deque[tuple[str, bytes]] = deque()
        """Samples of plotted values, with their topics, that were not sent yet."""
        self._queued = 0
        """Bytes of them."""

    def send_message(self, message: ServerMessage) -> None:
        """Send a text frame."""
        self.send(encode(message))

    def send(self, frame: str | bytes) -> None:
        """Send a frame, whatever the write buffer holds."""
        broadcast([self.connection], frame)
        if self.buffered > _LARGEST_BUFFER:
            self.connection.transport.abort()

    def keep(self, key: tuple[str, str], frame: str) -> None:
        """Send a text frame as soon as the write buffer is empty; a newer one replaces it."""
        self._messages[key] = frame
        self.send_messages()

    def send_messages(self) -> None:
        """Send the messages that wait, as long as the write buffer is empty."""
        while self._messages and not self.buffered:
            self.send(self._messages.pop(next(iter(self._messages))))

    def retain(self, subjects: Container[str]) -> None:
        """Drop what waits about all other subjects."""
        self._messages = {key: each for key, each in self._messages.items() if key[1] in subjects}

    def send_samples(self) -> None:
        """Send what waits, as long as the write buffer is empty."""
        while self._values and not self.buffered:
            self.send(self._pop())
        while self.waiting and not self.buffered:
            self.send(self.waiting.pop(next(iter(self.waiting))))

    def queue(self, topic: str, values: bytes) -> None:
        """Have values sent as soon as the write buffer is empty; the oldest give way."""
        self._values.append((topic, values))
        self._queued += len(values)
        while self._queued > _LARGEST_QUEUE:
            self._pop()

    def show(self, watched: Watched) -> None:
        """Take note of what it shows; what waits of anything else is dropped."""
        self.watched = watched
        shown = watched.latest
        self.waiting = {key: each for key, each in self.waiting.items() if key in shown}
        self._values = deque(each for each in self._values if each[0] in watched.fields)
        self._queued = sum(len(frame) for _, frame in self._values)

    def _pop(self) -> bytes:
        _, frame = self._values.popleft()
        self._queued -= len(frame)
        return frame

    @property
    def buffered(self) -> int:
        """Bytes in the write buffer: those that the system has not taken yet."""
        return self.connection.transport.get_write_buffer_size()


class Pages:
    """All pages, and the latched messages that a new one is sent."""

    def __init__(self) -> None:
        self._pages: dict[str, Page] = {}
        self._count = 0
        self._latched: dict[tuple[str, str], str] = {}
        """(type of message, subject) -> text frame."""
        self._samples: dict[tuple[Channel, str], bytes] = {}
        """The latest of each channel that a page shows, for one that comes to show it."""

    def __len__(self) -> int:
        return len(self._pages)

    @property
    def is_full(self) -> bool:
        """Whether no more pages are accepted."""
        return len(self._pages) >= MOST_PAGES

    @property
    def watched(self) -> Watched:
        """What any page shows."""
        all_of = [page.watched for page in self._pages.values()]
        fields: dict[str, frozenset[str]] = {}
        for each in all_of:
            for topic, paths in each.fields.items():
                fields[topic] = fields.get(topic, frozenset()) | paths
        return Watched(
            frozenset().union(*(each.parts for each in all_of)),
            frozenset().union(*(each.sensors for each in all_of)),
            frozenset().union(*(each.messages for each in all_of)),
            fields,
            frozenset().union(*(each.whole for each in all_of)),
        )

    @property
    def wanted(self) -> frozenset[tuple[Channel, str]]:
        """Channels of which a page has had the newest sample."""
        pages = self._pages.values()
        return frozenset().union(*(each.watched.latest - each.waiting.keys() for each in pages))

    def next_name(self) -> str:
        """Return the name of the next page."""
        self._count += 1
        return f'page {self._count}'

    def add(self, page: Page, hello: ServerMessage) -> None:
        """Add a page; send it ``hello`` and all latched messages."""
        page.send_message(hello)
        for frame in self._latched.values():
            page.send(frame)
        self._pages[page.name] = page

    def remove(self, page: Page) -> None:
        """Remove a page that has disconnected."""
        self._pages.pop(page.name, None)

    def send_message(self, message: ServerMessage) -> None:
        """Send a message, about nothing that has a name, to the pages that are connected now."""
        self._send(message, '', encode(message), self._pages.values())

    def tell(self, name: str, message: ServerMessage) -> None:
        """Send a message to one page, if it is there still."""
        if (page := self._pages.get(name)) is not None:
            page.send_message(message)

    def send_to(self, part: Part, message: ServerMessage) -> None:
        """Send a message to the pages that watch a part."""
        watching = [each for each in self._pages.values() if part in each.watched.parts]
        if watching:
            self._send(message, '', encode(message), watching)

    def publish(self, subject: str, message: ServerMessage) -> None:
        """
        Send a message to all pages, also to those that connect later.

        It replaces the latched message of the same type and subject, and is not sent if it is
        equal to that.

        Args:
            subject: the robot or simulator that it is about; '' for none.
            message: to send.
        """
        key, frame = (message.type, subject), encode(message)
        if self._latched.get(key) != frame:
            self._latched[key] = frame
            self._send(message, subject, frame, self._pages.values())

    def retain(self, subjects: Iterable[str]) -> None:
        """Drop the latched messages about all other subjects; they are gone."""
        kept = {'', *subjects}
        self._latched = {key: each for key, each in self._latched.items() if key[1] in kept}
        for page in self._pages.values():
            page.retain(kept)

    def clear_latched(self) -> None:
        """Drop all latched messages: without pages they are not kept up to date."""
        self._latched.clear()

    def send_messages(self) -> None:
        """Send the messages that wait to the pages that can take them."""
        for page in [*self._pages.values()]:
            page.send_messages()

    def send_state(self, state: bytes) -> None:
        """Send a state to all pages with an empty write buffer, after the messages that wait."""
        broadcast([page.connection for page in self._pages.values() if not page.buffered], state)

    def show(self, page: Page, watched: Watched) -> None:
        """Take note of what a page shows; it gets the latest samples of what it did not show."""
        before = page.watched.latest
        page.show(watched)
        for channel in watched.latest - before:
            if (known := self._samples.get(channel)) is not None:
                page.waiting[channel] = known
        self.forget_samples()

    def forget_samples(self) -> None:
        """Drop the samples of what no page shows any more."""
        shown = self.watched.latest
        self._samples = {key: each for key, each in self._samples.items() if key in shown}

    def send_samples(self, samples: Iterable[Sample]) -> None:
        """Send new samples, and those that wait, to the pages that show them and can take them."""
        for each in samples:
            if each.channel == 'values':
                self._queue_values(each)
            else:
                self._keep_newest(each)
        for page in [*self._pages.values()]:
            page.send_samples()

    def _queue_values(self, sample: Sample) -> None:
        for page in self._pages.values():
            if sample.topic in page.watched.fields:
                page.queue(sample.topic, sample.frame)

    def _keep_newest(self, sample: Sample) -> None:
        key = sample.channel, sample.topic
        if sample.is_lasting and self._samples.get(key) == sample.frame:
            return
        self._samples[key] = sample.frame
        for page in self._pages.values():
            if key in page.watched.latest:
                page.waiting[key] = sample.frame

    def _send(
        self, message: ServerMessage, subject: str, frame: str, pages: Iterable[Page]
    ) -> None:
        for page in [*pages]:
            if type(message) in REPLACED:
                page.keep((message.type, subject), frame)
            else:
                page.send(frame)
