# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``examples/send_goal.py`` where something goes wrong; a person types it in the long tests."""

from contextlib import ExitStack
import signal
import sys

from action_msgs.msg import GoalStatus
from support.navigated_robot import Navigating, NavigationServer
from support.paths import ROOT
from support.running_programs import Program
from support.waiting import until

EXAMPLE = str(ROOT / 'examples/send_goal.py')


def test_ctrl_c_cancels_the_goal():
    with Navigating() as robot, ExitStack() as stack:
        server = NavigationServer(robot, 'navigate_to_pose')
        stack.callback(server.destroy)  # the node's end leaves it, and the node in the graph
        with Program(sys.executable, EXAMPLE, '1.5', '0.5') as program:
            program.expect('3.24 m left')
            goal = server.goals[0]
            program.signal(signal.SIGINT)
            until(lambda: goal.is_cancel_requested)
            server.ends.set()
            assert program.end() == 1
            # Ctrl-C may have come between the distance and the end of its line.
            assert program.output.endswith('cancelled\n')
        until(lambda: goal.status == GoalStatus.STATUS_CANCELED)


def test_what_is_no_place_is_told_in_a_line():
    with Program(sys.executable, EXAMPLE, '1.5') as program:
        assert program.end() == 1
        assert program.output == 'python send_goal.py X Y: two numbers, m in the frame map\n'
