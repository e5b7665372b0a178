# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Programs as a user runs them: processes over real DDS, perhaps in a terminal of their own."""

import contextlib
import os
import re
import select
import signal
import subprocess
import sys
import time

from support.preloaded import Popen

PATIENCE = 30.0  # s; a bound that only a broken test reaches
ENVIRONMENT = {
    'PYTHONPATH': os.pathsep.join(filter(None, sys.path)),
    'PYTHONUNBUFFERED': '1',
}
# What Fast DDS 2.14 says although nothing is wrong. Of locks in /dev/shm that others hold, or left
# when they were killed: its ports there are one range for all domains, and it takes the next one.
# And of an address for its statistics, which are off, when a peer leaves while it is sent to.
REMARK = re.compile(
    r'^.*(RTPS_TRANSPORT_SHM|RTPS_OUT.*Error.*Locator .* not found in collection).*\n',
    re.MULTILINE,
)


class Program:
    """
    A running program and what it has printed so far, both streams; killed at the end of a test.

    Without Fast DDS's remarks on others' shared memory.

    :param terminal: Give it a pseudo-terminal of its own instead of pipes.
    """

    def __init__(self, *command, terminal=False, env=None, **options):
        self.output = ''
        self._master = self._slave = None
        streams = {'stdin': subprocess.DEVNULL, 'stdout': subprocess.PIPE}
        if terminal:
            self._master, self._slave = os.openpty()
            streams = {'stdin': self._slave, 'stdout': self._slave}
        self.process = Popen(
            command,
            env=os.environ | ENVIRONMENT | (env or {}),
            stderr=subprocess.STDOUT,
            start_new_session=True,
            **streams,
            **options,
        )
        self._source = self._master if terminal else self.process.stdout.fileno()

    @classmethod
    def of(cls, code, *args, **options):
        """Run the text of a Python program."""
        return cls(sys.executable, '-c', code, *args, **options)

    @classmethod
    def module(cls, name, *args, **options):
        """Run an executable of ``amr_description.nodes``."""
        return cls(sys.executable, '-m', f'amr_description.nodes.{name}', *args, **options)

    @property
    def lines(self):
        """What it has printed, line by line."""
        return self.output.splitlines()

    @property
    def terminal(self):
        """The side of the pseudo-terminal that the program has."""
        return self._slave

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        if self.process.stdout:
            self.process.stdout.close()
        for end in (self._master, self._slave):
            if end is not None:
                with contextlib.suppress(OSError):
                    os.close(end)

    def expect(self, pattern, since=0, *, within=PATIENCE):
        """Wait until the output from ``since`` on matches, ``within`` s; return the match."""
        deadline = time.monotonic() + within
        while not (found := re.compile(pattern).search(self.output, since)):
            if not self._read(deadline):
                raise AssertionError(f'no {pattern!r} in:\n{self.output}')
        return found

    def type(self, keys):
        """Press keys."""
        os.write(self._master, keys.encode())

    def hang_up(self):
        """Close the terminal, as when its window is closed."""
        for end in (self._slave, self._master):
            os.close(end)
        self._slave = self._master = None  # what others open now may have these numbers

    def signal(self, signum):
        """Send a signal to the program alone."""
        self.process.send_signal(signum)

    def end(self, signum=None):
        """Return the exit code, after sending a signal if one is given."""
        if signum is not None:
            self.signal(signum)
        if self._master is None:
            deadline = time.monotonic() + PATIENCE
            while self._read(deadline):
                pass
        code = self.process.wait(PATIENCE)
        while self._read(time.monotonic()):
            pass  # its last words: a terminal keeps them, and so does a pipe, after the deadline
        return code

    def _read(self, deadline):
        """Take some output; return whether there was any before the end or the deadline."""
        ready, _, _ = select.select([self._source], [], [], max(0.0, deadline - time.monotonic()))
        if not ready:
            return False
        try:
            data = os.read(self._source, 65536)
        except OSError:  # EIO: nobody has the terminal any more
            data = b''
        self.output = REMARK.sub('', self.output + data.decode(errors='replace'))
        return bool(data)
