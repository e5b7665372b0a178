# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a controller manager tells of itself, as others on the network hear it."""

from contextlib import contextmanager

from controller_manager_msgs.msg import ControllerManagerActivity
from diagnostic_msgs.msg import DiagnosticArray
from pal_statistics_msgs.msg import Statistics, StatisticsNames, StatisticsValues
import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from support.control_fakes import MS, WHEELS
from support.manager_host import ros_in_this_process, running_host

from amr_description.control.ros.node_parameters import NodeParameters
from amr_description.control.ros.status_topics import DiagnosticsTopic
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.log import null_log
from amr_description.ros.service_calls import wait_until

LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PATIENCE = 20.0


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    with ros_in_this_process(), running_host(tmp_path_factory.mktemp('host')) as host:
        yield host


@pytest.fixture(autouse=True)
def no_controllers(host):
    yield
    host.forget()


@contextmanager
def listening(host, message_type, topic, qos=10):
    """A list that fills with what is heard."""
    heard = []
    node = host.client_node
    subscription = node.create_subscription(message_type, topic, heard.append, qos)
    try:
        yield heard
    finally:
        node.destroy_subscription(subscription)


def await_(host, condition):
    found = wait_until(host.client_node, lambda: condition() or None, timeout=PATIENCE)
    assert found
    return found


def latest(host, heard, condition):
    """The first message from now on that is as it should be."""
    return await_(host, lambda: next((each for each in reversed(heard) if condition(each)), None))


def on_control_thread(host, call):
    """Have the control thread make a call; return its result."""
    future = host.loop_thread.submit(call)
    await_(host, future.done)
    return future.result()


# --- activity ------------------------------------------------------------------------------------


def states(message):
    return {
        'controllers': {c.name: (c.state.id, c.state.label) for c in message.controllers},
        'hardware': {c.name: (c.state.id, c.state.label) for c in message.hardware_components},
    }


def test_activity_is_told_to_whoever_comes_late_and_at_every_change(host):
    hardware = {'hardware': (3, 'active')}
    await_(host, lambda: host.loop_thread.loop.time > 100 * MS)  # what is said then has a stamp
    assert host.client.load('joint_state_broadcaster')
    with listening(host, ControllerManagerActivity, '/controller_manager/activity', LATCHED) as h:
        first = latest(host, h, lambda _: True)
        assert states(first) == {
            'controllers': {'joint_state_broadcaster': (1, 'unconfigured')},
            'hardware': hardware,
        }
        # One after the other: who has not been sent a latched message yet gets the next one.
        assert host.client.configure('joint_state_broadcaster')
        latest(host, h, lambda m: [c.state.label for c in m.controllers] == ['inactive'])
        assert host.client.switch(activate=['joint_state_broadcaster']) is None
        latest(host, h, lambda m: [c.state.label for c in m.controllers] == ['active'])
    said = [states(message)['controllers']['joint_state_broadcaster'] for message in h]
    assert said == [(1, 'unconfigured'), (2, 'inactive'), (3, 'active')]
    stamps = [message.header.stamp.sec * 10**9 + message.header.stamp.nanosec for message in h]
    assert stamps == sorted(stamps)
    assert 0 < stamps[0] <= stamps[-1] <= host.loop_thread.loop.time


def test_activity_is_told_while_time_stands_still(host):
    on_control_thread(host, host.loop_thread.loop.pause)
    try:
        with listening(
            host, ControllerManagerActivity, '/controller_manager/activity', LATCHED
        ) as h:
            host.activate('joint_state_broadcaster')
            found = latest(host, h, lambda m: [c.state.label for c in m.controllers] == ['active'])
            time = host.loop_thread.loop.time
            assert found.header.stamp.sec * 10**9 + found.header.stamp.nanosec == time
    finally:
        on_control_thread(host, host.loop_thread.loop.resume)


# --- diagnostics ---------------------------------------------------------------------------------


def test_diagnostics_have_a_status_for_each_task(host):
    host.activate('joint_state_broadcaster')
    with listening(host, DiagnosticArray, '/diagnostics') as heard:
        message = latest(host, heard, lambda m: m.status[0].message != '')
    assert [(status.name, status.hardware_id) for status in message.status] == [
        ('controller_manager: Controllers Activity', 'ros2_control'),
        ('controller_manager: Hardware Components Activity', 'ros2_control'),
        ('controller_manager: Controller Manager Activity', 'ros2_control'),
    ]
    values = [{pair.key: pair.value for pair in status.values} for status in message.status]
    assert values[0]['joint_state_broadcaster.state'] == 'active'
    assert values[0]['joint_state_broadcaster.execution_time'].startswith('Avg: ')
    assert set(values[1]) == {
        'hardware.state',
        'hardware.read_cycle.execution_time',
        'hardware.write_cycle.execution_time',
    }
    assert values[2]['update_rate'] == '100'
    assert values[2]['periodicity.average'] == '100.000000'  # of simulated time, which is exact
    assert message.status[2].level == b'\x00'
    assert message.status[2].message == 'Controller Manager is running'


def test_diagnostics_go_on_while_time_stands_still(host):
    on_control_thread(host, host.loop_thread.loop.pause)
    try:
        with listening(host, DiagnosticArray, '/diagnostics') as heard:
            first = latest(host, heard, lambda _: True)
            later = await_(host, lambda: next((m for m in heard if m is not first), None))
        assert later.header.stamp == first.header.stamp
    finally:
        on_control_thread(host, host.loop_thread.loop.resume)


def test_thresholds_count_from_when_they_are_set(host):
    prefix = 'diagnostics.threshold.hardware_components.execution_time'
    name = f'{prefix}.mean_error.warn'
    # What a busy machine adds is not to count.
    spread = [f'{prefix}.standard_deviation.{level}' for level in ('warn', 'error')]
    node = host.manager_node.node
    usual = node.get_parameters([name, *spread])
    node.set_parameters([Parameter(each, value=1e9) for each in (name, *spread)])
    with listening(host, DiagnosticArray, '/diagnostics') as heard:
        latest(host, heard, lambda m: m.status[1].level == b'\x00')
        node.set_parameters([Parameter(name, value=1e-6)])
        found = latest(host, heard, lambda m: m.status[1].level != b'\x00')
    assert found.status[1].message == (
        '\nHigh execution jitter or mean error : [ hardware hardware ]'
    )
    node.set_parameters(usual)


def test_a_manager_without_a_robot_says_so_by_its_full_name_if_asked_to(host):
    options = {'diagnostic_updater.use_fqn': True, 'diagnostic_updater.period': 0.1}
    node = Node(
        'controller_manager',
        namespace='/robot_1',
        allow_undeclared_parameters=True,
        parameter_overrides=[Parameter(name, value=value) for name, value in options.items()],
    )
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        DiagnosticsTopic(
            node, host.loop_thread, ManagerParameters(NodeParameters(node), [], null_log)
        )
        with listening(host, DiagnosticArray, '/diagnostics') as heard:

            def status():
                executor.spin_once(timeout_sec=0.0)
                found = [s for m in heard for s in m.status if s.name.startswith('/robot_1/')]
                return found[:3]

            found = await_(host, status)
    finally:
        executor.shutdown()
        node.destroy_node()
    name = '/robot_1/controller_manager'
    error, warning = b'\x02', b'\x01'
    assert [(status.name, status.level, status.message) for status in found] == [
        (
            f'{name}: Controllers Activity',
            error,
            'No hardware components are currently active to activate controllers',
        ),
        (
            f'{name}: Hardware Components Activity',
            error,
            'Resource manager is not yet initialized!',
        ),
        (f'{name}: Controller Manager Activity', warning, 'Waiting for robot description....'),
    ]


# --- interfaces and statistics -------------------------------------------------------------------


def test_names_are_latched_and_go_up_by_a_version_when_they_change(host):
    topic = '/controller_manager/introspection_data/names'
    with listening(host, StatisticsNames, topic, LATCHED) as heard:
        first = latest(host, heard, lambda _: True)
        assert sorted(first.names) == sorted(
            f'{kind}_interface.{joint}/{interface}'
            for joint in WHEELS
            for kind, interface in (
                ('state', 'position'),
                ('state', 'velocity'),
                ('command', 'velocity'),
            )
        )
        assert host.client.load('diff_drive_controller')
        assert host.client.configure('diff_drive_controller')
        second = latest(host, heard, lambda m: m.names_version > first.names_version)
    assert second.names_version == first.names_version + 1
    assert second.names == [
        *first.names,
        'command_interface.diff_drive_controller/linear/velocity',
        'command_interface.diff_drive_controller/angular/velocity',
    ]


def test_values_are_in_the_order_of_their_names_and_full_has_both(host):
    host.activate('diff_drive_controller')
    topic = '/controller_manager/introspection_data'
    with (
        listening(host, StatisticsNames, f'{topic}/names', LATCHED) as names,
        listening(host, StatisticsValues, f'{topic}/values') as values,
        listening(host, Statistics, f'{topic}/full') as full,
    ):
        host.hardware.positions[WHEELS[1]].value = 7.0
        named = latest(host, names, lambda m: m.names_version)
        found = latest(host, values, lambda m: 7.0 in m.values)
        complete = latest(host, full, lambda m: m.statistics)
    assert found.names_version == named.names_version
    value_of = dict(zip(named.names, found.values, strict=True))
    assert value_of[f'state_interface.{WHEELS[1]}/position'] == 7.0
    assert value_of[f'state_interface.{WHEELS[0]}/position'] == 0.0
    assert [statistic.name for statistic in complete.statistics] == named.names
    stamps = [m.header.stamp.sec * 10**9 + m.header.stamp.nanosec for m in values]
    assert all(stamp % host.loop_thread.loop.managers[0].period == 0 for stamp in stamps)


def test_statistics_of_controllers_and_components_are_told(host):
    host.activate('joint_state_broadcaster')
    with listening(host, Statistics, '/controller_manager/statistics/full') as heard:
        found = latest(host, heard, lambda m: m.statistics)
    value_of = {each.name: each.value for each in found.statistics}
    subjects = ('hardware.stats/read_cycle', 'hardware.stats/write_cycle')
    subjects += ('joint_state_broadcaster.stats',)
    numbers = 'max', 'min', 'average', 'standard_deviation', 'sample_count', 'current_value'
    assert list(value_of) == [
        f'{subject}/{quantity}/{number}'
        for subject in subjects
        for quantity in ('execution_time', 'periodicity')
        for number in numbers
    ]
    assert value_of['joint_state_broadcaster.stats/periodicity/average'] == 100.0
    assert value_of['hardware.stats/read_cycle/execution_time/min'] > 0.0
    assert value_of['hardware.stats/read_cycle/execution_time/sample_count'] > 0.0


def test_without_listeners_a_tick_does_nothing_for_them(host):
    manager = host.running.manager
    await_(host, lambda: manager.on_tick is None)
    with listening(host, StatisticsValues, '/controller_manager/statistics/values') as heard:
        latest(host, heard, lambda _: True)
        assert manager.on_tick is not None
    await_(host, lambda: manager.on_tick is None)


# --- overruns ------------------------------------------------------------------------------------


def test_overruns_are_warned_of_as_the_parameter_says(host):
    manager, node = host.running.manager, host.manager_node.node
    assert not manager.warns_of_overruns  # this one has simulated time
    for warns in (True, False):
        node.set_parameters([Parameter('overruns.print_warnings', value=warns)])
        await_(host, lambda wanted=warns: manager.warns_of_overruns is wanted)
