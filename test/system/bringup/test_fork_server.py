# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Programs that the fork server starts, beside the same ones that are executed."""

import asyncio
import ctypes
import json
import os
from pathlib import Path
import select
import signal
import subprocess
import sys

import pytest
from support.running_programs import PATIENCE

from amr_description.bringup.fork_server import ForkServer
from amr_description.bringup.process import Child, signal_blocked

SUBREAPER = 36  # PR_SET_CHILD_SUBREAPER
REPORT = f"""#!{sys.executable}
import json, os, signal, sys
from pathlib import Path
streams = [(each.fileno(), each.name, each.encoding, each.errors, each.line_buffering,
            each.write_through, each.isatty()) for each in (sys.stdin, sys.stdout, sys.stderr)]
status = Path('/proc/self/status').read_text().splitlines()
print(json.dumps({{
    'argv': sys.argv, 'orig_argv': sys.orig_argv, 'path': sys.path, 'name': __name__,
    'environment': dict(os.environ), 'folder': os.getcwd(), 'streams': streams,
    'leads': [os.getsid(0) == os.getpid(), os.getpgrp() == os.getpid()], 'parent': os.getppid(),
    'files': sorted(map(int, os.listdir('/proc/self/fd')))[:-1],
    'cmdline': Path('/proc/self/cmdline').read_text().rstrip(chr(0)),
    'comm': Path('/proc/self/comm').read_text(),
    # without what the C library adds to those that it handles once threads were made
    'signals': [line[-8:] for line in status if line.startswith('Sig') and '/' not in line],
    'nice': os.nice(0), 'loaded': 'rclpy' in sys.modules,
}}))
"""


@pytest.fixture(scope='module', autouse=True)
def subreaper():
    libc = ctypes.CDLL(None)
    libc.prctl(SUBREAPER, 1, 0, 0, 0)
    yield
    libc.prctl(SUBREAPER, 0, 0, 0, 0)


@pytest.fixture(scope='module')
def environment():
    return os.environ | {'PYTHONUNBUFFERED': '1'}


@pytest.fixture(scope='module')
def inherited():
    reader, writer = os.pipe()
    yield reader
    os.close(reader)
    os.close(writer)


@pytest.fixture
def server(environment, inherited):
    server = ForkServer(['talker'], environment, inherited)
    assert select.select([server], [], [], PATIENCE)[0]
    server.take_ready()
    yield server
    server.end()


def program(folder, text):
    path = folder / 'program'
    path.write_text(text)
    path.chmod(0o755)
    return str(path)


async def outcome(command, environment, inherited, server):
    """All lines of a program, and its exit code."""
    lines = []
    with signal_blocked(signal.SIGINT):
        child = Child(command, environment, inherited, lines.append, server)
    ended = asyncio.Event()
    asyncio.get_running_loop().add_signal_handler(signal.SIGCHLD, ended.set)
    while not child.poll():
        await asyncio.wait_for(ended.wait(), PATIENCE)
        ended.clear()
    child.close()
    return lines, child.returncode


def both(command, environment, inherited, server):
    """The outcomes of a program: executed, and forked."""
    assert server.can_start(command, environment)
    return [asyncio.run(outcome(command, environment, inherited, way)) for way in (None, server)]


def test_a_program_finds_what_an_executed_one_finds(tmp_path, environment, inherited, server):
    command = [program(tmp_path, REPORT), 'one', 'två', '', '--ros-args', '-r', '__node:=x']
    variables = environment | {'OF_THE_NODE': 'ä', 'ROS_DOMAIN_ID': '7'}
    executed, forked = both(command, variables, inherited, server)
    executed, forked = json.loads(executed[0][0]), json.loads(forked[0][0])
    assert not executed.pop('loaded')
    assert forked.pop('loaded')
    assert forked == executed
    assert executed['parent'] == os.getpid()


@pytest.mark.parametrize(
    ('text', 'code'),
    [
        ('pass', 0),
        ('raise SystemExit(3)', 3),
        ('1 / 0', 1),
        ('import os; os.kill(os.getpid(), 9)', -signal.SIGKILL),
    ],
)
def test_a_program_ends_as_an_executed_one_ends(
    tmp_path, environment, inherited, server, text, code
):
    command = [program(tmp_path, f'#!{sys.executable}\n{text}\n')]
    executed, forked = both(command, environment, inherited, server)
    assert executed[1] == forked[1] == code
    assert executed[0][-1:] == forked[0][-1:]


def test_what_a_fork_would_not_be_is_executed(environment, server):
    assert server.can_start(['/a/program'], environment)
    assert not server.can_start(['/a/program', 'x' * 10_000], environment)
    assert not server.can_start(['/a/program'], environment | {'LD_PRELOAD': 'libasan.so'})
    assert server.can_start(['/a/program'], environment | {'RCUTILS_COLORIZED_OUTPUT': '1'})


def test_without_its_server_a_program_is_executed(tmp_path, environment, inherited, server):
    command = [program(tmp_path, REPORT)]
    assert server.can_start(command, environment)
    os.kill(server.pid, signal.SIGKILL)
    [line], code = asyncio.run(outcome(command, environment, inherited, server))
    assert code == 0
    assert not json.loads(line)['loaded']
    assert not server.can_start(command, environment)


def test_a_server_that_does_not_answer_starts_nothing_later(
    tmp_path, environment, inherited, server
):
    command = [program(tmp_path, REPORT)]
    server._socket.settimeout(0.1)
    os.kill(server.pid, signal.SIGSTOP)
    [line], code = asyncio.run(outcome(command, environment, inherited, server))
    assert code == 0
    assert not json.loads(line)['loaded']
    assert not Path(f'/proc/{server.pid}').exists()


def test_a_server_ends_with_its_orchestrator(tmp_path, environment):
    code = (
        'import os, select, sys; from amr_description.bringup.fork_server import ForkServer; '
        'server = ForkServer(["talker"], os.environ, 0); select.select([server], [], []); '
        'print(server.pid, flush=True); os.kill(os.getpid(), 9)'
    )
    done = subprocess.run([sys.executable, '-c', code], stdout=subprocess.PIPE, text=True)
    assert done.returncode == -signal.SIGKILL
    # This process is a subreaper, so the orphan is its child now.
    pid, status = os.waitpid(int(done.stdout), 0)
    assert os.waitstatus_to_exitcode(status) == 0
    assert not Path(f'/proc/{pid}').exists()


def test_what_every_node_needs_is_loaded_before_programs_are_forked():
    code = (
        'import sys, rclpy\n'
        'from rclpy.node import Node\n'
        'from amr_description.forking import load_type_supports\n'
        'load_type_supports()\n'
        'loaded = {*sys.modules}\n'
        'rclpy.init()\n'
        'node = Node("first")\n'
        'print(*{*sys.modules} - loaded)\n'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True)
    assert done.stdout == '\n', done.stderr
