# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which processes are meant, what they wrote and how they ended: by events, without processes."""

import threading

import pytest

from amr_description.launch_api.events import ProcessExited, ProcessIO, ProcessStarted
from amr_description.launch_api.processes import ExecuteProcess
from amr_description.launch_testing.asserts import (
    assertExitCodes,
    assertInStderr,
    assertInStdout,
    assertInStream,
    assertSequentialStdout,
)
from amr_description.launch_testing.handlers import ActiveIoHandler, ActiveProcInfoHandler
from amr_description.launch_testing.util import (
    NO_CMD_ARGS,
    NoMatchingProcessException,
    resolveProcesses,
)


def started(name, *arguments):
    action = ExecuteProcess(cmd=['talk', *arguments])
    details = {'name': name, 'cmd': ['talk', *arguments], 'pid': 7}
    action.record.change(lambda record: setattr(record, 'details', details))
    return action


@pytest.fixture
def left():
    return started('talk-1', '--side', 'left')


@pytest.fixture
def right():
    return started('talk-2')


@pytest.fixture
def info(left, right):
    handler = ActiveProcInfoHandler()
    for action in (left, right):
        handler.append(ProcessStarted(action, action.process_details['name']))
    return handler


@pytest.fixture
def output(left, right):
    handler = ActiveIoHandler()
    handler.append(ProcessIO(left, 'talk-1', text=b'hello\n'))
    handler.append(ProcessIO(right, 'talk-2', text=b'hello\n'))
    handler.append(
        ProcessIO(left, 'talk-1', text=b'\x1b[33mworld\n', from_stdout=False, from_stderr=True)
    )
    return handler


def test_processes_are_meant_by_action_name_or_arguments(info, left, right):
    assert resolveProcesses(info) == [left, right]
    assert resolveProcesses(info, process=right) == [right]
    assert resolveProcesses(info, process='talk-2') == [right]
    assert resolveProcesses(info, process='talk', cmd_args='left') == [left]
    assert resolveProcesses(info, process='talk', cmd_args=['--side', 'left']) == [left]
    assert resolveProcesses(info, process='talk', cmd_args=NO_CMD_ARGS) == [right]
    assert resolveProcesses(info, process='talk', strict_proc_matching=False) == [left, right]


def test_what_means_none_or_several_is_refused(info):
    with pytest.raises(ValueError, match=r"several .* 'talk'; there are talk-1 --side left, talk"):
        resolveProcesses(info, process='talk')
    with pytest.raises(NoMatchingProcessException, match=r"called 'listen'.*there are talk-1"):
        resolveProcesses(info, process='listen')
    with pytest.raises(NoMatchingProcessException, match='that was not started'):
        resolveProcesses(info, process=ExecuteProcess(cmd=['a']))
    with pytest.raises(NoMatchingProcessException, match='no process has been seen'):
        resolveProcesses(ActiveProcInfoHandler())
    with pytest.raises(TypeError, match='process=3'):
        resolveProcesses(info, process=3)


def test_texts_are_found_in_the_stream_of_a_process(output, left, right):
    assertInStdout(output, 'hello', right)
    assertInStderr(output, 'world', 'talk-1')
    assertInStdout(output, 'hello', None)
    with pytest.raises(AssertionError, match=r"'world' not found in stdout of talk-1$"):
        assertInStdout(output, 'world', left)
    with pytest.raises(AssertionError, match='not found in stderr'):
        assertInStderr(
            output, 'world', left, strip_ansi_escape_sequences=True, output_filter=str.upper
        )
    with pytest.raises(ValueError, match='it takes stdout or stderr'):
        assertInStream(output, 'world', left, stream='both')
    with assertSequentialStdout(output, left) as sequence:
        sequence.assertInStdout('hello')
        sequence.assertInStdout('world')


def test_exit_codes_are_of_all_or_of_one(info, left, right):
    info.append(ProcessExited(left, 'talk-1', returncode=0))
    assertExitCodes(info, process=left)
    with pytest.raises(AssertionError, match='talk-2 exited with code None'):
        assertExitCodes(info)
    info.append(ProcessExited(right, 'talk-2', returncode=-2))
    with pytest.raises(AssertionError, match='talk-2 exited with code -2'):
        assertExitCodes(info)
    assertExitCodes(info, allowable_exit_codes=[0, -2])
    with pytest.raises(AssertionError, match=r"'0' is no number"):
        assertExitCodes(info, allowable_exit_codes=['0'])


def test_a_wait_ends_with_what_it_waits_for(info, output, left, right):
    late = ProcessExited(right, 'talk-2', returncode=0)
    line = ProcessIO(right, 'talk-2', text=b'late\n')
    begun = threading.Event()

    def come():
        begun.wait()
        output.append(line)
        info.append(late)

    thread = threading.Thread(target=come)
    thread.start()
    begun.set()
    output.assertWaitFor('late', process=right, stream='stdout', timeout=60)
    info.assertWaitForShutdown(process='talk-2', timeout=60)
    thread.join()
    info.assertWaitForStartup(process=left)
    assert info[right] is late
    assert info['talk-2'] is late
    assert output[right][-1] is line
    assert output['talk-2'][-1] is line


def test_a_wait_in_vain_says_for_what(info, output, left):
    with pytest.raises(AssertionError, match="'never' was not written in time"):
        output.assertWaitFor('never', process=left, timeout=0.01)
    with pytest.raises(NoMatchingProcessException):
        output.waitFor('never', process='listen', timeout=0.01)
    with pytest.raises(AssertionError, match=r"'talk-1' did not end in 0\.01 s"):
        info.assertWaitForShutdown(process=left, timeout=0.01)
    with pytest.raises(AssertionError, match="'listen' did not start"):
        info.assertWaitForStartup(process='listen', timeout=0.01)
