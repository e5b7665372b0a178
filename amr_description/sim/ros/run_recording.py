# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Begins and ends recordings of a run, as the parameter ``record`` of the simulator says."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
import threading
from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.errors import SimulationError
from amr_description.simulation import run_recording
from amr_description.simulation.run_recording import (
    FILTERS,
    PARAMETER,
    pattern,
    RecordedPublisher,
)
from amr_description.text import shorten
from amr_description.trusted_files import distrust_new

if TYPE_CHECKING:  # its libraries are for who records
    from amr_description.sim.ros.run_recorder import RosRunRecorder
    from amr_description.simulation.run_recorder import RunOptions

_PLACE = 'record_below'


class RosRunRecording(run_recording.RunRecording):
    """See the module."""

    def __init__(self, node: Node, publisher: RecordedPublisher, **options: Any) -> None:
        """
        Record nothing yet.

        Args:
            node: Has the parameters, which are declared.
            publisher: Whose messages are recorded.
            **options: As of the base class.
        """
        super().__init__(publisher, **options)
        self._node = node
        self._place = Path(node.get_parameter(_PLACE).value or Path.cwd()).resolve()
        # Who sets the parameter is told whether the recording has begun, or is complete.
        node.add_on_set_parameters_callback(self._on_parameters)

    def _new(self, folder: Path, options: 'RunOptions') -> 'RosRunRecorder':
        from amr_description.sim.ros.run_recorder import RosRunRecorder

        return RosRunRecorder(folder, options, **self._of_recorder())

    def _filter(self, name: str, given: Mapping[str, Any]) -> str:
        return str(given[name] if name in given else self._node.get_parameter(name).value)

    def _on_parameters(self, changed: Sequence[Parameter]) -> SetParametersResult:
        given = {each.name: each.value for each in changed}
        try:
            for name in given.keys() & set(FILTERS):
                pattern(name, self._filter(name, given))
            if PARAMETER in given:
                self._check(str(given[PARAMETER]))
                self.switch(str(given[PARAMETER]), given)
        except SimulationError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _check(self, folder: str) -> None:
        """
        Raise SimulationError: a recording that begins now may not be there.

        Every user of the host may ask, so only below the folder that who started it has chosen.
        """
        if folder and (reason := distrust_new(Path(folder), self._place)):
            raise SimulationError(
                f'{PARAMETER}: {shorten(folder)} {reason}, or another {_PLACE} at the start'
            )


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
