# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A simulator as a process, and a client that knows only its services and topics."""

from contextlib import contextmanager

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock
from simulation_interfaces.msg import Result
from support.ros_processes import PATIENCE, ROOT, running

from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import call_with, name_of_type, wait_until

URDF = (ROOT / 'urdf' / 'amr.urdf').read_text(encoding='utf-8')
SIMULATOR = '/mujoco_sim'


class Simulator:
    """A client of the services of a simulator."""

    def __init__(self, node: Node):
        self.node = node
        self.clock = []
        """Every time on /clock, ns."""
        self._clients = {}
        node.create_subscription(Clock, '/clock', self._on_clock, QoSProfile(depth=100))

    def _on_clock(self, message):
        self.clock.append(nanoseconds(message.clock))

    @property
    def time(self):
        """The last time on /clock, ns."""
        return self.clock[-1]

    def ask(self, service_type, **fields):
        """The response, whatever its result."""
        client = self._clients.get(service_type)
        if client is None:
            name = f'{SIMULATOR}/{name_of_type(service_type)}'
            client = self.node.create_client(service_type, name)
            self._clients[service_type] = client
        request = service_type.Request(**fields)
        return call_with(self.node, client, request, timeout=PATIENCE)

    def do(self, service_type, **fields):
        """The response, which must be OK."""
        response = self.ask(service_type, **fields)
        assert response.result.result == Result.RESULT_OK, response.result.error_message
        return response

    def refused(self, service_type, **fields):
        """The code and the reason of a refusal."""
        result = self.ask(service_type, **fields).result
        assert result.result != Result.RESULT_OK
        assert result.error_message
        assert '\n' not in result.error_message
        return result.result, result.error_message

    def wait(self, condition):
        """Spin the node until a condition holds; return what it returned."""
        found = wait_until(self.node, lambda: condition() or None, every=9.0, timeout=PATIENCE)
        assert found, 'it waited in vain'
        return found

    def action(self, action_type):
        """An action client whose server is there; destroy it at the end."""
        client = ActionClient(self.node, action_type, f'{SIMULATOR}/{name_of_type(action_type)}')
        self.wait(client.server_is_ready)
        return client

    def goal(self, client, feedback, goal):
        """The handle of an accepted goal; ``feedback``: a list that gets every feedback."""
        future = client.send_goal_async(
            goal, feedback_callback=lambda message: feedback.append(message.feedback)
        )
        self.wait(future.done)
        assert future.result().accepted
        return future.result()

    def end(self, handle):
        """Wait for the end of a goal; return its status and its result."""
        ended = handle.get_result_async()
        self.wait(ended.done)
        return ended.result().status, ended.result().result.result


@contextmanager
def simulator(*parameters):
    """Run a simulator with parameters ``name:=value``, while inside; yield its client."""
    arguments = [word for each in parameters for word in ('-p', each)]
    arguments = ['--ros-args', *arguments] if arguments else []
    rclpy.init(args=[])
    try:
        with running('mujoco_sim', *arguments, until='waiting for robots'):
            node = Node('simulator_client')
            yield Simulator(node)
            node.destroy_node()
    finally:
        rclpy.try_shutdown()
