# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``description_watcher``: show each change of a description as soon as its file is saved.

``ros2 run amr_description description_watcher FILE [NAME:=VALUE …]``. FILE is a URDF or a xacro
file with its arguments. When it, or a file that it includes, is saved, it is read again, and
becomes the parameter ``robot_description`` of robot_state_publisher, which publishes it: the page
and RViz draw the new robot. What cannot be read is one line of log, and the robot stays as it was.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
import sys
from typing import Any, TypeAlias

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.task import Future

from amr_description.ament_index import resolve_uri
from amr_description.errors import AmrError, UsageError
from amr_description.model.origins import files_in
from amr_description.parameters import parameter
from amr_description.ros.arguments import read_description, split_arguments
from amr_description.ros.node_help import DESCRIPTION, print_help
from amr_description.ros.parameters import declare
from amr_description.ros.runtime import run
from amr_description.ros.service_calls import ServiceReadiness

_PERIOD = 0.3
"""s between two looks at the files."""

_Saved: TypeAlias = tuple[int, int, int] | None
"""Of a file: inode, size, and when it was saved, ns; None: it is not there."""


@dataclass(frozen=True)
class DescriptionWatcherSettings:
    """The parameters of description_watcher."""

    publisher: str = parameter(
        'robot_state_publisher', 'The node whose parameter robot_description is set'
    )


class DescriptionWatcher(Node):
    """
    The node; see the module.

    Args:
        description: FILE and its arguments.
        options: keywords of :class:`rclpy.node.Node`.

    Raises:
        AmrError: the description cannot be read at the start.
    """

    def __init__(self, description: Sequence[str], **options: Any) -> None:
        super().__init__('description_watcher', **options)
        if not description:
            raise UsageError('description_watcher FILE [NAME:=VALUE …]: it watches a file')
        settings = declare(self, DescriptionWatcherSettings)
        self._words = description
        self._text = self._read()
        self._saved = self._look()
        self._changing = self._saved
        self._client = self.create_client(SetParameters, f'{settings.publisher}/set_parameters')
        self._is_ready = ServiceReadiness(self, self._client)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(_PERIOD, self._compare, clock=steady)
        self.get_logger().info(f'watching {", ".join(sorted(self._saved))}')

    def _read(self) -> str:
        return read_description(self._words, self.get_logger().warning)

    def _look(self) -> dict[str, _Saved]:
        """Return when each file was saved that the description is of."""
        files = {str(resolve_uri(self._words[0])), *files_in(self._text)}
        return {file: _saved(Path(file)) for file in files}

    def _compare(self) -> None:
        """Read the files again when one has changed, and is not being written any more."""
        self._is_ready()  # it has to be looked for before it is needed
        now = self._look()
        if now != self._changing:
            self._changing = now
        elif now != self._saved:
            self._saved = now
            self._reload()

    def _reload(self) -> None:
        try:
            text = self._read()
        except AmrError as error:
            self.get_logger().error(f'the description stays as it was: {error}')
            return
        if text == self._text:
            return
        self._text = text
        self._saved = self._changing = self._look()  # it may include other files now
        if not self._is_ready():
            self.get_logger().warning(
                f'nobody is told: there is no service {self._client.srv_name}; is '
                'robot_state_publisher running?'
            )
            return
        value = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=text)
        wanted = Parameter(name='robot_description', value=value)
        answer = self._client.call_async(SetParameters.Request(parameters=[wanted]))
        answer.add_done_callback(self._on_answer)

    def _on_answer(self, answer: Future) -> None:
        (result,) = answer.result().results
        if result.successful:
            self.get_logger().info(f'{self._words[0]} was saved: the robot is as it says now')
        else:
            self.get_logger().error(f'the description stays as it was: {result.reason}')


def _saved(file: Path) -> _Saved:
    try:
        status = file.stat()
    except OSError:
        return None
    return status.st_ino, status.st_size, status.st_mtime_ns


def main(args: list[str] | None = None) -> int:
    """Run the node until Ctrl-C; ``args`` as for every executable of this package."""
    purpose = 'Set robot_description of robot_state_publisher whenever its file is saved.'
    if print_help(
        args, 'description_watcher', purpose, DescriptionWatcherSettings, words=DESCRIPTION
    ):
        return 0
    description, ros_args = split_arguments(args)
    return run(lambda: DescriptionWatcher(description), ros_args)


if __name__ == '__main__':
    sys.exit(main())
