# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages and requests of any content on all topics and services of a stack: it goes on.

No process of it ends, each request is answered, the clock is never silent for long, and the robot
drives. The seed is printed, and the last calls, each as a line of a shell that repeats it.
"""

from collections import deque
import os
import random
import signal
import time

from fixtures.bringup.running import Bringup
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from support.any_message import any_message, line
from support.ros_processes import PATIENCE

from amr_description.ros.message_types import message_type, service_type
from amr_description.ros.service_calls import wait_until

SEED = 'AMR_FUZZ_SEED'
"""Environment variable: the seed of a run that is to be repeated."""
SHORT, LONG = 4.0, 600.0
"""s"""
MOST_SILENT = 10.0
"""s, for the clock and for an answer, on a machine that is busy; on a quiet one below 0.4 s."""
# What ends a stack, time or a robot, or holds that, as it is asked to.
LEFT_OUT = (
    'set_simulation_state', 'step_simulation', 'reset_simulation', 'load_world', 'delete_entity',
    'set_hardware_component_state', 'reload_controller_libraries', 'get_type_description',
    'emergency_stop', '/clock', '/rosout',
)  # fmt: skip
WHEELS = '/diff_drive_controller/cmd_vel'
PARAMETERS = 'set_parameters', 'set_parameters_atomically', 'set_logger_levels'


class Fuzzer(Node):
    """Sends, and keeps the last calls."""

    def __init__(self, stack, seed):
        super().__init__('fuzzer')
        self.stack, self.seed = stack, int(os.environ.get(SEED, seed))
        self.chance = random.Random(self.seed)
        self.last = deque(maxlen=8)
        self.heard = time.monotonic()
        self.silence = self.longest = 0.0
        self.silent_after = ''
        self.count = 0
        self.senders = {}

    def follow(self, topic):
        """Note how long a topic is silent."""
        name, kind = topic
        qos = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.create_subscription(message_type(kind), name, self.hear, qos)

    def hear(self, _):
        now = time.monotonic()
        if now - self.heard > self.silence:
            self.silence, self.silent_after = now - self.heard, self.last[-1] if self.last else ''
        self.heard = now

    def choices(self):
        """Return what can be sent where, anew each time, as controllers come and go."""
        topics = [
            ('topic', name, kinds[0])
            for name, kinds in self.get_topic_names_and_types()
            if self.count_subscribers(name) and not name.endswith(LEFT_OUT)
        ]
        services = [
            ('service', name, kinds[0])
            for name, kinds in self.get_service_names_and_types()
            if not name.startswith('/fuzzer/')
            and '/_action/' not in name
            and not name.endswith((*LEFT_OUT, *PARAMETERS))
        ]
        return topics + services

    def send(self, kind, name, type_name):
        if kind == 'topic':
            self.publish(name, type_name)
        else:
            self.call(name, type_name)
        self.count += 1

    def publish(self, name, type_name):
        if name not in self.senders:
            # Heard by those who want what was latched, too.
            qos = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
            self.senders[name] = self.create_publisher(message_type(type_name), name, qos)
        message = any_message(message_type(type_name), self.chance)
        self.last.append(line('topic pub -1', name, type_name, message))
        self.senders[name].publish(message)
        rclpy.spin_once(self, timeout_sec=0.0)

    def call(self, name, type_name):
        kind = service_type(type_name)
        if name not in self.senders:
            self.senders[name] = self.create_client(kind, name)
        client = self.senders[name]
        if not client.service_is_ready():
            return
        request = any_message(kind.Request, self.chance)
        self.last.append(line('service call', name, type_name, request))
        begin = time.monotonic()
        future = client.call_async(request)
        answer = wait_until(
            self, lambda: future.done() or not client.service_is_ready() or None, timeout=PATIENCE
        )
        self.longest = max(self.longest, time.monotonic() - begin)
        assert answer, self.story(f'{name} has not answered')

    def drive(self):
        """Drive with the wheels: /odom has to say so."""
        speeds = []
        self.create_subscription(Odometry, '/odom', lambda m: speeds.append(m.twist.twist), 10)
        wheels = self.create_publisher(TwistStamped, WHEELS, 10)
        command = TwistStamped()
        command.twist.linear.x = 0.3

        def drives():
            wheels.publish(command)
            return any(each.linear.x > 0.1 for each in speeds) or None

        assert wait_until(self, drives, timeout=PATIENCE), self.story('it does not drive')

    def look(self):
        """Read what the stack has said: nothing of it may have ended."""
        while self.stack._read(time.monotonic()):
            pass
        for words in ('process has died', 'is started again', 'stopped because'):
            assert words not in self.stack.output, self.story(words)

    def story(self, what):
        said = self.stack.output[-3000:]
        return '\n'.join([f'{what}; {SEED}={self.seed}, after:', *self.last, said])


def fuzz(tmp_path, stack_name, seconds, seed):
    prefix = os.environ['AMENT_PREFIX_PATH']
    with Bringup(tmp_path, stack_name, AMENT_PREFIX_PATH=prefix) as stack:
        stack.expect('The page is at', within=2 * PATIENCE)
        rclpy.init(args=[])
        try:
            fuzzer = Fuzzer(stack, seed)
            has_clock = stack_name in ('simulation', 'navigation')
            fuzzer.follow(
                ('/clock', 'rosgraph_msgs/msg/Clock')
                if has_clock
                else ('/joint_states', 'sensor_msgs/msg/JointState')
            )
            assert wait_until(fuzzer, lambda: len(fuzzer.choices()) > 25 or None, timeout=PATIENCE)
            end = time.monotonic() + seconds
            fuzzer.heard, fuzzer.silence = time.monotonic(), 0.0
            while time.monotonic() < end:
                fuzzer.send(*fuzzer.chance.choice(fuzzer.choices()))
                fuzzer.look()
            print(
                f'{stack_name}: {fuzzer.count} calls, longest answer {fuzzer.longest:.2f} s, '
                f'longest silence {fuzzer.silence:.2f} s, '
                f'after {fuzzer.silent_after[:300]}'
            )
            assert fuzzer.silence < MOST_SILENT, fuzzer.story('the clock was silent')
            assert fuzzer.longest < MOST_SILENT, fuzzer.story('an answer took too long')
            assert fuzzer.count > seconds
            fuzzer.drive()
            fuzzer.destroy_node()
        finally:
            rclpy.try_shutdown()
        assert stack.end(signal.SIGINT) == 0
        assert 'process has died' not in stack.output


def test_any_content_leaves_a_stack_standing(tmp_path):
    fuzz(tmp_path, 'navigation', SHORT, 40)  # which has all programs of the stack simulation


@pytest.mark.long
@pytest.mark.parametrize('stack', ['simulation', 'navigation', 'mock', 'serial'])
def test_any_content_for_ten_minutes(tmp_path, stack):
    fuzz(tmp_path, stack, LONG, random.SystemRandom().randrange(1_000_000))
