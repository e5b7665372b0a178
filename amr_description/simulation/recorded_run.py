# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a bag that the simulator has recorded has to be run again: robots, controllers, commands.

Only a run from time 0 on can be: what a robot did before the first message is not in the bag. With
a reset the simulator begins a new file, so each file but maybe the first one is such a run.
"""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from hashlib import blake2b
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias, TypeVar

from amr_description.bag import run_description
from amr_description.bag.reader import BagReader
from amr_description.bag.run_description import RunDescription
from amr_description.bag.storage import BagMessage
from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, BagError
from amr_description.messages.commands import plain_message
from amr_description.model.controller_files import declared_controllers, manager_of
from amr_description.model.frames import Transform
from amr_description.model.urdf import parse as parse_urdf
from amr_description.text import quote_all

Decode: TypeAlias = Callable[[str, bytes], Any]
"""What makes a message of the name of its type, and bytes."""
Made = TypeVar('Made')

_CLOCK_PERIOD = 10_000_000
"""ns: the simulator has a cycle at each multiple of it, and at each tick of its managers."""
_ACTIVITY = 'controller_manager_msgs/msg/ControllerManagerActivity'
_OF_THREADS = {
    f'sensor_msgs/msg/{name}'
    for name in ('CameraInfo', 'CompressedImage', 'Image', 'LaserScan', 'PointCloud2', 'Range')
}
"""Types of what sensors measure in a thread, where it takes long."""
_NOT_OF_THE_DRIVE = {_ACTIVITY, 'lifecycle_msgs/msg/TransitionEvent'}
_HINT = (
    "reset the simulation while it records ('ros2 service call /mujoco_sim/reset_simulation "
    'simulation_interfaces/srv/ResetSimulation "{scope: 3}"\', which keeps the robots), and take '
    'the file that begins then'
)


class Instant(NamedTuple):
    """A time at which the run stops, ns, and the commands that act from then on."""

    time: int
    commands: Sequence[tuple[str, Any]]
    """Topic and message."""


@dataclass(frozen=True)
class RecordedRun:
    """A run that a bag has recorded."""

    description: RunDescription
    active: tuple[str, ...]
    """Its controllers that are active; of all robots together."""
    instants: tuple[Instant, ...]
    """The last one is when controllers last ticked."""
    messages: Mapping[str, Sequence[tuple[int, bytes]]]
    """All that tells of the drive: topic → time, ns, and :func:`digest` of each message."""
    delayed: frozenset[str] = frozenset()
    """Topics that have messages later in real time, or not all."""

    @property
    def seconds(self) -> float:
        """How long it lasts."""
        return self.instants[-1].time / NANOSECONDS

    @property
    def commands(self) -> int:
        """How many there are."""
        return sum(len(instant.commands) for instant in self.instants)


def digest(data: bytes) -> bytes:
    """Return what tells a message from others: a bag may have more than fits into memory."""
    return blake2b(data, digest_size=16).digest()


class Difference(NamedTuple):
    """Where a topic of two runs differs first."""

    topic: str
    time: int
    """ns."""
    unlike: int
    """Messages that differ, or are in one run only."""
    total: int


class Delay(NamedTuple):
    """What a recording in real time has later than time that waits has it, or not at all."""

    topic: str
    late: int
    left_out: int


def differences(first: RecordedRun, second: RecordedRun) -> list[Difference]:
    """
    Return the topics whose messages are not the same, byte for byte, at the same times.

    Without those that are only delayed: see :func:`delays`.
    """
    found = []
    for topic in sorted({*first.messages, *second.messages}):
        one, other = first.messages.get(topic, ()), second.messages.get(topic, ())
        if one and topic in first.delayed and _delay(topic, one, other):
            continue
        shorter, longer = sorted((one, other), key=len)
        unlike = [index for index, each in enumerate(shorter) if each != longer[index]]
        unlike += range(len(shorter), len(longer))
        if unlike:
            found.append(Difference(topic, longer[unlike[0]][0], len(unlike), len(longer)))
    return found


def delays(first: RecordedRun, second: RecordedRun) -> list[Delay]:
    """
    Return the topics whose messages are the same, but which the first has later, or not all.

    In real time cameras and lidars measure in a thread, and leave out for which there is no time.
    In the second run time has to have waited for them. Nothing else is delayed.
    """
    found = []
    for topic in sorted(first.delayed & first.messages.keys()):
        delay = _delay(topic, first.messages[topic], second.messages.get(topic, ()))
        if delay is not None and (delay.late or delay.left_out):
            found.append(delay)
    return found


def _delay(
    topic: str, one: Sequence[tuple[int, bytes]], other: Sequence[tuple[int, bytes]]
) -> Delay | None:
    """Return how much later messages are than the same ones in ``other``; None: they differ."""
    late, following = 0, iter(other)
    for time, data in one:
        began = next((begin for begin, same in following if same == data), None)
        if began is None or time < began:
            return None
        late += time > began
    return Delay(topic, late, len(other) - len(one))


def read_run(bag: str | Path, decode: Decode = plain_message) -> RecordedRun:
    """
    Return the run of a bag, a folder or one of its files; of a bag with resets the last one.

    Args:
        bag: Its folder, or one of its files.
        decode: Makes the commands. Raises RuntimeError, ValueError or AmrError.

    Raises:
        BagError: The simulator has not recorded it, or it cannot be run again.
    """
    path = Path(bag)
    with BagReader(path) as reader:
        files = reader.file_paths
    file = files[-1]
    with BagReader(file) as reader:
        types = {name: topic.type for name, topic in reader.topics.items()}
        if run_description.TOPIC not in types:
            raise BagError(
                f'{path} is not recorded by the simulator: {run_description.TOPIC} is not in it; '
                "record by the parameter 'record' of mujoco_sim"
            )
        telling = {name for name, kind in types.items() if kind == _ACTIVITY}
        head = list(reader.messages({run_description.TOPIC, '/clock', *telling}))
        clock = [each.log_time for each in head if each.topic == '/clock']
        description = _description(file, types, clock, head)
        left_out = {topic for topic, kind in types.items() if kind in _NOT_OF_THE_DRIVE}
        left_out.add(run_description.TOPIC)
        told: dict[str, list[tuple[int, bytes]]] = {}
        commands: dict[int, list[tuple[str, Any]]] = {}
        for each in reader.messages():
            if each.topic in description.commands:
                message = _decoded(each, types[each.topic], file, decode)
                commands.setdefault(each.log_time, []).append((each.topic, message))
            if each.topic not in left_out:
                told.setdefault(each.topic, []).append((each.log_time, digest(each.data)))
    return RecordedRun(
        description,
        _active(file, types, head),
        _instants(clock, commands),
        told,
        frozenset(topic for topic, kind in types.items() if kind in _OF_THREADS),
    )


def _description(
    file: Path, types: Mapping[str, str], clock: Sequence[int], messages: Sequence[BagMessage]
) -> RunDescription:
    """Return what a run consists of. Raises BagError: it cannot be run again."""
    if not clock:
        raise BagError(f'{file}: no time has passed in it, or /clock was not recorded')
    if clock[0]:
        raise BagError(
            f'{file} begins at {clock[0] / NANOSECONDS:g} s of simulated time, and what was '
            f'before is not in it; {_HINT}'
        )
    for each in messages:
        is_change = each.topic == run_description.TOPIC or types[each.topic] == _ACTIVITY
        if each.log_time and is_change:
            raise BagError(
                f'{file}: at {each.log_time / NANOSECONDS:g} s robots were spawned or controllers '
                f'switched, which is not repeated; {_HINT}'
            )
    texts = [each for each in messages if each.topic == run_description.TOPIC]
    if not texts:
        raise BagError(f'{file}: no message of {run_description.TOPIC} is in it')
    description = run_description.from_text(_decoded(texts[-1], run_description.TYPE, file).data)
    if not description.robots:
        raise BagError(f'{file}: there is no robot in it')
    return description


def _decoded(message: BagMessage, kind: str, file: Path, decode: Decode = plain_message) -> Any:
    """Return what a message says. Raises BagError: it is not what its type says."""
    try:
        return decode(kind, message.data)
    except (RuntimeError, ValueError, AmrError) as error:
        raise BagError(
            f'{file}: the message of {message.topic} at {message.log_time / NANOSECONDS:g} s '
            f'cannot be read: {error}'
        ) from error


def _active(
    file: Path, types: Mapping[str, str], messages: Sequence[BagMessage]
) -> tuple[str, ...]:
    """Return the names of active controllers."""
    last = {each.topic: each for each in messages if types[each.topic] == _ACTIVITY}
    names: dict[str, None] = {}
    for each in last.values():
        activity = _decoded(each, _ACTIVITY, file)
        for controller in activity.controllers:
            if controller.state.label == 'active':
                names[controller.name] = None
    return tuple(names)


def _instants(
    clock: Sequence[int], commands: Mapping[int, Sequence[tuple[str, Any]]]
) -> tuple[Instant, ...]:
    # Where a step has ended between two cycles there was one more.
    usual = Counter(b - a for a, b in pairwise(clock)).most_common(1)
    period = usual[0][0] if usual and usual[0][0] else _CLOCK_PERIOD
    stops = {time for time in clock if time % period and time % _CLOCK_PERIOD}
    times = sorted({*stops, *commands, clock[-1]})
    return tuple(Instant(time, commands.get(time, ())) for time in times)


def simulation_of(
    kind: Callable[..., Made], run: RecordedRun, folder: Path, **options: Any
) -> Made:
    """
    Return a simulation of the robots of a run, for ``replay`` of it.

    Args:
        kind: Makes one, in this process or over ROS: its class.
        run: From a bag.
        folder: For the parameter files of the controllers, as long as the simulation runs.
        **options: Further arguments of it.

    Raises:
        BagError: Its robots are not of one description, or not each in a namespace of its name.
    """
    robots = run.description.robots
    first = robots[0]
    poses = {each.name: Transform(each.position, each.rotation) for each in robots}
    if len(robots) > 1 or first.namespace == f'/{first.name}':
        unlike = [each.name for each in robots if each.description != first.description]
        unlike += [each.name for each in robots if each.namespace != f'/{each.name}']
        if unlike:
            raise BagError(
                f'robots of several kinds, or namespaces, cannot be run again: {quote_all(unlike)}'
            )
        options['robots'] = poses
    else:
        options |= {'name': first.name, 'pose': poses[first.name]}
    controllers, activate = [], list[str]()
    for number, text in enumerate(run.description.controllers):
        path = folder / f'controllers{number or ""}.yaml'
        path.write_text(text, encoding='utf-8')
        controllers.append(path)
    if controllers:
        model = parse_urdf(first.description)
        namespace, manager = manager_of(model)
        inside = first.namespace if first.namespace != '/' else namespace
        declared = declared_controllers(controllers, inside, manager)
        activate = [each.name for each in declared if each.name in run.active]
    return kind(
        first.description,
        controllers or None,
        activate=activate if controllers else None,
        parameters=dict(run.description.parameters),
        **options,
    )
