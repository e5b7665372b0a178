# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Begins and ends recordings of a run, as the parameter ``record`` of the simulator says.

Nothing of a recorder is loaded before the first one begins.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
import os
from pathlib import Path
import re
import threading
from typing import TYPE_CHECKING

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
from amr_description.sim.ros.link_transforms import (
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
        self.on_begin: Callable[[], None] = lambda: None
        """Called on the control thread when a recording begins."""
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._apply)

    def begin(self, folder: str) -> None:
        """Begin to record to a folder, which is made. Raises SimulationError."""
        from amr_description.sim.ros.run_recorder import RunOptions, RunRecorder

        only, without = (self._pattern(name) for name in _FILTERS)
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

        def attach() -> None:
            recorder.set_time(self._time())
            self.on_begin()
            self._publisher.set_tape(recorder)
            self._recorder = recorder
            self.update()
            recorder.on_commands = self.update
            self.restart()
            self._publisher.reporters.append(self._report)

        self._on_loop(attach)
        self._log(Severity.INFO, f'Recording to {folder}')

    def update(self) -> None:
        """Record of what the run consists, if that has changed."""
        if self._recorder is None:
            return
        run = self._describe()
        descriptions = {
            f'{robot.namespace.rstrip("/")}/{_DESCRIPTION}': robot.description
            for robot in reversed(run.robots)
        }
        for topic in self._described - descriptions.keys():
            self._recorder.unlatch(topic)
        for topic, text in descriptions.items():
            self._recorder.latch(topic, TYPE, _message(text))
        self._described = set(descriptions)
        fixed = self._transforms.set_robots(self._robots())
        self._recorder.latch(FIXED, TF_TYPE, serialize(fixed))
        run = replace(run, commands=tuple(sorted(self._recorder.commands)))
        self._recorder.latch(TOPIC, TYPE, _message(run.to_text()))

    def restart(self) -> None:
        """Record the transforms of links in the next cycle; on the control thread."""
        self._transforms.restart()

    def _report(self, time: int) -> None:
        """Record the transforms of links, if they are due."""
        if self._recorder is not None and self._has_ticked(time):
            message = self._transforms.moving(time)
            if message is not None:
                self._recorder.add_sample(MOVING, TF_TYPE, serialize(message))

    def end(self) -> None:
        """End the recording, if there is one; its bag is complete on return."""
        recorder, self._recorder = self._recorder, None
        if recorder is None:
            return

        def detach() -> None:
            self._publisher.set_tape(None)
            self._publisher.reporters.remove(self._report)

        self._on_loop(detach)
        try:
            count = recorder.close()
        except BagError as error:
            self._log(Severity.ERROR, f'{_PARAMETER}: {error}')
        else:
            self._log(Severity.INFO, f'Recorded {count} messages to {recorder.folder}')

    def _pattern(self, name: str) -> re.Pattern[str] | None:
        text = self._node.get_parameter(name).value
        try:
            return re.compile(text) if text else None
        except re.error as error:
            raise SimulationError(f"{name}: '{text}': {error}") from error

    def _check(self, changed: Sequence[Parameter]) -> SetParametersResult:
        reason = ''
        for each in changed:
            if each.name == _PARAMETER and each.value and os.path.lexists(each.value):
                reason = f'{_PARAMETER}: {each.value} is there already; another name will do'
            elif each.name in _FILTERS:
                try:
                    re.compile(each.value)
                except re.error as error:
                    reason = f"{each.name}: '{each.value}': {error}"
        return SetParametersResult(successful=not reason, reason=reason)

    def _apply(self, changed: Sequence[Parameter]) -> None:
        folder = next((each.value for each in changed if each.name == _PARAMETER), None)
        if folder is None:
            return
        self.end()
        if folder:
            try:
                self.begin(folder)
            except SimulationError as error:
                self._log(Severity.ERROR, str(error))


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
    Return what has the control thread make a call, and waits for it.

    Args:
        put: queues a call for the control thread.
        is_running: whether that makes calls; else they are made here.
    """

    def make(call: Callable[[], None]) -> None:
        done = threading.Event()

        def make_and_tell() -> None:
            try:
                call()
            finally:
                done.set()

        if is_running():
            put(make_and_tell)
            done.wait(_PATIENCE)  # where it stands, the process has to end all the same
        else:
            call()

    return make


_PATIENCE = 2.0
"""s of the wall clock that the control thread has for a call."""


def _message(text: str) -> bytes:
    return serialize(String(data=text))
