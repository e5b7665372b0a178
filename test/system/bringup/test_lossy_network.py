# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot whose operator is at a link that loses every twentieth frame, and more.

What a user then sees stands in docs/two_machines.md.
"""

import re
import signal
import subprocess
import time

import pytest
from support.machines import Machine, missing, refusal
from support.needs import need
from support.running_programs import PATIENCE, Program

SUBNET = {'ROS_DOMAIN_ID': '9', 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'}
UNSET = ('FASTRTPS_DEFAULT_PROFILES_FILE', 'ROS_STATIC_PEERS')
DRIVE = '/diff_drive_controller/cmd_vel'
COMMAND = '{twist: {linear: {x: 0.3}}}'
PUB = (
    'ros2',
    'topic',
    'pub',
    '--rate',
    '20',
    '--print',
    '1000',
    DRIVE,
    'geometry_msgs/msg/TwistStamped',
    COMMAND,
)
ECHO = [
    'ros2',
    'topic',
    'echo',
    '--field',
    'twist.twist.linear.x',
    '/odom',
    'nav_msgs/msg/Odometry',
]
UP_TO_SPEED = r'(?m)^0\.(29|3)'
STEADY = 200
"""Odometry, of 50 Hz: four seconds."""
ASK = ('ros2', 'control', 'list_controllers')
LOSSES = [0.0, 0.05, 0.2]
DELAY = 0.02

pytestmark = pytest.mark.long


@pytest.fixture(scope='module', params=LOSSES, ids=lambda loss: f'{loss:.0%}')
def operator(request, tmp_path_factory):
    """The operator's machine; the robot is up at the other end of the link."""
    reason = missing() or refusal()
    need(reason is None, reason)
    folder = str(tmp_path_factory.mktemp('robot'))
    with (
        Machine() as robot,
        Machine(robot) as operator,
        robot.radio_to(
            operator, '192.168.7.1/24', '192.168.7.2/24', loss=request.param, delay=DELAY
        ),
    ):
        launch = ('ros2', 'launch', 'amr_description', 'simulation', 'viewer:=false')
        own = {'ROS_HOME': folder, 'ROS_LOG_DIR': folder}
        with Program(*words(robot, *launch, **own)) as up:
            up.expect('Ctrl-C stops all', within=2 * PATIENCE)
            yield operator
            assert up.end(signal.SIGINT) == 0
            assert 'Traceback' not in up.output


def words(machine, *command, **variables):
    given = [f'{name}={value}' for name, value in {**SUBNET, **variables}.items()]
    return [*machine.inside(), *(f'--unset={name}' for name in UNSET), *given, *command]


def test_it_is_driven_without_a_stop_and_asked(operator):
    begun = time.monotonic()
    with Program(*words(operator, *ECHO)) as echo, Program(*words(operator, *PUB)):
        echo.expect(r'(?m)^---$', within=2 * PATIENCE)
        seen = time.monotonic() - begun
        echo.expect(UP_TO_SPEED)
        driven = time.monotonic() - begun
        since = len(echo.output)
        echo.expect(rf'(\n---[^-]+){{{STEADY}}}', since)
        _, *speeds = re.findall(r'^(\S+)\n---$', echo.output[since:], re.MULTILINE)
    assert min(map(float, speeds)) > 0.25, 'no pause that its watchdog would have stopped it for'
    begun = time.monotonic()
    text = subprocess.check_output(words(operator, *ASK), text=True, timeout=PATIENCE)
    assert 'diff_drive_controller' in text
    asked = time.monotonic() - begun
    print(f'seen after {seen:.1f} s, at speed after {driven:.1f} s, answered after {asked:.1f} s')
