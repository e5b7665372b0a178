# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""/mujoco_sim/received: which commands have arrived, for whoever steps a paused simulation."""

from controller_manager_msgs.srv import SwitchController
from diagnostic_msgs.msg import KeyValue
from geometry_msgs.msg import TwistStamped
import pytest
from support.ros_processes import ROOT

from amr_description.control.ros.loop_publisher import ACKNOWLEDGEMENT_QOS
from amr_description.ros.service_calls import call

pytest_plugins = ['amr_description.testing.fixtures']

CMD_VEL = '/diff_drive_controller/cmd_vel'


class Client:
    """A program that knows the topics only."""

    def __init__(self, sim):
        self.sim = sim
        self.heard = []
        subscription = sim.node.create_subscription(
            KeyValue, '/mujoco_sim/received', self._hear, ACKNOWLEDGEMENT_QOS
        )
        self.publisher = sim.node.create_publisher(TwistStamped, CMD_VEL, 1)
        self.published = 0
        sim.wait(self.publisher.get_subscription_count, 'the controller')
        self.ends = [subscription, self.publisher]

    def _hear(self, message):
        self.heard.append((message.key, int(message.value)))

    def publish(self):
        self.publisher.publish(TwistStamped())
        self.published += 1

    def arrives(self):
        """Publish until that is confirmed, as best effort asks for."""
        since = self.published

        def confirmed():
            self.publish()
            return any(number > since for _, number in self.heard)

        self.sim.wait(confirmed, 'a receipt')


@pytest.fixture
def client(simulation):
    sim = simulation(ROOT / 'urdf' / 'amr.urdf')
    return Client(sim)


def test_each_message_is_confirmed_by_its_number(client):
    client.arrives()
    for _ in range(3):
        client.publish()
        client.sim.wait(lambda: (CMD_VEL, client.published) in client.heard, 'a receipt')
    assert all(0 < number <= client.published for _, number in client.heard)


def switch(client, **names):
    request = SwitchController.Request(strictness=SwitchController.Request.STRICT, **names)
    name = '/controller_manager/switch_controller'
    assert call(client.sim.node, SwitchController, name, request, timeout=20.0).ok


def test_what_nobody_takes_is_not_confirmed(client):
    client.arrives()
    controller = ['diff_drive_controller']
    switch(client, deactivate_controllers=controller)
    before = client.published
    for _ in range(3):
        client.publish()
    # The controller says so when it has heard them.
    client.sim.wait(lambda: "Can't accept new commands" in client.sim.log, 'the refusal')
    switch(client, activate_controllers=controller)
    assert [number for _, number in client.heard if number > before] == []
    client.arrives()
