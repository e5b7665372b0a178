# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
One running process of a stack: its process group, its output line by line, its end.

Processes are started, polled and signalled on the event loop's thread.
"""

import asyncio
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
import contextlib
import fcntl
import os
from pathlib import Path
import signal
import subprocess
import termios

from amr_description.bringup.fork_server import ForkedProcess, ForkServer

LAST_LINES = 20  # kept for failure reports
LONGEST_LINE = 32_768  # bytes; a longer one is shown in pieces rather than held in memory
_READ_SIZE = 65_536  # bytes, the capacity of a pipe


@contextlib.contextmanager
def signal_blocked(number: signal.Signals) -> Iterator[None]:
    """
    Block a signal within the context.

    A process that is started in it inherits the mask: the signal stays pending there until the
    process unblocks it.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [number])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class RunningProcess:
    """
    A process that leads a process group.

    Its subclasses :class:`Child` and :class:`terminal.TerminalChild` start it.
    """

    def __init__(self, process: subprocess.Popen[bytes] | ForkedProcess) -> None:
        """Take over a process that was just started."""
        self._process = process
        self.last_lines: deque[str] = deque(maxlen=LAST_LINES)
        """The last lines of its output, for failure reports."""
        self.sent: signal.Signals | None = None
        """The last signal that :meth:`send` sent."""

    @property
    def pid(self) -> int:
        """Process id, also that of its process group."""
        return self._process.pid

    @property
    def returncode(self) -> int | None:
        """Exit code or minus the signal's number; None until :meth:`poll` found the end."""
        return self._process.returncode

    @property
    def died_of_ctrl_c(self) -> bool:
        """Whether a SIGINT of somebody else ended it: :meth:`send` has sent none."""
        return self.sent is None and self.returncode in (-signal.SIGINT, 128 + signal.SIGINT)

    def poll(self) -> bool:
        """Return whether the process has ended; if so, all its lines were passed on."""
        return self._process.poll() is not None

    def send(self, number: signal.Signals) -> None:
        """Signal its whole process group, as Ctrl-C in a terminal does; it is to end."""
        if self.returncode is None:
            self.sent = number
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.pid, number)
                os.killpg(self.pid, signal.SIGCONT)  # one that is stopped does not hear of it

    def close(self) -> None:
        """Free what it uses, once it has ended."""


class Child(RunningProcess):
    """
    A process in a session of its own, whose output is passed on line by line.

    asyncio's subprocesses report the exit and the last output in no fixed order; here
    :meth:`poll` passes on every line that was written before the process ended.
    """

    def __init__(
        self,
        command: Sequence[str],
        environment: Mapping[str, str],
        inherit: int,
        on_line: Callable[[str], None],
        fork_server: ForkServer | None = None,
        folder: str | Path | None = None,
        splits: bool = False,
    ) -> None:
        """
        Start the process.

        An ignored signal is inherited by children, a handled one is reset to its default: thanks
        to the orchestrator's handlers no child ignores SIGINT, even where a shell started the
        orchestrator with SIGINT ignored.

        Args:
            command: the command line.
            environment: all its environment variables.
            inherit: a file descriptor that the child gets under the same number.
            on_line: called with each line of its stdout and stderr, without line end.
            fork_server: starts it, if it can; it has ``inherit`` already.
            folder: where it is started; None: here.
            splits: whether lines of stderr are to be told apart, as :class:`ErrorLine`; by one
                pipe for both outputs the order of their lines stays.

        Raises:
            OSError: the operating system cannot start it.
        """
        pipes = [os.pipe() for _ in range(2 if splits else 1)]
        readers, writers = [reader for reader, _ in pipes], [writer for _, writer in pipes]
        try:
            process = _forked(fork_server, command, environment, writers[0]) or subprocess.Popen(
                command,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=writers[0],
                stderr=writers[-1],
                pass_fds=(inherit,),
                start_new_session=True,
                cwd=folder,
            )
        except OSError:
            for reader in readers:
                os.close(reader)
            raise
        finally:
            for writer in writers:
                os.close(writer)
        super().__init__(process)
        self._on_line = on_line
        kinds: tuple[type[str], ...] = (str, ErrorLine)
        self._outputs = [
            _Output(reader, kind, self._pass_on)
            for reader, kind in zip(readers, kinds, strict=False)
        ]

    def poll(self) -> bool:
        """As in the base class."""
        if not super().poll():
            return False
        for output in self._outputs:
            output.drain()
        return True

    def close(self) -> None:
        """Stop reading its output, which its own children may still hold open."""
        for output in self._outputs:
            output.close()

    def _pass_on(self, line: str) -> None:
        self.last_lines.append(line)
        self._on_line(line)


class ErrorLine(str):
    """A line of stderr, where it is told apart from those of stdout."""

    __slots__ = ()


class _Output:
    """What comes through one pipe, line by line."""

    def __init__(self, reader: int, kind: type[str], on_line: Callable[[str], None]) -> None:
        os.set_blocking(reader, False)
        self._reader: int | None = reader
        self._kind = kind
        self._on_line = on_line
        self._splitter = LineSplitter()
        asyncio.get_running_loop().add_reader(reader, self._read)

    def close(self) -> None:
        """Stop reading."""
        if self._reader is not None:
            asyncio.get_running_loop().remove_reader(self._reader)
            os.close(self._reader)
            self._reader = None
            self._pass_on(self._splitter.flush())

    def drain(self) -> None:
        """Read what is in the pipe now, but not what other processes still write into it."""
        if self._reader is None:
            return
        waiting = fcntl.ioctl(self._reader, termios.FIONREAD, bytes(4))
        size = int.from_bytes(waiting, 'little')
        while size > 0 and self._reader is not None:
            self._read(min(size, _READ_SIZE))
            size -= _READ_SIZE
        self._pass_on(self._splitter.flush())

    def _read(self, size: int = _READ_SIZE) -> None:
        try:
            data = os.read(self._reader, size)
        except BlockingIOError:
            return
        if data:
            self._pass_on(self._splitter.feed(data))
        else:
            self.close()

    def _pass_on(self, lines: list[str]) -> None:
        for line in lines:
            self._on_line(line if self._kind is str else self._kind(line))


def _forked(
    server: ForkServer | None, command: Sequence[str], environment: Mapping[str, str], output: int
) -> ForkedProcess | None:
    """Return a process that the server has forked, or None: it is to be executed."""
    if server is None or not server.can_start(command, environment):
        return None
    with contextlib.suppress(OSError):  # somebody ended the server
        return server.start(command, environment, output)
    return None


class LineSplitter:
    """Splits a stream of bytes into lines of text, without their line ends."""

    def __init__(self, longest: int = LONGEST_LINE) -> None:
        """Begin; ``longest``: bytes after which a line is cut."""
        self._longest = longest
        self._rest = b''

    def feed(self, data: bytes) -> list[str]:
        """Add bytes; return the lines that are complete now."""
        *lines, self._rest = (self._rest + data).split(b'\n')
        pieces = [piece for line in lines for piece in self._cut(line)]
        *full, self._rest = self._cut(self._rest)
        return [_text(piece) for piece in pieces + full]

    def flush(self) -> list[str]:
        """Return the unfinished last line, if there is one; call it at the end of the stream."""
        rest, self._rest = self._rest, b''
        return [_text(rest)] if rest else []

    def _cut(self, line: bytes) -> list[bytes]:
        pieces = []
        while len(line) > self._longest:
            end = _start_of_character(line, self._longest)
            pieces.append(line[:end])
            line = line[end:]
        return [*pieces, line]


def _start_of_character(line: bytes, index: int) -> int:
    """Return the last index, at most 3 before ``index``, at which a UTF-8 character begins."""
    for back in range(4):
        if line[index - back] & 0xC0 != 0x80:
            return index - back
    return index


def _text(line: bytes) -> str:
    return line.removesuffix(b'\r').decode(errors='replace')
