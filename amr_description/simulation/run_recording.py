# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Begins and ends recordings of a run, with ROS or without.

Nothing of a recorder is loaded before the first one begins.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
import os
from pathlib import Path
import re
import threading
from typing import Any, Protocol, TYPE_CHECKING

from amr_description.bag.run_description import RunDescription, RunRobot, TOPIC, TYPE
from amr_description.cdr.writer import Writer
from amr_description.errors import BagError, SimulationError
from amr_description.log import Log, Severity
from amr_description.model.controller_files import files_of
from amr_description.model.robot import Robot
from amr_description.parameter_files import file_names
from amr_description.parameters import specs
from amr_description.simulation.manager_arguments import reads_files
from amr_description.simulation.parameters import SimulationParameters
from amr_description.simulation.topics.link_transforms import (
    FIXED,
    LinkTransforms,
    MOVING,
    SpawnedRobot,
    TYPE as TF_TYPE,
)

if TYPE_CHECKING:  # its libraries are for who records
    from amr_description.simulation.run_recorder import RunOptions, RunRecorder

PARAMETER = 'record'
_OF_THE_PROCESS = {
    'paused', 'real_time_factor', 'controllers', 'record', 'record_below', 'record_regex',
    'record_exclude_regex',
}  # fmt: skip
"""Parameters on which no result depends, or that a recorded run has in another way."""
FILTERS = ('record_regex', 'record_exclude_regex')
NO_PARAMETERS: Mapping[str, Any] = {}
_DESCRIPTION = 'robot_description'


class RecordedPublisher(Protocol):
    """A publisher of a loop whose messages can be recorded."""

    reporters: list[Callable[[int], None]]
    """Called at the end of a cycle with its time, ns."""

    @property
    def message_types(self) -> set[str]:
        """Names of the types of what is recorded now."""

    def set_recorder(self, recorder: Any) -> None:
        """Record with a recorder from now on; None: no more. On the control thread."""


class RunRecording:
    """
    The recording of a simulator.

    All but :meth:`update` is called on the ROS thread, or on the only one there is.
    """

    def __init__(
        self,
        publisher: RecordedPublisher,
        *,
        on_loop: Callable[[Callable[[], None]], None],
        time: Callable[[], int],
        has_ticked: Callable[[int], bool],
        is_paced: Callable[[], bool],
        describe: Callable[[], RunDescription],
        robots: Callable[[], Sequence[SpawnedRobot]],
        transforms: LinkTransforms,
        log: Log,
    ) -> None:
        """
        Record nothing yet.

        Args:
            publisher: whose messages are recorded.
            on_loop: has the control thread make a call between two cycles, or makes it, where
                that has not started or has ended.
            time: the present simulated time, ns.
            has_ticked: whether controllers have ticked at a time, ns.
            is_paced: whether cycles wait for the wall clock.
            describe: of what the run consists now.
            robots: those that are there now.
            transforms: of their links.
            log: of the simulator.
        """
        self._publisher, self._log = publisher, log
        self._on_loop, self._time, self._describe = on_loop, time, describe
        self._has_ticked, self._is_paced = has_ticked, is_paced
        self._robots, self._transforms = robots, transforms
        self._recorder: RunRecorder | None = None
        self._described: set[str] = set()
        """The topics of descriptions."""
        self._run = RunDescription()
        """As it was described last."""
        self._describing = threading.Lock()
        self.on_begin: Callable[[], None] = lambda: None
        """Called on the control thread when a recording begins."""

    def begin(self, folder: str) -> None:
        """Begin to record to a folder, which is made. Raises SimulationError."""
        self._attach(self._make(folder, {}))

    def switch(self, folder: str, given: Mapping[str, Any] = NO_PARAMETERS) -> None:
        """End the recording; begin one to a folder, if there is one. Raises SimulationError."""
        if not folder:
            self.end()
            return
        if os.path.lexists(folder):
            raise SimulationError(f'{PARAMETER}: {folder} is there already; another name will do')
        recorder = self._make(folder, given)  # the former one goes on if that is refused
        self.close()
        self._attach(recorder)

    def _make(self, folder: str, given: Mapping[str, Any]) -> 'RunRecorder':
        """``given``: parameters that have not been set yet."""
        try:
            from amr_description.simulation.run_recorder import RunOptions
        except ModuleNotFoundError as error:
            raise SimulationError(
                f'{PARAMETER}: to record needs the Python package {error.name}, which is not '
                f'installed; pip install {error.name}'
            ) from error
        only, without = (pattern(name, self._filter(name, given)) for name in FILTERS)
        try:
            recorder = self._new(Path(folder), RunOptions(only, without))
        except BagError as error:
            raise SimulationError(f'{PARAMETER}: {error}') from error
        for name in self._publisher.message_types:
            recorder.prepare(name)
        return recorder

    def _new(self, folder: Path, options: 'RunOptions') -> 'RunRecorder':
        """Return a recorder. Raises BagError."""
        from amr_description.simulation.run_recorder import RunRecorder

        return RunRecorder(folder, options, **self._of_recorder())

    def _of_recorder(self) -> dict[str, Any]:
        """Return further arguments of a recorder."""
        return {
            'time': self._time(),
            'has_ticked': self._has_ticked,
            'is_paced': self._is_paced,
            'log': self._log,
        }

    def _filter(self, name: str, given: Mapping[str, Any]) -> str:
        """Return the regular expression of a parameter."""
        return str(given.get(name, ''))

    def _attach(self, recorder: 'RunRecorder') -> None:
        """Record with it; files are read here, not on the control thread."""
        self._recorder = recorder
        texts = self._describe_anew()

        def attach() -> None:
            recorder.set_time(self._time())
            self.on_begin()
            self._publisher.set_recorder(recorder)
            recorder.on_failure = self._stop
            recorder.on_commands = self._add_run
            self._latch(recorder, texts)
            self.restart()
            self._publisher.reporters.append(self._report)

        try:
            self._on_loop(attach)
        except Exception as error:  # of a message that cannot be serialized, say
            self.detach()
            self._recorder = None
            with suppress(BagError):
                recorder.close()
            raise SimulationError(f'{PARAMETER}: {type(error).__name__}: {error}') from error
        self._log(Severity.INFO, f'Recording to {recorder.folder}')

    def update(self) -> None:
        """Record of what the run consists, if that has changed; on the ROS thread."""
        if self._recorder is not None:
            self._latch(self._recorder, self._describe_anew())

    def _describe_anew(self) -> dict[str, tuple[str, bytes]]:
        """Return the messages that tell of the robots: topic → type and bytes."""
        run = self._describe()
        with self._describing:
            self._run = run
        messages = {
            f'{robot.namespace.rstrip("/")}/{_DESCRIPTION}': (TYPE, _message(robot.description))
            for robot in reversed(run.robots)
        }
        fixed = self._transforms.set_robots(self._robots())
        return {**messages, FIXED: (TF_TYPE, fixed)}

    def _latch(self, recorder: 'RunRecorder', messages: Mapping[str, tuple[str, bytes]]) -> None:
        for topic in self._described - messages.keys():
            recorder.unlatch(topic)
        for topic, (kind, data) in messages.items():
            recorder.latch(topic, kind, data)
        self._described = set(messages)
        self._add_run()

    def _add_run(self) -> None:
        """Record of what the run consists, as described last; on any thread."""
        recorder = self._recorder
        if recorder is not None:
            with self._describing:  # the latest one is to be the last one
                run = replace(self._run, commands=tuple(sorted(recorder.commands)))
                recorder.latch(TOPIC, TYPE, _message(run.to_text()))

    def restart(self) -> None:
        """Record the transforms of links in the next cycle; on the control thread."""
        self._transforms.restart()

    def _report(self, time: int) -> None:
        """Record the transforms of links, if they are due."""
        if self._recorder is not None and self._has_ticked(time):
            message = self._transforms.moving(time)
            if message is not None:
                self._recorder.add_sample(MOVING, TF_TYPE, message)

    def detach(self) -> None:
        """Record nothing that is published from now on; :meth:`end` completes the bag."""
        if self._recorder is not None:
            self._on_loop(self._stop)

    def _stop(self) -> None:
        """Hand nothing to the recorder any more; on the control thread."""
        self._publisher.set_recorder(None)
        if self._report in self._publisher.reporters:
            self._publisher.reporters.remove(self._report)

    def end(self) -> None:
        """
        End the recording, if there is one; its bag is complete on return.

        Raises SimulationError: it is not, for the disk is full, say.
        """
        self.detach()
        recorder, self._recorder = self._recorder, None
        if recorder is None:
            return
        try:
            count = recorder.close()
        except BagError as error:
            raise SimulationError(
                f'{PARAMETER}: {recorder.folder} is not complete: {error}'
            ) from error
        self._log(Severity.INFO, f'Recorded {count} messages to {recorder.folder}')

    def close(self) -> None:
        """End the recording with the process; what goes wrong is logged."""
        try:
            self.end()
        except SimulationError as error:
            self._log(Severity.ERROR, str(error))


def pattern(name: str, text: str) -> re.Pattern[str] | None:
    """Return the pattern of a filter. Raises SimulationError."""
    try:
        return re.compile(text) if text else None
    except re.error as error:
        raise SimulationError(f"{name}: '{text}': {error}") from error


def describe_run(
    value_of: Callable[[str], Any], world: str, robots: Sequence[SpawnedRobot]
) -> RunDescription:
    """
    Return of what a run consists.

    Args:
        value_of: Returns the value of a parameter of the simulator.
        world: Of the present world: a shipped name, or a path.
        robots: Those that are there.
    """
    changed: dict[str, Any] = {}
    for spec in specs(SimulationParameters):
        value = value_of(spec.name)
        is_default = value == spec.default or value != value  # not a number: not given
        is_told = not is_default or spec.name == 'camera_renderer'
        if is_told and spec.name not in _OF_THE_PROCESS:
            changed[spec.name] = value
    if world != SimulationParameters.world:
        changed['world'] = world
    described = tuple(
        RunRobot(
            each.name,
            each.namespace,
            each.pose.translation,
            each.pose.rotation,
            each.robot.text,
        )
        for each in robots
    )
    first = robots[0].robot if robots else None
    return RunDescription(changed, controllers_texts(value_of('controllers'), first), described)


def controllers_texts(given: str, robot: Robot | None) -> tuple[str, ...]:
    """
    Return the parameter files of the controllers; none: there are none any more.

    Args:
        given: names of files between commas; empty: what the URDF names.
        robot: of the run.
    """
    paths = [Path(each) for each in file_names(given)]
    if not paths and robot is not None and reads_files(robot):
        paths = files_of(robot)
    try:
        return tuple(path.read_text(encoding='utf-8') for path in paths)
    except OSError:  # they were there when the robot was spawned
        return ()


def _message(text: str) -> bytes:
    """Return a std_msgs/msg/String."""
    out = Writer()
    out.text(text)
    return out.bytes()
