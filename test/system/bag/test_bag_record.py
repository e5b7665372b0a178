# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 bag record`` as a user runs it, and what is left of it however it ends."""

from pathlib import Path
import random
import re
import signal
import sys
import time

from fixtures.cli.commands import environment, ros2, started
import pytest
from rosbags.highlevel import AnyReader
from support.running_programs import Program
from support.waiting import until

from amr_description.bag.reader import BagReader

# Nobody reads what it prints meanwhile: a line a second does not fill the pipe.
RATE = ('-r', '50', '-p', '50')
CHATTER = ('topic', 'pub', *RATE, '/chatter', 'std_msgs/msg/String', 'data: hello')


@pytest.fixture(scope='module', autouse=True)
def chatter():
    """Somebody who publishes."""
    with started(*CHATTER) as program:
        program.expect('publishing #50')
        yield


def recording(*words):
    return started('bag', 'record', *map(str, words), terminal=True)


def count(folder: Path) -> int:
    with BagReader(folder) as reader:
        return sum(1 for _ in reader.messages())


def test_a_recording_says_what_it_does_and_rosbags_reads_it(tmp_path):
    bag = tmp_path / 'bag'
    with recording('/chatter', '-o', bag, '--custom-data', 'site=A') as program:
        for line in (
            'Press SPACE for pausing/resuming',
            'Listening for topics...',
            'Recording...',
            "Subscribed to topic '/chatter'",
            'All requested topics are subscribed. Stopping discovery...',
            r'\d+ s: [1-9]\d* messages of 1 topics, ',
        ):
            program.expect(re.escape(line) if '\\' not in line else line)
        program.type(' ')
        program.expect('Pausing recording.')
        program.type(' ')
        program.expect('Resuming recording.')
        program.type('\x03')
        assert program.end() == 0
        assert 'Recording stopped' in program.output
    with AnyReader([bag]) as reader:
        texts = {reader.deserialize(data, c.msgtype).data for c, _, data in reader.messages()}
        assert texts == {'hello'}
    found = ros2('bag', 'info', str(bag))
    assert found.returncode == 0
    assert 'Topic: /chatter | Type: std_msgs/msg/String | Count: ' in found.stdout
    again = ros2('bag', 'record', '-a', '-o', str(bag))
    assert (again.returncode, again.stderr) == (
        1, f"[ERROR] [ros2bag]: Output folder '{bag}' already exists.\n"
    )  # fmt: skip


@pytest.mark.parametrize('signum', [signal.SIGTERM, signal.SIGKILL])
def test_what_ends_suddenly_plays(tmp_path, signum):
    bag = tmp_path / 'bag'
    words = ('--node-name', 'scribe', '--disable-keyboard-controls')
    with recording('--all', '-o', bag, *words) as program:
        program.expect(r"\[scribe\]: Subscribed to topic '/chatter'")
        assert 'Press SPACE' not in program.output
        until(lambda: count(bag) > 0, every=0.05)
        code = program.end(signum)
    assert code == (0 if signum == signal.SIGTERM else -signal.SIGKILL)
    assert (bag / 'metadata.yaml').exists() == (signum == signal.SIGTERM)
    assert count(bag) > 0


@pytest.mark.parametrize('rounds', [pytest.param(50, marks=pytest.mark.long)])
def test_whenever_it_is_killed_what_is_left_is_read(tmp_path, rounds):
    for number in range(rounds):
        bag = tmp_path / f'bag{number}'
        with started('bag', 'record', '--all', '-o', str(bag), '-b', '20000') as program:
            program.expect("Subscribed to topic '/chatter'")
            time.sleep(random.uniform(0, 2.5))  # noqa: S311 - any moment
            assert program.end(signal.SIGKILL) == -signal.SIGKILL
        with BagReader(bag) as reader:
            files = reader.file_paths
            assert len([*reader.messages()]) == reader.metadata.message_count
        # A reader puts the messages of a bag in order, but here are those of each file.
        times = []
        for file in files:
            with BagReader(file) as reader:
                times += [message.log_time for message in reader.messages(['/chatter'])]
        assert times == sorted(times)


def test_what_was_latched_before_there_was_a_time_is_recorded(tmp_path):
    bag, kind = tmp_path / 'bag', 'std_msgs/msg/String'
    latched = ('--qos-durability', 'transient_local', '/latched', kind, 'data: hall')
    clock = ('/clock', 'rosgraph_msgs/msg/Clock', 'clock: {sec: 7}')
    once = ('-t', '1', '-w', '0', '--keep-alive', '60')
    with started('topic', 'pub', *once, *latched) as publisher:
        publisher.expect('publishing #1')
        with recording('/latched', '--use-sim-time', '-o', bag) as program:
            program.expect('use_sim_time set, waiting for /clock before starting recording...')
            with started('topic', 'pub', '-r', '20', *clock):
                program.expect('Sim time /clock found, starting recording.')
                program.expect(r'\d+ s: 1 messages of 1 topics, ')
                assert program.end(signal.SIGINT) == 0
    with BagReader(bag) as reader:
        (message,) = reader.messages()
    assert message.log_time == 7 * 10**9


def test_in_the_background_of_a_shell_it_goes_on(tmp_path):
    """Keys are the shell's then; after `fg` they are the recorder's again."""
    words = f'-m amr_description.cli ros2 bag record -a -o {tmp_path / "bag"}'
    bash = ['bash', '--norc', '--noediting', '-i']
    with Program(*bash, terminal=True, env={**environment(), 'PS1': 'prompt> '}) as shell:
        shell.expect('prompt> ')
        shell.type(f'{sys.executable} {words}\n')
        shell.expect("Subscribed to topic '/chatter'")
        shell.type('\x1a')
        place = shell.expect(r'Stopped[^\n]*\nprompt> ').end()
        shell.type('bg\n')
        place = shell.expect(r'&\r?\n(.*\n)*?.*prompt> ', place).end()
        shell.type('echo a key\n')
        # It may log between what a command of the shell prints and the prompt.
        place = shell.expect(r'\na key\r\n(.*\n)*?.*prompt> ', place).end()
        shell.type('jobs\n')
        place = shell.expect(r'(Running|Stopped) .*amr_description', place).end()
        assert 'Running' in shell.output[place - 100 : place]
        shell.type('fg\n')
        place = shell.expect(r'\d+ s: [1-9]\d* messages of', place).end()
        shell.type(' ')
        place = shell.expect('Pausing recording.', place).end()
        shell.type('\x03')
        shell.expect(r'Recording stopped(.*\n)*?.*prompt> ', place)
        shell.type('exit\n')
        shell.end()
    assert count(tmp_path / 'bag') > 0


def test_full_disk_is_one_line_and_what_was_written_plays(tmp_path):
    """A file that must not grow is a disk without room."""
    bag = tmp_path / 'bag'
    words = f'ros2 bag record -a -o {bag} --log-level error'
    script = f'ulimit -f 8; exec "$0" -m amr_description.cli {words}'
    with Program('bash', '-c', script, sys.executable, env=environment()) as program:
        assert program.end() == 1
        assert re.search(r'cannot write .*bag_0.mcap: .*File too large', program.output)
        assert 'Traceback' not in program.output
        assert 'Recording' not in program.output
    assert count(bag) > 0
