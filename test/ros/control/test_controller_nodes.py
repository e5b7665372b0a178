# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Controllers and components as the ROS nodes that they seem to be from outside."""

from lifecycle_msgs.msg import TransitionEvent
import pytest
from rcl_interfaces.msg import LoggerLevel
from rcl_interfaces.srv import SetLoggerLevels
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from support.manager_host import ros_in_this_process, running_host
from support.running_programs import PATIENCE

from amr_description.log import Severity
from amr_description.ros.service_calls import call, wait_until


@pytest.fixture
def host(tmp_path):
    with ros_in_this_process(), running_host(tmp_path) as host:
        yield host


def test_transitions_are_published_as_a_lifecycle_node_does(host):
    assert host.client.load('diff_drive_controller')
    events = []
    topic = '/diff_drive_controller/transition_event'
    host.client_node.create_subscription(TransitionEvent, topic, events.append, 10)
    publishers = host.client_node.get_publishers_info_by_topic
    seen = wait_until(host.client_node, lambda: publishers(topic) or None, timeout=PATIENCE)
    assert seen[0].qos_profile.reliability == ReliabilityPolicy.RELIABLE
    assert seen[0].qos_profile.durability == DurabilityPolicy.VOLATILE
    assert host.client.configure('diff_drive_controller')
    assert host.client.switch(activate=['diff_drive_controller']) is None
    assert host.client.switch(deactivate=['diff_drive_controller']) is None
    wait_until(host.client_node, lambda: len(events) >= 6 or None, timeout=PATIENCE)
    assert [
        (e.start_state.label, e.transition.id, e.transition.label, e.goal_state.label)
        for e in events
    ] == [
        ('unconfigured', 1, 'configure', 'configuring'),
        ('configuring', 10, 'transition_success', 'inactive'),
        ('inactive', 3, 'activate', 'activating'),
        ('activating', 30, 'transition_success', 'active'),
        ('active', 4, 'deactivate', 'deactivating'),
        ('deactivating', 40, 'transition_success', 'inactive'),
    ]


def test_a_component_has_a_node_and_says_what_it_says_under_its_name(host, stderr):
    assert 'hardware' in host.client_node.get_node_names()
    host.hardware.log(Severity.WARN, 'the motors are warm')
    wait_until(
        host.client_node,
        lambda: '[hardware]: the motors are warm' in stderr() or None,
        timeout=PATIENCE,
    )


def test_logger_levels_set_by_service_hold_for_the_log_port(host, stderr):
    assert host.client.load('joint_state_broadcaster')

    def set_level(node, level):
        request = SetLoggerLevels.Request(levels=[LoggerLevel(name=node, level=level)])
        response = call(host.client_node, SetLoggerLevels, f'/{node}/set_logger_levels', request)
        assert response.results[0].successful

    set_level('joint_state_broadcaster', LoggerLevel.LOG_LEVEL_WARN)
    assert host.client.configure('joint_state_broadcaster')  # says INFO under its own name
    set_level('controller_manager', LoggerLevel.LOG_LEVEL_DEBUG)
    host.manager_node.log(Severity.DEBUG, 'the whole story')

    def last_is_there():
        return '[controller_manager]: the whole story' in stderr() or None

    assert wait_until(host.client_node, last_is_there, timeout=PATIENCE)
    assert "Configuring controller: 'joint_state_broadcaster'" in stderr()
    assert "'joints' or 'interfaces' parameter is empty" not in stderr()


def test_a_controller_is_never_its_own_fallback(host):
    host.client.set_parameters(
        'joint_state_broadcaster', {'fallback_controllers': ['joint_state_broadcaster']}
    )
    assert not host.client.load('joint_state_broadcaster')
    assert 'cannot be a fallback controller for itself' in host.client.reasons(
        'joint_state_broadcaster'
    )
    assert 'joint_state_broadcaster' not in host.client_node.get_node_names()


def test_is_async_is_taken_with_a_warning(host, stderr):
    host.client.set_parameters(
        'joint_state_broadcaster', {'node_options_args': ['-p', 'is_async:=true']}
    )
    assert host.client.load('joint_state_broadcaster')

    def warned():
        return [line for line in stderr().splitlines() if 'is_async is true' in line] or None

    (line,) = wait_until(host.client_node, warned, timeout=PATIENCE)
    assert line.startswith('[WARN]')
