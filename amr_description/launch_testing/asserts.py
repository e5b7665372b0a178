# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Assertions about what processes have written, and how they ended."""

# ruff: noqa: N802, N803 - names of the original

from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Protocol

from amr_description.launch_api.events import ProcessEvent, ProcessIO
from amr_description.launch_api.processes import ExecuteProcess
from amr_description.launch_testing.text import (
    Expected,
    Filter,
    is_in_text,
    without_colours,
)
from amr_description.launch_testing.util import NO_CMD_ARGS, resolveProcesses

EXIT_OK = 0
EXIT_SIGINT = 130
EXIT_SIGQUIT = 131
EXIT_SIGKILL = 137
EXIT_SIGSEGV = 139
"""Exit codes as shells give them."""

_STREAMS = ('stdout', 'stderr')


class HasOutput(Protocol):
    """The output of processes."""

    def processes(self) -> Collection[ExecuteProcess]:
        """Return those that have written something."""
        ...

    def __getitem__(self, key: ExecuteProcess) -> Sequence[ProcessIO]:
        """Return what one has written."""
        ...


class HasEnds(Protocol):
    """Processes, and how they ended."""

    def processes(self) -> Collection[ExecuteProcess]:
        """Return those that were started."""
        ...

    def __getitem__(self, key: ExecuteProcess) -> ProcessEvent:
        """Return the last that happened to one."""
        ...


def assertExitCodes(
    proc_info: HasEnds,
    allowable_exit_codes: Sequence[int] = (EXIT_OK,),
    process: ExecuteProcess | str | None = None,
    cmd_args: Any = None,
    *,
    strict_proc_matching: bool = True,
) -> None:
    """Assert that processes have ended with one of some exit codes; by default all, with 0."""
    for each in allowable_exit_codes:
        assert isinstance(each, int), f'the exit code {each!r} is no number'
    found = resolveProcesses(
        proc_info, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    )
    for event in [proc_info[action] for action in found]:
        code = getattr(event, 'returncode', None)
        assert code in allowable_exit_codes, f'{event.process_name} exited with code {code}'


def assertInStream(
    proc_output: HasOutput,
    expected_output: Expected,
    process: ExecuteProcess | str | None,
    cmd_args: Any = None,
    *,
    output_filter: Filter | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
    stream: str = 'stderr',
) -> None:
    """Assert that one of the processes that are meant has written a text to a stream."""
    if stream not in _STREAMS:
        raise ValueError(f"stream='{stream}': it takes {' or '.join(_STREAMS)}")
    found = resolveProcesses(
        proc_output,
        process=process,
        cmd_args=cmd_args,
        strict_proc_matching=strict_proc_matching,
    )
    for each in found:
        text = ''.join(
            event.text.decode(errors='replace')
            for event in proc_output[each]
            if (event.from_stderr if stream == 'stderr' else event.from_stdout)
        )
        if output_filter is not None:
            text = output_filter(text)
        if strip_ansi_escape_sequences:
            text = without_colours(text)
        if is_in_text(expected_output, text):
            return
    names = ', '.join((each.process_details or {'name': '?'})['name'] for each in found)
    raise AssertionError(f'{expected_output!r} not found in {stream} of {names}')


def assertInStdout(
    proc_output: HasOutput,
    expected_output: Expected,
    process: ExecuteProcess | str | None,
    cmd_args: Any = None,
    **options: Any,
) -> None:
    """Assert that a text was written to stdout."""
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stdout', **options)


def assertInStderr(
    proc_output: HasOutput,
    expected_output: Expected,
    process: ExecuteProcess | str | None,
    cmd_args: Any = None,
    **options: Any,
) -> None:
    """Assert that a text was written to stderr, where nodes log."""
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stderr', **options)


assertDefaultStream = assertInStderr  # noqa: N816


class SequentialTextChecker:
    """Texts that come one after the other."""

    def __init__(self, output: Sequence[str]) -> None:
        self._text = ''.join(output)
        self._at = 0

    def assertInText(self, msg: str) -> None:
        """Assert that a text comes behind the last one."""
        found = self._text.find(msg, self._at)
        assert found >= 0, (
            f"'{msg}' not found in sequence after previous match.  "
            f'The output near the last matched line:\n{self.get_nearby_lines()}'
        )
        self._at = found + len(msg)

    assertInStdout = assertInText  # noqa: N815

    def get_nearby_lines(self) -> str:
        """Return the line of the last text, with two lines before it and two behind it."""
        before = self._text[: self._at].split('\n')[-3:]
        behind = self._text[self._at :].split('\n')[:3]
        return '\n'.join([*before[:-1], before[-1] + behind[0], *behind[1:]])


@contextmanager
def assertSequentialStdout(
    proc_output: HasOutput, process: ExecuteProcess | str | None, cmd_args: Any = None
) -> Iterator[SequentialTextChecker]:
    """Give a checker of the order in which one process has written texts."""
    (found,) = resolveProcesses(
        proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=True
    )
    yield SequentialTextChecker([each.text.decode() for each in proc_output[found]])


__all__ = [
    'EXIT_OK',
    'EXIT_SIGINT',
    'EXIT_SIGKILL',
    'EXIT_SIGQUIT',
    'EXIT_SIGSEGV',
    'NO_CMD_ARGS',
    'SequentialTextChecker',
    'assertDefaultStream',
    'assertExitCodes',
    'assertInStderr',
    'assertInStdout',
    'assertInStream',
    'assertSequentialStdout',
]
