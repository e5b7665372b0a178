# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which processes a test means, and one that only waits."""

# ruff: noqa: N802 - names of the original

from collections.abc import Collection, Iterable, Sequence
import sys
from typing import Any, Protocol

from amr_description.launch_api.processes import ExecuteProcess

NO_CMD_ARGS = object()
"""In place of arguments: a process that has none."""
_WAITS = 'import signal\ntry:\n    signal.pause()\nexcept KeyboardInterrupt:\n    pass'


class NoMatchingProcessException(Exception):  # noqa: N818
    """No process is meant; or none that is known so far."""


class KnowsProcesses(Protocol):
    """What has seen processes."""

    def processes(self) -> Collection[ExecuteProcess]:
        """Return them."""
        ...


def KeepAliveProc() -> ExecuteProcess:
    """Return a process that waits until it is interrupted."""
    return ExecuteProcess(cmd=[sys.executable, '-c', _WAITS], name='keep_alive')


def resolveProcesses(
    info_obj: KnowsProcesses,
    *,
    process: ExecuteProcess | str | None = None,
    cmd_args: Any = None,
    strict_proc_matching: bool = True,
) -> list[ExecuteProcess]:
    """
    Return the processes that are meant, at least one.

    Args:
        info_obj: Knows all.
        process: The action, or part of the name of its process, or None: all.
        cmd_args: Arguments that it has, where it is given by name; :data:`NO_CMD_ARGS`: none.
        strict_proc_matching: Whether a name may mean only one.

    Raises:
        NoMatchingProcessException: there is none.
        ValueError: there are several.
    """
    known = list(info_obj.processes())
    if process is None:
        if not known:
            raise NoMatchingProcessException('no process has been seen')
        return known
    if isinstance(process, ExecuteProcess):
        if process not in known:
            raise NoMatchingProcessException(f'nothing was seen of the process {_called(process)}')
        return [process]
    if not isinstance(process, str):
        raise TypeError(f'process={process!r}: it takes an action that starts one, or a name')
    found = [each for each in known if _is_meant(each, process, cmd_args)]
    others = f'; there are {", ".join(sorted(map(_called, known)))}'
    asked = f"'{process}'" + (f' with the arguments {cmd_args}' if cmd_args is not None else '')
    if not found:
        raise NoMatchingProcessException(f'no process is called {asked}{others}')
    if strict_proc_matching and len(found) > 1:
        raise ValueError(f'several processes are called {asked}{others}')
    return found


def _is_meant(action: ExecuteProcess, name: str, arguments: Any) -> bool:
    details = action.process_details or {}
    words: Sequence[str] = details.get('cmd', ())[1:]
    if name not in details.get('name', ''):
        return False
    if arguments is NO_CMD_ARGS:
        return not words
    wanted: Iterable[str] = [arguments] if isinstance(arguments, str) else arguments or ()
    return all(each in words for each in wanted)


def _called(action: ExecuteProcess) -> str:
    details = action.process_details
    return ' '.join([details['name'], *details['cmd'][1:]]) if details else 'that was not started'
