# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The order of a real start comes from events: the simulator may be late, and create may fail."""

import os
import re
import signal

from fixtures.bringup.running import Bringup, STACKS
from fixtures.sim.driving import AMR
import pytest


@pytest.fixture
def late(tmp_path):
    """Start the stack ``simulation`` without its simulator, and let that start."""

    def start(**arguments):
        prefixes = {'AMENT_PREFIX_PATH': os.environ['AMENT_PREFIX_PATH']}
        words = [f'{name}:={value}' for name, value in arguments.items()]
        stack = str(STACKS / 'late_simulator.py')
        return Bringup(tmp_path, stack, f'gate:={gate}', *words, **prefixes)

    gate = tmp_path / 'gate'
    os.mkfifo(gate)
    return start, lambda: gate.write_text('\n')  # which waits for the reader


def test_a_stack_comes_up_however_late_its_simulator_is(late):
    start, let_it_go = late
    with start() as bringup:
        bringup.expect(r'\[create-3\] \[WARN\] .* Waiting for service')
        assert 'spawner-4]: process started' not in bringup.output
        let_it_go()
        for step in ('create-3', 'spawner-4', 'spawner-5'):
            bringup.expect(rf'\[{step}\]: process has finished cleanly')
        bringup.expect('ready in')
        told = re.findall(r'\[([a-z]+-\d)\]: process (started|has fin)', bringup.output)
        assert told[-5:] == [
            ('create-3', 'has fin'),
            ('spawner-4', 'started'),
            ('spawner-4', 'has fin'),
            ('spawner-5', 'started'),
            ('spawner-5', 'has fin'),
        ]
        assert bringup.end(signal.SIGINT) == 0
        assert bringup.left() == []


def test_a_create_that_fails_stops_the_stack_and_is_named_with_its_reason(late, tmp_path):
    start, let_it_go = late
    (tmp_path / 'negative.urdf').write_text(AMR.replace('<mass value="', '<mass value="-', 1))
    with start(urdf=tmp_path / 'negative.urdf') as bringup:
        let_it_go()
        assert bringup.end() == 1
        assert 'spawner-4]: process started' not in bringup.output
        assert bringup.output.splitlines()[-1].startswith(
            '[ERROR] [launch]: stopped because create-3 ended with exit code 1 (never started: '
            f'spawner-4, spawner-5): Entity creation failed. {tmp_path}/negative.urdf:'
        )
        assert ': mass: found -' in bringup.output.splitlines()[-1]
        assert bringup.left() == []
