# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Services that the page's server calls, while the graph changes."""

import asyncio

import pytest
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters
import rclpy
from rclpy.node import Node
from std_srvs.srv import Empty

from amr_description.errors import ViewerError
from amr_description.viewer.ros.service_clients import command_timeout, ServiceClients

ASKED = ['cmd_vel_timeout', 'reference_timeout']


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


@pytest.mark.parametrize(
    ('values', 'timeout'),
    [
        ([ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=0.25)], 0.25),
        ([ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=500)], 0.5),  # ms
        ([ParameterValue(), ParameterValue(type=ParameterType.PARAMETER_DOUBLE)], 0.0),
        ([ParameterValue(), ParameterValue()], None),
    ],
)
def test_when_commands_expire_is_what_their_controller_says(values, timeout):
    class Services:
        async def call(self, name, request):
            assert (name, request.names) == ('/c/get_parameters', ASKED)
            return GetParameters.Response(values=values)

    assert asyncio.run(command_timeout(Services(), '/c/get_parameters')) == timeout
