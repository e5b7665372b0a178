# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A bag as the backend of the page's server: no node, no DDS."""

import asyncio
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence, Set as AbstractSet
from pathlib import Path
import threading
import time
from typing import NoReturn

from amr_description.bag.playback_clock import PlaybackClock
from amr_description.bag.reader import BagReader
from amr_description.bag.storage import TopicMetadata
from amr_description.clock import NANOSECONDS
from amr_description.errors import ViewerError
from amr_description.model.frames import Vector
from amr_description.viewer.backend import Answer, Handlers, Hold, Watched
from amr_description.viewer.bags import (
    Playback,
    Playhead,
    ReadOverview,
    ReadSeries,
    Recording,
    Seek,
)
from amr_description.viewer.introspection import (
    Endpoint,
    FrameStatus,
    Log,
    TopicInfo,
    Topics,
    Transforms,
)
from amr_description.viewer.protocol import (
    Channel,
    Graph,
    Layout,
    RobotInfo,
    ServerMessage,
    World,
)
from amr_description.viewer.requests import Definition, OverviewData, Part
from amr_description.viewer.ros.bag_samples import BagSamples, read_series
from amr_description.viewer.ros.forms import define
from amr_description.viewer.ros.recorded import Recorded, RecordedRobot
from amr_description.viewer.samples import Sample
from amr_description.viewer.server import Server
from amr_description.viewer.states import LAYOUTS, StateFrame

_FASTEST = 100.0
"""Times the speed at which it was recorded."""
_HEAD_PERIOD = 0.05
"""s between two messages of where the bag is played, at least."""
_STILL_PERIOD = 0.25
"""s between two states while nothing moves: for pages that have come in between."""
_TREE_PERIOD = 0.5
_MOST_STATES = 3000
"""Of an overview."""
_LARGEST = 16 * 1024 * 1024
"""Bytes of all its states: well below what a page may be behind, see pages.py."""
_FEWEST = 1 / 60
"""s between two states of an overview, at least."""
_LONGEST_READ = 15.0
"""s for all messages of a topic: pages wait for 20 s."""
_ONLY_A_RECORDING = 'this page shows a recording: nothing of it can be driven or changed'


class BagBackend:
    """
    Serves a bag; all but :meth:`close_bag` runs on the server's thread.

    :attr:`server` must be set before the server starts.
    """

    server: Server

    def __init__(self, path: Path, log_error: Callable[[str], object]) -> None:
        """Read the bag. Raises BagError."""
        self._path = path
        self._log_error = log_error
        self._reader = BagReader(path)
        try:
            self.left_out: list[Path] = []
            """Files of runs before the last one: the simulation was reset behind them."""
            files = self._reader.file_paths
            self._reader.keep_last_run()
            self.left_out += [each for each in files if each not in self._reader.file_paths]
            self.recorded = Recorded(self._reader)
        except BaseException:
            self._reader.close()
            raise
        self._clock = PlaybackClock(self.recorded.ready, time.monotonic_ns, paused=True)
        self._states = BagStates(self.recorded)
        self._samples = BagSamples(self._reader, self.recorded)
        self._parts: AbstractSet[Part] = frozenset()
        self._told_head: tuple[int, bool, float] | None = None
        self._head_due = self._state_due = self._tree_due = 0.0
        self._shown: int | None = None
        """The time of the last state, ns."""
        self._worlds: dict[str, World] = {}
        """What was published last of those."""
        self._reads: dict[str, set[threading.Event]] = {}
        """By page: set, they end what is read for it."""
        self._overview: asyncio.Task[OverviewData] | None = None
        self.handlers = Handlers(lambda _: self._refuse())
        self.handlers.add(Seek, self._move)
        self.handlers.add(Playback, self._run)
        self.handlers.add(ReadSeries, self._series)
        self.handlers.add(ReadOverview, self._whole)
        self.handlers.add(Definition, define)

    def close_bag(self) -> None:
        """Close the files, after the server has ended."""
        self._reader.close()

    # --- the page's life -------------------------------------------------------------------------

    def open(self) -> None:
        """Tell the first page, and those after it, what there is."""
        recorded, metadata = self.recorded, self._reader.metadata
        length = (recorded.end - recorded.begin) / NANOSECONDS
        path = self._path.absolute()
        begin = recorded.begin / NANOSECONDS
        count = metadata.message_count
        recording = Recording(path.name, str(path), begin, length, count, self._reader.size)
        self.server.pages.publish('', recording)
        robots = tuple(_info(each) for each in recorded.robots)
        hint = None if robots else _hint(path)
        self.server.pages.publish('', Graph(robots, (), hint, recorded.graph.sensors))
        for robot in recorded.robots:
            if robot.described is not None:
                self.server.pages.publish(robot.found.id, robot.described.message)
        self._shown = self._told_head = None
        self._worlds.clear()

    def close(self) -> None:
        """Pause: nobody looks."""
        self._clock.pause()

    def watch(self, watched: Watched) -> None:
        """Have samples of these topics made."""
        self._parts = watched.parts
        self._samples.watch(watched)

    def forget(self, page: str) -> None:
        """End what is read for it."""
        for each in self._reads.pop(page, ()):
            each.set()

    # --- what is shown ---------------------------------------------------------------------------

    def take_state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new: messages, then a state."""
        at, now = self._now(), time.monotonic()
        messages: list[ServerMessage] = []
        self._tell_head(at, now)
        if (layout := self._states.layout(at)) is not None or self._shown is None:
            messages.append(layout or self._states.present)
        if at == self._shown and now < self._state_due:
            return messages, None
        self._state_due = now + _STILL_PERIOD
        self._shown = at
        self._show_worlds(at)
        if 'transforms' in self._parts and now >= self._tree_due:
            self._tree_due = now + _TREE_PERIOD
            self.server.pages.send_to('transforms', self._transforms(at))
        return messages, self._states.take(at)

    def take_samples(self, wanted: AbstractSet[tuple[Channel, str]]) -> Sequence[Sample]:
        """Return the samples of these channels that are others than the last ones."""
        return self._samples.take(wanted, self._now())

    def latest(self, part: Part) -> ServerMessage | None:
        """Return what a page that begins to show a part is sent at once."""
        match part:
            case 'topics':
                return self._topics()
            case 'log':
                return Log(tuple(self.recorded.log))
            case 'transforms':
                return self._transforms(self._now())
            case _:
                return None

    def mesh(self, name: str) -> Path | bytes | None:
        """Return a file that a description names, or its converted data."""
        for each in self.recorded.robots:
            if each.described is not None and name in each.described.files:
                return each.described.files[name]
        return None

    # --- what pages ask --------------------------------------------------------------------------

    def robots(self) -> Sequence[str]:
        """Return none: nothing takes commands."""
        return ()

    def known(self) -> Sequence[str]:
        """Return none, so that STOP holds nothing."""
        return ()

    def hold(self, robots: AbstractSet[str]) -> Mapping[str, Hold]:  # noqa: ARG002
        """Hold nothing."""
        return {}

    def drive(self, robot: str, linear: float, angular: float, sideways: float = 0.0) -> None:  # noqa: ARG002
        """Refuse. Raises ViewerError."""
        self._refuse()

    def push(self, simulator: str, entity: str, link: str, force: Vector, torque: Vector) -> None:  # noqa: ARG002
        """Refuse. Raises ViewerError."""
        self._refuse()

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:  # noqa: ARG002
        """Refuse. Raises ViewerError."""
        self._refuse()

    def hold_joints(self, robot: str | None) -> None:
        """Do nothing: no joint moves by what a page says."""

    def _refuse(self) -> NoReturn:
        raise ViewerError(_ONLY_A_RECORDING)

    # --- the playhead ----------------------------------------------------------------------------

    def _now(self) -> int:
        """Return what time of the bag is shown, ns; at the end it is paused."""
        at = self._clock.now()
        if at >= self.recorded.end and not self._clock.paused:
            self._clock.pause()
            self._clock.jump(self.recorded.end)
        return min(max(at, self.recorded.begin), self.recorded.end)

    async def _move(self, request: Seek, _: str) -> str:
        begin, end = self.recorded.begin, self.recorded.end
        at = begin + round(request.place * NANOSECONDS)
        self._clock.jump(min(max(at, begin), end))
        self._head_due = 0.0
        return ''

    async def _run(self, request: Playback, _: str) -> str:
        playing, rate = request.playing, request.rate
        if not 0.0 < rate <= _FASTEST:
            raise ViewerError(f'a rate is above 0 and at most {_FASTEST:g}, not {rate:g}')
        if playing and self._clock.paused and self._now() >= self.recorded.end:
            self._clock.jump(self.recorded.begin)
        self._clock.set_rate(rate)
        if playing:
            self._clock.resume()
        else:
            self._clock.pause()
        self._head_due = 0.0
        return 'playing' if playing else 'paused'

    def _tell_head(self, at: int, now: float) -> None:
        head = at, not self._clock.paused, self._clock.rate
        before = self._told_head
        has_turned = before is None or head[1:] != before[1:]
        if head != before and (has_turned or now >= self._head_due):
            self._told_head, self._head_due = head, now + _HEAD_PERIOD
            place = (at - self.recorded.begin) / NANOSECONDS
            self.server.pages.publish('', Playhead(round(place, 6), head[1], head[2]))

    # --- parts -----------------------------------------------------------------------------------

    def _show_worlds(self, at: int) -> None:
        for simulator, each in self.recorded.worlds.items():
            world = each.at(at)
            if world is not None and self._worlds.get(simulator) is not world:
                self._worlds[simulator] = world
                self.server.pages.publish(simulator, world)

    def _topics(self) -> Topics:
        recorded = self.recorded
        seconds = max((recorded.end - recorded.begin) / NANOSECONDS, 1e-9)
        return Topics(
            (),
            tuple(
                TopicInfo(
                    name, (each.type,), _publishers(each), (), len(recorded.times[name]) / seconds
                )
                for name, each in sorted(recorded.topics.items())
            ),
        )

    def _transforms(self, at: int) -> Transforms:
        frames = self.recorded.frames
        return Transforms(
            tuple(
                FrameStatus(
                    each.name,
                    each.parent,
                    (each.parent,),
                    frames.is_static(each.name),
                    None,
                    None,
                    (frames.topic(each.name),),
                )
                for each in sorted(frames.tree(at), key=lambda each: each.name)
            ),
            {},
        )

    async def _series(self, request: ReadSeries, page: str) -> Answer:
        """Answer with a number of all messages. Raises ViewerError: it has none, or takes long."""
        topic, path = request.topic, request.path
        is_over = threading.Event()
        reads = self._reads.setdefault(page, set())
        reads.add(is_over)
        loop = asyncio.get_running_loop()
        try:
            async with asyncio.timeout(_LONGEST_READ):
                series = await loop.run_in_executor(
                    None, read_series, self._path, self.recorded, topic, path, is_over
                )
            return Answer(f'{topic} {path}', series)
        except TimeoutError:
            raise ViewerError(
                f'{topic} takes longer than {_LONGEST_READ:g} s to read; '
                '`ros2 bag trim` makes a shorter bag'
            ) from None
        finally:
            is_over.set()
            reads.discard(is_over)

    async def _whole(self, _: ReadOverview, __: str) -> Answer:
        """Answer with states of the whole bag; they are made once."""
        if self._overview is None:
            loop = asyncio.get_running_loop()
            self._overview = loop.create_task(asyncio.to_thread(overview, self.recorded))
        return Answer('the whole recording', await asyncio.shield(self._overview))


class BagStates:
    """The states of a bag: where everything was at a time."""

    def __init__(self, recorded: Recorded) -> None:
        self._recorded = recorded
        self._version: int | None = None
        self._frame: StateFrame | None = None
        self._number = 0

    @property
    def present(self) -> Layout:
        """The layout of the last state; :meth:`layout` must have been called."""
        assert self._frame is not None, 'laid out first'
        return self._frame.layout

    def layout(self, at: int) -> Layout | None:
        """Return the layout of the state of a time, ns; None: it is the one before."""
        version = self._recorded.frames.version(at)
        if version == self._version:
            return None
        self._version = version
        robots = tuple(each.layout() for each in self._recorded.robots)
        # Ids begin at 1: pages know a layout of 0 from nowhere.
        layout = Layout((version + 1) % LAYOUTS, self._recorded.frames.tree(at), robots)
        self._frame = StateFrame(layout)
        return layout

    def take(self, at: int) -> bytes:
        """Return the state of a time, ns; its layout is the present one."""
        frame = self._frame
        assert frame is not None, 'laid out first'
        recorded = self._recorded
        for index, each in enumerate(frame.layout.frames):
            frame.poses[index] = recorded.frames.pose(each.name, at)
        for robot, floats in zip(recorded.robots, frame.robots, strict=True):
            robot.write(floats, at)
        self._number += 1
        return frame.encode(self._number, recorded.time(at))


def overview(recorded: Recorded) -> OverviewData:
    """Return states of the whole bag, evenly spaced, the first and the last time among them."""
    states = BagStates(recorded)
    states.layout(recorded.end)
    length = recorded.end - recorded.begin
    wanted = int(length / NANOSECONDS / _FEWEST) + 1
    room = _LARGEST // len(states.take(recorded.begin))
    count = max(2, min(_MOST_STATES, wanted, room))
    frames = [
        states.take(recorded.begin + length * index // (count - 1)) for index in range(count)
    ]
    data = b64encode(b''.join(frames)).decode()
    layout = states.present
    return OverviewData(data, count, layout.id, layout.frames, layout.robots)


def _info(robot: RecordedRobot) -> RobotInfo:
    found = robot.found
    return RobotInfo(
        id=found.id,
        name=robot.described.name if robot.described is not None else '',
        present=True,
        command=None,  # nothing takes any
        odometry=found.odometry,
        truth=found.truth,
        wheels=found.wheels,
        joint_states=found.joint_states,
        joint_publisher=None,
        manager=None,
    )


def _publishers(topic: TopicMetadata) -> tuple[Endpoint, ...]:
    """Return who published: a bag has the QoS of each, not its node."""
    profiles = topic.offered_qos_profiles
    words = [f'{each.reliability}, {each.durability}'.replace('_', ' ') for each in profiles]
    return tuple(Endpoint('?', each) for each in words or ['QoS not recorded'])


def _hint(path: Path) -> str:
    return (
        f'{path.name} has no robot: no topic /robot_description was recorded; '
        '`ros2 bag record -a` records all topics'
    )
