# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The node ``rosbag2_player``: publishes a recording when it is due.

All of it happens in one thread, which waits for the next message. Services, keys and signals of
other threads are done by it between two messages.
"""

from collections import deque
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
import threading
import time as wall
from typing import Any

from rclpy.duration import Duration
from rclpy.exceptions import NameValidationException
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosbag2_interfaces.msg import ReadSplitEvent
from rosgraph_msgs.msg import Clock

from amr_description.bag.playback import BagPlayback, PlaybackOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.recording import BagRecording, is_same_offer, offer_of, SplitWatch
from amr_description.bag.ros.qos_profiles import to_rclpy
from amr_description.bag.ros.service_requests import ServiceRequests
from amr_description.bag.ros.topic_types import topic_class
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.bag.topic_selection import is_service_event
from amr_description.errors import AmrError, BagError
from amr_description.ros.discovery import DELIVERY_TIME
from amr_description.ros.messages import fill_stamp
from amr_description.ros.rclpy_internals import RCLError
from amr_description.streams import print_traceback
from amr_description.text import shorten

_SECOND = 10**9
_LATEST = 2**31 * _SECOND  # ns; builtin_interfaces/Time has no more
_SPARE = 2_000_000  # ns; with more than that to wait, messages are read ahead
_LONGEST_WAIT = 3600.0  # s
_ANSWERED = 2.0  # s; a service that takes longer has the request for sure
_POLL = 0.1  # s
NOT_WAITED_FOR = -1


@dataclass(frozen=True)
class PlayerOptions:
    """How a recording is published."""

    playback: PlaybackOptions = field(default_factory=PlaybackOptions)
    clock_frequency: float = 0.0
    """Hz of ``/clock``; 0: it is not published so."""
    clock_topics: Collection[str] | None = None
    """Each of their messages has ``/clock`` published before it; empty: of all; None: of none."""
    overrides: Mapping[str, QosProfile] = field(default_factory=dict)
    """Instead of the recorded QoS, by topic."""
    acked_timeout: int = NOT_WAITED_FOR
    """ms to wait for acknowledgements at the end; 0: for ever."""
    requests_from: str = ''
    """Whose service requests are sent: ``service_introspection`` or ``client_introspection``."""

    @property
    def has_clock(self) -> bool:
        """Whether ``/clock`` is published by the time of the recording."""
        return self.clock_frequency > 0.0 or self.clock_topics is not None


class Player:
    """
    Publishes a recording; call :meth:`start`, and :meth:`end` in every way out.

    Every method may be called in any thread.
    """

    def __init__(
        self,
        node: Node,
        recording: BagRecording,
        options: PlayerOptions,
        on_finished: Callable[[], object] = lambda: None,
    ) -> None:
        """
        Make the publishers.

        Args:
            node: to publish with.
            recording: what is played.
            options: how.
            on_finished: called in the thread of the player at the end.
        """
        self._node = node
        self._log = node.get_logger()
        self._options = options
        self._on_finished = on_finished
        self.playback = BagPlayback(recording, options.playback, wall.monotonic_ns)
        self._log.info(f'Set rate to {options.playback.rate:g}')
        self._calls: deque[Callable[[], None]] = deque()
        self._lock = threading.Lock()  # of what is appended, and whether it still is
        self._is_over = False
        self.error: BaseException | None = None
        """What ended playing, if it was not the end."""
        self._ending = False
        self._wake = threading.Event()
        self._thread = threading.Thread(target=self._run, name='player')
        self._has_begun = threading.Event()
        self._recording = recording
        self._splits = SplitWatch(recording.splits())
        self._first_run = self._told_resets = 0
        self._split_event = node.create_publisher(ReadSplitEvent, 'events/read_split', 1)
        self._clock: Publisher | None = None
        self._time = Clock()
        self._next_tick = 0
        self._tick_period = 0
        self._requests = ServiceRequests(node, options.requests_from)
        self._publishers = self._make_publishers(recording.topics)

    def _make_publishers(self, topics: Mapping[str, TopicMetadata]) -> dict[str, Publisher]:
        options = self._options
        if options.has_clock:
            self._clock = self._node.create_publisher(Clock, '/clock', QoSProfile(depth=1))
        if options.clock_frequency > 0.0:
            self._tick_period = max(1, round(_SECOND / options.clock_frequency))
        found = {}
        for topic in topics.values():
            if options.has_clock and topic.name == '/clock':
                continue
            try:
                if self._options.requests_from and is_service_event(topic):
                    self._requests.add(topic)
                    continue
                kind = topic_class(topic.type)
                found[topic.name] = self._node.create_publisher(
                    kind, topic.name, self._profile_of(topic)
                )
            except (AmrError, NameValidationException, RCLError, OverflowError) as error:
                self._log.warning(
                    f"Ignoring a topic '{shorten(topic.name)}', reason: {shorten(str(error))}."
                )
        if options.acked_timeout >= 0:
            self._warn_of_unacknowledged(found)
        return found

    def _profile_of(self, topic: TopicMetadata) -> QoSProfile:
        override = self._options.overrides.get(topic.name)
        if override is not None:
            self._log.info(f'Overriding QoS profile for topic {topic.name}')
            return to_rclpy(override)
        if not is_same_offer(topic.offered_qos_profiles):
            self._log.warning(
                f'Not all original publishers on topic {topic.name} offered the same QoS '
                'profiles. Rosbag2 cannot yet choose an adapted profile to offer for this mixed '
                'case. Falling back to the rosbag2_transport default publisher offer.'
            )
        return to_rclpy(offer_of(topic.offered_qos_profiles))

    def _warn_of_unacknowledged(self, publishers: Mapping[str, Publisher]) -> None:
        names = [name for name, each in publishers.items() if not _is_reliable(each)]
        if names:
            self._log.warning(
                '--wait-for-all-acked is invalid for the below topics since reliability of QOS '
                f'is BestEffort.\n{", ".join(names)}'
            )

    def start(self) -> None:
        """Begin to play."""
        self._thread.start()

    def end(self) -> None:
        """End playing, and wait for that."""
        self._ending = True
        self._wake.set()
        # Also one that is made and has not begun: start() may have been interrupted meanwhile.
        if self._thread in threading.enumerate():
            self._has_begun.wait()
            self._thread.join()

    def await_end(self) -> None:
        """Wait until all was played, or it was stopped."""
        self._thread.join()

    def destroy(self) -> None:
        """Destroy the publishers, after :meth:`end`; else the node has them until its own end."""
        for publisher in (*self._publishers.values(), self._split_event, self._clock):
            if publisher is not None:
                self._node.destroy_publisher(publisher)

    @property
    def is_over(self) -> bool:
        """Whether all was played, or it was stopped."""
        return self._is_over

    def pause(self) -> None:
        """Let the time of the recording stand."""
        self._call(self.playback.clock.pause)
        self._log.info('Pausing play.')

    def resume(self) -> None:
        """Let the time of the recording go on."""
        self._call(self.playback.clock.resume)
        self._log.info('Resuming play.')

    def toggle_paused(self) -> None:
        """Pause, or resume."""
        if self.is_paused:
            self.resume()
        else:
            self.pause()

    @property
    def is_paused(self) -> bool:
        """Whether the time of the recording stands."""
        return self.playback.clock.paused

    @property
    def rate(self) -> float:
        """How many times faster than recorded it is played."""
        return self.playback.clock.rate

    def set_rate(self, rate: float) -> bool:
        """Play slower or faster; return False if ``rate`` is not above 0."""
        is_set: bool = self._call(lambda: self.playback.clock.set_rate(rate))
        if is_set:
            self._log.info(f'Set rate to {rate:g}')
        else:
            self._log.warning(f'Failed to set rate to invalid value {rate:g}')
        return is_set

    def play_next(self) -> bool:
        """Publish the next message, while paused; return False if not."""
        if not self.is_paused:
            self._log.warning('Called play next, but not in paused state.')
            return False
        return bool(self._call(lambda: self._burst(1)))

    def burst(self, count: int) -> int:
        """Publish ``count`` messages at once, or all with 0, while paused; return how many."""
        if not self.is_paused:
            self._log.warning('Burst can only be used when in the paused state.')
            return 0
        played: int = self._call(lambda: self._burst(count)) or 0
        self._log.info(f'Burst {played} messages.')
        return played

    def seek(self, time: int) -> None:
        """Go on with the first message from then on, ns."""
        self._call(lambda: self.playback.seek(time))

    @property
    def is_at_end(self) -> bool:
        """Whether all has been published."""
        return bool(self._call(lambda: self.playback.is_at_end))

    def stop(self) -> None:
        """End playing; what comes after the end does not wait."""
        self._log.info('Stopping playback.')
        self._call(self.playback.stop)

    def _burst(self, count: int) -> int:
        played = 0
        while (not count or played < count) and not self._ending:
            while (latched := self._latched()) is not None:
                self._publish(latched)
            message = self.playback.play_next()
            if message is None:
                break
            played += self._publish(message)
        return played

    def _latched(self) -> BagMessage | None:
        """Return what is due while paused: only what was latched before."""
        return self.playback.poll()

    def _call(self, function: Callable[[], Any]) -> Any:
        """
        Have a function called by the thread of the player; return what it returns.

        One that fails there ends playing, as :attr:`error` says: then this returns None.
        """
        done = threading.Event()
        results = []

        def call() -> None:
            try:
                results.append(function())
            finally:
                done.set()

        with self._lock:
            has_thread = self._thread.ident is not None and not self._is_over
            if has_thread:
                self._calls.append(call)
        if has_thread:
            self._wake.set()
            done.wait()
        else:
            call()
        return results[0] if results else None

    def _run(self) -> None:
        self._has_begun.set()
        try:
            self._play()
            self._await_acknowledgements()
            self._await_answers()
        except BaseException as error:
            self._fail(error)
        finally:
            with self._lock:
                self._is_over = True
            while self._calls:  # each has somebody who waits for it
                try:
                    self._do_calls()
                except BaseException as error:
                    self._fail(error)
            self._on_finished()

    def _fail(self, error: BaseException) -> None:
        if self.error is None:
            self.error = error
            if isinstance(error, AmrError):
                self._log.error(f'Failed to play: {error}')
            else:
                print_traceback()

    def _play(self) -> None:
        playback = self.playback
        has_told_loop = False
        self._next_tick = wall.monotonic_ns()
        while not self._ending and not playback.finished:
            self._do_calls()
            tick = self._tick()
            message = playback.poll()
            if message is not None:
                self._publish(message)
                continue
            if playback.loops and not has_told_loop:
                has_told_loop = True
                self._log.info('Playing anew: times jump back, and tf2 drops what it knows.')
            waits = [each for each in (tick, playback.wait_time()) if each is not None]
            wait = min(waits, default=None)
            if (wait is None or wait > _SPARE) and playback.read_ahead():
                continue
            if wait != 0 and not playback.finished:
                seconds = _LONGEST_WAIT if wait is None else wait / _SECOND
                self._wake.wait(min(seconds, _LONGEST_WAIT))
                self._wake.clear()

    def _do_calls(self) -> None:
        while self._calls:
            self._calls.popleft()()

    def _tick(self) -> int | None:
        """Publish the clock if it is time to; return how long until the next time, ns."""
        if not self._tick_period:
            return None
        now = wall.monotonic_ns()
        if now >= self._next_tick:
            self._publish_clock(self.playback.now())
            late = (now - self._next_tick) // self._tick_period
            self._next_tick += (late + 1) * self._tick_period
        return max(0, self._next_tick - wall.monotonic_ns())

    def _publish_clock(self, time: int) -> None:
        if self._clock is not None:
            if time >= _LATEST:
                raise BagError(
                    f'/clock cannot have the time {time // _SECOND} s of the recording: it ends '
                    'in 2038'
                )
            fill_stamp(time, self._time.clock)
            self._clock.publish(self._time)

    def _publish(self, message: BagMessage) -> bool:
        """Publish a message, or send it as a request; return whether that was done."""
        # What was latched is older than the place that it is played at, and time never goes back.
        time = max(message.log_time, self.playback.begin)
        for closed, opened in self._splits.pass_time(time, self._run_of_message()):
            self._split_event.publish(
                ReadSplitEvent(
                    closed_file=str(closed),
                    opened_file=str(opened),
                    node_name=self._node.get_fully_qualified_name(),
                )
            )
        publisher = self._publishers.get(message.topic)
        if publisher is None:
            return self._requests.send(message)
        triggers = self._options.clock_topics
        if triggers is not None and (not triggers or message.topic in triggers):
            self._publish_clock(time)
        publisher.publish(message.data)
        return True

    def _run_of_message(self) -> int:
        """Return in which run of the recording it is, and say where another one begins."""
        resets = self.playback.resets
        if not resets:
            self._first_run = self._recording.run_at(self.playback.begin)
        elif resets > self._told_resets:
            self._log.info('Playing the next run: times jump back, and tf2 drops what it knows.')
        self._told_resets = resets
        return self._first_run + resets

    def _await_acknowledgements(self) -> None:
        if self._ending:
            return
        timeout = self._options.acked_timeout
        given = timeout != NOT_WAITED_FOR
        deadline = wall.monotonic() + DELIVERY_TIME
        for name, publisher in self._publishers.items():
            if not _is_reliable(publisher) or not publisher.get_subscription_count():
                continue
            if given:
                deadline = wall.monotonic() + (timeout / 1000 or float('inf'))
            while not self._ending and not publisher.wait_for_all_acked(
                Duration(seconds=max(0.0, min(_POLL, deadline - wall.monotonic())))
            ):
                if wall.monotonic() >= deadline:
                    if given:
                        self._log.error(
                            'Timed out while waiting for all published messages to be '
                            f'acknowledged for topic {name}'
                        )
                    break

    def _await_answers(self) -> None:
        """Wait until requests have arrived: one whose client goes at once may be dropped."""
        deadline = wall.monotonic() + _ANSWERED
        while not self._ending and self._requests.is_waiting and wall.monotonic() < deadline:
            self._wake.wait(_POLL)
            self._wake.clear()
            self._do_calls()


def _is_reliable(publisher: Publisher) -> bool:
    return bool(publisher.qos_profile.reliability == ReliabilityPolicy.RELIABLE)
