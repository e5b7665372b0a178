# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The actions that start a process: ExecuteProcess, Node; what has become of it."""

from collections.abc import Callable, Iterable, Mapping
import inspect
import os
import threading
from typing import Any

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import Action
from amr_description.launch_api.events import SomeActions
from amr_description.launch_api.locations import refusal
from amr_description.launch_api.substitutions import SomeSubstitutions, text_of
from amr_description.text import did_you_mean, truth

_TIMES = ('sigterm_timeout', 'sigkill_timeout', 'signal_lifecycle')
_HOW_IT_IS_SHOWN = ('output', 'output_format', 'emulate_tty', 'cached_output', 'log_cmd')
_NOT_NAMES = ('self', 'kwargs', 'others')
_OTHERS = ('respawn_max_retries', 'sigkill_timeout')


class ProcessRecord:
    """What has become of a process so far; tests read it on other threads."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self.details: dict[str, Any] | None = None
        """``name``, ``cmd``, ``cwd``, ``env`` and ``pid``; None: it was not started."""
        self.return_code: int | None = None
        """Exit code, or minus the number of the signal that ended it."""
        self.output = {'stdout': '', 'stderr': ''}

    def change(self, change: Callable[['ProcessRecord'], None]) -> None:
        """Write something down, and wake who waits."""
        with self._changed:
            change(self)
            self._changed.notify_all()

    def wait_for(
        self, predicate: Callable[['ProcessRecord'], object], timeout: float | None = None
    ) -> bool:
        """
        Wait until something is true of it; return whether it is.

        Args:
            predicate: Asked at each change.
            timeout: s; None: as long as it takes.
        """
        with self._changed:
            return bool(self._changed.wait_for(lambda: predicate(self), timeout))


class ExecuteProcess(Action):
    """A process; here its output is always shown line by line, and written to a log file."""

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutions],
        shell: bool | SomeSubstitutions = False,
        cwd: SomeSubstitutions | None = None,
        env: Mapping[Any, SomeSubstitutions] | None = None,
        additional_env: Mapping[Any, SomeSubstitutions] | None = None,
        prefix: SomeSubstitutions | None = None,
        on_exit: SomeActions | None = None,
        respawn: bool | SomeSubstitutions = False,
        respawn_delay: float | SomeSubstitutions | None = None,
        respawn_max_retries: int = -1,
        name: SomeSubstitutions | None = None,
        exec_name: SomeSubstitutions | None = None,
        condition: Any = None,
        **others: Any,
    ) -> None:
        super().__init__(condition=condition)
        self.exec_name = name if exec_name is None else exec_name
        self.record = ProcessRecord()
        odd = [each for each in others if each not in (*_TIMES, *_HOW_IT_IS_SHOWN, *_OTHERS)]
        if odd:
            known = inspect.signature(type(self).__init__).parameters
            known_too = inspect.signature(ExecuteProcess.__init__).parameters
            names = [each for each in {**known, **known_too} if each not in _NOT_NAMES]
            raise refusal(
                f'{type(self).__name__}({odd[0]}=…) is not understood here'
                f'{did_you_mean(odd[0], names)}; understood are {", ".join(names)}'
            )
        if isinstance(cmd, str):
            raise refusal(f"cmd='{cmd}': it takes a list, as {cmd.split()}; shell=True as well")
        self.cmd = list(cmd)
        self.shell = shell
        self.cwd = cwd
        self.env = env
        self.additional_env = additional_env or {}
        self.prefix = prefix
        self.on_exit = on_exit
        self.respawn = respawn
        self.respawn_delay = respawn_delay
        self.respawn_max_retries = respawn_max_retries

    @property
    def process_details(self) -> dict[str, Any] | None:
        """As in launch."""
        return self.record.details

    @property
    def return_code(self) -> int | None:
        """As in launch: None until it has ended."""
        return self.record.return_code

    def get_stdout(self) -> str:
        """Return what it has written so far; cached in any case here."""
        return self.record.output['stdout']

    def get_stderr(self) -> str:
        """Return what it has written to stderr so far, where a test runs it."""
        return self.record.output['stderr']

    def label(self, context: LaunchContext) -> str:
        """Return how it is called on the screen, without a number; '': after its program."""
        if self.exec_name is None:
            return ''
        return os.path.basename(text_of(context, self.exec_name))

    def words(self, context: LaunchContext) -> list[str]:
        """Return the words of the command."""
        return [text_of(context, each) for each in self.cmd]

    def respawns(self, context: LaunchContext) -> bool:
        """Return whether it is started again when it ends."""
        return self.truth(context, self.respawn, 'respawn')

    def delay(self, context: LaunchContext) -> float:
        """Return the time until it is started again, s."""
        given = self.respawn_delay
        if given is None or isinstance(given, int | float):
            return float(given or 0.0)
        text = text_of(context, given)
        try:
            return float(text)
        except ValueError:
            raise refusal(f"respawn_delay='{text}': it takes a number", self.where) from None

    def truth(self, context: LaunchContext, given: Any, name: str) -> bool:
        """Return an argument that is true or false. Raises BringupError."""
        if isinstance(given, bool):
            return given
        text = text_of(context, given)
        value = truth(text)
        if value is None:
            raise refusal(f"{name}='{text}': it takes true or false", self.where)
        return value


class ExecuteLocal(ExecuteProcess):
    """As ExecuteProcess, with the words of an Executable."""

    def __init__(self, *, process_description: 'Executable', **kwargs: Any) -> None:
        super().__init__(**{**process_description.options, **kwargs})


class Executable:
    """The words of a process, and its environment."""

    def __init__(self, *, cmd: Iterable[SomeSubstitutions], **options: Any) -> None:
        self.options: dict[str, Any] = {'cmd': cmd, **options}


class Node(ExecuteProcess):
    """An executable of a package."""

    def __init__(
        self,
        *,
        executable: SomeSubstitutions,
        package: SomeSubstitutions | None = None,
        name: SomeSubstitutions | None = None,
        namespace: SomeSubstitutions | None = None,
        parameters: Any = None,
        remappings: Any = None,
        ros_arguments: Iterable[SomeSubstitutions] | None = None,
        arguments: Iterable[SomeSubstitutions] | None = None,
        **kwargs: Any,
    ) -> None:
        if isinstance(arguments, str):
            raise refusal(f"arguments='{arguments}': it takes a list, as {arguments.split()}")
        super().__init__(cmd=(), **kwargs)
        self.executable = executable
        self.package = package
        self.name = name
        self.namespace = namespace
        self.parameters = parameters or ()
        self.remappings = remappings or ()
        self.ros_arguments = list(ros_arguments or ())
        self.arguments = list(arguments or ())
