# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Services that the page's server calls, while the graph changes."""

import asyncio

import pytest
import rclpy
from rclpy.node import Node
from std_srvs.srv import Empty

from amr_description.errors import ViewerError
from amr_description.viewer.ros.service_clients import ServiceClients


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('viewer')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def test_a_service_that_goes_while_it_is_waited_for_is_no_bug(node):
    services = ServiceClients(node)
    services.set_services({'/simulator/reset': Empty})

    async def call():
        calling = asyncio.create_task(services.call('/simulator/reset', Empty.Request()))
        await asyncio.sleep(0.0)  # it has begun, and waits for the server
        services.set_services({})
        await calling

    with pytest.raises(ViewerError, match='service /simulator/reset has gone'):
        asyncio.run(call())
