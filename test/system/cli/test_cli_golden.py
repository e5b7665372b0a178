# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Recordings of the genuine ``ros2`` (Jazzy, ros2cli 0.32.2), replayed against the same node.

A recording is a line of bash, what it printed on stdout and, below ``--- stderr:``, on stderr,
and its exit code. Where ours is better on purpose, a comment above says what the genuine one does.
A line on stderr may go on after the recorded text, with what was found and what would do.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
import re
import shlex
import subprocess
import sys

from fixtures.cli.commands import piped, ros2, running_node, shell
import pytest
from support.paths import TESTS

GOLDEN = TESTS / 'golden'
FILES = (
    'interface', 'node', 'param', 'param_set', 'pkg', 'service', 'service_call', 'topic_echo',
    'topic_meta', 'topic_pub',
)  # fmt: skip
IN_ORDER = ('param_set',)  # each line finds what those before it left behind
AT_ONCE = 4  # others are replayed so many at a time; mostly they wait for discovery

# What differs from run to run: places, counters, times, identifiers, how often a wait was told.
CHANGING = (
    (re.escape(sys.prefix), 'PREFIX'),
    (r'Hello World: \d+', 'Hello World: N'),
    (r'\b(sec: |nanosec: |sec=|nanosec=)[1-9]\d*', r'\1N'),
    (r'(_timestamp|_sequence_number): \d+', r'\1: N'),
    (r'^\d{10},\d+,', 'N,N,'),
    (r'GID: [0-9a-f.]+', 'GID: N'),
    (r'<string length: <\d+>>', '<string length: <N>>'),
    (r'^waiting for service to become available\.\.\.\n', ''),
    (r'(Waiting for at least 1 matching subscription\(s\)\.\.\.\n)+', ''),
)


@dataclass(frozen=True)
class Recording:
    file: str
    line: str
    stdout: str
    stderr: str
    code: int


def recordings(name):
    text = (GOLDEN / f'{name}.txt').read_text()
    text = re.sub(r'^#.*\n(?=(#.*\n)*\$ )', '', text, flags=re.MULTILINE)
    for block in re.split(r'^\$ ', text, flags=re.MULTILINE)[1:]:
        line, _, rest = block.partition('\n')
        output, code = re.fullmatch(r'(.*)\[exit (\d+)\]\n*', rest, re.DOTALL).groups()
        stdout, _, stderr = output.partition('--- stderr:\n')
        yield Recording(name, line, stdout, stderr, int(code))


ALL = [pytest.param(r, id=f'{name}: {r.line}') for name in FILES for r in recordings(name)]


@pytest.fixture(scope='module')
def replayed(request, tmp_path_factory):
    """
    Return what became of each selected recording.

    Several lines of a file run at a time, but never of two files: who listens must not be
    counted by who looks at the graph.
    """
    folder = tmp_path_factory.mktemp('bin')
    chosen = {i.callspec.params['recording'] for i in request.session.items if is_ours(i)}
    results = {}
    shell('true', folder)
    with running_node('fixture_node.py'):
        for name in FILES:
            replay = [r for r in recordings(name) if r in chosen]
            if replay and name in IN_ORDER:
                replay = list(recordings(name))
            with ThreadPoolExecutor(1 if name in IN_ORDER else AT_ONCE) as pool:
                found = pool.map(lambda recording: run(recording.line, folder), replay)
                results |= dict(zip(replay, found, strict=True))
    return results


def is_ours(item):
    return item.path.name == Path(__file__).name and 'recording' in item.fixturenames


def run(line, folder):
    """By bash where it has more to do than to split words."""
    first, _, rest = line.partition(' | ')
    try:
        if not first.startswith('ros2 ') or set('|&;<>$`*') & set(first):
            return shell(line, folder)
        args = shlex.split(first)[1:]
        return piped(args, rest) if rest else ros2(*args)
    except subprocess.TimeoutExpired as error:
        return error


def steady(text):
    for pattern, replacement in CHANGING:
        text = re.sub(pattern, replacement, text, flags=re.MULTILINE)
    return text


@pytest.mark.parametrize('recording', ALL)
def test_a_command_does_what_the_genuine_one_does(replayed, recording):
    result = replayed[recording]
    assert not isinstance(result, subprocess.TimeoutExpired), (result, result.stderr)
    assert result.returncode == recording.code, result.stderr
    assert steady(result.stdout) == steady(recording.stdout)
    said = steady(result.stderr).splitlines()
    recorded = recording.stderr.splitlines()
    assert len(said) == len(recorded), result.stderr
    for ours, theirs in zip(said, recorded, strict=True):
        assert ours.startswith(theirs)
