# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""/mujoco_sim/received: which commands have arrived, for whoever steps a paused simulation."""

from controller_manager_msgs.srv import SwitchController
from diagnostic_msgs.msg import KeyValue
from geometry_msgs.msg import TwistStamped
import pytest
from ros_processes import ROOT

from amr_description.nodes.clients import call
from amr_description.nodes.receipts import QOS

pytest_plugins = ['amr_description.testing.fixtures']

CMD_VEL = '/diff_drive_controller/cmd_vel'


class Client:
    """A program that knows the topics only."""

    def __init__(self, sim):
        self.sim = sim
        self.heard = []
        subscription = sim.node.create_subscription(
            KeyValue, '/mujoco_sim/received', self._hear, QOS
        )
        self.publishers = [sim.node.create_publisher(TwistStamped, CMD_VEL, 1) for _ in range(2)]
        for publisher in self.publishers:
            sim.wait(publisher.get_subscription_count, 'the controller')
        self.ends = [subscription, *self.publishers]

    def _hear(self, message):
        self.heard.append((message.key, int(message.value)))

    def arrives(self, publisher):
        """Publish until that is confirmed, as best effort asks for; return the number of it."""
        before = len(self.heard)

        def confirmed():
            publisher.publish(TwistStamped())
            return len(self.heard) > before

        self.sim.wait(confirmed, 'a receipt')
        return self.heard[-1]


@pytest.fixture
def client(simulation):
    sim = simulation(ROOT / 'urdf' / 'amr.urdf')
    return Client(sim)


def test_each_message_of_each_publisher_is_confirmed_by_its_number(client):
    for publisher in client.publishers:
        topic, first = client.arrives(publisher)
        assert topic == CMD_VEL
        client.heard.clear()
        for more in range(1, 4):
            publisher.publish(TwistStamped())
            client.sim.wait(lambda: client.heard, 'a receipt')
            _, number = client.heard.pop()
            assert number >= first + more


def switch(client, **names):
    request = SwitchController.Request(strictness=SwitchController.Request.STRICT, **names)
    name = '/controller_manager/switch_controller'
    assert call(client.sim.node, SwitchController, name, request, timeout=20.0).ok


def test_what_nobody_takes_is_not_confirmed(client):
    publisher = client.publishers[0]
    client.arrives(publisher)
    controller = ['diff_drive_controller']
    switch(client, deactivate_controllers=controller)
    client.heard.clear()
    for _ in range(3):
        publisher.publish(TwistStamped())
    # The controller says so when it has heard them.
    client.sim.wait(lambda: "Can't accept new commands" in client.sim.log, 'the refusal')
    switch(client, activate_controllers=controller)
    assert client.heard == []
    client.arrives(publisher)
