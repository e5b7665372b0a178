# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Two hundred random requests from four clients at once, while the robot drives: every request is
answered, and no control step is skipped or repeated.
"""

from contextlib import suppress
from itertools import pairwise
import math
import subprocess
import sys
import time

from geometry_msgs.msg import TwistStamped
from rclpy.node import Node
from support.manager_host import PERIOD, ros_in_this_process, running_host
from support.paths import TESTS
from support.preloaded import Popen

REQUESTER = TESTS / 'fixtures' / 'nodes' / 'requester.py'
CLIENTS = 4
REQUESTS = 50
RIVALS = ('bystander_1', 'bystander_2', 'rival_1', 'rival_2')
DRIVING = ('joint_state_broadcaster', 'diff_drive_controller')


def watch(host):
    """Lists that fill: the instants of the reads, their lateness, what was written."""
    instants, lateness, written = [], [], []
    read, write = host.hardware.read, host.hardware.write
    start = []

    def reading(time_now, period):
        wall = time.monotonic_ns()
        start[:] = start or [wall - time_now]
        instants.append(time_now)
        lateness.append(wall - time_now - start[0])
        read(time_now, period)

    def writing(time_now, period):
        write(time_now, period)
        written.append(dict(host.hardware.written))

    host.hardware.read, host.hardware.write = reading, writing
    return instants, lateness, written


def drive_until_all_ended(publisher, clients):
    """Command 0.5 m/s twenty times a second; a zero stamp counts as now."""
    command = TwistStamped()
    command.twist.linear.x = 0.5
    for client in clients:
        while client.poll() is None:
            publisher.publish(command)
            with suppress(subprocess.TimeoutExpired):
                client.wait(0.05)


def test_requests_of_four_clients_while_driving(tmp_path, request):
    with ros_in_this_process(), running_host(tmp_path) as host:
        node = Node('driver')
        publisher = node.create_publisher(TwistStamped, '/diff_drive_controller/cmd_vel', 1)
        host.activate(*DRIVING)
        instants, lateness, written = watch(host)
        clients = [
            Popen(
                [sys.executable, REQUESTER, str(seed), str(REQUESTS), *RIVALS],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            )
            for seed in range(CLIENTS)
        ]
        drive_until_all_ended(publisher, clients)
        answers = [client.communicate() for client in clients]
        last = written[-1]
        states = host.client.states()
        claims = dict(host.running.manager.resources.claims)
        node.destroy_node()
    assert [out for out, _ in answers] == [f'{REQUESTS} answers\n'] * CLIENTS, answers
    assert {states[name] for name in DRIVING} == {'active'}
    assert set(claims.values()) == {'diff_drive_controller'}
    assert {after - before for before, after in pairwise(instants)} == {PERIOD}
    speeds = {speed for cells in written for speed in cells.values() if not math.isnan(speed)}
    assert speeds == {0.0, 5.0}
    assert set(last.values()) == {5.0}
    late = sorted(lateness)
    late_ms = [instant / 1e6 for instant in late]
    request.node.user_properties += [  # record_property warns of the form of colcon's file
        ('requests', CLIENTS * REQUESTS),
        ('lateness of the tick, ms: median', late_ms[len(late) // 2]),
        ('lateness of the tick, ms: 99 %', late_ms[len(late) * 99 // 100]),
        ('lateness of the tick, ms: worst', late_ms[-1]),
    ]
