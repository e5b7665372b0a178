# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The controller manager as others on the network see it: services, topics, parameters, time."""

import re
import sys
import threading

from controller_manager_msgs import srv
import pytest
from rcl_interfaces.srv import DescribeParameters
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from support.control_fakes import WHEELS
from support.manager_host import Host, PERIOD, ros_in_this_process, running_host, YAML
from support.paths import TESTS
from support.running_programs import PATIENCE

from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import CallQueue, LoopThread
from amr_description.errors import ParameterError
from amr_description.messages.encoders import filling
from amr_description.ros.service_calls import call, wait_until

FIXTURES = TESTS / 'fixtures' / 'nodes'


@pytest.fixture
def ros():
    with ros_in_this_process():
        yield


MISSPELT = """\
controller_manager:
  ros__parameters:
    drive: {type: diff_drive_controller/DiffDriveController}
    turner: {type: diff_drive_controller/DiffDriveController}
    driver: {type: diff_drive_controller/DiffDriveControler}
    untyped: {tpye: diff_drive_controller/DiffDriveController}
drive:
  ros__parameters:
    left_wheel_names: [a]
    wheel_seperation: 0.3
    right_wheel_names: [b]
    wheel_radius: 0.1
turnner:
  ros__parameters:
    {left_wheel_names: [a], right_wheel_names: [b], wheel_separation: 0.3, wheel_radius: 0.1}
"""


@pytest.fixture
def host(ros, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(FIXTURES))
    monkeypatch.delitem(sys.modules, 'third_party', raising=False)
    with running_host(tmp_path) as host:
        yield host
    # Who has all libraries reloaded later would not find it any more.
    sys.modules.pop('third_party', None)


def test_a_controller_goes_through_its_states_by_services(host):
    client = host.client
    assert client.states() == {}
    assert client.load('joint_state_broadcaster')
    assert client.states() == {'joint_state_broadcaster': 'unconfigured'}
    assert client.configure('joint_state_broadcaster')
    assert client.states() == {'joint_state_broadcaster': 'inactive'}
    assert client.switch(activate=['joint_state_broadcaster']) is None
    assert client.states() == {'joint_state_broadcaster': 'active'}
    assert not client.unload('joint_state_broadcaster')
    assert client.switch(deactivate=['joint_state_broadcaster']) is None
    assert client.unload('joint_state_broadcaster')
    assert client.states() == {}
    assert 'joint_state_broadcaster' not in host.client_node.get_node_names()


def test_topics_have_the_names_and_the_qos_that_the_original_has(host):
    host.activate('joint_state_broadcaster', 'diff_drive_controller')
    publishers = host.client_node.get_publishers_info_by_topic
    (odom,) = wait_until(
        host.client_node,
        lambda: publishers('/odom') or None,
        lambda: None,
        every=1.0,
        timeout=PATIENCE,
    )
    (joints,) = publishers('/joint_states')
    for endpoint, node in ((odom, 'diff_drive_controller'), (joints, 'joint_state_broadcaster')):
        assert endpoint.node_name == node
        assert endpoint.qos_profile.reliability == ReliabilityPolicy.RELIABLE
        assert endpoint.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    (command,) = host.client_node.get_subscriptions_info_by_topic('/diff_drive_controller/cmd_vel')
    assert command.topic_type == 'geometry_msgs/msg/TwistStamped'
    assert command.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
    assert command.qos_profile.durability == DurabilityPolicy.VOLATILE


def test_nodes_say_sim_time_but_do_not_subscribe_to_the_clock(host):
    host.activate('diff_drive_controller')
    assert host.client_node.get_publishers_info_by_topic('/clock')
    assert host.client_node.get_subscriptions_info_by_topic('/clock') == []
    controllers = [host.running.requests.controllers['diff_drive_controller'].node]
    for node in (host.manager_node.node, *controllers):
        assert node.get_parameter('use_sim_time').value is True
        before = node.get_clock().now().nanoseconds
        wait_until(
            host.client_node,
            lambda: node.get_clock().now().nanoseconds > before or None,  # noqa: B023
            lambda: None,
            every=1.0,
            timeout=PATIENCE,
        )
        after = node.get_clock().now().nanoseconds
        assert before < after <= host.loop_thread.loop.time
        assert after % PERIOD == 0


def test_a_slow_configure_keeps_nobody_waiting(host):
    assert host.client.load('slow')
    import third_party

    future = host.client_node.create_client(
        srv.ConfigureController, '/controller_manager/configure_controller'
    ).call_async(srv.ConfigureController.Request(name='slow'))
    assert third_party.Slow.configuring.wait(PATIENCE)
    assert host.client.states() == {'slow': 'unconfigured'}
    reads = host.hardware.count('read')
    host.activate('joint_state_broadcaster')
    assert wait_until(
        host.client_node, lambda: host.hardware.count('read') > reads + 2 or None, timeout=PATIENCE
    )
    assert not host.client.unload('slow')
    assert 'it is being configured' in host.client.reasons('slow')
    assert not future.done()
    third_party.Slow.let.set()
    rclpy.spin_until_future_complete(host.client_node, future, timeout_sec=PATIENCE)
    assert future.result().ok
    assert host.client.states()['slow'] == 'inactive'


@pytest.mark.parametrize(
    ('name', 'reason'),
    [
        ('unheard_of', 'no type is set for it: /controller_manager has one for '),
        ('nowhere', "controller type 'no_such_package/Nothing' is not known"),
        ('broken', "load controller 'broken': ValueError: a mistake of a third party"),
        (
            'wrong_number',
            "'wheel_radius' must be of type double, found '0.1', a string; write",
        ),
    ],
)
def test_a_controller_that_cannot_be_loaded_is_refused_with_the_reason(host, name, reason):
    assert not host.client.load(name)
    assert reason in host.client.reasons(name)
    assert host.client.states() == {}
    assert name not in host.client_node.get_node_names()


@pytest.mark.parametrize(
    ('name', 'reason'),
    [
        (
            'drive',
            'x.yaml:10: drive: there is no parameter "wheel_seperation", and it is ignored; did '
            'you mean "wheel_separation"?',
        ),
        (
            'turner',
            'x.yaml:13: the section "turnner" is for no node: expected the name of the '
            'controllers: "drive", "turner", "driver"; did you mean "turner"?',
        ),
        (
            'driver',
            'x.yaml:5: driver: there is no controller type '
            '"diff_drive_controller/DiffDriveControler"; did you mean '
            '"diff_drive_controller/DiffDriveController"?',
        ),
        (
            'untyped',
            "no type is set for 'untyped': x.yaml:6: controller_manager: there is no parameter "
            '"untyped.tpye", and it is ignored; did you mean "untyped.type"?',
        ),
    ],
)
def test_a_mistake_in_a_file_is_named_in_the_place_of_its_consequence(ros, tmp_path, name, reason):
    with running_host(tmp_path, MISSPELT) as host:
        assert not host.client.load(name)
        assert host.client.reasons(name).replace(f'{tmp_path}/controllers', 'x') == reason


def test_a_parameter_that_is_ignored_is_warned_of_before_the_controller_runs(ros, tmp_path, capfd):
    text = YAML + 'rival_1:\n  ros__parameters:\n    publish_rat: 20.0\n'
    with running_host(tmp_path, text) as host:
        assert host.client.load('rival_1')
    assert (
        'there is no parameter "publish_rat", and it is ignored; did you mean "publish_rate"?'
        in (capfd.readouterr().err)
    )


@pytest.mark.parametrize(
    ('entry', 'reason'),
    [
        ({'params_file': 'missing.yaml'}, "parameter file 'missing.yaml': No such file"),
        ({'params_file': ['broken.yaml']}, 'broken.yaml:1:'),
        ({'params_file': 'x' * 300}, "x': File name too long"),
        ({'node_options_args': ['--ros-args', '-r', 'nonsense']}, 'nonsense'),
        ({'node_options_args': ['-p', 'update_rate:=-1']}, "'update_rate' must be at least 0"),
    ],
)
def test_what_cannot_be_given_to_a_controller_is_refused_with_the_reason(
    host, entry, reason, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'broken.yaml').write_text('{')
    host.client.set_parameters('slow', entry)
    assert not host.client.load('slow')
    assert reason in host.client.reasons('slow')
    assert 'slow' not in host.client_node.get_node_names()


def test_options_of_a_controller_hold_with_and_without_ros_args(host):
    for name, words in (
        ('slow', ['--ros-args', '-p', 'update_rate:=50', '--']),
        ('joint_state_broadcaster', ['-p', 'update_rate:=50']),
    ):
        host.client.set_parameters(name, {'node_options_args': words})
        assert host.client.load(name)
    rates = [each.update_rate for each in host.running.manager.snapshot.controllers]
    assert rates == [50, 50]


def test_a_parameter_is_checked_when_set_and_counts_at_the_next_configure(host):
    host.activate('diff_drive_controller')
    node = host.running.requests.controllers['diff_drive_controller'].node
    (refused,) = node.set_parameters([Parameter('wheel_radius', value=-0.1)])
    assert not refused.successful
    assert refused.reason == "parameter 'wheel_radius' must be greater than 0, found -0.1 m"
    (accepted,) = node.set_parameters([Parameter('publish_limited_velocity', value=True)])
    assert accepted.successful
    assert (
        host.client_node.get_publishers_info_by_topic('/diff_drive_controller/cmd_vel_out') == []
    )
    assert host.client.switch(deactivate=['diff_drive_controller']) is None
    assert host.client.configure('diff_drive_controller')
    publishers = host.client_node.get_publishers_info_by_topic
    assert wait_until(
        host.client_node,
        lambda: publishers('/diff_drive_controller/cmd_vel_out') or None,
        lambda: None,
        every=1.0,
        timeout=PATIENCE,
    )


def test_parameters_are_described_with_unit_and_meaning(host):
    assert host.client.load('diff_drive_controller')
    response = call(
        host.client_node,
        DescribeParameters,
        '/diff_drive_controller/describe_parameters',
        DescribeParameters.Request(names=['cmd_vel_timeout', 'left_wheel_names']),
    )
    timeout, wheels = response.descriptors
    assert timeout.description.endswith('[s]')
    assert wheels.type == Parameter.Type.STRING_ARRAY.value


def test_the_message_of_a_refused_switch_is_the_response(host):
    assert host.client.load('diff_drive_controller')
    message = host.client.switch(activate=['diff_drive_controller'])
    assert "is in 'unconfigured' state" in message


def test_types_interfaces_and_components_are_listed(host):
    host.activate('diff_drive_controller')
    types = call(
        host.client_node,
        srv.ListControllerTypes,
        '/controller_manager/list_controller_types',
        srv.ListControllerTypes.Request(),
    )
    bases = dict(zip(types.types, types.base_classes, strict=True))
    assert bases['diff_drive_controller/DiffDriveController'].endswith(
        'ChainableControllerInterface'
    )
    interfaces = call(
        host.client_node,
        srv.ListHardwareInterfaces,
        '/controller_manager/list_hardware_interfaces',
        srv.ListHardwareInterfaces.Request(),
    )
    references = [f'diff_drive_controller/{axis}/velocity' for axis in ('angular', 'linear')]
    wheels = sorted(f'{w}/velocity' for w in WHEELS)
    assert [i.name for i in interfaces.command_interfaces] == references + wheels
    assert [i.name for i in interfaces.command_interfaces if i.is_claimed] == wheels
    components = call(
        host.client_node,
        srv.ListHardwareComponents,
        '/controller_manager/list_hardware_components',
        srv.ListHardwareComponents.Request(),
    )
    (component,) = components.component
    assert (component.name, component.state.label) == ('hardware', 'active')


def test_a_failing_cycle_of_the_loop_ends_the_process_with_the_motors_stopped(host, monkeypatch):
    host.activate('diff_drive_controller')

    def break_down():
        raise RuntimeError('a bug in the loop')

    told = threading.Event()
    host.loop_thread.on_failure = told.set
    monkeypatch.setattr(host.loop_thread.loop, 'tick', break_down)
    assert told.wait(PATIENCE)
    host.loop_thread.stop()
    assert host.loop_thread.failed
    assert set(host.hardware.written.values()) == {0.0}
    assert host.hardware.count('deactivate') == 1


def test_converters_that_fail_end_nothing(host, stderr):
    host.client.set_parameters('babbler', {'type': 'third_party/Babbler'})
    host.activate('babbler')
    publisher = host.client_node.create_publisher(String, '/babbler/heard', 1)

    def complained():
        publisher.publish(String())
        said = '\n'.join(line for line in stderr().splitlines() if 'TypeError' in line)
        return "on '/babbler/said'" in said and "on '~/heard'" in said or None

    assert wait_until(host.client_node, complained, lambda: None, every=1.0, timeout=PATIENCE)
    assert not host.loop_thread.failed
    assert host.client.states() == {'babbler': 'active'}


def test_a_controller_whose_topics_cannot_be_made_is_not_configured(host):
    host.client.set_parameters('lost', {'type': 'third_party/Lost'})
    assert host.client.load('lost')
    assert not host.client.configure('lost')
    reason = host.client.reasons('lost')
    assert "Failed to configure controller 'lost': " in reason
    assert 'no_such_msgs' in reason
    assert host.client.states() == {'lost': 'unconfigured'}


def test_an_optional_topic_without_its_message_package_is_left_out(host, stderr):
    host.client.set_parameters('modest', {'type': 'third_party/Modest'})
    host.activate('modest')
    assert host.client.states() == {'modest': 'active'}

    def warned():
        return "'~/said' is not published: " in stderr() or None

    assert wait_until(host.client_node, warned, lambda: None, timeout=PATIENCE)


def test_a_switch_that_raises_anything_is_answered(host, monkeypatch):
    def break_down(*_):
        raise ZeroDivisionError('a third party')

    monkeypatch.setattr(host.running.manager, 'switch', break_down)
    answer = host.client.switch(activate=['any'])
    assert re.fullmatch(
        r'ZeroDivisionError: a third party \(test_controller_manager_node.py:\d+\)', answer
    )


def test_what_was_said_on_a_topic_that_is_gone_is_dropped(ros):
    node = Node('speaker')
    loop_publisher = LoopPublisher(node.get_logger())
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    gone, there = (node.create_publisher(String, name, latched) for name in ('gone', 'there'))
    filled = []
    for publisher in (gone, there):
        name = publisher.topic_name
        fill = filling(lambda sample, _: filled.append(sample), String())
        loop_publisher.topic(publisher, fill).send(name)
    node.destroy_publisher(gone)
    loop_publisher.publish(0)
    assert filled == ['/there']
    node.destroy_node()


def test_a_control_thread_that_was_never_started_stops_at_once(ros):
    thread = LoopThread(CallQueue(), SingleThreadedExecutor())
    thread.stop()
    assert not thread.failed


@pytest.mark.parametrize(
    ('rate', 'reason'),
    [
        ('0', 'must be greater than 0, found 0 Hz'),
        ('-5', 'must be greater than 0, found -5 Hz'),
        ('99.5', 'must be of type integer, found 99.5, a double'),
        ('fast', "must be of type integer, found 'fast', a string"),
    ],
)
def test_an_update_rate_that_cannot_be_is_refused(ros, tmp_path, rate, reason):
    path = tmp_path / 'rate.yaml'
    path.write_text(f'controller_manager: {{ros__parameters: {{update_rate: {rate}}}}}')
    with pytest.raises(ParameterError, match=f"'update_rate'.*{reason}"):
        Host(path)


def test_libraries_are_reloaded_once_nothing_runs_or_by_force(host, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    source = tmp_path / 'edited.py'
    template = 'from third_party import Slow\n\nclass Edited(Slow):\n    {body}\n'
    source.write_text(template.format(body='configure = print'))
    host.client.set_parameters('edited', {'type': 'edited/Edited'})
    host.activate('joint_state_broadcaster', 'edited')

    assert not host.client.reload_libraries(force_kill=False)
    assert 'there are still active controllers: edited, joint' in host.client.reasons('edited')
    assert set(host.client.states().values()) == {'active'}

    source.write_text(template.format(body='def configure(self, _): raise ValueError("anew")'))
    assert host.client.reload_libraries(force_kill=True)
    assert host.client.states() == {}
    assert 'edited' not in host.client_node.get_node_names()
    assert host.client.load('edited')
    assert not host.client.configure('edited')
    assert "Failed to configure controller 'edited': ValueError: anew" in host.client.reasons(
        'edited'
    )

    source.write_text('class Edited(\n')
    assert not host.client.reload_libraries(force_kill=False)
    assert "Cannot reload controller library 'edited': SyntaxError" in host.client.reasons(
        'edited'
    )
    assert host.client.states() == {}
