# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A new controller over ROS, named by its type alone: ours from the table, and one of another package
that nothing here knows of.
"""

from control_msgs.msg import DynamicJointState
import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64, Float64MultiArray
from support.control_fakes import WHEELS
from support.manager_host import ros_in_this_process, running_host
from support.paths import TESTS
from support.running_programs import PATIENCE

from amr_description.ros.service_calls import wait_until

FIXTURES = TESTS / 'fixtures' / 'nodes'
PARAMETERS = f"""
wheel_velocities:
  ros__parameters: {{joints: [{', '.join(WHEELS)}]}}
doubler:
  ros__parameters: {{wheel: {WHEELS[0]}}}
"""
TYPES = {
    'wheel_velocities': 'velocity_controllers/JointGroupVelocityController',
    'doubler': 'other_package/Doubler',
}


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    folder = tmp_path_factory.mktemp('host')
    path = folder / 'new_controllers.yaml'
    path.write_text(PARAMETERS)
    with (
        pytest.MonkeyPatch.context() as patch,
        ros_in_this_process(),
        running_host(folder) as host,
    ):
        patch.syspath_prepend(str(FIXTURES))
        for name, controller_type in TYPES.items():
            host.client.set_parameters(name, {'type': controller_type, 'params_file': [str(path)]})
        yield host


@pytest.fixture(autouse=True)
def left_alone(host):
    yield
    host.forget()


def until(host, condition, say=lambda: None):
    """Wait for ``condition()`` to be true, calling ``say`` every 0.1 s; fail if it never is."""
    found = wait_until(
        host.client_node, lambda: condition() or None, say, every=0.1, timeout=PATIENCE
    )
    assert found


def listen(host, message, topic, qos):
    heard = []
    host.client_node.create_subscription(message, topic, heard.append, qos)
    return heard


def test_a_group_of_joints_turns_as_told_and_stops_with_its_controller(host):
    publisher = host.client_node.create_publisher(
        Float64MultiArray, '/wheel_velocities/commands', 1
    )

    def tell():
        publisher.publish(Float64MultiArray(data=[1.0, 2.0, 3.0, 4.0]))

    host.activate('wheel_velocities')
    until(host, lambda: list(host.hardware.written.values()) == [1.0, 2.0, 3.0, 4.0], tell)
    assert host.client.switch(deactivate=['wheel_velocities']) is None
    until(host, lambda: set(host.hardware.written.values()) == {0.0})


def test_a_controller_of_another_package_needs_no_edit_here(host):
    publisher = host.client_node.create_publisher(Float64, '/doubler/speed', 1)
    doubled = listen(host, Float64, '/doubler/doubled', 1)
    host.activate('doubler')
    until(host, lambda: doubled, lambda: publisher.publish(Float64(data=1.5)))
    assert doubled[0].data == 3.0
    assert host.hardware.written[WHEELS[0]] == 3.0
    assert host.client.switch(deactivate=['doubler']) is None
    until(host, lambda: host.hardware.written[WHEELS[0]] == 0.0)


def test_a_parameter_of_another_package_is_checked_by_its_own_table(host, tmp_path):
    path = tmp_path / 'nameless.yaml'
    path.write_text('nameless: {ros__parameters: {factor: 3.0}}')
    host.client.set_parameters('nameless', {'type': TYPES['doubler'], 'params_file': [str(path)]})
    assert not host.client.load('nameless')
    assert "'wheel' must not be empty" in host.client.reasons('nameless')


def test_dynamic_joint_states_go_out_with_the_qos_of_the_original(host):
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    heard = listen(host, DynamicJointState, '/dynamic_joint_states', latched)
    host.activate('joint_state_broadcaster')
    until(host, lambda: heard)
    assert sorted(heard[0].joint_names) == sorted(WHEELS)
    for row in heard[0].interface_values:
        values = dict(zip(row.interface_names, row.values, strict=True))
        assert values.keys() == {'position', 'velocity'}
        assert values['velocity'] == 0.0
    assert heard[0].header.frame_id == 'base_link'
    (publisher,) = host.client_node.get_publishers_info_by_topic('/dynamic_joint_states')
    assert publisher.node_name == 'joint_state_broadcaster'
    assert publisher.qos_profile.reliability == ReliabilityPolicy.RELIABLE
    assert publisher.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
