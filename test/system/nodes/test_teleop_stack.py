# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``teleop`` in a terminal: a key drives the simulated robot, Ctrl-C ends all."""

import signal
import sys
import termios

from nav_msgs.msg import Odometry
import pytest
from support.running_programs import PATIENCE, Program
from support.teleop_host import robot_node, XTERM

from amr_description.bringup.guardian import processes

BRINGUP = (sys.executable, '-m', 'amr_description.bringup.main', 'teleop', 'viewer:=false')


@pytest.mark.parametrize('way_out', ['\x03', signal.SIGTERM], ids=['Ctrl-C', 'SIGTERM'])
def test_a_key_drives_and_the_end_of_teleop_is_the_end_of_all(way_out):
    with robot_node() as robot, Program(*BRINGUP, terminal=True, env=XTERM) as program:
        before = termios.tcgetattr(program.terminal)
        run = program.expect(r'found below \S*?([^/\s]+)\r?\n')[1]
        positions = []
        robot.create_subscription(
            Odometry, '/odom', lambda odometry: positions.append(odometry.pose.pose.position.x), 10
        )
        for step in ('create-3', 'spawner-4', 'spawner-5'):
            program.expect(rf'{step}\S*\]: process has finished cleanly')
        program.expect('currently:\tspeed 0.5')
        assert program.output.index('ready in') < program.output.index('Moving around')
        robot.until(lambda: program.type('i') or (positions and positions[-1] > 0.1))
        if way_out == '\x03':
            program.type(way_out)
        else:
            program.signal(way_out)
        assert program.process.wait(PATIENCE) == 0
        assert termios.tcgetattr(program.terminal) == before
        assert [process.pid for process in processes(run) if process.marked] == []
        program.end()
        assert 'Traceback' not in program.output
        assert 'process has died' not in program.output
