# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What listens where, on a machine that is in a network: nothing but at 127.0.0.1, unless asked.

And nodes that know nothing of this package are in the graph all the same.
"""

import re
import signal
import subprocess
import sys

import pytest
from support.machines import missing, one_network, refusal
from support.needs import need
from support.ros_processes import PATIENCE
from support.running_programs import Program

DOMAIN = '9'
OPENING = ('ROS_AUTOMATIC_DISCOVERY_RANGE', 'FASTRTPS_DEFAULT_PROFILES_FILE', 'ROS_STATIC_PEERS')

GENUINE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

def hear(message):
    print('heard', message.data, flush=True)

rclpy.init()
node = Node('genuine')
node.create_subscription(String, 'ours', hear, 10)
publisher = node.create_publisher(String, 'theirs', 10)
node.create_timer(0.1, lambda: publisher.publish(String(data='theirs')))
rclpy.spin(node)
"""
OURS = """
import sys
from amr_description.ros.runtime import run
from rclpy.node import Node
from std_msgs.msg import String

class Ours(Node):
    def __init__(self):
        super().__init__('ours')
        self.publisher = self.create_publisher(String, 'ours', 10)
        self.create_subscription(String, 'theirs', self.hear, 10)
        self.create_timer(0.1, lambda: self.publisher.publish(String(data='ours')))

    def hear(self, message):
        print('heard', message.data)

sys.exit(run(Ours, []))
"""


@pytest.fixture(scope='module')
def machines():
    reason = missing() or refusal()
    need(reason is None, reason)
    with one_network() as pair:
        yield pair


def words(machine, *command, **variables):
    """Return a command line on a machine in whose shell nobody has set anything of discovery."""
    given = [f'{name}={value}' for name, value in {'ROS_DOMAIN_ID': DOMAIN, **variables}.items()]
    unset = [f'--unset={name}' for name in OPENING]
    return [*machine.inside(), *unset, *given, *command]


def on(machine, *command, **variables):
    return Program(*words(machine, *command, **variables))


def addresses(machine):
    """Return the addresses at which something listens."""
    lines = machine.do('ss', '--listening', '--no-header', '--numeric', '--tcp', '--udp')
    return {line.split()[4].rpartition(':')[0] for line in lines.splitlines()}


LONG = pytest.mark.long
STACKS = [
    'display',
    pytest.param('simulation', marks=LONG),  # its programs are among those of the next
    'navigation',
    pytest.param('mock', marks=LONG),  # likewise
    'serial',
    pytest.param('fleet', marks=LONG),  # likewise
]


@pytest.mark.parametrize('stack', STACKS)
def test_a_stack_and_a_verb_listen_at_loopback_alone(machines, stack, tmp_path):
    robot, _ = machines
    own = {'ROS_HOME': str(tmp_path), 'ROS_LOG_DIR': str(tmp_path)}
    with on(robot, 'ros2', 'launch', 'amr_description', stack, **own) as up:
        up.expect('this host only')
        up.expect('The page is at', within=2 * PATIENCE)
        with on(robot, 'ros2', 'topic', 'pub', '/chatter', 'std_msgs/msg/String') as verb:
            verb.expect('publishing #1')
            assert addresses(robot) == {'127.0.0.1'}
        assert up.end(signal.SIGINT) == 0


def test_with_subnet_the_other_machine_is_heard_and_the_first_line_says_so(machines, tmp_path):
    robot, operator = machines
    own = {'ROS_HOME': str(tmp_path), 'ROS_LOG_DIR': str(tmp_path)}
    launch = ('ros2', 'launch', '--discovery', 'subnet', 'amr_description')
    with on(robot, *launch, 'mock', 'viewer:=false', **own) as up:
        up.expect('the whole network: whoever is in it can drive')
        reach = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'}
        once = ('ros2', 'topic', 'echo', '--once', '/joint_states', 'sensor_msgs/msg/JointState')
        with on(operator, *once, **reach) as echo:
            echo.expect('joint_wheel')
        assert '0.0.0.0' in addresses(robot)
        assert up.end(signal.SIGINT) == 0


@pytest.mark.parametrize('discovery_range', ['', 'SUBNET', 'LOCALHOST'])
def test_nodes_that_know_nothing_of_this_package_are_heard_and_hear(machines, discovery_range):
    robot, _ = machines
    others = {'ROS_AUTOMATIC_DISCOVERY_RANGE': discovery_range}
    genuine = on(robot, sys.executable, '-u', '-c', GENUINE, **others)
    with genuine, on(robot, sys.executable, '-u', '-c', OURS) as ours:
        ours.expect('heard theirs')
        genuine.expect('heard ours')
        assert ours.end(signal.SIGINT) == 0


def test_a_host_that_names_this_one_as_a_peer_hears_nothing(machines):
    robot, operator = machines
    with on(robot, sys.executable, '-u', '-c', OURS) as ours:
        reach = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET', 'ROS_STATIC_PEERS': '192.168.7.1'}
        command = words(operator, 'ros2', 'topic', 'list', '--spin-time', '4', **reach)
        text = subprocess.check_output(command, text=True)
        assert not re.search('ours|theirs', text)
        assert '/parameter_events' in text, 'of the command itself'
        assert ours.end(signal.SIGINT) == 0
