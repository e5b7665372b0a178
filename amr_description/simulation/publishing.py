# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a cycle publishes where nobody subscribes: it is recorded, or nothing is done for it.

It is the ``Publisher`` port of the loop, and has its messages in the same order as that of the
simulator over ROS: ``/clock`` first, then what controllers and sensors have sent.
"""

from collections.abc import Callable, Collection
from typing import Any, TYPE_CHECKING, TypeVar

from amr_description.bag.qos_text import QosProfile
from amr_description.bag.storage import TopicMetadata
from amr_description.control.contracts import Input, Qos
from amr_description.control.recorded_commands import each_new
from amr_description.log import Log, Severity
from amr_description.messages.parts import fill_stamp
from amr_description.plugin_errors import describe
from amr_description.simulation.topics.advertising import Encode

if TYPE_CHECKING:  # its libraries are for who records
    from amr_description.simulation.run_recorder import RunRecorder, Sink

_CLOCK = 'rosgraph_msgs/msg/Clock'
_QOS = Qos(depth=10, reliability='reliable', durability='volatile')
LATCHED = Qos(depth=1, reliability='reliable', durability='transient_local')
_LOG_PERIOD = 1.0
"""s of the wall clock between two lines of what cannot be written."""


def metadata_of(name: str, message: str, qos: Qos = _QOS) -> TopicMetadata:
    """Return what a bag has of a topic, as a publisher of rclpy with this quality offers it."""
    profile = QosProfile(
        'keep_last' if qos.depth else 'system_default',
        qos.depth,
        qos.reliability,
        qos.durability,
        deadline=0,
        lifespan=0,
        liveliness='system_default',
        liveliness_lease_duration=0,
    )
    return TopicMetadata(name, message, 'cdr', (profile,))


class PlainTopic:
    """A topic on which samples go out at the end of a cycle, to who records."""

    def __init__(
        self, metadata: TopicMetadata, encoder: Callable[[], Encode], publisher: 'PlainPublisher'
    ) -> None:
        """
        Publish nothing yet.

        Args:
            metadata: Of the topic.
            encoder: Returns what makes bytes of samples, once somebody records. Raises AmrError:
                nothing does.
            publisher: Of the loop.
        """
        self.metadata = metadata
        self.has_subscribers = False
        """Whether somebody records."""
        (profile,) = metadata.offered_qos_profiles
        self.is_latched = profile.durability == 'transient_local'
        self._latest: list[Any] = []
        """The newest sample of a latched topic."""
        self._encoder, self._publisher = encoder, publisher
        self._encode: Encode | None = None
        self._sink: Sink | None = None

    def send(self, sample: Any) -> None:
        """Publish a sample at the end of this cycle."""
        if self.is_latched:
            self._latest[:] = (sample,)
        if self.has_subscribers:
            self._publisher.outbox.append((self, sample))

    def write_aside(self, sample: Any) -> None:
        """Publish a sample now."""
        if self._sink is not None and self._encode is not None:
            try:
                data = self._encode(sample)
            except Exception as error:  # a third party's converter; the robot must go on
                self._publisher.log(
                    Severity.ERROR,
                    f"Could not publish on '{self.metadata.name}': {describe(error)}",
                    throttle=_LOG_PERIOD,
                )
            else:
                self._sink(data)

    def attach(self, recorder: 'RunRecorder | None') -> None:
        """Record from now on, what is latched first; None: no more."""
        self._sink = None
        if recorder is not None:
            try:
                self._encode = self._encode or self._encoder()
            except Exception as error:  # likewise
                name, reason = self.metadata.name, describe(error)
                self._publisher.log(Severity.WARN, f"'{name}' is not recorded: {reason}")
            else:
                self._sink = recorder.sink_of_samples(self.metadata)
        self.has_subscribers = self._sink is not None
        for sample in self._latest:
            self.write_aside(sample)


class PlainMessages:
    """A topic of messages that are published now and then: their bytes."""

    def __init__(self, metadata: TopicMetadata) -> None:
        """Publish nothing yet."""
        self.metadata = metadata
        self._latest: Callable[[], bytes] | None = None
        self._is_latched = metadata.offered_qos_profiles[0].durability == 'transient_local'
        self._sink: Sink | None = None

    def publish(self, make: Callable[[], bytes]) -> None:
        """Publish a message now, which is made if somebody records, or when somebody does."""
        if self._is_latched:
            self._latest = make
        if self._sink is not None:
            self._sink(make())

    def attach(self, recorder: 'RunRecorder | None') -> None:
        """Record from now on, what is latched first; None: no more."""
        self._sink = None if recorder is None else recorder.sink_of_messages(self.metadata)
        if self._sink is not None and self._latest is not None:
            self._sink(self._latest())


class PlainInput:
    """An input of a controller whose commands are recorded when the controller takes them."""

    def __init__(self, name: str, port: Input[Any]) -> None:
        """Record nothing yet; ``name``: of its topic."""
        self.metadata = TopicMetadata(name, port.port.message)
        self.port = port

    def attach(self, recorder: 'RunRecorder | None') -> None:
        """Record from now on; None: no more."""
        sink = None
        if recorder is not None:
            sink = recorder.sink_of_commands(self.metadata.name, self.metadata.type)
        self.port.on_drain = None if sink is None else each_new(sink)


_Recorded = TypeVar('_Recorded', bound=PlainTopic | PlainMessages | PlainInput)


class PlainPublisher:
    """See the module; it makes topics, too (``Topics``)."""

    def __init__(self, log: Log) -> None:
        """``log``: of the simulator."""
        self.log = log
        self.reporters: list[Callable[[int], None]] = []
        self.followers: list[Callable[[], None]] = []
        self.observers: list[Callable[[int], None]] = []
        """Called at the end of each cycle with its time, ns, whether somebody records or not."""
        self.outbox: list[tuple[PlainTopic, Any]] = []
        self._recorder: RunRecorder | None = None
        self._clock = PlainTopic(metadata_of('/clock', _CLOCK), _clock_encoder, self)
        self._recorded: list[PlainTopic | PlainMessages | PlainInput] = [self._clock]

    # --- topics -------------------------------------------------------------------------------

    def advertise(self, name: str, message: str, encode: Encode) -> PlainTopic:
        """Make a topic of a sensor, say."""
        return self.add(PlainTopic(metadata_of(name, message), lambda: encode, self))

    def withdraw(self, topic: Any) -> None:
        """Remove a topic."""
        self.forget([topic])

    def messages(self, name: str, message: str, qos: Qos = _QOS) -> PlainMessages:
        """Make a topic of messages that are published now and then."""
        return self.add(PlainMessages(metadata_of(name, message, qos)))

    def forget(self, gone: Collection[PlainTopic | PlainMessages | PlainInput]) -> None:
        """Record nothing of these any more."""
        for each in gone:
            each.attach(None)
            if self._recorder is not None and not isinstance(each, PlainInput):
                self._recorder.unlatch(each.metadata.name)
        self._recorded = [each for each in self._recorded if each not in gone]

    def add(self, each: _Recorded) -> _Recorded:
        """Have a topic recorded, until it is forgotten."""
        self._recorded.append(each)
        if self._recorder is not None:
            each.attach(self._recorder)
        return each

    # --- recording ----------------------------------------------------------------------------

    @property
    def message_types(self) -> set[str]:
        """Names of the types of what is recorded now."""
        return {each.metadata.type for each in self._recorded}

    def set_recorder(self, recorder: 'RunRecorder | None') -> None:
        """Record with a recorder from now on; None: no more."""
        self._recorder = recorder
        self.outbox.clear()
        for each in self._recorded:
            each.attach(recorder)

    # --- the loop -----------------------------------------------------------------------------

    def set_clocks(self, time: int) -> None:
        """Give what follows a time, ns."""
        if self._recorder is not None:
            self._recorder.set_time(time)

    def publish(self, time: int) -> None:
        """Publish what was sent since the last call; ``time``: of this cycle, ns."""
        for observe in self.observers:
            observe(time)
        recorder = self._recorder
        if recorder is None:
            return
        recorder.begin_cycle(time)
        for report in self.reporters:
            report(time)
        self._clock.write_aside(time)
        for topic, sample in self.outbox:
            topic.write_aside(sample)
        self.outbox.clear()
        for follow in self.followers:
            follow()
        recorder.end_cycle()


def _clock_encoder() -> Encode:
    from amr_description.messages.encoders import encoder_of, PlainForm

    return encoder_of(
        int, _CLOCK, lambda time, message: fill_stamp(time, message.clock), PlainForm(_CLOCK)
    )
