# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Requests of parameters that rclpy raises at: every node of a stack answers, and goes on."""

import os
import signal

from fixtures.bringup.running import Bringup
import pytest
from rcl_interfaces.msg import Parameter, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
import rclpy
from rclpy.node import Node
from support.ros_processes import PATIENCE

from amr_description.ros.service_calls import call

NAMES = ['nope', '', 'a b', 'x' * 10_000]
UNKNOWN = [Parameter(name='use_sim_time', value=ParameterValue(type=kind)) for kind in (77, 255)]


# What all nodes have from one place is asked of those of a small stack each time.
@pytest.mark.parametrize('stack', ['mock', pytest.param('navigation', marks=pytest.mark.long)])
def test_every_node_answers(tmp_path, stack):
    prefix = os.environ['AMENT_PREFIX_PATH']
    with Bringup(tmp_path, stack, AMENT_PREFIX_PATH=prefix) as up:
        up.expect('The page is at', within=2 * PATIENCE)
        rclpy.init(args=[])
        try:
            node = Node('asks')
            for name in sorted(nodes_of(node)):
                ask(node, name)
            node.destroy_node()
        finally:
            rclpy.try_shutdown()
        assert up.end(signal.SIGINT) == 0
        assert 'process has died' not in up.output
        assert 'Traceback' not in up.output


def nodes_of(node):
    """Return the nodes that have parameter services, once those of every stack are known."""
    of_every_stack = {'/controller_manager', '/diff_drive_controller', '/viewer'}

    def known():
        ends = '/set_parameters'
        services = [name for name, _ in node.get_service_names_and_types()]
        found = {each.removesuffix(ends) for each in services if each.endswith(ends)}
        return found - {'/asks'} if of_every_stack <= found else None

    found = None
    while found is None:
        rclpy.spin_once(node, timeout_sec=0.05)
        found = known()
    return found


def ask(node, name):
    def answer(service_type, service, **fields):
        request = service_type.Request(**fields)
        return call(node, service_type, f'{name}/{service}', request, timeout=PATIENCE)

    types = answer(GetParameterTypes, 'get_parameter_types', names=NAMES).types
    assert set(types) <= {0}, name
    answer(GetParameters, 'get_parameters', names=NAMES)
    answer(DescribeParameters, 'describe_parameters', names=NAMES)
    answer(ListParameters, 'list_parameters', prefixes=NAMES, depth=2**64 - 1)
    for result in answer(SetParameters, 'set_parameters', parameters=UNKNOWN).results:
        assert not result.successful, name
        assert 'a value is of type 0 to 9, not ' in result.reason, name
    together = answer(SetParametersAtomically, 'set_parameters_atomically', parameters=UNKNOWN)
    assert not together.result.successful, name
