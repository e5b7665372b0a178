# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Services that the page's server calls, while the graph changes."""

import asyncio

from controller_manager_msgs.msg import ControllerState
from controller_manager_msgs.srv import (
    ConfigureController,
    ListControllers,
    LoadController,
    SwitchController,
)
import pytest
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters
import rclpy
from rclpy.node import Node
from std_srvs.srv import Empty

from amr_description.errors import ViewerError
from amr_description.viewer.ros.service_clients import (
    activate_controllers,
    command_timeout,
    ServiceClients,
    UnansweredError,
)

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


class Manager:
    """A controller manager, asked as :class:`ServiceClients` asks it."""

    def __init__(self, parameters=(), **states):
        self.states = states
        self.parameters = parameters

    def __contains__(self, name):
        return name.startswith('/robot1/controller_manager/')

    async def call(self, name, request, timeout=0.0):
        if isinstance(request, ListControllers.Request):
            found = [ControllerState(name=n, state=s) for n, s in self.states.items()]
            return ListControllers.Response(controller=found)
        if isinstance(request, ListParameters.Request):
            response = ListParameters.Response()
            response.result.names = [*self.parameters]
            return response
        if isinstance(request, LoadController.Request):
            is_new = request.name not in self.states
            self.states.setdefault(request.name, 'unconfigured')
            return LoadController.Response(ok=is_new)
        if isinstance(request, ConfigureController.Request):
            is_loaded = self.states[request.name] == 'unconfigured'
            self.states[request.name] = 'inactive'
            return ConfigureController.Response(ok=is_loaded)
        names = request.activate_controllers
        is_possible = all(self.states[each] == 'inactive' for each in names)
        self.states.update(dict.fromkeys(names, 'active'))
        return SwitchController.Response(ok=is_possible)


def test_controllers_that_a_robot_brings_along_are_no_hindrance_to_the_others():
    names = ['joint_state_broadcaster', 'imu', 'range', 'wrench', 'diff_drive_controller']
    manager = Manager(imu='active', range='inactive', wrench='unconfigured')
    asyncio.run(activate_controllers(manager, '/robot1/controller_manager', names))
    assert manager.states == dict.fromkeys(names, 'active')


def test_of_a_robot_that_nobody_knows_any_more_all_controllers_of_the_file_are_active():
    parameters = (
        'update_rate',
        'drive.type',
        'drive.node_options_args',
        'joints.type',
        'a.b.type',
    )
    manager = Manager(parameters)
    names = asyncio.run(activate_controllers(manager, '/robot1/controller_manager', None))
    assert names == ['drive', 'joints']
    assert manager.states == {'drive': 'active', 'joints': 'active'}


class LateManager(Manager):
    """What has asked for it first has taken the one before it for it."""

    is_late = True

    async def call(self, name, request, timeout=0.0):
        if self.is_late:
            self.is_late = False
            raise UnansweredError(name)
        return await super().call(name, request, timeout)


def test_the_manager_that_has_come_in_place_of_another_is_asked_again():
    manager = LateManager()
    asyncio.run(activate_controllers(manager, '/robot1/controller_manager', ['drive']))
    assert manager.states == {'drive': 'active'}
