# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""joint_trajectory_controller over ROS: a real action client moves an arm of two joints."""

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTrajectoryControllerState
from control_msgs.srv import QueryTrajectoryState
import pytest
from rclpy.action import ActionClient
from support.control_fakes import WHEELS
from support.manager_host import ros_in_this_process, running_host
from support.running_programs import PATIENCE
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from amr_description.ros.service_calls import call, wait_until

JOINTS = list(WHEELS[:2])
YAML = f"""
controller_manager:
  ros__parameters:
    update_rate: 100
    arm: {{type: joint_trajectory_controller/JointTrajectoryController}}
arm:
  ros__parameters:
    joints: [{', '.join(JOINTS)}]
    command_interfaces: [velocity]
    state_interfaces: [position, velocity]
    gains: {{{', '.join(f'{joint}: {{p: 5.0, ff_velocity_scale: 1.0}}' for joint in JOINTS)}}}
    constraints: {{{', '.join(f'{joint}: {{goal: 0.05}}' for joint in JOINTS)}}}
"""


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    with (
        ros_in_this_process(),
        running_host(tmp_path_factory.mktemp('host'), YAML) as host,
    ):
        host.activate('arm')
        yield host


@pytest.fixture(scope='module')
def client(host):
    client = ActionClient(host.client_node, FollowJointTrajectory, '/arm/follow_joint_trajectory')
    wait_until(host.client_node, lambda: client.server_is_ready() or None, timeout=PATIENCE)
    yield client
    client.destroy()


def trajectory(*positions, names=JOINTS, step=0.2):
    points = []
    for number, row in enumerate(positions, start=1):
        sec, part = divmod(number * step, 1.0)
        time = Duration(sec=int(sec), nanosec=round(part * 1e9))
        points.append(JointTrajectoryPoint(positions=row, time_from_start=time))
    return JointTrajectory(joint_names=names, points=points)


def finish(host, future):
    return wait_until(
        host.client_node, lambda: future.result() if future.done() else None, timeout=PATIENCE
    )


def send(host, client, *positions, feedback_callback=None, **options):
    goal = FollowJointTrajectory.Goal(trajectory=trajectory(*positions, **options))
    return finish(host, client.send_goal_async(goal, feedback_callback=feedback_callback))


def test_a_goal_moves_the_joints_and_succeeds(host, client):
    feedback, states = [], []
    host.client_node.create_subscription(
        JointTrajectoryControllerState, '/arm/controller_state', states.append, 10
    )
    goal = FollowJointTrajectory.Goal(trajectory=trajectory([0.3, -0.2], [0.5, -0.4]))
    handle = finish(host, client.send_goal_async(goal, feedback_callback=feedback.append))
    assert handle.accepted
    response = finish(host, handle.get_result_async())
    assert response.status == GoalStatus.STATUS_SUCCEEDED
    assert response.result.error_code == FollowJointTrajectory.Result.SUCCESSFUL
    assert response.result.error_string == 'Goal successfully reached!'
    positions = [host.hardware.positions[joint].value for joint in JOINTS]
    assert positions == pytest.approx([0.5, -0.4], abs=0.06)
    assert list(feedback[0].feedback.joint_names) == JOINTS
    assert wait_until(host.client_node, lambda: states or None, timeout=PATIENCE)
    assert len(states[-1].output.velocities) == 2
    assert list(states[-1].joint_names) == JOINTS


def test_the_topic_moves_the_joints_too(host):
    publisher = host.client_node.create_publisher(JointTrajectory, '/arm/joint_trajectory', 10)
    wait_until(
        host.client_node, lambda: publisher.get_subscription_count() or None, timeout=PATIENCE
    )
    publisher.publish(trajectory([0.1, 0.1]))

    def is_there():
        values = [host.hardware.positions[joint].value for joint in JOINTS]
        return values == pytest.approx([0.1, 0.1], abs=0.02) or None

    assert wait_until(host.client_node, is_there, timeout=PATIENCE)


def test_a_wrong_message_is_named_in_the_log(host, stderr):
    publisher = host.client_node.create_publisher(JointTrajectory, '/arm/joint_trajectory', 10)
    wait_until(
        host.client_node, lambda: publisher.get_subscription_count() or None, timeout=PATIENCE
    )
    publisher.publish(JointTrajectory(joint_names=JOINTS))
    text = 'Empty trajectory received.'
    assert wait_until(host.client_node, lambda: text in stderr() or None, timeout=PATIENCE)


def test_a_wrong_goal_is_rejected_with_its_reason_in_the_log(host, client, stderr):
    assert not send(host, client, [0.0, 0.0], names=['nobody', JOINTS[1]]).accepted
    text = "Incoming joint nobody doesn't match the controller's joints."
    assert wait_until(host.client_node, lambda: text in stderr() or None, timeout=PATIENCE)


def test_a_goal_is_canceled(host, client):
    feedback = []
    handle = send(host, client, [2.0, 2.0], step=60.0, feedback_callback=feedback.append)
    wait_until(host.client_node, lambda: feedback or None, timeout=PATIENCE)
    request = QueryTrajectoryState.Request(time=feedback[-1].feedback.header.stamp)
    state = call(host.client_node, QueryTrajectoryState, '/arm/query_state', request)
    assert state.success
    assert list(state.name) == JOINTS
    assert len(finish(host, handle.cancel_goal_async()).goals_canceling) == 1
    assert finish(host, handle.get_result_async()).status == GoalStatus.STATUS_CANCELED


def test_a_deactivation_aborts_the_goal(host, client):
    handle = send(host, client, [2.0, 2.0], step=60.0)
    assert host.client.switch(deactivate=['arm']) is None
    response = finish(host, handle.get_result_async())
    assert response.status == GoalStatus.STATUS_ABORTED
    assert response.result.error_string == 'Current goal cancelled during deactivate transition.'
    assert host.client.switch(activate=['arm']) is None
