# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Several bags as one recording, and what was latched at a time of it."""

from bisect import bisect_right
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
import heapq
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError

_UNBOUNDED = 1000  # messages of a publisher that keeps all
_MOST_LATCHED = 100_000  # messages, whatever a bag says
_TRANSFORMS = 'tf2_msgs/msg/TFMessage'


class Split(NamedTuple):
    """Where a file of a bag begins: the time, ns, its path, and the number of its run."""

    begin: int
    path: Path
    run: int = 0


class BagRecording:
    """
    The chosen topics of one bag or several, in the order of their times.

    Where times begin again another run begins, as after the reset of a simulation: the first runs
    of all bags come first, then the second ones.
    """

    def __init__(
        self, readers: Sequence[BagReader], holds: Callable[[TopicMetadata], bool] = lambda _: True
    ) -> None:
        """
        Take bags that are open.

        Args:
            readers: of them; whoever opened them closes them.
            holds: returns whether a topic is chosen.

        Raises:
            BagError: a topic has two types.
        """
        self._readers = readers
        self.topics: dict[str, TopicMetadata] = {}
        for reader in readers:
            for topic in reader.topics.values():
                if holds(topic):
                    self._add(topic, reader)

    def _add(self, topic: TopicMetadata, reader: BagReader) -> None:
        known = self.topics.setdefault(topic.name, topic)
        if known.type != topic.type:
            raise BagError(
                f'{topic.name} has the type {topic.type} in {reader.path}, but {known.type} in a '
                'bag before'
            )
        if known is not topic:
            profiles = dict.fromkeys(known.offered_qos_profiles + topic.offered_qos_profiles)
            self.topics[topic.name] = replace(known, offered_qos_profiles=tuple(profiles))

    @property
    def start(self) -> int:
        """The time of the first message, ns. Raises BagError."""
        used = [each for each in self._readers if each.metadata.message_count]
        if self.runs > 1:
            return min(each.runs[0][0] for each in used)
        return min((each.metadata.starting_time for each in used), default=0)

    @property
    def end(self) -> int:
        """The last time of any message, ns."""
        used = [each.metadata for each in self._readers if each.metadata.message_count]
        return max((each.end_time for each in used), default=0)

    @property
    def schemas(self) -> dict[str, str]:
        """The text of each type that the bags have, by its name."""
        return {name: text for each in self._readers for name, text in each.schemas.items()}

    @property
    def runs(self) -> int:
        """How many there are: one, unless times begin again. Raises BagError."""
        return max((len(each.runs) for each in self._readers), default=1)

    def run_at(self, time: int) -> int:
        """Return the number of the first run that goes on at a time, ns, or after it. BagError."""
        for run in range(self.runs - 1):
            spans = (each.runs[run] for each in self._readers if run < len(each.runs))
            if any(end >= time for _, end in spans):
                return run
        return self.runs - 1

    def messages(self, start: int) -> Iterator[BagMessage]:
        """Yield the messages from a time of the first run that has it on, ns. Raises BagError."""
        run = self.run_at(start)
        later = range(run + 1, self.runs)
        return chain(
            self._of(self.topics, run, start, None),
            chain.from_iterable(self._of(self.topics, each, 0, None) for each in later),
        )

    def messages_of_run(
        self, run: int, start: int, end: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield the messages of a run from a time on, up to another, both ns. Raises BagError."""
        return self._of(self.topics, run, start, end)

    def latched_before(self, time: int, run: int | None = None) -> list[BagMessage]:
        """
        Return the messages that a subscription which begins at a time would still get.

        Args:
            time: ns.
            run: of which that is a time; None: the first one that has it.

        Raises:
            BagError: the bag cannot be read.
        """
        if run is None:
            run = self.run_at(time)
        depths = {
            name: depth
            for name, topic in self.topics.items()
            if (depth := latched_depth(topic.offered_qos_profiles))
        }
        if (not run and time <= self.start) or not depths:
            return []
        for name in depths:
            # Who published what is not recorded. A transform that is published once must not be
            # pushed out by another node's; older ones than the newest do no harm, in their order.
            topic = self.topics[name]
            if topic.type == _TRANSFORMS and len(topic.offered_qos_profiles) > 1:
                depths[name] = _UNBOUNDED
        kept: dict[str, deque[tuple[int, BagMessage]]] = {
            name: deque(maxlen=depth) for name, depth in depths.items()
        }
        for each in range(run + 1):
            for message in self._of(depths, each, 0, None if each < run else time - 1):
                kept[message.topic].append((each, message))
        found = [pair for each in kept.values() for pair in each]
        found.sort(key=lambda pair: (pair[0], pair[1].log_time))
        return [message for _, message in found]

    def splits(self) -> list[list[Split]]:
        """Return where each file begins, for each bag. Raises BagError."""
        return [
            [
                Split(file.starting_time, path, run)
                for file, path, run in zip(
                    each.metadata.files, each.file_paths, each.run_of_files, strict=False
                )
            ]
            for each in self._readers
        ]

    def _of(
        self, topics: Iterable[str], run: int, start: int, end: int | None
    ) -> Iterator[BagMessage]:
        names = set(topics)
        found = [each.messages_of_run(run, names, start, end) for each in self._readers]
        if len(found) == 1:
            return found[0]
        return heapq.merge(*found, key=lambda message: message.log_time)


class SplitWatch:
    """Notices by the times of messages that the next file of a bag has begun."""

    def __init__(self, splits: Iterable[Sequence[Split]]) -> None:
        """``splits``: as of :meth:`BagRecording.splits`."""
        self._bags = [
            sorted((Split(*each) for each in files), key=_run_and_begin)
            for files in splits
            if len(files) > 1
        ]
        self._current = [0] * len(self._bags)

    def pass_time(self, time: int, run: int = 0) -> list[tuple[Path, Path]]:
        """Return the files that ended before a time of a run, ns, and those after them."""
        passed = []
        for index, files in enumerate(self._bags):
            place = max(0, bisect_right(files, (run, time), key=_run_and_begin) - 1)
            before = self._current[index]
            passed += [(files[n].path, files[n + 1].path) for n in range(before, place)]
            self._current[index] = place
        return passed


def _run_and_begin(split: Split) -> tuple[int, int]:
    return split.run, split.begin


def latched_depth(profiles: Iterable[QosProfile]) -> int:
    """Return how many messages late subscriptions get from publishers of these profiles."""
    depth = sum(
        _UNBOUNDED if each.history == 'keep_all' else max(each.depth, 1)
        for each in profiles
        if each.durability == 'transient_local'
    )
    return min(depth, _MOST_LATCHED)


def is_same_offer(profiles: Sequence[QosProfile]) -> bool:
    """Return whether publishers offer the same, but for how many messages they keep."""
    return len({replace(each, history='keep_last', depth=0) for each in profiles}) <= 1


def offer_of(profiles: Sequence[QosProfile]) -> QosProfile:
    """
    Return the profile to play a topic with whose publishers had these.

    That of the original: theirs if they agree, with a depth of 10; else the default. What was
    latched by more than ten publishers, or by one that kept more, is all kept.
    """
    if not profiles or not is_same_offer(profiles):
        return QosProfile()
    depth = max(QosProfile().depth, latched_depth(profiles))
    return replace(profiles[0], history='keep_last', depth=depth)
