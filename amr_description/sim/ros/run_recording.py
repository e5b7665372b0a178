# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Begins and ends recordings of a run, as the parameter ``record`` of the simulator says.

Nothing of a recorder is loaded before the first one begins.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
import os
from pathlib import Path
import re
import threading
from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import String

from amr_description.bag.run_description import RunDescription, TOPIC, TYPE
from amr_description.control.contracts import Log, Severity
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.errors import BagError, SimulationError
from amr_description.model.controller_files import files_of
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.ros.cdr_padding import serialize
from amr_description.simulation.topics.link_transforms import (
    FIXED,
    LinkTransforms,
    MOVING,
    SpawnedRobot,
    TYPE as TF_TYPE,
)

if TYPE_CHECKING:  # its libraries are for who records
    from amr_description.sim.ros.run_recorder import RunRecorder

_PARAMETER = 'record'
_FILTERS = ('record_regex', 'record_exclude_regex')
_DESCRIPTION = 'robot_description'


class RunRecording:
    """The recording of a simulator; all but :meth:`update` is called on the ROS thread."""

    def __init__(
        self,
        node: Node,
        publisher: LoopPublisher,
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
            node: has the parameters, which are declared.
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
        self._node, self._publisher, self._log = node, publisher, log
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
        # Who sets the parameter is told whether the recording has begun, or is complete.
        node.add_on_set_parameters_callback(self._on_parameters)

    def begin(self, folder: str) -> None:
        """Begin to record to a folder, which is made. Raises SimulationError."""
        self._attach(self._make(folder, {}))

    def _make(self, folder: str, given: Mapping[str, Any]) -> 'RunRecorder':
        """``given``: parameters that have not been set yet."""
        from amr_description.sim.ros.run_recorder import RunOptions, RunRecorder

        only, without = (self._pattern(name, given) for name in _FILTERS)
        try:
            recorder = RunRecorder(
                Path(folder),
                RunOptions(only, without),
                time=self._time(),
                has_ticked=self._has_ticked,
                is_paced=self._is_paced,
                log=self._log,
            )
        except BagError as error:
            raise SimulationError(f'{_PARAMETER}: {error}') from error
        for name in self._publisher.message_types:
            recorder.prepare(name)
        return recorder

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
            raise SimulationError(f'{_PARAMETER}: {type(error).__name__}: {error}') from error
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
                f'{_PARAMETER}: {recorder.folder} is not complete: {error}'
            ) from error
        self._log(Severity.INFO, f'Recorded {count} messages to {recorder.folder}')

    def close(self) -> None:
        """End the recording with the process; what goes wrong is logged."""
        try:
            self.end()
        except SimulationError as error:
            self._log(Severity.ERROR, str(error))

    def _pattern(self, name: str, given: Mapping[str, Any]) -> re.Pattern[str] | None:
        text = given[name] if name in given else self._node.get_parameter(name).value
        try:
            return re.compile(text) if text else None
        except re.error as error:
            raise SimulationError(f"{name}: '{text}': {error}") from error

    def _on_parameters(self, changed: Sequence[Parameter]) -> SetParametersResult:
        given = {each.name: each.value for each in changed}
        try:
            for name in given.keys() & set(_FILTERS):
                self._pattern(name, given)
            if _PARAMETER in given:
                self._switch(given[_PARAMETER], given)
        except SimulationError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _switch(self, folder: str, given: Mapping[str, Any]) -> None:
        """End the recording; begin one to a folder, if there is one. Raises SimulationError."""
        if not folder:
            self.end()
            return
        if os.path.lexists(folder):
            raise SimulationError(f'{_PARAMETER}: {folder} is there already; another name will do')
        recorder = self._make(folder, given)  # the former one goes on if that is refused
        self.close()
        self._attach(recorder)


def controllers_text(path: str, robot: Robot | None) -> str:
    """
    Return the parameter file of the controllers; empty: the URDF names several, or none.

    Args:
        path: of the file; empty: what the URDF names.
        robot: of the run.
    """
    paths = [Path(path)] if path else []
    if not path and robot is not None and len(hardware_of(robot)) > len(robot.plugin_hardware):
        paths = files_of(robot)
    try:
        return paths[0].read_text(encoding='utf-8') if len(paths) == 1 else ''
    except OSError:  # it was there when the robot was spawned
        return ''


def on_loop(
    put: Callable[[Callable[[], None]], None], is_running: Callable[[], bool]
) -> Callable[[Callable[[], None]], None]:
    """
    Return what has the control thread make a call, waits for it, and raises its error.

    Args:
        put: queues a call for the control thread.
        is_running: whether that makes calls; else they are made here.
    """

    def make(call: Callable[[], None]) -> None:
        done = threading.Event()

        errors: list[Exception] = []

        def make_and_tell() -> None:
            try:
                call()
            except Exception as error:  # of the caller: the loop must go on
                errors.append(error)
            finally:
                done.set()

        if is_running():
            put(make_and_tell)
            done.wait(_PATIENCE)  # where it stands, the process has to end all the same
            if errors:
                raise errors[0]
        else:
            call()

    return make


_PATIENCE = 2.0
"""s of the wall clock that the control thread has for a call."""


def _message(text: str) -> bytes:
    return serialize(String(data=text))
